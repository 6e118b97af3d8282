//! What the paths along contours lose, and where none passes its proof: `lost-pocket`, `offset-collapse`, `unproved-path`. It is what `generate`
//! would refuse.

use super::Analysis;
use super::report::Report;
use crate::drawing::{ContourKey, Drawing, Outline, Role};
use crate::finding::{Detail, Finding, NotJudged, Place, Rule, Side};
use crate::geometry::Point;
use crate::settings::Compensation;
use crate::toolpath::{self, Walls};

/// What the path along a contour loses.
#[derive(Clone, Debug)]
pub(crate) struct Loss {
    /// The question: the side, and whether two of its walls form a narrow slot.
    asked: (Side, bool),
    /// It has a neck, or so little room that nothing of the path may be left.
    is_likely: bool,
    /// What finding out takes.
    looks: u64,
    /// The answer; `None` until it has been looked for.
    findings: Option<Vec<Finding>>,
}

impl Analysis {
    /// What the paths along contours with a known wire side lose.
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
        // Where the rule that would find these is off, a neck is assumed.
        let necks_are_told = is_on(Rule::NarrowSlot);
        let lengths = ordered.iter().filter_map(|&key| self.chains.get(key));
        let segments: usize = lengths.map(|contour| contour.len()).sum();
        let (mut left, mut left_out) = (self.settings.budget.granted(segments), Vec::new());
        for (&key, &side) in ordered.iter().zip(sides) {
            let Some(side) = side.filter(|_| !self.pairs.seen.crossings.contains_key(&key)) else {
                continue;
            };
            let has_neck = !necks_are_told || self.pairs.seen.slots.contains_key(&key);
            let asked = (side, has_neck);
            if self.lost.get(&key).is_none_or(|loss| loss.asked != asked) {
                self.lost.remove(&key);
                let loss = self.loss(drawing, key, asked);
                self.lost.extend(loss.map(|loss| (key, loss)));
            }
            let Some(loss) = self.lost.get(&key) else {
                continue;
            };
            // The looks are those of a fresh analysis, whatever is known already.
            let Some(rest) = left.checked_sub(loss.looks) else {
                left_out.push(key);
                continue;
            };
            left = rest;
            // Where findings are only counted, to judge a fix, only likely losses are looked for: all take too long.
            if !loss.is_likely && !report.shows_findings() {
                continue;
            }
            if loss.findings.is_none() {
                let found = self.misfits(drawing, key, side);
                if let Some(loss) = self.lost.get_mut(&key) {
                    loss.findings = Some(found);
                }
            }
            self.report_lost(key, necks_are_told, report);
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

    /// Reports what a path loses. A part in a slot with its own finding is not reported again as lost.
    fn report_lost(&self, key: ContourKey, necks_are_told: bool, report: &mut Report) {
        let found = self.lost.get(&key).and_then(|loss| loss.findings.as_ref());
        let Some(found) = found.filter(|found| !found.is_empty()) else {
            return;
        };
        let slots = match necks_are_told {
            true => self.pairs.slots_of(key),
            false => Vec::new(),
        };
        let is_told = |near: Point, place: &Place| {
            let index = match *place {
                Place::Segment { entity, segment } => self.chains.index_of(entity, segment),
                _ => None,
            };
            slots.iter().any(|(walls, disc)| match disc {
                Some((center, radius)) => (near - center).norm() <= radius + self.limits.correction,
                None => index.is_some_and(|(_, index)| walls.contains(&index)),
            })
        };
        for Finding {
            rule,
            severity,
            place,
            detail,
            ..
        } in found
        {
            let is_told = matches!(*detail, Detail::LostPocket { near } if is_told(near, place));
            if !is_told && report.counts(*rule, Some(*severity)) {
                let (place, detail) = (place.clone(), detail.clone());
                report.add(*rule, Some(*severity), place, detail, Vec::new());
            }
        }
    }

    /// What is to be asked about the path along a contour. `None` for one that is too long, where `narrow-slot` still works, is the
    /// wire's path itself, or consists of arcs each of which has its own finding.
    fn loss(&self, drawing: &Drawing, key: ContourKey, asked: (Side, bool)) -> Option<Loss> {
        let (contour, known) = (self.chains.get(key)?, self.known.get(&key)?);
        if contour.len() > toolpath::MOST_SEGMENTS_OF_MISFITS
            || self.settings.compensation == Compensation::None
            || known.index.tight().count() == contour.len()
        {
            return None;
        }
        let (side, has_neck) = asked;
        let correction = self.limits.correction;
        let segments = || contour.segments(drawing).map(|it| it.geometry);
        let may_collapse = || {
            let twice_area = known.index.twice_area();
            let length: f64 = segments().map(|segment| segment.length()).sum();
            // An outline that holds no disc of the correction has less area than its length times that.
            twice_area * side.sign() > 0.0 && twice_area.abs() / 2.0 <= length * correction
        };
        let is_likely = contour.closed && (has_neck || may_collapse());
        let looks = || toolpath::looks_beside(&Walls::new(segments().collect()), correction);
        Some(Loss {
            asked,
            is_likely,
            looks: if is_likely { looks() } else { 0 },
            findings: None,
        })
    }

    /// What prevents a path of the wire on `side` of a contour.
    fn misfits(&self, drawing: &Drawing, key: ContourKey, side: Side) -> Vec<Finding> {
        let Some((contour, known)) = self.chains.get(key).zip(self.known.get(&key)) else {
            return Vec::new();
        };
        let twice_area = known.index.twice_area();
        let role = match (contour.closed, side) {
            (false, Side::Left) => Role::Left,
            (false, Side::Right) => Role::Right,
            (true, side) if side.sign() * twice_area > 0.0 => Role::Opening,
            (true, _) => Role::Punch,
        };
        let outline = Outline {
            contour: contour.clone(),
            role,
            twice_area,
        };
        toolpath::misfits(drawing, &outline, &self.settings)
    }
}
