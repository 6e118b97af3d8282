//! wedm: a language server for wire EDM.
//!
//! The floors, from the top, each of which imports only floors below it: [`cli`]; `view`; [`server`]; [`ide`], [`job`],
//! [`protocol`]; [`document`], [`picture`]; [`compare`]; [`analysis`], [`program`]; [`fit`]; `rules`, [`toolpath`];
//! [`dxf`], [`settings`]; [`finding`]; [`drawing`]; [`rule`]; [`geometry`], [`text`], [`message`], `disk`.
//! `docs/architecture.md` is the map and describes each.
//!
//! Nothing here may panic. Text is nowhere cut at a number of bytes, which may lie within a character. Rooms that read
//! foreign input do not index; elsewhere an index comes from the same list a few lines before, and property tests and
//! fuzz targets exercise it.

#![warn(
    unreachable_pub,
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::todo,
    clippy::indexing_slicing
)]
#![cfg_attr(not(test), warn(clippy::unreachable, clippy::string_slice))]

#[macro_use]
pub mod message;

#[allow(clippy::indexing_slicing)]
pub mod analysis;
pub mod calibration;
#[allow(clippy::indexing_slicing)]
pub mod cli;
#[allow(clippy::indexing_slicing)]
pub mod compare;
mod disk;
pub mod document;
#[allow(clippy::indexing_slicing)]
pub mod drawing;
pub mod dxf;
pub mod finding;
#[allow(clippy::indexing_slicing)]
pub mod fit;
#[allow(clippy::indexing_slicing)]
pub mod geometry;
#[allow(clippy::indexing_slicing)]
pub mod ide;
pub mod job;
pub mod picture;
#[allow(clippy::indexing_slicing)]
pub mod program;
pub mod protocol;
pub mod rule;
#[allow(clippy::indexing_slicing)]
pub(crate) mod rules;
pub mod server;
pub mod settings;
pub mod text;
#[allow(clippy::indexing_slicing)]
pub mod toolpath;
mod view;
