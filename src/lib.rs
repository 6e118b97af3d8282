//! wedm: a language server for wire EDM.
//!
//! The floors, each of which imports only floors below it: [`cli`] and [`server`] (two faces of the same library),
//! [`analysis`], [`rules`], [`toolpath`], [`program`], [`dxf`], [`drawing`], [`geometry`].
//! `docs/architecture.md` is the map.

#[macro_use]
pub mod message;

pub mod analysis;
pub mod cli;
mod disk;
pub mod document;
pub mod drawing;
pub mod dxf;
pub mod finding;
pub mod fit;
pub mod geometry;
pub mod ide;
pub mod job;
pub mod picture;
pub mod program;
pub mod protocol;
pub mod rule;
pub(crate) mod rules;
pub mod server;
pub mod settings;
pub mod text;
pub mod toolpath;
