//! Arcs of a part's contour that the wire cannot follow at its distance: `small-radius` in programs.

/// Radii within half a µm of the correction are as large as it: programs count in µm.
const ROUNDING: f64 = 0.5;

/// Lengths of programs in those that people read.
pub(crate) const UM_IN_MM: f64 = 1000.0;

/// Whether a radius is below a correction, µm both.
pub(crate) fn is_tight(radius: f64, correction: f64) -> bool {
    radius < correction - ROUNDING
}
