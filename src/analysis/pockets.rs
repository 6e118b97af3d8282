//! What the offsets of contours lose, and where no path of the wire passes its proof.

use super::Analysis;
use super::known::Answer;
use super::report::Report;
use crate::drawing::{ContourKey, Drawing, Outline, Role};
use crate::finding::{Detail, Finding, NotJudged, Place, Rule, Side};
use crate::geometry::Point;
use crate::rules::lost_pocket::{self, Checked, Lost};
use crate::settings::Compensation;
use crate::toolpath;

impl Analysis {
    /// What the offsets of contours with a known wire side lose.
    pub(super) fn report_lost_pockets(
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
        // Where the rules that would find these are off, a neck is assumed and a crossing is not.
        let necks_are_told = is_on(Rule::NarrowSlot);
        let lengths = ordered.iter().filter_map(|&key| self.chains.get(key));
        let segments: usize = lengths.map(|contour| contour.len()).sum();
        let granted = self.settings.budget.granted(segments);
        let (mut left, mut left_out) = (granted, Vec::new());
        for (&key, &side) in ordered.iter().zip(sides) {
            let Some(side) = side.filter(|_| !self.pairs.seen.crossings.contains_key(&key)) else {
                continue;
            };
            let asked = (
                side,
                !necks_are_told || self.pairs.seen.slots.contains_key(&key),
            );
            let answer = self.lost.get(&key);
            let is_known = answer.is_some_and(|answer| answer.answers(asked, left));
            if !is_known {
                let Some(outlook) = self.outlook(drawing, key) else {
                    continue;
                };
                let answer = Answer {
                    asked,
                    checked: lost_pocket::check(&outlook, side, asked.1, (granted, left)),
                    misfit: None,
                };
                self.lost.insert(key, answer);
            }
            // The looks are those of a fresh analysis, whatever is known already.
            let looks = self.lost.get(&key).map_or(0, |it| it.checked.looks);
            let Some(rest) = left.checked_sub(looks) else {
                left_out.push(key);
                continue;
            };
            left = rest;
            // Where findings are only counted, to judge a fix, these are left out: they take too
            // long to find.
            if report.shows_findings()
                && self
                    .lost
                    .get(&key)
                    .is_some_and(|answer| answer.loses_nothing() && answer.misfit.is_none())
            {
                let misfit = self.misfit(drawing, key, side).map(Box::new);
                if let Some(answer) = self.lost.get_mut(&key) {
                    answer.misfit = Some(misfit);
                }
            }
            let (
                Some(Answer {
                    checked:
                        Checked {
                            lost: Some(lost), ..
                        },
                    misfit,
                    ..
                }),
                Some(outlook),
            ) = (self.lost.get(&key), self.outlook(drawing, key))
            else {
                continue;
            };
            let misfit = misfit.iter().flatten().next();
            let slots = if lost.is_empty() && misfit.is_none() || !necks_are_told {
                Vec::new()
            } else {
                self.pairs.slots_of(key)
            };
            // A part in a slot with its own finding is not reported again as lost.
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
        if let Some(&first) = left_out.first()
            && report.counts(Rule::NotJudged, None)
            && let Some(place) = self.outlook(drawing, first).and_then(|it| it.place(0))
        {
            let what = NotJudged::Offsets {
                contours: left_out.len(),
            };
            let detail = Detail::NotJudged(what);
            report.add(Rule::NotJudged, None, place, detail, Vec::new());
        }
    }

    /// Why there is no path of the wire on `side` of a contour. `None` for a contour that is too long to ask at every
    /// edit, is the wire's path itself, or consists of arcs each of which has its own finding.
    pub(super) fn misfit(&self, drawing: &Drawing, key: ContourKey, side: Side) -> Option<Finding> {
        let (contour, known) = (self.chains.get(key)?, self.known.get(&key)?);
        if contour.len() > lost_pocket::MOST_SEGMENTS
            || self.settings.compensation == Compensation::None
        {
            return None;
        }
        if known.index.tight().count() == contour.len() {
            return None;
        }
        let twice_area = known.index.twice_area();
        let role = match (contour.closed, side) {
            (false, Side::Left) => Role::Left,
            (false, Side::Right) => Role::Right,
            (true, side) if side.sign() * twice_area > 0.0 => Role::Opening,
            (true, _) => Role::Punch,
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
}
