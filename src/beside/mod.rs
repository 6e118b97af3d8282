//! A program beside its drawing: which blocks do not follow the drawing's contours, and by how much.
//!
//! [`Traced`] is all that is taken of a program, [`Drawn`] of a drawing. [`compare`] writes the drawing's program anew: one of ours is known block
//! by block (`own`). For any other it lays the wire's ways round the contours
//! (`rounds`) at the corrections that the settings give or that the program itself speaks for (`infer`), finds where the program
//! lies on the drawing (`anchor`), and goes along both at once (`walk`); what that is unsure of is asked the other way round: does every
//! block lie on the drawing (`members`), or all but one (`single`)? A program may leave out contours, begin anywhere, go either
//! way round, cut in several passes and leave a tab. Everything is in µm.

mod anchor;
mod comparison;
mod drawn;
mod findings;
mod goes;
mod infer;
mod matching;
mod members;
mod names;
mod own;
mod pose;
mod rounds;
mod single;
mod traced;
mod walk;

pub use comparison::{Comparison, Difference, DifferenceKind};
pub use drawn::Drawn;
pub use findings::{Beside, Partner, of_drawing, of_program};
pub use names::{Named, drawing_named, head_of, name_of, plain, programs_beside};
pub use own::compare;
pub use traced::Traced;

/// How far a block may lie from where the drawing has it, µm.
pub const TOLERANCE: f64 = 2.0;
/// How near a place of the program lies to that of the drawing which it is, µm.
const REACH: f64 = 2.5;
/// Blocks that lead from one pass to the next, at most.
const BETWEEN: usize = 6;
/// What is less is covered, µm.
const COVERED: f64 = 5.0;
