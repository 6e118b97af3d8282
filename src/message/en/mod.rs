//! English, which says which sentences there are: one file for each room that they are of.

mod cli;
mod drawing;
mod files;
mod findings;
mod job;
mod rules;
mod server;
mod settings;
mod toolpath;

pub(super) use {
    cli::*, drawing::*, files::*, findings::*, job::*, rules::*, server::*, settings::*,
    toolpath::*,
};

/// Every sentence, in the language that is spoken.
pub(crate) mod said {
    pub(crate) use super::{
        cli::said::*, drawing::said::*, files::said::*, findings::said::*, job::said::*,
        rules::said::*, server::said::*, settings::said::*, toolpath::said::*,
    };
}
