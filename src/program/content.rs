//! Which language a text is in whose name does not say it: programs come as `.txt`, `.cnc`, `.cmd` and `.eia`, too.

use super::Language;

/// Lines that are looked at: behind the header of a program there are blocks soon.
const LINES: usize = 400;
/// Bytes of a line that are looked at.
const WIDTH: usize = 160;

impl Language {
    /// The language in which most lines of a text are; `None` where it is none.
    pub(crate) fn of_content(text: &[u8]) -> Option<Language> {
        let (mut blocks, mut words, mut others) = (0, 0, 0);
        for line in text.split(|byte| matches!(byte, b'\n' | b'\r')).take(LINES) {
            let close: Vec<u8> = line
                .iter()
                .filter(|byte| !byte.is_ascii_whitespace())
                .take(WIDTH)
                .map(u8::to_ascii_uppercase)
                .collect();
            // A byte order mark, comments, the tape's end.
            let close = close.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&close);
            let Some(first) = close.first() else {
                continue;
            };
            if matches!(first, b';' | b'(' | b'%' | b'*' | b':' | b'/') || close.len() <= 2 {
                continue;
            }
            let block = without_number(close);
            if is_block(block) {
                blocks += 1;
            } else if is_line_of_words(block) {
                words += 1;
            } else {
                others += 1;
            }
        }
        let is_most = |lines: usize| lines > 0 && lines > others;
        match blocks >= words {
            true => is_most(blocks).then_some(Language::ThreeB),
            false => is_most(words).then_some(Language::Iso),
        }
    }
}

/// What stands behind `N12` or `N12:`.
fn without_number(line: &[u8]) -> &[u8] {
    let Some(rest) = line.strip_prefix(b"N") else {
        return line;
    };
    let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let rest = &rest[digits..];
    rest.strip_prefix(b":").unwrap_or(rest)
}

/// `B9900B0B9900GXL1`
fn is_block(line: &[u8]) -> bool {
    let numbers = line.iter().filter(|byte| **byte == b'B').count();
    let has_axis = line.windows(2).any(|pair| pair == b"GX" || pair == b"GY");
    line.first() == Some(&b'B') && numbers >= 3 && has_axis
}

/// `G01X10.Y-5.`, `X10.`, `M02`: a word that moves or switches the machine first.
fn is_line_of_words(line: &[u8]) -> bool {
    let is_number = |byte: u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+');
    let is_of_words =
        |byte: u8| is_number(byte) || byte.is_ascii_uppercase() || b"(),;=".contains(&byte);
    matches!(line, [b'G' | b'M' | b'X' | b'Y' | b'T' | b'D' | b'H' | b'O', number, ..] if is_number(*number))
        && line
            .iter()
            .take_while(|byte| !b";(".contains(byte))
            .all(|byte| is_of_words(*byte))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_known_by_what_stands_in_it() {
        let check = |text: &str, expected: Option<Language>| {
            assert_eq!(Language::of_content(text.as_bytes()), expected, "{text:?}");
        };
        let (three_b, iso) = (Some(Language::ThreeB), Some(Language::Iso));
        check("B9900B0B9900GXL1\nB9900B0B39600GYNR1\nDD\n", three_b);
        check(
            "; plate\r\nN 1: B 9900 B 0 B 9900 GX L1  9.9 , 0\r\nMJ\r\n",
            three_b,
        );
        check("\u{feff}B2900B0B2900GXDDNR1\n", three_b);
        check("%\nO0001\nN10 G92 X0 Y0\nG01 X10. Y5.\nM02\n%", iso);
        check("(plate)\ng90g1x1.\ny2.\nm02", iso);
        check("H001=.11\nC001 = ON 8 OFF 12\nG90\nG41 H001\nG1 X1.\n", iso);
        check(
            "Dear customer,\nthe plate is 20 x 10 mm.\nG1 goes first.\n",
            None,
        );
        check("0\nSECTION\n2\nENTITIES\n0\nEOF\n", None);
        check("@echo off\nmkdir build\ncopy a b\n", None);
        check("", None);
        check("\0\0\0", None);
    }
}
