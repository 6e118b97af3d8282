//! Text of a program in one of its layouts: the same blocks, words and comments, and nothing of what they do changed.
//!
//! A line is written anew from what the reader finds in it and read again before it counts. Damaged lines, headings and lines whose
//! new form would say anything else stay byte for byte as they are.

use super::pieces::{Field, Piece, pieces};
use crate::geometry::Point;
use crate::program::three_b::block::{Block, Node, PartArc};
use crate::program::three_b::decode::decode;
use crate::program::three_b::encode::{point_of, snap as node_of};
use crate::program::three_b::layout::{push_block_number, push_end_point, push_fields, push_to_comment_column};
use crate::program::three_b::parse::{Item, StatedPoint, Word, Words, read_line};
use crate::settings::Layout;
use crate::text::{SourceText, TextEdit};
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
pub fn format(text: &SourceText, layout: Option<Layout>, words: &Words<'_>, lines: Range<usize>) -> Vec<TextEdit> {
    let survey = survey(text, words);
    let layout = layout.unwrap_or(survey.layout);
    let mut walk = Walk::new(words, layout, survey.numbers_count_blocks);
    let mut edits = Edits::default();
    for line in 0..lines.end.min(text.line_count()) {
        let range = text.line_range(line);
        let bytes = &text.bytes()[range.clone()];
        walk.read(bytes, line == 0);
        if lines.contains(&line)
            && let Some(formed) = walk.form(bytes, line_end(text, line))
        {
            edits.replace(text, line, range, &formed);
        }
        walk.pass();
    }
    edits.joined(text)
}

/// What a text shows of its layout.
struct Survey {
    layout: Layout,
    /// Every block that has a number has its own ordinal.
    numbers_count_blocks: bool,
}

fn survey(text: &SourceText, words: &Words<'_>) -> Survey {
    let (mut ordinal, mut numbers_count_blocks) = (0_u32, true);
    // Compact, aligned, checking.
    let mut votes = [0_usize; 3];
    for line in 0..text.line_count() {
        let range = text.line_range(line);
        let bytes = &text.bytes()[range];
        read_line(bytes, 0, words, |item| {
            let Item::Block { range, number, stated_end, .. } = item else { return };
            ordinal = ordinal.saturating_add(1);
            numbers_count_blocks &= number.is_none_or(|number| number == ordinal);
            if ordinal as usize <= LOOKED_AT {
                let spaced = bytes.get(range).is_some_and(|block| block.contains(&b' '));
                votes[if stated_end.is_some() { 2 } else { usize::from(spaced) }] += 1;
            }
        });
    }
    let most = votes.iter().copied().max().unwrap_or(0);
    let layout = match votes {
        [compact, ..] if compact == most => Layout::Compact,
        [_, aligned, _] if aligned == most => Layout::Aligned,
        _ => Layout::Checking,
    };
    Survey { layout, numbers_count_blocks }
}

/// The line end of a line; of the one before it where it has none.
fn line_end(text: &SourceText, line: usize) -> &str {
    let end_of = |line: usize| {
        let bytes = text.bytes().get(text.line_range(line).end..text.line_start(line + 1)).unwrap_or_default();
        std::str::from_utf8(bytes).ok().filter(|end| !end.is_empty())
    };
    end_of(line).or_else(|| end_of(line.checked_sub(1)?)).unwrap_or("\n")
}

/// A line in its new form: text, and the bytes of the old line that stand behind it as they are.
struct Formed {
    /// From here on the old line is replaced: behind a byte order mark.
    from: usize,
    head: String,
    kept: Range<usize>,
}

/// The way through a program, line by line.
struct Walk<'a> {
    words: &'a Words<'a>,
    layout: Layout,
    numbers_count_blocks: bool,
    /// Blocks before this line.
    ordinal: u64,
    stand: Stand,
    /// The end word has come: nothing behind it is formatted.
    is_over: bool,
    items: Vec<Item>,
    pieces: Vec<Piece>,
    /// What the stated end points of the line's blocks are worth, one for each item, and where the machine stands behind the line.
    stated: Vec<Stated>,
    behind: Stand,
    is_sound: bool,
}

impl<'a> Walk<'a> {
    fn new(words: &'a Words<'a>, layout: Layout, numbers_count_blocks: bool) -> Walk<'a> {
        let stand = Stand { at: Point::origin(), trust: Trust::Known, arcs: 0.0 };
        Walk {
            words,
            layout,
            numbers_count_blocks,
            ordinal: 0,
            stand,
            stated: Vec::new(),
            behind: stand,
            is_over: false,
            items: Vec::new(),
            pieces: Vec::new(),
            is_sound: true,
        }
    }

    fn read(&mut self, line: &[u8], is_first: bool) {
        let mut items = std::mem::take(&mut self.items);
        items.clear();
        self.is_sound = true;
        read_line(line, usize::from(!is_first), self.words, |item| match item {
            Item::Fault(_) | Item::Text { .. } => self.is_sound = false,
            item => items.push(item),
        });
        // The reader skips a byte order mark at offset 0 only.
        let shift = usize::from(!is_first);
        for item in &mut items {
            if let Item::Block { range, .. } | Item::Word { range, .. } | Item::StartPoint { range, .. } = item {
                *range = range.start - shift..range.end - shift;
            }
        }
        self.items = items;
        self.go_on();
    }

    /// Follows the machine through the line.
    fn go_on(&mut self) {
        let mut stand = self.stand;
        if !self.is_sound {
            stand.trust = Trust::Lost;
        }
        let mut found = std::mem::take(&mut self.stated);
        found.clear();
        for item in &self.items {
            let mut stated = Stated::Absent(None);
            match item {
                Item::Block { block, stated_end, .. } => stated = self.stated(*stated_end, block, &mut stand),
                Item::Word { word: Word::Pause, .. } if stand.trust == Trust::Known => stand.trust = Trust::UnlessStated,
                Item::StartPoint { at: [x, y], .. } => {
                    stand = Stand { at: Point::new(x * 1000.0, y * 1000.0), trust: Trust::Known, arcs: 0.0 };
                }
                Item::Word { .. } | Item::Text { .. } | Item::Fault(_) => {}
            }
            found.push(stated);
        }
        (self.stated, self.behind) = (found, stand);
    }

    /// The line in its new form, `None` where it stays as it is.
    fn form(&mut self, line: &[u8], line_end: &str) -> Option<Formed> {
        self.pieces = pieces(line, self.words);
        let from = if line.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        let end = line.iter().rposition(|byte| !matches!(byte, b' ' | b'\t')).map_or(0, |last| last + 1).max(from);
        let trimmed = || (end < line.len()).then(|| Formed { from: line.len(), head: String::new(), kept: from..end });
        let is_strange = |byte: &u8| matches!(byte, 0x0b | 0x0c | 0x1a);
        if !self.is_sound || self.is_over || line.iter().any(is_strange) {
            return None;
        }
        let has = |field: Field| self.pieces.iter().filter(|piece| piece.field == field).count();
        let numbers = self
            .items
            .iter()
            .filter(|item| matches!(item, Item::Block { number: Some(_), .. } | Item::Word { number: Some(_), .. }))
            .count();
        // A header stands alone; a number that no block has would be lost.
        if self.items.is_empty() || has(Field::StartPoint) > 0 || has(Field::Strange) > 0 || has(Field::Number) != numbers {
            return trimmed();
        }
        let mut head = Vec::with_capacity(64);
        let mut last_block = None;
        for (index, (item, &stated)) in self.items.iter().zip(&self.stated).enumerate() {
            if index > 0 {
                head.extend_from_slice(line_end.as_bytes());
            }
            match item {
                Item::Block { block, number, range, part, .. } => {
                    let ordinal = self.ordinal + 1 + self.blocks_before(index);
                    let numbers = (*number, ordinal);
                    self.push_block(&mut head, (block, part.as_ref()), numbers, stated, self.coordinates_behind(line, range.end))?;
                    last_block = Some(block);
                }
                Item::Word { range, number, .. } => {
                    if let Some(number) = number {
                        self.push_number(&mut head, *number)?;
                    }
                    head.extend(line.get(range.clone())?.to_ascii_uppercase());
                    last_block = None;
                }
                Item::StartPoint { .. } | Item::Text { .. } | Item::Fault(_) => return trimmed(),
            }
        }
        let comment = self.pieces.last().filter(|piece| piece.field == Field::Comment).map(|piece| piece.range.clone());
        if let Some(comment) = &comment {
            match last_block {
                Some(block) if self.layout == Layout::Aligned => push_to_comment_column(&mut head, block),
                _ => head.push(b' '),
            }
            // Behind coordinates a remark without its mark would belong to them.
            if memchr::memchr(b';', &head).is_some() && line.get(comment.start) != Some(&b';') {
                head.extend_from_slice(b"; ");
            }
        }
        let kept = comment.map_or(end..end, |comment| comment.start..end);
        let formed = Formed { from, head: String::from_utf8(head).ok()?, kept };
        let is_same = formed.from == from && end == line.len() && line.get(from..formed.kept.start) == Some(formed.head.as_bytes());
        (!is_same && self.reads_the_same(line, &formed)).then_some(formed)
    }

    fn blocks_before(&self, index: usize) -> u64 {
        self.items.iter().take(index).filter(|item| matches!(item, Item::Block { .. })).count() as u64
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
            (Layout::Checking, None) if self.numbers_count_blocks => push_block_number(head, ordinal),
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
        let piece = self.pieces.iter().find(|piece| piece.range.start >= end);
        piece.filter(|piece| piece.field == Field::Coordinates).and_then(|piece| line.get(piece.range.clone())).unwrap_or_default()
    }

    /// What a block's stated end point is worth; moves on to the block's end.
    ///
    /// Where stated points stay in the text, what follows is held against them; where they go, against the blocks alone, so that
    /// formatting again finds the same.
    fn stated(&self, stated: Option<StatedPoint>, block: &Block, stand: &mut Stand) -> Stated {
        let stated = stated.and_then(|StatedPoint { at: [x, y], .. }| node_of(Point::new(x * 1000.0, y * 1000.0)));
        let told = if self.layout == Layout::Checking { stated } else { None };
        match decode(block, stand.at) {
            Ok(segment) => {
                stand.arcs += f64::from(u8::from(segment.as_arc().is_some()));
                stand.at = segment.end();
            }
            // The block means nothing: from here on only a stated point says where the machine is.
            Err(_) => stand.trust = Trust::Lost,
        }
        if let Some(node) = told
            && (stand.trust != Trust::Known || stand.is_near(node))
        {
            *stand = Stand { at: point_of(node), trust: Trust::Known, arcs: 0.0 };
            return Stated::Right(node);
        }
        match (stated, stand.trust) {
            (Some(node), Trust::Known | Trust::UnlessStated) if stand.is_near(node) => Stated::Right(node),
            (Some(_), _) => Stated::Wrong,
            (None, Trust::Lost) => Stated::Absent(None),
            (None, _) => Stated::Absent(node_of(stand.at)),
        }
    }

    /// Takes the line's blocks and words as gone through.
    fn pass(&mut self) {
        self.stand = self.behind;
        self.ordinal += self.blocks_before(self.items.len());
        self.is_over |= self.items.iter().any(|item| matches!(item, Item::Word { word: Word::End, .. }));
    }

    /// Reads the new form and compares: the same blocks, numbers that stand, words, in the same order, and no fault.
    fn reads_the_same(&self, line: &[u8], formed: &Formed) -> bool {
        let mut again: Vec<Item> = Vec::with_capacity(self.items.len());
        let text = [formed.head.as_bytes(), line.get(formed.kept.clone()).unwrap_or_default()].concat();
        for part in text.split(|byte| matches!(byte, b'\n' | b'\r')) {
            read_line(part, 1, self.words, |item| again.push(item));
        }
        let is_same = |(old, new): (&Item, &Item)| match (old, new) {
            (
                Item::Block { block: old, number, stated_end, part, .. },
                Item::Block { block: new, number: new_number, stated_end: new_end, part: new_part, .. },
            ) => {
                let number_is_kept = new_number.is_none() || number.is_none() || number == new_number;
                let end_is_kept = match (stated_end, new_end) {
                    (Some(old), Some(new)) => (0..2).all(|axis| (old.at[axis] - new.at[axis]).abs() <= 0.0006),
                    _ => true,
                };
                old == new && part == new_part && number_is_kept && end_is_kept
            }
            (Item::Word { word: old, number, .. }, Item::Word { word: new, number: new_number, .. }) => old == new && number == new_number,
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

/// So many edits of one text are many.
const MANY: usize = 2_000;

/// Bytes between two of many edits that are little.
const LITTLE: usize = 64;

/// Edits in the making: lines that follow each other become one.
#[derive(Default)]
struct Edits {
    list: Vec<TextEdit>,
    /// The last edit reaches to the end of this line.
    last_line: Option<usize>,
}

impl Edits {
    fn replace(&mut self, text: &SourceText, line: usize, range: Range<usize>, formed: &Formed) {
        let old = &text.bytes()[range.clone()];
        let kept = old.get(formed.kept.clone()).unwrap_or_default();
        let Ok(kept_text) = std::str::from_utf8(kept) else {
            // Bytes in another code page are not touched, so they are in no edit.
            self.push(range.start + formed.from.min(formed.kept.start)..range.start + formed.kept.start, formed.head.clone());
            self.push(range.start + formed.kept.end..range.end, String::new());
            self.last_line = None;
            return;
        };
        if formed.from >= old.len() {
            // Only space at the end goes.
            self.push(range.start + formed.kept.end..range.end, String::new());
            self.last_line = None;
            return;
        }
        let new = [&formed.head, kept_text].concat();
        let previous = line.checked_sub(1);
        match self.list.last_mut().filter(|_| previous.is_some() && self.last_line == previous) {
            Some(edit) => {
                edit.text.push_str(std::str::from_utf8(&text.bytes()[edit.range.end..range.start]).unwrap_or("\n"));
                edit.text.push_str(&new);
                edit.range.end = range.end;
            }
            None => self.list.push(TextEdit { range: range.start + formed.from..range.end, text: new }),
        }
        self.last_line = Some(line);
    }

    /// The edits. Where nearly all of a long text changes, those become one that are parted by little: tens of thousands of edits cost
    /// an editor more than the text between them.
    fn joined(self, text: &SourceText) -> Vec<TextEdit> {
        if self.list.len() <= MANY {
            return self.list;
        }
        let mut joined: Vec<TextEdit> = Vec::new();
        for edit in self.list {
            let between = |last: &TextEdit| std::str::from_utf8(text.bytes().get(last.range.end..edit.range.start)?).ok();
            match joined.last_mut() {
                Some(last) if edit.range.start - last.range.end <= LITTLE && between(last).is_some() => {
                    let between = between(last).unwrap_or_default();
                    last.text.reserve(between.len() + edit.text.len());
                    last.text.push_str(between);
                    last.text.push_str(&edit.text);
                    last.range.end = edit.range.end;
                }
                _ => joined.push(edit),
            }
        }
        joined
    }

    fn push(&mut self, range: Range<usize>, text: String) {
        if !(range.is_empty() && text.is_empty()) {
            self.list.push(TextEdit { range, text });
        }
    }
}

#[cfg(test)]
mod tests;
