//! The documentation is true: its links lead somewhere, its commands do what it shows, its pictures are what the program
//! draws, and every rule has its page.

mod chinese;
mod commands_shown;
mod floors;
mod pages;
mod rules;

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
pub(crate) fn anchors(page: &str) -> Vec<String> {
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

/// One command of a `console` block: what follows `$ `, the lines shown after it, and the code that `$ echo $?` shows.
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
    // The reader's own drawing.
    let own = folder.path().join("part.dxf");
    std::fs::copy(root().join("tests/data/tight.dxf"), own).unwrap();
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
