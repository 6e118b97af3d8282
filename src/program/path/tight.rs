//! Arcs of a part's contour that the wire cannot follow at its distance: `small-radius` in programs.

/// Radii within half a µm of the correction are as large as it: programs count in µm.
pub(super) const ROUNDING: f64 = 0.5;

/// Lengths of programs in those that people read.
pub(crate) const UM_IN_MM: f64 = 1000.0;

/// Whether a radius is below a correction, µm both.
pub(crate) fn is_tight(radius: f64, correction: f64) -> bool {
    radius < correction - ROUNDING
}

/// Whether a 4B controller refuses an arc inside of which the wire runs: its radius, whole µm in a block, must be larger
/// than the correction.
pub(crate) fn is_tight_in_four_b(radius: f64, correction: f64) -> bool {
    radius <= correction
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arc_as_large_as_the_correction_is_tight_in_four_b_alone() {
        for (radius, correction, expected) in [
            (99.0, 100.0, [true, true]),
            (100.0, 100.0, [false, true]),
            (101.0, 100.0, [false, false]),
            (100.0, 100.6, [true, true]),
            (101.0, 100.6, [false, false]),
        ] {
            let found = [
                is_tight(radius, correction),
                is_tight_in_four_b(radius, correction),
            ];
            assert_eq!(found, expected, "{radius} {correction}");
        }
    }
}
