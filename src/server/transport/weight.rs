//! The memory that a JSON text would take as a tree of values, counted before the tree is built.
//!
//! A short text can be a large tree: `[],[],…` takes 26 times its own length. Nothing here checks the text; the parser
//! refuses invalid JSON.

/// Slots of a list that is not empty: its first allocation.
const LIST: u64 = 4;
/// The same for an object, whose entries have keys and a table beside them.
const OBJECT: u64 = 8;
/// A tree may take this many slots of some 72 bytes: a good gigabyte. A polyline of a million vertices with bulges
/// takes seven millions.
pub(super) const LIMIT: u64 = 16_000_000;

/// True where the tree of `json` would take more than [`LIMIT`].
pub(super) fn is_too_heavy(json: &[u8]) -> bool {
    // No byte takes more than an object, and few bytes of a long text take anything.
    if (json.len() as u64).saturating_mul(OBJECT) <= LIMIT || weighing(json) * OBJECT <= LIMIT {
        return false;
    }
    let mut weight = 0;
    let mut rest = json;
    while let Some((&byte, behind)) = rest.split_first() {
        rest = behind;
        match byte {
            b'"' => rest = behind_string(rest),
            b'[' => weight += LIST,
            b'{' => weight += OBJECT,
            b',' | b':' => weight += 1,
            _ => continue,
        }
        if weight > LIMIT {
            return true;
        }
    }
    false
}

/// The number of bytes that take something where they are not in a string. The counters are bytes,
/// of which a processor adds many at once.
fn weighing(json: &[u8]) -> u64 {
    let weighs = |byte: &u8| u8::from(matches!(byte, b'[' | b'{' | b',' | b':'));
    let parts = json.chunks(u8::MAX.into());
    parts
        .map(|part| u64::from(part.iter().map(weighs).sum::<u8>()))
        .sum()
}

/// The text after the end of a string; empty where it does not end.
fn behind_string(mut rest: &[u8]) -> &[u8] {
    while let Some(at) = memchr::memchr2(b'"', b'\\', rest) {
        let behind = rest.get(at..).unwrap_or_default();
        if let [b'"', behind @ ..] = behind {
            return behind;
        }
        rest = behind.get(2..).unwrap_or_default();
    }
    &[]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_and_objects_weigh_and_strings_do_not() {
        let check = |json: String, expected: bool| {
            assert_eq!(is_too_heavy(json.as_bytes()), expected, "{}…", &json[..40])
        };
        check(format!("[{}[]]", "[],".repeat(4_000_000)), true);
        check(format!("[{}{{}}]", "{},".repeat(2_000_000)), true);
        check(format!("[{}1]", "1,".repeat(17_000_000)), true);
        check("[".repeat(5_000_000), true);
        check(format!("{{{}\"a\":1}}", "\"a\":1,".repeat(9_000_000)), true);
        check(
            format!("[{}[]]", "[106.243,92.283,0.41421356],".repeat(1_000_000)),
            false,
        );
        check(
            format!("{{\"text\":\"{}\"}}", "[],\\\"[".repeat(5_000_000)),
            false,
        );
        check(format!("\"{}", "[],".repeat(9_000_000)), false);
        let of_dxf = "  0\\nLINE\\n 10\\n1.0\\n".repeat(200_000);
        check(format!("{{\"text\":\"{of_dxf}\"}}"), false);
    }

    #[test]
    fn a_slot_is_what_it_is_taken_for() {
        assert!(size_of::<serde_json::Value>() <= 72);
    }
}
