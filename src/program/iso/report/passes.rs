//! Passes of one contour, each judged by itself and against those before it.
//!
//! A pass is what is cut under one G41 or G42: its way in switches the correction on, and a block with G40 off again. Passes of one contour
//! follow each other within a cut, or with a stop after each.

use super::super::contours::Contour;
use super::super::cut::Cut;
use super::super::moves::{Move, Place as Spot, added, apart, meet, micrometres};
use super::super::plain::word_at;
use super::super::summary::WireSide;
use super::Report;
use crate::finding::{Fault, Side};
use crate::geometry::Point;
use crate::settings::SideSetting;
use std::ops::Range;

/// Ends of two passes of one contour lie no farther apart, µm: more than corrections differ by, and less than contours stand apart.
const BESIDE: f64 = 500.0;

/// Corrections that differ by less are alike, µm.
const ALIKE: f64 = 0.5;

/// A contour that lies this far beside that of the pass before was moved, µm; less is rounding.
const MOVED: f64 = 3.0;

/// The word that switches the correction is searched for in this many lines before its cut.
pub(super) const SWITCH_REACH: usize = 1_000;

#[derive(Clone)]
struct Pass {
    side: Side,
    /// Where the program states it, µm.
    correction: Option<f64>,
    /// The places between its blocks, from the end of the lead-in to where the correction ends.
    nodes: Vec<Spot>,
    /// Above 0 where it runs counter-clockwise, µm².
    twice_area: f64,
    /// The byte at which its first line begins.
    from: usize,
    /// The block that ends the correction.
    off: Option<(Move, Range<usize>)>,
}

impl Pass {
    fn begins(&self) -> Spot {
        self.nodes.first().copied().unwrap_or_default()
    }

    fn ends(&self) -> Spot {
        self.nodes.last().copied().unwrap_or_default()
    }

    /// It goes round a contour, of which a tab at most is left.
    fn is_round(&self) -> bool {
        let left = micrometres(apart(self.begins(), self.ends()));
        self.twice_area.abs() > 2.0 + 8.0 * left.coords.norm_squared()
    }

    fn is_inside(&self) -> bool {
        (self.side == Side::Left) == (self.twice_area > 0.0)
    }

    /// The block that switches the correction off is the last side of the contour.
    fn ends_early(&self, tolerance: f64) -> Option<&Range<usize>> {
        let (off, range) = self.off.as_ref()?;
        let is_side = meet(off.to, self.begins(), tolerance) && !meet(off.from, off.to, tolerance);
        is_side.then_some(range)
    }

    fn is_of_the_contour_of(&self, other: &Pass) -> bool {
        let [own, its] = [self, other].map(|pass| pass.twice_area.abs());
        let ends = |pass: &Pass| [pass.begins(), pass.ends()];
        let is_met = |own: Spot| ends(other).iter().any(|its| meet(own, *its, BESIDE));
        (own - its).abs() <= 0.1 * own.max(its) && ends(self).into_iter().any(is_met)
    }

    /// How far all of its blocks lie beside those of another, in either direction, µm.
    fn moved_from(&self, other: &Pass) -> Option<f64> {
        let by = |its: &mut dyn Iterator<Item = &Spot>| {
            let apart = self
                .nodes
                .iter()
                .zip(its)
                .map(|(own, its)| micrometres(apart(*its, *own)));
            let apart: Vec<Point> = apart.collect();
            let first = *apart.first()?;
            let is_one = apart.iter().all(|way| (way - first).norm() <= MOVED / 2.0);
            is_one.then_some(first.coords.norm())
        };
        let is_alike = self.nodes.len() == other.nodes.len() && self.nodes.len() > 2;
        let (mut there, mut back) = (other.nodes.iter(), other.nodes.iter().rev());
        let by = is_alike.then(|| by(&mut there).or_else(|| by(&mut back)));
        by.flatten().filter(|by| *by > MOVED)
    }
}

impl Report<'_> {
    /// What is wrong with the passes of a cut that switches the correction on several times; false where it has none.
    pub(super) fn passes(&mut self, cut: &Contour<'_>) -> bool {
        let passes = match cut.sum.switched_on {
            0 | 1 => return false,
            _ => self.passes_of(cut),
        };
        let tolerance = cut.tolerance();
        for range in passes.iter().filter_map(|pass| pass.ends_early(tolerance)) {
            self.add(range.clone(), Fault::SwitchedOffEarly);
        }
        let round: Vec<Pass> = passes.into_iter().filter(Pass::is_round).collect();
        for passes in round.chunk_by(|one, next| next.is_of_the_contour_of(one)) {
            self.sides_of(passes);
            self.against_each_other(passes);
        }
        !round.is_empty()
    }

    /// The same of passes with a stop after each: their sides, alone, are judged with their cuts.
    pub(super) fn passes_between_stops(&mut self) {
        let document = self.document;
        let mut passes = Vec::new();
        let sided: Vec<(usize, [Spot; 4])> = self.cuts_with_sides();
        let are_near = |nth: Option<usize>, other: Option<usize>| {
            let places = |nth: Option<usize>| nth.and_then(|nth| sided.get(nth));
            let (Some((_, own)), Some((_, its))) = (places(nth), places(other)) else {
                return false;
            };
            let is_near = |own: &Spot| its.iter().any(|its| meet(*own, *its, BESIDE));
            own.iter().any(is_near)
        };
        for (nth, (cut, _)) in sided.iter().enumerate() {
            // Most cuts lie nowhere near the next one.
            let is_alone =
                !are_near(Some(nth), nth.checked_sub(1)) && !are_near(Some(nth), Some(nth + 1));
            if is_alone && document.contours.of_cut(*cut).is_none() {
                self.contour_of(&std::mem::take(&mut passes));
                continue;
            }
            let Some(cut) = document.contour(*cut) else {
                continue;
            };
            let WireSide::One(_) = cut.sum.side else {
                continue;
            };
            let own = self.pass_of(&cut).filter(Pass::is_round);
            let goes_on = own
                .as_ref()
                .zip(passes.last())
                .is_some_and(|(own, last)| own.is_of_the_contour_of(last));
            if !goes_on {
                self.contour_of(&std::mem::take(&mut passes));
            }
            passes.extend(own);
        }
        self.contour_of(&passes);
    }

    /// The cuts beside which the wire runs on a side, each with the places where a pass may begin and end.
    fn cuts_with_sides(&self) -> Vec<(usize, [Spot; 4])> {
        let document = self.document;
        let places = |(cut, own): (usize, &Cut)| {
            let sum = own.sum()?;
            let is_whole = document.contours.of_cut(cut).is_none();
            if is_whole && sum.side == WireSide::None {
                return None;
            }
            let [[first, _], [before, last]] = [sum.first, sum.last];
            let at = document.cuts.state_before(cut).at;
            let places = [first.to, before.from, last.from, last.to];
            Some((cut, places.map(|place| added(place, at))))
        };
        let cuts = document.cuts.iter().enumerate();
        cuts.filter_map(places).collect()
    }

    fn contour_of(&mut self, passes: &[Pass]) {
        if passes.len() > 1 {
            if self.control.limits.settings.side.role().is_none() {
                self.sides_of(passes);
            }
            self.against_each_other(passes);
        }
    }

    /// Passes of one contour run on one side of it: that of the settings, else that of most of them, and of the first.
    fn sides_of(&mut self, passes: &[Pass]) {
        let stated = match self.control.limits.settings.side {
            SideSetting::Opening => Some(true),
            SideSetting::Punch => Some(false),
            _ => None,
        };
        let inside = passes.iter().filter(|pass| pass.is_inside()).count();
        let is_first = passes.first().is_some_and(Pass::is_inside);
        let usual = stated.unwrap_or(match (2 * inside).cmp(&passes.len()) {
            std::cmp::Ordering::Less => false,
            std::cmp::Ordering::Equal => is_first,
            std::cmp::Ordering::Greater => true,
        });
        for pass in passes.iter().filter(|pass| pass.is_inside() != usual) {
            let (side, inside) = (pass.side, pass.is_inside());
            let fault = match stated {
                Some(_) => Fault::RoleSide {
                    side,
                    punch: !inside,
                },
                None => Fault::PassSide { side, inside },
            };
            let range = self.switch_range(pass.from);
            self.add(range, fault);
        }
    }

    /// A later pass takes what the one before it has left, at the same place.
    fn against_each_other(&mut self, passes: &[Pass]) {
        for (before, pass) in passes.iter().zip(passes.iter().skip(1)) {
            let corrections = before.correction.zip(pass.correction);
            if let Some((before, correction)) = corrections.filter(|(was, is)| is - was > ALIKE) {
                let range = self.switch_range(pass.from);
                self.add(range, Fault::PassRises { correction, before });
            }
            if let Some(by) = pass.moved_from(before) {
                let range = self.switch_range(pass.from);
                self.add(range, Fault::PassAside { by });
            }
        }
    }

    fn passes_of(&self, cut: &Contour<'_>) -> Vec<Pass> {
        let mut passes: Vec<Pass> = Vec::new();
        let mut is_on = false;
        for cut in cut.cuts.clone() {
            for (own, line) in self.document.moves_of(cut) {
                match (own.switches, own.side, passes.last_mut()) {
                    (Some(true), Some(side), _) => {
                        is_on = true;
                        passes.push(Pass {
                            side,
                            correction: self.control.stated_correction(own.offset),
                            nodes: vec![own.to],
                            twice_area: 0.0,
                            from: line.start,
                            off: None,
                        });
                    }
                    (Some(false), _, Some(pass)) if is_on => {
                        is_on = false;
                        pass.off = Some((own, line));
                    }
                    (_, Some(_), Some(pass)) if is_on => {
                        let seen = own.seen_from(pass.begins()).segment(&self.control.reading);
                        pass.twice_area += seen.twice_area(Point::origin());
                        pass.nodes.push(own.to);
                    }
                    _ => is_on = false,
                }
            }
        }
        passes
    }

    /// A cut that is one pass, as far as its ends show it.
    fn pass_of(&self, cut: &Contour<'_>) -> Option<Pass> {
        let [[first, second], last] = [cut.sum.first, cut.sum.last];
        let is_one = cut.sum.switched_on == 1 && first.switches == Some(true) && cut.sum.whole;
        let is_off = |step: &Move| step.switches == Some(false);
        let ends = match last {
            [before, off] if is_off(&off) => vec![before.from, off.from],
            [off, _] if is_off(&off) => vec![off.from],
            [_, last] => vec![last.from, last.to],
        };
        Some(Pass {
            side: first.side.filter(|_| is_one)?,
            correction: self.control.stated_correction(first.offset),
            nodes: [vec![first.to, second.to], ends].concat(),
            twice_area: cut.verdict.twice_area,
            from: cut.sum.range.0 as usize,
            off: None,
        })
    }

    /// The correction of a cut that switches it on once ends with the last side of its contour, not behind it.
    pub(super) fn off_too_early(&mut self, cut: &Contour<'_>) {
        let (first, tolerance) = (&cut.sum.first[0], cut.tolerance());
        let is_last = |step: &&Move| {
            let is_off = step.switches == Some(false) && meet(step.to, first.to, tolerance);
            is_off && !meet(step.from, step.to, tolerance)
        };
        let is_pass = cut.sum.switched_on == 1 && first.switches == Some(true);
        if is_pass && cut.sum.moves > 3 && cut.sum.last.iter().any(|step| is_last(&step)) {
            let [_, last_line] = cut.sum.ends();
            let range = self.code_before(last_line, &[40]);
            self.add(range, Fault::SwitchedOffEarly);
        }
    }

    /// The word that switched the correction on before the cut that begins at `start`; the cut's first line where it is
    /// not found.
    pub(super) fn switch_range(&self, start: usize) -> Range<usize> {
        let line = self.text.line_of(start);
        self.code_before(start..self.text.line_range(line).end.max(start), &[41, 42])
    }

    /// The last G with one of these numbers on the line where some bytes begin, or before it; these bytes where there is none.
    pub(super) fn code_before(&self, bytes: Range<usize>, codes: &[i64]) -> Range<usize> {
        let line = self.text.line_of(bytes.start);
        let lines = (line.saturating_sub(SWITCH_REACH)..=line).rev();
        let is_it = |number: Option<i64>| number.is_some_and(|number| codes.contains(&number));
        let mut found = lines.filter_map(|line| {
            word_at(self.text, line, |letter, number| {
                letter == b'G' && is_it(number.whole())
            })
        });
        found.next().unwrap_or(bytes)
    }
}
