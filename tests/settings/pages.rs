//! The keys on the pages, in the protocol and in both languages.

use super::*;

fn type_of(row: &Row, schema: &Value) -> String {
    let listed = |words: Vec<(&str, &str)>| {
        let names: Vec<String> = words.iter().map(|(name, _)| format!("`{name}`")).collect();
        names.join(", ")
    };
    let range = range(row).map_or_else(String::new, |range| format!(" {range}"));
    let own = words(schema);
    if !own.is_empty() {
        return listed(own);
    }
    match schema["type"].as_str() {
        Some("number") => format!("number{range}"),
        None if is_length(row) => format!("number{range}, or table of numbers by handle"),
        Some("integer") => format!("whole number{range}"),
        Some("boolean") => "`true`, `false`".into(),
        Some("string") => "a word".into(),
        Some("array") if schema["items"]["type"] == "number" => {
            format!("list of numbers{range}, at least one")
        }
        Some("array") => "list of lines".into(),
        Some("object") if ["profiles", "drawings"].contains(&row.key.as_str()) => {
            "table of tables by name".into()
        }
        Some("object") if schema["additionalProperties"]["type"] == "array" => {
            "table of lists of texts by name".into()
        }
        Some("object") => format!(
            "table of {} by name",
            listed(words(&schema["additionalProperties"]))
        ),
        _ => "point `[x, y]`, or table of points by handle".into(),
    }
}

#[test]
fn the_page_of_settings_lists_every_key() {
    let mut table = String::new();
    for row in of_documents() {
        let schema = schema_of(&row);
        let default = row
            .default
            .as_deref()
            .map(|default| default.trim_matches('"'));
        let default = default.map_or("not set".into(), |default| format!("`{default}`"));
        let of_words: Vec<String> = words(&schema)
            .into_iter()
            .filter(|(_, meaning)| !meaning.is_empty())
            .map(|(name, meaning)| format!("`{name}`: {meaning}"))
            .collect();
        let meaning = [std::slice::from_ref(&row.meaning), &of_words[..]]
            .concat()
            .join(" ");
        let kind = type_of(&row, &schema);
        table += &format!("| `{}` | {kind} | {default} | {meaning} |\n", row.key);
    }
    hold(
        "docs/settings.md",
        "| key | type | default | meaning |\n|---|---|---|---|\n",
        "\nA table `profiles.NAME`",
        &table,
    );
}

/// The first sentence of a meaning, and the words that may stand there.
fn in_short(row: &Row) -> String {
    let first = row.first_sentence();
    let schema = schema_of(row);
    let names: Vec<&str> = words(&schema).iter().map(|(name, _)| *name).collect();
    match names.is_empty() {
        true => first,
        false => format!("{first}: {}", names.join(", ")),
    }
}

#[test]
fn the_page_of_settings_shows_every_key_with_its_default() {
    let mut text = String::new();
    let mut table = "";
    // What wins over what is not set, and what has no default is an example.
    let example = |key: &str| match key {
        "passes.corrections" => "[0.175, 0.146, 0.140]",
        "passes.gaps" => "[0.02, 0.01, 0.01]",
        "passes.registers" => "[\"D1\", \"D2\", \"D3\"]",
        "passes.rates" => "[60, 120, 150]",
        "program.start-hole" => "2.0",
        "program.tab" => "3.0",
        "program.tab-stop" => "\"M01\"",
        "program.header" => "true",
        "job.thickness" => "40",
        "job.slug-limit" => "100",
        "linetypes" => "{ DASHED = \"punch\" }",
        "pair.drawn-as" => "\"punch\"",
        "pair.clearance" => "0.01",
        "pair.stripper" => "0.02",
        "pair.holder" => "0.005",
        "milling.tool-diameter" => "1.0",
        "milling.gap" => "0.05",
        "milling.layer" => "0.010",
        "milling.depth" => "0.2",
        "milling.wear" => "0.02",
        "milling.step" => "0.5",
        "workpieces" => "{ PUNCH = [\"PUNCH\"] }",
        "job.machine-rate" => "60",
        "layers" => "{ DIE = \"opening\", FRAME = \"ignore\" }",
        "colors" => "{ red = \"punch\" }",
        "contours" => "{ 2A = \"punch\" }",
        "docs-url" => "\"https://edm.example/rules/{rule}.html\"",
        "program.thread" => "[115.0, -10.0]",
        "program.entry" => "[105.0, -10.0]",
        "program.units" => "\"inch\"",
        "program.whole-numbers" => "\"mm\"",
        "program.drawing" => "\"plate.dxf\"",
        _ => panic!("{key} has no default and no example"),
    };
    let all = of_documents();
    let rows = all
        .iter()
        .filter(|row| !["rules", "profiles", "drawings"].contains(&row.key.as_str()));
    for row in rows {
        let (of, key) = row.key.split_once('.').unwrap_or(("", &row.key));
        if of != table {
            text += &format!("\n[{of}]\n");
            table = of;
        }
        let line = match &row.default {
            // Each says the correction where it is set.
            Some(default) if ["wire-diameter", "gap"].contains(&key) => {
                format!("# {key} = {default}")
            }
            Some(default) => format!("{key} = {default}"),
            None => format!("# {key} = {}", example(&row.key)),
        };
        text += &format!("{line:<26} # {}\n", in_short(row));
    }
    hold(
        "docs/settings.md",
        "commented out:\n\n```toml\n",
        "\n[rules]",
        &text,
    );
    let (settings, errors) = wedm::settings::from_toml(&text.replace("\n# ", "\n"));
    // Some keys have an effect only beside another value than the default of a second one.
    let mut errors = errors;
    errors.retain(|error| !error.message.contains("has no effect"));
    assert_eq!(errors, []);
    let program = settings.program.unwrap();
    assert!(settings.layers.is_some() && program.thread.is_some() && program.units.is_some());
}

/// What stands between two marks, each time.
fn between<'a>(text: &'a str, from: &str, to: &str) -> Vec<&'a str> {
    let parts = text.split(from).skip(1);
    let mut found: Vec<&str> = parts
        .filter_map(|part| part.split_once(to).map(|(part, _)| part))
        .collect();
    found.sort_unstable();
    found
}

#[test]
fn every_meaning_has_its_twin_with_the_same_links_and_code() {
    let code = |text: &str| {
        let mut code: Vec<String> = text
            .split('`')
            .skip(1)
            .step_by(2)
            .map(str::to_owned)
            .collect();
        code.sort();
        code
    };
    let same = |name: &str, english: &str, chinese: &str| {
        let links = |text| {
            between(text, "](", ")")
                .into_iter()
                .map(str::to_owned)
                .collect::<Vec<_>>()
        };
        assert_eq!(links(chinese), links(english), "links of {name}");
        assert_eq!(code(chinese), code(english), "code of {name}");
        let is_chinese = chinese.contains(|letter| ('\u{4e00}'..='\u{9fff}').contains(&letter));
        assert!(is_chinese && chinese.ends_with('。'), "{name}: {chinese}");
    };
    for row in rows() {
        same(&row.key, &row.meaning, &in_chinese(&row, None));
        if !row.key.starts_with("drawings.NAME") {
            for (word, meaning) in words(&schema_of(&row)) {
                if !meaning.is_empty() {
                    same(
                        &format!("{} = {word}", row.key),
                        meaning,
                        &in_chinese(&row, Some(word)),
                    );
                }
            }
        }
    }
}

/// What a stranger who adds a profile would forget.
#[test]
fn a_profile_that_ships_is_named_wherever_profiles_are_listed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let places = [
        "docs/programs.md",
        "clients/vscode/src/commands/profiles.ts",
    ];
    for place in places {
        let text = std::fs::read_to_string(root.join(place)).unwrap();
        for name in wedm::settings::shipped_profiles() {
            assert!(text.contains(name), "{place} does not name {name}");
        }
    }
}
