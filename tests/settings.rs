//! Wherever the keys of the settings are listed, the list is that of `src/settings/keys.rs`: the tables of the documentation, the file
//! that the page of settings shows, the settings page of VS Code, the types of the Python client.
//!
//! `UPDATE_EXPECT=1 cargo test --test settings` writes them anew.

use serde_json::{Map, Value, json};
use std::path::Path;
use wedm::rule::Rule;
use wedm::settings::{Row, camel_case, rows};

/// What stands between two lines of a file, the lines left out.
fn hold(file: &str, from: &str, to: &str, expected: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let text = std::fs::read_to_string(&path).unwrap();
    let begin = text
        .find(from)
        .unwrap_or_else(|| panic!("{file}: no {from:?}"));
    let begin = begin + from.len();
    let length = text[begin..]
        .find(to)
        .unwrap_or_else(|| panic!("{file}: no {to:?}"));
    if text[begin..begin + length] == *expected {
        return;
    }
    assert!(
        std::env::var_os("UPDATE_EXPECT").is_some(),
        "{file} does not list the settings as they are; update it with: UPDATE_EXPECT=1 cargo test --test settings"
    );
    let text = [&text[..begin], expected, &text[begin + length..]].concat();
    std::fs::write(&path, text).unwrap();
}

/// The schema of a key, without references and without the null that every key may be.
fn schema_of(row: &Row) -> Value {
    let protocol = wedm::protocol::schema();
    let mut schema = protocol["settings"].clone();
    for part in row.key.split('.') {
        schema = resolved(&protocol, &schema);
        schema = match part {
            "NAME" => schema["additionalProperties"].clone(),
            part => schema["properties"][camel_case(part)].clone(),
        };
    }
    resolved(&protocol, &schema)
}

/// A length, or one for each contour.
fn is_length(row: &Row) -> bool {
    row.key == "program.tab"
}

fn resolved(protocol: &Value, schema: &Value) -> Value {
    if let Some(reference) = schema["$ref"].as_str() {
        let name = reference.rsplit('/').next().unwrap();
        return resolved(protocol, &protocol["$defs"][name]);
    }
    if let Some(choices) = schema["anyOf"].as_array() {
        let others: Vec<&Value> = choices.iter().filter(|one| one["type"] != "null").collect();
        if let [one] = others[..] {
            return resolved(protocol, one);
        }
    }
    let mut schema = schema.clone();
    if let Some(types) = schema["type"].as_array() {
        schema["type"] = types.iter().find(|one| **one != "null").unwrap().clone();
    }
    for within in ["additionalProperties", "items"] {
        if schema[within].is_object() {
            schema[within] = resolved(protocol, &schema[within]);
        }
    }
    schema
}

/// The words of a closed set, with what each means.
fn words(schema: &Value) -> Vec<(&str, &str)> {
    let documented = schema["oneOf"].as_array().into_iter().flatten();
    let documented = documented.flat_map(|one| {
        let meaning = one["description"].as_str().unwrap_or_default();
        let names = one["enum"].as_array().into_iter().flatten();
        let names = names.chain(std::iter::once(&one["const"]));
        names.filter_map(move |name| Some((name.as_str()?, meaning)))
    });
    let bare = schema["enum"].as_array().into_iter().flatten();
    documented
        .chain(bare.filter_map(|name| Some((name.as_str()?, ""))))
        .collect()
}

fn range(row: &Row) -> Option<String> {
    let range = row.range?;
    let least = range.least;
    Some(match (range.most.is_finite(), range.is_least) {
        (true, _) => format!("from {least} to {}", range.most),
        (false, true) => format!("from {least} on"),
        (false, false) => format!("above {least}"),
    })
}

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

fn of_documents() -> Vec<Row> {
    let mut rows = rows();
    rows.retain(|row| !row.key.contains("NAME"));
    rows
}

#[test]
fn the_protocol_lists_every_key() {
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
        "docs/protocol.md",
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
    assert_eq!(errors, []);
    let program = settings.program.unwrap();
    assert!(settings.layers.is_some() && program.thread.is_some() && program.units.is_some());
}

/// The sentences of VS Code's settings page, in English and in Chinese, by the names that the manifest has for them.
#[derive(Default)]
struct Sentences(Vec<(String, [String; 2])>);

impl Sentences {
    /// The name of a sentence in the manifest.
    fn named(&mut self, name: &str, english: &str, chinese: &str) -> Value {
        let name = format!("settings.{name}");
        let reference = format!("%{name}%");
        let english = english.replace('\n', " ");
        self.0.push((name, [english, chinese.to_owned()]));
        json!(reference)
    }

    /// The lines of a bundle.
    fn of(&self, language: usize) -> String {
        let line = |(name, both): &(String, [String; 2])| {
            format!("  {}: {}", json!(name), json!(both[language]))
        };
        self.0.iter().map(line).collect::<Vec<_>>().join(",\n")
    }
}

/// What a key means, or one of its words, in Chinese.
fn in_chinese(row: &Row, word: Option<&str>) -> String {
    let name = || word.map_or(row.key.clone(), |word| format!("{} = {word}", row.key));
    row.in_chinese(word)
        .unwrap_or_else(|| panic!("src/message/meanings.rs does not have {}", name()))
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

/// The schema of a key as VS Code's settings page takes it.
fn editor_schema(row: &Row, schema: &Value, is_root: bool, sentences: &mut Sentences) -> Value {
    let mut of = Map::new();
    let null = |name: &str| {
        if is_root {
            json!([name, "null"])
        } else {
            json!(name)
        }
    };
    let own = words(schema);
    match schema["type"].as_str() {
        Some(name) => of.insert("type".into(), null(name)),
        None if is_length(row) => of.insert("type".into(), json!(["number", "object", "null"])),
        None if own.is_empty() => of.insert("type".into(), json!(["array", "object", "null"])),
        None => of.insert("type".into(), null("string")),
    };
    if is_root {
        of.insert("default".into(), Value::Null);
    }
    if !own.is_empty() {
        let default = row
            .default
            .as_deref()
            .map(|default| default.trim_matches('"'));
        let names = own.iter().map(|(name, _)| json!(name));
        of.insert(
            "enum".into(),
            names.chain(is_root.then_some(Value::Null)).collect(),
        );
        if own.iter().any(|(_, meaning)| !meaning.is_empty()) {
            let mut meanings: Vec<Value> = own
                .iter()
                .map(|(name, meaning)| match meaning.is_empty() {
                    true => json!(""),
                    false => sentences.named(
                        &format!("{}.{name}", row.key),
                        meaning,
                        &in_chinese(row, Some(name)),
                    ),
                })
                .collect();
            if is_root {
                meanings.push(sentences.named(
                    &format!("{}.null", row.key),
                    &format!("Not set: {}.", default.unwrap_or("as described")),
                    &format!("未设置：{}。", default.unwrap_or("见说明")),
                ));
            }
            of.insert("enumDescriptions".into(), meanings.into());
        }
    }
    let whole = |number: f64| match number.fract() == 0.0 {
        true => json!(number as i64),
        false => json!(number),
    };
    let mut bounds = Map::new();
    if let Some(range) = row.range {
        let least = if range.is_least {
            "minimum"
        } else {
            "exclusiveMinimum"
        };
        bounds.insert(least.into(), whole(range.least));
        if range.most.is_finite() {
            bounds.insert("maximum".into(), whole(range.most));
        }
    }
    match schema["type"].as_str() {
        Some("array") => {
            let mut items = json!({ "type": schema["items"]["type"] });
            items.as_object_mut().unwrap().extend(bounds);
            of.insert("items".into(), items);
        }
        Some("object") => {
            let of_each = &schema["additionalProperties"];
            if of_each["type"] == "array" {
                let list = json!({ "type": "array", "items": { "type": "string" } });
                of.insert("additionalProperties".into(), list);
                return Value::Object(of);
            }
            let names: Vec<&str> = words(of_each).iter().map(|(name, _)| *name).collect();
            of.insert(
                "additionalProperties".into(),
                json!({ "type": "string", "enum": names }),
            );
        }
        _ => of.extend(bounds),
    }
    Value::Object(of)
}

/// JSON with lists in one line, as package.json is written.
fn written(value: &Value, indent: usize) -> String {
    let Value::Object(entries) = value else {
        let text = serde_json::to_string(value).unwrap();
        return match value {
            Value::Array(items) => {
                let items: Vec<String> = items.iter().map(|item| item.to_string()).collect();
                format!("[{}]", items.join(", "))
            }
            _ => text,
        };
    };
    let inner = " ".repeat(indent + 2);
    let entries = entries
        .iter()
        .map(|(key, value)| format!("{inner}\"{key}\": {}", written(value, indent + 2)));
    let entries: Vec<String> = entries.collect();
    format!("{{\n{}\n{}}}", entries.join(",\n"), " ".repeat(indent))
}

#[test]
fn the_settings_page_of_vs_code_has_every_key() {
    let docs = "https://github.com/wedm/wedm/blob/main/docs/";
    let mut entries = Vec::new();
    let mut sentences = Sentences::default();
    let of_profiles: Map<String, Value> = rows()
        .iter()
        .filter_map(|row| {
            let key = row.key.strip_prefix("profiles.NAME.")?;
            let mut schema = editor_schema(row, &schema_of(row), false, &mut sentences);
            let chinese = in_chinese(row, None);
            schema["description"] = sentences.named(&row.key, &row.plain_meaning(), &chinese);
            Some((camel_case(key), schema))
        })
        .collect();
    for (index, row) in of_documents().iter().enumerate() {
        let mut schema = match row.key.as_str() {
            "profiles" => json!({
                "type": ["object", "null"],
                "default": null,
                "additionalProperties": { "type": "object", "additionalProperties": false, "properties": of_profiles },
            }),
            "drawings" => json!({ "type": ["object", "null"], "default": null }),
            _ => editor_schema(row, &schema_of(row), true, &mut sentences),
        };
        schema["order"] = json!(10 + index);
        if row.key == "contours" {
            schema["scope"] = json!("resource");
        }
        // The pages of the rules are there in Chinese, too.
        let [english, chinese] = [
            (row.meaning.clone(), docs.to_owned()),
            (in_chinese(row, None), format!("{docs}zh/")),
        ]
        .map(|(meaning, rules)| {
            meaning
                .replace("](rules/", &format!("]({rules}rules/"))
                .replace("](programs", &format!("]({docs}programs"))
        });
        let unset = row
            .default
            .as_deref()
            .filter(|_| words(&schema_of(row)).is_empty());
        let [english, chinese] = match unset {
            None => [english, chinese],
            Some(default) => [
                format!("{english} Not set: {default}."),
                format!("{chinese}未设置：{default}。"),
            ],
        };
        if row.key == "rules" {
            schema["propertyNames"] = json!({ "enum": Rule::ALL.map(Rule::name).to_vec() });
        }
        schema["markdownDescription"] = sentences.named(&row.key, &english, &chinese);
        let key: Vec<String> = row.key.split('.').map(camel_case).collect();
        entries.push(format!(
            "        \"wedm.{}\": {}",
            key.join("."),
            written(&schema, 8)
        ));
    }
    hold(
        "clients/vscode/package.json",
        "\"description\": \"%own.trace.server%\"\n        },\n",
        "\n      }\n    }",
        &entries.join(",\n"),
    );
    for (language, file) in ["package.nls.json", "package.nls.zh-cn.json"]
        .iter()
        .enumerate()
    {
        let last = match language {
            0 => "\"editor.drawing\": \"Picture (Wire EDM)\",\n",
            _ => "\"editor.drawing\": \"图片（线切割）\",\n",
        };
        hold(
            &format!("clients/vscode/{file}"),
            last,
            "\n}\n",
            &sentences.of(language),
        );
    }
}

fn python_type(row: &Row, schema: &Value) -> String {
    let own = words(schema);
    match schema["type"].as_str() {
        _ if !own.is_empty() => {
            let names: Vec<String> = own.iter().map(|(name, _)| format!("\"{name}\"")).collect();
            format!("Literal[{}]", names.join(", "))
        }
        Some("number") => "float".into(),
        None if is_length(row) => "Union[float, Mapping[str, float]]".into(),
        Some("integer") => "int".into(),
        Some("boolean") => "bool".into(),
        Some("string") => "str".into(),
        Some("array") if schema["prefixItems"].is_array() => "Sequence[float]".into(),
        Some("array") => format!("Sequence[{}]", python_type(row, &schema["items"])),
        Some("object") if schema["properties"].is_object() => match row.key.as_str() {
            "profiles" => "Profile".into(),
            "drawings" => "DrawingSettings".into(),
            key => panic!("no class of the Python client is named for {key}"),
        },
        Some("object") => {
            let each = resolved(&wedm::protocol::schema(), &schema["additionalProperties"]);
            format!("Mapping[str, {}]", python_type(row, &each))
        }
        _ => "Place".into(),
    }
}

/// The keys of one drawing, whose tables are not rows of their own.
fn python_class_of_drawings() -> String {
    let rows = rows();
    let row = rows.iter().find(|row| row.key == "drawings").unwrap();
    let schema = schema_of(row)["additionalProperties"].clone();
    let keys = schema["properties"].as_object().unwrap().iter();
    keys.map(|(key, schema)| {
        let snake = key.chars().map(|c| match c.is_uppercase() {
            true => format!("_{}", c.to_lowercase()),
            false => c.to_string(),
        });
        let schema = resolved(&wedm::protocol::schema(), schema);
        let kind = match key.as_str() {
            "contours" => "Mapping[str, ContourSettings]".into(),
            _ => python_type(row, &schema),
        };
        format!("    {}: {kind}\n", snake.collect::<String>())
    })
    .collect()
}

#[test]
fn the_python_client_has_every_key() {
    let mut text = String::new();
    let classes = [
        ("Passes", "passes.", "Several passes."),
        ("Job", "job.", "The workpiece."),
        ("Pair", "pair.", "A punch and its plate."),
        ("MillingSettings", "milling.", "Milling by an electrode."),
        ("ProgramSettings", "program.", "How a program is written."),
        (
            "Profile",
            "profiles.NAME.",
            "How ISO programs are written for one kind of machine.",
        ),
        (
            "ContourSettings",
            "drawings.NAME.contours.HANDLE.",
            "What is said of one contour of one drawing.",
        ),
        (
            "DrawingSettings",
            "drawings.NAME.",
            "What is said of one drawing.",
        ),
        (
            "Settings",
            "",
            "Only what is set counts; lengths are mm, thread and entry are drawing units.",
        ),
    ];
    let rows = rows();
    for row in &rows {
        let (of, _) = row.key.rsplit_once('.').unwrap_or_default();
        let mut prefixes = classes
            .iter()
            .map(|(_, prefix, _)| prefix.trim_end_matches('.'));
        let is_held = prefixes.any(|prefix| prefix == of);
        assert!(is_held, "no class of the Python client has {}", row.key);
    }
    for (name, prefix, about) in classes {
        text += &format!("\n\nclass {name}(TypedDict, total=False):\n    \"\"\"{about}\"\"\"\n\n");
        if name == "DrawingSettings" {
            text += &python_class_of_drawings();
            continue;
        }
        for row in &rows {
            let Some(key) = row
                .key
                .strip_prefix(prefix)
                .filter(|key| !key.contains('.'))
            else {
                continue;
            };
            let kind = python_type(row, &schema_of(row));
            text += &format!("    {}: {kind}\n", key.replace('-', "_"));
        }
        if prefix.is_empty() {
            text += "    passes: Passes\n    job: Job\n    pair: Pair\n    milling: MillingSettings\n    program: ProgramSettings\n";
        }
    }
    hold(
        "clients/python/src/wedm_client/settings.py",
        "by the handle of one of its entities.\"\"\"\n",
        "\n\ndef to_json",
        &text,
    );
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
