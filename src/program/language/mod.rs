//! What an editor asks about a program: the machine's way in words, contours, numbers, layouts.
//!
//! Functions of a document, without a protocol: places are bytes. What hangs on the machine's way is asked of its trace and is the
//! same for every language; what a language alone knows stands in its own folder.

mod format;

pub use format::format;
