//! Every sentence that a person reads, in every language: one folder a language, and nothing in them but text.
//!
//! A sentence has a name and takes what it is about; the rooms call `say!` with both and hold no wording of their own:
//!
//! ```text
//! en/        no_such_layer(layer, names) => "there is no layer {layer:?}, expected {names}";
//! a room     say!(no_such_layer, layer, names.join(", "))          a `String`
//! en/        no_drawing => "there is no drawing in it";
//! a room     say!(no_drawing)                                      a `&'static str`
//! ```
//!
//! - What a sentence takes is shown as `format!` shows it, `{layer:?}` and `{length:.3}` included, but that nothing is −0.000. Where the wording depends on a number or
//!   on a choice (a plural, a case), the row is a function: `errors(count: usize) => { … }`. Words
//!   that are not text of ours (keys, names of rules, file extensions, letters of a program) are
//!   handed in and never translated.
//! - `en/` says which sentences there are (`declare!`), a file for each room. Another language is a folder with the same rows under
//!   `translate!`, its line in `Language`, and its arm in `in_spoken!`; a row that it lacks does not compile.
//! - A process speaks one language: an editor starts a server of its own, and a command is one person's. `speak` chooses it before
//!   anything is read, since readers put their sentences into what they find.
//! - Two tables are keyed by other names: the help of the command line (`help.rs` of each language), and the Chinese meanings of the
//!   settings (`meanings.rs`), whose English is in their rows. Lines of the log, the reason of an `expect`, and the examples of a
//!   command stay where they are; `tests/messages.rs` finds other sentences outside.

#[macro_use]
mod table;
mod en;
mod language;
mod meanings;
mod readable;
mod zh;

pub(crate) use en::said;
pub(crate) use language::{Asker, Language, has_options, speak, speak_of_options, spoken};
pub(crate) use readable::{columns, is_hidden, readable};
pub(crate) use readable::{duration, lengths};

use std::fmt::{self, Debug, Display, Formatter};

fn help_of(language: Language) -> &'static [(&'static str, &'static str)] {
    match language {
        Language::English => en::HELP,
        Language::Chinese => zh::HELP,
    }
}

/// The help of the command line under a name, in the language in force.
pub(crate) fn help(name: &str) -> Option<&'static str> {
    let found = help_of(spoken()).iter().find(|(own, _)| *own == name);
    found.map(|(_, text)| *text)
}

#[cfg(test)]
pub(crate) fn help_names(language: Language) -> impl Iterator<Item = &'static str> {
    help_of(language).iter().map(|(name, _)| *name)
}

/// What a key of the settings means in the language that is spoken; `None` where it is English.
pub(crate) fn meaning(key: &str) -> Option<&'static str> {
    match spoken() {
        Language::English => None,
        Language::Chinese => meanings::meaning(key),
    }
}

/// What a key of the settings, or with ` = ` one of its words, means in Chinese.
pub(crate) fn meaning_in_chinese(name: &str) -> Option<&'static str> {
    meanings::meaning(name)
}

/// A help as it is shown, with what stands in it beside our own texts in the language that is spoken.
pub(crate) fn help_beside(shown: String) -> String {
    match spoken() {
        Language::English => shown,
        Language::Chinese => zh::BESIDE
            .iter()
            .fold(shown, |shown, (english, own)| shown.replace(english, own)),
    }
}

/// What a sentence may speak of: whatever can be shown.
pub(crate) trait Shown {
    fn show(&self, formatter: &mut Formatter<'_>) -> fmt::Result;
    fn quote(&self, formatter: &mut Formatter<'_>) -> fmt::Result;
}

impl<T: Display + Debug> Shown for T {
    fn show(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        Display::fmt(self, formatter)
    }

    fn quote(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        Debug::fmt(self, formatter)
    }
}

struct AsItIs<'a>(&'a dyn Shown);

impl Display for AsItIs<'_> {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        self.0.show(formatter)
    }
}

/// A number that is rounded to zero has no sign: no sentence says −0.000.
impl Display for dyn Shown + '_ {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        let Some(decimals) = formatter.precision() else {
            return self.show(formatter);
        };
        let as_it_is = AsItIs(self);
        let text = match formatter.sign_plus() {
            true => format!("{as_it_is:+.decimals$}"),
            false => format!("{as_it_is:.decimals$}"),
        };
        match text.strip_prefix('-') {
            Some(zero) if zero.bytes().all(|digit| matches!(digit, b'0' | b'.')) => {
                let sign = if formatter.sign_plus() { "+" } else { "" };
                write!(formatter, "{sign}{zero}")
            }
            _ => formatter.write_str(&text),
        }
    }
}

impl Debug for dyn Shown + '_ {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        self.quote(formatter)
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn no_sentence_says_that_nothing_is_negative() {
        let of = |x: f64, y: f64| say!(no_tab_fits_at, x, y);
        assert!(
            of(-1e-9, -0.0).contains("(0.000, 0.000)"),
            "{}",
            of(-1e-9, -0.0)
        );
        assert!(
            of(-0.0006, 1.0).contains("(-0.001, 1.000)"),
            "{}",
            of(-0.0006, 1.0)
        );
        let off = say!(the_cut_does_not_close, 0.5, -1e-9, -0.5);
        assert!(off.contains("X +0.000, Y -0.500"), "{off}");
    }
}
