//! Answers to an editor about 3B text alone: its pieces, what they mean, what can follow, its layouts.
//!
//! Answers about the machine's path, in any language, are in [`crate::ide::program`].

mod completion;
mod meaning;
mod signature;

pub(super) use completion::completions;
pub(super) use meaning::meaning;
pub(super) use signature::signature;

use super::words::{LinePart, WordKind};
use crate::program::three_b::Document;
use crate::program::three_b::pieces::{Field, Piece, pieces};

/// The pieces of a line that begins at a byte; damaged lines are cut as far as possible.
pub(super) fn line_parts(document: &Document, line: &[u8], offset: usize) -> Vec<LinePart> {
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
    let part = |piece: Piece| LinePart {
        kind: kind_of(piece.field),
        range: offset + piece.range.start..offset + piece.range.end,
    };
    let pieces = pieces(line, &document.words());
    pieces.into_iter().map(part).collect()
}
