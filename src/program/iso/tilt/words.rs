//! The words of a line that have to do with the wire's upper end.

use crate::finding::Side;
use crate::program::iso::plain::words_in;
use crate::program::iso::word::{Number, Token};
use std::ops::Range;

/// One of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::program::iso) enum Upper {
    /// The wire leans to a side of its way (G51, G52, G141, G142), or upright again (G50, G140).
    Lean { to: Option<Side>, code: i64 },
    /// A.
    Angle(Number),
    /// T, which switches other things where no word tilts the wire.
    Tool(Number),
    /// U and V: the distance of the upper guide along X, 0, or Y, 1.
    Guide(usize, Number),
    /// TP and TN: the height of the programmed plane, 0, or of the other one, 1.
    Plane(usize, Option<Number>),
    /// A second contour after a colon.
    Second,
}

/// Hands out those of a line in their order, each with its place in the line.
pub(in crate::program::iso) fn upper_words(line: &[u8], mut each: impl FnMut(Upper, Range<usize>)) {
    words_in(line, |token, range| {
        let upper = match token {
            Token::Word { letter, number } => match (letter, number.whole()) {
                (b'G', Some(code @ (51 | 141))) => Upper::Lean {
                    to: Some(Side::Left),
                    code,
                },
                (b'G', Some(code @ (52 | 142))) => Upper::Lean {
                    to: Some(Side::Right),
                    code,
                },
                (b'G', Some(code @ (50 | 140))) => Upper::Lean { to: None, code },
                (b'A', _) => Upper::Angle(number),
                (b'T', _) => Upper::Tool(number),
                (b'U', _) => Upper::Guide(0, number),
                (b'V', _) => Upper::Guide(1, number),
                _ => return,
            },
            Token::Foreign => match line.get(range.clone()).unwrap_or_default() {
                [b':', ..] => Upper::Second,
                [b'T' | b't', rest @ ..] => match rest {
                    [b'P' | b'p', ..] => Upper::Plane(0, number_of(rest)),
                    [b'N' | b'n', ..] => Upper::Plane(1, number_of(rest)),
                    _ => return,
                },
                _ => return,
            },
            _ => return,
        };
        each(upper, range);
    });
}

/// The number of what stands after the first letter of a name, read as a word.
fn number_of(word: &[u8]) -> Option<Number> {
    let mut found = None;
    words_in(word, |token, _| {
        if let Token::Word { number, .. } = token {
            found = Some(number);
        }
    });
    found
}

/// All of them in a line.
#[derive(Default)]
pub(super) struct Words {
    pub(super) side: Option<Side>,
    pub(super) upright: bool,
    /// A and T.
    pub(super) angle: Option<Number>,
    pub(super) tool: Option<Number>,
    pub(super) guide: [Option<Number>; 2],
    pub(super) planes: [Option<Number>; 2],
    /// The byte after the colon.
    pub(super) second: Option<usize>,
}

impl Words {
    pub(super) fn of(line: &[u8]) -> Words {
        let mut said = Words::default();
        upper_words(line, |upper, range| match upper {
            Upper::Lean { to: None, .. } => said.upright = true,
            Upper::Lean { to, .. } => said.side = to,
            Upper::Angle(number) => said.angle = Some(number),
            Upper::Tool(number) => said.tool = Some(number),
            Upper::Guide(axis, number) => said.guide[axis] = Some(number),
            Upper::Plane(plane, number) => said.planes[plane] = number.or(said.planes[plane]),
            Upper::Second => said.second = Some(range.start + 1),
        });
        said
    }
}
