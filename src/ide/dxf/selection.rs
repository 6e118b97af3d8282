//! The steps of a growing selection: the value, its tag, the vertex, the record, the entity, the section, everything.

use super::spot::{section_of, spot, vertex_at};
use crate::dxf::Document;
use crate::dxf::lexer::Lexer;
use crate::ide::widen;
use std::ops::Range;

/// Ranges of bytes around a byte, each within the next.
pub(crate) fn selections(document: &Document, offset: usize) -> Vec<Range<usize>> {
    let all = 0..document.text().len();
    let mut found: Vec<Range<usize>> = Vec::new();
    let Some(spot) = spot(document, document.text().line_of(offset)) else {
        return vec![all];
    };
    let lines = spot.lines;
    let bytes_of = |range: Range<usize>| {
        lines.range(range.start).start..lines.range(range.end.saturating_sub(1)).end
    };
    let mut wider = |range| widen(&mut found, offset, range);
    wider(lines.trimmed_range(spot.line));
    if let Some(tag) = spot.tag {
        wider(bytes_of(tag.line..tag.line + 2));
    }
    if let Some(vertex) = vertex_at(document, spot.item, spot.line) {
        wider(bytes_of(vertex));
    }
    let of_item = document.table().lines_of(spot.item, lines.count());
    if let Some(record) = spot.record.filter(|&record| record > of_item.start) {
        let end = end_of_record(document, record, of_item.end);
        wider(bytes_of(record..end));
    }
    wider(bytes_of(of_item));
    if let Some((_, items)) = section_of(document, spot.item) {
        let start = document.table().lines_of(items.start, lines.count()).start;
        wider(bytes_of(
            start
                ..document
                    .table()
                    .lines_of(items.end.saturating_sub(1), lines.count())
                    .end,
        ));
    }
    wider(all.clone());
    if found.is_empty() {
        found.push(all);
    }
    found
}

/// One past the last line of the record that begins at `record`.
fn end_of_record(document: &Document, record: usize, limit: usize) -> usize {
    let lines = crate::dxf::lines::Lines::new(document.text());
    let mut lexer = Lexer::new(lines, record);
    lexer.next();
    while lexer.at() < limit {
        let at = lexer.at();
        if lexer.peek_record().is_some() {
            return at;
        }
        if lexer.next().is_none() {
            break;
        }
        lexer.findings.clear();
    }
    limit
}
