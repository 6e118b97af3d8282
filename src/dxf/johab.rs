//! Decodes Johab, the Korean code page 1361, which `encoding_rs` lacks.
//!
//! Source: KS X 1001, annex 3. A syllable is five bits each for its first consonant, its vowel and its last consonant;
//! symbols and Chinese characters are those of Wansung (EUC-KR), two of its rows to a first byte.

/// First consonants that stand alone, by their place in a syllable.
const INITIALS: &str = "ㄱㄲㄴㄷㄸㄹㅁㅂㅃㅅㅆㅇㅈㅉㅊㅋㅌㅍㅎ";
/// Last consonants that stand alone.
const FINALS: &str = "ㄱㄲㄳㄴㄵㄶㄷㄹㄺㄻㄼㄽㄾㄿㅀㅁㅂㅄㅅㅆㅇㅈㅊㅋㅌㅍㅎ";
/// The first vowel that stands alone; the others follow it.
const FIRST_VOWEL: u32 = 0x314f;
const FIRST_SYLLABLE: u32 = 0xac00;
const VOWELS: u32 = 21;
/// The number of last consonants, none included.
const ENDS: u32 = 28;

/// The bytes as text; invalid codes become U+FFFD.
pub(super) fn decoded(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len());
    let mut rest = bytes;
    while let Some((&first, behind)) = rest.split_first() {
        rest = behind;
        if first.is_ascii() {
            text.push(char::from(first));
            continue;
        }
        let found = behind
            .split_first()
            .and_then(|(&second, behind)| Some((character(first, second)?, behind)));
        let (character, behind) = found.unwrap_or((char::REPLACEMENT_CHARACTER, behind));
        text.push(character);
        rest = behind;
    }
    text
}

/// The character of two bytes.
pub(super) fn character(first: u8, second: u8) -> Option<char> {
    match first {
        0x84..=0xd3 => syllable(u32::from(u16::from_be_bytes([first, second]))),
        0xd9..=0xde => of_wansung(0xa1 + (first - 0xd9) * 2, second),
        0xe0..=0xf9 => of_wansung(0xca + (first - 0xe0) * 2, second),
        _ => None,
    }
}

fn syllable(code: u32) -> Option<char> {
    let (initial, vowel, end) = ((code >> 10) & 31, (code >> 5) & 31, code & 31);
    // 1 and 2 mean a missing part; of each eight vowel codes two are unused, and of those of the last consonant 18.
    let initial = match initial {
        1 => None,
        2..=20 => Some(initial - 2),
        _ => return None,
    };
    let vowel = match vowel {
        2 => None,
        3..=29 if vowel % 8 >= 2 => Some(vowel / 8 * 6 + vowel % 8 - 3),
        _ => return None,
    };
    let end = match end {
        1..=17 => end - 1,
        19..=29 => end - 2,
        _ => return None,
    };
    let alone = |letters: &str, at: u32| letters.chars().nth(at as usize);
    match (initial, vowel, end) {
        (Some(initial), Some(vowel), end) => {
            char::from_u32(FIRST_SYLLABLE + (initial * VOWELS + vowel) * ENDS + end)
        }
        (Some(initial), None, 0) => alone(INITIALS, initial),
        (None, Some(vowel), 0) => char::from_u32(FIRST_VOWEL + vowel),
        (None, None, 1..) => alone(FINALS, end - 1),
        _ => None,
    }
}

/// A character of the row, or of the one after it.
fn of_wansung(row: u8, second: u8) -> Option<char> {
    const IN_A_ROW: u8 = 94;
    let at = match second {
        0x31..=0x7e => second - 0x31,
        0x91..=0xfe => second - 0x43,
        _ => return None,
    };
    let code = [row + at / IN_A_ROW, 0xa1 + at % IN_A_ROW];
    let (text, bad) = encoding_rs::EUC_KR.decode_without_bom_handling(&code);
    let mut characters = text.chars();
    characters
        .next()
        .filter(|_| !bad && characters.next().is_none())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn syllables_letters_symbols_and_chinese_characters() {
        for (bytes, expected) in [
            (&b"\x94\x61\xb7\xa1A\xd1"[..], "다이A\u{fffd}"),
            (b"\x88\x61\x88\x41\x84\x61\x84\x44\xd3\xbd", "가ㄱㅏㄳ힣"),
            (b"\xd9\x31\xda\x91\xe0\x31\xf9\xfe", "\u{3000}ｏ伽詰"),
            (b"\x80\x41\x88\x42x", "\u{fffd}A\u{fffd}Bx"),
        ] {
            assert_eq!(decoded(bytes), expected, "{bytes:02x?}");
        }
    }
}
