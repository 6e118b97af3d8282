//! A drawing's edit as replacements of numbers in the text; nothing else of the text moves.

use super::Document;
use super::entities::{mirror, mirrored_angles};
use super::lexer::{LOOKAHEAD, Tag};
use super::lines::Lines;
use super::number::{self, Code, Number, written};
use super::place::{own_tags, vertex_tags};
use super::reader::range_key;
use super::record::{self, Style};
use crate::drawing::{Change, DrawingEdit, EntityId, Geometry, Vertex};
use crate::finding::{Finding, Rule, Severity};
use crate::geometry::{Point, positive_angle};
use crate::text::{SourceText, TextEdit};
use std::collections::BTreeMap;
use std::ops::Range;

/// Decimals of lengths and of angles in degrees.
const DECIMALS: usize = 12;
/// Decimals of bulges.
const BULGE_DECIMALS: usize = 15;

/// What an edit asks of one entity.
#[derive(Default)]
struct Wanted {
    /// The vertices to be set, and to be removed where there is none.
    vertices: BTreeMap<usize, Option<Vertex>>,
    line: Option<(Point, Point)>,
    arc: Option<(Point, f64, f64, f64)>,
    removed: bool,
    /// Index before the edit and the vertex that comes in there, in the order in which they are to stand.
    inserted: Vec<(usize, Vertex)>,
    closed: Option<bool>,
    /// New entities behind it, in the order in which they are to stand.
    added: Vec<Geometry>,
}

impl Document {
    /// The edit as replacements of numbers in the text, sorted and disjoint. An error says why it cannot be made.
    ///
    /// Lengths and degrees are written with up to 12 decimals, bulges with 15, a number that stays is not touched. An
    /// angle is written in [0°, 360°).
    pub fn text_edits(&self, edit: &DrawingEdit) -> Result<Vec<TextEdit>, String> {
        if self.is_binary {
            return Err(say!(the_file_is_binary_dxf_and_not_edited).into());
        }
        let mut wanted: BTreeMap<EntityId, Wanted> = BTreeMap::new();
        for change in &edit.changes {
            let of_entity = wanted.entry(change.entity()).or_default();
            match *change {
                Change::SetVertex { index, vertex, .. } => {
                    let slot = of_entity.vertices.entry(index).or_insert(Some(vertex));
                    if slot.is_some() {
                        *slot = Some(vertex);
                    }
                }
                Change::RemoveVertex { index, .. } => {
                    of_entity.vertices.insert(index, None);
                }
                Change::SetLine { start, end, .. } => of_entity.line = Some((start, end)),
                Change::SetArc {
                    center,
                    radius,
                    start_angle,
                    end_angle,
                    ..
                } => {
                    of_entity.arc = Some((center, radius, start_angle, end_angle));
                }
                Change::RemoveEntity { .. } => of_entity.removed = true,
                Change::InsertVertex { index, vertex, .. } => {
                    of_entity.inserted.push((index, vertex))
                }
                Change::SetClosed { closed, .. } => of_entity.closed = Some(closed),
                Change::AddEntity { ref geometry, .. } => of_entity.added.push(geometry.clone()),
            }
        }
        // Of several in one place, the last comes first: each goes in before what stands there.
        for of_entity in wanted.values_mut() {
            of_entity.inserted.reverse();
            of_entity.added.reverse();
        }
        let mut edits = Vec::new();
        let mut free_handle = None;
        for (entity, wanted) in wanted {
            self.edit_entity(entity, &wanted, &mut edits)?;
            self.add_entities(entity, &wanted.added, &mut free_handle, &mut edits)?;
        }
        edits.sort_by_key(|edit| (edit.range.start, edit.range.end));
        if let Some(line) = edits.iter().find_map(|edit| self.fault_decided_by(edit)) {
            return Err(say!(lines_would_come_or_go_near_line, line + 1));
        }
        Ok(edits)
    }

    /// The line of a fault of the text before an edit that adds or removes lines: how the text goes on there was told from the
    /// lines behind it, and would perhaps be told otherwise.
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
        let name = format!("{} {}", entity.kind, entity.handle);
        let is_changed = wanted.line.is_some()
            || wanted.arc.is_some()
            || wanted.closed.is_some()
            || !wanted.vertices.is_empty()
            || !wanted.inserted.is_empty();
        let may = if is_changed {
            self.drawing.is_editable(id)
        } else {
            self.drawing.is_whole(id)
        };
        if !may {
            return Err(say!(has_no_numbers_of_its_own_in_the_text, name));
        }
        if wanted.removed {
            edits.push(TextEdit {
                range: self.whole_lines(of_entity),
                text: String::new(),
            });
            return Ok(());
        }
        let tags: Vec<Tag> = match entity.geometry {
            Geometry::Polyline { .. } => Vec::new(),
            _ => own_tags(lines, of_entity.clone()).collect(),
        };
        if let Some((start, end)) = wanted.line {
            if !matches!(entity.geometry, Geometry::Line { .. }) {
                return Err(say!(is_not_a_line, name));
            }
            for (code, value) in [(10, start.x), (20, start.y), (11, end.x), (21, end.y)] {
                self.set_length(lines, &tags, code, value, &name, edits)?;
            }
        }
        if let Some((mut center, radius, mut start_angle, mut end_angle)) = wanted.arc {
            if !matches!(entity.geometry, Geometry::Arc { .. }) {
                return Err(say!(is_not_an_arc, name));
            }
            if is_mirrored(lines, &tags) {
                center.x = 0.0 - center.x;
                (start_angle, end_angle) = mirrored_angles(start_angle, end_angle);
            }
            if radius <= 0.0 || radius.is_nan() {
                return Err(say!(cannot_have_the_radius, name, radius));
            }
            for (code, value) in [(10, center.x), (20, center.y), (40, radius)] {
                self.set_length(lines, &tags, code, value, &name, edits)?;
            }
            for (code, value) in [(50, start_angle), (51, end_angle)] {
                self.set_angle(lines, &tags, code, value, &name, edits)?;
            }
        }
        if let Some(closed) = wanted.closed {
            self.set_closed(id, of_entity.clone(), closed, &name, edits)?;
        }
        if !wanted.vertices.is_empty() || !wanted.inserted.is_empty() {
            self.edit_vertices(id, of_entity, wanted, &name, edits)?;
        }
        Ok(())
    }

    /// New records behind an entity. A handle is given where that entity has one.
    fn add_entities(
        &self,
        after: EntityId,
        added: &[Geometry],
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
        for geometry in added {
            let handle = match last(&tags, 5) {
                None => None,
                Some(_) => {
                    let free = free_handle
                        .or_else(|| record::free_handle(lines))
                        .ok_or(say!(no_handle_is_left_for_a_new_entity))?;
                    *free_handle = Some(
                        free.checked_add(1)
                            .ok_or(say!(no_handle_is_left_for_a_new_entity))?,
                    );
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
            let text = Style::of(&self.text, lines, model.start).inserted(&self.text, at, record);
            edits.push(TextEdit {
                range: at..at,
                text,
            });
        }
        Ok(())
    }

    /// Sets or clears the bit of group code 70 that says that a polyline is closed.
    fn set_closed(
        &self,
        id: EntityId,
        of_entity: Range<usize>,
        closed: bool,
        name: &str,
        edits: &mut Vec<TextEdit>,
    ) -> Result<(), String> {
        let lines = Lines::new(&self.text);
        let Some(table) = self.table.vertices.get(&id) else {
            return Err(say!(is_not_a_polyline, name));
        };
        let end_of_head = of_entity.start + table.lines.first().map_or(2, |&line| line as usize);
        // Of a LWPOLYLINE the flags may also stand behind the vertices.
        let is_light = lines.trimmed(of_entity.start + 1) == b"LWPOLYLINE";
        let end = if is_light { of_entity.end } else { end_of_head };
        if let Some(tag) = own_tags(lines, of_entity.start..end)
            .filter(|tag| tag.code == 70)
            .last()
        {
            let range = lines.trimmed_range(tag.value_line());
            let flags: Option<i64> =
                std::str::from_utf8(self.text.slice(range.clone()).unwrap_or_default())
                    .ok()
                    .and_then(|text| text.parse().ok());
            let Some(flags) = flags else {
                return Err(say!(group_code_70_of_is_no_whole_number, name));
            };
            let wanted = if closed { flags | 1 } else { flags & !1 };
            if wanted != flags {
                edits.push(TextEdit {
                    range,
                    text: wanted.to_string(),
                });
            }
        } else if closed {
            let style = Style::of(&self.text, lines, of_entity.start);
            let line = own_tags(lines, of_entity.start..end_of_head)
                .last()
                .map_or(of_entity.start, |tag| tag.line)
                + 2;
            let at = self.text.line_start(line);
            let mut tag = Vec::new();
            style.tag(70, b"1", &mut tag);
            edits.push(TextEdit {
                range: at..at,
                text: style.inserted(&self.text, at, tag),
            });
        }
        Ok(())
    }

    fn edit_vertices(
        &self,
        id: EntityId,
        of_entity: Range<usize>,
        wanted: &Wanted,
        name: &str,
        edits: &mut Vec<TextEdit>,
    ) -> Result<(), String> {
        let lines = Lines::new(&self.text);
        let Some(table) = self.table.vertices.get(&id) else {
            return Err(say!(is_not_a_polyline, name));
        };
        let count = table.lines.len();
        let removed = wanted
            .vertices
            .values()
            .filter(|vertex| vertex.is_none())
            .count();
        let beyond = wanted
            .inserted
            .iter()
            .map(|(index, _)| *index)
            .find(|&index| index > count);
        if let Some(index) = wanted
            .vertices
            .range(count..)
            .next()
            .map(|(&index, _)| index)
            .or(beyond)
        {
            return Err(say!(
                a_vertex_of_an_entity_is_out_of_range,
                index,
                name,
                count
            ));
        }
        let left = count - removed + wanted.inserted.len();
        if removed > 0 && left < 2 {
            return Err(say!(would_be_left_with_less_than_two_vertices, name));
        }
        for (&index, vertex) in &wanted.vertices {
            let Some(range) = self.vertex_lines(id, index) else {
                continue;
            };
            let Some(mut vertex) = *vertex else {
                self.remove_vertex(lines, range, edits);
                continue;
            };
            if table.in_space && vertex.bulge != 0.0 {
                return Err(in_space(name));
            }
            if table.mirrored {
                mirror(&mut vertex);
            }
            self.set_vertex(lines, range, vertex, name, edits)?;
        }
        for &(index, mut vertex) in &wanted.inserted {
            if table.mirrored {
                mirror(&mut vertex);
            }
            if table.in_space && vertex.bulge != 0.0 {
                return Err(in_space(name));
            }
            self.insert_vertex(id, index, count, vertex, name, edits)?;
        }
        // A POLYLINE states no count.
        let is_light = lines.trimmed(of_entity.start + 1) == b"LWPOLYLINE";
        if left != count && is_light {
            let head = of_entity.start
                ..of_entity.start + table.lines.first().map_or(0, |&line| line as usize);
            if let Some(tag) = own_tags(lines, head).filter(|tag| tag.code == 90).last() {
                let text = left.to_string();
                let range = lines.trimmed_range(tag.value_line());
                if self.text.slice(range.clone()) != Some(text.as_bytes()) {
                    edits.push(TextEdit { range, text });
                }
            }
        }
        Ok(())
    }

    fn set_vertex(
        &self,
        lines: Lines,
        range: Range<usize>,
        vertex: Vertex,
        name: &str,
        edits: &mut Vec<TextEdit>,
    ) -> Result<(), String> {
        let tags: Vec<Tag> = vertex_tags(lines, range).collect();
        self.set_length(lines, &tags, 10, vertex.point.x, name, edits)?;
        self.set_length(lines, &tags, 20, vertex.point.y, name, edits)?;
        if last(&tags, 42).is_some() {
            return self.set(lines, &tags, 42, vertex.bulge, BULGE_DECIMALS, name, edits);
        }
        if vertex.bulge == 0.0 {
            return Ok(());
        }
        let place = tags.iter().rfind(|tag| of_point(tag));
        let Some(&before) = place.filter(|_| vertex.bulge.is_finite()) else {
            return Err(say!(cannot_take_the_bulge, name));
        };
        let code_line = lines.range(before.line);
        let line_end = self
            .text
            .slice(code_line.end..self.text.line_start(before.line + 1))
            .unwrap_or_default();
        let code = lines.trimmed_range(before.line);
        let text = [
            self.text
                .slice(code_line.start..code.start)
                .unwrap_or_default(),
            b"42",
            self.text.slice(code.end..code_line.end).unwrap_or_default(),
            line_end,
            written(vertex.bulge, BULGE_DECIMALS).as_bytes(),
            line_end,
        ]
        .concat();
        let at = self.text.line_start(before.line + 2);
        edits.push(TextEdit {
            range: at..at,
            text: String::from_utf8_lossy(&text).into_owned(),
        });
        Ok(())
    }

    /// A new vertex before vertex `index`, or behind the last one, in the style of the one beside it.
    fn insert_vertex(
        &self,
        id: EntityId,
        index: usize,
        count: usize,
        vertex: Vertex,
        name: &str,
        edits: &mut Vec<TextEdit>,
    ) -> Result<(), String> {
        let lines = Lines::new(&self.text);
        if !vertex.is_finite() {
            return Err(say!(a_new_vertex_of_has_a_number_that_is_not_finite, name));
        }
        let behind = index >= count;
        let Some(model) = self.vertex_lines(id, index.min(count.saturating_sub(1))) else {
            return Err(say!(has_no_vertex_to_model_a_new_one_on, name));
        };
        let is_record = number::code(lines.content(model.start)) == Code::Known(0);
        let tags: Vec<Tag> = vertex_tags(lines, model.clone()).collect();
        let style = Style::of(&self.text, lines, model.start);
        let mut text = Vec::new();
        let coordinates = |text: &mut Vec<u8>| {
            style.number(10, vertex.point.x, DECIMALS, text);
            style.number(20, vertex.point.y, DECIMALS, text);
        };
        let bulge = |text: &mut Vec<u8>| {
            if vertex.bulge != 0.0 {
                style.number(42, vertex.bulge, BULGE_DECIMALS, text);
            }
        };
        let end = if is_record {
            style.tag(0, b"VERTEX", &mut text);
            for tag in &tags {
                match tag.code {
                    // A handle is one entity's own; the bulge comes behind the point.
                    5 | 20 | 42 => {}
                    10 => coordinates(&mut text),
                    code => style.tag(code, lines.content(tag.value_line()), &mut text),
                }
            }
            bulge(&mut text);
            let is_next = |line: &usize| number::code(lines.content(*line)) == Code::Known(0);
            (model.start + 2..model.end)
                .step_by(2)
                .find(is_next)
                .unwrap_or(model.end)
        } else {
            coordinates(&mut text);
            bulge(&mut text);
            // Behind the place of a bulge, where there is none yet: see `set_vertex`.
            let of_vertex = tags
                .iter()
                .rfind(|tag| of_point(tag) || matches!(tag.code, 42 | 91));
            of_vertex.map_or(model.end, |tag| tag.line + 2)
        };
        let at = self.text.line_start(if behind { end } else { model.start });
        edits.push(TextEdit {
            range: at..at,
            text: style.inserted(&self.text, at, text),
        });
        Ok(())
    }

    fn remove_vertex(&self, lines: Lines, range: Range<usize>, edits: &mut Vec<TextEdit>) {
        if number::code(lines.content(range.start)) == Code::Known(0) {
            // A VERTEX record, up to the next one.
            let end = (range.start + 2..range.end)
                .step_by(2)
                .find(|&line| number::code(lines.content(line)) == Code::Known(0))
                .unwrap_or(range.end);
            edits.push(TextEdit {
                range: self.whole_lines(range.start..end),
                text: String::new(),
            });
            return;
        }
        // Behind the last vertex there may be tags of the whole entity.
        let mut spans: Vec<Range<usize>> = Vec::new();
        for tag in
            vertex_tags(lines, range).filter(|tag| matches!(tag.code, 10 | 20 | 40 | 41 | 42 | 91))
        {
            match spans.last_mut() {
                Some(span) if span.end == tag.line => span.end = tag.line + 2,
                _ => spans.push(tag.line..tag.line + 2),
            }
        }
        edits.extend(spans.into_iter().map(|span| TextEdit {
            range: self.whole_lines(span),
            text: String::new(),
        }));
    }

    fn whole_lines(&self, lines: Range<usize>) -> Range<usize> {
        let start = if lines.start == 0 {
            Lines::new(&self.text).range(0).start
        } else {
            self.text.line_start(lines.start)
        };
        start..self.text.line_start(lines.end)
    }

    fn set_length(
        &self,
        lines: Lines,
        tags: &[Tag],
        code: i16,
        value: f64,
        name: &str,
        edits: &mut Vec<TextEdit>,
    ) -> Result<(), String> {
        self.set(lines, tags, code, value, DECIMALS, name, edits)
    }

    /// `angle` in radians.
    fn set_angle(
        &self,
        lines: Lines,
        tags: &[Tag],
        code: i16,
        angle: f64,
        name: &str,
        edits: &mut Vec<TextEdit>,
    ) -> Result<(), String> {
        let degrees = positive_angle(angle).to_degrees();
        let written_degrees = record::degrees(angle);
        if let Some(tag) = last(tags, code)
            && let Number::Exact(present) = number::number(lines.content(tag.value_line()))
        {
            let apart = (present - degrees).rem_euclid(360.0);
            if apart.min(360.0 - apart) < 1e-12 {
                return Ok(());
            }
        }
        self.set(lines, tags, code, written_degrees, DECIMALS, name, edits)
    }

    /// Replaces the number behind `code`, unless it is the same as written.
    #[expect(
        clippy::too_many_arguments,
        reason = "one number, its place and its precision"
    )]
    fn set(
        &self,
        lines: Lines,
        tags: &[Tag],
        code: i16,
        value: f64,
        decimals: usize,
        name: &str,
        edits: &mut Vec<TextEdit>,
    ) -> Result<(), String> {
        if !value.is_finite() {
            return Err(say!(group_code_of_cannot_be, code, name, value));
        }
        let Some(tag) = last(tags, code) else {
            return Err(say!(has_no_group_code, name, code));
        };
        let line = tag.value_line();
        if let Number::Exact(present) = number::number(lines.content(line))
            && (present - value).abs() <= 0.5 * 0.1f64.powi(decimals as i32)
        {
            return Ok(());
        }
        edits.push(TextEdit {
            range: lines.trimmed_range(line),
            text: written(value, decimals),
        });
        Ok(())
    }
}

fn in_space(name: &str) -> String {
    say!(is_a_3d_polyline_and_cannot_take_the_bulge, name)
}

/// The tag that counts: the last one of its code.
fn last(tags: &[Tag], code: i16) -> Option<Tag> {
    tags.iter().rfind(|tag| tag.code == code).copied()
}

/// The point of a vertex and its widths: what a bulge stands behind.
fn of_point(tag: &Tag) -> bool {
    matches!(tag.code, 10 | 20 | 30 | 40 | 41)
}

/// True where the extrusion is (0, 0, -1): the only one but (0, 0, 1) that an entity with geometry can have.
fn is_mirrored(lines: Lines, tags: &[Tag]) -> bool {
    let z = last(tags, 230).map(|tag| number::number(lines.content(tag.value_line())));
    matches!(z, Some(Number::Exact(z) | Number::Blemished(z, _)) if z < 0.0)
}

/// The line behind the last tag of a record: empty lines at the end of the text are none of its tags, but one may be a value.
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
