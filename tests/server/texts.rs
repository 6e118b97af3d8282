//! Text documents: incremental sync, encodings, and clients that do odd things.

use crate::support::{Client, TIGHT, capabilities, codes, dxf_of, frame, small};
use serde_json::{Value, json};

const URI: &str = "file:///plate.dxf";

fn change(client: &mut Client, version: i64, changes: Value) {
    client.notify(
        "textDocument/didChange",
        json!({ "textDocument": { "uri": URI, "version": version }, "contentChanges": changes }),
    );
}

fn replace(from: (u64, u64), to: (u64, u64), text: &str) -> Value {
    json!({ "range": { "start": { "line": from.0, "character": from.1 }, "end": { "line": to.0, "character": to.1 } }, "text": text })
}

/// Zero-based line of the bulge that is at fault.
fn line_of(text: &str, wanted: &str) -> u64 {
    text.lines().position(|line| line == wanted).unwrap() as u64
}

#[test]
fn a_fault_in_dxf_text_is_shown_at_its_number_and_goes_with_it() {
    let mut client = Client::start();
    let text = dxf_of(&[("2A", &TIGHT)]);
    let line = line_of(&text, "0.41421356237309503");
    let found = client.open_text(URI, "dxf", &text);
    assert_eq!(codes(&found), ["small-radius"]);
    assert_eq!(
        found[0]["range"],
        json!({ "start": { "line": line, "character": 0 }, "end": { "line": line, "character": 19 } })
    );
    assert_eq!(
        (&found[0]["data"]["handle"], &found[0]["data"]["segment"]),
        (&json!("2A"), &json!(2))
    );
    // 9.95 → 9.5, twice: the radius grows to 0.5.
    let first = line_of(&text, "9.95");
    change(
        &mut client,
        2,
        json!([
            replace((first, 3), (first, 4), ""),
            replace((line + 2, 3), (line + 2, 4), "")
        ]),
    );
    assert_eq!(client.diagnostics(URI, 2).len(), 0);
    change(&mut client, 3, json!([{ "text": text }]));
    assert_eq!(small(&client.diagnostics(URI, 3)), 1);
    client.notify(
        "textDocument/didClose",
        json!({ "textDocument": { "uri": URI } }),
    );
    assert_eq!(
        client.published(URI),
        json!({ "uri": URI, "diagnostics": [] })
    );
    client.shut_down();
}

#[test]
fn ranges_outside_the_text_are_clamped() {
    let mut client = Client::start();
    let text = dxf_of(&[("2A", &TIGHT)]);
    client.open_text(URI, "dxf", &text);
    let far = 4_000_000_000;
    for (version, edit) in [
        (2, replace((far, far), (far, far), "999\nbehind the end\n")),
        (3, replace((0, far), (0, far), "")),
        (4, replace((far, 0), (0, 0), "")),
        (5, replace((1, 5), (0, 0), "")),
    ] {
        change(&mut client, version, json!([edit]));
        assert_eq!(
            small(&client.diagnostics(URI, version)),
            1,
            "version {version}"
        );
    }
    change(&mut client, 6, json!([replace((0, 0), (far, far), "")]));
    assert_eq!(small(&client.diagnostics(URI, 6)), 0);
    change(
        &mut client,
        7,
        json!([replace((far, far), (far, far), &text)]),
    );
    assert_eq!(small(&client.diagnostics(URI, 7)), 1);
    client.shut_down();
}

#[test]
fn characters_are_counted_as_agreed() {
    for (encoding, wide, umlaut) in [("utf-16", 2, 1), ("utf-8", 4, 2)] {
        let mut all = capabilities();
        all["general"]["positionEncodings"] = json!([encoding]);
        let mut client = Client::start_with(all, json!({}));
        let comment = "𝄞ö!";
        let text = format!("999\n{comment}\n{}", dxf_of(&[("2A", &TIGHT)]));
        client.open_text(URI, "dxf", &text);
        // Only the exclamation mark goes; were the count wrong, the next line would lose its end.
        let at = wide + umlaut;
        change(&mut client, 2, json!([replace((1, at), (1, at + 1), "?")]));
        assert_eq!(small(&client.diagnostics(URI, 2)), 1, "{encoding}");
        change(&mut client, 3, json!([replace((1, 0), (1, at + 1), "")]));
        assert_eq!(small(&client.diagnostics(URI, 3)), 1, "{encoding}");
        client.shut_down();
    }
}

#[test]
fn what_is_not_open_is_not_changed_and_not_closed() {
    let mut client = Client::start();
    change(&mut client, 2, json!([{ "text": "" }]));
    client.logged("was changed without being open");
    client.notify(
        "textDocument/didClose",
        json!({ "textDocument": { "uri": URI } }),
    );
    client.logged("was closed without being open");
    assert!(
        client
            .settle()
            .iter()
            .all(|message| message["method"] != "textDocument/publishDiagnostics")
    );
    client.shut_down();
}

#[test]
fn an_older_version_is_applied_in_order_and_logged_and_never_published_as_older() {
    let mut client = Client::start();
    let text = dxf_of(&[("2A", &TIGHT)]);
    client.open_text(URI, "dxf", &text);
    change(
        &mut client,
        10,
        json!([replace((0, 0), (0, 0), "999\nnine\n")]),
    );
    assert_eq!(small(&client.diagnostics(URI, 10)), 1);
    change(&mut client, 4, json!([{ "text": "0\nEOF\n" }]));
    client.logged("older than 10");
    assert_eq!(client.published(URI)["version"], 10);
    assert!(
        client
            .request("wedm/inspect", json!({ "uri": URI }))
            .unwrap()["entities"]
            .as_array()
            .unwrap()
            .is_empty()
    );
    client.shut_down();
}

#[test]
fn opening_a_text_twice_replaces_it_and_says_so() {
    let mut client = Client::start();
    assert_eq!(
        small(&client.open_text(URI, "dxf", &dxf_of(&[("2A", &TIGHT)]))),
        1
    );
    assert_eq!(small(&client.open_text(URI, "dxf", "0\nEOF\n")), 0);
    client.logged("was already open");
    client.shut_down();
}

#[test]
fn a_text_is_known_by_language_or_name_and_any_text_may_be_opened() {
    let mut client = Client::start();
    let text = dxf_of(&[("2A", &TIGHT)]);
    assert_eq!(
        small(&client.open_text("file:///a.DXF", "plaintext", &text)),
        1
    );
    assert_eq!(small(&client.open_text("untitled:1", "dxf", &text)), 1);
    assert_eq!(
        client
            .open_text("file:///readme.md", "markdown", &text)
            .len(),
        0
    );
    assert!(!client.open_text("file:///a.3b", "3b", "B1B2\n").is_empty());
    assert_eq!(
        client.code(
            "wedm/generate",
            json!({ "uri": "file:///a.3b", "format": "3b" })
        ),
        -32803
    );
    client.shut_down();
}

#[test]
fn a_file_that_is_not_what_it_claims_to_be_gets_one_diagnostic() {
    let mut client = Client::start();
    for (index, text) in [
        "",
        "\u{0}\u{1}\u{2}binary",
        "AC1032\u{0}\u{0}",
        "{\"json\": true}",
        &"0".repeat(1_000_000),
    ]
    .iter()
    .enumerate()
    {
        let found = client.open_text(&format!("file:///{index}.dxf"), "dxf", text);
        assert!(found.len() <= 2, "{text:.20}: {found:?}");
    }
    client.shut_down();
}

#[test]
fn a_change_that_cannot_be_read_asks_for_the_whole_text() {
    let text = dxf_of(&[("2A", &TIGHT)]);
    let malformed = json!({ "jsonrpc": "2.0", "method": "textDocument/didChange",
        "params": { "textDocument": { "uri": URI, "version": 2 }, "contentChanges": [{ "range": 3, "text": "" }] } });
    let cut_off = malformed.to_string();
    let cut_off = &cut_off[..cut_off.len() - 3];
    for broken in [&malformed.to_string(), cut_off] {
        let mut client = Client::start();
        assert_eq!(small(&client.open_text(URI, "dxf", &text)), 1);
        client.send_bytes(&frame(broken));
        let shown = client.told("window/showMessage");
        assert!(
            shown["message"].as_str().unwrap().starts_with(URI),
            "{shown}"
        );
        assert_eq!(codes(&client.diagnostics(URI, 1)), ["syntax"]);
        // It would be made at a wrong place.
        change(&mut client, 3, json!([replace((0, 0), (9, 0), "")]));
        let symbols = json!({ "textDocument": { "uri": URI } });
        assert_eq!(client.code("textDocument/documentSymbol", symbols), -32801);
        let whole = json!([{ "text": "?" }, { "text": text }, replace((0, 0), (0, 0), "999\nx\n")]);
        change(&mut client, 4, whole);
        assert_eq!(small(&client.diagnostics(URI, 4)), 1);
        assert!(
            client
                .settle()
                .iter()
                .all(|message| message["method"] != "window/showMessage")
        );
        client.shut_down();
    }
}

#[test]
fn half_a_letter_is_one_letter() {
    let mut client = Client::start();
    let text = format!("999\n!\n{}", dxf_of(&[("2A", &TIGHT)]));
    client.open_text(URI, "dxf", &text);
    let body = json!({ "jsonrpc": "2.0", "method": "textDocument/didChange", "params": {
        "textDocument": { "uri": URI, "version": 2 }, "contentChanges": [replace((1, 0), (1, 0), "HALF")] } });
    client.send_bytes(&frame(&body.to_string().replace("HALF", "\\ud83d")));
    assert_eq!(small(&client.diagnostics(URI, 2)), 1);
    // Were it none, or two, the next line would be torn.
    change(&mut client, 3, json!([replace((1, 0), (1, 2), "")]));
    assert_eq!(small(&client.diagnostics(URI, 3)), 1);
    client.shut_down();
}
