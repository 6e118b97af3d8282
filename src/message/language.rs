//! The language of all sentences, and who chose it.

use std::sync::atomic::{AtomicBool, AtomicU16, Ordering};

/// The languages in which sentences are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum Language {
    #[default]
    English,
    /// Simplified, also for requests for any other kind of Chinese.
    Chinese,
}

impl Language {
    /// Every language, in the order of their numbers.
    pub(crate) const ALL: [Language; 2] = [Language::English, Language::Chinese];

    /// As `--lang` and the settings of editors name it.
    pub(crate) fn tag(self) -> &'static str {
        match self {
            Language::English => "en",
            Language::Chinese => "zh",
        }
    }

    /// Other names that `--lang` accepts.
    pub(crate) fn aliases(self) -> &'static [&'static str] {
        match self {
            Language::English => &["en-US", "en_US", "en-GB", "en_GB"],
            Language::Chinese => &["zh-CN", "zh_CN", "zh-cn", "zh-Hans", "zh_CN.UTF-8"],
        }
    }

    /// The language of a tag, whatever its region and encoding: `en`, `en-GB` of a client, `en_US.UTF-8` of an
    /// environment; `C` and `POSIX` are English. `None` for an unknown language.
    pub(crate) fn of(tag: &str) -> Option<Language> {
        let name = tag.split(['-', '_', '.', '@']).next().unwrap_or_default();
        if matches!(name, "C" | "POSIX") {
            return Some(Language::English);
        }
        Language::ALL
            .into_iter()
            .find(|language| language.tag().eq_ignore_ascii_case(name))
    }

    /// The language of the environment: the first of POSIX's variables that is set and not empty.
    pub(crate) fn of_environment(variable: impl Fn(&str) -> Option<String>) -> Option<Language> {
        let tag = ["LC_ALL", "LC_MESSAGES", "LANG"]
            .into_iter()
            .find_map(|name| variable(name).filter(|tag| !tag.is_empty()))?;
        Language::of(&tag)
    }
}

/// Who chose a language; each overrides those listed before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub(crate) enum Asker {
    Environment,
    /// `locale` of the client.
    Client,
    /// `--lang`.
    CommandLine,
}

/// The language in the low byte, its chooser in the high one.
static SPOKEN: AtomicU16 = AtomicU16::new(0);

/// Sets the language, unless a chooser of higher rank has set it.
pub(crate) fn speak(language: Language, asker: Asker) {
    let asked = u16::from(asker as u8) << 8 | u16::from(language as u8);
    let _ = SPOKEN.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |before| {
        (before >> 8 <= asked >> 8).then_some(asked)
    });
}

/// The language in which sentences are made.
pub(crate) fn spoken() -> Language {
    let index = usize::from(SPOKEN.load(Ordering::Relaxed) & 0xff);
    Language::ALL.get(index).copied().unwrap_or_default()
}

/// Whether sentences are read where options are typed: elsewhere a choice is clicked.
static HAS_OPTIONS: AtomicBool = AtomicBool::new(false);

/// Says that sentences are read on a command line.
pub(crate) fn speak_of_options() {
    HAS_OPTIONS.store(true, Ordering::Relaxed);
}

/// True where a sentence may name options.
pub(crate) fn has_options() -> bool {
    HAS_OPTIONS.load(Ordering::Relaxed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tag_says_its_language_whatever_region_and_encoding() {
        for tag in [
            "en",
            "EN",
            "en-GB",
            "en_US.UTF-8",
            "en@euro",
            "C",
            "C.UTF-8",
            "POSIX",
        ] {
            assert_eq!(Language::of(tag), Some(Language::English), "{tag}");
        }
        for tag in [
            "zh",
            "zh-CN",
            "zh-cn",
            "zh-Hans",
            "zh_CN.UTF-8",
            "zh_CN.GB18030",
            "zh-TW",
        ] {
            assert_eq!(Language::of(tag), Some(Language::Chinese), "{tag}");
        }
        for tag in ["", "tlh", "english", "_en"] {
            assert_eq!(Language::of(tag), None, "{tag}");
        }
        for language in Language::ALL {
            assert_eq!(Language::of(language.tag()), Some(language));
            assert_eq!(Language::ALL[language as usize], language);
        }
    }

    #[test]
    fn the_first_variable_that_is_not_empty_says_it() {
        let of = |set: &[(&str, &str)]| {
            let value = |name: &str| set.iter().find(|(own, _)| *own == name);
            Language::of_environment(|name| Some(value(name)?.1.to_owned()))
        };
        assert_eq!(of(&[]), None);
        assert_eq!(of(&[("LANG", "en_US.UTF-8")]), Some(Language::English));
        assert_eq!(
            of(&[("LC_ALL", ""), ("LANG", "en")]),
            Some(Language::English)
        );
        assert_eq!(
            of(&[("LC_MESSAGES", "zh_CN.UTF-8"), ("LANG", "en")]),
            Some(Language::Chinese)
        );
        assert_eq!(of(&[("LC_ALL", "tlh"), ("LANG", "zh_CN")]), None);
    }
}
