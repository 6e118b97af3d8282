//! The program that wedm writes for a drawing, to be compared with another one.

use super::sides::Sides;
use super::traced::{Motion, Traced};
use crate::drawing::{Drawing, EntityId, Outline};
use crate::geometry::{Point, Segment, Vector};
use crate::program::write::scaled;
use crate::program::{Document, Format, Language};
use crate::settings::{Effective, Layout};
use crate::toolpath::{Source, WirePath, plan};

/// Of more entities, or of contours of more segments, no program is written for a comparison.
const MOST: usize = 20_000;

/// A program written for the comparison, and the paths it was written from, µm.
#[derive(Debug)]
pub(super) struct Reference {
    pub(crate) traced: Traced,
    pieces: Vec<(Segment, Source)>,
    /// From its places to those of the drawing.
    shift: Vector,
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
        let text = format.write(&paths, of.unit_mm, settings, &mut |_, _| true);
        let language = match format {
            Format::Iso | Format::Milling => Language::Iso,
            Format::ThreeB | Format::FourB => Language::ThreeB,
        };
        let document = Document::read(language, text.ok()?.text.into_bytes(), settings);
        let traced = Traced::of(&document);
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
