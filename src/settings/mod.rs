//! Settings: one type for every level, and what they mean once all levels are laid over each other.
//!
//! Each level holds only what somebody set. Keys are camelCase in JSON and kebab-case in `wedm.toml`.

mod budget;
mod effective;
mod from_json;
mod from_toml;
mod passes;
mod profile;
mod reader;
mod value;

pub use budget::Budget;
pub use effective::Effective;
pub use from_json::from_json;
pub use from_toml::{FILE_NAME, from_toml, place_in, read_file};
pub use passes::{PassFault, pass_faults};
pub use profile::{
    CenterRule, Coordinates, LineEnd, NumberUnit, Profile, ProfileSettings, Zero, shipped_profiles,
};

use crate::drawing::Role;
use crate::finding::{Rule, Severity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Side of the contour on which the wire runs, where neither the entity nor its layer says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SideSetting {
    /// Every arc must survive both sides.
    #[default]
    Both,
    /// Nested contours alternate: outermost punch, holes openings.
    Auto,
    Opening,
    Punch,
}

impl SideSetting {
    /// The role of every contour that states none; nothing where it depends on nesting.
    pub fn role(self) -> Option<Role> {
        match self {
            SideSetting::Auto => None,
            SideSetting::Both => Some(Role::Both),
            SideSetting::Opening => Some(Role::Opening),
            SideSetting::Punch => Some(Role::Punch),
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum UnitSetting {
    #[default]
    Mm,
    Inch,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Layout {
    /// `B9900B0B9900GXL1`
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
    #[default]
    Ccw,
    Cw,
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

/// What happens between the contours of one program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Jumps {
    /// The way to the next thread hole is written as line blocks.
    #[default]
    Blocks,
    None,
}

/// Where the correction is applied.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Compensation {
    /// The offset is in the coordinates.
    #[default]
    Path,
    /// The controller offsets: G41/G42 or 4B.
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
    pub fn severity(self) -> Option<Severity> {
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

/// Corrections of a multi-pass cut.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields, default)]
pub struct Passes {
    /// Correction of each pass in mm, falling.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corrections: Option<Vec<f64>>,
}

/// How a program is written.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields, default)]
pub struct ProgramSettings {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layout: Option<Layout>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<Direction>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner: Option<Corner>,
    /// Thread hole in drawing units; a table by handle for several contours.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thread: Option<PointSetting>,
    /// Point on the contour in drawing units where the cut begins; a table by handle for several contours.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub entry: Option<PointSetting>,
    /// Length of the lead-in in mm when no thread hole is given.
    #[serde(skip_serializing_if = "Option::is_none", alias = "lead-in")]
    pub lead_in: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub order: Option<Order>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub jumps: Option<Jumps>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compensation: Option<Compensation>,
    /// Digits of the controller's numbers in 3B: a block with a longer one is split. 4 to 9.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub digits: Option<u8>,
    /// In what the numbers of an ISO program are that does not say so (G20, G21).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub units: Option<UnitSetting>,
    /// How ISO programs are written: a profile that ships, or one of `profiles`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile: Option<String>,
    /// Word that ends the program.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end: Option<String>,
    /// Word that pauses it, to thread the wire.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pause: Option<String>,
}

/// One level of settings: built-in, `initializationOptions`, `workspace/configuration`, `wedm.toml`, a request's `options`, the command line.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields, default)]
pub struct Settings {
    /// Wire radius + spark gap in mm: how far the wire's centre runs from the contour.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub correction: Option<f64>,
    /// mm. With `gap` it says the correction where that is not set; beside it, how thick the wire is.
    #[serde(skip_serializing_if = "Option::is_none", alias = "wire-diameter")]
    pub wire_diameter: Option<f64>,
    /// Spark gap in mm; see `wireDiameter`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gap: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub side: Option<SideSetting>,
    /// Unit of drawings that do not state one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub units: Option<UnitSetting>,
    /// mm added to the correction when a fix chooses its radius.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub passes: Option<Passes>,
    /// Role by layer name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layers: Option<BTreeMap<String, Role>>,
    /// Role by the handle of an entity: comes before those of layers and colours. Handles are those of one drawing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contours: Option<BTreeMap<String, Role>>,
    /// Role by colour, where neither entity nor layer has one: `red`, `yellow`, `green`, `cyan`, `blue`, `magenta`, `white`, `1` to `255`
    /// (AutoCAD colour index) or `#rrggbb`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colors: Option<BTreeMap<String, Role>>,
    /// How near the arcs lie to the ellipses and splines that they stand for, in mm.
    #[serde(skip_serializing_if = "Option::is_none", alias = "arc-fit")]
    pub arc_fit: Option<f64>,
    /// Severity by rule name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rules: Option<BTreeMap<String, RuleSeverity>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub program: Option<ProgramSettings>,
    /// Profiles of ISO programs by name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profiles: Option<BTreeMap<String, ProfileSettings>>,
}

impl Settings {
    /// Lays `later` over `self`: what `later` sets wins; tables are merged key by key.
    ///
    /// A wire diameter or a gap of a later level says the correction anew, where that level says none itself.
    pub fn overlaid(&self, later: &Settings) -> Settings {
        let mut earlier = self.clone();
        if later.correction.is_none() && (later.wire_diameter.is_some() || later.gap.is_some()) {
            earlier.correction = None;
        }
        Settings {
            correction: later.correction.or(earlier.correction),
            wire_diameter: later.wire_diameter.or(earlier.wire_diameter),
            gap: later.gap.or(earlier.gap),
            side: later.side.or(earlier.side),
            units: later.units.or(earlier.units),
            margin: later.margin.or(earlier.margin),
            passes: later.passes.clone().or(earlier.passes),
            layers: merged(earlier.layers, later.layers.clone()),
            contours: merged(earlier.contours, later.contours.clone()),
            colors: merged(earlier.colors, later.colors.clone()),
            arc_fit: later.arc_fit.or(earlier.arc_fit),
            rules: merged(earlier.rules, later.rules.clone()),
            program: match (earlier.program, &later.program) {
                (Some(earlier), Some(later)) => Some(earlier.overlaid(later)),
                (earlier, later) => later.clone().or(earlier),
            },
            profiles: match (earlier.profiles, &later.profiles) {
                (Some(mut earlier), Some(later)) => {
                    for (name, profile) in later {
                        let merged = earlier
                            .get(name)
                            .map_or_else(|| profile.clone(), |known| known.overlaid(profile));
                        earlier.insert(name.clone(), merged);
                    }
                    Some(earlier)
                }
                (earlier, later) => later.clone().or(earlier),
            },
        }
    }
}

impl Settings {
    /// What is wrong with the corrections of the passes once all levels are laid over each other. `place` says where a text speaks of it.
    pub fn pass_errors(
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
        let (key, faults) = match (
            self.passes
                .as_ref()
                .and_then(|passes| passes.corrections.as_ref()),
            self.correction,
        ) {
            (Some(list), _) => (
                "passes.corrections",
                pass_faults(list, true, self.wire_diameter),
            ),
            (None, Some(single)) => (
                "correction",
                pass_faults(&[single], false, self.wire_diameter),
            ),
            (None, None) => return Vec::new(),
        };
        let error = |fault: PassFault| SettingsError {
            key: key.into(),
            range: place(&fault),
            message: fault.message,
            rule,
            severity,
        };
        faults.into_iter().map(error).collect()
    }
}

impl ProgramSettings {
    fn overlaid(&self, later: &ProgramSettings) -> ProgramSettings {
        ProgramSettings {
            layout: later.layout.or(self.layout),
            direction: later.direction.or(self.direction),
            corner: later.corner.or(self.corner),
            thread: later.thread.clone().or(self.thread.clone()),
            entry: later.entry.clone().or(self.entry.clone()),
            lead_in: later.lead_in.or(self.lead_in),
            order: later.order.or(self.order),
            jumps: later.jumps.or(self.jumps),
            compensation: later.compensation.or(self.compensation),
            digits: later.digits.or(self.digits),
            units: later.units.or(self.units),
            profile: later.profile.clone().or(self.profile.clone()),
            end: later.end.clone().or(self.end.clone()),
            pause: later.pause.clone().or(self.pause.clone()),
        }
    }
}

fn merged<V>(
    earlier: Option<BTreeMap<String, V>>,
    later: Option<BTreeMap<String, V>>,
) -> Option<BTreeMap<String, V>> {
    match (earlier, later) {
        (Some(mut earlier), Some(later)) => {
            earlier.extend(later);
            Some(earlier)
        }
        (earlier, later) => later.or(earlier),
    }
}

/// A setting that does not fit: which one, and what was expected. Lower-case, no final dot.
#[derive(Clone, Debug, PartialEq)]
pub struct SettingsError {
    /// Dotted key, as written.
    pub key: String,
    pub message: String,
    /// Bytes in the source text, where there is one.
    pub range: Option<std::ops::Range<usize>>,
    /// What it is reported as: `settings`, or `pass-order`.
    pub rule: Rule,
    pub severity: Severity,
}

impl SettingsError {
    /// A value that does not fit by itself.
    pub fn new(
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
        }
    }
}
