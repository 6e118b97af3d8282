//! The properties of a program's cuts, and their blocks as ways.

use super::super::decode::meant;
use super::super::entry::{BlockEntry, Entry, Move, travel_of};
use super::{At, Document, JoinedCut};
use crate::drawing::wire_side;
use crate::geometry::{Point, Segment};
use crate::program::path::{
    Blocks, ControlOffset, Ends, HasCuts, Lay, MOST_BLOCKS, Node, PartedWay, UM_IN_MM, WayPart,
    Writing, mixed,
};
use std::borrow::Cow;
use std::ops::Range;

/// The blocks of a cut as its stretches hold them.
struct Held<'a> {
    document: &'a Document,
    parts: Vec<HeldPart>,
}

/// The blocks of a cut in one part of a stretch.
struct HeldPart {
    stretch: usize,
    entries: Range<usize>,
    start: Move,
}

impl HasCuts for Document {
    type Cut = JoinedCut;

    fn ends(&self, cut: &JoinedCut) -> Ends {
        cut.sum.ends()
    }

    fn twice_area(&self, cut: &JoinedCut) -> f64 {
        cut.sum.twice_area
    }

    fn only_lay<'a>(&'a self, cut: &JoinedCut) -> Option<Cow<'a, Lay>> {
        let [(stretch, part), last] = cut.parts;
        let of = self
            .stretches
            .get(stretch)
            .filter(|_| (stretch, part) == last)?;
        of.parts.get(part).map(|part| of.lay(part))
    }

    fn way<'a>(&'a self, cut: &JoinedCut) -> PartedWay<'a> {
        let (mut held, mut parts) = (Vec::new(), Vec::new());
        let mut at = Move::default();
        let [(first_stretch, first_part), (last_stretch, last_part)] = cut.parts;
        let stretches = self.stretches.iter().enumerate();
        for (stretch, of) in stretches.take(last_stretch + 1).skip(first_stretch) {
            let first = if stretch == first_stretch {
                first_part
            } else {
                0
            };
            for (index, part) in of.parts.iter().enumerate().skip(first) {
                if stretch == last_stretch && index > last_part {
                    break;
                }
                let sum = of.sum(part);
                if sum.blocks > 0 {
                    held.push(HeldPart {
                        stretch,
                        entries: part.entries(),
                        start: at,
                    });
                    parts.push(WayPart {
                        lay: of.lay(part),
                        blocks: sum.blocks,
                        arcs: sum.arcs,
                        start: at.meant,
                    });
                    at = at.plus(sum.travel);
                }
            }
        }
        let blocks = Held {
            document: self,
            parts: held,
        };
        PartedWay::new(Box::new(blocks), parts, cut.stop, None)
    }

    fn mark(&self, cut: &JoinedCut) -> u64 {
        mixed(cut.sum.mark, cut.stop.map_or(0, |blocks| blocks as u64 + 1))
    }

    fn last_block(&self, cut: &JoinedCut) -> Option<Range<usize>> {
        self.last_block_of(cut).map(|at| self.range_of(at))
    }

    fn part_count(&self, cut: &JoinedCut) -> usize {
        cut.parts[1].0 - cut.parts[0].0 + 1
    }

    fn is_doubtful(&self, cut: &JoinedCut) -> bool {
        cut.is_jump || cut.sum.errors > 0
    }

    /// In 4B its first arc says on which side the wire runs, in 3B that holds the part's contour the settings do.
    fn control_offset(&self, cut: &JoinedCut) -> Option<ControlOffset> {
        let entries = self.entries_of(cut).take(MOST_BLOCKS);
        let blocks = entries.filter_map(|at| self.entry(at)?.block());
        let mut sides = blocks.filter_map(BlockEntry::side_of_wire);
        let by_settings = || {
            let role = self.limits.side.role();
            let role = role.filter(|_| self.limits.holds_part)?;
            wire_side(role, true, cut.sum.twice_area)
        };
        Some(ControlOffset {
            side: sides.next().or_else(by_settings)?,
            correction: self.limits.correction * UM_IN_MM,
        })
    }
}

impl Held<'_> {
    fn entries(&self, part: usize) -> impl Iterator<Item = &BlockEntry> {
        let part = self.parts.get(part);
        let entries = part.and_then(|part| {
            let stretch = self.document.stretches.get(part.stretch)?;
            stretch.entries.get(part.entries.clone())
        });
        entries.unwrap_or_default().iter().filter_map(Entry::block)
    }
}

impl Blocks for Held<'_> {
    /// A block that leads nowhere is a piece of no length.
    fn pieces(&self, part: usize) -> Vec<Segment> {
        let mut at = Move::default();
        let piece = |entry: &BlockEntry| {
            let [x, y] = at.meant_um();
            let block = entry.block();
            at = at.plus(travel_of(&block));
            let start = Point::new(x, y);
            meant(&block, start).unwrap_or(Segment::line(start, start))
        };
        self.entries(part).map(piece).collect()
    }

    fn node(&self, part: usize, nth: usize) -> Option<Node> {
        let start = self.parts.get(part)?.start;
        let before = self.entries(part).take(nth);
        let at = before.fold(start, |at, entry| at.plus(entry.travel()));
        Some(at.node())
    }

    fn range(&self, part: usize, nth: usize) -> Option<Range<usize>> {
        let HeldPart {
            stretch, entries, ..
        } = self.parts.get(part)?;
        let places = entries.clone().map(|entry| At {
            stretch: *stretch,
            entry,
        });
        let is_block = |at: &At| {
            self.document
                .entry(*at)
                .is_some_and(|entry| entry.block().is_some())
        };
        Some(self.document.range_of(places.filter(is_block).nth(nth)?))
    }

    fn writing(&self) -> Writing {
        Writing::default()
    }
}
