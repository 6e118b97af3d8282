//! What is known of one contour: its index, its stated role, what the local rules have seen in it.

use super::report::Report;
use crate::drawing::{Contour, ContourIndex, Drawing, RUN, Role};
use crate::finding::{Finding, Severity, Side};
use crate::rules::lost_pocket::Lost;
use crate::rules::{LOCAL_RULES, Limits, Observation, Outlook};
use crate::settings::Effective;
use std::iter::once;
use std::ops::Range;

#[derive(Clone, Debug)]
pub(crate) struct Known {
    pub(crate) index: ContourIndex,
    /// The role that an entity or a layer states.
    pub(crate) stated: Option<Role>,
    /// For each local rule, for each run of the index, what it has seen; nothing at all where it has seen nothing, as in
    /// most contours.
    observations: Vec<Vec<Vec<Observation>>>,
    /// Number of runs when the rules looked last.
    runs: usize,
}

impl Known {
    pub(crate) fn new(index: ContourIndex, stated: Option<Role>) -> Known {
        Known {
            index,
            stated,
            observations: Vec::new(),
            runs: 0,
        }
    }

    /// Lets every local rule look again at the segments of `changed` and as far about as it reaches; at all behind when
    /// the number of segments has changed.
    pub(crate) fn check(
        &mut self,
        drawing: &Drawing,
        contour: &Contour,
        limits: &Limits,
        settings: &Effective,
        changed: Range<usize>,
    ) {
        let outlook = Outlook {
            drawing,
            contour,
            index: &self.index,
            limits,
        };
        let (count, runs) = (contour.len(), self.index.run_count());
        let recounted = self.runs != runs;
        self.runs = runs;
        let mut seen = Vec::new();
        for (number, rule) in LOCAL_RULES.iter().enumerate() {
            if settings.severity(rule.rule).is_none() {
                continue;
            }
            let (before, behind) = (rule.reach)(&outlook, changed.clone());
            let end = if recounted {
                count
            } else {
                (changed.end + behind).min(count)
            };
            let mut ranges: Vec<Range<usize>> =
                once(changed.start.saturating_sub(before)..end).collect();
            if contour.closed && changed.start < before {
                ranges.push(count.saturating_sub(before - changed.start)..count);
            }
            if contour.closed && changed.end + behind > count {
                ranges.push(0..(changed.end + behind - count).min(count));
            }
            if let Some(observations) = self
                .observations
                .get_mut(number)
                .filter(|observations| !observations.is_empty())
            {
                observations.resize(runs, Vec::new());
            }
            for run in ranges
                .into_iter()
                .flat_map(|range| range.start / RUN..range.end.div_ceil(RUN).min(runs))
            {
                seen.clear();
                (rule.check)(&outlook, self.index.range_of(run), &mut seen);
                if seen.is_empty() && self.observations.get(number).is_none_or(Vec::is_empty) {
                    continue;
                }
                self.observations.resize(LOCAL_RULES.len(), Vec::new());
                let observations = &mut self.observations[number];
                observations.resize(runs, Vec::new());
                observations[run] = seen.as_slice().into();
            }
        }
    }

    /// True when a local rule has seen something.
    pub(crate) fn has_observations(&self) -> bool {
        !self.observations.iter().flatten().all(Vec::is_empty)
    }

    /// Adds the findings of the local rules in this contour, rule by rule, in order of travel.
    pub(crate) fn report(&self, outlook: &Outlook, wire_side: Option<Side>, report: &mut Report) {
        for (rule, observations) in LOCAL_RULES.iter().zip(&self.observations) {
            let concerned = |observation: &&Observation| {
                let of_side = match wire_side {
                    Some(_) => observation.side.is_none() || observation.side == wire_side,
                    None => !observation.needs_side,
                };
                of_side
                    && (observation.index > 0
                        || !outlook.contour.closed
                        || (rule.holds)(outlook, **observation))
            };
            let mut observations = observations.iter().flatten().filter(concerned);
            if rule.one_hint_when_side_unknown && wire_side.is_none() {
                let Some(&first) = observations.next() else {
                    continue;
                };
                let (mildest, count) = (Some(Severity::Hint), 1 + observations.count());
                if report.counts(rule.rule, mildest)
                    && let (Some(place), Some(detail)) = (
                        outlook.place(first.index as usize),
                        (rule.detail)(outlook, first, Some(count)),
                    )
                {
                    let related = if count == 1 {
                        (rule.related)(outlook, first)
                    } else {
                        Vec::new()
                    };
                    report.add(rule.rule, mildest, place, detail, related);
                }
                continue;
            }
            for &observation in observations {
                if report.counts(rule.rule, None)
                    && let (Some(place), Some(detail)) = (
                        outlook.place(observation.index as usize),
                        (rule.detail)(outlook, observation, None),
                    )
                {
                    report.add(
                        rule.rule,
                        None,
                        place,
                        detail,
                        (rule.related)(outlook, observation),
                    );
                }
            }
        }
    }
}

/// What the offset of a contour loses.
#[derive(Clone, Debug)]
pub(crate) struct Answer {
    /// What was asked: the side, and whether there is a neck.
    pub(crate) asked: (Side, bool),
    pub(crate) lost: Vec<Lost>,
    /// What stands against a path, where nothing is lost; `None` while that has not been asked.
    pub(crate) misfit: Option<Option<Box<Finding>>>,
}
