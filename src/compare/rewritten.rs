//! The program that wedm writes for a drawing, to be compared with another one.

use super::basis::Basis;
use super::traced::{Traced, Traits};
use crate::drawing::EntityId;
use crate::geometry::{Bounds, Grid, Point, Segment, Vector};
use crate::program::notes::Notes;
use crate::program::write::scaled;
use crate::program::{Document, Format, Language};
use crate::settings::{Effective, Jumps, Layout};
use crate::text::SourceText;
use crate::toolpath::{Source, WirePath, plan};

/// Of more entities, or of contours of more segments, no program is written for a comparison.
const MOST: usize = 20_000;
/// A program of more blocks is not read again where that shows nothing beyond what was noted when it was written.
const LONG: usize = 500;
/// How far from a block its piece of the path is looked for, µm; and the same of 4B, which moves the part's contour.
const REACH: f64 = 5.0;
const FOUR_B_REACH: f64 = 3_000.0;

/// A program written for the comparison.
#[derive(Debug)]
pub(super) struct Rewritten {
    pub(super) traced: Traced,
    /// Of each block the segment of the drawing that it follows; `None` for the ways in, out and between, and stops.
    pub(super) sources: Vec<Option<(EntityId, usize)>>,
    /// From its places to those of the drawing.
    pub(super) shift: Vector,
}

/// What is to be written.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Asked {
    format: Format,
    states_ends: bool,
    /// The contours that it cuts; all where none is named.
    handles: Option<Vec<String>>,
}

impl Asked {
    pub(super) fn of(traced: &Traced, handles: Option<Vec<String>>) -> Asked {
        Asked {
            format: traced.format(),
            states_ends: traced.states_ends,
            handles,
        }
    }
}

impl Rewritten {
    pub(super) fn of(basis: Basis, asked: &Asked) -> Option<Rewritten> {
        let mut settings = match (asked.format, basis.settings.mills) {
            (Format::Milling, true) => basis.settings.milled().ok()?,
            (Format::Milling, false) | (_, true) => return None,
            (_, false) => basis.settings.clone(),
        };
        if asked.states_ends {
            settings.layout = Layout::Checking;
        }
        let contours = basis.contours.iter();
        let segments: usize = contours.map(|contour| contour.segments.len()).sum();
        if settings.pass_error().is_some() || segments.max(basis.drawing.len()) > MOST {
            return None;
        }
        let paths = plan(
            basis.drawing,
            basis.outlines,
            &asked.format.settings(&settings),
            asked.handles.as_deref(),
        )
        .ok()?;
        let traced = written(asked.format, &paths, basis.unit_mm, &settings)?;
        let scale = basis.unit_mm * 1e3;
        let shift = match traced.is_placed {
            true => Vector::zeros(),
            false => paths.first()?.begin() * scale - traced.begin()?,
        };
        Some(Rewritten {
            sources: sources(&traced, &paths, scale, shift),
            traced,
            shift,
        })
    }
}

/// Of each block the segment of the drawing of the piece of a path that it lies on.
///
/// Where the table is moved by hand, or each contour counts from its own zero, the next path lies elsewhere than the
/// program says: then it is where its first block begins.
fn sources(
    traced: &Traced,
    paths: &[WirePath],
    scale: f64,
    shift: Vector,
) -> Vec<Option<(EntityId, usize)>> {
    let pieces = Pieces::of(paths, scale);
    let reach = if traced.four_b { FOUR_B_REACH } else { REACH };
    let (mut shift, mut next) = (shift, 0);
    let mut sources = Vec::with_capacity(traced.blocks.len());
    for (index, block) in traced.blocks.iter().enumerate() {
        let Some(own) = block.segment() else {
            sources.push(None);
            continue;
        };
        let is_first = traced.cuts.iter().any(|cut| cut.blocks.start == index);
        if is_first && pieces.source(own, shift, reach).is_none() {
            let begins = paths.iter().enumerate().skip(next);
            let places = begins.map(|(path, it)| (path, it.begin() * scale - own.start()));
            let mut near = places.filter(|(_, by)| pieces.source(own, *by, reach).is_some());
            if let Some((path, by)) = near.next() {
                (shift, next) = (by, path + 1);
            }
        }
        let found = pieces.source(own, shift, reach);
        sources.push(found.and_then(|(_, source)| source.segment()));
        // What is counted in whole micrometres drifts along arcs.
        if let Some((piece, _)) = found.filter(|_| traced.counts && !traced.four_b) {
            let end = own.end() + shift;
            shift += piece.point_at(piece.share_of(end).clamp(0.0, 1.0)) - end;
        }
    }
    sources
}

/// The pieces of all paths, µm, with their index.
struct Pieces {
    all: Vec<(Segment, Source)>,
    index: Grid<usize>,
}

impl Pieces {
    fn of(paths: &[WirePath], scale: f64) -> Pieces {
        let pieces = paths.iter().flat_map(|path| &path.segments);
        let all: Vec<(Segment, Source)> = pieces
            .map(|piece| (scaled(&piece.geometry, scale), piece.source))
            .collect();
        let mut index: Grid<usize> = Grid::default();
        for (number, (piece, _)) in all.iter().enumerate() {
            index.insert(number, piece.bounds());
        }
        Pieces { all, index }
    }

    /// The piece that a block lies on, and where that comes from.
    fn source(&self, block: &Segment, shift: Vector, reach: f64) -> Option<(Segment, Source)> {
        let places: [Point; 3] = [0.0, 0.5, 1.0].map(|share| block.point_at(share) + shift);
        let mut best: Option<(f64, usize)> = None;
        self.index
            .near(&Bounds::of_disc(places[1], reach), |number, _| {
                let Some((piece, _)) = self.all.get(number) else {
                    return;
                };
                let all = places.iter().map(|place| piece.distance_to(*place));
                let own = (all.fold(0.0, f64::max), number);
                if own.0 <= reach && best.is_none_or(|best| own < best) {
                    best = Some(own);
                }
            });
        self.all.get(best?.1).copied()
    }
}

/// The program that is written along paths.
fn written(
    format: Format,
    paths: &[WirePath],
    unit_mm: f64,
    settings: &Effective,
) -> Option<Traced> {
    let mut notes = Notes::default();
    let text = format.write_noting(paths, unit_mm, settings, Some(&mut notes), &mut |_, _| true);
    let text = text.ok()?.text;
    let language = format.language();
    // Where the wire is taken by hand, the coordinates after blocks show it.
    let is_taken = settings.jumps == Jumps::None && settings.layout == Layout::Checking;
    if notes.steps.len() <= LONG || is_taken || !paths.iter().all(returns) {
        let document = Document::read(language, text.into_bytes(), settings);
        return Some(Traced::of(&document));
    }
    Some(of_notes(notes, text, language, settings))
}

/// The same by what was noted.
fn of_notes(notes: Notes, text: String, language: Language, settings: &Effective) -> Traced {
    let traits = Traits {
        language,
        four_b: notes.four_b,
        mills: false,
        states_ends: language == Language::ThreeB && settings.layout == Layout::Checking,
    };
    let trace = notes.into_trace(text.as_bytes());
    Traced::of_trace(trace, &SourceText::new(text.into_bytes()), traits)
}

/// The wire comes back to its thread hole: each stop after such a path stands between two contours.
fn returns(path: &WirePath) -> bool {
    !path.segments.is_empty() && !path.cut_off && !path.is_open() && path.begin() == path.end()
}

#[cfg(test)]
mod tests {
    use super::super::traced::Motion;
    use super::*;
    use crate::drawing::{Contour, Drawing, Entity, Geometry, Kind, Outline, Role, Unit, Vertex};
    use crate::settings::from_toml;

    /// A punch, and an opening beside it.
    fn drawn() -> (Drawing, Vec<Outline>) {
        let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
        let mut outlines = Vec::new();
        for (handle, x, role) in [("2A", 0.0, Role::Punch), ("2B", 40.0, Role::Opening)] {
            let vertices = [
                Vertex::new(x, 0.0, 0.0),
                Vertex::new(x + 20.1234, 0.4567, 0.3),
                Vertex::new(x + 18.3, 12.3, -0.2),
                Vertex::new(x + 4.5, 14.1, 0.0),
            ];
            let id = drawing.push(Entity {
                handle: handle.into(),
                layer: "0".into(),
                role: None,
                kind: Kind::LightPolyline,
                geometry: Geometry::Polyline {
                    closed: true,
                    vertices: vertices.into(),
                },
            });
            let contour = Contour::new(&drawing, [(id, false)], true);
            outlines.push(Outline {
                twice_area: contour.twice_area(&drawing),
                contour,
                role,
            });
        }
        (drawing, outlines)
    }

    fn are_alike(one: &Motion, other: &Motion) -> bool {
        match (one, other) {
            (Motion::Cut(one), Motion::Cut(other)) => [0.0, 0.5, 1.0]
                .iter()
                .all(|share| (one.point_at(*share) - other.point_at(*share)).norm() < 1e-6),
            (Motion::Way(one, by), Motion::Way(other, other_by)) => {
                (one - other).norm() + (by - other_by).norm() < 1e-6
            }
            _ => one == other,
        }
    }

    #[test]
    fn what_is_noted_of_a_program_is_what_is_read() {
        let (drawing, outlines) = drawn();
        for (format, keys) in [
            (Format::ThreeB, ""),
            (Format::ThreeB, "layout = \"checking\""),
            (Format::ThreeB, "header = true\njumps = \"none\""),
            (Format::FourB, "layout = \"aligned\""),
            (Format::Iso, ""),
            (Format::Iso, "jumps = \"none\"\nprofile = \"robofil\""),
            (Format::Iso, "compensation = \"controller\""),
            (Format::Iso, "profile = \"fast-wire\""),
        ] {
            let passes = match format {
                Format::FourB => "correction = 0.1",
                _ => "passes.corrections = [0.2, 0.1]",
            };
            let (set, errors) = from_toml(&format!("{passes}\n[program]\n{keys}\n"));
            assert!(errors.is_empty(), "{errors:?}");
            let settings = Effective::of(&set);
            let paths = plan(&drawing, &outlines, &format.settings(&settings), None).unwrap();
            assert!(paths.iter().all(returns));
            let mut notes = Notes::default();
            let text = format
                .write_noting(&paths, 1.0, &settings, Some(&mut notes), &mut |_, _| true)
                .unwrap()
                .text;
            let language = format.language();
            let bytes = text.clone().into_bytes();
            let read = Traced::of(&Document::read(language, bytes, &settings));
            let noted = of_notes(notes, text.clone(), language, &settings);
            for (one, other) in noted.blocks.iter().zip(&read.blocks) {
                assert!(
                    are_alike(&one.motion, &other.motion),
                    "{one:?} {other:?}\n{text}"
                );
            }
            // The rest is just the same.
            let rest = |traced: &Traced| {
                let blocks = traced.blocks.iter();
                let blocks =
                    blocks.map(|block| (block.range.clone(), block.line, block.is_offset()));
                let flags = [
                    traced.is_placed,
                    traced.counts,
                    traced.four_b,
                    traced.states_ends,
                ];
                (blocks.collect::<Vec<_>>(), traced.cuts.clone(), flags)
            };
            assert_eq!(rest(&noted), rest(&read), "{text}");
        }
    }
}
