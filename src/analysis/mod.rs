//! Drawing → contours → findings, and what of it may be reused after an edit.

mod dead_ends;
mod known;
mod pairs;
mod repair;
mod report;

use crate::drawing::{
    Chains, Contour, ContourIndex, ContourKey, ContourSegment, Delta, Drawing, DrawingEdit,
    EntityId, Outline, RUN, Role, Touched, nesting_depths, stated_role,
};
use crate::finding::{Detail, Finding, Fix, FixKind, NoFix, Place, Rule, Side};
use crate::geometry::{Bounds, Point};
use crate::rules::lost_pocket::{self, Lost};
use crate::rules::small_radius::{self, Attempt, Replacement, Travel};
use crate::rules::{
    CONTOUR_RULES, Fact, LOCAL_RULES, Limits, NEIGHBOURS, Outlook, PAIR_RULES, Wall, units,
};
use crate::settings::{Compensation, Effective, SideSetting};
use crate::toolpath;
use known::Known;
use pairs::{Pairs, RunId};
use repair::Can;
use report::{Report, Tally};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeSet;
use std::iter::once;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// Up to so many touched places are looked at one by one, however small the drawing is.
const FEW: usize = 16;
/// Where an edit takes more contours than these apart, and a good part of all, everything is looked at anew.
const MANY: usize = 256;
/// Segments that are looked at to say which repairs of arcs below the correction would bring another fault.
const MOST_TRIED: usize = 40_000;

/// What of a contour that has something to tell is asked at every report, so that those beyond the limit of a report are not
/// looked at.
#[derive(Clone, Copy, Debug)]
struct Loud {
    /// The first of its entities in machining order.
    first: EntityId,
    has_tight_arcs: bool,
    has_facts: bool,
    /// A rule on whole contours holds.
    as_a_whole: bool,
    /// How many of its arcs are below the correction with the wire on a side, once they have been counted.
    faults: Option<(Option<Side>, usize)>,
}

/// What the offset of a contour loses.
#[derive(Clone, Debug)]
struct Answer {
    /// What was asked: the side, and whether there is a neck.
    asked: (Side, bool),
    lost: Vec<Lost>,
    /// What stands against a path, where nothing is lost; `None` while that has not been asked.
    misfit: Option<Option<Box<Finding>>>,
}

/// What is known of one drawing under one set of settings.
#[derive(Clone, Debug)]
pub struct Analysis {
    settings: Arc<Effective>,
    limits: Limits,
    chains: Chains,
    known: FxHashMap<ContourKey, Known>,
    /// Contours that have something to tell without a look at others: most have not.
    loud: FxHashMap<ContourKey, Loud>,
    /// Contours larger than any machine.
    vast: FxHashSet<ContourKey>,
    /// How many contours have a stated role.
    stated: usize,
    /// An entity that was removed and may come back nearly as it was, as one does in whose text a number is being typed: all
    /// that is known of it is kept until the next change. Nothing of it shows, since the drawing does not hold it.
    asleep: Option<EntityId>,
    pairs: Pairs,
    /// Whether a fix was found for a fault, and the region that the answer depends on.
    answers: FxHashMap<(ContourKey, usize), (Option<NoFix>, Bounds)>,
    /// What the offset of a contour loses, for a side and with or without a neck.
    lost: FxHashMap<ContourKey, Answer>,
    order: OnceLock<Vec<ContourKey>>,
    outlines: OnceLock<Arc<Vec<Outline>>>,
    /// What there is to be said in all, once it has been asked for.
    tally: OnceLock<Tally>,
}

impl Analysis {
    pub fn new(drawing: &Drawing, settings: Arc<Effective>) -> Analysis {
        let limits = Limits::new(&settings, settings.unit_of(drawing).mm);
        let chains = Chains::new(drawing, limits.tolerances.join, &|id| {
            is_cut(drawing, &settings, id)
        });
        let mut analysis = Analysis {
            settings,
            limits,
            chains,
            known: FxHashMap::default(),
            loud: FxHashMap::default(),
            vast: FxHashSet::default(),
            stated: 0,
            asleep: None,
            pairs: Pairs::default(),
            answers: FxHashMap::default(),
            lost: FxHashMap::default(),
            order: OnceLock::new(),
            outlines: OnceLock::new(),
            tally: OnceLock::new(),
        };
        // In machining order: where not all is compared, it is the same that is left out, however the drawing came about.
        let keys = analysis.in_machining_order(drawing).to_vec();
        let segments = keys
            .iter()
            .filter_map(|&key| analysis.chains.get(key))
            .map(Contour::len)
            .sum();
        analysis.pairs = Pairs::new(&analysis.settings.budget, segments);
        analysis.known.reserve(keys.len());
        analysis.learn(drawing, &keys);
        analysis
    }

    /// Looks again at what `delta` touched. Same result as a fresh [`Analysis::new`].
    pub fn update(&mut self, drawing: &Drawing, delta: &Delta) {
        if self.pairs.is_within_budget() {
            self.look_at_touched(drawing, delta);
        }
        if !self.pairs.is_within_budget() {
            *self = Analysis::new(drawing, self.settings.clone());
        }
    }

    fn look_at_touched(&mut self, drawing: &Drawing, delta: &Delta) {
        self.tally = OnceLock::new();
        let limits = Limits::new(&self.settings, self.settings.unit_of(drawing).mm);
        if limits != self.limits || delta.touched.contains(&Touched::All) || self.is_most(delta) {
            *self = Analysis::new(drawing, self.settings.clone());
            return;
        }
        if !delta.touched.is_empty() {
            self.outlines = OnceLock::new();
        }
        let mut moved = Vec::new();
        let asleep = self.asleep.take();
        match (asleep, delta.touched.as_slice()) {
            (Some(_), []) => {
                self.asleep = asleep;
                return;
            }
            (Some(entity), [Touched::Vertices { entity: woken, .. }]) if *woken == entity => {
                self.order = OnceLock::new()
            }
            (Some(entity), _) => moved.push(entity),
            (None, [Touched::Removed { entity }]) if self.may_sleep(*entity) => {
                self.asleep = Some(*entity);
                self.order = OnceLock::new();
                return;
            }
            (None, _) => {}
        }
        for touched in &delta.touched {
            let (entity, vertices) = match *touched {
                Touched::Vertices {
                    entity,
                    start,
                    removed,
                    inserted,
                } => (entity, Some((start, removed, inserted))),
                Touched::Entity { entity } | Touched::Removed { entity } => (entity, None),
                Touched::All => continue,
            };
            let stays =
                self.chains
                    .same_ends(drawing, entity, is_cut(drawing, &self.settings, entity));
            if !stays || !self.look_again(drawing, entity, vertices) {
                moved.push(entity);
            }
        }
        if moved.is_empty() {
            return;
        }
        self.order = OnceLock::new();
        let settings = self.settings.clone();
        let rechained = self
            .chains
            .update(drawing, &moved, &|id| is_cut(drawing, &settings, id));
        // Thousands of contours with ends in one place are one group, and lie on each other: to forget each of them costs a look at all.
        let gone = rechained.gone.len();
        if gone > MANY && gone * 4 > self.known.len() {
            *self = Analysis::new(drawing, settings);
            return;
        }
        for key in &rechained.gone {
            self.lost.remove(key);
            self.loud.remove(key);
            self.vast.remove(key);
            if let Some(known) = self.take_known(*key) {
                self.pairs.forget(*key, &known.index);
            }
        }
        let gone: FxHashSet<ContourKey> = rechained.gone.into_iter().collect();
        self.answers.retain(|(key, _), _| !gone.contains(key));
        self.learn(drawing, &rechained.new);
    }

    /// True for an entity that is a contour of its own, and in the way of nothing that has been seen of others.
    fn may_sleep(&self, entity: EntityId) -> bool {
        let key = self.chains.contour_of(entity);
        let contour = key.and_then(|key| self.chains.get(key));
        contour.is_some_and(|contour| contour.closed && contour.pieces.len() == 1)
            && key.is_some_and(|key| self.pairs.may_spare(key))
    }

    fn enter_known(&mut self, key: ContourKey, known: Known) {
        self.stated += usize::from(known.stated.is_some());
        self.known.insert(key, known);
    }

    fn take_known(&mut self, key: ContourKey) -> Option<Known> {
        let known = self.known.remove(&key)?;
        self.stated -= usize::from(known.stated.is_some());
        Some(known)
    }

    /// Takes down whether a contour has something to tell.
    fn listen_to(&mut self, drawing: &Drawing, key: ContourKey) {
        let of_contour = |outlook: Outlook| CONTOUR_RULES.iter().any(|rule| (rule.holds)(&outlook));
        let known = self.known.get(&key);
        let loud = self.chains.first_of(key).map(|first| Loud {
            first,
            has_tight_arcs: known.is_some_and(|known| known.index.tight().next().is_some()),
            has_facts: known.is_some_and(Known::has_facts),
            as_a_whole: self.outlook(drawing, key).is_some_and(of_contour),
            faults: None,
        });
        match loud.filter(|loud| loud.has_tight_arcs || loud.has_facts || loud.as_a_whole) {
            Some(loud) => drop(self.loud.insert(key, loud)),
            None => drop(self.loud.remove(&key)),
        }
        if self
            .known
            .get(&key)
            .is_some_and(|known| units::is_vast(&known.index.bounds(), self.limits.unit_mm))
        {
            self.vast.insert(key);
        } else {
            self.vast.remove(&key);
        }
    }

    /// The contours that have something to tell, in machining order.
    fn loud_in_order(&self, drawing: &Drawing) -> Vec<ContourKey> {
        // What sleeps is not in the drawing.
        let awake = self
            .loud
            .iter()
            .filter(|(_, loud)| Some(loud.first) != self.asleep);
        let mut loud: Vec<(u64, ContourKey)> = awake
            .map(|(&key, loud)| (drawing.rank(loud.first), key))
            .collect();
        loud.sort_unstable();
        loud.into_iter().map(|(_, key)| key).collect()
    }

    /// What holds of `drawing` once `delta` has been made to the drawing that this is of.
    fn updated(&self, drawing: &Drawing, delta: &Delta) -> Analysis {
        if self.is_most(delta) {
            return Analysis::new(drawing, self.settings.clone());
        }
        // What is only tried does not ask for a look at everything.
        let mut analysis = self.clone();
        analysis.pairs.refill();
        analysis.look_at_touched(drawing, delta);
        analysis
    }

    /// True when a look at all that is touched costs more than a look at everything.
    fn is_most(&self, delta: &Delta) -> bool {
        let touched = delta.touched.len();
        touched > FEW && touched * RUN > self.known.values().map(|known| known.index.len()).sum()
    }

    /// The settings that the findings hold under.
    pub fn settings(&self) -> &Arc<Effective> {
        &self.settings
    }

    /// Contours with their roles, in machining order. Cheap to keep as a snapshot.
    pub fn outlines(&self, drawing: &Drawing) -> &Arc<Vec<Outline>> {
        self.outlines.get_or_init(|| {
            let ordered = self.in_machining_order(drawing);
            let roles = self.roles(drawing, ordered);
            let outline = |(key, role): (ContourKey, Role)| {
                let contour = self.chains.get(key)?.clone();
                let twice_area = if contour.closed {
                    self.known.get(&key)?.index.twice_area()
                } else {
                    0.0
                };
                Some(Outline {
                    contour,
                    role,
                    twice_area,
                })
            };
            Arc::new(
                ordered
                    .iter()
                    .copied()
                    .zip(roles)
                    .filter_map(outline)
                    .collect(),
            )
        })
    }

    /// At most `limit` findings, errors first, then in machining order; and how many there are in all.
    pub fn findings(&mut self, drawing: &Drawing, limit: usize) -> (Vec<Finding>, usize) {
        let (mut findings, count) = self.report(drawing, limit).finish();
        self.give_reasons(drawing, &mut findings);
        (findings, count)
    }

    /// Says of arcs whose repair would bring another fault that there is none. Each takes a look at the drawing: in one where that would be
    /// more than [`MOST_TRIED`] segments in all, it is found out when the repair is asked for.
    fn give_reasons(&self, drawing: &Drawing, findings: &mut [Finding]) {
        let mut hopeful: Vec<(&mut crate::finding::SmallRadius, EntityId, usize)> = findings
            .iter_mut()
            .filter_map(|finding| match (&mut finding.detail, &finding.place) {
                (Detail::SmallRadius(numbers), Place::Segment { entity, segment })
                    if numbers.no_fix.is_none() =>
                {
                    Some((&mut **numbers, *entity, *segment))
                }
                _ => None,
            })
            .collect();
        let segments: usize = self.known.values().map(|known| known.index.len()).sum();
        if hopeful.len().saturating_mul(segments) > MOST_TRIED {
            return;
        }
        for (numbers, entity, segment) in &mut hopeful {
            let at = self.chains.index_of(*entity, *segment);
            if at.is_some_and(|(key, index)| self.larger_arc(drawing, key, index).is_none()) {
                numbers.no_fix = Some(NoFix::Spoils);
            }
        }
    }

    /// The repair of an arc below the correction that puts one larger arc in the place of its run, where that leaves the drawing
    /// better than it is.
    fn larger_arc(&self, drawing: &Drawing, key: ContourKey, index: usize) -> Option<Fix> {
        let (travel, attempt) = self.attempt(drawing, key, index)?;
        let replacement = attempt.outcome.ok()?;
        let kind = FixKind::Refillet {
            radius: replacement.arc.radius,
            arcs: replacement.arcs,
            moved: replacement.moved,
        };
        let in_fix_all = replacement.moved <= self.limits.correction;
        let edit = small_radius::drawing_edit(drawing, &[(travel, replacement)])
            .filter(|edit| self.enlarges(drawing, edit, None))?;
        Some(Fix {
            kind,
            preferred: true,
            in_fix_all,
            edit,
        })
    }

    /// How many findings of which kind there are.
    fn tally(&mut self, drawing: &Drawing) -> Tally {
        Tally {
            unseen: self.pairs.uncompared(),
            ..self.report(drawing, 0).tally()
        }
    }

    fn report(&mut self, drawing: &Drawing, limit: usize) -> Report {
        let mut report = Report::new(self.settings.clone(), limit);
        // By nesting, the role of each depends on all.
        let nested: Option<FxHashMap<ContourKey, Role>> = (self.settings.side == SideSetting::Auto)
            .then(|| {
                let ordered = self.in_machining_order(drawing);
                ordered
                    .iter()
                    .copied()
                    .zip(self.roles(drawing, ordered))
                    .collect()
            });
        // Where nothing states a role and none depends on nesting.
        let everywhere = self.settings.side.role().filter(|_| self.stated == 0);
        let role_of = |analysis: &Analysis, key: ContourKey| match &nested {
            Some(roles) => roles.get(&key).copied().unwrap_or(Role::Both),
            None if everywhere.is_some() => everywhere.unwrap_or(Role::Both),
            None => analysis
                .roles(drawing, &[key])
                .first()
                .copied()
                .unwrap_or(Role::Both),
        };
        let side_of =
            |analysis: &Analysis, key: ContourKey| analysis.wire_side(key, role_of(analysis, key));
        let ends = self.dead_ends(drawing, &|key| side_of(self, key));
        let loud: Vec<(ContourKey, Option<Side>)> = self
            .loud_in_order(drawing)
            .into_iter()
            .map(|key| (key, side_of(self, key)))
            .collect();
        for &(key, wire_side) in &loud {
            self.report_small_radii(drawing, key, wire_side, &mut report);
        }
        for &(key, wire_side) in &loud {
            if self.loud.get(&key).is_some_and(|loud| loud.has_facts)
                && let (Some(known), Some(outlook)) =
                    (self.known.get(&key), self.outlook(drawing, key))
            {
                known.report(&outlook, wire_side, &mut report);
            }
        }
        let as_a_whole = |key: &ContourKey| self.loud.get(key).is_some_and(|loud| loud.as_a_whole);
        self.report_contours(
            drawing,
            loud.iter().map(|(key, _)| *key).filter(as_a_whole),
            &mut report,
        );
        self.report_size(drawing, &mut report);
        self.pairs.report(
            drawing,
            &|key| self.outlook(drawing, key),
            &|key| side_of(self, key),
            &mut report,
        );
        self.report_dead_ends(drawing, &ends, &mut report);
        if self.settings.side != SideSetting::Both || self.stated > 0 {
            let ordered = self.in_machining_order(drawing).to_vec();
            let sides: Vec<Option<Side>> = ordered.iter().map(|&key| side_of(self, key)).collect();
            self.report_lost_pockets(drawing, &ordered, &sides, &mut report);
        }
        report
    }

    /// What the rules on whole contours see.
    fn report_contours(
        &self,
        drawing: &Drawing,
        keys: impl Iterator<Item = ContourKey>,
        report: &mut Report,
    ) {
        let outlook = |key| self.outlook(drawing, key);
        let concerned: Vec<Outlook> = keys
            .filter_map(outlook)
            .filter(|outlook| outlook.contour.pieces.len() > 1 || !outlook.contour.closed)
            .filter(|outlook| CONTOUR_RULES.iter().any(|rule| (rule.holds)(outlook)))
            .collect();
        if concerned.is_empty() {
            return;
        }
        let doubled = self.pairs.doubled(&outlook);
        for rule in CONTOUR_RULES {
            let mildest = (rule.mildest)(&self.settings);
            for outlook in concerned
                .iter()
                .copied()
                .filter(|outlook| (rule.holds)(outlook))
            {
                // What lies there twice is reported as that.
                if !outlook
                    .contour
                    .pieces
                    .iter()
                    .all(|piece| doubled.contains(&piece.entity))
                    && report.counts(rule.rule, mildest)
                    && let (Some((place, related)), Some(detail)) =
                        ((rule.places)(&outlook), (rule.detail)(&outlook))
                {
                    report.add(rule.rule, mildest, place, detail, related);
                }
            }
        }
    }

    /// Sizes that speak for another unit than the drawing's: of the largest contour.
    fn report_size(&self, drawing: &Drawing, report: &mut Report) {
        // What sleeps is not in the drawing.
        let is_there = |key: ContourKey| {
            self.chains
                .first_of(key)
                .is_some_and(|first| drawing.get(first).is_some())
        };
        let bounds_of = |key: ContourKey| {
            self.known
                .get(&key)
                .filter(|_| is_there(key))
                .map(|known| known.index.bounds())
        };
        let mut keys = self.known.keys().copied();
        let is_large = self.vast.iter().any(|&key| is_there(key));
        let is_absurd = is_large
            || (self.known.keys().any(|&key| is_there(key))
                && !keys.any(|key| {
                    bounds_of(key)
                        .is_some_and(|bounds| units::is_sizable(&bounds, self.limits.unit_mm))
                }));
        if is_absurd && report.counts(Rule::Units, None) {
            let all: Box<dyn Iterator<Item = &ContourKey>> = if is_large {
                Box::new(self.vast.iter())
            } else {
                Box::new(self.known.keys())
            };
            let size = all
                .filter_map(|&key| bounds_of(key))
                .map(|bounds| units::size(&bounds))
                .fold(0.0, f64::max);
            report.add(
                Rule::Units,
                None,
                Place::Document,
                Detail::Size { size },
                Vec::new(),
            );
        }
    }

    /// What the offsets of contours with a known wire side lose.
    fn report_lost_pockets(
        &mut self,
        drawing: &Drawing,
        ordered: &[ContourKey],
        sides: &[Option<Side>],
        report: &mut Report,
    ) {
        let is_on = |rule| self.settings.severity(rule).is_some();
        let of_rules = [Rule::LostPocket, Rule::OffsetCollapse, Rule::UnprovedPath]
            .into_iter()
            .any(is_on);
        if !of_rules || sides.iter().all(Option::is_none) {
            return;
        }
        // Without the rules that see them, a neck is taken for granted, and a crossing for none.
        let necks = is_on(Rule::NarrowSlot).then(|| self.pairs.contours_with(Rule::NarrowSlot));
        let crossed = self.pairs.contours_with(Rule::SelfIntersection);
        for (&key, &side) in ordered.iter().zip(sides) {
            let Some(side) = side.filter(|_| !crossed.contains(&key)) else {
                continue;
            };
            let asked = (
                side,
                necks.as_ref().is_none_or(|necks| necks.contains(&key)),
            );
            if self
                .lost
                .get(&key)
                .is_none_or(|answer| answer.asked != asked)
            {
                let Some(outlook) = self.outlook(drawing, key) else {
                    continue;
                };
                let lost = lost_pocket::look(&outlook, side, asked.1);
                self.lost.insert(
                    key,
                    Answer {
                        asked,
                        lost,
                        misfit: None,
                    },
                );
            }
            // Fixes are held against each other by what is cheap to know.
            if report.shows_findings()
                && self
                    .lost
                    .get(&key)
                    .is_some_and(|answer| answer.lost.is_empty() && answer.misfit.is_none())
            {
                let misfit = self.misfit(drawing, key, side).map(Box::new);
                if let Some(answer) = self.lost.get_mut(&key) {
                    answer.misfit = Some(misfit);
                }
            }
            let (Some(Answer { lost, misfit, .. }), Some(outlook)) =
                (self.lost.get(&key), self.outlook(drawing, key))
            else {
                continue;
            };
            let misfit = misfit.iter().flatten().next();
            let slots = if lost.is_empty() && misfit.is_none() || necks.is_none() {
                Vec::new()
            } else {
                self.pairs.slots_of(key)
            };
            // What a slot is told of is not told again as what is lost in it.
            let is_told = |near: Point, index: usize| {
                slots.iter().any(|(walls, disc)| match disc {
                    Some((center, radius)) => {
                        (near - center).norm() <= radius + self.limits.correction
                    }
                    None => walls.contains(&index),
                })
            };
            for lost in lost {
                if matches!(*lost, Lost::Pocket { near, index } if is_told(near, index)) {
                    continue;
                }
                let (rule, index, detail) = match *lost {
                    Lost::All => (
                        Rule::OffsetCollapse,
                        0,
                        Detail::OffsetCollapse {
                            required: self.limits.correction,
                            point: false,
                        },
                    ),
                    Lost::Pocket { near, index } => {
                        (Rule::LostPocket, index, Detail::LostPocket { near })
                    }
                };
                if report.counts(rule, None)
                    && let Some(place) = outlook.place(index)
                {
                    report.add(rule, None, place, detail, Vec::new());
                }
            }
            if let Some(Finding {
                rule,
                severity,
                place,
                detail,
                ..
            }) = misfit.map(Box::as_ref)
            {
                let index = match *place {
                    Place::Segment { entity, segment } => self
                        .chains
                        .index_of(entity, segment)
                        .map(|(_, index)| index),
                    _ => None,
                };
                let near = |near: Point| is_told(near, index.unwrap_or(usize::MAX));
                if !matches!(*detail, Detail::LostPocket { near: at } if near(at))
                    && report.counts(*rule, Some(*severity))
                {
                    report.add(
                        *rule,
                        Some(*severity),
                        place.clone(),
                        detail.clone(),
                        Vec::new(),
                    );
                }
            }
        }
    }

    /// What stands against a path of the wire on `side` of a contour; `None` for one that is too long to ask at every edit, that is the
    /// wire's path itself, or of whose arcs each says so.
    fn misfit(&self, drawing: &Drawing, key: ContourKey, side: Side) -> Option<Finding> {
        let (contour, known) = (self.chains.get(key)?, self.known.get(&key)?);
        if !contour.closed
            || contour.len() > lost_pocket::MOST_SEGMENTS
            || self.settings.compensation == Compensation::None
        {
            return None;
        }
        if known.index.tight().count() == contour.len() {
            return None;
        }
        let twice_area = known.index.twice_area();
        let role = if side.sign() * twice_area > 0.0 {
            Role::Opening
        } else {
            Role::Punch
        };
        toolpath::misfit(
            drawing,
            &Outline {
                contour: contour.clone(),
                role,
                twice_area,
            },
            &self.settings,
        )
    }

    /// Arcs below the correction in one contour.
    fn report_small_radii(
        &mut self,
        drawing: &Drawing,
        key: ContourKey,
        wire_side: Option<Side>,
        report: &mut Report,
    ) {
        let Some(loud) = self.loud.get(&key).filter(|loud| loud.has_tight_arcs) else {
            return;
        };
        if let Some((_, count)) = loud.faults.filter(|(side, _)| *side == wire_side)
            && report.is_full(Rule::SmallRadius, None)
        {
            report.count(Rule::SmallRadius, None, count);
            return;
        }
        let tight: Vec<usize> = self
            .known
            .get(&key)
            .map_or_else(Vec::new, |known| known.index.tight().collect());
        let mut count = 0;
        for index in tight {
            let Some((segment, mut numbers)) = self.fault(drawing, key, index, wire_side) else {
                continue;
            };
            count += 1;
            if report.counts(Rule::SmallRadius, None) {
                numbers.no_fix = self.answer(drawing, key, index);
                let place = Place::Segment {
                    entity: segment.entity,
                    segment: segment.segment,
                };
                report.add(
                    Rule::SmallRadius,
                    None,
                    place,
                    Detail::SmallRadius(Box::new(numbers)),
                    Vec::new(),
                );
            }
        }
        if let Some(loud) = self.loud.get_mut(&key) {
            loud.faults = Some((wire_side, count));
        }
    }

    /// The fixes of one finding, the preferred one first; empty where none is right.
    pub fn fixes(&self, drawing: &Drawing, finding: &Finding) -> Vec<Fix> {
        let Place::Segment { entity, segment } = &finding.place else {
            return Vec::new();
        };
        if finding.rule != Rule::SmallRadius {
            return self.checked(
                drawing,
                finding.rule,
                self.other_fixes(drawing, finding, (*entity, *segment))
                    .unwrap_or_default(),
            );
        }
        let Some((key, index)) = self.chains.index_of(*entity, *segment) else {
            return Vec::new();
        };
        let mut fixes = Vec::new();
        let found = self
            .attempt(drawing, key, index)
            .and_then(|(_, attempt)| attempt.outcome.ok());
        let old = self
            .chains
            .get(key)
            .and_then(|contour| contour.segment(drawing, index))
            .map(|segment| segment.geometry);
        let is_notch = found.zip(old).is_some_and(|(replacement, old)| {
            let ends = [old.start(), old.end()];
            ends.contains(&replacement.arc.start) && ends.contains(&replacement.arc.end)
        });
        fixes.extend(self.larger_arc(drawing, key, index));
        let place = self
            .chains
            .get(key)
            .and_then(|contour| contour.segment(drawing, index));
        if let Some(place) = place.filter(|_| !is_notch)
            && let Some((edit, kink)) = small_radius::keep_end_points(drawing, &place, &self.limits)
            && self.enlarges(drawing, &edit, Some(Rule::LostPocket))
        {
            let kind = FixKind::KeepEndPoints {
                radius: self.limits.fix_radius,
                kink,
            };
            fixes.push(Fix {
                kind,
                preferred: false,
                in_fix_all: false,
                edit,
            });
        }
        fixes
    }

    /// The fixes of a finding of any rule but `small-radius`.
    fn other_fixes(
        &self,
        drawing: &Drawing,
        finding: &Finding,
        at: (EntityId, usize),
    ) -> Option<Vec<Fix>> {
        let (key, index) = self.chains.index_of(at.0, at.1)?;
        let outlook = self.outlook(drawing, key)?;
        if let Some(rule) = LOCAL_RULES.iter().find(|local| local.rule == finding.rule) {
            // A hint that stands for many corners is no place to mend one of them.
            if matches!(finding.detail, Detail::SharpCorner { count: Some(count), .. } if count > 1)
            {
                return None;
            }
            return Some((rule.fixes)(
                &outlook,
                Fact {
                    index: index as u32,
                    side: None,
                    needs_side: false,
                },
            ));
        }
        if let Some(rule) = CONTOUR_RULES.iter().find(|rule| rule.rule == finding.rule) {
            return Some((rule.fixes)(&outlook));
        }
        let rule = PAIR_RULES.iter().find(|pair| pair.rule == finding.rule)?;
        let Place::Segment { entity, segment } = finding.related.first()? else {
            return None;
        };
        let (other_key, other_index) = self.chains.index_of(*entity, *segment)?;
        let theirs = self.outlook(drawing, other_key)?;
        Some((rule.fixes)(
            &Wall::new(&outlook, index)?,
            &Wall::new(&theirs, other_index)?,
        ))
    }

    fn outlook<'a>(&'a self, drawing: &'a Drawing, key: ContourKey) -> Option<Outlook<'a>> {
        let contour = self.chains.get(key)?;
        Some(Outlook {
            drawing,
            contour,
            index: &self.known.get(&key)?.index,
            limits: &self.limits,
        })
    }

    /// One edit that makes every safe fix; `None` where there is none.
    ///
    /// Doubles first, then arcs; where there are none to be mended, what the other rules can mend safely, one rule at a time: call
    /// again until nothing is left.
    pub fn fix_all(&self, drawing: &Drawing) -> Option<DrawingEdit> {
        self.fix_all_of(drawing, None)
    }

    /// As [`Analysis::fix_all`], of the fixes that `can` says can be made.
    pub fn fix_all_that(
        &self,
        drawing: &Drawing,
        can: &dyn Fn(&DrawingEdit) -> bool,
    ) -> Option<DrawingEdit> {
        self.fix_all_of(drawing, Some(can))
    }

    fn fix_all_of(&self, drawing: &Drawing, can: Can<'_>) -> Option<DrawingEdit> {
        let doubles = self.fix_all_else(drawing, &repair::FIRST, can);
        doubles
            .or_else(|| self.fix_all_arcs(drawing, can))
            .or_else(|| self.fix_all_else(drawing, &repair::THEN, can))
    }

    fn fix_all_arcs(&self, drawing: &Drawing, can: Can<'_>) -> Option<DrawingEdit> {
        self.settings.severity(Rule::SmallRadius)?;
        let mut replacements = Vec::new();
        for (key, wire_side) in self.with_tight_arcs(drawing) {
            let mut accepted: Vec<(Stretch, Travel, Replacement)> = Vec::new();
            for index in self.tight_in_entity_order(key) {
                if self.fault(drawing, key, index, wire_side).is_none() {
                    continue;
                }
                let Some((
                    travel,
                    Attempt {
                        outcome: Ok(replacement),
                        ..
                    },
                )) = self.attempt(drawing, key, index)
                else {
                    continue;
                };
                let stretch = Stretch::of(&travel, &replacement);
                let free = accepted
                    .first()
                    .is_none_or(|(first, ..)| !first.overlaps(&stretch))
                    && accepted
                        .last()
                        .is_none_or(|(last, ..)| !last.overlaps(&stretch));
                if !free || replacement.moved > self.limits.correction {
                    continue;
                }
                let alone = [(travel, replacement)];
                let can_be_made = can.is_none_or(|can| {
                    small_radius::drawing_edit(drawing, &alone).is_some_and(|edit| can(&edit))
                });
                let [(travel, replacement)] = alone;
                if can_be_made {
                    accepted.push((stretch, travel, replacement));
                }
            }
            replacements.extend(
                accepted
                    .into_iter()
                    .map(|(_, travel, replacement)| (travel, replacement)),
            );
        }
        repair::most_together(&replacements, self.tries(), |together, _| {
            small_radius::drawing_edit(drawing, together)
                .filter(|edit| self.enlarges(drawing, edit, None))
        })
    }

    /// Contours that have tight arcs, in machining order, with the wire side of each.
    fn with_tight_arcs(&self, drawing: &Drawing) -> Vec<(ContourKey, Option<Side>)> {
        let ordered = self.in_machining_order(drawing);
        let roles = self.roles(drawing, ordered);
        let tight = ordered.iter().zip(roles).filter(|(key, _)| {
            self.known
                .get(key)
                .is_some_and(|known| known.index.tight().next().is_some())
        });
        tight
            .map(|(&key, role)| (key, self.wire_side(key, role)))
            .collect()
    }

    fn wire_side(&self, key: ContourKey, role: Role) -> Option<Side> {
        if !matches!(role, Role::Opening | Role::Punch) {
            return None;
        }
        let closed = self.chains.get(key)?.closed;
        crate::drawing::wire_side(role, closed, self.known.get(&key)?.index.twice_area())
    }

    fn tight_in_entity_order(&self, key: ContourKey) -> Vec<usize> {
        self.known
            .get(&key)
            .map_or_else(Vec::new, |known| known.index.tight().collect())
    }

    fn fault(
        &self,
        drawing: &Drawing,
        key: ContourKey,
        index: usize,
        wire_side: Option<Side>,
    ) -> Option<(ContourSegment, crate::finding::SmallRadius)> {
        let segment = self.chains.get(key)?.segment(drawing, index)?;
        Some((
            segment,
            small_radius::check(&segment, wire_side, &self.limits)?,
        ))
    }

    /// The replacement of the run that holds a tight arc, looked for on the side of its centre.
    fn attempt<'a>(
        &'a self,
        drawing: &'a Drawing,
        key: ContourKey,
        index: usize,
    ) -> Option<(Travel<'a>, Attempt)> {
        let contour = self.chains.get(key)?;
        let segment = contour.segment(drawing, index)?;
        let arc = *segment.geometry.as_arc()?;
        let travel = Travel {
            drawing,
            contour,
            index: &self.known.get(&key)?.index,
            side: small_radius::center_side(arc.sweep),
        };
        if !drawing.is_editable(segment.entity) {
            // Whatever a search would find, it could not be made; and a fitted curve may have a million tight arcs.
            return Some((
                travel,
                Attempt {
                    outcome: Err(NoFix::NotEditable),
                    region: segment.geometry.bounds(),
                },
            ));
        }
        let position = travel.position_of(index);
        let run = small_radius::run_of(&travel, position, &self.limits)?;
        let mut attempt = small_radius::refillet(&travel, &run, &self.limits);
        // Where the arc was drawn in two and rounded, the two are one run all the same.
        if attempt.outcome.is_err()
            && let Some(longer) = small_radius::rounded_run_of(&travel, position, &self.limits)
                .filter(|longer| *longer != run)
        {
            let again = small_radius::refillet(&travel, &longer, &self.limits);
            let mut region = attempt.region;
            region.merge(&again.region);
            attempt = Attempt {
                outcome: again.outcome.or(attempt.outcome),
                region,
            };
        }
        if let Ok(replacement) = &attempt.outcome
            && !(replacement.before..=replacement.after).all(|position| {
                travel
                    .segment(position)
                    .is_none_or(|segment| drawing.is_editable(segment.entity))
            })
        {
            attempt.outcome = Err(NoFix::NotEditable);
        }
        Some((travel, attempt))
    }

    /// Why a fault has no fix, `None` where it has one; remembered until something near it changes.
    fn answer(&mut self, drawing: &Drawing, key: ContourKey, index: usize) -> Option<NoFix> {
        if let Some((answer, _)) = self.answers.get(&(key, index)) {
            return *answer;
        }
        let (_, attempt) = self.attempt(drawing, key, index)?;
        let answer = attempt.outcome.err();
        self.answers.insert((key, index), (answer, attempt.region));
        answer
    }

    /// Number of arcs below the correction in some entities.
    fn tight(&self, drawing: &Drawing, entities: &FxHashSet<EntityId>) -> usize {
        let entities = entities.iter().filter_map(|&id| drawing.get(id));
        let arcs = entities.flat_map(|entity| entity.geometry.segments_of(drawing.flat()));
        arcs.filter(|segment| {
            segment
                .as_arc()
                .is_some_and(|arc| small_radius::is_too_small(arc.radius, &self.limits))
        })
        .count()
    }

    /// Looks at whole contours for the first time.
    fn learn(&mut self, drawing: &Drawing, keys: &[ContourKey]) {
        let mut runs = Vec::new();
        for &key in keys {
            let Some(contour) = self.chains.get(key) else {
                continue;
            };
            let index = ContourIndex::new(
                drawing,
                contour,
                self.limits.correction - self.limits.tolerances.report,
            );
            let mut known = Known::new(
                index,
                stated_role(contour, &|id| role_of(drawing, &self.settings, id)),
            );
            known.look(
                drawing,
                contour,
                &self.limits,
                &self.settings,
                0..contour.len(),
            );
            runs.extend((0..known.index.run_count()).map(|run| (key, run as u32)));
            self.enter_known(key, known);
            self.listen_to(drawing, key);
        }
        self.look_at_pairs(drawing, &runs);
    }

    /// Looks at the pairs of segments that the runs form with each other and with others; the runs are new or have been
    /// forgotten.
    fn look_at_pairs(&mut self, drawing: &Drawing, runs: &[RunId]) {
        let mut pairs = std::mem::take(&mut self.pairs);
        let outlook = |key| self.outlook(drawing, key);
        pairs.look(&outlook, &self.limits, &self.settings, runs);
        self.pairs = pairs;
    }

    /// Looks again at an entity whose contour still runs as it did. False where it is in none.
    fn look_again(
        &mut self,
        drawing: &Drawing,
        entity: EntityId,
        vertices: Option<(usize, usize, usize)>,
    ) -> bool {
        let Some(key) = self.chains.contour_of(entity) else {
            return drawing
                .get(entity)
                .is_none_or(|e| e.geometry.segment_count() == 0);
        };
        let Some(geometry) = drawing.get(entity).map(|entity| &entity.geometry) else {
            return false;
        };
        let Some(before) = self.chains.piece_of(entity) else {
            return false;
        };
        let recounted = before.count() != geometry.segment_count();
        if recounted {
            self.chains.recount(drawing, entity);
            self.answers.retain(|(other, _), _| *other != key);
        }
        self.lost.remove(&key);
        let (Some(piece), Some(mut known)) = (self.chains.piece_of(entity), self.take_known(key))
        else {
            return false;
        };
        let Some(contour) = self.chains.get(key) else {
            return false;
        };
        if vertices.is_none() {
            known.stated = stated_role(contour, &|id| role_of(drawing, &self.settings, id));
        }
        // What holds of a whole entity is kept with its first and last segment.
        let mut own = segments_of(vertices, piece.count(), geometry.is_closed());
        if piece.count() > 0 {
            own.extend([0..1, piece.count() - 1..piece.count()]);
        }
        let ranges = own.into_iter().map(|range| {
            let (start, end) = match piece.reversed {
                true => (
                    piece.range().end - range.end,
                    piece.range().end - range.start,
                ),
                false => (piece.first() + range.start, piece.first() + range.end),
            };
            // What lies behind has other indices now; in a piece travelled against its own direction, and in the pieces
            // behind this one, that reaches past the splice.
            start..if recounted { contour.len() } else { end }
        });
        let ranges: Vec<Range<usize>> = ranges.collect();
        // What a pair rule sees at a segment depends on its neighbours, too. Runs behind a segment that came or went
        // have other segments.
        let mut runs = BTreeSet::new();
        for range in &ranges {
            let count = if recounted {
                known.index.len().max(contour.len())
            } else {
                contour.len()
            };
            let behind = if recounted {
                count
            } else {
                (range.end + NEIGHBOURS).min(count)
            };
            runs.extend(range.start.saturating_sub(NEIGHBOURS) / RUN..behind.div_ceil(RUN));
            if contour.closed && range.start < NEIGHBOURS {
                runs.extend(count.saturating_sub(NEIGHBOURS) / RUN..count.div_ceil(RUN));
            }
            if contour.closed && (recounted || range.end + NEIGHBOURS > count) {
                runs.extend(0..NEIGHBOURS.min(count).div_ceil(RUN));
            }
        }
        // Two closed outlines that lie on each other begin where they like: what holds of both is kept where one of them begins.
        let is_ring = geometry.is_closed() && known.index.run_count() > 1;
        let beside = if is_ring {
            self.pairs.beside(key, known.index.run_count())
        } else {
            FxHashSet::default()
        };
        let beginnings: Vec<RunId> = beside
            .into_iter()
            .filter_map(|other| self.beginning_of(drawing, other))
            .collect();
        for &(other, run) in &beginnings {
            if let Some(bounds) = self
                .known
                .get(&other)
                .map(|known| known.index.bounds_of_run(run as usize))
            {
                self.pairs.forget_run((other, run), &bounds);
            }
        }
        let mut forgotten = FxHashSet::default();
        for &run in &runs {
            if run < known.index.run_count() && forgotten.insert(run) {
                self.pairs
                    .forget_run((key, run as u32), &known.index.bounds_of_run(run));
            }
        }
        for range in ranges {
            let mut changed = known.index.bounds_about(range.clone());
            known.index.update(drawing, contour, range.clone());
            changed.merge(&known.index.bounds_about(range.clone()));
            known.look(
                drawing,
                contour,
                &self.limits,
                &self.settings,
                range.clone(),
            );
            self.answers
                .retain(|(other, _), (_, region)| *other != key || !region.touches(&changed));
        }
        let count = known.index.run_count();
        let runs = runs
            .into_iter()
            .filter(|&run| run < count)
            .map(|run| (key, run as u32));
        let runs: BTreeSet<RunId> = runs.collect();
        self.enter_known(key, known);
        self.listen_to(drawing, key);
        let runs: Vec<RunId> = runs.into_iter().chain(beginnings).collect();
        self.look_at_pairs(drawing, &runs);
        true
    }

    /// The run with the first segment of a contour that is one closed entity.
    fn beginning_of(&self, drawing: &Drawing, key: ContourKey) -> Option<RunId> {
        let first = self.chains.first_of(key).filter(|&first| {
            drawing
                .get(first)
                .is_some_and(|entity| entity.geometry.is_closed())
        })?;
        let (_, index) = self.chains.index_of(first, 0)?;
        Some((key, (index / RUN) as u32))
    }

    /// Keys of all contours in machining order: that of the first entity of each.
    fn in_machining_order(&self, drawing: &Drawing) -> &[ContourKey] {
        self.order.get_or_init(|| {
            let mut seen = FxHashSet::default();
            let mut last = None;
            let mut keys = Vec::new();
            for &id in drawing.order() {
                let key = self.chains.contour_of(id);
                if key != last
                    && let Some(key) = key
                    && seen.insert(key)
                {
                    keys.push(key);
                }
                last = key;
            }
            keys
        })
    }

    /// The role of each contour: stated by an entity, by its layer, by the `side` setting, or by nesting.
    fn roles(&self, drawing: &Drawing, keys: &[ContourKey]) -> Vec<Role> {
        let everywhere = self.settings.side.role();
        let depths = match everywhere {
            Some(_) => Vec::new(),
            None => {
                let contours: Vec<_> = keys
                    .iter()
                    .filter_map(|key| Some((self.chains.get(*key)?, &self.known.get(key)?.index)))
                    .collect();
                nesting_depths(drawing, &contours)
            }
        };
        let nested = |position: usize| {
            if depths.get(position).is_some_and(|depth| depth % 2 == 1) {
                Role::Opening
            } else {
                Role::Punch
            }
        };
        let role = |(position, key): (usize, &ContourKey)| {
            self.known
                .get(key)
                .and_then(|known| known.stated)
                .or(everywhere)
                .unwrap_or_else(|| nested(position))
        };
        keys.iter().enumerate().map(role).collect()
    }
}

/// The role that an entity states, else that of its handle, else that of its layer, else that of its colour.
fn role_of(drawing: &Drawing, settings: &Effective, id: EntityId) -> Option<Role> {
    let entity = drawing.get(id)?;
    let by_color = || {
        if settings.colors.is_empty() {
            None
        } else {
            settings.colors.get(&drawing.color(id)?).copied()
        }
    };
    let by_handle = || {
        if settings.contours.is_empty() {
            None
        } else {
            settings.contours.get(&*entity.handle).copied()
        }
    };
    entity
        .role
        .or_else(by_handle)
        .or_else(|| settings.layers.get(&*entity.layer).copied())
        .or_else(by_color)
}

/// True when an entity is part of a contour: it has segments, its role is not `ignore`, and it is seen, or somebody has given it
/// or its layer a role. A colour or a handle alone does not bring back what is frozen.
pub fn is_cut(drawing: &Drawing, settings: &Effective, id: EntityId) -> bool {
    let Some(entity) = drawing
        .get(id)
        .filter(|entity| entity.geometry.segment_count() > 0)
    else {
        return false;
    };
    let is_asked_for = || entity.role.is_some() || settings.layers.contains_key(&*entity.layer);
    role_of(drawing, settings, id) != Some(Role::Ignore)
        && (drawing.visibility(id).is_seen() || is_asked_for())
}

/// The segments of an entity that a splice of its vertices changed, in one or two ranges.
fn segments_of(
    vertices: Option<(usize, usize, usize)>,
    count: usize,
    closed: bool,
) -> Vec<Range<usize>> {
    let Some((start, removed, inserted)) = vertices else {
        return once(0..count).collect();
    };
    if removed != inserted {
        // What lies behind the splice has other indices now; the segment before it has another end.
        let first = if closed && start == 0 {
            0
        } else {
            start.saturating_sub(1).min(count)
        };
        return once(first..count).collect();
    }
    let end = (start + inserted).min(count);
    let own = start.saturating_sub(1).min(end)..end;
    let closing = (closed && start == 0 && count > 0).then(|| count - 1..count);
    once(own).chain(closing).collect()
}

/// What a replacement takes of a contour, in the contour's own direction: from one place to another, in segments.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    from: f64,
    length: f64,
    round: f64,
}

impl Stretch {
    fn of(travel: &Travel, replacement: &Replacement) -> Stretch {
        let place = |position: isize, point| {
            let share = travel.segment(position).map_or(0.0, |segment| {
                segment.geometry.share_of(point).clamp(0.0, 1.0)
            });
            position as f64 + share
        };
        let (start, end) = (
            place(replacement.before, replacement.arc.start),
            place(replacement.after, replacement.arc.end),
        );
        let round = travel.len() as f64;
        let from = match travel.side {
            Side::Left => start,
            Side::Right => round - end,
        };
        Stretch {
            from: from.rem_euclid(round),
            length: end - start,
            round,
        }
    }

    fn overlaps(&self, other: &Stretch) -> bool {
        (other.from - self.from).rem_euclid(self.round) < self.length
            || (self.from - other.from).rem_euclid(self.round) < other.length
    }
}
