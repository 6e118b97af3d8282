//! `wedm serve`: the language server.

use crate::server::{self, Options};
use clap::Args;
use std::process::ExitCode;

/// Speak the language server protocol on stdin and stdout (what happens without a command)
#[derive(Args, Debug, Default)]
pub struct Arguments {
    /// Accepted for editors that pass it; there is no other way
    #[arg(long)]
    stdio: bool,
    /// Go on when the process that the client names has died: in a container its number means nothing
    #[arg(long)]
    no_parent_watch: bool,
}

pub fn run(arguments: &Arguments) -> ExitCode {
    server::run_stdio(Options {
        watch_parent: !arguments.no_parent_watch,
    })
}
