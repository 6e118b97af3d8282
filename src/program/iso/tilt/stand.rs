//! Whether the wire stands upright after lines that do not move it.

use super::words::Words;
use crate::program::iso::word::Number;

/// How lines of words have the wire stand.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::program::iso) struct Stand {
    /// G51 or G52 is in force.
    is_aside: bool,
    /// The angle in force is 0.
    is_without_angle: bool,
    /// The upper guide is beside the lower one.
    guide: [bool; 2],
    /// The upper end has a way of its own.
    has_second: bool,
}

impl Stand {
    /// True where the wire leans on a move after this line.
    pub(in crate::program::iso) fn leans_after(&mut self, line: &[u8]) -> bool {
        let said = Words::of(line);
        let is_zero = |number: Number| number.mantissa == 0;
        if said.upright {
            self.is_aside = false;
        }
        let switches = said.side.is_some() || said.upright;
        self.is_aside |= said.side.is_some();
        let angle = said.angle.or(said.tool.filter(|_| said.side.is_some()));
        if let Some(angle) = angle {
            self.is_without_angle = is_zero(angle);
        }
        let guide = said.guide.into_iter().filter(|_| !switches);
        for (beside, number) in self.guide.iter_mut().zip(guide) {
            *beside = number.map_or(*beside, |number| !is_zero(number));
        }
        self.has_second |= said.second.is_some();
        self.is_aside && !self.is_without_angle || self.guide != [false; 2] || self.has_second
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_tilt_the_wire_until_others_stand_it_upright() {
        for (lines, leans) in [
            (&["G51 A3."][..], true),
            (&["G52 T2."], true),
            (&["G51"], true),
            (&["G141 A1."], true),
            (&["G51 A3.", "G50"], false),
            (&["G51 A0."], false),
            (&["G50"], false),
            (&["U1. V0."], true),
            (&["U1.", "U0."], false),
            (&["T84", "M80", "A3."], false),
            (&["X0. Y0. : X1. Y0."], true),
        ] {
            let mut stand = Stand::default();
            let ends = lines.iter().map(|line| stand.leans_after(line.as_bytes()));
            assert_eq!(ends.last(), Some(leans), "{lines:?}");
        }
    }
}
