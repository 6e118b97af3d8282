//! Punches that do not go into their plates: `does-not-fit`.

use super::Analysis;
use super::edited::Edited;
use super::own_walls::Own;
use super::report::Report;
use crate::drawing::{ContourKey, Drawing, Outline, Role};
use crate::finding::{Detail, Place, Rule, Severity, Side};
use crate::fit::{self, Fitted, Laid};
use crate::settings::{Compensation, Partners};
use crate::toolpath::Part;
use std::ops::Range;
use std::sync::Arc;

/// A contour with more segments is not compared with its partner at every edit.
const MOST_SEGMENTS: usize = 100_000;

/// The knowledge of two contours, or of one that is cut twice.
#[derive(Clone, Debug)]
pub(crate) struct Answer {
    /// `None` where one of the two has no path, which other findings report.
    pub(super) known: Option<Arc<Fitted>>,
    /// One of the two has been edited since: it may follow the edit.
    pub(super) is_old: bool,
}

/// What the wire leaves of a contour.
#[derive(Clone, Debug)]
pub(crate) struct Left {
    part: Arc<Part>,
    /// Where the contour has been edited since.
    edited: Edited,
}

impl Left {
    fn new(part: Arc<Part>) -> Left {
        let edited = Edited::not();
        Left { part, edited }
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
    /// Marks as old the results between a contour that has been edited, there or anywhere, and its
    /// partner; parts that the edit has not touched still hold.
    pub(super) fn outdate_fits(&mut self, key: ContourKey, there: Option<&[Range<usize>]>) {
        if let Some(own) = self.walls.get_mut(&key) {
            own.edited.merge(there);
        }
        for (_, left) in self.parts.iter_mut().filter(|((of, _), _)| *of == key) {
            left.edited.merge(there);
        }
        for ((one, other), answer) in &mut self.fits {
            answer.is_old |= *one == key || *other == key;
        }
    }

    /// Forgets the results for a contour that is gone.
    pub(super) fn forget_fits(&mut self, key: ContourKey) {
        self.walls.remove(&key);
        self.beside.retain(|both| !both.contains(&key));
        self.parts.retain(|(of, _), _| *of != key);
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
        self.fits.retain(|_, answer| !answer.is_old);
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
                self.walls_again(drawing, &keys, outlines);
                let mut walls = std::mem::take(&mut self.walls);
                let mut walls_of = |index: usize, outline: &Outline| {
                    let own = walls.entry(keys[index]);
                    let own = own.or_insert_with(|| Own::of(drawing, outline));
                    own.walls.clone()
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
            let known = answer.known.clone().filter(|_| !answer.is_old)?;
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
            let known = self.walls.get(&keys[index]).filter(|own| own.is_new());
            let known = known.map(|own| own.walls.clone());
            known.unwrap_or_else(|| fit::walls_of(drawing, &outline.contour))
        };
        let is_new = |key: &ContourKey| self.walls.get(key).is_some_and(Own::is_new);
        let known = |both: [usize; 2]| {
            let both = both.map(|index| keys[index]);
            both.iter().all(is_new) && self.beside.contains(&both)
        };
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
        if let Some(answer) = self.fits.get(&(one, other))
            && !answer.is_old
        {
            return answer.known.clone();
        }
        let is_small = punch.contour.len().max(plate.contour.len()) <= MOST_SEGMENTS;
        if is_small && let Some(known) = self.followed(drawing, both) {
            return Some(known);
        }
        for (key, outline) in both.into_iter().filter(|_| is_small) {
            let own = self.walls.entry(key);
            let own = own.or_insert_with(|| Own::of(drawing, outline));
            if !own.is_new() {
                *own = Own::of(drawing, outline);
            }
        }
        let known = is_small.then(|| self.fitted(drawing, both)).flatten();
        let known = known.map(Arc::new);
        if let Some(known) = &known {
            self.keep_parts([one, other], known.parts.clone());
        }
        let answer = Answer {
            known: known.clone(),
            is_old: false,
        };
        self.fits.insert((one, other), answer);
        known
    }

    /// The parts of contours as they are now.
    fn keep_parts(&mut self, keys: [ContourKey; 2], parts: [Arc<Part>; 2]) {
        for ((key, role), part) in keys.into_iter().zip(ROLES).zip(parts) {
            self.parts.insert((key, role), Left::new(part));
        }
    }

    /// What is known of two partners after an edit, if both parts could follow it from what was known before.
    fn followed(
        &mut self,
        drawing: &Drawing,
        both: [(ContourKey, &Outline); 2],
    ) -> Option<Arc<Fitted>> {
        let keys = both.map(|(key, _)| key);
        let [one, other] = keys;
        let [of_punch, of_plate] = [(one, ROLES[0]), (other, ROLES[1])];
        let known = self.fits.get(&(one, other))?.known.as_ref()?;
        let is_sound = |of: &(ContourKey, Role), part: &Arc<Part>| {
            let left = self.parts.get(of);
            left.is_some_and(|left| left.edited.within().is_some() && Arc::ptr_eq(&left.part, part))
        };
        let [punch, plate] = &known.parts;
        if !is_sound(&of_punch, punch) || !is_sound(&of_plate, plate) {
            return None;
        }
        // They are changed in place, if nothing else shares them.
        let known = self.fits.remove(&(one, other))?.known?;
        let edited = [of_punch, of_plate].map(|of| self.parts.remove(&of).map(|left| left.edited));
        let mut fitted = Arc::unwrap_or_clone(known);
        let Fitted { parts, held } = &mut fitted;
        let edited = edited.map(|edited| edited.unwrap_or(Edited::Anywhere));
        let outlines = [0, 1].map(|which| {
            let within = edited[which].within().unwrap_or_default();
            (both[which].1, within)
        });
        let settings = &self.settings;
        let have = fit::follow(drawing, outlines, settings, one == other, (parts, held));
        for ((of, part), has) in [of_punch, of_plate].iter().zip(&fitted.parts).zip(have) {
            if has {
                self.parts.insert(*of, Left::new(part.clone()));
            }
        }
        if have != [true; 2] {
            return None;
        }
        let known = Some(Arc::new(fitted));
        let answer = Answer {
            known: known.clone(),
            is_old: false,
        };
        self.fits.insert((one, other), answer);
        known
    }

    /// Two outlines, or one that is cut twice, laid in each other.
    pub(super) fn fitted(
        &self,
        drawing: &Drawing,
        both: [(ContourKey, &Outline); 2],
    ) -> Option<Fitted> {
        let settings = &self.settings;
        let [(one, punch), (other, plate)] = both;
        let walls = |key: ContourKey| {
            let own = self.walls.get(&key).filter(|own| own.is_new());
            own.map(|own| &*own.walls)
        };
        match settings.partners()? {
            Partners::CutTwice(_) => {
                let parts = fit::cut_twice_parts(drawing, punch, settings, walls(one)).ok()?;
                let held = fit::cut_twice(drawing, parts.each_ref(), settings);
                let parts = parts.map(Arc::new);
                Some(Fitted { parts, held })
            }
            Partners::Drawn => {
                let part_of = |key: ContourKey, outline: &Outline, role: Role| {
                    let known = self.parts.get(&(key, role));
                    if let Some(left) = known.filter(|left| !left.edited.is_any()) {
                        return Some(left.part.clone());
                    }
                    let part = fit::drawn_part(drawing, outline, role, settings, walls(key));
                    part.ok().map(Arc::new)
                };
                let (punch_part, plate_part) = rayon::join(
                    || part_of(one, punch, ROLES[0]),
                    || part_of(other, plate, ROLES[1]),
                );
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
