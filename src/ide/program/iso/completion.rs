//! What can follow where a line is being written: words with what they mean, the centre of an arc from its end, the way back to where
//! the cut began, places of the control's table, the lines of the profile.

use super::meaning::{known_g, known_m};
use crate::geometry::{Arc, Point, left_normal};
use crate::ide::{Completion, CompletionKind};
use crate::program::grid::{best_center, snap};
use crate::program::iso::block::{Block, Motion, read_line};
use crate::program::iso::document::Document;
use crate::program::iso::machine::{CenterRule, Course, Machine, Move, Place, added, micrometres};
use crate::program::iso::steps::Begun;
use crate::program::iso::style::Style;
use crate::program::iso::word::{Number, Token, WordFault, words};
use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::Range;

/// G and M words that are offered by themselves.
const G_WORDS: [u8; 15] = [0, 1, 2, 3, 4, 17, 20, 21, 40, 41, 42, 90, 91, 92, 70];
const M_WORDS: [u8; 6] = [0, 1, 2, 30, 98, 99];

/// A chord that runs this nearly along the way before it makes no arc that leaves it tangent: the sine of the angle between them.
const ALONG: f64 = 1e-4;

/// Subprograms that are offered.
const MOST_SUBPROGRAMS: usize = 100;

/// Places of the control's table that are offered where the program names none.
const FIRST_PLACES: u32 = 4;

/// What can stand at a byte, what is most likely first.
pub fn completions(document: &Document, offset: usize) -> Vec<Completion> {
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

/// What stands in a line before the cursor.
struct Typed {
    /// The words that are whole.
    block: Block,
    /// The bytes of the line up to the word that has been begun.
    head: Vec<u8>,
    /// The letter of the word at the cursor, and its number where it has one.
    letter: Option<u8>,
    number: Option<Number>,
    /// What is replaced: that word, or nothing at the cursor.
    range: Range<usize>,
}

impl Typed {
    /// `None` in a comment.
    fn of(before: &[u8], start: usize) -> Option<Typed> {
        let mut last = None;
        words(before, start.max(1), |token| last = Some(token));
        // Counted from 1 in the first line, so that no byte order mark is looked for.
        let by = start.max(1) - start;
        let end = start + before.len();
        let (letter, number, begun) = match last {
            Some(
                Token::Comment { range }
                | Token::Fault {
                    fault: WordFault::OpenComment,
                    range,
                },
            ) if range.end - by == end => return None,
            Some(Token::Word {
                letter,
                number,
                range,
            }) if range.end - by == end => (Some(letter), Some(number), range.start - by),
            Some(Token::Fault {
                fault: WordFault::NoNumber { letter },
                range,
            }) if range.end - by == end => (Some(letter), None, range.start - by),
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

struct Offer<'a> {
    document: &'a Document,
    line: usize,
    /// Before the line.
    machine: Machine,
    style: Style,
    typed: Typed,
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
            Some(b'X' | b'Y') => self.ways_back(false),
            Some(_) => {}
            None => self.next_word(),
        }
    }

    fn push(&mut self, text: String, about: String) {
        if !self.found.iter().any(|known| known.text == text) {
            let range = self.typed.range.clone();
            self.found.push(Completion {
                label: text.clone(),
                about: about.into(),
                text,
                range,
                kind: CompletionKind::Word,
            });
        }
    }

    fn snippet(&mut self, label: &str, about: &str, text: &str) {
        let range = self.typed.range.clone();
        self.found.push(Completion {
            label: label.into(),
            about: about.to_owned().into(),
            text: text.into(),
            range,
            kind: CompletionKind::Snippet,
        });
    }

    /// Words with a letter: those that every control takes, and those that the profile writes.
    fn words_of(&mut self, letter: u8, numbers: &[u8]) {
        for &number in numbers {
            let number = Number {
                mantissa: number.into(),
                decimals: 0,
                point: false,
            };
            if let Some(about) = if letter == b'G' {
                known_g(number)
            } else {
                known_m(number)
            } {
                self.push(
                    format!("{}{:02}", letter as char, number.mantissa),
                    about.into(),
                );
            }
        }
        for line in self.document.limits.lines() {
            let line = line.replace(['{', '}'], " ");
            let mut own = Vec::new();
            words(line.as_bytes(), 1, |token| {
                if let Token::Word {
                    letter: its, range, ..
                } = token
                    && its == letter
                {
                    own.extend(line.get(range.start - 1..range.end - 1).map(str::to_owned));
                }
            });
            for word in own {
                self.push(word, "written by the profile".into());
            }
        }
    }

    /// Places of the control's table: those that the program fills or uses, else the first ones.
    fn places(&mut self, letter: u8) {
        let mut places = self.document.table_places(letter);
        if places.is_empty() {
            places.extend((0..FIRST_PLACES).map(|index| (index, None)));
        }
        for (index, value) in places {
            let about = match value {
                Some(value) => format!(
                    "correction {:.3} mm, as this program sets it",
                    value as f64 / 1e6
                ),
                None => "place in the control's table of corrections".into(),
            };
            self.push(format!("{}{index}", letter as char), about);
        }
    }

    fn subprograms(&mut self, before: &str) {
        let text = self.document.text();
        let subprograms = self.document.subprograms();
        for (number, line) in subprograms.into_iter().take(MOST_SUBPROGRAMS) {
            let shown: String = String::from_utf8_lossy(
                text.bytes().get(text.line_range(line)).unwrap_or_default(),
            )
            .chars()
            .take(40)
            .collect();
            self.push(
                format!("{before}P{number}"),
                format!("line {}: {}", line + 1, shown.trim()),
            );
        }
    }

    fn next_number(&mut self) {
        if let Some((last, step)) = self.document.numbers_before(self.line) {
            self.push(
                format!("N{}", last.saturating_add(step)),
                "the next block number".into(),
            );
        }
    }

    fn next_word(&mut self) {
        let block = self.typed.block;
        let is_begin = block.motion.is_none()
            && !block.has_coordinates()
            && block.compensation.is_none()
            && block.call.is_none()
            && !block.sets_position
            && !block.takes_coordinates
            && block.stop.is_none();
        if is_begin && !is_m98(&self.typed.head) {
            return self.beginnings();
        }
        let glued = !self.typed.head.last().is_some_and(u8::is_ascii_whitespace);
        if glued {
            return;
        }
        if is_m98(&self.typed.head) {
            return self.subprograms("");
        }
        if matches!(block.compensation, Some(side) if side != crate::program::iso::block::Compensation::Off)
            && block.offset.is_none()
        {
            let letter = self.document.table_letter();
            self.places(letter);
        }
        if block.sets_position && !block.has_coordinates() {
            let (x, y) = (self.style.number(0), self.style.number(0));
            self.push(format!("X{x} Y{y}"), "the wire stands at the zero".into());
        }
        match self.motion() {
            Motion::Clockwise | Motion::CounterClockwise if block.r.is_none() => self.centers(),
            Motion::Line | Motion::Rapid if !block.has_coordinates() && block.motion.is_some() => {
                self.ways_back(false)
            }
            _ => {}
        }
    }

    fn motion(&self) -> Motion {
        self.typed.block.motion.unwrap_or(self.machine.motion)
    }

    /// What can begin a line.
    fn beginnings(&mut self) {
        self.ways_back(true);
        let Machine {
            side,
            incremental,
            stated,
            ..
        } = self.machine;
        if self.typed.block.number.is_none() {
            self.next_number();
        }
        self.snippet(
            "G01 X Y",
            "cuts along a straight line",
            "G01 X${1:0} Y${2:0}$0",
        );
        self.snippet(
            "G02 X Y I J",
            "cuts along an arc clockwise: I and J are offered behind Y",
            "G02 X${1:0} Y${2:0} $0",
        );
        self.snippet(
            "G03 X Y I J",
            "cuts along an arc counter-clockwise: I and J are offered behind Y",
            "G03 X${1:0} Y${2:0} $0",
        );
        self.snippet("G00 X Y", "moves without cutting", "G00 X${1:0} Y${2:0}$0");
        let place = self
            .document
            .table_places(self.document.table_letter())
            .first()
            .map_or(1, |(index, _)| *index);
        let offset = format!("{}{place}", self.document.table_letter() as char);
        match side {
            Some(_) => self.push("G40".into(), "ends the correction".into()),
            None => {
                self.push(
                    format!("G41 {offset}"),
                    "the wire runs on the left of the contour".into(),
                );
                self.push(
                    format!("G42 {offset}"),
                    "the wire runs on the right of the contour".into(),
                );
            }
        }
        if incremental {
            self.push("G90".into(), "coordinates are absolute".into());
        } else {
            self.push(
                "G91".into(),
                "coordinates count from where the wire stands".into(),
            );
        }
        if !stated {
            let zero = self.style.number(0);
            self.push(
                format!("G92 X{zero} Y{zero}"),
                "says where the wire stands".into(),
            );
        }
        self.subprograms("M98 ");
        self.push("M00".into(), "stop, as to thread the wire".into());
        let end = self.document.limits.end.clone();
        self.push(end, "end of the program".into());
        let zero = self.style.number(0);
        for line in self
            .document
            .limits
            .lines()
            .map(str::to_owned)
            .collect::<Vec<_>>()
        {
            let line = line.replace("{x}", &zero).replace("{y}", &zero);
            let sides: &[&str] = if line.contains("{side}") {
                &["G41", "G42"]
            } else {
                &[""]
            };
            for side in sides {
                self.push(line.replace("{side}", side), "a line of the profile".into());
            }
        }
    }

    /// The straight ways back to where the cut began and to the end of its way in.
    fn ways_back(&mut self, whole: bool) {
        let Some(Begun { from, to, .. }) = self.document.begun_cut(self.line) else {
            return;
        };
        for (target, about) in [
            (from, "line back to where the cut began"),
            (to, "line to the end of the way in"),
        ] {
            if target == self.machine.at || self.machine.lost != [false, false] {
                continue;
            }
            let incremental = self
                .typed
                .block
                .incremental
                .unwrap_or(self.machine.incremental);
            let base = if incremental {
                self.machine.at
            } else {
                self.machine.zero
            };
            let [x, y] = [
                target[0].wrapping_sub(base[0]),
                target[1].wrapping_sub(base[1]),
            ]
            .map(|length| self.style.number(length));
            let motion = if whole { "G01 " } else { "" };
            let text = format!("{motion}X{x} Y{y}");
            // Proved: the line leads there.
            let led = self.run(&text).is_some_and(|made| {
                (0..2).all(|axis| (made.to[axis] - target[axis]).abs() <= self.style.step())
            });
            if led {
                self.push(text, about.into());
            }
        }
    }

    /// What the control makes of the line with `tail` behind what is there.
    fn run(&self, tail: &str) -> Option<Move> {
        let mut line = self.typed.head.clone();
        line.push(b' ');
        line.extend_from_slice(tail.as_bytes());
        let mut machine = self.machine;
        machine.run(&read_line(&line, 1, |_| {}), self.document.reading())
    }

    /// I and J of the arcs that lead from here to the end that stands in the line.
    fn centers(&mut self) {
        if !matches!(self.motion(), Motion::Clockwise | Motion::CounterClockwise) {
            return;
        }
        let mut block = self.typed.block;
        if self.typed.letter == Some(b'R') {
            block.r = self.typed.number;
        }
        let mut machine = self.machine;
        let Some(made) = machine.run(&block, self.document.reading()) else {
            return;
        };
        if made.from == made.to {
            return;
        }
        let reading = *self.document.reading();
        let zero = self.machine.zero;
        let rule = reading.rule(made.incremental);
        let coordinate = |center: Place, axis: usize| match rule {
            CenterRule::StartToCenter => center[axis].wrapping_sub(made.from[axis]),
            CenterRule::CenterToStart => made.from[axis].wrapping_sub(center[axis]),
            CenterRule::Absolute => center[axis].wrapping_sub(zero[axis]),
        };
        let mut candidates =
            candidates(&made, self.document.begun_cut(self.line).as_ref(), &reading);
        let given = [block.i, block.j]
            .map(|number| number.map(|number| reading.length(number, self.machine.inch)));
        if let Some(axis) = given.iter().position(Option::is_some) {
            // One of them stands: the other follows from it.
            let place = given[axis].map(|length| match rule {
                CenterRule::StartToCenter => made.from[axis].wrapping_add(length),
                CenterRule::CenterToStart => made.from[axis].wrapping_sub(length),
                CenterRule::Absolute => zero[axis].wrapping_add(length),
            });
            candidates = place
                .and_then(|place| equidistant(&made, axis, place))
                .into_iter()
                .collect();
        }
        for (center, about) in candidates {
            let Some(center) = self.on_grid(&made, center) else {
                continue;
            };
            let [i, j] = [coordinate(center, 0), coordinate(center, 1)]
                .map(|length| self.style.number(length));
            let text = match given {
                [Some(_), _] => format!("J{j}"),
                [_, Some(_)] => format!("I{i}"),
                _ => format!("I{i} J{j}"),
            };
            // R, which the cursor stands at, gives way to I and J.
            if let Some(Course::Arc(arc)) = self.run(&text).map(|made| made.course(&reading)) {
                let turn = arc.sweep.abs().to_degrees();
                self.push(
                    text,
                    format!("R {:.3}, {turn:.1}°{about}", arc.radius / 1e3),
                );
            }
        }
    }

    /// The centre that can be written, as far from both ends as that goes.
    fn on_grid(&self, made: &Move, center: Point) -> Option<Place> {
        let step = self.style.step();
        let scale = 1e3 / step as f64;
        let [from, to] = [made.from, made.to].map(|place| snap(micrometres(place) * scale));
        let arc = Arc::about(
            center * scale,
            micrometres(made.from) * scale,
            micrometres(made.to) * scale,
            true,
        );
        let node = best_center(&arc, from?, to?);
        Some([node.x.checked_mul(step)?, node.y.checked_mul(step)?])
    }
}

/// Centres in µm, each with what is said about it: the arc that leaves the cut before without a corner, that of R, a quarter and a half
/// turn.
fn candidates(
    made: &Move,
    begun: Option<&Begun>,
    reading: &crate::program::iso::machine::Reading,
) -> Vec<(Point, &'static str)> {
    let (from, to) = (micrometres(made.from), micrometres(made.to));
    let chord = to - from;
    let turn = if made.motion == Motion::CounterClockwise {
        1.0
    } else {
        -1.0
    };
    let mut found = Vec::new();
    if let Course::Arc(arc) = made.course(reading) {
        found.push((arc.center, ", the arc that R means"));
    }
    if let Some(last) = begun
        .map(|begun| begun.last)
        .filter(|last| last.to == made.from)
    {
        let normal = left_normal(last.segment(reading).end_tangent()) * turn;
        let across = normal.dot(&chord);
        if across > chord.norm() * ALONG {
            found.push((
                from + normal * (chord.norm_squared() / (2.0 * across)),
                ", leaves the block before without a corner",
            ));
        }
    }
    let middle = from + chord / 2.0;
    for (sweep, about) in [(FRAC_PI_2, ""), (PI, ""), (1.5 * PI, "")] {
        let height = chord.norm() / 2.0 / (sweep / 2.0).tan();
        found.push((
            middle + left_normal(chord.normalize()) * (turn * height),
            about,
        ));
    }
    found
}

/// The centre as far from both ends of an arc as from each other, one coordinate of which is given, nm.
fn equidistant(made: &Move, axis: usize, place: i64) -> Option<(Point, &'static str)> {
    let other = 1 - axis;
    let origin = made.from;
    let chord = added(made.to, origin.map(i64::wrapping_neg)).map(|length| length as f64);
    let along = place.wrapping_sub(origin[axis]) as f64;
    if chord[other] == 0.0 {
        return None;
    }
    let across =
        ((chord[0] * chord[0] + chord[1] * chord[1]) / 2.0 - chord[axis] * along) / chord[other];
    let mut center = [0.0; 2];
    center[axis] = along;
    center[other] = across;
    let start = micrometres(origin);
    Some((
        Point::new(start.x + center[0] / 1e3, start.y + center[1] / 1e3),
        "",
    ))
}

fn is_m98(line: &[u8]) -> bool {
    crate::program::iso::block::word_range(line, 1, |letter, number| {
        letter == b'M' && number.whole() == Some(98)
    })
    .is_some()
}
