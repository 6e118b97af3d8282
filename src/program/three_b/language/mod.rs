//! What an editor asks about 3B text alone: its pieces, what they mean, its layouts.
//!
//! What hangs on the machine's way, whatever the language, is in [`crate::program::language`].

mod format;
mod meaning;
mod pieces;

pub use format::format;
pub use meaning::meaning;
pub use pieces::{Field, Piece, pieces};
