//! Sentences stand in `src/message`: none stray elsewhere, beyond those that `tests/messages.txt` counts for each room.

use std::collections::BTreeMap;
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
                if silent.is_none() {
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
    let mut rooms: BTreeMap<String, Vec<String>> = BTreeMap::new();
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
        let room = within.components().next().unwrap().as_os_str();
        let room = room.to_string_lossy().trim_end_matches(".rs").to_owned();
        let text = std::fs::read_to_string(&path).unwrap();
        let stray = literals(product(&text));
        let stray = stray.into_iter().filter(|literal| is_sentence(literal));
        rooms
            .entry(room)
            .or_default()
            .extend(stray.map(|literal| format!("{}: {literal:?}", within.display())));
    }
    let list = root.join("tests/messages.txt");
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        let counts = rooms.iter().filter(|(_, stray)| !stray.is_empty());
        let rows: String = counts
            .map(|(room, stray)| format!("{room} {}\n", stray.len()))
            .collect();
        std::fs::write(&list, rows).unwrap();
    }
    let known: BTreeMap<String, usize> = std::fs::read_to_string(&list)
        .unwrap_or_default()
        .lines()
        .filter_map(|row| {
            let (room, count) = row.split_once(' ')?;
            Some((room.to_owned(), count.parse().ok()?))
        })
        .collect();
    for (room, stray) in rooms {
        let most = known.get(&room).copied().unwrap_or(0);
        assert!(
            stray.len() <= most,
            "{} sentences stand in src/{room}, {most} are known: give them a row in src/message/en/ and say!() them\n{}",
            stray.len(),
            stray.join("\n")
        );
    }
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
    check("r#\"a \"raw text\" here\"#", &["a \"raw text\" here"]);
    check(
        "f(\"G01 X1\", \"wire-diameter\", \"as-drawn, nearest\")",
        &[],
    );
    check("f(\"not cut, as it seems\")", &["not cut, as it seems"]);
    check("say!(no_such_layer, layer)", &[]);
}
