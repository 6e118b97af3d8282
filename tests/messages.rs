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
/// schema, what the standard library puts after a reason. The examples under the help of the command line stand with its options.
const WORDS_OF_FORMATS: [&str; 13] = [
    "one of ",
    "\\\\ No newline at end of file\\n",
    "wire fault",
    "wire other",
    "wire tab",
    "lead back",
    "{ uri, version, changes }",
    "{ uri, factor }",
    " (os error",
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

/// What stands before the tests of a file; a line that names a file of tests ends nothing.
fn product(text: &str) -> &str {
    const TESTS: &str = "\n#[cfg(test)]\nmod ";
    let has_body = |at: &usize| {
        let line = text[at + TESTS.len()..].lines().next();
        line.is_some_and(|line| line.ends_with('{'))
    };
    let mut tests = text.match_indices(TESTS).map(|(at, _)| at);
    tests.find(has_body).map_or(text, |at| &text[..at])
}

/// The texts of the product's files outside of `src/message`, each with its path.
fn product_texts() -> Vec<(String, String)> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut texts = Vec::new();
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
        texts.push((within.display().to_string(), product(&text).to_owned()));
    }
    texts
}

#[test]
fn sentences_stand_in_the_room_of_messages() {
    let mut stray: Vec<String> = Vec::new();
    for (path, text) in product_texts() {
        let is_of_a_format = |literal: &String| {
            let first = literal.trim_start_matches("\\\n").lines().next();
            WORDS_OF_FORMATS.contains(&&**literal) || first == Some("Examples:")
        };
        let sentences = literals(&text).into_iter();
        let sentences =
            sentences.filter(|literal| is_sentence(literal) && !is_of_a_format(literal));
        stray.extend(sentences.map(|literal| format!("{path}: {literal:?}")));
    }
    assert!(
        stray.is_empty(),
        "{} sentences stand outside of src/message: give them a row in src/message/en/ and say!() them\n{}",
        stray.len(),
        stray.join("\n")
    );
}

/// What each call is handed, up to the bracket that closes it; `call` ends with the one that opens it.
fn handed_to<'a>(text: &'a str, call: &'a str) -> impl Iterator<Item = &'a str> {
    text.match_indices(call).map(move |(at, _)| {
        let rest = &text[at + call.len()..];
        let mut depth = 1;
        let end = rest.find(|letter| {
            depth += i32::from(letter == '(') - i32::from(letter == ')');
            depth == 0
        });
        &rest[..end.unwrap_or(rest.len())]
    })
}

/// Words that are shown as they stand: coloured, or written as what a value is called.
fn bare_words(text: &str) -> Vec<String> {
    // What serde says that it expects.
    const OF_SERDE: [&str; 2] = ["a number", "a vertex [x, y] or [x, y, bulge]"];
    let handed = ["styled(", "write_str("].into_iter();
    let handed = handed.flat_map(|call| handed_to(text, call));
    let words = handed.flat_map(literals);
    let is_word = |word: &String| {
        // One letter is one of a program.
        let letters = unbraced(word);
        let letters = letters.chars().filter(|letter| letter.is_alphabetic());
        letters.count() > 1 && !OF_SERDE.contains(&&**word)
    };
    words.filter(is_word).collect()
}

#[test]
fn no_word_is_shown_as_it_stands_in_the_code() {
    for (path, text) in product_texts() {
        let words = bare_words(&text);
        assert!(words.is_empty(), "{path}: {words:?}: say!() them");
    }
    assert_eq!(bare_words("styled(GOOD, \"written\")"), ["written"]);
    assert_eq!(bare_words("f.write_str(\"cancelled\")"), ["cancelled"]);
    assert!(bare_words("styled(GOOD, say!(written)), \"of_a_key\"").is_empty());
    assert!(bare_words("styled(STRONG, format!(\"{:<20}\", name()))").is_empty());
}

/// A sentence for people shows no value as a debugger does.
#[test]
fn no_sentence_takes_a_value_as_a_debugger_shows_it() {
    for (path, text) in product_texts() {
        for handed in handed_to(&text, "say!(") {
            assert!(!handed.contains(":?"), "{path}: say!({handed})");
        }
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
    check("f(b\"no such layer\")", &[]);
    check("r#\"a \"raw text\" here\"#", &["a \"raw text\" here"]);
    check(
        "f(\"G01 X1\", \"wire-diameter\", \"as-drawn, nearest\")",
        &[],
    );
    check("f(\"not cut, as it seems\")", &["not cut, as it seems"]);
    check("say!(no_such_layer, layer)", &[]);
}

/// A row of a language: its name, what it takes, and its wordings.
#[derive(Debug)]
struct Row {
    name: String,
    takes: String,
    wordings: Vec<String>,
}

/// The rows of a language, file by file, in their order.
fn rows(language: &str) -> Vec<(String, Vec<Row>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/message");
    let files = walkdir::WalkDir::new(folder.join(language)).sort_by_file_name();
    let files = files.into_iter().map(|entry| entry.unwrap().into_path());
    let files = files.filter(|path| path.extension().is_some_and(|ending| ending == "rs"));
    files
        .map(|path| {
            let text = std::fs::read_to_string(&path).unwrap();
            let mut rows: Vec<Row> = Vec::new();
            for line in text.lines() {
                let head = line
                    .strip_prefix("    ")
                    .filter(|head| head.starts_with(|first: char| first.is_ascii_alphanumeric()));
                if let Some((head, wording)) = head.and_then(|head| head.split_once(" => ")) {
                    let (name, takes) = head.split_once('(').unwrap_or((head, ""));
                    rows.push(Row {
                        name: name.to_owned(),
                        takes: takes.to_owned(),
                        wordings: literals(wording),
                    });
                } else if let Some(row) = rows.last_mut() {
                    row.wordings.extend(literals(line));
                }
            }
            (
                path.file_name().unwrap().to_string_lossy().into_owned(),
                rows,
            )
        })
        .collect()
}

/// What stands in braces, sorted: `{layer:?}`, `{x:.3}`, `{{x}}`.
fn placeholders(wording: &str) -> Vec<&str> {
    let ends = wording.match_indices('{').filter_map(|(from, _)| {
        let end = wording[from..].find('}')?;
        Some(&wording[from..=from + end])
    });
    let mut found: Vec<&str> = ends.collect();
    found.sort_unstable();
    found
}

/// Rows that a function words, with a plural where the language has one: their wordings are counted by no test.
fn is_function(row: &Row) -> bool {
    row.takes.contains(':')
}

#[test]
fn every_sentence_has_its_twin_which_speaks_of_the_same() {
    let (english, chinese) = (rows("en"), rows("zh"));
    let files = |of: &[(String, Vec<Row>)]| -> Vec<String> {
        of.iter().map(|(name, _)| name.clone()).collect()
    };
    assert_eq!(files(&english), files(&chinese));
    let mut wrong: Vec<String> = Vec::new();
    for ((file, ours), (_, theirs)) in english.iter().zip(&chinese) {
        let names = |rows: &[Row]| -> Vec<String> {
            let of = rows.iter().map(|row| format!("{}({}", row.name, row.takes));
            of.collect()
        };
        assert_eq!(names(ours), names(theirs), "{file}: rows in the same order");
        for (one, other) in ours.iter().zip(theirs).filter(|(one, _)| !is_function(one)) {
            let (said, twin) = (&one.wordings[0], &other.wordings[0]);
            if placeholders(said) != placeholders(twin) {
                wrong.push(format!("{file}: {}: {said:?} and {twin:?}", one.name));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A name says what its sentence means; one that was cut off out of its first words ends in a word that leads on to the next.
#[test]
fn no_name_of_a_sentence_is_cut_off() {
    const LEADS_ON: [&str; 11] = [
        "a", "an", "the", "its", "and", "or", "not", "that", "which", "where", "until",
    ];
    // To what the sentence takes, where it takes anything.
    const LEADS_TO: [&str; 11] = [
        "of", "to", "from", "with", "for", "at", "by", "as", "than", "is", "are",
    ];
    let mut wrong: Vec<String> = Vec::new();
    for (file, rows) in rows("en") {
        for row in &rows {
            let Some((_, last)) = row.name.rsplit_once('_') else {
                continue;
            };
            if LEADS_ON.contains(&last) || (LEADS_TO.contains(&last) && row.takes.is_empty()) {
                wrong.push(format!("{file}: {}: {:?}", row.name, row.wordings));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// One meaning has one word, that of docs/zh/glossary.md: what stands for it elsewhere in the trade is not used beside it.
#[test]
fn chinese_has_one_word_for_one_meaning() {
    const OTHERS: [(&str, &str); 6] = [
        ("图纸", "图形"),
        ("留料", "暂留段"),
        ("偏置", "偏移"),
        ("钼丝直径", "电极丝直径"),
        ("起割孔", "穿丝孔"),
        ("过割", "过切"),
    ];
    let mut texts: Vec<(String, String)> = Vec::new();
    for (file, rows) in rows("zh") {
        let wordings = rows.into_iter().flat_map(|row| row.wordings);
        texts.extend(wordings.map(|wording| (file.clone(), wording)));
    }
    let pages = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/zh/rules");
    for page in std::fs::read_dir(pages).unwrap() {
        let page = page.unwrap().path();
        let text = std::fs::read_to_string(&page).unwrap();
        texts.push((page.display().to_string(), text));
    }
    for (place, text) in texts {
        for (other, ours) in OTHERS {
            assert!(
                !text.contains(other),
                "{place}: {other}, expected {ours}: {text}"
            );
        }
    }
}

#[test]
fn chinese_rows_are_chinese() {
    let is_han = |letter: char| matches!(letter, '\u{4e00}'..='\u{9fff}');
    // Code words, and words that Chinese does without.
    const WITHOUT: [&str; 3] = ["wedm fix {file} --in-place", "profile {name}：{why}", ""];
    let mut wrong: Vec<String> = Vec::new();
    for (file, rows) in rows("zh") {
        for (name, wording) in rows.iter().flat_map(|row| {
            let name = &row.name;
            row.wordings.iter().map(move |wording| (name, wording))
        }) {
            if WITHOUT.contains(&&**wording) {
                continue;
            }
            let speaks = wording.chars().any(is_han);
            let words = unbraced(wording);
            // Units and letters of a program are no words.
            let is_of_words = words
                .split(|letter: char| !letter.is_ascii_alphabetic())
                .any(|word| word.len() > 2);
            let plain = |mark: char| {
                // A half-width mark right beside Chinese letters, which have their own.
                let letters: Vec<char> = wording.chars().collect();
                letters
                    .windows(2)
                    .any(|pair| is_han(pair[0]) && pair[1] == mark)
            };
            if (is_of_words && !speaks)
                || is_sentence(&words.replace("wedm ", "wedm-"))
                || [',', ':', ';', '!', '?'].into_iter().any(plain)
            {
                wrong.push(format!("{file}: {name}: {wording:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The wording without its placeholders and code words.
fn unbraced(wording: &str) -> String {
    let mut text = String::new();
    let mut depth = 0;
    let mut is_code = false;
    for letter in wording.chars() {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            '`' => is_code = !is_code,
            _ if depth == 0 && !is_code => text.push(letter),
            _ => {}
        }
    }
    text
}

/// What the plugin of LibreCAD says, as Qt's `lupdate` has gathered it, and how that is said in Chinese.
#[test]
fn every_sentence_of_the_librecad_plugin_has_its_twin() {
    let file =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("clients/librecad/translations/wedm_zh.ts");
    let text = std::fs::read_to_string(file).unwrap();
    let between = |text: &str, from: &str, to: &str| {
        let (_, rest) = text.split_once(from)?;
        Some(rest.split_once(to)?.0.to_owned())
    };
    let numbered = |sentence: &str| {
        let mut found: Vec<String> = sentence
            .split('%')
            .skip(1)
            .filter_map(|rest| rest.chars().next())
            .filter(|mark| mark.is_ascii_digit() || *mark == 'n')
            .map(String::from)
            .collect();
        found.sort_unstable();
        found
    };
    let messages: Vec<&str> = text.split("<message").skip(1).collect();
    assert!(messages.len() > 100, "{} sentences", messages.len());
    for message in messages {
        let source = between(message, "<source>", "</source>").unwrap();
        let twin = between(message, "<numerusform>", "</numerusform>")
            .or_else(|| between(message, "<translation>", "</translation>"))
            .unwrap_or_else(|| panic!("{source:?} has no translation"));
        assert!(!twin.trim().is_empty(), "{source:?}");
        assert_eq!(numbered(&source), numbered(&twin), "{source:?}: {twin:?}");
    }
}
