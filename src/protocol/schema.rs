//! The JSON Schema of every `wedm/` message.

use super::*;
use crate::finding::Rule;
use crate::settings::{self, Row, Settings, camel_case};
use schemars::generate::{SchemaGenerator, SchemaSettings};
use serde_json::{Map, Value, json};

/// One schema for the whole name space: `methods` says what each takes and gives, `$defs` holds the types.
pub fn schema() -> Value {
    let mut types = SchemaSettings::draft2020_12().into_generator();
    fn of<T: schemars::JsonSchema>(types: &mut SchemaGenerator) -> Value {
        types.subschema_for::<T>().to_value()
    }
    let methods = method::methods(&mut types);
    let commands = json!({
        method::APPLY_DRAWING_EDIT_COMMAND: { "arguments": [of::<DrawingEdit>(&mut types)] },
        method::SCALE_COMMAND: { "arguments": [of::<ScaleProgram>(&mut types)] },
    });
    let settings = of::<Settings>(&mut types);
    let data = of::<FindingData>(&mut types);
    let of_fix_all = of::<FixAllData>(&mut types);
    let definitions = declared(&mut types);
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "wedm protocol",
        "description": format!("Every message of the wedm/ name space, protocol {PROTOCOL}."),
        "protocol": PROTOCOL,
        "methods": methods,
        "commands": commands,
        "settings": settings,
        "diagnosticData": data,
        "fixAllData": of_fix_all,
        "$defs": definitions,
    })
}

/// The JSON Schema of `wedm.toml`.
pub(crate) fn settings_schema() -> Value {
    let mut types = SchemaSettings::draft2020_12().into_generator();
    let settings = types.subschema_for::<Settings>().to_value();
    let mut definitions = declared(&mut types);
    definitions.values_mut().for_each(hyphen);
    let of_rules = [
        ("Settings", "/properties/rules"),
        (
            "DrawingSettings",
            "/properties/suppress/additionalProperties",
        ),
    ];
    for (name, at) in of_rules {
        let table = definitions.get_mut(name).and_then(|it| it.pointer_mut(at));
        if let Some(table) = table {
            name_rules(table);
        }
    }
    let mut whole = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": settings::FILE_NAME,
        "type": "object",
        "allOf": [settings],
        "$defs": definitions,
    });
    leave_out_null(&mut whole);
    whole
}

/// Removes null, which TOML does not have and an editor would propose.
fn leave_out_null(part: &mut Value) {
    match part {
        Value::Array(items) => items.iter_mut().for_each(leave_out_null),
        Value::Object(keys) => {
            for (key, value) in keys.iter_mut() {
                if let (Value::Array(kinds), "type" | "anyOf" | "enum") = (value, key.as_str()) {
                    let is_null = |kind: &Value| *kind == json!("null") || kind["type"] == "null";
                    kinds.retain(|kind| !kind.is_null() && !is_null(kind));
                }
            }
            // A choice of one type is that type, and a fault within it is then reported as such.
            if keys
                .get("anyOf")
                .is_some_and(|all| all.as_array().map(Vec::len) == Some(1))
            {
                let all = keys.remove("anyOf").unwrap_or_default();
                keys.insert("allOf".into(), all);
            }
            keys.values_mut().for_each(leave_out_null);
        }
        _ => {}
    }
}

/// Turns a table by rule into one key for each rule, which editors complete and check.
fn name_rules(table: &mut Value) {
    let of_each = table["additionalProperties"].take();
    let key = |rule: Rule| {
        let said = json!({ "description": rule.summary(), "allOf": [of_each] });
        (rule.name().to_owned(), said)
    };
    table["properties"] = Value::Object(Rule::ALL.into_iter().map(key).collect());
    table["additionalProperties"] = json!(false);
}

/// The types so far, with what the rows of the keys say of them.
fn declared(types: &mut SchemaGenerator) -> Map<String, Value> {
    let mut definitions = types.take_definitions(true);
    let rows = settings::rows();
    rows.iter().for_each(|row| declare(&mut definitions, row));
    definitions
}

/// Gives a type its keys as TOML has them.
fn hyphen(definition: &mut Value) {
    if let Some(Value::Object(properties)) = definition.get_mut("properties") {
        let keys = std::mem::take(properties).into_iter();
        *properties = keys.map(|(key, value)| (hyphened(&key), value)).collect();
    }
}

/// `lead-in` of `leadIn`.
fn hyphened(key: &str) -> String {
    let mut out = String::with_capacity(key.len() + 2);
    for letter in key.chars() {
        if letter.is_ascii_uppercase() {
            out.push('-');
        }
        out.push(letter.to_ascii_lowercase());
    }
    out
}

/// The type that holds the key of a row, and its name in there.
fn place_of(row: &Row) -> (&'static str, &str) {
    match row.key.rsplit_once('.') {
        Some((table, key)) if table.ends_with(".HANDLE") => ("ContourSettings", key),
        Some((table, key)) if table.starts_with("drawings.") => ("DrawingSettings", key),
        Some(("passes", key)) => ("Passes", key),
        Some(("program", key)) => ("ProgramSettings", key),
        Some(("job", key)) => ("JobSettings", key),
        Some(("pair", key)) => ("PairSettings", key),
        Some(("milling", key)) => ("MillingSettings", key),
        Some((_, key)) => ("ProfileSettings", key),
        None => ("Settings", row.key.as_str()),
    }
}

/// Adds to the type of a level of settings what the row of a key says beyond its type: the range, and the meaning as plain text.
fn declare(definitions: &mut Map<String, Value>, row: &Row) {
    let (of, key) = place_of(row);
    let Some(schema) = definitions
        .get_mut(of)
        .and_then(|table| table["properties"].get_mut(camel_case(key)))
    else {
        return;
    };
    schema["description"] = row.plain_meaning().into();
    let Some(range) = row.range else { return };
    let numbers = match schema.get_mut("items") {
        Some(items) => items,
        None => schema,
    };
    // Whole numbers without a point.
    let bound = |bound: f64| match bound.fract() == 0.0 {
        true => json!(bound as i64),
        false => json!(bound),
    };
    let least = if range.is_least {
        "minimum"
    } else {
        "exclusiveMinimum"
    };
    numbers[least] = bound(range.least);
    if range.most.is_finite() {
        numbers["maximum"] = bound(range.most);
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_schema_of_the_file_has_the_keys_of_the_file() {
        let schema = super::settings_schema();
        for row in super::settings::rows() {
            let (of, key) = super::place_of(&row);
            assert!(
                schema["$defs"][of]["properties"].get(key).is_some(),
                "{of} {key}"
            );
        }
        let text = schema.to_string();
        for rest in text.split("\"#/$defs/").skip(1) {
            let name = rest.split('"').next().unwrap();
            assert!(schema["$defs"].get(name).is_some(), "{name}");
        }
        assert!(schema["$defs"].get("Inspection").is_none());
        assert!(!text.contains("null"), "TOML has none");
        // Names of rules are completed, and a misspelt one is marked.
        let rules = &schema["$defs"]["Settings"]["properties"]["rules"];
        let reasons =
            &schema["$defs"]["DrawingSettings"]["properties"]["suppress"]["additionalProperties"];
        for table in [rules, reasons] {
            assert!(table["properties"].get("gap").is_some(), "{table}");
            assert_eq!(table["additionalProperties"], false);
        }
    }

    #[test]
    fn every_reference_of_the_schema_leads_to_a_type() {
        let schema = super::schema();
        let text = schema.to_string();
        let references = text
            .split("\"#/$defs/")
            .skip(1)
            .filter_map(|rest| rest.split('"').next());
        for name in references {
            assert!(schema["$defs"].get(name).is_some(), "{name}");
        }
        assert!(schema["$defs"].as_object().unwrap().len() > 20);
    }
}
