//! Answers to an editor about ISO text alone: what its words mean, what can follow, which words belong together.
//!
//! Answers about the machine's path, in any language, are in [`crate::ide::program`].

mod centres;
mod completion;
mod matching;
mod meaning;
mod names;
mod signature;
#[cfg(test)]
mod tests;
mod vocabulary;

pub(super) use completion::completions;
pub(super) use matching::partner;
pub(super) use meaning::meaning;
pub(super) use names::named;
pub(super) use signature::signature;

use super::words::{LinePart, WordKind};
use crate::program::iso::plain::word_in;
use crate::program::iso::{Document, Token, words};
use std::ops::Range;

/// The pieces of a line that begins at a byte; damaged lines are cut as far as possible.
pub(super) fn line_parts(document: &Document, line: &[u8], offset: usize) -> Vec<LinePart> {
    let mut parts = Vec::new();
    if document.text().line_of(offset) < document.leader() {
        let range = offset..offset + line.len();
        let kind = WordKind::Comment;
        return Vec::from_iter((!line.is_empty()).then_some(LinePart { kind, range }));
    }
    words(line, 0, |token, range| {
        // A part of a word that is read nevertheless.
        if let Token::Fault(_) = token
            && parts
                .last()
                .is_some_and(|last: &LinePart| offset + range.start < last.range.end)
        {
            return;
        }
        let kind = match token {
            Token::Word { letter, .. } => match letter {
                b'N' | b'O' => WordKind::Number,
                b'G' => WordKind::Motion,
                b'M' | b'T' => WordKind::Stop,
                b'X' | b'Y' | b'I' | b'J' | b'R' | b'U' | b'V' => WordKind::Length,
                _ => WordKind::Setting,
            },
            Token::Corner { .. } => WordKind::Length,
            Token::Definition { .. } | Token::Sum { .. } | Token::Foreign => WordKind::Setting,
            Token::Comment => WordKind::Comment,
            Token::Tape | Token::Skip => WordKind::Lead,
            Token::Fault(_) => WordKind::Strange,
        };
        if !range.is_empty() {
            parts.push(LinePart {
                kind,
                range: offset + range.start..offset + range.end,
            });
        }
    });
    parts
}

/// Of things in some ranges, in their order, that at a byte; between two that touch, the second one.
fn at_byte<T>(all: Vec<(T, Range<usize>)>, offset: usize) -> Option<(T, Range<usize>)> {
    let touches = |range: &Range<usize>| range.start <= offset && offset <= range.end;
    let mut touching = all.into_iter().filter(|(_, range)| touches(range));
    let first = touching.next()?;
    Some(
        touching
            .find(|(_, range)| offset < range.end)
            .unwrap_or(first),
    )
}

/// True where a line has the word.
fn holds(line: &[u8], letter: u8, number: i64) -> bool {
    let is_it = |its: u8, own: crate::program::iso::word::Number| {
        its == letter && own.whole() == Some(number)
    };
    word_in(line, is_it).is_some()
}
