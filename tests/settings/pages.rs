//! The keys on the pages, in the protocol and in both languages.

use super::*;

/// The language of a page: what of the two is said there.
#[derive(Clone, Copy)]
enum Tongue {
    English,
    Chinese,
}
use Tongue::{Chinese, English};

impl Tongue {
    fn say<'a>(self, english: &'a str, chinese: &'a str) -> &'a str {
        match self {
            English => english,
            Chinese => chinese,
        }
    }

    fn between(self) -> &'static str {
        self.say(", ", "、")
    }

    /// What a key means, or one of its words. In Chinese links lead to the headings of the Chinese pages.
    fn meaning(self, row: &Row, word: Option<&str>, english: &str) -> String {
        let own = match self {
            English => return english.to_owned(),
            Chinese => in_chinese(row, word),
        };
        let mut text = own.clone();
        for link in between(&own, "](programs.md#", ")") {
            let twin = twin_of(link);
            text = text.replace(
                &format!("programs.md#{link})"),
                &format!("programs.md#{twin})"),
            );
        }
        text
    }
}

/// The heading of `docs/zh/programs.md` that stands where the one of this name stands in `docs/programs.md`.
fn twin_of(anchor: &str) -> String {
    let [english, chinese] = ["docs/programs.md", "docs/zh/programs.md"].map(|name| {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        crate::docs::anchors(&std::fs::read_to_string(root.join(name)).unwrap())
    });
    let place = english.iter().position(|own| own == anchor);
    chinese[place.unwrap_or_else(|| panic!("no heading {anchor}"))].clone()
}

fn numbers(row: &Row, tongue: Tongue) -> String {
    match (tongue, row.range) {
        (English, _) => {
            format!(
                "number{}",
                range(row).map_or_else(String::new, |range| format!(" {range}"))
            )
        }
        (Chinese, None) => "数".into(),
        (Chinese, Some(range)) if range.most.is_finite() => {
            format!("{} 至 {} 的数", range.least, range.most)
        }
        (Chinese, Some(range)) if range.is_least => format!("不小于 {} 的数", range.least),
        (Chinese, Some(range)) => format!("大于 {} 的数", range.least),
    }
}

fn type_of(row: &Row, schema: &Value, tongue: Tongue) -> String {
    let listed = |words: Vec<(&str, &str)>| {
        let names: Vec<String> = words.iter().map(|(name, _)| format!("`{name}`")).collect();
        names.join(tongue.between())
    };
    let say = |english: &str, chinese: &str| tongue.say(english, chinese).to_owned();
    let number = numbers(row, tongue);
    let own = words(schema);
    if !own.is_empty() {
        return listed(own);
    }
    match schema["type"].as_str() {
        Some("number") => number,
        None if is_length(row) => {
            number + tongue.say(", or table of numbers by handle", "，或按句柄的表")
        }
        Some("integer") => match tongue {
            English => format!("whole {number}"),
            Chinese => number.replace("数", "整数"),
        },
        Some("boolean") => listed(vec![("true", ""), ("false", "")]),
        Some("string") => say("a word", "字"),
        Some("array") if schema["items"]["type"] == "number" => match tongue {
            English => number.replacen("number", "list of numbers", 1) + ", at least one",
            Chinese => format!("{number}的列表，至少一个"),
        },
        Some("array") => say("list of lines", "行的列表"),
        Some("object") if ["profiles", "drawings"].contains(&row.key.as_str()) => {
            say("table of tables by name", "按名称的表，各项又是表")
        }
        Some("object") if schema["additionalProperties"]["type"] == "array" => say(
            "table of lists of texts by name",
            "按名称的表，各项是文字的列表",
        ),
        Some("object") => {
            let names = listed(words(&schema["additionalProperties"]));
            match tongue {
                English => format!("table of {names} by name"),
                Chinese => format!("按名称的表：{names}"),
            }
        }
        _ => say(
            "point `[x, y]`, or table of points by handle",
            "点 `[x, y]`，或按句柄的表",
        ),
    }
}

/// A row for each key, as the page of a language has it.
fn table_of_keys(tongue: Tongue) -> String {
    let mut table = String::new();
    for row in of_documents() {
        let schema = schema_of(&row);
        let default = row
            .default
            .as_deref()
            .map(|default| default.trim_matches('"'));
        let not_set = tongue.say("not set", "未设置").to_owned();
        let default = default.map_or(not_set, |default| format!("`{default}`"));
        let of_words: Vec<String> = words(&schema)
            .into_iter()
            .filter(|(_, meaning)| !meaning.is_empty())
            .map(|(name, meaning)| {
                let meaning = tongue.meaning(&row, Some(name), meaning);
                format!("`{name}`{}{meaning}", tongue.say(": ", "："))
            })
            .collect();
        let meaning = tongue.meaning(&row, None, &row.meaning);
        let meaning = [std::slice::from_ref(&meaning), &of_words[..]]
            .concat()
            .join(tongue.say(" ", ""));
        let kind = type_of(&row, &schema, tongue);
        table += &format!("| `{}` | {kind} | {default} | {meaning} |\n", row.key);
    }
    table
}

#[test]
fn the_pages_of_settings_list_every_key() {
    hold(
        "docs/settings.md",
        "| key | type | default | meaning |\n|---|---|---|---|\n",
        "\nA table `profiles.NAME`",
        &table_of_keys(English),
    );
    hold(
        "docs/zh/settings.md",
        "| 键 | 类型 | 默认值 | 说明 |\n|---|---|---|---|\n",
        "\n表 `profiles.名称`",
        &table_of_keys(Chinese),
    );
}

/// The first sentence of a meaning, and the words that may stand there.
fn in_short(row: &Row, tongue: Tongue) -> String {
    let first = match tongue {
        English => row.first_sentence(),
        Chinese => {
            let plain = without_links(&in_chinese(row, None)).replace('`', "");
            plain.split('。').next().unwrap_or_default().to_owned()
        }
    };
    let schema = schema_of(row);
    let names: Vec<&str> = words(&schema).iter().map(|(name, _)| *name).collect();
    match names.is_empty() {
        true => first,
        false => [
            &first,
            tongue.say(": ", "："),
            &names.join(tongue.between()),
        ]
        .concat(),
    }
}

/// A text with the names of its links alone.
fn without_links(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some((before, link)) = rest.split_once("](") {
        let (head, name) = before.rsplit_once('[').unwrap_or((before, ""));
        plain += head;
        plain += name;
        rest = link.split_once(')').map_or("", |(_, behind)| behind);
    }
    plain + rest
}

/// What has no default is an example.
fn example(key: &str) -> &'static str {
    match key {
        "passes.corrections" => "[0.175, 0.146, 0.140]",
        "passes.gaps" => "[0.02, 0.01, 0.01]",
        "passes.registers" => "[\"D1\", \"D2\", \"D3\"]",
        "passes.rates" => "[60, 120, 150]",
        "program.start-hole" => "2.0",
        "program.tab" => "3.0",
        "program.tab-stop" => "\"M01\"",
        "program.pause-between-passes" => "\"\"",
        "program.header" => "true",
        "job.thickness" => "40",
        "job.slug-limit" => "100",
        "job.wires" => "[0.25, 0.2, 0.1]",
        "job.wire-gaps" => "[0.015, 0.012, 0.008]",
        "job.wire-rates" => "[60, 45, 12]",
        "job.title" => "\"Die plate\"",
        "job.part" => "\"A-17\"",
        "job.material" => "\"1.2379\"",
        "job.machine" => "\"Robofil 290\"",
        "job.revision" => "\"B\"",
        "job.programmer" => "\"Li\"",
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
        "program.format" => "\"iso\"",
        "program.thread" => "[115.0, -10.0]",
        "program.entry" => "[105.0, -10.0]",
        "program.units" => "\"inch\"",
        "program.whole-numbers" => "\"mm\"",
        "program.drawing" => "\"plate.dxf\"",
        _ => panic!("{key} has no default and no example"),
    }
}

/// A `wedm.toml` with every key.
fn file_of_keys(tongue: Tongue) -> String {
    let mut text = String::new();
    let mut table = "";
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
            // It follows from wire and gap, which are set above it.
            Some(default) if key == "correction" => format!("# {key} = {default}"),
            Some(default) => format!("{key} = {default}"),
            None => format!("# {key} = {}", example(&row.key)),
        };
        text += &format!("{line:<26} # {}\n", in_short(row, tongue));
    }
    text
}

#[test]
fn the_pages_of_settings_show_every_key_with_its_default() {
    let text = file_of_keys(English);
    hold(
        "docs/settings.md",
        "from wire and gap:\n\n```toml\n",
        "\n[rules]",
        &text,
    );
    hold(
        "docs/zh/settings.md",
        "也注释掉：\n\n```toml\n",
        "\n[rules]",
        &file_of_keys(Chinese),
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
        "docs/zh/programs.md",
        "clients/picture/profiles.ts",
    ];
    for place in places {
        let text = std::fs::read_to_string(root.join(place)).unwrap();
        for name in wedm::settings::shipped_profiles() {
            assert!(text.contains(name), "{place} does not name {name}");
        }
    }
}
