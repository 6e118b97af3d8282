//! The pages, pictures and lists of the rules.

use super::*;

#[test]
fn every_rule_has_its_page() {
    for rule in Rule::ALL {
        let page = read(&root().join(format!("docs/rules/{}.md", rule.name())));
        assert!(
            page.starts_with(&format!("# {}\n", rule.name())),
            "{}",
            rule.name()
        );
        for heading in [
            "## What it does",
            "## Why it matters for the cut",
            "## Example",
            "## Settings",
        ] {
            assert!(page.contains(heading), "{}: no {heading:?}", rule.name());
        }
    }
}

/// The list of rules: what each says, how bad it is where nothing is set, and in which documents it is found. Update it with
/// `UPDATE_EXPECT=1 cargo test --test command_line docs`.
#[test]
fn the_list_of_rules_is_the_table_of_rules() {
    let path = root().join("docs/rules/README.md");
    let committed = read(&path);
    let (head, rest) = committed.split_once("| rule |").expect("a table");
    let (_, behind) = rest.split_once("\n\n").expect("what stands below it");
    let (behind, _) = behind.split_once(REASONS).expect("why a cell stays empty");
    let of = |rule: Rule, subject| {
        if rule.subjects().contains(&subject) {
            "•"
        } else {
            ""
        }
    };
    let row = |rule: Rule| {
        let name = rule.name();
        let severity = severity_on_page(rule);
        let default = format!("{:?}", rule.default_severity()).to_lowercase();
        assert!(severity.starts_with(&default), "{name}: {severity}");
        let [drawing, three_b, four_b, iso] = [
            Subject::Drawing,
            Subject::ThreeB,
            Subject::FourB,
            Subject::Iso,
        ]
        .map(|subject| of(rule, subject));
        format!(
            "| [{name}]({name}.md) | {} | {severity} | {drawing} | {three_b} | {four_b} | {iso} |\n",
            rule.summary()
        )
    };
    let rows: String = Rule::ALL.into_iter().map(row).collect();
    let list = format!(
        "{head}| rule | says | severity | drawing | 3B | 4B | ISO |\n|---|---|---|:-:|:-:|:-:|:-:|\n{rows}\n{behind}{REASONS}{}",
        reasons("docs/rules", "Why not elsewhere: ", ", ")
    );
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&path, &list).unwrap();
    }
    assert!(
        read(&path) == list,
        "docs/rules/README.md is out of date; update it with: UPDATE_EXPECT=1 cargo test --test command_line docs"
    );
}

/// The head of the table that says why cells of the list stay empty.
const REASONS: &str = "| rules | why not elsewhere |\n|---|---|\n";

/// The rows of that table: a rule that is not found in every kind of document says why on its page, in one line after `mark`. Rules
/// that say the same share a row.
pub(super) fn reasons(folder: &str, mark: &str, comma: &str) -> String {
    let mut rows: Vec<(String, String)> = Vec::new();
    for rule in Rule::ALL {
        let name = rule.name();
        let page = read(&root().join(format!("{folder}/{name}.md")));
        let mut said = page.lines().filter_map(|line| line.strip_prefix(mark));
        let kinds = [
            Subject::Drawing,
            Subject::ThreeB,
            Subject::FourB,
            Subject::Iso,
        ];
        // What is said of the settings themselves is found in no document.
        let asks = rule != Rule::Settings
            && kinds
                .iter()
                .any(|subject| !rule.subjects().contains(subject));
        let reason = said.next();
        assert_eq!(
            (reason.is_some(), said.next()),
            (asks, None),
            "{folder}/{name}.md says in one line after {mark:?} why it is not found elsewhere, if it is not"
        );
        let Some(reason) = reason else { continue };
        match rows.iter_mut().find(|(other, _)| other == reason) {
            Some((_, names)) => names.push_str(&format!("{comma}`{name}`")),
            None => rows.push((reason.to_owned(), format!("`{name}`"))),
        }
    }
    let rows = rows.into_iter();
    rows.map(|(reason, names)| format!("| {names} | {reason} |\n"))
        .collect()
}

/// Every dot of the table is found in a document of this repository, and nothing else is. Texts of 3B are programs of 4B, too.
#[test]
fn rules_are_found_where_the_table_says() {
    let made = tempfile::tempdir().unwrap();
    for file in files_in("tests/data/programs").chain(files_in("tests/data/rules")) {
        let copy = made.path().join(file.strip_prefix(root()).unwrap());
        std::fs::create_dir_all(copy.parent().unwrap()).unwrap();
        let is_three_b = copy.extension().is_some_and(|ending| ending == "3b");
        let copy = match is_three_b {
            true => copy.with_extension("4b"),
            false => copy,
        };
        std::fs::copy(file, copy).unwrap();
    }
    // Long slanting ways beside each other, whose boxes all lie on each other: more than are searched for a slip.
    let zigzag = "B9999B10000B10000GYL1\nB20B0B20GXL1\nB9999B10000B10000GYL3\nB20B0B20GXL1\n";
    for name in ["zigzag.3b", "zigzag.4b"] {
        std::fs::write(made.path().join(name), zigzag.repeat(252) + "DD\n").unwrap();
    }
    let mut found = BTreeSet::new();
    for arguments in [
        &["tests/data", "docs"][..],
        &["--side", "opening", "docs/pictures"],
        &[made.path().to_str().unwrap()],
    ] {
        let output = wedm(
            &root(),
            &[&["check", "--output", "json"], arguments].concat(),
        );
        let said: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        for row in said["diagnostics"].as_array().unwrap() {
            let name = |key: &str| row[key].as_str().unwrap().to_owned();
            found.insert((
                name("path").rsplit('.').next().unwrap().to_owned(),
                name("rule"),
            ));
        }
    }
    let kinds = [
        ("dxf", Subject::Drawing),
        ("3b", Subject::ThreeB),
        ("4b", Subject::FourB),
        ("iso", Subject::Iso),
    ];
    let said = kinds.into_iter().flat_map(|(ending, subject)| {
        let is_said = move |rule: &Rule| rule.subjects().contains(&subject);
        let rules = Rule::ALL.into_iter().filter(is_said);
        rules.map(move |rule| (ending.to_owned(), rule.name().to_owned()))
    });
    let said: BTreeSet<_> = said.collect();
    // Said after 100,000 findings, where a path is asked for, and where no path is known that passes its proof.
    let elsewhere = [Rule::More, Rule::LeadIn, Rule::UnprovedPath].map(Rule::name);
    let unsaid: Vec<_> = found.difference(&said).collect();
    let unfound = said.difference(&found);
    let unfound: Vec<_> = unfound
        .filter(|(_, rule)| !elsewhere.contains(&rule.as_str()))
        .collect();
    assert!(
        unsaid.is_empty() && unfound.is_empty(),
        "found, and not in the table: {unsaid:?}; in the table, and not found: {unfound:?}"
    );
}

/// The picture of a rule is drawn from a drawing of its name, in which the rule is found.
#[test]
fn every_rule_of_drawings_has_a_picture_that_shows_it() {
    // These are said of settings, of damage, beside a program, where a start hole has a diameter, or when a path is asked for.
    let elsewhere = [
        Rule::DoesNotFit,
        Rule::NotTheDrawing,
        Rule::LeadIn,
        Rule::StartHole,
        Rule::UnprovedPath,
        Rule::Syntax,
        Rule::NotJudged,
        Rule::More,
    ];
    let of_drawings = Rule::ALL
        .into_iter()
        .filter(|rule| rule.subjects().contains(&Subject::Drawing) && !elsewhere.contains(rule));
    for name in of_drawings.map(Rule::name) {
        let page = read(&root().join(format!("docs/rules/{name}.md")));
        assert!(
            page.contains(&format!("](../pictures/{name}.svg)")),
            "the page of {name} shows no picture"
        );
        let drawing = root().join(format!("docs/pictures/{name}.dxf"));
        let output = wedm(
            &root(),
            &[
                "check",
                drawing.to_str().unwrap(),
                "--side",
                "opening",
                "--output",
                "json",
            ],
        );
        let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let rules: Vec<&str> = found["diagnostics"]
            .as_array()
            .unwrap()
            .iter()
            .filter_map(|row| row["rule"].as_str())
            .collect();
        assert!(
            rules.contains(&name),
            "{name} is not found in its own picture: {rules:?}"
        );
    }
}

/// Holds a picture against the committed one.
#[track_caller]
fn check_picture(name: &str, drawn: &str) {
    let path = root().join("docs/pictures").join(name);
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&path, drawn).unwrap();
    }
    assert!(
        read(&path) == drawn,
        "docs/pictures/{name} is out of date; update it with: UPDATE_EXPECT=1 cargo test --test command_line docs"
    );
}

#[test]
fn the_pictures_are_what_the_program_draws() {
    let folder = tempfile::tempdir().unwrap();
    let pictures = root().join("docs/pictures");
    for entry in std::fs::read_dir(&pictures).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "dxf") {
            let drawing = path.to_str().unwrap();
            let name = path.with_extension("svg");
            let name = name.file_name().unwrap().to_str().unwrap();
            let drawn = if name == "does-not-fit.svg" {
                let picture = folder.path().join(name);
                let pair = "--drawn-as punch --clearance 0.01 --correction 0.1 --wire-diameter 0.18 --gap 0.01";
                let mut arguments = vec!["fit", drawing, "-o", picture.to_str().unwrap()];
                arguments.extend(pair.split(' '));
                assert_eq!(wedm(folder.path(), &arguments).status.code(), Some(1));
                read(&picture)
            } else {
                let output = wedm(folder.path(), &["draw", drawing, "--side", "opening"]);
                String::from_utf8(output.stdout).unwrap()
            };
            check_picture(name, &drawn);
        }
    }
    assert!(wedm(folder.path(), &["demo", "."]).status.success());
    check_picture("plate.svg", &read(&folder.path().join("demo.svg")));
}

/// A page that says in which documents a rule works names those of the table.
#[test]
fn the_pages_say_where_their_rules_work() {
    let all = [
        (Subject::Drawing, ""),
        (Subject::ThreeB, "3B"),
        (Subject::FourB, "4B"),
        (Subject::Iso, "ISO"),
    ];
    let mut count = 0;
    for rule in Rule::ALL {
        for (folder, begins, drawings) in [
            ("docs/rules", "Works in ", "drawings"),
            ("docs/zh/rules", "适用于", "图形"),
        ] {
            let page = read(&root().join(format!("{folder}/{}.md", rule.name())));
            for line in page.split(begins).skip(1) {
                let said = line.split(['.', '。']).next().unwrap();
                for (subject, word) in all {
                    let word = if subject == Subject::Drawing {
                        drawings
                    } else {
                        word
                    };
                    let is_found = rule.subjects().contains(&subject);
                    assert_eq!(
                        said.contains(word),
                        is_found,
                        "{folder}: {}: {said}",
                        rule.name()
                    );
                }
                count += 1;
            }
        }
    }
    assert!(count >= 2, "no page says it");
}

/// What a page says of the default severity of a rule.
fn severity_on_page(rule: Rule) -> String {
    severity_on("docs/rules", rule, "Default severity: ", '.')
}

/// The same of a Chinese page.
pub(super) fn severity_on_chinese_page(rule: Rule) -> String {
    severity_on("docs/zh/rules", rule, "默认级别：", '。')
}

/// What stands behind the words of a page up to the end of their sentence.
fn severity_on(folder: &str, rule: Rule, words: &str, end: char) -> String {
    let name = rule.name();
    let page = read(&root().join(format!("{folder}/{name}.md")));
    let severity = page
        .split(words)
        .nth(1)
        .and_then(|rest| rest.split([end, '\n']).next());
    severity
        .unwrap_or_else(|| panic!("{folder}/{name}.md says no severity"))
        .to_owned()
}

/// The defaults of the rules on a page of settings stand in comments, since a rule that is set is no milder anywhere. `note` says what
/// else belongs to the default of a rule.
fn the_page_shows_the_default_of_every_rule(name: &str, note: impl Fn(Rule, &str) -> String) {
    let path = root().join(name);
    let page = read(&path);
    let (head, rest) = page.split_once("[rules] ").unwrap();
    let (first, rest) = rest.split_once('\n').unwrap();
    let (_, tail) = rest.split_once("```").unwrap();
    let row = |rule: Rule| {
        let default = format!("{:?}", rule.default_severity()).to_lowercase();
        let row = format!("# {} = \"{default}\"", rule.name());
        match note(rule, &default).as_str() {
            "" => format!("{row}\n"),
            note => format!("{row:<34} # {note}\n"),
        }
    };
    let of_documents = Rule::ALL.into_iter().filter(|rule| *rule != Rule::Settings);
    let rows: String = of_documents.map(row).collect();
    let shown = format!("{head}[rules] {first}\n{rows}```{tail}");
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&path, &shown).unwrap();
    }
    assert!(
        read(&path) == shown,
        "{name} is out of date; update it with: UPDATE_EXPECT=1 cargo test --test command_line docs"
    );
}

/// Update them with `UPDATE_EXPECT=1 cargo test --test command_line docs`.
#[test]
fn the_pages_of_settings_show_the_default_of_every_rule() {
    the_page_shows_the_default_of_every_rule("docs/settings.md", |rule, default| {
        let on_page = severity_on_page(rule);
        let note = on_page.strip_prefix(default).unwrap_or_else(|| {
            panic!(
                "docs/rules/{}.md says {on_page}, not {default}",
                rule.name()
            )
        });
        note.trim_start_matches([',', ';', ' ']).to_owned()
    });
    the_page_shows_the_default_of_every_rule("docs/zh/settings.md", |rule, default| {
        let on_page = severity_on_chinese_page(rule);
        let word = format!("（{default}）");
        // "警告（warning）；……": the word is the default, and the rest belongs to it.
        let note = match on_page.split_once(&word) {
            Some((first, rest)) if first.chars().count() == 2 => rest,
            _ => &on_page,
        };
        let names = ["error", "warning", "information", "hint"].map(|name| format!("（{name}）"));
        let note = names
            .iter()
            .fold(note.to_owned(), |note, name| note.replace(name, ""));
        note.trim_start_matches(['，', '；']).to_owned()
    });
}
