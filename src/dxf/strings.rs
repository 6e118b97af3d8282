//! Text values: their escapes, and the words of an MTEXT without its formatting.

use super::johab;
use encoding_rs::Encoding;

/// The code pages of `\M+1` to `\M+5` (DXF reference, "MIF"); the fourth, which `encoding_rs` lacks, is Johab.
const MULTIBYTE: [Option<&Encoding>; 5] = [
    Some(encoding_rs::SHIFT_JIS),
    Some(encoding_rs::BIG5),
    Some(encoding_rs::EUC_KR),
    None,
    Some(encoding_rs::GBK),
];

/// A value as text: `\U+XXXX` is the character of that number, `\M+nXXXX` the one of that code in an East Asian code
/// page; invalid UTF-8 becomes U+FFFD.
pub(super) fn decoded(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let mut decoded = String::with_capacity(text.len());
    let mut rest = &*text;
    while let Some(at) = rest.find('\\') {
        let (before, escape) = rest.split_at(at);
        decoded.push_str(before);
        let (character, length) = unicode(escape)
            .or_else(|| multibyte(escape))
            .unwrap_or(('\\', 1));
        decoded.push(character);
        rest = escape.get(length..).unwrap_or_default();
    }
    decoded.push_str(rest);
    decoded
}

/// The character of an escape at the beginning of `text`, and the length of the escape.
fn unicode(text: &str) -> Option<(char, usize)> {
    const LENGTH: usize = "\\U+XXXX".len();
    let number = |text: &str| u16::from_str_radix(text.strip_prefix("\\U+")?.get(..4)?, 16).ok();
    let first = number(text)?;
    // A character beyond the first 65,536 is written as two.
    let second = text.get(LENGTH..).and_then(number);
    let mut characters = char::decode_utf16([first].into_iter().chain(second));
    let character = characters.next()?.ok()?;
    Some((character, LENGTH * character.len_utf16()))
}

fn multibyte(text: &str) -> Option<(char, usize)> {
    let digits = text.strip_prefix("\\M+")?.get(..5)?;
    let page = digits.get(..1)?.parse::<usize>().ok()?.checked_sub(1)?;
    let code = u16::from_str_radix(digits.get(1..)?, 16)
        .ok()?
        .to_be_bytes();
    let Some(encoding) = *MULTIBYTE.get(page)? else {
        return Some((johab::character(code[0], code[1])?, 8));
    };
    // A one-byte code is written with a first byte of 0.
    let code = if code[0] == 0 { &code[1..] } else { &code };
    let (character, bad) = encoding.decode_without_bom_handling(code);
    let mut characters = character.chars();
    let only = characters
        .next()
        .filter(|_| !bad && characters.next().is_none())?;
    Some((only, 8))
}

/// The words of a TEXT, without the switches of underline, overline and strike-through (`%%u`, `%%o`, `%%k`).
pub(super) fn words_of_text(text: &str) -> String {
    let mut words = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find("%%") {
        let (before, code) = rest.split_at(at);
        words.push_str(before);
        let is_switch = matches!(
            code.as_bytes().get(2),
            Some(b'u' | b'U' | b'o' | b'O' | b'k' | b'K')
        );
        words.push_str(if is_switch { "" } else { "%%" });
        rest = code
            .get(if is_switch { 3 } else { 2 }..)
            .unwrap_or_default();
    }
    words.push_str(rest);
    words
}

/// The words of an MTEXT, without groups, fonts, heights and colours; `\P` is a new line (DXF reference, MTEXT format
/// codes).
pub(super) fn words_of_mtext(text: &str) -> String {
    let mut words = String::with_capacity(text.len());
    let mut rest = text.chars();
    while let Some(character) = rest.next() {
        match character {
            '{' | '}' => {}
            '\\' => match rest.next() {
                Some('P') => words.push('\n'),
                Some('~') => words.push(' '),
                Some(escaped @ ('\\' | '{' | '}')) => words.push(escaped),
                Some('A' | 'C' | 'F' | 'f' | 'H' | 'Q' | 'T' | 'W' | 'p' | 'S' | 'c') => {
                    rest.by_ref().find(|&end| end == ';');
                }
                // Switches of underline and overline stand alone.
                Some(_) | None => {}
            },
            other => words.push(other),
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escapes() {
        for (bytes, expected) in [
            (&b"m\\U+00E4rks"[..], "märks"),
            (b"\\U+5200\\U+5177", "刀具"),
            (b"\\U+12", "\\U+12"),
            (b"a\\U+D83D\\U+DE00b\\U+00E4", "a😀bä"),
            (b"\\U+D83Db\\U+DE00\\U+D83D", "\\U+D83Db\\U+DE00\\U+D83D"),
            (b"\\M+49461\\M+4B7A1", "다이"),
            (b"\\M+18BE0\\M+5C4A3x", "金模x"),
            (b"\\M+9B0BC\\M+1ZZZZ\\", "\\M+9B0BC\\M+1ZZZZ\\"),
            (b"\\U+\xc3\xa4\xc3\xa4", "\\U+ää"),
            (b"a\xff", "a\u{fffd}"),
        ] {
            assert_eq!(decoded(bytes), expected);
        }
    }

    #[test]
    fn formatting() {
        for (text, expected) in [
            ("O", "O"),
            ("{\\fArial|b0|i0;O}", "O"),
            ("\\A1;a\\Pb\\~c\\\\\\{", "a\nb c\\{"),
            ("\\LO\\l", "O"),
            ("\\H2.5", ""),
            ("\\", ""),
        ] {
            assert_eq!(words_of_mtext(text), expected);
        }
        for (text, expected) in [
            ("%%uO", "O"),
            ("%%UO%%u", "O"),
            ("%%c5", "%%c5"),
            ("50%%", "50%%"),
            ("%%%%oO", "%%O"),
            ("O", "O"),
        ] {
            assert_eq!(words_of_text(text), expected);
        }
    }
}
