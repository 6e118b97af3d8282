//! The side of the correction along each contour, whoever wrote the program: G41 and G42, or D and DD of 4B.

use super::REACH;
use super::difference::Difference;
use super::drawn::Drawn;
use super::placement::Placement;
use super::rounds::{Rounds, Spot};
use super::traced::Traced;
use super::walk::Kind;
use crate::drawing::EntityId;
use crate::geometry::{Segment, Side};
use crate::settings::Compensation;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// A program that has been laid on its drawing.
pub(super) struct Seen<'a> {
    pub drawn: &'a Drawn,
    pub traced: &'a Traced,
    pub rounds: &'a Rounds,
    pub placement: &'a Placement,
    /// For each block that follows a round, its number, and whether it goes against its direction.
    pub on: &'a [Option<(usize, bool)>],
}

/// The most that are named.
const FEW: usize = 6;
/// The least share of its contour that tells the side of a pass.
const TELLS: f64 = 0.5;

/// The blocks of a pass that follow one contour in one direction under one word.
struct Run {
    blocks: Range<usize>,
    contour: usize,
    back: bool,
    side: Option<Side>,
    share: f64,
}

/// The passes and arcs at which the wire runs on the wrong side, or on none.
pub(super) fn words(seen: &Seen) -> Vec<Difference> {
    let mut found = match seen.traced.four_b {
        true => arcs(seen),
        false => sides(seen),
    };
    found.truncate(FEW);
    found
}

fn sides(seen: &Seen) -> Vec<Difference> {
    let traced = seen.traced;
    let is_offset = traced.blocks.iter().any(|block| block.is_offset());
    let is_asked = seen.drawn.settings.compensation == Compensation::Controller;
    if !is_offset && (!is_asked || traced.counts) {
        return Vec::new();
    }
    let runs = runs(seen);
    let (mut found, mut is_lost) = (Vec::new(), false);
    for run in &runs {
        let Some(meant) = meant(seen, &runs, run) else {
            continue;
        };
        if run.side == Some(meant) || !is_offset && is_lost {
            continue;
        }
        is_lost = true;
        let kind = Kind::Side {
            said: run.side,
            meant: Some(meant),
        };
        let mut one = Difference::of(&traced.blocks[run.blocks.start], None, 0.0, kind);
        // It is switched on before the way in.
        let stretch =
            |at: &usize| traced.blocks[*at].stretch == traced.blocks[run.blocks.start].stretch;
        let first = (0..=run.blocks.start).rev().take_while(stretch).last();
        if run.side.is_some()
            && let Some((range, line)) = first.and_then(|first| traced.switch_before(first))
        {
            (one.range, one.line) = (range, line);
        }
        found.push(one);
    }
    found
}

/// The side on which a run should have the wire: that of the drawing, else that of most passes of its contour, else, where
/// it has none, that of most passes.
fn meant(seen: &Seen, runs: &[Run], run: &Run) -> Option<Side> {
    let turned = |side: Side, back: bool| if back { side.reversed() } else { side };
    let contour = seen.drawn.contours().get(run.contour)?;
    if let Some(side) = contour.side {
        return Some(turned(side, run.back));
    }
    let vote = |is_of: &dyn Fn(&Run) -> bool| {
        let votes = runs.iter().filter(|other| is_of(other));
        let votes = votes.filter_map(|other| Some((turned(other.side?, other.back), other.share)));
        let sum: f64 = votes.map(|(side, share)| side.sign() * share).sum();
        (sum.abs() > 1e-6)
            .then(|| turned(if sum > 0.0 { Side::Left } else { Side::Right }, run.back))
    };
    let own = vote(&|other| other.contour == run.contour);
    match run.side {
        Some(_) => own,
        None => own.or_else(|| vote(&|_| true)),
    }
}

fn runs(seen: &Seen) -> Vec<Run> {
    let blocks = &seen.traced.blocks;
    let mut runs: Vec<Run> = Vec::new();
    for (index, (block, on)) in blocks.iter().zip(seen.on).enumerate() {
        let (Some((round, back)), Some(segment)) = (*on, block.segment()) else {
            continue;
        };
        let round = &seen.rounds.rounds[round];
        if !round.closed {
            continue;
        }
        let share = segment.length() / round.length;
        let is_on = |run: &&mut Run| {
            run.blocks.end == index
                && (run.contour, run.back) == (round.contour, back)
                && blocks[run.blocks.start].stretch == block.stretch
        };
        match runs.last_mut().filter(is_on) {
            Some(run) => (run.blocks.end, run.share) = (index + 1, run.share + share),
            None => runs.push(Run {
                blocks: index..index + 1,
                contour: round.contour,
                back,
                side: block.side,
                share,
            }),
        }
    }
    runs.retain(|run| run.share >= TELLS);
    runs
}

/// The arcs of 4B that have the wire on the other side than their contour; of several in sequence the first.
fn arcs(seen: &Seen) -> Vec<Difference> {
    let blocks = &seen.traced.blocks;
    // For each arc its contour, and whether it tells of the left side of the contour's direction.
    let tells = |index: usize| {
        let (round, back) = (*seen.on.get(index)?)?;
        let arc = blocks[index].segment()?.as_arc()?;
        let concave = seen.traced.said(&blocks[index]).concave?;
        let contour = seen.rounds.rounds[round].contour;
        Some((contour, ((arc.sweep > 0.0) == concave) != back, round))
    };
    let all: Vec<Option<(usize, bool, usize)>> = (0..blocks.len()).map(tells).collect();
    let mut votes: FxHashMap<usize, i64> = FxHashMap::default();
    for (contour, is_left, _) in all.iter().flatten() {
        *votes.entry(*contour).or_default() += if *is_left { 1 } else { -1 };
    }
    let is_left = |contour: usize| match seen.drawn.contours().get(contour)?.side {
        Some(side) => Some(side == Side::Left),
        None => Some(votes[&contour] > 0).filter(|_| votes[&contour] != 0),
    };
    let (mut found, mut last) = (Vec::new(), None);
    for (index, told) in all.iter().enumerate() {
        let Some((contour, said, round)) = *told else {
            continue;
        };
        let is_wrong = is_left(contour).is_some_and(|meant| meant != said);
        if is_wrong && last != Some(contour) {
            let concave = seen.traced.said(&blocks[index]).concave;
            let kind = Kind::Turned {
                meant: concave == Some(false),
            };
            let back = seen.on[index].is_some_and(|(_, back)| back);
            let segment = seen.segment_at(round, back, blocks[index].segment());
            found.push(Difference::of(&blocks[index], segment, 0.0, kind));
        }
        last = is_wrong.then_some(contour);
    }
    found
}

impl Seen<'_> {
    /// The segment of the drawing that a block on a round follows.
    fn segment_at(
        &self,
        round: usize,
        back: bool,
        own: Option<&Segment>,
    ) -> Option<(EntityId, usize)> {
        let at = self.placement.place(own?.point_at(0.5));
        let near = self.rounds.near(at, 2.0 * REACH);
        let is_on = |spot: &&Spot| (spot.round, spot.back) == (round, back);
        self.rounds.piece(near.iter().find(is_on)?).source
    }
}
