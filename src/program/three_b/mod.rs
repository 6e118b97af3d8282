//! The 3B block language of Chinese fast-wire controllers.
//!
//! Everything here counts in micrometres on the program's grid; only [`write()`] knows of a drawing's unit.

mod around;
pub(crate) mod block;
mod cut;
pub mod decode;
mod document;
pub(crate) mod encode;
mod entry;
mod fault;
mod fields;
pub(in crate::program) mod format;
pub(crate) mod layout;
mod line;
mod machine;
mod numbers;
pub(crate) mod parse;
mod part;
pub(crate) mod pieces;
mod proof;
pub(in crate::program) mod refactor;
mod repair;
mod rules;
mod stand;
#[cfg(test)]
mod tests;
pub(crate) mod words;
mod write;

pub use block::{Block, CountingAxis, Motion, Quadrant};
pub use decode::decode;
pub use document::Document;
pub use fields::{Fields, fields_of};
#[cfg(feature = "testing")]
pub use machine::stepped::interpolate;
pub use machine::travel;
pub use parse::{Item, read, read_line};
pub use words::Words;
pub use write::write;
pub(crate) use write::{write_four_b, write_with};
