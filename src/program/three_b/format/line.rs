//! One line: as the reader finds it, and in its new form.

use crate::program::edits::LineEdits;
use crate::program::lookalikes::with_plain_marks;
use crate::program::three_b::around::{StatedPoint, before_comment};
use crate::program::three_b::block::{Block, PartArc};
use crate::program::three_b::layout::{push_block_number, push_fields, push_to_comment_column};
use crate::program::three_b::line::BYTE_ORDER_MARK;
use crate::program::three_b::parse::{Item, read_line};
use crate::program::three_b::pieces::{Field, Piece, pieces};
use crate::program::three_b::words::{Word, Words};
use crate::settings::Layout;
use crate::text::{SourceText, TextEdit};
use std::ops::Range;

/// A line as the reader finds it.
pub(super) struct Line {
    /// From 0.
    number: usize,
    pub(crate) parts: Vec<Part>,
    /// It holds nothing that cannot be read.
    is_sound: bool,
    /// A comment holds a block.
    holds_comment: bool,
}

/// A block, a word or the header with the start.
pub(super) struct Part {
    pub(crate) what: What,
    pub(crate) range: Range<usize>,
    number: Option<u32>,
    stated_end: Option<StatedPoint>,
}

#[derive(PartialEq)]
pub(super) enum What {
    Block(Block, Option<PartArc>),
    Word(Word),
    /// mm.
    StartPoint([f64; 2]),
}

impl Line {
    pub(super) fn read(number: usize, bytes: &[u8], words: &Words<'_>) -> Line {
        // Wide marks and spaces among the fields stay as they stand.
        let code = before_comment(bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes));
        let mut line = Line {
            number,
            parts: Vec::with_capacity(1),
            is_sound: code.is_ascii() || with_plain_marks(code).is_none(),
            holds_comment: false,
        };
        read_line(bytes, 0, words, |item| {
            let (what, range, number, stated_end) = match item {
                Item::Block {
                    block,
                    range,
                    number,
                    stated_end,
                    part,
                } => (What::Block(block, part), range, number, stated_end),
                Item::Word {
                    word,
                    range,
                    number,
                    ..
                } => (What::Word(word), range, number, None),
                Item::StartPoint { at, range } => (What::StartPoint(at), range, None, None),
                Item::CommentedBlock { .. } => return line.holds_comment = true,
                Item::Fault(_) | Item::Text { .. } => return line.is_sound = false,
            };
            line.parts.push(Part {
                what,
                range,
                number,
                stated_end,
            });
        });
        line
    }
}

impl Part {
    /// The same block or word, with its number and end point.
    fn reads_as(&self, new: &Part) -> bool {
        let beside = |part: &Part| (part.number, part.stated_end);
        self.what == new.what && beside(self) == beside(new)
    }
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
        for (index, part) in line.parts.iter().enumerate() {
            if index > 0 {
                head.extend_from_slice(text.line_end(line.number).as_bytes());
            }
            if let Some(number) = part.number {
                self.push_number(&mut head, number)?;
            }
            aligned = None;
            match &part.what {
                What::Block(block, arc) => {
                    push_fields(&mut head, self.layout, block, arc.as_ref());
                    let mut behind = pieces.iter();
                    let next = behind.find(|piece| piece.range.start >= part.range.end);
                    match next.filter(|piece| piece.field == Field::Coordinates) {
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
                What::Word(_) => head.extend(old.get(part.range.clone())?.to_ascii_uppercase()),
                What::StartPoint(_) => return None,
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
        let again = || lines.iter().flat_map(|line| &line.parts);
        let is_sound = |line: &Line| line.is_sound && !line.holds_comment;
        let mut pairs = line.parts.iter().zip(again());
        lines.iter().all(is_sound)
            && again().count() == line.parts.len()
            && pairs.all(|(old, new)| old.reads_as(new))
    }
}

impl Line {
    /// It has blocks or words, and nothing that would be lost: a header stands alone, a number without a block stays.
    fn is_plain(&self, pieces: &[Piece]) -> bool {
        let count = |field: Field| pieces.iter().filter(|piece| piece.field == field).count();
        let numbers = self.parts.iter().filter(|part| part.number.is_some());
        // Coordinates behind a word are no end of a block.
        let ends = self.parts.iter().filter(|part| {
            let mut behind = pieces.iter();
            let next = behind.find(|piece| piece.range.start >= part.range.end);
            matches!(part.what, What::Block(..))
                && next.is_some_and(|next| next.field == Field::Coordinates)
        });
        let is_other = count(Field::StartPoint) + count(Field::Strange) > 0;
        !self.parts.is_empty()
            && !is_other
            && count(Field::Number) == numbers.count()
            && count(Field::Coordinates) == ends.count()
    }
}
