//! One line: as the reader finds it, and in its new form.

use super::Ends;
use crate::geometry::{Point, Segment};
use crate::program::edits::LineEdits;
use crate::program::lookalikes::with_plain_marks;
use crate::program::three_b::around::{StatedPoint, before_comment};
use crate::program::three_b::block::{Block, Node, PartArc};
use crate::program::three_b::decode::decode;
use crate::program::three_b::layout::{
    push_block_number, push_end_point, push_fields, push_to_comment_column,
};
use crate::program::three_b::line::BYTE_ORDER_MARK;
use crate::program::three_b::parse::{Item, read_line};
use crate::program::three_b::pieces::{Field, Piece, pieces};
use crate::program::three_b::words::{Word, Words};
use crate::settings::Layout;
use crate::text::{SourceText, TextEdit};
use std::ops::Range;

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

/// A line as the reader finds it, and what the way through the program adds.
pub(super) struct Line {
    /// From 0.
    number: usize,
    pub(crate) parts: Vec<Part>,
    /// It holds nothing that cannot be read.
    pub(crate) is_sound: bool,
    /// A comment holds a block.
    holds_comment: bool,
    /// Blocks before it.
    pub(crate) ordinal: u64,
    /// The end word has come before.
    pub(crate) is_over: bool,
}

/// A block, a word or the header with the start.
pub(super) struct Part {
    pub(crate) what: What,
    pub(crate) range: Range<usize>,
    pub(crate) number: Option<u32>,
    pub(crate) stated_end: Option<StatedPoint>,
    /// The path of the block, from the origin.
    pub(crate) way: Option<Segment>,
    /// The verdict on its stated end point.
    pub(crate) stated: Stated,
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
            ordinal: 0,
            is_over: false,
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
                way: match &what {
                    What::Block(block, _) => decode(block, Point::origin()).ok(),
                    What::Word(_) | What::StartPoint(_) => None,
                },
                what,
                range,
                number,
                stated_end,
                stated: Stated::Absent(None),
            });
        });
        line
    }
}

impl Part {
    /// The same block or word: what stays of its number and end point is as it was.
    fn reads_as(&self, new: &Part) -> bool {
        let is_block = matches!(self.what, What::Block(..));
        let is_number_gone = is_block && (self.number.is_none() || new.number.is_none());
        let is_near = match (self.stated_end, new.stated_end) {
            (Some(StatedPoint { at: [x, y], .. }), Some(StatedPoint { at: [a, b], .. })) => {
                (x - a).abs().max((y - b).abs()) <= 0.0006
            }
            _ => true,
        };
        self.what == new.what && (is_number_gone || self.number == new.number) && is_near
    }
}

/// Writes lines again.
pub(super) struct Writer<'a> {
    pub(crate) words: &'a Words<'a>,
    pub(crate) layout: Layout,
    pub(crate) ends: Ends,
    pub(crate) numbers_count_blocks: bool,
}

impl Writer<'_> {
    /// The edits that bring one line into its new form.
    pub(crate) fn form(&self, line: &Line, text: &SourceText, edits: &mut LineEdits) {
        let old = text.line(line.number);
        let is_strange = |byte: &u8| matches!(byte, 0x0b | 0x0c | 0x1a);
        if !line.is_sound || line.is_over || old.iter().any(is_strange) {
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
        let mut last_block = None;
        let mut ordinal = line.ordinal;
        for (index, part) in line.parts.iter().enumerate() {
            if index > 0 {
                head.extend_from_slice(text.line_end(line.number).as_bytes());
            }
            last_block = None;
            match &part.what {
                What::Block(block, arc) => {
                    ordinal += 1;
                    self.push_block_number(&mut head, part, ordinal)?;
                    push_fields(&mut head, self.layout, block, arc.as_ref());
                    let mut behind = pieces.iter();
                    let next = behind.find(|piece| piece.range.start >= part.range.end);
                    let coordinates = next.filter(|piece| piece.field == Field::Coordinates);
                    let coordinates = coordinates.and_then(|piece| old.get(piece.range.clone()));
                    self.push_end(&mut head, block, part.stated, coordinates.unwrap_or(b""));
                    last_block = Some(block);
                }
                What::Word(_) => {
                    if let Some(number) = part.number {
                        self.push_number(&mut head, number)?;
                    }
                    head.extend(old.get(part.range.clone())?.to_ascii_uppercase());
                }
                What::StartPoint(_) => return None,
            }
        }
        let comment = pieces.last().filter(|last| last.field == Field::Comment);
        if let Some(comment) = comment {
            match last_block {
                Some(block) if self.layout == Layout::Aligned => {
                    push_to_comment_column(&mut head, block)
                }
                _ => head.push(b' '),
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

    fn push_block_number(&self, head: &mut Vec<u8>, block: &Part, ordinal: u64) -> Option<()> {
        let is_checking = self.layout == Layout::Checking;
        match block.number {
            // It goes with the end point.
            Some(_) if !is_checking && matches!(block.stated, Stated::Right(_)) => {}
            Some(number) => self.push_number(head, number)?,
            None if !is_checking || self.ends == Ends::Kept => {}
            None if self.numbers_count_blocks => push_block_number(head, ordinal),
            None => head.extend_from_slice(b"        "),
        }
        Some(())
    }

    fn push_end(&self, head: &mut Vec<u8>, block: &Block, stated: Stated, old: &[u8]) {
        match stated {
            Stated::AsItStands => {
                push_to_comment_column(head, block);
                if !old.starts_with(b";") {
                    head.extend_from_slice(b"; ");
                }
                head.extend_from_slice(old);
            }
            Stated::Right(node) | Stated::Absent(Some(node)) if self.layout == Layout::Checking => {
                push_to_comment_column(head, block);
                push_end_point(head, node);
            }
            Stated::Right(_) | Stated::Absent(_) => {}
        }
    }

    /// Reads the new form and compares: the same blocks, words and kept numbers in the same order, and no fault.
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
        let is_other = count(Field::StartPoint) + count(Field::Strange) > 0;
        !self.parts.is_empty() && !is_other && count(Field::Number) == numbers.count()
    }
}
