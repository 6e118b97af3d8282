//! The start of each line of a text, in little more than two bytes a line.

use super::head;
use std::ops::Range;

/// Lines in one block.
const BLOCK: usize = 64;

/// The starts of the lines of a text, rising from 0. Moving all lines after a place costs a step for each block of them.
#[derive(Clone, Debug)]
pub(crate) enum LineStarts {
    /// The start of each block's first line, and the distance of each line from it.
    Near { blocks: Vec<u32>, offsets: Vec<u16> },
    /// The start of each line, for a text whose lines are too long for blocks.
    Far(Vec<u32>),
}

impl LineStarts {
    /// The lines of a text, which end with LF, CR LF or CR. A text that ends with a line end has an empty last line.
    pub(super) fn new(bytes: &[u8]) -> LineStarts {
        let about = bytes.len() / 8 + 1;
        let mut blocks = Vec::with_capacity(about / BLOCK + 1);
        let mut offsets = Vec::with_capacity(about);
        let (mut base, mut too_far) = (0, false);
        each_line_start(bytes, |start| {
            if offsets.len() % BLOCK == 0 {
                blocks.push(start);
                base = start;
            }
            too_far |= start - base > u32::from(u16::MAX);
            offsets.push((start - base) as u16);
        });
        if too_far {
            let mut starts = Vec::with_capacity(offsets.len());
            drop((blocks, offsets));
            each_line_start(bytes, |start| starts.push(start));
            return LineStarts::Far(starts);
        }
        blocks.shrink_to_fit();
        offsets.shrink_to_fit();
        LineStarts::Near { blocks, offsets }
    }

    /// Number of lines.
    pub(crate) fn len(&self) -> usize {
        match self {
            LineStarts::Near { offsets, .. } => offsets.len(),
            LineStarts::Far(starts) => starts.len(),
        }
    }

    /// Where a line begins; `None` past the last.
    #[inline]
    pub(crate) fn get(&self, line: usize) -> Option<usize> {
        match self {
            LineStarts::Near { blocks, offsets } => {
                let offset = *offsets.get(line)?;
                Some(*blocks.get(line / BLOCK)? as usize + usize::from(offset))
            }
            LineStarts::Far(starts) => starts.get(line).map(|&start| start as usize),
        }
    }

    /// The number of lines that begin at `offset` or before it.
    pub(super) fn begun_by(&self, offset: usize) -> usize {
        match self {
            LineStarts::Near { blocks, offsets } => {
                let behind = blocks.partition_point(|&start| start as usize <= offset);
                let Some((block, &begin)) = blocks.iter().enumerate().take(behind).next_back()
                else {
                    return 0;
                };
                let first = block * BLOCK;
                let of_block = head(offsets.get(first..).unwrap_or_default(), BLOCK);
                first + of_block.partition_point(|&far| begin as usize + usize::from(far) <= offset)
            }
            LineStarts::Far(starts) => starts.partition_point(|&start| start as usize <= offset),
        }
    }

    /// Replaces the starts of some lines by `fresh`, and moves all after them by `shift` (modulo 2³²).
    pub(super) fn replace(&mut self, lines: Range<usize>, fresh: &[u32], shift: u32) {
        let starts = match self {
            LineStarts::Near { blocks, offsets } => {
                match replace_near(blocks, offsets, lines.clone(), fresh, shift) {
                    true => return,
                    false => {
                        let start = |line: usize| self.get(line).unwrap_or_default() as u32;
                        let behind =
                            (lines.end..self.len()).map(|line| start(line).wrapping_add(shift));
                        (0..lines.start)
                            .map(start)
                            .chain(fresh.iter().copied())
                            .chain(behind)
                            .collect()
                    }
                }
            }
            LineStarts::Far(starts) => {
                for start in starts.iter_mut().skip(lines.end) {
                    *start = start.wrapping_add(shift);
                }
                starts.splice(lines, fresh.iter().copied());
                return;
            }
        };
        *self = LineStarts::Far(starts);
    }
}

/// False, with nothing changed, where a line is too far from the first of its block.
fn replace_near(
    blocks: &mut Vec<u32>,
    offsets: &mut Vec<u16>,
    lines: Range<usize>,
    fresh: &[u32],
    shift: u32,
) -> bool {
    let first = lines.start / BLOCK;
    // Where the number of lines stays, the blocks after only move.
    let end = match fresh.len() == lines.len() {
        true => offsets.len().min((lines.end / BLOCK + 1) * BLOCK),
        false => offsets.len(),
    };
    let start = |line: usize| {
        let block = blocks.get(line / BLOCK)?;
        Some(block.wrapping_add(u32::from(*offsets.get(line)?)))
    };
    let before = (first * BLOCK..lines.start).filter_map(start);
    let behind = (lines.end..end).filter_map(start);
    let behind = behind.map(|start| start.wrapping_add(shift));
    let (mut new_blocks, mut new_offsets) = (
        Vec::new(),
        Vec::with_capacity(end - first * BLOCK + fresh.len()),
    );
    let mut base = 0;
    for start in before.chain(fresh.iter().copied()).chain(behind) {
        if new_offsets.len() % BLOCK == 0 {
            new_blocks.push(start);
            base = start;
        }
        let Ok(offset) = u16::try_from(start.wrapping_sub(base)) else {
            return false;
        };
        new_offsets.push(offset);
    }
    let last = end.div_ceil(BLOCK);
    for block in blocks.iter_mut().skip(last) {
        *block = block.wrapping_add(shift);
    }
    blocks.splice(first..last, new_blocks);
    match end == offsets.len() {
        true => {
            offsets.truncate(first * BLOCK);
            offsets.append(&mut new_offsets);
        }
        false => _ = offsets.splice(first * BLOCK..end, new_offsets),
    }
    true
}

impl PartialEq for LineStarts {
    fn eq(&self, other: &LineStarts) -> bool {
        self.len() == other.len() && (0..self.len()).all(|line| self.get(line) == other.get(line))
    }
}

impl Eq for LineStarts {}

/// The starts of all lines. Reads eight bytes at a time: lines are so short that a search for each line end costs more
/// than looking at every byte.
fn each_line_start(bytes: &[u8], mut begins: impl FnMut(u32)) {
    const LOW: u64 = 0x7f7f_7f7f_7f7f_7f7f;
    let zero_bytes = |word: u64| !(((word & LOW) + LOW) | word | LOW);
    begins(0);
    let mut end_at = |end: usize| {
        if bytes.get(end) == Some(&b'\n') || bytes.get(end + 1) != Some(&b'\n') {
            begins(end as u32 + 1);
        }
    };
    let (words, rest) = bytes.as_chunks::<8>();
    for (index, word) in words.iter().enumerate() {
        let word = u64::from_le_bytes(*word);
        let mut ends =
            zero_bytes(word ^ 0x0a0a_0a0a_0a0a_0a0a) | zero_bytes(word ^ 0x0d0d_0d0d_0d0d_0d0d);
        while ends != 0 {
            end_at(index * 8 + ends.trailing_zeros() as usize / 8);
            ends &= ends - 1;
        }
    }
    for (index, byte) in rest.iter().enumerate() {
        if matches!(byte, b'\n' | b'\r') {
            end_at(words.len() * 8 + index);
        }
    }
}
