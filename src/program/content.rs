//! Guesses the language of a text whose name does not tell: programs come as `.txt`, `.cnc`, `.cmd` and `.eia`, too.

use super::document::Language;

/// Lines that are looked at: soon after its header a program has blocks.
const LINES: usize = 400;
/// Bytes of a line that are looked at.
const WIDTH: usize = 160;

impl Language {
    /// The language of most lines of a text; `None` where there is none.
    pub(crate) fn of_content(text: &[u8]) -> Option<Language> {
        let (mut lines, mut others) = ([0; Language::ALL.len()], 0);
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
            let of = Language::ALL.iter().position(|one| one.has_line(block));
            *of.map_or(&mut others, |of| &mut lines[of]) += 1;
        }
        // On a tie, the first language.
        let all = Language::ALL.into_iter().zip(lines).rev();
        let (most, lines) = all.max_by_key(|(_, lines)| *lines)?;
        (lines > others).then_some(most)
    }

    /// True where a line, without spaces and in capitals, reads as one of it.
    fn has_line(self, line: &[u8]) -> bool {
        match self {
            Language::ThreeB => is_block(line),
            Language::Iso => is_line_of_words(line),
        }
    }
}

/// The text after `N12` or `N12:`.
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

    /// The extension of VS Code has the same cases in its test.
    #[test]
    fn a_text_is_known_by_what_stands_in_it() {
        let table = include_str!("../../clients/languages.json");
        let table: serde_json::Value = serde_json::from_str(table).unwrap();
        let cases = table["cases"].as_array().unwrap();
        assert!(cases.len() > 10);
        for case in cases {
            let text = case["text"].as_str().unwrap();
            let found = Language::of_content(text.as_bytes()).map(Language::id);
            assert_eq!(found, case["language"].as_str(), "{text:?}");
        }
    }
}
