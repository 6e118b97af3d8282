//! `wedm completions`: what a shell needs to complete the commands and their options.

use super::{Failure, Verdict, output};
use clap::Args;
use clap_complete::Shell;

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm completions bash > ~/.local/share/bash-completion/completions/wedm
  wedm completions fish > ~/.config/fish/completions/wedm.fish")]
pub(crate) struct Arguments {
    #[arg(value_enum)]
    shell: Shell,
}

pub(crate) fn run(arguments: &Arguments, command: &mut clap::Command) -> Result<Verdict, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, command, "wedm", &mut script);
    output::write(None, &script, false)?;
    Ok(Verdict::Clean)
}
