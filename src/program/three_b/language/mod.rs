//! What an editor asks about 3B text alone: its pieces, its layouts.
//!
//! What hangs on the machine's way, whatever the language, is in [`crate::program::language`].

mod format;
mod pieces;

pub use format::format;
