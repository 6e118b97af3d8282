//! The JSON Schema of every `wedm/` message.

use super::*;
use crate::settings::Settings;
use schemars::generate::{SchemaGenerator, SchemaSettings};
use serde_json::{Value, json};

/// One schema for the whole name space: `methods` says what each takes and gives, `$defs` holds the types.
pub fn schema() -> Value {
    let mut types = SchemaSettings::draft2020_12().into_generator();
    fn of<T: schemars::JsonSchema>(types: &mut SchemaGenerator) -> Value {
        types.subschema_for::<T>().to_value()
    }
    let methods = json!({
        method::DID_OPEN_DRAWING: { "params": of::<OpenDrawing>(&mut types) },
        method::DID_CHANGE_DRAWING: { "params": of::<ChangeDrawing>(&mut types) },
        method::DID_CLOSE_DRAWING: { "params": of::<CloseDrawing>(&mut types) },
        method::INSPECT: { "params": of::<Inspect>(&mut types), "result": of::<Inspection>(&mut types) },
        method::CONTOURS: { "params": of::<DrawingName>(&mut types), "result": of::<Contours>(&mut types) },
        method::TOOLPATH: { "params": of::<OptionsOf>(&mut types), "result": of::<Toolpath>(&mut types) },
        method::PICTURE: { "params": of::<OptionsOf>(&mut types), "result": of::<Picture>(&mut types) },
        method::SIMULATE: { "params": of::<Simulate>(&mut types), "result": of::<Simulation>(&mut types) },
        method::LOCATE: { "params": of::<Locate>(&mut types), "result": of::<Option<Located>>(&mut types) },
        method::SETTINGS: { "params": of::<DrawingName>(&mut types), "result": of::<SettingsInForce>(&mut types) },
        method::GENERATE: {
            "params": of::<Generate>(&mut types),
            "result": of::<Program>(&mut types),
            "errorData": of::<Refused>(&mut types),
        },
        method::APPLY_DRAWING_EDIT: {
            "sentBy": "server",
            "params": of::<ApplyDrawingEdit>(&mut types),
            "result": of::<Applied>(&mut types),
        },
        method::RESEND_DRAWING: {
            "sentBy": "server",
            "params": of::<ResendDrawing>(&mut types),
            "result": of::<Resent>(&mut types),
        },
    });
    let commands = json!({
        method::APPLY_DRAWING_EDIT_COMMAND: { "arguments": [of::<DrawingEdit>(&mut types)] },
        method::SCALE_COMMAND: { "arguments": [of::<ScaleProgram>(&mut types)] },
    });
    let settings = of::<Settings>(&mut types);
    let data = of::<FindingData>(&mut types);
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "wedm protocol",
        "description": format!("Every message of the wedm/ name space, protocol {PROTOCOL}."),
        "protocol": PROTOCOL,
        "methods": methods,
        "commands": commands,
        "settings": settings,
        "diagnosticData": data,
        "$defs": types.take_definitions(true),
    })
}

#[cfg(test)]
mod tests {
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
