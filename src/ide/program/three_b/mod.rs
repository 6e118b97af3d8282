//! What an editor asks about 3B text alone: its pieces, what they mean, what can follow, its layouts.
//!
//! What hangs on the machine's way, whatever the language, is in [`crate::ide::program`].

mod completion;
mod meaning;
mod signature;

pub(crate) use completion::completions;
pub(crate) use meaning::meaning;
pub(crate) use signature::signature;
