//! What a program would be if one of its blocks were otherwise: longer, another arc, not twice, not lost, or exchanged
//! with the next.

use super::members::{Members, numbers_apart};
use super::placement::{Placement, stretch};
use super::rounds::{Rounds, Spot};
use super::traced::{Block, Motion, Traced};
use super::{REACH, TOLERANCE};
use crate::drawing::EntityId;
use crate::geometry::{Arc, Point, Segment, Vector};
use std::f64::consts::TAU;

/// The most pieces that one block may stand for, and how far apart they may lie as one line or arc, µm.
const TOGETHER: usize = 5;
const SAME: f64 = 1e-2;
/// A smaller deviation is no change, µm.
const LEAST: f64 = 1.4;
/// A place nearer to a node is that node, µm.
const NODE: f64 = 1.6;
/// A way in that ends this near to its contour is meant to end there, µm.
const BESIDE: f64 = 500.0;

/// One block that is otherwise.
#[derive(Clone, Debug)]
pub(super) struct Edit {
    change: Change,
    /// Its number, or that of the block before which one is lost.
    pub index: usize,
    pub source: Option<(EntityId, usize)>,
    /// By how much everything after it moves, where that is counted from there.
    pub by: Vector,
    /// How far the block is off, µm.
    pub off: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Change {
    Doubled,
    Exchanged,
    Lost(Segment, How),
    Otherwise(Segment, How),
}

/// What a block may be otherwise, where the program up to it is known.
pub(super) fn edits(
    traced: &Traced,
    rounds: &Rounds,
    members: &Members,
    index: usize,
) -> Vec<Edit> {
    let placement = &members.placement;
    let Some(&own) = traced.blocks[index].segment() else {
        return Vec::new();
    };
    let mut all: Vec<Edit> = Vec::new();
    let mut add = |edit: Edit| {
        let is_same = |other: &Edit| {
            (other.by - edit.by).amax() < SAME
                && (other.off - edit.off).abs() < SAME
                && std::mem::discriminant(&other.change) == std::mem::discriminant(&edit.change)
                && other.change.how() == edit.change.how()
        };
        if !all.iter().any(is_same) {
            all.push(edit);
        }
    };
    let near = |point: Point, reach: f64| rounds.near(placement.place(point), reach);
    let alone = |spot: Spot| (spot, spot);
    let goes_on = members.spot.zip(members.entry);
    let begun = near(own.start(), 2.0 * REACH).into_iter().map(alone);
    let begun: Vec<_> = goes_on.into_iter().chain(begun).collect();
    // What comes before a place from which the rest follows.
    let ending = |point: Point| {
        let all = near(point, 2.0 * REACH).into_iter();
        let all = all.filter(|spot| rounds.is_begin(spot));
        all.filter_map(|spot| rounds.before(&spot)).map(alone)
    };
    let source_of = |spot: &Spot| rounds.piece(spot).source;
    let of = |change: Change, spot: Option<&Spot>, by: Vector, off: f64| Edit {
        change,
        index,
        source: spot.and_then(source_of),
        by,
        off,
    };
    let first = begun.first().map(|(spot, _)| spot);
    let before = index.checked_sub(1).map(|before| &traced.blocks[before]);
    if before.is_some_and(|before| is_again(traced, before, &traced.blocks[index])) {
        let by = own.start() - own.end();
        let length = before.and_then(Block::segment).map_or(0.0, Segment::length);
        add(of(Change::Doubled, first, by, length));
    }
    if let Some(next) = traced.blocks.get(index + 1).and_then(Block::segment) {
        let off = ((next.end() - next.start()) - (own.end() - own.start())).norm();
        if off > REACH {
            add(of(Change::Exchanged, first, Vector::zeros(), off));
        }
    }
    let hows = How::of(traced);
    for (spot, entry) in begun.iter().copied().chain(ending(own.start())) {
        let (lost, _) = stretch(rounds, &spot, &entry);
        let (by, off) = (lost.end() - lost.start(), lost.length());
        for &how in hows.iter().take(2) {
            // What it leaves nothing of is not lost before it.
            let is_all = how != How::Relative && (own.start() + by - own.end()).norm() <= REACH;
            if !is_all {
                add(of(Change::Lost(lost, how), Some(&spot), by, off));
            }
        }
    }
    for (spot, entry) in begun.iter().copied().chain(ending(own.end())) {
        let all = stretches(rounds, spot, &entry);
        // To the end of a piece, or to where a tab begins.
        let end = placement.place(own.end());
        let part = all.last().and_then(|rest| {
            let share = rest.share_of(end);
            (share > 0.0 && share < 1.0).then(|| rest.part(0.0, share))
        });
        for meant in all.into_iter().chain(part) {
            if let Some((meant, by, off)) = meant_by(&meant, traced, index, placement) {
                // Nor does a block stand for the next one as well.
                let next = traced.blocks.get(index + 1).and_then(Block::segment);
                let ends_there = |next: &Segment| (next.end() - own.end() - by).norm() <= BESIDE;
                let is_of_both = by.norm() > 2.0 * BESIDE && next.is_some_and(ends_there);
                let likely = hows
                    .iter()
                    .filter(|how| **how == How::Relative || !is_of_both);
                for &how in likely {
                    add(of(Change::Otherwise(meant, how), Some(&spot), by, off));
                }
            }
        }
    }
    // A way in that ends beside its contour.
    if goes_on.is_none() && own.as_arc().is_none() {
        let next = traced.blocks.get(index + 1).and_then(Block::segment);
        for spot in near(own.end(), BESIDE) {
            let by = match (next.and_then(Segment::as_arc), rounds.whole(&spot).as_arc()) {
                (Some(next), Some(piece)) => piece.center - placement.place(next.center),
                _ => spot.at - placement.place(own.end()),
            };
            if !(LEAST..=BESIDE).contains(&by.norm()) {
                continue;
            }
            let meant = Segment::line(own.start(), own.end() + by);
            for &how in hows {
                add(of(
                    Change::Otherwise(meant, how),
                    Some(&spot),
                    by,
                    by.norm(),
                ));
            }
        }
    }
    all
}

impl Change {
    fn how(&self) -> Option<How> {
        match self {
            Change::Lost(_, how) | Change::Otherwise(_, how) => Some(*how),
            Change::Doubled | Change::Exchanged => None,
        }
    }
}

impl Edit {
    /// The number of the block that is named, in the program with the edit.
    pub(super) fn named(&self) -> usize {
        match self.change {
            Change::Doubled => self.index - 1,
            _ => self.index,
        }
    }

    /// The program with the block as it may be meant.
    pub(super) fn of(&self, traced: &Traced) -> Traced {
        let mut edited = traced.clone();
        let index = self.index;
        let Some(&own) = traced.blocks[index].segment() else {
            return edited;
        };
        match self.change {
            Change::Doubled => {
                edited.blocks.remove(index);
                shift_cuts(&mut edited, index, -1);
                move_on(&mut edited.blocks[index..], self.by);
            }
            Change::Exchanged => {
                if let Some(next) = traced.blocks.get(index + 1).and_then(Block::segment) {
                    let first = next.moved(own.start() - next.start());
                    let second = own.moved(first.end() - own.start());
                    edited.blocks[index].motion = Motion::Cut(first);
                    edited.blocks[index + 1].motion = Motion::Cut(second);
                }
            }
            Change::Lost(lost, how) => {
                let lost = lost.moved(own.start() - lost.start());
                let block = Block {
                    motion: Motion::Cut(lost),
                    ..edited.blocks[index].clone()
                };
                edited.blocks.insert(index, block);
                shift_cuts(&mut edited, index, 1);
                go_on(traced, &mut edited.blocks[index + 1..], self.by, how);
            }
            Change::Otherwise(meant, how) => {
                edited.blocks[index].motion = Motion::Cut(meant);
                go_on(traced, &mut edited.blocks[index + 1..], self.by, how);
            }
        }
        edited
    }
}

/// A block says the same as the one before it.
fn is_again(traced: &Traced, before: &Block, own: &Block) -> bool {
    before.segment().is_some()
        && own.segment().is_some()
        && traced.said(own).is_like(&traced.said(before))
}

/// The possible meanings of a block from a spot on: the rest of its piece, and more where that continues as one line or
/// arc.
fn stretches(rounds: &Rounds, spot: Spot, entry: &Spot) -> Vec<Segment> {
    let (mut rest, mut next) = stretch(rounds, &spot, entry);
    let mut all = vec![rest];
    while let Some(further) = next.filter(|_| all.len() < TOGETHER) {
        let (piece, behind) = stretch(rounds, &further, entry);
        let Some(both) = joined(&rest, &piece) else {
            break;
        };
        (rest, next) = (both, behind);
        all.push(rest);
    }
    all
}

/// Two pieces as one line or arc.
fn joined(first: &Segment, second: &Segment) -> Option<Segment> {
    match (first, second) {
        (Segment::Line(first), Segment::Line(second)) => {
            let both = Segment::line(first.start, second.end);
            (both.distance_to(first.end) < SAME).then_some(both)
        }
        (Segment::Arc(first), Segment::Arc(second)) => {
            let sweep = first.sweep + second.sweep;
            let is_same = (first.center - second.center).norm() < SAME
                && first.sweep * second.sweep > 0.0
                && sweep.abs() <= TAU + 1e-9;
            is_same.then_some(Segment::Arc(Arc {
                sweep,
                end: second.end,
                ..*first
            }))
        }
        _ => None,
    }
}

/// A stretch of the drawing that replaces a block, by how much its end moves, and how far the block is off.
fn meant_by(
    stretch: &Segment,
    traced: &Traced,
    index: usize,
    placement: &Placement,
) -> Option<(Segment, Vector, f64)> {
    let block = &traced.blocks[index];
    let (own, is_lost) = (block.segment()?, block.is_lost);
    // In a program that counts from block to block, a change moves either what lies after it or, seen from there, what
    // lies before it.
    let aside = own.start() - placement.program(stretch.start());
    let aside = if aside.norm() > NODE {
        aside
    } else {
        Vector::zeros()
    };
    let end = placement.program(stretch.end()) + aside;
    let by = end - own.end();
    // A whole turn that ends a little beside its start may be next to none.
    let turn = stretch.as_arc().filter(|arc| arc.is_full_turn());
    let turn = turn.map_or(0.0, |_| stretch.length());
    let longer = (stretch.length() - own.length()).abs();
    let is_alike = is_lost
        || block.by_radius && turns_like(own, stretch)
        || stretch.as_arc().is_some() == own.as_arc().is_some()
            && longer.min((longer - turn).abs()) <= 2.0 * by.norm() + TOLERANCE;
    let meant = match stretch.moved(end - stretch.end()) {
        Segment::Line(_) => Segment::line(own.start(), end),
        arc => arc,
    };
    let manner = (traced.counts, block.by_radius);
    let apart = match is_lost {
        true => traced.center_apart(block, &meant.moved(own.start() - meant.start())),
        false => numbers_apart(own, &meant, manner),
    };
    let off = by.norm().max(apart);
    (is_alike && off >= LEAST).then_some((meant, by, off))
}

/// Two arcs that go round in the same sense.
fn turns_like(one: &Segment, other: &Segment) -> bool {
    let sweeps = one.as_arc().zip(other.as_arc());
    sweeps.is_some_and(|(one, other)| one.sweep * other.sweep > 0.0)
}

/// Cuts of a program that has a block more or less.
fn shift_cuts(traced: &mut Traced, from: usize, by: isize) {
    let shifted = |at: &mut usize, is_behind: bool| {
        if is_behind {
            *at = at.saturating_add_signed(by);
        }
    };
    for range in traced.cuts.iter_mut().flatten() {
        let (behind, ends) = (range.start > from, range.end > from);
        shifted(&mut range.start, behind);
        shifted(&mut range.end, ends);
    }
}

/// Moves blocks.
fn move_on(blocks: &mut [Block], by: Vector) {
    for block in blocks {
        match &mut block.motion {
            Motion::Cut(segment) => *segment = segment.moved(by),
            Motion::Way(start, _) => *start += by,
            Motion::Stop => {}
        }
    }
}

/// How the blocks after a changed end continue.
#[derive(Clone, Copy, Debug, PartialEq)]
enum How {
    /// Counted from there: it is moved.
    Relative,
    /// Where it was; an arc about the place that is counted from its start, or about where it was.
    AbsoluteFrom,
    Absolute,
    /// The same where each coordinate holds until another one is said.
    Held,
}

impl How {
    const ALL: [How; 4] = [How::Relative, How::AbsoluteFrom, How::Absolute, How::Held];

    /// A machine that counts goes on from wherever it is.
    fn of(traced: &Traced) -> &'static [How] {
        if traced.counts {
            &How::ALL[..1]
        } else {
            &How::ALL
        }
    }
}

/// Lets blocks go on after one whose end has moved.
fn go_on(traced: &Traced, behind: &mut [Block], by: Vector, how: How) {
    match how {
        How::Relative => move_on(behind, by),
        How::Held => hold(traced, behind, by),
        How::AbsoluteFrom | How::Absolute => {
            let next = behind.iter_mut().find(|block| block.segment().is_some());
            if let Some(next) = next
                && let Some(own) = next.segment()
            {
                let center_by = if how == How::Absolute {
                    Vector::zeros()
                } else {
                    by
                };
                let ends = [own.start() + by, own.end()];
                next.motion = Motion::Cut(between(traced, next, own, ends, center_by));
            }
        }
    }
}

/// A block between other ends: an arc by its radius, else about a centre that has moved as well.
fn between(
    traced: &Traced,
    block: &Block,
    own: &Segment,
    [start, end]: [Point; 2],
    center_by: Vector,
) -> Segment {
    if block.by_radius || block.is_lost {
        let is_absolute = center_by == Vector::zeros();
        let said = traced.arc_between(block, [start, end], is_absolute);
        return said.unwrap_or(Segment::line(start, end));
    }
    match own {
        Segment::Line(_) => Segment::line(start, end),
        Segment::Arc(arc) => Segment::Arc(Arc::about(
            arc.center + center_by,
            start,
            end,
            arc.sweep > 0.0,
        )),
    }
}

/// Moves the blocks after a changed end that name no other place in the direction of the change.
fn hold(traced: &Traced, behind: &mut [Block], mut by: Vector) {
    for block in behind {
        let Some([start, end]) = block.motion.ends() else {
            continue;
        };
        let kept = by.zip_map(&(end - start), |by, way| if way == 0.0 { by } else { 0.0 });
        if let Some(own) = block.segment() {
            let ends = [start + by, end + kept];
            block.motion = Motion::Cut(between(traced, block, own, ends, by));
        }
        match &mut block.motion {
            Motion::Cut(_) => {}
            Motion::Way(start, way) => {
                *start += by;
                *way += kept - by;
            }
            Motion::Stop => {}
        }
        by = kept;
        if by == Vector::zeros() {
            return;
        }
    }
}
