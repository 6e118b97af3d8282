//! The words of a program mirrored or turned: numbers stay as they are written, their letters and signs change.

use super::{Iso, swapped_sides};
use crate::program::iso::block::Block;
use crate::program::iso::plain::words_in;
use crate::program::iso::taper::{Words, refuse_anywhere};
use crate::program::iso::word::{Number, Token};
use crate::program::refactor::{Rewrite, Sheet, Transform};
use crate::text::TextEdit;
use std::ops::Range;

/// Puts the changed words into the rewrite.
pub(super) fn turn_words(
    sheet: &Sheet<'_, Iso>,
    transform: Transform,
    rewrite: &mut Rewrite<Iso>,
) -> Result<(), String> {
    refuse_anywhere(sheet.document, Words::Guide)?;
    let text = sheet.document.text();
    let edits = &mut rewrite.extra.words;
    if transform.mirrors() {
        edits.extend(swapped_sides(sheet.document, 0..text.line_count()));
    }
    for line in 0..text.line_count() {
        line_words(
            sheet.document.line_bytes(line),
            text.line_start(line),
            transform,
            edits,
        )
        .map_err(|reason| say!(line_by_number, line + 1, reason))?;
    }
    Ok(())
}

/// The place of a number with its letter, and the replacement.
type Turned = (Range<usize>, String);

/// The words of a line that change.
fn line_words(
    line: &[u8],
    start: usize,
    transform: Transform,
    edits: &mut Vec<TextEdit>,
) -> Result<(), String> {
    let block = Block::of(line);
    let (mut fault, mut is_wait) = (None, false);
    // X and Y, I and J: place and text of the number without its sign.
    let mut pairs: [[Option<Turned>; 2]; 2] = Default::default();
    words_in(line, |token, range| {
        let Token::Word { letter, number } = token else {
            return;
        };
        let slot = match letter {
            b'X' => (0, 0),
            b'Y' => (0, 1),
            b'I' => (1, 0),
            b'J' => (1, 1),
            b'G' => {
                is_wait |= number.whole() == Some(4);
                let motion = match (number.mantissa, number.decimals) {
                    (2, 0) => "G03",
                    (3, 0) => "G02",
                    (51 | 52 | 141 | 142, 0) if transform.mirrors() => {
                        fault = Some(say!(a_taper_would_not_be_kept).to_owned());
                        return;
                    }
                    _ => return,
                };
                if transform.mirrors() {
                    let place = start + range.start..start + range.end;
                    edits.push(TextEdit::new(place, motion));
                }
                return;
            }
            _ => return,
        };
        if pairs[slot.0][slot.1].is_some() {
            fault = Some(say!(a_letter_stands_twice, letter as char));
        }
        let digits = line.get(range.start + 1..range.end).unwrap_or_default();
        pairs[slot.0][slot.1] = Some((range, turned(digits, number, transform.sign(slot.1))));
    });
    if let Some(fault) = fault {
        return Err(fault);
    }
    if block.takes_coordinates && block.has_coordinates() {
        return if is_wait {
            Ok(())
        } else {
            Err(say!(a_word_takes_the_coordinates_for_a_place_of_the_machine).into())
        };
    }
    for (pair, names) in pairs.into_iter().zip([["X", "Y"], ["I", "J"]]) {
        let name = |axis: usize| names[if transform.swaps() { 1 - axis } else { axis }];
        let mut edit = |range: Range<usize>, name: &str, number: String| {
            let place = start + range.start..start + range.end;
            edits.push(TextEdit::new(place, format!("{name}{number}")));
        };
        match pair {
            // Both keep their order in the line.
            [Some((first, x)), Some((second, y))] if transform.swaps() => {
                edit(first, names[0], y);
                edit(second, names[1], x);
            }
            [first, second] => {
                for (axis, word) in [first, second].into_iter().enumerate() {
                    if let Some((range, number)) = word {
                        edit(range, name(axis), number);
                    }
                }
            }
        }
    }
    Ok(())
}

/// A number as it is written, with its sign turned where `sign` is −1.
fn turned(digits: &[u8], number: Number, sign: i64) -> String {
    let text = String::from_utf8_lossy(digits).trim().to_owned();
    if sign > 0 || number.mantissa == 0 {
        return text;
    }
    match text.strip_prefix('-') {
        Some(rest) => rest.to_owned(),
        None => format!("-{}", text.trim_start_matches('+')),
    }
}
