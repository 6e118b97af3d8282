//! A program compared with its drawing: which blocks do not follow the drawing, and by how much.
//!
//! Two comparisons, the first that applies. *Our own* (`own`): the program is written again from the drawing under the
//! settings in force (`rewritten`); where nine blocks of ten agree, each of the others is named. *Of another writer*
//! (`foreign`): each pass lies at one offset beside one contour (`passes`), and its blocks follow the way of the wire
//! round that contour (`ring`, `walk`); ways in and out are not judged. Nothing is guessed of the settings. All is in µm
//! but `Difference::off`, which is in mm.
//!
//! [`Traced`] is all that is taken of a program, [`Drawn`] of a drawing. Nothing here knows of files that are open, of
//! LSP, or of sentences.

mod aligned;
mod basis;
mod budget;
mod difference;
mod drawn;
mod entry;
mod findings;
mod foreign;
mod leads;
mod names;
mod own;
mod passes;
mod place;
mod reported;
mod resume;
mod rewritten;
mod ring;
mod traced;
mod walk;
mod walls;
mod words;

pub use difference::{Comparison, Difference, DifferenceKind};
pub use drawn::Drawn;
pub use findings::{Beside, Partner, of_drawing};
pub(crate) use findings::{Form, of_program};
pub(crate) use names::{Folders, HEAD, is_program, name_of};
pub use names::{Named, plain};
pub use traced::Traced;

/// The largest distance of a block from its place in the drawing that is no difference.
pub(crate) const TOLERANCE: f64 = 2.0;

/// Compares a program with a drawing; `None` where nothing in it follows the drawing.
pub fn compare(drawn: &Drawn, traced: &Traced) -> Option<Comparison> {
    if let Some(comparison) = own::compare(drawn, traced, None) {
        return Some(comparison);
    }
    if traced.mills {
        return None;
    }
    let seen = foreign::compare(drawn, traced)?;
    // Of a program that cuts some of the contours, those are written again.
    let handles = seen.handles.filter(|handles| !handles.is_empty());
    let own = handles.and_then(|handles| own::compare(drawn, traced, Some(handles)));
    // In another order they are not ours.
    let is_moved = |one: &Difference| one.kind == DifferenceKind::Moved;
    let own = own.filter(|own| !own.differences.iter().any(is_moved));
    Some(own.unwrap_or(seen.comparison))
}
