//! Drawing → contours → findings, and what can be reused after an edit.

mod again;
mod arcs;
mod common_line;
mod compare;
mod contours;
mod dead_ends;
mod drafting;
mod electrode;
mod end_index;
mod fit_fixes;
mod fits;
mod fitting;
mod fixes;
mod judge;
mod known;
mod largest_wire;
mod learn;
mod misfits;
mod notable;
mod observations;
mod pair_findings;
mod pairs;
mod pockets;
mod quick_reject;
mod radius_prices;
mod repair;
mod report;
mod runs;
mod said_twice;
mod search;
mod splice;
mod suppressed;
mod together;
mod told;
mod twice;
mod within;

#[cfg(test)]
mod tests;

#[cfg(test)]
pub(crate) use contours::is_cut;
pub use largest_wire::{largest_wire, work};
pub use radius_prices::{RadiusPrices, ShopWire, TightPlace, price_of_segment, radius_prices};

use crate::drawing::{Chains, Contour, ContourKey, Delta, Drawing, EntityId, RUN, Touched};
use crate::finding::{Finding, NoFix};
use crate::geometry::Bounds;
use crate::rules::{Limits, Outlook};
use crate::settings::Effective;
use crate::toolpath::Walls;
use contours::{Outlined, set_aside};
use drafting::{AsideEntities, LoneLines};
use fitting::Fitting;
use known::Known;
use notable::Notable;
use pairs::Pairs;
use pockets::Loss;
use report::Tally;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};
use suppressed::Judged;

/// Up to this many touched places are checked one by one, however small the drawing is.
const FEW: usize = 16;
/// Above this many split contours, if they are a good part of all, the drawing is analysed from scratch.
const MANY: usize = 256;

/// What is known of one drawing under one set of settings.
#[derive(Clone, Debug)]
pub struct Analysis {
    settings: Arc<Effective>,
    limits: Limits,
    chains: Chains,
    /// Shared with copies, which are made for tentative repairs.
    known: FxHashMap<ContourKey, Arc<Known>>,
    /// Contours with findings that do not depend on others: most have none.
    notable: FxHashMap<ContourKey, Notable>,
    /// Contours larger than any machine.
    vast: FxHashSet<ContourKey>,
    /// The number of segments of the known contours.
    segments: usize,
    /// The number of contours with a stated role.
    stated: usize,
    /// Lines that stand alone, and which of them are not cut: nothing else is kept of those.
    lone: LoneLines,
    /// Entities that are not cut because of their linetype or layer.
    aside: AsideEntities,
    /// A removed entity that may come back nearly unchanged, as while a number of it is being typed: all that is known
    /// of it is kept until the next change: looked at again, a polyline of 140,000 vertices takes fifteen times as long. Nothing of it shows,
    /// since it is not in the drawing.
    suspended: Option<EntityId>,
    pairs: Pairs,
    /// Why no fix was found for a fault of a contour, or that one was.
    answers: FxHashMap<(ContourKey, usize), Option<NoFix>>,
    /// What the path along a contour loses, for a side and with or without a neck.
    lost: FxHashMap<ContourKey, Loss>,
    /// What was found between partners, or for a contour that is cut twice.
    fits: BTreeMap<(ContourKey, ContourKey), fits::KnownFit>,
    /// The segments of contours that may belong to a pair, for questions about what is near.
    walls: FxHashMap<ContourKey, Arc<Walls>>,
    /// Which contours run beside each other, each time the smaller one first.
    beside: FxHashSet<[ContourKey; 2]>,
    order: OnceLock<Vec<ContourKey>>,
    outlines: OnceLock<Outlined>,
    /// All findings, once they have been asked for.
    tally: OnceLock<Tally>,
    /// How well pairs fit, once that has been asked for.
    fitting: OnceLock<Option<Fitting>>,
}

impl Analysis {
    pub fn new(drawing: &Drawing, settings: Arc<Effective>) -> Analysis {
        let limits = Limits::new(&settings, settings.unit_of(drawing).mm);
        let chains = Chains::of_parts(drawing, (limits.tolerances.join, limits.least()), &|id| {
            contours::chained_with(drawing, &settings, id)
        });
        let mut analysis = Analysis {
            settings,
            limits,
            chains,
            known: FxHashMap::default(),
            notable: FxHashMap::default(),
            vast: FxHashSet::default(),
            segments: 0,
            stated: 0,
            lone: LoneLines::default(),
            aside: AsideEntities::default(),
            suspended: None,
            pairs: Pairs::default(),
            answers: FxHashMap::default(),
            lost: FxHashMap::default(),
            fits: BTreeMap::new(),
            walls: FxHashMap::default(),
            beside: FxHashSet::default(),
            order: OnceLock::new(),
            outlines: OnceLock::new(),
            tally: OnceLock::new(),
            fitting: OnceLock::new(),
        };
        // What is cut is not set aside.
        for (id, _) in drawing.entities() {
            if analysis.chains.contour_of(id).is_none()
                && set_aside(drawing, &analysis.settings, id).is_some()
            {
                analysis.note_aside(drawing, id);
            }
        }
        // In machining order: where not all can be compared, the same is left out however the drawing came about.
        let keys = analysis.in_machining_order(drawing).to_vec();
        analysis.order = OnceLock::new();
        let segments = keys
            .iter()
            .filter_map(|&key| analysis.chains.get(key))
            .map(Contour::len)
            .sum();
        analysis.pairs = Pairs::new(&analysis.settings.budget, segments);
        analysis.known.reserve(keys.len());
        let (whole, mut lone) = analysis.without_lone(drawing, keys);
        analysis.learn(drawing, &whole);
        analysis.judge_lone(drawing, &lone);
        lone.retain(|&key| !analysis.is_lone(key));
        analysis.learn(drawing, &lone);
        analysis.pairs.settle();
        analysis
    }

    /// Makes ready what the first edit needs.
    pub(crate) fn make_ready(&mut self) {
        self.chains.make_ready();
    }

    /// Checks again what `delta` touched. The result is that of a fresh [`Analysis::new`].
    pub fn update(&mut self, drawing: &Drawing, delta: &Delta) {
        // An edit may move an entity away from the point that gives it its role.
        let hangs_on_points = !self.settings.points.is_empty();
        if self.pairs.is_as_fresh() && !hangs_on_points {
            self.look_at_touched(drawing, delta);
        }
        if !self.pairs.is_as_fresh() || hangs_on_points {
            *self = Analysis::new(drawing, self.settings.clone());
        }
    }

    fn look_at_touched(&mut self, drawing: &Drawing, delta: &Delta) {
        (self.tally, self.fitting) = (OnceLock::new(), OnceLock::new());
        let limits = Limits::new(&self.settings, self.settings.unit_of(drawing).mm);
        if limits != self.limits || delta.touched.contains(&Touched::All) || self.is_most(delta) {
            *self = Analysis::new(drawing, self.settings.clone());
            return;
        }
        if !delta.touched.is_empty() {
            self.outlines = OnceLock::new();
        }
        let mut moved = Vec::new();
        match (self.suspended.take(), delta.touched.as_slice()) {
            (Some(entity), []) => {
                self.suspended = Some(entity);
                return;
            }
            (Some(entity), [Touched::Vertices { entity: woken, .. }]) if *woken == entity => {
                self.order = OnceLock::new()
            }
            (Some(entity), _) => moved.push(entity),
            (None, &[Touched::Removed { entity }]) if self.may_be_suspended(entity) => {
                self.suspended = Some(entity);
                self.order = OnceLock::new();
                return;
            }
            (None, _) => {}
        }
        // The places about which lone lines are judged again.
        let mut changed = Vec::new();
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
            self.note_aside(drawing, entity);
            let key = self.chains.contour_of(entity);
            let is_lone = key.is_some_and(|key| {
                self.lone.contains_key(&key) || self.as_lone(drawing, key).is_some()
            });
            let part = contours::chained_with(drawing, &self.settings, entity);
            let stays = !is_lone
                && self.chains.same_ends(drawing, entity, part.is_some())
                && !self.leaves_out(drawing, entity, vertices)
                && part.is_none_or(|part| self.is_of_part(entity, part));
            let box_of = |analysis: &Analysis| key.and_then(|key| analysis.box_of(key));
            changed.extend(box_of(self).filter(|_| !self.lone.is_empty()));
            if !stays || !self.look_again(drawing, entity, vertices) {
                moved.push(entity);
            }
            changed.extend(box_of(self).filter(|_| !self.lone.is_empty()));
        }
        if moved.is_empty() {
            self.look_at_lone(drawing, &changed, Vec::new());
            return;
        }
        self.order = OnceLock::new();
        let settings = self.settings.clone();
        let rechained = self.chains.update_parts(drawing, &moved, &|id| {
            contours::chained_with(drawing, &settings, id)
        });
        // Thousands of contours with ends in one place are one group, and lie on each other:
        // to forget each of them costs a look at all of them.
        let gone = rechained.gone.len();
        if gone > MANY && gone * 4 > self.known.len() {
            *self = Analysis::new(drawing, settings);
            return;
        }
        for key in &rechained.gone {
            changed.extend(self.box_of(*key).filter(|_| !self.lone.is_empty()));
            self.forget(*key);
            self.lone.remove(key);
        }
        let gone: FxHashSet<ContourKey> = rechained.gone.into_iter().collect();
        self.answers.retain(|(key, _), _| !gone.contains(key));
        let (whole, lone) = self.without_lone(drawing, rechained.new);
        self.learn(drawing, &whole);
        if !self.lone.is_empty() {
            let new = whole.iter().chain(&lone);
            changed.extend(new.filter_map(|&key| self.box_of(key)));
        }
        self.look_at_lone(drawing, &changed, lone);
    }

    /// Forgets the observations of a contour.
    fn forget(&mut self, key: ContourKey) {
        self.lost.remove(&key);
        self.forget_fits(key);
        self.notable.remove(&key);
        self.vast.remove(&key);
        if let Some(known) = self.take_known(key) {
            self.pairs.forget(key, &known.index);
        }
    }

    /// Checks again the single lines near what has changed, some of which are `new`.
    fn look_at_lone(&mut self, drawing: &Drawing, changed: &[Bounds], new: Vec<ContourKey>) {
        let asked = self.lone_near(changed);
        let answered = self.judge_lone(drawing, &asked);
        if answered.is_empty() && new.is_empty() {
            return;
        }
        (self.order, self.outlines) = (OnceLock::new(), OnceLock::new());
        for &key in &answered {
            if self.is_lone(key) {
                self.forget(key);
                self.answers.retain(|(other, _), _| *other != key);
            }
        }
        let mut cut: Vec<ContourKey> = answered.into_iter().chain(new).collect();
        cut.retain(|&key| !self.is_lone(key) && !self.known.contains_key(&key));
        cut.sort_unstable();
        cut.dedup();
        self.learn(drawing, &cut);
    }

    /// True where the contour of an entity is chained by this number, and for an entity without contour.
    fn is_of_part(&self, entity: EntityId, part: u16) -> bool {
        let known = self
            .chains
            .contour_of(entity)
            .and_then(|key| self.known.get(&key));
        known.is_none_or(|known| contours::chain_number(known.part, known.stated) == part)
    }

    /// True for an entity that is a contour of its own, on which no observation of others depends.
    fn may_be_suspended(&self, entity: EntityId) -> bool {
        let key = self.chains.contour_of(entity);
        let contour = key.and_then(|key| self.chains.get(key));
        contour.is_some_and(|contour| contour.pieces.len() == 1)
            && key.is_some_and(|key| {
                let own = self.box_of(key);
                self.chains.stands_alone(key)
                    && self.pairs.may_spare(key)
                    && own.is_some_and(|own| self.lone_near(&[own]).is_empty())
            })
    }

    /// The analysis of `drawing`, which `delta` has made of the drawing of this one.
    fn updated(&self, drawing: &Drawing, delta: &Delta) -> Analysis {
        if self.is_most(delta) || !self.settings.points.is_empty() {
            return Analysis::new(drawing, self.settings.clone());
        }
        // A tentative edit is not worth a look at everything.
        let mut analysis = self.clone();
        analysis.pairs.refill();
        analysis.look_at_touched(drawing, delta);
        analysis
    }

    /// True when checking all that is touched costs more than analysing everything.
    fn is_most(&self, delta: &Delta) -> bool {
        let touched = delta.touched.len();
        touched > FEW && touched * RUN > self.segments
    }

    /// The settings that the findings hold under.
    pub(crate) fn settings(&self) -> &Arc<Effective> {
        &self.settings
    }

    /// At most `limit` findings, errors first, then in machining order; and their number in all. Suppressed ones are
    /// not among them.
    pub fn findings(&mut self, drawing: &Drawing, limit: usize) -> (Vec<Finding>, usize) {
        if self.settings.suppressed.is_empty()
            && self.settings.own.is_empty()
            && !drawing.has_marks()
        {
            let (mut findings, count) = self.report(drawing, limit).finish();
            self.give_reasons(drawing, &mut findings);
            return (findings, count);
        }
        let Judged {
            mut findings,
            useless,
            ..
        } = self.judged(drawing);
        findings.extend(useless);
        findings.sort_by_key(|finding| finding.severity);
        let count = findings.len();
        findings.truncate(limit);
        (findings, count)
    }

    fn outlook<'a>(&'a self, drawing: &'a Drawing, key: ContourKey) -> Option<Outlook<'a>> {
        let contour = self.chains.get(key)?;
        let known = self.known.get(&key)?;
        Some(Outlook {
            drawing,
            contour,
            index: &known.index,
            limits: &self.limits,
            part: known.part,
            on_line: self.is_on_line(key),
            at_hand: None,
        })
    }
}
