//! The slips of a hand or of a bad line, each turned back: what a line may have been meant to say.

use super::Repair;
use super::scan::{Line, Way};
use crate::finding::FixKind;
use crate::geometry::{Vector, left_normal};
use crate::program::iso::block::Motion;
use crate::program::iso::document::Document;
use crate::program::iso::layout::is_parted;
use crate::program::iso::line::with_word;
use crate::program::iso::machine::{
    Bend, CenterRule, Machine, Move, Place, Reading, distance, micrometres,
};
use crate::program::iso::shape::directions;
use crate::program::iso::style::Style;
use crate::program::iso::word::{Number, Token, WordFault, plain, words};
use crate::program::repair::gap::{half_turn_between, is_one_line};
use crate::text::TextEdit;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// How much a slip is less likely than none, by its kind.
mod prior {
    pub const SIGN: f64 = 0.3;
    pub const SWAP: f64 = 0.3;
    pub const MOTION: f64 = 0.3;
    pub const POINT: f64 = 0.3;
    pub const DIGIT: f64 = 0.6;
    pub const DOUBLED: f64 = 0.3;
    pub const MORE: f64 = 0.8;
    pub const LOST: f64 = 0.8;
    pub const TWICE: f64 = 0.2;
    pub const BLOCKS: f64 = 0.5;
    pub const LETTER: f64 = 0.2;
    pub const WORD: f64 = 1.2;
    pub const VALUE: f64 = 1.0;
    pub const BLOCK: f64 = 3.0;
    pub const LOST_BLOCK: f64 = 2.0;
    pub const TANGENT: f64 = 1.0;
    /// A length that stands elsewhere in the cut, and one that stands nowhere else.
    pub const KNOWN: f64 = 1.0;
    pub const ALONE: f64 = 0.5;
}

/// Lines of a cut with others in their place.
pub struct Change {
    pub index: usize,
    pub replaced: usize,
    pub lines: Vec<Vec<u8>>,
    pub prior: f64,
    /// It takes nothing away that stands but once.
    pub is_a_slip: bool,
    kind: FixKind,
    found: String,
    meant: String,
}

/// The lengths of a cut, and how often each stands in it.
pub struct Pool {
    /// Along X and Y, from an arc to its centre: nm, without sign.
    counts: [FxHashMap<i64, u32>; 2],
    /// What absolute coordinates along each axis are, as they are written.
    coordinates: [Vec<Number>; 2],
    is_parted: bool,
    styles: [Style; 2],
}

/// Coordinates that are tried for one that is lost.
const MOST_COORDINATES: usize = 40;

impl Pool {
    pub fn of(document: &Document, lines: &[Line]) -> Pool {
        let mut pool = Pool {
            counts: Default::default(),
            coordinates: Default::default(),
            is_parted: is_parted(document.text()),
            styles: [false, true].map(|inch| Style::of(document, inch)),
        };
        let length = |number: Number| document.reading().length(number, false).abs();
        for Line { block, .. } in lines {
            for (group, numbers) in [[block.x, block.y], [block.i, block.j]]
                .into_iter()
                .enumerate()
            {
                numbers
                    .into_iter()
                    .flatten()
                    .for_each(|number| *pool.counts[group].entry(length(number)).or_default() += 1);
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

    /// What speaks for a number in the place of another.
    fn prior(&self, letter: u8, found: Option<i64>, meant: i64) -> f64 {
        let counts = &self.counts[usize::from(matches!(letter, b'I' | b'J'))];
        let count = |length: i64| counts.get(&length.abs()).copied().unwrap_or(0);
        let others = count(meant)
            - u32::from(found.is_some_and(|found| found.abs() == meant.abs()) && count(meant) > 0);
        let known = if others > 0 && meant != 0 {
            -prior::KNOWN
        } else {
            0.0
        };
        let alone = if found.is_some_and(|found| count(found) <= 1) {
            -prior::ALONE
        } else {
            0.0
        };
        known + alone
    }
}

/// A line whose words are changed.
struct Words<'a> {
    document: &'a Document,
    pool: &'a Pool,
    bytes: &'a [u8],
    index: usize,
    before: &'a Machine,
    changes: Vec<Change>,
}

/// What a line of a cut may have been meant to be.
pub fn of_line(
    document: &Document,
    way: &Way<'_>,
    pool: &Pool,
    lines: &Range<usize>,
    index: usize,
) -> Vec<Change> {
    let own = document.line_bytes(lines.start + index);
    let plain = plain(own);
    let bytes = plain.as_deref().unwrap_or(own);
    let block = &way.lines[index].block;
    if block.empty || block.sets_position || block.takes_coordinates {
        return Vec::new();
    }
    if block.stop.is_some() {
        return lost_blocks(document, way, pool, lines.start, index);
    }
    let before = way.machine_before(index);
    let mut own = Words {
        document,
        pool,
        bytes,
        index,
        before,
        changes: Vec::new(),
    };
    own.of_tokens();
    let mut machine = *before;
    let made = machine.run(block, way.reading);
    if let Some(made) = &made {
        own.of_center(made);
    }
    if made.is_some() || way.lines[index].faults > 0 {
        own.of_values(&machine, way);
    }
    let is_move = made.is_some() || way.lines[index].faults > 0;
    let mut changes = own.changes;
    changes.extend(lost_blocks(document, way, pool, lines.start, index));
    let next = (index + 1..lines.len()).find(|next| !way.lines[*next].block.empty);
    let shown = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim().to_owned();
    if is_move {
        let said = |line: &Line| {
            (
                line.block.x,
                line.block.y,
                line.block.i,
                line.block.j,
                line.block.r,
                line.block.motion,
            )
        };
        let is_twice = index > 0
            && said(&way.lines[index - 1]) == said(&way.lines[index])
            && !way.lines[index - 1].block.empty;
        let prior = if is_twice { prior::TWICE } else { prior::BLOCK };
        let found = shown(bytes);
        changes.push(Change {
            index,
            replaced: 1,
            lines: Vec::new(),
            is_a_slip: is_twice,
            prior,
            kind: FixKind::DeleteBlock,
            found,
            meant: String::new(),
        });
    }
    if let Some(next) = next.filter(|next| is_move && *next == index + 1) {
        let other = document.line_bytes(lines.start + next);
        let is_other = way.lines[next].block.has_coordinates()
            || way.lines[next].block.i.is_some()
            || way.lines[next].block.j.is_some();
        if other != bytes && is_other {
            let swapped = with_numbers_kept(bytes, other);
            let (found, meant) = (shown(bytes), shown(other));
            changes.push(Change {
                index,
                replaced: 2,
                is_a_slip: true,
                lines: swapped,
                prior: prior::BLOCKS,
                kind: FixKind::ExchangeBlocks,
                found,
                meant,
            });
        }
    }
    changes
}

/// Blocks that may have been lost before a line: what closes the cut, and the line that leads to an arc on its tangent.
fn lost_blocks(
    document: &Document,
    way: &Way<'_>,
    pool: &Pool,
    first: usize,
    index: usize,
) -> Vec<Change> {
    let before = way.machine_before(index);
    let mut machine = *before;
    let next = machine.run(&way.lines[index].block, way.reading);
    if before.lost != [false, false] {
        return Vec::new();
    }
    let gaps = if before.incremental {
        way.gaps(index)
    } else {
        next.map_or_else(Vec::new, |next| tangent_gaps(&next, way.reading))
    };
    let heading = way.heading_before(index);
    let ahead = next.and_then(|next| Some(directions(&next, way.reading)?.0));
    let style = pool.styles[usize::from(before.inch)];
    let parted = if pool.is_parted { " " } else { "" };
    let mut changes = Vec::new();
    for gap in gaps {
        let to = [0, 1].map(|axis| style.rounded(before.at[axis].wrapping_add(gap[axis])));
        let along = micrometres(to) - micrometres(before.at);
        if along.norm() < SHORTEST {
            continue;
        }
        let mut shapes = vec![None];
        if let (Some(heading), Some(ahead), true) = (heading, ahead, before.incremental) {
            shapes.extend(half_turn_between(heading, ahead, along).map(Some));
        }
        let is_part = heading.is_some_and(|heading| is_one_line(heading, along));
        for half in shapes {
            let base = if before.incremental {
                before.at
            } else {
                before.zero
            };
            let motion = match half {
                None => "G01",
                Some(half) if half > 0.0 => "G03",
                Some(_) => "G02",
            };
            let mut words = vec![motion.to_owned()];
            let number = |length: i64| style.number(length);
            for (axis, letter) in [(0, 'X'), (1, 'Y')] {
                words.push(format!(
                    "{letter}{}",
                    number(to[axis].wrapping_sub(base[axis]))
                ));
            }
            if let Some(half) = half {
                let sign = match way.reading.rule(before.incremental) {
                    CenterRule::StartToCenter => 1.0,
                    CenterRule::CenterToStart => -1.0,
                    CenterRule::Absolute => continue,
                };
                let center = (along + left_normal(along) / half.tan()) / 2.0;
                let nm = |um: f64| style.number((sign * um * 1e3).round() as i64);
                words.extend([format!("I{}", nm(center.x)), format!("J{}", nm(center.y))]);
            }
            let words = words.join(parted);
            let line = match free_number(document, first + index) {
                Some(number) => with_word(words.as_bytes(), &format!("N{number}"), pool.is_parted),
                None => words.clone().into_bytes(),
            };
            let prior = match half {
                _ if is_part => prior::BLOCK + prior::MORE,
                None if !before.incremental => prior::TANGENT,
                _ => prior::LOST_BLOCK,
            };
            let kind = FixKind::InsertBlock {
                length: along.norm() / 1e3,
                is_arc: half.is_some(),
            };
            changes.push(Change {
                index,
                replaced: 0,
                lines: vec![line],
                is_a_slip: false,
                prior,
                kind,
                found: String::new(),
                meant: words,
            });
        }
    }
    changes
}

/// Shorter blocks are not lost, but rounding, µm.
const SHORTEST: f64 = 10.0;

/// The number of a block before a line, where there is room for one.
fn free_number(document: &Document, line: usize) -> Option<u32> {
    let (last, step) = document.numbers_before(line)?;
    let number = last.checked_add(step)?;
    let next = document
        .block(line)
        .number
        .or_else(|| document.number_behind(line));
    next.is_none_or(|next| next > number).then_some(number)
}

/// From where an arc begins to where it would begin if the line were there that leads to it on its tangent: its end stays, and its centre
/// goes along where I and J count from the start.
fn tangent_gaps(arc: &Move, reading: &Reading) -> Vec<Place> {
    let (Bend::Center { .. }, false) = (arc.bend, arc.incremental) else {
        return Vec::new();
    };
    let rule = reading.rule(false);
    let (Some(center), Some((tangent, _))) = (arc.center(rule), directions(arc, reading)) else {
        return Vec::new();
    };
    let (along, lengths) = if rule == CenterRule::Absolute {
        let radius = distance(center, arc.to) / 1e3;
        let across = micrometres(center) - micrometres(arc.from);
        let length = (across.norm_squared() - radius * radius).max(0.0).sqrt();
        let turned = (radius / across.norm().max(radius)).asin();
        let turned = if arc.motion == Motion::CounterClockwise {
            -turned
        } else {
            turned
        };
        (rotated(across, turned), vec![length])
    } else {
        let from_end = micrometres(center) - micrometres(arc.to);
        let radius = distance(center, arc.from) / 1e3;
        let half = from_end.dot(&tangent.normalize());
        let square = half * half - from_end.norm_squared() + radius * radius;
        let root = square.sqrt();
        (tangent, vec![-half - root, -half + root])
    };
    let along = along.normalize();
    let is_likely = |length: &f64| length.is_finite() && *length > SHORTEST;
    let place = |length: f64| [along.x, along.y].map(|part| (part * length * 1e3).round() as i64);
    lengths.into_iter().filter(is_likely).map(place).collect()
}

fn rotated(vector: Vector, by: f64) -> Vector {
    let (sin, cos) = by.sin_cos();
    Vector::new(
        vector.x * cos - vector.y * sin,
        vector.x * sin + vector.y * cos,
    )
}

/// Two lines exchanged; their block numbers stay where they are.
fn with_numbers_kept(one: &[u8], other: &[u8]) -> Vec<Vec<u8>> {
    let number = |line: &[u8]| {
        crate::program::iso::block::word_range(line, 1, |letter, _| letter == b'N')
            .map(|range| range.start - 1..range.end - 1)
    };
    match (number(one), number(other)) {
        (Some(a), Some(b)) => {
            let with = |line: &[u8], place: Range<usize>, number: &[u8]| {
                let mut line = line.to_vec();
                line.splice(place, number.iter().copied());
                line
            };
            vec![
                with(other, b.clone(), &one[a.clone()]),
                with(one, a, &other[b]),
            ]
        }
        _ => vec![other.to_vec(), one.to_vec()],
    }
}

impl Words<'_> {
    fn push(&mut self, range: Range<usize>, text: &str, prior: f64, found: &str, meant: &str) {
        let mut line = self.bytes.to_vec();
        line.splice(range, text.bytes());
        let kind = FixKind::Rewrite {
            found: found.to_owned(),
            meant: meant.to_owned(),
        };
        let (found, meant) = (found.to_owned(), meant.to_owned());
        self.changes.push(Change {
            index: self.index,
            replaced: 1,
            is_a_slip: true,
            lines: vec![line],
            prior,
            kind,
            found,
            meant,
        });
    }

    fn text(&self, range: &Range<usize>) -> String {
        String::from_utf8_lossy(self.bytes.get(range.clone()).unwrap_or_default()).into_owned()
    }

    /// Slips within the words.
    fn of_tokens(&mut self) {
        let mut tokens = Vec::new();
        // Counted from 1 so that no byte order mark is looked for.
        words(self.bytes, 1, |token| tokens.push(token));
        let placed = |range: &Range<usize>| range.start - 1..range.end - 1;
        let mut places: FxHashMap<u8, Range<usize>> = FxHashMap::default();
        let (mut motion, mut twice) = (None, None);
        for token in &tokens {
            match token {
                Token::Word {
                    letter: letter @ (b'X' | b'Y' | b'I' | b'J' | b'R'),
                    number,
                    range,
                } => {
                    self.of_number(*letter, Some(*number), placed(range));
                    if places.insert(*letter, placed(range)).is_some() {
                        twice = Some((*letter, placed(range)));
                    }
                }
                Token::Word {
                    letter: b'G',
                    number,
                    range,
                } if number.decimals == 0 && (0..=3).contains(&number.mantissa) => {
                    motion = Some((number.mantissa, placed(range)));
                }
                Token::Fault { fault, range } => self.of_fault(*fault, placed(range)),
                _ => {}
            }
        }
        for (one, other) in [(b'X', b'Y'), (b'I', b'J')] {
            if let (Some(a), Some(b)) = (places.get(&one).cloned(), places.get(&other).cloned()) {
                let (a, b) = if a.start < b.start { (a, b) } else { (b, a) };
                let (first, second) = (self.text(&a), self.text(&b));
                // The numbers change places, the letters stay.
                let text = format!(
                    "{}{}{}{}{}",
                    &first[..1],
                    &second[1..],
                    self.text(&(a.end..b.start)),
                    &second[..1],
                    &first[1..]
                );
                let found = format!("{first} {second}");
                let meant = format!(
                    "{}{} {}{}",
                    &first[..1],
                    &second[1..],
                    &second[..1],
                    &first[1..]
                );
                self.push(a.start..b.end, &text, prior::SWAP, &found, &meant);
            }
        }
        // A letter of another axis.
        for (letter, other) in [(b'X', b'Y'), (b'Y', b'X'), (b'I', b'J'), (b'J', b'I')] {
            if let Some(range) = places.get(&letter).cloned()
                && (!places.contains_key(&other))
            {
                self.as_letter(range, other, prior::WORD);
            }
        }
        if let Some((letter, range)) = twice {
            let other = match letter {
                b'X' => b'Y',
                b'Y' => b'X',
                b'I' => b'J',
                _ => b'I',
            };
            for range in [
                places[&letter].clone(),
                range,
                self.first_of(letter, &tokens),
            ] {
                if letter != b'R' && !places.contains_key(&other) {
                    self.as_letter(range.clone(), other, prior::LETTER);
                }
                let found = self.text(&range);
                self.push(range, "", prior::LOST, &found, "");
            }
        }
        self.of_motion(motion, &places);
    }

    fn first_of(&self, wanted: u8, tokens: &[Token]) -> Range<usize> {
        let found = tokens.iter().find_map(|token| match token {
            Token::Word { letter, range, .. } if *letter == wanted => {
                Some(range.start - 1..range.end - 1)
            }
            _ => None,
        });
        found.unwrap_or(0..0)
    }

    fn as_letter(&mut self, range: Range<usize>, letter: u8, prior: f64) {
        let found = self.text(&range);
        let meant = format!("{}{}", letter as char, &found[1..]);
        self.push(range, &meant, prior, &found, &meant);
    }

    fn of_motion(
        &mut self,
        motion: Option<(i64, Range<usize>)>,
        places: &FxHashMap<u8, Range<usize>>,
    ) {
        let has_center =
            places.contains_key(&b'I') || places.contains_key(&b'J') || places.contains_key(&b'R');
        for other in 1..=3 {
            if has_center == (other == 1) {
                continue;
            }
            let meant = format!("G{other:02}");
            match &motion {
                Some((own, range)) if *own != other => {
                    let found = self.text(range);
                    self.push(range.clone(), &meant, prior::MOTION, &found, &meant);
                }
                Some(_) => {}
                None => {
                    let with = with_word(self.bytes, &meant, self.pool.is_parted);
                    let kind = FixKind::Rewrite {
                        found: String::new(),
                        meant: meant.clone(),
                    };
                    let (found, lines) = (String::new(), vec![with]);
                    self.changes.push(Change {
                        index: self.index,
                        replaced: 1,
                        is_a_slip: true,
                        lines,
                        prior: prior::MOTION,
                        kind,
                        found,
                        meant,
                    });
                }
            }
        }
        // I and J where a straight cut is meant.
        if has_center
            && self.before.motion == Motion::Line
            && motion.as_ref().is_none_or(|(own, _)| *own == 1)
        {
            let ranges: Vec<Range<usize>> = [b'I', b'J']
                .iter()
                .filter_map(|letter| places.get(letter).cloned())
                .collect();
            if let (Some(first), Some(last)) = (
                ranges.iter().map(|range| range.start).min(),
                ranges.iter().map(|range| range.end).max(),
            ) {
                let found = self.text(&(first..last));
                self.push(first..last, "", prior::WORD, &found, "");
            }
        }
    }

    /// Slips in one number; `range` is that of the word.
    fn of_number(&mut self, letter: u8, number: Option<Number>, range: Range<usize>) {
        let word = self.text(&range);
        let Some(at) = word
            .bytes()
            .position(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+'))
        else {
            return;
        };
        let text = &word[at..];
        let found = number.map(|number| self.length(number));
        let digits: Vec<usize> = text
            .bytes()
            .enumerate()
            .filter(|(_, byte)| byte.is_ascii_digit())
            .map(|(at, _)| at)
            .collect();
        let point = text.find('.');
        let mut meant: Vec<(String, f64)> = Vec::new();
        let bytes = text.as_bytes();
        let with = |range: Range<usize>, other: &str| {
            format!("{}{other}{}", &text[..range.start], &text[range.end..])
        };
        for (nth, &at) in digits.iter().enumerate() {
            for digit in b'0'..=b'9' {
                if digit != bytes[at] {
                    meant.push((
                        with(at..at + 1, &char::from(digit).to_string()),
                        prior::DIGIT,
                    ));
                }
                // A digit that was lost: its place before this one.
                let is_same_again =
                    nth > 0 && bytes[digits[nth - 1]] == digit && digits[nth - 1] + 1 == at;
                if !is_same_again {
                    meant.push((with(at..at, &char::from(digit).to_string()), prior::MORE));
                }
            }
            if digits.len() > 1 {
                let is_doubled = nth > 0 && bytes[digits[nth - 1]] == bytes[at];
                meant.push((
                    with(at..at + 1, ""),
                    if is_doubled {
                        prior::DOUBLED
                    } else {
                        prior::MORE
                    },
                ));
            }
            if let Some(&next) = digits.get(nth + 1)
                && bytes[next] != bytes[at]
            {
                let mut swapped = bytes.to_vec();
                swapped.swap(at, next);
                meant.extend(
                    String::from_utf8(swapped)
                        .ok()
                        .map(|text| (text, prior::SWAP)),
                );
            }
        }
        for digit in b'0'..=b'9' {
            meant.push((format!("{text}{}", char::from(digit)), prior::MORE));
        }
        match text.strip_prefix(['-', '+']) {
            Some(rest) => meant.push((rest.to_owned(), prior::SIGN)),
            None => meant.push((format!("-{text}"), prior::SIGN)),
        }
        match point {
            None if self.document.pointed() == Some(true) => {
                let places = digits.iter().skip(1).copied().chain([text.len()]);
                meant.extend(places.map(|at| (with(at..at, "."), prior::POINT)));
                meant.extend(digits.first().map(|at| (with(*at..*at, "."), prior::POINT)));
            }
            Some(at) if self.document.pointed() == Some(false) => {
                meant.push((with(at..at + 1, ""), prior::POINT))
            }
            _ => {}
        }
        // Nobody writes a number with a zero more in front of it.
        let zeros = |text: &str| {
            let digits = text.trim_start_matches(['-', '+']);
            let zeros = digits.len() - digits.trim_start_matches('0').len();
            zeros
                - usize::from(digits[zeros..].is_empty() || digits[zeros..].starts_with('.'))
                    .min(zeros)
        };
        let has_zeros = zeros(text);
        meant.retain(|(text, _)| zeros(text) <= has_zeros);
        for (text, prior) in meant {
            let more = number_of(&text).map_or(0.0, |number| {
                self.pool.prior(letter, found, self.length(number))
            });
            let meant = format!("{}{text}", &word[..at]);
            self.push(range.clone(), &meant, prior + more, &word, &meant);
        }
    }

    fn length(&self, number: Number) -> i64 {
        self.document.reading().length(number, false)
    }

    /// What cannot be read.
    fn of_fault(&mut self, fault: WordFault, range: Range<usize>) {
        let text = self.text(&range);
        match fault {
            WordFault::NotANumber { .. } => {
                for (at, _) in text.match_indices(['.', ',']) {
                    let meant = format!("{}{}", &text[..at], &text[at + 1..]);
                    self.push(range.clone(), &meant, prior::POINT, &text, &meant);
                }
            }
            WordFault::NoNumber { .. } => {
                self.push(range.clone(), "", prior::WORD, &text, "");
                for digit in 0..=9 {
                    let point = if self.document.pointed() == Some(true) {
                        "."
                    } else {
                        ""
                    };
                    let meant = format!("{text}{digit}{point}");
                    self.push(range.clone(), &meant, prior::MORE, &text, &meant);
                }
            }
            // A number without its letter.
            WordFault::NoWord if number_of(&text).is_some() => {
                for letter in ["X", "Y", "I", "J", "G"] {
                    let meant = format!("{letter}{text}");
                    self.push(range.clone(), &meant, prior::LETTER, &text, &meant);
                }
            }
            WordFault::LetterO => {
                let meant = text.replace(['O', 'o'], "0");
                self.push(range, &meant, prior::LETTER, &text, &meant);
            }
            WordFault::DecimalComma => self.push(range, ".", prior::LETTER, &text, "."),
            _ => {}
        }
    }

    /// I or J of an arc as the other one and its ends tell it.
    fn of_center(&mut self, made: &Move) {
        let Bend::Center { .. } = made.bend else {
            return;
        };
        let reading = self.document.reading();
        let rule = reading.rule(made.incremental);
        let Some(center) = made.center(rule) else {
            return;
        };
        for axis in 0..2 {
            let Some(place) = solved(made, center, axis) else {
                continue;
            };
            let length = match rule {
                CenterRule::StartToCenter => place.wrapping_sub(made.from[axis]),
                CenterRule::CenterToStart => made.from[axis].wrapping_sub(place),
                CenterRule::Absolute => place.wrapping_sub(self.before.zero[axis]),
            };
            self.set(if axis == 0 { b'I' } else { b'J' }, length);
        }
    }

    /// A word of a length, in the place of the one that stands or behind the last one.
    fn set(&mut self, letter: u8, length: i64) {
        let style = self.pool.styles[usize::from(self.before.inch)];
        if length.abs() > 10_000_000_000 {
            return;
        }
        let meant = format!("{}{}", letter as char, style.number(length));
        let mut places = Vec::new();
        words(self.bytes, 1, |token| {
            if let Token::Word {
                letter,
                number,
                range,
            } = token
                && matches!(letter, b'X' | b'Y' | b'I' | b'J' | b'G' | b'N')
            {
                places.push((letter, number, range.start - 1..range.end - 1));
            }
        });
        let own = places.iter().find(|(its, ..)| *its == letter).cloned();
        if let Some((_, number, range)) = own {
            let found = self.length(number);
            if found != length {
                let prior = prior::VALUE + self.pool.prior(letter, Some(found), length);
                let text = self.text(&range);
                self.push(range, &meant, prior, &text, &meant);
            }
            return;
        }
        let order = |letter: u8| b"NGXYIJ".iter().position(|its| *its == letter);
        let behind = places
            .iter()
            .filter(|(its, ..)| order(*its) < order(letter))
            .map(|(.., range)| range.end)
            .max();
        let at = behind.unwrap_or(0);
        let text = if self.pool.is_parted && at > 0 {
            format!(" {meant}")
        } else {
            meant.clone()
        };
        let prior = prior::LOST + self.pool.prior(letter, None, length);
        self.push(at..at, &text, prior, "", &meant);
    }

    /// Coordinates that close the cut, or that others have.
    fn of_values(&mut self, behind: &Machine, way: &Way<'_>) {
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

/// Where along an axis the centre of an arc lies that has the other coordinate of `center`; `None` where its ends do not tell.
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

fn number_of(text: &str) -> Option<Number> {
    let mut found = None;
    words(format!("X{text}").as_bytes(), 1, |token| {
        found = match (token, found) {
            (
                Token::Word {
                    letter: b'X',
                    number,
                    range,
                },
                None,
            ) if range.len() == text.len() + 1 => Some(Some(number)),
            _ => Some(None),
        };
    });
    found.flatten()
}

impl Change {
    pub fn into_repair(self, document: &Document, first: usize) -> Option<Repair> {
        let text = document.text();
        let line = first + self.index;
        let edits = match &self.lines[..] {
            [new] if self.replaced == 0 => {
                let place = text.line_start(line);
                let end = text.line_end_before(text.line_range(line).end);
                let new = String::from_utf8(new.clone()).ok()?;
                vec![TextEdit::new(place..place, format!("{new}{end}"))]
            }
            // The whole line goes, with its end.
            [] => vec![TextEdit::new(
                text.line_start(line)..text.line_start(line + 1),
                "",
            )],
            lines => {
                let edit = |(nth, new): (usize, &Vec<u8>)| {
                    let range = text.line_range(line + nth);
                    edit_between(range.start, text.bytes().get(range)?, new)
                };
                lines
                    .iter()
                    .enumerate()
                    .map(edit)
                    .collect::<Option<Vec<_>>>()?
            }
        };
        let (kind, found, meant) = (self.kind, self.found, self.meant);
        Some(Repair {
            kind,
            edits,
            line,
            found,
            meant,
            closes: false,
            is_sure: false,
            explains: false,
        })
    }
}

/// The edit that makes one line of another, from the first byte that changes to the last.
fn edit_between(start: usize, old: &[u8], new: &[u8]) -> Option<TextEdit> {
    let head = old.iter().zip(new).take_while(|(a, b)| a == b).count();
    let tail = old[head..]
        .iter()
        .rev()
        .zip(new[head..].iter().rev())
        .take_while(|(a, b)| a == b)
        .count();
    let text = String::from_utf8(new[head..new.len() - tail].to_vec()).ok()?;
    Some(TextEdit::new(start + head..start + old.len() - tail, text))
}
