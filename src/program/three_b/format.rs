//! Text of a program in one of its layouts: the same blocks, words and comments, and nothing of what they do changed.
//!
//! A line is written anew from what the reader finds in it and read again before it counts. Damaged lines, headings and lines whose
//! new form would say anything else stay byte for byte as they are.

use super::pieces::{Field, Piece, pieces};
use crate::geometry::{Point, Vector};
use crate::program::alike::with_plain_marks;
use crate::program::edits::{self, AT_ONCE, LineEdits};
use crate::program::three_b::block::{Block, Node, PartArc};
use crate::program::three_b::decode::decode;
use crate::program::three_b::encode::{point_of, snap as node_of};
use crate::program::three_b::layout::{
    push_block_number, push_end_point, push_fields, push_to_comment_column,
};
use crate::program::three_b::parse::{Item, StatedPoint, Word, Words, before_comment, read_line};
use crate::settings::Layout;
use crate::text::{SourceText, TextEdit};
use rayon::prelude::*;
use std::borrow::Cow;
use std::ops::Range;

/// How far a stated end point may lie from the block's own and still be it: 2 µm, and 1 µm for each arc since the last one.
const STATED_TOLERANCE: f64 = 2.0;

/// Blocks that are looked at to find out in which layout a text stands.
const LOOKED_AT: usize = 1000;

/// The edits that bring `lines` into a layout, sorted and disjoint; without a layout, into the one in which most blocks stand.
///
/// Blocks, words, block numbers, comments and the header with the start stay. Block numbers and end points of the checking layout
/// are left out of the other two together; an end point that is not the block's own is a fault and stays in every layout. Each block
/// gets a line of its own. Formatting twice is formatting once.
pub fn format(
    text: &SourceText,
    layout: Option<Layout>,
    words: &Words<'_>,
    lines: Range<usize>,
) -> Vec<TextEdit> {
    let layout = layout.unwrap_or_else(|| layout_of(text, words));
    // The numbers of the checking layout hang on all blocks, the rest on those before.
    let end = if layout == Layout::Checking {
        text.line_count()
    } else {
        lines.end.min(text.line_count())
    };
    let read = |first: usize| Chunk::read(text, words, first..(first + AT_ONCE).min(end));
    let firsts: Vec<usize> = (0..end).step_by(AT_ONCE).collect();
    let mut chunks: Vec<Chunk> = if firsts.len() > 2 {
        firsts.into_par_iter().map(read).collect()
    } else {
        firsts.into_iter().map(read).collect()
    };
    let numbers_count_blocks = numbers_count_blocks(&chunks);
    let mut walk = Walk::new(layout);
    chunks.iter_mut().for_each(|chunk| walk.go_through(chunk));
    edits::formed(text, &chunks, |chunk| {
        chunk.form(text, words, layout, numbers_count_blocks, &lines)
    })
}

/// The layout in which most of the first blocks stand.
fn layout_of(text: &SourceText, words: &Words<'_>) -> Layout {
    // Compact, aligned, checking.
    let mut votes = [0_usize; 3];
    for line in 0..text.line_count() {
        let bytes = &text.bytes()[text.line_range(line)];
        read_line(bytes, 0, words, |item| {
            let Item::Block {
                range, stated_end, ..
            } = item
            else {
                return;
            };
            let spaced = bytes.get(range).is_some_and(|block| block.contains(&b' '));
            votes[if stated_end.is_some() {
                2
            } else {
                usize::from(spaced)
            }] += 1;
        });
        if votes.iter().sum::<usize>() >= LOOKED_AT {
            break;
        }
    }
    let most = votes.iter().copied().max().unwrap_or(0);
    match votes {
        [compact, ..] if compact == most => Layout::Compact,
        [_, aligned, _] if aligned == most => Layout::Aligned,
        _ => Layout::Checking,
    }
}

/// True where every block that has a number has its own ordinal.
fn numbers_count_blocks(chunks: &[Chunk]) -> bool {
    let numbers = chunks
        .iter()
        .flat_map(|chunk| &chunk.items)
        .filter_map(|item| match item {
            Item::Block { number, .. } => Some(*number),
            _ => None,
        });
    numbers
        .zip(1_u32..)
        .all(|(number, ordinal)| number.is_none_or(|number| number == ordinal))
}

/// Some lines as the reader finds them, and what comes of them on the way through the program.
struct Chunk {
    first_line: usize,
    lines: Vec<Line>,
    /// Blocks, words and headers of all lines, without faults and other text.
    items: Vec<Item>,
    /// Where the blocks among them lead.
    ways: Vec<Option<Way>>,
    /// What their stated end points are worth, one for each item.
    stated: Vec<Stated>,
    /// Blocks before these lines.
    ordinal: u64,
    /// The end word has come before.
    is_over: bool,
}

struct Line {
    /// Behind its last item.
    end: usize,
    is_sound: bool,
}

/// Where a block leads, µm.
#[derive(Clone, Copy)]
struct Way {
    by: Vector,
    is_arc: bool,
}

impl Chunk {
    fn read(text: &SourceText, words: &Words<'_>, lines: Range<usize>) -> Chunk {
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
            read_line(
                &text.bytes()[text.line_range(line)],
                shift,
                words,
                |mut item| match &mut item {
                    Item::Fault(_) | Item::Text { .. } => is_sound = false,
                    Item::CommentedBlock { .. } => {}
                    Item::Block { range, .. }
                    | Item::Word { range, .. }
                    | Item::StartPoint { range, .. } => {
                        *range = range.start - shift..range.end - shift;
                        chunk.ways.push(way_of(&item));
                        chunk.items.push(item);
                    }
                },
            );
            // Wide marks and spaces among the fields stay as they stand.
            let line = &text.bytes()[text.line_range(line)];
            let code = before_comment(line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line));
            is_sound &= code.is_ascii() || with_plain_marks(code).is_none();
            chunk.lines.push(Line {
                end: chunk.items.len(),
                is_sound,
            });
        }
        chunk
    }

    /// The edits of those of its lines that are asked for.
    fn form(
        &self,
        text: &SourceText,
        words: &Words<'_>,
        layout: Layout,
        numbers_count_blocks: bool,
        lines: &Range<usize>,
    ) -> LineEdits {
        let mut edits = LineEdits::default();
        let (mut ordinal, mut is_over, mut first) = (self.ordinal, self.is_over, 0);
        for (line, Line { end, is_sound }) in (self.first_line..).zip(&self.lines) {
            let (items, stated) = (&self.items[first..*end], &self.stated[first..*end]);
            if lines.contains(&line) {
                let range = text.line_range(line);
                let bytes = &text.bytes()[range.clone()];
                let pieces = Vec::new();
                let mut writer = Writer {
                    words,
                    layout,
                    numbers_count_blocks,
                    ordinal,
                    is_over,
                    items,
                    stated,
                    pieces,
                    is_sound: *is_sound,
                };
                if let Some(formed) = writer.form(bytes, line_end(text, line)) {
                    replace(&mut edits, text, line, formed);
                }
            }
            ordinal += count_blocks(items);
            is_over |= has_end(items);
            first = *end;
        }
        edits
    }
}

fn way_of(item: &Item) -> Option<Way> {
    let Item::Block { block, .. } = item else {
        return None;
    };
    let segment = decode(block, Point::origin()).ok()?;
    Some(Way {
        by: segment.end().coords,
        is_arc: segment.as_arc().is_some(),
    })
}

fn count_blocks(items: &[Item]) -> u64 {
    items
        .iter()
        .filter(|item| matches!(item, Item::Block { .. }))
        .count() as u64
}

fn has_end(items: &[Item]) -> bool {
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

/// The line end of a line; of the one before it where it has none.
fn line_end(text: &SourceText, line: usize) -> &str {
    let end_of = |line: usize| {
        let bytes = text
            .bytes()
            .get(text.line_range(line).end..text.line_start(line + 1))
            .unwrap_or_default();
        std::str::from_utf8(bytes)
            .ok()
            .filter(|end| !end.is_empty())
    };
    end_of(line)
        .or_else(|| end_of(line.checked_sub(1)?))
        .unwrap_or("\n")
}

/// A line in its new form: text, and the bytes of the old line that stand behind it as they are.
struct Formed {
    /// From here on the old line is replaced: behind a byte order mark.
    from: usize,
    head: String,
    kept: Range<usize>,
}

/// The way through a program, line by line.
struct Walk {
    layout: Layout,
    /// Blocks so far.
    ordinal: u64,
    stand: Stand,
    /// The end word has come: nothing behind it is formatted.
    is_over: bool,
}

impl Walk {
    fn new(layout: Layout) -> Walk {
        Walk {
            layout,
            ordinal: 0,
            stand: Stand {
                at: Point::origin(),
                trust: Trust::Known,
                arcs: 0.0,
            },
            is_over: false,
        }
    }

    /// Follows the machine through some lines.
    fn go_through(&mut self, chunk: &mut Chunk) {
        (chunk.ordinal, chunk.is_over) = (self.ordinal, self.is_over);
        let mut first = 0;
        for Line { end, is_sound } in &chunk.lines {
            if !is_sound {
                self.stand.trust = Trust::Lost;
            }
            for (item, way) in chunk.items[first..*end]
                .iter()
                .zip(&chunk.ways[first..*end])
            {
                let stand = &mut self.stand;
                let mut stated = Stated::Absent(None);
                match item {
                    Item::Block { stated_end, .. } => {
                        stated = stand.go_on(*stated_end, *way, self.layout)
                    }
                    Item::Word {
                        word: Word::Pause, ..
                    } if stand.trust == Trust::Known => stand.trust = Trust::UnlessStated,
                    Item::StartPoint { at: [x, y], .. } => {
                        *stand = Stand {
                            at: Point::new(x * 1000.0, y * 1000.0),
                            trust: Trust::Known,
                            arcs: 0.0,
                        };
                    }
                    Item::Word { .. }
                    | Item::Text { .. }
                    | Item::CommentedBlock { .. }
                    | Item::Fault(_) => {}
                }
                chunk.stated.push(stated);
            }
            first = *end;
        }
        self.ordinal += count_blocks(&chunk.items);
        self.is_over |= has_end(&chunk.items);
    }
}

/// Writes one line anew.
struct Writer<'a> {
    words: &'a Words<'a>,
    layout: Layout,
    numbers_count_blocks: bool,
    /// Blocks before this line.
    ordinal: u64,
    is_over: bool,
    items: &'a [Item],
    stated: &'a [Stated],
    pieces: Vec<Piece>,
    is_sound: bool,
}

impl Writer<'_> {
    /// The line in its new form, `None` where it stays as it is.
    fn form(&mut self, line: &[u8], line_end: &str) -> Option<Formed> {
        self.pieces = pieces(line, self.words);
        let from = if line.starts_with(b"\xef\xbb\xbf") {
            3
        } else {
            0
        };
        let end = line
            .iter()
            .rposition(|byte| !matches!(byte, b' ' | b'\t'))
            .map_or(0, |last| last + 1)
            .max(from);
        let trimmed = || {
            (end < line.len()).then(|| Formed {
                from: line.len(),
                head: String::new(),
                kept: from..end,
            })
        };
        let is_strange = |byte: &u8| matches!(byte, 0x0b | 0x0c | 0x1a);
        if !self.is_sound || self.is_over || line.iter().any(is_strange) {
            return None;
        }
        let has = |field: Field| {
            self.pieces
                .iter()
                .filter(|piece| piece.field == field)
                .count()
        };
        let numbers = self
            .items
            .iter()
            .filter(|item| {
                matches!(
                    item,
                    Item::Block {
                        number: Some(_),
                        ..
                    } | Item::Word {
                        number: Some(_),
                        ..
                    }
                )
            })
            .count();
        // A header stands alone; a number that no block has would be lost.
        if self.items.is_empty()
            || has(Field::StartPoint) > 0
            || has(Field::Strange) > 0
            || has(Field::Number) != numbers
        {
            return trimmed();
        }
        let mut head = Vec::with_capacity(64);
        let mut last_block = None;
        let mut ordinal = self.ordinal;
        for (index, (item, &stated)) in self.items.iter().zip(self.stated).enumerate() {
            if index > 0 {
                head.extend_from_slice(line_end.as_bytes());
            }
            match item {
                Item::Block {
                    block,
                    number,
                    range,
                    part,
                    ..
                } => {
                    ordinal += 1;
                    let numbers = (*number, ordinal);
                    self.push_block(
                        &mut head,
                        (block, part.as_ref()),
                        numbers,
                        stated,
                        self.coordinates_behind(line, range.end),
                    )?;
                    last_block = Some(block);
                }
                Item::Word { range, number, .. } => {
                    if let Some(number) = number {
                        self.push_number(&mut head, *number)?;
                    }
                    head.extend(line.get(range.clone())?.to_ascii_uppercase());
                    last_block = None;
                }
                Item::StartPoint { .. }
                | Item::Text { .. }
                | Item::CommentedBlock { .. }
                | Item::Fault(_) => return trimmed(),
            }
        }
        let comment = self
            .pieces
            .last()
            .filter(|piece| piece.field == Field::Comment)
            .map(|piece| piece.range.clone());
        if let Some(comment) = &comment {
            match last_block {
                Some(block) if self.layout == Layout::Aligned => {
                    push_to_comment_column(&mut head, block)
                }
                _ => head.push(b' '),
            }
            // Behind coordinates a remark without its mark would belong to them.
            if memchr::memchr(b';', &head).is_some() && line.get(comment.start) != Some(&b';') {
                head.extend_from_slice(b"; ");
            }
        }
        let kept = comment.map_or(end..end, |comment| comment.start..end);
        let formed = Formed {
            from,
            head: String::from_utf8(head).ok()?,
            kept,
        };
        let is_same = formed.from == from
            && end == line.len()
            && line.get(from..formed.kept.start) == Some(formed.head.as_bytes());
        (!is_same && self.reads_the_same(line, &formed)).then_some(formed)
    }

    fn push_number(&self, head: &mut Vec<u8>, number: u32) -> Option<()> {
        match self.layout {
            // It stands for whatever was too large.
            _ if number == u32::MAX => return None,
            Layout::Compact => head.extend_from_slice(format!("N{number} ").as_bytes()),
            Layout::Aligned | Layout::Checking => push_block_number(head, number.into()),
        }
        Some(())
    }

    fn push_block(
        &self,
        head: &mut Vec<u8>,
        (block, part): (&Block, Option<&PartArc>),
        (number, ordinal): (Option<u32>, u64),
        stated: Stated,
        coordinates: &[u8],
    ) -> Option<()> {
        const BLANK_NUMBER: &[u8] = b"        ";
        match (self.layout, number) {
            (Layout::Compact | Layout::Aligned, Some(_)) if matches!(stated, Stated::Right(_)) => {}
            (_, Some(number)) => self.push_number(head, number)?,
            (Layout::Checking, None) if self.numbers_count_blocks => {
                push_block_number(head, ordinal)
            }
            (Layout::Checking, None) => head.extend_from_slice(BLANK_NUMBER),
            (_, None) => {}
        }
        push_fields(head, self.layout, block, part);
        match (self.layout, stated) {
            (_, Stated::Wrong) => {
                push_to_comment_column(head, block);
                if !coordinates.starts_with(b";") {
                    head.extend_from_slice(b"; ");
                }
                head.extend_from_slice(coordinates);
            }
            (Layout::Checking, Stated::Right(node) | Stated::Absent(Some(node))) => {
                push_to_comment_column(head, block);
                push_end_point(head, node);
            }
            _ => {}
        }
        Some(())
    }

    /// The coordinates as they stand behind a block that ends at `end`.
    fn coordinates_behind<'l>(&self, line: &'l [u8], end: usize) -> &'l [u8] {
        let piece = self
            .pieces
            .get(self.pieces.partition_point(|piece| piece.range.start < end));
        piece
            .filter(|piece| piece.field == Field::Coordinates)
            .and_then(|piece| line.get(piece.range.clone()))
            .unwrap_or_default()
    }

    /// Reads the new form and compares: the same blocks, numbers that stand, words, in the same order, and no fault.
    fn reads_the_same(&self, line: &[u8], formed: &Formed) -> bool {
        let mut again: Vec<Item> = Vec::with_capacity(self.items.len());
        let text = match line.get(formed.kept.clone()) {
            Some(kept) if !kept.is_empty() => Cow::Owned([formed.head.as_bytes(), kept].concat()),
            _ => Cow::Borrowed(formed.head.as_bytes()),
        };
        for part in text.split(|byte| matches!(byte, b'\n' | b'\r')) {
            read_line(part, 1, self.words, |item| again.push(item));
        }
        let is_same = |(old, new): (&Item, &Item)| match (old, new) {
            (
                Item::Block {
                    block: old,
                    number,
                    stated_end,
                    part,
                    ..
                },
                Item::Block {
                    block: new,
                    number: new_number,
                    stated_end: new_end,
                    part: new_part,
                    ..
                },
            ) => {
                let number_is_kept =
                    new_number.is_none() || number.is_none() || number == new_number;
                let end_is_kept = match (stated_end, new_end) {
                    (Some(old), Some(new)) => {
                        (0..2).all(|axis| (old.at[axis] - new.at[axis]).abs() <= 0.0006)
                    }
                    _ => true,
                };
                old == new && part == new_part && number_is_kept && end_is_kept
            }
            (
                Item::Word {
                    word: old, number, ..
                },
                Item::Word {
                    word: new,
                    number: new_number,
                    ..
                },
            ) => old == new && number == new_number,
            _ => false,
        };
        again.len() == self.items.len() && self.items.iter().zip(&again).all(is_same)
    }
}

/// Where the machine stands.
#[derive(Clone, Copy)]
struct Stand {
    /// µm.
    at: Point,
    trust: Trust,
    /// Arcs since a place that was told.
    arcs: f64,
}

impl Stand {
    /// Moves on to a block's end, and tells what its stated end point is worth.
    ///
    /// Where stated points stay in the text, what follows is held against them; where they go, against the blocks alone, so that
    /// formatting again finds the same.
    fn go_on(&mut self, stated: Option<StatedPoint>, way: Option<Way>, layout: Layout) -> Stated {
        let stated = stated
            .and_then(|StatedPoint { at: [x, y], .. }| node_of(Point::new(x * 1000.0, y * 1000.0)));
        let told = if layout == Layout::Checking {
            stated
        } else {
            None
        };
        match way {
            Some(Way { by, is_arc }) => {
                self.arcs += f64::from(u8::from(is_arc));
                self.at += by;
            }
            // The block means nothing: from here on only a stated point says where the machine is.
            None => self.trust = Trust::Lost,
        }
        if let Some(node) = told
            && (self.trust != Trust::Known || self.is_near(node))
        {
            *self = Stand {
                at: point_of(node),
                trust: Trust::Known,
                arcs: 0.0,
            };
            return Stated::Right(node);
        }
        match (stated, self.trust) {
            (Some(node), Trust::Known | Trust::UnlessStated) if self.is_near(node) => {
                Stated::Right(node)
            }
            (Some(_), _) => Stated::Wrong,
            (None, Trust::Lost) => Stated::Absent(None),
            (None, _) => Stated::Absent(node_of(self.at)),
        }
    }

    fn is_near(&self, node: Node) -> bool {
        (point_of(node) - self.at).norm() <= STATED_TOLERANCE + self.arcs
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Trust {
    Known,
    /// The table may have been moved by hand while the wire was out: a stated point says where to.
    UnlessStated,
    /// Behind something damaged.
    Lost,
}

/// A stated end point, or where the block ends without one.
#[derive(Clone, Copy)]
enum Stated {
    /// It is the block's own.
    Right(Node),
    Wrong,
    /// There is none; the block's own, where it is known.
    Absent(Option<Node>),
}

fn replace(edits: &mut LineEdits, text: &SourceText, line: usize, formed: Formed) {
    let range = text.line_range(line);
    let old = text.bytes().get(range.clone()).unwrap_or_default();
    let Formed { from, head, kept } = formed;
    let behind = TextEdit::new(range.start + kept.end..range.end, "");
    match std::str::from_utf8(old.get(kept.clone()).unwrap_or_default()) {
        // Only space at the end goes.
        Ok(_) if from >= old.len() => edits.push(text, 0..0, behind),
        Ok(kept) => {
            let new = TextEdit::new(range.start + from..range.end, head + kept);
            edits.push(text, line..line + 1, new);
        }
        // Bytes in another code page are not touched, so they are in no edit.
        Err(_) => {
            let before = range.start + from.min(kept.start)..range.start + kept.start;
            edits.push(text, 0..0, TextEdit::new(before, head));
            edits.push(text, 0..0, behind);
        }
    }
}

#[cfg(test)]
mod tests;
