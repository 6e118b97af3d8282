//! `--output lisp`: an answer as one S-expression that AutoLISP's `read` takes.
//!
//! It is a list of *items*, lists whose first element says what they are: `(finding (rule . "gap") …)`. Each item is one line, so that
//! a client may also read line by line. Keys are symbols with hyphens, numbers of lengths have a point and no exponent, `nil` is false
//! and "none".

use super::options::LispEncoding;
use super::{Failure, output};
use crate::dxf::{EntityChange, Group, GroupValue};
use crate::message::is_hidden;
use serde::Serialize;
use serde_json::Value;

/// The items so far, in characters that the encoding has.
pub(crate) struct Answer {
    text: String,
    encoding: LispEncoding,
}

impl Answer {
    /// The answer of a command; its first item names it and the version.
    pub(crate) fn new(command: &str, encoding: LispEncoding) -> Answer {
        let mut answer = Answer {
            text: String::from("(\n"),
            encoding,
        };
        let version = env!("CARGO_PKG_VERSION");
        answer.push(
            "wedm",
            &serde_json::json!({ "version": version, "command": command }),
        );
        answer
    }

    /// An item with the fields of `value`, which is an object.
    pub(crate) fn push(&mut self, kind: &str, value: &impl Serialize) {
        self.push_with(kind, value, "");
    }

    /// The same with more, which is written already.
    pub(crate) fn push_with(&mut self, kind: &str, value: &impl Serialize, more: &str) {
        let value = serde_json::to_value(value).unwrap_or_default();
        let item = format!("({kind}{}{more})\n", self.fields(&value));
        self.text.push_str(&item);
    }

    /// An item for each entity that changes, goes or comes.
    pub(crate) fn push_changes(&mut self, changes: &[EntityChange]) {
        for change in changes {
            let item = self.change(change);
            self.text.push_str(&item);
            self.text.push('\n');
        }
    }

    /// Why a file, or all of it, came to nothing.
    pub(crate) fn push_failure(&mut self, failure: &Failure) {
        self.push("failure", &serde_json::json!({ "message": failure.0 }));
    }

    pub(crate) fn print(mut self) -> Result<(), Failure> {
        self.text.push_str(")\n");
        match self.encoding {
            LispEncoding::Gbk => output::print_bytes(&encoding_rs::GBK.encode(&self.text).0),
            LispEncoding::Utf8 | LispEncoding::Ascii => output::print_bytes(self.text.as_bytes()),
        }
    }

    /// `(entmod "2A" (10 …) …)`, `(entdel "2A")` or `(entmake "2A" (0 . "LINE") …)`, where 2A is an entity that the new one looks like.
    pub(crate) fn change(&self, change: &EntityChange) -> String {
        match change {
            EntityChange::Set { handle, groups } => {
                format!("(entmod {}{})", self.string(handle), self.groups(groups))
            }
            EntityChange::Remove { handle } => format!("(entdel {})", self.string(handle)),
            EntityChange::Make { like, groups } => {
                format!("(entmake {}{})", self.string(like), self.groups(groups))
            }
        }
    }

    /// ` (0 . "LINE") (10 1.0 2.0 0.0)`
    pub(crate) fn groups(&self, groups: &[Group]) -> String {
        let one = |(code, value): &Group| match value {
            GroupValue::Text(text) => format!(" ({code} . {})", self.string(text)),
            GroupValue::Whole(whole) => format!(" ({code} . {whole})"),
            GroupValue::Real(value) => format!(" ({code} . {})", real(*value)),
            GroupValue::Point(at) => {
                let at: Vec<String> = at.iter().copied().map(real).collect();
                format!(" ({code} {})", at.join(" "))
            }
        };
        groups.iter().map(one).collect()
    }

    /// ` (fixes ((title . "…") …) …)`, each element written already.
    pub(crate) fn list(key: &str, elements: &[String]) -> String {
        match elements.is_empty() {
            true => String::new(),
            false => format!(" ({key} {})", elements.join(" ")),
        }
    }

    /// ` (rule . "gap") (at 1.0 2.0)` of an object.
    pub(crate) fn fields(&self, value: &Value) -> String {
        let Value::Object(fields) = value else {
            return String::new();
        };
        let one = |(key, value): (&String, &Value)| {
            let key = symbol(key);
            match value {
                Value::Array(_) | Value::Object(_) => {
                    let list = self.value(value);
                    let inner = list.strip_prefix('(').unwrap_or(&list);
                    match inner == ")" {
                        true => format!(" ({key})"),
                        false => format!(" ({key} {inner}"),
                    }
                }
                value => format!(" ({key} . {})", self.value(value)),
            }
        };
        fields.iter().map(one).collect()
    }

    fn value(&self, value: &Value) -> String {
        match value {
            Value::Null | Value::Bool(false) => "nil".into(),
            Value::Bool(true) => "T".into(),
            Value::String(text) => self.string(text),
            Value::Number(number) => match number.as_i64().map(i32::try_from) {
                Some(Ok(whole)) => whole.to_string(),
                _ => real(number.as_f64().unwrap_or_default()),
            },
            Value::Array(all) => {
                let all: Vec<String> = all.iter().map(|one| self.value(one)).collect();
                format!("({})", all.join(" "))
            }
            Value::Object(_) => format!("({})", self.fields(value).trim_start()),
        }
    }

    /// A string in quotation marks. What the encoding has not becomes `\U+XXXX`, which is how AutoCAD writes such a character in
    /// a drawing and what it shows as that character.
    fn string(&self, text: &str) -> String {
        let mut out = String::from("\"");
        for character in text.chars() {
            match character {
                '"' | '\\' => out.extend(['\\', character]),
                '\n' => out.push_str("\\n"),
                '\r' => out.push_str("\\r"),
                '\t' => out.push_str("\\t"),
                '\u{1b}' => out.push_str("\\e"),
                control if control.is_ascii_control() => {
                    out.push_str(&format!("\\{:03o}", u32::from(control)));
                }
                character if self.has(character) => out.push(character),
                other => {
                    let units = &mut [0; 2];
                    for unit in other.encode_utf16(units) {
                        out.push_str(&format!("\\\\U+{unit:04X}"));
                    }
                }
            }
        }
        out.push('"');
        out
    }

    fn has(&self, character: char) -> bool {
        if character.is_ascii() || is_hidden(character) {
            return character.is_ascii();
        }
        match self.encoding {
            LispEncoding::Utf8 => true,
            LispEncoding::Ascii => false,
            LispEncoding::Gbk => {
                let units = &mut [0; 4];
                let (bytes, _, is_lost) = encoding_rs::GBK.encode(character.encode_utf8(units));
                // A second byte that is a backslash begins an escape for a reader that goes byte by byte.
                !is_lost && !bytes.contains(&b'\\')
            }
        }
    }
}

/// `stockLeft` → `stock-left`
fn symbol(key: &str) -> String {
    let mut symbol = String::new();
    for letter in key.chars() {
        if letter.is_ascii_uppercase() {
            symbol.push('-');
        }
        symbol.push(letter.to_ascii_lowercase());
    }
    symbol
}

/// A number with a point and without an exponent.
fn real(value: f64) -> String {
    let digits = value.to_string();
    match digits.contains('.') {
        true => digits,
        false => digits + ".0",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(encoding: LispEncoding) -> Answer {
        Answer::new("check", encoding)
    }

    #[test]
    fn strings_are_what_autolisp_reads() {
        let check = |encoding, text: &str, expected: &str| {
            assert_eq!(answer(encoding).string(text), expected, "{text:?}");
        };
        check(LispEncoding::Utf8, "模 \"a\\b\"", "\"模 \\\"a\\\\b\\\"\"");
        check(
            LispEncoding::Utf8,
            "a\nb\tc\r\u{1b}\u{7}",
            "\"a\\nb\\tc\\r\\e\\007\"",
        );
        check(LispEncoding::Utf8, "\u{202e}", "\"\\\\U+202E\"");
        check(LispEncoding::Gbk, "模ﬀ", "\"模\\\\U+FB00\"");
        check(
            LispEncoding::Ascii,
            "Ø😀",
            "\"\\\\U+00D8\\\\U+D83D\\\\U+DE00\"",
        );
        // Its second byte in GBK is a backslash.
        let (bytes, ..) = encoding_rs::GBK.encode("誠");
        assert_eq!(bytes[1], b'\\');
        check(LispEncoding::Gbk, "誠", "\"\\\\U+8AA0\"");
    }

    #[test]
    fn numbers_have_a_point_and_no_exponent() {
        let expected = [
            (0.0, "0.0"),
            (-3.0, "-3.0"),
            (1e-7, "0.0000001"),
            (1e21, "1000000000000000000000.0"),
            (0.1 + 0.2, "0.30000000000000004"),
        ];
        for (value, text) in expected {
            assert_eq!(real(value), text);
        }
    }

    #[test]
    fn objects_are_association_lists() {
        let value = serde_json::json!({
            "stockLeft": 0.5, "segment": 3, "large": 4_000_000_000_u32, "at": [1.0, 2.0], "none": null, "is": true,
            "related": [{ "handle": "2A" }, { "handle": "2B", "segment": 0 }], "empty": [], "inner": { "a": 1 },
        });
        let expected = [
            " (at 1.0 2.0)",
            " (empty)",
            " (inner (a . 1))",
            " (is . T)",
            " (large . 4000000000.0)",
            " (none . nil)",
            " (related ((handle . \"2A\")) ((handle . \"2B\") (segment . 0)))",
            " (segment . 3)",
            " (stock-left . 0.5)",
        ];
        let written = answer(LispEncoding::Utf8).fields(&value);
        for field in expected {
            assert!(written.contains(field), "{field} in {written}");
        }
        assert_eq!(written.len(), expected.concat().len());
    }
}
