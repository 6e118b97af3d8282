//! ISO text in an even form: words in upper case, with one space between them or none; its meaning is unchanged.
//!
//! Numbers stay as they are: a decimal point and the number of digits mean something to a control.

use super::leader::leader;
use super::plain::{words_at, words_in};
use super::word::Token;
use crate::program::edits::{self, AT_ONCE, LineEdits};
use crate::settings::Layout;
use crate::text::{SourceText, TextEdit};
use std::ops::Range;

/// Lines that are read to find whether spaces separate words.
pub(super) const LOOKED_AT: usize = 1000;

/// The edits that bring `lines` into an even form, sorted and disjoint: words close up in the compact layout and are
/// separated by one space in the others; without a layout, as in most lines of the text.
///
/// Lines with unreadable text, with variables, and with comments in another code page stay byte for byte.
pub(crate) fn format(
    text: &SourceText,
    layout: Option<Layout>,
    lines: Range<usize>,
) -> Vec<TextEdit> {
    let parted = layout.map_or_else(|| is_parted(text), |layout| layout != Layout::Compact);
    let lines = lines.start.max(leader(text))..lines.end.min(text.line_count());
    let firsts = lines.clone().step_by(AT_ONCE);
    let pieces: Vec<Range<usize>> = firsts
        .map(|first| first..(first + AT_ONCE).min(lines.end))
        .collect();
    edits::formed(text, &pieces, |lines| {
        let mut edits = LineEdits::default();
        for line in lines.clone() {
            if let Some(new) = formed(text.line(line), parted) {
                let edit = TextEdit::new(text.line_range(line), new);
                edits.push(text, line..line + 1, edit);
            }
        }
        edits
    })
}

/// True where spaces separate words in most lines.
pub(super) fn is_parted(text: &SourceText) -> bool {
    let (mut parted, mut closed) = (0, 0);
    for line in 0..text.line_count().min(LOOKED_AT) {
        let mut end = None;
        words_at(text, line, |_, _, range| {
            match end {
                Some(end) if end == range.start => closed += 1,
                Some(_) => parted += 1,
                None => {}
            }
            end = Some(range.end);
        });
    }
    parted >= closed
}

/// A line in its new form; `None` where it stays.
fn formed(line: &[u8], parted: bool) -> Option<String> {
    let tokens = tokens_of(line);
    let mut out = String::with_capacity(line.len() + 16);
    let (mut covered, mut may_touch) = (0, true);
    for (token, range) in &tokens {
        if matches!(token, Token::Foreign | Token::Fault(_)) {
            return None;
        }
        let is_comment = *token == Token::Comment;
        let bytes = line.get(range.clone())?;
        if !line
            .get(covered..range.start)?
            .iter()
            .all(|byte| matches!(byte, b' ' | b'\t'))
        {
            return None;
        }
        covered = range.end;
        let text = std::str::from_utf8(bytes).ok()?.trim_end();
        // A semicolon that ends a block is no comment.
        let closes_up = may_touch || text == ";" || (!parted && !is_comment);
        if !closes_up {
            out.push(' ');
        }
        if is_comment {
            out.push_str(text);
        } else if text.is_ascii() {
            out.extend(
                text.bytes()
                    .filter(|byte| !matches!(byte, b' ' | b'\t'))
                    .map(|byte| char::from(byte.to_ascii_uppercase())),
            );
        } else {
            out.extend(
                text.chars()
                    .filter(|character| !matches!(character, ' ' | '\t'))
                    .map(|character| character.to_ascii_uppercase()),
            );
        }
        // After a comment in brackets a space precedes the next word in every form.
        may_touch = *token == Token::Skip;
    }
    let is_blank = |rest: &[u8]| rest.iter().all(|byte| matches!(byte, b' ' | b'\t'));
    if !is_blank(line.get(covered..)?) || out.as_bytes() == line {
        return None;
    }
    let again = tokens_of(out.as_bytes());
    let is_same =
        |(old, new): (&Placed, &Placed)| meaning(old, line) == meaning(new, out.as_bytes());
    (tokens.len() == again.len() && tokens.iter().zip(&again).all(is_same)).then_some(out)
}

/// A token and its place.
type Placed = (Token, Range<usize>);

fn tokens_of(line: &[u8]) -> Vec<Placed> {
    let mut tokens = Vec::new();
    // A line with a byte order mark stays.
    words_in(line, |token, range| tokens.push((token, range)));
    tokens
}

/// A token without its place; comments, definitions and the machine's own words count as their text.
fn meaning<'a>((token, range): &'a Placed, line: &[u8]) -> (&'a Token, String) {
    let said = match token {
        Token::Word { .. } | Token::Corner { .. } | Token::Tape => String::new(),
        _ => String::from_utf8_lossy(line.get(range.clone()).unwrap_or_default())
            .trim_end()
            .to_ascii_uppercase()
            .replace([' ', '\t'], ""),
    };
    (token, said)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn formatted(text: &str, layout: Option<Layout>) -> String {
        let source = SourceText::new(text.as_bytes().to_vec());
        let mut result = text.to_owned();
        for edit in format(&source, layout, 0..source.line_count())
            .into_iter()
            .rev()
        {
            result.replace_range(edit.range, &edit.text);
        }
        result
    }

    #[track_caller]
    fn check(layout: Option<Layout>, text: &str, expected: &str) {
        assert_eq!(formatted(text, layout), expected, "{layout:?} of {text}");
        assert_eq!(
            formatted(expected, layout),
            expected,
            "again, {layout:?} of {text}"
        );
    }

    #[test]
    fn words_are_parted_or_close_up_and_nothing_else_changes() {
        let text = "%\nn10 g01 x1.50  y-0\t(in ) \r\nN20G02X1Y2I0J1;\n/n30 m00\n\nm02\n";
        check(
            Some(Layout::Aligned),
            text,
            "%\nN10 G01 X1.50 Y-0 (in )\r\nN20 G02 X1 Y2 I0 J1;\n/N30 M00\n\nM02\n",
        );
        check(
            Some(Layout::Compact),
            text,
            "%\nN10G01X1.50Y-0 (in )\r\nN20G02X1Y2I0J1;\n/N30M00\n\nM02\n",
        );
        check(
            None,
            "G01X1Y2\ng01 x5\nG01X1Y2\n",
            "G01X1Y2\nG01X5\nG01X1Y2\n",
        );
    }

    #[test]
    fn lines_that_cannot_be_read_stay() {
        check(
            Some(Layout::Compact),
            "g01 x1,5\ng01 x#3\ng01 x1 (open\n\u{feff}g01 x1\n",
            "g01 x1,5\ng01 x#3\ng01 x1 (open\n\u{feff}g01 x1\n",
        );
    }

    proptest! {
        #[test]
        fn formatting_keeps_what_is_read_and_is_the_same_when_repeated(lines in prop::collection::vec("[NGXYIJMHnxg0-9 .()/;%=-]{0,24}", 0..6), layout in 0_usize..3) {
            let layout = [None, Some(Layout::Compact), Some(Layout::Checking)][layout];
            let text = lines.join("\n");
            let once = formatted(&text, layout);
            let said = |text: &str| {
                let of_line = |line: &str| {
                    let said = |token: &Placed| {
                        let (token, said) = meaning(token, line.as_bytes());
                        (token.clone(), said)
                    };
                    tokens_of(line.as_bytes()).iter().map(said).collect::<Vec<_>>()
                };
                text.split('\n').map(of_line).collect::<Vec<_>>()
            };
            prop_assert_eq!(said(&once), said(&text));
            if layout.is_some() {
                prop_assert_eq!(formatted(&once, layout), once);
            }
        }
    }
}
