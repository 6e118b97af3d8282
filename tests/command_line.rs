//! The command line, and what is written for people and tools to read: pages, tables of settings, sentences, the schema.
//!
//! One binary for many files: what they stand on is compiled once.

#[path = "cli/main.rs"]
mod cli;
#[path = "demo.rs"]
mod demo;
#[path = "docs/main.rs"]
mod docs;
#[path = "messages.rs"]
mod messages;
#[path = "schema.rs"]
mod schema;
#[path = "settings/main.rs"]
mod settings;
