//! Answers to an editor about DXF text: what a code means, what is where, which name refers to
//! what.
//!
//! Functions of a document or of its text, without a protocol: places are bytes. A function about one place reads the
//! text from the beginning of its record; a function about the whole takes only a text, so that it can run beside the
//! document, and stops when told to.

mod codes;
mod completion;
mod folding;
mod hints;
mod hover;
mod names;
mod outline;
mod records;
mod selection;
mod spot;
mod symbols;
#[cfg(test)]
mod tests;
mod tokens;

pub(crate) use completion::completions;
pub use folding::folds;
pub(crate) use hints::hints;
pub(crate) use hover::hover;
pub(crate) use names::{Name, name_at, occurrences};
pub use outline::outline;
pub(crate) use selection::selections;
pub(crate) use symbols::{notes, symbols};
pub use tokens::{tokens, tokens_in};
