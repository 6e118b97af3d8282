//! What editors ask about the text of programs, over the real process.

use crate::support::{Client, capabilities};
use serde_json::{Value, json};

const URI: &str = "file:///plate.3b";

fn start() -> Client {
    start_with(json!({}))
}

fn start_with(options: Value) -> Client {
    let mut all = capabilities();
    all["textDocument"] = json!({ "documentSymbol": { "hierarchicalDocumentSymbolSupport": true } });
    Client::start_with(all, options)
}

fn at(line: u64, character: u64) -> Value {
    json!({ "textDocument": { "uri": URI }, "position": { "line": line, "character": character } })
}

fn document() -> Value {
    json!({ "textDocument": { "uri": URI } })
}

fn lines(start: u64, end: u64) -> Value {
    json!({ "start": { "line": start, "character": 0 }, "end": { "line": end, "character": 0 } })
}

/// A text with LSP edits made in it, the last one first; characters are bytes here.
fn applied(text: &str, edits: &Value) -> String {
    let offset = |position: &Value| {
        let line = position["line"].as_u64().unwrap() as usize;
        let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
        start + position["character"].as_u64().unwrap() as usize
    };
    let mut result = text.to_owned();
    for edit in edits.as_array().unwrap().iter().rev() {
        result.replace_range(offset(&edit["range"]["start"])..offset(&edit["range"]["end"]), edit["newText"].as_str().unwrap());
    }
    result
}

/// R10, correction 0.1 mm, from its centre and back.
const HOLE: &str = "b9900b0b9900gxl1 ; in\nB9900B0B39600GYNR1\nB9900 B0 B9900 GX L3\ndd\n";

#[test]
fn formatting_follows_the_layout_that_is_set_and_else_the_text() {
    let aligned = "B   9900 B      0 B   9900 GX L1  ; in\nB   9900 B      0 B  39600 GY NR1\nB   9900 B      0 B   9900 GX L3\nDD\n";
    for (options, expected) in [
        (json!({}), "B9900B0B9900GXL1 ; in\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n"),
        (json!({ "program": { "layout": "aligned" } }), aligned),
    ] {
        let mut client = start_with(options);
        client.open_text(URI, "3b", HOLE);
        let mut params = document();
        params["options"] = json!({ "tabSize": 4, "insertSpaces": true });
        let edits = client.request("textDocument/formatting", params.clone()).unwrap();
        assert_eq!(applied(HOLE, &edits), expected);
        params["range"] = lines(0, 1);
        let edits = client.request("textDocument/rangeFormatting", params.clone()).unwrap();
        let (first, rest) = (expected.lines().next().unwrap(), HOLE.split_once('\n').unwrap().1);
        assert_eq!(applied(HOLE, &edits), format!("{first}\n{rest}"));
        let mut typed = at(3, 0);
        typed["ch"] = json!("\n");
        typed["options"] = params["options"].clone();
        let edits = client.request("textDocument/onTypeFormatting", typed).unwrap();
        let third = expected.lines().nth(2).unwrap();
        assert_eq!(applied(HOLE, &edits).lines().collect::<Vec<_>>(), [HOLE.lines().next().unwrap(), "B9900B0B39600GYNR1", third, "dd"]);
        client.shut_down();
    }
}

#[test]
fn a_drawing_is_not_formatted() {
    let mut client = start();
    client.open_text("file:///a.dxf", "dxf", "0\nEOF\n");
    let params = json!({ "textDocument": { "uri": "file:///a.dxf" }, "options": { "tabSize": 4, "insertSpaces": true } });
    assert_eq!(client.request("textDocument/formatting", params).unwrap(), Value::Null);
    client.shut_down();
}
