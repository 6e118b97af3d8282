//! The thread holes for the drill: rows of a list, and a drawing with the holes.

use crate::document::{Snapshot, Source};
use crate::drawing::{Drawing, Entity, Geometry, START_HOLES};
use crate::dxf::{self, Added};
use crate::geometry::Point;
use crate::toolpath::StartHole;

/// The names of the columns.
pub(crate) const HEAD: &str = "drawing,x_mm,y_mm,diameter_mm,contour,hole\n";

/// The holes that are drilled: not those that were found where there is no room for any, which is an error of the drawing.
pub(crate) fn drilled(mut holes: Vec<StartHole>) -> Vec<StartHole> {
    holes.retain(|hole| !hole.cuts);
    holes
}

/// A row of CSV for each hole, in mm; without a diameter where the settings have none.
pub(crate) fn rows(name: &str, snapshot: &Snapshot, holes: &[StartHole]) -> String {
    let unit_mm = snapshot.settings.unit_of(&snapshot.drawing).mm;
    let diameter = snapshot.settings.start_hole;
    let diameter = diameter.map_or_else(String::new, |diameter| diameter.to_string());
    // A coordinate that rounds to zero has no sign.
    let mm = |along: f64| (along * unit_mm * 1e4).round() / 1e4 + 0.0;
    let contour_of = |hole: &StartHole| {
        let outline = snapshot.outlines.get(hole.outline);
        outline.map_or("?", |outline| outline.name(&snapshot.drawing))
    };
    let row = |hole: &StartHole| {
        format!(
            "{},{:.4},{:.4},{diameter},{},{}\n",
            cell(name),
            mm(hole.at.x),
            mm(hole.at.y),
            cell(contour_of(hole)),
            if hole.is_given { "given" } else { "found" }
        )
    };
    holes.iter().map(row).collect()
}

/// A cell of CSV: in quotes where it has to be.
fn cell(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

/// A new drawing of everything drawn and the holes: a circle where a diameter is set, and the mark that keeps the hole
/// in place when the drawing is read again.
fn drawn(snapshot: &Snapshot, holes: &[StartHole]) -> Drawing {
    let unit = snapshot.settings.unit_of(&snapshot.drawing);
    let mut drawing = Drawing::new(Some(unit));
    for (_, entity) in snapshot.drawing.entities() {
        drawing.push(entity.clone());
    }
    for &StartHole { at, .. } in holes {
        let circle = snapshot
            .settings
            .start_hole
            .map(|diameter| Geometry::Circle {
                center: at,
                radius: diameter / 2.0 / unit.mm,
            });
        let text = "O".into();
        for geometry in circle.into_iter().chain([Geometry::Text { at, text }]) {
            drawing.push(Entity::new(START_HOLES, START_HOLES, geometry));
        }
    }
    drawing
}

/// The holes as DXF: in the text of the drawing, of which everything else stays; where there is none, in a new drawing of what was read.
pub(crate) fn as_dxf(
    source: &Source,
    snapshot: &Snapshot,
    holes: &[StartHole],
) -> Result<InDxf, String> {
    let unit = snapshot.settings.unit_of(&snapshot.drawing);
    let diameter = snapshot.settings.start_hole;
    let places: Vec<Point> = holes.iter().map(|hole| hole.at).collect();
    let added = Added {
        layer: START_HOLES,
        places: &places,
        radius: diameter.map(|diameter| diameter / 2.0 / unit.mm),
        mark: "O",
        height: 1.0 / unit.mm,
    };
    if let Source::Dxf(text) = source
        && let Some(bytes) = text.with_added(&added)
    {
        return Ok(InDxf {
            bytes,
            is_new: false,
        });
    }
    Ok(InDxf {
        bytes: dxf::write(&drawn(snapshot, holes))?,
        is_new: true,
    })
}

/// A drawing with the holes.
pub(crate) struct InDxf {
    pub(crate) bytes: Vec<u8>,
    /// It is a new drawing: what was not read is not in it.
    pub(crate) is_new: bool,
}
