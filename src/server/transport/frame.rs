//! Frames of the base protocol from a stream of bytes, and recovery after a broken one.
//!
//! Knows nothing of JSON. Never allocates by `Content-Length` alone: memory grows with the bytes that came. Every step
//! consumes bytes: there are fewer steps than bytes.

use super::lost::{LostChange, lost_change};
use super::{Messages, stdio};
use crate::text::head;
use memchr::memmem;
use std::io::Read;
use std::ops::Range;

/// A body longer than this is skipped.
pub(super) const BODY_CAP: u64 = 256 * 1024 * 1024;
/// A longer header block is invalid.
const HEADER_CAP: usize = 8 * 1024;
const CHUNK: usize = 64 * 1024;
/// A longer `Content-Length: …` line is not searched for.
const MARKER_CAP: usize = 64;

/// The next item of the stream.
#[derive(Debug, PartialEq, Eq)]
pub enum Frame {
    Body(Vec<u8>),
    /// An invalid frame, and why; the stream stands before the next one.
    Broken(String),
    End,
}

pub struct Frames<R> {
    input: R,
    buffer: Vec<u8>,
    /// Bytes of `buffer` that are used up.
    start: usize,
    /// Bytes that have been dropped from the front of `buffer`; negative while the end of a broken body is read again.
    dropped: i64,
    ended: bool,
    /// The last body was broken: the following bytes may be its rest.
    out_of_step: bool,
    /// The change of a document in what was passed over.
    lost: Option<LostChange>,
    /// Bytes ahead that are the end of a broken body, which its reader has looked through.
    looked_through: usize,
}

impl<R: Read> Messages for Frames<R> {
    fn step(&mut self) -> Frame {
        Frames::step(self)
    }

    fn take_lost(&mut self) -> Option<LostChange> {
        self.lost.take()
    }

    fn was_broken(&mut self, body: &[u8]) {
        Frames::was_broken(self, body);
    }

    fn position(&self) -> i64 {
        Frames::position(self)
    }

    fn is_hung_up(&self) -> bool {
        stdio::is_hung_up()
    }
}

impl<R: Read> Frames<R> {
    pub fn new(input: R) -> Frames<R> {
        Frames {
            input,
            buffer: Vec::new(),
            start: 0,
            dropped: 0,
            ended: false,
            out_of_step: false,
            lost: None,
            looked_through: 0,
        }
    }

    /// Passes over bytes that are no part of a sound message.
    fn pass_over(&mut self, count: usize) {
        let known = self.looked_through.min(count);
        self.looked_through -= known;
        if let Some(lost) = lost_change(self.ahead(known..count)) {
            self.lost = Some(lost);
        }
        self.start += count;
    }

    /// Bytes of the stream that are used up. It grows with every step; after [`Frames::was_broken`] it is less than
    /// before it, but more than before the step.
    pub fn position(&self) -> i64 {
        self.dropped + self.start as i64
    }

    /// Reads until a frame is whole, broken, or the stream ends.
    pub fn step(&mut self) -> Frame {
        if std::mem::take(&mut self.out_of_step) {
            self.skip_to_header(0);
            self.looked_through = 0;
        }
        match self.header() {
            Ok(None) => Frame::End,
            Ok(Some(length)) if length > BODY_CAP => {
                self.skip_body(length);
                Frame::Broken(say!(a_body_is_over_the_limit, length, BODY_CAP))
            }
            Ok(Some(length)) => self.body(length as usize),
            Err(reason) => Frame::Broken(reason),
        }
    }

    /// Marks the last body as invalid: its end and the following bytes are searched for the next header.
    pub fn was_broken(&mut self, body: &[u8]) {
        let tail = body
            .get(body.len().saturating_sub(MARKER_CAP)..)
            .unwrap_or_default();
        self.dropped += self.start as i64 - tail.len() as i64;
        self.buffer.splice(..self.start, tail.iter().copied());
        self.looked_through = tail.len();
        self.start = 0;
        self.out_of_step = true;
    }

    fn rest(&self) -> &[u8] {
        self.buffer.get(self.start..).unwrap_or_default()
    }

    /// A part of the unused bytes.
    fn ahead(&self, range: Range<usize>) -> &[u8] {
        self.rest().get(range).unwrap_or_default()
    }

    /// Reads more; false at the end of the stream.
    fn fill(&mut self) -> bool {
        if self.ended {
            return false;
        }
        if self.start > CHUNK {
            self.drop_used();
        }
        let old = self.buffer.len();
        self.buffer.resize(old + CHUNK, 0);
        let count = loop {
            match self
                .input
                .read(self.buffer.get_mut(old..).unwrap_or_default())
            {
                Ok(count) => break count,
                Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
                Err(_) => break 0,
            }
        };
        self.buffer.truncate(old + count);
        self.ended = count == 0;
        !self.ended
    }

    /// Forgets the used bytes.
    fn drop_used(&mut self) {
        self.buffer.drain(..self.start);
        self.dropped += self.start as i64;
        self.start = 0;
    }

    /// The length in the next header block; `None` at the end of the stream.
    ///
    /// A faulty block is used up to and with the first byte of the faulty line: the rest of that
    /// line may hold the next header.
    fn header(&mut self) -> Result<Option<u64>, String> {
        let mut length = None;
        // Where the next line of the block begins.
        let mut at = 0;
        loop {
            let Some(end) = memchr::memchr(b'\n', self.ahead(at..self.rest().len()))
                .map(|end| at + end)
                .filter(|&end| end <= HEADER_CAP)
            else {
                if self.rest().len() > HEADER_CAP {
                    self.skip_to_header(at + 1);
                    return Err(say!(no_whole_header_within_bytes, HEADER_CAP));
                }
                if !self.fill() {
                    return match self.rest().iter().all(u8::is_ascii_whitespace) {
                        true => Ok(None),
                        false => {
                            self.start = self.buffer.len();
                            Err(say!(the_stream_ends_within_a_header).into())
                        }
                    };
                }
                continue;
            };
            let line = self.ahead(at..end).trim_ascii();
            if line.is_empty() {
                let is_between_frames = at == 0;
                self.start += end + 1;
                match length {
                    // Blank lines between frames are harmless.
                    _ if is_between_frames => continue,
                    None => {
                        self.skip_to_header(0);
                        return Err(say!(a_header_without_content_length).into());
                    }
                    length => return Ok(length),
                }
            }
            let fault = match field(line) {
                Some((name, value)) if name.eq_ignore_ascii_case(b"content-length") => {
                    length = std::str::from_utf8(value)
                        .ok()
                        .and_then(|digits| digits.parse().ok());
                    length.is_none().then(|| {
                        format!("Content-Length is \"{}\", expected a number", shown(value))
                    })
                }
                // Something was printed right before the next header.
                Some(_) if marker(self.ahead(at..end + 1)).is_none() => None,
                _ => Some(say!(is_no_header_line, shown(line))),
            };
            if let Some(fault) = fault {
                self.skip_to_header(at + 1);
                return Err(fault);
            }
            at = end + 1;
        }
    }

    fn body(&mut self, length: usize) -> Frame {
        if length > CHUNK {
            // A long body is handed on as it lies in the buffer, without a second copy.
            self.drop_used();
        }
        let mut searched: usize = 0;
        loop {
            let have = self.rest().len().min(length);
            // No JSON holds a header line: where one stands, the length was wrong and the next frame begins.
            let from = searched.saturating_sub(MARKER_CAP);
            if let Some(at) = marker(self.ahead(from..have)) {
                self.pass_over(from + at);
                return Frame::Broken(say!(the_next_frame_begins_within_a_body, length));
            }
            searched = have;
            if have == length {
                break;
            }
            if !self.fill() {
                self.start = self.buffer.len();
                return Frame::Broken(say!(the_stream_ends_within_a_body, length));
            }
        }
        let end = self.start + length;
        let body = if self.start == 0 && length > CHUNK {
            let rest = self.buffer.split_off(end);
            self.dropped += end as i64;
            std::mem::replace(&mut self.buffer, rest)
        } else {
            let body = self.ahead(0..length).to_vec();
            self.start = end;
            if self.start == self.buffer.len() {
                self.drop_used();
            }
            body
        };
        Frame::Body(body)
    }

    /// Drops `length` bytes, or fewer when the next header comes before.
    fn skip_body(&mut self, length: u64) {
        let mut left = length;
        loop {
            let have = usize::try_from(left)
                .unwrap_or(usize::MAX)
                .min(self.rest().len());
            if let Some(at) = marker(self.ahead(0..have)) {
                self.pass_over(at);
                return;
            }
            let drop = if have as u64 == left {
                have
            } else {
                have.saturating_sub(MARKER_CAP)
            };
            self.pass_over(drop);
            left -= drop as u64;
            if left == 0 || !self.fill() {
                return;
            }
        }
    }

    /// Drops everything before the next header line, which is searched for from `from` bytes ahead on.
    fn skip_to_header(&mut self, from: usize) {
        self.pass_over(from.min(self.rest().len()));
        loop {
            if let Some(at) = marker(self.rest()) {
                self.pass_over(at);
                return;
            }
            self.pass_over(self.rest().len().saturating_sub(MARKER_CAP));
            if !self.fill() {
                self.start = self.buffer.len();
                return;
            }
        }
    }
}

/// The first bytes in a header's place, for a message.
fn shown(bytes: &[u8]) -> String {
    String::from_utf8_lossy(head(bytes, MARKER_CAP)).into_owned()
}

/// Name and value of a header line.
fn field(line: &[u8]) -> Option<(&[u8], &[u8])> {
    let mut parts = line.splitn(2, |byte| *byte == b':');
    let (name, value) = (parts.next()?, parts.next()?);
    let is_token = !name.is_empty()
        && name
            .iter()
            .all(|&byte| byte.is_ascii_alphanumeric() || byte == b'-');
    is_token.then(|| (name, value.trim_ascii()))
}

/// Where a whole `Content-Length: <digits>` line begins.
fn marker(bytes: &[u8]) -> Option<usize> {
    const NAME: &[u8] = b"Content-Length:";
    const TAIL: &[u8] = b"ength:";
    memmem::find_iter(bytes, TAIL).find_map(|at| {
        let end = at + TAIL.len();
        let begin = end.checked_sub(NAME.len())?;
        let value = head(bytes.get(end..)?, MARKER_CAP - NAME.len());
        let digits = value.get(..memchr::memchr(b'\n', value)?)?.trim_ascii();
        let whole = !digits.is_empty()
            && digits.iter().all(u8::is_ascii_digit)
            && bytes.get(begin..end)?.eq_ignore_ascii_case(NAME);
        whole.then_some(begin)
    })
}

#[cfg(test)]
mod tests;
