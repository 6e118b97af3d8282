//! A reference to a block in which one number is edited: what it draws lies elsewhere, and nothing else has changed.

use super::Document;
use super::blocks::Drawn;
use super::entity::Outcome;
use super::lexer::Lexer;
use super::lines::Lines;
use super::number::{self, Code};
use super::reader::{Said, range_key, read_item};
use super::table::{Became, Context, Named};
use crate::drawing::{Delta, Entity, EntityId, Touched};
use std::mem::discriminant;
use std::ops::Range;
use std::sync::Arc;

/// The reference that holds an edit, its lines, and what it draws.
pub(super) struct ReferenceZone {
    lines: Range<usize>,
    ids: Range<u32>,
}

impl Document {
    /// The reference in which an edit is about to change one number that says where and how large it draws its block.
    pub(super) fn reference_zone(
        &self,
        range: &Range<usize>,
        replacement: &str,
    ) -> Option<ReferenceZone> {
        let line = self.text.line_of(range.start);
        let item = self.table.item_at(line)?;
        let of_item = self.table.items.get(item)?;
        let Became::Parts { first, count } = of_item.became else {
            return None;
        };
        let lines = Lines::new(&self.text);
        let own = self.table.lines_of(item, lines.count());
        let is_value = line > own.start + 2 && (line - own.start) % 2 == 1;
        let is_number = || {
            let code = number::code(lines.content(line - 1));
            matches!(
                code,
                Code::Known(10 | 20 | 30 | 41 | 42 | 43 | 44 | 45 | 50)
            )
        };
        let is_within_line =
            range.end <= lines.range(line).end && !replacement.contains(['\n', '\r']);
        let stands = of_item.context == Context::Entities
            && of_item.named == Named::ByText
            && own.end < lines.count()
            && !self.table.left_out.contains_key(&first)
            && self.table.frames.is_empty()
            && !self.is_at_fault(own.start, own.end)
            && !self.is_spoken_of(&own);
        (stands && is_value && is_within_line && is_number()).then(|| ReferenceZone {
            lines: own,
            ids: first.0..first.0.saturating_add(count),
        })
    }

    /// True where the text has a finding in some lines.
    fn is_spoken_of(&self, lines: &Range<usize>) -> bool {
        let [start, end] = [lines.start, lines.end].map(|line| self.text.line_start(line));
        let first = self
            .findings
            .partition_point(|finding| range_key(finding).0 < start);
        let mut own = self.findings.iter().skip(first).take(1);
        own.any(|finding| range_key(finding).0 < end)
    }

    /// Draws the reference again. `None` where it no longer draws the same parts.
    pub(super) fn reread_reference(
        &mut self,
        zone: &ReferenceZone,
        range: &Range<usize>,
        bytes: i64,
    ) -> Option<Delta> {
        let tolerance = self.table.fit_tolerance;
        let mut lexer = Lexer::new(Lines::new(&self.text), zone.lines.start);
        let read = read_item(&mut lexer, Context::Entities, tolerance, &mut self.layers)?;
        let Said::Entity(Outcome::Insert(insert)) = read.said else {
            return None;
        };
        if lexer.at() != zone.lines.end || !lexer.findings.is_empty() {
            return None;
        }
        let blocks = self.table.blocks.clone();
        let Drawn { parts, left_out } =
            blocks.redraw(&insert, tolerance, &mut self.table.states)?;
        let old = zone.ids.clone().map(|id| self.drawing.get(EntityId(id)));
        let mut pairs = parts.iter().zip(old);
        let are_same = pairs.all(|(part, old)| {
            old.is_some_and(|old| {
                old.kind == part.kind
                    && old.layer == part.layer
                    && discriminant(&old.geometry) == discriminant(&part.geometry)
            })
        });
        if !left_out.is_empty() || parts.len() != zone.ids.len() || !are_same {
            return None;
        }
        let drawing = Arc::make_mut(&mut self.drawing);
        let mut delta = Delta::default();
        for (id, part) in zone.ids.clone().map(EntityId).zip(parts) {
            if let Some(old) = drawing.get(id).filter(|old| old.geometry != part.geometry) {
                let new = Entity {
                    geometry: part.geometry,
                    ..old.clone()
                };
                drawing.replace(id, new);
                delta.touched.push(Touched::Entity { entity: id });
            }
        }
        self.shift_findings(range.end, bytes);
        Some(delta)
    }
}
