//! A polyline with one number being typed: it is damaged now, and will soon be whole again.
//!
//! As long as the edits stay within that vertex, everything read of the polyline is kept aside and only the vertex is
//! reread. This needs a LWPOLYLINE without any other fault: the finding is then the one about that number, as in a
//! fresh reading.

use super::Document;
use super::edit::{Others, VertexZone, plain_vertex, shift};
use super::entities::mirror;
use super::entity::{Common, VertexLines};
use super::lexer::{Lexer, Tag};
use super::lines::Lines;
use super::number::{self, Code, Number};
use super::reader::range_key;
use super::table::{Became, NO_ITEM, Named};
use crate::drawing::{Appearance, Delta, Entity, EntityId, Touched};
use crate::finding::{Finding, Place, Rule};
use std::ops::Range;
use std::sync::Arc;

#[derive(Clone, Debug)]
pub(super) struct Suspended {
    item: usize,
    id: EntityId,
    entity: Arc<Entity>,
    appearance: Appearance,
    vertices: VertexLines,
    index: usize,
    /// The vertex as it was when the number was valid.
    lines: Range<usize>,
    others: Others,
}

impl Document {
    /// The suspended polyline, when the edit leaves the first and the last byte of its vertex alone.
    pub(super) fn suspended_about(&mut self, range: &Range<usize>) -> Option<Suspended> {
        let suspended = self.suspended.take()?;
        let inside = range.start > self.text.line_start(suspended.lines.start)
            && range.end < self.text.line_start(suspended.lines.end);
        inside.then_some(*suspended)
    }

    /// Suspends the polyline when the edit has made one of its numbers invalid. `None` where the edit did more than
    /// that.
    pub(super) fn suspend(
        &mut self,
        zone: &VertexZone,
        range: &Range<usize>,
        lines: i64,
        bytes: i64,
    ) -> Option<Delta> {
        let VertexZone {
            entity: id,
            item,
            index,
            lines: ref old,
            others,
        } = *zone;
        let of_item = self.table.lines_of(item, Lines::new(&self.text).count());
        let is_light = Lines::new(&self.text).trimmed(of_item.start + 1) == b"LWPOLYLINE";
        let by_text =
            self.table.items.get(item)?.named == Named::ByText && self.table.named_anew == 0;
        if lines != 0 || !is_light || !by_text || !self.drawing.is_editable(id) {
            return None;
        }
        let fault = fault_in(Lines::new(&self.text), old.clone())?;
        let (start, end) = (
            self.text.line_start(of_item.start),
            self.text.line_start(of_item.end),
        );
        let first = self
            .findings
            .partition_point(|finding| range_key(finding).0 < start);
        if self
            .findings
            .get(first)
            .is_some_and(|finding| (range_key(finding).0 as i64) < end as i64 - bytes)
        {
            return None;
        }
        let appearance = self.drawing.appearance(id);
        let vertices = self.table.vertices.remove(&id)?;
        let entity = Arc::make_mut(&mut self.drawing).remove(id)?;
        self.table.set_item_of(id, NO_ITEM);
        self.table.items.get_mut(item)?.became = Became::Damaged;
        self.shift_findings(range.end, bytes);
        self.findings.insert(first, fault);
        self.suspended = Some(Box::new(Suspended {
            item,
            id,
            entity,
            appearance,
            vertices,
            index,
            lines: old.clone(),
            others,
        }));
        Some(Delta {
            touched: vec![Touched::Removed { entity: id }],
        })
    }

    /// Brings the polyline back when its number is valid again; until then it stays suspended. `None` where the edit
    /// did more than that.
    pub(super) fn resume(
        &mut self,
        mut suspended: Suspended,
        range: &Range<usize>,
        lines: i64,
        bytes: i64,
    ) -> Option<Delta> {
        if lines != 0 {
            return None;
        }
        let start = self.text.line_start(suspended.lines.start);
        let first = self
            .findings
            .partition_point(|finding| range_key(finding).0 < start);
        let own = |finding: &Finding| {
            finding.rule == Rule::Syntax && matches!(finding.place, Place::Text { .. })
        };
        self.findings.get(first).filter(|finding| own(finding))?;
        let Some((mut vertex, others)) =
            plain_vertex(Lines::new(&self.text), suspended.lines.clone())
        else {
            let fault = fault_in(Lines::new(&self.text), suspended.lines.clone())?;
            self.shift_findings(range.end, bytes);
            *self.findings.get_mut(first)? = fault;
            self.suspended = Some(Box::new(suspended));
            return Some(Delta::default());
        };
        if others != suspended.others {
            return None;
        }
        if suspended.vertices.mirrored {
            mirror(&mut vertex);
        }
        let drawing = Arc::make_mut(&mut self.drawing);
        if !drawing.put_back(suspended.id, suspended.entity) {
            return None;
        }
        drawing.set_appearance(suspended.id, suspended.appearance);
        let touched = drawing
            .splice(suspended.id, suspended.index, 1, &[vertex])
            .ok()?;
        self.findings.remove(first);
        self.shift_findings(range.end, bytes);
        self.table.items.get_mut(suspended.item)?.became = Became::Entity(suspended.id);
        self.table.set_item_of(suspended.id, suspended.item as u32);
        shift(&mut suspended.vertices.lines, suspended.index + 1, lines);
        self.table.vertices.insert(suspended.id, suspended.vertices);
        Some(Delta {
            touched: vec![touched],
        })
    }
}

/// The finding about the one invalid number in a vertex's lines; `None` where anything else is wrong there, or where
/// the lines are out of step.
fn fault_in(lines: Lines, range: Range<usize>) -> Option<Finding> {
    let mut fault = None;
    for line in range.clone().step_by(2) {
        let Code::Known(code) = number::code(lines.content(line)) else {
            return None;
        };
        if !matches!(code, 10 | 20 | 42) || (line == range.start) != (code == 10) {
            return None;
        }
        match number::number(lines.content(line + 1)) {
            Number::Exact(_) => {}
            Number::Bad if fault.is_none() => fault = Some(Tag { code, line }),
            _ => return None,
        }
    }
    let tag = fault?;
    let mut lexer = Lexer::new(lines, tag.line);
    lexer.next()?;
    Common::default().coordinate(&mut lexer, tag);
    if lexer.out_of_step || lexer.findings.len() != 1 {
        return None;
    }
    lexer.findings.pop()
}
