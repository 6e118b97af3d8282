//! The wire sides that a program may have been written with, for contours that state none.

use crate::drawing::{Drawing, Outline, Role, winding_of};
use crate::geometry::Bounds;

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

/// The outlines with these sides in place of unknown ones.
pub(super) fn sided(drawing: &Drawing, outlines: &[Outline], sides: Sides) -> Vec<Outline> {
    let mut all = outlines.to_vec();
    let of = |outline: &Outline| {
        let own = outline.contour.segments(drawing);
        let own: Vec<_> = own.map(|segment| segment.geometry).collect();
        let mut bounds = Bounds::EMPTY;
        own.iter()
            .for_each(|segment| bounds.merge(&segment.bounds()));
        (own, bounds)
    };
    let is_nested = sides == Sides::Nested && all.len() <= MOST;
    let shapes: Vec<_> = match is_nested {
        true => outlines.iter().map(of).collect(),
        false => Vec::new(),
    };
    for (index, outline) in all.iter_mut().enumerate() {
        if outline.role != Role::Both || !outline.contour.closed {
            continue;
        }
        let holds = |other: &usize| -> bool {
            let (Some((own, inner)), Some((around, outer))) =
                (shapes.get(index), shapes.get(*other))
            else {
                return false;
            };
            let Some(first) = own.first().filter(|_| outlines[*other].contour.closed) else {
                return false;
            };
            let point = first.point_at(0.5);
            outer.merged(inner) == *outer
                && outer != inner
                && winding_of(around.iter().copied(), point) != 0
        };
        let depth = (0..shapes.len()).filter(holds).count();
        outline.role = match sides {
            Sides::All(role) => role,
            _ if depth % 2 == 1 => Role::Opening,
            _ => Role::Punch,
        };
    }
    all
}
