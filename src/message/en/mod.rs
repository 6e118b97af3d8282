//! English, which says which sentences there are: one file for each room that they are of.

mod amounts;
mod cli;
mod codes;
mod drawing;
mod files;
mod findings;
mod help;
mod ide;
mod job;
mod pages;
mod program;
mod server;
mod settings;
mod toolpath;
mod view;

pub(super) use {
    amounts::*, cli::*, codes::*, drawing::*, files::*, findings::*, help::*, ide::*, job::*,
    pages::*, program::*, server::*, settings::*, toolpath::*, view::*,
};

/// Every sentence, in the language that is spoken.
pub(crate) mod said {
    pub(crate) use super::{
        amounts::said::*, cli::said::*, codes::said::*, drawing::said::*, files::said::*,
        findings::said::*, ide::said::*, job::said::*, pages::said::*, program::said::*,
        server::said::*, settings::said::*, toolpath::said::*, view::said::*,
    };
}
