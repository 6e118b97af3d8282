//! Ways: blocks that cut one after another, held as a whole or in parts.

use super::tolerance;
use crate::geometry::{Bounds, Point, Segment, Vector};
use std::cell::OnceCell;
use std::ops::Range;

/// Where a way stands between two of its blocks, µm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Where the machine stands.
    pub stands: Point,
    /// Where it would, did it not drift while it counts.
    pub meant: Point,
}

impl Node {
    /// A node of a program that names its places.
    pub fn at(point: Point) -> Node {
        Node {
            stands: point,
            meant: point,
        }
    }

    pub fn is_near(&self, other: &Node, tolerance: f64) -> bool {
        (self.stands - other.stands).norm() <= tolerance
            || (self.meant - other.meant).norm() <= tolerance
    }
}

/// How a program says where its blocks lead.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Writing {
    /// Its places are named, not only the ways between them.
    pub names_places: bool,
    /// How far ends that are meant as one may lie apart because numbers are written so coarsely, µm.
    pub slack: f64,
}

/// Blocks that cut one after another. What is `None` is not held.
pub trait Way {
    fn count(&self) -> usize;
    fn arcs(&self) -> usize;
    fn writing(&self) -> Writing;
    /// Where it stands before a block, or behind the last.
    fn node(&self, index: usize) -> Option<Node>;
    /// What a block means, where it is meant to begin; a line without length where it leads nowhere.
    fn piece(&self, index: usize) -> Option<Segment>;
    /// Hands out all pieces that come within `reach` µm of a place, and perhaps others, in their order, until `each` says that it has
    /// seen enough.
    fn pieces_about(
        &self,
        at: Point,
        reach: f64,
        each: &mut dyn FnMut(usize, &Segment) -> bool,
    ) -> Option<()>;

    /// The blocks before its first stop, where it holds one: what comes behind is the tab.
    fn stop(&self) -> Option<usize>;

    /// How far it may end beside a place and still end in it, µm.
    fn tolerance(&self) -> f64 {
        tolerance(self.arcs()).max(self.writing().slack)
    }
}

/// A way of which everything is held.
#[derive(Clone, Debug, Default)]
pub struct HeldWay {
    nodes: Vec<Node>,
    pieces: Vec<Segment>,
    arcs: usize,
    writing: Writing,
    stop: Option<usize>,
}

impl HeldWay {
    pub fn from(start: Node, writing: Writing) -> HeldWay {
        HeldWay {
            nodes: vec![start],
            writing,
            ..HeldWay::default()
        }
    }

    /// What comes next stands behind a stop.
    pub fn stop_here(&mut self) {
        self.stop.get_or_insert(self.pieces.len());
    }

    /// One block more: what it means, from where the way is meant to stand, and where the machine stands behind it.
    pub fn push(&mut self, piece: Segment, is_arc: bool, end: Node) {
        self.pieces.push(piece);
        self.nodes.push(end);
        self.arcs += usize::from(is_arc);
    }
}

impl Way for HeldWay {
    fn count(&self) -> usize {
        self.pieces.len()
    }

    fn arcs(&self) -> usize {
        self.arcs
    }

    fn writing(&self) -> Writing {
        self.writing
    }

    fn stop(&self) -> Option<usize> {
        self.stop
    }

    fn node(&self, index: usize) -> Option<Node> {
        self.nodes.get(index).copied()
    }

    fn piece(&self, index: usize) -> Option<Segment> {
        self.pieces.get(index).copied()
    }

    fn pieces_about(
        &self,
        _: Point,
        _: f64,
        each: &mut dyn FnMut(usize, &Segment) -> bool,
    ) -> Option<()> {
        _ = self
            .pieces
            .iter()
            .enumerate()
            .any(|(index, piece)| each(index, piece));
        Some(())
    }
}

/// Blocks of a way that are held together: what an edit leaves as it was.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    /// Tells two parts apart: equal ways have equal marks.
    pub mark: u64,
    pub blocks: usize,
    pub arcs: usize,
    /// Where it begins, seen from the beginning of the way, nm.
    pub start: [i64; 2],
    /// µm, seen from its beginning.
    pub bounds: Bounds,
    /// Blocks of it that come near each other, by their number in the part, neighbours left out.
    pub near: &'a [(u32, u32)],
}

impl Part<'_> {
    /// Where it begins, µm.
    pub fn offset(&self) -> Vector {
        micrometres(self.start)
    }

    /// Its box where it lies.
    pub fn placed(&self) -> Bounds {
        self.bounds.moved(self.offset())
    }
}

/// A displacement of whole nm in µm.
pub fn micrometres(nm: [i64; 2]) -> Vector {
    Vector::new(nm[0] as f64 * 1e-3, nm[1] as f64 * 1e-3)
}

/// What the mark of a way becomes with one field more.
pub fn mixed(mark: u64, field: u64) -> u64 {
    (mark ^ field)
        .wrapping_mul(0x2545_f491_4f6c_dd1d)
        .rotate_left(23)
}

/// What hands out the blocks of parts.
pub trait Blocks: Sync {
    /// Those of a part, from the origin on.
    fn pieces(&self, part: usize) -> Vec<Segment>;

    /// Where a block of a part begins, or where the last one ends; `None` where that is told by the pieces.
    fn node(&self, _part: usize, _nth: usize) -> Option<Node> {
        None
    }

    /// Bytes of a block of a part.
    fn range(&self, part: usize, nth: usize) -> Option<Range<usize>>;

    fn writing(&self) -> Writing;
}

/// A way in parts. Costs these, and the blocks of those that are asked for.
pub struct PartedWay<'a> {
    pub blocks: Box<dyn Blocks + 'a>,
    pub parts: Vec<Part<'a>>,
    /// Blocks before each part.
    firsts: Vec<usize>,
    pieces: Vec<OnceCell<Vec<Segment>>>,
    count: usize,
    arcs: usize,
    /// Blocks before the stop at its tab.
    stop: Option<usize>,
    /// Before and behind the first and the last block, where they are known beforehand.
    ends: Option<[[Node; 2]; 2]>,
}

/// What boxes are grown by, µm: places are rounded to nm.
const SLACK: f64 = 1.0;

impl<'a> PartedWay<'a> {
    pub fn new(
        blocks: Box<dyn Blocks + 'a>,
        parts: Vec<Part<'a>>,
        stop: Option<usize>,
        ends: Option<[[Node; 2]; 2]>,
    ) -> PartedWay<'a> {
        let mut count = 0;
        let firsts = parts.iter().map(|part| {
            count += part.blocks;
            count - part.blocks
        });
        let firsts = firsts.collect();
        PartedWay {
            blocks,
            firsts,
            pieces: parts.iter().map(|_| OnceCell::new()).collect(),
            arcs: parts.iter().map(|part| part.arcs).sum(),
            parts,
            count,
            stop,
            ends,
        }
    }

    /// Bytes of a block by its number.
    pub fn range(&self, index: usize) -> Option<Range<usize>> {
        let part = self.part_of(index)?;
        self.blocks.range(part, index - self.firsts.get(part)?)
    }

    fn part_of(&self, index: usize) -> Option<usize> {
        self.firsts
            .partition_point(|first| *first <= index)
            .checked_sub(1)
    }

    fn pieces(&self, index: usize) -> Option<&[Segment]> {
        let part = self.parts.get(index)?;
        let made = || {
            let own = self.blocks.pieces(index).into_iter();
            own.map(|piece| piece.moved(part.offset())).collect()
        };
        Some(self.pieces.get(index)?.get_or_init(made))
    }
}

impl Way for PartedWay<'_> {
    fn count(&self) -> usize {
        self.count
    }

    fn arcs(&self) -> usize {
        self.arcs
    }

    fn writing(&self) -> Writing {
        self.blocks.writing()
    }

    fn stop(&self) -> Option<usize> {
        self.stop
    }

    fn node(&self, index: usize) -> Option<Node> {
        let known = self.ends.and_then(|[first, last]| match index {
            0 => Some(first[0]),
            1 => Some(first[1]),
            _ if index == self.count => Some(last[1]),
            _ if index + 1 == self.count => Some(last[0]),
            _ => None,
        });
        let told = || {
            let part = self.part_of(index.min(self.count.checked_sub(1)?))?;
            self.blocks.node(part, index - self.firsts.get(part)?)
        };
        known.or_else(told).or_else(|| {
            Some(Node::at(if index == self.count {
                self.piece(index.checked_sub(1)?)?.end()
            } else {
                self.piece(index)?.start()
            }))
        })
    }

    fn piece(&self, index: usize) -> Option<Segment> {
        let part = self.part_of(index)?;
        self.pieces(part)?.get(index - self.firsts[part]).copied()
    }

    fn pieces_about(
        &self,
        at: Point,
        reach: f64,
        each: &mut dyn FnMut(usize, &Segment) -> bool,
    ) -> Option<()> {
        let place = Bounds::of_disc(at, reach + SLACK);
        for (index, part) in self.parts.iter().enumerate() {
            if part.placed().touches(&place)
                && self
                    .pieces(index)?
                    .iter()
                    .zip(self.firsts[index]..)
                    .any(|(piece, index)| each(index, piece))
            {
                break;
            }
        }
        Some(())
    }
}
