//! Numbers and lines of one entity in the text: set, inserted, removed.

use super::super::lexer::Tag;
use super::super::lines::Lines;
use super::super::number::{self, Number, written};
use super::super::record::{self, DECIMALS, Style};
use crate::geometry::positive_angle;
use crate::text::{SourceText, TextEdit};
use std::ops::Range;

/// Writes the edit of one entity.
pub(super) struct Pen<'a> {
    pub(super) text: &'a SourceText,
    pub(super) lines: Lines<'a>,
    /// Kind and handle of the entity, as refusals name it.
    pub(super) name: String,
    pub(super) edits: &'a mut Vec<TextEdit>,
}

impl Pen<'_> {
    pub(super) fn set_length(&mut self, tags: &[Tag], code: i16, value: f64) -> Result<(), String> {
        self.set(tags, code, value, DECIMALS)
    }

    /// `angle` in radians.
    pub(super) fn set_angle(&mut self, tags: &[Tag], code: i16, angle: f64) -> Result<(), String> {
        let degrees = positive_angle(angle).to_degrees();
        if let Some(tag) = last(tags, code)
            && let Number::Exact(present) = number::number(self.lines.content(tag.value_line()))
        {
            let apart = (present - degrees).rem_euclid(360.0);
            if apart.min(360.0 - apart) < 1e-12 {
                return Ok(());
            }
        }
        self.set(tags, code, record::degrees(angle), DECIMALS)
    }

    /// Replaces the number after `code`, unless it is the same as written.
    pub(super) fn set(
        &mut self,
        tags: &[Tag],
        code: i16,
        value: f64,
        decimals: usize,
    ) -> Result<(), String> {
        if !value.is_finite() {
            return Err(say!(a_group_code_cannot_be, code, self.name, value));
        }
        let Some(tag) = last(tags, code) else {
            return Err(say!(has_no_group_code, self.name, code));
        };
        let line = tag.value_line();
        if let Number::Exact(present) = number::number(self.lines.content(line))
            && (present - value).abs() <= 0.5 * 0.1f64.powi(decimals as i32)
        {
            return Ok(());
        }
        self.put(line, written(value, decimals));
        Ok(())
    }

    /// Puts another value on a line.
    pub(super) fn put(&mut self, line: usize, value: String) {
        let range = self.lines.trimmed_range(line);
        self.edits.push(TextEdit::new(range, value));
    }

    /// Inserts tags before a line.
    pub(super) fn insert(&mut self, line: usize, style: &Style, tags: Vec<u8>) {
        let at = self.text.line_start(line);
        let text = style.inserted(self.text, at, tags);
        self.edits.push(TextEdit::new(at..at, text));
    }

    /// Removes whole lines; the byte-order mark stays.
    pub(super) fn remove(&mut self, lines: Range<usize>) {
        let start = match lines.start {
            0 => self.lines.range(0).start,
            line => self.text.line_start(line),
        };
        let range = start..self.text.line_start(lines.end);
        self.edits.push(TextEdit::new(range, ""));
    }
}

/// The tag that counts: the last one with the code.
pub(super) fn last(tags: &[Tag], code: i16) -> Option<Tag> {
    tags.iter().rfind(|tag| tag.code == code).copied()
}
