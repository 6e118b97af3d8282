//! The other cuts of a program as evidence: a move that another pass has, too, is hardly wrong.

use super::cut::{Changed, FEWEST_WITH_LEADS, Piece, Pieces};
use crate::geometry::{Point, Vector};
use std::collections::BTreeMap;

/// From its start to its end and its middle, µm.
type Shape = [i64; 4];

/// The moves of the other passes of a cut, in either direction.
#[derive(Debug, Default)]
pub(super) struct Beside {
    counts: BTreeMap<Shape, usize>,
    /// The moves of the cut itself are among them: its passes have no stop between them.
    holds_own: bool,
}

/// The shape of a piece, and that of the way back along it.
fn shapes(piece: &Piece) -> Option<[Shape; 2]> {
    let curve = piece.curve.filter(|curve| curve.length() > 0.0)?;
    let shape = |by: Vector, start: Point| {
        let middle = curve.point_at(0.5) - start;
        [by.x, by.y, middle.x, middle.y].map(|um| um.round() as i64)
    };
    Some([
        shape(piece.by, curve.start()),
        shape(-piece.by, curve.end()),
    ])
}

/// Which way a piece begins, and how it turns: a pass that lies aside of another one is like it in these.
fn turning(piece: &Piece) -> Option<[i8; 3]> {
    let curve = piece.curve?;
    let sign = |value: f64| match value.abs() < 1e-9 {
        true => 0,
        false => value.signum() as i8,
    };
    let begin = curve.start_tangent();
    let sweep = curve.as_arc().map_or(0.0, |arc| arc.sweep);
    Some([sign(begin.x), sign(begin.y), sign(sweep)])
}

impl Beside {
    /// Those that may be passes of a cut; or itself, where it holds several.
    pub(super) fn of(pieces: &Pieces) -> Beside {
        let (own, holds_own) = (&pieces.all, pieces.holds_passes);
        let mut beside = Beside {
            holds_own,
            ..Beside::default()
        };
        let is_pass = |other: &&Vec<Piece>| !holds_own && other.len().abs_diff(own.len()) <= 1;
        let passes = pieces.others.iter().filter(is_pass).flatten();
        let moves = passes.chain(own.iter().filter(|_| holds_own));
        for shape in moves.filter_map(shapes).flatten() {
            *beside.counts.entry(shape).or_default() += 1;
        }
        // Nearly all of it is as in another pass.
        let unlike = beside.unlike(own, true);
        if own.len() < FEWEST_WITH_LEADS || 4 * unlike > own.len() || unlike == 0 {
            beside.counts.clear();
        }
        beside
    }

    /// How many pieces no other pass has; one that stands in the text is not its own witness.
    fn unlike(&self, pieces: &[Piece], stands: bool) -> usize {
        let least = usize::from(self.holds_own && stands);
        let has = |shape: &Shape| self.counts.get(shape).is_some_and(|count| *count > least);
        let shapes = pieces.iter().filter_map(shapes);
        shapes.filter(|[shape, _]| !has(shape)).count()
    }

    /// How much of some pieces other passes have, more than of those in whose place they stand.
    pub(super) fn likeness(&self, pieces: &Pieces, with: &Changed<'_>) -> i32 {
        let (was, is) = (with.replaced(), with.by);
        let more = match self.counts.is_empty() {
            true => 0,
            false => self.unlike(was, true) as i32 - self.unlike(is, false) as i32,
        };
        let turns = || with.iter().map(turning);
        let length = turns().count();
        let is_alike = |other: &Vec<Piece>| {
            other.len() == length && length > 1 && other.iter().map(turning).eq(turns())
        };
        more.clamp(-2, 2) + i32::from(pieces.others.iter().any(is_alike))
    }
}
