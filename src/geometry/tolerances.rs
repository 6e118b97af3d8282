//! The absolute tolerances, named once and passed down.

/// Absolute tolerances in millimetres; `Tolerances::in_units` turns them into drawing units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// Two end points closer than this belong together when entities are chained.
    pub join: f64,
    /// Closer than this they belong together whatever else is near: at most what `join` is where nobody has set it.
    pub(crate) certain: f64,
    /// A radius no further than this below the correction is rounding, not a fault.
    pub(crate) report: f64,
    /// Smaller differences cannot be measured on the part, and warnings ignore them.
    pub(crate) resolution: f64,
    /// The largest distance of a fitted arc from its curve.
    pub(crate) arc_fit: f64,
    /// Two entities within this of each other lie in the same place.
    pub(crate) same_place: f64,
    /// Two outlines nearer than this touch.
    pub(crate) touch: f64,
    /// Controllers stumble over a segment shorter than this.
    pub(crate) short: f64,
    /// Chords whose corners lie this near to one circle stand for an arc.
    pub(crate) chords: f64,
    /// The path of the wire takes chords that lie as near to an arc for that arc; 0: none.
    pub(crate) chord_fit: f64,
    /// A segment shorter than this has no direction.
    pub(crate) zero_length: f64,
    /// How deep a new arc's disc may dip into a neighbour before the arc counts as cutting it.
    pub(crate) clearance: f64,
    /// An arc that rises less than this above its chord is a line: its bulge is rounding, and its radius means nothing.
    pub(crate) flat: f64,
}

impl Default for Tolerances {
    fn default() -> Self {
        Tolerances {
            join: 0.01,
            certain: 0.01,
            report: 1e-6,
            resolution: 1e-3,
            arc_fit: 1e-3,
            same_place: 0.005,
            short: 0.005,
            chords: 0.002,
            chord_fit: 0.0,
            touch: 1e-3,
            zero_length: 1e-9,
            clearance: 1e-7,
            flat: 1e-6,
        }
    }
}

impl Tolerances {
    /// The same tolerances in a drawing whose unit is `unit_mm` millimetres.
    pub(crate) fn in_units(self, unit_mm: f64) -> Tolerances {
        Tolerances {
            join: self.join / unit_mm,
            certain: self.certain / unit_mm,
            report: self.report / unit_mm,
            resolution: self.resolution / unit_mm,
            arc_fit: self.arc_fit / unit_mm,
            same_place: self.same_place / unit_mm,
            touch: self.touch / unit_mm,
            short: self.short / unit_mm,
            chords: self.chords / unit_mm,
            chord_fit: self.chord_fit / unit_mm,
            zero_length: self.zero_length / unit_mm,
            clearance: self.clearance / unit_mm,
            flat: self.flat / unit_mm,
        }
    }
}
