//! The changes of a text in one message.
//!
//! A refactoring of a whole program arrives as one change for each line of it. To read the contour again after each of
//! them costs the square of their number, so many changes are first made in a copy of the text, and those beside each
//! other then come to the document as one.

use super::content::Content;
use super::convert;
use crate::text::{Encoding, SourceText};
use ls_types::TextDocumentContentChangeEvent;
use std::ops::Range;

/// Up to this many changes are made one by one: a copy of the text costs more.
const FEW: usize = 32;

/// The largest distance of two changes that are made as one, bytes: to read these again costs less than another change.
const BESIDE: usize = 16 * 1024;

/// Makes the changes of one message in a text.
pub(super) fn make(
    content: &mut Content,
    changes: Vec<TextDocumentContentChangeEvent>,
    encoding: Encoding,
) {
    match content.source_text() {
        Some(text) if changes.len() > FEW => {
            let copy = text.clone();
            gathered(copy, changes, encoding, |range, replacement| {
                content.edit_text(range, replacement)
            });
        }
        _ => {
            for change in changes {
                let range = match content.source_text() {
                    Some(text) => changed(text, &change, encoding),
                    None => 0..0,
                };
                content.edit_text(range, &change.text);
            }
        }
    }
}

/// The bytes that a change replaces: all where it names none.
fn changed(
    text: &SourceText,
    change: &TextDocumentContentChangeEvent,
    encoding: Encoding,
) -> Range<usize> {
    let range = change.range;
    range.map_or(0..text.len(), |range| {
        convert::bytes_of(text, range, encoding)
    })
}

/// Changes that lie beside each other, as one.
struct Gathered {
    /// The bytes that they replace, before the first of them.
    before: Range<usize>,
    /// The bytes that stand there now.
    now: Range<usize>,
}

impl Gathered {
    fn new(range: Range<usize>) -> Gathered {
        Gathered {
            before: range.clone(),
            now: range,
        }
    }

    fn is_beside(&self, range: &Range<usize>) -> bool {
        range.start <= self.now.end + BESIDE && self.now.start <= range.end + BESIDE
    }

    /// Takes in the bytes that the next change replaces, and those between.
    fn take_in(&mut self, range: &Range<usize>) {
        let earlier = self.now.start.saturating_sub(range.start);
        let later = range.end.saturating_sub(self.now.end);
        self.before = self.before.start - earlier..self.before.end + later;
        self.now = self.now.start - earlier..self.now.end + later;
    }
}

/// Makes changes one after the other in a copy of a text, and hands out the edits that do the same to the text, one
/// after the other.
fn gathered(
    mut copy: SourceText,
    changes: Vec<TextDocumentContentChangeEvent>,
    encoding: Encoding,
    mut edit: impl FnMut(Range<usize>, &str),
) {
    let mut make = |gathered: Gathered, copy: &SourceText| {
        let replacement = copy.slice(gathered.now).unwrap_or_default();
        edit(gathered.before, &String::from_utf8_lossy(replacement));
    };
    let mut gathered: Option<Gathered> = None;
    for change in changes {
        let range = changed(&copy, &change, encoding);
        let apart = gathered.take_if(|gathered| !gathered.is_beside(&range));
        if let Some(apart) = apart {
            make(apart, &copy);
        }
        let gathered = gathered.get_or_insert_with(|| Gathered::new(range.clone()));
        gathered.take_in(&range);
        gathered.now.end = gathered.now.end - range.len() + change.text.len();
        copy.replace_here(range, &change.text);
    }
    if let Some(gathered) = gathered {
        make(gathered, &copy);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ls_types::Position;
    use proptest::prelude::*;

    fn at(line: u32, character: u32) -> Position {
        Position { line, character }
    }

    #[allow(deprecated, reason = "the event has the field")]
    fn change(range: Option<ls_types::Range>, text: &str) -> TextDocumentContentChangeEvent {
        TextDocumentContentChangeEvent {
            range,
            range_length: None,
            text: text.into(),
        }
    }

    #[test]
    fn a_change_of_every_line_is_one_edit() {
        let text = SourceText::new(b"a1\n".repeat(5_000));
        let line = |line| ls_types::Range::new(at(line, 1), at(line, 2));
        let changes = (0..5_000).rev().map(|one| change(Some(line(one)), "22"));
        let mut edits = Vec::new();
        gathered(text, changes.collect(), Encoding::Utf16, |range, text| {
            edits.push((range, text.to_owned()));
        });
        let [(range, replacement)] = &edits[..] else {
            panic!("{} edits", edits.len());
        };
        assert_eq!(*range, 1..14_999);
        assert_eq!(replacement.len(), 19_999 - 1);
    }

    proptest! {
        /// Between far and near places, in any order, over each other, with a change of the whole text among them.
        #[test]
        fn gathered_changes_do_what_they_do_one_by_one(
            changes in prop::collection::vec(
                (any::<bool>(), 0_u32..40, 0_u32..9, 0_u32..3, 0_u32..9, "[aé\n]{0,4}", 0_u8..30), 0..40),
        ) {
            let line = "é".repeat(2_000) + "\n";
            let mut expected = SourceText::new(line.repeat(20).into_bytes());
            let mut own = expected.clone();
            let events: Vec<TextDocumentContentChangeEvent> = changes
                .into_iter()
                .map(|(is_long, line, from, lines, to, text, whole)| {
                    let from = if is_long { from * 200 } else { from };
                    let end = if lines == 0 { at(line, from + to) } else { at(line + lines, to) };
                    let range = ls_types::Range::new(at(line, from), end);
                    change((whole > 0).then_some(range), &text)
                })
                .collect();
            for event in &events {
                let range = changed(&expected, event, Encoding::Utf16);
                expected.replace(range, &event.text);
            }
            let copy = own.clone();
            gathered(copy, events, Encoding::Utf16, |range, text| own.replace(range, text));
            prop_assert_eq!(own.bytes(), expected.bytes());
        }
    }
}
