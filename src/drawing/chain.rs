//! Chaining entities to contours by their end points.

use super::{Contour, Drawing};

/// The contours of a drawing, kept up to date edit by edit.
#[derive(Clone, Debug, Default)]
pub struct Chains {
    contours: Vec<Contour>,
}

impl Chains {
    /// Chains everything in `drawing`; `join` is the join tolerance in drawing units.
    pub fn new(_drawing: &Drawing, _join: f64) -> Chains {
        Chains::default()
    }

    /// In machining order: that of the first entity of each.
    pub fn contours(&self) -> &[Contour] {
        &self.contours
    }
}
