//! Turns lines into tags: pairs of group code and value, brought back into step where a line is missing or extra.
//!
//! Whether the text is out of step depends on the lines that follow, at most [`LOOKAHEAD`] of them.

use super::fault::{self, quoted};
use super::lines::Lines;
use super::number::{self, Code, Number};
use super::value_type::ValueType;
use crate::finding::Finding;
use std::ops::Range;

/// No decision of the lexer looks further ahead than this many lines.
pub(crate) const LOOKAHEAD: usize = 2 * (WINDOW + SETTLING) + 4;
/// The tags that are looked at to tell codes from values.
const WINDOW: usize = 8;
/// The tags that may be skipped, once the text is in step, to reach a sound one.
const SETTLING: usize = 2;
/// Empty lines in a row that may stand between two records.
const EMPTY_LINES: usize = 16;

/// A group code and the line it stands on; the value stands on the next line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tag {
    pub(crate) code: i16,
    pub(crate) line: usize,
}

impl Tag {
    pub(crate) fn value_line(self) -> usize {
        self.line + 1
    }
}

pub(crate) struct Lexer<'a> {
    pub(crate) lines: Lines<'a>,
    at: usize,
    /// The last line that must no longer be taken for a code line: [`Lexer::recover`] goes back
    /// only to lines after it.
    consumed: usize,
    /// The text was out of step since the last [`Lexer::begin_item`].
    pub(crate) out_of_step: bool,
    /// A code line at the end of the text without a value.
    pub(crate) dangling: Option<usize>,
    /// The faults so far, here and in the tags read.
    pub(crate) findings: Vec<Finding>,
}

impl<'a> Lexer<'a> {
    pub(crate) fn new(lines: Lines<'a>, at: usize) -> Lexer<'a> {
        Lexer {
            lines,
            at,
            consumed: at + 1,
            out_of_step: false,
            dangling: None,
            findings: Vec::new(),
        }
    }

    /// Goes on at the line `at` of the item that begins at the line `start`, all of which was in step so far.
    pub(super) fn within(lines: Lines<'a>, start: usize, at: usize) -> Lexer<'a> {
        Lexer {
            at,
            ..Lexer::new(lines, start)
        }
    }

    /// A fault on a line that makes text unreadable.
    pub(super) fn damage(&mut self, line: usize, sentence: String) {
        self.damage_in(self.lines.trimmed_range(line), sentence);
    }

    pub(super) fn damage_in(&mut self, range: Range<usize>, sentence: String) {
        fault::damage(&mut self.findings, range, sentence);
    }

    /// Something odd on a line that was read all the same.
    pub(super) fn oddity(&mut self, line: usize, sentence: String) {
        self.oddity_in(self.lines.trimmed_range(line), sentence);
    }

    pub(super) fn oddity_in(&mut self, range: Range<usize>, sentence: String) {
        fault::oddity(&mut self.findings, range, sentence);
    }

    /// A remark on how a line was read that is not a fault.
    pub(super) fn remark(&mut self, line: usize, sentence: String) {
        let range = self.lines.trimmed_range(line);
        fault::remark(&mut self.findings, range, sentence);
    }

    /// The line of the next tag.
    pub(crate) fn at(&self) -> usize {
        self.at
    }

    pub(crate) fn at_end(&self) -> bool {
        self.at >= self.lines.count()
    }

    /// Goes on from `line` and forgets everything before it.
    pub(crate) fn begin_item(&mut self, line: usize) {
        self.at = line;
        self.consumed = line + 1;
        self.out_of_step = false;
        self.dangling = None;
    }

    /// Puts back `tag`, which was just read.
    pub(crate) fn back_to(&mut self, tag: Tag) {
        self.at = tag.line;
        self.consumed = tag.line + 1;
    }

    /// The tag that begins the next record, when the lexer stands before one.
    pub(crate) fn peek_record(&self) -> Option<Tag> {
        let line = self.at;
        let begins = line + 1 < self.lines.count()
            && number::code(self.lines.content(line)) == Code::Known(0)
            && is_name(self.lines.content(line + 1));
        begins.then_some(Tag { code: 0, line })
    }

    /// Passes over the tag that begins a record, as [`Lexer::peek_record`] gave it.
    pub(crate) fn pass(&mut self, record: Tag) {
        self.at = record.line + 2;
    }

    /// The next tag; `None` at the end of the text. Lines that make no tag are skipped with one finding.
    pub(crate) fn next(&mut self) -> Option<Tag> {
        loop {
            let line = self.at;
            if line + 1 >= self.lines.count() {
                if line < self.lines.count() && !self.lines.trimmed(line).is_empty() {
                    self.dangling = Some(line);
                }
                self.at = self.lines.count();
                return None;
            }
            match number::code(self.lines.content(line)) {
                Code::Known(0) if !is_name(self.lines.content(line + 1)) => self.recover(line),
                Code::Known(code) => {
                    self.at = line + 2;
                    return Some(Tag { code, line });
                }
                Code::OutOfRange if self.score(line + 2) == FULL => {
                    let code = quoted(self.lines.trimmed(line));
                    self.damage(
                        line,
                        say!(group_code_is_out_of_range_expected_5_to_1071, code),
                    );
                    self.at = line + 2;
                }
                Code::OutOfRange | Code::NotANumber => match self.behind_empty_lines(line) {
                    Some(record) => self.pass_over_empty_lines(line, record),
                    None => self.recover(line),
                },
            }
        }
    }

    /// The line of the record after empty lines, of which `line` is the first.
    fn behind_empty_lines(&self, line: usize) -> Option<usize> {
        let is_empty =
            |line: &usize| *line < self.lines.count() && self.lines.trimmed(*line).is_empty();
        let record = line + (line..line + EMPTY_LINES).take_while(is_empty).count();
        let begins = record > line
            && record + 1 < self.lines.count()
            && number::code(self.lines.content(record)) == Code::Known(0)
            && is_name(self.lines.content(record + 1));
        begins.then_some(record)
    }

    /// Empty lines between two records take nothing from either.
    fn pass_over_empty_lines(&mut self, line: usize, record: usize) {
        let sentence = match record - line {
            1 => say!(an_empty_line_stands_for_a_group_code).to_owned(),
            count => say!(empty_lines_stand_for_a_group_code, count),
        };
        self.oddity_in(self.lines.range(line), sentence);
        self.at = record;
        self.consumed = record;
    }

    /// True when the value of `tag`, which does not fit its code, is the next code: a line is missing or extra. Adds
    /// the finding and goes on in step.
    pub(crate) fn back_in_step(&mut self, tag: Tag) -> bool {
        let line = tag.value_line();
        let kept = self.score(line + 1);
        if kept == FULL || self.score(line) <= kept {
            return false;
        }
        self.out_of_step = true;
        self.at = self.settled(line);
        self.consumed = self.at;
        if self.at == line {
            self.lost_value(tag.line);
        } else {
            let found = quoted(self.lines.trimmed(line));
            let sentence = say!(a_line_off_where_a_value_is_expected, found, tag.code);
            self.damage_in(self.lines.range(line), sentence);
        }
        true
    }

    /// Finds the next line that starts a tag after `line` failed to.
    fn recover(&mut self, line: usize) {
        self.out_of_step = true;
        let in_step = self.score(line + 2);
        let extra = self.score(line + 1);
        // The value before may be the code to which this line is the value: `0` and then a name.
        let back = line
            .checked_sub(1)
            .filter(|&before| before > self.consumed)
            .map_or(0, |before| self.score(before));
        let names_record = back > 0 && number::code(self.lines.content(line - 1)) == Code::Known(0);
        let best = in_step.max(extra).max(back);
        let next = if best <= FULL / 2 {
            self.end_of_garbage(line + 1)
        } else if in_step == best {
            line + 2
        } else if back == best && names_record {
            line - 1
        } else if extra == best {
            line + 1
        } else {
            line - 1
        };
        self.at = next;
        self.consumed = self.consumed.max(line.min(next));
        if next < line {
            return self.lost_value(line - 2);
        }
        let found = quoted(self.lines.trimmed(line));
        if next == line + 1 {
            self.at = self.settled(next);
        }
        let sentence =
            if next == line + 2 && number::code(self.lines.content(line)) == Code::Known(0) {
                say!(
                    group_code_0_is_followed_by_no_name,
                    quoted(self.lines.trimmed(line + 1))
                )
            } else if next == line + 2 {
                say!(stands_where_a_group_code_is_expected, found)
            } else if next > line + 2 {
                say!(lines_that_are_no_tags, found, next - line)
            } else {
                say!(a_line_off_where_a_group_code_is_expected, found)
            };
        let end = self.lines.range(next.max(line + 1) - 1).end;
        let start = self.lines.range(line).start;
        let whole = if next > line + 2 {
            start..end.max(start)
        } else {
            self.lines.range(line)
        };
        self.damage_in(whole, sentence);
    }

    /// The line after the code line is not its value but the next code. The place is the code line: what follows may
    /// be another record.
    fn lost_value(&mut self, code_line: usize) {
        let code = quoted(self.lines.trimmed(code_line));
        let sentence = say!(group_code_is_not_followed_by_its_value, code);
        self.damage_in(self.lines.range(code_line), sentence);
    }

    /// The first sound tag from `line` on that is in step.
    fn settled(&self, line: usize) -> usize {
        let sound = |at: usize| match number::code(self.lines.content(at)) {
            Code::Known(code) => fits(code, self.lines.content(at + 1)),
            _ => false,
        };
        let end = self.lines.count();
        (line..)
            .step_by(2)
            .take(SETTLING + 1)
            .find(|&at| at + 1 >= end || sound(at))
            .unwrap_or(line)
            .min(end)
    }

    fn end_of_garbage(&self, from: usize) -> usize {
        (from..self.lines.count())
            .find(|&line| {
                matches!(number::code(self.lines.content(line)), Code::Known(_))
                    && self.score(line) == FULL
            })
            .unwrap_or(self.lines.count())
    }

    /// How well the lines from `line` on pair up as tags: 0 to [`FULL`].
    fn score(&self, line: usize) -> usize {
        let (mut good, mut seen) = (0, 0);
        let mut at = line;
        while seen < WINDOW && at < self.lines.count() {
            seen += 1;
            if at + 1 == self.lines.count() {
                break;
            }
            let value = self.lines.content(at + 1);
            if let Code::Known(code) = number::code(self.lines.content(at)) {
                good += usize::from(fits(code, value));
                if code == 0 && value == b"EOF" {
                    break;
                }
            }
            at += 2;
        }
        (good * FULL).checked_div(seen).unwrap_or(FULL)
    }
}

const FULL: usize = 1000;

/// True for a possible record name.
fn is_name(value: &[u8]) -> bool {
    value.first().is_some_and(u8::is_ascii_uppercase) || value.iter().any(u8::is_ascii_alphabetic)
}

/// True when `value` is of the type that `code` demands.
fn fits(code: i16, value: &[u8]) -> bool {
    match ValueType::of(code) {
        _ if code == 0 => is_name(value),
        Some(ValueType::Real) => number::number(value) != Number::Bad,
        Some(ValueType::Flag | ValueType::Short | ValueType::Long | ValueType::Huge) => {
            let text = number::trimmed(value);
            let digits = text.strip_prefix(b"-").unwrap_or(text);
            !digits.is_empty() && digits.iter().all(u8::is_ascii_digit)
        }
        Some(ValueType::Text | ValueType::Bytes) | None => true,
    }
}
