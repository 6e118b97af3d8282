//! Ways in and out and between contours, in a program of ours: which of them leads elsewhere than the settings say, and
//! which contours lie elsewhere because of it.
//!
//! A thread hole that was moved is no fault: the way in comes from there, the way out leads back there, and the contour
//! between them lies where it should.

use super::TOLERANCE;
use super::aligned::{Aligned, PLACED, Row};
use super::difference::Difference;
use super::traced::Traced;
use super::words::Words;
use crate::finding::DifferenceKind;
use crate::geometry::Vector;
use crate::program::block_words::BlockWords;
use std::ops::Range;

/// A program that lies elsewhere by more is meant to, µm.
const SLIP: f64 = 50.0;

/// A block of the program and the one beside it, by their numbers.
type Facing = (usize, usize);

/// The rows of one cut, and of the way to it.
struct Cut<'a> {
    bridge: &'a [Facing],
    ways_in: &'a [Facing],
    contour: &'a [Facing],
    ways_out: &'a [Facing],
    /// The number of its first block.
    start: usize,
}

/// `None` where a contour begins elsewhere than under the settings: the program is not written by them.
pub(super) fn leads(aligned: &Aligned) -> Option<Vec<Difference>> {
    let both = aligned.rows.iter().filter_map(|row| match *row {
        Row::Both { own, ideal } => Some((own, ideal)),
        _ => None,
    });
    let rows: Vec<Facing> = both.collect();
    let within = |range: Range<usize>| {
        let from = rows.partition_point(|(_, ideal)| *ideal < range.start);
        let to = rows.partition_point(|(_, ideal)| *ideal < range.end);
        rows.get(from..to.max(from)).unwrap_or_default()
    };
    let is_of_contour = |(_, ideal): &Facing| aligned.source(*ideal).is_some();
    let mut found = Vec::new();
    let away = aligned.from.norm();
    if (TOLERANCE..=SLIP).contains(&away) && !aligned.traced.is_relative {
        found.extend(aligned.start(0, away));
    }
    let (mut carried, mut last) = (Vector::zeros(), 0);
    // As the rewritten program has them: one that is changed may be read otherwise.
    for range in aligned.rewritten.traced.cuts.iter().map(|cut| &cut.blocks) {
        let rows = within(range.clone());
        let (Some(first), Some(end)) = (
            rows.iter().position(is_of_contour),
            rows.iter().rposition(is_of_contour),
        ) else {
            continue;
        };
        let cut = Cut {
            bridge: within(last..range.start),
            ways_in: &rows[..first],
            contour: &rows[first..=end],
            ways_out: &rows[end + 1..],
            start: rows.first().map_or(0, |(own, _)| *own),
        };
        last = range.end;
        if aligned.begins_elsewhere(&cut) {
            return None;
        }
        found.extend(aligned.way(&cut, &mut carried));
    }
    Some(found)
}

impl Aligned<'_> {
    /// How far a block is off, µm.
    fn off(&self, (own, ideal): Facing) -> f64 {
        let pair = self.pair(own, ideal);
        pair.map_or(0.0, |(own, ideal)| {
            Words::of(self, own, ideal).off(own, ideal)
        })
    }

    /// The first block that leads elsewhere and says something else.
    fn first_off(&self, rows: &[Facing]) -> Option<Facing> {
        let is_other = |(own, ideal): Facing| {
            let pair = self.pair(own, ideal);
            pair.is_some_and(|(own, ideal)| !Words::of(self, own, ideal).are_same)
        };
        let mut rows = rows.iter().copied();
        rows.find(|row| self.off(*row) > TOLERANCE && is_other(*row))
    }

    /// Both ends of a contour are others, and so are both ways.
    fn begins_elsewhere(&self, cut: &Cut) -> bool {
        let ends = [cut.contour.first(), cut.contour.last()];
        let are_others = ends
            .into_iter()
            .flatten()
            .all(|row| self.off(*row) > TOLERANCE);
        are_others
            && self.first_off(cut.ways_in).is_some()
            && self.first_off(cut.ways_out).is_some()
    }

    /// The way to a contour or from it that is wrong. `carried`: how far the contour before ended from its place, and then
    /// this one.
    fn way(&self, cut: &Cut, carried: &mut Vector) -> Option<Difference> {
        let begins = |row: &Facing| Some(self.ends_away(row.0, row.1)?[0]);
        let ends = |row: &Facing| Some(self.ends_away(row.0, row.1)?[1]);
        let is_relative = self.traced.is_relative;
        let (first, last) = (cut.contour.first()?, cut.contour.last()?);
        let (begin, end) = (begins(first)?, ends(last)?);
        let expected = if is_relative {
            *carried
        } else {
            Vector::zeros()
        };
        *carried = end;
        if begin.norm() > TOLERANCE && (begin - expected).norm() > TOLERANCE {
            let off = (begin - expected).norm();
            let mut ways = [cut.bridge, cut.ways_in].into_iter();
            let Some(way) = ways.find_map(|ways| self.first_off(ways)) else {
                return self.start(cut.start, off);
            };
            // What goes on where it should lies there; only the way to it is wrong.
            let kind = match ends(first)?.norm() <= PLACED {
                true => DifferenceKind::Lead,
                false => DifferenceKind::Moved,
            };
            let source = self
                .source(first.1)
                .filter(|_| kind == DifferenceKind::Moved);
            let block = self.traced.blocks.get(way.0)?;
            return Some(Difference::of(block, source, off, kind));
        }
        let named = |row: Facing, off: f64| {
            let block = self.traced.blocks.get(row.0)?;
            Some(Difference::of(block, None, off, DifferenceKind::Lead))
        };
        let hole = cut.ways_in.first().and_then(begins).unwrap_or(begin);
        let back = cut.ways_out.last().and_then(ends).unwrap_or(end);
        let drift = if is_relative {
            end - begin
        } else {
            Vector::zeros()
        };
        let gap = (back - hole - drift).norm();
        if gap > TOLERANCE {
            if let Some(way) = self.first_off(cut.ways_out) {
                return named(way, gap);
            }
            let ways = [cut.bridge, cut.ways_in];
            return match ways.into_iter().find_map(|ways| self.first_off(ways)) {
                Some(way) => named(way, gap),
                None => self.start(cut.start, gap),
            };
        }
        // At the ends of a tab the wire goes from pass to pass.
        let is_between = |(_, ideal): &&Facing| self.source(*ideal).is_none();
        let between: Vec<Facing> = cut.contour.iter().filter(is_between).copied().collect();
        // From another hole the ways are others; from the same one, one of them is wrong.
        let ways = match (hole - begin).norm() > TOLERANCE {
            true => [&[][..], &between, &[]],
            false => [cut.ways_in, &between, cut.ways_out],
        };
        // A number that only the machine reads.
        let is_in_place = |row: &&Facing| {
            let ends = self.ends_away(row.0, row.1).unwrap_or_default();
            ends.iter().all(|away| away.norm() <= PLACED)
        };
        let bridge: Vec<Facing> = cut.bridge.iter().filter(is_in_place).copied().collect();
        if let Some(way) = self.first_off(&bridge) {
            return named(way, self.off(way));
        }
        let way = ways.into_iter().find_map(|ways| self.first_off(ways))?;
        named(way, self.off(way))
    }

    /// The line before a block in which an ISO program states where it begins, where that says something else.
    fn start(&self, block: usize, off: f64) -> Option<Difference> {
        let first = self.traced.blocks.get(block)?;
        let before = block
            .checked_sub(1)
            .and_then(|before| self.traced.blocks.get(before));
        let from = before.map_or(0, |before| before.line + 1);
        let own = starts(self.traced);
        let ideal = starts(&self.rewritten.traced);
        let mut both = own.into_iter().zip(ideal);
        let is_it = |line: usize| (from..=first.line).contains(&line);
        let ((line, range, _), _) =
            both.find(|((line, _, own), (_, _, ideal))| is_it(*line) && !own.is_like(ideal))?;
        Some(Difference {
            range,
            line,
            ..Difference::of(first, None, off, DifferenceKind::Lead)
        })
    }
}

/// The lines in which an ISO program states where it is.
fn starts(traced: &Traced) -> Vec<(usize, Range<usize>, BlockWords)> {
    if traced.counts {
        return Vec::new();
    }
    let lines = (0..traced.text.line_count()).map(|line| (line, traced.text.line_range(line)));
    let words = lines.map(|(line, range)| (line, range.clone(), traced.said_in(range)));
    words.filter(|(_, _, words)| words.sets_place()).collect()
}
