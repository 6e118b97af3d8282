//! The blocks of a section as a way, for the one answer on where contours close.

use super::super::decode::meant;
use super::super::run::{BlockEntry, Entry, Move, Part};
use super::{Document, Section};
use crate::geometry::{Bounds, Point, Segment, Vector};
use crate::program::path::{Node, Way, Writing};
use std::cell::OnceCell;
use std::ops::Range;

/// A section block by block. Costs its runs, and the blocks of those that are asked for.
pub(super) struct SectionWay<'a> {
    document: &'a Document,
    parts: Vec<WayPart>,
    count: usize,
    arcs: usize,
    travel: Move,
    stop: Option<usize>,
}

/// The blocks of a section in one part of a run.
struct WayPart {
    run: usize,
    entries: Range<usize>,
    /// Blocks of the section before it.
    first: usize,
    start: Move,
    bounds: Bounds,
    pieces: OnceCell<Vec<Segment>>,
}

/// What boxes are grown by, µm: places are rounded to nm.
const SLACK: f64 = 1.0;

impl<'a> SectionWay<'a> {
    pub fn of(document: &'a Document, section: &Section) -> SectionWay<'a> {
        let mut way = SectionWay {
            document,
            parts: Vec::new(),
            count: 0,
            arcs: 0,
            travel: Move::default(),
            stop: None,
        };
        let [(first_run, first_part), (last_run, last_part)] = section.parts;
        for (run, of) in document
            .runs
            .iter()
            .enumerate()
            .take(last_run + 1)
            .skip(first_run)
        {
            let from = if run == first_run { first_part } else { 0 };
            let to = if run == last_run {
                last_part + 1
            } else {
                of.parts.len()
            };
            for (index, part) in of
                .parts
                .get(from..to)
                .unwrap_or_default()
                .iter()
                .enumerate()
            {
                if part.sum.blocks > 0 {
                    way.push(run, part);
                }
                let is_last = (run, from + index) == section.parts[1];
                way.stop = way
                    .stop
                    .or((part.word.is_some() && !is_last).then_some(way.count));
            }
        }
        way
    }

    fn push(&mut self, run: usize, part: &Part) {
        let (first, start) = (self.count, self.travel);
        self.parts.push(WayPart {
            run,
            entries: part.entries.clone(),
            first,
            start,
            bounds: part.bounds,
            pieces: OnceCell::new(),
        });
        self.count += part.sum.blocks;
        self.arcs += part.sum.arcs;
        self.travel = self.travel.plus(part.sum.travel);
    }

    fn entries(&self, part: &WayPart) -> impl Iterator<Item = &'a BlockEntry> {
        let entries = self
            .document
            .runs
            .get(part.run)
            .and_then(|run| run.entries.get(part.entries.clone()));
        entries.unwrap_or_default().iter().filter_map(Entry::block)
    }

    fn part_of(&self, index: usize) -> Option<&WayPart> {
        self.parts.get(
            self.parts
                .partition_point(|part| part.first <= index)
                .checked_sub(1)?,
        )
    }

    fn pieces<'b>(&self, part: &'b WayPart) -> &'b [Segment] {
        part.pieces.get_or_init(|| {
            let [x, y] = part.start.meant_um();
            pieces_of(self.entries(part))
                .into_iter()
                .map(|piece| piece.moved(Vector::new(x, y)))
                .collect()
        })
    }
}

impl Way for SectionWay<'_> {
    fn count(&self) -> usize {
        self.count
    }

    fn arcs(&self) -> usize {
        self.arcs
    }

    fn writing(&self) -> Writing {
        Writing::default()
    }

    fn stop(&self) -> Option<usize> {
        self.stop
    }

    fn node(&self, index: usize) -> Option<Node> {
        let at = if index == self.count {
            self.travel
        } else {
            let part = self.part_of(index)?;
            self.entries(part)
                .take(index - part.first)
                .fold(part.start, |at, entry| at.plus(entry.travel))
        };
        let ([x, y], [a, b]) = (at.meant_um(), at.machine);
        Some(Node {
            stands: Point::new(a as f64, b as f64),
            meant: Point::new(x, y),
        })
    }

    fn piece(&self, index: usize) -> Option<Segment> {
        let part = self.part_of(index).filter(|_| index < self.count)?;
        self.pieces(part).get(index - part.first).copied()
    }

    fn pieces_about(
        &self,
        at: Point,
        reach: f64,
        each: &mut dyn FnMut(usize, &Segment) -> bool,
    ) -> Option<()> {
        let place = Bounds::of_disc(at, reach + SLACK);
        for part in &self.parts {
            let [x, y] = part.start.meant_um();
            let by = Vector::new(x, y);
            let bounds = Bounds {
                min: part.bounds.min + by,
                max: part.bounds.max + by,
            };
            if bounds.touches(&place)
                && self
                    .pieces(part)
                    .iter()
                    .zip(part.first..)
                    .any(|(piece, index)| each(index, piece))
            {
                break;
            }
        }
        Some(())
    }
}

/// The pieces of blocks from the origin on; a block that leads nowhere is a piece of no length.
pub(super) fn pieces_of<'a>(blocks: impl Iterator<Item = &'a BlockEntry>) -> Vec<Segment> {
    let mut at = Move::default();
    blocks
        .map(|entry| {
            let [x, y] = at.meant_um();
            at = at.plus(entry.travel);
            let start = Point::new(x, y);
            meant(&entry.block, start).unwrap_or(Segment::line(start, start))
        })
        .collect()
}
