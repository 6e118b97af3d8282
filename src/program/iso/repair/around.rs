//! The lines of a cut, and what is known of it from those before them; and two of them exchanged.

use crate::program::iso::block::Block;
use crate::program::iso::document::Document;
use crate::program::iso::plain::word_in;
use std::ops::Range;

/// Longer cuts, in lines, are not searched.
pub(super) const LONGEST: usize = 4_000;

/// The lines between the stops around a line, or between the places where subprograms begin, end and are called; more
/// than [`LONGEST`] where there are too many.
pub(super) fn cut_around(document: &Document, line: usize) -> Range<usize> {
    cut_within(document, line, LONGEST)
}

/// The same, up to this many lines before and behind.
pub(in crate::program::iso) fn cut_within(
    document: &Document,
    line: usize,
    most: usize,
) -> Range<usize> {
    let is_order_kept = document.order().is_none();
    let ends_with = |line: usize| {
        let block = document.block(line);
        block.stop.is_some() || (!is_order_kept && (block.call.is_some() || block.returns))
    };
    let begins_with = |line: usize| {
        let block = document.block(line);
        let is_called = |number: u32| document.calls(number);
        !is_order_kept && (block.program.is_some() || block.number.is_some_and(is_called))
    };
    let count = document.text().line_count();
    let mut first = line;
    while first > 0 && line - first <= most && !begins_with(first) && !ends_with(first - 1) {
        first -= 1;
    }
    let mut end = line + 1;
    while end < count && end - line <= most && !ends_with(end - 1) && !begins_with(end) {
        end += 1;
    }
    first..end
}

/// True where the lines of a cut hold all of it. The search makes no corners of the control, and an arc begins where
/// such a corner ends; it knows no variables; and with subprograms a cut may have begun before its lines.
pub(super) fn stands_alone(document: &Document, lines: &Range<usize>) -> bool {
    let (mut has_corner, mut has_arc) = (false, false);
    for block in lines.clone().map(|line| document.block(line)) {
        has_corner |= block.corner.is_some();
        has_arc |= block.has_center();
    }
    let is_begun = || document.begun_cut(lines.start).count() > 0;
    let has_variable = lines
        .clone()
        .any(|line| memchr::memchr(b'#', document.line_bytes(line)).is_some());
    let reaches_back = has_corner && has_arc || document.order().is_some() && is_begun();
    !has_variable && !reaches_back
}

/// True for a line of the way itself.
pub(super) fn is_way(block: &Block) -> bool {
    !(block.empty || block.sets_position || block.takes_coordinates)
}

/// Two lines exchanged; their block numbers stay where they are.
pub(super) fn with_numbers_kept(one: &[u8], other: &[u8]) -> Vec<Vec<u8>> {
    let number = |line: &[u8]| word_in(line, |letter, _| letter == b'N');
    match (number(one), number(other)) {
        (Some(a), Some(b)) => {
            let with = |line: &[u8], place: Range<usize>, number: &[u8]| {
                let mut line = line.to_vec();
                line.splice(place, number.iter().copied());
                line
            };
            vec![
                with(other, b.clone(), &one[a.clone()]),
                with(one, a, &other[b]),
            ]
        }
        _ => vec![other.to_vec(), one.to_vec()],
    }
}
