//! Characters that look like those of a program but differ: full-width forms, wide spaces, dashes, Cyrillic and Greek
//! letters; in UTF-8, and in GBK, which editors of Chinese Windows write.

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
    let is_utf_8 = std::str::from_utf8(line).is_ok();
    let mut at = 0;
    while let Some(rest) = line.get(at..).filter(|rest| !rest.is_empty()) {
        if rest[0] < 0x80 {
            at += 1;
            continue;
        }
        let (likeness, length) = if is_utf_8 {
            in_utf_8(rest)
        } else {
            in_gbk(rest)
        };
        found.extend(likeness.map(|likeness| Alike {
            at,
            length,
            likeness,
        }));
        at += length;
    }
    found
}

fn in_utf_8(rest: &[u8]) -> (Option<Likeness>, usize) {
    let length = match rest[0] {
        0xf0.. => 4,
        0xe0.. => 3,
        _ => 2,
    };
    let character = rest
        .get(..length)
        .and_then(|bytes| std::str::from_utf8(bytes).ok())
        .and_then(|text| text.chars().next());
    let likeness = match character {
        Some(wide @ '\u{ff01}'..='\u{ff5e}') => {
            Some(Likeness::FullWidth((wide as u32 - 0xff01 + 0x21) as u8))
        }
        Some(
            '\u{a0}' | '\u{2000}'..='\u{200b}' | '\u{202f}' | '\u{205f}' | '\u{3000}' | '\u{feff}',
        ) => Some(Likeness::Space),
        Some('\u{3001}') => Some(Likeness::FullWidth(b',')),
        Some('\u{3002}') => Some(Likeness::FullWidth(b'.')),
        Some('\u{2212}' | '\u{2013}') => Some(Likeness::FullWidth(b'-')),
        Some(letter) => foreign(letter).map(Likeness::Foreign),
        None => None,
    };
    (likeness, length)
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

fn in_gbk(rest: &[u8]) -> (Option<Likeness>, usize) {
    match *rest {
        [0xa3, low @ 0xa1..=0xfe, ..] => (Some(Likeness::FullWidth(low - 0x80)), 2),
        [0xa1, 0xa1, ..] => (Some(Likeness::Space), 2),
        [0xa1, 0xa2, ..] => (Some(Likeness::FullWidth(b',')), 2),
        [row @ (0xa6 | 0xa7), low, ..] => (foreign_in_gbk(row, low).map(Likeness::Foreign), 2),
        [0x81..=0xfe, 0x40..=0xfe, ..] => (None, 2),
        _ => (None, 1),
    }
}

/// The same letters of the Greek and the Cyrillic row of GBK.
fn foreign_in_gbk(row: u8, low: u8) -> Option<u8> {
    Some(match (row, low) {
        (0xa7, 0xa3 | 0xd3) | (0xa6, 0xa2) => b'B',
        (0xa7, 0xb7 | 0xe7) | (0xa6, 0xb6) => b'X',
        (0xa7, 0xb5 | 0xe5) | (0xa6, 0xb4) => b'Y',
        (0xa7, 0xb0 | 0xe0) | (0xa6, 0xaf) => b'O',
        (0xa7, 0xa6 | 0xd6) | (0xa6, 0xa5) => b'E',
        (0xa7, 0xa1 | 0xd1) | (0xa6, 0xa1) => b'A',
        (0xa6, 0xad) => b'N',
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
    match text.first().map(|_| in_utf_8(text)) {
        Some((Some(Likeness::Space), length)) => length,
        _ => 0,
    }
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
