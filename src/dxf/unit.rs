//! The unit that a drawing states, and the tolerance of fitted arcs in it.

use crate::drawing::Unit;
use crate::finding::Severity;
use crate::geometry::Tolerances;

/// The setting for fitted arcs in drawing units. A drawing without a stated unit may be in inches.
pub(super) fn fit_tolerance(arc_fit: Option<f64>, unit: Option<Unit>) -> f64 {
    arc_fit.unwrap_or(Tolerances::default().arc_fit) / unit.unwrap_or(Unit::INCH).mm
}

/// The unit of a value of `$INSUNITS` (DXF reference, HEADER section); `None` where it is not a length.
pub(crate) fn unit_of(insunits: i32) -> Option<Unit> {
    let mm = match insunits {
        1 => 25.4,
        2 => 304.8,
        3 => 1_609_344.0,
        4 => 1.0,
        5 => 10.0,
        6 => 1000.0,
        7 => 1e6,
        8 => 25.4e-6,
        9 => 0.0254,
        10 => 914.4,
        11 => 1e-7,
        12 => 1e-6,
        13 => 1e-3,
        14 => 100.0,
        15 => 1e4,
        16 => 1e5,
        17 => 1e12,
        21 => 1200.0 / 3937.0 * 1000.0,
        _ => return None,
    };
    Some(Unit { mm })
}

/// What a HEADER states of the unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct StatedUnit {
    /// `$INSUNITS`.
    pub(super) insunits: Option<i32>,
    /// `$MEASUREMENT`: 0 for inches, 1 for millimetres. Templates leave it behind in drawings of the other kind, so it
    /// is evidence, and no unit.
    pub(super) measurement: Option<i32>,
}

impl StatedUnit {
    const INCHES: Option<i32> = Some(0);

    /// The same, and what an earlier HEADER states beside it.
    pub(super) fn or(self, earlier: StatedUnit) -> StatedUnit {
        StatedUnit {
            insunits: self.insunits.or(earlier.insunits),
            measurement: self.measurement.or(earlier.measurement),
        }
    }

    pub(super) fn unit(self) -> Option<Unit> {
        self.insunits.and_then(unit_of)
    }

    /// What is to be said of a drawing that states no unit.
    pub(super) fn doubt(self) -> Option<(Severity, String)> {
        let sentence: String = match self.insunits {
            None if self.measurement == StatedUnit::INCHES => {
                let sentence = say!(measurement_speaks_for_inches).to_owned();
                return Some((Severity::Warning, sentence));
            }
            None => say!(the_drawing_does_not_say_its_unit).into(),
            Some(0) => say!(the_drawing_says_that_it_has_no_unit).into(),
            Some(other) if unit_of(other).is_none() => {
                say!(insunits_is_no_unit_that_is_known, other)
            }
            Some(_) => return None,
        };
        Some((Severity::Information, sentence))
    }
}
