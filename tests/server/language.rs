//! What editors ask about DXF text, over the real process.

use crate::support::{Client, TIGHT, capabilities, dxf_of};
use serde_json::{Value, json};

const URI: &str = "file:///plate.dxf";

fn start() -> Client {
    let mut all = capabilities();
    all["textDocument"] = json!({ "documentSymbol": { "hierarchicalDocumentSymbolSupport": true } });
    Client::start_with(all, json!({}))
}

fn at(line: u64, character: u64) -> Value {
    json!({ "textDocument": { "uri": URI }, "position": { "line": line, "character": character } })
}

fn document() -> Value {
    json!({ "textDocument": { "uri": URI } })
}

/// Zero-based number of the first line that is `wanted`.
fn line_of(text: &str, wanted: &str) -> u64 {
    text.lines().position(|line| line == wanted).unwrap_or_else(|| panic!("there is a line {wanted}")) as u64
}

/// Names of a symbol and of those in it, indented by depth.
fn names(symbols: &Value, depth: usize, list: &mut Vec<String>) {
    for symbol in symbols.as_array().into_iter().flatten() {
        list.push(format!("{}{}", "  ".repeat(depth), symbol["name"].as_str().unwrap_or_default()));
        names(&symbol["children"], depth + 1, list);
    }
}

#[test]
fn hover_symbols_and_folds_of_a_plate() {
    let mut client = start();
    let text = dxf_of(&[("2A", &TIGHT)]);
    client.open_text(URI, "dxf", &text);
    let bulge = line_of(&text, "0.41421356237309503");
    let hover = client.request("textDocument/hover", at(bulge, 3)).unwrap();
    let said = hover["contents"]["value"].as_str().unwrap();
    assert!(said.contains("bulge") && said.contains("90°") && said.contains("radius 0.05 mm") && said.contains("(9.95, 9.95)"), "{said}");
    let mut list = Vec::new();
    names(&client.request("textDocument/documentSymbol", document()).unwrap(), 0, &mut list);
    assert_eq!(list, ["HEADER", "ENTITIES", "  Contours", "    contour 1", "  LWPOLYLINE 2A"]);
    let folds = client.request("textDocument/foldingRange", document()).unwrap();
    assert_eq!(folds.as_array().unwrap().len(), 3, "{folds}");
    client.shut_down();
}
