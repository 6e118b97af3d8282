//! Text with its lines: bytes, the start of each line, and positions as editors count them.
//!
//! The bytes may be anything; nothing here knows what the text means. Offsets are bytes, lines count from 0.

mod aside;
mod gap;
mod line_starts;
mod patch;
mod writing;

pub(crate) use aside::Again;
pub(crate) use line_starts::LineStarts;
pub(crate) use patch::Patch;
pub(crate) use writing::{Writing, consists_of_pairs, is_gb_18030_by_chance};

use gap::Bytes;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

/// How a client counts characters within a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Encoding {
    Utf8,
    #[default]
    Utf16,
}

/// Padding wider than this does not line up a column and is dropped. (`format!` takes no width above 65,535.)
pub(crate) const WIDEST_COLUMN: usize = 64;

/// A replacement of a range of bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextEdit {
    pub range: Range<usize>,
    pub text: String,
}

impl TextEdit {
    pub(crate) fn new(range: Range<usize>, text: impl Into<String>) -> TextEdit {
        let text = text.into();
        TextEdit { range, text }
    }
}

impl From<TextEdit> for Vec<TextEdit> {
    fn from(edit: TextEdit) -> Vec<TextEdit> {
        vec![edit]
    }
}

/// The bytes after `edits`, which must be sorted and disjoint; `None` when they are not, or reach past the end.
pub fn edited(bytes: &[u8], edits: &[TextEdit]) -> Option<Vec<u8>> {
    let mut result = Vec::with_capacity(bytes.len());
    let mut at = 0;
    for edit in edits {
        result.extend_from_slice(bytes.get(at..edit.range.start)?);
        result.extend_from_slice(edit.text.as_bytes());
        at = edit.range.end;
    }
    result.extend_from_slice(bytes.get(at..)?);
    Some(result)
}

/// The one edit from the first byte that differs to the last; `None` where none does, or where the changed part is not
/// UTF-8.
pub(crate) fn difference(old: &[u8], new: &[u8]) -> Option<TextEdit> {
    let same = |(a, b): &(&u8, &u8)| a == b;
    let start = old.iter().zip(new).take_while(same).count();
    let (before, after) = (old.get(start..)?, new.get(start..)?);
    let tail = before.iter().rev().zip(after.iter().rev());
    let kept = tail.take_while(same).count();
    let text = String::from_utf8(new.get(start..new.len() - kept)?.to_vec()).ok()?;
    let range = start..old.len() - kept;
    (!range.is_empty() || !text.is_empty()).then_some(TextEdit { range, text })
}

/// The bytes of a document and the starts of its lines, which end with LF, CR LF or CR.
///
/// A text has at least one line; a text that ends with a line end has an empty last line. Texts of 4 GiB and more are
/// cut off. A clone shares the text until one of the two is edited.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceText {
    bytes: Arc<Bytes>,
    line_starts: Arc<LineStarts>,
}

impl Default for SourceText {
    fn default() -> Self {
        SourceText::new(Vec::new())
    }
}

/// Whether bytes are UTF-16, by their mark or by a zero in every other place; nothing else in a text has so many.
pub(crate) fn is_utf_16(bytes: &[u8]) -> bool {
    let head = head(bytes, 1024);
    if head.starts_with(b"\xff\xfe") || head.starts_with(b"\xfe\xff") {
        return true;
    }
    let zeros = |all: &mut dyn Iterator<Item = &u8>| all.filter(|&&byte| byte == 0).count();
    let (all, odd) = (
        zeros(&mut head.iter()),
        zeros(&mut head.iter().skip(1).step_by(2)),
    );
    all * 5 > head.len() * 2 && odd * 10 > head.len() * 4 && all * 10 < head.len() * 6
}

/// Whether bytes are no text at all: many of them are control characters that no text has. A punched tape begins with
/// zeros.
pub(crate) fn is_binary(bytes: &[u8]) -> bool {
    let head = head(bytes, 1024);
    let blank = head.iter().take_while(|&&byte| byte == 0).count();
    let head = head.get(blank..).unwrap_or_default();
    let is_control = |byte: &&u8| matches!(byte, 0..=8 | 11 | 14..=25 | 27..=31 | 127);
    let controls = head.iter().filter(is_control).count();
    controls > 3 && controls * 20 > head.len()
}

/// The first items of a list, at most this many.
pub(crate) fn head<T>(all: &[T], most: usize) -> &[T] {
    all.get(..most).unwrap_or(all)
}

/// True where some bytes hold a letter or a digit of any writing, not signs alone.
pub(crate) fn says_anything(bytes: &[u8]) -> bool {
    let says = |byte: &u8| byte.is_ascii_alphanumeric() || !byte.is_ascii();
    bytes.iter().any(says)
}

/// The first characters of some bytes, for a sentence about them.
pub(crate) fn shown(bytes: &[u8]) -> String {
    let near = String::from_utf8_lossy(head(bytes, 48));
    near.chars().take(12).collect()
}

impl SourceText {
    pub fn new(mut bytes: Vec<u8>) -> SourceText {
        bytes.truncate(u32::MAX as usize);
        let line_starts = Arc::new(LineStarts::new(&bytes));
        SourceText {
            bytes: Arc::new(Bytes::new(bytes)),
            line_starts,
        }
    }

    /// The bytes with room for typing, so that the first edit need not move them all.
    pub(crate) fn with_room(mut bytes: Vec<u8>) -> Vec<u8> {
        bytes.reserve_exact(gap::ROOM_FOR_THE_FIRST);
        bytes
    }

    /// Keeps the lines and not the bytes: bytes that are asked for are read `again`.
    pub(crate) fn set_aside(&mut self, again: Again) {
        self.bytes = Arc::new(Bytes::aside(self.len(), again));
    }

    /// True where something that was set aside could not be read again: what was found in the text
    /// does not hold.
    pub(crate) fn is_lost(&self) -> bool {
        self.bytes.is_lost()
    }

    /// The whole text. After an edit that left a gap, the first call copies it; use the line functions to read a line.
    pub fn bytes(&self) -> &[u8] {
        self.bytes.whole()
    }

    pub(crate) fn into_bytes(self) -> Vec<u8> {
        Arc::unwrap_or_clone(self.bytes).into_whole()
    }

    /// A range of bytes; `None` where it reaches past the end.
    #[inline]
    pub(crate) fn slice(&self, range: Range<usize>) -> Option<&[u8]> {
        self.bytes.slice(range)
    }

    #[inline]
    pub(crate) fn byte(&self, at: usize) -> Option<u8> {
        self.bytes.get(at).copied()
    }

    /// The bytes before a line, and those from there on. Both hold whole lines.
    pub(crate) fn pieces(&self) -> (&[u8], &[u8]) {
        match self.bytes.pieces() {
            ([], whole) => (whole, &[]),
            pieces => pieces,
        }
    }

    /// The bytes before a line, as far as they are at hand: all where there is no gap and nothing is set aside.
    pub(crate) fn at_hand(&self) -> &[u8] {
        match self.bytes.is_aside() {
            true => &[],
            false => self.pieces().0,
        }
    }

    /// Makes the text contiguous again, for those who read all of it.
    pub(crate) fn join(&mut self) {
        if !self.bytes.pieces().1.is_empty() && !self.bytes.pieces().0.is_empty() {
            Arc::make_mut(&mut self.bytes).join();
        }
    }

    /// The first digits in a range of bytes.
    pub(crate) fn digits_in(&self, range: &Range<usize>) -> Option<Range<usize>> {
        let bytes = self.slice(range.clone())?;
        let start = bytes.iter().position(u8::is_ascii_digit)?;
        let digits = bytes
            .iter()
            .skip(start)
            .take_while(|byte| byte.is_ascii_digit());
        let start = range.start + start;
        Some(start..start + digits.count())
    }

    /// The text with `U+FFFD` for invalid UTF-8.
    pub fn as_str_lossy(&self) -> Cow<'_, str> {
        String::from_utf8_lossy(self.bytes())
    }

    pub fn len(&self) -> usize {
        self.bytes.len()
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub fn line_count(&self) -> usize {
        self.line_starts.len()
    }

    /// Where a line begins; the end of the text for a line past the last.
    pub fn line_start(&self, line: usize) -> usize {
        self.line_starts.get(line).unwrap_or(self.bytes.len())
    }

    pub(crate) fn line_starts(&self) -> &LineStarts {
        &self.line_starts
    }

    /// The line that holds the byte at `offset`; the last line for an offset past the end.
    pub fn line_of(&self, offset: usize) -> usize {
        self.line_starts.begun_by(offset).saturating_sub(1)
    }

    /// The line end in use before a place: that of the last line which ends there, LF where none does.
    pub(crate) fn line_end_before(&self, place: usize) -> &'static str {
        let (head, tail) = self.pieces();
        let in_tail = tail
            .get(..place.saturating_sub(head.len()))
            .unwrap_or_default();
        let in_head = head.get(..place.min(head.len())).unwrap_or_default();
        let end = memchr::memrchr(b'\n', in_tail)
            .map(|at| at + head.len())
            .or_else(|| memchr::memrchr(b'\n', in_head));
        match end.and_then(|at| self.byte(at.checked_sub(1)?)) {
            Some(b'\r') => "\r\n",
            _ => "\n",
        }
    }

    /// The bytes of a line without its line end; empty at the end of the text for a line past the last.
    pub fn line_range(&self, line: usize) -> Range<usize> {
        let start = self.line_start(line);
        let mut end = self.line_start(line.saturating_add(1)).max(start);
        if line + 1 < self.line_starts.len() {
            if end > start && self.byte(end - 1) == Some(b'\n') {
                end -= 1;
            }
            if end > start && self.byte(end - 1) == Some(b'\r') {
                end -= 1;
            }
        }
        start..end
    }

    /// A line with its line end.
    pub(crate) fn whole_line(&self, line: usize) -> Range<usize> {
        self.line_start(line)..self.line_start(line + 1)
    }

    /// The bytes of a line, without its line end.
    pub(crate) fn line(&self, line: usize) -> &[u8] {
        self.slice(self.line_range(line)).unwrap_or_default()
    }

    /// The line end of a line; of the one before it where it has none, else LF.
    pub(crate) fn line_end(&self, line: usize) -> &'static str {
        let end_of = |line: usize| {
            let end = self.line_range(line).end;
            match (self.byte(end)?, self.byte(end + 1)) {
                (b'\r', Some(b'\n')) => Some("\r\n"),
                (b'\r', _) => Some("\r"),
                _ => Some("\n"),
            }
        };
        let own = end_of(line).or_else(|| end_of(line.checked_sub(1)?));
        own.unwrap_or("\n")
    }

    /// Of some edits those that change anything, in the order of the text.
    pub(crate) fn changing(&self, mut edits: Vec<TextEdit>) -> Vec<TextEdit> {
        edits.sort_by_key(|edit| edit.range.start);
        edits.retain(|edit| self.slice(edit.range.clone()) != Some(edit.text.as_bytes()));
        edits
    }

    /// The edit that removes a word, with the space after it in its line.
    pub(crate) fn without_word(&self, word: &Range<usize>) -> TextEdit {
        let behind = self.bytes().get(word.end..).unwrap_or_default();
        let is_space = |byte: &&u8| matches!(byte, b' ' | b'\t');
        let space = behind.iter().take_while(is_space).count();
        TextEdit::new(word.start..word.end + space, "")
    }

    /// Replaces a range of bytes, which is clamped to the text. Costs a move of the tail; where the number of lines
    /// changes, also a step for each line after it.
    pub(crate) fn replace(&mut self, range: Range<usize>, replacement: &str) {
        self.replaced(range, replacement, |bytes, range, _| {
            bytes.replace(range, replacement.as_bytes());
        });
    }

    /// As [`SourceText::replace`]; costs a move of the bytes between this edit and the one before.
    /// The text then has a gap, and [`SourceText::bytes`] has to copy it.
    pub(crate) fn replace_here(&mut self, range: Range<usize>, replacement: &str) {
        self.replaced(range, replacement, |bytes, range, next| {
            bytes.replace_beside_gap(range, replacement.as_bytes(), next);
        });
    }

    /// `make` is given the clamped range, and where the first line after it begins.
    fn replaced(
        &mut self,
        range: Range<usize>,
        replacement: &str,
        make: impl FnOnce(&mut Bytes, Range<usize>, usize),
    ) {
        let end = range.end.min(self.bytes.len());
        let start = range.start.min(end);
        // The starts that the edit can make or unmake lie between its two ends, both included: a CR and a LF that meet
        // there are one line end.
        let first = self.line_starts.begun_by(start.saturating_sub(1));
        let last = self.line_starts.begun_by(end).max(first);
        let next = self.line_start(self.line_starts.begun_by(end));
        make(Arc::make_mut(&mut self.bytes), start..end, next);
        let new_end = start + replacement.len();
        let fresh: Vec<u32> = (start.max(1)..=new_end)
            .filter(|&at| self.begins_line(at))
            .map(|at| at as u32)
            .collect();
        let shift = (new_end as u32).wrapping_sub(end as u32);
        Arc::make_mut(&mut self.line_starts).replace(first..last, &fresh, shift);
    }

    fn begins_line(&self, at: usize) -> bool {
        match at.checked_sub(1).and_then(|before| self.bytes.get(before)) {
            Some(b'\n') => true,
            Some(b'\r') => self.bytes.get(at) != Some(&b'\n'),
            _ => false,
        }
    }

    /// The byte at `character` of `line`, clamped: past the end of a line its end, past the last line the end of the text.
    /// A position within a character is its first byte.
    pub(crate) fn offset_of(&self, line: usize, character: usize, encoding: Encoding) -> usize {
        if line >= self.line_count() {
            return self.bytes.len();
        }
        let Range { start: mut at, end } = self.line_range(line);
        let mut left = character;
        while at < end && left > 0 {
            let (bytes, units) = measure(self.slice(at..end).unwrap_or_default(), encoding);
            if units > left {
                break;
            }
            at += bytes;
            left -= units;
        }
        at
    }

    /// Line and character of a byte, clamped to the text; a byte within a character stands for its first, one within a
    /// line end for the end of its line.
    pub(crate) fn position_of(&self, offset: usize, encoding: Encoding) -> (usize, usize) {
        let line = self.line_of(offset);
        let Range { start, end } = self.line_range(line);
        (line, self.counted(start, offset.min(end), encoding).1)
    }

    /// Characters from the byte `from` to the byte `to` of the same line, and the end of the last of them, which is
    /// before `to` if `to` lies within a character.
    pub(crate) fn counted(&self, from: usize, to: usize, encoding: Encoding) -> (usize, usize) {
        let Some(bytes) = self.slice(from..to) else {
            return (from, 0);
        };
        if bytes.is_ascii() {
            return (to, bytes.len());
        }
        let (mut at, mut characters) = (from, 0);
        while at < to {
            // No character crosses the end of its line, so none crosses the end of its piece.
            let end = match self.pieces().0.len() {
                head if at < head => head,
                _ => self.len(),
            };
            let character = self.slice(at..end.min(at + LONGEST_CHARACTER));
            let (bytes, units) = measure(character.unwrap_or_default(), encoding);
            if at + bytes > to {
                break;
            }
            at += bytes;
            characters += units;
        }
        (at, characters)
    }
}

/// Bytes of a character in UTF-8.
const LONGEST_CHARACTER: usize = 4;

/// Bytes and units of the first character; an invalid byte is a character of one unit.
fn measure(bytes: &[u8], encoding: Encoding) -> (usize, usize) {
    let length = match bytes.first() {
        None => return (0, 0),
        Some(0..=0x7f) => return (1, 1),
        Some(0xc2..=0xdf) => 2,
        Some(0xe0..=0xef) => 3,
        Some(0xf0..=0xf4) => 4,
        Some(_) => 1,
    };
    let valid = length > 1
        && bytes
            .get(..length)
            .is_some_and(|character| std::str::from_utf8(character).is_ok());
    match (valid, encoding) {
        (false, _) => (1, 1),
        (true, Encoding::Utf8) => (length, length),
        (true, Encoding::Utf16) => (length, if length == 4 { 2 } else { 1 }),
    }
}

#[cfg(test)]
mod tests;
