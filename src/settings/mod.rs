//! Settings: one type for every level, and the result of merging all levels.
//!
//! Each level holds only what somebody set. Keys are camelCase in JSON and kebab-case in `wedm.toml`.

mod budget;
mod by_name;
#[macro_use]
mod table;
mod choices;
mod effective;
mod from_json;
mod from_option;
mod from_toml;
mod job;
mod keep;
mod keys;
mod level;
mod milling;
mod origins;
mod pair;
mod passes;
mod profile;
mod reader;
mod row;
mod said;
mod shipped;
mod spelling;
mod toml_tree;
mod value;
mod workpieces;

pub use budget::Budget;
pub use choices::{
    CenterRule, Compensation, Coordinates, Corner, Direction, DrawnAs, Jumps, Layout, Lead,
    LineEnd, NumberUnit, Order, ProgramFormat, RuleSeverity, Sequence, SideSetting, SkimCorner,
    UnitSetting, WearCompensation, Zero,
};
pub use effective::Effective;
pub(crate) use effective::{NEAR, point_of};
pub(crate) use from_json::from_json;
pub use from_toml::from_toml;
pub(crate) use from_toml::{FILE_NAME, is_there, place_in, read_file};
pub(crate) use job::{ENDS, PAUSES};
pub(crate) use keep::{as_lines, keep, set, table_of_suppressions};
pub(crate) use keys::{
    ContourSettings, JobSettings, MillingSettings, PairSettings, Passes, Profile, ProfileSettings,
    ProgramSettings,
};
pub use keys::{Settings, rows};
pub use milling::Electrode;
pub use origins::{Origin, Origins};
pub(crate) use pair::{MissingForFit, Partners, Use, part_title};
pub(crate) use passes::{PassFault, pass_faults, passes_table};
pub(crate) use row::LARGEST;
pub use row::Row;
pub use shipped::shipped_profiles;
pub(crate) use spelling::nearest;
pub use table::camel_case;
pub(crate) use workpieces::Workpieces;

use crate::drawing::Role;
use crate::finding::{Rule, Severity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use table::Overlay;

/// One point, or one for each contour by the handle of an entity in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum PointSetting {
    One([f64; 2]),
    ByHandle(BTreeMap<String, [f64; 2]>),
}

/// One length in mm, or one for each contour by the handle of an entity in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum LengthSetting {
    One(f64),
    ByHandle(BTreeMap<String, f64>),
}

plain! {
    bool, f64, u8, u32, String, [f64; 2], Vec<f64>, Vec<String>, Role, PointSetting, LengthSetting,
}

impl Settings {
    /// The settings of `[program]`.
    pub(crate) fn program(&self) -> ProgramSettings {
        self.program.clone().unwrap_or_default()
    }

    /// Each contour is cut on both sides, as punch and as plate.
    fn is_pair(&self) -> bool {
        let pair = self.pair.as_ref();
        pair.is_some_and(|pair| pair.drawn_as.is_some())
    }

    /// Lays `later` over `self`: `later` wins; tables are merged key by key.
    ///
    /// A later level with a correction resets the passes of earlier levels, and one with a wire diameter or a gap their
    /// correction. One thread hole or one entry likewise resets those of single contours. A later side ends a pair whose
    /// contours are cut on both, and a later pair an earlier side.
    pub(crate) fn overlaid(&self, later: &Settings) -> Settings {
        let mut laid = Overlay::overlaid(self, later);
        if later.wire_diameter.is_some() || later.gap.is_some() {
            laid.correction = later.correction;
        }
        if let (Some(laid), Some(earlier)) = (&mut laid.passes, &self.passes) {
            let own = later.passes.clone().unwrap_or_default();
            laid.reset(earlier, &own, later.correction.is_some());
            if later.gap.is_some() {
                laid.gaps = own.gaps;
            }
        }
        let is_one_side = |side: SideSetting| side != SideSetting::Both;
        if later.is_pair() {
            laid.side = later.side;
        } else if self.is_pair() && later.side.is_some_and(is_one_side) {
            laid.pair = later.pair.clone();
        }
        if let Some(program) = &later.program {
            let is_one = |point: &Option<PointSetting>| matches!(point, Some(PointSetting::One(_)));
            let drawings = laid.drawings.iter_mut().flat_map(BTreeMap::values_mut);
            let contours = drawings.flat_map(|drawing| &mut drawing.contours);
            for contour in contours.flat_map(BTreeMap::values_mut) {
                contour.thread = contour.thread.filter(|_| !is_one(&program.thread));
                contour.entry = contour.entry.filter(|_| !is_one(&program.entry));
            }
        }
        laid
    }

    /// Contradictions after all levels are merged: in the corrections of the passes, the pair, the electrode and the
    /// program. `place` finds the place of a fault in a text.
    pub(crate) fn contradictions(
        &self,
        place: &dyn Fn(&PassFault) -> Option<std::ops::Range<usize>>,
    ) -> Vec<SettingsError> {
        let others = pair::faults(self).into_iter().chain(milling::faults(self));
        let others = others.chain(job::faults(self)).chain(profile::faults(self));
        let error = |fault: PassFault| SettingsError {
            of_levels: true,
            ..SettingsError::new(fault.key.clone(), fault.message.clone(), place(&fault))
        };
        let warning = |fault: PassFault| SettingsError {
            severity: Severity::Warning,
            ..error(fault)
        };
        let mut errors = self.pass_errors(place);
        errors.extend(others.map(error));
        let doubts = job::idle(self).into_iter().chain(job::doubts(self));
        errors.extend(doubts.map(warning));
        errors
    }

    fn pass_errors(
        &self,
        place: &dyn Fn(&PassFault) -> Option<std::ops::Range<usize>>,
    ) -> Vec<SettingsError> {
        let rule = Rule::PassOrder;
        let stated = self.rules.as_ref().and_then(|rules| rules.get(rule.name()));
        let Some(severity) = stated.map_or(Some(rule.default_severity()), |severity| {
            severity.severity()
        }) else {
            return Vec::new();
        };
        let passes = self.passes.clone().unwrap_or_default();
        let milling = self.milling.clone().unwrap_or_default();
        let faults = match (&passes.corrections, self.correction) {
            (Some(list), _) => pass_faults(list, &passes, self.wire_diameter),
            (None, Some(single)) => pass_faults(&[single], &passes, self.wire_diameter),
            // Half the wire and its gap, or the default.
            (None, None) if milling.correction().is_none() => {
                pass_faults(&[f64::INFINITY], &passes, self.wire_diameter)
            }
            (None, None) => return Vec::new(),
        };
        let error = |(fault, severity): (PassFault, Severity)| SettingsError {
            range: place(&fault),
            key: fault.key.into(),
            message: fault.message,
            rule,
            severity,
            of_levels: true,
        };
        // Somebody may want a part that is smaller by so little: it is a warning unless it is set.
        let pair = self.pair.clone().unwrap_or_default();
        let clearances = [pair.clearance, pair.stripper].into_iter().flatten();
        let allowed = clearances.fold(0.0, f64::max) + self.resolution().max(1e-3);
        let of_kerf = stated.map_or(Severity::Warning, |_| severity);
        let beyond = passes::cuts_beyond(self, allowed).into_iter();
        faults
            .into_iter()
            .map(|fault| (fault, severity))
            .chain(beyond.map(|fault| (fault, of_kerf)))
            .map(error)
            .collect()
    }
}

/// A setting that does not fit: which one, and what was expected. In lower case without a full
/// stop.
#[derive(Clone, Debug, PartialEq)]
pub struct SettingsError {
    /// Dotted key, as written.
    pub(crate) key: String,
    pub message: String,
    /// Bytes in the source text, where there is one.
    pub range: Option<std::ops::Range<usize>>,
    /// The rule that reports it: `settings`, or `pass-order`.
    pub(crate) rule: Rule,
    pub(crate) severity: Severity,
    /// It shows only after all levels are merged.
    pub(crate) of_levels: bool,
}

impl SettingsError {
    /// A value that does not fit by itself.
    pub(crate) fn new(
        key: impl Into<String>,
        message: String,
        range: Option<std::ops::Range<usize>>,
    ) -> SettingsError {
        SettingsError {
            key: key.into(),
            message,
            range,
            rule: Rule::Settings,
            severity: Rule::Settings.default_severity(),
            of_levels: false,
        }
    }
}
