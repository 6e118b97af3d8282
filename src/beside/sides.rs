//! The wire sides that a program may have been written with, for contours that state none.

use crate::drawing::{Drawing, Outline, Role, nesting_depths};

/// Of more contours it is not worked out which lie within others; `docs/rules/not-the-drawing.md` says so.
const MOST: usize = 500;

/// The sides of the contours that may be punch or opening.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Sides {
    AsSet,
    /// Those that lie within an odd number of others are openings, the others punches.
    Nested,
    All(Role),
}

impl Sides {
    /// The guess.
    pub(super) const GUESSED: [Sides; 3] = [
        Sides::Nested,
        Sides::All(Role::Opening),
        Sides::All(Role::Punch),
    ];
}

/// The outlines with these sides in place of unknown ones. Two that lie within `tolerance` of each other everywhere are one.
pub(super) fn sided(
    drawing: &Drawing,
    outlines: &[Outline],
    (sides, tolerance): (Sides, f64),
) -> Vec<Outline> {
    let mut all = outlines.to_vec();
    let mut depths = Vec::new();
    if sides == Sides::Nested && all.len() <= MOST {
        let contours = outlines.iter().map(|outline| &outline.contour);
        let contours = contours.map(|contour| (contour, contour.bounds(drawing)));
        depths = nesting_depths(drawing, &contours.collect::<Vec<_>>(), tolerance);
    }
    for (index, outline) in all.iter_mut().enumerate() {
        if outline.role != Role::Both || !outline.contour.closed {
            continue;
        }
        outline.role = match sides {
            Sides::All(role) => role,
            _ if depths.get(index).is_some_and(|depth| depth % 2 == 1) => Role::Opening,
            _ => Role::Punch,
        };
    }
    all
}
