//! The thread holes for the drill: rows of a list, and a drawing with the holes.

use super::Cut;
use crate::document::{Snapshot, Source};
use crate::drawing::{Drawing, Entity, Geometry, START_HOLES};
use crate::dxf::{self, Added};
use crate::geometry::Point;
use crate::toolpath::StartHole;

/// The drill list of some drawings, as CSV.
#[derive(Default)]
pub(crate) struct List {
    rows: Vec<Row>,
}

/// The hole of a contour: the part of a pair that is threaded there, and the cells before and after it.
struct Row {
    part: Option<String>,
    before: String,
    behind: &'static str,
    /// Its place among all holes of the drawing, from 1: the number in the picture.
    number: usize,
}

/// The holes that are drilled: not those that were found where there is no room for any, which is an error of the drawing, nor those in what has dropped.
pub(crate) fn drilled(mut holes: Vec<StartHole>) -> Vec<StartHole> {
    holes.retain(|hole| !hole.cuts && !hole.is_open);
    holes
}

/// The holes that are drilled, with their numbers in the order of the cuts; `first` is that of the first one.
pub(crate) fn numbered(
    holes: &[StartHole],
    first: usize,
) -> impl Iterator<Item = (usize, &StartHole)> {
    let holes = holes.iter().enumerate();
    let holes = holes.map(move |(index, hole)| (first + index, hole));
    holes.filter(|(_, hole)| !hole.cuts && !hole.is_open)
}

impl List {
    /// A row for each hole of a drawing, in mm; without a diameter where the settings have none.
    pub(crate) fn add(&mut self, name: &str, cuts: &[Cut]) {
        let mut first = 1;
        for cut in cuts {
            let row = |(number, hole): (usize, &StartHole)| row(name, cut, (number, hole));
            let numbered = numbered(&cut.planned.holes, first);
            self.rows.extend(numbered.map(row));
            first += cut.planned.holes.len();
        }
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.rows.len()
    }

    /// The list; it has a column for the part where a drawing is a pair.
    pub(crate) fn csv(&self) -> String {
        let has_parts = self.rows.iter().any(|row| row.part.is_some());
        let head = if has_parts { HEAD_OF_PARTS } else { HEAD };
        let line = |row: &Row| match (has_parts, &row.part) {
            (false, _) => format!("{},{},{}\n", row.before, row.behind, row.number),
            (true, part) => {
                let part = cell(part.as_deref().unwrap_or_default());
                format!("{},{},{part},{}\n", row.before, row.behind, row.number)
            }
        };
        let lines = self.rows.iter().map(line);
        [head.to_owned()].into_iter().chain(lines).collect()
    }
}

/// The names of the columns, and those of a list with pairs.
const HEAD: &str = "drawing,x_mm,y_mm,diameter_mm,contour,hole,number\n";
const HEAD_OF_PARTS: &str = "drawing,x_mm,y_mm,diameter_mm,contour,hole,part,number\n";

fn row(name: &str, cut: &Cut, (number, hole): (usize, &StartHole)) -> Row {
    let snapshot = &cut.snapshot;
    let unit_mm = snapshot.settings.unit_of(&snapshot.drawing).mm;
    let diameter = snapshot.settings.start_hole;
    let diameter = diameter.map_or_else(String::new, |diameter| diameter.to_string());
    // A coordinate that rounds to zero has no sign.
    let mm = |along: f64| (along * unit_mm * 1e4).round() / 1e4 + 0.0;
    let outline = snapshot.outlines.get(hole.outline);
    let contour = outline.map_or("?", |outline| outline.name(&snapshot.drawing));
    let before = format!(
        "{},{:.4},{:.4},{diameter},{}",
        cell(name),
        mm(hole.at.x),
        mm(hole.at.y),
        cell(contour),
    );
    Row {
        part: cut.name().map(str::to_owned),
        before,
        behind: if hole.is_given { "given" } else { "found" },
        number,
    }
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

/// The holes as DXF, but those of a pair: in the text of the drawing, of which everything else stays; where there is none, in a new drawing of what was read.
pub(crate) fn as_dxf(source: &Source, snapshot: &Snapshot, cuts: &[Cut]) -> Result<InDxf, String> {
    // A mark in the drawing is one for every part that is cut along its contour.
    if cuts.iter().any(|cut| cut.part.is_some()) {
        return Err(say!(holes_of_a_pair_are_csv).into());
    }
    let holes = cuts.iter().flat_map(|cut| cut.planned.holes.clone());
    let holes = &drilled(holes.collect());
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
