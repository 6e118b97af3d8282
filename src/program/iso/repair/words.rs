//! The possible intended words of a line: typing and transmission errors, each undone.

use super::found::Meant;
use super::scan::{Line, Scanned};
use crate::program::iso::block::Motion;
use crate::program::iso::document::Document;
use crate::program::iso::line::with_word;
use crate::program::iso::machine::Machine;
use crate::program::iso::moves::{Bend, Move, Place, to_center};
use crate::program::iso::plain::words_in;
use crate::program::iso::style::Style;
use crate::program::iso::word::{Number, Token, WordFault};
use crate::program::repair::keys::{self, Key};
use rustc_hash::FxHashMap;
use std::ops::Range;

/// How unlikely a slip is compared with none, by its kind.
pub(super) mod prior {
    pub(crate) const SIGN: f64 = 0.3;
    pub(crate) const SWAP: f64 = 0.3;
    pub(crate) const MOTION: f64 = 0.3;
    pub(crate) const POINT: f64 = 0.3;
    pub(crate) const ZERO: f64 = 0.5;
    pub(crate) const DIGIT: f64 = 0.6;
    pub(crate) const DOUBLED: f64 = 0.3;
    pub(crate) const MORE: f64 = 0.8;
    pub(crate) const LOST: f64 = 0.8;
    pub(crate) const TWICE: f64 = 0.2;
    pub(crate) const BLOCKS: f64 = 0.5;
    pub(crate) const LETTER: f64 = 0.2;
    pub(crate) const WORD: f64 = 1.2;
    pub(crate) const VALUE: f64 = 1.0;
    pub(crate) const BLOCK: f64 = 3.0;
    pub(crate) const LOST_BLOCK: f64 = 2.0;
    pub(crate) const TANGENT: f64 = 1.0;
    /// A length that also occurs elsewhere in the cut, and one that does not.
    pub(crate) const KNOWN: f64 = 1.0;
    pub(crate) const ALONE: f64 = 0.5;
}

/// The lengths of a cut, and how often each occurs.
pub(crate) struct Pool {
    /// Along X and Y, from an arc to its centre: nm, without sign.
    counts: [FxHashMap<i64, u32>; 2],
    /// Absolute coordinates along each axis, as they are written.
    coordinates: [Vec<Number>; 2],
    pub(crate) is_parted: bool,
    pub(crate) styles: [Style; 2],
}

/// Coordinates that are tried for a lost one.
const MOST_COORDINATES: usize = 40;

impl Pool {
    pub(crate) fn of(document: &Document, lines: &[Line]) -> Pool {
        let mut pool = Pool {
            counts: Default::default(),
            coordinates: Default::default(),
            is_parted: document.is_parted(),
            styles: [false, true].map(|inch| Style::of(document, inch)),
        };
        let length = |number: Number| document.reading().length(number, false).abs();
        for Line { block, .. } in lines {
            for (group, numbers) in [(0, [block.x, block.y]), (1, [block.i, block.j])] {
                for number in numbers.into_iter().flatten() {
                    *pool.counts[group].entry(length(number)).or_default() += 1;
                }
            }
            for (axis, number) in [block.x, block.y].into_iter().enumerate() {
                if let Some(number) = number
                    && pool.coordinates[axis].len() < MOST_COORDINATES
                    && !pool.coordinates[axis].contains(&number)
                {
                    pool.coordinates[axis].push(number);
                }
            }
        }
        pool
    }

    /// The evidence for a number in place of another: 0 or below.
    fn prior(&self, letter: u8, found: Option<i64>, meant: i64) -> f64 {
        let counts = &self.counts[usize::from(matches!(letter, b'I' | b'J'))];
        let count = |length: i64| counts.get(&length.abs()).copied().unwrap_or(0);
        let others = count(meant)
            - u32::from(found.is_some_and(|found| found.abs() == meant.abs()) && count(meant) > 0);
        let is_alone = found.is_some_and(|found| count(found) <= 1);
        let speaks = |speaks: bool, prior: f64| if speaks { -prior } else { 0.0 };
        speaks(others > 0 && meant != 0, prior::KNOWN) + speaks(is_alone, prior::ALONE)
    }
}

/// A line with changed words.
pub(crate) struct Words<'a> {
    pub(crate) document: &'a Document,
    pub(crate) pool: &'a Pool,
    pub(crate) bytes: &'a [u8],
    pub(crate) index: usize,
    pub(crate) before: &'a Machine,
    pub(crate) meant: Vec<(Meant, f64)>,
}

/// A changed letter usually stands for another axis.
fn other_axis(letter: u8) -> u8 {
    match letter {
        b'X' => b'Y',
        b'Y' => b'X',
        b'I' => b'J',
        _ => b'I',
    }
}

impl Words<'_> {
    /// All intended lines that one slip could explain, with their evidence.
    pub(crate) fn all(mut self, way: &Scanned<'_>) -> Vec<(Meant, f64)> {
        self.of_tokens();
        let line = &way.lines[self.index];
        let mut machine = *self.before;
        let made = machine.run(&line.block, way.reading);
        if let Some(made) = &made {
            self.of_center(made);
        }
        if made.is_some() || line.faults > 0 {
            self.of_values(&machine, way);
        }
        self.meant
    }

    fn put(&mut self, line: Vec<u8>, prior: f64, found: &str, meant: &str) {
        self.put_with(line, prior, 0.0, found, meant);
    }

    /// `evidence` is a part of the whole `prior`.
    fn put_with(&mut self, line: Vec<u8>, prior: f64, evidence: f64, found: &str, meant: &str) {
        let meant = Meant {
            evidence,
            ..Meant::new(line, found, meant)
        };
        self.meant.push((meant, prior));
    }

    fn push(&mut self, range: Range<usize>, text: &str, prior: f64, found: &str, meant: &str) {
        let mut line = self.bytes.to_vec();
        line.splice(range, text.bytes());
        self.put(line, prior, found, meant);
    }

    /// Another text in a place.
    fn rewrite(&mut self, range: Range<usize>, meant: &str, prior: f64) {
        let found = self.text(&range);
        self.push(range, meant, prior, &found, meant);
    }

    fn text(&self, range: &Range<usize>) -> String {
        String::from_utf8_lossy(self.bytes.get(range.clone()).unwrap_or_default()).into_owned()
    }

    /// Slips within the words.
    fn of_tokens(&mut self) {
        let mut tokens = Vec::new();
        words_in(self.bytes, |token, range| tokens.push((token, range)));
        // Where each letter stands, the last one first.
        let mut places: FxHashMap<u8, Vec<Range<usize>>> = FxHashMap::default();
        let (mut motion, mut twice) = (None, None);
        for (token, range) in tokens {
            match token {
                Token::Word {
                    letter: letter @ (b'X' | b'Y' | b'I' | b'J' | b'R'),
                    number,
                } => {
                    self.of_number(letter, number, range.clone());
                    let known = places.entry(letter).or_default();
                    if !known.is_empty() {
                        twice = Some(letter);
                    }
                    known.insert(0, range);
                }
                Token::Word {
                    letter: b'G',
                    number,
                } if number.decimals == 0 && (0..=3).contains(&number.mantissa) => {
                    motion = Some((number.mantissa, range));
                }
                Token::Fault(fault) => self.of_fault(fault, range),
                _ => {}
            }
        }
        let place = |letter: u8| places.get(&letter).map(|places| places[0].clone());
        for (one, other) in [(b'X', b'Y'), (b'I', b'J')] {
            if let (Some(a), Some(b)) = (place(one), place(other)) {
                self.swap(a, b);
            }
        }
        // A letter of another axis.
        for letter in *b"XYIJ" {
            if let (Some(range), None) = (place(letter), place(other_axis(letter))) {
                self.as_letter(range, other_axis(letter), prior::WORD);
            }
        }
        if let Some(letter) = twice {
            for range in &places[&letter] {
                if letter != b'R' && place(other_axis(letter)).is_none() {
                    self.as_letter(range.clone(), other_axis(letter), prior::LETTER);
                }
                self.rewrite(range.clone(), "", prior::LOST);
            }
        }
        self.of_motion(motion, &place);
    }

    /// The numbers of two words change places, the letters stay.
    fn swap(&mut self, one: Range<usize>, other: Range<usize>) {
        let (a, b) = match one.start < other.start {
            true => (one, other),
            false => (other, one),
        };
        let (first, second, between) = (self.text(&a), self.text(&b), self.text(&(a.end..b.start)));
        let (Some((letter, number)), Some((other_letter, other_number))) =
            (first.split_at_checked(1), second.split_at_checked(1))
        else {
            return;
        };
        let [one, other] = [
            format!("{letter}{other_number}"),
            format!("{other_letter}{number}"),
        ];
        let text = format!("{one}{between}{other}");
        let [found, meant] = [format!("{first} {second}"), format!("{one} {other}")];
        self.push(a.start..b.end, &text, prior::SWAP, &found, &meant);
    }

    fn as_letter(&mut self, range: Range<usize>, letter: u8, prior: f64) {
        if let Some(number) = self.text(&range).get(1..) {
            let meant = format!("{}{number}", letter as char);
            self.rewrite(range, &meant, prior);
        }
    }

    fn of_motion(
        &mut self,
        motion: Option<(i64, Range<usize>)>,
        place: &dyn Fn(u8) -> Option<Range<usize>>,
    ) {
        let has_center = b"IJR".iter().any(|letter| place(*letter).is_some());
        for other in (1..=3).filter(|other| has_center != (*other == 1)) {
            let meant = format!("G{other:02}");
            match &motion {
                Some((own, range)) if *own != other => {
                    self.rewrite(range.clone(), &meant, prior::MOTION);
                }
                Some(_) => {}
                None => {
                    let with = with_word(self.bytes, &meant, self.pool.is_parted);
                    self.put(with, prior::MOTION, "", &meant);
                    // Its line may be lost as well, and under G90 nothing tells.
                    self.call_calculated(!self.before.incremental);
                }
            }
        }
        // I and J where a straight cut is meant.
        let is_line = self.before.motion == Motion::Line && motion.is_none_or(|(own, _)| own == 1);
        let ranges = [place(b'I'), place(b'J')].into_iter().flatten();
        let both = ranges.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end));
        if let Some(both) = both.filter(|_| is_line) {
            self.rewrite(both, "", prior::WORD);
            // These are two words.
            self.call_calculated(true);
        }
    }

    /// Whether the last of the intended lines is no slip.
    fn call_calculated(&mut self, is_calculated: bool) {
        if let Some((made, _)) = self.meant.last_mut() {
            made.is_calculated = is_calculated;
        }
    }

    /// Slips in one number; `range` is that of the word.
    fn of_number(&mut self, letter: u8, number: Number, range: Range<usize>) {
        let word = self.text(&range);
        let is_number = |byte: u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+');
        let Some(at) = word.bytes().position(is_number) else {
            return;
        };
        let (letters, text) = word.split_at(at);
        let found = self.length(number);
        let zeros = text_zeros(text);
        for (text, key) in keys::meant(text, self.document.pointed()) {
            let prior = match key {
                Key::Digit => prior::DIGIT,
                // Zeros are lost first.
                Key::Lost if text_zeros(&text) > zeros => prior::ZERO,
                Key::Lost | Key::More => prior::MORE,
                Key::Doubled => prior::DOUBLED,
                Key::Swapped => prior::SWAP,
                Key::Sign => prior::SIGN,
                Key::Point => prior::POINT,
            };
            let more = number_of(&text).map_or(0.0, |number| {
                self.pool.prior(letter, Some(found), self.length(number))
            });
            let meant = format!("{letters}{text}");
            let mut line = self.bytes.to_vec();
            line.splice(range.clone(), meant.bytes());
            self.put_with(line, prior + more, more, &word, &meant);
        }
    }

    fn length(&self, number: Number) -> i64 {
        self.document.reading().length(number, false)
    }

    /// Slips in unreadable text.
    fn of_fault(&mut self, fault: WordFault, range: Range<usize>) {
        let text = self.text(&range);
        match fault {
            WordFault::NotANumber { .. } => {
                for (at, _) in text.match_indices(['.', ',']) {
                    let mut meant = text.clone();
                    meant.remove(at);
                    self.rewrite(range.clone(), &meant, prior::POINT);
                }
            }
            WordFault::NoNumber { .. } => {
                self.rewrite(range.clone(), "", prior::WORD);
                let is_pointed = self.document.pointed() == Some(true);
                let point = if is_pointed { "." } else { "" };
                for digit in 0..=9 {
                    self.rewrite(range.clone(), &format!("{text}{digit}{point}"), prior::MORE);
                }
            }
            // A number without its letter.
            WordFault::NoWord if number_of(&text).is_some() => {
                let letters = ["X", "Y", "I", "J", "G"];
                // No G word has so many digits.
                let many = letters.len() - usize::from(text.contains('.') || text.len() > 3);
                for letter in letters.into_iter().take(many) {
                    self.rewrite(range.clone(), &format!("{letter}{text}"), prior::LETTER);
                }
            }
            WordFault::LetterO => {
                self.rewrite(range, &text.replace(['O', 'o'], "0"), prior::LETTER)
            }
            WordFault::DecimalComma => self.rewrite(range, ".", prior::LETTER),
            _ => {}
        }
    }

    /// I or J of an arc, computed from the other one and the ends.
    fn of_center(&mut self, made: &Move) {
        let Bend::Center { .. } = made.bend else {
            return;
        };
        let reading = self.document.reading();
        let rule = reading.rule(made.incremental);
        let Some(center) = made.center(rule) else {
            return;
        };
        for (axis, letter) in [(0, b'I'), (1, b'J')] {
            if let Some(place) = solved(made, center, axis) {
                let words = to_center(rule, [place; 2], made.from, self.before.zero);
                self.set(letter, words[axis]);
            }
        }
    }

    /// A word with a length, in place of the present one or after the last one.
    fn set(&mut self, letter: u8, length: i64) {
        let style = self.pool.styles[usize::from(self.before.inch)];
        if length.abs() > 10_000_000_000 {
            return;
        }
        let meant = format!("{}{}", letter as char, style.number(length));
        let mut places = Vec::new();
        words_in(self.bytes, |token, range| {
            if let Token::Word { letter, number } = token
                && matches!(letter, b'X' | b'Y' | b'I' | b'J' | b'G' | b'N')
            {
                places.push((letter, number, range));
            }
        });
        let own = places.iter().find(|(its, ..)| *its == letter).cloned();
        if let Some((_, number, range)) = own {
            let found = self.length(number);
            if found != length {
                let prior = prior::VALUE + self.pool.prior(letter, Some(found), length);
                let own = self.text(&range);
                self.rewrite(range, &meant, prior);
                self.call_calculated(!keys::is_slip(own.as_bytes(), meant.as_bytes()));
            }
            return;
        }
        let order = |letter: u8| b"NGXYIJ".iter().position(|its| *its == letter);
        let is_before = |(its, ..): &&(u8, Number, Range<usize>)| order(*its) < order(letter);
        let behind = places.iter().filter(is_before).map(|(.., range)| range.end);
        let at = behind.max().unwrap_or(0);
        let space = if self.pool.is_parted && at > 0 {
            " "
        } else {
            ""
        };
        let prior = prior::LOST + self.pool.prior(letter, None, length);
        self.push(at..at, &format!("{space}{meant}"), prior, "", &meant);
    }

    /// Coordinates that close the cut, or that others have.
    fn of_values(&mut self, behind: &Machine, way: &Scanned<'_>) {
        if behind.incremental {
            let gaps = way.gaps(self.index);
            for axis in 0..2 {
                let letter = [b'X', b'Y'][axis];
                let own = [way.lines[self.index].block.x, way.lines[self.index].block.y][axis]
                    .map_or(0, |number| self.length(number));
                for gap in gaps.iter().filter(|gap| gap[axis] != 0) {
                    self.set(letter, own.wrapping_add(gap[axis]));
                }
            }
            return;
        }
        let block = &way.lines[self.index].block;
        for (axis, own) in [block.x, block.y].into_iter().enumerate() {
            if own.is_some() {
                continue;
            }
            for number in self.pool.coordinates[axis].clone() {
                self.set(
                    [b'X', b'Y'][axis],
                    self.document.reading().length(number, self.before.inch),
                );
            }
        }
    }
}

/// The coordinate of an arc's centre along an axis, given the other one in `center`; `None` where the ends do not
/// determine it.
fn solved(made: &Move, center: Place, axis: usize) -> Option<i64> {
    let other = 1 - axis;
    let at = |place: Place, axis: usize| place[axis].wrapping_sub(made.from[axis]) as f64;
    let end = [at(made.to, 0), at(made.to, 1)];
    let along = end[axis];
    if along.abs() < 1_000.0 {
        return None;
    }
    let square = end[0] * end[0] + end[1] * end[1];
    let place = (square / 2.0 - at(center, other) * end[other]) / along;
    (place.abs() < 1e13).then(|| made.from[axis].wrapping_add(place.round() as i64))
}

fn text_zeros(text: &str) -> usize {
    text.bytes().filter(|byte| *byte == b'0').count()
}

fn number_of(text: &str) -> Option<Number> {
    let mut found = None;
    words_in(format!("X{text}").as_bytes(), |token, range| {
        found = match (token, found) {
            (
                Token::Word {
                    letter: b'X',
                    number,
                },
                None,
            ) if range.len() == text.len() + 1 => Some(Some(number)),
            _ => Some(None),
        };
    });
    found.flatten()
}
