//! The evidence against a way, as counts and as a cost.

/// The evidence against a way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Against {
    pub(crate) hard: u32,
    pub(crate) soft: f64,
    /// The same that says which way is likelier, but not which is meant: chance makes and hides it.
    pub(crate) vague: f64,
    /// Cuts that do not close.
    pub(crate) open: u32,
    /// Cuts that close, but do not return to the thread hole.
    pub(crate) beside: u32,
    /// Cuts whose way out is not their way in backwards.
    pub(crate) unlike: u32,
    /// Places at an arc where the way goes back on itself.
    pub(crate) back: u32,
    /// Of the hard ones, lines out and back on one way, which may be a slit.
    pub(crate) slits: u32,
    /// Of the hard ones, arcs without a radius.
    pub(crate) radiusless: u32,
}

impl Against {
    pub(crate) fn cost(&self) -> f64 {
        self.soft + self.vague
    }

    /// What is reported of a way, and then what only may be.
    pub(crate) fn faults(&self) -> [u32; 2] {
        [self.hard, self.back]
    }

    pub(super) fn plus(self, other: Against) -> Against {
        Against {
            hard: self.hard + other.hard,
            soft: self.soft + other.soft,
            vague: self.vague + other.vague,
            open: self.open + other.open,
            beside: self.beside + other.beside,
            unlike: self.unlike + other.unlike,
            back: self.back + other.back,
            slits: self.slits + other.slits,
            radiusless: self.radiusless + other.radiusless,
        }
    }

    pub(super) fn minus(self, other: Against) -> Against {
        Against {
            hard: self.hard - other.hard,
            soft: self.soft - other.soft,
            vague: self.vague - other.vague,
            open: self.open - other.open,
            beside: self.beside - other.beside,
            unlike: self.unlike - other.unlike,
            back: self.back - other.back,
            slits: self.slits - other.slits,
            radiusless: self.radiusless - other.radiusless,
        }
    }
}
