//! Words that may change where the wire goes, or how often, and that nobody follows: what is written anew would cut another
//! part. Those that do nothing of the kind are listed here; every other word is one of them.

#![warn(clippy::indexing_slicing)]

use super::block::{Block, Code};
use super::document::Document;
use super::names::{Unfollowed, is_harmless, meaning};
use super::plain::{text_of, words_under};
use super::variables::Variables;
use super::word::{Number, Token};
use rustc_hash::FxHashSet;
use std::collections::BTreeSet;

/// One of them in its line, from 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct UnfollowedWord {
    pub(crate) line: usize,
    pub(crate) word: String,
    pub(crate) what: Unfollowed,
}

/// Such words of the lines that run, in their order, each once.
pub(super) fn unfollowed(document: &Document) -> Vec<UnfollowedWord> {
    let missing = document
        .order()
        .into_iter()
        .flat_map(|order| &order.missing);
    let missing: FxHashSet<usize> = missing.map(|(line, _)| *line).collect();
    let mut found = Vec::new();
    let (mut seen, mut zeros_seen) = (FxHashSet::default(), FxHashSet::default());
    let mut zeros = Zeros::default();
    let mut has_begun = false;
    for cut in 0..document.cuts.len() {
        document.run_lines(cut, &mut |ran| {
            let line = ran.line;
            let is_new = seen.insert(line);
            let moves = ran.moves().next().is_some();
            let bytes = document.line_bytes(line);
            let own = Line::of(
                bytes,
                ran.block,
                ran.variables,
                &document.control.limits.known,
            );
            let zero = zeros.take(&own, moves);
            let others = own.words.iter().filter(|_| is_new);
            let is_missing = missing.contains(&line);
            let others = others.filter(|(token, _)| has_begun || !is_name(token));
            let zero = zero.filter(|word| zeros_seen.insert((line, word.clone())));
            let others = others.filter_map(|(token, text)| own.judge(token, text, is_missing));
            for (word, what) in zero
                .map(|word| (word, Unfollowed::Zero))
                .into_iter()
                .chain(others)
            {
                found.push(UnfollowedWord { line, word, what });
            }
            has_begun |= !own.words.iter().all(|(token, _)| is_name(token));
        });
    }
    found
}

/// `L1000` or `O1`, at the beginning the name of the program; and what says nothing.
fn is_name(token: &Token) -> bool {
    match token {
        Token::Word { letter, .. } => matches!(letter, b'L' | b'N' | b'O'),
        token => matches!(token, Token::Comment | Token::Tape),
    }
}

/// A line that runs, as its words.
struct Line<'a> {
    block: &'a Block,
    /// Words that profiles write.
    known: &'a BTreeSet<Code>,
    /// Each with its text, in upper case.
    words: Vec<(Token, String)>,
}

impl Line<'_> {
    fn of<'a>(
        bytes: &[u8],
        block: &'a Block,
        mut variables: Variables,
        known: &'a BTreeSet<Code>,
    ) -> Line<'a> {
        let mut words = Vec::new();
        words_under(&mut variables, bytes, 1, |token, range| {
            let text = text_of(bytes, &(range.start - 1..range.end - 1));
            words.push((token, text));
        });
        Line {
            block,
            known,
            words,
        }
    }

    fn has(&self, wanted: &[u8]) -> bool {
        let is_wanted = |(token, _): &(Token, String)| matches!(token, Token::Word { letter, .. } if wanted.contains(letter));
        self.words.iter().any(is_wanted)
    }

    /// The words of the line that belong to a call.
    fn call(&self) -> String {
        let of_call = |(token, _): &&(Token, String)| match token {
            Token::Word { letter, .. } => {
                !matches!(letter, b'N' | b'O' | b'F' | b'G' | b'X' | b'Y')
            }
            token => *token == Token::Foreign,
        };
        let own: Vec<&str> = self
            .words
            .iter()
            .filter(of_call)
            .map(|(_, text)| &**text)
            .collect();
        own.join(" ")
    }

    /// A word of the line says what the others are for: it calls, fills a table, waits.
    fn explains(&self, wanted: &[i64]) -> bool {
        let is_wanted = |(token, _): &(Token, String)| matches!(token, Token::Word { letter: b'G', number } if tenths(*number).is_some_and(|code| wanted.contains(&code)));
        self.words.iter().any(is_wanted)
    }

    /// What a word of the line does that nobody follows, and how it is named.
    fn judge(&self, token: &Token, text: &str, is_missing: bool) -> Option<(String, Unfollowed)> {
        let named = |what| (text.to_owned(), what);
        match token {
            Token::Word {
                letter: b'G',
                number,
            } => self.prepares(*number).map(named),
            Token::Word {
                letter: b'M',
                number,
            } => match number.whole() {
                Some(96 | 97) => Some((self.call(), Unfollowed::Call)),
                Some(98) if is_missing => Some((self.call(), Unfollowed::Missing)),
                Some(98) if self.block.call.is_none() => Some((self.call(), Unfollowed::Call)),
                Some(98) if self.counts_otherwise() => Some((self.call(), Unfollowed::Repeat)),
                Some(99) if self.has(b"PL") => Some((self.call(), Unfollowed::Jump)),
                // Switches of the machine.
                Some(0..=95 | 98 | 99) => None,
                _ => (!self.is_known(b'M', *number)).then(|| named(Unfollowed::Unknown)),
            },
            Token::Word { letter, number } => self.adds(*letter, *number).map(named),
            Token::Foreign => self.of_name(text).map(named),
            _ => None,
        }
    }

    fn is_known(&self, letter: u8, number: Number) -> bool {
        self.known.contains(&Code::of(letter, number))
    }

    /// Of a word that neither prepares nor switches.
    fn adds(&self, letter: u8, number: Number) -> Option<Unfollowed> {
        let block = self.block;
        let is_of_call = self.has(b"M") || block.takes_coordinates || self.explains(&EXPLAINING);
        match letter {
            b'C' | b'E' | b'F' | b'I' | b'J' | b'N' | b'O' | b'R' | b'S' | b'T' | b'U' | b'V'
            | b'W' | b'X' | b'Y' | b'Z' => None,
            b'D' | b'H' => number.index().is_none().then_some(Unfollowed::Correction),
            _ if is_of_call => None,
            b'L' if block.has_coordinates() => Some(Unfollowed::Repeat),
            b'L' | b'P' => Some(Unfollowed::Call),
            // Beside G50 to G52 the angle by which the wire leans; else axes that turn the part.
            b'A' if self.explains(&LEANING) => None,
            _ if number.mantissa == 0 || self.is_known(letter, number) => None,
            _ => Some(Unfollowed::Unknown),
        }
    }

    /// A call has words beside P and L that may say how often it runs, or from which block on.
    fn counts_otherwise(&self) -> bool {
        self.words.iter().any(|(token, text)| match token {
            Token::Word {
                letter: b'L',
                number,
            } => number.index().is_none(),
            Token::Word { letter, .. } => !b"NOMPGFXYD".contains(letter),
            Token::Foreign => !text.starts_with(['#', ':']),
            _ => false,
        })
    }

    fn prepares(&self, number: Number) -> Option<Unfollowed> {
        let block = self.block;
        // Of a word that moves, the coordinates belong to that.
        let is_given_a_place = block.has_coordinates() && block.motion.is_none();
        match tenths(number)? {
            // Fast feed and looking ahead, `G05 P10000`.
            50 | 80 if self.has(b"P") => None,
            // Chinese controls: mirrors about X, Y, both, with the axes exchanged or not.
            50 | 60 | 70 | 80 | 90 | 110 => Some(Unfollowed::Frame),
            // One of those, or `G10 L2 P1 X… Y…`; a value for the table of corrections shifts nothing.
            100 if !self.has(b"PR") || block.has_coordinates() => Some(Unfollowed::Frame),
            // Polar coordinates, other planes, mirrors, rotations, scales.
            160 | 161 | 180 | 190 | 240 | 260 | 511 | 680..=689 => Some(Unfollowed::Frame),
            100 => None,
            // Without an angle of the wire: the zero of what follows.
            520 if block.has_coordinates() && !self.has(b"ATUV") => Some(Unfollowed::Frame),
            220 if self.has(b"LP") => Some(Unfollowed::Call),
            250 | 280 | 290 | 300 | 310 => Some(Unfollowed::Way),
            270 | 530 if block.has_coordinates() => Some(Unfollowed::Way),
            650..=679 => Some(Unfollowed::Call),
            720..=799 | 800..=899 | 930 if is_given_a_place => Some(Unfollowed::Way),
            code if HARMLESS.contains(&code) || matches!(code % 1000, 540..=599) => None,
            _ => (!self.is_known(b'G', number)).then_some(Unfollowed::Unknown),
        }
    }

    /// Of a name, a variable, or a word whose number only the control knows.
    fn of_name(&self, text: &str) -> Option<Unfollowed> {
        if let Some(variable) = text.strip_prefix('#') {
            let digits = variable.split(|digit: char| !digit.is_ascii_digit()).next();
            // Those of the system: corrections, alarms and times, places of the machine and its zeros.
            return match digits?.parse() {
                Ok(0..=999 | 3000..=3999) => None,
                Ok(2000..=2999) => Some(Unfollowed::Correction),
                _ => Some(Unfollowed::Frame),
            };
        }
        let is_letter = |byte: &u8| byte.is_ascii_alphabetic();
        let name: Vec<u8> = text.bytes().take_while(is_letter).collect();
        match (&name[..], meaning(&name)) {
            // The second contour after a colon, which the taper follows.
            ([], _) => None,
            (_, Some(what)) => what,
            ([letter], _) if b"CEFNSTWZ".contains(letter) => None,
            (name, _) if is_harmless(name) || self.known.contains(&Code::of_name(name)) => None,
            _ => Some(Unfollowed::Unknown),
        }
    }
}

/// G words that leave the way of the wire as it is, times 10: what is followed, and waits, exact stops, feeds, ends of what
/// would be refused itself.
const HARMLESS: [i64; 48] = [
    0, 10, 20, 30, 40, 50, 51, 80, 120, 150, 170, 200, 210, 270, 400, 410, 420, 490, 500, 501, 510,
    520, 600, 610, 611, 620, 630, 640, 641, 690, 700, 710, 800, 900, 901, 910, 911, 920, 930, 940,
    950, 960, 970, 980, 990, 1400, 1410, 1420,
];

/// Those that say what P, L, K, Q beside them are: a table, a mode, a zero, a call.
const EXPLAINING: [i64; 14] = [
    40, 50, 51, 80, 100, 220, 541, 641, 650, 651, 660, 661, 670, 680,
];

/// Those beside which A is the angle by which the wire leans.
const LEANING: [i64; 6] = [500, 510, 520, 1400, 1410, 1420];

/// What lines of words that do not move the wire do to the coordinates after them.
#[derive(Default)]
pub(super) struct Frame {
    zeros: Zeros,
    moved: bool,
}

impl Frame {
    /// The word of a line by which the moves after it lead elsewhere, or more often, than they say.
    pub(super) fn changed_by(&mut self, bytes: &[u8], block: &Block) -> Option<String> {
        let known = BTreeSet::default();
        let line = Line::of(bytes, block, Variables::default(), &known);
        let zero = self.zeros.take(&line, std::mem::take(&mut self.moved));
        let other = || {
            let own = line.words.iter();
            let judged = own.filter_map(|(token, text)| line.judge(token, text, false));
            let leads = |(_, what): &(String, Unfollowed)| {
                use Unfollowed::{Frame, Jump, Repeat, Way, Zero};
                matches!(what, Frame | Jump | Repeat | Way | Zero)
            };
            { judged }.find(leads).map(|(word, _)| word)
        };
        zero.or_else(other)
    }

    /// The wire moves before the next line.
    pub(super) fn moves(&mut self) {
        self.moved = true;
    }
}

/// The number of a G word, times 10.
fn tenths(number: Number) -> Option<i64> {
    match number.decimals {
        0 => number.mantissa.checked_mul(10),
        1 => Some(number.mantissa),
        _ => None,
    }
}

/// The zero that the coordinates count from: G54 to G59, those of more tables (G154), `G54.1 P1`.
#[derive(Default)]
struct Zeros {
    now: Option<(i64, Option<i64>)>,
    /// The wire has moved.
    moved: bool,
}

impl Zeros {
    /// Takes a line, which moves the wire or does not; the word by which it counts from another zero than before.
    fn take(&mut self, line: &Line<'_>, moves: bool) -> Option<String> {
        let place = line.words.iter().find_map(|(token, _)| match token {
            Token::Word {
                letter: b'P',
                number,
            } => number.whole(),
            _ => None,
        });
        let mut other = None;
        for (token, text) in &line.words {
            let Token::Word {
                letter: b'G',
                number,
            } = token
            else {
                continue;
            };
            let Some(code) = tenths(*number).filter(|code| matches!(code % 1000, 540..=599)) else {
                continue;
            };
            let place = place.filter(|_| code % 10 != 0);
            // Controls wake up in G54.
            if self.moved && self.now.unwrap_or((540, None)) != (code, place) {
                other = Some(text.clone());
            }
            self.now = Some((code, place));
        }
        self.moved |= moves;
        other
    }
}
