//! What the rules on pairs of segments have seen, by the runs of segments that the two lie in.

use super::report::Report;
use crate::drawing::{ContourIndex, ContourKey, ContourSegment, Drawing, EntityId};
use crate::finding::{Detail, NotJudged, Place, Rule, Severity, Side};
use crate::geometry::{Bounds, Grid, Point, Segment, left_normal};
use crate::rules::{Limits, Outlook, PAIR_RULES, PairRule, Sight, Wall};
use crate::settings::{Budget, Effective};
use rustc_hash::{FxHashMap, FxHashSet};
use std::rc::Rc;

/// A run of segments of one contour.
pub type RunId = (ContourKey, u32);

/// A segment by its contour and its index in there.
type SegmentId = (ContourKey, usize);

/// A contour's outlook by key.
type Outlooks<'a, 'b> = &'a dyn Fn(ContourKey) -> Option<Outlook<'b>>;

/// What a pair rule has seen between two segments.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// Index into [`PAIR_RULES`].
    rule: usize,
    one: SegmentId,
    other: SegmentId,
    sides: (Option<Side>, Option<Side>),
    mildest: Option<Severity>,
    /// A disc that must be empty, of the contour's own segments or of all, and whether something reaches into it.
    disc: Option<(Point, f64)>,
    own_disc: bool,
    blocked: bool,
}

/// What a look of the budget is: a segment held against another one, or so many boxes of the grid.
const BOXES_OF_A_LOOK: u64 = 4;
/// What the rules take for two segments that come near each other, in looks.
const LOOKS_OF_A_PAIR: u64 = 16;

/// Segments of a run that have one box together.
const GROUP: usize = 8;

/// Runs whose segments are kept at hand while runs are compared.
const KEPT: usize = 256;

/// Two segments of a contour that form a slot, and the disc between them.
pub type Slot = ([usize; 2], Option<(Point, f64)>);

/// Two segments of a contour that form a slot, and the side of travel that it lies on, `None` where any.
pub type FacingWalls = ([usize; 2], Option<Side>);

/// The runs of all contours by place, and what has been seen between them.
#[derive(Clone, Debug, Default)]
pub struct Pairs {
    grid: Grid<RunId>,
    seen: FxHashMap<(RunId, RunId), Vec<Seen>>,
    partners: FxHashMap<RunId, Vec<RunId>>,
    /// Runs near which something has come or gone: whether their discs are empty is to be asked again.
    stale: FxHashSet<RunId>,
    /// How many pairs are in `seen`.
    seen_count: usize,
    /// Runs that have not been compared with everything near them, since enough had been seen already.
    uncompared: FxHashSet<RunId>,
    /// The farthest that a rule reaches.
    reach: f64,
    /// Looks that there were when all was looked at last, and those that are left of them: for comparing, and for asking whether discs
    /// are empty.
    granted: u64,
    left: u64,
    left_to_ask: u64,
    most_seen: usize,
}

impl Pairs {
    /// Nothing seen yet, and what a look at a drawing of so many segments may take, with all that is edited in it afterwards.
    pub fn new(budget: &Budget, segments: usize) -> Pairs {
        let granted = budget
            .looks
            .saturating_add(budget.looks_of_a_segment.saturating_mul(segments as u64));
        Pairs {
            granted,
            left: granted,
            left_to_ask: granted,
            most_seen: budget.most_seen,
            ..Pairs::default()
        }
    }

    /// Gives the looks anew, for an edit that is only tried.
    pub fn refill(&mut self) {
        (self.left, self.left_to_ask) = (self.granted, self.granted);
    }

    /// True while what has been seen, edit by edit, is what a look at everything sees. Each pair that there is has been looked at once at
    /// least: where that took no more than half of what there was, a look at everything comes to its end, too. Else what is left out
    /// hangs on the order in which things are looked at: all has to be looked at.
    pub fn is_within_budget(&self) -> bool {
        let half = self.granted / 2;
        self.uncompared.is_empty()
            && self.seen_count < self.most_seen
            && self.left >= half
            && self.left_to_ask >= half
    }

    /// True when nothing that has been seen between others depends on this contour, and all that is sought has been.
    pub fn may_spare(&self, key: ContourKey) -> bool {
        let depends = |each: &Seen| {
            each.disc.is_some() && !each.own_disc && each.one.0 != key && each.other.0 != key
        };
        self.uncompared.is_empty()
            && self.seen_count < self.most_seen
            && !self.seen.values().flatten().any(depends)
    }

    /// Forgets a contour as it was when it was looked at last.
    pub fn forget(&mut self, key: ContourKey, index: &ContourIndex) {
        for run in 0..index.run_count() {
            self.forget_run((key, run as u32), &index.bounds_of_run(run));
        }
    }

    /// Forgets a run with the box that it was looked at with.
    pub fn forget_run(&mut self, run: RunId, bounds: &Bounds) {
        self.grid.remove(run, bounds);
        self.uncompared.remove(&run);
        self.disturb(bounds);
        for partner in self.partners.remove(&run).unwrap_or_default() {
            let gone = self.seen.remove(&ordered(run, partner));
            self.seen_count -= gone.map_or(0, |gone| gone.len());
            if let Some(of_partner) = self.partners.get_mut(&partner) {
                of_partner.retain(|other| *other != run);
            }
        }
    }

    /// Contours of which something has been seen beside this one.
    pub fn beside(&self, key: ContourKey, runs: usize) -> FxHashSet<ContourKey> {
        let partners = (0..runs).filter_map(|run| self.partners.get(&(key, run as u32)));
        partners
            .flatten()
            .map(|other| other.0)
            .filter(|other| *other != key)
            .collect()
    }

    /// Something has come or gone within these bounds.
    fn disturb(&mut self, bounds: &Bounds) {
        if self.partners.is_empty() {
            return;
        }
        let (partners, stale) = (&self.partners, &mut self.stale);
        self.grid.near(&bounds.grown(self.reach), |run| {
            if partners.contains_key(&run) {
                stale.insert(run);
            }
        });
    }

    /// Looks at new runs, with each other and with all that come near them.
    pub fn look(
        &mut self,
        outlook: Outlooks,
        limits: &Limits,
        settings: &Effective,
        runs: &[RunId],
    ) {
        let doubles_matter = PAIR_RULES
            .iter()
            .any(|rule| rule.silent_for_doubles && settings.severity(rule.rule).is_some());
        let is_on = |rule: &PairRule| {
            settings.severity(rule.rule).is_some()
                || (rule.rule == Rule::DuplicateEntity && doubles_matter)
        };
        let rules: Vec<(usize, f64)> = PAIR_RULES
            .iter()
            .enumerate()
            .filter(|(_, rule)| is_on(rule))
            .map(|(at, rule)| (at, (rule.reach)(limits)))
            .collect();
        self.reach = rules.iter().map(|(_, reach)| *reach).fold(0.0, f64::max);
        self.grid.reserve(runs.len());
        for &run in runs {
            if let Some(outlook) = outlook(run.0) {
                let bounds = outlook.index.bounds_of_run(run.1 as usize);
                self.grid.insert(run, bounds);
                self.disturb(&bounds);
            }
        }
        // Their order is that of the contours, whatever the numbers by which these are known.
        let new: FxHashMap<RunId, usize> = runs
            .iter()
            .enumerate()
            .map(|(at, &run)| (run, at))
            .collect();
        let (mut near, mut found) = (Vec::new(), Vec::new());
        let mut left = self.left;
        let mut kept = Kept {
            outlook,
            walls: FxHashMap::default(),
        };
        for (at, &run) in runs.iter().enumerate() {
            let Some(own) = outlook(run.0) else { continue };
            if self.seen_count >= self.most_seen || left == 0 {
                self.uncompared.insert(run);
                continue;
            }
            let area = own.index.bounds_of_run(run.1 as usize).grown(self.reach);
            near.clear();
            let looked = self.grid.near(&area, |other| {
                // Two new runs are looked at once.
                if new.get(&other).is_none_or(|&its| at <= its) {
                    near.push(other);
                }
            });
            left = left.saturating_sub(looked / BOXES_OF_A_LOOK);
            if near.is_empty() {
                continue;
            }
            let Some(walls) = kept.walls_of(run) else {
                continue;
            };
            // A long line may have a box that holds half the drawing, and come near little of it.
            near.retain(|&other| {
                left = left.saturating_sub(LOOKS_OF_A_PAIR + walls.each.len() as u64);
                let theirs = outlook(other.0).map_or(Bounds::EMPTY, |theirs| {
                    theirs.index.bounds_of_run(other.1 as usize)
                });
                other == run
                    || walls.each.iter().any(|(wall, bounds)| {
                        bounds.grown(self.reach).touches(&theirs)
                            && passes(wall.geometry(), &theirs, self.reach)
                    })
            });
            for &other in &near {
                if self.seen_count >= self.most_seen || left == 0 {
                    self.uncompared.insert(run);
                    break;
                }
                let look = Look {
                    rules: &rules,
                    reach: self.reach,
                    keys: (run.0, other.0),
                };
                let looked = match kept.walls_of(other).filter(|_| other != run) {
                    Some(theirs) => look.between(&walls, &theirs, &mut found),
                    None => look.within(&walls, &mut found),
                };
                left = left.saturating_sub(looked);
                if !found.is_empty() {
                    if found.iter().any(|seen: &Seen| seen.disc.is_some()) {
                        self.stale.insert(run);
                    }
                    self.seen_count += found.len();
                    self.seen
                        .insert(ordered(run, other), std::mem::take(&mut found));
                    self.partners.entry(run).or_default().push(other);
                    if other != run {
                        self.partners.entry(other).or_default().push(run);
                    }
                }
            }
        }
        self.left = left;
        self.ask_again(&mut kept, limits);
    }

    /// Looks whether the discs of what has been seen at the stale runs are empty, while looks are left. Of the others nothing is told.
    fn ask_again(&mut self, kept: &mut Kept, limits: &Limits) {
        let mut left = self.left_to_ask;
        let stale = std::mem::take(&mut self.stale);
        let partners = stale
            .iter()
            .filter_map(|run| Some((run, self.partners.get(run)?)));
        let mut asked: Vec<(RunId, RunId)> = partners
            .flat_map(|(&run, partners)| partners.iter().map(move |&partner| ordered(run, partner)))
            .collect();
        // In the order along the contours, so that what is kept of one pair serves the next.
        let mut ranks: FxHashMap<ContourKey, u64> = FxHashMap::default();
        let outlook = kept.outlook;
        let mut rank = |key: ContourKey| {
            *ranks.entry(key).or_insert_with(|| {
                let first = outlook(key)
                    .and_then(|it| Some(it.drawing.rank(it.contour.pieces.first()?.entity)));
                first.unwrap_or(u64::MAX)
            })
        };
        let mut place = |(key, run): RunId| (rank(key), key, run);
        asked.sort_by_cached_key(|&(one, other)| {
            let (one, other) = (place(one), place(other));
            if one <= other {
                (one, other)
            } else {
                (other, one)
            }
        });
        asked.dedup();
        for pair in asked {
            let Some(mut seen) = self.seen.remove(&pair) else {
                continue;
            };
            for each in &mut seen {
                each.blocked = each.disc.is_some_and(|disc| {
                    left == 0
                        || self.reaches_into(
                            kept,
                            limits,
                            disc,
                            each.own_disc.then_some(each.one.0),
                            &mut left,
                        )
                });
            }
            if left == 0 && seen.iter().any(|each| each.disc.is_some()) {
                self.uncompared.insert(pair.0);
            }
            self.seen.insert(pair, seen);
        }
        self.left_to_ask = left;
    }

    /// True when some segment, of one contour or of all, reaches into a disc by more than rounding.
    fn reaches_into(
        &self,
        kept: &mut Kept,
        limits: &Limits,
        (center, radius): (Point, f64),
        of: Option<ContourKey>,
        left: &mut u64,
    ) -> bool {
        let radius = radius - (1e-6 * radius).max(limits.tolerances.clearance);
        let area = Bounds::of_disc(center, radius);
        let mut near = Vec::new();
        let looked = self.grid.near(&area, |run| {
            if of.is_none_or(|key| run.0 == key) {
                near.push(run);
            }
        });
        *left = left.saturating_sub(looked / BOXES_OF_A_LOOK);
        near.into_iter().any(|run| {
            kept.walls_of(run).is_some_and(|walls| {
                *left = left.saturating_sub(LOOKS_OF_A_PAIR + walls.each.len() as u64);
                walls.reach_into(&area, center, radius)
            })
        })
    }

    /// Contours that have something of `rule` between two of their own segments.
    pub fn contours_with(&self, rule: Rule) -> FxHashSet<ContourKey> {
        let own = |each: &&Seen| {
            PAIR_RULES[each.rule].rule == rule && each.one.0 == each.other.0 && !each.blocked
        };
        self.seen
            .values()
            .flatten()
            .filter(own)
            .map(|each| each.one.0)
            .collect()
    }

    /// What `narrow-slot` tells of one contour: the two segments, and the disc between them.
    pub fn slots_of(&self, key: ContourKey) -> Vec<Slot> {
        let own = |each: &&Seen| {
            PAIR_RULES[each.rule].rule == Rule::NarrowSlot
                && each.one.0 == key
                && each.other.0 == key
                && !each.blocked
        };
        self.seen
            .values()
            .flatten()
            .filter(own)
            .map(|each| ([each.one.1, each.other.1], each.disc))
            .collect()
    }

    /// The walls that `narrow-slot` has seen face each other in one contour, with their side of travel, by contour.
    pub fn slots(&self) -> FxHashMap<ContourKey, Vec<FacingWalls>> {
        let mut slots: FxHashMap<ContourKey, Vec<FacingWalls>> = FxHashMap::default();
        for each in self.seen.values().flatten() {
            if PAIR_RULES[each.rule].rule == Rule::NarrowSlot
                && each.one.0 == each.other.0
                && !each.blocked
            {
                slots
                    .entry(each.one.0)
                    .or_default()
                    .push(([each.one.1, each.other.1], each.sides.0.or(each.sides.1)));
            }
        }
        slots
    }

    /// What `lost-pocket` has seen between two segments of one contour: the contour, the two, the side of the wire, and the centre of the
    /// disc that touches them. In no order.
    pub fn dead_ends(&self) -> impl Iterator<Item = (ContourKey, [usize; 2], Side, Point)> + '_ {
        let of_rule =
            |each: &&Seen| PAIR_RULES[each.rule].rule == Rule::LostPocket && !each.blocked;
        let told = |each: &Seen| {
            Some((
                each.one.0,
                [each.one.1, each.other.1],
                each.sides.0?,
                each.disc?.0,
            ))
        };
        self.seen
            .values()
            .flatten()
            .filter(of_rule)
            .filter_map(told)
    }

    /// Entities that lie in the same place as another.
    pub fn doubled(&self, outlook: Outlooks) -> FxHashSet<EntityId> {
        let mut doubled = FxHashSet::default();
        for seen in self
            .seen
            .values()
            .flatten()
            .filter(|seen| PAIR_RULES[seen.rule].rule == Rule::DuplicateEntity)
        {
            for (key, index) in [seen.one, seen.other] {
                doubled.extend(
                    outlook(key)
                        .and_then(|outlook| outlook.segment(index as isize))
                        .map(|segment| segment.entity),
                );
            }
        }
        doubled
    }

    /// How many runs have not been compared with everything near them.
    pub fn uncompared(&self) -> usize {
        self.uncompared.len()
    }

    /// Says where segments have not been compared.
    fn report_uncompared(&self, drawing: &Drawing, outlook: Outlooks, report: &mut Report) {
        if self.uncompared.is_empty() || !report.counts(Rule::NotJudged, None) {
            return;
        }
        let first = self.uncompared.iter().filter_map(|&(key, run)| {
            outlook(key)?.place(outlook(key)?.index.range_of(run as usize).start)
        });
        let rank = |place: &Place| match place {
            Place::Segment { entity, segment } => Some((drawing.rank(*entity), *segment)),
            _ => None,
        };
        if let Some(place) = first.min_by_key(rank) {
            let left_out = NotJudged::Pairs {
                count: self.uncompared.len(),
            };
            report.add(
                Rule::NotJudged,
                None,
                place,
                Detail::NotJudged(left_out),
                Vec::new(),
            );
        }
    }

    /// Adds the findings, in the machining order of their entities.
    pub fn report(
        &self,
        drawing: &Drawing,
        outlook: Outlooks,
        wire_side: &dyn Fn(ContourKey) -> Option<Side>,
        report: &mut Report,
    ) {
        self.report_uncompared(drawing, outlook, report);
        type Ends = ((EntityId, usize), (EntityId, usize));
        let concerned = |key: ContourKey, side: Option<Side>| {
            side.is_none() || wire_side(key).is_none() || side == wire_side(key)
        };
        let mut seen: Vec<(usize, Ends, &Seen)> = Vec::new();
        for each in self.seen.values().flatten() {
            let ends = |(key, index): SegmentId| {
                outlook(key)?
                    .segment(index as isize)
                    .map(|segment| (segment.entity, segment.segment))
            };
            if !each.blocked
                && PAIR_RULES[each.rule].pair_by_pair
                && concerned(each.one.0, each.sides.0)
                && concerned(each.other.0, each.sides.1)
                && let (Some(one), Some(other)) = (ends(each.one), ends(each.other))
            {
                seen.push((each.rule, (one, other), each));
            }
        }
        let rank = |(entity, segment): (EntityId, usize)| (drawing.rank(entity), segment);
        seen.sort_unstable_by_key(|(rule, ends, _)| (*rule, rank(ends.0), rank(ends.1)));
        let is_double =
            |each: &&(usize, Ends, &Seen)| PAIR_RULES[each.0].rule == Rule::DuplicateEntity;
        let doubles: FxHashSet<(EntityId, EntityId)> = seen
            .iter()
            .filter(is_double)
            .map(|(_, ends, _)| (ends.0.0, ends.1.0))
            .collect();
        let merged = merged(
            &seen.iter().map(|(_, _, each)| *each).collect::<Vec<_>>(),
            &|key| outlook(key).map(|it| it.contour.len()),
        );
        for (at, (rule, ends, each)) in seen.iter().enumerate() {
            let rule = &PAIR_RULES[*rule];
            if rule.silent_for_doubles && doubles.contains(&(ends.0.0, ends.1.0))
                || merged.contains(&at)
            {
                continue;
            }
            let unknown = rule.warning_when_side_unknown
                && (wire_side(each.one.0).is_none() || wire_side(each.other.0).is_none());
            // Where the contour is the wire's own path it may well touch and cross itself: leads do.
            let mildest = if unknown || report.is_for_a_path() {
                Some(Severity::Warning)
            } else {
                each.mildest
            };
            if report.counts(rule.rule, mildest)
                && let (Some(own), Some(theirs)) = (outlook(each.one.0), outlook(each.other.0))
                && let (Some(one), Some(other)) = (
                    Wall::new(&own, each.one.1),
                    Wall::new(&theirs, each.other.1),
                )
                && let (Some(place), Some(related)) =
                    (own.place(each.one.1), theirs.place(each.other.1))
                && let Some(detail) = (rule.detail)(&one, &other, each.one.0 == each.other.0)
            {
                report.add(rule.rule, mildest, place, detail, vec![related]);
            }
        }
    }
}

/// False when the line or circle of a segment passes a box at more than `reach`.
fn passes(segment: &Segment, bounds: &Bounds, reach: f64) -> bool {
    let center = bounds.min + (bounds.max - bounds.min) * 0.5;
    match segment {
        Segment::Line(line) => {
            let normal = left_normal(line.direction());
            let half = (bounds.width() * normal.x.abs() + bounds.height() * normal.y.abs()) / 2.0;
            normal.dot(&(center - line.start)).abs() <= half + reach * 2.0
        }
        Segment::Arc(arc) => {
            let half_diagonal = bounds.width().hypot(bounds.height()) / 2.0;
            ((center - arc.center).norm() - arc.radius).abs() <= half_diagonal + reach * 2.0
        }
    }
}

fn ordered(one: RunId, other: RunId) -> (RunId, RunId) {
    if one <= other {
        (one, other)
    } else {
        (other, one)
    }
}

/// Which of `seen` another one stands for: of neighbouring pairs that see one thing, all but the one with the smallest disc.
fn merged(seen: &[&Seen], count_of: &dyn Fn(ContourKey) -> Option<usize>) -> FxHashSet<usize> {
    let mut at: FxHashMap<(usize, SegmentId, SegmentId), usize> = FxHashMap::default();
    let pair = |seen: &Seen| {
        if seen.one <= seen.other {
            (seen.one, seen.other)
        } else {
            (seen.other, seen.one)
        }
    };
    for (position, each) in seen
        .iter()
        .enumerate()
        .filter(|(_, each)| PAIR_RULES[each.rule].one_per_place)
    {
        let (one, other) = pair(each);
        at.insert((each.rule, one, other), position);
    }
    let mut gone = FxHashSet::default();
    let mut known = FxHashSet::default();
    let width = |position: usize| seen[position].disc.map_or(0.0, |(_, radius)| radius);
    for start in (0..seen.len()).filter(|&position| PAIR_RULES[seen[position].rule].one_per_place) {
        if !known.insert(start) {
            continue;
        }
        let (mut group, mut waiting) = (vec![start], vec![start]);
        while let Some(position) = waiting.pop() {
            let (one, other) = pair(seen[position]);
            let beside = |(key, index): SegmentId| {
                let count = count_of(key).unwrap_or(1).max(1);
                [
                    (key, index),
                    (key, (index + 1) % count),
                    (key, (index + count - 1) % count),
                ]
            };
            for one in beside(one) {
                for other in beside(other) {
                    let (one, other) = if one <= other {
                        (one, other)
                    } else {
                        (other, one)
                    };
                    if let Some(&met) = at.get(&(seen[position].rule, one, other))
                        && known.insert(met)
                    {
                        group.push(met);
                        waiting.push(met);
                    }
                }
            }
        }
        // Of equally narrow ones the first in the order of entities stays.
        let narrowest = group
            .iter()
            .copied()
            .map(width)
            .fold(f64::INFINITY, f64::min);
        let stays = group
            .iter()
            .copied()
            .filter(|&position| width(position) <= narrowest + 1e-9)
            .min();
        gone.extend(
            group
                .into_iter()
                .filter(|&position| Some(position) != stays),
        );
    }
    gone
}

/// The walls of some runs, which are met again and again by those about them.
struct Kept<'a, 'b> {
    outlook: Outlooks<'a, 'b>,
    walls: FxHashMap<RunId, Rc<Walls<'b>>>,
}

impl<'b> Kept<'_, 'b> {
    fn walls_of(&mut self, run: RunId) -> Option<Rc<Walls<'b>>> {
        if let Some(walls) = self.walls.get(&run) {
            return Some(walls.clone());
        }
        if self.walls.len() >= KEPT {
            self.walls.clear();
        }
        let walls = Rc::new(Walls::of(&(self.outlook)(run.0)?, run.1));
        self.walls.insert(run, walls.clone());
        Some(walls)
    }
}

/// The segments of a run with their boxes.
struct Walls<'a> {
    each: Vec<(Wall<'a>, Bounds)>,
    /// The box of each [`GROUP`] of them, and that of all.
    groups: Vec<Bounds>,
    all: Bounds,
}

impl<'a> Walls<'a> {
    fn of(outlook: &Outlook<'a>, run: u32) -> Walls<'a> {
        let range = outlook.index.range_of(run as usize);
        let first = range.start;
        let segments = outlook
            .contour
            .segments_in(outlook.drawing, range)
            .enumerate();
        let wall = |(along, segment): (usize, ContourSegment)| {
            let bounds = segment.geometry.bounds();
            (
                Wall {
                    outlook: *outlook,
                    index: first + along,
                    segment,
                },
                bounds,
            )
        };
        let each: Vec<(Wall, Bounds)> = segments.map(wall).collect();
        let mut all = Bounds::EMPTY;
        let groups = each.chunks(GROUP).map(|group| {
            let mut bounds = Bounds::EMPTY;
            group.iter().for_each(|(_, own)| bounds.merge(own));
            all.merge(&bounds);
            bounds
        });
        let groups = groups.collect();
        Walls { each, groups, all }
    }

    /// True when a segment comes nearer to `center` than `radius`; `area` is the box of that disc.
    fn reach_into(&self, area: &Bounds, center: Point, radius: f64) -> bool {
        let groups = self
            .each
            .chunks(GROUP)
            .zip(&self.groups)
            .filter(|(_, bounds)| bounds.touches(area));
        let mut near = groups
            .flat_map(|(group, _)| group)
            .filter(|(_, bounds)| bounds.touches(area));
        near.any(|(wall, _)| wall.geometry().distance_to(center) < radius)
    }
}

/// One look at the pairs that two runs form.
struct Look<'a> {
    /// Indices into [`PAIR_RULES`], and how far each reaches.
    rules: &'a [(usize, f64)],
    reach: f64,
    keys: (ContourKey, ContourKey),
}

impl Look<'_> {
    /// The pairs within one run. Gives back how many looks it took, as [`Look::between`] does.
    fn within(&self, walls: &Walls, found: &mut Vec<Seen>) -> u64 {
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
                for (_, other) in
                    others.filter(|(other, (_, bounds))| *other > at && area.touches(bounds))
                {
                    looks += LOOKS_OF_A_PAIR;
                    self.at(one, other, found);
                }
            }
        }
        looks
    }

    fn between(&self, walls: &Walls, others: &Walls, found: &mut Vec<Seen>) -> u64 {
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
                let near = |other: &&(Wall, Bounds)| {
                    area.touches(&other.1) && passes(one.0.geometry(), &other.1, self.reach)
                };
                for other in group.iter().filter(near) {
                    looks += LOOKS_OF_A_PAIR;
                    self.at(one, other, found);
                }
            }
        }
        looks
    }

    /// Lets the rules look at two segments whose boxes come near each other. The one of the entity that is machined earlier
    /// comes first, so that the answer depends neither on how contours are keyed nor on when an entity was drawn.
    fn at(&self, one: &(Wall, Bounds), other: &(Wall, Bounds), found: &mut Vec<Seen>) {
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
        for &(rule, reach) in self.rules {
            // What is said of the two as doubles needs no other word. A contour that doubles itself also crosses itself.
            if is_double && PAIR_RULES[rule].silent_for_doubles && own.0 != theirs.0 {
                continue;
            }
            if one.1.grown(reach).touches(&other.1) {
                for Sight {
                    sides,
                    disc,
                    own_disc,
                    mildest,
                } in (PAIR_RULES[rule].look)(&one.0, &other.0, own.0 == theirs.0)
                {
                    is_double |= PAIR_RULES[rule].rule == Rule::DuplicateEntity;
                    found.push(Seen {
                        rule,
                        one: own,
                        other: theirs,
                        sides,
                        mildest,
                        disc,
                        own_disc,
                        blocked: false,
                    });
                }
            }
        }
    }
}
