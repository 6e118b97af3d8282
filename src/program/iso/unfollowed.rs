//! Words that change where the wire goes, or how often, and that nobody follows: what is written anew would cut another
//! part.

#![warn(clippy::indexing_slicing)]

use super::block::{Block, index};
use super::document::Document;
use super::names::{Unfollowed, meaning};
use super::plain::{text_of, words_in};
use super::word::{Number, Token};
use rustc_hash::FxHashSet;

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
    for stretch in 0..document.stretches.len() {
        document.run_lines(stretch, &mut |ran| {
            let line = ran.line;
            let is_new = seen.insert(line);
            let moves = ran.moves().next().is_some();
            let own = Line::of(document.line_bytes(line), ran.block);
            let zero = zeros.take(&own, moves);
            let others = own.words.iter().filter(|_| is_new);
            let is_missing = missing.contains(&line);
            let zero = zero.filter(|word| zeros_seen.insert((line, word.clone())));
            let others = others.filter_map(|(token, text)| own.judge(token, text, is_missing));
            for (word, what) in zero
                .map(|word| (word, Unfollowed::Zero))
                .into_iter()
                .chain(others)
            {
                found.push(UnfollowedWord { line, word, what });
            }
        });
    }
    found
}

/// A line that runs, as its words.
struct Line<'a> {
    block: &'a Block,
    /// Each with its text, in upper case.
    words: Vec<(Token, String)>,
}

impl Line<'_> {
    fn of<'a>(bytes: &[u8], block: &'a Block) -> Line<'a> {
        let mut found = Vec::new();
        words_in(bytes, |token, range| {
            let text = text_of(bytes, &range);
            found.push((token, text));
        });
        Line {
            block,
            words: found,
        }
    }

    fn has(&self, wanted: &[u8]) -> bool {
        let is_wanted = |(token, _): &(Token, String)| matches!(token, Token::Word { letter, .. } if wanted.contains(letter));
        self.words.iter().any(is_wanted)
    }

    fn calls(&self) -> bool {
        let is_call = |(token, _): &(Token, String)| matches!(token, Token::Word { letter: b'M', number } if number.whole() == Some(98));
        self.words.iter().any(is_call)
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
                _ => None,
            },
            Token::Word { letter: b'L', .. } => {
                let repeats = self.block.has_coordinates() && !self.block.takes_coordinates;
                (repeats && !self.calls()).then(|| named(Unfollowed::Repeat))
            }
            Token::Foreign => of_name(text).map(named),
            _ => None,
        }
    }

    /// A call has words beside P and L that may say how often it runs, or from which block on.
    fn counts_otherwise(&self) -> bool {
        self.words.iter().any(|(token, text)| match token {
            Token::Word {
                letter: b'L',
                number,
            } => index(*number).is_none(),
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
            // Without an angle of the wire: the zero of what follows.
            520 if block.has_coordinates() && !self.has(b"ATUV") => Some(Unfollowed::Frame),
            250 | 280 | 290 | 300 | 310 => Some(Unfollowed::Way),
            530 if block.has_coordinates() => Some(Unfollowed::Way),
            650..=679 => Some(Unfollowed::Call),
            720..=799 | 800..=899 | 930 if is_given_a_place => Some(Unfollowed::Way),
            _ => None,
        }
    }
}

/// What lines of words that do not move the wire do to the coordinates after them.
#[derive(Default)]
pub(super) struct Frame {
    zeros: Zeros,
    moved: bool,
}

impl Frame {
    /// The word of a line by which the moves after it lead elsewhere, or more often, than they say.
    pub(super) fn changed_by(&mut self, bytes: &[u8], block: &Block) -> Option<String> {
        let line = Line::of(bytes, block);
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

/// Of a name, or a word with a variable.
fn of_name(text: &str) -> Option<Unfollowed> {
    let is_letter = |byte: &u8| byte.is_ascii_alphabetic();
    let name: Vec<u8> = text.bytes().take_while(is_letter).collect();
    match &name[..] {
        b"D" | b"H" => Some(Unfollowed::Correction),
        name => meaning(name).flatten(),
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
