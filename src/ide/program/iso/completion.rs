//! Completion of a line: words with their meanings, the centre of an arc from its end, the way back to the start of the
//! cut, places of the control's table, the lines of the profile.

use super::super::step::ways_back;
use super::holds;
use super::vocabulary::known;
use crate::ide::{Completion, CompletionKind};
use crate::program::iso::block::{Block, Compensation, Motion, read_line};
use crate::program::iso::document::Document;
use crate::program::iso::line::words_of_move;
use crate::program::iso::machine::Machine;
use crate::program::iso::moves::{Move, nanometres};
use crate::program::iso::plain::{words, words_in};
use crate::program::iso::style::Style;
use crate::program::iso::word::{Number, Token, WordFault};
use std::borrow::Cow;
use std::ops::Range;

/// The G and M words that are always offered.
const G_WORDS: [u8; 15] = [0, 1, 2, 3, 4, 17, 20, 21, 40, 41, 42, 90, 91, 92, 70];
const M_WORDS: [u8; 6] = [0, 1, 2, 30, 98, 99];

/// The most subprograms that are offered.
const MOST_SUBPROGRAMS: usize = 100;

/// Places of the control's table that are offered where the program names none.
const FIRST_PLACES: u32 = 4;

/// What can stand at a byte, the most likely first.
pub(crate) fn completions(document: &Document, offset: usize) -> Vec<Completion> {
    let text = document.text();
    let line = text.line_of(offset);
    let range = text.line_range(line);
    let offset = offset.clamp(range.start, range.end);
    let Some(before) = text.bytes().get(range.start..offset) else {
        return Vec::new();
    };
    let Some(typed) = Typed::of(before, range.start) else {
        return Vec::new();
    };
    let Some(machine) = document.machine_before(line) else {
        return Vec::new();
    };
    let inch = typed.block.inch.unwrap_or(machine.inch);
    let style = Style::of(document, inch);
    let mut offer = Offer {
        document,
        line,
        machine,
        style,
        typed,
        found: Vec::new(),
    };
    offer.fill();
    offer.found
}

/// The words of a line before the cursor.
pub(super) struct Typed {
    /// The complete words.
    pub(crate) block: Block,
    /// The bytes of the line up to the unfinished word.
    head: Vec<u8>,
    /// The letter of the word at the cursor, and its number where it has one.
    pub(crate) letter: Option<u8>,
    pub(crate) number: Option<Number>,
    /// The range to replace: that word, or the empty range at the cursor.
    range: Range<usize>,
}

impl Typed {
    /// `None` in a comment.
    fn of(before: &[u8], start: usize) -> Option<Typed> {
        let mut last = None;
        words(before, start.max(1), |token, range| {
            last = Some((token, range))
        });
        // Counted from 1 in the first line, so that no byte order mark is looked for.
        let by = start.max(1) - start;
        let end = start + before.len();
        let last = last.filter(|(_, range)| range.end - by == end);
        let (letter, number, begun) = match last {
            Some((
                Token::Comment | Token::Fault(WordFault::OpenComment | WordFault::CommentedBlock),
                _,
            )) => return None,
            Some((Token::Word { letter, number }, range)) => {
                (Some(letter), Some(number), range.start - by)
            }
            Some((Token::Fault(WordFault::NoNumber { letter }), range)) => {
                (Some(letter), None, range.start - by)
            }
            _ => (None, None, end),
        };
        let head = before.get(..begun - start)?.to_vec();
        let block = read_line(&head, 1, |_| {});
        Some(Typed {
            block,
            head,
            letter,
            number,
            range: begun..end,
        })
    }
}

pub(super) struct Offer<'a> {
    pub(crate) document: &'a Document,
    pub(crate) line: usize,
    /// The state before the line.
    pub(crate) machine: Machine,
    pub(crate) style: Style,
    pub(crate) typed: Typed,
    found: Vec<Completion>,
}

impl Offer<'_> {
    fn fill(&mut self) {
        match self.typed.letter {
            Some(b'G') => self.words_of(b'G', &G_WORDS),
            Some(b'M') => self.words_of(b'M', &M_WORDS),
            Some(letter @ (b'D' | b'H')) => self.places(letter),
            Some(b'P') => self.subprograms(""),
            Some(b'N') => self.next_number(),
            Some(b'I' | b'J' | b'R') => self.centers(),
            Some(b'X' | b'Y') => self.ways_back(""),
            Some(_) => {}
            None => self.next_word(),
        }
    }

    pub(super) fn push(&mut self, text: impl Into<String>, about: impl Into<Cow<'static, str>>) {
        let text = text.into();
        if !self.found.iter().any(|known| known.text == text) {
            let range = &self.typed.range;
            let word = Completion::new(text, about, range, CompletionKind::Word);
            self.found.push(word);
        }
    }

    /// Words with a letter: those that every control takes, and those that the profile writes.
    fn words_of(&mut self, letter: u8, numbers: &[u8]) {
        for &number in numbers {
            let number = Number {
                mantissa: number.into(),
                decimals: 0,
                point: false,
            };
            if let Some(about) = known(letter, number) {
                self.push(format!("{}{:02}", letter as char, number.mantissa), about);
            }
        }
        for line in self.document.control.limits.lines() {
            let line = line.replace(['{', '}'], " ");
            words_in(line.as_bytes(), |token, range| {
                if let Token::Word { letter: its, .. } = token
                    && its == letter
                    && let Some(word) = line.get(range)
                {
                    self.push(word, say!(written_by_the_profile));
                }
            });
        }
    }

    /// Places of the control's table: those that the program fills or uses, else the first ones.
    fn places(&mut self, letter: u8) {
        let mut places = self.document.table_places(letter);
        if places.is_empty() {
            places.extend((0..FIRST_PLACES).map(|index| (index, None)));
        }
        for (index, value) in places {
            let about: Cow<str> = match value {
                Some(value) => say!(correction_as_this_program_sets_it, value as f64 / 1e6).into(),
                None => say!(place_in_the_table_of_corrections).into(),
            };
            self.push(format!("{}{index}", letter as char), about);
        }
    }

    fn subprograms(&mut self, before: &str) {
        let text = self.document.text();
        let subprograms = self.document.subprograms();
        for (number, line) in subprograms.into_iter().take(MOST_SUBPROGRAMS) {
            let bytes = text.bytes().get(text.line_range(line)).unwrap_or_default();
            let shown: String = String::from_utf8_lossy(bytes).chars().take(40).collect();
            let about = say!(line_by_number, line + 1, shown.trim());
            self.push(format!("{before}P{number}"), about);
        }
    }

    fn next_number(&mut self) {
        if let Some((last, step)) = self.document.numbers_before(self.line) {
            let next = format!("N{}", last.saturating_add(step));
            self.push(next, say!(the_next_block_number));
        }
    }

    fn next_word(&mut self) {
        let block = self.typed.block;
        let is_call = holds(&self.typed.head, b'M', 98);
        let is_begin = block.motion.is_none()
            && !block.has_coordinates()
            && block.compensation.is_none()
            && block.call.is_none()
            && !block.sets_position
            && !block.takes_coordinates
            && block.stop.is_none();
        if is_begin && !is_call {
            return self.beginnings();
        }
        if !self.typed.head.last().is_some_and(u8::is_ascii_whitespace) {
            return;
        }
        if is_call {
            return self.subprograms("");
        }
        if block.offset.is_none()
            && let Some(Compensation::Left | Compensation::Right) = block.compensation
        {
            self.places(self.document.table_letter());
        }
        if block.sets_position && !block.has_coordinates() {
            let zero = self.style.number(0);
            self.push(
                format!("X{zero} Y{zero}"),
                say!(the_wire_stands_at_the_zero),
            );
        }
        match self.motion() {
            Motion::Clockwise | Motion::CounterClockwise if block.r.is_none() => self.centers(),
            Motion::Line | Motion::Rapid if !block.has_coordinates() && block.motion.is_some() => {
                self.ways_back("")
            }
            _ => {}
        }
    }

    pub(super) fn motion(&self) -> Motion {
        self.typed.block.motion.unwrap_or(self.machine.motion)
    }

    /// The ways to begin a line.
    fn beginnings(&mut self) {
        self.ways_back("G01 ");
        if self.typed.block.number.is_none() {
            self.next_number();
        }
        for (label, about, text) in [
            ("G01 X Y", say!(cuts_a_line), "G01 X${1:0} Y${2:0}$0"),
            (
                "G02 X Y I J",
                say!(cuts_an_arc_clockwise),
                "G02 X${1:0} Y${2:0} $0",
            ),
            (
                "G03 X Y I J",
                say!(cuts_an_arc_counter_clockwise),
                "G03 X${1:0} Y${2:0} $0",
            ),
            (
                "G00 X Y",
                say!(moves_without_cutting),
                "G00 X${1:0} Y${2:0}$0",
            ),
        ] {
            let snippet = Completion::snippet(label, about, text, &self.typed.range);
            self.found.push(snippet);
        }
        let letter = self.document.table_letter();
        let places = self.document.table_places(letter);
        let place = places.first().map_or(1, |(index, _)| *index);
        let offset = format!("{}{place}", letter as char);
        if self.machine.side.is_some() {
            self.push("G40", say!(ends_the_correction));
        } else {
            self.push(format!("G41 {offset}"), say!(the_wire_runs_on_the_left));
            self.push(format!("G42 {offset}"), say!(the_wire_runs_on_the_right));
        }
        if self.machine.incremental {
            self.push("G90", say!(coordinates_are_absolute));
        } else {
            self.push("G91", say!(coordinates_count_from_the_wire));
        }
        let zero = self.style.number(0);
        if !self.machine.stated {
            self.push(
                format!("G92 X{zero} Y{zero}"),
                say!(says_where_the_wire_stands),
            );
        }
        self.subprograms("M98 ");
        self.push("M00", say!(stop_to_thread_the_wire));
        self.push(
            self.document.control.limits.end.clone(),
            say!(end_of_the_program),
        );
        let profile = self.document.control.limits.profile();
        let register = profile.map_or("", |profile| &profile.register);
        for line in self.document.control.limits.lines() {
            let line = line.replace("{x}", &zero).replace("{y}", &zero);
            let line = line.replace("{register}", register);
            let sides: &[&str] = match line.contains("{side}") {
                true => &["G41", "G42"],
                false => &[""],
            };
            for side in sides {
                self.push(line.replace("{side}", side), say!(a_line_of_the_profile));
            }
        }
    }

    /// The straight ways back, after the word that cuts where it is missing.
    fn ways_back(&mut self, motion: &str) {
        let mut machine = self.machine;
        machine.incremental = self.typed.block.incremental.unwrap_or(machine.incremental);
        for (target, about) in ways_back(&self.document.begun_cut(self.line)) {
            let target = nanometres(target.coords);
            if target == machine.at || machine.lost != [false, false] {
                continue;
            }
            let words = words_of_move(&machine, &self.style, Motion::Line, target, None);
            let text = format!("{motion}{}", words[1..].join(" "));
            // Checked by running it: the line leads there.
            let is_there = |made: Move| {
                (0..2).all(|axis| (made.to[axis] - target[axis]).abs() <= self.style.step())
            };
            if self.run(&text).is_some_and(is_there) {
                self.push(text, about);
            }
        }
    }

    /// What the control makes of the line with `tail` appended.
    pub(super) fn run(&self, tail: &str) -> Option<Move> {
        let mut line = self.typed.head.clone();
        line.push(b' ');
        line.extend_from_slice(tail.as_bytes());
        let mut machine = self.machine;
        machine.run(&read_line(&line, 1, |_| {}), self.document.reading())
    }
}
