//! The meaning of a word to the machine: what every control takes alike, with a note where it depends on the machine.

use super::names;
use super::vocabulary::{known, usual};
use crate::program::iso::block::{Block, Register, read_line};
use crate::program::iso::document::Document;
use crate::program::iso::machine::Machine;
use crate::program::iso::moves::CenterRule;
use crate::program::iso::plain::words;
use crate::program::iso::word::{Number, Token};
use std::ops::Range;

/// The meaning of the word at a range of bytes, in Markdown; `None` for a word without one.
pub(crate) fn meaning(document: &Document, word: Range<usize>) -> Option<String> {
    let text = document.text();
    let line = text.line_of(word.start);
    let range = text.line_range(line);
    let bytes = text.bytes().get(range.clone())?;
    let mut found = None;
    words(bytes, range.start, |token, range| {
        if range.start == word.start {
            found = Some(token);
        }
    });
    let shown = String::from_utf8_lossy(text.bytes().get(word)?).to_ascii_uppercase();
    let about = About {
        document,
        block: read_line(bytes, 1, |_| {}),
        before: document.machine_before(line).unwrap_or_default(),
        shown: &shown,
    };
    let of_table = |letter: u8| matches!(letter, b'D' | b'H');
    Some(match found? {
        Token::Word { letter, number } => {
            let word = about.word(letter, number);
            match about.row_of(letter, number) {
                Some(row) => format!("{word}\n\n{row}"),
                None => word,
            }
        }
        Token::Definition {
            letter,
            value: Some(value),
            ..
        } if of_table(letter) => {
            let length = about.length_in(value, about.before.inch);
            say!(
                value_for_a_place_of_the_table,
                shown,
                letter as char,
                length
            )
        }
        Token::Sum { letter, index, .. } if of_table(letter) => {
            let value = document.table_value(offset(letter, index)?);
            let holds = value.map_or_else(
                || say!(it_hangs_on_places_that_the_program_does_not_fill).into(),
                |value| say!(it_comes_to_mm, mm(value)),
            );
            say!(value_reckoned_from_others, shown, holds)
        }
        Token::Corner { round, number } => {
            let length = about.length_in(number, about.before.inch);
            match round {
                true => say!(the_corner_is_rounded, shown, length),
                false => say!(the_corner_is_chamfered, shown, length),
            }
        }
        Token::Definition { .. } | Token::Sum { .. } | Token::Foreign => {
            say!(matter_of_the_machine, shown)
        }
        Token::Tape => say!(begin_and_end_on_tape).into(),
        Token::Skip => say!(block_that_may_be_left_out).into(),
        Token::Comment | Token::Fault(_) => return None,
    })
}

/// A place of the control's table; `None` where the number does not name a place.
fn offset(letter: u8, index: Number) -> Option<Register> {
    let index = index.index()?;
    Some(Register { letter, index })
}

/// nm as mm, with as many decimals as needed, at least three.
fn mm(length: i64) -> String {
    let text = format!("{:.6}", length as f64 / 1e6);
    let kept = text.find('.').map_or(text.len(), |point| point + 4);
    let (head, tail) = text.split_at(kept.min(text.len()));
    let text = format!("{head}{}", tail.trim_end_matches('0'));
    if text == "-0.000" {
        "0.000".into()
    } else {
        text
    }
}

struct About<'a> {
    document: &'a Document,
    /// The whole line.
    block: Block,
    /// The state before the line.
    before: Machine,
    /// The word as it stands.
    shown: &'a str,
}

impl About<'_> {
    /// The row of a table that a word chooses and the program itself sets, and its content.
    fn row_of(&self, letter: u8, number: Number) -> Option<String> {
        if !matches!(letter, b'C' | b'E') {
            return None;
        }
        let index = offset(letter, number)?.index;
        let line = names::line_of_row(self.document, letter, index)?;
        let row = String::from_utf8_lossy(self.document.text().line(line))
            .trim()
            .to_owned();
        Some(say!(the_row_of_the_table_is_in_line, line + 1, row))
    }

    fn word(&self, letter: u8, number: Number) -> String {
        let shown = self.shown;
        match letter {
            b'N' => say!(number_that_a_call_may_name, shown),
            b'O' => say!(number_of_a_program, shown),
            b'X' | b'Y' => self.coordinate(letter as char, number),
            b'I' => self.centre('X', number),
            b'J' => self.centre('Y', number),
            b'R' => say!(radius_of_the_arc, shown, self.length(number)),
            b'D' | b'H' => self.place(letter, number),
            b'F' => say!(feed_in_a_unit_of_the_machine, shown),
            b'L' => say!(how_often_the_subprogram_is_run, shown),
            b'P' => match (self.block.call, self.block.takes_coordinates) {
                (Some(number), _) => say!(runs_the_subprogram, shown, number),
                (None, true) => say!(how_long_the_machine_waits, shown),
                (None, false) => say!(matter_of_the_machine, shown),
            },
            _ => match (known(letter, number), usual(letter, number)) {
                (Some(about), _) => say!(word_in_bold, shown, about),
                (None, Some(usual)) => say!(matter_of_the_machine_mostly, shown, usual),
                (None, None) => say!(matter_of_the_machine, shown),
            },
        }
    }

    fn length_in(&self, number: Number, inch: bool) -> String {
        mm(self.document.reading().length(number, inch))
    }

    /// A length, read under the state after the line's own words.
    fn length(&self, number: Number) -> String {
        self.length_in(number, self.block.inch.unwrap_or(self.before.inch))
    }

    fn is_incremental(&self) -> bool {
        self.block.incremental.unwrap_or(self.before.incremental)
    }

    fn coordinate(&self, axis: char, number: Number) -> String {
        let (shown, length) = (self.shown, self.length(number));
        if self.block.sets_position {
            say!(the_wire_stands_at, shown, axis, length)
        } else if self.block.takes_coordinates {
            say!(along_an_axis_for_another_word, shown, length, axis)
        } else if self.is_incremental() {
            say!(along_an_axis_from_the_wire, shown, length, axis)
        } else {
            say!(to_a_place_from_the_zero, shown, axis, length)
        }
    }

    fn centre(&self, axis: char, number: Number) -> String {
        let length = self.length(number);
        let meant = match self.document.reading().rule(self.is_incremental()) {
            CenterRule::StartToCenter => say!(centre_from_the_start, length, axis),
            CenterRule::CenterToStart => say!(start_from_the_centre, length, axis),
            CenterRule::Absolute => say!(centre_from_the_zero, axis, length),
        };
        let known = if self.document.evidence().leaves_centers_open() {
            say!(the_arcs_leave_that_open)
        } else {
            say!(found_from_the_arcs_of_this_program)
        };
        say!(centre_and_how_that_is_known, self.shown, meant, known)
    }

    fn place(&self, letter: u8, number: Number) -> String {
        let place = offset(letter, number).unwrap_or(Register {
            letter,
            index: u32::MAX,
        });
        match self.document.table_value(place) {
            Some(value) => say!(
                place_of_the_table_as_set,
                self.shown,
                place.index,
                mm(value)
            ),
            None => {
                let correction =
                    (self.document.control.limits.settings.correction * 1e6).round() as i64;
                say!(
                    place_of_the_table_of_the_machine,
                    self.shown,
                    place.index,
                    mm(correction)
                )
            }
        }
    }
}
