//! Decodes the written text and compares it with the path, block by block.

use super::block::{Motion, PartArc};
use super::encode::{Decoded, END_TOLERANCE, Encoded, alternatives, point_of};
use super::parse::{Item, read_line};
use super::words::Words;
use crate::geometry::{Segment, Vector};
use crate::program::encode::proved_aside;
use crate::program::path::tolerance;
use std::ops::Range;

/// The results for the blocks of one program so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Proof {
    /// Sum of the deviations of blocks from their nodes: the drift of a controller that only counts J, µm.
    pub(crate) drift: Vector,
    /// Largest distance of a block from its piece of the path, over its whole length, µm.
    pub(crate) deviation: f64,
    arcs: usize,
    drift_at_start: Vector,
    arcs_at_start: usize,
}

impl Proof {
    /// Takes a block, decoded from its own node, or another one for the same arc where a counting
    /// controller would otherwise drift further and further: equal arcs in a row miss their ends by
    /// the same amount. No number is above `largest`; without it there is no other one.
    pub(crate) fn taken(
        &mut self,
        encoded: Encoded,
        decoded: Decoded,
        largest: Option<i64>,
    ) -> (Encoded, Decoded) {
        let drift = self.drift - self.drift_at_start;
        let miss = |decoded: &Decoded| match decoded {
            Ok(decoded) => decoded.end() - point_of(encoded.to),
            Err(_) => Vector::new(f64::INFINITY, f64::INFINITY),
        };
        let drifted = |decoded: &Decoded| (drift + miss(decoded)).norm();
        let allowed = tolerance(self.arcs - self.arcs_at_start) / 2.0;
        let mut taken = (encoded, decoded);
        if let Some(largest) = largest.filter(|_| drifted(&taken.1) > allowed) {
            let others = alternatives(&encoded, largest).into_iter();
            let best = others.min_by(|a, b| drifted(&a.1).total_cmp(&drifted(&b.1)));
            if let Some(best) = best.filter(|(_, other)| drifted(other) < drifted(&taken.1)) {
                taken = best;
            }
        }
        self.drift += miss(&taken.1);
        self.arcs += usize::from(!matches!(taken.0.block.motion, Motion::Line(_)));
        taken
    }

    /// Ends one contour: its drift must stay within the tolerance of closing.
    pub(crate) fn finish_contour(&mut self) -> Result<(), String> {
        let drift = (self.drift - self.drift_at_start).norm();
        let allowed = tolerance(self.arcs - self.arcs_at_start);
        if drift > allowed {
            return Err(say!(
                a_controller_that_counts_j_drifts_more_than_allowed,
                drift,
                allowed
            ));
        }
        (self.drift_at_start, self.arcs_at_start) = (self.drift, self.arcs);
        Ok(())
    }
}

/// A line that was read back and is as it should be.
pub(super) struct Checked {
    /// Bytes of the block in the text.
    pub(super) range: Range<usize>,
    pub(super) number: Option<u32>,
    /// Its largest distance from its piece of the path, µm.
    pub(super) aside: f64,
}

/// Reads `line` back, which begins at byte `at` of the text, and compares its block, which is `decoded` from its own
/// node, with its piece of the path.
pub(super) fn check_line(
    line: &[u8],
    at: usize,
    words: &Words<'_>,
    (encoded, decoded): (&Encoded, &Segment),
    part: Option<PartArc>,
) -> Result<Checked, String> {
    let mut read = None;
    let mut fault = None;
    read_line(line, 0, words, |item| match item {
        Item::Block {
            block,
            part,
            range,
            number,
            ..
        } => read = Some((block, part, range, number)),
        Item::Fault(found) => fault = Some(found),
        _ => {}
    });
    if let Some(fault) = fault {
        return Err(say!(a_written_block_cannot_be_read_again, fault.sentence()));
    }
    match read {
        Some((block, read, range, number)) if block == encoded.block && read == part => {
            Ok(Checked {
                range: at + range.start..at + range.end,
                number,
                aside: check_block(encoded, decoded)?,
            })
        }
        _ => Err(say!(
            a_written_block_reads_otherwise,
            String::from_utf8_lossy(line),
            encoded.block
        )),
    }
}

/// The largest distance of a decoded block from its piece of the path.
fn check_block(encoded: &Encoded, decoded: &Segment) -> Result<f64, String> {
    let block = &encoded.block;
    let distance = (decoded.end() - point_of(encoded.to)).norm();
    if distance > END_TOLERANCE {
        return Err(say!(
            a_block_ends_beside_its_node,
            block,
            distance,
            encoded.to
        ));
    }
    proved_aside(decoded, &encoded.piece, 0.0)
        .map_err(|worst| say!(a_block_runs_beside_the_path, block, worst, encoded.from))
}
