//! Simplified Chinese, in the words of `docs/zh/glossary.md`: the same rows as in English.

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
