//! The row of a key: its name, its default, its range, and its meaning.

use super::shipped_profiles;

/// The largest number of any setting: no coordinate of a machine or drawing loses its digits beside
/// it, or becomes infinite.
pub(crate) const LARGEST: f64 = 1e12;

/// The smallest number above zero: dividing by it stays finite.
const SMALLEST: f64 = 1e-12;

/// The range of a key's numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    pub least: f64,
    /// The least number itself is allowed.
    pub is_least: bool,
    pub most: f64,
}

impl Range {
    pub(super) const ABOVE_ZERO: Range = Range {
        is_least: false,
        ..Range::FROM_ZERO
    };
    pub(super) const FROM_ZERO: Range = Range::of(0.0, f64::INFINITY);

    /// All numbers from `least` to `most`, both included.
    pub(super) const fn of(least: f64, most: f64) -> Range {
        Range {
            least,
            is_least: true,
            most,
        }
    }

    pub(super) fn holds(&self, number: f64) -> bool {
        number.abs() <= LARGEST
            && (number == 0.0 || number.abs() >= SMALLEST)
            && number <= self.most
            && (number > self.least || self.is_least && number == self.least)
    }

    /// The number that is expected in place of another.
    pub(super) fn expected(&self, instead_of: Option<f64>) -> String {
        let Range { least, most, .. } = self;
        let is_large = instead_of.is_some_and(|number| number > LARGEST && number.is_finite());
        let is_small = instead_of.is_some_and(|number| number > 0.0 && number < SMALLEST);
        match (most.is_finite(), self.is_least) {
            (false, _) if is_large => say!(a_number_up_to, LARGEST),
            (false, _) if is_small => say!(a_number_of_or_above, SMALLEST),
            (true, _) => say!(a_number_from_to, least, most),
            (false, true) => say!(a_number_of_or_above, least),
            (false, false) => say!(a_number_above, least),
        }
    }
}

/// A key as its row declares it.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// As `wedm.toml` has it: `program.lead-in`; `profiles.NAME.end` within a table by name.
    pub key: String,
    /// As TOML writes it; `None` where the key is not set by default.
    pub default: Option<String>,
    pub range: Option<Range>,
    /// The kind of its value, by the reader's method.
    pub(crate) read: &'static str,
    /// Its possible words, where they are a closed set.
    pub(crate) words: Vec<String>,
    /// The meaning of the key. The first sentence can stand alone.
    pub meaning: String,
}

impl Row {
    /// The meaning of the key, or of one of its words, in Chinese.
    pub fn in_chinese(&self, word: Option<&str>) -> Option<String> {
        let of_word = word.map(|word| format!("{} = {word}", self.key));
        let own = crate::message::meaning_in_chinese(of_word.as_deref().unwrap_or(&self.key))?;
        Some(naming_profiles(own, "、"))
    }

    /// The meaning in the language in force, without the targets of its links.
    pub fn plain_meaning(&self) -> String {
        let mut plain = String::new();
        let spoken = crate::message::meaning(&self.key);
        let meaning = spoken.map_or_else(|| self.meaning.clone(), |own| naming_profiles(own, "、"));
        let mut rest = meaning.as_str();
        while let Some((before, link)) = rest.split_once("](") {
            plain.extend(before.rsplitn(2, '[').collect::<Vec<_>>().into_iter().rev());
            rest = link.split_once(')').map_or("", |(_, behind)| behind);
        }
        plain + rest
    }

    /// The meaning of the key in short, without a full stop.
    pub fn first_sentence(&self) -> String {
        let meaning = self.plain_meaning().replace('`', "");
        let first = meaning.split('。').next().unwrap_or_default();
        let first = first.split(". ").next().unwrap_or_default();
        first.trim_end_matches(['.', ' ']).to_owned()
    }
}

/// A meaning with the names of the shipped profiles in place of `{profiles}`.
pub(super) fn naming_profiles(meaning: &str, between: &str) -> String {
    let names = || shipped_profiles().map(|name| format!("`{name}`"));
    meaning.replace("{profiles}", &names().collect::<Vec<_>>().join(between))
}
