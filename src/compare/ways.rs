//! Ways in and out and between contours, in a program of ours: which of them leads elsewhere than the settings say, and
//! which contours lie elsewhere because of it.
//!
//! A thread hole that was moved is no fault: the way in comes from there, the way out leads back there, and the contour
//! between them lies where it should.

use super::TOLERANCE;
use super::aligned::{Aligned, PLACED, Pair};
use super::difference::Difference;
use super::traced::Traced;
use crate::finding::DifferenceKind;
use crate::geometry::Vector;
use crate::program::block_words::BlockWords;
use std::ops::Range;

/// A program that lies elsewhere by more is meant to, µm.
const SLIP: f64 = 50.0;

/// The pairs of one cut, and of the way to it.
struct Cut<'a> {
    bridge: &'a [Pair<'a>],
    ways_in: &'a [Pair<'a>],
    contour: &'a [Pair<'a>],
    ways_out: &'a [Pair<'a>],
}

/// `None` where a contour begins elsewhere than under the settings: the program is not written by them.
pub(super) fn ways(aligned: &Aligned) -> Option<Vec<Difference>> {
    let pairs: Vec<Pair> = aligned.pairs().copied().collect();
    let within = |range: Range<usize>| {
        let from = pairs.partition_point(|pair| pair.nth < range.start);
        let to = pairs.partition_point(|pair| pair.nth < range.end);
        pairs.get(from..to.max(from)).unwrap_or_default()
    };
    let mut found = Vec::new();
    let away = aligned.from.norm();
    if (TOLERANCE..=SLIP).contains(&away) && !aligned.traced.is_relative {
        found.extend(start(aligned, 0, away));
    }
    let (mut carried, mut last) = (Vector::zeros(), 0);
    // As the rewritten program has them: one that is changed may be read otherwise.
    for range in aligned.rewritten.traced.cuts.iter().map(|cut| &cut.blocks) {
        let rows = within(range.clone());
        let (Some(first), Some(end)) = (
            rows.iter().position(Pair::is_of_contour),
            rows.iter().rposition(Pair::is_of_contour),
        ) else {
            continue;
        };
        let cut = Cut {
            bridge: within(last..range.start),
            ways_in: &rows[..first],
            contour: &rows[first..=end],
            ways_out: &rows[end + 1..],
        };
        last = range.end;
        // Both ends of a contour are others, and so are both ways.
        let ends = [&rows[first], &rows[end]];
        let begins_elsewhere = ends.into_iter().all(|pair| pair.off > TOLERANCE);
        let are_off = |ways: &[Pair]| ways.iter().any(Pair::is_off);
        if begins_elsewhere && are_off(cut.ways_in) && are_off(cut.ways_out) {
            return None;
        }
        found.extend(way(aligned, &cut, &mut carried));
    }
    Some(found)
}

/// The way to a contour or from it that is wrong. `carried`: how far the contour before ended from its place, and then
/// this one.
fn way(aligned: &Aligned, cut: &Cut, carried: &mut Vector) -> Option<Difference> {
    let is_relative = aligned.traced.is_relative;
    let (first, last) = (cut.contour.first()?, cut.contour.last()?);
    let ([begin, _], [_, end]) = (first.away, last.away);
    let [expected, drift] = match is_relative {
        true => [*carried, end - begin],
        false => [Vector::zeros(); 2],
    };
    *carried = end;
    let hole = cut.ways_in.first().map_or(begin, |way| way.away[0]);
    let back = cut.ways_out.last().map_or(end, |way| way.away[1]);
    let (astray, gap) = ((begin - expected).norm(), (back - hole - drift).norm());
    let is_astray = begin.norm() > TOLERANCE && astray > TOLERANCE;
    // At the ends of a tab the wire goes from pass to pass.
    let between = cut.contour.iter().filter(|pair| !pair.is_of_contour());
    // A number that only the machine reads.
    let is_in_place = |pair: &&Pair| pair.away.iter().all(|away| away.norm() <= PLACED);
    let bridge = cut.bridge.iter().filter(is_in_place);
    let mut ways: Vec<&Pair> = Vec::new();
    if is_astray {
        ways.extend(cut.bridge.iter().chain(cut.ways_in));
    } else if gap > TOLERANCE {
        ways.extend(cut.ways_out.iter().chain(cut.bridge).chain(cut.ways_in));
    } else if (hole - begin).norm() > TOLERANCE {
        // From another hole the ways are others; from the same one, one of them is wrong.
        ways.extend(bridge.chain(between));
    } else {
        ways.extend(bridge.chain(cut.ways_in).chain(between).chain(cut.ways_out));
    }
    let off = if is_astray { astray } else { gap };
    let Some(way) = ways.into_iter().find(|way| way.is_off()) else {
        let at = cut.ways_in.first().map_or(first.at, |way| way.at);
        return (off > TOLERANCE).then(|| start(aligned, at, off))?;
    };
    // What goes on where it should lies there; only the way to it is wrong.
    let kind = match is_astray && first.away[1].norm() > PLACED {
        true => DifferenceKind::Moved,
        false => DifferenceKind::Lead,
    };
    let source = first.source.filter(|_| kind == DifferenceKind::Moved);
    let off = if off > TOLERANCE { off } else { way.off };
    Some(Difference::of(way.own, source, off, kind))
}

/// The line before a block in which an ISO program states where it begins, where that says something else.
fn start(aligned: &Aligned, block: usize, off: f64) -> Option<Difference> {
    let blocks = &aligned.traced.blocks;
    let first = blocks.get(block)?;
    let before = block.checked_sub(1).and_then(|before| blocks.get(before));
    let lines = before.map_or(0, |before| before.line + 1)..=first.line;
    let both = starts(aligned.traced)
        .into_iter()
        .zip(starts(&aligned.rewritten.traced));
    let mut others = both.filter(|((.., own), (.., ideal))| !own.is_like(ideal));
    let ((line, range, _), _) = others.find(|((line, ..), _)| lines.contains(line))?;
    Some(Difference {
        range,
        line,
        ..Difference::of(first, None, off, DifferenceKind::Lead)
    })
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
