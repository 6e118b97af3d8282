//! The way of the wire round one contour at one offset, as a line along which a program moves.

use super::contour::Contour;
use crate::drawing::EntityId;
use crate::geometry::{Point, Segment, Side};
use crate::program::write::scaled;
use crate::settings::{Compensation, Corner, Effective};
use crate::toolpath;

/// Pieces up to this length are left out: nothing of them may be left on the grid of a program.
const CRUMB: f64 = 1.0;
/// An arc of more than this is a circle, radians.
const TURN: f64 = 6.25;
/// An offset below this is none: the wire runs on the contour, or the control moves it there.
pub(super) const NONE: f64 = 2.0;

/// A piece of a ring.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) segment: Segment,
    pub(super) source: Option<(EntityId, usize)>,
    /// Where it begins along the ring.
    pub(super) before: f64,
}

/// The way, in the direction of the program.
#[derive(Clone, Debug, Default)]
pub(super) struct Ring {
    pub(super) pieces: Vec<Piece>,
    pub(super) length: f64,
    pub(super) closed: bool,
}

/// What a ring is laid for: a contour, how far beside it, positive to its left, and whether against its direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Course {
    pub(super) contour: usize,
    pub(super) offset: f64,
    pub(super) back: bool,
    pub(super) corner: Corner,
}

impl Ring {
    /// `None` where no wire runs there.
    pub(super) fn of(
        contour: &Contour,
        course: &Course,
        settings: &Effective,
        unit_mm: f64,
    ) -> Option<Ring> {
        let mut segments = contour.segments.clone();
        if course.back {
            segments.reverse();
            for segment in &mut segments {
                segment.geometry = segment.geometry.reversed();
            }
        }
        let scale = unit_mm * 1e3;
        let mut ring = Ring {
            closed: contour.closed,
            ..Ring::default()
        };
        if course.offset.abs() <= NONE {
            for own in &segments {
                let source = Some((own.entity, own.segment));
                ring.push(scaled(&own.geometry, scale), source);
            }
            return Some(ring);
        }
        let is_left = (course.offset > 0.0) != course.back;
        let side = if is_left { Side::Left } else { Side::Right };
        let settings = Effective {
            compensation: Compensation::Path,
            corner: course.corner,
            ..settings.clone()
        };
        let (sided, mm) = ((side, contour.closed), course.offset.abs() / 1e3);
        let laid = toolpath::rounds(&segments, sided, &[mm], &settings, unit_mm);
        for piece in laid.into_iter().next()?? {
            ring.push(scaled(&piece.geometry, scale), piece.source.segment());
        }
        Some(ring)
    }

    fn push(&mut self, whole: Segment, source: Option<(EntityId, usize)>) {
        // A circle has no place where it begins.
        let is_turn = whole.as_arc().is_some_and(|arc| arc.sweep.abs() > TURN);
        let parts = if is_turn { 4 } else { 1 };
        let share = |part: u32| f64::from(part) / f64::from(parts);
        for part in 0..parts {
            let segment = match is_turn {
                true => whole.part(share(part), share(part + 1)),
                false => whole,
            };
            let (before, length) = (self.length, segment.length());
            if length > CRUMB {
                self.length += length;
                self.pieces.push(Piece {
                    segment,
                    source,
                    before,
                });
            }
        }
    }

    /// From its begin to just before its end, which on a closed one is its begin.
    pub(super) fn whole(&self) -> [f64; 2] {
        [0.0, self.length * (1.0 - 1e-12)]
    }

    /// The number of the piece at a place along the ring, which may lie beyond its end.
    pub(super) fn index(&self, along: f64) -> usize {
        let along = match self.closed {
            true => along.rem_euclid(self.length.max(1e-9)),
            false => along,
        };
        let behind = self.pieces.partition_point(|piece| piece.before <= along);
        behind.saturating_sub(1)
    }

    /// The pieces that lie between two places along the ring, each with where it begins, counted on over its end.
    pub(super) fn between(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, &Piece)> {
        let count = self.pieces.len();
        let turns = (from / self.length.max(1e-9)).floor();
        let (first, base) = match self.closed {
            true => (self.index(from), turns * self.length),
            false => (self.index(from.max(0.0)), 0.0),
        };
        let all = (first..).map_while(move |number| {
            if !self.closed && number >= count || count == 0 {
                return None;
            }
            let piece = self.pieces.get(number % count)?;
            let laps = (number / count) as f64;
            Some((base + laps * self.length + piece.before, piece))
        });
        all.take_while(move |(before, _)| *before <= to)
    }

    /// The place along the ring between two others that is nearest to a point, and how far that is.
    pub(super) fn nearest(&self, point: Point, from: f64, to: f64) -> Option<(f64, f64)> {
        let all = self.between(from, to).map(|(before, piece)| {
            let share = piece.segment.share_of(point).clamp(0.0, 1.0);
            let along = before + share * piece.segment.length();
            (along, (piece.segment.point_at(share) - point).norm())
        });
        all.min_by(|one, other| one.1.total_cmp(&other.1))
    }

    /// The segment of the drawing at a place along the ring.
    pub(super) fn source(&self, along: f64) -> Option<(EntityId, usize)> {
        self.pieces.get(self.index(along))?.source
    }
}
