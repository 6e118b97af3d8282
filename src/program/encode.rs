//! From a line or arc of the path to blocks between nodes of the grid: every language cuts it into pieces in the same
//! way.

use super::grid::{MOST_PIECES, Node, chord_count, in_pieces, largest_distance, sagitta, snap};
use super::write::{Piece, ProofError, Proved, too_many_blocks};
use crate::geometry::{Arc, Segment};
use crate::toolpath::each;
use std::f64::consts::PI;

/// The largest distance of a block from its piece of the path, anywhere, µm: centres are on the grid, ends are snapped.
pub(super) const ASIDE_TOLERANCE: f64 = 2.5;

/// The largest sagitta of a chord that replaces a piece of an arc too large for a language, µm.
const CHORD_SAGITTA: f64 = 0.5;

/// How a language can write an arc.
pub(super) enum Attempt<B> {
    Made(B),
    /// Only in this many pieces of one length.
    Pieces(i64),
    /// Only as straight cuts: its numbers do not fit.
    Chords,
    /// Not within tolerance.
    Misses,
}

/// The writer of one language for a piece of the path. Nodes and pieces are in steps of its grid.
pub(super) trait Encoder {
    type Block;

    /// A step of the grid, µm.
    fn step(&self) -> f64;
    /// The straight cuts for this many steps.
    fn lines(&self, longest: i64) -> i64;
    /// An arc of a larger radius, in steps, is written as chords.
    fn largest_radius(&self) -> f64;
    fn line(&self, piece: Segment, from: Node, to: Node) -> Self::Block;
    fn arc(&self, arc: &Arc, from: Node, to: Node, full_turn: bool) -> Attempt<Self::Block>;

    /// Appends the blocks of `piece` between its snapped ends; nothing for a piece without length on the grid, such as
    /// an arc of radius zero. `None` where no arc within tolerance can be written, or a number does not fit.
    fn encode(
        &self,
        piece: &Segment,
        from: Node,
        to: Node,
        blocks: &mut Vec<Self::Block>,
    ) -> Option<()> {
        encode(self, piece, from, to, 0, blocks)
    }
}

/// Pieces of which one core takes the blocks at a time.
const AT_A_TIME: usize = 64;

/// Blocks, each with the number of its piece, as many in a list as one core takes at a time.
pub(super) type Numbered<B> = Vec<Vec<(usize, B)>>;

/// The blocks of pieces. Refused where they take more than `most` straight cuts; `misses` says that no block leads along
/// a piece.
pub(super) fn encode_all<E>(
    encoder: &E,
    pieces: &[Piece],
    most: usize,
    misses: impl Fn(&Piece) -> String + Sync,
) -> Proved<Numbered<E::Block>>
where
    E: Encoder + Sync,
    E::Block: Send,
{
    let mut left = most;
    for piece in pieces {
        let count = count_of(encoder, piece);
        let rest = count.and_then(|count| left.checked_sub(count));
        left = rest.ok_or_else(too_many_blocks)?;
    }
    let of = |chunk: usize| {
        let (mut made, mut own) = (Vec::with_capacity(2 * AT_A_TIME), Vec::new());
        let first = chunk * AT_A_TIME;
        for (nth, piece) in pieces.iter().enumerate().skip(first).take(AT_A_TIME) {
            encoder
                .encode(&piece.segment, piece.from, piece.to, &mut own)
                .ok_or_else(|| ProofError::Mismatch(misses(piece)))?;
            made.extend(own.drain(..).map(|block| (nth, block)));
        }
        Ok(made)
    };
    each(pieces.len().div_ceil(AT_A_TIME), 2, of)
        .into_iter()
        .collect()
}

/// The straight cuts of a piece: an arc that fits into a block is none. `None` beyond [`MOST_PIECES`].
fn count_of<E: Encoder>(encoder: &E, piece: &Piece) -> Option<usize> {
    let count = match &piece.segment {
        Segment::Line(_) => straight_cuts(encoder, steps_between(piece.from, piece.to))?,
        Segment::Arc(arc) if arc.radius > encoder.largest_radius() => {
            chord_count(arc, CHORD_SAGITTA / encoder.step())?
        }
        Segment::Arc(_) => 0,
    };
    usize::try_from(count).ok()
}

/// The straight cuts for this many steps; `None` beyond [`MOST_PIECES`].
fn straight_cuts<E: Encoder + ?Sized>(encoder: &E, longest: i64) -> Option<i64> {
    Some(encoder.lines(longest)).filter(|count| *count <= MOST_PIECES)
}

/// The steps along the axis on which two nodes are farther apart.
fn steps_between(from: Node, to: Node) -> i64 {
    (to.x - from.x).abs().max((to.y - from.y).abs())
}

fn encode<E: Encoder + ?Sized>(
    encoder: &E,
    piece: &Segment,
    from: Node,
    to: Node,
    depth: u32,
    blocks: &mut Vec<E::Block>,
) -> Option<()> {
    let Segment::Arc(arc) = piece else {
        return straight(encoder, piece, from, to, blocks);
    };
    let full_turn = from == to && arc.sweep.abs() > PI;
    if from == to && (!full_turn || arc.radius < 0.5) {
        return Some(());
    }
    match encoder.arc(arc, from, to, full_turn) {
        Attempt::Made(block) => blocks.push(block),
        Attempt::Pieces(count) => in_pieces(piece, from, to, count, |piece, from, to| {
            encode(encoder, &piece, from, to, 0, blocks)
        })?,
        Attempt::Chords => {
            let count = chord_count(arc, CHORD_SAGITTA / encoder.step())?;
            in_pieces(piece, from, to, count, |piece, from, to| {
                straight(encoder, &piece, from, to, blocks)
            })?;
        }
        // A chord of an arc this flat is as near to it as the grid is.
        Attempt::Misses if sagitta(arc) * encoder.step() <= 2.0 * CHORD_SAGITTA => {
            straight(encoder, piece, from, to, blocks)?;
        }
        Attempt::Misses if depth < 8 => {
            let middle = snap(arc.point_at(0.5))?;
            for (share, from, to) in [(0.0, from, middle), (0.5, middle, to)] {
                let half = piece.part(share, share + 0.5);
                encode(encoder, &half, from, to, depth + 1, blocks)?;
            }
        }
        Attempt::Misses => return None,
    }
    Some(())
}

/// Straight cuts, for an arc too.
fn straight<E: Encoder + ?Sized>(
    encoder: &E,
    piece: &Segment,
    from: Node,
    to: Node,
    blocks: &mut Vec<E::Block>,
) -> Option<()> {
    let longest = steps_between(from, to);
    if longest == 0 {
        return Some(());
    }
    let count = straight_cuts(encoder, longest)?;
    in_pieces(piece, from, to, count, |piece, from, to| {
        blocks.push(encoder.line(piece, from, to));
        Some(())
    })
}

/// The largest distance of a written line or arc from its piece, µm; as an error, that of the two middles counted in,
/// where one of these is above the tolerance by more than `slack`, or unknown.
pub(super) fn proved_aside(written: &Segment, piece: &Segment, slack: f64) -> Result<f64, f64> {
    let middles = (written.point_at(0.5) - piece.point_at(0.5)).norm();
    let aside = largest_distance(written, piece);
    let worst = aside.max(middles);
    let is_beside = worst > ASIDE_TOLERANCE + slack || aside.is_nan() || middles.is_nan();
    if is_beside { Err(worst) } else { Ok(aside) }
}

/// The largest distance of a written line or arc from its piece, and of the two middles; infinite where it is unknown.
pub(super) fn aside(written: &Segment, piece: &Segment) -> f64 {
    let middles = (written.point_at(0.5) - piece.point_at(0.5)).norm();
    match middles.is_nan() {
        true => f64::INFINITY,
        false => largest_distance(written, piece).max(middles),
    }
}
