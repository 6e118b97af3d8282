//! Profiles: how an ISO program is written for one kind of machine, as data.
//!
//! Shipped profiles are in `profiles.toml`, a user's in the table `[profiles.NAME]` of `wedm.toml`;
//! both are read the same way.

use super::reader::Reader;
use super::shipped::shipped;
use super::table::Overlay;
use super::{
    CenterRule, Coordinates, NumberUnit, PassFault, Profile, ProfileSettings, ProgramSettings,
    Settings, shipped_profiles,
};
use std::collections::BTreeMap;
use std::sync::LazyLock;

static SHIPPED: LazyLock<BTreeMap<String, ProfileSettings>> = LazyLock::new(|| {
    let settings: Option<Settings> = Reader::default().table("", shipped());
    settings
        .and_then(|settings| settings.profiles)
        .unwrap_or_default()
});

impl Profile {
    /// True where its pause stops the machine by an M word, so that the wire can be taken out.
    pub(crate) fn stops(&self) -> bool {
        let stops = |line: &String| {
            line.as_bytes()
                .windows(2)
                .any(|pair| matches!(pair, [b'M' | b'm', digit] if digit.is_ascii_digit()))
        };
        self.pause.iter().any(stops)
    }

    /// The profile of a name: a user's, laid over its base, or a shipped one. The error lists them.
    pub(crate) fn of(
        name: &str,
        own: Option<&BTreeMap<String, ProfileSettings>>,
    ) -> Result<Profile, String> {
        let mine = own.and_then(|own| own.get(name));
        let base = mine.and_then(|mine| mine.base.as_deref());
        let shipped = match (mine, base) {
            (None, _) => SHIPPED.get(name),
            (Some(_), Some(base)) => SHIPPED.get(base),
            (Some(_), None) => SHIPPED
                .get(name)
                .or(SHIPPED.get(&ProgramSettings::default().profile())),
        };
        let Some(shipped) = shipped else {
            let name = base.unwrap_or(name);
            return Err(say!(there_is_no_profile, name, names(own).join(", ")));
        };
        let set = mine.map_or_else(|| shipped.clone(), |mine| shipped.overlaid(mine));
        if let Some(fault) = contradiction(name, &set, mine) {
            return Err(fault.message);
        }
        let mut profile = set.filled(name.into());
        if profile.unit == NumberUnit::Um {
            profile.decimals = ProfileSettings::default().decimals();
        }
        Ok(profile)
    }
}

/// The names of all profiles, those that ship among them.
fn names(own: Option<&BTreeMap<String, ProfileSettings>>) -> Vec<&str> {
    let own = own.into_iter().flat_map(BTreeMap::keys);
    let mut names: Vec<&str> = own.map(String::as_str).collect();
    shipped_profiles().for_each(|name| names.push(name));
    names.sort_unstable();
    names.dedup();
    names
}

/// Under G91 there is no place that the coordinates of a centre could count from.
fn contradiction(
    name: &str,
    set: &ProfileSettings,
    mine: Option<&ProfileSettings>,
) -> Option<PassFault> {
    let contradicts =
        set.coordinates() == Coordinates::Incremental && set.center() == CenterRule::Absolute;
    let key = |key: &str| format!("profiles.{name}.{key}");
    let (center, coordinates) = (key("center"), key("coordinates"));
    let message = say!(no_absolute_center_under_g91, center, coordinates);
    let is_center = mine.is_none_or(|mine| mine.center.is_some());
    let at = if is_center { center } else { coordinates };
    contradicts.then(|| PassFault::of(at, message))
}

/// A profile of a name that none has, and own ones that contradict themselves.
pub(super) fn faults(settings: &Settings) -> Vec<PassFault> {
    let own = settings.profiles.as_ref();
    let named = settings
        .program
        .as_ref()
        .and_then(|program| program.profile.as_ref());
    let known = names(own);
    let unknown = named
        .filter(|name| !known.contains(&name.as_str()))
        .map(|name| {
            let key = "program.profile";
            let found = format!("{name:?}");
            PassFault::of(
                key,
                say!(is_not_what_is_expected, key, found, known.join(", ")),
            )
        });
    let of_own = own.into_iter().flatten().filter_map(|(name, mine)| {
        let base = mine.base.as_ref().unwrap_or(name);
        let shipped = SHIPPED
            .get(base)
            .or(SHIPPED.get(&ProgramSettings::default().profile()))?;
        contradiction(name, &shipped.overlaid(mine), Some(mine))
    });
    unknown.into_iter().chain(of_own).collect()
}

impl Default for Profile {
    fn default() -> Self {
        ProfileSettings::default().filled(ProgramSettings::default().profile())
    }
}

#[cfg(test)]
mod tests {
    use super::super::{CenterRule, Effective, from_toml};
    use super::*;

    #[test]
    fn shipped_profiles_are_read_without_a_fault() {
        let (_, errors) = from_toml(include_str!("profiles.toml"));
        assert_eq!(errors, []);
        assert!(shipped_profiles().any(|name| name == "generic"));
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
        let mut shipped: Vec<&str> = shipped_profiles().collect();
        shipped.sort_unstable();
        let mut known = [&shipped[..], &["mine"]].concat();
        known.sort_unstable();
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
            "profiles.mine.begin[0] holds {z}, expected {x}, {y}, {side} or {register}",
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
            &format!("expected {}", shipped.join(", ")),
        );
        check("speed = 1", "speed", "profiles.mine.speed is not known");
        let no_center = "under G91 a centre has no coordinates of its own";
        check(
            "coordinates = \"incremental\"\ncenter = \"absolute\"",
            "\"absolute\"",
            no_center,
        );
        check(
            "base = \"robofil\"\ncoordinates = \"incremental\"",
            "\"incremental\"",
            no_center,
        );
        check(
            "base = \"fast-wire\"\ncenter = \"absolute\"",
            "\"absolute\"",
            no_center,
        );
        check(
            "[program]\nprofile = \"mina\"",
            "\"mina\"",
            &format!("program.profile is \"mina\", expected {}", known.join(", ")),
        );
    }
}
