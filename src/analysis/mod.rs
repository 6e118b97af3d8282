//! Drawing → contours → findings, and what of it may be reused after an edit.

mod known;
mod pairs;
mod report;

use crate::drawing::{
    Chains, ContourIndex, ContourKey, ContourSegment, Delta, Drawing, DrawingEdit, EntityId, Outline, RUN, Role, Touched, nesting_depths,
    stated_role,
};
use crate::finding::{Detail, Finding, Fix, FixKind, NoFix, Place, Rule, Side};
use crate::geometry::Bounds;
use crate::rules::small_radius::{self, Attempt, Replacement, Travel};
use crate::rules::{Fact, LOCAL_RULES, Limits, Outlook, PAIR_RULES};
use crate::settings::{Effective, SideSetting};
use known::Known;
use pairs::{Pairs, RunId};
use report::Report;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// What is known of one drawing under one set of settings.
#[derive(Clone, Debug)]
pub struct Analysis {
    settings: Arc<Effective>,
    limits: Limits,
    chains: Chains,
    known: FxHashMap<ContourKey, Known>,
    pairs: Pairs,
    /// Whether a fix was found for a fault, and the region that the answer depends on.
    answers: FxHashMap<(ContourKey, usize), (Option<NoFix>, Bounds)>,
    order: OnceLock<Vec<ContourKey>>,
    outlines: OnceLock<Arc<Vec<Outline>>>,
}

impl Analysis {
    pub fn new(drawing: &Drawing, settings: Arc<Effective>) -> Analysis {
        let limits = Limits::new(&settings, settings.unit_of(drawing).mm);
        let chains = Chains::new(drawing, limits.tolerances.join, &|id| is_cut(drawing, &settings, id));
        let mut analysis = Analysis {
            settings,
            limits,
            chains,
            known: FxHashMap::default(),
            pairs: Pairs::default(),
            answers: FxHashMap::default(),
            order: OnceLock::new(),
            outlines: OnceLock::new(),
        };
        let keys: Vec<ContourKey> = analysis.chains.keys().collect();
        analysis.learn(drawing, &keys);
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
            if vertices.is_none() {
                self.order = OnceLock::new();
            }
        }
        if moved.is_empty() {
            return;
        }
        self.order = OnceLock::new();
        let settings = self.settings.clone();
        let rechained = self.chains.update(drawing, &moved, &|id| is_cut(drawing, &settings, id));
        for key in &rechained.gone {
            if let Some(known) = self.known.remove(key) {
                self.pairs.forget(*key, &known.index);
            }
        }
        let gone: FxHashSet<ContourKey> = rechained.gone.into_iter().collect();
        self.answers.retain(|(key, _), _| !gone.contains(key));
        self.learn(drawing, &rechained.new);
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
                let twice_area = if contour.closed { self.known.get(&key)?.index.twice_area() } else { 0.0 };
                Some(Outline { contour, role, twice_area })
            };
            Arc::new(ordered.iter().copied().zip(roles).filter_map(outline).collect())
        })
    }

    /// At most `limit` findings, errors first, then in machining order; and how many there are in all.
    pub fn findings(&mut self, drawing: &Drawing, limit: usize) -> (Vec<Finding>, usize) {
        let mut report = Report::new(self.settings.clone(), limit);
        let ordered = self.in_machining_order(drawing).to_vec();
        let roles = self.roles(drawing, &ordered);
        let sides: Vec<Option<Side>> = ordered.iter().zip(&roles).map(|(key, role)| self.wire_side(*key, *role)).collect();
        for (&key, &wire_side) in ordered.iter().zip(&sides) {
            self.report_small_radii(drawing, key, wire_side, &mut report);
        }
        for (&key, &wire_side) in ordered.iter().zip(&sides) {
            if let (Some(known), Some(outlook)) = (self.known.get(&key), self.outlook(drawing, key)) {
                known.report(&outlook, wire_side, &mut report);
            }
        }
        let side_of: FxHashMap<ContourKey, Option<Side>> = ordered.into_iter().zip(sides).collect();
        self.pairs.report(&|key| self.outlook(drawing, key), &side_of, &mut report);
        report.finish()
    }

    /// Arcs below the correction in one contour.
    fn report_small_radii(&mut self, drawing: &Drawing, key: ContourKey, wire_side: Option<Side>, report: &mut Report) {
        let tight: Vec<usize> = self.known.get(&key).map_or_else(Vec::new, |known| known.index.tight().collect());
        for index in tight {
            let Some((segment, mut numbers)) = self.fault(drawing, key, index, wire_side) else { continue };
            if report.counts(Rule::SmallRadius, None) {
                numbers.no_fix = self.answer(drawing, key, index);
                let place = Place::Segment { entity: segment.entity, segment: segment.segment };
                report.add(Rule::SmallRadius, None, place, Detail::SmallRadius(Box::new(numbers)), Vec::new());
            }
        }
    }

    /// The fixes of one finding, the preferred one first; empty where none is right.
    pub fn fixes(&self, drawing: &Drawing, finding: &Finding) -> Vec<Fix> {
        let Place::Segment { entity, segment } = &finding.place else { return Vec::new() };
        if finding.rule != Rule::SmallRadius {
            let fixes = self.other_fixes(drawing, finding, (*entity, *segment)).unwrap_or_default();
            return fixes.into_iter().filter(|fix| self.keeps_radii(drawing, &fix.edit)).collect();
        }
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

    /// The fixes of a finding of any rule but `small-radius`.
    fn other_fixes(&self, drawing: &Drawing, finding: &Finding, at: (EntityId, usize)) -> Option<Vec<Fix>> {
        let (key, index) = self.locate(at)?;
        let outlook = self.outlook(drawing, key)?;
        if let Some(rule) = LOCAL_RULES.iter().find(|local| local.rule == finding.rule) {
            let is_hint = rule.one_hint_when_side_unknown && matches!(finding.detail, Detail::SharpCorner { count, .. } if count > 1);
            let side = if is_hint { return None } else { None };
            return Some((rule.fixes)(&outlook, Fact { index: index as u32, side }));
        }
        let rule = PAIR_RULES.iter().find(|pair| pair.rule == finding.rule)?;
        let Place::Segment { entity, segment } = finding.related.first()? else { return None };
        let (other_key, other_index) = self.locate((*entity, *segment))?;
        Some((rule.fixes)(&outlook, index, &self.outlook(drawing, other_key)?, other_index))
    }

    /// The contour that holds a segment, and its index in there.
    fn locate(&self, (entity, segment): (EntityId, usize)) -> Option<(ContourKey, usize)> {
        let key = self.chains.contour_of(entity)?;
        Some((key, self.chains.get(key)?.index_of(entity, segment)?))
    }

    fn outlook<'a>(&'a self, drawing: &'a Drawing, key: ContourKey) -> Option<Outlook<'a>> {
        let contour = self.chains.get(key)?;
        Some(Outlook { drawing, contour, index: &self.known.get(&key)?.index, limits: &self.limits })
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
        let ordered = self.in_machining_order(drawing);
        let roles = self.roles(drawing, ordered);
        let tight =
            ordered.iter().zip(roles).filter(|(key, _)| self.known.get(key).is_some_and(|known| known.index.tight().next().is_some()));
        tight.map(|(&key, role)| (key, self.wire_side(key, role))).collect()
    }

    fn wire_side(&self, key: ContourKey, role: Role) -> Option<Side> {
        let closed = self.chains.get(key)?.closed;
        crate::drawing::wire_side(role, closed, self.known.get(&key)?.index.twice_area())
    }

    fn tight_in_entity_order(&self, key: ContourKey) -> Vec<usize> {
        self.known.get(&key).map_or_else(Vec::new, |known| known.index.tight().collect())
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
        let travel = Travel { drawing, contour, index: &self.known.get(&key)?.index, side: small_radius::center_side(arc.sweep) };
        let run = small_radius::run_of(&travel, travel.position_of(index), &self.limits)?;
        let mut attempt = small_radius::refillet(&travel, &run, &self.limits);
        if let Ok(replacement) = &attempt.outcome
            && !(replacement.before..=replacement.after)
                .all(|position| travel.segment(position).is_none_or(|segment| drawing.is_editable(segment.entity)))
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

    /// True when the edit can be made and leaves fewer tight arcs than there were.
    fn betters(&self, drawing: &Drawing, edit: &DrawingEdit) -> bool {
        let touched: FxHashSet<EntityId> = edit.changes.iter().map(crate::drawing::Change::entity).collect();
        let mut after = drawing.clone();
        after.apply(edit).is_ok() && self.tight(&after, &touched) < self.tight(drawing, &touched)
    }

    /// True when an edit can be made and leaves no more tight arcs than there were.
    fn keeps_radii(&self, drawing: &Drawing, edit: &DrawingEdit) -> bool {
        let mut after = drawing.clone();
        let Ok(delta) = after.apply(edit) else { return false };
        let touched: FxHashSet<EntityId> = delta
            .touched
            .iter()
            .filter_map(|touched| match touched {
                Touched::Vertices { entity, .. } | Touched::Entity { entity } | Touched::Removed { entity } => Some(*entity),
                Touched::All => None,
            })
            .collect();
        self.tight(&after, &touched) <= self.tight(drawing, &touched)
    }

    /// Number of arcs below the correction in some entities.
    fn tight(&self, drawing: &Drawing, entities: &FxHashSet<EntityId>) -> usize {
        let entities = entities.iter().filter_map(|&id| drawing.get(id));
        let arcs = entities.flat_map(|entity| entity.geometry.segments());
        arcs.filter(|segment| segment.as_arc().is_some_and(|arc| small_radius::is_too_small(arc.radius, &self.limits))).count()
    }

    /// Looks at whole contours for the first time.
    fn learn(&mut self, drawing: &Drawing, keys: &[ContourKey]) {
        let mut runs = Vec::new();
        for &key in keys {
            let Some(contour) = self.chains.get(key) else { continue };
            let index = ContourIndex::new(drawing, contour, self.limits.correction - self.limits.tolerances.report);
            let mut known = Known::new(index, stated_role(drawing, contour, &|layer| self.settings.layers.get(layer).copied()));
            known.look(drawing, contour, &self.limits, &self.settings, 0..contour.len());
            runs.extend((0..known.index.run_count()).map(|run| (key, run as u32)));
            self.known.insert(key, known);
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
    fn look_again(&mut self, drawing: &Drawing, entity: EntityId, vertices: Option<(usize, usize, usize)>) -> bool {
        let Some(key) = self.chains.contour_of(entity) else { return drawing.get(entity).is_none_or(|e| e.geometry.segment_count() == 0) };
        let Some(geometry) = drawing.get(entity).map(|entity| &entity.geometry) else { return false };
        let piece_of =
            |chains: &Chains| chains.get(key).and_then(|contour| contour.pieces.iter().find(|piece| piece.entity == entity)).copied();
        let Some(before) = piece_of(&self.chains) else { return false };
        let recounted = before.count != geometry.segment_count();
        if recounted {
            self.chains.recount(drawing, entity);
            self.answers.retain(|(other, _), _| *other != key);
        }
        let (Some(piece), Some(mut known)) = (piece_of(&self.chains), self.known.remove(&key)) else { return false };
        let Some(contour) = self.chains.get(key) else { return false };
        if vertices.is_none() {
            known.stated = stated_role(drawing, contour, &|layer| self.settings.layers.get(layer).copied());
        }
        // What holds of a whole entity is kept with its first and last segment.
        let mut own = segments_of(vertices, piece.count, geometry.is_closed());
        if piece.count > 0 {
            own.extend([0..1, piece.count - 1..piece.count]);
        }
        let mut runs = BTreeSet::new();
        for range in own {
            let range = match piece.reversed {
                true => piece.first + piece.count - range.end..piece.first + piece.count - range.start,
                false => piece.first + range.start..piece.first + range.end,
            };
            // Neighbours across a joint belong to what is looked at together.
            let runs_before = known.index.run_count();
            let first_run = range.start / RUN;
            let last_run = if recounted { runs_before } else { range.end.div_ceil(RUN).max(first_run + 1) };
            let mut changed = known.index.bounds_about(range.clone());
            for run in first_run..last_run {
                self.pairs.forget_run((key, run as u32), &known.index.bounds_of_run(run));
            }
            known.index.update(drawing, contour, range.clone());
            changed.merge(&known.index.bounds_about(range.clone()));
            known.look(drawing, contour, &self.limits, &self.settings, range.clone());
            let last_run = if recounted { known.index.run_count() } else { last_run.min(known.index.run_count()) };
            runs.extend((first_run..last_run).map(|run| (key, run as u32)));
            self.answers.retain(|(other, _), (_, region)| *other != key || !region.touches(&changed));
        }
        self.known.insert(key, known);
        let runs: Vec<RunId> = runs.into_iter().collect();
        self.look_at_pairs(drawing, &runs);
        true
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
        let depths = match self.settings.side {
            SideSetting::Auto => {
                let contours: Vec<_> = keys.iter().filter_map(|key| Some((self.chains.get(*key)?, &self.known.get(key)?.index))).collect();
                nesting_depths(drawing, &contours)
            }
            _ => Vec::new(),
        };
        let role = |(position, key): (usize, &ContourKey)| {
            self.known.get(key).and_then(|known| known.stated).unwrap_or(match self.settings.side {
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
    let Some((start, removed, inserted)) = vertices else { return vec![0..count] };
    if removed != inserted {
        // What lies behind the splice has other indices now; the segment before it has another end.
        let first = start.saturating_sub(1).min(count);
        return if closed && start == 0 { vec![0..count] } else { vec![first..count] };
    }
    let end = (start + inserted).min(count);
    let own = start.saturating_sub(1).min(end)..end;
    if closed && start == 0 && count > 0 { vec![own, count - 1..count] } else { vec![own] }
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
