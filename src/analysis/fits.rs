//! Punches that do not go into their plates: `does-not-fit`.

use super::Analysis;
use super::report::Report;
use crate::drawing::{ContourKey, Drawing, Outline, Role};
use crate::finding::{Cause, Detail, Misfit, Place, Rule, Severity, Side};
use crate::fit::{self, Held, SegmentOf, Spot};
use crate::geometry::{Bounds, Grid};
use crate::settings::{Compensation, Partners};
use crate::toolpath::Part;
use std::cell::LazyCell;
use std::sync::Arc;

/// A contour of more segments is not compared with its partner at every edit.
const MOST_SEGMENTS: usize = 100_000;

/// The knowledge of two contours, or of one that is cut twice.
#[derive(Clone, Debug)]
pub(crate) struct Answer {
    /// `None` where one of the two has no path, which other findings report.
    pub(super) known: Option<Arc<Fitted>>,
    /// One of the two has been edited since: what still holds need not be checked again.
    pub(super) is_old: bool,
}

/// A punch and its plate, one laid in the other.
#[derive(Debug)]
pub(crate) struct Fitted {
    parts: [Arc<Part>; 2],
    pub(super) held: Held,
}

impl Fitted {
    /// Where less clearance is left than there should be.
    pub(super) fn spots(&self) -> impl Iterator<Item = Spot> {
        self.held.spots(self.parts.each_ref().map(|part| &**part))
    }
}

/// What is left of a contour.
#[derive(Clone, Debug)]
pub(crate) struct Left {
    part: Arc<Part>,
    /// The contour has been edited since: what of it still holds need not be worked out again.
    is_old: bool,
}

/// The contours of a drawing that are pairs, by their indices among all outlines.
pub(super) struct Paired {
    /// Punch and plate; one that is cut twice stands for both.
    pub(super) pairs: Vec<[(ContourKey, usize); 2]>,
    /// Contours of workpieces that have no partner.
    alone: Vec<usize>,
    /// The names of workpieces of which nothing is drawn.
    missing: Vec<String>,
    pub(super) outlines: Arc<Vec<Outline>>,
}

/// What a punch is, and its plate.
const ROLES: [Role; 2] = [Role::Punch, Role::Opening];

impl Analysis {
    /// The results between an edited contour and its partner hold no longer, except where the edit has not touched
    /// them.
    pub(super) fn outdate_fits(&mut self, key: ContourKey) {
        self.walls.remove(&key);
        for ((of, _), left) in &mut self.parts {
            left.is_old |= *of == key;
        }
        for ((one, other), answer) in &mut self.fits {
            answer.is_old |= *one == key || *other == key;
        }
    }

    /// Forgets the results for a contour that is gone.
    pub(super) fn forget_fits(&mut self, key: ContourKey) {
        self.walls.remove(&key);
        self.parts.retain(|(of, _), _| *of != key);
        self.fits
            .retain(|(one, other), _| *one != key && *other != key);
    }

    /// Where parts of pairs bind.
    pub(super) fn report_fits(&mut self, drawing: &Drawing, report: &mut Report) {
        // Fixes are held against each other by what is cheap to know.
        if !report.shows_findings() {
            return;
        }
        let Some(paired) = self.paired(drawing) else {
            return;
        };
        let of = |(key, index): (ContourKey, usize)| (key, &paired.outlines[index]);
        for &pair in &paired.pairs {
            self.report_pair(drawing, pair.map(of), report);
        }
        for &index in &paired.alone {
            self.report_alone(drawing, &paired.outlines[index], &paired.missing, report);
        }
        // No partners any more.
        self.fits.retain(|_, answer| !answer.is_old);
    }

    /// What are partners; `None` where nobody asks whether they fit.
    pub(super) fn asked_partners(&self) -> Option<Partners> {
        self.settings.severity(Rule::DoesNotFit)?;
        let (partners, _) = self.settings.fit().ok()?;
        Some(partners)
    }

    /// Which contours are pairs; `None` where nobody asks whether parts fit.
    pub(super) fn paired(&mut self, drawing: &Drawing) -> Option<Paired> {
        let partners = self.asked_partners()?;
        let outlines = self.outlines(drawing).clone();
        let keys = self.in_machining_order(drawing).to_vec();
        if keys.len() != outlines.len() {
            return None;
        }
        let mut paired = Paired {
            pairs: Vec::new(),
            alone: Vec::new(),
            missing: Vec::new(),
            outlines,
        };
        let outlines = &paired.outlines;
        match partners {
            Partners::CutTwice(_) => {
                let twice = (0..keys.len()).filter(|&index| fit::is_cut_twice(&outlines[index]));
                paired.pairs = twice.map(|index| [(keys[index], index); 2]).collect();
            }
            Partners::Drawn => {
                let (mut walls, beside) = (std::mem::take(&mut self.walls), &mut self.beside);
                let mut walls_of = |index: usize, outline: &Outline| {
                    let walls = walls.entry(keys[index]);
                    let walls = walls.or_insert_with(|| fit::walls_of(drawing, &outline.contour));
                    walls.clone()
                };
                let settings = &self.settings;
                let drawn = fit::partners(drawing, outlines, settings, &mut walls_of, beside);
                self.walls = walls;
                let with_keys = |pair: [usize; 2]| pair.map(|index| (keys[index], index));
                paired.pairs = drawn.pairs.into_iter().map(with_keys).collect();
                (paired.alone, paired.missing) = (drawn.alone, drawn.missing);
            }
        }
        Some(paired)
    }

    fn report_alone(
        &self,
        drawing: &Drawing,
        outline: &Outline,
        missing: &[String],
        report: &mut Report,
    ) {
        let mildest = Some(Severity::Warning);
        if report.counts(Rule::DoesNotFit, mildest)
            && let Some(first) = outline.contour.segment(drawing, 0)
        {
            let of = fit::name_of(drawing, &outline.contour, &self.settings);
            let (place, detail) = (
                Place::from(&first),
                Detail::NoPartner {
                    of,
                    missing: missing.to_vec(),
                },
            );
            report.add(Rule::DoesNotFit, mildest, place, detail, Vec::new());
        }
    }

    /// The knowledge of two partners, neither of which is crossed; worked out if necessary.
    pub(super) fn fit_of(
        &mut self,
        drawing: &Drawing,
        both: [(ContourKey, &Outline); 2],
    ) -> Option<Arc<Fitted>> {
        let crossed = &self.pairs.seen.crossings;
        if both.iter().any(|(key, _)| crossed.contains_key(key)) {
            return None;
        }
        let [(one, punch), (other, plate)] = both;
        if let Some(answer) = self.fits.get(&(one, other))
            && !answer.is_old
        {
            return answer.known.clone();
        }
        let is_small = punch.contour.len().max(plate.contour.len()) <= MOST_SEGMENTS;
        for (key, outline) in both.into_iter().filter(|_| is_small) {
            let walls = self.walls.entry(key);
            walls.or_insert_with(|| fit::walls_of(drawing, &outline.contour));
        }
        let known = is_small.then(|| self.fitted(drawing, both)).flatten();
        let known = known.map(Arc::new);
        for ((key, role), known) in [one, other].into_iter().zip(ROLES).zip([&known; 2]) {
            if let Some(known) = known {
                let [punch, plate] = &known.parts;
                let part = if role == ROLES[0] { punch } else { plate }.clone();
                let is_old = false;
                self.parts.insert((key, role), Left { part, is_old });
            }
        }
        let answer = Answer {
            known: known.clone(),
            is_old: false,
        };
        self.fits.insert((one, other), answer);
        known
    }

    /// Two outlines, or one that is cut twice, laid in each other. What still holds from before an edit is not checked
    /// again.
    pub(super) fn fitted(
        &self,
        drawing: &Drawing,
        both: [(ContourKey, &Outline); 2],
    ) -> Option<Fitted> {
        let settings = &self.settings;
        let [(one, punch), (other, plate)] = both;
        let left = |key: ContourKey, role: Role| self.parts.get(&(key, role));
        let walls = |key: ContourKey| self.walls.get(&key).map(|walls| &**walls);
        let old = self
            .fits
            .get(&(one, other))
            .and_then(|answer| answer.known.as_deref());
        let before = old.map(|old| (old.parts.each_ref().map(|part| &**part), &old.held));
        match settings.partners()? {
            Partners::CutTwice(_) => {
                let before_each = ROLES.map(|role| left(one, role).map(|left| &*left.part));
                let walls = walls(one);
                let parts = fit::cut_twice_parts(drawing, punch, settings, walls, before_each);
                let parts = parts.ok()?;
                let held = fit::cut_twice(drawing, parts.each_ref(), settings, false, before);
                let parts = parts.map(Arc::new);
                Some(Fitted { parts, held })
            }
            Partners::Drawn => {
                let part_of = |key: ContourKey, outline: &Outline, role: Role| {
                    let before = left(key, role);
                    if let Some(left) = before.filter(|left| !left.is_old) {
                        return Some(left.part.clone());
                    }
                    let before = before.map(|left| &*left.part);
                    let part =
                        fit::drawn_part(drawing, outline, role, settings, walls(key), before);
                    part.ok().map(Arc::new)
                };
                let (punch_part, plate_part) = rayon::join(
                    || part_of(one, punch, ROLES[0]),
                    || part_of(other, plate, ROLES[1]),
                );
                let parts = [punch_part?, plate_part?];
                let both = parts.each_ref().map(|part| &**part);
                let outlines = [punch, plate];
                let held = fit::drawn_pair(drawing, outlines, both, settings, false, before);
                Some(Fitted { parts, held })
            }
        }
    }

    fn report_pair(
        &mut self,
        drawing: &Drawing,
        both: [(ContourKey, &Outline); 2],
        report: &mut Report,
    ) {
        let is_cut_twice = both[0].0 == both[1].0;
        let Some(fitted) = self.fit_of(drawing, both) else {
            return;
        };
        let held = &fitted.held;
        let (rounding, wanted) = (
            self.limits.tolerances.report,
            self.settings.pair.clearance.unwrap_or(0.0) / self.limits.unit_mm,
        );
        let corners = LazyCell::new(|| {
            let (corners, mut places) = (held.corners().collect::<Vec<_>>(), Grid::default());
            for (index, (at, _)) in corners.iter().enumerate() {
                places.insert(index, Bounds::of_disc(*at, self.wide(wanted, 0.0)));
            }
            (corners, places)
        });
        // Walls are deepest where they end, in a corner.
        let corner_of = |spot: &Spot| {
            if spot.turn > 0.0 {
                return Some(spot.of.clone());
            }
            let wide = self.wide(wanted, spot.clearance);
            let mut first: Option<usize> = None;
            let (corners, places) = &*corners;
            places.near(
                &Bounds::of_disc(spot.at, spot.clearance.abs()),
                |index, _| {
                    let is_near = (corners[index].0 - spot.at).norm() <= wide;
                    if is_near && first.is_none_or(|first| index < first) {
                        first = Some(index);
                    }
                },
            );
            Some(corners.get(first?)?.1.clone())
        };
        let arc_radius = |(entity, segment): SegmentOf| {
            let geometry = drawing.segment(entity, segment)?;
            Some(geometry.as_arc()?.radius)
        };
        let cause = |spot: &Spot, at: SegmentOf, other: SegmentOf| {
            let radii = arc_radius(at).zip(arc_radius(other));
            let radii = radii.filter(|(own, other)| {
                !is_cut_twice && ((own - other).abs() - wanted).abs() > rounding
            });
            match (corner_of(spot), radii) {
                (Some(of), _) => Cause::Corner(of),
                (None, Some((own, other))) => Cause::Radii([own, other]),
                (None, None) => Cause::Wall,
            }
        };
        let is_binding = |clearance: f64| clearance < -rounding;
        let count = held.clearances().filter(|it| is_binding(it.1)).count();
        let of_each = if is_cut_twice { 1 } else { 2 };
        report.count(Rule::DoesNotFit, None, of_each * count);
        for spot in fitted.spots().filter(|spot| is_binding(spot.clearance)) {
            if report.is_full(Rule::DoesNotFit, None) {
                break;
            }
            let mut add = |at: SegmentOf, other: SegmentOf, of: &Arc<str>, partner: &Arc<str>| {
                if !report.is_full(Rule::DoesNotFit, None) {
                    let misfit = Misfit {
                        at: spot.at,
                        clearance: spot.clearance,
                        wanted,
                        of: of.clone(),
                        partner: partner.clone(),
                        cause: cause(&spot, at, other),
                    };
                    let detail = Detail::DoesNotFit(Box::new(misfit));
                    report.add(
                        Rule::DoesNotFit,
                        None,
                        place(at),
                        detail,
                        vec![place(other)],
                    );
                }
            };
            add(spot.segment, spot.other, &spot.of, &spot.partner);
            if !is_cut_twice {
                add(spot.other, spot.segment, &spot.partner, &spot.of);
            }
        }
    }

    /// True where the fit decides whether the wire leaves too much in the arcs of a contour.
    pub(super) fn says_the_fit(
        &self,
        drawing: &Drawing,
        key: ContourKey,
        wire_side: Option<Side>,
    ) -> bool {
        if self.settings.compensation != Compensation::Path
            || self.settings.severity(Rule::DoesNotFit).is_none()
        {
            return false;
        }
        let Some(contour) = self.chains.get(key).filter(|contour| contour.closed) else {
            return false;
        };
        match self.settings.fit() {
            Ok((Partners::CutTwice(_), _)) => wire_side.is_none(),
            Ok((Partners::Drawn, _)) => fit::workpiece_of(drawing, contour, &self.settings) != 0,
            Err(_) => false,
        }
    }

    /// The largest distance of what belongs to a corner from its spot, where this much clearance is `missing`.
    pub(super) fn wide(&self, clearance: f64, missing: f64) -> f64 {
        2.0 * self.limits.correction.max(clearance) + missing.abs()
    }
}

fn place((entity, segment): SegmentOf) -> Place {
    Place::Segment { entity, segment }
}
