//! The words of a program, for colouring.

use super::words::{LinePart, WordKind};
use super::words_of;
use crate::ide::occurrence::{Stop, Stopped};
use crate::ide::{Token, TokenKind};
use crate::program::Document;
use rayon::prelude::*;
use std::ops::Range;

/// Lines that are read in one go.
const CHUNK: usize = 4_096;

/// The token kinds of DXF, for the words of programs.
fn kind_of(kind: WordKind) -> Option<TokenKind> {
    Some(match kind {
        WordKind::Number => TokenKind::Handle,
        WordKind::Lead => TokenKind::Name,
        WordKind::Length => TokenKind::Number,
        WordKind::Setting => TokenKind::Code,
        WordKind::Motion => TokenKind::Record,
        WordKind::Stop => TokenKind::Variable,
        WordKind::Stated => TokenKind::Text,
        WordKind::Comment => TokenKind::Comment,
        WordKind::Strange => return None,
    })
}

/// The tokens of some lines.
pub(crate) fn tokens_in(document: &Document, lines: Range<usize>) -> Vec<Token> {
    let text = document.text();
    let mut found = Vec::new();
    for line in lines.start..lines.end.min(text.line_count()) {
        let begin = text.line_start(line);
        let token = |part: LinePart| {
            Some(Token {
                line,
                start: part.range.start - begin,
                length: part.range.len(),
                kind: kind_of(part.kind)?,
            })
        };
        found.extend(words_of(document, line).into_iter().filter_map(token));
    }
    found
}

/// Calls `take` for each token of the whole text, at most `limit`; each line is read by itself.
pub(crate) fn tokens(
    document: &Document,
    limit: usize,
    stop: Stop<'_>,
    take: impl FnMut(Token),
) -> Result<(), Stopped> {
    let firsts: Vec<usize> = (0..document.text().line_count()).step_by(CHUNK).collect();
    let (mut left, mut take) = (limit, take);
    // As many chunks at once as may be needed.
    for some in firsts.chunks(16) {
        let tokens = |&first: &usize| tokens_in(document, first..first + CHUNK);
        let chunks: Vec<Vec<Token>> = match some {
            [one] => vec![tokens(one)],
            some => some.par_iter().map(tokens).collect(),
        };
        for token in chunks.into_iter().flatten().take(left) {
            take(token);
            left -= 1;
        }
        if left == 0 {
            break;
        }
        if stop() {
            return Err(Stopped);
        }
    }
    Ok(())
}
