//! Passes of one contour, each closed by its tab, which a later cut removes.

use super::{CutPath, Cuts, JOINED};
use crate::geometry::{Bounds, Point, Segment};
use crate::program::path::{lie_beside, tolerance, without_ways_back};

/// The most blocks of a way in or out.
const LEAD: usize = 2;

/// The most blocks of a tab.
const TAB: usize = 64;

/// How much shorter than the rest of its pass a tab is: the way back along the same cut is just as long, but for rounding.
const SHORTER: f64 = 0.9;

/// A pass as a closed contour, and the way to it from the thread hole.
pub(super) struct Ring {
    pub segments: Vec<Segment>,
    pub leads: Vec<Segment>,
}

/// The passes of one contour.
pub(super) enum Passes<'a> {
    One(&'a CutPath),
    /// Rough to finish.
    Several(Vec<Ring>),
}

impl Cuts {
    /// Its cuts by contour.
    pub(super) fn by_contour(&self) -> impl Iterator<Item = Passes<'_>> {
        let mut cuts = &self.cuts[..];
        std::iter::from_fn(move || {
            let (first, others) = cuts.split_first()?;
            let Some((rings, count)) = passes(cuts) else {
                cuts = others;
                return Some(Passes::One(first));
            };
            cuts = cuts.get(count..).unwrap_or_default();
            Some(Passes::Several(rings))
        })
    }

    /// The number of its contours, each with all its passes.
    pub(crate) fn contour_count(&self) -> usize {
        self.by_contour().count()
    }
}

/// The passes at the start of some cuts, rough to finish, and the number of those cuts; `None` where these are not
/// several passes of one contour.
fn passes(cuts: &[CutPath]) -> Option<(Vec<Ring>, usize)> {
    let begin = cuts.first()?.segments.first()?.start();
    let arcs = |cut: &CutPath| {
        cut.segments
            .iter()
            .filter(|it| it.as_arc().is_some())
            .count()
    };
    let near = JOINED * tolerance(cuts.first().map_or(0, arcs));
    let begins_there = |cut: &&CutPath| {
        let first = cut.segments.first();
        first.is_some_and(|first| (first.start() - begin).norm() <= near)
    };
    let count = cuts.iter().take_while(begins_there).count();
    let cuts = cuts.get(..count).filter(|cuts| cuts.len() > 1)?;
    let wholes: Option<Vec<Ring>> = cuts.iter().map(whole).collect();
    let rings = wholes.filter(|rings| all_beside(rings)).or_else(|| {
        let mut runs: Vec<&[Segment]> = cuts.iter().flat_map(runs).collect();
        // Under the control a pass the other way has the same coordinates.
        if cuts.iter().all(|cut| cut.side.is_none()) {
            runs = without_ways_back(runs, near);
        }
        let all = 0..runs.len();
        let with_tabs = all.filter_map(|run| with_tab(&runs, run, begin, near));
        let mut rings: Vec<Ring> = with_tabs.collect();
        // An overlap past the start is repeated in the next pass, and encloses nothing.
        let largest = rings.iter().map(Ring::bounds);
        let largest = largest.max_by(|one, other| one.width().total_cmp(&other.width()))?;
        rings.retain(|ring| lie_beside(&largest, &ring.bounds()));
        Some(rings).filter(|rings| all_beside(rings))
    });
    let rings = rings.map(|rings| (rings, count));
    rings.or_else(|| first_passes(cuts))
}

/// The first of some cuts that lie beside each other, each with a way to it. If the wire is taken
/// to the next contour by hand and no coordinates say so, that contour seems to begin in the same
/// place.
fn first_passes(cuts: &[CutPath]) -> Option<(Vec<Ring>, usize)> {
    let led = cuts.iter().take_while(|cut| cut.lead_in > 0);
    let mut rings: Vec<Ring> = Vec::new();
    for ring in led.map_while(whole) {
        let is_beside = |first: &Ring| lie_beside(&first.bounds(), &ring.bounds());
        if !rings.first().is_none_or(is_beside) {
            break;
        }
        rings.push(ring);
    }
    let count = rings.len();
    (count > 1).then_some((rings, count))
}

/// Several, each beside the first.
fn all_beside(rings: &[Ring]) -> bool {
    let first = rings.first().map(Ring::bounds);
    let is_beside = |ring: &Ring| first.is_some_and(|first| lie_beside(&first, &ring.bounds()));
    rings.len() > 1 && rings.iter().all(is_beside)
}

impl Ring {
    fn bounds(&self) -> Bounds {
        let boxes = self.segments.iter().map(Segment::bounds);
        boxes.fold(Bounds::EMPTY, |whole, part| whole.merged(&part))
    }
}

/// The moves of a cut from stop to stop.
fn runs(cut: &CutPath) -> impl Iterator<Item = &[Segment]> {
    let runs = cut.runs(&cut.stops);
    runs.filter_map(|run| cut.segments.get(run))
}

/// A cut that closes by itself, without a stop.
fn whole(cut: &CutPath) -> Option<Ring> {
    let all = &cut.segments[..];
    let contour = cut.span();
    let segments = all.get(contour.clone())?;
    let leads = all[..contour.start].iter().chain(&all[contour.end..]);
    (cut.closed && cut.stops.is_empty() && !segments.is_empty()).then(|| Ring {
        segments: segments.to_vec(),
        leads: leads.copied().collect(),
    })
}

/// A run from the start of a pass to its tab, or back, with the tab as another run cuts it.
fn with_tab(runs: &[&[Segment]], run: usize, thread: Point, near: f64) -> Option<Ring> {
    let own = runs[run];
    let others = || {
        let others = runs.iter().enumerate();
        others
            .filter(|(index, _)| *index != run)
            .map(|(_, other)| *other)
    };
    let is_at = |one: Point, other: Point| (one - other).norm() <= near;
    let starts = (0..=LEAD.min(own.len())).rev();
    let both = starts.flat_map(|from| (0..=LEAD).map(move |after| (from, after)).rev());
    both.filter_map(|(from, after)| {
        let to = own.len().checked_sub(after)?;
        let main = own.get(from..to).filter(|main| !main.is_empty())?;
        let ends = [main.last()?.end(), main.first()?.start()];
        let is_open = !is_at(ends[0], ends[1]) && !ends.iter().any(|end| is_at(*end, thread));
        let length = |pieces: &[Segment]| pieces.iter().map(Segment::length).sum::<f64>();
        let tabs = || others().filter_map(|other| tab_in(other, ends, &is_at));
        let shorter = || tabs().find(|tab| length(tab) < SHORTER * length(main));
        is_open.then(shorter).flatten().map(|tab| {
            let is_at_thread = |point: Point| is_at(point, thread);
            let lead = match own.first().is_some_and(|first| is_at_thread(first.start())) {
                true => &own[..from],
                false => &own[to..],
            };
            Ring {
                segments: main.iter().copied().chain(tab).collect(),
                leads: lead.to_vec(),
            }
        })
    })
    .next()
}

/// The part of a run between two places, reversed where it runs from the second to the first.
fn tab_in(
    run: &[Segment],
    [from, to]: [Point; 2],
    is_at: &dyn Fn(Point, Point) -> bool,
) -> Option<Vec<Segment>> {
    run.iter().enumerate().find_map(|(first, piece)| {
        let is_back = is_at(piece.start(), to);
        if !is_back && !is_at(piece.start(), from) {
            return None;
        }
        let other = if is_back { from } else { to };
        let behind = run[first..].iter().take(TAB);
        let count = behind
            .take_while(|piece| !is_at(piece.end(), other))
            .count()
            + 1;
        let tab = run
            .get(first..first + count)
            .filter(|tab| tab.len() <= TAB)?;
        Some(match is_back {
            true => tab.iter().rev().map(Segment::reversed).collect(),
            false => tab.to_vec(),
        })
    })
}
