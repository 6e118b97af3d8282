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

/// Lead-in, circle, lead-out.
const NUMBERED: &str = "; a hole\n; R10\nN1 B9900B0B9900GXL1\nN2 B9900B0B39600GYNR1\nN3 B9900B0B9900GXL3\nD\nDD\n";

#[test]
fn each_question_has_its_answer() {
    let mut client = start();
    client.open_text(URI, "3b", NUMBERED);
    let hover = client.request("textDocument/hover", at(3, 4)).unwrap();
    let said = hover["contents"]["value"].as_str().unwrap();
    assert!(said.contains("**X** of an arc") && said.contains("R 9.900 mm, 360°"), "{said}");
    assert_eq!(hover["range"], json!({ "start": { "line": 3, "character": 4 }, "end": { "line": 3, "character": 8 } }));
    let mut params = document();
    params["range"] = lines(2, 4);
    let hints = client.request("textDocument/inlayHint", params.clone()).unwrap();
    let labels: Vec<_> = hints.as_array().unwrap().iter().map(|hint| hint["label"].as_str().unwrap()).collect();
    assert_eq!(labels, ["→ 9.900, 0.000", "R 9.900, 360° → 9.900, 0.000"]);
    let symbols = client.request("textDocument/documentSymbol", document()).unwrap();
    assert_eq!(symbols[0]["name"], "contour 1");
    let names: Vec<_> = symbols[0]["children"].as_array().unwrap().iter().map(|child| child["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["lead-in", "N2", "lead-out"]);
    let folds = client.request("textDocument/foldingRange", document()).unwrap();
    assert_eq!((&folds[0]["kind"], &folds[1]["endLine"]), (&json!("comment"), &json!(4)), "{folds}");
    let full = client.request("textDocument/semanticTokens/full", document()).unwrap();
    let first_block: Vec<_> = full["data"].as_array().unwrap()[10..15].iter().map(|number| number.as_u64().unwrap()).collect();
    assert_eq!(first_block, [1, 0, 2, 2, 0]);
    let range = client.request("textDocument/semanticTokens/range", params).unwrap();
    assert_eq!(range["data"].as_array().unwrap().len(), 2 * 9 * 5);
    let end = client.request("textDocument/definition", at(5, 0)).unwrap();
    assert_eq!(end[0]["range"]["start"]["line"], 6);
    let both = client.request("textDocument/documentHighlight", at(2, 5)).unwrap();
    assert_eq!((&both[0]["range"]["start"]["line"], &both[1]["range"]["start"]["line"]), (&json!(2), &json!(4)));
    let mut references = at(5, 0);
    references["context"] = json!({ "includeDeclaration": true });
    assert_eq!(client.request("textDocument/references", references).unwrap().as_array().unwrap().len(), 2);
    let mut places = document();
    places["positions"] = json!([{ "line": 2, "character": 5 }]);
    let selection = client.request("textDocument/selectionRange", places).unwrap();
    assert_eq!(selection[0]["range"]["start"]["character"], 4);
    assert_eq!(selection[0]["parent"]["range"]["end"]["character"], 19);
    client.shut_down();
}

#[test]
fn a_block_gets_another_number() {
    let mut client = start();
    client.open_text(URI, "3b", NUMBERED);
    assert_eq!(client.request("textDocument/prepareRename", at(3, 1)).unwrap()["placeholder"], "2");
    assert_eq!(client.request("textDocument/prepareRename", at(3, 6)).unwrap(), Value::Null);
    let mut params = at(3, 1);
    params["newName"] = json!("N20");
    let edit = client.request("textDocument/rename", params.clone()).unwrap();
    let change = &edit["documentChanges"][0];
    assert_eq!((&change["textDocument"]["version"], &change["edits"][0]["newText"]), (&json!(1), &json!("20")));
    params["newName"] = json!("3");
    let error = client.request("textDocument/rename", params).unwrap_err();
    assert_eq!(error["message"], "N3 is the block in line 5");
    client.shut_down();
}

#[test]
fn odd_programs_are_answered_too() {
    for text in ["", "\n", "DD", "D\nD\n", "B1B2", "\u{feff}B5B0B5GXL1\r\nDD", "B0B0B5GXNR1\nB5B0B0GXL1\n", "N1\nN2\n;\n;\n"] {
        let mut client = start();
        client.open_text(URI, "3b", text);
        for line in [0, 1, 99] {
            let mut range = document();
            range["range"] = lines(0, 9);
            range["options"] = json!({ "tabSize": 4, "insertSpaces": true });
            let mut places = document();
            places["positions"] = json!([{ "line": line, "character": 1 }]);
            for (method, params) in [
                ("hover", at(line, 1)),
                ("definition", at(line, 1)),
                ("documentHighlight", at(line, 0)),
                ("prepareRename", at(line, 0)),
                ("documentSymbol", document()),
                ("foldingRange", document()),
                ("selectionRange", places),
                ("inlayHint", range.clone()),
                ("semanticTokens/full", document()),
                ("semanticTokens/range", range.clone()),
                ("formatting", range.clone()),
                ("rangeFormatting", range),
            ] {
                client.request(&format!("textDocument/{method}"), params).unwrap_or_else(|error| panic!("{method} of {text:?}: {error}"));
            }
        }
        client.shut_down();
    }
}
