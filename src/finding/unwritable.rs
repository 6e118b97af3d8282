//! What a language cannot express of a contour, as numbers; [`crate::message`] has the sentence.

/// Why 4B, whose controller changes the radius of each arc by its correction, cannot hold a contour. Lengths and
/// coordinates in mm.
#[derive(Clone, Debug, PartialEq)]
pub enum Unwritable {
    /// The wire runs inside of an arc of `radius`, which begins `at` and must be larger than the `correction`.
    TightArc {
        at: [f64; 2],
        radius: f64,
        correction: f64,
    },
    /// The cut begins in a corner.
    BeginsInCorner { at: [f64; 2] },
    /// A corner that turns by `turn` radians has no room for an arc of `radius` that is tangent to both its sides.
    NoTransition {
        at: [f64; 2],
        radius: f64,
        turn: f64,
    },
}
