//! `wedm serve`: the language server.

use crate::server::{self, Options};
use clap::Args;
use std::io::IsTerminal;
use std::process::ExitCode;

#[derive(Args, Debug, Default)]
pub(crate) struct Arguments {
    #[arg(long)]
    stdio: bool,
    #[arg(long)]
    no_parent_watch: bool,
}

impl Arguments {
    /// True where there is no client: a person sits at the terminal and gave no options.
    pub(crate) fn is_asked_by_nobody(&self) -> bool {
        // What stdout is does not matter: `wedm | head` is typed by a person, too.
        std::io::stdin().is_terminal() && !self.stdio && !self.no_parent_watch
    }
}

pub(crate) fn run(arguments: &Arguments) -> ExitCode {
    server::run_stdio(Options {
        watch_parent: !arguments.no_parent_watch,
    })
}
