//! Punches that do not go into their plates: `does-not-fit`.

use super::Analysis;
use super::report::Report;
use crate::drawing::{ContourKey, Drawing, Outline, Role};
use crate::finding::{Detail, Place, Rule, Severity, Side};
use crate::fit::{self, Fitted, Laid};
use crate::settings::{Compensation, Partners};
use crate::toolpath::{Part, Walls};
use std::sync::Arc;

/// A contour with more segments is not compared with its partner at every edit.
const MOST_SEGMENTS: usize = 100_000;

/// The knowledge of two contours, or of one that is cut twice.
#[derive(Clone, Debug)]
pub(crate) struct KnownFit {
    /// `None` where one of the two has no path, which other findings report.
    known: Option<Arc<Fitted>>,
    /// Which of the two have been edited since.
    edited: [bool; 2],
}

impl KnownFit {
    fn new(known: Option<Arc<Fitted>>) -> KnownFit {
        KnownFit {
            known,
            edited: [false; 2],
        }
    }

    /// What is known, where neither of the two has been edited.
    pub(super) fn holds(&self) -> Option<&Option<Arc<Fitted>>> {
        (self.edited == [false; 2]).then_some(&self.known)
    }

    /// The parts of contours that have not been edited.
    fn unedited(&self) -> [Option<&Arc<Part>>; 2] {
        [0, 1].map(|which| {
            let known = self.known.as_ref().filter(|_| !self.edited[which]);
            known.map(|known| &known.parts[which])
        })
    }
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

/// The roles of a punch and of its plate.
const ROLES: [Role; 2] = [Role::Punch, Role::Opening];

impl Analysis {
    /// Marks as old the results between a contour that has been edited and its partner, of which the part still holds.
    pub(super) fn outdate_fits(&mut self, key: ContourKey) {
        self.forget_walls(key);
        for ((one, other), answer) in &mut self.fits {
            for (of, is_edited) in [one, other].into_iter().zip(&mut answer.edited) {
                *is_edited |= *of == key;
            }
        }
    }

    fn forget_walls(&mut self, key: ContourKey) {
        self.walls.remove(&key);
        self.beside.retain(|both| !both.contains(&key));
    }

    /// Forgets the results for a contour that is gone.
    pub(super) fn forget_fits(&mut self, key: ContourKey) {
        self.forget_walls(key);
        self.fits
            .retain(|(one, other), _| *one != key && *other != key);
    }

    /// Reports where the parts of pairs bind.
    pub(super) fn report_fits(&mut self, drawing: &Drawing, report: &mut Report) {
        // Where findings are only counted, to judge a fix, these are left out: they take too long
        // to find.
        if !report.shows_findings() {
            return;
        }
        let Some(paired) = self.paired(drawing) else {
            return;
        };
        let of = |(key, index): (ContourKey, usize)| (key, &paired.outlines[index]);
        for &pair in &paired.pairs {
            self.report_roles(drawing, pair.map(of), report);
            self.report_pair(drawing, pair.map(of), report);
        }
        for &index in &paired.alone {
            self.report_alone(drawing, &paired.outlines[index], &paired.missing, report);
        }
        // They are no longer partners.
        self.fits.retain(|_, answer| answer.holds().is_some());
    }

    /// How partners are determined; `None` where fits are not to be checked.
    pub(super) fn asked_partners(&self) -> Option<Partners> {
        self.settings.severity(Rule::DoesNotFit)?;
        if self.settings.pair_error().is_some() {
            return None;
        }
        let (partners, _) = self.settings.fit().ok()?;
        Some(partners)
    }

    /// Which contours are pairs; `None` where fits are not to be checked.
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
                let twice = fit::all_cut_twice(outlines);
                paired.pairs = twice.map(|index| [(keys[index], index); 2]).collect();
            }
            Partners::Drawn => {
                let mut walls = std::mem::take(&mut self.walls);
                let mut walls_of = |index: usize, outline: &Outline| {
                    let own = walls.entry(keys[index]);
                    own.or_insert_with(|| fit::walls_of(drawing, &outline.contour))
                        .clone()
                };
                let known = |both: [usize; 2]| self.beside.contains(&both.map(|it| keys[it]));
                let settings = &self.settings;
                let (drawn, together) =
                    fit::partners(drawing, outlines, settings, &mut walls_of, &known);
                self.walls = walls;
                let together = together.into_iter();
                self.beside = together.map(|both| both.map(|it| keys[it])).collect();
                let with_keys = |pair: [usize; 2]| pair.map(|index| (keys[index], index));
                paired.pairs = drawn.pairs.into_iter().map(with_keys).collect();
                (paired.alone, paired.missing) = (drawn.alone, drawn.missing);
            }
        }
        Some(paired)
    }

    /// Partners of which one has been given the role of the other.
    fn report_roles(
        &self,
        drawing: &Drawing,
        both: [(ContourKey, &Outline); 2],
        report: &mut Report,
    ) {
        let mildest = Some(Severity::Warning);
        if both[0].0 == both[1].0 {
            return;
        }
        for ((key, outline), role) in both.into_iter().zip(ROLES) {
            let stated = self.known.get(&key).and_then(|known| known.stated);
            let is_other = stated.is_some_and(|stated| ROLES.contains(&stated) && stated != role);
            if is_other
                && let Some(first) = outline.contour.segment(drawing, 0)
                && report.counts(Rule::DoesNotFit, mildest)
            {
                let handle = outline.name(drawing);
                let detail = Detail::Said(match role {
                    Role::Punch => say!(lies_within_its_partner_and_is_no_opening, handle),
                    _ => say!(lies_about_its_partner_and_is_no_punch, handle),
                });
                report.add(
                    Rule::DoesNotFit,
                    mildest,
                    Place::from(&first),
                    detail,
                    Vec::new(),
                );
            }
        }
    }

    fn report_alone(
        &self,
        drawing: &Drawing,
        outline: &Outline,
        missing: &[String],
        report: &mut Report,
    ) {
        let mildest = Some(Severity::Warning);
        if let Some(first) = outline.contour.segment(drawing, 0)
            && report.counts(Rule::DoesNotFit, mildest)
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

    /// All pairs, each laid in the other, where that is known and nothing has been edited since.
    pub(crate) fn laid(&self, drawing: &Drawing) -> Option<Laid> {
        let outlines = self.outlines(drawing);
        let keys = self.in_machining_order(drawing);
        let (pairs, alone) = match self.asked_partners()? {
            Partners::CutTwice(_) => {
                let twice = fit::all_cut_twice(outlines);
                (twice.map(|at| [at; 2]).collect(), Vec::new())
            }
            Partners::Drawn => {
                let drawn = self.drawn_partners(drawing);
                (drawn.pairs, drawn.alone)
            }
        };
        let known = |pair: [usize; 2]| {
            let [one, other] = pair.map(|index| keys.get(index).copied());
            let answer = self.fits.get(&(one?, other?))?;
            let known = answer.holds()?.clone()?;
            Some((pair, known))
        };
        let pairs = pairs.into_iter().map(known).collect::<Option<_>>()?;
        Some(Laid { pairs, alone })
    }

    /// Which contours are partners where both are drawn; what is known of their walls is used.
    pub(super) fn drawn_partners(&self, drawing: &Drawing) -> fit::Drawn {
        let outlines = self.outlines(drawing);
        let keys = self.in_machining_order(drawing);
        let mut walls_of = |index: usize, outline: &Outline| {
            let known = self.walls.get(&keys[index]).cloned();
            known.unwrap_or_else(|| fit::walls_of(drawing, &outline.contour))
        };
        let known = |both: [usize; 2]| self.beside.contains(&both.map(|it| keys[it]));
        fit::partners(drawing, outlines, &self.settings, &mut walls_of, &known).0
    }

    /// What is known of two partners, neither of which crosses itself; worked out if necessary.
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
        if let Some(known) = self.fits.get(&(one, other)).and_then(KnownFit::holds) {
            return known.clone();
        }
        let is_small = punch.contour.len().max(plate.contour.len()) <= MOST_SEGMENTS;
        let old = self.fits.remove(&(one, other)).filter(|_| is_small);
        let unedited = old.map_or([None, None], |old| old.unedited().map(Option::<&_>::cloned));
        for (key, outline) in both.into_iter().filter(|_| is_small) {
            let own = self.walls.entry(key);
            own.or_insert_with(|| fit::walls_of(drawing, &outline.contour));
        }
        let fitted = || self.fitted(drawing, both, unedited);
        let known = is_small.then(fitted).flatten().map(Arc::new);
        (self.fits).insert((one, other), KnownFit::new(known.clone()));
        known
    }

    /// Two outlines, or one that is cut twice, laid in each other; what of their parts is `known`.
    pub(super) fn fitted(
        &self,
        drawing: &Drawing,
        both: [(ContourKey, &Outline); 2],
        known: [Option<Arc<Part>>; 2],
    ) -> Option<Fitted> {
        let settings = &self.settings;
        let [(one, punch), (_, plate)] = both;
        let walls = |key: ContourKey| -> Option<&Walls> { self.walls.get(&key).map(|own| &**own) };
        match settings.partners()? {
            Partners::CutTwice(_) => {
                let parts = fit::cut_twice_parts(drawing, punch, settings, walls(one)).ok()?;
                let held = fit::cut_twice(drawing, parts.each_ref(), settings);
                let parts = parts.map(Arc::new);
                Some(Fitted { parts, held })
            }
            Partners::Drawn => {
                let part_of = |which: usize, (key, outline): (ContourKey, &Outline)| {
                    let role = ROLES[which];
                    // A punch may be that of several partners, whose pairs stand in a row.
                    let of_punch = || {
                        let pairs = self
                            .fits
                            .range((key, ContourKey::MIN)..=(key, ContourKey::MAX));
                        let mut parts = pairs.filter_map(|(_, answer)| answer.unedited()[which]);
                        parts.next().filter(|_| which == 0)
                    };
                    if let Some(known) = known[which].as_ref().or_else(of_punch) {
                        return Some(known.clone());
                    }
                    let part = fit::drawn_part(drawing, outline, role, settings, walls(key));
                    part.ok().map(Arc::new)
                };
                let (punch_part, plate_part) =
                    rayon::join(|| part_of(0, both[0]), || part_of(1, both[1]));
                let parts = [punch_part?, plate_part?];
                let both = parts.each_ref().map(|part| &**part);
                let outlines = [punch, plate];
                let held = fit::drawn_pair(drawing, outlines, both, settings);
                Some(Fitted { parts, held })
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
            Ok((Partners::Drawn, _)) => self.settings.workpieces.of_contour(drawing, contour) != 0,
            Err(_) => false,
        }
    }
}
