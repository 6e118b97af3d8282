//! Translates binary DXF to the equivalent text, so that one reader reads both.
//!
//! Source: DXF reference, "Binary DXF files".

use super::value_type::ValueType;

/// The first bytes of a binary file.
const SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// The same after a program has turned each CR LF into LF, as in a text file. A number that held CR
/// LF by chance has lost a byte, and the tags after it are out of step.
const AS_TEXT: &[u8] = b"AutoCAD Binary DXF\n\x1a\0";

/// The first bytes of the file, where it is binary DXF.
pub(super) fn sentinel(bytes: &[u8]) -> Option<&'static [u8]> {
    [SENTINEL, AS_TEXT]
        .into_iter()
        .find(|sentinel| bytes.starts_with(sentinel))
}

/// True where the file was transferred as if it were text.
pub(super) fn is_mangled(bytes: &[u8]) -> bool {
    bytes.starts_with(AS_TEXT)
}

/// The file as text, one tag on two lines; and the fault, where the tags break off.
pub(super) fn to_text(bytes: &[u8]) -> (Vec<u8>, Option<String>) {
    let mut tags = Tags {
        bytes,
        at: sentinel(bytes).map_or(0, <[u8]>::len),
        wide: false,
    };
    // Since release 13 a code has two bytes. The first code is 0 (a record) or 999 (a comment).
    tags.wide = matches!(bytes.get(tags.at..tags.at + 2), Some([0, 0] | [0xe7, 0x03]));
    let mut text = Vec::with_capacity(bytes.len() * 2);
    loop {
        let begins_at = tags.at;
        let Some(code) = tags.code() else {
            let cut = begins_at < bytes.len();
            return (
                text,
                cut.then(|| say!(byte_the_file_ends_inside_a_group, begins_at)),
            );
        };
        let (mark, code_text) = (text.len(), code.to_string());
        text.extend_from_slice(code_text.as_bytes());
        text.push(b'\n');
        if let Err(sentence) = tags.value(code, &mut text) {
            text.truncate(mark);
            return (text, Some(say!(in_byte, begins_at, sentence)));
        }
        let is_end = code == 0 && text.ends_with(b"\nEOF");
        text.push(b'\n');
        if is_end {
            return (text, None);
        }
    }
}

struct Tags<'a> {
    bytes: &'a [u8],
    at: usize,
    wide: bool,
}

impl<'a> Tags<'a> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let taken = *self.bytes.get(self.at..)?.first_chunk::<N>()?;
        self.at += N;
        Some(taken)
    }

    fn code(&mut self) -> Option<i16> {
        if self.wide {
            return self.take().map(i16::from_le_bytes);
        }
        match self.take::<1>()? {
            // A two-byte code follows.
            [255] => self.take().map(i16::from_le_bytes),
            [code] => Some(i16::from(code)),
        }
    }

    /// Writes the value after `code`; an error says why there is none.
    fn value(&mut self, code: i16, text: &mut Vec<u8>) -> Result<(), String> {
        let cut = || say!(the_file_ends_inside_the_value_of_group_code, code);
        let value_type = ValueType::of(code).ok_or_else(|| say!(group_code_is_not_known, code))?;
        let written = match value_type {
            ValueType::Text => {
                let rest = self.bytes.get(self.at..).unwrap_or_default();
                let end = memchr::memchr(0, rest).ok_or_else(cut)?;
                // A line end within a value would begin another line.
                let plain = |&byte: &u8| match byte {
                    b'\r' | b'\n' => b' ',
                    byte => byte,
                };
                text.extend(rest.iter().take(end).map(plain));
                self.at += end + 1;
                return Ok(());
            }
            ValueType::Bytes => {
                let [length] = self.take::<1>().ok_or_else(cut)?;
                let end = self.at + usize::from(length);
                let chunk = self.bytes.get(self.at..end).ok_or_else(cut)?;
                self.at = end;
                for byte in chunk {
                    text.extend_from_slice(format!("{byte:02X}").as_bytes());
                }
                return Ok(());
            }
            ValueType::Real => {
                let number = self.take().map(f64::from_le_bytes);
                number.map(|number| format!("{number:?}"))
            }
            ValueType::Flag => self.take::<1>().map(|[byte]| byte.to_string()),
            ValueType::Short => self
                .take()
                .map(|bytes| i16::from_le_bytes(bytes).to_string()),
            ValueType::Long => self
                .take()
                .map(|bytes| i32::from_le_bytes(bytes).to_string()),
            ValueType::Huge => self
                .take()
                .map(|bytes| i64::from_le_bytes(bytes).to_string()),
        };
        text.extend_from_slice(written.ok_or_else(cut)?.as_bytes());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(tags: &[u8]) -> Vec<u8> {
        [SENTINEL, tags].concat()
    }

    #[test]
    fn both_widths_of_codes_and_all_lengths_of_values() {
        let half = 0.5f64.to_le_bytes();
        let narrow = [
            b"\0LINE\0\x0a".as_slice(),
            &half,
            b"\x3e\xff\xff\xff\xe8\x03APP\0\0EOF\0",
        ]
        .concat();
        let wide = [
            b"\0\0LINE\0\x0a\0".as_slice(),
            &half,
            b"\x3e\0\xff\xff\x5a\0\x01\0\0\0\x22\x01\x01\x36\x01\x02\xab\x01\xa0\0\x02\0\0\0\0\0\0\0\0\0EOF\0",
        ]
        .concat();
        for (tags, expected) in [
            (narrow, "0\nLINE\n10\n0.5\n62\n-1\n1000\nAPP\n0\nEOF\n"),
            (
                wide,
                "0\nLINE\n10\n0.5\n62\n-1\n90\n1\n290\n1\n310\nAB01\n160\n2\n0\nEOF\n",
            ),
        ] {
            let (text, fault) = to_text(&file(&tags));
            assert_eq!(
                (String::from_utf8(text).unwrap().as_str(), fault),
                (expected, None)
            );
        }
    }

    #[test]
    fn a_file_that_is_cut_anywhere_has_one_finding() {
        let number = 1.5f64.to_le_bytes();
        let mut tags = b"\0\0SECTION\0\x02\0ENTITIES\0\0\0LINE\0".to_vec();
        for code in [10u8, 20, 11, 21] {
            tags.extend([code, 0]);
            tags.extend(number);
        }
        tags.extend(b"\0\0ENDSEC\0\0\0EOF\0");
        let whole = file(&tags);
        for length in SENTINEL.len()..=whole.len() {
            let document = crate::dxf::Document::read_file(whole[..length].to_vec());
            let syntax = document
                .findings()
                .iter()
                .filter(|finding| finding.rule == crate::finding::Rule::Syntax);
            assert_eq!(
                syntax.count(),
                usize::from(length < whole.len()),
                "{length}: {:?}",
                document.findings()
            );
        }
    }

    #[test]
    fn a_file_that_was_handled_as_a_text_is_read_and_said() {
        let tags = b"\0SECTION\0\x02ENTITIES\0\0LINE\0";
        let number = |code: u8, value: f64| [&[code][..], &value.to_le_bytes()].concat();
        let line = [
            number(10, 1.0),
            number(20, 2.0),
            number(11, 3.0),
            number(21, 4.0),
        ]
        .concat();
        let whole = [AS_TEXT, tags, &line, b"\0ENDSEC\0\0EOF\0"].concat();
        let document = crate::dxf::Document::read_file(whole);
        let said: Vec<_> = document
            .findings()
            .iter()
            .filter(|finding| finding.rule == crate::finding::Rule::Syntax)
            .collect();
        assert_eq!((document.drawing().len(), said.len()), (1, 1), "{said:?}");
        assert_eq!(said[0].severity, crate::finding::Severity::Warning);
    }

    #[test]
    fn what_breaks_off_is_named() {
        for (tags, expected) in [
            (
                &b"\0\0LINE\0\x0a\0\0\0"[..],
                "byte 29: the file ends inside the value of group code 10",
            ),
            (
                b"\0\0LINE\0\x0a",
                "byte 29: the file ends inside a group code",
            ),
            (
                b"\0\0LINE",
                "byte 22: the file ends inside the value of group code 0",
            ),
            (
                b"\0\0LINE\0\x10\x27",
                "byte 29: group code 10000 is not known, so the length of its value is not",
            ),
        ] {
            assert_eq!(to_text(&file(tags)).1.as_deref(), Some(expected));
        }
    }
}
