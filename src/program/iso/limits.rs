//! The settings that decide what is a fault of an ISO program.

use super::block::{Block, Code, Note, Register, Stop, read_line};
use super::moves::CenterRule;
use crate::settings::{Effective, NumberUnit, Profile, UnitSetting, shipped_profiles};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;
use std::sync::LazyLock;

/// The settings that decide what is a fault, and what follows from them.
#[derive(Clone, Debug)]
pub(crate) struct Limits {
    pub(crate) settings: Effective,
    /// The word that ends a program of the settings' profile.
    pub(crate) end: String,
    /// Words that profiles write: a user with a profile for a machine knows their meaning there.
    pub(crate) known: BTreeSet<Code>,
}

impl Limits {
    pub(crate) fn of(settings: &Effective) -> Limits {
        Limits {
            settings: settings.clone(),
            end: end_word(settings),
            known: known_words(settings),
        }
    }

    pub(crate) fn profile(&self) -> Option<&Profile> {
        self.settings.profile.as_ref().ok()
    }

    /// A program without a stated unit is in inches.
    pub(crate) fn inch(&self) -> bool {
        self.settings.program_units == Some(UnitSetting::Inch)
    }

    /// The profile of the settings writes whole micrometres.
    pub(crate) fn writes_micrometres(&self) -> bool {
        let unit = self.profile().map(|profile| profile.unit);
        unit == Some(NumberUnit::Um)
    }

    /// The meaning of I and J where full circles alone leave it open.
    pub(crate) fn center(&self) -> CenterRule {
        let center = self.profile().map(|profile| profile.center);
        center.unwrap_or(CenterRule::StartToCenter)
    }

    /// The lines of the settings' profile, except those that move the wire.
    pub(crate) fn lines(&self) -> impl Iterator<Item = &str> {
        self.profile()
            .into_iter()
            .flat_map(lines_of)
            .map(String::as_str)
    }
}

fn lines_of(profile: &Profile) -> impl Iterator<Item = &String> {
    [
        &profile.begin,
        &profile.contour_begin,
        &profile.contour_end,
        &profile.pause,
        &profile.pause_between_passes,
        &profile.end,
    ]
    .into_iter()
    .flatten()
}

static SHIPPED_WORDS: LazyLock<BTreeSet<Code>> = LazyLock::new(|| {
    shipped_profiles()
        .filter_map(|name| Profile::of(name, None).ok())
        .flat_map(|profile| words_of_profile(&profile))
        .collect()
});

fn known_words(settings: &Effective) -> BTreeSet<Code> {
    let own = settings.profile.iter().flat_map(words_of_profile);
    SHIPPED_WORDS.iter().copied().chain(own).collect()
}

/// A line of a profile, as a control may read it.
pub(super) fn example_of(line: &str, register: &str) -> String {
    let line = line.replace("{register}", register);
    line.replace("{side}", "G41").replace(['{', '}'], " ")
}

/// The words of a profile's lines that depend on the machine.
fn words_of_profile(profile: &Profile) -> Vec<Code> {
    let mut codes = Vec::new();
    for line in lines_of(profile) {
        read_line(example_of(line, &profile.register).as_bytes(), 1, |note| {
            if let Note::Foreign { code, .. } = note {
                codes.push(code);
            }
        });
    }
    codes
}

/// M02 or M30, as in the settings' profile.
fn end_word(settings: &Effective) -> String {
    let lines = settings.profile.iter().flat_map(|profile| &profile.end);
    let mut ends = lines.filter(|line| Block::of(line.as_bytes()).stop == Some(Stop::End));
    ends.next_back()
        .map_or_else(|| "M02".into(), |line| line.trim().into())
}

/// The last value of each place of the control's table, nm.
pub(crate) type Table = FxHashMap<Register, i64>;
