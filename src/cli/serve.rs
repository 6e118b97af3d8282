//! `wedm serve`: the language server.

use crate::server::{self, Options};
use clap::Args;
use std::io::IsTerminal;
use std::process::ExitCode;

/// Speak the language server protocol on stdin and stdout (what happens without a command)
#[derive(Args, Debug, Default)]
pub(crate) struct Arguments {
    /// Accepted for editors that pass it; there is no other way
    #[arg(long)]
    stdio: bool,
    /// Go on when the process that the client names has died: in a container its number means nothing
    #[arg(long)]
    no_parent_watch: bool,
}

impl Arguments {
    /// True where there is no client: a person sits at the terminal and gave no options.
    pub(crate) fn is_asked_by_nobody(&self) -> bool {
        let terminals = std::io::stdin().is_terminal() && std::io::stdout().is_terminal();
        terminals && !self.stdio && !self.no_parent_watch
    }
}

pub(crate) fn run(arguments: &Arguments) -> ExitCode {
    server::run_stdio(Options {
        watch_parent: !arguments.no_parent_watch,
    })
}
