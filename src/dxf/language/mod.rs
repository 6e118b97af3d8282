//! What an editor asks about DXF text: what a code means, what stands where, what names what.
//!
//! Functions of a document or of its text, without a protocol: places are bytes. What looks at the neighbourhood of a place
//! reads the text from the beginning of its record; what looks at everything takes a text only, so that it can run beside
//! the document, and stops when it is told to.

mod codes;
mod folding;
mod hover;
mod outline;
mod spot;
mod symbols;

pub use folding::{Fold, folds};
pub use hover::{Hover, hover};
pub use outline::{ContourNote, Node, NodeKind, Stop, outline};
pub use symbols::{GROUPED_ABOVE, symbols};
