//! Links, names of files, settings and pauses on the pages are right.

use super::*;

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

/// Both sides of a merge once stood in CHANGELOG.md.
#[test]
fn no_page_holds_both_sides_of_a_merge() {
    for path in pages() {
        let page = read(&path);
        let mark = page
            .lines()
            .find(|line| line.starts_with("<<<<<<< ") || line.starts_with(">>>>>>> "));
        assert_eq!(mark, None, "{}", path.display());
    }
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
    // The correction that follows from wire and gap is the default one.
    assert!((Effective::of(&all).correction - Effective::default().correction).abs() < 1e-12);
    let shown = Effective {
        correction: Effective::default().correction,
        corrections: Effective::default().corrections,
        wire_diameter: None,
        gap: None,
        passes: default,
        states_unit: false,
        states_order: false,
        stated_layout: None,
        stated_direction: None,
        stated_lead_in: None,
        ..Effective::of(&all)
    };
    assert_eq!(shown, Effective::default());
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
