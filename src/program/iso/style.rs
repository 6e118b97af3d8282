//! The number format of a program, found from its lengths: additions are written alike.

mod of_document;

use super::moves::{Place, micrometres};
use crate::geometry::{Arc, Point};
use crate::program::grid::{best_center, snap};

/// How lengths are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Style {
    /// Whole micrometres (ten-thousandths of an inch) without a point.
    fine: bool,
    decimals: u8,
    /// All numbers have as many decimals.
    padded: bool,
    /// No number has a point: those of whole units get none.
    bare: bool,
    inch: bool,
}

impl Style {
    pub(crate) fn is_inch(&self) -> bool {
        self.inch
    }

    /// The value of the last digit, nm.
    pub(crate) fn step(&self) -> i64 {
        match (self.fine, self.inch) {
            (true, false) => 1_000,
            (true, true) => 2_540,
            (false, inch) => {
                (if inch { 25_400_000 } else { 1_000_000 }) / 10_i64.pow(u32::from(self.decimals))
            }
        }
    }

    /// The nearest length that can be written, nm.
    pub(crate) fn rounded(&self, length: i64) -> i64 {
        self.steps(length).wrapping_mul(self.step())
    }

    fn steps(&self, length: i64) -> i64 {
        let half = self.step() / 2;
        (if length < 0 {
            length.wrapping_sub(half)
        } else {
            length.wrapping_add(half)
        }) / self.step()
    }

    /// The centre, µm, of an arc between two places as it can be written: as far from both as possible.
    pub(crate) fn center(&self, center: Point, from: Place, to: Place) -> Option<Place> {
        let step = self.step();
        let scale = 1e3 / step as f64;
        let [from, to] = [from, to].map(|place| micrometres(place) * scale);
        let arc = Arc::about(center * scale, from, to, true);
        let node = best_center(&arc, snap(from)?, snap(to)?);
        Some([node.x.checked_mul(step)?, node.y.checked_mul(step)?])
    }

    /// The number of a length in nm.
    pub(crate) fn number(&self, length: i64) -> String {
        let steps = self.steps(length);
        let sign = if steps < 0 { "-" } else { "" };
        let steps = steps.unsigned_abs();
        if self.fine {
            return format!("{sign}{steps}");
        }
        let per_unit = 10_u64.pow(u32::from(self.decimals));
        let text = format!(
            "{sign}{}.{:0width$}",
            steps / per_unit,
            steps % per_unit,
            width = usize::from(self.decimals)
        );
        let short = text.trim_end_matches('0');
        match (self.padded, self.bare) {
            (true, _) => text,
            (false, true) => short.trim_end_matches('.').to_owned(),
            (false, false) => short.to_owned(),
        }
    }
}
