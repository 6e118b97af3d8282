//! Programs for the machine: how each language is read, judged, followed by the machine and written.
//!
//! [`Document`] is a program as the faces hold it, in any language; [`path`] is common to all languages: the machine's
//! way. Everything about one language is in its own folder.

pub(crate) mod block_words;
mod content;
mod contours;
pub mod convert;
mod cuts;
mod document;
mod edits;
mod encode;
mod format;
pub(crate) mod grid;
pub mod iso;
mod layout;
mod lookalikes;
mod mended;
mod numbering;
pub mod path;
mod profile;
mod refactor;
mod refactorings;
mod repair;
mod report;
pub(crate) mod steps;
pub mod three_b;
mod whereabouts;
pub(crate) mod write;

pub use document::{Document, Language};
pub use format::Format;
pub use layout::format;
pub use refactorings::{Offer, Proposal, offers, refactorings, scaled};
pub(crate) use whereabouts::{Stand, Whereabouts};
pub(crate) use write::{CutCorner, ProofError, ProvedProgram};
