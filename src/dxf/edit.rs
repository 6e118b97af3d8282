//! An edit of the text: only what it touched is read again.
//!
//! An edit within the vertices of a polyline rereads a few of them, and one of a number of a VERTEX
//! that VERTEX alone; other edits reread the items around them. An edit with effects further away (sections, ordinals as names) rereads everything.

use super::Document;
use super::entities::mirror;
use super::foreign;
use super::frame;
use super::lexer::LOOKAHEAD;
use super::lines::Lines;
use super::number::{self, Code, Number};
use super::reader::range_key;
use super::table::Became;
use crate::drawing::{Delta, EntityId, Vertex};
use crate::finding::{Finding, Place, Rule};
use std::ops::Range;
use std::sync::Arc;

/// Reading begins at least this many lines before an edit: decisions there may have looked at the edited lines.
pub(super) const LOOKBACK: usize = LOOKAHEAD + 4;
/// An edit in the first bytes may change what the text is taken for.
const HEAD: usize = 1024;
/// Each added or removed entity costs the length of the drawing; beyond this many, everything is read again.
pub(super) const FEW: usize = 64;

/// From this many bytes on an edit leaves the text in two pieces. In tests every text is large.
const LARGE: usize = if cfg!(test) { 1 } else { 64 * 1024 };

/// The VERTEX record that holds an edit: its lines before the edit, and what must stay as it is.
struct VertexZone {
    entity: EntityId,
    item: usize,
    index: usize,
    lines: Range<usize>,
    others: Others,
}

/// The tags of a VERTEX that are not its geometry but decide what it is: z and flags.
type Others = [Option<f64>; 2];

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
        let vertex = self.vertex_zone(&range);
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
            if let Some(zone) = vertex
                && let Some(delta) = self.reread_vertex(&zone, &range, lines, bytes)
            {
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

    /// The vertex that holds the edit, if its first and last byte stay. The last vertex of a POLYLINE does not count:
    /// SEQEND follows in the same lines.
    fn vertex_zone(&self, range: &Range<usize>) -> Option<VertexZone> {
        let line = self.text.line_of(range.start);
        let item = self.table.item_at(line)?;
        let Became::Entity(entity) = self.table.items.get(item)?.became else {
            return None;
        };
        let vertices = self.table.vertices.get(&entity)?;
        let lines = Lines::new(&self.text);
        let start = self.table.lines_of(item, lines.count()).start;
        let relative = line.checked_sub(start)?;
        let index = vertices
            .lines
            .partition_point(|&vertex| vertex as usize <= relative)
            .checked_sub(1)?;
        let zone = self.vertex_lines(entity, index)?;
        let inside = range.start > self.text.line_start(zone.start)
            && range.end < self.text.line_start(zone.end)
            && zone.end < lines.count();
        if !inside || self.is_at_fault(zone.start, zone.end) {
            return None;
        }
        let (_, others) = plain_vertex(lines, zone.clone())?;
        Some(VertexZone {
            entity,
            item,
            index,
            lines: zone,
            others,
        })
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

    fn reread_vertex(
        &mut self,
        zone: &VertexZone,
        range: &Range<usize>,
        lines: i64,
        bytes: i64,
    ) -> Option<Delta> {
        let VertexZone {
            entity,
            item,
            index,
            lines: ref old,
            others,
        } = *zone;
        let end = old.end.checked_add_signed(lines as isize)?;
        let (mut vertex, others_now) = plain_vertex(Lines::new(&self.text), old.start..end)?;
        if others_now != others {
            return None;
        }
        let table = self.table.vertices.get_mut(&entity)?;
        if table.in_space {
            vertex.bulge = 0.0;
        }
        if table.mirrored {
            mirror(&mut vertex);
        }
        shift(&mut table.lines, index + 1, lines);
        shift(&mut self.table.lines, item + 1, lines);
        self.shift_findings(range.end, bytes);
        let touched = Arc::make_mut(&mut self.drawing)
            .splice(entity, index, 1, &[vertex])
            .ok()?;
        Some(Delta {
            touched: vec![touched],
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

/// A VERTEX record that holds only sound tags of a vertex: as it stands in the text, and its other tags.
fn plain_vertex(lines: Lines, range: Range<usize>) -> Option<(Vertex, Others)> {
    if !range.len().is_multiple_of(2) || range.end > lines.count() {
        return None;
    }
    let begins = number::code(lines.content(range.start)) == Code::Known(0);
    if !begins || lines.trimmed(range.start + 1) != b"VERTEX" {
        return None;
    }
    let [mut x, mut y, mut bulge, mut z, mut flags] = [None; 5];
    for line in range.clone().step_by(2) {
        let Code::Known(code) = number::code(lines.content(line)) else {
            return None;
        };
        let value = match code {
            10 => &mut x,
            20 => &mut y,
            42 => &mut bulge,
            30 => &mut z,
            70 => &mut flags,
            0 if line == range.start => continue,
            5 | 6 | 8 | 40 | 41 | 50 | 62 | 91 | 100 | 330 => continue,
            _ => return None,
        };
        // A second x begins another vertex.
        let another = code == 10 && value.is_some();
        if another || (code == 70 && !lines.trimmed(line + 1).iter().all(u8::is_ascii_digit)) {
            return None;
        }
        let Number::Exact(number) = number::number(lines.content(line + 1)) else {
            return None;
        };
        *value = Some(number);
    }
    let vertex = Vertex::new(x?, y?, bulge.unwrap_or(0.0));
    vertex.is_finite().then_some((vertex, [z, flags]))
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
