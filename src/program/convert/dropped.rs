//! What a new program does not take over of an old one beside its moves, in sentences.

use crate::program::document::Document;
use crate::program::iso;
pub(crate) use crate::program::iso::Dropped;
use crate::program::iso::{Unfollowed, UnfollowedWord};

/// Words that are named one by one.
const NAMED: usize = 8;

impl Dropped {
    /// Of a program that is written anew.
    pub(crate) fn of(document: &Document) -> Dropped {
        match document {
            Document::Iso(program) => {
                let tilts = iso::refuse_taper(program, iso::TaperWords::All).is_err();
                iso::dropped(program, !tilts)
            }
            Document::ThreeB(program) => {
                let (words, comments) = program.beside_blocks();
                Dropped {
                    words,
                    comments,
                    ..Dropped::default()
                }
            }
        }
    }

    /// Why the way of the wire would not be that of the program: in lower case without a full stop.
    pub(crate) fn refusal(&self) -> Option<String> {
        let UnfollowedWord { line, word, what } = self.unfollowed.first()?;
        let reason = match what {
            Unfollowed::Way => say!(a_word_moves_the_wire_unfollowed, word),
            Unfollowed::Frame => say!(a_word_moves_what_follows, word),
            Unfollowed::Zero => say!(a_word_counts_from_another_zero, word),
            Unfollowed::Missing => say!(a_word_calls_what_is_missing, word),
            Unfollowed::Call => say!(a_word_calls_what_is_not_followed, word),
            Unfollowed::Repeat => say!(a_word_repeats_unfollowed, word),
            Unfollowed::Jump => say!(a_word_goes_on_in_another_block, word),
            Unfollowed::Correction => say!(a_word_says_an_unknown_correction, word),
            Unfollowed::Unknown => say!(a_word_may_move_the_wire, word),
        };
        Some(say!(line_by_number, line + 1, reason))
    }

    /// What the way of the wire lacks in whatever is made of the program, in a sentence.
    pub(crate) fn way(&self) -> Option<String> {
        let word = |own: &UnfollowedWord| say!(a_word_in_its_line, own.word, own.line + 1);
        let (named, more) = named(&self.unfollowed, word);
        (!self.unfollowed.is_empty()).then(|| say!(written_as_if_words_were_not_there, named, more))
    }

    pub(crate) fn sentences(&self) -> Vec<String> {
        let mut sentences = Vec::new();
        if !self.words.is_empty() {
            let word = |(line, word): &(usize, String)| say!(a_word_in_its_line, word, line + 1);
            let (named, more) = named(&self.words, word);
            sentences.push(say!(not_written_words_of_the_machine, named, more));
        }
        if !self.optional.is_empty() {
            let (lines, more) = named(&self.optional, |line| (line + 1).to_string());
            sentences.push(say!(not_written_that_a_block_may_be_skipped, lines, more));
        }
        if self.comments {
            sentences.push(say!(not_written_the_comments).to_owned());
        }
        sentences
    }
}

/// The first of some in a row, and what stands for the others.
fn named<T>(all: &[T], one: impl Fn(&T) -> String) -> (String, &'static str) {
    let first: Vec<String> = all.iter().take(NAMED).map(one).collect();
    let more = if all.len() > NAMED { ", …" } else { "" };
    (first.join(", "), more)
}
