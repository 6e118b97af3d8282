//! `units`, as far as the contours show it: sizes that no wire cuts suggest a wrong unit.
//!
//! The reader reports a file that states no unit at all. There is no fix: only the author knows what the drawing means.

use crate::geometry::Bounds;

/// A contour longer or wider than this many mm fits on no machine: the travel of the largest is about a third of it.
const LARGEST_MM: f64 = 5000.0;
/// Where no contour is larger than this many mm, the whole drawing is smaller than twice the thinnest wire.
const SMALLEST_MM: f64 = 0.05;

/// The larger side of a contour's box, drawing units.
pub(crate) fn size(bounds: &Bounds) -> f64 {
    bounds.width().max(bounds.height())
}

/// True for a contour whose size is absurd at `unit_mm`.
pub(crate) fn is_vast(bounds: &Bounds, unit_mm: f64) -> bool {
    size(bounds) * unit_mm > LARGEST_MM
}

/// True for a contour that the drawing needs: one large enough to be cut.
pub(crate) fn is_sizable(bounds: &Bounds, unit_mm: f64) -> bool {
    size(bounds) * unit_mm >= SMALLEST_MM
}
