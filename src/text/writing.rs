//! The encoding of a program file: UTF-8, or GB 18030, which editors of Chinese Windows use.

use encoding_rs::GB18030;
use std::borrow::Cow;

/// The encoding of a file's bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Writing {
    /// UTF-8, or unknown bytes: they are taken as they are.
    Plain,
    Gb18030,
}

impl Writing {
    /// The bytes of a file as UTF-8, and its encoding. Bytes that are neither UTF-8 nor GB 18030 stay as they are, and
    /// so do bytes that would not encode back the same.
    pub(crate) fn read(bytes: Vec<u8>) -> (Vec<u8>, Writing) {
        if std::str::from_utf8(&bytes).is_ok_and(|text| !is_gb_18030_by_chance(text)) {
            return (bytes, Writing::Plain);
        }
        let text = GB18030.decode_without_bom_handling_and_without_replacement(&bytes);
        match text.map(Cow::into_owned) {
            Some(text) if *Writing::Gb18030.written(text.as_bytes()) == bytes => {
                (text.into_bytes(), Writing::Gb18030)
            }
            _ => (bytes, Writing::Plain),
        }
    }

    /// UTF-8 in the encoding of such a file.
    pub(crate) fn written(self, text: &[u8]) -> Cow<'_, [u8]> {
        match (self, std::str::from_utf8(text)) {
            (Writing::Gb18030, Ok(text)) => GB18030.encode(text).0,
            _ => Cow::Borrowed(text),
        }
    }
}

/// True for a text whose letters beyond ASCII may be codes of two bytes of a page of East Asia that are valid UTF-8 by chance.
pub(crate) fn consists_of_pairs(text: &str) -> bool {
    let is_common = |letter: char| {
        let mut bytes = [0; 4];
        let bytes = letter.encode_utf8(&mut bytes).as_bytes();
        letter.is_ascii() || matches!(bytes, [_, 0xa1..=0xff])
    };
    text.chars().all(is_common)
}

/// True for a GB 18030 text that is valid UTF-8 too, as 凸模 alone would be: everything except ASCII
/// is a common two-byte letter of GB 18030, and as UTF-8 it would mix scripts within a word.
pub(crate) fn is_gb_18030_by_chance(text: &str) -> bool {
    let script = |letter: char| match letter {
        // Signs, which occur beside letters of any script.
        '\0'..='\u{bf}' => None,
        '\u{c0}'..='\u{36f}' => Some("Latin"),
        '\u{370}'..='\u{3ff}' => Some("Greek"),
        '\u{400}'..='\u{52f}' => Some("Cyrillic"),
        _ => Some("further"),
    };
    let mixes = |(one, other): (char, char)| match (script(one), script(other)) {
        (Some(one), Some(other)) => one != other,
        _ => false,
    };
    !text.is_ascii() && consists_of_pairs(text) && text.chars().zip(text.chars().skip(1)).any(mixes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_file_is_utf_8_or_gb_18030_or_left_alone() {
        let check = |bytes: &[u8], text: Option<&str>| {
            let (read, writing) = Writing::read(bytes.to_vec());
            assert_eq!(writing == Writing::Gb18030, text.is_some(), "{bytes:x?}");
            assert_eq!(read, text.map_or(bytes, str::as_bytes), "{bytes:x?}");
            assert_eq!(*writing.written(&read), *bytes, "{bytes:x?}");
        };
        check(b"", None);
        check(b"B0B0B5GXL1 ; a\r\n", None);
        check("; 凸模 R 0.08".as_bytes(), None);
        check("\u{feff}; 凸模".as_bytes(), None);
        check(b"; \xb0\xbc\xc4\xa3\r\n", Some("; 凹模\r\n"));
        // These bytes are UTF-8 as well, of letters that never occur together in a word.
        check(b"; \xcd\xb9\xc4\xa3\r\n", Some("; 凸模\r\n"));
        for text in [
            "; pi\u{e8}ce \u{f8} 5 \u{b5}m \u{b1}2\u{b0}",
            "; \u{43f}\u{430}\u{43d}",
            "; \u{b5}\u{3a9}",
        ] {
            check(text.as_bytes(), None);
        }
        // Four bytes, and letters whose second byte is one of ASCII.
        check(
            b"; \x95\x32\x82\x36 \x81\x40\x81\x7c",
            Some("; \u{20000} 丂亅"),
        );
        // Cut off within a letter, a byte that begins none, and two ways to write one letter.
        check(b"; \xcd\xb9\xc4", None);
        check(b"; \xcd\xb9\xff", None);
        check(b"; \xcd\xb9 \x80", None);
    }

    proptest! {
        #[test]
        fn nothing_is_lost_on_the_way(bytes in prop::collection::vec(any::<u8>(), 0..60), text in "\\PC{0,30}") {
            let (read, writing) = Writing::read(bytes.clone());
            prop_assert_eq!(&*writing.written(&read), &bytes[..]);
            // Bytes valid in both are UTF-8; U+E5E5 is the one letter that GB 18030 cannot write.
            let encoded = GB18030.encode(&text).0.into_owned();
            let is_gb = std::str::from_utf8(&encoded).is_err() && !text.contains('\u{e5e5}');
            let (read, writing) = Writing::read(encoded.clone());
            prop_assert_eq!(&*writing.written(&read), &encoded[..]);
            if is_gb {
                prop_assert_eq!((&read[..], writing), (text.as_bytes(), Writing::Gb18030));
            }
        }
    }
}
