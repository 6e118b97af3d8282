//! New drawings as DXF text, by the `dxf` crate: a text that nobody wrote by hand needs no positions.

use crate::drawing::{Drawing, Geometry, Unit};
use crate::geometry::{Bounds, Point, positive_angle};
use ::dxf as crate_dxf;
use crate_dxf::entities::{self, Entity, EntityCommon, EntityType};
use crate_dxf::enums::{AcadVersion, Units};
use crate_dxf::{LwPolylineVertex, Point as Point3};

/// Height of texts, in millimetres: a start mark has no height of its own.
const TEXT_HEIGHT_MM: f64 = 1.0;

/// A4 landscape.
const SHEET_MM: [f64; 2] = [297.0, 210.0];

/// The drawing as an ASCII DXF file of release 2000: LWPOLYLINE, LINE, ARC, CIRCLE and TEXT on their layers.
///
/// Numbers have 12 decimals, bulges too; angles are degrees in [0°, 360°). Handles are new, entities keep their order.
/// The unit is written where it is millimetre, inch, centimetre or metre, else the file has none.
/// The error is the message of the writing crate.
pub fn write(drawing: &Drawing) -> Result<Vec<u8>, String> {
    let mut file = crate_dxf::Drawing::new();
    file.header.version = AcadVersion::R2000;
    file.header.default_drawing_units = match drawing.unit {
        Some(unit) if unit == Unit::MILLIMETRE => Units::Millimeters,
        Some(unit) if unit == Unit::INCH => Units::Inches,
        Some(Unit { mm: 10.0 }) => Units::Centimeters,
        Some(Unit { mm: 1000.0 }) => Units::Meters,
        _ => Units::Unitless,
    };
    set_extents(&mut file, drawing);
    let text_height = TEXT_HEIGHT_MM / drawing.unit.unwrap_or(Unit::MILLIMETRE).mm;
    for (_, entity) in drawing.entities() {
        let specific = match &entity.geometry {
            Geometry::Polyline { closed, vertices } => {
                let vertices = vertices
                    .iter()
                    .map(|vertex| LwPolylineVertex {
                        x: vertex.point.x,
                        y: vertex.point.y,
                        bulge: vertex.bulge,
                        ..LwPolylineVertex::default()
                    })
                    .collect();
                let mut polyline = entities::LwPolyline {
                    vertices,
                    ..entities::LwPolyline::default()
                };
                polyline.set_is_closed(*closed);
                EntityType::LwPolyline(polyline)
            }
            Geometry::Line { start, end } => {
                EntityType::Line(entities::Line::new(in_space(*start), in_space(*end)))
            }
            Geometry::Arc {
                center,
                radius,
                start_angle,
                end_angle,
            } => {
                let (start, end) = (
                    positive_angle(*start_angle).to_degrees(),
                    positive_angle(*end_angle).to_degrees(),
                );
                EntityType::Arc(entities::Arc::new(in_space(*center), *radius, start, end))
            }
            Geometry::Circle { center, radius } => {
                EntityType::Circle(entities::Circle::new(in_space(*center), *radius))
            }
            Geometry::Text { at, .. } if entity.point_of_arc().is_some() => {
                EntityType::Arc(entities::Arc::new(in_space(*at), 0.0, 0.0, 0.0))
            }
            Geometry::Text { at, text } => EntityType::Text(entities::Text {
                location: in_space(*at),
                value: text.clone(),
                text_height,
                ..entities::Text::default()
            }),
        };
        let common = EntityCommon {
            layer: entity.layer.to_string(),
            ..EntityCommon::default()
        };
        file.add_entity(Entity { common, specific });
    }
    let mut bytes = Vec::new();
    file.save(&mut bytes)
        .map_err(|error| say!(the_dxf_file_cannot_be_written, error))?;
    Ok(as_written(bytes))
}

/// What the crate states of the time and of chance: the same drawing is to be the same file, and readers need none of it.
const OF_THE_MOMENT: [&[u8]; 8] = [
    b"$TDCREATE",
    b"$TDUCREATE",
    b"$TDUPDATE",
    b"$TDUUPDATE",
    b"$TDINDWG",
    b"$TDUSRTIMER",
    b"$FINGERPRINTGUID",
    b"$VERSIONGUID",
];

/// Sets the extents of the drawing and a sheet of A4: the crate's own are those of a drawing in inches, and programs
/// print that area.
fn set_extents(file: &mut crate_dxf::Drawing, drawing: &Drawing) {
    let mut bounds = Bounds::EMPTY;
    for (_, entity) in drawing.entities() {
        entity
            .geometry
            .segments_of(drawing.flat())
            .for_each(|segment| bounds.merge(&segment.bounds()));
    }
    if !bounds.is_empty() {
        let (min, max) = (in_space(bounds.min), in_space(bounds.max));
        file.header.minimum_drawing_extents = min.clone();
        file.header.maximum_drawing_extents = max.clone();
        file.header.minimum_drawing_limits = min;
        file.header.maximum_drawing_limits = max;
    }
    let [width, height] =
        SHEET_MM.map(|length| length / drawing.unit.unwrap_or(Unit::MILLIMETRE).mm);
    file.header.paperspace_maximum_drawing_limits = Point3::new(width, height, 0.0);
}

/// Leaves out [what another run would state otherwise](OF_THE_MOMENT), and adds a handle for each symbol table, which the crate
/// leaves out: strict readers repair that.
///
/// Lines come in pairs of group code and value. The handles continue from `$HANDSEED`.
fn as_written(bytes: Vec<u8>) -> Vec<u8> {
    let lines: Vec<&[u8]> = bytes.split_inclusive(|byte| *byte == b'\n').collect();
    let pairs: Vec<(&[u8], &[u8])> = lines
        .as_chunks()
        .0
        .iter()
        .map(|[code, value]| (code.trim_ascii(), value.trim_ascii()))
        .collect();
    let seed_at = pairs
        .iter()
        .position(|pair| *pair == (b"9", b"$HANDSEED"))
        .map(|at| at + 1);
    let seed = seed_at
        .and_then(|at| u64::from_str_radix(std::str::from_utf8(pairs.get(at)?.1).ok()?, 16).ok());
    let (Some(seed_at), Some(seed)) = (seed_at, seed) else {
        return bytes;
    };
    let is_table = |at: usize| {
        let before = at.checked_sub(1).and_then(|before| pairs.get(before));
        pairs.get(at).is_some_and(|(code, _)| *code == b"2")
            && before.is_some_and(|before| *before == (b"0", b"TABLE"))
    };
    let names_a_moment = |at: usize| {
        let pair = pairs.get(at);
        pair.is_some_and(|(code, name)| *code == b"9" && OF_THE_MOMENT.contains(name))
    };
    let tables = (0..pairs.len()).filter(|at| is_table(*at)).count() as u64;
    let mut next = seed;
    let mut whole = Vec::with_capacity(bytes.len() + 64 * tables as usize);
    for (at, pair) in lines.chunks(2).enumerate() {
        if names_a_moment(at) || at.checked_sub(1).is_some_and(names_a_moment) {
            continue;
        }
        if at == seed_at {
            whole.extend_from_slice(format!("  5\r\n{:X}\r\n", seed + tables).as_bytes());
            continue;
        }
        pair.iter().for_each(|line| whole.extend_from_slice(line));
        if pair.len() == 2 && is_table(at) {
            // Owner 0: a table belongs to nothing.
            whole.extend_from_slice(format!("  5\r\n{next:X}\r\n330\r\n0\r\n").as_bytes());
            next += 1;
        }
    }
    whole
}

fn in_space(point: Point) -> Point3 {
    Point3::new(point.x, point.y, 0.0)
}
