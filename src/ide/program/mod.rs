//! What an editor asks about a program: the machine's way in words, contours, numbers, layouts.
//!
//! Functions of a document, without a protocol: places are bytes. What hangs on the machine's way is asked of its trace and is the
//! same for every language; what the pieces of a line are and mean is told by the language itself, through `words`.

mod folding;
mod hints;
mod hover;
mod iso;
mod navigation;
mod numbers;
mod selection;
mod sentences;
mod symbols;
#[cfg(test)]
mod tests;
mod three_b;
mod words;
mod writing;

pub use folding::folds;
pub use hints::hints;
pub use hover::hover;
pub use navigation::{highlights, match_of, pauses};
pub use numbers::{number_at, renamed};
pub use selection::selections;
pub use symbols::{Symbol, SymbolKind, symbols};
pub use words::{Part, WordKind, words_of};
pub use writing::{Signature, completions, signature};
