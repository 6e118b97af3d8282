//! `path-crosses-itself`: the search for crossings in a cut, part by part, which reuses the results of parts that an
//! edit left alone.
//!
//! Two parts of a cut are compared where their boxes touch, and the result is kept by their content and relative place:
//! an edit only changes the pairs of the part that it touched, and of parts that moved relative to it. The whole way
//! then decides which pieces cross, so that the division into parts does not matter.

use super::crossing::{
    Crossing, MOST_PAIRS, Tangle, come_near, margin, most_looks, near_each_other, step_across,
};
use super::known_tabs::KnownTabs;
use super::offset_losses::{ControlOffset, Loss, losses};
use super::parted::{Blocks, PartedWay, SLACK, WayPart, micrometres};
use super::passes::{Before, MOST_PASSES, Passes, passes};
use super::way::Way;
use crate::finding::{Detail, Fault, Finding, NotJudged, Place, Rule, Severity};
use crate::geometry::{Bounds, Boxes, Segment, Vector};
use crate::text::SourceText;
use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};
use std::cell::Cell;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// Two parts, the place of the second relative to the first, nm, and whether it comes next.
type Pair = (u64, u64, [i64; 2], bool);

/// Pieces of two parts that come near each other, by their indices there, and the cost of finding them.
type Near = (Box<[(u32, u32)]>, usize);

/// The known results for pairs of parts, and for what goes on after stops.
#[derive(Clone, Debug, Default)]
pub(crate) struct Known {
    pairs: FxHashMap<Pair, Near>,
    /// The results for cuts, by their marks.
    found: FxHashMap<u64, Arc<Found>>,
    /// The last cut of several passes that was searched.
    passed: Option<Box<Passed>>,
    /// The results in use since the last search began: pairs of parts, and cuts; and the most that ever were.
    used: [usize; 2],
    most_used: [usize; 2],
    pub(in crate::program) tabs: KnownTabs,
}

impl Known {
    /// Begins the search through the cuts of a program.
    pub(crate) fn begin(&mut self) {
        self.used = [0, 0];
    }

    /// The crossings of a cut with this many parts, by its mark, and what the offset of the control loses of it: its way
    /// is only asked for where nothing is known yet.
    pub(crate) fn crossings<'a>(
        &mut self,
        mark: u64,
        offset: Option<ControlOffset>,
        parts: usize,
        way: impl FnOnce() -> PartedWay<'a>,
    ) -> Arc<Found> {
        let mark = offset.map_or(mark, |offset| offset.mixed_into(mark));
        let found = match self.found.get(&mark) {
            Some(found) => found.clone(),
            None => {
                let way = way();
                let may_cross = !matches!(&way.parts[..], [one] if !one.lay.may_cross());
                let passes = match may_cross || offset.is_some() {
                    true => {
                        let before = self.passed.as_ref().and_then(|before| before.like(&way));
                        passes(&way, before)
                    }
                    false => Passes::default(),
                };
                let first_pass = passes.all.first().map_or(way.count(), |pass| pass.end);
                let mut found = match may_cross {
                    true => self.search(&way, passes),
                    false => Found::default(),
                };
                if let Some(offset) = offset.filter(|_| found.is_clean()) {
                    let losses = losses(&way, first_pass, offset);
                    found.is_too_long = losses.is_none();
                    found.losses = losses.unwrap_or_default();
                }
                let found = Arc::new(found);
                self.found.insert(mark, found.clone());
                found
            }
        };
        self.used[0] += found.pairs.max(parts);
        self.used[1] += 1;
        found
    }

    fn search(&mut self, way: &PartedWay<'_>, passes: Passes) -> Found {
        if passes.all.is_empty() {
            return search(way, self);
        }
        let [first, last] = passes.known;
        let known = self.passed.take().map(|before| before.crossings);
        let mut crossings = known.unwrap_or_default();
        let others = passes.all.get(first..passes.all.len() - last);
        let own = others.unwrap_or_default().iter();
        let aside = aside_at_stop(way);
        let own = own.map(|pass| crossings_of_pass(way, pass, aside));
        crossings.splice(first..crossings.len() - last, own);
        let placed = |(pass, (crossings, _)): (&Range<usize>, &OfPass)| {
            let begin = pass.start;
            let placed = |one: &Crossing| Crossing {
                first: one.first + begin,
                second: one.second + begin,
                at: one.at,
            };
            crossings.iter().map(placed).collect::<Vec<_>>()
        };
        let all = passes.all.iter().zip(&crossings).flat_map(placed).collect();
        let is_left_out = |(_, is_all): &OfPass| !is_all;
        let is_crowded = passes.all.len() == MOST_PASSES || crossings.iter().any(is_left_out);
        self.passed = Some(Box::new(Passed {
            parts: parts_of(way),
            blocks: way.count(),
            tolerance: way.tolerance(),
            passes: passes.all,
            crossings,
        }));
        Found {
            crossings: all,
            is_crowded,
            ..Found::default()
        }
    }

    /// Ends the search: forgets everything where much more is known than ever was in use at once. What an edit leaves
    /// alone is not asked for, and may be again.
    pub(crate) fn tidy(&mut self) {
        let [pairs, cuts] = [0, 1].map(|kind| self.used[kind].max(self.most_used[kind]));
        self.most_used = [pairs, cuts];
        if self.pairs.len() > 4 * pairs + 16_384 {
            self.pairs.clear();
        }
        if self.found.len() > 4 * cuts + 4096 {
            self.found.clear();
        }
        self.tabs.tidy();
    }
}

/// The crossings of one pass, relative to its start, and whether all of it was looked at.
type OfPass = (Vec<Crossing>, bool);

/// A part by its way, its blocks and its start.
type PartMark = (u64, usize, [i64; 2]);

fn parts_of(way: &PartedWay<'_>) -> Vec<PartMark> {
    let mark = |part: &WayPart<'_>| (part.lay.mark, part.blocks, part.start);
    way.parts.iter().map(mark).collect()
}

/// A cut of several passes: an edit in one of them leaves the others known.
#[derive(Clone, Debug)]
struct Passed {
    parts: Vec<PartMark>,
    blocks: usize,
    tolerance: f64,
    passes: Vec<Range<usize>>,
    crossings: Vec<OfPass>,
}

impl Passed {
    /// Its agreement with a way.
    fn like(&self, way: &PartedWay<'_>) -> Option<Before<'_>> {
        let parts = parts_of(way);
        let is_one = |(own, other): &(&PartMark, &PartMark)| own == other;
        let first = self.parts.iter().zip(&parts).take_while(is_one).count();
        let (own, others) = (self.parts.get(first..)?, parts.get(first..)?);
        let both = own.iter().rev().zip(others.iter().rev());
        let last = both.take_while(is_one).count();
        let blocks = |parts: &[PartMark]| parts.iter().map(|(_, blocks, _)| blocks).sum();
        let same = [self.parts.get(..first)?, own.get(own.len() - last..)?].map(blocks);
        (self.tolerance == way.tolerance()).then_some(Before {
            passes: &self.passes,
            blocks: self.blocks,
            same,
        })
    }
}

/// The result for a cut.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Found {
    pub(crate) crossings: Vec<Crossing>,
    /// Too much lies on one place to look at all of it.
    pub(crate) is_crowded: bool,
    /// What the offset of the control loses of it.
    pub(super) losses: Vec<Loss>,
    /// It has too many blocks to look for that.
    is_too_long: bool,
    /// Pairs of parts that were compared.
    pairs: usize,
}

impl Found {
    pub(crate) fn is_clean(&self) -> bool {
        let crosses = !self.crossings.is_empty() || self.is_crowded;
        !crosses && self.losses.is_empty() && !self.is_too_long
    }

    /// The crossings and losses to report of a way, whose last block stands at some bytes of the text.
    pub(crate) fn findings(
        &self,
        way: &PartedWay<'_>,
        last: Option<Range<usize>>,
        text: &SourceText,
    ) -> Vec<Finding> {
        let mut findings = Vec::new();
        for crossing in &self.crossings {
            let (Some(from), Some(own)) = (way.range(crossing.first), way.range(crossing.second))
            else {
                continue;
            };
            // The corner that a control makes after a block belongs to that block.
            let before = crossing.second.checked_sub(1);
            let is_corner = before.and_then(|before| way.range(before)) == Some(own.clone());
            let piece = way.piece(crossing.second).filter(|_| !is_corner);
            let fault = Fault::PathCrossesItself {
                at: [crossing.at.x / 1000.0, crossing.at.y / 1000.0],
                from_block: piece.map(|piece| (crossing.at - piece.start()) / 1000.0),
                other: text.line_of(from.start),
            };
            findings.push(Finding {
                related: vec![Place::Text { range: from }],
                ..Finding::of(fault, own)
            });
        }
        for loss in &self.losses {
            let Some(own) = way.range(loss.block) else {
                continue;
            };
            let other = loss.other.and_then(|other| way.range(other));
            findings.push(Finding {
                related: other
                    .map(|range| Place::Text { range })
                    .into_iter()
                    .collect(),
                ..Finding::in_text(loss.rule, own, loss.detail.clone()).with(loss.severity)
            });
        }
        let blocks = way.count();
        let left_out = [
            (self.is_crowded, NotJudged::Crossings { blocks }),
            (self.is_too_long, NotJudged::Losses { blocks }),
        ];
        for (_, what) in left_out.into_iter().filter(|(is_it, _)| *is_it) {
            let Some(range) = last.clone() else { break };
            let finding = Finding::in_text(Rule::NotJudged, range, Detail::NotJudged(what));
            findings.push(finding.with(Severity::Information));
        }
        findings
    }
}

/// The most pairs of touching parts that are compared, for this many parts.
fn most_touching(parts: usize) -> usize {
    1024 + 256 * parts
}

/// Pairs of parts that are compared at once: few at first, since a way that coincides with itself shows what counts in
/// those.
const AT_ONCE: [usize; 2] = [32, 1024];

/// The parts of a cut that are compared, each prepared once.
struct Search<'w> {
    parts: &'w [WayPart<'w>],
    blocks: &'w dyn Blocks,
    /// Blocks before each part.
    firsts: &'w [usize],
    prepared: Vec<OnceLock<Prepared>>,
}

impl Search<'_> {
    fn prepared(&self, index: usize) -> &Prepared {
        self.prepared[index].get_or_init(|| Prepared::of(self.blocks.pieces(index)))
    }

    fn apart(&self, a: usize, b: usize) -> [i64; 2] {
        let (from, to) = (self.parts[a].start, self.parts[b].start);
        [0, 1].map(|axis| to[axis].wrapping_sub(from[axis]))
    }

    fn key(&self, a: usize, b: usize) -> Pair {
        let [one, other] = [a, b].map(|index| self.parts[index].lay.mark);
        (one, other, self.apart(a, b), b == a + 1)
    }

    /// Compares the pairs of parts about which nothing is known.
    fn learn(&self, pairs: &[(usize, usize)], known: &mut Known) {
        let mut asked = FxHashSet::default();
        let is_unknown = |&(a, b): &(usize, usize)| {
            let key = self.key(a, b);
            !known.pairs.contains_key(&key) && asked.insert(key)
        };
        let unknown: Vec<(usize, usize)> = pairs.iter().copied().filter(is_unknown).collect();
        let look = |&(a, b): &(usize, usize)| -> (Pair, Near) {
            let (by, is_next) = (micrometres(self.apart(a, b)), b == a + 1);
            let near = self.prepared(a).near(self.prepared(b), by, is_next);
            (self.key(a, b), near)
        };
        let found: Vec<(Pair, Near)> = if unknown.len() > 64 {
            unknown.par_iter().map(look).collect()
        } else {
            unknown.iter().map(look).collect()
        };
        known.pairs.extend(found);
    }

    /// Adds the blocks of a part that come near each other; false where these are not all.
    fn within(&self, index: usize, near: &mut Vec<(usize, usize)>) -> bool {
        let (first, lay) = (self.firsts[index], &self.parts[index].lay);
        let own = lay.near.iter();
        near.extend(own.map(|&(a, b)| (first + a as usize, first + b as usize)));
        if !lay.is_tangled || near.len() > MOST_PAIRS {
            return true;
        }
        let pieces = self.prepared(index).pieces.iter().copied();
        let (found, is_all) = near_each_other(pieces, MOST_PAIRS);
        near.extend(found.into_iter().map(|(a, b)| (first + a, first + b)));
        is_all
    }

    /// A block of the cut in its place.
    fn piece(&self, index: usize) -> Option<Segment> {
        let behind = self.firsts.partition_point(|first| *first <= index);
        let part = behind.checked_sub(1)?;
        let own = self.prepared(part).pieces.get(index - self.firsts[part])?;
        Some(own.moved(self.parts.get(part)?.offset()))
    }
}

/// Finds where a cut crosses itself.
fn search(way: &PartedWay<'_>, known: &mut Known) -> Found {
    let parts = &way.parts[..];
    let count = way.count();
    let search = Search {
        parts,
        blocks: &*way.blocks,
        firsts: &way.firsts,
        prepared: parts.iter().map(|_| OnceLock::new()).collect(),
    };
    let placed = |part: &WayPart<'_>| part.placed().grown(SLACK);
    let placed: Vec<Bounds> = parts.iter().map(placed).collect();
    let boxes = Boxes::of(placed.iter().copied());
    let mut near: Vec<(usize, usize)> = Vec::new();
    let mut left = most_looks(count);
    let mut is_crowded = false;
    // Pairs and parts that have been gone through.
    let (mut gone, mut behind, mut at_once) = (0, 0, AT_ONCE[0]);
    while behind < parts.len() && near.len() <= MOST_PAIRS {
        // In the order of the later one: the first pieces along the way count, so the search may end where these are
        // found.
        let (mut some, mut next) = (Vec::new(), behind);
        while next < parts.len() && some.len() < at_once && left > 0 {
            boxes.touching(&placed[next], next, &mut |earlier| {
                some.push((earlier, next))
            });
            next += 1;
        }
        if left == 0 {
            (next, is_crowded) = (parts.len(), true);
        }
        search.learn(&some, known);
        for index in behind..next {
            is_crowded |= !search.within(index, &mut near);
        }
        for &(a, b) in &some {
            // Earlier results count as well: they must not change how much of a cut is searched.
            let key = search.key(a, b);
            let Some((found, cost)) = known.pairs.get(&key).filter(|_| left > 0) else {
                is_crowded = true;
                break;
            };
            let in_cut = |&(i, j): &(u32, u32)| {
                let [one, other] = [a, b].map(|part| search.firsts[part]);
                (one + i as usize, other + j as usize)
            };
            near.extend(found.iter().map(in_cut));
            left = left.saturating_sub(*cost);
        }
        (gone, behind) = (gone + some.len(), next);
        at_once = (2 * at_once).min(AT_ONCE[1]);
        if gone > most_touching(parts.len()) {
            left = 0;
        }
    }
    if near.is_empty() {
        return Found {
            is_crowded,
            pairs: gone,
            ..Found::default()
        };
    }
    let (found, is_all) = Tangle {
        piece: &|index| search.piece(index),
        count,
        margin: margin(way.totals().arcs),
        aside: aside_at_stop(way),
        next: None,
        steps: Cell::new(0),
    }
    .crossings(near);
    Found {
        crossings: found,
        is_crowded: is_crowded || !is_all,
        pairs: gone,
        ..Found::default()
    }
}

/// The crossings of one pass of a cut: it may coincide with another, and ways in and out cross others.
fn crossings_of_pass(way: &PartedWay<'_>, pass: &Range<usize>, aside: f64) -> OfPass {
    let pass = pass.start..pass.end.min(way.count());
    Tangle {
        piece: &|index| way.piece(pass.start + index).filter(|_| index < pass.len()),
        count: pass.len(),
        margin: margin(way.arcs_in(&pass)),
        aside,
        next: way.piece(pass.end),
        steps: Cell::new(0),
    }
    .all_crossings()
}

/// The step to the side after the stop, to cut the tab in another pass than the one before, µm; 0 where there is none.
fn aside_at_stop(way: &PartedWay<'_>) -> f64 {
    let across = || {
        let behind = way.stop()?;
        let before = way.piece(behind.checked_sub(1)?)?;
        step_across(&before, &way.piece(behind)?)
    };
    across().unwrap_or(0.0)
}

/// The pieces of a part from the origin, with boxes about them.
struct Prepared {
    pieces: Vec<Segment>,
    boxes: Boxes,
}

impl Prepared {
    fn of(pieces: Vec<Segment>) -> Prepared {
        let boxes = Boxes::of(pieces.iter().map(|piece| piece.bounds().grown(SLACK)));
        Prepared { pieces, boxes }
    }

    /// The pieces of two parts that come near each other, where the other one begins at `by`; it may begin where this one ends.
    fn near(&self, other: &Prepared, by: Vector, is_next: bool) -> Near {
        let mut found = Vec::new();
        let mut cost = 16;
        let mut waiting = vec![((self.boxes.top(), 0), (other.boxes.top(), 0))];
        while let Some(((level_a, a), (level_b, b))) = waiting.pop() {
            cost += 1;
            let (Some(ours), Some(theirs)) =
                (self.boxes.get(level_a, a), other.boxes.get(level_b, b))
            else {
                continue;
            };
            let theirs = theirs.moved(by);
            if !ours.touches(&theirs) {
                continue;
            }
            match (level_a, level_b) {
                (0, 0) => {
                    let (piece, other) = (&self.pieces[a], other.pieces[b].moved(by));
                    let is_neighbour = is_next && b == 0 && a + 1 == self.pieces.len();
                    if !is_neighbour && come_near(piece, ours, &other, &theirs) {
                        found.push((a as u32, b as u32));
                    }
                }
                _ if level_a >= level_b => {
                    waiting.extend([2 * a, 2 * a + 1].map(|a| ((level_a - 1, a), (level_b, b))))
                }
                _ => waiting.extend([2 * b, 2 * b + 1].map(|b| ((level_a, a), (level_b - 1, b)))),
            }
        }
        keep_first(&mut found);
        (found.into(), cost)
    }
}

/// Keeps the pairs whose later block comes first along the way: one more than are used, to show that there are more.
fn keep_first(near: &mut Vec<(u32, u32)>) {
    if near.len() > MOST_PAIRS + 1 {
        near.sort_unstable_by_key(|&(first, second)| (second, first));
        near.truncate(MOST_PAIRS + 1);
    }
}
