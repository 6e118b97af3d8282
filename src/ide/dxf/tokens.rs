//! Each line of the text with its kind, for colouring.

use super::codes::{Value, value_of};
use super::spot::spot;
use crate::dxf::Document;
use crate::dxf::lexer::{Lexer, Tag};
use crate::dxf::lines::Lines;
use crate::dxf::number::{self, Number};
use crate::ide::{Stop, Token, TokenKind};
use crate::text::SourceText;
use std::ops::Range;

/// Calls `take` for each token of the whole text, at most `limit`; `None` when it was stopped.
pub fn tokens(
    text: &SourceText,
    limit: usize,
    stop: Stop<'_>,
    mut take: impl FnMut(Token),
) -> Option<()> {
    let mut count = 0;
    let whole = collect(text, 0, b"", |token| {
        take(token);
        count += 1;
        if count >= limit {
            Next::Enough
        } else if count % 8192 == 0 && stop() {
            Next::Stopped
        } else {
            Next::On
        }
    });
    whole.then_some(())
}

/// The tokens of some lines.
pub fn tokens_in(document: &Document, lines: Range<usize>) -> Vec<Token> {
    let mut found = Vec::new();
    // A text that is not DXF has no spots; it is read from its beginning.
    let (begin, name) = spot(document, lines.start).map_or((0, &b""[..]), |spot| {
        (spot.tag.map_or(spot.in_step, |tag| tag.line), spot.name)
    });
    collect(document.text(), begin, name, |token| {
        if token.line >= lines.end {
            return Next::Enough;
        }
        if token.line >= lines.start {
            found.push(token);
        }
        Next::On
    });
    found
}

enum Next {
    On,
    Enough,
    Stopped,
}

/// Calls `take` for each token from a line on that is in step; `record` is the name of the record that holds it. False
/// when it was stopped.
fn collect(
    text: &SourceText,
    from: usize,
    record: &[u8],
    mut take: impl FnMut(Token) -> Next,
) -> bool {
    let lines = Lines::new(text);
    let mut lexer = Lexer::new(lines, from);
    let mut is_style = record == b"DIMSTYLE";
    // Where a line is missing the lexer takes a value for the next code, whose token has already
    // been handed out by then.
    let mut told = from;
    while let Some(tag) = lexer.next() {
        lexer.findings.clear();
        let code = lines.trimmed_range(tag.line);
        let of_value = lines.trimmed_range(tag.value_line());
        let value = lines.slice(of_value.clone());
        if tag.code == 0 {
            is_style = value == b"DIMSTYLE";
        }
        for (line, range, kind) in [
            (tag.line, code, code_kind(tag)),
            (tag.value_line(), of_value, value_kind(tag, value, is_style)),
        ] {
            if range.is_empty() || line < told {
                continue;
            }
            told = line + 1;
            match take(Token {
                line,
                start: range.start - text.line_start(line),
                length: range.len(),
                kind,
            }) {
                Next::On => {}
                Next::Enough => return true,
                Next::Stopped => return false,
            }
        }
    }
    true
}

fn code_kind(tag: Tag) -> TokenKind {
    if tag.code == 999 {
        TokenKind::Comment
    } else {
        TokenKind::Code
    }
}

fn value_kind(tag: Tag, value: &[u8], is_style: bool) -> TokenKind {
    match tag.code {
        0 => TokenKind::Record,
        999 => TokenKind::Comment,
        5 if is_style => TokenKind::Text,
        8 | 1003 => TokenKind::Layer,
        9 => TokenKind::Variable,
        2 | 100 => TokenKind::Name,
        1 | 3 | 4 | 6 | 7 | 102 | 300..=309 | 410..=419 | 430..=439 | 470..=479 | 1000..=1002 => {
            TokenKind::Text
        }
        // Nearly all codes are points and numbers: they need no look into the table.
        10..=59 => number_or_text(value),
        code => match value_of(code) {
            Value::Handle | Value::OwnHandle => TokenKind::Handle,
            _ => number_or_text(value),
        },
    }
}

fn number_or_text(value: &[u8]) -> TokenKind {
    if number::number(value) == Number::Bad {
        TokenKind::Text
    } else {
        TokenKind::Number
    }
}
