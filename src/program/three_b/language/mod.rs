//! What an editor asks about 3B text alone: its pieces, what they mean, what can follow, its layouts.
//!
//! What hangs on the machine's way, whatever the language, is in [`crate::program::language`].

mod completion;
mod format;
mod meaning;
mod pieces;
mod signature;

pub use completion::completions;
pub use format::format;
pub use meaning::meaning;
pub use pieces::{Field, Piece, pieces};
pub use signature::signature;
