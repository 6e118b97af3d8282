//! Ways: consecutive cutting blocks, and where they lead.

use crate::geometry::{Point, Segment};

/// The tolerance for the end of a way with this many arcs at a place, µm: rounding adds up as a random walk.
pub(crate) fn tolerance(arcs: usize) -> f64 {
    2.0 + (arcs as f64).sqrt()
}

/// The position on a way between two of its blocks, µm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Node {
    /// Where the machine stands.
    pub(crate) stands: Point,
    /// The position without the drift of counting.
    pub(crate) meant: Point,
}

impl Node {
    /// A node of a program that names its places.
    pub(crate) fn at(point: Point) -> Node {
        Node {
            stands: point,
            meant: point,
        }
    }

    pub(crate) fn is_near(&self, other: &Node, tolerance: f64) -> bool {
        (self.stands - other.stands).norm() <= tolerance
            || (self.meant - other.meant).norm() <= tolerance
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

/// What is known of a way without its blocks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Totals {
    pub(crate) count: usize,
    pub(crate) arcs: usize,
    pub(crate) writing: Writing,
    /// Blocks before its first stop, if it holds one: the tab is after.
    pub(crate) stop: Option<usize>,
}

/// Consecutive cutting blocks. `None` stands for one that is not held.
pub(crate) trait Way {
    fn totals(&self) -> Totals;

    fn count(&self) -> usize {
        self.totals().count
    }

    fn stop(&self) -> Option<usize> {
        self.totals().stop
    }

    /// The position before a block, or after the last.
    fn node(&self, index: usize) -> Option<Node>;
    /// The curve of a block at its intended start; a line without length where it leads nowhere.
    fn piece(&self, index: usize) -> Option<Segment>;
    /// True where all its blocks are held.
    fn is_held(&self) -> bool {
        true
    }

    /// Hands out all pieces within `reach` µm of a place, and perhaps others, in their order, until `each` stops it. `None` where not all
    /// are held.
    fn pieces_about(
        &self,
        _at: Point,
        _reach: f64,
        each: &mut dyn FnMut(usize, &Segment) -> bool,
    ) -> Option<()> {
        if !self.is_held() {
            return None;
        }
        for index in 0..self.count() {
            if each(index, &self.piece(index)?) {
                break;
            }
        }
        Some(())
    }

    /// The tolerance for its end at a place, µm.
    fn tolerance(&self) -> f64 {
        let Totals { arcs, writing, .. } = self.totals();
        tolerance(arcs).max(writing.slack)
    }
}

/// A way of which everything is held.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeldWay {
    nodes: Vec<Node>,
    pieces: Vec<Segment>,
    totals: Totals,
}

impl HeldWay {
    pub(crate) fn from(start: Node, writing: Writing) -> HeldWay {
        HeldWay {
            nodes: vec![start],
            totals: Totals {
                writing,
                ..Totals::default()
            },
            pieces: Vec::new(),
        }
    }

    pub(crate) fn pieces(&self) -> &[Segment] {
        &self.pieces
    }

    /// Adds a block: its curve from the intended position, and the machine's position after it.
    pub(crate) fn push(&mut self, piece: Segment, is_arc: bool, end: Node) {
        self.pieces.push(piece);
        self.nodes.push(end);
        self.totals.count += 1;
        self.totals.arcs += usize::from(is_arc);
    }
}

impl Way for HeldWay {
    fn totals(&self) -> Totals {
        self.totals
    }

    fn node(&self, index: usize) -> Option<Node> {
        self.nodes.get(index).copied()
    }

    fn piece(&self, index: usize) -> Option<Segment> {
        self.pieces.get(index).copied()
    }
}
