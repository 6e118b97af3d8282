//! The words between the blocks.

#![warn(clippy::indexing_slicing)]

use crate::settings::{ENDS, Effective, PAUSES};

/// The effect of a word between the blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Word {
    /// The machine stops until the wire is threaded.
    Pause,
    End,
}

/// The words between blocks of one controller. The usual ones of other controllers are read as well.
#[derive(Clone, Copy, Debug)]
pub struct Words<'a> {
    pub(crate) pause: &'a str,
    pub(crate) end: &'a str,
}

impl Default for Words<'_> {
    fn default() -> Self {
        Words {
            pause: "D",
            end: "DD",
        }
    }
}

impl Words<'_> {
    pub(super) fn of(settings: &Effective) -> Words<'_> {
        Words {
            pause: settings.pause.trim(),
            end: settings.end.trim(),
        }
    }

    /// The effect of a word; `None` for one unknown in programs. Letter case does not matter.
    pub(super) fn meaning(&self, word: &[u8]) -> Option<Word> {
        let is = |known: &str| !word.is_empty() && word.eq_ignore_ascii_case(known.as_bytes());
        if is(self.end) {
            return Some(Word::End);
        }
        // A setting may have made one of the usual end words the pause.
        if is(self.pause) {
            return Some(Word::Pause);
        }
        if ENDS.into_iter().chain(ISO_ENDS).any(is) {
            return Some(Word::End);
        }
        let mut pauses = PAUSES.into_iter().chain(ISO_PAUSES);
        pauses.any(is).then_some(Word::Pause)
    }

    /// True for the two words that the settings name.
    pub(super) fn is_own(&self, word: &[u8]) -> bool {
        [self.pause, self.end]
            .iter()
            .any(|own| word.eq_ignore_ascii_case(own.as_bytes()))
    }
}

/// Words of ISO that some controllers take between blocks of 3B.
const ISO_ENDS: [&str; 3] = ["M02", "M2", "M30"];
const ISO_PAUSES: [&str; 2] = ["M00", "M0"];

/// The switches of pump and wire, which stand beside blocks and move nothing.
const SWITCHES: [&str; 4] = ["T84", "T85", "T86", "T87"];

/// Whether a text begins with a switch of the machine; its length.
pub(super) fn switch(text: &[u8]) -> Option<usize> {
    let word = word_of(text);
    let is_it = |known: &str| word.eq_ignore_ascii_case(known.as_bytes());
    SWITCHES.into_iter().any(is_it).then_some(word.len())
}

/// The letters and digits that a text begins with.
pub(super) fn word_of(text: &[u8]) -> &[u8] {
    let mut parts = text.splitn(2, |byte| !byte.is_ascii_alphanumeric());
    parts.next().unwrap_or_default()
}
