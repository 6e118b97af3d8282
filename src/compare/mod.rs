//! A program compared with its drawing: which blocks do not follow the drawing, and by how much.
//!
//! Two comparisons, the first that applies. *Our own* (`own`): the program is written again from the drawing under the
//! settings in force (`rewritten`); where nine blocks of ten agree, each of the others is named. *Of another writer*
//! (`foreign`): each pass lies at one offset beside one contour (`level`), and its blocks follow the way of the wire
//! round that contour (`ring`, `walk`); ways in and out are not judged. Nothing is guessed of the settings. All is in µm
//! but `Difference::off`, which is in mm.
//!
//! [`Traced`] is all that is taken of a program, [`Drawn`] of a drawing. Nothing here knows of files that are open, of
//! LSP, or of sentences.

mod aligned;
mod budget;
mod contour;
mod corrections;
mod difference;
mod drawn;
mod findings;
mod foreign;
mod judged;
mod level;
mod names;
mod own;
mod place;
mod reported;
mod rewritten;
mod ring;
mod traced;
mod walk;
mod walls;
mod ways;
mod words;

pub use crate::finding::DifferenceKind;
use budget::Budget;
pub use difference::{Comparison, Difference};
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
    compare_within(drawn, traced, budget::MOST)
}

/// The same in so many steps at most: what they do not reach is said to be [beyond](DifferenceKind::Beyond).
pub fn compare_within(drawn: &Drawn, traced: &Traced, steps: usize) -> Option<Comparison> {
    // Contours in another order are not ours, unless one of them was moved.
    let is_moved = |one: &Difference| {
        !traced.four_b && one.kind == DifferenceKind::Moved && one.off * 1e3 > walls::FARTHEST
    };
    let own = own::compare(drawn, traced, None);
    let (own, moved) = match own {
        Some(own) if own.differences.iter().any(is_moved) => (None, Some(own)),
        own => (own, None),
    };
    if own.is_some() || traced.mills {
        return own.or(moved);
    }
    let Some(seen) = foreign::compare(drawn, traced, Budget::of(steps)) else {
        return moved;
    };
    if let Some(moved) = moved {
        let is_sound = seen.comparison.differences.is_empty();
        return Some(if is_sound { seen.comparison } else { moved });
    }
    let handles = seen.handles.filter(|handles| !handles.is_empty());
    let own = handles.and_then(|handles| own::compare(drawn, traced, Some(handles)));
    let own = own.filter(|own| !own.differences.iter().any(is_moved));
    Some(own.unwrap_or(seen.comparison))
}
