//! The program that wedm writes for a drawing, to be compared with another one.

use super::sides::Sides;
use super::traced::{Motion, Traced, Traits};
use crate::drawing::{Drawing, EntityId, Outline};
use crate::geometry::{Point, Segment, Vector};
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

/// A program written for the comparison, and the paths it was written from, µm.
#[derive(Debug)]
pub(super) struct Reference {
    pub(crate) traced: Traced,
    pieces: Vec<(Segment, Source)>,
    /// From its places to those of the drawing.
    pub(super) shift: Vector,
}

/// The conditions under which a program is written.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Under {
    pub(crate) settings: Effective,
    /// The sides of contours that state none.
    pub(crate) sides: Sides,
    /// The contours that it cuts; all where none is named.
    pub(crate) handles: Option<Vec<String>>,
}

/// The drawing from which it is written.
pub(super) struct Of<'a> {
    pub(crate) drawing: &'a Drawing,
    pub(crate) outlines: &'a [Outline],
    /// mm of the drawing's unit.
    pub(crate) unit_mm: f64,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Asked {
    format: Format,
    under: Under,
}

impl Asked {
    pub(super) fn of(traced: &Traced, under: &Under) -> Asked {
        let format = traced.format();
        let mut under = under.clone();
        if traced.states_ends {
            under.settings.layout = Layout::Checking;
        }
        Asked { format, under }
    }
}

impl Reference {
    pub(super) fn of(of: &Of<'_>, Asked { format, under }: &Asked) -> Option<Reference> {
        let milled = match (format, under.settings.mills) {
            (Format::Milling, true) => Some(under.settings.milled().ok()?),
            (Format::Milling, false) | (_, true) => return None,
            (_, false) => None,
        };
        let settings = milled.as_ref().unwrap_or(&under.settings);
        let cut = of.outlines.iter();
        let cut = cut.filter(|outline| outline.contour.double_of.is_none());
        let segments: usize = cut.map(|outline| outline.contour.len()).sum();
        if settings.pass_error().is_some() || segments.max(of.drawing.len()) > MOST {
            return None;
        }
        let paths = plan(
            of.drawing,
            of.outlines,
            &format.settings(settings),
            under.handles.as_deref(),
        )
        .ok()?;
        let traced = written(*format, &paths, of.unit_mm, settings)?;
        let scale = of.unit_mm * 1e3;
        let shift = match traced.is_placed {
            true => Vector::zeros(),
            false => paths.first()?.begin() * scale - traced.begin()?,
        };
        let pieces = |path: WirePath| path.segments.into_iter();
        let pieces = paths.into_iter().flat_map(pieces);
        Some(Reference {
            traced,
            pieces: pieces
                .map(|piece| (scaled(&piece.geometry, scale), piece.source))
                .collect(),
            shift,
        })
    }

    /// The parts of the paths beside walls and round corners, µm.
    pub(crate) fn on_walls(&self) -> impl Iterator<Item = &Segment> {
        let is_on_wall = |source: &Source| source.place().is_some();
        let own = self
            .pieces
            .iter()
            .filter(move |(_, source)| is_on_wall(source));
        own.map(|(piece, _)| piece)
    }

    /// Whether a place of the written program lies on a path beside a wall or round a corner.
    pub(super) fn is_on_wall(&self, place: Point, tolerance: f64) -> bool {
        let at = place + self.shift;
        self.on_walls()
            .any(|piece| piece.distance_to(at) <= tolerance)
    }

    /// The segment of the drawing that a block follows; `None` for the ways in and out and between.
    pub(crate) fn source_of(&self, motion: &Motion) -> Option<(EntityId, usize)> {
        let Motion::Cut(segment) = motion else {
            return None;
        };
        let shares = [0.0, 0.5, 1.0].map(|share| segment.point_at(share) + self.shift);
        // Farther away than the nearest so far is as good as any.
        let within = |piece: &Segment, than: f64| {
            let mut farthest: f64 = 0.0;
            for place in shares {
                farthest = farthest.max(piece.distance_to(place));
                if farthest >= than {
                    return None;
                }
            }
            Some(farthest)
        };
        let (mut least, mut nearest) = (f64::INFINITY, None);
        for (piece, source) in &self.pieces {
            if let Some(away) = within(piece, least) {
                (least, nearest) = (away, Some(source));
            }
        }
        nearest?.segment()
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
    let language = match format {
        Format::Iso | Format::Milling => Language::Iso,
        Format::ThreeB | Format::FourB => Language::ThreeB,
    };
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
    use super::*;
    use crate::drawing::{Contour, Entity, Geometry, Kind, Role, Unit, Vertex};
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
            let language = match format {
                Format::Iso => Language::Iso,
                _ => Language::ThreeB,
            };
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
