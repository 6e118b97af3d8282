//! Changes of documents in what could not be read: whoever made them no longer has the text that the server has.

use memchr::memmem;

/// The documents whose change may be lost, by the URIs that stand beside it; none where that is unknown, which is any.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct LostChange {
    pub(crate) uris: Vec<String>,
}

/// The ends of the names of `textDocument/didChange` and `wedm/didChangeDrawing`; the slash may be escaped.
const METHODS: [&[u8]; 2] = [b"didChange\"", b"didChangeDrawing\""];
/// The most URIs that are looked for.
const MOST: usize = 16;

/// The change in bytes that are no sound message, if there is one.
pub(super) fn lost_change(bytes: &[u8]) -> Option<LostChange> {
    let is_there = |name: &[u8]| memmem::find(bytes, name).is_some();
    if !METHODS.iter().any(|name| is_there(name)) {
        return None;
    }
    let uris = memmem::find_iter(bytes, b"\"uri\"")
        .filter_map(|at| value_behind(bytes.get(at + 5..)?))
        .take(MOST);
    Some(LostChange {
        uris: uris.collect(),
    })
}

/// The string behind a colon.
fn value_behind(bytes: &[u8]) -> Option<String> {
    let value = bytes.trim_ascii_start().strip_prefix(b":")?;
    let mut values = serde_json::Deserializer::from_slice(value).into_iter::<String>();
    values.next()?.ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lost_change_is_known_by_its_method_and_its_uri() {
        let check = |bytes: &str, expected: Option<&[&str]>| {
            let lost = lost_change(bytes.as_bytes());
            let expected = expected.map(|uris| uris.iter().map(|uri| (*uri).to_owned()).collect());
            assert_eq!(lost.map(|lost| lost.uris), expected, "{bytes}");
        };
        check(r#"{"method":"textDocument/hover","uri":"a:b"}"#, None);
        check(
            r#"{"method":"workspace/didChangeConfiguration","uri":"a:b"}"#,
            None,
        );
        check(
            r#"{"method":"textDocument/didChange","params":{"textDocument":{"uri" : "file:\/\/\/a"}, "#,
            Some(&["file:///a"]),
        );
        check(
            r#"{"method":"textDocument\/didChange","uri":"a:b","#,
            Some(&["a:b"]),
        );
        check(
            r#"{"method":"wedm/didChangeDrawing","drawing":{"uri":"cad:1"#,
            Some(&[]),
        );
        check(
            r#"{"method":"wedm/didChangeDrawing","drawing":{"uri":"cad:1""#,
            Some(&["cad:1"]),
        );
        check(r#"{"method":"textDocument/didChange"}"#, Some(&[]));
    }
}
