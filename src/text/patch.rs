//! Combines successive edits into one edit of the original text.

use super::TextEdit;
use std::ops::Range;

/// A text as the remains of an older one, and the insertions between them.
#[derive(Clone, Debug)]
pub(crate) struct Patch {
    /// In the order of the text. The remains of the old text come in their old order.
    pieces: Vec<Piece>,
    old_length: usize,
}

#[derive(Clone, Debug)]
enum Piece {
    Old(Range<usize>),
    New(String),
}

impl Piece {
    fn length(&self) -> usize {
        match self {
            Piece::Old(range) => range.len(),
            Piece::New(text) => text.len(),
        }
    }

    /// A part of the piece, by its bytes; `None` where it would cut a character in two.
    fn part(&self, range: Range<usize>) -> Option<Piece> {
        match self {
            Piece::Old(own) => Some(Piece::Old(own.start + range.start..own.start + range.end)),
            Piece::New(text) => Some(Piece::New(text.get(range)?.to_owned())),
        }
    }
}

impl Patch {
    /// A text of this length, unchanged.
    pub(crate) fn of(old_length: usize) -> Patch {
        Patch {
            pieces: vec![Piece::Old(0..old_length)],
            old_length,
        }
    }

    /// Adds edits of the text as it is after all edits so far; they are sorted and disjoint. `None` when they are not,
    /// or reach past the end.
    pub(crate) fn then(&self, edits: &[TextEdit]) -> Option<Patch> {
        let mut pieces = Vec::with_capacity(self.pieces.len() + 2 * edits.len());
        let mut rest = self.pieces.iter();
        let mut present = rest.next();
        let (mut begins, mut at) = (0, 0);
        // Takes, or skips, everything up to `to`.
        let mut advance = |to: usize, pieces: Option<&mut Vec<Piece>>| {
            let mut taken = Vec::new();
            while at < to {
                let piece = present?;
                let end = begins + piece.length();
                let until = end.min(to);
                taken.push(piece.part(at - begins..until - begins)?);
                at = until;
                if until == end {
                    (begins, present) = (end, rest.next());
                }
            }
            if let Some(pieces) = pieces {
                pieces.append(&mut taken);
            }
            Some(())
        };
        let mut last = 0;
        for edit in edits {
            if edit.range.start < last || edit.range.end < edit.range.start {
                return None;
            }
            advance(edit.range.start, Some(&mut pieces))?;
            advance(edit.range.end, None)?;
            pieces.push(Piece::New(edit.text.clone()));
            last = edit.range.end;
        }
        let length = self.pieces.iter().map(Piece::length).sum();
        advance(length, Some(&mut pieces))?;
        Some(Patch {
            pieces,
            old_length: self.old_length,
        })
    }

    /// The edits of the old text that make the new one, sorted and disjoint.
    pub(crate) fn edits(&self) -> Vec<TextEdit> {
        let mut edits = Vec::new();
        let (mut from, mut text) = (0, String::new());
        let mut close = |from: usize, to: usize, text: &mut String| {
            if from < to || !text.is_empty() {
                edits.push(TextEdit {
                    range: from..to,
                    text: std::mem::take(text),
                });
            }
        };
        for piece in &self.pieces {
            match piece {
                Piece::New(new) => text.push_str(new),
                Piece::Old(range) if range.is_empty() => {}
                Piece::Old(range) => {
                    close(from, range.start, &mut text);
                    from = range.end;
                }
            }
        }
        close(from, self.old_length, &mut text);
        edits
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::edited;

    fn edit(range: Range<usize>, text: &str) -> TextEdit {
        TextEdit {
            range,
            text: text.into(),
        }
    }

    #[test]
    fn edits_one_after_another_are_one() {
        let old = b"0123456789";
        for (rounds, expected) in [
            (
                vec![vec![edit(2..4, "ab")], vec![edit(3..3, "-")]],
                "01a-b456789",
            ),
            (
                vec![
                    vec![edit(2..2, "abc"), edit(5..7, "")],
                    vec![edit(3..9, "X")],
                ],
                "01aX89",
            ),
            (vec![vec![edit(0..10, "")], vec![edit(0..0, "new")]], "new"),
            (
                vec![
                    vec![edit(9..10, "x")],
                    vec![edit(0..1, ""), edit(9..10, "")],
                ],
                "12345678",
            ),
            (
                vec![
                    vec![edit(1..1, "a"), edit(1..1, "b")],
                    vec![edit(2..2, "-")],
                    vec![edit(0..1, "")],
                ],
                "a-b123456789",
            ),
            (vec![vec![]], "0123456789"),
        ] {
            let mut patch = Patch::of(old.len());
            let mut text = old.to_vec();
            for round in &rounds {
                patch = patch.then(round).unwrap();
                text = edited(&text, round).unwrap();
            }
            assert_eq!(String::from_utf8(text).unwrap(), expected);
            assert_eq!(
                edited(old, &patch.edits()).as_deref(),
                Some(expected.as_bytes()),
                "{:?}",
                patch.edits()
            );
        }
    }

    #[test]
    fn edits_change_their_bytes_and_no_others() {
        let edits = [edit(1..2, "xyz"), edit(3..3, "-"), edit(4..5, "")];
        assert_eq!(
            edited(b"ab\xffde", &edits).as_deref(),
            Some(&b"axyz\xff-d"[..])
        );
    }

    #[test]
    fn edits_that_cannot_be_made_are_refused() {
        for edits in [vec![edit(0..9, "")], vec![edit(2..3, ""), edit(1..2, "")]] {
            assert_eq!(edited(b"abc", &edits), None);
            assert!(Patch::of(3).then(&edits).is_none(), "{edits:?}");
        }
    }
}
