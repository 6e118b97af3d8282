//! The style of a program, found from its lengths.

use super::Style;
use crate::program::iso::document::Document;
use crate::settings::NumberUnit;

/// Lines with coordinates that are read to find whether trailing zeros are written.
const LOOKED_AT: usize = 200;

/// Decimals that are written where the program needs fewer, for mm and inches: about a micrometre each.
const LEAST_DECIMALS: [u8; 2] = [3, 5];

/// Decimals for which a step is a whole number of nm, for mm and inches.
const MOST_DECIMALS: [u8; 2] = [6, 5];

impl Style {
    /// The style of a program, for numbers in inches or millimetres.
    pub(crate) fn of(document: &Document, inch: bool) -> Style {
        let profile = document.control.limits.profile();
        // Where the program has no lengths yet, the profile decides.
        let fine = match document.evidence().numbers {
            0 => profile.is_some_and(|profile| profile.unit == NumberUnit::Um),
            _ => document.reading().whole_numbers_are_fine,
        };
        let unit = usize::from(inch);
        let decimals = document
            .evidence()
            .decimals()
            .clamp(LEAST_DECIMALS[unit], MOST_DECIMALS[unit]);
        let (mut looked_at, mut padded) = (0, true);
        for line in 0..document.text().line_count() {
            let block = document.block(line);
            for number in [block.x, block.y, block.i, block.j].into_iter().flatten() {
                padded &= number.decimals == decimals;
                looked_at += 1;
            }
            if !padded || looked_at >= LOOKED_AT {
                break;
            }
        }
        Style {
            fine,
            decimals,
            padded: padded || looked_at == 0,
            bare: looked_at > 0 && document.evidence().with_point == 0,
            inch,
        }
    }
}
