//! Lengths and angles as people read them.

/// How a finding is worded: the unit of its lengths and the tool. A plain number is a unit, with a
/// wire as the tool.
#[derive(Clone, Copy, Debug)]
pub struct Telling {
    /// mm of the drawing's unit.
    pub unit_mm: f64,
    /// An electrode cuts, not a wire.
    pub mills: bool,
}

impl From<f64> for Telling {
    fn from(unit_mm: f64) -> Telling {
        Telling {
            unit_mm,
            mills: false,
        }
    }
}

impl Telling {
    /// A length of the drawing, as people read it.
    pub(super) fn mm(self, length: f64) -> String {
        mm(length * self.unit_mm)
    }

    /// The name of the cutting tool, for use within a sentence.
    pub(super) fn tool(self) -> &'static str {
        match self.mills {
            true => say!(the_electrode_that_mills),
            false => say!(the_wire_that_cuts),
        }
    }
}

/// A length in mm with three decimals, or with as many as its first digit needs.
pub(super) fn mm(length: f64) -> String {
    let places = if length != 0.0 && length.abs() < 0.0005 {
        6
    } else {
        3
    };
    format!("{length:.places$}")
}

/// The angle of a corner as people read it, between its walls, degrees: a contour that turns by 160° makes a point of 20°.
pub(super) fn between_walls(turn: f64) -> f64 {
    180.0 - turn.abs().to_degrees()
}

/// Two lengths in mm with as many decimals as it takes to tell them apart, at least three.
pub(super) fn told_apart(one: f64, other: f64) -> (String, String) {
    let digits = |places: usize| (format!("{one:.places$}"), format!("{other:.places$}"));
    (3..=9)
        .map(digits)
        .find(|(a, b)| a != b)
        .unwrap_or_else(|| digits(3))
}

/// What is absurd about the size of a part, mm.
pub(super) fn absurd(size: f64) -> &'static str {
    if size > 1.0 {
        say!(more_than_any_machine_travels)
    } else {
        say!(less_than_a_wire_is_thick)
    }
}
