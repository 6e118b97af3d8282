//! The number of an angle by which a word tilts the wire.

use crate::program::iso::word::Number;

/// No machine leans its wire by more degrees.
pub(crate) const STEEPEST: f64 = 60.0;

/// Whole numbers below this many degrees may be meant as degrees.
const FINE: f64 = 0.1;

/// An angle that is hardly meant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Doubtful {
    /// Line of the text, from 0.
    pub(crate) line: usize,
    pub(crate) degrees: f64,
    /// Steeper than any machine leans its wire, and not followed; else one of a few thousandths of a degree, written without a point.
    pub(crate) is_steep: bool,
}

/// An angle: degrees, or thousandths of one where whole numbers are fine; and whether it is hardly meant.
pub(super) fn degrees(number: Number, is_fine: bool, line: usize) -> (f64, Option<Doubtful>) {
    let degrees = number.mantissa as f64 / 10_f64.powi(i32::from(number.decimals));
    let is_whole = !number.point && is_fine;
    let degrees = match is_whole {
        true => degrees / 1000.0,
        false => degrees,
    };
    let is_steep = degrees.abs() > STEEPEST;
    let is_doubtful = is_steep || is_whole && degrees != 0.0 && degrees.abs() < FINE;
    let doubtful = is_doubtful.then_some(Doubtful {
        line,
        degrees,
        is_steep,
    });
    (degrees, doubtful)
}
