//! Rewrites a line so that its move leads elsewhere; all other words stay.

use super::block::{Block, Motion};
use super::document::Document;
use super::machine::Machine;
use super::moves::{Bend, Move, Place, Reading, apart, to_center};
use super::plain::words_in;
use super::style::Style;
use super::word::Token;
use crate::finding::Side;
use crate::text::{TextEdit, difference};
use std::ops::Range;

/// The largest distance of an arc's middle from the intended one, µm: its centre is written in the program's steps.
pub(super) const MIDDLE_TOLERANCE: f64 = 2.5;

/// The target of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::program) struct Target {
    pub(crate) motion: Motion,
    pub(crate) to: Place,
    pub(crate) bend: Bent,
    pub(crate) side: Option<Side>,
}

/// What a move runs about: nothing, a centre, or one given by its radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::program) enum Bent {
    Line,
    Center(Place),
    Radius(i64),
}

impl Target {
    /// The target of a move as it is.
    pub(crate) fn of(made: &Move, reading: &Reading) -> Target {
        let bend = match (made.is_arc(), made.bend) {
            (true, Bend::Radius(radius)) => Bent::Radius(radius),
            (true, _) => made
                .center(reading.rule(made.incremental))
                .map_or(Bent::Line, Bent::Center),
            (false, _) => Bent::Line,
        };
        Target {
            motion: made.motion,
            to: made.to,
            bend,
            side: made.side,
        }
    }
}

/// The edit of one line that leads its move to `target`, from the state before it; `None` where that cannot be written.
pub(super) fn line_to(
    document: &Document,
    line: usize,
    before: &Machine,
    target: &Target,
) -> Option<TextEdit> {
    let own = document.line_bytes(line);
    let reading = document.reading();
    let inch = document.block(line).inch.unwrap_or(before.inch);
    let written = Line {
        bytes: own,
        parted: document.is_parted(),
        style: Style::of(document, inch),
        reading,
    };
    let new = written.leading(target, before).ok()?;
    let mut machine = *before;
    let made = machine.run(&Block::of(&new), reading);
    prove(line, made.as_ref(), target, reading).ok()?;
    let mut edits = Vec::new();
    let range = document.text().line_range(line);
    push_changed(&mut edits, range, own, &new).ok()?;
    edits.pop()
}

/// An edit from the first byte of a line that changes to the last.
pub(super) fn push_changed(
    edits: &mut Vec<TextEdit>,
    range: Range<usize>,
    old: &[u8],
    new: &[u8],
) -> Result<(), String> {
    if old != new {
        let TextEdit { range: own, text } =
            difference(old, new).ok_or(say!(a_line_is_in_another_code_page))?;
        let place = range.start + own.start..range.start + own.end;
        edits.push(TextEdit::new(place, text));
    }
    Ok(())
}

pub(super) fn prove(
    line: usize,
    made: Option<&Move>,
    target: &Target,
    reading: &Reading,
) -> Result<(), String> {
    let fault = |what: &str| Err(say!(line_by_number, line + 1, what));
    let Some(made) = made else {
        return fault(say!(the_new_line_does_not_move));
    };
    if made.to != target.to || made.motion != target.motion {
        return fault(say!(the_new_line_leads_elsewhere));
    }
    if made.curve(reading).is_none() {
        return fault(say!(its_arc_cannot_be_written_with_the_program_s_decimals));
    }
    Ok(())
}

/// A rewritten line.
pub(super) struct Line<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) parted: bool,
    pub(crate) style: Style,
    pub(crate) reading: &'a Reading,
}

impl Line<'_> {
    /// The words that lead to `target`, except that of its motion.
    fn words_to(&self, target: &Target, before: &Machine) -> Vec<String> {
        let block = Block::of(self.bytes);
        let incremental = block.incremental.unwrap_or(before.incremental);
        let base = if incremental { before.at } else { before.zero };
        let mut cluster: Vec<String> = Vec::new();
        let number = |length: i64| self.style.number(length);
        let had = [block.x.is_some(), block.y.is_some()];
        for (axis, letter) in [(0, 'X'), (1, 'Y')] {
            let moves = target.to[axis] != before.at[axis];
            // An arc without coordinates is a full circle; a line without any does not move.
            let is_needed = target.to == before.at && target.bend == Bent::Line;
            if moves || had[axis] || is_needed {
                let along = number(target.to[axis].wrapping_sub(base[axis]));
                cluster.push(format!("{letter}{along}"));
            }
        }
        match target.bend {
            Bent::Line => {}
            Bent::Radius(radius) => cluster.push(format!("R{}", number(radius))),
            Bent::Center(center) => {
                let stated = block.center.or(before.center);
                let rule = stated.unwrap_or(self.reading.rule(incremental));
                let [i, j] = to_center(rule, center, before.at, before.zero).map(number);
                cluster.extend([format!("I{i}"), format!("J{j}")]);
            }
        }
        cluster
    }

    /// The line with the words that lead to `target` from the machine's position before it. All other words stay.
    pub(crate) fn leading(&self, target: &Target, before: &Machine) -> Result<Vec<u8>, String> {
        let cluster = self.words_to(target, before);
        let motion = target.motion.word();
        let mut out: Vec<u8> = Vec::with_capacity(self.bytes.len() + 24);
        let (mut copied, mut is_placed, mut has_motion) = (0, false, false);
        let mut anchor = 0;
        let separator = if self.parted { " " } else { "" };
        let mut fault = None;
        let mut tokens = Vec::new();
        words_in(self.bytes, |token, range| tokens.push((token, range)));
        for (token, range) in tokens {
            let Token::Word { letter, number } = token else {
                if let Token::Fault(_) = token {
                    fault = Some(say!(the_line_cannot_be_read));
                }
                continue;
            };
            match letter {
                b'G' if Motion::of(number).is_some() => {
                    has_motion = true;
                    out.extend_from_slice(&self.bytes[copied..range.start]);
                    let same = Some(target.motion) == Motion::of(number);
                    out.extend_from_slice(if same {
                        &self.bytes[range.clone()]
                    } else {
                        motion.as_bytes()
                    });
                    (copied, anchor) = (range.end, out.len());
                }
                b'X' | b'Y' | b'I' | b'J' | b'R' => {
                    let gap = &self.bytes[copied..range.start];
                    if is_placed {
                        // The space before a removed word goes too.
                        let kept = gap
                            .iter()
                            .rposition(|byte| !matches!(byte, b' ' | b'\t'))
                            .map_or(0, |last| last + 1);
                        out.extend_from_slice(&gap[..kept]);
                    } else {
                        out.extend_from_slice(gap);
                        out.extend_from_slice(cluster.join(separator).as_bytes());
                        is_placed = true;
                    }
                    copied = range.end;
                }
                _ => {
                    out.extend_from_slice(&self.bytes[copied..range.end]);
                    (copied, anchor) = (range.end, out.len());
                }
            }
        }
        out.extend_from_slice(&self.bytes[copied..]);
        if let Some(fault) = fault {
            return Err(fault.into());
        }
        let mut insert = |at: usize, text: String| {
            let text = if at > 0 && self.parted {
                format!(" {text}")
            } else {
                text
            };
            out.splice(at..at, text.bytes());
        };
        if !is_placed && !cluster.is_empty() {
            insert(anchor, cluster.join(separator));
        }
        if !has_motion && before.motion != target.motion {
            return Ok(with_word(&out, motion, self.parted));
        }
        Ok(out)
    }
}

impl Document {
    /// The edit that puts a word after the block number of a line; `None` in another code page.
    pub(super) fn with_word(&self, line: usize, word: &str) -> Option<TextEdit> {
        let text = self.text();
        let new = String::from_utf8(with_word(text.line(line), word, self.is_parted())).ok()?;
        Some(TextEdit::new(text.line_range(line), new))
    }
}

/// The words of a line of its own that moves from where the machine stands to a place; `center` as I and J give it.
pub(crate) fn words_of_move(
    before: &Machine,
    style: &Style,
    motion: Motion,
    to: Place,
    center: Option<Place>,
) -> Vec<String> {
    let base = if before.incremental {
        before.at
    } else {
        before.zero
    };
    let [x, y] = apart(to, base);
    let lengths = [('X', x), ('Y', y)].into_iter();
    let lengths = lengths.chain(center.into_iter().flat_map(|[i, j]| [('I', i), ('J', j)]));
    let words = lengths.map(|(letter, length)| format!("{letter}{}", style.number(length)));
    [motion.word().to_owned()]
        .into_iter()
        .chain(words)
        .collect()
}

/// A line with a word put after its block number.
pub(super) fn with_word(line: &[u8], word: &str, parted: bool) -> Vec<u8> {
    let mut at = 0;
    let mut is_first = true;
    words_in(line, |token, range| {
        let leads = match token {
            Token::Word { letter, .. } => matches!(letter, b'N' | b'O'),
            token => matches!(token, Token::Skip | Token::Tape),
        };
        if leads && is_first {
            at = range.end;
        } else {
            is_first = false;
        }
    });
    let mut out = line.to_vec();
    let lead = line
        .iter()
        .take_while(|byte| matches!(byte, b' ' | b'\t'))
        .count();
    let text = match (at, parted) {
        (0, true) => format!("{word} "),
        (_, true) => format!(" {word}"),
        (_, false) => word.to_owned(),
    };
    let at = if at == 0 { lead } else { at };
    out.splice(at..at, text.bytes());
    out
}
