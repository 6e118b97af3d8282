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
        self.with(other, |own, other| own + other, 1.0)
    }

    pub(super) fn minus(self, other: Against) -> Against {
        self.with(other, |own, other| own - other, -1.0)
    }

    fn with(self, other: Against, counts: impl Fn(u32, u32) -> u32, sign: f64) -> Against {
        Against {
            hard: counts(self.hard, other.hard),
            soft: self.soft + sign * other.soft,
            vague: self.vague + sign * other.vague,
            open: counts(self.open, other.open),
            beside: counts(self.beside, other.beside),
            unlike: counts(self.unlike, other.unlike),
            back: counts(self.back, other.back),
            slits: counts(self.slits, other.slits),
            radiusless: counts(self.radiusless, other.radiusless),
        }
    }
}
