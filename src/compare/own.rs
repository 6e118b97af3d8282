//! A program of ours: its blocks beside those of the program that is written again. Where nine of ten blocks agree the
//! program is ours, and each of the others is named.

use super::TOLERANCE;
use super::aligned::{Aligned, PLACED, Pair, Row};
use super::corrections::of_corrections;
use super::difference::{Comparison, Difference};
use super::drawn::Drawn;
use super::traced::{Block, Motion, Traced};
use super::ways::ways;
use crate::drawing::EntityId;
use crate::finding::DifferenceKind;
use crate::geometry::Vector;

/// What differs in a program that we would write; `None` where we would not.
pub(super) fn compare(
    drawn: &Drawn,
    traced: &Traced,
    handles: Option<Vec<String>>,
) -> Option<Comparison> {
    // Each contour takes a block at least.
    let count = handles.as_ref().map_or(drawn.contours().len(), Vec::len);
    if traced.blocks.len() < count {
        return None;
    }
    let rewritten = &*drawn.rewritten(traced, handles)?;
    let aligned = Aligned::of(traced, rewritten)?;
    // Another depth, or another wear, is another number of layers: it is another program.
    let [own, ideal] = [traced, &rewritten.traced].map(|all| all.blocks.len());
    if traced.mills && own.abs_diff(ideal) > 1 {
        return None;
    }
    let mut differences = blocks(&aligned);
    differences.extend(ways(&aligned)?);
    differences.extend(of_corrections(&aligned));
    differences.sort_by_key(|one| one.range.start);
    let of_contours = aligned.pairs().filter(|pair| pair.is_of_contour());
    Some(Comparison {
        follows: of_contours.map(|pair| pair.own.range.clone()).collect(),
        differences,
    })
}

/// Blocks of contours, stops and coordinates after blocks that differ.
fn blocks(aligned: &Aligned) -> Vec<Difference> {
    let mut found = Vec::new();
    // Where the last named block was, and how far from its place it began: until the program is back there, what follows
    // is a part of the same change.
    let mut change: Option<(usize, Vector)> = None;
    for (number, row) in aligned.rows.iter().enumerate() {
        let part = |change: &mut Option<(usize, Vector)>| {
            change.take().filter(|(named, _)| number - named <= 2)
        };
        match row {
            Row::Both(pair) if pair.off <= TOLERANCE => {
                change = None;
                found.extend(stated(pair));
            }
            Row::Both(pair) if pair.is_off() => {
                let [begins, ends] = pair.away;
                let is_back = |(_, away): (usize, Vector)| (ends - away).norm() <= PLACED;
                if part(&mut change).is_some_and(is_back) {
                    continue;
                }
                change = Some((number, begins));
                let kind = DifferenceKind::Block;
                let named = Difference::of(pair.own, pair.source, pair.off, kind);
                found.extend(Some(named).filter(|_| pair.is_of_contour()));
            }
            Row::Both(_) => {}
            Row::Lost { at, ideal, .. } if ideal.motion == Motion::Stop => {
                found.extend(unstopped(aligned.traced, *at));
            }
            Row::Lost { at, ideal, source } => {
                if part(&mut change).is_none() {
                    found.extend(gap(behind(aligned.traced, *at), ideal, *source));
                }
            }
            Row::More(own) => {
                if own.motion != Motion::Stop && part(&mut change).is_none() {
                    found.extend(gap(Some(own), own, None));
                }
            }
        }
    }
    found
}

/// The coordinates after a block say something else.
fn stated(pair: &Pair) -> Option<Difference> {
    let off = pair.words.stated;
    (off > TOLERANCE).then(|| Difference::of(pair.own, None, off, DifferenceKind::Stated))
}

/// A block before which one is lost, or the last one.
fn behind(traced: &Traced, at: usize) -> Option<&Block> {
    traced.blocks.get(at).or(traced.blocks.last())
}

/// A stop that is lost before a block, where nothing stands in its place.
fn unstopped(traced: &Traced, at: usize) -> Option<Difference> {
    let block = behind(traced, at)?;
    let before = traced.blocks.get(at.checked_sub(1)?)?;
    let is_bare = traced.is_bare_between(before, block);
    is_bare.then(|| Difference::of(block, None, 0.0, DifferenceKind::Unstopped))
}

/// A block at which one is lost, or which is too many: `whole` long.
fn gap(at: Option<&Block>, whole: &Block, source: Option<(EntityId, usize)>) -> Option<Difference> {
    let block = at?;
    let length = whole
        .motion
        .ends()
        .map_or(0.0, |[start, end]| (end - start).norm());
    let kind = match source.is_some() || std::ptr::eq(block, whole) {
        true => DifferenceKind::Block,
        false => DifferenceKind::Lead,
    };
    Some(Difference::of(block, source, length, kind))
}
