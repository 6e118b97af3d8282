//! A drawing's edit as replacements of numbers in the text; the rest of the text stays.

mod pen;
mod vertices;

use super::Document;
use super::entities::mirrored_angles;
use super::lexer::{LOOKAHEAD, Tag};
use super::lines::Lines;
use super::number::{self, Number};
use super::place::own_tags;
use super::reader::range_key;
use super::record::{self, Style};
use crate::drawing::{Change, DrawingEdit, EntityId, Geometry, Vertex};
use crate::finding::{Finding, Rule, Severity};
use crate::text::{SourceText, TextEdit};
use pen::{Pen, last};
use std::collections::BTreeMap;
use std::ops::Range;

/// What an edit asks of one entity.
#[derive(Default)]
struct Wanted<'a> {
    /// The vertices to set, and with `None` to remove.
    vertices: BTreeMap<usize, Option<Vertex>>,
    shape: Option<&'a Geometry>,
    removed: bool,
    /// The index before the edit, and the new vertex. Of several at one index the last is listed
    /// first, since each goes in before the vertex at that index.
    inserted: Vec<(usize, Vertex)>,
    closed: Option<bool>,
    /// New entities after it, the last first.
    added: Vec<&'a Geometry>,
}

impl<'a> Wanted<'a> {
    fn take(&mut self, change: &'a Change) {
        match change {
            Change::SetVertex { index, vertex, .. } => {
                let slot = self.vertices.entry(*index).or_insert(Some(*vertex));
                *slot = slot.and(Some(*vertex));
            }
            Change::RemoveVertex { index, .. } => {
                self.vertices.insert(*index, None);
            }
            Change::Reshape { geometry, .. } => self.shape = Some(geometry),
            Change::RemoveEntity { .. } => self.removed = true,
            Change::InsertVertex { index, vertex, .. } => self.inserted.push((*index, *vertex)),
            Change::SetClosed { closed, .. } => self.closed = Some(*closed),
            Change::AddEntity { geometry, .. } => self.added.push(geometry),
        }
    }
}

impl Document {
    /// The edit as replacements of numbers in the text, sorted and disjoint. The error says why it cannot be made.
    ///
    /// Lengths and degrees are written with up to 12 decimals, bulges with 15; an unchanged number is not touched. An
    /// angle is written in [0°, 360°).
    pub fn text_edits(&self, edit: &DrawingEdit) -> Result<Vec<TextEdit>, String> {
        if self.is_binary {
            return Err(say!(the_file_is_binary_dxf_and_not_edited).into());
        }
        let mut wanted: BTreeMap<EntityId, Wanted> = BTreeMap::new();
        for change in &edit.changes {
            wanted.entry(change.entity()).or_default().take(change);
        }
        for of_entity in wanted.values_mut() {
            of_entity.inserted.reverse();
            of_entity.added.reverse();
        }
        let mut edits = Vec::new();
        let mut free_handle = None;
        for (&entity, wanted) in &wanted {
            self.edit_entity(entity, wanted, &mut edits)?;
            self.add_entities(entity, &wanted.added, &mut free_handle, &mut edits)?;
        }
        edits.sort_by_key(|edit| (edit.range.start, edit.range.end));
        if let Some(line) = edits.iter().find_map(|edit| self.fault_decided_by(edit)) {
            return Err(say!(lines_would_come_or_go_near_a_damaged_one, line + 1));
        }
        Ok(edits)
    }

    /// The line of a text fault before an edit that adds or removes lines. The reader resumed there by looking at the
    /// lines after, and might decide differently after the edit.
    fn fault_decided_by(&self, edit: &TextEdit) -> Option<usize> {
        let ends = |bytes: &[u8]| SourceText::new(bytes.to_vec()).line_count();
        if ends(self.text.slice(edit.range.clone())?) == ends(edit.text.as_bytes()) {
            return None;
        }
        let reach = self.text.line_start(
            self.text
                .line_of(edit.range.start)
                .saturating_sub(LOOKAHEAD),
        );
        let behind = self
            .findings
            .partition_point(|finding| range_key(finding).0 <= edit.range.end);
        let damage = |finding: &&Finding| {
            finding.rule == Rule::Syntax && finding.severity == Severity::Error
        };
        let near = self
            .findings
            .iter()
            .take(behind)
            .filter(damage)
            .find(|finding| range_key(finding).1 >= reach)?;
        Some(self.text.line_of(range_key(near).0))
    }

    fn edit_entity(
        &self,
        id: EntityId,
        wanted: &Wanted,
        edits: &mut Vec<TextEdit>,
    ) -> Result<(), String> {
        let lines = Lines::new(&self.text);
        let (Some(entity), Some(item)) = (self.drawing.get(id), self.table.item_of(id)) else {
            return Err(say!(the_entity_is_not_in_the_text_any_more).into());
        };
        let of_entity = self.table.lines_of(item, lines.count());
        let mut pen = Pen {
            text: &self.text,
            lines,
            name: format!("{} {}", entity.kind, entity.handle),
            edits,
        };
        let has_vertices = !wanted.vertices.is_empty() || !wanted.inserted.is_empty();
        let may = if wanted.shape.is_some() || wanted.closed.is_some() || has_vertices {
            self.drawing.is_editable(id)
        } else {
            self.drawing.is_whole(id)
        };
        if !may {
            return Err(say!(has_no_numbers_of_its_own_in_the_text, pen.name));
        }
        if wanted.removed {
            pen.remove(of_entity);
            return Ok(());
        }
        if let Some(shape) = wanted.shape {
            reshape(&mut pen, of_entity.clone(), &entity.geometry, shape)?;
        }
        if let Some(closed) = wanted.closed {
            self.set_closed(&mut pen, id, of_entity.clone(), closed)?;
        }
        if has_vertices {
            self.edit_vertices(&mut pen, id, of_entity, wanted)?;
        }
        Ok(())
    }

    /// New records after an entity. They get handles where that entity has one.
    fn add_entities(
        &self,
        after: EntityId,
        added: &[&Geometry],
        free_handle: &mut Option<u64>,
        edits: &mut Vec<TextEdit>,
    ) -> Result<(), String> {
        let lines = Lines::new(&self.text);
        let Some(item) = self.table.item_of(after).filter(|_| !added.is_empty()) else {
            return Ok(());
        };
        let model = self.table.lines_of(item, lines.count());
        let tags: Vec<Tag> = own_tags(lines, model.clone()).collect();
        let mirrored = is_mirrored(lines, &tags);
        let at = self.text.line_start(end_of_tags(lines, &model));
        let style = Style::of(&self.text, lines, model.start);
        for geometry in added {
            let handle = match last(&tags, 5) {
                None => None,
                Some(_) => {
                    let none_left = || say!(no_handle_is_left_for_a_new_entity);
                    let free = free_handle
                        .or_else(|| record::free_handle(lines))
                        .ok_or_else(none_left)?;
                    *free_handle = Some(free.checked_add(1).ok_or_else(none_left)?);
                    Some(format!("{free:X}"))
                }
            };
            let record = record::new_entity(
                &self.text,
                lines,
                model.clone(),
                mirrored,
                handle.as_deref(),
                geometry,
            )?;
            edits.push(TextEdit::new(
                at..at,
                style.inserted(&self.text, at, record),
            ));
        }
        Ok(())
    }
}

/// Writes the numbers of a line or an arc that replaces another one.
fn reshape(
    pen: &mut Pen,
    of_entity: Range<usize>,
    old: &Geometry,
    new: &Geometry,
) -> Result<(), String> {
    let tags: Vec<Tag> = own_tags(pen.lines, of_entity).collect();
    match (old, new) {
        (Geometry::Line { .. }, Geometry::Line { start, end }) => {
            for (code, value) in [(10, start.x), (20, start.y), (11, end.x), (21, end.y)] {
                pen.set_length(&tags, code, value)?;
            }
        }
        (
            Geometry::Arc { .. },
            &Geometry::Arc {
                mut center,
                radius,
                mut start_angle,
                mut end_angle,
            },
        ) => {
            if is_mirrored(pen.lines, &tags) {
                center.x = 0.0 - center.x;
                (start_angle, end_angle) = mirrored_angles(start_angle, end_angle);
            }
            if radius <= 0.0 || radius.is_nan() {
                return Err(say!(cannot_have_the_radius, pen.name, radius));
            }
            for (code, value) in [(10, center.x), (20, center.y), (40, radius)] {
                pen.set_length(&tags, code, value)?;
            }
            pen.set_angle(&tags, 50, start_angle)?;
            pen.set_angle(&tags, 51, end_angle)?;
        }
        (_, Geometry::Arc { .. }) => return Err(say!(is_not_an_arc, pen.name)),
        _ => return Err(say!(is_not_a_line, pen.name)),
    }
    Ok(())
}

/// True where the extrusion is (0, 0, -1): an entity with geometry has this one or (0, 0, 1).
fn is_mirrored(lines: Lines, tags: &[Tag]) -> bool {
    let z = last(tags, 230).map(|tag| number::number(lines.content(tag.value_line())));
    matches!(z, Some(Number::Exact(z) | Number::Blemished(z, _)) if z < 0.0)
}

/// The line after the last tag of a record. Empty lines at the end of the text belong to no tag, but one may be a
/// value.
fn end_of_tags(lines: Lines, record: &Range<usize>) -> usize {
    if record.end < lines.count() {
        return record.end;
    }
    let is_said = |line: &usize| !lines.trimmed(*line).is_empty();
    let said = record
        .clone()
        .rev()
        .find(is_said)
        .map_or(record.start, |line| line + 1);
    (said + (said - record.start) % 2).min(record.end)
}
