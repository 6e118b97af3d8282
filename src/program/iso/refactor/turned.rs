//! The words of a program mirrored or turned: numbers stay as they are written, their letters and signs change.

use crate::program::iso::block::Block;
use crate::program::iso::document::Document;
use crate::program::iso::plain::{words_at, words_in};
use crate::program::iso::word::{Number, Token};
use crate::program::refactor::moves::Edits;
use crate::program::refactor::transform::Transform;
use crate::text::TextEdit;
use std::ops::Range;

/// The G41 and G42 of some lines, each exchanged for the other.
pub(super) fn swapped_sides(document: &Document, lines: Range<usize>) -> Vec<TextEdit> {
    let mut edits = Vec::new();
    for line in lines {
        words_at(document.text(), line, |letter, number, range| {
            let other = match (letter, number.whole()) {
                (b'G', Some(41)) => "G42",
                (b'G', Some(42)) => "G41",
                _ => return,
            };
            edits.push(TextEdit::new(range, other));
        });
    }
    edits
}

/// The changed words.
pub(super) fn turned_words(document: &Document, transform: Transform) -> Edits {
    let text = document.text();
    let mut edits = match transform.mirrors() {
        true => swapped_sides(document, 0..text.line_count()),
        false => Vec::new(),
    };
    for line in 0..text.line_count() {
        let of_line = line_words(document.line_bytes(line), transform)
            .map_err(|reason| say!(line_by_number, line + 1, reason))?;
        let start = text.line_start(line);
        edits.extend(of_line.into_iter().map(|mut edit| {
            edit.range = start + edit.range.start..start + edit.range.end;
            edit
        }));
    }
    Ok(edits)
}

/// The words of a line that change.
fn line_words(line: &[u8], transform: Transform) -> Edits {
    const LETTERS: [u8; 4] = *b"XYIJ";
    let block = Block::of(line);
    let (mut fault, mut is_wait, mut edits) = (None, false, Vec::new());
    // Place and new number of X, Y, I and J.
    let mut found: [Option<(Range<usize>, String)>; 4] = Default::default();
    words_in(line, |token, range| {
        let Token::Word { letter, number } = token else {
            return;
        };
        if let Some(nth) = LETTERS.iter().position(|own| *own == letter) {
            if found[nth].is_some() {
                fault = Some(say!(a_letter_stands_twice, letter as char));
            }
            let digits = line.get(range.start + 1..range.end).unwrap_or_default();
            found[nth] = Some((
                range.clone(),
                turned(digits, number, transform.sign(nth % 2)),
            ));
        }
        if letter != b'G' {
            return;
        }
        is_wait |= number.whole() == Some(4);
        match (number.mantissa, number.decimals) {
            (2, 0) if transform.mirrors() => edits.push(TextEdit::new(range, "G03")),
            (3, 0) if transform.mirrors() => edits.push(TextEdit::new(range, "G02")),
            (51 | 52 | 141 | 142, 0) if transform.mirrors() => {
                fault = Some(say!(a_taper_would_not_be_kept).to_owned());
            }
            _ => {}
        }
    });
    if let Some(fault) = fault {
        return Err(fault);
    }
    if block.takes_coordinates && block.has_coordinates() {
        return match is_wait {
            true => Ok(edits),
            false => Err(say!(a_word_takes_the_coordinates_for_a_place_of_the_machine).into()),
        };
    }
    let mut names = LETTERS;
    if transform.swaps() {
        for pair in [[0, 1], [2, 3]] {
            names.swap(pair[0], pair[1]);
            // Both keep their order in the line.
            let both = pair.map(|nth: usize| found[nth].clone());
            if let [Some((first, one)), Some((second, other))] = both {
                found[pair[0]] = Some((second, one));
                found[pair[1]] = Some((first, other));
            }
        }
    }
    for (name, word) in names.into_iter().zip(found) {
        if let Some((range, number)) = word {
            edits.push(TextEdit::new(range, format!("{}{number}", name as char)));
        }
    }
    Ok(edits)
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
