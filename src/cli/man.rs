//! `wedm man`: a manual page for each command, as packages install them.

use super::{Failure, Verdict, output};
use clap::Args;
use clap_mangen::Man;
use std::path::PathBuf;

#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm man ~/.local/share/man/man1")]
pub(crate) struct Arguments {
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

pub(crate) fn run(arguments: &Arguments, command: clap::Command) -> Result<Verdict, Failure> {
    let folder = &arguments.folder;
    std::fs::create_dir_all(folder).map_err(|error| {
        Failure(say!(
            could_not_be_made,
            folder.display(),
            crate::disk::plain(&error)
        ))
    })?;
    let mut command = command.disable_help_subcommand(true);
    command.build();
    let mut pages = vec![command.clone()];
    pages.extend(command.get_subcommands().cloned());
    for page in pages {
        let man = Man::new(page.display_order(0));
        let path = folder.join(man.get_filename());
        let mut text = Vec::new();
        man.render(&mut text)
            .map_err(|error| Failure::of(&path, error))?;
        output::write(Some(&path), &text, true)?;
    }
    Ok(Verdict::Clean)
}
