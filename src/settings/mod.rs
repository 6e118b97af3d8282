//! Settings: one type for every level, and what they mean once all levels are laid over each other.
//!
//! Each level holds only what somebody set. Keys are camelCase in JSON and kebab-case in `wedm.toml`.

mod budget;
mod effective;
mod from_json;
mod from_option;
mod from_toml;
#[macro_use]
mod table;
mod job;
mod keep;
mod keys;
mod level;
mod milling;
mod pair;
mod passes;
mod profile;
mod reader;
mod row;
mod shipped;
mod spelling;
mod toml_tree;
mod value;
mod workpieces;

pub use budget::Budget;
pub use effective::Effective;
pub(crate) use effective::{NEAR, point_of};
pub(crate) use from_json::from_json;
pub use from_toml::from_toml;
pub(crate) use from_toml::{FILE_NAME, place_in, read_file};
pub(crate) use keep::{as_lines, keep, table_of_suppressions};
pub(crate) use keys::{
    ContourSettings, JobSettings, MillingSettings, PairSettings, Passes, Profile, ProfileSettings,
    ProgramSettings,
};
pub use keys::{Settings, rows};
pub use milling::Electrode;
pub(crate) use pair::{Partners, Use};
pub(crate) use passes::{PassFault, pass_faults, passes_table};
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

/// Side of the contour on which the wire runs, where neither the entity nor its layer says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SideSetting {
    /// The outline is cut once from inside and once from outside.
    #[default]
    Both,
    /// By nesting: the outermost contour is a punch, contours in it are openings, and so on.
    Auto,
    /// The wire runs inside.
    Opening,
    /// The wire runs outside.
    Punch,
    /// Of open contours: the wire runs to the left of their direction. Closed ones count as `both`.
    Left,
    /// The same to the right.
    Right,
}

impl SideSetting {
    /// The role of every contour that states none; nothing where it depends on nesting.
    pub(crate) fn role(self) -> Option<Role> {
        match self {
            SideSetting::Auto => None,
            SideSetting::Both => Some(Role::Both),
            SideSetting::Opening => Some(Role::Opening),
            SideSetting::Punch => Some(Role::Punch),
            SideSetting::Left => Some(Role::Left),
            SideSetting::Right => Some(Role::Right),
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum UnitSetting {
    /// Millimetres.
    #[default]
    Mm,
    /// Inches.
    Inch,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Layout {
    /// No spaces: `B9900B0B9900GXL1`.
    #[default]
    Compact,
    /// Fixed columns with spaces.
    Aligned,
    /// Aligned, with block number and the absolute end point in mm behind the block.
    Checking,
}

/// Direction in which a closed contour is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// Counter-clockwise.
    #[default]
    Ccw,
    /// Clockwise.
    Cw,
    /// As the contour is drawn.
    AsDrawn,
}

/// Which contour is cut after which. What lies within a contour always comes before it: the part drops when the contour round it is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// As they are drawn or selected; what lies within one directly before it.
    AsDrawn,
    /// As they are drawn or selected; where that is not possible, one outermost contour after the other, the innermost in it first.
    #[default]
    InsideFirst,
    /// From each to the one with the nearest thread hole.
    Nearest,
    /// As the handles are given, which also say where in its contour the cut begins, and which way it goes where `direction` is not set.
    AsPicked,
}

/// How the wire path rounds a convex corner of the part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Corner {
    /// Rolls about the vertex.
    #[default]
    Arc,
    /// Extends the two offsets until they meet.
    Intersection,
}

/// How the wire comes from the thread hole to its path and goes back.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Lead {
    /// Straight from the thread hole to the entry.
    Straight,
    /// At right angles to the contour: a thread hole that is found lies there; where `thread` and `entry` do not lie opposite to each
    /// other the way has a corner, where there is room for one.
    #[default]
    Perpendicular,
    /// Along an arc that is tangent to the path, on the wire's side, behind a straight piece that is tangent to the arc. Its radius is
    /// a third of the lead, halved until it fits, and not below the correction.
    Arc,
}

/// What happens between the contours of one program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Jumps {
    /// The pause word, the way to the next thread hole as blocks, and the pause word again.
    #[default]
    Blocks,
    /// The pause word alone.
    None,
}

/// Which way the passes of a contour go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Sequence {
    /// To and fro: each pass goes back along the one before it.
    #[default]
    Alternate,
    /// All the same way.
    OneWay,
}

/// What the passes after the first make of a corner that the wire runs inside of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SkimCorner {
    /// Each pass turns in a point: as sharp as the wire leaves it, with more stock in the corner than along the walls.
    #[default]
    Sharp,
    /// Each pass runs at one distance beside the first: as much stock in the corner as along the walls, which is left rounder.
    ConstantStock,
}

/// Which part of a pair is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum DrawnAs {
    /// What is drawn is the punch.
    Punch,
    /// What is drawn is the opening of the plate.
    Plate,
}

/// How the feed of a milling electrode makes up for its wear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum WearCompensation {
    /// Not at all: each layer is fed its height.
    None,
    /// Each layer is fed its height and the wear of the whole layer, and the next one goes back along it, so that the floor wears even.
    #[default]
    Uniform,
    /// Each layer is fed its height, and on its way, step by step, what has been worn.
    Linear,
}

/// Where the correction is applied.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Compensation {
    /// The offset is in the coordinates.
    #[default]
    Path,
    /// The controller offsets: G41 and G42, or 4B; refused for 3B.
    Controller,
    /// The contour is the wire's path.
    None,
}

/// Severity of a rule, or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum RuleSeverity {
    Error,
    Warning,
    Information,
    Hint,
    Off,
}

impl RuleSeverity {
    pub(crate) fn severity(self) -> Option<Severity> {
        match self {
            RuleSeverity::Error => Some(Severity::Error),
            RuleSeverity::Warning => Some(Severity::Warning),
            RuleSeverity::Information => Some(Severity::Information),
            RuleSeverity::Hint => Some(Severity::Hint),
            RuleSeverity::Off => None,
        }
    }
}

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
    bool, f64, u8, u32, String, [f64; 2], Vec<f64>, Vec<String>, Role, RuleSeverity, PointSetting, LengthSetting, Lead, SideSetting, UnitSetting, Layout, Direction,
    Corner, Order, Jumps, Sequence, SkimCorner, Compensation, WearCompensation, DrawnAs, CenterRule, Coordinates, Zero, NumberUnit, LineEnd,
}

impl Settings {
    /// What is set of `[program]`.
    pub(crate) fn program(&self) -> ProgramSettings {
        self.program.clone().unwrap_or_default()
    }

    /// Lays `later` over `self`: what `later` sets wins; tables are merged key by key.
    ///
    /// A wire diameter or a gap of a later level says the correction anew, where that level says none itself. So does one thread hole
    /// or one entry for all that is said of single contours.
    pub(crate) fn overlaid(&self, later: &Settings) -> Settings {
        let mut laid = Overlay::overlaid(self, later);
        if later.wire_diameter.is_some() || later.gap.is_some() {
            laid.correction = later.correction;
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

    /// What contradicts itself once all levels are laid over each other: the corrections of the passes, what is said of a pair, of an
    /// electrode and of the program. `place` says where a text speaks of it.
    pub(crate) fn contradictions(
        &self,
        place: &dyn Fn(&PassFault) -> Option<std::ops::Range<usize>>,
    ) -> Vec<SettingsError> {
        let others = pair::faults(self).into_iter().chain(milling::faults(self));
        let others = others.chain(job::faults(self));
        let others = others.map(|fault| SettingsError {
            of_levels: true,
            ..SettingsError::new(fault.key, fault.message.clone(), place(&fault))
        });
        let mut errors = self.pass_errors(place);
        errors.extend(others);
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
        let faults = match (&passes.corrections, self.correction) {
            (Some(list), _) => pass_faults(list, &passes, self.wire_diameter),
            (None, Some(single)) => pass_faults(&[single], &passes, self.wire_diameter),
            (None, None) => return Vec::new(),
        };
        let error = |fault: PassFault| SettingsError {
            key: fault.key.into(),
            range: place(&fault),
            message: fault.message,
            rule,
            severity,
            of_levels: true,
        };
        faults.into_iter().map(error).collect()
    }
}

/// How I and J lead to an arc's centre.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CenterRule {
    /// From the start to the centre.
    #[default]
    StartToCenter,
    /// From the centre to the start.
    CenterToStart,
    /// The centre itself in the coordinates of the program.
    Absolute,
}

/// G90 or G91.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Coordinates {
    /// G90.
    #[default]
    Absolute,
    /// G91.
    Incremental,
}

/// Where absolute coordinates count from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Zero {
    /// The zero of the drawing.
    #[default]
    Drawing,
    /// Where the wire is threaded first.
    Start,
}

/// Millimetres with a decimal point, or whole micrometres without one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum NumberUnit {
    #[default]
    Mm,
    Um,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LineEnd {
    #[default]
    Lf,
    Crlf,
}

/// A setting that does not fit: which one, and what was expected. Lower-case, no final dot.
#[derive(Clone, Debug, PartialEq)]
pub struct SettingsError {
    /// Dotted key, as written.
    pub(crate) key: String,
    pub message: String,
    /// Bytes in the source text, where there is one.
    pub range: Option<std::ops::Range<usize>>,
    /// What it is reported as: `settings`, or `pass-order`.
    pub(crate) rule: Rule,
    pub(crate) severity: Severity,
    /// It shows only once all levels are laid over each other: of one level alone it says nothing.
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
