//! The documentation is true: its links lead somewhere, its commands do what it shows, its pictures are what the program
//! draws, and every rule has its page.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use wedm::rule::{Rule, Subject};
use wedm::settings::Effective;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn wedm(folder: &Path, arguments: &[&str]) -> Output {
    wedm_in("C", folder, arguments)
}

fn wedm_in(language: &str, folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_wedm"))
        .args(arguments)
        .env("LC_ALL", language)
        .current_dir(folder)
        .output()
        .unwrap()
}

/// The pages of the project, and every page of `docs`.
fn pages() -> Vec<PathBuf> {
    let of_docs = walkdir::WalkDir::new(root().join("docs"))
        .sort_by_file_name()
        .into_iter()
        .map(|entry| entry.unwrap().into_path());
    let pages = of_docs.filter(|path| path.extension().is_some_and(|ending| ending == "md"));
    [
        "README.md",
        "README.zh-CN.md",
        "CHANGELOG.md",
        "CONTRIBUTING.md",
        "SECURITY.md",
    ]
    .map(|name| root().join(name))
    .into_iter()
    .chain(pages)
    .collect()
}

fn files_in(folder: &str) -> impl Iterator<Item = PathBuf> {
    let entries = walkdir::WalkDir::new(root().join(folder)).sort_by_file_name();
    let entries = entries.into_iter().map(Result::unwrap);
    entries
        .filter(|entry| entry.file_type().is_file())
        .map(walkdir::DirEntry::into_path)
}

/// Targets of all links and pictures of a page, what stands in fenced blocks and in code left out.
fn links(page: &str) -> Vec<String> {
    let mut fenced = false;
    let mut links = Vec::new();
    for line in page.lines() {
        if line.starts_with("```") {
            fenced = !fenced;
            continue;
        }
        let text: String = line.split('`').step_by(2).collect();
        let targets = text
            .split("](")
            .skip(1)
            .filter_map(|rest| rest.split(')').next());
        links.extend(targets.filter(|_| !fenced).map(str::to_owned));
    }
    links
}

/// The anchors that headings make: lower case, spaces to hyphens, punctuation dropped.
fn anchors(page: &str) -> Vec<String> {
    let headings = page
        .lines()
        .filter(|line| line.starts_with('#'))
        .map(|line| line.trim_start_matches('#').trim().to_lowercase());
    let anchor = |heading: String| {
        heading
            .chars()
            .filter(|c| c.is_alphanumeric() || *c == ' ' || *c == '-')
            .collect::<String>()
            .replace(' ', "-")
    };
    headings.map(anchor).collect()
}

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

/// What a page is made of: depths of headings; blocks of code, of which TOML without its comments and otherwise how many lines; rows of
/// tables; and where links lead.
fn shape(page: &str) -> (Vec<usize>, Vec<Vec<String>>, usize, Vec<String>) {
    let (mut headings, mut blocks, mut is_code) = (Vec::new(), Vec::new(), false);
    for line in page.lines() {
        if line.starts_with("```") {
            is_code = !is_code;
            if is_code {
                blocks.push(vec![line.to_owned()]);
            }
        } else if let Some(block) = blocks.last_mut().filter(|_| is_code) {
            let is_toml = block[0] == "```toml";
            let code = line.split('#').next().unwrap_or_default().trim_end();
            block.push(if is_toml { code } else { "" }.to_owned());
        } else if line.starts_with('#') {
            headings.push(line.chars().take_while(|mark| *mark == '#').count());
        }
    }
    let rows = page.lines().filter(|line| line.starts_with('|')).count();
    let file = |target: String| target.split('#').next().unwrap_or_default().to_owned();
    let mut targets: Vec<String> = links(page).into_iter().map(file).collect();
    targets.sort_unstable();
    (headings, blocks, rows, targets)
}

#[test]
fn every_page_of_a_rule_has_its_twin_in_chinese() {
    for rule in Rule::ALL {
        let name = rule.name();
        let page = read(&root().join(format!("docs/rules/{name}.md")));
        let twin = read(&root().join(format!("docs/zh/rules/{name}.md")));
        assert!(twin.starts_with(&format!("# {name}\n")), "{name}");
        let twin = twin.replace("](../../", "](../");
        assert_eq!(shape(&page), shape(&twin), "{name}");
        let default = format!("{:?}", rule.default_severity()).to_lowercase();
        assert!(
            twin.contains("默认级别：") && twin.contains(&format!("（{default}）")),
            "{name}: {default} is not said"
        );
    }
}

/// The list of rules: what each says, how bad it is where nothing is set, and in which documents it is found. Update it with
/// `UPDATE_EXPECT=1 cargo test --test docs`.
#[test]
fn the_list_of_rules_is_the_table_of_rules() {
    let path = root().join("docs/rules/README.md");
    let committed = read(&path);
    let (head, rest) = committed.split_once("| rule |").expect("a table");
    let (_, reasons) = rest.split_once("\n\n").expect("why a cell stays empty");
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
        "{head}| rule | says | severity | drawing | 3B | 4B | ISO |\n|---|---|---|:-:|:-:|:-:|:-:|\n{rows}\n{reasons}"
    );
    for rule in Rule::ALL {
        let found = rule.subjects();
        let everywhere = [
            Subject::Drawing,
            Subject::ThreeB,
            Subject::FourB,
            Subject::Iso,
        ];
        let is_everywhere = everywhere.iter().all(|subject| found.contains(subject));
        let says_why = reasons.contains(&format!("`{}`", rule.name()));
        let of_settings = rule == Rule::Settings;
        assert!(
            is_everywhere || of_settings || says_why,
            "docs/rules/README.md does not say why {} is not found everywhere",
            rule.name()
        );
    }
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&path, &list).unwrap();
    }
    assert!(
        read(&path) == list,
        "docs/rules/README.md is out of date; update it with: UPDATE_EXPECT=1 cargo test --test docs"
    );
}

/// The same list in Chinese: the sentences are those of `wedm explain`, the severities those of the pages.
#[test]
fn the_list_of_rules_in_chinese_is_the_english_one() {
    let path = root().join("docs/zh/rules/README.md");
    let committed = read(&path);
    let head = "|---|---|---|:-:|:-:|:-:|:-:|\n";
    let (before, rest) = committed.split_once(head).expect("a table");
    let (_, behind) = rest.split_once("\n## ").expect("what stands below it");
    let listed = wedm_in("zh_CN.UTF-8", &root(), &["explain"]).stdout;
    let listed = String::from_utf8(listed).unwrap();
    let summary_of = |name: &str| {
        let line = listed
            .lines()
            .find(|line| line.split_whitespace().next() == Some(name));
        let mut words = line.expect(name).splitn(2, char::is_whitespace);
        let rest = words.nth(1).unwrap().trim_start();
        rest.split_once(char::is_whitespace)
            .unwrap()
            .1
            .trim()
            .to_owned()
    };
    let english = read(&root().join("docs/rules/README.md"));
    let row = |rule: Rule| {
        let name = rule.name();
        let page = read(&root().join(format!("docs/zh/rules/{name}.md")));
        let severity = page
            .split("默认级别：")
            .nth(1)
            .and_then(|rest| rest.split(['。', '\n']).next());
        let severity = severity.expect(name);
        let row = english
            .lines()
            .find(|line| line.starts_with(&format!("| [{name}](")))
            .unwrap_or_else(|| panic!("docs/rules/README.md does not list {name} yet"));
        // Behind the last bar stands nothing; before it the four kinds of documents.
        let cells: Vec<&str> = row.rsplitn(6, " |").collect();
        let dots: String = cells[1..5]
            .iter()
            .rev()
            .map(|cell| format!("{cell} |"))
            .collect();
        format!(
            "| [{name}]({name}.md) | {} | {severity} |{dots}\n",
            summary_of(name)
        )
    };
    let rows: String = Rule::ALL.into_iter().map(row).collect();
    let list = format!("{before}{head}{rows}\n## {behind}");
    let named = |page: &str| page.lines().filter(|line| line.starts_with("| `")).count();
    assert_eq!(named(&english), named(&list), "why cells stay empty");
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&path, &list).unwrap();
    }
    assert!(
        read(&path) == list,
        "docs/zh/rules/README.md is out of date; update it with: UPDATE_EXPECT=1 cargo test --test docs"
    );
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
    // Said behind 100,000 findings, where a path is asked for, and where no path is known that holds its proof.
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

#[test]
fn every_relative_link_leads_somewhere() {
    for path in pages() {
        let page = read(&path);
        for link in links(&page).iter().filter(|link| !link.contains("://")) {
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() {
                path.clone()
            } else {
                path.parent().unwrap().join(file)
            };
            assert!(target.exists(), "{}: {link} leads nowhere", path.display());
            let known =
                anchor.is_empty() || anchors(&read(&target)).iter().any(|known| known == anchor);
            assert!(known, "{}: {link} names no heading", path.display());
        }
    }
}

/// One command of a `console` block: what follows `$ `, the lines shown behind it, and the code that `$ echo $?` shows.
struct Shown {
    command: String,
    lines: Vec<String>,
    code: i32,
}

fn commands(page: &str) -> Vec<Shown> {
    let mut commands: Vec<Shown> = Vec::new();
    let (mut within, mut asks_for_code) = (false, false);
    for line in page.lines() {
        if line.starts_with("```") {
            within = line == "```console";
        } else if within && line == "$ echo $?" {
            asks_for_code = true;
        } else if within && let Some(command) = line.strip_prefix("$ ") {
            commands.push(Shown {
                command: command.into(),
                lines: Vec::new(),
                code: 0,
            });
        } else if within && let Some(last) = commands.last_mut() {
            match std::mem::take(&mut asks_for_code) {
                true => {
                    last.code = line
                        .parse()
                        .unwrap_or_else(|_| panic!("{line:?} is no exit code"))
                }
                false => last.lines.push(line.to_owned()),
            }
        }
    }
    commands
}

/// True when `line` is what is shown, in which `...` stands for anything.
fn is_shown(shown: &str, line: &str) -> bool {
    let parts: Vec<&str> = shown.split("...").collect();
    let (Some(first), Some(last)) = (parts.first(), parts.last()) else {
        return false;
    };
    let Some(mut rest) = line.strip_prefix(first) else {
        return false;
    };
    if parts.len() == 1 {
        return rest.is_empty();
    }
    for part in &parts[1..parts.len() - 1] {
        let Some(at) = rest.find(part) else {
            return false;
        };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

#[test]
fn the_commands_of_the_readme_do_what_it_shows() {
    the_commands_do_what_is_shown("README.md", "C");
}

#[test]
fn the_chinese_readme_shows_the_same_commands_which_answer_in_chinese() {
    let of = |name: &str| -> Vec<(String, i32)> {
        let shown = commands(&read(&root().join(name))).into_iter();
        shown.map(|shown| (shown.command, shown.code)).collect()
    };
    assert_eq!(of("README.md"), of("README.zh-CN.md"));
    the_commands_do_what_is_shown("README.zh-CN.md", "zh_CN.UTF-8");
}

/// The Chinese readme leads everywhere that the English one does, to the page in Chinese where there is one, and has the same tables.
#[test]
fn the_chinese_readme_has_what_the_english_one_has() {
    let [english, chinese] = ["README.md", "README.zh-CN.md"].map(|name| read(&root().join(name)));
    let own = links(&chinese);
    let twin = |link: &String| {
        let page = match link.strip_prefix("docs/") {
            Some("glossary.md") => "docs/zh/words.md".to_owned(),
            Some(page) => format!("docs/zh/{page}"),
            None => link.clone(),
        };
        own.contains(link) || own.contains(&page)
    };
    let other = |link: &&String| link.as_str() != "README.zh-CN.md";
    let missing: Vec<String> = links(&english)
        .iter()
        .filter(other)
        .filter(|link| !twin(link))
        .cloned()
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
    let rows = |page: &str| page.lines().filter(|line| line.starts_with('|')).count();
    assert!(rows(&chinese) >= rows(&english), "a table lacks rows");
}

/// The drawings that the pages speak of stand beside the reader, and those of the tests where a checkout has them. Commands of other
/// programs are shown, not run.
#[test]
fn the_commands_of_tutorials_and_how_to_do_what_they_show() {
    the_commands_do_what_is_shown("docs/how-to.md", "C");
    for name in ["librecad", "vscode", "python"] {
        the_commands_do_what_is_shown(&format!("docs/tutorials/{name}.md"), "C");
    }
}

/// The suppression that the how-to shows, in both languages, suppresses what it speaks of.
#[test]
fn the_suppression_of_the_how_to_suppresses() {
    for name in ["docs/how-to.md", "docs/zh/how-to.md"] {
        let page = read(&root().join(name));
        let mut blocks = page.split("```toml").skip(1);
        let lines = blocks.find(|block| block.contains(".suppress.")).unwrap();
        let lines = lines.split("```").next().unwrap();
        let folder = tempfile::tempdir().unwrap();
        std::fs::copy(
            root().join("docs/pictures/gap.dxf"),
            folder.path().join("gap.dxf"),
        )
        .unwrap();
        std::fs::write(folder.path().join("wedm.toml"), lines).unwrap();
        let output = wedm(folder.path(), &["check", "gap.dxf", "--deny", "warning"]);
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(
            output.status.success() && said.contains("1 suppressed"),
            "{name}: {said}"
        );
    }
}

/// The how-to in Chinese has the same parts, commands and settings, and its commands answer in Chinese.
#[test]
fn the_how_to_has_its_twin_in_chinese() {
    let [english, chinese] =
        ["docs/how-to.md", "docs/zh/how-to.md"].map(|name| read(&root().join(name)));
    let of = |page: &str| -> Vec<(String, i32)> {
        let shown = commands(page).into_iter();
        shown.map(|shown| (shown.command, shown.code)).collect()
    };
    assert_eq!(of(&english), of(&chinese));
    let parts = |page: &str| page.lines().filter(|line| line.starts_with('#')).count();
    assert_eq!(parts(&english), parts(&chinese));
    let settings = |page: &str| -> Vec<String> {
        let blocks = page.split("```toml").skip(1);
        let lines = blocks.flat_map(|block| block.split("```").next().unwrap().lines());
        // The reason of a suppression is a sentence.
        let keys = lines.map(|line| line.split(" = \"").next().unwrap().to_owned());
        keys.collect()
    };
    assert_eq!(settings(&english), settings(&chinese));
    the_commands_do_what_is_shown("docs/zh/how-to.md", "zh_CN.UTF-8");
}

/// The tutorials in Chinese show the same commands and the same Python.
#[test]
fn the_tutorials_have_their_twins_in_chinese() {
    let python = |page: &str| -> Vec<String> {
        let blocks = page.split("```python").skip(1);
        let code = blocks.flat_map(|block| block.split("```").next().unwrap().lines());
        let calls = code.map(|line| line.split(['#', '"']).next().unwrap().trim().to_owned());
        calls.collect()
    };
    for entry in std::fs::read_dir(root().join("docs/tutorials")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let english = read(&root().join("docs/tutorials").join(&name));
        let twin = format!("docs/zh/tutorials/{name}");
        let chinese = read(&root().join(&twin));
        let of = |page: &str| -> Vec<(String, i32)> {
            let shown = commands(page).into_iter();
            shown.map(|shown| (shown.command, shown.code)).collect()
        };
        assert_eq!(of(&english), of(&chinese), "{twin}");
        assert_eq!(python(&english), python(&chinese), "{twin}");
        the_commands_do_what_is_shown(&twin, "zh_CN.UTF-8");
    }
}

fn the_commands_do_what_is_shown(page: &str, language: &str) {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("tests/data");
    std::fs::create_dir_all(&data).unwrap();
    for entry in std::fs::read_dir(root().join("tests/data")).unwrap() {
        let path = entry.unwrap().path();
        if path.is_file() {
            std::fs::copy(&path, data.join(path.file_name().unwrap())).unwrap();
        }
    }
    for name in ["die", "slot", "gap", "notch"].map(|name| format!("{name}.dxf")) {
        let drawing = root().join("docs/pictures").join(&name);
        std::fs::copy(&drawing, folder.path().join(&name)).unwrap();
        std::fs::create_dir_all(folder.path().join("drawings")).unwrap();
        std::fs::copy(&drawing, folder.path().join("drawings").join(&name)).unwrap();
    }
    let shown = commands(&read(&root().join(page)));
    let ours = shown.iter().filter_map(|shown| {
        let arguments = shown
            .command
            .strip_prefix("wedm ")
            .or_else(|| shown.command.strip_prefix("cargo run --release -- "))?;
        Some((shown, arguments.split_whitespace().collect::<Vec<_>>()))
    });
    let mut count = 0;
    for (shown, arguments) in ours {
        let output = wedm_in(language, folder.path(), &arguments);
        let printed = [output.stdout, output.stderr]
            .map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
            .concat();
        assert_eq!(
            output.status.code(),
            Some(shown.code),
            "{}: {printed}",
            shown.command
        );
        let (left_out, lines): (Vec<_>, Vec<_>) =
            shown.lines.iter().partition(|line| *line == "...");
        for line in &lines {
            assert!(
                printed.lines().any(|other| is_shown(line, other)),
                "{}: no line {line:?} in\n{printed}",
                shown.command
            );
        }
        for printed in printed.lines().filter(|_| left_out.is_empty()) {
            assert!(
                printed.is_empty() || lines.iter().any(|line| is_shown(line, printed)),
                "{page}, {}: {printed:?} is not shown, nor `...` in its place",
                shown.command
            );
        }
        count += 1;
    }
    assert!(count >= 1, "{page} shows {count} commands");
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
        "docs/pictures/{name} is out of date; update it with: UPDATE_EXPECT=1 cargo test --test docs"
    );
}

#[test]
fn the_pictures_are_what_the_program_draws() {
    let folder = tempfile::tempdir().unwrap();
    let pictures = root().join("docs/pictures");
    for entry in std::fs::read_dir(&pictures).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "dxf") {
            let output = wedm(
                folder.path(),
                &["draw", path.to_str().unwrap(), "--side", "opening"],
            );
            let name = path.with_extension("svg");
            check_picture(
                name.file_name().unwrap().to_str().unwrap(),
                &String::from_utf8(output.stdout).unwrap(),
            );
        }
    }
    assert!(wedm(folder.path(), &["demo", "."]).status.success());
    check_picture("plate.svg", &read(&folder.path().join("demo.svg")));
}

#[test]
fn contributing_says_what_each_dependency_is_for() {
    let page = read(&root().join("CONTRIBUTING.md"));
    let (_, table) = page.split_once("## What each dependency is for").unwrap();
    let rows = table.lines().filter_map(|line| line.strip_prefix("| "));
    let cells = rows.filter_map(|row| row.split(" |").next());
    // The first row is the heading.
    let named = |of_tests: bool| {
        let cells = cells.clone().skip(1).filter_map(move |cell| {
            let tests = cell.strip_prefix("*for tests:* ");
            if of_tests {
                tests
            } else {
                tests.is_none().then_some(cell)
            }
        });
        let names = cells.flat_map(|cell| cell.split(", "));
        names.map(str::to_owned).collect::<BTreeSet<_>>()
    };
    let manifest: toml::Table = read(&root().join("Cargo.toml")).parse().unwrap();
    let keys = |table: &toml::Value| table.as_table().unwrap().keys().cloned().collect();
    let mut own: BTreeSet<String> = keys(&manifest["dependencies"]);
    own.append(&mut keys(&manifest["target"]["cfg(unix)"]["dependencies"]));
    assert_eq!(named(false), own);
    assert_eq!(named(true), keys(&manifest["dev-dependencies"]));
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

/// What stands behind the first word of a page's "Default severity: ".
fn severity_on_page(rule: Rule) -> String {
    let name = rule.name();
    let page = read(&root().join(format!("docs/rules/{name}.md")));
    let severity = page
        .split("Default severity: ")
        .nth(1)
        .and_then(|rest| rest.split(['.', '\n']).next());
    severity
        .unwrap_or_else(|| panic!("the page of {name} says no severity"))
        .to_owned()
}

/// The defaults of the rules stand in comments, since a rule that is set is no milder anywhere. Update them with
/// `UPDATE_EXPECT=1 cargo test --test docs`.
#[test]
fn the_page_of_settings_shows_the_default_of_every_rule() {
    let path = root().join("docs/settings.md");
    let page = read(&path);
    let (head, rest) = page.split_once("[rules] ").unwrap();
    let (first, rest) = rest.split_once('\n').unwrap();
    let (_, tail) = rest.split_once("```").unwrap();
    let row = |rule: Rule| {
        let default = format!("{:?}", rule.default_severity()).to_lowercase();
        let on_page = severity_on_page(rule);
        let note = on_page
            .strip_prefix(&default)
            .unwrap_or_else(|| {
                panic!(
                    "docs/rules/{}.md says {on_page}, not {default}",
                    rule.name()
                )
            })
            .trim_start_matches([',', ';', ' ']);
        let row = format!("# {} = \"{default}\"", rule.name());
        match note {
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
        "docs/settings.md is out of date; update it with: UPDATE_EXPECT=1 cargo test --test docs"
    );
}

/// The `wedm.toml` on the page of settings is read without a fault, and all of it are the defaults.
#[test]
fn the_settings_shown_are_the_defaults() {
    let page = read(&root().join("docs/settings.md"));
    let example = page
        .split("```toml\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next())
        .unwrap();
    let (all, errors) = wedm::settings::from_toml(example);
    assert!(errors.is_empty(), "{errors:?}");
    // That a key is set counts, whichever value it has.
    let (set, default) = (Effective::of(&all).passes, Effective::default().passes);
    assert_eq!(set.sequence(), default.sequence());
    assert_eq!(set.skim_corner(), default.skim_corner());
    let shown = Effective {
        passes: default,
        states_unit: false,
        stated_layout: None,
        stated_direction: None,
        stated_lead_in: None,
        ..Effective::of(&all)
    };
    assert_eq!(shown, Effective::default());
}

/// The floors of `docs/architecture.md`, from the top down: the names in the first column of its picture.
fn floors() -> Vec<Vec<String>> {
    let page = read(&root().join("docs/architecture.md"));
    let rows = page
        .lines()
        .filter_map(|line| line.strip_prefix("│ ")?.split_once('│'));
    let names = |cell: &str| {
        cell.split_whitespace()
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    rows.map(|(cell, _)| names(cell))
        .filter(|floor| !floor.is_empty())
        .collect()
}

/// Sources without their comments and tests, each with the room that it belongs to: `geometry` for `geometry.rs` and `geometry/arc.rs`.
fn sources() -> Vec<(String, PathBuf, String)> {
    let folder = root().join("src");
    let mut of_tests = Vec::new();
    let mut sources = Vec::new();
    for entry in walkdir::WalkDir::new(&folder).sort_by_file_name() {
        let path = entry.unwrap().into_path();
        if path.extension().is_none_or(|ending| ending != "rs") {
            continue;
        }
        let within = path.strip_prefix(&folder).unwrap().with_extension("");
        let room = within.iter().next().unwrap().to_str().unwrap().to_owned();
        let mut source = String::new();
        let mut is_for_tests = false;
        for line in read(&path).lines() {
            let code = line.split("//").next().unwrap();
            if is_for_tests && let Some(name) = code.strip_prefix("mod ") {
                // What stands behind a module of tests within a file is of tests too.
                let Some(name) = name.strip_suffix(';') else {
                    break;
                };
                let beside = if within.ends_with("mod") {
                    within.parent().unwrap().into()
                } else {
                    within.clone()
                };
                of_tests.push(folder.join(beside).join(name));
            }
            is_for_tests = code.trim() == "#[cfg(test)]";
            source += code;
            source.push('\n');
        }
        sources.push((room, path, source));
    }
    let is_of_tests = |path: &Path| {
        of_tests
            .iter()
            .any(|test| path.with_extension("") == *test || path.starts_with(test))
    };
    sources.retain(|(room, path, _)| !is_of_tests(path) && room != "lib" && room != "main");
    sources
}

/// What a source names behind `crate::`: the first name, or those of a list in braces.
fn rooms_named(source: &str) -> Vec<String> {
    let name_at = |text: &str| {
        let is_of_name = |c: &char| c.is_alphanumeric() || *c == '_';
        text.trim_start()
            .chars()
            .take_while(is_of_name)
            .collect::<String>()
    };
    let mut rooms = Vec::new();
    for rest in source.split("crate::").skip(1) {
        let Some(list) = rest.strip_prefix('{') else {
            rooms.push(name_at(rest));
            continue;
        };
        let (mut depth, mut begins) = (1, vec![0]);
        for (at, c) in list.char_indices() {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 1 => begins.push(at + 1),
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
        rooms.extend(begins.into_iter().map(|begin| name_at(&list[begin..])));
    }
    rooms
}

/// Every room stands in the picture of the floors, and imports only from floors below its own.
#[test]
fn no_room_imports_upwards() {
    let floors = floors();
    let floor_of = |room: &str| {
        floors
            .iter()
            .position(|floor| floor.iter().any(|name| name == room))
    };
    let sources = sources();
    for (room, path, _) in &sources {
        assert!(
            floor_of(room).is_some(),
            "{} is on no floor of docs/architecture.md",
            path.display()
        );
    }
    for room in floors.iter().flatten() {
        assert!(
            sources.iter().any(|(other, ..)| other == room),
            "docs/architecture.md draws {room}, which is not in src"
        );
    }
    let mut upwards = Vec::new();
    for (room, path, source) in &sources {
        let named = rooms_named(source);
        let wrong = named.iter().filter(|other| {
            *other != room && floor_of(other).is_some_and(|floor| Some(floor) <= floor_of(room))
        });
        upwards.extend(wrong.map(|other| format!("{} imports {other}", path.display())));
    }
    assert!(
        upwards.is_empty(),
        "not from a floor below:\n{}",
        upwards.join("\n")
    );
    let program = sources
        .iter()
        .find(|(_, path, _)| path.ends_with("document.rs"))
        .unwrap();
    assert!(rooms_named(&program.2).len() > 3, "imports are not read");
}

/// The paths of a tree of imports, each for itself.
fn paths_of(tree: &str) -> Vec<String> {
    let Some((before, list)) = tree.split_once('{') else {
        return vec![tree.trim().to_owned()];
    };
    let list = list.rsplit_once('}').map_or(list, |(list, _)| list);
    let (mut parts, mut depth) = (vec![String::new()], 0);
    for c in list.chars() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        match parts.last_mut() {
            Some(part) if c != ',' || depth > 0 => part.push(c),
            _ => parts.push(String::new()),
        }
    }
    let parts = parts.iter().filter(|part| !part.trim().is_empty());
    parts
        .flat_map(|part| paths_of(part))
        .map(|part| before.trim().to_owned() + &part)
        .collect()
}

/// A path from the root of the crate.
type Names = Vec<String>;

/// What a module takes from elsewhere: the path of each with the name that it has here, and the paths that the code spells out without importing them.
fn imports_of(own: &[String], source: &str) -> (Vec<(String, Names)>, Vec<Names>) {
    let from_root = |path: &str| {
        let mut names = path.split("::").map(str::trim).peekable();
        let mut whole = match names.next_if_eq(&"crate") {
            Some(_) => Vec::new(),
            None => own.to_vec(),
        };
        _ = names.next_if_eq(&"self");
        while names.next_if_eq(&"super").is_some() {
            whole.pop();
        }
        whole.extend(names.filter(|name| *name != "self").map(str::to_owned));
        whole
    };
    let (mut imported, mut spelled) = (Vec::new(), Vec::new());
    for statement in source.split(';') {
        let mut lines = statement.lines();
        let is_import = |line: &&str| {
            let line = line.trim_start();
            line.starts_with("use ") || line.starts_with("pub") && line.contains(" use ")
        };
        let code = match lines.find(is_import) {
            None => statement,
            Some(line) => {
                let (before, _) = statement.split_once(line).unwrap();
                let tree = &statement[before.len() + line.find("use ").unwrap() + 4..];
                imported.extend(paths_of(tree).iter().map(|path| {
                    let (path, name) = match path.split_once(" as ") {
                        Some((path, name)) => (path, Some(name.trim().to_owned())),
                        None => (path.as_str(), None),
                    };
                    let whole = from_root(path);
                    (name.or(whole.last().cloned()).unwrap_or_default(), whole)
                }));
                before
            }
        };
        for (at, _) in code
            .match_indices("crate::")
            .chain(code.match_indices("super::"))
        {
            let goes_on = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
            if !code[..at].ends_with(goes_on) {
                let end = code[at..].find(|c| !goes_on(c)).unwrap_or(code.len() - at);
                spelled.push(from_root(code[at..][..end].trim_end_matches(':')));
            }
        }
    }
    (imported, spelled)
}

/// Nor do files import each other, directly or by way of others. A name that a module hands on is imported from the file that it comes from. A module and what
/// lies within it are one.
#[test]
fn no_files_import_each_other() {
    let folder = root().join("src");
    let module = |path: &Path| {
        let within = path.strip_prefix(&folder).unwrap().with_extension("");
        let names = within.iter().map(|name| name.to_str().unwrap().to_owned());
        names.filter(|name| name != "mod").collect::<Names>()
    };
    let read: BTreeMap<Names, _> = sources()
        .into_iter()
        .map(|(_, path, source)| {
            let own = module(&path);
            let imports = imports_of(&own, &source);
            (own, imports)
        })
        .collect();
    let mut handed_on: BTreeMap<&[String], BTreeMap<&str, &Names>> = BTreeMap::new();
    for (own, (imported, _)) in &read {
        let named = imported.iter().map(|(name, path)| (name.as_str(), path));
        handed_on.insert(own, named.collect());
    }
    let file_of = |path: &Names| {
        let mut path = path.clone();
        // No name is handed on more often than this.
        for _ in 0..8 {
            let within = (0..=path.len())
                .rev()
                .find(|end| read.contains_key(&path[..*end]));
            let Some(within) = within else {
                return Names::new();
            };
            let (module, rest) = path.split_at(within);
            let names = handed_on.get(module);
            let from = rest.first().and_then(|name| names?.get(name.as_str()));
            path = match from {
                Some(from) if **from != path => from.iter().chain(&rest[1..]).cloned().collect(),
                _ => return module.to_vec(),
            };
        }
        panic!("{path:?} is handed on in a circle");
    };
    let mut imports: BTreeMap<&Names, BTreeSet<Names>> = BTreeMap::new();
    for (own, (imported, spelled)) in &read {
        let paths = imported.iter().map(|(_, path)| path).chain(spelled);
        let mut named: BTreeSet<Names> = paths.map(file_of).collect();
        named.retain(|other| !own.starts_with(other) && !other.starts_with(own));
        imports.insert(own, named);
    }
    let count: usize = imports.values().map(BTreeSet::len).sum();
    assert!(count > 2000, "{count}: imports are not read");
    // What imports nothing that is left is in no circle, nor is what nothing that is left imports.
    loop {
        let before = imports.len();
        let left: BTreeSet<Names> = imports.keys().map(|own| own.to_vec()).collect();
        imports.retain(|_, named| {
            named.retain(|other| left.contains(other));
            !named.is_empty()
        });
        let named: BTreeSet<Names> = imports.values().flatten().cloned().collect();
        imports.retain(|own, _| named.contains(*own));
        if imports.len() == before {
            break;
        }
    }
    let circles: Vec<String> = imports
        .iter()
        .map(|(own, named)| {
            let named: Vec<String> = named.iter().map(|other| other.join("/")).collect();
            format!("{} imports {}", own.join("/"), named.join(", "))
        })
        .collect();
    assert!(circles.is_empty(), "{}", circles.join("\n"));
}

/// No file has more than 500 lines but one that says at its head why it has.
#[test]
fn files_are_short() {
    let length = |path: &PathBuf| read(path).lines().count();
    let says_why = |path: &PathBuf| {
        let text = read(path);
        let mut head = text.lines().take_while(|line| line.starts_with("//!"));
        head.any(|line| line.contains("One file, since"))
    };
    let is_code = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "rs");
    let long: Vec<String> = ["src", "tests"]
        .into_iter()
        .flat_map(files_in)
        .filter(|path| is_code(path) && length(path) > 500 && !says_why(path))
        .map(|path| path.strip_prefix(root()).unwrap().display().to_string())
        .collect();
    // Tests that are still to be taken apart.
    let to_be_split = [
        "tests/beside.rs",
        "tests/convert.rs",
        "tests/docs.rs",
        "tests/faults/inject.rs",
        "tests/fit.rs",
        "tests/holes.rs",
        "tests/incremental.rs",
        "tests/milling.rs",
        "tests/open.rs",
        "tests/pairs/cases.rs",
        "tests/pairs/dead_ends.rs",
        "tests/passes.rs",
        "tests/paths.rs",
        "tests/server/program_text.rs",
        "tests/settings.rs",
    ];
    assert_eq!(long, to_be_split);
}

/// Code spans of a page that name a file or folder: relative to the root, or to `src`. What has a capital letter for a name that one
/// chooses, as `docs/rules/NAME.md`, is none.
fn paths_named(page: &str) -> Vec<String> {
    let spans = page
        .lines()
        .flat_map(|line| line.split('`').skip(1).step_by(2));
    let is_path = |span: &&str| {
        let is_of_path = |c: char| c.is_alphanumeric() || "/._-".contains(c);
        let is_file = [".rs", ".md", ".toml", ".json", ".ts", ".mjs"]
            .iter()
            .any(|ending| span.ends_with(ending));
        let is_other = ["wedm/", "textDocument/", "workspace/", "target/"]
            .iter()
            .any(|space| span.starts_with(space));
        (is_file || span.contains('/'))
            && span.chars().all(is_of_path)
            && !is_other
            && !span.contains("NAME")
            && *span != "wedm.toml"
    };
    spans.filter(is_path).map(str::to_owned).collect()
}

#[test]
fn the_files_that_the_maps_name_are_there() {
    for name in ["docs/architecture.md", "CONTRIBUTING.md"] {
        let named = paths_named(&read(&root().join(name)));
        assert!(named.len() > 10, "{name}: {} paths", named.len());
        for path in named {
            let there = root().join(&path).exists() || root().join("src").join(&path).exists();
            assert!(there, "{name} names {path}, which is not there");
        }
    }
}

/// The pauses before a server is started again are those that the tests of the clients hold theirs against.
#[test]
fn the_page_says_the_pauses_of_the_clients() {
    let table: serde_json::Value =
        serde_json::from_str(&read(&root().join("clients/restarts.json"))).unwrap();
    let pauses = table["cases"][0]["pauses"].as_array().unwrap();
    let [first, .., fifth, last] = pauses.as_slice() else {
        panic!("{pauses:?}")
    };
    assert!(first == 0 && last.is_null(), "{pauses:?}");
    let between: Vec<String> = pauses[1..pauses.len() - 2]
        .iter()
        .map(ToString::to_string)
        .collect();
    let said = format!("after {} and {fifth} seconds", between.join(", "));
    let page = read(&root().join("docs/protocol.md"));
    assert!(
        page.contains(&said),
        "docs/protocol.md does not say {said:?}"
    );
}
