//! `wedm serve`: the language server.

use super::{Failure, Verdict};
use clap::Args;

/// Speak the language server protocol on stdin and stdout (what happens without a command)
#[derive(Args, Debug)]
pub struct Arguments {
    /// Accepted for editors that pass it; there is no other way
    #[arg(long)]
    stdio: bool,
}

pub fn run() -> Result<Verdict, Failure> {
    Err(Failure("not merged".into()))
}
