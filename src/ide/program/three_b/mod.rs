//! Answers to an editor about 3B text alone: its pieces, what they mean, what can follow, its layouts.
//!
//! Answers about the machine's path, in any language, are in [`crate::ide::program`].

mod completion;
mod meaning;
mod signature;

use super::{Completion, Language, LinePart, Signature, WordKind};
use crate::program::three_b::Document;
use crate::program::three_b::pieces::{Field, Piece, pieces};
use std::ops::Range;

impl Language for Document {
    fn completions(&self, offset: usize) -> Vec<Completion> {
        completion::completions(self, offset)
    }

    fn signature(&self, offset: usize) -> Option<Signature> {
        signature::signature(self, offset)
    }

    fn meaning(&self, word: Range<usize>) -> Option<String> {
        meaning::meaning(self, word)
    }

    fn words(&self, line: &[u8], offset: usize) -> Vec<LinePart> {
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
        let pieces = pieces(line, &self.words());
        pieces.into_iter().map(part).collect()
    }
}
