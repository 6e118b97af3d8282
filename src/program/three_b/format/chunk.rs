//! The lines of a program that is formatted, as the reader finds them.

use crate::geometry::{Point, Vector};
use crate::program::lookalikes::with_plain_marks;
use crate::program::three_b::around::before_comment;
use crate::program::three_b::block::Node;
use crate::program::three_b::decode::decode;
use crate::program::three_b::parse::{Item, read_line};
use crate::program::three_b::words::{Word, Words};
use crate::text::SourceText;
use std::ops::Range;

/// Some lines as the reader finds them, and what the way through the program adds.
pub(super) struct Chunk {
    pub(crate) first_line: usize,
    pub(crate) lines: Vec<Line>,
    /// Blocks, words and headers of all lines, without faults and other text.
    pub(crate) items: Vec<Item>,
    /// The ends of the blocks among them.
    pub(crate) ways: Vec<Option<Travel>>,
    /// The verdict on their stated end points, one for each item.
    pub(crate) stated: Vec<Stated>,
    /// Blocks before these lines.
    pub(crate) ordinal: u64,
    /// The end word has come before.
    pub(crate) is_over: bool,
}

pub(super) struct Line {
    /// After its last item.
    pub(crate) end: usize,
    pub(crate) is_sound: bool,
}

/// Where a block leads, µm.
#[derive(Clone, Copy)]
pub(super) struct Travel {
    pub(crate) by: Vector,
    pub(crate) is_arc: bool,
}

/// A stated end point, or the end of a block without one.
#[derive(Clone, Copy)]
pub(super) enum Stated {
    /// It is the block's own.
    Right(Node),
    /// It is not, or nobody asks: it stays.
    AsItStands,
    /// There is none; the block's own, where it is known.
    Absent(Option<Node>),
}

impl Chunk {
    pub(crate) fn read(text: &SourceText, words: &Words<'_>, lines: Range<usize>) -> Chunk {
        let mut chunk = Chunk {
            first_line: lines.start,
            lines: Vec::with_capacity(lines.len()),
            items: Vec::with_capacity(lines.len()),
            ways: Vec::with_capacity(lines.len()),
            stated: Vec::with_capacity(lines.len()),
            ordinal: 0,
            is_over: false,
        };
        for line in lines {
            // The reader skips a byte order mark at offset 0 only.
            let shift = usize::from(line > 0);
            let mut is_sound = true;
            let line = text.line(line);
            read_line(line, shift, words, |mut item| match &mut item {
                Item::Fault(_) | Item::Text { .. } => is_sound = false,
                Item::CommentedBlock { .. } => {}
                Item::Block { range, .. }
                | Item::Word { range, .. }
                | Item::StartPoint { range, .. } => {
                    *range = range.start - shift..range.end - shift;
                    chunk.ways.push(way_of(&item));
                    chunk.items.push(item);
                }
            });
            // Wide marks and spaces among the fields stay as they stand.
            let code = before_comment(line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line));
            is_sound &= code.is_ascii() || with_plain_marks(code).is_none();
            chunk.lines.push(Line {
                end: chunk.items.len(),
                is_sound,
            });
        }
        chunk
    }
}

fn way_of(item: &Item) -> Option<Travel> {
    let Item::Block { block, .. } = item else {
        return None;
    };
    let segment = decode(block, Point::origin()).ok()?;
    Some(Travel {
        by: segment.end().coords,
        is_arc: segment.as_arc().is_some(),
    })
}

pub(super) fn count_blocks(items: &[Item]) -> u64 {
    items
        .iter()
        .filter(|item| matches!(item, Item::Block { .. }))
        .count() as u64
}

pub(super) fn has_end(items: &[Item]) -> bool {
    items.iter().any(|item| {
        matches!(
            item,
            Item::Word {
                word: Word::End,
                ..
            }
        )
    })
}
