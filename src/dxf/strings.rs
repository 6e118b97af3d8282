//! Text values: their escapes, and the words of an MTEXT without its formatting.

/// A value as text: `\U+XXXX` is the character of that number, what is no UTF-8 becomes U+FFFD.
pub(super) fn decoded(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let mut parts = text.split("\\U+");
    let mut decoded = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let character = part.get(..4).and_then(|digits| u32::from_str_radix(digits, 16).ok()).and_then(char::from_u32);
        match character {
            Some(character) => {
                decoded.push(character);
                decoded.push_str(&part[4..]);
            }
            None => {
                decoded.push_str("\\U+");
                decoded.push_str(part);
            }
        }
    }
    decoded
}

/// The words of an MTEXT: groups, fonts, heights and colours dropped, `\P` a new line (DXF reference, MTEXT format codes).
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
            (b"\\U+\xc3\xa4\xc3\xa4", "\\U+ää"),
            (b"a\xff", "a\u{fffd}"),
        ] {
            assert_eq!(decoded(bytes), expected);
        }
    }

    #[test]
    fn formatting() {
        for (text, expected) in
            [("O", "O"), ("{\\fArial|b0|i0;O}", "O"), ("\\A1;a\\Pb\\~c\\\\\\{", "a\nb c\\{"), ("\\LO\\l", "O"), ("\\H2.5", ""), ("\\", "")]
        {
            assert_eq!(words_of_mtext(text), expected);
        }
    }
}
