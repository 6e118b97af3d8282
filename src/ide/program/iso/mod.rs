//! What an editor asks about ISO text alone: what its words mean, what can follow, which words belong together.
//!
//! What hangs on the machine's way, whatever the language, is in [`crate::ide::program`].

mod completion;
mod matching;
mod meaning;
mod signature;
#[cfg(test)]
mod tests;

pub use completion::completions;
pub use matching::partner;
pub use meaning::meaning;
pub use signature::signature;
