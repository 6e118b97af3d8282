//! The surroundings of a line: its tag, the record that holds it, the section around that. Reads no more than the
//! record.

use crate::dxf::Document;
use crate::dxf::lexer::{Lexer, Tag};
use crate::dxf::lines::Lines;
use crate::dxf::table::Became;
use std::ops::Range;

/// A line of the text among its tags.
pub(super) struct Spot<'a> {
    pub(crate) lines: Lines<'a>,
    pub(crate) line: usize,
    pub(crate) item: usize,
    /// First line of the record; the name stands on the next one. `None` before the first record.
    pub(crate) record: Option<usize>,
    /// Name of the record; empty where there is none.
    pub(crate) name: &'a [u8],
    /// The tag that holds the line, on either of its two lines.
    pub(crate) tag: Option<Tag>,
    /// The tag before that.
    pub(crate) before: Option<Tag>,
    /// First line after the last whole tag that ends before the line.
    pub(crate) in_step: usize,
}

impl Spot<'_> {
    pub(crate) fn at_value(&self) -> bool {
        self.tag.is_some_and(|tag| tag.value_line() == self.line)
    }
}

/// The spot of a line; `None` past the end of the text.
pub(super) fn spot(document: &Document, line: usize) -> Option<Spot<'_>> {
    let lines = Lines::new(document.text());
    let item = document.table().item_at(line)?;
    let of_item = document.table().lines_of(item, lines.count());
    let begins = Lexer::new(lines, of_item.start).peek_record().is_some();
    let mut record = begins.then_some(of_item.start);
    let from = vertex_before(document, item, line).unwrap_or(of_item.start);
    let mut spot = Spot {
        lines,
        line,
        item,
        record,
        name: b"",
        tag: None,
        before: None,
        in_step: from,
    };
    let mut lexer = Lexer::new(lines, from);
    let mut last = None;
    while lexer.at() <= line
        && let Some(tag) = lexer.next()
    {
        lexer.findings.clear();
        if tag.line > line {
            break;
        }
        if tag.code == 0 {
            record = Some(tag.line);
        }
        if tag.value_line() >= line {
            spot.tag = Some(tag);
            break;
        }
        last = Some(tag);
        spot.in_step = tag.line + 2;
    }
    spot.before = last;
    spot.record = record;
    spot.name = record.map_or(b"", |record| lines.trimmed(record + 1));
    Some(spot)
}

/// The line of the vertex that holds `line`: a polyline of 100,000 vertices is one item.
fn vertex_before(document: &Document, item: usize, line: usize) -> Option<usize> {
    vertex_at(document, item, line).map(|vertex| vertex.start)
}

/// The lines of the vertex that holds `line`.
pub(super) fn vertex_at(document: &Document, item: usize, line: usize) -> Option<Range<usize>> {
    let entity = document.table().items.get(item)?.entity()?;
    let start = *document.table().lines.get(item)? as usize;
    let vertices = document.table().vertices.get(&entity)?;
    let index = vertices
        .lines
        .partition_point(|&vertex| start + vertex as usize <= line)
        .checked_sub(1)?;
    document.vertex_lines(entity, index)
}

/// Name of the section that holds an item, and the items of it, both ends included; `None` outside of all.
pub(super) fn section_of(document: &Document, item: usize) -> Option<(String, Range<usize>)> {
    let lines = Lines::new(document.text());
    let name_of = |item: usize| {
        document
            .table()
            .lines
            .get(item)
            .map_or(&b""[..], |&line| lines.trimmed(line as usize + 1))
    };
    let is_edge = |item: &usize| {
        matches!(
            document.table().items.get(*item).map(|item| item.became),
            Some(Became::Structure { .. })
        )
    };
    let first = if is_edge(&item) && name_of(item) == b"ENDSEC" {
        item.checked_sub(1)?
    } else {
        item
    };
    let start = (0..=first)
        .rev()
        .find(is_edge)
        .filter(|&start| name_of(start) == b"SECTION")?;
    let end = (start + 1..document.table().items.len())
        .find(is_edge)
        .unwrap_or(document.table().items.len());
    let last = if name_of(end) == b"ENDSEC" {
        end
    } else {
        end.saturating_sub(1)
    };
    let line = *document.table().lines.get(start)? as usize;
    // The name is the first tag of code 2; it follows the beginning, except for comments.
    let name = (line + 2..line + 12)
        .step_by(2)
        .find(|&at| lines.trimmed(at) == b"2")
        .map(|at| text_of(lines.trimmed(at + 1)));
    Some((name.unwrap_or_default(), start..last + 1))
}

pub(super) fn text_of(bytes: &[u8]) -> String {
    const SHOWN: usize = 200;
    String::from_utf8_lossy(&bytes[..bytes.len().min(SHOWN)]).into_owned()
}
