//! From a place in the text to its segment and back, the settings in force, and what a picture's elements are called.

use crate::support::{Client, TIGHT, capabilities, dxf_of};
use serde_json::{Value, json};

const URI: &str = "file:///plate.dxf";

fn line_of(text: &str, wanted: &str) -> u64 {
    text.lines()
        .position(|line| line == wanted)
        .unwrap_or_else(|| panic!("there is a line {wanted}")) as u64
}

#[test]
fn a_place_in_the_text_is_its_segment_and_back() {
    let mut client = Client::start();
    let circle = "0\nCIRCLE\n5\nC1\n8\n0\n10\n50\n20\n50\n40\n7.25\n0\nENDSEC";
    let text = dxf_of(&[
        ("2A", &TIGHT),
        (
            "2B",
            &[[20.0, 0.0, 0.0], [30.0, 0.0, 0.0], [30.0, 9.0, 0.0]],
        ),
    ]);
    let text = text.replacen("0\nENDSEC\n0\nEOF", &format!("{circle}\n0\nEOF"), 1);
    client.open_text(URI, "dxf", &text);
    let mut at = |line: u64| {
        client
            .request(
                "wedm/locate",
                json!({ "uri": URI, "position": { "line": line, "character": 0 } }),
            )
            .unwrap()
    };
    let bulge = line_of(&text, "0.41421356237309503");
    let place = |line: u64, length: u64| json!({ "start": { "line": line, "character": 0 }, "end": { "line": line, "character": length } });
    assert_eq!(
        at(bulge),
        json!({ "handle": "2A", "segment": 2, "range": place(bulge, 19) })
    );
    // The x and y of the same vertex are of the same segment.
    assert_eq!(at(bulge - 4), at(bulge));
    let head = line_of(&text, "2A");
    assert_eq!(
        at(head),
        json!({ "handle": "2A", "range": place(head - 2, 10) })
    );
    let radius = line_of(&text, "7.25");
    assert_eq!(
        at(radius),
        json!({ "handle": "C1", "segment": 0, "range": place(radius, 4) })
    );
    assert_eq!(at(0), Value::Null);
    let mut of = |handle: &str, segment: Option<u64>| {
        client.request(
            "wedm/locate",
            json!({ "uri": URI, "handle": handle, "segment": segment }),
        )
    };
    assert_eq!(of("2A", Some(2)).unwrap()["range"], place(bulge, 19));
    assert_eq!(of("2A", None).unwrap()["range"], place(head - 2, 10));
    assert_eq!(of("C1", Some(0)).unwrap()["range"], place(radius, 4));
    assert_eq!(
        of("2B", Some(0)).unwrap()["range"],
        place(line_of(&text, "20.0"), 4)
    );
    client.shut_down();
}

#[test]
fn what_is_not_written_anywhere_is_refused_with_its_reason() {
    let mut client = Client::start();
    client.open_text(URI, "dxf", &dxf_of(&[("2A", &TIGHT)]));
    client.open_drawing("cad:///1", json!([crate::support::wide_plate("2A")]));
    client.open_text("file:///hole.3b", "3b", "B1000B0B1000GXL1\nDD\n");
    let position = json!({ "line": 0, "character": 0 });
    let mut check = |params: Value, code: i64, message: &str| {
        let error = client.request("wedm/locate", params).unwrap_err();
        assert_eq!(error["code"], code, "{error}");
        assert!(
            error["message"].as_str().unwrap().contains(message),
            "{error}"
        );
    };
    check(
        json!({ "uri": URI, "handle": "ZZ" }),
        -32602,
        "there is no entity ZZ",
    );
    check(
        json!({ "uri": URI, "handle": "2A", "segment": 5 }),
        -32602,
        "expected 0 to 4",
    );
    check(
        json!({ "uri": URI, "handle": "2A", "position": position }),
        -32602,
        "either position or handle",
    );
    check(json!({ "uri": URI }), -32602, "either position or handle");
    check(
        json!({ "uri": "file:///none.dxf", "handle": "2A" }),
        -32602,
        "is not open",
    );
    check(
        json!({ "uri": "cad:///1", "handle": "2A" }),
        -32803,
        "is not DXF text",
    );
    check(
        json!({ "uri": "file:///hole.3b", "position": position }),
        -32803,
        "is not DXF text",
    );
    client.shut_down();
}

#[test]
fn a_picture_names_the_segment_of_each_of_its_parts() {
    let mut client = Client::start();
    client.open_text(URI, "dxf", &dxf_of(&[("2A", &TIGHT)]));
    let picture = client
        .request("wedm/picture", json!({ "uri": URI }))
        .unwrap();
    let svg = picture["svg"].as_str().unwrap();
    for part in [
        r#"<path class="contour" data-handle="2A" data-segment="4""#,
        r#"<path class="fault error" data-handle="2A" data-segment="2""#,
        r#"<g class="mark error" data-handle="2A" data-segment="2" data-at=""#,
        r#"<g class="lens error" data-handle="2A" data-segment="2""#,
        r#"<g class="drawing""#,
        r#"data-unit-mm="1.0""#,
    ] {
        assert!(svg.contains(part), "{part} is missing");
    }
    client.shut_down();
}

#[test]
fn the_settings_in_force_say_where_the_correction_comes_from() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("wedm.toml");
    let uri = format!("file://{}/plate.dxf", folder.path().display());
    let check = |options: Value, toml: Option<&str>, correction: f64, from: &str| {
        match toml {
            Some(text) => std::fs::write(&file, text).unwrap(),
            None => std::fs::remove_file(&file).unwrap_or_default(),
        }
        let mut client = Client::start_with(capabilities(), options);
        let in_force = client
            .request("wedm/settings", json!({ "uri": uri }))
            .unwrap();
        assert_eq!(
            (&in_force["correction"], &in_force["correctionFrom"]),
            (&json!(correction), &json!(from)),
            "{in_force}"
        );
        assert_eq!(in_force["file"].is_string(), toml.is_some());
        client.shut_down();
    };
    check(json!({}), None, 0.1, "default");
    check(json!({ "correction": 0.12 }), None, 0.12, "client");
    check(
        json!({ "correction": 0.12 }),
        Some("side = \"punch\""),
        0.12,
        "client",
    );
    check(
        json!({ "correction": 0.12 }),
        Some("correction = 0.2"),
        0.2,
        "file",
    );
    check(
        json!({ "correction": 0.12 }),
        Some("wire-diameter = 0.3\ngap = 0.05"),
        0.2,
        "file",
    );
    check(
        json!({ "passes": { "corrections": [0.3, 0.2] } }),
        Some("correction = 0.1"),
        0.1,
        "file",
    );
    check(
        json!({ "passes": { "corrections": [0.3, 0.2] } }),
        Some("wire-diameter = 0.25\ngap = 0.02"),
        0.3,
        "client",
    );
    check(
        json!({}),
        Some("[passes]\ncorrections = [0.25, 0.2]"),
        0.25,
        "file",
    );
}
