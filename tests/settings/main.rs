//! Wherever the keys of the settings are listed, the list is that of `src/settings/keys.rs`: the tables of the documentation, the file
//! that the page of settings shows, the settings page of VS Code, the types of the Python client.
//!
//! `UPDATE_EXPECT=1 cargo test --test command_line settings` rewrites them.

mod clients;
mod pages;
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
        "{file} does not list the settings as they are; update it with: UPDATE_EXPECT=1 cargo test --test command_line settings"
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
            "NAME" | "HANDLE" => schema["additionalProperties"].clone(),
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

fn of_documents() -> Vec<Row> {
    let mut rows = rows();
    rows.retain(|row| !row.key.contains("NAME"));
    rows
}

/// What a key means, or one of its words, in Chinese.
fn in_chinese(row: &Row, word: Option<&str>) -> String {
    let name = || word.map_or(row.key.clone(), |word| format!("{} = {word}", row.key));
    row.in_chinese(word)
        .unwrap_or_else(|| panic!("src/message/meanings.rs does not have {}", name()))
}
