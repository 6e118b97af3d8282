//! Every sentence that a person reads, in every language: one file a language, and nothing of the house but text.
//!
//! A sentence has a name and takes what it speaks of; the rooms say `say!` with both and hold no wording of their own:
//!
//! ```text
//! en.rs      no_such_layer(layer, names) => "there is no layer {layer:?}, expected {names}";
//! a room     say!(no_such_layer, layer, names.join(", "))          a `String`
//! en.rs      no_drawing => "there is no drawing in it";
//! a room     say!(no_drawing)                                      a `&'static str`
//! ```
//!
//! - What a sentence takes is shown as `format!` shows it, `{layer:?}` and `{length:.3}` included. Where the wording hangs on a number or
//!   on a choice (a plural, a case), the row is a function: `errors(count: usize) => { … }`. Words that are no text of ours (keys, names
//!   of rules, file endings, letters of a program) are handed in and never translated.
//! - `en.rs` says which sentences there are (`declare!`). Another language is a file with the same rows under `translate!`, its line
//!   in [`Language`], and its arm in `call!`; a row that it lacks does not compile.
//! - A process speaks one language: an editor starts a server of its own, and a command is one person's. [`speak`] chooses it before
//!   anything is read, since readers put their sentences into what they find.
//! - Lines of the log, what a bug says before it stops (`expect`), and the help of the command line, which `clap` takes from the comments
//!   of its options, stand where they are. `tests/messages.rs` finds other sentences that stand elsewhere.

#[macro_use]
mod table;
mod en;
mod readable;

pub(crate) use en::said;
pub use readable::{is_hidden, readable};

use std::fmt::{Debug, Display};
use std::sync::atomic::{AtomicU8, Ordering};

/// What a sentence may speak of: whatever can be shown.
pub(crate) trait Shown: Display + Debug {}
impl<T: Display + Debug> Shown for T {}

/// The languages in which sentences are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Language {
    #[default]
    English,
}

impl Language {
    /// Every language, in the order of their numbers.
    pub const ALL: [Language; 1] = [Language::English];
}

static SPOKEN: AtomicU8 = AtomicU8::new(Language::English as u8);

/// From now on sentences are made in this language.
pub fn speak(language: Language) {
    SPOKEN.store(language as u8, Ordering::Relaxed);
}

/// The language in which sentences are made.
pub fn spoken() -> Language {
    let index = usize::from(SPOKEN.load(Ordering::Relaxed));
    Language::ALL.get(index).copied().unwrap_or_default()
}
