//! Reads settings from JSON: `initializationOptions`, `workspace/configuration`, the `options` of a request.

use super::level;
use super::value::{Entry, Node, Value};
use super::{Settings, SettingsError};

/// Reads one level of settings. A value that does not fit is left out and reported, the other keys
/// hold; null is "not set".
///
/// An object that holds the section `wedm` stands for that section: editors send either.
pub(crate) fn from_json(json: &serde_json::Value) -> (Settings, Vec<SettingsError>) {
    let section = json.get("wedm").filter(|section| {
        section.is_object() || section.is_null() || *section == &serde_json::json!([])
    });
    level::read(&node(section.unwrap_or(json)))
}

fn node(json: &serde_json::Value) -> Node {
    use serde_json::Value as Json;
    let value = match json {
        Json::Null => Value::Null,
        Json::Bool(truth) => Value::Truth(*truth),
        Json::Number(number) => Value::Number(number.as_f64().unwrap_or(f64::NAN)),
        Json::String(text) => Value::Text(text.clone()),
        Json::Array(items) => Value::List(items.iter().map(node).collect()),
        Json::Object(entries) => {
            let entries = entries
                .iter()
                .map(|(key, value)| Entry::new(key, node(value)));
            Value::Table(entries.collect())
        }
    };
    Node { value, range: None }
}
