//! What an editor asks about a program: the machine's way in words, contours, numbers, layouts.
//!
//! Functions of a document, without a protocol: places are bytes. What hangs on the machine's way is asked of its trace and is the
//! same for every language; what the pieces of a line are and mean is told by the language itself, through `words`.

mod folding;
mod format;
mod hints;
mod hover;
mod navigation;
mod numbers;
mod refactorings;
mod selection;
mod sentences;
mod symbols;
#[cfg(test)]
mod tests;
mod words;
mod writing;

pub use folding::{Fold, folds};
pub use format::format;
pub use hints::{HINT_LINES, Hint, hints};
pub use hover::{Hover, hover};
pub use navigation::{highlights, match_of, pauses};
pub use numbers::{number_at, renamed};
pub use refactorings::{refactorings, scaled};
pub use selection::selections;
pub use symbols::{Symbol, SymbolKind, symbols};
pub use words::{Part, WordKind, words_of};
pub use writing::{Completion, Signature, completions, signature};
