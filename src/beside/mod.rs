//! A program beside its drawing: which blocks do not follow the drawing's contours, and by how much.
//!
//! [`Traced`] is all that is taken of a program, [`Drawn`] of a drawing. [`compare`] writes the drawing's program
//! again: a program of ours is compared block by block (`against_reference`). For any other it lays the wire's ways
//! round the contours (`rounds`) at the corrections from the settings or inferred from the program itself (`infer`),
//! finds where the program lies on the drawing (`anchor`), and goes along both at once (`walk`); what that is unsure of
//! is asked the other way round: does every block lie on the drawing (`members`), or all but one (`single`)? A program
//! may leave out contours, begin anywhere, go either way round, cut in several passes and leave a tab. Everything is in
//! µm.

mod about_stops;
mod against_reference;
mod alongside;
mod anchor;
mod begun;
mod cache;
mod compare;
mod comparison;
mod coverage;
mod difference;
mod displaced;
mod drawn;
mod edits;
mod findings;
mod followed;
mod foreign;
mod gouges;
mod guess;
mod infer;
mod matching;
mod measure;
mod members;
mod names;
mod pairs;
mod passes;
mod placed;
mod placement;
mod reference;
mod rounds;
mod said;
mod sides;
mod single;
mod tabs;
mod traced;
mod uneven;
mod verdict;
mod walk;
mod way;

pub use compare::compare;
pub use comparison::{Comparison, Difference, DifferenceKind};
pub use drawn::Drawn;
pub use findings::{Beside, Partner, of_drawing};
pub(crate) use findings::{Form, of_program};
pub(crate) use names::{Folders, HEAD, is_program, name_of};
pub use names::{Named, plain};
pub use traced::Traced;

/// The largest distance of a block from its place in the drawing, µm.
pub(crate) const TOLERANCE: f64 = 2.0;
/// The largest distance of a place of the program from its place in the drawing, µm.
const REACH: f64 = 2.5;
/// The most blocks that lead from one pass to the next.
const BETWEEN: usize = 6;
/// The most blocks of a way in and one out together that are taken for nothing else.
const LEADS: usize = 2;
/// A shorter stretch of the drawing counts as cut, µm.
const COVERED: f64 = 5.0;
