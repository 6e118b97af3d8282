//! The settings under which a program of ours was written, where they differ from those of the drawing.
//!
//! What can be measured in the program is measured: its contours and their order, corrections, the way in, tab and
//! overlap. What cannot is tried: for each guess the program is generated; the guess that shares most blocks is
//! refined, one setting at a time.

use super::against_reference::{Told, against_reference};
use super::cache::Guess;
use super::drawn::Drawn;
use super::measure;
use super::passes::{corrections, shortness};
use super::reference::{Reference, Under};
use super::sides::Sides;
use super::tabs::{tabs, threads};
use super::traced::Traced;
use super::verdict::{is_certain, is_round, is_told, rank, without_leads};
use super::way::{Way, way};
use crate::settings::{
    Compensation, Corner, Direction, Effective, Lead, LengthSetting, Order, Sequence, SkimCorner,
};
use rustc_hash::FxHashMap;
use std::cmp::Ordering;

/// The most blocks that are generated under guessed settings; the same where a program was searched before that differs
/// in a few blocks; and the least cost of a guess.
const MOST_TRIED: usize = 300_000;
const MOST_AGAIN: usize = 30_000;
const LEAST_COST: usize = 60;
/// A guess of the sides whose score is lower by at most this may still be right.
const LESS: f64 = 0.05;
/// A correction may have four decimals: it is at most this many steps of 0.1 µm away from one that was found.
const STEPS: i32 = 12;
/// A diameter of thread holes for which there is room nearly everywhere, mm.
const HOLE: f64 = 0.5;

/// The changes in a program of ours under other settings.
pub(super) fn otherwise(drawn: &Drawn, traced: &Traced) -> Option<Told> {
    let known = drawn.cache().guess();
    let is_near = known.as_ref().is_some_and(|known| known.is_near(traced));
    if let Some(Guess { under, left, .. }) = &known
        && let Some(under) = under
        && let Some(told) = against_reference(drawn, traced, under)
        && (is_certain(traced, &told, under)
            || is_near && told.elsewhere == 0 && told.comparison.differences.len() <= *left)
        && is_told(traced, &told)
    {
        return Some(without_leads(traced, told.under(under)));
    }
    let mut searches: Vec<Search> = Vec::new();
    for &sides in drawn.sides() {
        let mut search = Search::of(drawn, traced, sides)?;
        if is_near {
            search.fuel = MOST_AGAIN;
        }
        search.begin();
        searches.push(search);
        if searches.last().is_some_and(Search::is_done) {
            break;
        }
    }
    // The most likely side first, and any other that is hardly less so: what no word contradicts comes before what lies
    // nearer.
    searches.sort_by(|one, other| {
        let key = |search: &Search| (search.is_done(), search.is_of_its_side(), search.score);
        key(other).partial_cmp(&key(one)).unwrap_or(Ordering::Equal)
    });
    let least = searches.first()?.score - LESS;
    searches.retain(|search| search.score >= least);
    let (mut told, mut fuel) = (None, MOST_TRIED);
    for search in &mut searches {
        search.fuel = search.fuel.min(fuel);
        search.all();
        fuel = search.fuel;
        let is_done = search.is_done();
        let own = search.told.take();
        let is_better = |own: &(Told, Under), told: &(Told, Under)| {
            rank(traced, &own.0) < rank(traced, &told.0)
        };
        if told
            .as_ref()
            .is_none_or(|told| own.as_ref().is_some_and(|own| is_better(own, told)))
        {
            told = own;
        }
        if is_done {
            break;
        }
    }
    let (told, under) = told.unzip();
    let told = told.zip(under.as_ref());
    let told = told.map(|(told, under)| without_leads(traced, told.under(under)));
    let differences = |told: &Told| told.comparison.differences.len();
    let left = told.as_ref().map_or(0, differences);
    drawn.cache().note(Guess::of(traced, under, left));
    told
}

struct Search<'a> {
    drawn: &'a Drawn,
    traced: &'a Traced,
    /// Blocks that may still be written.
    fuel: usize,
    cost: usize,
    best: Under,
    /// The share of blocks that it has in common with the program.
    score: f64,
    /// The blocks of the program regardless of direction, and with it.
    ways: [FxHashMap<Way, i32>; 2],
    /// The verdict of the best guess that leaves few differences.
    told: Option<(Told, Under)>,
}

impl<'a> Search<'a> {
    fn of(drawn: &'a Drawn, traced: &'a Traced, sides: Sides) -> Option<Search<'a>> {
        let is_offset = traced.blocks.iter().any(|block| block.is_offset());
        let settings = &*drawn.settings;
        let compensation = match (settings.compensation, is_offset) {
            (Compensation::Path, true) => Compensation::Controller,
            (Compensation::Controller, false) => Compensation::Path,
            (set, _) => set,
        };
        let handles = measure::contours(drawn, traced);
        let settings = Effective {
            compensation,
            order: match handles {
                Some(_) => Order::AsDrawn,
                None => settings.order,
            },
            ..settings.clone()
        };
        let segments: usize = drawn.cut().map(|outline| outline.contour.len()).sum();
        let ways = [false, true].map(|is_directed| {
            let mut ways = FxHashMap::default();
            for block in &traced.blocks {
                *ways.entry(way(block, is_directed)).or_default() += 1;
            }
            ways
        });
        (!traced.blocks.is_empty()).then(|| Search {
            drawn,
            traced,
            fuel: MOST_TRIED,
            cost: traced
                .blocks
                .len()
                .max(segments.min(2 * traced.blocks.len()))
                .max(LEAST_COST),
            best: Under {
                settings,
                sides,
                handles,
            },
            score: -1.0,
            ways,
            told: None,
        })
    }

    fn is_done(&self) -> bool {
        self.told
            .as_ref()
            .is_some_and(|(told, under)| is_certain(self.traced, told, under))
    }

    /// It has found the changes in a program of this side, as far as words tell it.
    fn is_of_its_side(&self) -> bool {
        let told = self.told.as_ref();
        told.is_some_and(|(told, _)| !told.has_other_side())
    }

    /// Guesses of corrections alone.
    fn begin(&mut self) {
        let base = self.best.clone();
        self.each(false, self.of_corrections());
        self.each(true, self.of_ways());
        if self.score <= 0.0 && base.handles.is_some() {
            // The contours may have been taken for others.
            let settings = self.drawn.settings.order;
            self.best = Under {
                handles: None,
                settings: Effective {
                    order: settings,
                    ..base.settings
                },
                ..base
            };
            self.each(false, self.of_corrections());
        }
    }

    /// Guesses of the other settings, one after the other.
    fn all(&mut self) {
        self.score = -1.0;
        self.each(true, vec![self.best.clone()]);
        for nth in 0..2 {
            let before = self.score;
            self.each(true, self.of_directions());
            self.each(true, self.of_passes());
            self.each(true, self.of_leads());
            self.each(true, self.of_holes());
            self.each(true, self.of_ways());
            if nth == 0 {
                self.each(true, self.of_threads());
            }
            self.each(true, self.of_tabs());
            self.each(true, self.of_overlaps());
            for pass in 0..self.best.settings.each_correction().len() {
                self.each(true, self.of_steps(pass));
            }
            if self.is_done() || self.score <= before {
                return;
            }
        }
    }

    /// Tries guesses, and keeps the one whose program is most alike.
    fn each(&mut self, is_directed: bool, guesses: Vec<Under>) {
        for guess in guesses {
            if self.is_done() || self.fuel < self.cost {
                return;
            }
            self.fuel -= self.cost;
            let Some(reference) = self.drawn.reference(self.traced, &guess) else {
                continue;
            };
            let score = self.likeness(&reference, is_directed);
            if score <= 0.5 && self.score >= score {
                continue;
            }
            let told = against_reference(self.drawn, self.traced, &guess);
            let told = told.filter(|told| is_told(self.traced, told));
            if let Some(told) = told {
                let is_better = |(other, _): &(Told, Under)| {
                    rank(self.traced, &told) < rank(self.traced, other)
                };
                if self.told.as_ref().is_none_or(is_better) {
                    self.told = Some((told, guess.clone()));
                }
            }
            if score > self.score {
                (self.best, self.score) = (guess, score);
            }
        }
    }

    /// The share of blocks that a program has in common with ours.
    fn likeness(&self, reference: &Reference, is_directed: bool) -> f64 {
        let mut left = self.ways[usize::from(is_directed)].clone();
        let mut common = 0;
        for block in &reference.traced.blocks {
            if let Some(count) = left.get_mut(&way(block, is_directed))
                && *count > 0
            {
                *count -= 1;
                common += 1;
            }
        }
        let both = reference.traced.blocks.len() + self.traced.blocks.len();
        f64::from(2 * common) / both as f64
    }

    /// The best guess with other settings.
    fn with(&self, change: impl FnOnce(&mut Effective)) -> Under {
        let mut guess = self.best.clone();
        change(&mut guess.settings);
        guess
    }

    fn of_corrections(&self) -> Vec<Under> {
        let mut guesses = vec![self.best.clone()];
        for corrections in corrections(self.drawn, self.traced) {
            let skim_corners = match corrections.len() {
                0..2 => vec![None],
                _ => vec![None, Some(SkimCorner::ConstantStock)],
            };
            for corner in [Corner::Arc, Corner::Intersection] {
                for &skim_corner in &skim_corners {
                    guesses.push(self.with(|settings| {
                        correct(settings, &corrections);
                        settings.corner = corner;
                        settings.passes.skim_corner = skim_corner;
                    }));
                }
            }
        }
        guesses
    }

    /// 4B has no word for the correction: where it has no transition either, only its ways in and out tell it.
    fn of_ways(&self) -> Vec<Under> {
        let own = self.best.settings.each_correction();
        if !self.traced.four_b {
            return Vec::new();
        }
        let Some(reference) = self.drawn.reference(self.traced, &self.best) else {
            return Vec::new();
        };
        let of = |longer: f64| {
            let by = (longer * 10.0).round() / 1e4;
            let corrections: Vec<f64> = own.iter().map(|mm| mm - by).collect();
            let is_some = corrections.iter().all(|mm| *mm > 0.0);
            is_some.then(|| self.with(|settings| correct(settings, &corrections)))
        };
        let longer = measure::longer_ways(self.traced, &reference.traced);
        let mut guesses: Vec<Under> = longer.into_iter().filter_map(of).collect();
        guesses.sort_by_key(|guess| shortness(guess.settings.correction));
        guesses
    }

    fn of_directions(&self) -> Vec<Under> {
        let all = [Direction::Ccw, Direction::Cw, Direction::AsDrawn];
        let of = |direction| self.with(|settings| settings.direction = direction);
        all.map(of).into()
    }

    fn of_leads(&self) -> Vec<Under> {
        let own = &self.drawn.settings;
        let mut lengths = measure::leads(self.traced, self.best.settings.correction);
        // Of two ways that should be as long, the one of an odd length was changed.
        lengths.sort_by_key(|(length, _)| !is_round(*length));
        let mut guesses = Vec::new();
        for (length, stated) in [(own.lead_in, own.stated_lead_in)]
            .into_iter()
            .chain(lengths)
        {
            for lead in [Lead::Perpendicular, Lead::Straight, Lead::Arc] {
                guesses.push(self.with(|settings| {
                    (settings.lead, settings.lead_in, settings.stated_lead_in) =
                        (lead, length, stated);
                }));
            }
        }
        guesses
    }

    /// The wire may be threaded at the deepest place of an opening.
    fn of_holes(&self) -> Vec<Under> {
        let others = [None, Some(HOLE)].into_iter();
        let others =
            others.filter(|hole| hole.is_some() != self.best.settings.start_hole.is_some());
        // A length of the way in that was measured may be that to the hole, and stated nowhere.
        let lengths = |own: &Effective| (own.lead_in, own.stated_lead_in);
        let [own, best] = [&*self.drawn.settings, &self.best.settings].map(lengths);
        let lengths = std::iter::once(own).chain((best != own).then_some(best));
        let of = |hole| {
            let leads = [Lead::Perpendicular, Lead::Straight, Lead::Arc];
            let all = lengths
                .clone()
                .flat_map(move |length| leads.map(|lead| (length, lead)));
            all.map(move |((length, stated), lead)| {
                self.with(|settings| {
                    (settings.start_hole, settings.lead) = (hole, lead);
                    (settings.lead_in, settings.stated_lead_in) = (length, stated);
                })
            })
        };
        others.flat_map(of).collect()
    }

    /// The wire may be threaded anywhere: where the program has it.
    fn of_threads(&self) -> Vec<Under> {
        let corrections = self.best.settings.each_correction();
        let Some([threads, entries]) = threads(self.drawn, self.traced, &corrections) else {
            return Vec::new();
        };
        let threaded = self.with(|settings| settings.thread = Some(threads.clone()));
        let entered = self.with(|settings| {
            settings.thread = Some(threads);
            settings.entry = Some(entries);
        });
        vec![threaded, entered]
    }

    fn of_tabs(&self) -> Vec<Under> {
        let without = self.with(|settings| settings.tab = LengthSetting::One(0.0));
        let Some(reference) = self.drawn.reference(self.traced, &without) else {
            return Vec::new();
        };
        let corrections = self.best.settings.each_correction();
        let lengths = tabs(self.drawn, self.traced, &reference, &corrections);
        let of = |tab| self.with(|settings| settings.tab = LengthSetting::One(tab));
        // Slugs are kept above a limit that nothing in the program tells.
        let of_slugs = |tab: f64| {
            let knows_slugs = self.drawn.settings.job.slug_limit.is_some();
            (tab > 0.0 && !knows_slugs).then(|| {
                self.with(|settings| {
                    settings.tab = LengthSetting::One(tab);
                    (settings.job.thickness, settings.job.slug_limit) = (Some(1.0), Some(0.0));
                })
            })
        };
        let with_slugs = |tab: f64| std::iter::once(of(tab)).chain(of_slugs(tab));
        lengths.into_iter().flat_map(with_slugs).collect()
    }

    fn of_overlaps(&self) -> Vec<Under> {
        let lengths = measure::overlaps(self.traced);
        let of = |overlap| self.with(|settings| settings.closing_overlap = overlap);
        lengths.into_iter().map(of).collect()
    }

    /// One of the corrections changed by a few tenths of a micrometre.
    fn of_steps(&self, pass: usize) -> Vec<Under> {
        let corrections = self.best.settings.each_correction();
        let steps = (1..=STEPS).flat_map(|step| [step, -step]);
        let of = |step: i32| {
            let mut corrections = corrections.clone();
            let own = corrections.get_mut(pass)?;
            *own = ((*own * 1e4).round() + f64::from(step)) / 1e4;
            (*own > 0.0).then(|| self.with(|settings| correct(settings, &corrections)))
        };
        steps.filter_map(of).collect()
    }

    fn of_passes(&self) -> Vec<Under> {
        if self.best.settings.corrections.len() < 2 {
            return Vec::new();
        }
        let mut guesses = Vec::new();
        // Passes that all run one way look like those of the other direction, every other one.
        let directed = self.of_directions();
        for sequence in [Sequence::Alternate, Sequence::OneWay] {
            for skim_corner in [SkimCorner::Sharp, SkimCorner::ConstantStock] {
                for mut guess in directed.clone() {
                    guess.settings.passes.sequence = Some(sequence);
                    guess.settings.passes.skim_corner = Some(skim_corner);
                    guesses.push(guess);
                }
            }
        }
        guesses
    }
}

fn correct(settings: &mut Effective, corrections: &[f64]) {
    settings.correction = corrections.first().copied().unwrap_or_default();
    settings.pass = (corrections.len() > 1).then_some(1);
    settings.corrections = corrections.to_vec();
}
