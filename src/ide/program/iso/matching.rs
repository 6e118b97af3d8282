//! Words that belong together: where the correction begins and ends, a call and what it calls, both
//! ends of a tape.

use super::at_byte;
use crate::program::iso::block::{Block, Compensation, read_line};
use crate::program::iso::document::Document;
use crate::program::iso::plain::{word_at, words};
use crate::program::iso::word::Token;
use std::ops::Range;

/// The word at a byte and its counterpart; `None` where there is none.
///
/// For G41 and G42, the G40 that ends it; for G40, the word that it ends; for a call, the line that it calls; for M99,
/// the start of its subprogram; for `%`, the other one.
pub(in crate::ide::program) fn partner(
    document: &Document,
    offset: usize,
) -> Option<(Range<usize>, Range<usize>)> {
    let text = document.text();
    let line = text.line_of(offset);
    let (bytes, start) = (text.line(line), text.line_start(line));
    let mut tokens = Vec::new();
    words(bytes, start, |token, range| {
        if matches!(token, Token::Word { .. } | Token::Tape) {
            tokens.push((token, range));
        }
    });
    let (token, range) = at_byte(tokens, offset)?;
    match token {
        Token::Word {
            letter: b'G',
            number,
        } => match number.whole()? {
            40 => Some((
                range,
                switched(document, (0..line).rev(), |side| side != Compensation::Off)?,
            )),
            41 | 42 => Some((
                range,
                switched(document, line + 1..text.line_count(), |side| {
                    side == Compensation::Off
                })?,
            )),
            _ => None,
        },
        Token::Word {
            letter: b'M' | b'P',
            ..
        } => {
            let block = read_line(bytes, start, |_| {});
            if let Some(number) = block.call {
                let line = document.called_line(number)?;
                return Some((range, label_in(document, line, number)?));
            }
            if !block.returns {
                return None;
            }
            (0..=line).rev().find_map(|line| {
                let bytes = text.bytes().get(text.line_range(line))?;
                let block = read_line(bytes, 1, |_| {});
                let called = [block.number, block.program]
                    .into_iter()
                    .flatten()
                    .find(|number| document.calls(*number))?;
                Some((range.clone(), label_in(document, line, called)?))
            })
        }
        Token::Tape => {
            let other = (line..text.line_count())
                .chain(0..line)
                .find_map(|line| tape_in(document, line, &range))?;
            Some((range, other))
        }
        _ => None,
    }
}

/// The first word of some lines that switches the correction as wanted.
fn switched(
    document: &Document,
    lines: impl Iterator<Item = usize>,
    wanted: impl Fn(Compensation) -> bool,
) -> Option<Range<usize>> {
    let text = document.text();
    for line in lines {
        let block = Block::of(text.line(line));
        if block.compensation.is_some_and(&wanted) {
            return word_at(text, line, |letter, number| {
                letter == b'G' && matches!(number.whole(), Some(40..=42))
            });
        }
    }
    None
}

/// The N or O word of a line.
fn label_in(document: &Document, line: usize, wanted: u32) -> Option<Range<usize>> {
    word_at(document.text(), line, |letter, number| {
        matches!(letter, b'N' | b'O') && number.index() == Some(wanted)
    })
}

fn tape_in(document: &Document, line: usize, besides: &Range<usize>) -> Option<Range<usize>> {
    let range = document.text().line_range(line);
    let bytes = document.text().bytes().get(range.clone())?;
    let mut found = None;
    if bytes.contains(&b'%') {
        words(bytes, range.start, |token, range| {
            if token == Token::Tape && range != *besides {
                found.get_or_insert(range);
            }
        });
    }
    found
}
