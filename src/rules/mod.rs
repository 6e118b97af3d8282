//! The rules of the wire: one folder or file each, with its check and its fix.
//!
//! A rule speaks geometry: it sees contours and gives back findings on segments and fixes as drawing edits.
//! It knows nothing of text, of protocols, or of how a sentence about it reads.

pub mod small_radius;

use crate::geometry::Tolerances;
use crate::settings::Effective;

/// What the rules measure against, in the units of one drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The largest correction of all passes.
    pub correction: f64,
    /// The smallest correction of all passes: what the last pass takes, the earlier ones need not leave.
    pub last_correction: f64,
    /// Radius that a fix gives: correction + margin.
    pub fix_radius: f64,
    /// 1-based number of the pass with the largest correction, where several are set.
    pub pass: Option<usize>,
    pub tolerances: Tolerances,
}

impl Limits {
    /// The limits of `settings` in a drawing whose unit is `unit_mm` millimetres.
    pub fn new(settings: &Effective, unit_mm: f64) -> Limits {
        Limits {
            correction: settings.correction / unit_mm,
            last_correction: settings.corrections.iter().copied().fold(settings.correction, f64::min) / unit_mm,
            fix_radius: (settings.correction + settings.margin) / unit_mm,
            pass: settings.pass,
            tolerances: settings.tolerances.in_units(unit_mm),
        }
    }
}
