//! The text of a document in the body of its message: one string of many megabytes with an escape in each line, read on all cores.
//!
//! The parser reads what is left of the body, and all of it where anything is unusual: a string that is not valid, escapes by number.

use rayon::prelude::*;
use serde_json::Value;
use std::ops::Range;

/// Shorter strings are left to the parser.
const LONG: usize = if cfg!(test) { 32 } else { 1024 * 1024 };
/// The text is among this many first strings of a body.
const FIRST: usize = 64;
/// The most bytes that may be left of such a body.
const REST: usize = 64 * 1024;
/// Bytes that are read in one piece.
const PIECE: usize = if cfg!(test) { 8 } else { 1024 * 1024 };

/// Takes the place of the long string while the rest is read.
const IN_ITS_PLACE: &str = "the-long-string";

/// Reads a body with a long string; `None` where the parser had better read all of it.
pub(super) fn parse(body: &[u8]) -> Option<Value> {
    let Range { start, end } = long_string(body)?;
    let (before, behind) = (body.get(..start)?, body.get(end..)?);
    if before.len() + behind.len() > REST {
        return None;
    }
    let rest = [before, IN_ITS_PLACE.as_bytes(), behind].concat();
    let mut value: Value = serde_json::from_slice(&rest).ok()?;
    let mut text = Some(unescaped(body.get(start..end)?)?);
    let places = put_in_place(&mut value, &mut text);
    // It may be a key, or another value under the same key may have replaced it.
    (places == 1).then_some(value)
}

/// The first long string of a body, without its quotes.
fn long_string(body: &[u8]) -> Option<Range<usize>> {
    let mut at = 0;
    for _ in 0..FIRST {
        if body.len() - at < LONG {
            return None;
        }
        let start = quote_from(body, at)? + 1;
        let mut end = quote_from(body, start)?;
        while backslashes_before(body.get(start..end)?) % 2 == 1 {
            end = quote_from(body, end + 1)?;
        }
        if end - start >= LONG {
            return Some(start..end);
        }
        at = end + 1;
    }
    None
}

fn quote_from(body: &[u8], from: usize) -> Option<usize> {
    Some(from + memchr::memchr(b'"', body.get(from..)?)?)
}

/// The number of backslashes that a text ends with.
fn backslashes_before(text: &[u8]) -> usize {
    text.iter().rev().take_while(|&&byte| byte == b'\\').count()
}

/// What a string says; `None` where it is not valid or has escapes by number.
fn unescaped(string: &[u8]) -> Option<String> {
    let mut pieces = Vec::with_capacity(string.len() / PIECE + 1);
    let mut rest = string;
    while rest.len() > PIECE {
        let (piece, _) = rest.split_at_checked(PIECE)?;
        // No escape is cut in two.
        let end = PIECE + backslashes_before(piece) % 2;
        let (piece, behind) = rest.split_at_checked(end)?;
        pieces.push(piece);
        rest = behind;
    }
    pieces.push(rest);
    let read: Option<Vec<Vec<u8>>> = pieces.into_par_iter().map(unescaped_piece).collect();
    let read = read?;
    let mut text = Vec::with_capacity(read.iter().map(Vec::len).sum());
    read.iter().for_each(|piece| text.extend_from_slice(piece));
    String::from_utf8(text).ok()
}

/// The same for a piece that begins and ends between two characters or escapes; in bytes.
fn unescaped_piece(mut rest: &[u8]) -> Option<Vec<u8>> {
    // Words are written whole, also where only their beginning is plain.
    let mut out = vec![0; rest.len() + WORD];
    let mut room = out.as_mut_slice();
    while let Some((&first, behind)) = rest.split_first() {
        if let Some(word) = rest.first_chunk::<WORD>() {
            *room.first_chunk_mut::<WORD>()? = *word;
            let plain = plain_bytes(u64::from_le_bytes(*word));
            if plain > 0 {
                (rest, room) = (rest.get(plain..)?, room.get_mut(plain..)?);
                continue;
            }
        }
        let (byte, length) = match (first, behind.first()) {
            (b'\\', Some(&escape)) => (escaped(escape)?, 2),
            (b'\\' | ..b' ', _) => return None,
            (plain, _) => (plain, 1),
        };
        *room.first_mut()? = byte;
        (rest, room) = (rest.get(length..)?, room.get_mut(1..)?);
    }
    let left = room.len();
    out.truncate(out.len() - left);
    Some(out)
}

/// The byte that a backslash and this letter stand for.
fn escaped(letter: u8) -> Option<u8> {
    Some(match letter {
        b'n' => b'\n',
        b'r' => b'\r',
        b't' => b'\t',
        b'b' => 8,
        b'f' => 12,
        b'"' | b'\\' | b'/' => letter,
        _ => return None,
    })
}

/// Bytes that are looked at together.
const WORD: usize = 8;

/// The number of bytes of a word before the first that is a backslash or a control character; the first byte is the lowest one.
fn plain_bytes(word: u64) -> usize {
    const ONES: u64 = u64::from_le_bytes([1; WORD]);
    const HIGH: u64 = ONES << 7;
    // The highest bit of each byte below a limit: above the first such byte also of some others.
    let below = |word: u64, limit: u64| word.wrapping_sub(ONES * limit) & !word & HIGH;
    let others = word ^ (ONES * b'\\' as u64);
    let found = below(word, b' '.into()) | below(others, 1);
    (found.trailing_zeros() / 8) as usize
}

/// Puts the text in the first place that is kept for it. Returns the number of such places.
fn put_in_place(value: &mut Value, text: &mut Option<String>) -> usize {
    match value {
        Value::String(string) if string == IN_ITS_PLACE => {
            if let Some(text) = text.take() {
                *string = text;
            }
            1
        }
        Value::Array(values) => values
            .iter_mut()
            .map(|value| put_in_place(value, text))
            .sum(),
        Value::Object(values) => values
            .values_mut()
            .map(|value| put_in_place(value, text))
            .sum(),
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_long_string_is_read_as_the_parser_reads_it(
            pieces in prop::collection::vec(
                prop::sample::select(vec![
                    "0\\n", "LINE\\n", "\\\\", "\\\"", "\\/", "\\t", "\\r\\n", "12.5", " ", "ä", "模", "\\b\\f", "\\u00e4", "\\q", "\n", "\"", "\u{7f}",
                ]),
                0..60,
            ),
            weights in prop::collection::vec(0..6usize, 60),
            head in prop::sample::select(vec![
                r#"{"a":"#, r#"{"a":["","the-long-string","#, r#"{"a":1,"a":"#, r#"{"\"":[{"b":"#, "[", "{",
            ]),
            tail in prop::sample::select(vec!["}", r#","a":2}"#, "}]}", "]", ":1}", ""]),
        ) {
            // The unusual ones are in few of the strings.
            let unusual = ["\\u00e4", "\\q", "\n", "\""];
            let each = pieces.iter().zip(&weights);
            let text: String = each
                .filter(|(piece, weight)| **weight == 0 || !unusual.contains(*piece))
                .map(|(piece, _)| *piece)
                .collect();
            let body = format!("{head}\"{text}\"{tail}");
            if let Some(read) = parse(body.as_bytes()) {
                prop_assert_eq!(serde_json::from_str::<Value>(&body).ok(), Some(read), "{}", body);
            }
        }
    }

    #[test]
    fn what_is_usual_is_read_here() {
        let text = "  0\\r\\nLINE\\n 10\\n1.0\\n\\\\ \\\" ä\\n".repeat(9);
        let body = format!(r#"{{"jsonrpc":"2.0","params":{{"uri":"a\\","text":"{text}"}}}}"#);
        let read = parse(body.as_bytes());
        assert_eq!(read, serde_json::from_str(&body).ok());
        assert!(read.is_some());
    }

    #[test]
    fn what_is_unusual_is_left_to_the_parser() {
        let long = "0\\n".repeat(20);
        for body in [
            format!(r#"["{long}\u0041"]"#),
            format!(r#"["{long}\x"]"#),
            format!("[\"{long}\n\"]"),
            format!(r#"["{long}"#),
            format!(r#"["{long}\"]"#),
            format!(r#"{{"{long}":1}}"#),
            format!(r#"{{"a":"{long}","a":1}}"#),
            format!(r#"["the-long-string","{long}"]"#),
            r#"["short"]"#.into(),
        ] {
            assert_eq!(parse(body.as_bytes()), None, "{body}");
        }
        assert_eq!(
            parse(&[b"[\"".as_slice(), &[0xff; 40], b"\"]"].concat()),
            None
        );
    }
}
