//! Block numbers: found, renamed.

use super::words::WordKind;
use super::words_of;
use crate::program::Document;
use crate::text::TextEdit;
use std::ops::Range;

/// The block number at a byte: its bytes, and its value.
pub(crate) fn number_at(document: &Document, offset: usize) -> Option<(Range<usize>, u32)> {
    let line = document.text().line_of(offset);
    let part = words_of(document, line).into_iter().find(|part| {
        part.kind == WordKind::Number && part.range.start <= offset && offset <= part.range.end
    })?;
    let digits = document.text().digits_in(&part.range)?;
    let text = std::str::from_utf8(document.text().bytes().get(digits.clone())?).ok()?;
    Some((digits, text.parse().ok()?))
}

/// The edits that give the block at a byte another number, `20` or `N20`, and change the calls to it.
///
/// Errors: no number there, a name that is not a number, or a number that another block has.
pub(crate) fn renamed(
    document: &Document,
    offset: usize,
    name: &str,
) -> Result<Vec<TextEdit>, String> {
    let (digits, number) =
        number_at(document, offset).ok_or(say!(there_is_no_block_number_here))?;
    let name = name.trim();
    let letters: &[char] = match document {
        Document::ThreeB(_) => &['N', 'n'],
        Document::Iso(_) => &['N', 'n', 'O', 'o'],
    };
    let name = name.strip_prefix(letters).unwrap_or(name).trim();
    let is_number =
        !name.is_empty() && name.len() <= 8 && name.bytes().all(|byte| byte.is_ascii_digit());
    let new = name.parse().ok().filter(|_| is_number);
    let new = new.ok_or_else(|| say!(is_no_block_number, name))?;
    document.renamed(digits, number, name, new)
}
