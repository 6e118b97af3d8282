//! One line: as the reader finds it, and in its new form.

use crate::program::edits::LineEdits;
use crate::program::lookalikes::with_plain_marks;
use crate::program::three_b::around::before_comment;
use crate::program::three_b::layout::{push_block_number, push_fields, push_to_comment_column};
use crate::program::three_b::line::BYTE_ORDER_MARK;
use crate::program::three_b::parse::{Item, read_line};
use crate::program::three_b::pieces::{Field, Piece, pieces};
use crate::program::three_b::words::Words;
use crate::settings::Layout;
use crate::text::{SourceText, TextEdit};

/// A line as the reader finds it.
pub(super) struct Line {
    /// From 0.
    number: usize,
    /// Blocks, words and the header with the start.
    pub(crate) items: Vec<Item>,
    /// It holds nothing that cannot be read.
    is_sound: bool,
    /// A comment holds a block.
    holds_comment: bool,
}

impl Line {
    pub(super) fn read(number: usize, bytes: &[u8], words: &Words<'_>) -> Line {
        // Wide marks and spaces among the fields stay as they stand.
        let code = before_comment(bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes));
        let mut line = Line {
            number,
            items: Vec::with_capacity(1),
            is_sound: code.is_ascii() || with_plain_marks(code).is_none(),
            holds_comment: false,
        };
        read_line(bytes, 0, words, |item| match item {
            Item::CommentedBlock { .. } => line.holds_comment = true,
            Item::Fault(_) | Item::Text { .. } => line.is_sound = false,
            item => line.items.push(item),
        });
        line
    }
}

/// Where an item ends, and its number.
fn end_and_number(item: &Item) -> (usize, Option<u32>) {
    match item {
        Item::Block { range, number, .. } | Item::Word { range, number, .. } => {
            (range.end, *number)
        }
        _ => (0, None),
    }
}

/// The same block or word, with its number and end point.
fn reads_as(old: &Item, new: &Item) -> bool {
    let [old, new] = [old, new].map(|item| {
        let mut item = item.clone();
        if let Item::Block { range, .. } | Item::Word { range, .. } = &mut item {
            *range = 0..0;
        }
        item
    });
    old == new
}

/// Writes lines again.
pub(super) struct Writer<'a> {
    pub(crate) words: &'a Words<'a>,
    pub(crate) layout: Layout,
}

impl Writer<'_> {
    /// The edits that bring one line into its new form.
    pub(crate) fn form(&self, line: &Line, text: &SourceText, edits: &mut LineEdits) {
        let old = text.line(line.number);
        let is_strange = |byte: &u8| matches!(byte, 0x0b | 0x0c | 0x1a);
        if !line.is_sound || old.iter().any(is_strange) {
            return;
        }
        let start = text.line_start(line.number);
        let marked = old.strip_prefix(BYTE_ORDER_MARK);
        let from = old.len() - marked.unwrap_or(old).len();
        let is_own = |byte: &u8| !matches!(byte, b' ' | b'\t');
        let end = old.iter().rposition(is_own).map_or(0, |last| last + 1);
        let behind = TextEdit::new(start + end..start + old.len(), "");
        let pieces = pieces(old, self.words);
        let comment = pieces.last().filter(|last| last.field == Field::Comment);
        let kept = comment.map_or(end, |comment| comment.range.start)..end;
        if !line.is_plain(&pieces) {
            return edits.push(text, 0..0, behind);
        }
        let Some(head) = self.head(line, text, &pieces) else {
            return;
        };
        let kept_text = old.get(kept.clone()).unwrap_or_default();
        let new = [head.as_bytes(), kept_text].concat();
        if old.get(from..) == Some(&new) || !self.reads_the_same(line, &new) {
            return;
        }
        match String::from_utf8(new) {
            Ok(new) => {
                let new = TextEdit::new(start + from..start + old.len(), new);
                edits.push(text, line.number..line.number + 1, new);
            }
            // Bytes in another code page are not touched, so they are in no edit.
            Err(_) => {
                let before = start + from..start + kept.start;
                edits.push(text, 0..0, TextEdit::new(before, head));
                edits.push(text, 0..0, behind);
            }
        }
    }

    /// Everything before the comment.
    fn head(&self, line: &Line, text: &SourceText, pieces: &[Piece]) -> Option<String> {
        let old = text.line(line.number);
        let mut head = Vec::with_capacity(64);
        let mut aligned = None;
        for (index, item) in line.items.iter().enumerate() {
            if index > 0 {
                head.extend_from_slice(text.line_end(line.number).as_bytes());
            }
            let (item_end, number) = end_and_number(item);
            if let Some(number) = number {
                self.push_number(&mut head, number)?;
            }
            aligned = None;
            match item {
                Item::Block { block, part, .. } => {
                    push_fields(&mut head, self.layout, block, part.as_ref());
                    match coordinates_behind(pieces, item_end) {
                        Some(end) => {
                            let end = old.get(end.range.clone())?;
                            push_to_comment_column(&mut head, block);
                            if !end.starts_with(b";") {
                                head.extend_from_slice(b"; ");
                            }
                            head.extend_from_slice(end);
                        }
                        None if self.layout == Layout::Compact => {}
                        None => aligned = Some(block),
                    }
                }
                Item::Word { range, .. } => {
                    head.extend(old.get(range.clone())?.to_ascii_uppercase());
                }
                _ => return None,
            }
        }
        let comment = pieces.last().filter(|last| last.field == Field::Comment);
        if let Some(comment) = comment {
            match aligned {
                Some(block) => push_to_comment_column(&mut head, block),
                None => head.push(b' '),
            }
            // After coordinates a remark without its mark would belong to them.
            if head.contains(&b';') && old.get(comment.range.start) != Some(&b';') {
                head.extend_from_slice(b"; ");
            }
        }
        String::from_utf8(head).ok()
    }

    fn push_number(&self, head: &mut Vec<u8>, number: u32) -> Option<()> {
        match self.layout {
            // It stands for a number that was too large.
            _ if number == u32::MAX => return None,
            Layout::Compact => head.extend_from_slice(format!("N{number} ").as_bytes()),
            Layout::Aligned | Layout::Checking => push_block_number(head, number.into()),
        }
        Some(())
    }

    /// Reads the new form and compares: the same blocks, words, numbers and end points in the same order, and no fault.
    fn reads_the_same(&self, line: &Line, new: &[u8]) -> bool {
        let lines = new.split(|byte| matches!(byte, b'\n' | b'\r'));
        let lines: Vec<Line> = lines.map(|new| Line::read(0, new, self.words)).collect();
        let again = || lines.iter().flat_map(|line| &line.items);
        let is_sound = |line: &Line| line.is_sound && !line.holds_comment;
        let mut pairs = line.items.iter().zip(again());
        lines.iter().all(is_sound)
            && again().count() == line.items.len()
            && pairs.all(|(old, new)| reads_as(old, new))
    }
}

impl Line {
    /// It has blocks or words, and nothing that would be lost: a header stands alone, a number without a block stays.
    fn is_plain(&self, pieces: &[Piece]) -> bool {
        let count = |field: Field| pieces.iter().filter(|piece| piece.field == field).count();
        let items = self.items.iter();
        let numbers = items.filter(|item| end_and_number(item).1.is_some());
        // Coordinates behind a word are no end of a block.
        let ends = self.items.iter().filter(|item| {
            let end = coordinates_behind(pieces, end_and_number(item).0);
            matches!(item, Item::Block { .. }) && end.is_some()
        });
        let is_other = count(Field::StartPoint) + count(Field::Strange) > 0;
        !self.items.is_empty()
            && !is_other
            && count(Field::Number) == numbers.count()
            && count(Field::Coordinates) == ends.count()
    }
}

/// The coordinates next behind a place of a line.
fn coordinates_behind(pieces: &[Piece], at: usize) -> Option<&Piece> {
    let next = pieces.iter().find(|piece| piece.range.start >= at);
    next.filter(|piece| piece.field == Field::Coordinates)
}
