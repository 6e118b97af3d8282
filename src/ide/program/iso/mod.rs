//! What an editor asks about ISO text alone: what its words mean, what can follow, which words belong together.
//!
//! What hangs on the machine's way, whatever the language, is in [`crate::ide::program`].

mod centres;
mod completion;
mod matching;
mod meaning;
mod signature;
#[cfg(test)]
mod tests;
mod vocabulary;

pub(crate) use completion::completions;
pub(crate) use matching::partner;
pub(crate) use meaning::meaning;
pub(crate) use signature::signature;

use crate::program::iso::block::word_range;

/// True where a word stands in a line.
fn holds(line: &[u8], letter: u8, number: i64) -> bool {
    let is_it = |its: u8, own: crate::program::iso::word::Number| {
        its == letter && own.whole() == Some(number)
    };
    word_range(line, 1, is_it).is_some()
}
