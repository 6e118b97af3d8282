//! Sentences stand in `src/message`, and none elsewhere.

use std::path::Path;

/// Calls whose text no user is meant to read: the log, and what a bug says before it stops.
const NOT_FOR_PEOPLE: [&str; 13] = [
    "expect",
    "panic!",
    "unreachable!",
    "todo!",
    "assert!",
    "assert_eq!",
    "debug_assert!",
    "debug_assert_eq!",
    "debug!",
    "info!",
    "warn!",
    "error!",
    "trace!",
];

/// What looks like a sentence and is a word of a format: what serde and diff say, classes of SVG, shapes of JSON, descriptions in the
/// schema. The examples under the help of the command line stand with the rest of it, which `clap` takes from comments.
const WORDS_OF_FORMATS: [&str; 10] = [
    "one of ",
    "\\\\ No newline at end of file\\n",
    "wire fault",
    "wire other",
    "{ uri, version, changes }",
    "{ uri, factor }",
    "wedm protocol",
    "Every message of the wedm/ name space, protocol {PROTOCOL}.",
    "A vertex [x, y, bulge] of a polyline; the bulge may be left out and is 0 then.",
    "Examples:",
];

/// The string literals of a Rust text that may be shown, without those of comments, attributes and [`NOT_FOR_PEOPLE`].
fn literals(text: &str) -> Vec<String> {
    let bytes = text.as_bytes();
    let (mut found, mut at) = (Vec::new(), 0);
    // Depth of brackets, and the depth within which nothing counts.
    let (mut depth, mut silent): (usize, Option<usize>) = (0, None);
    while at < bytes.len() {
        let rest = &text[at..];
        match bytes[at] {
            b'/' if rest.starts_with("//") => {
                at += rest.find('\n').unwrap_or(rest.len());
                continue;
            }
            b'\'' => {
                // A character, or a lifetime.
                let mut letters = rest[1..].chars();
                let length = match (letters.next(), letters.next()) {
                    (Some('\\'), _) => rest[3..].find('\'').map_or(1, |end| end + 4),
                    (Some(letter), Some('\'')) => letter.len_utf8() + 2,
                    _ => 1,
                };
                at += length;
                continue;
            }
            b'"' => {
                let raw = &text[..at];
                let hashes = raw.len() - raw.trim_end_matches('#').len();
                let is_raw = raw.trim_end_matches('#').ends_with('r');
                let close = format!("\"{}", "#".repeat(hashes));
                let mut end = at + 1;
                while end < bytes.len() {
                    match bytes[end] {
                        b'\\' if !is_raw => end += 1,
                        b'"' if !is_raw || text[end..].starts_with(&close) => break,
                        _ => {}
                    }
                    end += 1;
                }
                // Bytes are what a file says.
                let is_bytes = raw.trim_end_matches(['#', 'r']).ends_with("(b")
                    || raw.trim_end_matches(['#', 'r']).ends_with(" b");
                if silent.is_none() && !is_bytes {
                    found.push(text[at + 1..end].to_owned());
                }
                at = end + 1;
                continue;
            }
            b'(' | b'[' | b'{' => {
                depth += 1;
                let before = &text[..at];
                let is_call = NOT_FOR_PEOPLE.iter().any(|name| {
                    before.strip_suffix(name).is_some_and(|head| {
                        !head.ends_with(|c: char| c.is_alphanumeric() || c == '_')
                    })
                });
                let is_attribute = before.ends_with('#') || before.ends_with("#!");
                if silent.is_none() && (is_call || is_attribute) {
                    silent = Some(depth);
                }
            }
            b')' | b']' | b'}' => {
                if silent == Some(depth) {
                    silent = None;
                }
                depth = depth.saturating_sub(1);
            }
            _ => {}
        }
        at += rest.chars().next().map_or(1, char::len_utf8);
    }
    found
}

/// True for two words with a space between, the second in small letters.
fn is_sentence(literal: &str) -> bool {
    let words: Vec<&str> = literal.split(' ').map(str::trim).collect();
    let is_word = |word: &str| {
        let word = word.trim_matches(|c: char| c.is_ascii_punctuation());
        word.len() > 1 && word.chars().all(|c| c.is_ascii_alphabetic())
    };
    words.windows(2).any(|pair| {
        is_word(pair[0])
            && is_word(pair[1])
            && pair[1].starts_with(|c: char| c.is_ascii_lowercase())
            && !pair[0].ends_with(|c: char| c.is_ascii_punctuation() && c != ',' && c != ':')
    })
}

/// What stands before the tests of a file.
fn product(text: &str) -> &str {
    let tests = text.find("\n#[cfg(test)]\nmod ");
    tests.map_or(text, |at| &text[..at])
}

#[test]
fn sentences_stand_in_the_room_of_messages() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let source = root.join("src");
    let mut stray: Vec<String> = Vec::new();
    for entry in walkdir::WalkDir::new(&source).sort_by_file_name() {
        let path = entry.unwrap().into_path();
        let within = path.strip_prefix(&source).unwrap();
        let is_test = within.components().any(|part| {
            ["tests", "tests.rs", "testing", "message"]
                .iter()
                .any(|name| part.as_os_str() == *name)
        });
        if is_test || path.extension().is_none_or(|ending| ending != "rs") {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let is_of_a_format = |literal: &String| {
            let first = literal.trim_start_matches("\\\n").lines().next();
            WORDS_OF_FORMATS.contains(&&**literal) || first == Some("Examples:")
        };
        let sentences = literals(product(&text)).into_iter();
        let sentences =
            sentences.filter(|literal| is_sentence(literal) && !is_of_a_format(literal));
        stray.extend(sentences.map(|literal| format!("{}: {literal:?}", within.display())));
    }
    assert!(
        stray.is_empty(),
        "{} sentences stand outside of src/message: give them a row in src/message/en/ and say!() them\n{}",
        stray.len(),
        stray.join("\n")
    );
}

#[test]
fn a_stray_sentence_is_seen() {
    let check = |text: &str, expected: &[&str]| {
        let found: Vec<String> = literals(text)
            .into_iter()
            .filter(|literal| is_sentence(literal))
            .collect();
        assert_eq!(found, expected, "{text}");
    };
    check("let a = \"no such layer\";", &["no such layer"]);
    check("// \"no such layer\"\nlet a = '\"';", &[]);
    check(
        "#[doc = \"no such layer\"] x.expect(\"no such layer\"); \"two words\"",
        &["two words"],
    );
    check("f(b\"no such layer\")", &[]);
    check("r#\"a \"raw text\" here\"#", &["a \"raw text\" here"]);
    check(
        "f(\"G01 X1\", \"wire-diameter\", \"as-drawn, nearest\")",
        &[],
    );
    check("f(\"not cut, as it seems\")", &["not cut, as it seems"]);
    check("say!(no_such_layer, layer)", &[]);
}
