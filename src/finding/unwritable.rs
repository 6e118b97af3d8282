//! What a language cannot express of a contour: its numbers and sentences.

use super::lengths::between_walls;

told! {
    /// Why 4B, whose controller changes the radius of each arc by its correction, cannot hold a contour. Lengths and
    /// coordinates in mm.
    enum Unwritable;
    fn sentence();

    /// The wire runs inside of an arc of `radius`, which begins `at` and must be larger than the `correction`.
    TightArc { at: [f64; 2], radius: f64, correction: f64 }
        => say!(an_arc_that_4b_cannot_have, radius, at[0], at[1], correction);
    /// The cut begins in a corner.
    BeginsInCorner { at: [f64; 2] }
        => say!(n4b_needs_a_transition_arc_where_the_cut_begins, at[0], at[1]);
    /// A corner that turns by `turn` radians has no room for an arc of `radius` that is tangent to both its sides.
    NoTransition { at: [f64; 2], radius: f64, turn: f64 } => {
        let angle = between_walls(*turn);
        say!(n4b_needs_a_transition_arc_of_r_at_the_corner, radius, at[0], at[1], angle)
    };
}
