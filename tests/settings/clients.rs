//! The keys in the clients.

use super::*;

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

/// What VS Code's settings page calls a choice that is not made, in place of `null`.
const NOT_SET: &str = "%settings.not-set%";

/// The keys and tables that come first on that page, in this order: what every job needs. The others follow as on the page of the settings.
const FIRST: [&str; 15] = [
    "wire-diameter",
    "gap",
    "correction",
    "side",
    "passes.corrections",
    "passes.gaps",
    "program.format",
    "program.profile",
    "program.compensation",
    "program.direction",
    "units",
    "layers",
    "program",
    "passes",
    "rules",
];

/// Where a key stands among the first ones; behind all of them where it is none.
fn place_of(key: &str) -> usize {
    let named = FIRST.iter().position(|first| *first == key);
    let table = key.split('.').next();
    let tabled = || FIRST.iter().position(|first| Some(*first) == table);
    named.or_else(tabled).unwrap_or(FIRST.len())
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
    if is_root && schema["type"] == "boolean" {
        of.insert("enum".into(), json!([true, false, null]));
        of.insert(
            "enumItemLabels".into(),
            json!(["%settings.yes%", "%settings.no%", NOT_SET]),
        );
    }
    if !own.is_empty() {
        let default = row
            .default
            .as_deref()
            .map(|default| default.trim_matches('"'));
        let names: Vec<Value> = own.iter().map(|(name, _)| json!(name)).collect();
        if is_root {
            let labels = names.iter().cloned().chain([json!(NOT_SET)]);
            of.insert("enumItemLabels".into(), labels.collect());
        }
        let all = names.into_iter().chain(is_root.then_some(Value::Null));
        of.insert("enum".into(), all.collect());
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
    let rows = of_documents();
    let mut listed: Vec<&str> = rows.iter().map(|row| row.key.as_str()).collect();
    listed.sort_by_key(|key| place_of(key));
    for row in &rows {
        let mut schema = match row.key.as_str() {
            "profiles" => json!({
                "type": ["object", "null"],
                "default": null,
                "additionalProperties": { "type": "object", "additionalProperties": false, "properties": of_profiles },
            }),
            "drawings" => json!({ "type": ["object", "null"], "default": null }),
            _ => editor_schema(row, &schema_of(row), true, &mut sentences),
        };
        let place = listed.iter().position(|key| *key == row.key);
        schema["order"] = json!(place);
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
            0 => "\"settings.not-set\": \"not set\",\n",
            _ => "\"settings.not-set\": \"未设置\",\n",
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
            "Settings for one contour of one drawing.",
        ),
        (
            "DrawingSettings",
            "drawings.NAME.",
            "Settings for one drawing.",
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
        "by the handle of an entity of each contour.\"\"\"\n",
        "\n\ndef to_json",
        &text,
    );
}
