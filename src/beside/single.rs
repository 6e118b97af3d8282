//! Finds one changed block that explains all differences.
//!
//! A walk names a changed block where it can tell it from a lead, a tab or another pass. Where it is unsure, each block
//! near the named ones is tried: if it is laid as the drawing has it, does all the rest follow?

use super::members::Members;
use super::placement::{Placement, stretch};
use super::rounds::{Rounds, Spot};
use super::traced::{Block, Motion, Traced};
use super::walk::{Kind, Unlike, Walked};
use super::{REACH, TOLERANCE};
use crate::geometry::{Arc, Point, Segment, Vector};
use std::f64::consts::TAU;

/// Blocks before and after a named one that are tried, and the blocks that all tries together may read.
const ABOUT: usize = 3;
const MOST: usize = 60_000;
/// The most pieces that one block may stand for, and how far apart they may lie as one line or arc, µm.
const TOGETHER: usize = 5;
const SAME: f64 = 1e-2;
/// A smaller deviation is no change, µm.
const LEAST: f64 = 1.4;
/// A place nearer to a node is that node, µm.
const NODE: f64 = 1.6;

/// The one block that explains all.
pub(super) struct Only {
    pub unlike: Unlike,
    /// The program with that block as it should be, on its drawing.
    pub repaired: Traced,
    pub walked: Walked,
}

/// A program of which every block follows, and the sum of their deviations, µm.
type Whole<'a> = &'a dyn Fn(&Traced, Placement) -> Option<(Walked, f64)>;

/// The one block that explains it best, by no more than `most` µm; `None` where none does.
pub(super) fn single(
    traced: &Traced,
    rounds: &Rounds,
    placement: Placement,
    named: &[Unlike],
    most: f64,
    whole: Whole,
) -> Option<Only> {
    let mut tried: Vec<usize> = Vec::new();
    for away in 0..=ABOUT {
        for unlike in named {
            for index in [unlike.block.checked_sub(away), Some(unlike.block + away)] {
                let is_cut = |index: &usize| {
                    let block = traced.blocks.get(*index);
                    block.is_some_and(|block| block.segment().is_some())
                };
                tried.extend(index.filter(is_cut).filter(|index| !tried.contains(index)));
            }
        }
    }
    tried.extend(Members::breaks(traced, rounds, placement));
    tried.sort_unstable();
    tried.dedup();
    let mut fuel = MOST / traced.blocks.len().max(1);
    tried.sort_by_key(|index| named.iter().all(|unlike| unlike.block != *index));
    let mut order = tried.clone();
    order.sort_unstable();
    let mut members = Members::new(traced, placement);
    let mut at = 0;
    let mut before = std::collections::BTreeMap::new();
    for index in order {
        (at..index).for_each(|block| members.take(traced, rounds, block));
        at = index;
        before.insert(index, members.clone());
    }
    let mut best: Option<(f64, Only)> = None;
    let mut consider = |unlike: Unlike, repaired: Traced, placement: Placement| -> bool {
        let Some((walked, miss)) = whole(&repaired, placement) else {
            return false;
        };
        let sum = miss + unlike.off;
        if best.as_ref().is_none_or(|(least, _)| sum < *least) {
            let only = Only {
                unlike,
                repaired,
                walked,
            };
            best = Some((sum, only));
        }
        true
    };
    'tries: for index in tried {
        let members = &before[&index];
        let own = *traced.blocks[index].segment()?;
        let unlike = |source, off| Unlike {
            block: index,
            source,
            off,
            kind: Kind::Block,
        };
        // Where the program lies may have been found before the change, or after it.
        let mut either = |unlike: Unlike, repaired: Traced, by: Vector| {
            if !consider(unlike.clone(), repaired.clone(), placement) {
                consider(unlike, repaired, placement.moved(by));
            }
        };
        let goes_on = members.spot.zip(members.entry);
        let at = |point: Point| rounds.near(members.placement.place(point), 2.0 * REACH);
        let begun = at(own.start()).into_iter().map(|spot| (spot, spot));
        let begun: Vec<_> = goes_on.into_iter().chain(begun).collect();
        let ending = |point: Point| {
            let all = at(point).into_iter().filter(|spot| rounds.is_begin(spot));
            all.filter_map(|spot| rounds.before(&spot))
                .map(|spot| (spot, spot))
        };
        let source = begun.first().map(|(spot, _)| rounds.piece(spot).source);
        let source = source.flatten();
        if let Some((edited, by)) = doubled(traced, index) {
            let block = index - 1;
            either(
                Unlike {
                    block,
                    ..unlike(source, by.norm())
                },
                edited,
                by,
            );
        }
        if let Some((edited, off)) = exchanged(traced, index) {
            either(unlike(source, off), edited, Vector::zeros());
        }
        for (spot, entry) in begun.iter().copied().chain(ending(own.start())) {
            let (lost, _) = stretch(rounds, &spot, &entry);
            let by = lost.end() - lost.start();
            for edited in lacking(traced, index, &lost, &members.placement) {
                fuel = fuel.saturating_sub(1);
                either(
                    unlike(rounds.piece(&spot).source, lost.length()),
                    edited,
                    by,
                );
            }
        }
        for (spot, entry) in begun.iter().copied().chain(ending(own.end())) {
            let all = stretches(rounds, spot, &entry);
            // To the end of a piece, or to where a tab begins.
            let end = members.placement.place(own.end());
            let part = all.last().and_then(|rest| {
                let share = rest.share_of(end);
                (share > 0.0 && share < 1.0).then(|| rest.part(0.0, share))
            });
            for meant in all.into_iter().chain(part) {
                let is_lost = traced.blocks[index].is_lost;
                let Some((meant, by)) = meant_by(&meant, &own, is_lost, &members.placement) else {
                    continue;
                };
                if by.norm() > most {
                    continue;
                }
                // A machine that counts goes on from wherever it is.
                let hows = if traced.counts {
                    &How::ALL[..1]
                } else {
                    &How::ALL
                };
                for &how in hows {
                    if fuel == 0 {
                        break 'tries;
                    }
                    fuel -= 1;
                    let repaired = repaired(traced, index, meant, by, how);
                    let unlike = unlike(rounds.piece(&spot).source, by.norm());
                    match how {
                        How::Relative => either(unlike, repaired, by),
                        _ => either(unlike, repaired, Vector::zeros()),
                    }
                }
            }
        }
    }
    best.map(|(_, only)| only)
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

/// A stretch of the drawing that replaces a block, and by how much its end moves.
fn meant_by(
    stretch: &Segment,
    own: &Segment,
    is_lost: bool,
    placement: &Placement,
) -> Option<(Segment, Vector)> {
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
    let is_alike = is_lost
        || stretch.as_arc().is_some() == own.as_arc().is_some()
            && (stretch.length() - own.length()).abs() <= 2.0 * by.norm() + TOLERANCE;
    let meant = match stretch.moved(end - stretch.end()) {
        Segment::Line(_) => Segment::line(own.start(), end),
        arc => arc,
    };
    (is_alike && by.norm() >= LEAST).then_some((meant, by))
}

/// The program without a block that stands twice, and by how much what lies behind moves.
fn doubled(traced: &Traced, index: usize) -> Option<(Traced, Vector)> {
    let before = traced.blocks[index.checked_sub(1)?].segment()?;
    let own = traced.blocks[index].segment()?;
    let by = own.start() - own.end();
    let is_again = (before.start() - before.end() - by).norm() < SAME
        && before.as_arc().is_some() == own.as_arc().is_some();
    if !is_again {
        return None;
    }
    let mut edited = traced.clone();
    edited.blocks.remove(index);
    shift_cuts(&mut edited, index, -1);
    move_on(&mut edited.blocks[index..], by);
    Some((edited, by))
}

/// The program with a block and the next in the other order, and how far the place between them moves.
fn exchanged(traced: &Traced, index: usize) -> Option<(Traced, f64)> {
    let own = *traced.blocks[index].segment()?;
    let next = *traced.blocks.get(index + 1)?.segment()?;
    let mut edited = traced.clone();
    let first = next.moved(own.start() - next.start());
    let second = own.moved(first.end() - own.start());
    let off = (first.end() - own.end()).norm();
    edited.blocks[index].motion = Motion::Cut(first);
    edited.blocks[index + 1].motion = Motion::Cut(second);
    (off > REACH).then_some((edited, off))
}

/// The program with a block that it lacks before another: what lies behind is counted from there, or is where it was.
fn lacking(traced: &Traced, index: usize, lost: &Segment, placement: &Placement) -> Vec<Traced> {
    let Some(own) = traced.blocks[index].segment() else {
        return Vec::new();
    };
    let lost = lost.moved(own.start() - lost.start());
    let end = placement.program(placement.place(lost.end()));
    let by = end - own.start();
    let mut counted = traced.clone();
    let block = Block {
        motion: Motion::Cut(lost),
        ..counted.blocks[index].clone()
    };
    counted.blocks.insert(index, block);
    shift_cuts(&mut counted, index, 1);
    let mut placed = counted.clone();
    let (start, end) = (own.start() + by, own.end());
    placed.blocks[index + 1].motion = Motion::Cut(begun_at(own, start, end, by, How::AbsoluteFrom));
    move_on(&mut counted.blocks[index + 1..], by);
    vec![counted, placed]
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
#[derive(Clone, Copy, PartialEq)]
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
}

fn repaired(traced: &Traced, index: usize, meant: Segment, by: Vector, how: How) -> Traced {
    let mut repaired = traced.clone();
    repaired.blocks[index].motion = Motion::Cut(meant);
    if how == How::Relative {
        move_on(&mut repaired.blocks[index + 1..], by);
        return repaired;
    }
    let mut behind = repaired.blocks[index + 1..].iter_mut();
    if how == How::Held {
        hold(behind, by);
        return repaired;
    }
    let next = behind.find_map(|block| match &mut block.motion {
        Motion::Cut(segment) => Some(segment),
        _ => None,
    });
    if let Some(next) = next {
        let end = next.end();
        *next = begun_at(next, next.start() + by, end, by, how);
    }
    repaired
}

/// Moves the blocks after a changed end that name no other place in the direction of the change.
fn hold<'a>(behind: impl Iterator<Item = &'a mut Block>, mut by: Vector) {
    for block in behind {
        let Some([start, end]) = block.motion.ends() else {
            continue;
        };
        let kept = by.zip_map(&(end - start), |by, way| if way == 0.0 { by } else { 0.0 });
        match &mut block.motion {
            Motion::Cut(Segment::Line(_)) => {
                block.motion = Motion::Cut(Segment::line(start + by, end + kept));
            }
            Motion::Cut(Segment::Arc(arc)) => {
                let center = arc.center + by;
                *arc = Arc::about(center, start + by, end + kept, arc.sweep > 0.0);
            }
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

fn begun_at(segment: &Segment, start: Point, end: Point, by: Vector, how: How) -> Segment {
    match segment {
        Segment::Line(_) => Segment::line(start, end),
        Segment::Arc(arc) => {
            let center = match how {
                How::AbsoluteFrom => arc.center + by,
                _ => arc.center,
            };
            Segment::Arc(Arc::about(center, start, end, arc.sweep > 0.0))
        }
    }
}
