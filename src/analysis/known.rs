//! The knowledge of one contour: its index, its stated role, the observations of the local rules.

use super::notable::Kind;
use super::report::Report;
use super::together::of_observations;
use crate::drawing::{Contour, ContourIndex, Drawing, Role};
use crate::finding::{Detail, Place, Rule, Severity, Side};
use crate::rules::arc_as_chords::REACH;
use crate::rules::{AtHand, LOCAL_RULES, Limits, LocalRule, Observation, Outlook};
use crate::settings::Effective;
use std::iter::once;
use std::ops::Range;

/// Runs whose segments are at hand at once.
const AT_ONCE: usize = 256;
/// Where runs are farther apart than this, as the first and the last of a contour, the segments between them are not at hand.
const NEAR: usize = 4;
/// Segments at hand before and after the runs, as many as rules look at; others are worked out when a rule asks for them.
const ABOUT: usize = REACH;

#[derive(Clone, Debug)]
pub(crate) struct Known {
    pub(crate) index: ContourIndex,
    /// The role that an entity or a layer states.
    pub(crate) stated: Option<Role>,
    /// The number of its workpiece.
    pub(crate) part: u16,
    /// What each local rule has seen, for each run of the index: empty where a rule, or none of them as in most
    /// contours, has seen anything.
    by_rule: Box<[Vec<Vec<Observation>>]>,
}

impl Known {
    pub(crate) fn new(index: ContourIndex, stated: Option<Role>, part: u16) -> Known {
        Known {
            index,
            stated,
            part,
            by_rule: Box::default(),
        }
    }

    /// It is cut on the line, which only a role of its own says.
    pub(crate) fn is_on_line(&self) -> bool {
        self.stated == Some(Role::Line)
    }

    /// Runs every local rule on the segments of `changed` and those within its reach. `all` is the
    /// whole contour, where that is at hand.
    pub(crate) fn check(
        &mut self,
        drawing: &Drawing,
        contour: &Contour,
        limits: &Limits,
        settings: &Effective,
        changed: Range<usize>,
        mut all: Option<AtHand>,
    ) {
        let outlook = Outlook {
            drawing,
            contour,
            index: &self.index,
            limits,
            part: self.part,
            on_line: self.is_on_line(),
            at_hand: None,
        };
        let (count, runs) = (contour.len(), self.index.run_count());
        // Which rule checks which run, run by run.
        let mut asked: Vec<(usize, usize)> = Vec::new();
        for (number, rule) in LOCAL_RULES.iter().enumerate() {
            // The wire's centre follows any corner that is drawn.
            let needs_no_room = outlook.on_line && rule.rule == Rule::SharpCorner;
            if settings.severity(rule.rule).is_none() || needs_no_room {
                continue;
            }
            let (before, behind) = (rule.reach)(&outlook, changed.clone());
            let end = (changed.end + behind).min(count);
            let mut ranges: Vec<Range<usize>> =
                once(changed.start.saturating_sub(before)..end).collect();
            if contour.closed && changed.start < before {
                ranges.push(count.saturating_sub(before - changed.start)..count);
            }
            if contour.closed && changed.end + behind > count {
                ranges.push(0..(changed.end + behind - count).min(count));
            }
            asked.extend(
                ranges
                    .into_iter()
                    .flat_map(|range| self.index.runs_over(range))
                    .map(|run| (run, number)),
            );
        }
        asked.sort_unstable();
        asked.dedup();
        let mut seen = Vec::new();
        let at_once = |(one, _): &(usize, usize), (other, _): &(usize, usize)| {
            one / AT_ONCE == other / AT_ONCE && other - one <= NEAR
        };
        for asked in asked.chunk_by(at_once) {
            let segments_of = |run| self.index.range_of(run);
            let range = segments_of(asked[0].0).start.saturating_sub(ABOUT)
                ..(segments_of(asked[asked.len() - 1].0).end + ABOUT).min(count);
            let at_hand = all
                .take()
                .unwrap_or_else(|| AtHand::of(drawing, contour, limits, range));
            let outlook = Outlook {
                at_hand: Some(&at_hand),
                ..outlook
            };
            for &(run, number) in asked {
                seen.clear();
                (LOCAL_RULES[number].check)(&outlook, self.index.range_of(run), &mut seen);
                let known = self.by_rule.get(number);
                if seen.is_empty() && known.is_none_or(Vec::is_empty) {
                    continue;
                }
                if self.by_rule.is_empty() {
                    self.by_rule = vec![Vec::new(); LOCAL_RULES.len()].into();
                }
                let known = &mut self.by_rule[number];
                known.resize(runs, Vec::new());
                known[run] = seen.as_slice().into();
            }
        }
    }

    /// Records that the segments of the runs from `behind` on have indices larger by so many.
    pub(crate) fn shift(&mut self, behind: usize, by: isize) {
        let of_runs = self.by_rule.iter_mut();
        let later = of_runs.flat_map(|seen| seen.iter_mut().skip(behind));
        for observation in later.flatten() {
            observation.index = (observation.index as usize).wrapping_add_signed(by) as u32;
        }
    }

    /// True when a local rule has an observation.
    pub(crate) fn has_observations(&self) -> bool {
        !self.by_rule.iter().flatten().all(Vec::is_empty)
    }

    /// The number of findings of each kind, rule by rule; and of those that another one of the contour stands for.
    /// `open_is_an_error` where an open contour is reported as one.
    pub(crate) fn counts(
        &self,
        outlook: &Outlook,
        wire_side: Option<Side>,
        open_is_an_error: bool,
    ) -> [Vec<(Kind, usize)>; 2] {
        let (mut own, mut stood_for) = (Vec::new(), Vec::new());
        let of_rules = self.of_rules(outlook, wire_side, open_is_an_error);
        for of_rule in of_rules.filter(|of_rule| of_rule.count > 0) {
            let kind = (of_rule.rule.rule, of_rule.mildest);
            let is_one = of_rule.is_one || of_rule.rule.together.is_some();
            own.push((kind, if is_one { 1 } else { of_rule.count }));
            if !of_rule.is_one && is_one && of_rule.count > 1 {
                stood_for.push((kind, of_rule.count - 1));
            }
        }
        [own, stood_for]
    }

    /// What the local rules of which one finding stands for many have seen at a segment: each by itself.
    pub(crate) fn each_at(
        &self,
        outlook: &Outlook,
        wire_side: Option<Side>,
        index: usize,
    ) -> Vec<(Rule, Place, Detail)> {
        let of_rules = self.of_rules(outlook, wire_side, false);
        let together = of_rules.filter(|of_rule| of_rule.rule.together.is_some());
        let mut found = Vec::new();
        for of_rule in together {
            let run = self.index.runs_over(index..index + 1).next();
            let observations = run.and_then(|run| of_rule.observations.get(run));
            let here = observations.into_iter().flatten().find(|one| {
                one.index as usize == index
                    && is_of(wire_side, one)
                    && holds(of_rule.rule, outlook, one)
            });
            found.extend(here.and_then(|&one| {
                let detail = (of_rule.rule.detail)(outlook, one, of_rule.is_one.then_some(1))?;
                Some((of_rule.rule.rule, outlook.place(index)?, detail))
            }));
        }
        found
    }

    /// Adds the findings of the local rules in this contour, which have been counted, rule by rule, in order of travel.
    pub(crate) fn report(&self, outlook: &Outlook, wire_side: Option<Side>, report: &mut Report) {
        let open_is_an_error = report.open_is_an_error();
        for of_rule in self.of_rules(outlook, wire_side, open_is_an_error) {
            let OfRule {
                rule,
                mildest,
                count,
                is_one,
                observations,
            } = of_rule;
            let concerned = observations.iter().flatten().filter(|observation| {
                is_of(wire_side, observation) && holds(rule, outlook, observation)
            });
            if let Some(together) = rule.together
                && !is_one
                && count > 1
                && !report.names_each()
            {
                let concerned: Vec<Observation> = concerned.copied().collect();
                if let Some((place, detail, related)) =
                    of_observations(outlook, rule, together, concerned)
                    && !report.is_full(rule.rule, mildest)
                {
                    report.add(rule.rule, mildest, place, detail, related);
                }
                continue;
            }
            for &observation in concerned.take(if is_one { 1 } else { usize::MAX }) {
                if report.is_full(rule.rule, mildest) {
                    break;
                }
                if let (Some(place), Some(detail)) = (
                    outlook.place(observation.index as usize),
                    (rule.detail)(outlook, observation, is_one.then_some(count)),
                ) {
                    let is_told_alone = !is_one || count == 1;
                    let related = if is_told_alone {
                        (rule.related)(outlook, observation)
                    } else {
                        Vec::new()
                    };
                    report.add(rule.rule, mildest, place, detail, related);
                }
            }
        }
    }

    fn of_rules<'a>(
        &'a self,
        outlook: &'a Outlook,
        wire_side: Option<Side>,
        open_is_an_error: bool,
    ) -> impl Iterator<Item = OfRule<'a>> {
        // An open contour is not cut: a finding that would only spoil the cut is a hint until it is
        // closed.
        let waits = !outlook.contour.closed && wire_side.is_none() && open_is_an_error;
        let of_rules = LOCAL_RULES.iter().zip(&self.by_rule);
        of_rules.map(move |(rule, observations)| {
            let concerned = observations.iter().flatten();
            let concerned =
                concerned.filter(|one| is_of(wire_side, one) && holds(rule, outlook, one));
            let is_one = rule.one_hint_when_side_unknown && wire_side.is_none();
            OfRule {
                rule,
                mildest: if is_one || waits {
                    Some(Severity::Hint)
                } else {
                    rule.mildest
                },
                count: concerned.count(),
                is_one,
                observations,
            }
        })
    }
}

/// The findings of a local rule for a contour.
struct OfRule<'a> {
    rule: &'a LocalRule,
    mildest: Option<Severity>,
    /// The number of its observations, for which one finding stands where it `is_one`.
    count: usize,
    is_one: bool,
    observations: &'a [Vec<Observation>],
}

/// Whether an observation still holds; one at the start of a closed contour is checked again.
fn holds(rule: &LocalRule, outlook: &Outlook, observation: &Observation) -> bool {
    observation.index > 0 || !outlook.contour.closed || (rule.holds)(outlook, *observation)
}

/// True for an observation on this side of the wire, or on any where the side is not known.
fn is_of(wire_side: Option<Side>, observation: &Observation) -> bool {
    match wire_side {
        Some(_) => observation.side.is_none() || observation.side == wire_side,
        None => !observation.needs_side,
    }
}
