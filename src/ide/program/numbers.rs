//! Block numbers: found, renamed.

use super::words::{WordKind, words_of};
use crate::program::{Document, iso};
use crate::text::TextEdit;
use std::ops::Range;

/// The block number at a byte: its bytes, and what it is.
pub(crate) fn number_at(document: &Document, offset: usize) -> Option<(Range<usize>, u32)> {
    let line = document.text().line_of(offset);
    let part = words_of(document, line).into_iter().find(|part| {
        part.kind == WordKind::Number && part.range.start <= offset && offset <= part.range.end
    })?;
    let digits = document.text().digits_in(&part.range)?;
    let text = std::str::from_utf8(document.text().bytes().get(digits.clone())?).ok()?;
    Some((digits, text.parse().ok()?))
}

/// The edits that give the block at a byte another number, `20` or `N20`, and the calls of it.
///
/// Errors: no number there, a name that is no number, or one that another block has.
pub(crate) fn renamed(
    document: &Document,
    offset: usize,
    name: &str,
) -> Result<Vec<TextEdit>, String> {
    let (digits, number) =
        number_at(document, offset).ok_or(say!(there_is_no_block_number_here))?;
    if let Document::Iso(program) = document {
        return iso::renamed(program, digits, number, name);
    }
    let name = name.trim();
    let name = name.strip_prefix(['N', 'n']).unwrap_or(name).trim();
    let is_number =
        !name.is_empty() && name.len() <= 8 && name.bytes().all(|byte| byte.is_ascii_digit());
    let number: u32 = name
        .parse()
        .ok()
        .filter(|_| is_number)
        .ok_or_else(|| say!(is_no_block_number, name))?;
    let line = document.text().line_of(offset);
    let trace = document.trace();
    if let Some(step) = trace
        .steps
        .iter()
        .find(|step| step.number == Some(number) && step.line != line)
    {
        return Err(say!(
            the_number_is_that_of_another_block,
            number,
            step.line + 1
        ));
    }
    Ok(vec![TextEdit::new(digits, name)])
}
