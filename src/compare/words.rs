//! What a block of a program of ours says beside where it leads: its numbers, and the side of an arc of 4B.

use super::TOLERANCE;
use super::traced::{Block, Traced};
use crate::geometry::Vector;

/// A larger difference of a number that moves nothing is another way to say the same, µm.
const SLIP: f64 = 50.0;

/// The words of a block beside those of the rewritten one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Words {
    /// They are the same: where the block leads elsewhere, it begins elsewhere.
    pub(super) are_same: bool,
    /// The difference of one of the numbers, where all else is equal, µm.
    apart: f64,
    /// The same for the coordinates after the block.
    pub(super) stated: f64,
    /// Of an arc of 4B, whether the wire should run inside of it, where the block has it otherwise.
    pub(super) inside: Option<bool>,
}

impl Words {
    pub(super) fn of(traced: &Traced, own: &Block, rewritten: &Traced, ideal: &Block) -> Words {
        if traced.line_from(own) == rewritten.line_from(ideal) {
            return Words {
                are_same: true,
                ..Words::default()
            };
        }
        let (said, expected) = (traced.said(own), rewritten.said(ideal));
        let stated = said.stated.zip(expected.stated);
        let concave = expected.concave;
        // Where coordinates count from zero, they differ as the place does.
        let apart = said.apart(&expected).filter(|_| traced.counts);
        Words {
            are_same: said.is_like(&expected),
            apart: apart.unwrap_or(0.0),
            stated: stated.map_or(0.0, |([x, y], [ideal_x, ideal_y])| {
                (x - ideal_x).abs().max((y - ideal_y).abs())
            }),
            inside: concave.filter(|_| said.concave != concave),
        }
    }

    /// How far a block is off, µm.
    pub(super) fn off(&self, own: &Block, ideal: &Block) -> f64 {
        let way = |block: &Block| {
            let ends = block.motion.ends();
            ends.map_or(Vector::zeros(), |[start, end]| end - start)
        };
        // A line in place of an arc is off by more than rounding, wherever it ends.
        let other = || (way(own) - way(ideal)).norm().max(2.0 * TOLERANCE);
        let away = own.motion.away_from(&ideal.motion).unwrap_or_else(other);
        // Of a line X and Y say only which way it leads, in whatever numbers.
        let is_line = ideal.segment().is_none_or(|ideal| ideal.as_arc().is_none());
        match is_line && self.apart > SLIP {
            true => away,
            false => away.max(self.apart),
        }
    }
}
