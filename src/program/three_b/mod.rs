//! The 3B block language of Chinese fast-wire controllers.
//!
//! Everything in here counts in micrometres on the program's grid; only [`write()`] knows of a drawing's unit.

mod block;
mod decode;
mod document;
mod encode;
pub(in crate::program) mod language;
mod layout;
mod parse;
mod proof;
#[cfg(test)]
mod tests;
mod write;

pub use block::{Block, CountingAxis, LARGEST, Motion, Node, Quadrant};
pub use decode::{DecodeFault, decode};
pub use document::Document;
pub use encode::{Encoded, encode, snap};
pub use parse::{Item, SyntaxFault, Word, Words, read, read_line};
pub use write::{ProofError, ProvedProgram, write, write_with};
