//! The new text of a block.

use super::{New, ThreeB};
use crate::program::grid::Node;
use crate::program::refactor::{Content, Edits, Rewrite, Sheet};
use crate::program::three_b::layout::{
    push_end_point, push_fields, push_start_point, push_to_comment_column,
};
use crate::text::{SourceText, TextEdit};
use std::ops::Range;

/// The edits of a rewritten program, sorted and disjoint, without those that change nothing.
pub(super) fn edits(
    sheet: &Sheet<'_, ThreeB>,
    content: &Content<ThreeB>,
    rewrite: &Rewrite<ThreeB>,
) -> Edits {
    let text = sheet.document.text();
    let mut edits = Vec::new();
    if let (Some(start), Some(header)) = (rewrite.start, sheet.document.header()) {
        edits.push(new_header(text, &header, start)?);
    }
    for (&row, news) in &rewrite.rows {
        edits.push(slot(text, content, row, news)?);
    }
    Ok(text.changing(edits))
}

pub(super) fn new_header(
    text: &SourceText,
    header: &Range<usize>,
    start: Node,
) -> Result<TextEdit, String> {
    let mut line = Vec::new();
    push_start_point(&mut line, start);
    let line = String::from_utf8(line).map_err(|error| error.to_string())?;
    // Only the header itself: any text before it in its line stays.
    let old = text.bytes().get(header.clone()).unwrap_or_default();
    let line = line.trim_end();
    let new = if old.starts_with(b";") {
        line
    } else {
        line.trim_start_matches("; ")
    };
    Ok(TextEdit::new(header.clone(), new))
}

/// The replacement of one row: its number stays, its comment goes with its block.
fn slot(
    text: &SourceText,
    content: &Content<ThreeB>,
    index: usize,
    news: &[New],
) -> Result<TextEdit, String> {
    let (line, row) = (content.rows[index].line, &content.rows[index].own);
    let Some(first) = news.first() else {
        // The whole line goes, its line end with it.
        return Ok(TextEdit::new(text.whole_line(line), ""));
    };
    let comment_moves = first.source != index;
    let mut end = row
        .coordinates
        .as_ref()
        .map_or(row.range.end, |coordinates| coordinates.end);
    if let (true, Some(comment)) = (comment_moves, &row.comment) {
        end = comment.end;
    }
    let mut out = Vec::new();
    for (position, new) in news.iter().enumerate() {
        if position > 0 {
            out.extend_from_slice(text.line_end(line).as_bytes());
        }
        let block = &new.encoded.block;
        push_fields(&mut out, row.layout, block, new.part.as_ref());
        if row.coordinates.is_some() {
            push_to_comment_column(&mut out, block);
            push_end_point(&mut out, new.encoded.to);
        }
        let carried = content
            .rows
            .get(new.source)
            .and_then(|source| source.own.comment.clone());
        if let (true, true, Some(comment)) = (position == 0, comment_moves, carried) {
            out.push(b' ');
            out.extend_from_slice(text.bytes().get(comment).unwrap_or_default());
        }
    }
    if !comment_moves && news.len() > 1 && row.comment.is_some() {
        return Err(say!(
            a_comment_stands_behind_a_block_that_becomes_several,
            line + 1
        ));
    }
    let text =
        String::from_utf8(out).map_err(|_| say!(the_comment_is_in_another_code_page, line + 1))?;
    Ok(TextEdit::new(row.range.start..end, text))
}
