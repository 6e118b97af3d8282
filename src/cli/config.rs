//! `wedm config`: what can be set.

use super::{Failure, Verdict, output};
use crate::protocol;
use clap::{Args, Subcommand};

/// Say what can be set
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  wedm config schema > wedm.schema.json    completion and checks in editors that take a schema for TOML:
                                           `#:schema ./wedm.schema.json` in the first line of wedm.toml")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// The JSON Schema of wedm.toml
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
