//! Drawing → contours → findings, and what of it may be reused after an edit.

use crate::drawing::{
    Chains, ContourIndex, ContourKey, ContourSegment, Delta, Drawing, DrawingEdit, EntityId, Outline, Role, Touched, nesting_depths,
    stated_role,
};
use crate::finding::{Detail, Finding, Fix, FixKind, NoFix, Place, Rule, Side};
use crate::geometry::Bounds;
use crate::rules::Limits;
use crate::rules::small_radius::{self, Attempt, Replacement, Travel};
use crate::settings::{Effective, SideSetting};
use rustc_hash::{FxHashMap, FxHashSet};
use std::iter::once;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// What is known of one drawing under one set of settings.
#[derive(Clone, Debug)]
pub struct Analysis {
    settings: Arc<Effective>,
    limits: Limits,
    chains: Chains,
    indexes: FxHashMap<ContourKey, ContourIndex>,
    /// Whether a fix was found for a fault, and the region that the answer depends on.
    answers: FxHashMap<(ContourKey, usize), (Option<NoFix>, Bounds)>,
    outlines: OnceLock<Arc<Vec<Outline>>>,
}

impl Analysis {
    pub fn new(drawing: &Drawing, settings: Arc<Effective>) -> Analysis {
        let limits = Limits::new(&settings, settings.unit_of(drawing).mm);
        let chains = Chains::new(drawing, limits.tolerances.join, &|id| is_cut(drawing, &settings, id));
        let mut analysis =
            Analysis { settings, limits, chains, indexes: FxHashMap::default(), answers: FxHashMap::default(), outlines: OnceLock::new() };
        let keys: Vec<ContourKey> = analysis.chains.keys().collect();
        keys.into_iter().for_each(|key| analysis.index(drawing, key));
        analysis
    }

    /// Looks again at what `delta` touched. Same result as a fresh [`Analysis::new`].
    pub fn update(&mut self, drawing: &Drawing, delta: &Delta) {
        let limits = Limits::new(&self.settings, self.settings.unit_of(drawing).mm);
        if limits != self.limits || delta.touched.contains(&Touched::All) {
            *self = Analysis::new(drawing, self.settings.clone());
            return;
        }
        if !delta.touched.is_empty() {
            self.outlines = OnceLock::new();
        }
        let mut moved = Vec::new();
        for touched in &delta.touched {
            let (entity, vertices) = match *touched {
                Touched::Vertices { entity, start, removed, inserted } => (entity, Some((start, removed, inserted))),
                Touched::Entity { entity } | Touched::Removed { entity } => (entity, None),
                Touched::All => continue,
            };
            let stays = self.chains.same_ends(drawing, entity, is_cut(drawing, &self.settings, entity));
            if !stays || !self.look_again(drawing, entity, vertices) {
                moved.push(entity);
            }
        }
        if moved.is_empty() {
            return;
        }
        let settings = self.settings.clone();
        let rechained = self.chains.update(drawing, &moved, &|id| is_cut(drawing, &settings, id));
        let gone: FxHashSet<ContourKey> = rechained.gone.into_iter().collect();
        self.indexes.retain(|key, _| !gone.contains(key));
        self.answers.retain(|(key, _), _| !gone.contains(key));
        rechained.new.into_iter().for_each(|key| self.index(drawing, key));
    }

    /// The settings that the findings hold under.
    pub fn settings(&self) -> &Arc<Effective> {
        &self.settings
    }

    /// Contours with their roles, in machining order. Cheap to keep as a snapshot.
    pub fn outlines(&self, drawing: &Drawing) -> &Arc<Vec<Outline>> {
        self.outlines.get_or_init(|| {
            let ordered = self.in_machining_order(drawing);
            let roles = self.roles(drawing, &ordered);
            let outline = |(key, role): (ContourKey, Role)| {
                let contour = self.chains.get(key)?.clone();
                let twice_area = if contour.closed { self.indexes.get(&key)?.twice_area() } else { 0.0 };
                Some(Outline { contour, role, twice_area })
            };
            Arc::new(ordered.iter().copied().zip(roles).filter_map(outline).collect())
        })
    }

    /// At most `limit` findings, errors first, then in machining order; and how many there are in all.
    pub fn findings(&mut self, drawing: &Drawing, limit: usize) -> (Vec<Finding>, usize) {
        let Some(severity) = self.settings.severity(Rule::SmallRadius) else { return (Vec::new(), 0) };
        let mut findings = Vec::new();
        let mut count = 0;
        for (key, wire_side) in self.with_tight_arcs(drawing) {
            for index in self.tight_in_entity_order(key) {
                let Some((segment, mut numbers)) = self.fault(drawing, key, index, wire_side) else { continue };
                count += 1;
                if findings.len() < limit {
                    numbers.no_fix = self.answer(drawing, key, index);
                    findings.push(Finding {
                        rule: Rule::SmallRadius,
                        severity,
                        place: Place::Segment { entity: segment.entity, segment: segment.segment },
                        detail: Detail::SmallRadius(Box::new(numbers)),
                    });
                }
            }
        }
        (findings, count)
    }

    /// The fixes of one finding, the preferred one first; empty where none is right.
    pub fn fixes(&self, drawing: &Drawing, finding: &Finding) -> Vec<Fix> {
        let (Place::Segment { entity, segment }, Detail::SmallRadius(_)) = (&finding.place, &finding.detail) else { return Vec::new() };
        let Some(key) = self.chains.contour_of(*entity) else { return Vec::new() };
        let Some(index) = self.chains.get(key).and_then(|contour| contour.index_of(*entity, *segment)) else { return Vec::new() };
        let mut fixes = Vec::new();
        let found = self.attempt(drawing, key, index).and_then(|(travel, attempt)| Some((travel, attempt.outcome.ok()?)));
        let mut is_notch = false;
        if let Some((travel, replacement)) = found {
            let old = self.chains.get(key).and_then(|contour| contour.segment(drawing, index)).map(|segment| segment.geometry);
            is_notch = old.is_some_and(|old| {
                let ends = [old.start(), old.end()];
                ends.contains(&replacement.arc.start) && ends.contains(&replacement.arc.end)
            });
            let radius = replacement.arc.radius;
            let kind = FixKind::Refillet { radius, arcs: replacement.arcs, moved: replacement.moved };
            let in_fix_all = replacement.moved <= self.limits.correction;
            if let Some(edit) = small_radius::drawing_edit(drawing, &[(travel, replacement)])
                && self.betters(drawing, &edit)
            {
                fixes.push(Fix { kind, preferred: true, in_fix_all, edit });
            }
        }
        let place = self.chains.get(key).and_then(|contour| contour.segment(drawing, index));
        if let Some(place) = place.filter(|_| !is_notch)
            && let Some((edit, kink)) = small_radius::keep_end_points(drawing, &place, &self.limits)
            && self.betters(drawing, &edit)
        {
            let kind = FixKind::KeepEndPoints { radius: self.limits.fix_radius, kink };
            fixes.push(Fix { kind, preferred: false, in_fix_all: false, edit });
        }
        fixes
    }

    /// One edit that makes every safe fix; `None` where there is none.
    pub fn fix_all(&self, drawing: &Drawing) -> Option<DrawingEdit> {
        self.settings.severity(Rule::SmallRadius)?;
        let mut replacements = Vec::new();
        for (key, wire_side) in self.with_tight_arcs(drawing) {
            let mut accepted: Vec<(Stretch, Travel, Replacement)> = Vec::new();
            for index in self.tight_in_entity_order(key) {
                if self.fault(drawing, key, index, wire_side).is_none() {
                    continue;
                }
                let Some((travel, Attempt { outcome: Ok(replacement), .. })) = self.attempt(drawing, key, index) else { continue };
                let stretch = Stretch::of(&travel, &replacement);
                let free = accepted.first().is_none_or(|(first, ..)| !first.overlaps(&stretch))
                    && accepted.last().is_none_or(|(last, ..)| !last.overlaps(&stretch));
                if free && replacement.moved <= self.limits.correction {
                    accepted.push((stretch, travel, replacement));
                }
            }
            replacements.extend(accepted.into_iter().map(|(_, travel, replacement)| (travel, replacement)));
        }
        if replacements.is_empty() {
            return None;
        }
        let edit = small_radius::drawing_edit(drawing, &replacements)?;
        self.betters(drawing, &edit).then_some(edit)
    }

    /// Contours that have tight arcs, in machining order, with the wire side of each.
    fn with_tight_arcs(&self, drawing: &Drawing) -> Vec<(ContourKey, Option<Side>)> {
        if self.indexes.values().all(|index| index.tight().next().is_none()) {
            return Vec::new();
        }
        let ordered = self.in_machining_order(drawing);
        let roles = self.roles(drawing, &ordered);
        let sided = ordered.into_iter().zip(roles).filter_map(|(key, role)| {
            let index = self.indexes.get(&key)?;
            index.tight().next()?;
            let closed = self.chains.get(key)?.closed;
            Some((key, crate::drawing::wire_side(role, closed, index.twice_area())))
        });
        sided.collect()
    }

    fn tight_in_entity_order(&self, key: ContourKey) -> Vec<usize> {
        self.indexes.get(&key).map_or_else(Vec::new, |index| index.tight().collect())
    }

    fn fault(
        &self,
        drawing: &Drawing,
        key: ContourKey,
        index: usize,
        wire_side: Option<Side>,
    ) -> Option<(ContourSegment, crate::finding::SmallRadius)> {
        let segment = self.chains.get(key)?.segment(drawing, index)?;
        Some((segment, small_radius::check(&segment, wire_side, &self.limits)?))
    }

    /// The replacement of the run that holds a tight arc, looked for on the side of its centre.
    fn attempt<'a>(&'a self, drawing: &'a Drawing, key: ContourKey, index: usize) -> Option<(Travel<'a>, Attempt)> {
        let contour = self.chains.get(key)?;
        let arc = *contour.segment(drawing, index)?.geometry.as_arc()?;
        let travel = Travel { drawing, contour, index: self.indexes.get(&key)?, side: small_radius::center_side(arc.sweep) };
        let run = small_radius::run_of(&travel, travel.position_of(index), &self.limits)?;
        Some((travel, small_radius::refillet(&travel, &run, &self.limits)))
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

    /// True when the edit can be made and leaves fewer tight arcs than there were.
    fn betters(&self, drawing: &Drawing, edit: &DrawingEdit) -> bool {
        let touched: FxHashSet<EntityId> = edit.changes.iter().map(crate::drawing::Change::entity).collect();
        let tight = |drawing: &Drawing| {
            let entities = touched.iter().filter_map(|&id| drawing.get(id));
            let arcs = entities.flat_map(|entity| entity.geometry.segments());
            arcs.filter(|segment| segment.as_arc().is_some_and(|arc| small_radius::is_too_small(arc.radius, &self.limits))).count()
        };
        let mut after = drawing.clone();
        after.apply(edit).is_ok() && tight(&after) < tight(drawing)
    }

    fn index(&mut self, drawing: &Drawing, key: ContourKey) {
        if let Some(contour) = self.chains.get(key) {
            let threshold = self.limits.correction - self.limits.tolerances.report;
            self.indexes.insert(key, ContourIndex::new(drawing, contour, threshold));
        }
    }

    /// Looks again at an entity whose contour still runs as it did. False where it is in none.
    fn look_again(&mut self, drawing: &Drawing, entity: EntityId, vertices: Option<(usize, usize, usize)>) -> bool {
        let Some(key) = self.chains.contour_of(entity) else { return drawing.get(entity).is_none_or(|e| e.geometry.segment_count() == 0) };
        let (Some(contour), Some(known)) = (self.chains.get(key), self.indexes.get(&key).map(ContourIndex::len)) else { return false };
        let Some(geometry) = drawing.get(entity).map(|entity| &entity.geometry) else { return false };
        let Some(piece) = contour.pieces.iter().find(|piece| piece.entity == entity) else { return false };
        let recounted = piece.count != geometry.segment_count();
        if recounted {
            self.chains.recount(drawing, entity);
        }
        let Some(contour) = self.chains.get(key) else { return false };
        let Some(piece) = contour.pieces.iter().find(|piece| piece.entity == entity).copied() else { return false };
        let own = segments_of(vertices, piece.count, geometry.is_closed());
        let Some(index) = self.indexes.get_mut(&key) else { return false };
        for range in own {
            let range = match piece.reversed {
                true => piece.first + piece.count - range.end..piece.first + piece.count - range.start,
                false => piece.first + range.start..piece.first + range.end,
            };
            let mut changed = index.bounds_about(range.clone());
            index.update(drawing, contour, range.clone());
            changed.merge(&index.bounds_about(range));
            self.answers.retain(|(other, _), (_, region)| *other != key || !region.touches(&changed));
        }
        if recounted || known != index.len() {
            self.answers.retain(|(other, _), _| *other != key);
        }
        true
    }

    /// Keys of all contours in machining order: that of the first entity of each.
    fn in_machining_order(&self, drawing: &Drawing) -> Vec<ContourKey> {
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
    }

    /// The role of each contour: stated by an entity, by its layer, by the `side` setting, or by nesting.
    fn roles(&self, drawing: &Drawing, keys: &[ContourKey]) -> Vec<Role> {
        let depths = match self.settings.side {
            SideSetting::Auto => {
                let contours: Vec<_> = keys.iter().filter_map(|key| Some((self.chains.get(*key)?, self.indexes.get(key)?))).collect();
                nesting_depths(drawing, &contours)
            }
            _ => Vec::new(),
        };
        let role = |(position, key): (usize, &ContourKey)| {
            let contour = self.chains.get(*key);
            let stated = contour.and_then(|contour| stated_role(drawing, contour, &|layer| self.settings.layers.get(layer).copied()));
            stated.unwrap_or(match self.settings.side {
                SideSetting::Opening => Role::Opening,
                SideSetting::Punch => Role::Punch,
                SideSetting::Both => Role::Both,
                SideSetting::Auto if depths.get(position).is_some_and(|depth| depth % 2 == 1) => Role::Opening,
                SideSetting::Auto => Role::Punch,
            })
        };
        keys.iter().enumerate().map(role).collect()
    }
}

/// True when an entity is part of a contour: it has segments and its role is not `ignore`.
fn is_cut(drawing: &Drawing, settings: &Effective, id: EntityId) -> bool {
    drawing.get(id).is_some_and(|entity| {
        let role = entity.role.or_else(|| settings.layers.get(&*entity.layer).copied());
        role != Some(Role::Ignore) && entity.geometry.segment_count() > 0
    })
}

/// The segments of an entity that a splice of its vertices changed, in one or two ranges.
fn segments_of(vertices: Option<(usize, usize, usize)>, count: usize, closed: bool) -> Vec<Range<usize>> {
    let Some((start, removed, inserted)) = vertices else { return once(0..count).collect() };
    if removed != inserted {
        // What lies behind the splice has other indices now; the segment before it has another end.
        let first = if closed && start == 0 { 0 } else { start.saturating_sub(1).min(count) };
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
            let share = travel.segment(position).map_or(0.0, |segment| segment.geometry.share_of(point).clamp(0.0, 1.0));
            position as f64 + share
        };
        let (start, end) = (place(replacement.before, replacement.arc.start), place(replacement.after, replacement.arc.end));
        let round = travel.len() as f64;
        let from = match travel.side {
            Side::Left => start,
            Side::Right => round - end,
        };
        Stretch { from: from.rem_euclid(round), length: end - start, round }
    }

    fn overlaps(&self, other: &Stretch) -> bool {
        (other.from - self.from).rem_euclid(self.round) < self.length || (self.from - other.from).rem_euclid(self.round) < other.length
    }
}
