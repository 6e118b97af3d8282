//! ISO programs for wire EDM: G code, read as a control runs it and written by profiles.
//!
//! The meaning of numbers and arc centres differs from machine to machine and is found from the program itself, never
//! assumed.

pub(crate) mod block;
mod code;
mod contours;
mod control;
mod corner;
mod cursor;
mod cut;
pub(crate) mod document;
mod dropped;
mod encode;
mod evidence;
mod far;
mod fixes;
pub(crate) mod labels;
mod layout;
mod leader;
mod limits;
pub(crate) mod line;
pub(crate) mod machine;
mod mill;
pub(crate) mod moves;
mod names;
mod numbers;
mod order;
pub(crate) mod plain;
mod read;
pub(in crate::program) mod refactor;
mod repair;
mod report;
pub(crate) mod steps;
pub(crate) mod style;
mod summary;
mod table;
pub(in crate::program) mod taper;
#[cfg(test)]
mod tests;
mod tilt;
mod unfollowed;
mod variables;
pub(crate) mod word;
mod write;

pub(crate) use block::Register;
pub use block::read_line;
pub use document::Document;
pub(crate) use dropped::Dropped;
pub(in crate::program) use dropped::dropped;
pub(crate) use layout::format;
pub(crate) use mill::write_milled;
pub(in crate::program) use taper::{Words as TaperWords, refuse_anywhere as refuse_taper};

pub(crate) use names::Unfollowed;
pub(crate) use plain::{words, words_in};
pub(in crate::program) use tilt::{STEEPEST, Unknown};
pub(crate) use unfollowed::UnfollowedWord;
pub(crate) use word::Token;
pub use write::write;
pub(crate) use write::{Carried, read_of_profile, write_keeping, write_with};
