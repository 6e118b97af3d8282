//! What a group code or value means, and what it comes to in millimetres.

use super::codes::{self, Value};
use super::spot::{Spot, spot, text_of, vertex_at};
use crate::drawing::{EntityId, Geometry, Unit};
use crate::dxf::Document;
use crate::dxf::number::{self, Number};
use crate::geometry::Segment;
use crate::ide::Hover;

/// What stands at a byte; `None` where no tag is.
pub fn hover(document: &Document, offset: usize, unit: Unit) -> Option<Hover> {
    let spot = spot(document, document.text().line_of(offset))?;
    let tag = spot.tag?;
    let lines = spot.lines;
    let record = text_of(spot.name);
    let value_bytes = lines.trimmed(tag.value_line());
    let (about, value) = codes::meaning(&record, tag.code);
    let mut text = match tag.code {
        0 => about_record(document, &spot, &record),
        999 => "comment: programs pass it over".to_owned(),
        _ if record.is_empty() => format!("**{}** {about}", tag.code),
        _ => format!("**{}** of {record}: {about}", tag.code),
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
        && let Some((_, about)) = codes::VARIABLES
            .iter()
            .find(|(name, _)| name.as_bytes() == value_bytes)
    {
        text = format!("**{}** {about}", text_of(value_bytes));
    } else if record == "SECTION" && tag.code != 2 {
        // A header variable's value stands behind its name.
        if let Some((name, about)) = variable_of(&spot) {
            text = format!("**{name}** {about}");
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
        .flat_map(|section| codes::records_of(section))
        .find(|(name, _)| *name == record);
    let mut text = format!("**{record}**");
    if let Some((_, about)) = known {
        text = format!("{text}: {about}");
    }
    let entity = document
        .table()
        .items
        .get(spot.item)
        .and_then(|item| item.entity())
        .and_then(|id| document.drawing().get(id));
    if let Some(entity) = entity {
        let segments = match entity.geometry.segment_count() {
            1 => "1 segment".to_owned(),
            count => format!("{count} segments"),
        };
        text = format!(
            "{text}\n\nentity {} on layer {}, {segments}",
            entity.handle, entity.layer
        );
    }
    text
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
        return "a line".into();
    }
    let direction = if bulge > 0.0 {
        "counter-clockwise"
    } else {
        "clockwise"
    };
    let angle = format!("arc of {}°, {direction}", rounded(sweep.abs()));
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
        Some(Segment::Line(_)) => format!(
            "a line: {angle}, which rises less than a millionth of a millimetre above its chord"
        ),
        Some(Segment::Arc(arc)) => {
            let radius = radius_in(arc.radius, unit);
            format!(
                "{angle}\n\nradius {radius}, centre ({}, {})",
                rounded(arc.center.x),
                rounded(arc.center.y)
            )
        }
        None => angle,
    }
}

/// A radius in drawing units, and in millimetres where those are others.
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
    Some(format!(
        "the arc sweeps {}°, radius {}",
        rounded(sweep),
        radius_in(radius, unit)
    ))
}

fn about_handle(document: &Document, handle: &str) -> String {
    match document
        .drawing()
        .find(handle)
        .and_then(|id| document.drawing().get(id))
    {
        Some(entity) => format!("names {} on layer {}", entity.kind, entity.layer),
        None if handle.chars().all(|digit| digit == '0') => "names nothing".into(),
        None => "names no entity that is cut; \"go to definition\" looks for it in the whole file"
            .into(),
    }
}

fn about_flags(record: &str, code: i16, value: f64) -> Option<String> {
    let names: &[(i64, &str)] = match (record, code) {
        ("LWPOLYLINE", 70) => &[(1, "closed"), (128, "linetype runs through")],
        ("POLYLINE", 70) => &[
            (1, "closed"),
            (2, "curve fit"),
            (4, "spline fit"),
            (8, "in space"),
            (16, "mesh"),
            (64, "polyface"),
            (128, "linetype runs through"),
        ],
        ("SPLINE", 70) => &[
            (1, "closed"),
            (2, "periodic"),
            (4, "rational"),
            (8, "planar"),
            (16, "linear"),
        ],
        ("LAYER", 70) => &[(1, "frozen"), (2, "frozen in new viewports"), (4, "locked")],
        ("LAYER", 62) => {
            return Some(if value < 0.0 {
                "the layer is off".into()
            } else {
                "the layer is on".into()
            });
        }
        _ => return None,
    };
    let flags = value as i64;
    let set: Vec<&str> = names
        .iter()
        .filter(|(bit, _)| flags & bit != 0)
        .map(|(_, name)| *name)
        .collect();
    Some(if set.is_empty() {
        if record.contains("POLYLINE") {
            "open".into()
        } else {
            "none is set".into()
        }
    } else {
        set.join(", ")
    })
}

/// The header variable whose value the spot is.
fn variable_of(spot: &Spot<'_>) -> Option<(&'static str, &'static str)> {
    let tag = spot.tag?;
    // A point has three tags behind the name.
    let before = (1..=3)
        .filter_map(|back| tag.line.checked_sub(2 * back))
        .find(|&line| spot.lines.trimmed(line) == b"9")?;
    let name = spot.lines.trimmed(before + 1);
    codes::VARIABLES
        .iter()
        .find(|(known, _)| known.as_bytes() == name)
        .copied()
}

fn about_variable_value(spot: &Spot<'_>, value: f64) -> Option<String> {
    let (name, _) = variable_of(spot).filter(|_| spot.name == b"SECTION")?;
    if name != "$INSUNITS" {
        return None;
    }
    let unit = crate::dxf::unit_of(value as i32)?;
    Some(format!("one unit is {} mm", unit.mm))
}

/// At most six decimals, none that say nothing.
pub(super) fn rounded(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.into()
    }
}
