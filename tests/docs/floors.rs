//! The structure of `src`: no import upwards or in a circle, no file too long.

use super::*;

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
                // What stands after a module of tests within a file is of tests too.
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

/// What a source names after `crate::`: the first name, or those of a list in braces.
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
    assert!(long.is_empty(), "{long:?}");
}
