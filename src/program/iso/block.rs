//! The meaning of one line for the machine: its modal words, coordinates and marks, typed. Lengths stay as they are
//! written.

#![warn(clippy::indexing_slicing)]

pub(super) use super::code::Code;
use super::plain::words_under;
use super::variables::Variables;
use super::word::{Number, Term, Token, Value, WordFault};
use crate::settings::CenterRule;
use std::ops::Range;

/// G00 to G03.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Motion {
    Rapid,
    #[default]
    Line,
    Clockwise,
    CounterClockwise,
}

impl Motion {
    const ALL: [Motion; 4] = [
        Motion::Rapid,
        Motion::Line,
        Motion::Clockwise,
        Motion::CounterClockwise,
    ];

    /// That of a number after G.
    pub(super) fn of(number: Number) -> Option<Motion> {
        let index = usize::try_from(number.mantissa).ok()?;
        Motion::ALL
            .get(index)
            .filter(|_| number.decimals == 0)
            .copied()
    }

    pub(super) fn word(self) -> &'static str {
        match self {
            Motion::Rapid => "G00",
            Motion::Line => "G01",
            Motion::Clockwise => "G02",
            Motion::CounterClockwise => "G03",
        }
    }

    pub(super) fn is_arc(self) -> bool {
        matches!(self, Motion::Clockwise | Motion::CounterClockwise)
    }

    /// The arc that turns left, counter-clockwise, or else clockwise.
    pub(super) fn turning(left: bool) -> Motion {
        match left {
            true => Motion::CounterClockwise,
            false => Motion::Clockwise,
        }
    }

    /// An arc in the other direction; a straight move unchanged.
    pub(super) fn reversed(self) -> Motion {
        match self {
            Motion::Clockwise => Motion::CounterClockwise,
            Motion::CounterClockwise => Motion::Clockwise,
            straight => straight,
        }
    }
}

/// G40, G41, G42.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Compensation {
    Off,
    /// The wire runs to the left of the direction of travel.
    Left,
    Right,
}

/// M00, M01, M02 and M30.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stop {
    Pause,
    End,
}

/// The content of a line. Of a repeated word the last one holds, as in controls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Block {
    /// `N12`.
    pub(crate) number: Option<u32>,
    /// `O0001` or `:0001`.
    pub(crate) program: Option<u32>,
    pub(crate) motion: Option<Motion>,
    /// True for G91, false for G90.
    pub(crate) incremental: Option<bool>,
    pub(crate) compensation: Option<Compensation>,
    /// G90.1: I and J are the centre's coordinates; G91.1: they lead from the start to the centre.
    pub(crate) center: Option<CenterRule>,
    /// True for inches (G20, G70), false for millimetres (G21, G71).
    pub(crate) inch: Option<bool>,
    /// G92: the coordinates are the wire's present position.
    pub(crate) sets_position: bool,
    pub(crate) x: Option<Number>,
    pub(crate) y: Option<Number>,
    /// The height of an electrode that mills; its other effects depend on the machine.
    pub(crate) z: Option<Number>,
    pub(crate) i: Option<Number>,
    pub(crate) j: Option<Number>,
    pub(crate) r: Option<Number>,
    /// `,R2.` or `,C1.`
    pub(crate) corner: Option<Corner>,
    /// `D1` or `H1`: the place of the correction in the control's table.
    pub(crate) offset: Option<Register>,
    pub(crate) stop: Option<Stop>,
    /// `M98 P1`.
    pub(crate) call: Option<u32>,
    /// `L3`: how often the subprogram runs.
    pub(crate) repeat: Option<u32>,
    /// M99.
    pub(crate) returns: bool,
    /// A word that takes the coordinates for something else than a move, such as G04, G28 or G68.
    pub(crate) takes_coordinates: bool,
    /// A word of the line could not be read, so its coordinates are unknown.
    pub(crate) broken: bool,
    /// Only comments, marks and spaces.
    pub(crate) empty: bool,
}

/// A corner that the control makes at the end of a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Corner {
    /// Rounded; else chamfered.
    pub(crate) round: bool,
    /// Its radius, or the distance of a chamfer's ends from the corner.
    pub(crate) size: Number,
}

pub(crate) use crate::program::path::Register;

/// Something besides the block that a line shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Note {
    /// A word whose meaning depends on the machine.
    Foreign { code: Code, range: Range<usize> },
    /// `H001=110`, or `H001=.0085+H175`.
    Definition {
        offset: Register,
        terms: Vec<Term>,
        range: Range<usize>,
    },
    /// A length that is not 0, with a decimal point or without.
    Length { pointed: bool, range: Range<usize> },
    /// A word that the line repeats.
    Twice { letter: u8, range: Range<usize> },
    Fault {
        fault: WordFault,
        range: Range<usize>,
    },
}

impl Note {
    /// A value for a place of the control's table, where it is one.
    fn of_table(letter: u8, place: Number, terms: Option<Vec<Term>>, range: Range<usize>) -> Note {
        let terms = terms.filter(|_| matches!(letter, b'D' | b'H'));
        match place.index().zip(terms) {
            Some((index, terms)) => Note::Definition {
                offset: Register { letter, index },
                terms,
                range,
            },
            None => Note::foreign(letter, place, range),
        }
    }

    fn foreign(letter: u8, number: Number, range: Range<usize>) -> Note {
        let code = Code::of(letter, number);
        Note::Foreign { code, range }
    }
}

/// Reads one line, without its line end. Ranges are counted from `offset`.
pub fn read_line(line: &[u8], offset: usize, note: impl FnMut(Note)) -> Block {
    read_under(&mut Variables::default(), line, offset, note)
}

/// The same where the lines before have given values to variables, as this one may.
pub(super) fn read_under(
    variables: &mut Variables,
    line: &[u8],
    offset: usize,
    mut note: impl FnMut(Note),
) -> Block {
    let mut reader = Reader {
        block: Block {
            empty: true,
            ..Block::default()
        },
        call: None,
        p: None,
        is_alone: true,
    };
    words_under(variables, line, offset, |token, range| {
        let at = range.start - offset;
        reader.take(token, range, line.get(at..).unwrap_or_default(), &mut note)
    });
    let Reader {
        block,
        call,
        p,
        is_alone,
    } = reader;
    let mut foreign = |code, range| note(Note::Foreign { code, range });
    match (call, p) {
        (Some(_), Some((Some(subprogram), _))) => {
            return Block {
                call: Some(subprogram),
                ..block
            };
        }
        // `M98 H100`: who is called is not known.
        (Some(range), _) => foreign(Code::SUBPROGRAM, range),
        (None, Some((_, range))) if !block.takes_coordinates => {
            let code = match is_alone {
                true => Code::SUBPROGRAM_BY_P,
                false => Code(u32::from(b'P') << 16),
            };
            foreign(code, range);
        }
        (None, _) => {}
    }
    block
}

/// A line as far as it has been read.
struct Reader {
    block: Block,
    /// M98.
    call: Option<Range<usize>>,
    /// The number after P, which M98 or a word that takes the coordinates explains.
    p: Option<(Option<u32>, Range<usize>)>,
    /// No word stands beside it but the block's number.
    is_alone: bool,
}

impl Reader {
    /// Takes a token; `text` is the line from there on.
    fn take(
        &mut self,
        token: Token,
        range: Range<usize>,
        text: &[u8],
        note: &mut impl FnMut(Note),
    ) {
        let says_nothing = matches!(token, Token::Skip | Token::Comment | Token::Tape);
        let is_number = matches!(
            token,
            Token::Word {
                letter: b'N' | b'P',
                ..
            }
        );
        self.block.empty &= says_nothing;
        self.is_alone &= says_nothing || is_number;
        match token {
            Token::Word { letter, number } => self.word(letter, number, range, note),
            Token::Definition {
                letter,
                index: place,
                value,
            } => {
                let term = |value| Term {
                    is_negative: false,
                    value: Value::Number(value),
                };
                let terms = value.map(|value| vec![term(value)]);
                note(Note::of_table(letter, place, terms, range));
            }
            Token::Sum {
                letter,
                index: place,
                terms,
            } => note(Note::of_table(letter, place, Some(terms), range)),
            Token::Corner { round, number } => {
                let size = number;
                self.block.corner = Some(Corner { round, size });
            }
            Token::Foreign => {
                let code = Code::of_text(text, range.len());
                note(Note::Foreign { code, range });
            }
            Token::Skip => {
                let code = Code::SKIP;
                note(Note::Foreign { code, range });
            }
            Token::Comment | Token::Tape => {}
            Token::Fault(fault) => {
                self.block.broken |= !fault.is_read();
                note(Note::Fault { fault, range });
            }
        }
    }

    fn word(
        &mut self,
        letter: u8,
        number: Number,
        range: Range<usize>,
        note: &mut impl FnMut(Note),
    ) {
        let block = &mut self.block;
        let twice = |range: &Range<usize>| Note::Twice {
            letter,
            range: range.clone(),
        };
        let length = match letter {
            b'X' => Some(&mut block.x),
            b'Y' => Some(&mut block.y),
            b'I' => Some(&mut block.i),
            b'J' => Some(&mut block.j),
            b'R' => Some(&mut block.r),
            _ => None,
        };
        if let Some(length) = length {
            if length.replace(number).is_some() {
                note(twice(&range));
            }
            if number.mantissa != 0 {
                let pointed = number.point;
                note(Note::Length { pointed, range });
            }
            return;
        }
        match letter {
            b'G' => {
                if block.motion.is_some() && Motion::of(number).is_some() {
                    note(twice(&range));
                }
                if !block.prepare(number) {
                    note(Note::foreign(letter, number, range));
                }
            }
            b'M' => match number.whole() {
                Some(0 | 1) => block.stop = Some(Stop::Pause),
                Some(2 | 30) => block.stop = Some(Stop::End),
                Some(98) => self.call = Some(range),
                Some(99) => block.returns = true,
                _ => note(Note::foreign(letter, number, range)),
            },
            b'P' => self.p = Some((number.index(), range)),
            // Of a number that counts nothing the machine alone knows the meaning.
            b'N' | b'O' | b'D' | b'H' | b'L' => match number.index() {
                Some(index) => block.count(letter, index),
                None => note(Note::foreign(letter, number, range)),
            },
            // The feed does not change where the wire goes.
            b'F' => {}
            b'Z' => {
                block.z = Some(number);
                note(Note::foreign(letter, number, range));
            }
            _ => note(Note::foreign(letter, number, range)),
        }
    }
}

impl Block {
    /// Takes a word that counts, or names a place of a table.
    fn count(&mut self, letter: u8, index: u32) {
        match letter {
            b'N' => self.number = Some(index),
            b'O' => self.program = Some(index),
            b'L' => self.repeat = Some(index),
            _ => self.offset = Some(Register { letter, index }),
        }
    }

    /// Takes a G word; false where its meaning depends on the machine.
    fn prepare(&mut self, number: Number) -> bool {
        if number.decimals > 0 {
            // The axes of a mirror, with G51.1 and G50.1.
            self.takes_coordinates |= matches!((number.mantissa, number.decimals), (501 | 511, 1));
            let stated = match (number.mantissa, number.decimals) {
                (901, 1) => CenterRule::Absolute,
                (911, 1) => CenterRule::StartToCenter,
                _ => return false,
            };
            self.center = Some(stated);
            return true;
        }
        match number.mantissa {
            0..=3 => self.motion = Motion::of(number),
            4 => self.takes_coordinates = true,
            20 | 70 => self.inch = Some(true),
            21 | 71 => self.inch = Some(false),
            40 => self.compensation = Some(Compensation::Off),
            41 => self.compensation = Some(Compensation::Left),
            42 => self.compensation = Some(Compensation::Right),
            90 => self.incremental = Some(false),
            91 => self.incremental = Some(true),
            92 => self.sets_position = true,
            17 => {}
            // G68 has the centre and the angle of a rotation.
            10 | 26..=31 | 65..=68 => {
                self.takes_coordinates = true;
                return false;
            }
            _ => return false,
        }
        true
    }

    /// The content of a line, without its faults.
    pub(crate) fn of(line: &[u8]) -> Block {
        read_line(line, 1, |_| {})
    }

    /// True where the line has a coordinate of its own.
    pub fn has_coordinates(&self) -> bool {
        self.x.is_some() || self.y.is_some()
    }

    /// True where it has an arc's centre.
    pub(crate) fn has_center(&self) -> bool {
        self.i.is_some() || self.j.is_some()
    }

    /// It leads somewhere, if only all round a circle.
    pub(super) fn leads(&self) -> bool {
        self.has_coordinates() || self.has_center()
    }

    /// Its centre is that of no arc, under the motion that is in force.
    pub(super) fn has_stray_center(&self, motion: Motion) -> bool {
        let is_of_way = !self.takes_coordinates && !self.sets_position;
        self.has_center() && !motion.is_arc() && is_of_way
    }
}
