//! Whether every block of a program lies on its drawing, in whatever order.
//!
//! A walk along both must guess where a program means to be. That there is no difference can be shown without guessing:
//! each block except the few leads and ways from pass to pass follows some piece of some round, and each round that is
//! cut is cut as often everywhere.

use super::coverage::Coverage;
use super::placement::{Placement, lever, stretch};
use super::rounds::{Rounds, Spot};
use super::traced::{Motion, Traced};
use super::walk::{Kind, Unlike, Walked};
use super::{BETWEEN, COVERED, LEADS, REACH};
use crate::geometry::{Point, Segment, Vector};
use std::ops::Range;

/// The state of a program up to one of its blocks.
#[derive(Clone)]
pub(super) struct Members {
    pub(crate) placement: Placement,
    /// Where the last block has led to, and where its run began.
    pub(crate) spot: Option<Spot>,
    pub(crate) entry: Option<Spot>,
    runs: Vec<bool>,
    on: Vec<Option<(usize, bool)>>,
    /// Blocks that end where the drawing says.
    follows: Vec<usize>,
    coverage: Coverage,
    /// The place of the program, without 4B's addition at the start of a contour.
    base: Option<Vector>,
    contours: Vec<usize>,
    /// Blocks since the last that follows; one that follows has been left for them.
    away: usize,
    /// Their length together, µm.
    skipped: f64,
    left: Option<Spot>,
    /// A block shows a difference.
    pub(crate) is_broken: bool,
    miss: f64,
    stretch: Stretch,
    slips: Vec<Unlike>,
}

/// What no writer rounds the numbers of a block by, µm: both of its ends, or its start and its centre, lie on the grid.
const NUMBER: f64 = 1.9;

/// A wire that leaves by more from where it came is meant to, where the program may take it anywhere, µm.
const MOST_MISSED: f64 = 50.0;

/// The blocks since the correction was switched on or off.
#[derive(Clone, Copy, Default)]
struct Stretch {
    cut: usize,
    follow: usize,
}

impl Stretch {
    /// More than a way there and back follows nothing of the drawing.
    fn is_foreign(self) -> bool {
        self.follow == 0 && self.cut > LEADS
    }
}

impl Members {
    pub(super) fn new(traced: &Traced, placement: Placement) -> Members {
        Members {
            placement,
            spot: None,
            entry: None,
            runs: vec![false; traced.blocks.len()],
            on: vec![None; traced.blocks.len()],
            follows: Vec::new(),
            coverage: Coverage::default(),
            base: None,
            contours: Vec::new(),
            away: 0,
            skipped: 0.0,
            left: None,
            is_broken: false,
            miss: 0.0,
            stretch: Stretch::default(),
            slips: Vec::new(),
        }
    }

    /// Takes one block after the other; sets `is_broken` at the first one that shows a difference.
    pub(super) fn take(&mut self, traced: &Traced, rounds: &Rounds, index: usize) {
        let block = &traced.blocks[index];
        let before = index.checked_sub(1).map(|before| &traced.blocks[before]);
        if let Some(before) = before
            && before.stretch != block.stretch
        {
            self.is_broken |= before.is_offset() && self.stretch.is_foreign();
            // The words that switch the correction say that another pass begins, wherever that is.
            (self.stretch, self.left) = (Stretch::default(), None);
        }
        let segment = match &block.motion {
            Motion::Cut(segment) => segment,
            Motion::Stop => {
                self.left = None;
                self.coverage.stop();
                return;
            }
            Motion::Way(..) => {
                self.coverage.stop();
                (self.spot, self.entry, self.left, self.away) = (None, None, None, 0);
                return;
            }
        };
        self.stretch.cut += 1;
        let goes_on = self.spot.zip(self.entry);
        let found = goes_on
            .and_then(|(spot, entry)| follow(self.placement, traced, rounds, index, (spot, entry)));
        let found = found.or_else(|| self.begin(traced, rounds, index, segment, goes_on));
        let Some(found) = found else {
            if let Some(spot) = self.spot.take() {
                self.left = Some(spot);
                (self.away, self.skipped) = (0, 0.0);
            }
            self.skipped += segment.length();
            if traced.counts && segment.as_arc().is_some() {
                self.placement = self.placement.unsurely();
            }
            self.entry = None;
            self.away += 1;
            self.is_broken |= self.away > BETWEEN;
            return;
        };
        self.note_slips(traced, rounds, index, &found);
        let Found {
            from,
            entry,
            placement,
            to,
            length,
            whole,
            miss,
        } = found;
        if self.base.is_none() {
            self.base = rounds.beside(&from).map(|by| placement.shift - by);
        }
        if self.spot.is_none()
            && let Some(left) = self.left
        {
            self.is_broken |= self.goes_on_behind(rounds, &left, &from);
        }
        let goes_on = self.spot.is_some_and(|spot| {
            (spot.round, spot.back) == (from.round, from.back)
                && (spot.at - from.at).norm() <= COVERED
        });
        if !goes_on {
            self.coverage.end_run();
        }
        (self.placement, self.spot, self.entry) = (placement, to, Some(entry));
        (self.left, self.away) = (None, 0);
        self.stretch.follow += 1;
        self.runs[index] = true;
        self.on[index] = Some((from.round, from.back));
        self.follows.extend(whole.then_some(index));
        self.miss += miss;
        self.contours.push(rounds.rounds[from.round].contour);
        rounds.cover(&from, length, |part| self.coverage.cut(from.round, part));
    }

    /// Notes a block with numbers that no writer rounds so.
    fn note_slips(&mut self, traced: &Traced, rounds: &Rounds, index: usize, found: &Found) {
        let block = &traced.blocks[index];
        let Some(segment) = block.segment() else {
            return;
        };
        let (from, length) = (&found.from, found.length);
        let mut note = |block: usize, off: f64| {
            self.slips.push(Unlike {
                block,
                source: rounds.piece(from).source,
                off,
                kind: Kind::Block,
            });
        };
        if !rounds.is_begin(from) {
            // A line that begins on the end of an arc: the arc before it ends too early.
            let rest = rounds.rest(from);
            let is_early = segment.as_arc().is_none()
                && rest.as_arc().is_some()
                && rest.length() > COVERED
                && length > rest.length() + COVERED;
            if is_early && let Some(before) = index.checked_sub(1) {
                note(before, rest.length());
            }
        } else if !traced.four_b {
            let (meant, _) = stretch(rounds, from, &found.entry);
            let is_one = (length - meant.length()).abs() < 1e-6;
            let off = match found.whole {
                true if is_one => numbers_apart(segment, &meant, (traced.counts, block.by_radius)),
                true => 0.0,
                // On another piece, which it has been found to follow.
                false if length > meant.length() => 0.0,
                // Where on its piece it ends is the program's own.
                false => meant.distance_to(meant.start() + (segment.end() - segment.start())),
            };
            if off > NUMBER {
                note(index, off);
            }
        }
    }

    /// Whether a run goes on from one spot at another as if the blocks between them were on it: no way from pass to
    /// pass returns to its own place or goes along.
    fn goes_on_behind(&self, rounds: &Rounds, left: &Spot, from: &Spot) -> bool {
        if (left.round, left.back) != (from.round, from.back) {
            return false;
        }
        let ahead = rounds.ahead(left, from);
        let beside = (ahead - self.skipped).abs();
        (left.at - from.at).norm() < 10.0 || beside <= 10.0 + 0.02 * self.skipped
    }

    /// A run that begins with a block.
    fn begin(
        &self,
        traced: &Traced,
        rounds: &Rounds,
        index: usize,
        segment: &Segment,
        goes_on: Option<(Spot, Spot)>,
    ) -> Option<Found> {
        let near = rounds.near(self.placement.place(segment.start()), REACH);
        let all = near.into_iter().filter_map(|spot| {
            // Where the run began divides a piece for all of it.
            let own = |(last, entry): (Spot, Spot)| {
                ((last.round, last.back) == (spot.round, spot.back)).then_some(entry)
            };
            let entry = goes_on.and_then(own).unwrap_or(spot);
            follow(self.placement, traced, rounds, index, (spot, entry))
        });
        // 4B puts each contour where its wire begins.
        let base = self.base.map(|base| self.placement.shifted(base));
        let beside = base.into_iter().flat_map(|base| {
            let near = rounds.near_beside(base.place(segment.start()), REACH);
            near.into_iter().filter_map(move |(spot, by)| {
                follow(base.moved(by), traced, rounds, index, (spot, spot))
            })
        });
        whole_or_first(all.chain(beside))
    }

    /// Blocks about those where blocks begin to follow, or no longer do, and those of short cuts of which none does.
    pub(crate) fn breaks(traced: &Traced, rounds: &Rounds, placement: Placement) -> Vec<usize> {
        let mut members = Members::new(traced, placement);
        let (mut breaks, mut reached) = (Vec::new(), traced.blocks.len());
        for index in 0..traced.blocks.len() {
            let is_on = members.spot.is_some();
            members.take(traced, rounds, index);
            if is_on != members.spot.is_some() {
                breaks.extend(index.saturating_sub(2)..=index);
            }
            if members.is_broken {
                breaks.extend(index.saturating_sub(BETWEEN + 2)..=index);
                reached = index;
                break;
            }
        }
        let cuts = traced.cuts.iter().map(|[all, _]| all);
        // Where nothing follows at all, the program is another one's.
        let is_of_drawing = members.runs.contains(&true);
        let is_lost = |cut: &&Range<usize>| {
            let is_short = cut.end <= reached && cut.len() <= BETWEEN + 2;
            is_of_drawing && is_short && !members.runs[cut.start..cut.end].contains(&true)
        };
        breaks.extend(cuts.filter(is_lost).cloned().flatten());
        breaks.retain(|&index| traced.blocks[index].segment().is_some());
        breaks
    }

    /// How many blocks follow.
    pub(super) fn count(traced: &Traced, rounds: &Rounds, placement: Placement) -> usize {
        let mut members = Members::new(traced, placement);
        (0..traced.blocks.len()).for_each(|index| members.take(traced, rounds, index));
        members.runs.iter().filter(|runs| **runs).count()
    }

    /// All of them, and the sum of their deviations, µm; `None` where there is a difference.
    pub(super) fn all(
        traced: &Traced,
        rounds: &Rounds,
        placement: Placement,
    ) -> Option<(Walked, f64)> {
        let mut members = Members::new(traced, placement);
        let mut cuts = traced.cuts.iter().map(|[all, _]| all).peekable();
        let (mut begun, mut misses_start) = (None, false);
        for index in 0..traced.blocks.len() {
            if cuts.peek().is_some_and(|cut| cut.start == index) {
                begun = members.placement.begin(&traced.blocks[index]);
            }
            members.take(traced, rounds, index);
            if members.is_broken {
                return None;
            }
            if let Some(cut) = cuts.next_if(|cut| cut.end == index + 1) {
                misses_start |= members.misses(traced, rounds, cut, begun);
            }
        }
        let whole = members.coverage.are_whole(rounds);
        let walked = Walked {
            runs: members.runs,
            on: members.on,
            follows: members.follows,
            contours: members.contours,
            slips: members.slips,
            misses_start,
            ..Walked::default()
        };
        (whole && !walked.contours.is_empty()).then_some((walked, members.miss))
    }

    /// Whether a cut that goes round closed contours ends elsewhere than where it has begun.
    fn misses(
        &self,
        traced: &Traced,
        rounds: &Rounds,
        cut: &Range<usize>,
        begun: Option<Point>,
    ) -> bool {
        let mut on = self.on[cut.clone()].iter().flatten().peekable();
        let is_closed = on.peek().is_some() && on.all(|(round, _)| rounds.rounds[*round].closed);
        let mut blocks = traced.blocks[cut.clone()].iter().rev();
        let last = blocks.find_map(|block| block.motion.ends());
        let end = last.map(|[_, end]| self.placement.place(end));
        let apart = begun
            .zip(end)
            .map_or(0.0, |(begun, end)| (end - begun).norm());
        // In ISO the wire may leave where it likes.
        let is_meant = !traced.counts && apart > MOST_MISSED;
        is_closed && apart > REACH && !is_meant
    }
}

/// By how much the numbers of a block differ from those of its piece, µm: where it leads from its start, and where its
/// centre lies from there. Where a machine counts steps, the end of an arc is not among these numbers.
pub(super) fn numbers_apart(
    own: &Segment,
    meant: &Segment,
    (counts, by_radius): (bool, bool),
) -> f64 {
    let ends = ((own.end() - own.start()) - (meant.end() - meant.start())).amax();
    match (own.as_arc(), meant.as_arc()) {
        (Some(arc), Some(other)) => {
            let centers = (arc.center - arc.start) - (other.center - other.start);
            let apart = centers.amax() - if by_radius { lever(arc) } else { 0.0 };
            if counts { apart } else { apart.max(ends) }
        }
        // A chord, or an arc that is nearly straight.
        (None, None) => ends,
        _ => 0.0,
    }
}

fn follow(
    mut placement: Placement,
    traced: &Traced,
    rounds: &Rounds,
    index: usize,
    (from, entry): (Spot, Spot),
) -> Option<Found> {
    let reached = placement.follow(rounds, traced, index, &from, &entry)?;
    Some(Found {
        from,
        entry,
        placement,
        to: reached.spot,
        length: reached.length,
        whole: reached.whole,
        miss: reached.off.norm(),
    })
}

fn whole_or_first(mut all: impl Iterator<Item = Found>) -> Option<Found> {
    let first = all.next()?;
    if first.whole {
        return Some(first);
    }
    Some(all.find(|found| found.whole).unwrap_or(first))
}

struct Found {
    from: Spot,
    entry: Spot,
    placement: Placement,
    to: Option<Spot>,
    length: f64,
    whole: bool,
    miss: f64,
}
