//! Ways: consecutive cutting blocks, and where they lead.

use crate::geometry::{Point, Segment, Vector};

/// The tolerance for the end of a way with this many arcs at a place, µm: rounding adds up as a random walk.
pub(crate) fn tolerance(arcs: usize) -> f64 {
    2.0 + (arcs as f64).sqrt()
}

/// The position on a way between two of its blocks, µm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Node {
    /// Where the machine stands.
    pub(crate) machine: Point,
    /// The position without the drift of counting.
    pub(crate) ideal: Point,
}

impl Node {
    /// A node of a program that names its places.
    pub(crate) fn at(point: Point) -> Node {
        Node {
            machine: point,
            ideal: point,
        }
    }

    pub(crate) fn is_near(&self, other: &Node, tolerance: f64) -> bool {
        (self.machine - other.machine).norm() <= tolerance
            || (self.ideal - other.ideal).norm() <= tolerance
    }
}

/// How a program gives the ends of its blocks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Writing {
    /// Its places are named, not only the ways between them.
    pub(crate) names_places: bool,
    /// How far coinciding ends may be apart because numbers are written coarsely, µm.
    pub(crate) slack: f64,
}

/// Consecutive cutting blocks: their curves, µm, each from the intended end of the one before.
#[derive(Clone, Debug, Default)]
pub(crate) struct Way {
    /// Before each block, and after the last.
    nodes: Vec<Node>,
    /// A line without length for a block that leads nowhere.
    pieces: Vec<Segment>,
    arcs: usize,
    writing: Writing,
    /// Blocks before its first stop, if it holds one: the tab is after.
    stop: Option<usize>,
}

impl Way {
    pub(crate) fn from(start: Node, writing: Writing) -> Way {
        Way {
            nodes: vec![start],
            writing,
            ..Way::default()
        }
    }

    /// The same with a stop after this many blocks, before its tab.
    pub(crate) fn stopping(mut self, stop: Option<usize>) -> Way {
        self.stop = stop;
        self
    }

    /// Adds a block: its curve from the intended position, and the position after it.
    pub(crate) fn push(&mut self, piece: Segment, is_arc: bool, end: Node) {
        self.pieces.push(piece);
        self.nodes.push(end);
        self.arcs += usize::from(is_arc);
    }

    /// This way, and after a stop another one, which begins at the place where it begins itself.
    pub(crate) fn append(&mut self, behind: &Way) {
        let (end, begin) = (self.end(), behind.node(0));
        let (machine, ideal) = (end.machine - begin.machine, end.ideal - begin.ideal);
        self.stop = self.stop.or(Some(self.count()));
        let pieces = behind.pieces.iter().map(|piece| piece.moved(ideal));
        self.pieces.extend(pieces);
        let nodes = behind.nodes.iter().skip(1).map(|node| Node {
            machine: node.machine + machine,
            ideal: node.ideal + ideal,
        });
        self.nodes.extend(nodes);
        self.arcs += behind.arcs;
    }

    pub(crate) fn count(&self) -> usize {
        self.pieces.len()
    }

    pub(crate) fn arcs(&self) -> usize {
        self.arcs
    }

    pub(crate) fn writing(&self) -> Writing {
        self.writing
    }

    pub(crate) fn stop(&self) -> Option<usize> {
        self.stop
    }

    pub(crate) fn pieces(&self) -> &[Segment] {
        &self.pieces
    }

    /// The position before a block, or after the last.
    pub(crate) fn node(&self, index: usize) -> Node {
        let last = || self.nodes.last().copied().unwrap_or_default();
        self.nodes.get(index).copied().unwrap_or_else(last)
    }

    pub(crate) fn end(&self) -> Node {
        self.node(usize::MAX)
    }

    /// From before a block to the end of another one, as the blocks mean it, µm.
    pub(crate) fn ideal_between(&self, from: usize, to: usize) -> Vector {
        self.node(to).ideal - self.node(from).ideal
    }

    /// The tolerance for its end at a place, µm.
    pub(crate) fn tolerance(&self) -> f64 {
        tolerance(self.arcs).max(self.writing.slack)
    }
}
