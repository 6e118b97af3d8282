//! The readings of a line that are one slip away: typing and transmission errors, each undone.

use super::way::Line;
use crate::program::iso::block::Motion;
use crate::program::iso::document::Document;
use crate::program::iso::line::with_word;
use crate::program::iso::machine::Machine;
use crate::program::iso::moves::{Move, Place, to_center};
use crate::program::iso::plain::words_in;
use crate::program::iso::style::Style;
use crate::program::iso::word::{Number, Token, WordFault};
use crate::program::repair::keys;
use crate::program::repair::slip::Sort;
use std::ops::Range;

/// What is calculated changes so many characters at least.
const CALCULATED: i32 = 10;

/// Another text in a place of a line.
pub(super) struct Reading {
    pub(super) range: Range<usize>,
    pub(super) text: String,
    pub(super) sort: Sort,
    pub(super) keys: i32,
    /// The only number that it changes, with its letter.
    pub(super) number: Option<(u8, Number)>,
}

/// A line whose words may be wrong.
pub(super) struct Words<'a> {
    pub(super) document: &'a Document,
    pub(super) style: Style,
    pub(super) bytes: &'a [u8],
    pub(super) line: &'a Line,
    pub(super) before: &'a Machine,
}

/// A letter usually stands for that of the other axis.
fn other_axis(letter: u8) -> u8 {
    match letter {
        b'X' => b'Y',
        b'Y' => b'X',
        b'I' => b'J',
        _ => b'I',
    }
}

type Take<'t> = &'t mut dyn FnMut(Reading);

impl Words<'_> {
    /// Hands out all readings; `gaps` lead to where the line should end, nm.
    pub(super) fn readings(&self, gaps: &[Place], take: Take<'_>) {
        // Where each letter stands, the last one first.
        let mut places: Vec<(u8, Range<usize>)> = Vec::new();
        let mut motion = None;
        words_in(self.bytes, |token, range| match token {
            Token::Word { letter, number } => match letter {
                b'X' | b'Y' | b'I' | b'J' | b'R' => {
                    self.of_number(letter, range.clone(), take);
                    places.insert(0, (letter, range));
                }
                b'G' if Motion::of(number).is_some() => motion = Some((number.mantissa, range)),
                _ => {}
            },
            Token::Fault(fault) => self.of_fault(fault, range, take),
            _ => {}
        });
        let all = |letter: u8| places.iter().filter(move |(its, _)| *its == letter);
        let place = |letter: u8| all(letter).next().map(|(_, range)| range.clone());
        for letter in *b"XYIJ" {
            match (place(letter), place(other_axis(letter))) {
                (Some(one), Some(other)) if one.start < other.start => self.swap(one, other, take),
                (Some(_), None) => {
                    for (_, range) in all(letter) {
                        self.as_letter(range.clone(), other_axis(letter), take);
                    }
                }
                _ => {}
            }
        }
        for (letter, range) in &places {
            if all(*letter).nth(1).is_some() {
                self.rewrite(range.clone(), "", Sort::Key, 2, take);
            }
        }
        let centers = [b'I', b'J'].map(place);
        let has_center = centers.iter().any(Option::is_some) || place(b'R').is_some();
        self.of_motion(motion, has_center, take);
        let both = centers.into_iter().flatten();
        if let Some(both) = both.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end)) {
            // A straight cut is meant.
            self.rewrite(both, "", Sort::Calculated, CALCULATED, take);
        }
        self.of_values(gaps, take);
    }

    fn text(&self, range: &Range<usize>) -> String {
        String::from_utf8_lossy(self.bytes.get(range.clone()).unwrap_or_default()).into_owned()
    }

    fn rewrite(&self, range: Range<usize>, text: &str, sort: Sort, keys: i32, take: Take<'_>) {
        take(Reading {
            range,
            text: text.to_owned(),
            sort,
            keys,
            number: None,
        });
    }

    /// The numbers of two words change places, the letters stay.
    fn swap(&self, one: Range<usize>, other: Range<usize>, take: Take<'_>) {
        let (first, second) = (self.text(&one), self.text(&other));
        let between = self.text(&(one.end..other.start));
        if let (Some((letter, number)), Some((other_letter, other_number))) =
            (first.split_at_checked(1), second.split_at_checked(1))
        {
            let text = format!("{letter}{other_number}{between}{other_letter}{number}");
            self.rewrite(one.start..other.end, &text, Sort::Key, 1, take);
        }
    }

    fn as_letter(&self, range: Range<usize>, letter: u8, take: Take<'_>) {
        if let Some(number) = self.text(&range).get(1..) {
            let text = format!("{}{number}", letter as char);
            self.rewrite(range, &text, Sort::Kind, 2, take);
        }
    }

    fn of_motion(&self, motion: Option<(i64, Range<usize>)>, has_center: bool, take: Take<'_>) {
        for other in (1..=3).filter(|other| has_center != (*other == 1)) {
            let text = format!("G{other:02}");
            match &motion {
                Some((own, _)) if *own == other => {}
                Some((own, range)) => {
                    let (sort, keys) = match (*own > 1, other > 1) {
                        (true, true) => (Sort::Key, 1),
                        (_, true) => (Sort::Kind, 3),
                        // Its radius may be lost as well.
                        (_, false) => (Sort::Calculated, 3),
                    };
                    self.rewrite(range.clone(), &text, sort, keys, take);
                }
                None => {
                    let parted = self.document.is_parted();
                    let with = with_word(self.bytes, &text, parted);
                    // Its line may be lost as well, and under G90 nothing tells; or the radius.
                    let sort = match self.before.incremental && other > 1 {
                        true => Sort::Kind,
                        false => Sort::Calculated,
                    };
                    let whole = 0..self.bytes.len();
                    self.rewrite(whole, &String::from_utf8_lossy(&with), sort, 3, take);
                }
            }
        }
    }

    /// Slips in one number; `range` is that of the word.
    fn of_number(&self, letter: u8, range: Range<usize>, take: Take<'_>) {
        let word = self.text(&range);
        let is_number = |byte: u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+');
        let Some(at) = word.bytes().position(is_number) else {
            return;
        };
        let (letters, own) = word.split_at(at);
        for text in keys::meant(own, self.document.pointed()) {
            take(Reading {
                range: range.clone(),
                number: number_of(&text).map(|number| (letter, number)),
                text: format!("{letters}{text}"),
                sort: Sort::Key,
                keys: 1,
            });
        }
    }

    /// Slips in unreadable text.
    fn of_fault(&self, fault: WordFault, range: Range<usize>, take: Take<'_>) {
        let text = self.text(&range);
        match fault {
            WordFault::NotANumber { .. } => {
                for (at, _) in text.match_indices(['.', ',']) {
                    let mut meant = text.clone();
                    meant.remove(at);
                    self.rewrite(range.clone(), &meant, Sort::Key, 1, take);
                }
            }
            WordFault::NoNumber { .. } => {
                self.rewrite(range.clone(), "", Sort::Key, 1, take);
                let is_pointed = self.document.pointed() == Some(true);
                let point = if is_pointed { "." } else { "" };
                for digit in 0..=9 {
                    let meant = format!("{text}{digit}{point}");
                    self.rewrite(range.clone(), &meant, Sort::Key, 1, take);
                }
            }
            // A number without its letter.
            WordFault::NoWord if number_of(&text).is_some() => {
                // No G word has so many digits.
                let is_long = text.contains('.') || text.len() > 3;
                let letters = ["X", "Y", "I", "J", "G"];
                for letter in letters.into_iter().take(5 - usize::from(is_long)) {
                    self.rewrite(
                        range.clone(),
                        &format!("{letter}{text}"),
                        Sort::Key,
                        1,
                        take,
                    );
                }
            }
            WordFault::LetterO => {
                let meant = text.replace(['O', 'o'], "0");
                self.rewrite(range, &meant, Sort::Key, 1, take);
            }
            WordFault::DecimalComma => self.rewrite(range, ".", Sort::Key, 1, take),
            _ => {}
        }
    }

    /// Numbers that everything else determines.
    fn of_values(&self, gaps: &[Place], take: Take<'_>) {
        let mut machine = *self.before;
        let reading = self.document.reading();
        let block = &self.line.block;
        if let Some(made) = machine.run(block, reading) {
            self.of_center(&made, take);
        }
        if !machine.incremental {
            return;
        }
        for (axis, own) in [block.x, block.y].into_iter().enumerate() {
            let own = own.map_or(0, |number| reading.length(number, machine.inch));
            for gap in gaps.iter().filter(|gap| gap[axis] != 0) {
                self.set([b'X', b'Y'][axis], own.wrapping_add(gap[axis]), take);
            }
        }
    }

    /// I or J of an arc, from the other one and the ends.
    fn of_center(&self, made: &Move, take: Take<'_>) {
        let rule = self.document.reading().rule(made.incremental);
        let Some(center) = made.center(rule) else {
            return;
        };
        for (axis, letter) in [(0, b'I'), (1, b'J')] {
            if let Some(place) = made.center_along(axis, center) {
                let words = to_center(rule, [place; 2], made.from, self.before.zero);
                self.set(letter, words[axis], take);
            }
        }
    }

    /// A word with a length, in place of the present one or after the last one.
    fn set(&self, letter: u8, length: i64, take: Take<'_>) {
        if length.abs() > 10_000_000_000 {
            return;
        }
        let meant = format!("{}{}", letter as char, self.style.number(length));
        let order = |letter: u8| b"NGXYIJ".iter().position(|its| *its == letter);
        let (mut own, mut at) = (None, 0);
        words_in(self.bytes, |token, range| {
            if let Token::Word { letter: its, .. } = token {
                if its == letter {
                    own = Some(range.clone());
                }
                if order(its).is_some() && order(its) < order(letter) {
                    at = at.max(range.end);
                }
            }
        });
        if let Some(range) = own {
            let is_slip = keys::is_slip(self.text(&range).as_bytes(), meant.as_bytes());
            let keys = if is_slip { 2 } else { CALCULATED };
            return self.rewrite(range, &meant, Sort::Calculated, keys, take);
        }
        let is_apart = self.document.is_parted() && at > 0;
        let space = if is_apart { " " } else { "" };
        let text = format!("{space}{meant}");
        self.rewrite(at..at, &text, Sort::Calculated, CALCULATED - 1, take);
    }
}

/// A plain number.
fn number_of(text: &str) -> Option<Number> {
    let digits = text.trim_start_matches(['-', '+']);
    let (whole, behind) = digits.split_once('.').unwrap_or((digits, ""));
    let is_plain = |byte: u8| byte.is_ascii_digit();
    let all = format!("{whole}{behind}");
    let is_number = !all.is_empty() && all.len() < 16 && all.bytes().all(is_plain);
    let mantissa = all.parse::<i64>().ok().filter(|_| is_number)?;
    Some(Number {
        mantissa: if text.starts_with('-') {
            -mantissa
        } else {
            mantissa
        },
        decimals: behind.len() as u8,
        point: digits.contains('.'),
    })
}
