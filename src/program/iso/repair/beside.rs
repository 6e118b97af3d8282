//! The other cuts of a program as evidence: a move that another pass has, too, is hardly wrong.

use crate::program::repair::cut::{FEWEST_WITH_LEADS, Piece};
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

fn shape(piece: &Piece) -> Option<Shape> {
    let curve = piece.curve.filter(|curve| curve.length() > 0.0)?;
    let middle = curve.point_at(0.5) - curve.start();
    Some([piece.by.x, piece.by.y, middle.x, middle.y].map(|um| um.round() as i64))
}

fn backwards(piece: &Piece) -> Option<Shape> {
    let curve = piece.curve.filter(|curve| curve.length() > 0.0)?;
    let middle = curve.point_at(0.5) - curve.end();
    Some([-piece.by.x, -piece.by.y, middle.x, middle.y].map(|um| um.round() as i64))
}

impl Beside {
    /// Those that may be passes of a cut; or itself, where it `holds_own`.
    pub(super) fn of(own: &[Piece], others: &[Vec<Piece>], holds_own: bool) -> Beside {
        let mut beside = Beside {
            holds_own,
            ..Beside::default()
        };
        let is_pass = |other: &&Vec<Piece>| !holds_own && other.len().abs_diff(own.len()) <= 1;
        let passes = others.iter().filter(is_pass).flatten();
        let moves = passes.chain(own.iter().filter(|_| holds_own));
        for shape in moves
            .flat_map(|piece| [shape(piece), backwards(piece)])
            .flatten()
        {
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
        let shapes = pieces.iter().filter_map(shape);
        shapes.filter(|shape| !has(shape)).count()
    }

    /// How many more of some pieces other passes have than of those in whose place they stand.
    pub(super) fn likeness(&self, was: &[Piece], is: &[Piece]) -> i32 {
        if self.counts.is_empty() {
            return 0;
        }
        let more = self.unlike(was, true) as i32 - self.unlike(is, false) as i32;
        more.clamp(-2, 2)
    }
}
