//! Words that give the upper guide another path than the lower one. Their meaning depends on the order, the direction
//! and the mode of the moves of X and Y: refactorings that would change it refuse such a program.

use super::plain::words_in;
use super::word::Token;
use crate::program::iso::document::Document;
use std::ops::Range;

/// The kinds of such words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) enum Words {
    /// Those that position the upper guide: U, V, a second contour after a colon.
    Guide,
    /// Those and the ones that tilt the wire: G51, G52, G140 to G142, TP, TN.
    All,
}

/// An error where one of the words stands in some lines.
pub(in crate::program) fn refuse(
    document: &Document,
    mut lines: Range<usize>,
    wanted: Words,
) -> Result<(), String> {
    match lines.find_map(|line| reason(document, line, wanted).map(|reason| (line, reason))) {
        Some((line, reason)) => Err(say!(line_by_number, line + 1, reason)),
        None => Ok(()),
    }
}

/// An error where one of the words stands anywhere.
pub(in crate::program) fn refuse_anywhere(
    document: &Document,
    wanted: Words,
) -> Result<(), String> {
    refuse(document, 0..document.text().line_count(), wanted)
}

/// An error where the wire leans by an angle from a line before this one on.
pub(in crate::program) fn refuse_where_it_leans(
    document: &Document,
    line: usize,
) -> Result<(), String> {
    let mut leans = None;
    for before in 0..line {
        words_in(document.line_bytes(before), |token, _| {
            if let Token::Word {
                letter: b'G',
                number,
            } = token
            {
                match number.whole() {
                    Some(51 | 52 | 141 | 142) => leans = Some(before),
                    Some(50 | 140) => leans = None,
                    _ => {}
                }
            }
        });
    }
    match leans {
        Some(line) => {
            let reason = say!(the_upper_profile_would_begin_beside_a_corner);
            Err(say!(line_by_number, line + 1, reason))
        }
        None => Ok(()),
    }
}

fn reason(document: &Document, line: usize, wanted: Words) -> Option<&'static str> {
    let code = without_comments(document.line_bytes(line));
    let mut words = code.iter().enumerate().filter(|(at, byte)| {
        let before = at.checked_sub(1).and_then(|before| code.get(before));
        byte.is_ascii_alphabetic() && !before.is_some_and(u8::is_ascii_alphabetic) || **byte == b':'
    });
    words.find_map(|(at, letter)| {
        let number = |from: usize| -> Option<&[u8]> {
            let rest = code.get(from..)?.trim_ascii_start();
            let length = rest
                .iter()
                .take_while(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+'))
                .count();
            rest.get(..length).filter(|number| !number.is_empty())
        };
        match letter {
            b'U' | b'V' if number(at + 1).is_some() => {
                Some(say!(the_way_of_the_upper_guide_would_not_be_kept))
            }
            b':' if code[at..].iter().any(|byte| matches!(byte, b'X' | b'Y')) => {
                Some(say!(the_second_contour_behind_the_colon_would_not_be_kept))
            }
            b'G' if wanted == Words::All => {
                let whole = number(at + 1)
                    .and_then(|number| std::str::from_utf8(number).ok())
                    .and_then(|number| number.parse::<u32>().ok());
                whole
                    .filter(|code| matches!(code, 51 | 52 | 140..=142))
                    .map(|_| say!(a_taper_would_not_be_kept))
            }
            b'T' if wanted == Words::All
                && matches!(code.get(at + 1), Some(b'P' | b'N'))
                && number(at + 2).is_some() =>
            {
                Some(say!(the_planes_of_a_taper_would_not_be_kept))
            }
            _ => None,
        }
    })
}

/// In upper case.
fn without_comments(line: &[u8]) -> Vec<u8> {
    let mut depth = 0_usize;
    let mut code = Vec::with_capacity(line.len());
    for byte in line {
        match byte {
            b'(' => depth += 1,
            b')' => depth = depth.saturating_sub(1),
            b';' if depth == 0 => break,
            byte if depth == 0 => code.push(byte.to_ascii_uppercase()),
            _ => {}
        }
    }
    code
}
