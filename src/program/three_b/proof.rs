//! Decodes the written text and compares it with the path, block by block.

use super::block::{Block, Node, PartArc};
use super::decode::decode;
use super::encode::{ASIDE_TOLERANCE, END_TOLERANCE, Encoded, alternatives, point_of};
use super::parse::{Item, read_line};
use super::words::Words;
use crate::geometry::Vector;
use crate::program::grid::largest_distance;
use crate::program::path::tolerance;

/// The results for the blocks of one program so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Proof {
    /// Sum of the deviations of blocks from their nodes: the drift of a controller that only counts J, µm.
    pub(crate) drift: Vector,
    /// Largest distance of a block from its piece of the path, over its whole length, µm.
    pub(crate) deviation: f64,
    pub(crate) arcs: usize,
    drift_at_start: Vector,
    arcs_at_start: usize,
}

impl Proof {
    /// Reads `line` back, decodes it from its own node and compares it with its piece of the path.
    pub(crate) fn check_line(
        &mut self,
        line: &[u8],
        words: &Words<'_>,
        encoded: &Encoded,
        part: Option<PartArc>,
    ) -> Result<(), String> {
        let mut read: Option<(Block, Option<PartArc>)> = None;
        let mut fault = None;
        read_line(line, 0, words, |item| match item {
            Item::Block { block, part, .. } => read = Some((block, part)),
            Item::Fault(found) => fault = Some(found),
            _ => {}
        });
        if let Some(fault) = fault {
            return Err(say!(a_written_block_cannot_be_read_again, fault.sentence()));
        }
        match read {
            Some((block, read)) if block == encoded.block && read == part => {
                self.check_block(&block, encoded)
            }
            _ => Err(say!(
                a_written_block_reads_otherwise,
                String::from_utf8_lossy(line),
                encoded.block
            )),
        }
    }

    fn check_block(&mut self, block: &Block, encoded: &Encoded) -> Result<(), String> {
        let decoded = decode(block, point_of(encoded.from))
            .map_err(|_| say!(a_block_cannot_be_decoded, block))?;
        let miss = decoded.end() - point_of(encoded.to);
        let distance = miss.norm();
        if distance > END_TOLERANCE {
            return Err(say!(
                a_block_ends_beside_its_node,
                block,
                distance,
                encoded.to
            ));
        }
        let aside = largest_distance(&decoded, &encoded.piece);
        let middles = (decoded.point_at(0.5) - encoded.piece.point_at(0.5)).norm();
        if aside.max(middles) > ASIDE_TOLERANCE || aside.is_nan() || middles.is_nan() {
            return Err(say!(
                a_block_runs_beside_the_path,
                block,
                aside.max(middles),
                encoded.from
            ));
        }
        self.drift += miss;
        self.deviation = self.deviation.max(aside);
        self.arcs += usize::from(decoded.as_arc().is_some());
        Ok(())
    }

    /// The block, or another one for the same arc where a counting controller would else drift further and further:
    /// equal arcs in a row miss their ends alike.
    pub(crate) fn steadied(&self, encoded: &Encoded, largest: i64) -> Encoded {
        let drift = self.drift - self.drift_at_start;
        let drifted = |block: &Block| match decode(block, point_of(encoded.from)) {
            Ok(decoded) => (drift + (decoded.end() - point_of(encoded.to))).norm(),
            Err(_) => f64::INFINITY,
        };
        let allowed = tolerance(self.arcs - self.arcs_at_start) / 2.0;
        if drifted(&encoded.block) <= allowed {
            return *encoded;
        }
        let best = alternatives(encoded, largest)
            .into_iter()
            .min_by(|a, b| drifted(a).total_cmp(&drifted(b)));
        match best.filter(|block| drifted(block) < drifted(&encoded.block)) {
            Some(block) => Encoded { block, ..*encoded },
            None => *encoded,
        }
    }

    /// Ends one contour: its drift must stay within the tolerance of closing.
    ///
    /// `first` and `last` are its nodes where the path is closed: they must be equal.
    pub(crate) fn finish_contour(
        &mut self,
        closed: bool,
        first: Node,
        last: Node,
    ) -> Result<(), String> {
        if closed && first != last {
            return Err(say!(the_cut_begins_at_and_ends_at, first, last));
        }
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
