//! The first look at contours, and the next one where an edit has touched them.

use super::compare::RunId;
use super::contours::role_of;
use super::known::Known;
use super::notable::{Notability, Notable};
use super::{Analysis, MANY};
use crate::drawing::{
    Contour, ContourIndex, ContourKey, Drawing, EntityId, Piece, RUN, stated_role,
};
use crate::rules::{AtHand, CONTOUR_RULES, NEIGHBOURS, Outlook, units};
use rayon::prelude::*;
use rustc_hash::FxHashSet;
use std::collections::BTreeSet;
use std::iter::once;
use std::ops::Range;
use std::sync::Arc;

impl Analysis {
    fn enter_known(&mut self, key: ContourKey, known: Arc<Known>) {
        self.segments += known.index.len();
        self.stated += usize::from(known.stated.is_some());
        self.known.insert(key, known);
    }

    pub(super) fn take_known(&mut self, key: ContourKey) -> Option<Arc<Known>> {
        let known = self.known.remove(&key)?;
        self.segments -= known.index.len();
        self.stated -= usize::from(known.stated.is_some());
        Some(known)
    }

    /// Records whether a contour has findings of its own.
    pub(super) fn note(&mut self, drawing: &Drawing, key: ContourKey) {
        let told = self.told_by(drawing, key);
        self.take_down(key, told);
    }

    /// Which findings of its own a contour may have, and whether it is larger than any machine.
    fn told_by(&self, drawing: &Drawing, key: ContourKey) -> (Option<Notability>, bool) {
        let of_contour = |outlook: Outlook| CONTOUR_RULES.iter().any(|rule| (rule.holds)(&outlook));
        let known = self.known.get(&key);
        let what = Notability {
            has_tight_arcs: known.is_some_and(|known| known.index.tight().next().is_some()),
            has_observations: known.is_some_and(|known| known.has_observations()),
            as_a_whole: self.outlook(drawing, key).is_some_and(of_contour),
        };
        let has_something = what.has_tight_arcs || what.has_observations || what.as_a_whole;
        let is_vast =
            known.is_some_and(|known| units::is_vast(&known.index.bounds(), self.limits.unit_mm));
        (has_something.then_some(what), is_vast)
    }

    fn take_down(&mut self, key: ContourKey, (what, is_vast): (Option<Notability>, bool)) {
        match what.zip(self.chains.first_of(key)) {
            Some((what, first)) => {
                let counted = None;
                let notable = Notable {
                    first,
                    what,
                    counted,
                };
                self.notable.insert(key, notable);
            }
            None => drop(self.notable.remove(&key)),
        }
        match is_vast {
            true => self.vast.insert(key),
            false => self.vast.remove(&key),
        };
    }

    /// Arcs with a smaller radius are below the correction.
    pub(super) fn tight_below(&self) -> f64 {
        self.limits.correction - self.limits.tolerances.report
    }

    /// Looks at whole contours for the first time.
    pub(super) fn learn(&mut self, drawing: &Drawing, keys: &[ContourKey]) {
        let tight = self.tight_below();
        let learned = each_of(keys, |key| {
            let contour = self.chains.get(key)?;
            // Most contours are short: their segments are worked out once.
            let all = 0..contour.len();
            let at_hand = (1..=RUN)
                .contains(&all.len())
                .then(|| AtHand::of(drawing, contour, &self.limits, all.clone()))
                .filter(|at_hand| !at_hand.segments().is_empty());
            let index = match &at_hand {
                Some(at_hand) => ContourIndex::of_one_run(at_hand.segments(), tight),
                None => ContourIndex::new(drawing, contour, tight),
            };
            let stated = stated_role(contour, &|id| role_of(drawing, &self.settings, id));
            let mut known = Known::new(
                index,
                stated,
                self.settings.workpieces.of_contour(drawing, contour),
            );
            known.check(drawing, contour, &self.limits, &self.settings, all, at_hand);
            Some(Arc::new(known))
        });
        let mut runs = Vec::new();
        for (&key, known) in keys.iter().zip(learned) {
            if let Some(known) = known {
                runs.extend((0..known.index.run_count()).map(|run| (key, run as u32)));
                self.enter_known(key, known);
            }
        }
        let told = each_of(keys, |key| self.told_by(drawing, key));
        for (&key, told) in keys.iter().zip(told) {
            self.take_down(key, told);
        }
        self.look_at_pairs(drawing, &runs);
    }

    /// Compares the pairs of segments that these runs form with each other and with others; the runs are new or have
    /// been forgotten.
    fn look_at_pairs(&mut self, drawing: &Drawing, runs: &[RunId]) {
        let mut pairs = std::mem::take(&mut self.pairs);
        let outlook = |key| self.outlook(drawing, key);
        pairs.check(&outlook, &self.limits, &self.settings, runs);
        self.pairs = pairs;
    }

    /// Whether what is shorter than the resolution decides about the contour of an entity of which these vertices have changed.
    pub(super) fn leaves_out(
        &self,
        drawing: &Drawing,
        entity: EntityId,
        vertices: Option<(usize, usize, usize)>,
    ) -> bool {
        drawing.get(entity).is_some_and(|it| {
            let (count, closed) = (it.geometry.segment_count(), it.geometry.is_closed());
            let ranges = segments_of(vertices, count, closed);
            self.chains.leaves_out(drawing, entity, &ranges)
        })
    }

    /// Checks again an entity whose contour still runs as it did. False where it is in no contour.
    pub(super) fn look_again(
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
        let is_recounted = before.count() != geometry.segment_count();
        if is_recounted {
            self.chains.recount(drawing, entity);
        }
        self.answers.retain(|(other, _), _| *other != key);
        self.lost.remove(&key);
        self.outdate_fits(key);
        let (Some(piece), Some(known)) = (self.chains.piece_of(entity), self.take_known(key))
        else {
            return false;
        };
        let mut known = Arc::unwrap_or_clone(known);
        let mut forgotten = FxHashSet::default();
        let spliced = vertices
            .filter(|_| is_recounted)
            .and_then(|vertices| self.splice(drawing, key, &mut known, vertices, &mut forgotten));
        if is_recounted && spliced.is_none() {
            self.pairs.forget(key, &known.index);
            self.learn(drawing, &[key]);
            return true;
        }
        let vertices = spliced.or(vertices);
        let Some(contour) = self.chains.get(key) else {
            return false;
        };
        if vertices.is_none() {
            known.stated = stated_role(contour, &|id| role_of(drawing, &self.settings, id));
        }
        // What holds of a whole entity is kept with its first and last segment.
        let mut own = segments_of(vertices, piece.count(), geometry.is_closed());
        let changed = own.len();
        if piece.count() > 0 {
            own.extend([0..1, piece.count() - 1..piece.count()]);
        }
        let ranges = own.into_iter().map(|range| within(&piece, range));
        let ranges: Vec<Range<usize>> = ranges.collect();
        let mut runs = self.runs_beside(key, contour, &known.index, (&ranges, changed));
        runs.extend(&forgotten);
        // Two closed outlines that lie on each other may begin anywhere: what is known of both is kept where one of them begins.
        let is_ring = geometry.is_closed() && known.index.run_count() > 1;
        let beginnings = match is_ring {
            true => self.beginnings_beside(drawing, key, known.index.run_count()),
            false => Vec::new(),
        };
        for &(other, run) in &beginnings {
            if let Some(known) = self.known.get(&other) {
                let bounds = known.index.bounds_of_run(run as usize);
                self.pairs.forget_run((other, run), &bounds);
            }
        }
        for &run in &runs {
            if forgotten.insert(run) {
                self.pairs
                    .forget_run((key, run as u32), &known.index.bounds_of_run(run));
            }
        }
        for range in ranges {
            let runs = known.index.runs_over(range.clone());
            (known.index).look_again(drawing, contour, self.tight_below(), runs);
            let (limits, settings) = (&self.limits, &self.settings);
            known.check(drawing, contour, limits, settings, range, None);
        }
        self.enter_known(key, Arc::new(known));
        self.note(drawing, key);
        let runs = runs.into_iter().map(|run| (key, run as u32));
        let runs: Vec<RunId> = runs.chain(beginnings).collect();
        self.look_at_pairs(drawing, &runs);
        true
    }

    /// The runs of a contour at which a pair rule may see something else after an edit of these segments, of which the first
    /// `changed` ranges have changed, and the others are the ends of the entity.
    fn runs_beside(
        &self,
        key: ContourKey,
        contour: &Contour,
        index: &ContourIndex,
        (ranges, changed): (&[Range<usize>], usize),
    ) -> BTreeSet<usize> {
        let is_all = contour.pieces.len() == 1;
        let mut runs = BTreeSet::new();
        for (nth, range) in ranges.iter().enumerate() {
            // For an entity that is a contour by itself there is nothing to check as a whole where
            // no other comes near its ends.
            let is_end = nth >= changed && is_all;
            let bounds = || index.bounds_of_run(index.run_of(range.start));
            if !is_end || self.pairs.comes_near_others(key, &bounds()) {
                // What a pair rule sees at a segment depends on its neighbours, too.
                runs.extend(runs_about(index, contour.closed, range));
            }
        }
        runs
    }

    /// Of the contours that are seen beside one, and are one closed entity each, the run with the first segment.
    fn beginnings_beside(&self, drawing: &Drawing, key: ContourKey, runs: usize) -> Vec<RunId> {
        let beginning = |key: ContourKey| {
            let first = self.chains.first_of(key)?;
            drawing.get(first)?.geometry.is_closed().then_some(())?;
            let index = self.chains.piece_of(first)?.first();
            let run = self.known.get(&key)?.index.run_of(index);
            Some((key, run as u32))
        };
        let beside = self.pairs.beside(key, runs).into_iter();
        beside.filter_map(beginning).collect()
    }
}

/// The runs of a contour with these segments and those that a rule on pairs looks at beside them.
fn runs_about(
    index: &ContourIndex,
    closed: bool,
    segments: &Range<usize>,
) -> impl Iterator<Item = usize> + use<> {
    let count = index.len();
    let (from, to) = (
        segments.start.saturating_sub(NEIGHBOURS),
        segments.end + NEIGHBOURS,
    );
    let before = (closed && segments.start < NEIGHBOURS)
        .then(|| index.runs_over(count.saturating_sub(NEIGHBOURS)..count));
    let behind = (closed && to > count).then(|| index.runs_over(0..NEIGHBOURS.min(count)));
    let own = index.runs_over(from..to.min(count));
    own.chain(before.into_iter().flatten())
        .chain(behind.into_iter().flatten())
}

/// Asks a question of each contour; of many contours on several threads.
fn each_of<T: Send>(keys: &[ContourKey], ask: impl Fn(ContourKey) -> T + Sync) -> Vec<T> {
    match keys.len() {
        0..MANY => keys.iter().map(|&key| ask(key)).collect(),
        _ => keys.par_iter().map(|&key| ask(key)).collect(),
    }
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
        // Segments after the splice have other indices now; the segment before it has another end.
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

/// Segments of a piece as those of its contour.
fn within(piece: &Piece, own: Range<usize>) -> Range<usize> {
    let Range { start, end } = piece.range();
    match piece.reversed {
        true => end - own.end..end - own.start,
        false => start + own.start..start + own.end,
    }
}
