//! Settings with every default filled in.

use super::by_name::ByName;
use super::{
    Budget, Compensation, ContourSettings, Corner, Direction, JobSettings, Jumps, Layout, Lead,
    LengthSetting, MillingSettings, NumberUnit, Order, Origins, PairSettings, Passes, PointSetting,
    Profile, ProgramFormat, Sequence, Settings, SideSetting, SkimCorner, UnitSetting, Workpieces,
};
use crate::drawing::{Color, Outline, Role, Unit};
use crate::finding::{Finding, Rule, Severity};
use crate::geometry::{Point, Tolerances};
use std::collections::{BTreeMap, BTreeSet};

/// All levels merged, with the defaults below them. Lengths in mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Effective {
    /// The largest correction of all passes, against which radii are checked.
    pub correction: f64,
    /// 1-based number of the pass with the largest correction, where several are set.
    pub pass: Option<usize>,
    /// Correction of each pass; one where none are set.
    pub corrections: Vec<f64>,
    /// Diameter of the wire and spark gap in mm, where set.
    pub wire_diameter: Option<f64>,
    pub gap: Option<f64>,
    /// The settings of several passes.
    pub passes: Passes,
    pub side: SideSetting,
    /// The levels that correction, side and unit come from.
    pub origins: Origins,
    pub unit: Unit,
    /// Set by the user.
    pub states_unit: bool,
    /// The order of the contours is set.
    pub states_order: bool,
    pub margin: f64,
    pub layers: ByName<Role>,
    /// Roles by linetype, in upper case.
    pub linetypes: BTreeMap<String, Role>,
    /// The name of the document's file.
    pub document: Option<String>,
    /// Suppressed findings of the document, by handle and rule, with the reason.
    pub suppressed: BTreeMap<String, BTreeMap<Rule, String>>,
    /// Roles by handle.
    pub contours: BTreeMap<String, Role>,
    /// Settings of single contours of the document, by handle or point.
    pub own: BTreeMap<String, ContourSettings>,
    /// The roles among those, for contours that are named by a point, mm.
    pub points: Vec<(Point, Role)>,
    pub colors: BTreeMap<Color, Role>,
    pub severities: BTreeMap<Rule, Option<Severity>>,
    /// The rules whose severity the user has set.
    pub stated: BTreeSet<Rule>,
    pub docs_url: Option<String>,
    /// What programs are written in, where set.
    pub format: Option<ProgramFormat>,
    pub layout: Layout,
    /// The layout that the user has set; without one, formatting keeps the program's own.
    pub stated_layout: Option<Layout>,
    /// Programs of blocks begin with a comment that gives the thread hole.
    pub header: bool,
    pub direction: Direction,
    /// The direction that the user has set.
    pub stated_direction: Option<Direction>,
    pub corner: Corner,
    pub thread: Option<PointSetting>,
    pub entry: Option<PointSetting>,
    /// 0: none, the wire is threaded where its path begins.
    pub lead_in: f64,
    /// The length of the lead-in that the user has set.
    pub stated_lead_in: Option<f64>,
    /// Diameter of the start holes, mm, where set.
    pub start_hole: Option<f64>,
    pub lead: Lead,
    /// The length of the tab of a punch until it is cut off, mm.
    pub tab: LengthSetting,
    /// The word that stops the machine before the tab is cut off, where set.
    pub tab_stop: Option<String>,
    /// How far each pass goes on past its start, mm.
    pub closing_overlap: f64,
    pub job: JobSettings,
    /// The settings of a pair.
    pub pair: PairSettings,
    pub workpieces: Workpieces,
    /// The settings of a milling electrode.
    pub milling: MillingSettings,
    /// An electrode cuts, not a wire: it enters from above without leads, and runs along the middle
    /// of open contours.
    pub mills: bool,
    /// The wire comes to its path across the contour: it runs on the part's side of what is drawn, of a part that ends farther away.
    pub comes_across: bool,
    /// Only this workpiece is cut.
    pub only: Option<u16>,
    pub order: Order,
    /// Parts that share an edge are cut apart on it.
    pub common_line: bool,
    pub jumps: Jumps,
    /// The wire stays threaded between contours, so that the way there cuts, too. Set for a format whose programs do
    /// not stop.
    pub stays_threaded: bool,
    pub compensation: Compensation,
    /// Digits of the controller's numbers in 3B.
    pub digits: u32,
    /// The unit of an ISO program that states none, where set; else mm.
    pub program_units: Option<UnitSetting>,
    /// What whole numbers of ISO programs are, where somebody has said that.
    pub whole_numbers: Option<NumberUnit>,
    /// The drawing of programs, relative to their folder.
    pub drawing: Option<String>,
    /// How ISO programs are written; for an unknown profile the sentence that lists the known ones.
    pub profile: Result<Profile, String>,
    /// The name that was stated for it, known or not.
    pub profile_name: String,
    pub end: String,
    pub pause: String,
    /// The word between the passes of a contour, empty for none, where set.
    pub pause_between_passes: Option<String>,
    pub tolerances: Tolerances,
    pub budget: Budget,
}

impl Effective {
    /// Whether the path is the contour itself, without offset: by its role, for all of them, or where an electrode mills along an
    /// open one.
    pub(crate) fn runs_on(&self, outline: &Outline) -> bool {
        self.compensation == Compensation::None
            || outline.is_on_line()
            || self.mills && !outline.contour.closed
    }

    /// The page of a rule, if there is an address for it.
    pub(crate) fn page_of(&self, rule: Rule) -> Option<String> {
        Some(self.docs_url.as_ref()?.replace("{rule}", rule.name()))
    }

    /// Fills in the defaults. Values that do not fit have been reported and left out before.
    pub fn of(settings: &Settings) -> Effective {
        let milling = settings.milling.clone().unwrap_or_default();
        let of_electrode = milling.correction().filter(|_| !says_a_wire(settings));
        let corrections = corrections_of(settings, of_electrode);
        let largest = corrections
            .iter()
            .copied()
            .enumerate()
            .max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
        let (index, correction) = largest.unwrap_or_default();
        let program = settings.program();
        let skim_corner = settings.passes.as_ref().and_then(|own| own.skim_corner);
        let severities = settings.rules.clone().unwrap_or_default();
        let severity = |rule: Rule| match severities.get(rule.name()) {
            Some(set) => set.severity(),
            None => Some(rule.default_severity()),
        };
        let is_stated = |rule: &Rule| severities.contains_key(rule.name());
        Effective {
            correction,
            pass: (corrections.len() > 1).then_some(index + 1),
            corrections,
            wire_diameter: settings.wire_diameter,
            gap: settings.gap,
            passes: Passes {
                // A control offsets the drawn contour, whatever the pass.
                skim_corner: match program.compensation() {
                    Compensation::Controller => None,
                    Compensation::Path | Compensation::None => skim_corner,
                },
                ..settings.passes.clone().unwrap_or_default()
            },
            side: settings.side(),
            origins: Origins::default(),
            states_unit: settings.units.is_some(),
            states_order: program.order.is_some(),
            unit: match settings.units() {
                UnitSetting::Mm => Unit::MILLIMETRE,
                UnitSetting::Inch => Unit::INCH,
            },
            margin: settings.margin(),
            layers: ByName::of(
                settings
                    .layers
                    .iter()
                    .flatten()
                    .map(|(name, role)| (name, *role)),
            ),
            document: None,
            suppressed: BTreeMap::new(),
            linetypes: settings
                .linetypes
                .iter()
                .flatten()
                .map(|(name, &role)| (name.to_uppercase(), role))
                .collect(),
            contours: settings.contours.clone().unwrap_or_default(),
            own: BTreeMap::new(),
            points: Vec::new(),
            colors: settings
                .colors
                .iter()
                .flatten()
                .filter_map(|(name, role)| Some((Color::named(name)?, *role)))
                .collect(),
            severities: Rule::ALL.map(|rule| (rule, severity(rule))).into(),
            stated: Rule::ALL.into_iter().filter(is_stated).collect(),
            docs_url: settings.docs_url.clone(),
            format: program.format,
            layout: program.layout(),
            stated_layout: program.layout,
            header: program
                .header
                .unwrap_or(program.layout() != Layout::Compact),
            direction: program.direction(),
            stated_direction: program.direction,
            corner: program.corner(),
            thread: program.thread.clone(),
            entry: program.entry.clone(),
            lead_in: program.lead_in(),
            stated_lead_in: program.lead_in,
            start_hole: program.start_hole,
            lead: program.lead(),
            tab: program.tab.clone().unwrap_or(LengthSetting::One(0.0)),
            tab_stop: program.tab_stop.clone(),
            closing_overlap: program.closing_overlap(),
            job: settings.job.clone().unwrap_or_default(),
            pair: settings.pair.clone().unwrap_or_default(),
            workpieces: Workpieces::of(settings),
            milling: MillingSettings {
                wear_compensation: Some(milling.wear_compensation()),
                slot_ends: Some(milling.slot_ends()),
                ..milling
            },
            mills: of_electrode.is_some(),
            comes_across: false,
            only: None,
            order: program.order(),
            common_line: program.common_line(),
            jumps: program.jumps(),
            stays_threaded: false,
            compensation: program.compensation(),
            digits: program.digits().into(),
            program_units: program.units,
            whole_numbers: program.whole_numbers,
            drawing: program.drawing.clone(),
            profile: Profile::of(&program.profile(), settings.profiles.as_ref()),
            profile_name: program.profile(),
            end: program.end(),
            pause: program.pause(),
            pause_between_passes: program.pause_between_passes.clone(),
            tolerances: Tolerances {
                join: settings.join(),
                certain: settings.join().min(Tolerances::default().certain),
                arc_fit: settings.arc_fit(),
                chord_fit: settings.chord_fit(),
                resolution: settings.resolution(),
                ..Tolerances::default()
            },
            budget: Budget::default(),
        }
    }

    /// The largest number that the controller takes in 3B, µm.
    pub(crate) fn largest_number(&self) -> i64 {
        10_i64.pow(self.digits.min(18)) - 1
    }

    /// The same with one pass alone, that of the largest correction.
    pub(crate) fn of_one_pass(&self) -> Effective {
        Effective {
            corrections: vec![self.correction],
            pass: None,
            passes: Passes::default(),
            tab: LengthSetting::One(0.0),
            closing_overlap: 0.0,
            ..self.clone()
        }
    }

    /// The direction of a pass along the contour relative to the first one. Passes count from 0.
    pub(crate) fn runs_back(&self, pass: usize) -> bool {
        pass % 2 == 1 && self.passes.sequence() == Sequence::Alternate
    }

    /// Half the kerf of a pass in mm: the wire's radius and the spark gap, where both are known. Passes count from 0.
    pub fn half_kerf(&self, pass: usize) -> Option<f64> {
        let gap = match &self.passes.gaps {
            Some(gaps) => gaps.get(pass).copied(),
            None => self.gap,
        };
        Some(self.wire_diameter? / 2.0 + gap?)
    }

    /// Length of the tab of a contour in mm, by the handles of its entities; 0 for none.
    pub(crate) fn tab_of<'a>(&self, mut handles: impl Iterator<Item = &'a str>) -> f64 {
        match &self.tab {
            LengthSetting::One(length) => *length,
            LengthSetting::ByHandle(lengths) => handles
                .find_map(|handle| lengths.get(handle).copied())
                .unwrap_or(0.0),
        }
    }

    /// Mass in g of this many mm² of steel, where the height of the workpiece is known.
    pub(crate) fn mass_of(&self, area: f64) -> Option<f64> {
        /// g in a mm³ of steel.
        const STEEL: f64 = 7.85e-3;
        Some(STEEL * area * self.job.thickness?)
    }

    /// True where what drops out of a contour of this role lies inside it.
    pub(crate) fn has_waste_inside(&self, role: Role) -> bool {
        role != Role::Line && (role == Role::Opening) != self.comes_across
    }

    /// True where a slug of this many mm² is too heavy to drop.
    pub(crate) fn keeps_slug(&self, area: f64) -> bool {
        let mass = self.mass_of(area).zip(self.job.slug_limit);
        mass.is_some_and(|(mass, limit)| mass > limit)
    }

    /// The radius that the last pass leaves in a sharp corner when the wire runs on its inside, mm: half its kerf, or
    /// its correction where nothing else is known; with skims of constant stock, plus the distance between the first
    /// path and the last.
    pub(crate) fn corner_radius(&self) -> f64 {
        let last = self.last_correction();
        let number = self.corrections.len().saturating_sub(1);
        let half_kerf = self.half_kerf(number).filter(|_| number > 0);
        match self.passes.skim_corner() {
            SkimCorner::Sharp => half_kerf.unwrap_or(last),
            SkimCorner::ConstantStock => self.correction - last + half_kerf.unwrap_or(last),
        }
    }

    /// The smallest correction of all passes, mm.
    pub(crate) fn last_correction(&self) -> f64 {
        let all = self.corrections.iter().copied();
        all.fold(self.correction, f64::min)
    }

    /// The correction of each pass, mm, from rough to finish.
    pub(crate) fn each_correction(&self) -> Vec<f64> {
        match self.corrections.len() {
            0 | 1 => vec![self.correction],
            _ => self.corrections.clone(),
        }
    }

    /// The fault in the corrections of the passes, if it is an error: no program is written then.
    pub(crate) fn pass_error(&self) -> Option<String> {
        let is_error = self.severity(Rule::PassOrder) == Some(Severity::Error);
        let faults = || super::pass_faults(&self.corrections, &self.passes, self.wire_diameter);
        if is_error {
            faults().into_iter().next().map(|fault| fault.message)
        } else {
            None
        }
    }

    /// Severity of a rule, `None` when it is switched off.
    pub(crate) fn severity(&self, rule: Rule) -> Option<Severity> {
        self.severities
            .get(&rule)
            .copied()
            .unwrap_or(Some(rule.default_severity()))
    }

    /// Severity of a reader's finding: the one set for its rule, else the reader's own. `None` when it is switched off.
    pub(crate) fn severity_of(&self, finding: &Finding) -> Option<Severity> {
        self.severity_over(finding.rule, finding.severity)
    }

    /// The same with the settings of one drawing, by the name of its file.
    pub(crate) fn of_document(settings: &Settings, name: Option<String>) -> Effective {
        let said = settings.drawings.as_ref().zip(name.as_ref());
        let said = said.and_then(|(drawings, name)| drawings.get(name));
        let own = said.and_then(|said| said.suppress.clone());
        let own_contours = said.and_then(|said| said.contours.clone());
        let own_contours = own_contours.unwrap_or_default();
        let rules = |reasons: BTreeMap<String, String>| {
            let rule = |name: &str| Rule::ALL.into_iter().find(|rule| rule.name() == name);
            let known = reasons
                .into_iter()
                .filter_map(|(name, reason)| Some((rule(&name)?, reason)));
            known.collect()
        };
        let mut effective = Effective::of(settings);
        for (key, said) in &own_contours {
            match (said.side, point_of(key)) {
                (Some(side), Some(at)) => effective.points.push((at, side)),
                (Some(side), None) => drop(effective.contours.insert(key.clone(), side)),
                (None, _) => {}
            }
        }
        Effective {
            document: name,
            own: own_contours,
            suppressed: own
                .into_iter()
                .flatten()
                .map(|(handle, reasons)| (handle, rules(reasons)))
                .collect(),
            ..effective
        }
    }

    /// Severity of a finding whose rule has several: `own`, unless the user has set the rule.
    pub(crate) fn severity_over(&self, rule: Rule, own: Severity) -> Option<Severity> {
        if self.stated.contains(&rule) {
            self.severity(rule)
        } else {
            Some(own)
        }
    }

    /// The unit of a drawing: its own, else that of the settings.
    pub fn unit_of(&self, drawing: &crate::drawing::Drawing) -> Unit {
        drawing.unit.unwrap_or(self.unit)
    }
}

/// Whether it says what the wire cuts, so that no electrode is meant.
fn says_a_wire(settings: &Settings) -> bool {
    let passes = settings.passes.as_ref();
    settings.correction.is_some()
        || settings.wire_diameter.is_some()
        || settings.gap.is_some()
        || passes.is_some_and(|passes| passes.corrections.is_some())
}

/// The correction of each pass, one where none are set.
fn corrections_of(settings: &Settings, of_electrode: Option<f64>) -> Vec<f64> {
    let passes = settings.passes.as_ref();
    let listed = passes.and_then(|passes| passes.corrections.clone());
    let single = || match (settings.correction, settings.wire_diameter, settings.gap) {
        (Some(correction), ..) => correction,
        (None, None, None) => of_electrode.unwrap_or_else(|| settings.correction()),
        (None, ..) => settings.wire_diameter() / 2.0 + settings.gap(),
    };
    listed
        .filter(|list| !list.is_empty())
        .unwrap_or_else(|| vec![single()])
}

/// The largest distance of a naming point from its contour, mm.
pub(crate) const NEAR: f64 = 0.01;

/// The point that names a contour, `x,y`; `None` where it is a handle.
pub(crate) fn point_of(key: &str) -> Option<Point> {
    let (x, y) = key.split_once(',')?;
    let number = |text: &str| text.trim().parse().ok().filter(|it: &f64| it.is_finite());
    Some(Point::new(number(x)?, number(y)?))
}

impl Default for Effective {
    fn default() -> Self {
        Effective::of(&Settings::default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Open documents are judged again only when their settings differ.
    #[test]
    fn what_is_set_to_its_default_changes_nothing() {
        let set = Settings {
            correction: Some(Settings::default().correction()),
            ..Settings::default()
        };
        assert!(Effective::of(&set) == Effective::of(&Settings::default()));
    }
}
