//! `wedm config`: what can be set.

use super::{Failure, Verdict, output};
use crate::protocol;
use clap::{Args, Subcommand};

#[derive(Args, Debug)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    Schema,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Verdict, Failure> {
    match arguments.what {
        What::Schema => {
            output::print_json_text(&format!("{:#}\n", protocol::settings_schema()))?;
        }
    }
    Ok(Verdict::Clean)
}
