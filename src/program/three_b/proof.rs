//! Decodes the written text and compares it with the path, block by block.

use super::block::PartArc;
use super::encode::{END_TOLERANCE, Encoded, point_of};
use super::parse::{Item, read_line};
use super::stand::{Planned, Stand, plan};
use super::words::Words;
use crate::geometry::Vector;
use crate::program::encode::proved_aside;
use crate::program::grid::Node;
use crate::program::path::tolerance;

/// Where the program stands, and what has been proved so far.
#[derive(Clone, Debug)]
pub(super) struct Proof {
    stand: Stand,
    /// The node at which it should stand.
    node: Node,
    /// Largest distance of a block from its piece of the path, over its whole length, in both readings, µm.
    pub(crate) deviation: f64,
    /// Of the contour.
    arcs: usize,
}

impl Proof {
    pub(crate) fn from(node: Node) -> Proof {
        Proof {
            stand: Stand::at(node),
            node,
            deviation: 0.0,
            arcs: 0,
        }
    }

    /// The blocks in place of one between nodes. No number is above `largest`; without it there is no other one.
    pub(crate) fn plan(
        &mut self,
        encoded: Encoded,
        largest: Option<i64>,
    ) -> Result<Vec<Planned>, String> {
        let planned = plan(self.stand, encoded, largest)
            .ok_or_else(|| say!(a_block_cannot_be_decoded, encoded.block))?;
        self.stand = planned.last().map_or(self.stand, |last| last.after);
        self.arcs += usize::from(!encoded.block.motion.is_line());
        self.node = encoded.to;
        Ok(planned)
    }

    /// The table has been moved by hand.
    pub(crate) fn moved_by_hand(&mut self, to: Node) {
        (self.stand, self.node) = (Stand::at(to), to);
    }

    /// The drift of a reader that runs exact arcs, µm.
    pub(crate) fn drift(&self) -> Vector {
        self.stand.exact - point_of(self.node)
    }

    /// The drift that closing allows, µm.
    pub(crate) fn allowed(&self) -> f64 {
        tolerance(self.arcs)
    }

    /// Ends one contour: its drift must stay within the tolerance of closing.
    pub(crate) fn finish_contour(&mut self) -> Result<(), String> {
        let (drift, allowed) = (self.drift().norm(), self.allowed());
        if drift > allowed {
            return Err(say!(
                a_controller_that_counts_j_drifts_more_than_allowed,
                drift,
                allowed
            ));
        }
        self.arcs = 0;
        Ok(())
    }
}

/// Reads `line` back, and compares its block with its piece of the path, from where the program stands: its largest
/// distance from that, µm. `drift` is how far it may stand beside its nodes, µm.
pub(super) fn check_line(
    line: &[u8],
    words: &Words<'_>,
    planned: &Planned,
    part: Option<PartArc>,
    drift: f64,
) -> Result<f64, String> {
    let mut read = None;
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
        Some(read) if read == (planned.encoded.block, part) => check_block(planned, drift),
        _ => Err(say!(
            a_written_block_reads_otherwise,
            String::from_utf8_lossy(line),
            planned.encoded.block
        )),
    }
}

/// The largest distance of a block from its piece of the path, in both readings; its end also from that of the piece.
/// Exact arcs are what is proved; where the control stands is stated.
fn check_block(planned: &Planned, drift: f64) -> Result<f64, String> {
    let Encoded {
        block, from, piece, ..
    } = &planned.encoded;
    let ends = [planned.after.exact, point_of(planned.after.machine)];
    let [exact, machine] = ends.map(|end| (end - planned.encoded.target()).norm());
    if exact > END_TOLERANCE + drift {
        return Err(say!(
            a_block_ends_beside_its_node,
            block,
            exact,
            planned.encoded.to
        ));
    }
    let runs = [
        (planned.run, drift),
        (planned.run_of_machine(), f64::INFINITY),
    ];
    runs.iter()
        .try_fold(exact.max(machine), |worst, (run, slack)| {
            let aside = proved_aside(run, piece, *slack)
                .map_err(|worst| say!(a_block_runs_beside_the_path, block, worst, from))?;
            Ok(worst.max(aside))
        })
}
