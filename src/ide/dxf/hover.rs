//! The meaning of a group code or value, and its length in millimetres.

use super::codes::{self, About, Value};
use super::records;
use super::spot::{Spot, spot, text_of, vertex_at};
use crate::drawing::{EntityId, Geometry, Unit};
use crate::dxf::Document;
use crate::dxf::number::{self, Number};
use crate::geometry::Segment;
use crate::ide::Hover;
use crate::ide::amounts::{rounded as rounded_to, turn};
use crate::message::said;

/// The hover at a byte; `None` where there is no tag.
pub(crate) fn hover(document: &Document, offset: usize, unit: Unit) -> Option<Hover> {
    let spot = spot(document, document.text().line_of(offset))?;
    let tag = spot.tag?;
    let lines = spot.lines;
    let record = text_of(spot.name);
    let value_bytes = lines.trimmed(tag.value_line());
    let (about, value) = codes::meaning(&record, tag.code);
    let mut text = match tag.code {
        0 => about_record(document, &spot, &record),
        999 => say!(a_comment_programs_pass_it_over).to_owned(),
        _ if record.is_empty() => say!(word_in_bold, tag.code, about),
        _ => say!(code_of_a_record, tag.code, record, about),
    };
    let number = match number::number(value_bytes) {
        Number::Exact(number) | Number::Blemished(number, _) => Some(number),
        Number::Bad => None,
    };
    let entity = document
        .table()
        .items
        .get(spot.item)
        .and_then(|item| item.entity());
    let more = match (value, number) {
        (Value::Length, Some(number)) => in_mm(number, unit),
        (Value::Degrees, Some(_)) => about_angle(document, entity, &record, tag.code, unit),
        (Value::Bulge, Some(number)) => Some(about_bulge(document, &spot, entity, number, unit)),
        (Value::Handle, _) => Some(about_handle(document, &text_of(value_bytes))),
        (Value::Plain, Some(number)) => {
            about_flags(&record, tag.code, number).or_else(|| about_variable_value(&spot, number))
        }
        _ => None,
    };
    if tag.code == 9
        && let Some((name, about)) = variable(value_bytes)
    {
        text = say!(word_in_bold, name, about());
    } else if record == "SECTION" && tag.code != 2 {
        // A header variable's value stands after its name.
        if let Some((name, about)) = variable_of(&spot) {
            text = say!(word_in_bold, name, about());
        }
    }
    if let Some(more) = more {
        text.push_str("\n\n");
        text.push_str(&more);
    }
    Some(Hover {
        range: lines.trimmed_range(spot.line),
        text,
    })
}

fn about_record(document: &Document, spot: &Spot<'_>, record: &str) -> String {
    let known = ["", "TABLES", "ENTITIES", "OBJECTS"]
        .iter()
        .flat_map(|section| records::records_of(section))
        .find(|(name, _)| *name == record);
    let text = match known {
        Some((_, about)) => say!(record_and_what_it_is, record, about()),
        None => format!("**{record}**"),
    };
    let item = document.table().items.get(spot.item);
    let entity = item
        .and_then(|item| item.entity())
        .and_then(|id| document.drawing().get(id));
    match entity {
        Some(entity) => {
            let segments = say!(segments, entity.geometry.segment_count());
            let about = say!(entity_on_layer, entity.handle, entity.layer, segments);
            format!("{text}\n\n{about}")
        }
        None => text,
    }
}

/// A length in millimetres, where the drawing has another unit.
fn in_mm(length: f64, unit: Unit) -> Option<String> {
    (unit.mm != 1.0).then(|| format!("{} mm", rounded(length * unit.mm)))
}

fn about_bulge(
    document: &Document,
    spot: &Spot<'_>,
    entity: Option<EntityId>,
    bulge: f64,
    unit: Unit,
) -> String {
    let sweep = 4.0 * bulge.atan().to_degrees();
    if bulge == 0.0 {
        return say!(a_line).into();
    }
    let angle = say!(arc_of_degrees, rounded(sweep.abs()), turn(bulge));
    let arc = entity.and_then(|entity| {
        let start = vertex_at(document, spot.item, spot.line)?.start;
        let from_item = (start - *document.table().lines.get(spot.item)? as usize) as u32;
        let index = document
            .table()
            .vertices
            .get(&entity)?
            .lines
            .binary_search(&from_item)
            .ok()?;
        document.drawing().segment(entity, index)
    });
    match arc {
        Some(Segment::Line(_)) => say!(a_line_since_the_arc_hardly_rises, angle),
        Some(Segment::Arc(arc)) => {
            let radius = radius_in(arc.radius, unit);
            let center = arc.center * unit.mm;
            let (x, y) = (rounded(center.x), rounded(center.y));
            format!("{angle}\n\n{}", say!(radius_and_centre, radius, x, y))
        }
        None => angle,
    }
}

/// A radius in drawing units, and in millimetres if the unit is another.
fn radius_in(radius: f64, unit: Unit) -> String {
    match unit.mm {
        1.0 => format!("{} mm", rounded(radius)),
        mm => format!("{} ({} mm)", rounded(radius), rounded(radius * mm)),
    }
}

fn about_angle(
    document: &Document,
    entity: Option<EntityId>,
    record: &str,
    code: i16,
    unit: Unit,
) -> Option<String> {
    if record != "ARC" || !matches!(code, 50 | 51) {
        return None;
    }
    let Geometry::Arc {
        radius,
        start_angle,
        end_angle,
        ..
    } = document.drawing().get(entity?)?.geometry
    else {
        return None;
    };
    let sweep = (end_angle - start_angle).to_degrees().rem_euclid(360.0);
    let sweep = if sweep == 0.0 { 360.0 } else { sweep };
    Some(say!(
        the_arc_sweeps,
        rounded(sweep),
        radius_in(radius, unit)
    ))
}

fn about_handle(document: &Document, handle: &str) -> String {
    let drawing = document.drawing();
    match drawing.find(handle).and_then(|id| drawing.get(id)) {
        Some(entity) => say!(names_an_entity_on_layer, entity.kind, entity.layer),
        None if handle.chars().all(|digit| digit == '0') => say!(names_nothing).into(),
        None => say!(names_no_entity_that_is_cut).into(),
    }
}

fn about_flags(record: &str, code: i16, value: f64) -> Option<String> {
    let names: &[(i64, About)] = match (record, code) {
        ("LWPOLYLINE", 70) => &[(1, said::closed), (128, said::linetype_runs_through)],
        ("POLYLINE", 70) => &[
            (1, said::closed),
            (2, said::curve_fit),
            (4, said::spline_fit),
            (8, said::in_space),
            (16, said::mesh),
            (64, said::polyface),
            (128, said::linetype_runs_through),
        ],
        ("SPLINE", 70) => &[
            (1, said::closed),
            (2, said::periodic),
            (4, said::rational),
            (8, said::planar),
            (16, said::linear),
        ],
        ("LAYER", 70) => &[
            (1, said::frozen),
            (2, said::frozen_in_new_viewports),
            (4, said::locked),
        ],
        ("LAYER", 62) if value < 0.0 => return Some(say!(the_layer_is_off).into()),
        ("LAYER", 62) => return Some(say!(the_layer_is_on).into()),
        _ => return None,
    };
    let flags = value as i64;
    let set: Vec<&str> = names
        .iter()
        .filter(|(bit, _)| flags & bit != 0)
        .map(|(_, name)| name())
        .collect();
    Some(match (set.is_empty(), record.contains("POLYLINE")) {
        (false, _) => set.join(", "),
        (true, true) => say!(open).into(),
        (true, false) => say!(no_flag_is_set).into(),
    })
}

fn variable(name: &[u8]) -> Option<records::Named> {
    let known = |(known, _): &&records::Named| known.as_bytes() == name;
    records::VARIABLES.iter().find(known).copied()
}

/// The header variable whose value the spot is.
fn variable_of(spot: &Spot<'_>) -> Option<records::Named> {
    let tag = spot.tag?;
    // A point has three tags after the name.
    let before = (1..=3)
        .filter_map(|back| tag.line.checked_sub(2 * back))
        .find(|&line| spot.lines.trimmed(line) == b"9")?;
    variable(spot.lines.trimmed(before + 1))
}

fn about_variable_value(spot: &Spot<'_>, value: f64) -> Option<String> {
    let (name, _) = variable_of(spot).filter(|_| spot.name == b"SECTION")?;
    if name != "$INSUNITS" {
        return None;
    }
    let unit = crate::dxf::unit_of(value as i32)?;
    Some(say!(one_unit_is_mm, unit.mm))
}

fn rounded(value: f64) -> String {
    rounded_to(value, 6)
}
