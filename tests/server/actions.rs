//! Code actions and the command behind those of drawings.

mod several;

use crate::support::{Client, TIGHT, capabilities, dxf_of, tight_plate};
use serde_json::{Value, json};

const CAD: &str = "cad:///1";
const DXF: &str = "file:///plate.dxf";

fn everywhere() -> Value {
    json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 1_000_000, "character": 0 } })
}

fn on_line(line: u64) -> Value {
    json!({ "start": { "line": line, "character": 0 }, "end": { "line": line, "character": 0 } })
}

fn actions(
    client: &mut Client,
    uri: &str,
    range: Value,
    diagnostics: &[Value],
    only: Option<&str>,
) -> Vec<Value> {
    let mut context = json!({ "diagnostics": diagnostics });
    if let Some(only) = only {
        context["only"] = json!([only]);
    }
    let params = json!({ "textDocument": { "uri": uri }, "range": range, "context": context });
    client
        .request("textDocument/codeAction", params)
        .unwrap()
        .as_array()
        .cloned()
        .unwrap()
}

fn argument(action: &Value) -> Value {
    assert_eq!(action["command"]["command"], "wedm.applyDrawingEdit");
    action["command"]["arguments"][0].clone()
}

/// Handles that the edits of quick fixes touch.
fn touched(actions: &[Value]) -> Vec<String> {
    let mut handles: Vec<String> = actions
        .iter()
        .map(|action| {
            argument(action)["changes"][0]["handle"]
                .as_str()
                .unwrap()
                .into()
        })
        .collect();
    handles.dedup();
    handles
}

#[test]
fn a_fix_of_a_drawing_makes_it_clean() {
    let mut client = Client::start();
    let found = client.open_drawing(CAD, json!([tight_plate("2A")]));
    let offered = actions(
        &mut client,
        CAD,
        found[0]["range"].clone(),
        &found,
        Some("quickfix"),
    );
    let preferred: Vec<bool> = offered
        .iter()
        .map(|action| action["isPreferred"] == true)
        .collect();
    assert_eq!(preferred, [true, false]);
    assert!(
        offered[1]["title"]
            .as_str()
            .unwrap()
            .starts_with("Keep the end points"),
        "{}",
        offered[1]["title"]
    );
    assert_eq!(offered[0]["kind"], "quickfix");
    assert_eq!(offered[0]["diagnostics"][0]["data"], found[0]["data"]);
    let edit = argument(&offered[0]);
    assert_eq!((&edit["uri"], &edit["version"]), (&json!(CAD), &json!(1)));
    client.change_drawing(CAD, 2, edit["changes"].clone());
    assert_eq!(client.diagnostics(CAD, 2).len(), 0);
    assert!(actions(&mut client, CAD, everywhere(), &[], None).is_empty());
    client.shut_down();
}

#[test]
fn diagnostics_choose_by_handle_and_segment_else_the_range_does() {
    let mut client = Client::start();
    let apart = |handle: &str, by: f64| {
        let mut plate = tight_plate(handle);
        plate["vertices"]
            .as_array_mut()
            .unwrap()
            .iter_mut()
            .for_each(|vertex| vertex[0] = json!(vertex[0].as_f64().unwrap() + by));
        plate
    };
    let found = client.open_drawing(CAD, json!([apart("A", 0.0), apart("B", 20.0)]));
    assert_eq!(found.len(), 2);
    // Both lie on line 2.
    let mut check = |range: Value, diagnostics: &[Value], expected: &[&str]| {
        assert_eq!(
            touched(&actions(
                &mut client,
                CAD,
                range,
                diagnostics,
                Some("quickfix")
            )),
            expected
        );
    };
    check(on_line(2), &found[1..], &["B"]);
    check(on_line(2), &found, &["A", "B"]);
    check(on_line(2), &[], &["A", "B"]);
    check(on_line(3), &[], &[]);
    let mut bare = found[1].clone();
    bare.as_object_mut().unwrap().remove("data");
    check(on_line(2), &[bare], &["A", "B"]);
    // A diagnostic of a fault that is gone chooses nothing.
    let mut gone = found[1].clone();
    gone["data"]["segment"] = json!(0);
    check(on_line(2), &[gone], &[]);
    client.shut_down();
}

#[test]
fn only_what_is_asked_for_is_offered() {
    let mut client = Client::start();
    client.open_drawing(CAD, json!([tight_plate("2A")]));
    let mut check = |only: Option<&str>, expected: &[&str]| {
        let offered = actions(&mut client, CAD, everywhere(), &[], only);
        let kinds: Vec<&str> = offered
            .iter()
            .filter_map(|action| action["kind"].as_str())
            .collect();
        assert_eq!(kinds, expected, "{only:?}");
    };
    check(None, &["quickfix", "quickfix", "source.fixAll.wedm"]);
    check(Some("quickfix"), &["quickfix", "quickfix"]);
    check(Some("source"), &["source.fixAll.wedm"]);
    check(Some("source.fixAll"), &["source.fixAll.wedm"]);
    check(Some("source.fixAll.wedm"), &["source.fixAll.wedm"]);
    check(Some("source.fixAll.other"), &[]);
    check(Some("source.organizeImports"), &[]);
    check(Some("refactor"), &[]);
    // For a light bulb: editors ask at every step of the cursor.
    let context = json!({ "diagnostics": [], "triggerKind": 2 });
    let params =
        json!({ "textDocument": { "uri": CAD }, "range": everywhere(), "context": context });
    let offered = client.request("textDocument/codeAction", params).unwrap();
    let kinds: Vec<&str> = offered
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|action| action["kind"].as_str())
        .collect();
    assert_eq!(kinds, ["quickfix", "quickfix"]);
    client.shut_down();
}

/// Applies LSP text edits to a text of ASCII characters.
fn applied(text: &str, edits: &[Value]) -> String {
    let starts: Vec<usize> = std::iter::once(0)
        .chain(text.match_indices('\n').map(|(at, _)| at + 1))
        .collect();
    let offset = |position: &Value| {
        starts[position["line"].as_u64().unwrap() as usize]
            + position["character"].as_u64().unwrap() as usize
    };
    let mut edits: Vec<(usize, usize, &str)> = edits
        .iter()
        .map(|edit| {
            (
                offset(&edit["range"]["start"]),
                offset(&edit["range"]["end"]),
                edit["newText"].as_str().unwrap(),
            )
        })
        .collect();
    edits.sort();
    let mut result = text.to_owned();
    for (start, end, new) in edits.into_iter().rev() {
        result.replace_range(start..end, new);
    }
    result
}

#[test]
fn a_fix_of_dxf_text_is_versioned_and_touches_numbers_alone() {
    let mut client = Client::start();
    let text = dxf_of(&[("2A", &TIGHT)]);
    let found = client.open_text(DXF, "dxf", &text);
    let offered = actions(
        &mut client,
        DXF,
        found[0]["range"].clone(),
        &found,
        Some("quickfix"),
    );
    let change = &offered[0]["edit"]["documentChanges"][0];
    assert_eq!(change["textDocument"], json!({ "uri": DXF, "version": 1 }));
    let fixed = applied(&text, change["edits"].as_array().unwrap());
    assert_eq!(fixed.lines().count(), text.lines().count());
    let differing = fixed
        .lines()
        .zip(text.lines())
        .filter(|(new, old)| new != old);
    assert!(
        differing.clone().count() > 0
            && differing
                .clone()
                .all(|(new, _)| new.trim().parse::<f64>().is_ok())
    );
    client.notify("textDocument/didChange", json!({ "textDocument": { "uri": DXF, "version": 2 }, "contentChanges": [{ "text": fixed }] }));
    assert_eq!(client.diagnostics(DXF, 2).len(), 0);
    client.shut_down();
}

#[test]
fn the_actions_of_dxf_text_answer_on_any_tag_of_the_segment() {
    let mut client = Client::start();
    let text = dxf_of(&[("2A", &TIGHT)]);
    client.open_text(DXF, "dxf", &text);
    let bulge = text
        .lines()
        .position(|line| line == "0.41421356237309503")
        .unwrap() as u64;
    // The vertex before it begins four lines above: 10, x, 20, y, 42, bulge.
    for line in bulge - 4..=bulge {
        assert_eq!(
            actions(&mut client, DXF, on_line(line), &[], Some("quickfix")).len(),
            2,
            "line {line}"
        );
    }
    assert!(actions(&mut client, DXF, on_line(0), &[], Some("quickfix")).is_empty());
    client.shut_down();
}

/// A tight arc, a line that lies there twice, a crumb of a line and two ends that do not meet: one action mends them all, whichever
/// way the drawing comes, and leaves nothing that it would mend when it is asked again.
#[test]
fn fix_all_goes_on_until_nothing_safe_is_left() {
    let line = |handle: &str, [a, b, c, d]: [f64; 4]| json!({ "handle": handle, "type": "line", "start": [a, b], "end": [c, d] });
    let arc = |handle: &str, x: f64, y: f64, from: f64| json!({ "handle": handle, "type": "arc", "center": [x, y], "radius": 0.05, "startAngle": from, "endAngle": from + 90.0 });
    let entities = json!([
        line("1", [0.05, 0.0, 5.0, 0.0]),
        line("2", [5.0, 0.0, 5.003, 0.0]),
        line("3", [5.003, 0.0, 9.95, 0.0]),
        arc("4", 9.95, 0.05, 270.0),
        line("5", [10.0, 0.05, 10.0, 9.95]),
        line("6", [10.0, 9.95, 10.0, 0.05]),
        arc("7", 9.95, 9.95, 0.0),
        line("8", [9.95, 10.006, 0.05, 10.0]),
        arc("9", 0.05, 9.95, 90.0),
        line("A", [0.0, 9.95, 0.0, 0.05]),
        arc("B", 0.05, 0.05, 180.0)
    ]);
    let texts: Vec<String> = entities
        .as_array()
        .unwrap()
        .iter()
        .map(dxf_entity)
        .collect();
    let text = format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n",
        texts.concat()
    );
    let mut client = Client::start();
    let found = client.open_text(DXF, "dxf", &text);
    let rules = |found: &[Value]| {
        found
            .iter()
            .map(|each| each["code"].as_str().unwrap().to_owned())
            .collect::<std::collections::BTreeSet<_>>()
    };
    let all = ["duplicate-entity", "gap", "short-segment", "small-radius"];
    assert!(
        all.iter().all(|rule| rules(&found).contains(*rule)),
        "{:?}",
        rules(&found)
    );
    let offered = actions(&mut client, DXF, everywhere(), &[], Some("source.fixAll"));
    let count = |found: &[Value], all: bool| {
        let is_counted = |one: &&Value| {
            one["severity"].as_u64() <= Some(2) || all && one["code"] == "arc-as-chords"
        };
        found.iter().filter(is_counted).count() as u64
    };
    let before = count(&found, true);
    let says = |action: &Value, after: &[Value]| {
        let left = count(after, false);
        let data = &action["data"];
        assert_eq!(data["left"], left, "{data}");
        assert_eq!(data["repaired"], before - left, "{data}");
        let left = if left == 0 {
            "none".to_owned()
        } else {
            left.to_string()
        };
        let said = format!("{} findings repaired, {left} left", data["repaired"]);
        assert_eq!(data["said"], said);
    };
    let mut edits = offered[0]["edit"]["documentChanges"][0]["edits"]
        .as_array()
        .unwrap()
        .clone();
    // From the back, so that what lies before stays where it is.
    edits.reverse();
    let changes: Vec<Value> = edits
        .iter()
        .map(|edit| json!({ "range": edit["range"], "text": edit["newText"] }))
        .collect();
    client.notify(
        "textDocument/didChange",
        json!({ "textDocument": { "uri": DXF, "version": 2 }, "contentChanges": changes }),
    );
    let found = client.diagnostics(DXF, 2);
    assert!(
        all.iter().all(|rule| !rules(&found).contains(*rule)),
        "{:?}",
        rules(&found)
    );
    says(&offered[0], &found);
    assert!(actions(&mut client, DXF, everywhere(), &[], Some("source.fixAll")).is_empty());

    let found = client.open_drawing(CAD, entities);
    assert!(
        all.iter().all(|rule| rules(&found).contains(*rule)),
        "{:?}",
        rules(&found)
    );
    let offered = actions(&mut client, CAD, everywhere(), &[], Some("source.fixAll"));
    client.change_drawing(CAD, 2, argument(&offered[0])["changes"].clone());
    let found = client.diagnostics(CAD, 2);
    assert!(
        all.iter().all(|rule| !rules(&found).contains(*rule)),
        "{:?}",
        rules(&found)
    );
    says(&offered[0], &found);
    assert!(actions(&mut client, CAD, everywhere(), &[], Some("source.fixAll")).is_empty());
    client.shut_down();
}

/// A line or an arc of a drawing as DXF text.
fn dxf_entity(entity: &Value) -> String {
    let kind = entity["type"].as_str().unwrap().to_uppercase();
    let number = |key: &str| entity[key].to_string();
    let point = |key: &str, code: u8| {
        format!(
            "{code}\n{}\n{}\n{}\n",
            entity[key][0],
            code + 10,
            entity[key][1]
        )
    };
    let rest = match kind.as_str() {
        "LINE" => point("start", 10) + &point("end", 11),
        _ => format!(
            "{}40\n{}\n50\n{}\n51\n{}\n",
            point("center", 10),
            number("radius"),
            number("startAngle"),
            number("endAngle")
        ),
    };
    format!(
        "0\n{kind}\n5\n{}\n8\n0\n{rest}",
        entity["handle"].as_str().unwrap()
    )
}

#[test]
fn a_client_without_document_changes_gets_plain_ones() {
    let mut without = capabilities();
    without["workspace"] = json!({});
    let mut client = Client::start_with(without, json!({}));
    client.open_text(DXF, "dxf", &dxf_of(&[("2A", &TIGHT)]));
    let offered = actions(&mut client, DXF, everywhere(), &[], Some("source.fixAll"));
    assert!(
        !offered[0]["edit"]["changes"][DXF]
            .as_array()
            .unwrap()
            .is_empty()
    );
    assert!(offered[0]["edit"].get("documentChanges").is_none());
    client.shut_down();
}

#[test]
fn the_command_goes_to_the_client_and_back() {
    let mut client = Client::start();
    client.open_drawing(CAD, json!([tight_plate("2A")]));
    let offered = actions(&mut client, CAD, everywhere(), &[], Some("source.fixAll"));
    let edit = argument(&offered[0]);
    let command = json!({ "command": "wedm.applyDrawingEdit", "arguments": [edit] });
    let id = client.ask("workspace/executeCommand", command.clone());
    let asked = client.asked("wedm/applyDrawingEdit");
    assert_eq!(asked.params, json!({ "edit": edit }));
    // The server serves others while the client thinks.
    assert!(
        client
            .request("wedm/inspect", json!({ "uri": CAD }))
            .is_ok()
    );
    client.change_drawing(CAD, 2, asked.params["edit"]["changes"].clone());
    client.respond(&asked, json!({ "applied": true }));
    assert_eq!(client.answer(id).unwrap(), json!({ "applied": true }));
    assert_eq!(client.diagnostics(CAD, 2).len(), 0);
    // What was made for version 1 is refused now.
    assert_eq!(client.code("workspace/executeCommand", command), -32801);
    client.shut_down();
}

#[test]
fn a_command_that_cannot_be_run_is_refused() {
    let mut client = Client::start();
    client.open_drawing(CAD, json!([tight_plate("2A")]));
    client.open_text(DXF, "dxf", "0\nEOF\n");
    let edit = |uri: &str| json!({ "uri": uri, "version": 1, "changes": [] });
    let mut check = |command: &str, arguments: Value, code: i64| {
        assert_eq!(
            client.code(
                "workspace/executeCommand",
                json!({ "command": command, "arguments": arguments })
            ),
            code,
            "{command} {arguments}"
        );
    };
    check("wedm.other", json!([]), -32602);
    check("wedm.applyDrawingEdit", json!([]), -32602);
    check("wedm.applyDrawingEdit", json!([{}]), -32602);
    check(
        "wedm.applyDrawingEdit",
        json!([edit(CAD), edit(CAD)]),
        -32602,
    );
    check(
        "wedm.applyDrawingEdit",
        json!([edit("cad:///none")]),
        -32602,
    );
    check("wedm.applyDrawingEdit", json!([edit(DXF)]), -32602);
    client.shut_down();

    let mut client = Client::start_with(json!({}), json!({}));
    client.open_drawing(CAD, json!([tight_plate("2A")]));
    assert_eq!(
        client.code(
            "workspace/executeCommand",
            json!({ "command": "wedm.applyDrawingEdit", "arguments": [edit(CAD)] })
        ),
        -32803
    );
    client.shut_down();
}

#[test]
fn looking_for_fixes_reports_progress_where_a_token_is_given() {
    let mut client = Client::start();
    client.open_drawing(CAD, json!([tight_plate("2A")]));
    let params = json!({ "textDocument": { "uri": CAD }, "range": everywhere(), "context": { "diagnostics": [] }, "workDoneToken": "t" });
    client.request("textDocument/codeAction", params).unwrap();
    // A report after each round: one repairs the only fault.
    let told = [(); 3].map(|()| client.told("$/progress")["value"].take());
    assert_eq!(
        told.each_ref().map(|told| told["kind"].clone()),
        ["begin", "report", "end"]
    );
    assert_eq!(told[1]["percentage"], 100, "{told:?}");
    client.shut_down();
}
