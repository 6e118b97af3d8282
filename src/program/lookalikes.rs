//! Characters that look like those of a program but differ: full-width forms, wide spaces, dashes, Cyrillic and Greek
//! letters; in UTF-8, and in GBK, which editors of Chinese Windows write.

use encoding_rs::GBK;

/// The kind of a look-alike character.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) enum Likeness {
    FullWidth(u8),
    Space,
    /// Cyrillic or Greek.
    Foreign(u8),
}

impl Likeness {
    pub(crate) fn ascii(self) -> u8 {
        match self {
            Likeness::FullWidth(byte) | Likeness::Foreign(byte) => byte,
            Likeness::Space => b' ',
        }
    }

    /// Letters and digits; the others are marks and spaces.
    pub(crate) fn is_letter(self) -> bool {
        self.ascii().is_ascii_alphanumeric()
    }
}

/// A character by its place in a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) struct Alike {
    pub(crate) at: usize,
    pub(crate) length: usize,
    pub(crate) likeness: Likeness,
}

/// The look-alike characters of a line, in their order.
pub(in crate::program) fn alike(line: &[u8]) -> Vec<Alike> {
    let mut found = Vec::new();
    if line.is_ascii() {
        return found;
    }
    let mut add = |at, length, character: Option<char>| {
        found.extend(character.and_then(likeness).map(|likeness| Alike {
            at,
            length,
            likeness,
        }));
    };
    if let Ok(text) = std::str::from_utf8(line) {
        text.char_indices()
            .for_each(|(at, character)| add(at, character.len_utf8(), Some(character)));
        return found;
    }
    let mut at = 0;
    while let Some(rest) = line.get(at..).filter(|rest| !rest.is_empty()) {
        let length = match rest {
            [0x81..=0xfe, 0x40..=0xfe, ..] => 2,
            _ => 1,
        };
        let (text, _) = GBK.decode_without_bom_handling(&rest[..length]);
        add(at, length, text.chars().next());
        at += length;
    }
    found
}

fn likeness(character: char) -> Option<Likeness> {
    Some(match character {
        wide @ '\u{ff01}'..='\u{ff5e}' => Likeness::FullWidth((wide as u32 - 0xff01 + 0x21) as u8),
        '\u{a0}' | '\u{2000}'..='\u{200b}' | '\u{202f}' | '\u{205f}' | '\u{3000}' | '\u{feff}' => {
            Likeness::Space
        }
        '\u{3001}' => Likeness::FullWidth(b','),
        '\u{3002}' => Likeness::FullWidth(b'.'),
        '\u{2212}' | '\u{2013}' => Likeness::FullWidth(b'-'),
        letter => Likeness::Foreign(foreign(letter)?),
    })
}

/// Letters that look like one of a program.
fn foreign(letter: char) -> Option<u8> {
    Some(match letter {
        'А' | 'Α' => b'A',
        'а' => b'a',
        'В' | 'в' | 'Β' => b'B',
        'С' => b'C',
        'с' => b'c',
        'Е' | 'Ε' => b'E',
        'е' => b'e',
        'Ԍ' => b'G',
        'Н' | 'Η' => b'H',
        'І' | 'Ι' => b'I',
        'Ј' => b'J',
        'К' => b'K',
        'М' | 'Μ' => b'M',
        'Ν' => b'N',
        'О' | 'о' | 'Ο' => b'O',
        'Р' => b'P',
        'р' => b'p',
        'Ѕ' => b'S',
        'Т' | 'Τ' => b'T',
        'Х' | 'Χ' => b'X',
        'х' => b'x',
        'У' | 'Υ' | 'Ү' => b'Y',
        'у' => b'y',
        _ => return None,
    })
}

/// The line with its marks and spaces as a controller needs them, each in place; `None` where nothing changes. Letters
/// and digits stay.
pub(in crate::program) fn with_plain_marks(line: &[u8]) -> Option<Vec<u8>> {
    let marks: Vec<Alike> = alike(line)
        .into_iter()
        .filter(|found| !found.likeness.is_letter())
        .collect();
    (!marks.is_empty()).then(|| {
        let mut plain = line.to_vec();
        for mark in marks {
            plain[mark.at..mark.at + mark.length].fill(b' ');
            plain[mark.at] = mark.likeness.ascii();
        }
        plain
    })
}

/// The line in plain letters, digits, marks and spaces.
pub(in crate::program) fn in_plain_letters(line: &[u8], alike: &[Alike]) -> Vec<u8> {
    let mut plain = Vec::with_capacity(line.len());
    let mut from = 0;
    for found in alike {
        plain.extend_from_slice(line.get(from..found.at).unwrap_or_default());
        plain.push(found.likeness.ascii());
        from = found.at + found.length;
    }
    plain.extend_from_slice(line.get(from..).unwrap_or_default());
    plain
}

/// How many bytes the wide space has that a text begins with; 0 where there is none.
pub(in crate::program) fn wide_space(text: &[u8]) -> usize {
    let mut head = text.get(..4).unwrap_or(text).utf8_chunks();
    let first = head.next().and_then(|head| head.valid().chars().next());
    first
        .filter(|first| likeness(*first) == Some(Likeness::Space))
        .map_or(0, char::len_utf8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_are_told_by_their_looks() {
        let plain = |line: &[u8]| String::from_utf8(in_plain_letters(line, &alike(line))).unwrap();
        assert_eq!(
            plain("（１）Ｂ９９00В0\u{3000}\u{a0}N8：ＤＤ".as_bytes()),
            "(1)B9900B0  N8:DD"
        );
        assert_eq!(plain("Х−1。5 у–2 Ԍ".as_bytes()), "X-1.5 y-2 G");
        // The same in GBK.
        assert_eq!(plain(b"\xa7\xa39900\xa6\xa2"), "B9900B");
        assert_eq!(plain(b"\xa7\xae02\xa1\xa3\xa7\xe7"), "M02.x");
        assert_eq!(plain(b"\xa3\xa81\xa3\xa9\xa3\xc29\xa1\xa1"), "(1)B9 ");
        assert_eq!(alike("直线 é".as_bytes()), []);
        assert_eq!(with_plain_marks("（1）B".as_bytes()).unwrap(), b"(  1)  B");
        assert_eq!(with_plain_marks("Ｂ".as_bytes()), None);
        for (text, length) in [
            ("\u{a0}B", 2),
            ("\u{205f}B", 3),
            ("\u{3000}", 3),
            ("Ｂ", 0),
            ("", 0),
        ] {
            assert_eq!(wide_space(text.as_bytes()), length, "{text:?}");
        }
    }
}
