//! An edit of the text: only what it touched is read again.
//!
//! An edit within the vertices of a LWPOLYLINE rereads a few of them; other edits reread the items around them. An edit with effects
//! further away (sections, ordinals as names) rereads everything.

use super::Document;
use super::foreign;
use super::frame;
use super::lexer::LOOKAHEAD;
use super::lines::Lines;
use super::reader::range_key;
use crate::drawing::Delta;
use crate::finding::{Finding, Place, Rule};
use std::ops::Range;

/// Reading begins at least this many lines before an edit: decisions there may have looked at the edited lines.
pub(super) const LOOKBACK: usize = LOOKAHEAD + 4;
/// An edit in the first bytes may change what the text is taken for.
const HEAD: usize = 1024;
/// Each added or removed entity costs the length of the drawing; beyond this many, everything is read again.
pub(super) const FEW: usize = 64;

/// From this many bytes on an edit leaves the text in two pieces. In tests every text is large.
const LARGE: usize = if cfg!(test) { 1 } else { 64 * 1024 };

/// What was known before the edit of everything that it can have touched.
pub(super) struct ItemZone {
    pub(super) first: usize,
    /// The last line, before the edit, that the edit touches.
    pub(super) end_line: usize,
}

impl Document {
    /// Replaces a range of bytes (clamped to the text) and rereads what it touched.
    ///
    /// Ids of entities that the edit did not touch stay, unless the delta says that everything may have changed.
    pub fn edit(&mut self, range: Range<usize>, replacement: &str) -> Delta {
        let end = range.end.min(self.text.len());
        let range = range.start.min(end)..end;
        let reference = self.reference_zone(&range, replacement);
        let run = self.vertex_run(&range);
        let zone = self
            .item_zone(&range)
            .filter(|zone| !self.holds_frame(zone));
        let (old_lines, old_length) = (self.text.line_count(), self.text.len());
        if old_length < LARGE {
            self.text.replace(range.clone(), replacement);
        } else {
            self.text.replace_here(range.clone(), replacement);
        }
        let lines = self.text.line_count() as i64 - old_lines as i64;
        let bytes = self.text.len() as i64 - old_length as i64;
        if range.start >= HEAD || foreign::recognise(self.head()).is_none() {
            if let Some(delta) = run.and_then(|run| self.reread_run(run, lines, bytes)) {
                return delta;
            }
            if let Some(zone) = reference
                && let Some(delta) = self.reread_reference(&zone, &range, bytes)
            {
                return delta;
            }
            if let Some(delta) = zone.and_then(|zone| self.reread_items(&zone, lines, bytes)) {
                return delta;
            }
        }
        self.read_all();
        Delta::all()
    }

    /// The beginning of the text, by which other kinds of file are recognised.
    fn head(&self) -> &[u8] {
        self.text
            .slice(0..HEAD.min(self.text.len()))
            .unwrap_or_default()
    }

    /// True where a fault that begins before the line `end` may have been judged by the line `from`, or lies after it.
    pub(super) fn is_at_fault(&self, from: usize, end: usize) -> bool {
        let near = self.text.line_start(from.saturating_sub(LOOKBACK));
        let end = self.text.line_start(end);
        let begun_before = |at: usize| {
            self.findings
                .partition_point(|finding| range_key(finding).0 < at)
        };
        // Some lines that are no tags and begin long before may reach as far as here.
        let first = begun_before(near).saturating_sub(3);
        self.findings
            .iter()
            .take(begun_before(end))
            .skip(first)
            .any(|finding| {
                matches!(&finding.place, Place::Text { range } if range.end >= near)
                    && finding.rule == Rule::Syntax
            })
    }

    pub(super) fn shift_findings(&mut self, from: usize, bytes: i64) {
        let first = self
            .findings
            .partition_point(|finding| range_key(finding).0 < from);
        for finding in self.findings.iter_mut().skip(first) {
            shift_place(finding, bytes);
        }
    }

    fn item_zone(&self, range: &Range<usize>) -> Option<ItemZone> {
        // The byte-order mark, and a text that was not DXF.
        if range.start < 4 || self.table.items.len() < 3 {
            return None;
        }
        let line = self.text.line_of(range.start).saturating_sub(LOOKBACK);
        Some(ItemZone {
            first: self.table.item_at(line)?,
            end_line: self.text.line_of(range.end),
        })
    }

    /// True where a zone, or its end, holds a text with a frame, which decides about another
    /// entity.
    fn holds_frame(&self, zone: &ItemZone) -> bool {
        let lines = Lines::new(&self.text);
        let last = || self.table.item_at(zone.end_line).map_or(0, |item| item + 1);
        let range = || {
            self.table.lines_of(zone.first, lines.count()).start
                ..self.table.lines_of(last(), lines.count()).end
        };
        !self.table.frames.is_empty() && frame::is_named_in(lines, range())
    }
}

pub(super) fn shift(lines: &mut [u32], from: usize, by: i64) {
    if by != 0 {
        for line in lines.iter_mut().skip(from) {
            *line = line.wrapping_add(by as u32);
        }
    }
}

pub(super) fn shift_place(finding: &mut Finding, bytes: i64) {
    if let Place::Text { range } = &mut finding.place {
        range.start = (range.start as i64 + bytes) as usize;
        range.end = (range.end as i64 + bytes) as usize;
    }
}
