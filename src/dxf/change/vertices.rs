//! The vertices of a polyline: moved, inserted, removed; and whether it is closed.

use super::super::Document;
use super::super::entities::mirror;
use super::super::lexer::Tag;
use super::super::number::{self, Code, Number};
use super::super::place::{own_tags, vertex_tags};
use super::super::record::{DECIMALS, Style};
use super::Wanted;
use super::pen::{Pen, last};
use crate::drawing::{EntityId, Vertex};
use std::ops::Range;

/// Decimals of bulges.
const BULGE_DECIMALS: usize = 15;

/// Bulges that differ by no more count as equal: over a chord of a metre that is less than a millionth of a µm.
const SAME_BULGE: f64 = 1e-12;

impl Document {
    /// Sets or clears the closed bit of a polyline's group code 70.
    pub(super) fn set_closed(
        &self,
        pen: &mut Pen,
        id: EntityId,
        of_entity: Range<usize>,
        closed: bool,
    ) -> Result<(), String> {
        let lines = pen.lines;
        let Some(table) = self.table.vertices.get(&id) else {
            return Err(say!(is_not_a_polyline, pen.name));
        };
        let end_of_head = of_entity.start + table.lines.first().map_or(2, |&line| line as usize);
        // In a LWPOLYLINE the flags may also stand after the vertices.
        let is_light = lines.trimmed(of_entity.start + 1) == b"LWPOLYLINE";
        let end = if is_light { of_entity.end } else { end_of_head };
        let flags = own_tags(lines, of_entity.start..end).filter(|tag| tag.code == 70);
        if let Some(tag) = flags.last() {
            let flags = std::str::from_utf8(lines.trimmed(tag.value_line())).ok();
            let Some(flags) = flags.and_then(|text| text.parse::<i64>().ok()) else {
                return Err(say!(group_code_70_of_is_no_whole_number, pen.name));
            };
            let wanted = if closed { flags | 1 } else { flags & !1 };
            if wanted != flags {
                pen.put(tag.value_line(), wanted.to_string());
            }
        } else if closed {
            let style = Style::of(pen.text, lines, of_entity.start);
            let head = own_tags(lines, of_entity.start..end_of_head);
            let line = head.last().map_or(of_entity.start, |tag| tag.line) + 2;
            let mut tag = Vec::new();
            style.tag(70, b"1", &mut tag);
            pen.insert(line, &style, tag);
        }
        Ok(())
    }

    pub(super) fn edit_vertices(
        &self,
        pen: &mut Pen,
        id: EntityId,
        of_entity: Range<usize>,
        wanted: &Wanted,
    ) -> Result<(), String> {
        let Some(table) = self.table.vertices.get(&id) else {
            return Err(say!(is_not_a_polyline, pen.name));
        };
        let count = table.lines.len();
        let removed = wanted
            .vertices
            .values()
            .filter(|vertex| vertex.is_none())
            .count();
        let mut beyond = wanted.vertices.range(count..).map(|(&index, _)| index);
        let mut inserted_beyond = wanted.inserted.iter().map(|&(index, _)| index);
        if let Some(index) = beyond
            .next()
            .or_else(|| inserted_beyond.find(|&index| index > count))
        {
            return Err(say!(
                a_vertex_of_an_entity_is_out_of_range,
                index,
                pen.name,
                count
            ));
        }
        let left = count - removed + wanted.inserted.len();
        if removed > 0 && left < 2 {
            return Err(say!(would_be_left_with_less_than_two_vertices, pen.name));
        }
        let as_written = |mut vertex: Vertex, name: &str| {
            if table.in_space && vertex.bulge != 0.0 {
                return Err(say!(is_a_3d_polyline_and_cannot_take_the_bulge, name));
            }
            if table.mirrored {
                mirror(&mut vertex);
            }
            Ok(vertex)
        };
        for (&index, vertex) in &wanted.vertices {
            let Some(range) = self.vertex_lines(id, index) else {
                continue;
            };
            match vertex {
                None => remove_vertex(pen, range),
                Some(vertex) => {
                    let vertex = as_written(*vertex, &pen.name)?;
                    set_vertex(pen, range, vertex)?;
                }
            }
        }
        for &(index, vertex) in &wanted.inserted {
            let vertex = as_written(vertex, &pen.name)?;
            let model = self.vertex_lines(id, index.min(count.saturating_sub(1)));
            insert_vertex(pen, model, index >= count, vertex)?;
        }
        // A POLYLINE states no count.
        let is_light = pen.lines.trimmed(of_entity.start + 1) == b"LWPOLYLINE";
        if left != count && is_light {
            let head = table.lines.first().map_or(0, |&line| line as usize);
            let head = own_tags(pen.lines, of_entity.start..of_entity.start + head);
            if let Some(tag) = head.filter(|tag| tag.code == 90).last()
                && *pen.lines.trimmed(tag.value_line()) != *left.to_string().as_bytes()
            {
                pen.put(tag.value_line(), left.to_string());
            }
        }
        Ok(())
    }
}

fn set_vertex(pen: &mut Pen, range: Range<usize>, vertex: Vertex) -> Result<(), String> {
    let tags: Vec<Tag> = vertex_tags(pen.lines, range).collect();
    pen.set_length(&tags, 10, vertex.point.x)?;
    pen.set_length(&tags, 20, vertex.point.y)?;
    if let Some(tag) = last(&tags, 42) {
        // More digits than the file's writer used do not make a different arc.
        let present = number::number(pen.lines.content(tag.value_line()));
        if matches!(present, Number::Exact(present) if (present - vertex.bulge).abs() <= SAME_BULGE)
        {
            return Ok(());
        }
        return pen.set(&tags, 42, vertex.bulge, BULGE_DECIMALS);
    }
    if vertex.bulge == 0.0 {
        return Ok(());
    }
    let place = tags.iter().rfind(|tag| of_point(tag));
    let Some(before) = place.filter(|_| vertex.bulge.is_finite()) else {
        return Err(say!(cannot_take_the_bulge, pen.name));
    };
    let style = Style::of(pen.text, pen.lines, before.line);
    let mut tag = Vec::new();
    style.number(42, vertex.bulge, BULGE_DECIMALS, &mut tag);
    pen.insert(before.line + 2, &style, tag);
    Ok(())
}

/// A new vertex before the vertex `model`, or after it, in its style.
fn insert_vertex(
    pen: &mut Pen,
    model: Option<Range<usize>>,
    behind: bool,
    vertex: Vertex,
) -> Result<(), String> {
    if !vertex.is_finite() {
        return Err(say!(
            a_new_vertex_of_has_a_number_that_is_not_finite,
            pen.name
        ));
    }
    let Some(model) = model else {
        return Err(say!(has_no_vertex_to_model_a_new_one_on, pen.name));
    };
    let lines = pen.lines;
    let tags: Vec<Tag> = vertex_tags(lines, model.clone()).collect();
    let style = Style::of(pen.text, lines, model.start);
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
    let end = match end_of_record(pen, &model) {
        Some(end) => {
            style.tag(0, b"VERTEX", &mut text);
            for tag in &tags {
                match tag.code {
                    // A handle belongs to one entity; the bulge comes after the point.
                    5 | 20 | 42 => {}
                    10 => coordinates(&mut text),
                    code => style.tag(code, lines.content(tag.value_line()), &mut text),
                }
            }
            bulge(&mut text);
            end
        }
        None => {
            coordinates(&mut text);
            bulge(&mut text);
            // After the place of a bulge, where there is none yet: see `set_vertex`.
            let of_vertex = tags
                .iter()
                .rfind(|tag| of_point(tag) || matches!(tag.code, 42 | 91));
            of_vertex.map_or(model.end, |tag| tag.line + 2)
        }
    };
    pen.insert(if behind { end } else { model.start }, &style, text);
    Ok(())
}

fn remove_vertex(pen: &mut Pen, range: Range<usize>) {
    if let Some(end) = end_of_record(pen, &range) {
        return pen.remove(range.start..end);
    }
    // After the last vertex there may be tags of the whole entity.
    let mut spans: Vec<Range<usize>> = Vec::new();
    for tag in
        vertex_tags(pen.lines, range).filter(|tag| matches!(tag.code, 10 | 20 | 40 | 41 | 42 | 91))
    {
        match spans.last_mut() {
            Some(span) if span.end == tag.line => span.end = tag.line + 2,
            _ => spans.push(tag.line..tag.line + 2),
        }
    }
    spans.into_iter().for_each(|span| pen.remove(span));
}

/// The end of the VERTEX record that begins in these lines; `None` for a vertex of a LWPOLYLINE, which has no record.
fn end_of_record(pen: &Pen, range: &Range<usize>) -> Option<usize> {
    let begins = |line: &usize| number::code(pen.lines.content(*line)) == Code::Known(0);
    let next = || (range.start + 2..range.end).step_by(2).find(begins);
    begins(&range.start).then(|| next().unwrap_or(range.end))
}

/// The point of a vertex and its widths; a bulge follows them.
fn of_point(tag: &Tag) -> bool {
    matches!(tag.code, 10 | 20 | 30 | 40 | 41)
}
