//! Moves of a program in any language: as they are, and as a refactoring wants them.
//!
//! A refactoring changes a list of moves. A language [prints](Printer::print) each that is changed in the place of an
//! existing block and in its manner: layout, comment, number of decimals.

use super::transform::Transform;
use crate::finding::Side;
use crate::geometry::{Arc, Point, Segment, equally_far};
use crate::program::encode::{ASIDE_TOLERANCE, aside};
use crate::program::three_b::block::PartArc;
use crate::text::TextEdit;
use std::ops::Range;

/// The edits, sorted and disjoint, or why it cannot be done: in lower case without a full stop.
pub(in crate::program) type Edits = Result<Vec<TextEdit>, String>;

/// mm.
pub(in crate::program) const INCH: f64 = 25.4;

/// A place in nm, which are whole in every language.
pub(in crate::program) type Place = [i64; 2];

/// Where a place lies, µm.
pub(in crate::program) fn point(place: Place) -> Point {
    Point::from(place.map(|nm| nm as f64 / 1e3))
}

/// The place nearest to a point in µm; `None` beyond what a program can address exactly.
pub(in crate::program) fn place(point: Point) -> Option<Place> {
    const FARTHEST: f64 = 1e15;
    let nm = [point.x, point.y].map(|um| (um * 1e3).round());
    let is_near = nm.iter().all(|nm| nm.abs() <= FARTHEST);
    is_near.then_some(nm.map(|nm| nm as i64))
}

/// The numbers of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::program) enum Numbers {
    /// Those of its block, mirrored or turned.
    Turned(Transform),
    /// Those of its block, the other way round.
    Reversed,
    /// Calculated anew.
    Fitted,
}

/// A move, with the block that it is, or in whose manner it is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::program) struct Move {
    /// The index of that block among all that move, and its line.
    pub(crate) like: usize,
    pub(crate) line: usize,
    /// Contours close exactly: the drift of a counting control is taken back.
    pub(crate) from: Place,
    pub(crate) to: Place,
    /// Its curve, from `from`, µm.
    pub(crate) piece: Segment,
    pub(crate) side: Option<Side>,
    pub(crate) is_rapid: bool,
    pub(crate) numbers: Numbers,
    /// The radius that a block of 4B states.
    pub(crate) part: Option<PartArc>,
    /// It says how far it leads, not where it ends: a control that counts ends beside that.
    pub(crate) counts: bool,
}

impl Move {
    pub(crate) fn is_arc(&self) -> bool {
        self.piece.as_arc().is_some()
    }

    pub(crate) fn reversed(self) -> Move {
        let piece = self.piece.reversed();
        Move {
            numbers: Numbers::Reversed,
            piece: self.between(&piece, [self.to, self.from]),
            from: self.to,
            to: self.from,
            ..self
        }
    }

    /// A straight cut in its place.
    pub(crate) fn straight(self, [from, to]: [Place; 2]) -> Move {
        self.fitted(&Segment::line(point(from), point(to)), [from, to])
    }

    /// Another curve in its place.
    pub(crate) fn fitted(self, piece: &Segment, [from, to]: [Place; 2]) -> Move {
        Move {
            numbers: Numbers::Fitted,
            piece: self.between(piece, [from, to]),
            from,
            to,
            part: None,
            ..self
        }
    }

    pub(crate) fn transformed(self, transform: Transform) -> Move {
        let turned = |side: Side| match transform.mirrors() {
            true => side.reversed(),
            false => side,
        };
        Move {
            numbers: Numbers::Turned(transform),
            piece: transform.of_segment(&self.piece),
            from: transform.of_place(self.from),
            to: transform.of_place(self.to),
            side: self.side.map(turned),
            ..self
        }
    }

    /// A piece between its places. An arc keeps its direction, and its centre where the ends are stated. Else the centre
    /// moves to the nearest place equally far from both ends, because snapping, scaling or removing drift has moved
    /// these by as much. Where that would lead elsewhere, as about two places of nearly a full circle, the arc stays as
    /// it is.
    fn between(&self, piece: &Segment, ends: [Place; 2]) -> Segment {
        let [start, end] = ends.map(point);
        let Segment::Arc(arc) = piece else {
            return Segment::line(start, end);
        };
        let about = |center: Point| Segment::Arc(Arc::about(center, start, end, arc.sweep > 0.0));
        if !self.counts {
            return about(arc.center);
        }
        let Some(center) = equally_far(arc.center, start, end) else {
            return *piece;
        };
        let fitted = about(center);
        let moved = (start - arc.start).norm().max((end - arc.end).norm());
        match aside(&fitted, piece) <= ASIDE_TOLERANCE + moved {
            true => fitted,
            false => *piece,
        }
    }
}

/// What becomes of a program.
pub(in crate::program) struct Rewrite {
    /// What stands in the place of each move; its line goes where that is nothing.
    pub(crate) moves: Vec<Option<Move>>,
    /// Words beside the moves.
    pub(crate) words: Vec<TextEdit>,
    /// The new start of the program, if it changes.
    pub(crate) start: Option<Place>,
    /// The new end of the program, µm, if it changes.
    pub(crate) end: Option<Point>,
    /// How much longer the contours become; `None` where that is not known.
    pub(crate) factor: Option<f64>,
}

/// A change by which words beside the moves would become wrong.
pub(in crate::program) enum Change<'a> {
    /// Contours are cut the other way: the lines from behind the move before each to its last, and whether the control
    /// offsets it.
    Reverse(&'a [(Range<usize>, bool)]),
    StartHere {
        /// Those of the contour.
        lines: Range<usize>,
        /// It then begins at a corner, and not within a straight edge or where it is tangent.
        is_corner: bool,
        /// A way in leads to the start, from where the contour then goes on in another direction.
        is_led_elsewhere: bool,
    },
    Scale(f64),
    Turn(Transform),
}

/// The new text: the edits, sorted and disjoint, and of each move how many blocks stand in its place.
pub(in crate::program) struct Printed {
    pub(crate) edits: Vec<TextEdit>,
    pub(crate) blocks: Vec<usize>,
}

/// A program in its language.
pub(in crate::program) trait Printer {
    /// Blocks that move.
    fn count(&self) -> usize;

    /// The radius that a block states beside its move.
    fn part(&self, _: usize) -> Option<PartArc> {
        None
    }

    /// Whether a block does nothing but go on from the one before in its manner.
    fn goes_on(&self, block: usize) -> bool;

    /// A step of the numbers of a block, nm.
    fn step(&self, block: usize) -> i64;

    /// The longest straight cut, nm.
    fn longest(&self) -> i64 {
        i64::MAX
    }

    /// Lengths are written in inches, so inches need no scaling.
    fn is_in_inches(&self) -> bool {
        false
    }

    /// The edits of words that follow a change; an error where one would become wrong.
    fn words(&self, change: &Change<'_>) -> Edits;

    /// The text of the new moves, in the places of these.
    fn print(&self, moves: &[Move], rewrite: &Rewrite) -> Result<Printed, String>;
}
