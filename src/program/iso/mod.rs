//! ISO programs for wire EDM: words of G code, read as a control runs them and written by profiles.
//!
//! How numbers and arc centres are meant differs from machine to machine and is found from the program itself, never assumed.

mod block;
mod control;
mod corner;
mod crossings;
mod cuts;
mod document;
mod encode;
mod evidence;
mod fixes;
mod labels;
pub mod language;
mod layout;
mod limits;
mod line;
mod machine;
mod numbers;
mod order;
mod read;
pub(in crate::program) mod refactor;
mod repair;
mod report;
mod run;
mod shape;
mod steps;
mod stretch;
mod style;
mod table;
mod taper;
#[cfg(test)]
mod tests;
mod word;
mod write;

pub use block::{Block, Compensation, Corner, Motion, Note, Offset, Stop, read_line};
pub use document::Document;
pub use layout::format;
pub(in crate::program) use numbers::renamed;
pub(in crate::program) use taper::{Words as TaperWords, refuse_anywhere as refuse_taper};

pub use machine::{CenterRule, Course, Machine, Move, Reading};
pub use word::{Number, Term, Token, Value, WordFault, words};
pub use write::{write, write_with};
