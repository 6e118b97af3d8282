//! From where the moves are to lead to edits of the text, and the proof that they lead there.

use super::sheet::{Content, Sheet};
use crate::finding::{Severity, Side};
use crate::geometry::Segment;
use crate::program::iso::block::{Motion, read_line};
use crate::program::iso::document::Document;
use crate::program::iso::layout::is_parted;
use crate::program::iso::machine::{Bend, CenterRule, Course, Machine, Move, Place, Reading};
use crate::program::iso::style::Style;
use crate::program::iso::word::{Number, Token, words};
use crate::text::TextEdit;
use std::collections::BTreeMap;
use std::ops::Range;

/// How far the middle of an arc may lie from where it is meant to, µm: its centre is written in the program's steps.
const MIDDLE_TOLERANCE: f64 = 2.5;

/// Where a move leads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    pub motion: Motion,
    pub to: Place,
    pub bend: Bent,
    pub side: Option<Side>,
}

/// About what an arc runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bent {
    Line,
    Center(Place),
    Radius(i64),
}

impl Target {
    /// What a move does.
    pub fn of(made: &Move, reading: &Reading) -> Target {
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

/// What a refactoring does to a program.
#[derive(Clone, Debug, Default)]
pub struct Rewrite {
    /// By row, where it leads; rows that are not named lead where they did.
    pub rows: BTreeMap<usize, Target>,
    /// Words of the text that become others.
    pub words: Vec<TextEdit>,
    /// How arcs are to be written; as they are, where it is `None`.
    pub reading: Option<Reading>,
    /// A word to be put before the first move.
    pub first_word: Option<&'static str>,
}

impl Rewrite {
    /// The edits of the text; none where nothing changes.
    pub fn edits(mut self, sheet: &Sheet<'_>, content: &Content) -> Result<Vec<TextEdit>, String> {
        self.words.sort_by_key(|edit| edit.range.start);
        let document = sheet.document;
        let text = document.text();
        let old = document.reading();
        let reading = self.reading.unwrap_or(*old);
        let parted = is_parted(text);
        let targets: Vec<Target> = content
            .rows
            .iter()
            .enumerate()
            .map(|(index, row)| {
                self.rows
                    .get(&index)
                    .copied()
                    .unwrap_or_else(|| Target::of(&row.made, old))
            })
            .collect();
        let styles = [false, true].map(|inch| Style::of(document, inch));
        let mut machine = document.first_machine();
        let mut edits = Vec::new();
        let (mut row, mut word) = (0, 0);
        for line in 0..text.line_count() {
            let range = text.line_range(line);
            let own = text.bytes().get(range.clone()).unwrap_or_default();
            let mut bytes = own.to_vec();
            let first = word;
            while self
                .words
                .get(word)
                .is_some_and(|edit| edit.range.end <= range.end)
            {
                word += 1;
            }
            for edit in self.words[first..word].iter().rev() {
                bytes.splice(
                    edit.range.start - range.start..edit.range.end - range.start,
                    edit.text.bytes(),
                );
            }
            let here = content.rows.get(row).filter(|row| row.line == line);
            let Some(target) = here.and_then(|_| targets.get(row)) else {
                machine.run(&read_line(&bytes, 1, |_| {}), &reading);
                push(&mut edits, range, own, &bytes)?;
                continue;
            };
            if row == 0
                && let Some(word) = self.first_word
            {
                bytes = with_word(&bytes, word, parted);
            }
            row += 1;
            // A line that does what is meant stays as it is.
            let mut as_it_is = machine;
            let made = as_it_is.run(&read_line(&bytes, 1, |_| {}), &reading);
            if made.is_some_and(|made| {
                made.from == machine.at && Target::of(&made, &reading) == *target
            }) {
                machine = as_it_is;
            } else {
                let style = styles[usize::from(as_it_is.inch)];
                bytes = Line {
                    bytes: &bytes,
                    parted,
                    style,
                    reading: &reading,
                }
                .leading(target, &machine)?;
                let made = machine.run(&read_line(&bytes, 1, |_| {}), &reading);
                prove(line, made.as_ref(), target, &reading)?;
            }
            push(&mut edits, range, own, &bytes)?;
        }
        if edits.is_empty() {
            return Ok(edits);
        }
        prove_program(sheet, &applied(text.bytes(), &edits), &targets)?;
        Ok(edits)
    }
}

/// The edit of one line that leads its move to `target`, from what is in force before it; `None` where that cannot be written.
pub fn line_to(
    document: &Document,
    line: usize,
    before: &Machine,
    target: &Target,
) -> Option<TextEdit> {
    let range = document.text().line_range(line);
    let own = document.text().bytes().get(range.clone())?;
    let reading = document.reading();
    let inch = read_line(own, 1, |_| {}).inch.unwrap_or(before.inch);
    let written = Line {
        bytes: own,
        parted: is_parted(document.text()),
        style: Style::of(document, inch),
        reading,
    };
    let new = written.leading(target, before).ok()?;
    let mut machine = *before;
    let made = machine.run(&read_line(&new, 1, |_| {}), reading);
    prove(line, made.as_ref(), target, reading).ok()?;
    let mut edits = Vec::new();
    push(&mut edits, range, own, &new).ok()?;
    edits.pop()
}

/// An edit from the first byte of a line that changes to the last.
fn push(
    edits: &mut Vec<TextEdit>,
    range: Range<usize>,
    old: &[u8],
    new: &[u8],
) -> Result<(), String> {
    if old == new {
        return Ok(());
    }
    let start = old.iter().zip(new).take_while(|(a, b)| a == b).count();
    let same_end = old
        .iter()
        .rev()
        .zip(new.iter().rev())
        .take_while(|(a, b)| a == b)
        .count();
    let kept = same_end.min(old.len() - start).min(new.len() - start);
    let text = String::from_utf8(new[start..new.len() - kept].to_vec())
        .map_err(|_| "a line is in another code page".to_owned())?;
    edits.push(TextEdit {
        range: range.start + start..range.end - kept,
        text,
    });
    Ok(())
}

fn prove(
    line: usize,
    made: Option<&Move>,
    target: &Target,
    reading: &Reading,
) -> Result<(), String> {
    let fault = |what: &str| Err(format!("line {}: {what}", line + 1));
    let Some(made) = made else {
        return fault("the new line does not move");
    };
    if made.to != target.to || made.motion != target.motion {
        return fault("the new line leads elsewhere");
    }
    if !matches!(made.course(reading), Course::Line | Course::Arc(_)) {
        return fault("its arc cannot be written with the program's decimals");
    }
    Ok(())
}

/// The new program, read from its text alone, makes the moves that are meant, and has no fault that the old one has not.
fn prove_program(sheet: &Sheet<'_>, text: &[u8], targets: &[Target]) -> Result<(), String> {
    let after = Document::read_with(text.to_vec(), sheet.settings);
    let mut index = 0;
    let mut fault = None;
    after.moves(&mut |line, made, _| {
        let Some(target) = targets.get(index) else {
            fault.get_or_insert_with(|| format!("line {} would move too", line + 1));
            return;
        };
        index += 1;
        let same = made.to == target.to && made.motion == target.motion && made.side == target.side;
        if !same || !runs_along(&made, target, after.reading()) {
            fault.get_or_insert_with(|| match target.bend {
                Bent::Center(_) if same => {
                    "the arcs would not tell any more how I and J are meant".to_owned()
                }
                _ => format!("line {} would lead elsewhere", line + 1),
            });
        }
    });
    if index != targets.len() {
        fault.get_or_insert_with(|| "a move would be lost".to_owned());
    }
    let errors = |document: &Document| {
        document
            .plain_findings()
            .iter()
            .filter(|finding| finding.severity == Severity::Error)
            .count()
    };
    if fault.is_none() && errors(&after) > errors(sheet.document) {
        fault = Some("the new program would have faults that this one has not".into());
    }
    fault.map_or(Ok(()), Err)
}

fn runs_along(made: &Move, target: &Target, reading: &Reading) -> bool {
    let bend = match target.bend {
        Bent::Line => return !made.is_arc(),
        Bent::Radius(radius) => Bend::Radius(radius),
        Bent::Center(center) => {
            let [i, j] = [0, 1].map(|axis| center[axis].wrapping_sub(made.from[axis]));
            Bend::Center {
                i,
                j,
                absolute: center,
            }
        }
    };
    let meant = Move {
        bend,
        incremental: false,
        ..*made
    };
    let plain = Reading {
        absolute: CenterRule::StartToCenter,
        ..*reading
    };
    match (made.course(reading), meant.course(&plain)) {
        (Course::Arc(is), Course::Arc(meant)) => {
            let middle = |arc| Segment::Arc(arc).point_at(0.5);
            (middle(is) - middle(meant)).norm() <= MIDDLE_TOLERANCE
        }
        _ => false,
    }
}

/// A line that is written anew.
struct Line<'a> {
    bytes: &'a [u8],
    parted: bool,
    style: Style,
    reading: &'a Reading,
}

impl Line<'_> {
    /// The line with the words that lead to `target` from where the machine stands before it. All other words stay.
    fn leading(&self, target: &Target, before: &Machine) -> Result<Vec<u8>, String> {
        let block = read_line(self.bytes, 1, |_| {});
        let incremental = block.incremental.unwrap_or(before.incremental);
        let base = if incremental { before.at } else { before.zero };
        let mut cluster: Vec<String> = Vec::new();
        let number = |length: i64| self.style.number(length);
        let had = [block.x.is_some(), block.y.is_some()];
        for (axis, letter) in [(0, 'X'), (1, 'Y')] {
            let moves = target.to[axis] != before.at[axis];
            // An arc without coordinates is a full circle; a line without any is none.
            let is_needed = target.to == before.at && target.bend == Bent::Line;
            if moves || had[axis] || is_needed {
                cluster.push(format!(
                    "{letter}{}",
                    number(target.to[axis].wrapping_sub(base[axis]))
                ));
            }
        }
        match target.bend {
            Bent::Line => {}
            Bent::Radius(radius) => cluster.push(format!("R{}", number(radius))),
            Bent::Center(center) => {
                for (axis, letter) in [(0, 'I'), (1, 'J')] {
                    let length = match self.reading.rule(incremental) {
                        CenterRule::StartToCenter => center[axis].wrapping_sub(before.at[axis]),
                        CenterRule::CenterToStart => before.at[axis].wrapping_sub(center[axis]),
                        CenterRule::Absolute => center[axis].wrapping_sub(before.zero[axis]),
                    };
                    cluster.push(format!("{letter}{}", number(length)));
                }
            }
        }
        let motion = word_of(target.motion);
        let mut out: Vec<u8> = Vec::with_capacity(self.bytes.len() + 24);
        let (mut copied, mut is_placed, mut has_motion) = (0, false, false);
        let mut anchor = 0;
        let separator = if self.parted { " " } else { "" };
        let mut fault = None;
        let mut tokens = Vec::new();
        words(self.bytes, 1, |token| tokens.push(token));
        for token in tokens {
            let Token::Word {
                letter,
                number,
                range,
            } = token
            else {
                if let Token::Fault { .. } = token {
                    fault = Some("the line cannot be read");
                }
                continue;
            };
            let range = range.start - 1..range.end - 1;
            match letter {
                b'G' if is_motion(number) => {
                    has_motion = true;
                    out.extend_from_slice(&self.bytes[copied..range.start]);
                    let same = Some(target.motion) == motion_of(number);
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
                        // The space before a word that goes, goes with it.
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

/// A line with a word put behind its block number.
pub fn with_word(line: &[u8], word: &str, parted: bool) -> Vec<u8> {
    let mut at = 0;
    let mut is_first = true;
    words(line, 1, |token| {
        if let Token::Word {
            letter: b'N' | b'O',
            range,
            ..
        }
        | Token::Skip { range }
        | Token::Tape { range } = token
            && is_first
        {
            at = range.end - 1;
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

fn word_of(motion: Motion) -> &'static str {
    match motion {
        Motion::Rapid => "G00",
        Motion::Line => "G01",
        Motion::Clockwise => "G02",
        Motion::CounterClockwise => "G03",
    }
}

fn motion_of(number: Number) -> Option<Motion> {
    Some(match number.whole()? {
        0 => Motion::Rapid,
        1 => Motion::Line,
        2 => Motion::Clockwise,
        3 => Motion::CounterClockwise,
        _ => return None,
    })
}

pub fn is_motion(number: Number) -> bool {
    number.decimals == 0 && motion_of(number).is_some()
}

/// Bytes with sorted, disjoint edits made.
pub fn applied(bytes: &[u8], edits: &[TextEdit]) -> Vec<u8> {
    let mut result = Vec::with_capacity(bytes.len());
    let mut at = 0;
    for edit in edits {
        result.extend_from_slice(bytes.get(at..edit.range.start).unwrap_or_default());
        result.extend_from_slice(edit.text.as_bytes());
        at = edit.range.end;
    }
    result.extend_from_slice(bytes.get(at..).unwrap_or_default());
    result
}

/// The G41 and G42 of some lines, each as the other one.
pub fn swapped_sides(document: &Document, lines: Range<usize>) -> Vec<TextEdit> {
    let text = document.text();
    let mut edits = Vec::new();
    for line in lines {
        let range = text.line_range(line);
        words(
            text.bytes().get(range.clone()).unwrap_or_default(),
            range.start.max(1),
            |token| {
                if let Token::Word {
                    letter: b'G',
                    number,
                    range: word,
                } = token
                    && let Some(other) = match (number.decimals, number.mantissa) {
                        (0, 41) => Some("G42"),
                        (0, 42) => Some("G41"),
                        _ => None,
                    }
                {
                    let by = range.start.max(1) - range.start;
                    edits.push(TextEdit {
                        range: word.start - by..word.end - by,
                        text: other.into(),
                    });
                }
            },
        );
    }
    edits
}
