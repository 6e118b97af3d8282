//! The pieces of a line in every language's own terms, brought to one list of kinds.

use crate::program::iso::{Token, words as iso_words};
use crate::program::three_b::pieces::{Field, pieces};
use crate::program::{Document, three_b};
use std::ops::Range;

/// What a piece of a line is, whatever the language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WordKind {
    /// `N12`.
    Number,
    /// What leads a number: `B` of 3B.
    Lead,
    /// A length or coordinate: X, Y, J of 3B; `X1.5` of ISO.
    Length,
    /// The counting axis of 3B; values for the control's table and words of settings in ISO.
    Setting,
    /// What kind of motion: Z of 3B, G words of ISO.
    Motion,
    /// Pauses, ends and the like.
    Stop,
    /// Coordinates that only say where a block ends or a program begins.
    Stated,
    Comment,
    Strange,
}

/// A piece of a line; bytes of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    pub(crate) kind: WordKind,
    pub(crate) range: Range<usize>,
}

/// The pieces of a line, one behind the other; damaged lines are cut as far as that goes.
pub(crate) fn words_of(document: &Document, line: usize) -> Vec<Part> {
    let text = document.text();
    let range = text.line_range(line);
    let bytes = text.bytes().get(range.clone()).unwrap_or_default();
    match document {
        Document::ThreeB(program) => of_three_b(program, bytes, range.start),
        Document::Iso(_) => of_iso(bytes, range.start),
    }
}

fn of_three_b(program: &three_b::Document, line: &[u8], offset: usize) -> Vec<Part> {
    let kind_of = |field: Field| match field {
        Field::Number => WordKind::Number,
        Field::Separator => WordKind::Lead,
        Field::X | Field::Y | Field::J | Field::Radius => WordKind::Length,
        Field::Axis | Field::Convexity => WordKind::Setting,
        Field::Motion => WordKind::Motion,
        Field::Pause | Field::End => WordKind::Stop,
        Field::Coordinates | Field::StartPoint => WordKind::Stated,
        Field::Comment => WordKind::Comment,
        Field::Strange => WordKind::Strange,
    };
    let part = |piece: crate::program::three_b::pieces::Piece| Part {
        kind: kind_of(piece.field),
        range: offset + piece.range.start..offset + piece.range.end,
    };
    pieces(line, &program.words())
        .into_iter()
        .map(part)
        .collect()
}

fn of_iso(line: &[u8], offset: usize) -> Vec<Part> {
    let mut parts = Vec::new();
    iso_words(line, 0, |token| {
        // Part of a word that is read all the same.
        if let Token::Fault { range, .. } = &token
            && parts
                .last()
                .is_some_and(|last: &Part| offset + range.start < last.range.end)
        {
            return;
        }
        let (kind, range) = match token {
            Token::Word { letter, range, .. } => (
                match letter {
                    b'N' | b'O' => WordKind::Number,
                    b'G' => WordKind::Motion,
                    b'M' | b'T' => WordKind::Stop,
                    b'X' | b'Y' | b'I' | b'J' | b'R' | b'U' | b'V' => WordKind::Length,
                    _ => WordKind::Setting,
                },
                range,
            ),
            Token::Corner { range, .. } => (WordKind::Length, range),
            Token::Definition { range, .. }
            | Token::Sum { range, .. }
            | Token::Foreign { range } => (WordKind::Setting, range),
            Token::Comment { range } => (WordKind::Comment, range),
            Token::Tape { range } | Token::Skip { range } => (WordKind::Lead, range),
            Token::Fault { range, .. } => (WordKind::Strange, range),
        };
        if !range.is_empty() {
            parts.push(Part {
                kind,
                range: offset + range.start..offset + range.end,
            });
        }
    });
    parts
}
