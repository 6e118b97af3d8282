//! Profiles: how an ISO program is written for one kind of machine, as data.
//!
//! Those that ship stand in `profiles.toml`, those of a user in the table `[profiles.NAME]` of `wedm.toml`; both are read alike.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// How I and J lead to an arc's centre.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CenterRule {
    #[default]
    StartToCenter,
    CenterToStart,
    /// The centre itself in the coordinates of the program.
    Absolute,
}

/// G90 or G91.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Coordinates {
    #[default]
    Absolute,
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

/// What somebody has set of a profile.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields, default)]
pub struct ProfileSettings {
    /// The profile whose values hold where none is set: one that ships, `generic` by default.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coordinates: Option<Coordinates>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub zero: Option<Zero>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<NumberUnit>,
    /// Digits behind the point of millimetres: 3 to 6.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decimals: Option<u8>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center: Option<CenterRule>,
    /// False: a full circle is written as two halves, which every control takes.
    #[serde(skip_serializing_if = "Option::is_none", alias = "full-circles")]
    pub full_circles: Option<bool>,
    /// True: G00 to G03 and coordinates that have not changed are left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modal: Option<bool>,
    /// Between the words of a block.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spaces: Option<bool>,
    /// Step of the N numbers; 0 for none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub numbers: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none", alias = "line-end")]
    pub line_end: Option<LineEnd>,
    /// Lines before everything. `{x}` and `{y}` are the place where the wire is threaded first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub begin: Option<Vec<String>>,
    /// Lines before each contour. `{side}` is G41 or G42; a line with it is left out where the offset is in the coordinates.
    #[serde(skip_serializing_if = "Option::is_none", alias = "contour-begin")]
    pub contour_begin: Option<Vec<String>>,
    /// Lines before the way out of each contour, where the control offsets it.
    #[serde(skip_serializing_if = "Option::is_none", alias = "contour-end")]
    pub contour_end: Option<Vec<String>>,
    /// Lines at which the wire is taken out or threaded, between contours.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pause: Option<Vec<String>>,
    /// Lines at the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end: Option<Vec<String>>,
}

/// A profile with every value filled in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Profile {
    pub name: String,
    pub coordinates: Coordinates,
    pub zero: Zero,
    pub unit: NumberUnit,
    pub decimals: u8,
    pub center: CenterRule,
    pub full_circles: bool,
    pub modal: bool,
    pub spaces: bool,
    pub numbers: u32,
    pub line_end: LineEnd,
    pub begin: Vec<String>,
    pub contour_begin: Vec<String>,
    pub contour_end: Vec<String>,
    pub pause: Vec<String>,
    pub end: Vec<String>,
}

/// The profile that holds where none is named.
pub const DEFAULT_PROFILE: &str = "generic";

/// Digits behind the point of micrometres in millimetres, and of the finest step.
pub const DECIMALS: std::ops::RangeInclusive<u8> = 3..=6;

static SHIPPED: LazyLock<BTreeMap<String, ProfileSettings>> = LazyLock::new(|| {
    super::from_toml(include_str!("profiles.toml"))
        .0
        .profiles
        .unwrap_or_default()
});

/// Names of the profiles that ship.
pub fn shipped_profiles() -> impl Iterator<Item = &'static str> {
    SHIPPED.keys().map(String::as_str)
}

impl ProfileSettings {
    /// What `later` sets wins.
    pub(super) fn overlaid(&self, later: &ProfileSettings) -> ProfileSettings {
        ProfileSettings {
            base: later.base.clone().or(self.base.clone()),
            coordinates: later.coordinates.or(self.coordinates),
            zero: later.zero.or(self.zero),
            unit: later.unit.or(self.unit),
            decimals: later.decimals.or(self.decimals),
            center: later.center.or(self.center),
            full_circles: later.full_circles.or(self.full_circles),
            modal: later.modal.or(self.modal),
            spaces: later.spaces.or(self.spaces),
            numbers: later.numbers.or(self.numbers),
            line_end: later.line_end.or(self.line_end),
            begin: later.begin.clone().or(self.begin.clone()),
            contour_begin: later.contour_begin.clone().or(self.contour_begin.clone()),
            contour_end: later.contour_end.clone().or(self.contour_end.clone()),
            pause: later.pause.clone().or(self.pause.clone()),
            end: later.end.clone().or(self.end.clone()),
        }
    }
}

impl Profile {
    /// True where its pause stops the machine by an M word, so that the wire can be taken out.
    pub fn stops(&self) -> bool {
        let stops = |line: &String| {
            line.as_bytes()
                .windows(2)
                .any(|pair| matches!(pair, [b'M' | b'm', digit] if digit.is_ascii_digit()))
        };
        self.pause.iter().any(stops)
    }

    /// The profile of a name: a user's, laid over its base, or one that ships. The error says which there are.
    pub fn of(
        name: &str,
        own: Option<&BTreeMap<String, ProfileSettings>>,
    ) -> Result<Profile, String> {
        let mine = own.and_then(|own| own.get(name));
        let base = mine.and_then(|mine| mine.base.as_deref());
        let shipped = match (mine, base) {
            (None, _) => SHIPPED.get(name),
            (Some(_), Some(base)) => SHIPPED.get(base),
            (Some(_), None) => SHIPPED.get(name).or(SHIPPED.get(DEFAULT_PROFILE)),
        };
        let Some(shipped) = shipped else {
            let mut names: Vec<&str> = shipped_profiles().collect();
            names.extend(
                own.into_iter()
                    .flat_map(|own| own.keys().map(String::as_str)),
            );
            names.sort_unstable();
            names.dedup();
            return Err(format!(
                "there is no profile {:?}, expected {}",
                base.unwrap_or(name),
                names.join(", ")
            ));
        };
        let set = mine.map_or_else(|| shipped.clone(), |mine| shipped.overlaid(mine));
        Ok(Profile {
            name: name.into(),
            coordinates: set.coordinates.unwrap_or_default(),
            zero: set.zero.unwrap_or_default(),
            unit: set.unit.unwrap_or_default(),
            decimals: match set.unit.unwrap_or_default() {
                NumberUnit::Mm => set.decimals.unwrap_or(*DECIMALS.start()),
                NumberUnit::Um => *DECIMALS.start(),
            },
            center: set.center.unwrap_or_default(),
            full_circles: set.full_circles.unwrap_or(false),
            modal: set.modal.unwrap_or(false),
            spaces: set.spaces.unwrap_or(true),
            numbers: set.numbers.unwrap_or(0),
            line_end: set.line_end.unwrap_or_default(),
            begin: set.begin.unwrap_or_default(),
            contour_begin: set.contour_begin.unwrap_or_default(),
            contour_end: set.contour_end.unwrap_or_default(),
            pause: set.pause.unwrap_or_else(|| vec!["M00".into()]),
            end: set.end.unwrap_or_else(|| vec!["M02".into()]),
        })
    }
}

impl Default for Profile {
    fn default() -> Self {
        Profile::of(DEFAULT_PROFILE, None).unwrap_or_else(|_| Profile {
            name: DEFAULT_PROFILE.into(),
            coordinates: Coordinates::default(),
            zero: Zero::default(),
            unit: NumberUnit::default(),
            decimals: *DECIMALS.start(),
            center: CenterRule::default(),
            full_circles: false,
            modal: false,
            spaces: true,
            numbers: 0,
            line_end: LineEnd::default(),
            begin: Vec::new(),
            contour_begin: Vec::new(),
            contour_end: Vec::new(),
            pause: vec!["M00".into()],
            end: vec!["M02".into()],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Effective, from_toml};
    use super::*;

    #[test]
    fn shipped_profiles_are_read_without_a_fault() {
        let (_, errors) = from_toml(include_str!("profiles.toml"));
        assert_eq!(errors, []);
        assert_eq!(
            shipped_profiles().collect::<Vec<_>>(),
            ["fast-wire", "generic", "robofil"]
        );
        assert_eq!(Profile::default().name, "generic");
    }

    #[test]
    fn a_users_profile_lies_over_its_base() {
        let text = "[program]\nprofile = \"mine\"\n[profiles.mine]\nbase = \"robofil\"\nnumbers = 10\nend = [\"M30\"]\n";
        let (settings, errors) = from_toml(text);
        assert_eq!(errors, []);
        let profile = Effective::of(&settings).profile.unwrap();
        assert_eq!(
            (profile.name.as_str(), profile.numbers, profile.center),
            ("mine", 10, CenterRule::Absolute)
        );
        assert_eq!(
            (profile.end, profile.begin.len()),
            (vec!["M30".to_string()], 3)
        );
    }

    #[test]
    fn a_misfit_is_named_with_its_place() {
        let check = |line: &str, place: &str, expected: &str| {
            let text = format!("[profiles.mine]\nspaces = false\n{line}\n");
            let (settings, errors) = from_toml(&text);
            let [error] = errors.as_slice() else {
                panic!("{line}: {errors:?}")
            };
            assert!(error.message.contains(expected), "{}", error.message);
            assert_eq!(&text[error.range.clone().unwrap()], place);
            assert_eq!(
                settings.profiles.unwrap()["mine"].spaces,
                Some(false),
                "{line}"
            );
        };
        check(
            "decimals = 2",
            "2",
            "profiles.mine.decimals is 2, expected a whole number from 3 to 6",
        );
        check(
            "center = \"radius\"",
            "\"radius\"",
            "expected one of start-to-center, center-to-start, absolute",
        );
        check(
            "begin = [\"G92 X{z}\"]",
            "\"G92 X{z}\"",
            "profiles.mine.begin[0] holds {z}, expected {x}, {y} or {side}",
        );
        check("end = \"M02\"", "\"M02\"", "expected a list of lines");
        check(
            "begin = [\"G90\\nG91\"]",
            "\"G90\\nG91\"",
            "expected one line",
        );
        check(
            "base = \"agie\"",
            "\"agie\"",
            "expected fast-wire, generic, robofil",
        );
        check("speed = 1", "speed", "profiles.mine.speed is not known");
        check(
            "[program]\nprofile = \"mina\"",
            "\"mina\"",
            "program.profile is \"mina\", expected fast-wire, generic, mine, robofil",
        );
    }
}
