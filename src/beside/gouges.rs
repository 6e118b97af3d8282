//! Ways in and out that run into the part.

use super::alongside::Seen;
use super::difference::Difference;
use super::rounds::Round;
use super::walk::Kind;
use crate::geometry::{Point, Segment, Side, left_normal};

/// A way may run this far into the part by rounding, µm.
const LEAST: f64 = 5.0;
/// The most pieces of rounds that are looked at.
const MOST: usize = 400_000;
/// Distances from two pieces that meet are alike within this, µm.
const SAME: f64 = 1e-6;

/// The first block of each cut that leads from the wire's side of its contour into the part.
pub(super) fn gouges(seen: &Seen) -> Vec<Difference> {
    let (mut found, mut fuel) = (Vec::new(), MOST);
    for [all, _] in &seen.traced.cuts {
        let rounds = all
            .clone()
            .filter_map(|index| Some((*seen.on.get(index)?)?.0));
        let mut rounds: Vec<usize> = rounds.collect();
        rounds.sort_unstable();
        rounds.dedup();
        let Some(contour) = rounds
            .first()
            .map(|round| seen.rounds.rounds[*round].contour)
        else {
            continue;
        };
        let rounds: Vec<&Round> = rounds
            .iter()
            .map(|round| &seen.rounds.rounds[*round])
            .collect();
        let is_one = rounds
            .iter()
            .all(|round| round.contour == contour && round.closed);
        let side = seen
            .drawn
            .contours()
            .get(contour)
            .and_then(|contour| contour.side);
        let (Some(side), true) = (side, is_one && !seen.traced.four_b) else {
            continue;
        };
        let mut into = |place: Point| {
            let pieces: usize = rounds.iter().map(|round| round.pieces.len()).sum();
            fuel = fuel.checked_sub(pieces)?;
            let place = seen.placement.place(place);
            let all = rounds.iter().map(|round| within(round, side, place));
            Some(all.fold(f64::INFINITY, f64::min))
        };
        let is_aside = |index: usize| seen.on[index].is_none();
        let first = all
            .clone()
            .find_map(|index| seen.traced.blocks[index].segment());
        // A hole in the part is where somebody wants it.
        let Some(true) = first.and_then(|first| Some(into(first.start())? <= LEAST)) else {
            continue;
        };
        let deepest = |segment: &Segment, into: &mut dyn FnMut(Point) -> Option<f64>| {
            let shares = [0.5, 1.0].map(|share| segment.point_at(share));
            let [middle, end] = shares.map(&mut *into);
            Some(middle?.max(end?))
        };
        for index in all.clone().filter(|index| is_aside(*index)) {
            let Some(segment) = seen.traced.blocks[index].segment() else {
                continue;
            };
            if let Some(off) = deepest(segment, &mut into).filter(|off| *off > LEAST) {
                let block = &seen.traced.blocks[index];
                found.push(Difference::of(block, None, off, Kind::Inside));
                break;
            }
        }
    }
    found
}

/// How far a place lies from a round on the side of the part, µm; negative on the side of the wire.
fn within(round: &Round, side: Side, place: Point) -> f64 {
    let (mut nearest, mut aside) = (f64::INFINITY, 0.0_f64);
    for piece in &round.pieces {
        let own = &piece.segment;
        let away = own.distance_to(place);
        if away > nearest + SAME {
            continue;
        }
        let share = own.share_of(place).clamp(0.0, 1.0);
        let left = left_normal(own.tangent_at(share)).dot(&(place - own.point_at(share)));
        if away < nearest - SAME || left.abs() > aside.abs() {
            (nearest, aside) = (away.min(nearest), left);
        }
    }
    match aside * side.sign() < 0.0 {
        true => nearest,
        false => -nearest,
    }
}
