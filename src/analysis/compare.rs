//! Compares the segments of two runs by the rules on pairs.

use crate::drawing::{ContourKey, ContourSegment};
use crate::finding::{Severity, Side};
use crate::geometry::{Bounds, Line, Point, Segment, left_normal};
use crate::rules::dead_end::Left;
use crate::rules::{Outlook, PAIR_RULES, PairObservation, Wall, part_for_good};
use rustc_hash::FxHashMap;
use std::collections::VecDeque;
use std::rc::Rc;

/// A run of segments of one contour.
pub(crate) type RunId = (ContourKey, u32);

/// A pair in a fixed order, whichever of the two is given first: of two runs, the key of what is seen between them.
pub(super) fn ordered<T: Ord + Copy>(one: T, other: T) -> (T, T) {
    (one.min(other), one.max(other))
}

/// A segment by its contour and its index in it.
pub(crate) type SegmentId = (ContourKey, usize);

/// A contour's outlook by key.
pub(crate) type Outlooks<'a, 'b> = &'a (dyn Fn(ContourKey) -> Option<Outlook<'b>> + Sync);

/// A dead end: its first and last wall, and what the wire leaves between them, if that matters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ended {
    pub(super) walls: [usize; 2],
    pub(super) left: Option<Left>,
}

/// What a pair rule has observed between two segments.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Observed {
    /// Index into [`PAIR_RULES`].
    pub(crate) rule: usize,
    pub(crate) one: SegmentId,
    pub(crate) other: SegmentId,
    pub(crate) sides: (Option<Side>, Option<Side>),
    pub(crate) mildest: Option<Severity>,
    /// A disc that must be empty, of the contour's own segments or of all, and whether something reaches into it.
    pub(crate) disc: Option<(Point, f64)>,
    pub(crate) own_disc: bool,
    pub(crate) blocked: bool,
    /// What is left beyond a dead end, once that has been worked out.
    pub(crate) ended: Option<Ended>,
}

impl Observed {
    /// True if it is reported pair by pair.
    pub(super) fn is_told(&self) -> bool {
        PAIR_RULES[self.rule].pair_by_pair
    }

    /// Segments of a contour from `first` on have other indices.
    pub(super) fn shift(&mut self, key: ContourKey, first: usize, by: isize) {
        for (_, index) in [&mut self.one, &mut self.other]
            .into_iter()
            .filter(|segment| segment.0 == key)
        {
            *index = shifted(*index, first, by);
        }
        // The walls of a dead end are of one contour.
        if self.one.0 == key
            && let Some(Ended { walls, left }) = &mut self.ended
        {
            *walls = walls.map(|wall| shifted(wall, first, by));
            if let Some(left) = left {
                left.index = shifted(left.index, first, by);
            }
        }
    }
}

/// The new index of a segment, where those from `first` on have changed.
fn shifted(index: usize, first: usize, by: isize) -> usize {
    match index < first {
        true => index,
        false => index.wrapping_add_signed(by),
    }
}

/// What the rules on two segments that come near each other cost, in looks.
pub(crate) const LOOKS_OF_A_PAIR: u64 = 32;

/// The number of segments of a run that share a box.
const GROUP: usize = 8;

/// The number of segments at hand while runs are compared.
const KEPT: usize = 1 << 14;

/// False when the line or circle of a segment stays farther than `reach` from a box.
pub(crate) fn passes(segment: &Segment, bounds: &Bounds, reach: f64) -> bool {
    let center = bounds.min + (bounds.max - bounds.min) * 0.5;
    match segment {
        Segment::Line(line) => {
            let normal = left_normal(line.direction());
            let half = (bounds.width() * normal.x.abs() + bounds.height() * normal.y.abs()) / 2.0;
            normal.dot(&(center - line.start)).abs() <= half + reach * 2.0
        }
        Segment::Arc(arc) => {
            let half_diagonal = (bounds.max - center).norm();
            ((center - arc.center).norm() - arc.radius).abs() <= half_diagonal + reach * 2.0
        }
    }
}

/// False for two segments of which one stays farther than `reach` from the other, or its box.
fn may_meet(
    (one, own): (&Segment, &Bounds),
    (other, theirs): (&Segment, &Bounds),
    reach: f64,
) -> bool {
    match (one, other) {
        (Segment::Line(one), Segment::Line(other)) => {
            !lies_beside(one, other, reach) && !lies_beside(other, one, reach)
        }
        _ => passes(one, theirs, reach) && passes(other, own, reach),
    }
}

fn lies_beside(line: &Line, other: &Line, reach: f64) -> bool {
    let normal = left_normal(line.direction());
    let (from, to) = (
        normal.dot(&(other.start - line.start)),
        normal.dot(&(other.end - line.start)),
    );
    from.min(to) > reach * 2.0 || from.max(to) < reach * -2.0
}

/// A cache of the walls of some runs, which their neighbours need repeatedly.
pub(crate) struct RunsAtHand<'a, 'b> {
    pub(crate) outlook: Outlooks<'a, 'b>,
    walls: FxHashMap<RunId, Rc<RunWalls<'b>>>,
    /// The runs that are kept, the oldest first, and how many segments they have.
    order: VecDeque<RunId>,
    segments: usize,
}

impl<'a, 'b> RunsAtHand<'a, 'b> {
    pub(crate) fn new(outlook: Outlooks<'a, 'b>) -> RunsAtHand<'a, 'b> {
        RunsAtHand {
            outlook,
            walls: FxHashMap::default(),
            order: VecDeque::new(),
            segments: 0,
        }
    }

    pub(crate) fn walls_of(&mut self, run: RunId) -> Option<Rc<RunWalls<'b>>> {
        if let Some(walls) = self.walls.get(&run) {
            return Some(walls.clone());
        }
        let walls = Rc::new(RunWalls::of(&(self.outlook)(run.0)?, run.1));
        self.segments += walls.each.len();
        while self.segments > KEPT
            && let Some(oldest) = self.order.pop_front()
        {
            let gone = self.walls.remove(&oldest);
            self.segments -= gone.map_or(0, |gone| gone.each.len());
        }
        self.order.push_back(run);
        self.walls.insert(run, walls.clone());
        Some(walls)
    }
}

/// A segment of a run with its box.
pub(crate) type Walled<'a> = (Wall<'a>, Bounds);

/// The segments of a run.
pub(crate) struct RunWalls<'a> {
    pub(crate) each: Vec<Walled<'a>>,
    /// The box of each [`GROUP`] of them, and that of all.
    pub(crate) groups: Vec<Bounds>,
    pub(crate) all: Bounds,
}

impl<'a> RunWalls<'a> {
    pub(crate) fn of(outlook: &Outlook<'a>, run: u32) -> RunWalls<'a> {
        let range = outlook.index.range_of(run as usize);
        let first = range.start;
        let segments = outlook
            .contour
            .segments_in(outlook.drawing, range)
            .enumerate();
        let mut before = outlook
            .segment(first as isize - 1)
            .map(|segment| segment.geometry);
        let wall = |(along, segment): (usize, ContourSegment)| {
            let before = before.replace(segment.geometry);
            let bounds = segment.geometry.bounds();
            (
                Wall::behind(before, outlook, first + along, segment),
                bounds,
            )
        };
        let each: Vec<Walled> = segments.map(wall).collect();
        let mut all = Bounds::EMPTY;
        let groups = each.chunks(GROUP).map(|group| {
            let mut bounds = Bounds::EMPTY;
            group.iter().for_each(|(_, own)| bounds.merge(own));
            all.merge(&bounds);
            bounds
        });
        let groups = groups.collect();
        RunWalls { each, groups, all }
    }

    /// True when a segment comes nearer to `center` than `radius`; `area` is the box of that disc.
    pub(crate) fn reach_into(&self, area: &Bounds, center: Point, radius: f64) -> bool {
        let groups = self
            .each
            .chunks(GROUP)
            .zip(&self.groups)
            .filter(|(_, bounds)| bounds.touches(area));
        let mut near = groups
            .flat_map(|(group, _)| group)
            .filter(|(_, bounds)| bounds.touches(area));
        // A cut on the line is no wall.
        near.any(|(wall, _)| !wall.outlook.on_line && wall.geometry().distance_to(center) < radius)
    }
}

/// One comparison of the pairs that two runs form.
pub(crate) struct Comparison<'a> {
    /// Indices into [`PAIR_RULES`], and how far each reaches.
    pub(crate) rules: &'a [(usize, f64)],
    pub(crate) reach: f64,
    pub(crate) keys: (ContourKey, ContourKey),
}

impl Comparison<'_> {
    /// The pairs within one run. Returns how many looks it took, as [`Comparison::between`] does.
    pub(crate) fn within(&self, walls: &RunWalls, found: &mut Vec<Observed>) -> u64 {
        let mut looks = (walls.each.len() * walls.groups.len()) as u64;
        for (at, one) in walls.each.iter().enumerate() {
            let area = one.1.grown(self.reach);
            for (group, _) in walls
                .groups
                .iter()
                .enumerate()
                .skip((at + 1) / GROUP)
                .filter(|(_, bounds)| area.touches(bounds))
            {
                let others = walls
                    .each
                    .iter()
                    .enumerate()
                    .skip(group * GROUP)
                    .take(GROUP);
                let near = |(place, other): &(usize, &Walled)| {
                    *place > at && area.touches(&other.1) && self.may_meet(one, other)
                };
                for (_, other) in others.filter(near) {
                    looks += LOOKS_OF_A_PAIR;
                    self.at(one, other, found);
                }
            }
        }
        looks
    }

    pub(crate) fn between(
        &self,
        walls: &RunWalls,
        others: &RunWalls,
        found: &mut Vec<Observed>,
    ) -> u64 {
        let mut looks = (walls.each.len() + others.each.len()) as u64;
        for one in &walls.each {
            let area = one.1.grown(self.reach);
            if !(area.touches(&others.all) && passes(one.0.geometry(), &others.all, self.reach)) {
                continue;
            }
            looks += others.groups.len() as u64;
            for (group, _) in others
                .each
                .chunks(GROUP)
                .zip(&others.groups)
                .filter(|(_, bounds)| area.touches(bounds))
            {
                let near = |other: &&Walled| area.touches(&other.1) && self.may_meet(one, other);
                for other in group.iter().filter(near) {
                    looks += LOOKS_OF_A_PAIR;
                    self.at(one, other, found);
                }
            }
        }
        looks
    }

    fn may_meet(&self, (one, own): &Walled, (other, theirs): &Walled) -> bool {
        may_meet(
            (one.geometry(), own),
            (other.geometry(), theirs),
            self.reach,
        )
    }

    /// Applies the rules to two segments whose boxes come near each other. The one of the entity
    /// that is machined earlier comes first, so that the answer depends neither on the keys of
    /// contours nor on when an entity was drawn.
    fn at(&self, one: &Walled, other: &Walled, found: &mut Vec<Observed>) {
        let place = |wall: &Wall| {
            (
                wall.outlook.drawing.rank(wall.segment.entity),
                wall.segment.segment,
            )
        };
        let (own, theirs) = ((self.keys.0, one.0.index), (self.keys.1, other.0.index));
        let ((one, own), (other, theirs)) = if place(&one.0) <= place(&other.0) {
            ((one, own), (other, theirs))
        } else {
            ((other, theirs), (one, own))
        };
        let mut is_double = false;
        let part = part_for_good(&one.0, &other.0, own.0 == theirs.0);
        for &(rule, reach) in self.rules {
            // For duplicates no other finding is needed. A contour that duplicates itself also crosses itself.
            if is_double && PAIR_RULES[rule].silent_for_doubles && own.0 != theirs.0 {
                continue;
            }
            if part && PAIR_RULES[rule].silent_where_they_part {
                continue;
            }
            if one.1.grown(reach).touches(&other.1) {
                for PairObservation {
                    sides,
                    disc,
                    own_disc,
                    mildest,
                } in (PAIR_RULES[rule].check)(&one.0, &other.0, own.0 == theirs.0)
                {
                    is_double |= PAIR_RULES[rule].rule == crate::finding::Rule::DuplicateEntity;
                    found.push(Observed {
                        rule,
                        one: own,
                        other: theirs,
                        sides,
                        mildest,
                        disc,
                        own_disc,
                        blocked: false,
                        ended: None,
                    });
                }
            }
        }
    }
}
