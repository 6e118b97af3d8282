//! How well all pairs fit: no repair may make that worse.

use super::Analysis;
use super::fits::Paired;
use crate::drawing::Drawing;

/// Laying one segment of a part in the other takes as long as this many looks at pairs of segments.
const LOOKS_A_SEGMENT: u64 = 50;

/// How well the parts of all pairs fit.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fitting {
    /// Pairs that could be laid in each other.
    pairs: usize,
    /// Places that bind.
    binding: usize,
    /// The least clearance of all, at most the one that is set.
    least: f64,
    rounding: f64,
}

impl Fitting {
    /// True where no pair is lost, no more places bind, and nowhere is less left than before. The
    /// faults of a pair that was not recognised before were there all the same.
    pub(super) fn is_no_worse_than(&self, before: &Fitting) -> bool {
        self.pairs > before.pairs
            || self.pairs == before.pairs
                && self.binding <= before.binding
                && self.least >= before.least - self.rounding
    }

    /// True where nothing is worse and fewer places bind.
    pub(super) fn is_better_than(&self, before: &Fitting) -> bool {
        self.is_no_worse_than(before) && self.binding < before.binding
    }
}

impl Analysis {
    /// How well the parts of all pairs fit; `None` where there is no pair. The looks that it takes are added to `looks`.
    pub(super) fn fitting(&mut self, drawing: &Drawing, looks: &mut u64) -> Option<Fitting> {
        let Paired {
            pairs, outlines, ..
        } = self.paired(drawing)?;
        let rounding = self.limits.tolerances.report;
        let mut fitting: Option<Fitting> = None;
        for pair in pairs {
            let both = pair.map(|(key, index)| (key, &outlines[index]));
            let segments: usize = both.iter().map(|(_, it)| it.contour.len()).sum();
            *looks = looks.saturating_add(LOOKS_A_SEGMENT * segments as u64);
            let Some(fitted) = self.fit_of(drawing, both) else {
                continue;
            };
            let held = &fitted.held;
            let binds = |(_, clearance): &(_, f64)| *clearance < -rounding;
            let binding = held.clearances().filter(binds).count();
            let known = fitting.get_or_insert(Fitting {
                pairs: 0,
                binding: 0,
                least: held.least(),
                rounding,
            });
            known.pairs += 1;
            known.binding += binding;
            known.least = known.least.min(held.least());
        }
        fitting
    }

    /// True where an edit makes no pair fit worse; `tried` is the state after it.
    pub(super) fn keeps_fits(
        &self,
        drawing: &Drawing,
        (tried, edited): (&mut Analysis, &Drawing),
        looks: &mut u64,
    ) -> bool {
        let Some(before) = self.fitting_of(drawing) else {
            return true;
        };
        let after = tried.fitting(edited, looks);
        after.is_some_and(|after| after.is_no_worse_than(before))
    }

    /// How well the pairs of the present drawing fit.
    pub(super) fn fitting_of(&self, drawing: &Drawing) -> Option<&Fitting> {
        // Most drawings have no pairs, and a copy is expensive.
        self.asked_partners()?;
        let fitting = || self.clone().fitting(drawing, &mut 0);
        self.fitting.get_or_init(fitting).as_ref()
    }
}
