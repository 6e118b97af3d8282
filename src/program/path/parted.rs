//! Ways in parts, so that the unchanged parts of an edited way are reused.

use super::lay::Lay;
use super::way::{Node, Totals, Way, Writing};
use crate::geometry::{Bounds, Point, Segment, Vector};
use std::borrow::Cow;
use std::cell::OnceCell;
use std::ops::Range;

/// Blocks of a way that are held together: an edit elsewhere leaves them alone.
#[derive(Clone, Debug)]
pub(crate) struct WayPart<'a> {
    pub(crate) lay: Cow<'a, Lay>,
    pub(crate) blocks: usize,
    pub(crate) arcs: usize,
    /// Its start relative to the beginning of the way, nm.
    pub(crate) start: [i64; 2],
}

impl WayPart<'_> {
    /// Where it begins, µm.
    pub(crate) fn offset(&self) -> Vector {
        micrometres(self.start)
    }

    /// Its box in place.
    pub(crate) fn placed(&self) -> Bounds {
        self.lay.bounds.moved(self.offset())
    }
}

/// A displacement of whole nm in µm.
pub(crate) fn micrometres(nm: [i64; 2]) -> Vector {
    Vector::new(nm[0] as f64 * 1e-3, nm[1] as f64 * 1e-3)
}

/// Hands out the blocks of parts.
pub(crate) trait Blocks: Sync {
    /// Those of a part, from the origin on.
    fn pieces(&self, part: usize) -> Vec<Segment>;

    /// Where a block of a part begins, or where the last one ends; `None` where the pieces show it.
    fn node(&self, _part: usize, _nth: usize) -> Option<Node> {
        None
    }

    /// Bytes of a block of a part.
    fn range(&self, part: usize, nth: usize) -> Option<Range<usize>>;

    fn writing(&self) -> Writing;
}

/// A way in parts. Its cost is that of the parts, and of the blocks of those that are asked for.
pub(crate) struct PartedWay<'a> {
    pub(crate) blocks: Box<dyn Blocks + 'a>,
    pub(crate) parts: Vec<WayPart<'a>>,
    /// Blocks before each part.
    pub(super) firsts: Vec<usize>,
    pieces: Vec<OnceCell<Vec<Segment>>>,
    totals: Totals,
    /// Before and after the first and the last block, where they are known beforehand.
    ends: Option<[[Node; 2]; 2]>,
}

/// The enlargement of boxes, µm: places are rounded to nm.
pub(super) const SLACK: f64 = 1.0;

impl<'a> PartedWay<'a> {
    pub(crate) fn new(
        blocks: Box<dyn Blocks + 'a>,
        parts: Vec<WayPart<'a>>,
        stop: Option<usize>,
        ends: Option<[[Node; 2]; 2]>,
    ) -> PartedWay<'a> {
        let mut totals = Totals {
            writing: blocks.writing(),
            stop,
            ..Totals::default()
        };
        let firsts = parts.iter().map(|part| {
            totals.count += part.blocks;
            totals.arcs += part.arcs;
            totals.count - part.blocks
        });
        let firsts = firsts.collect();
        PartedWay {
            blocks,
            firsts,
            pieces: parts.iter().map(|_| OnceCell::new()).collect(),
            parts,
            totals,
            ends,
        }
    }

    /// Bytes of a block by its number.
    pub(crate) fn range(&self, index: usize) -> Option<Range<usize>> {
        let part = self.part_of(index)?;
        self.blocks.range(part, index - self.firsts.get(part)?)
    }

    /// How many blocks of a range are arcs. Costs the blocks of the parts at its ends.
    pub(crate) fn arcs_in(&self, range: &Range<usize>) -> usize {
        let parts = self.parts.iter().zip(&self.firsts).enumerate();
        let of_part = |(index, (part, first)): (usize, (&WayPart<'_>, &usize))| {
            let [begin, end] =
                [range.start, range.end].map(|at| at.clamp(*first, first + part.blocks));
            if end - begin == part.blocks {
                return part.arcs;
            }
            if begin == end || part.arcs == 0 {
                return 0;
            }
            let own = self
                .pieces(index)
                .and_then(|all| all.get(begin - first..end - first));
            let is_arc = |piece: &&Segment| piece.as_arc().is_some();
            own.unwrap_or_default().iter().filter(is_arc).count()
        };
        parts.map(of_part).sum()
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
    fn totals(&self) -> Totals {
        self.totals
    }

    fn node(&self, index: usize) -> Option<Node> {
        let count = self.totals.count;
        let known = self.ends.and_then(|[first, last]| match index {
            0 => Some(first[0]),
            1 => Some(first[1]),
            _ if index == count => Some(last[1]),
            _ if index + 1 == count => Some(last[0]),
            _ => None,
        });
        let told = || {
            let part = self.part_of(index.min(count.checked_sub(1)?))?;
            self.blocks.node(part, index - self.firsts.get(part)?)
        };
        known.or_else(told).or_else(|| {
            Some(Node::at(if index == count {
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
