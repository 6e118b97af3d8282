//! One line in its new form.

use super::Ends;
use super::chunk::Stated;
use crate::program::three_b::block::{Block, PartArc};
use crate::program::three_b::layout::{
    push_block_number, push_end_point, push_fields, push_to_comment_column,
};
use crate::program::three_b::parse::{Item, read_line};
use crate::program::three_b::pieces::{Field, Piece, pieces};
use crate::program::three_b::words::Words;
use crate::settings::Layout;
use std::borrow::Cow;
use std::ops::Range;

/// A line in its new form: text, and the bytes of the old line that stay after it.
pub(super) struct Formed {
    /// The old line is replaced from here on: after a byte order mark.
    pub(crate) from: usize,
    pub(crate) head: String,
    pub(crate) kept: Range<usize>,
}

/// Writes one line again.
pub(super) struct Writer<'a> {
    pub(crate) words: &'a Words<'a>,
    pub(crate) layout: Layout,
    pub(crate) ends: Ends,
    pub(crate) numbers_count_blocks: bool,
    /// Blocks before this line.
    pub(crate) ordinal: u64,
    pub(crate) is_over: bool,
    pub(crate) items: &'a [Item],
    pub(crate) stated: &'a [Stated],
    pub(crate) pieces: Vec<Piece>,
    pub(crate) is_sound: bool,
}

impl Writer<'_> {
    /// The line in its new form, `None` where it stays as it is.
    pub(crate) fn form(&mut self, line: &[u8], line_end: &str) -> Option<Formed> {
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
        // A header stands alone; a number without a block would be lost.
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
            // After coordinates a remark without its mark would belong to them.
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
            // It stands for a number that was too large.
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
            (_, None) if self.ends == Ends::Kept => {}
            (Layout::Checking, None) if self.numbers_count_blocks => {
                push_block_number(head, ordinal)
            }
            (Layout::Checking, None) => head.extend_from_slice(BLANK_NUMBER),
            (_, None) => {}
        }
        push_fields(head, self.layout, block, part);
        match (self.layout, stated) {
            (_, Stated::AsItStands) => {
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

    /// The coordinates as they stand after a block that ends at `end`.
    fn coordinates_behind<'l>(&self, line: &'l [u8], end: usize) -> &'l [u8] {
        let piece = self
            .pieces
            .get(self.pieces.partition_point(|piece| piece.range.start < end));
        piece
            .filter(|piece| piece.field == Field::Coordinates)
            .and_then(|piece| line.get(piece.range.clone()))
            .unwrap_or_default()
    }

    /// Reads the new form and compares: the same blocks, words and kept numbers in the same order, and no fault.
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
