//! Semantic tokens after edits: what the server says has changed makes the tokens of the whole text of those before.

use crate::support::{Client, TIGHT, capabilities, dxf_of};
use serde_json::{Value, json};

fn start() -> Client {
    let mut all = capabilities();
    all["textDocument"] = json!({ "semanticTokens": {
        "requests": { "full": { "delta": true } }, "tokenTypes": [], "tokenModifiers": [], "formats": ["relative"],
    } });
    Client::start_with(all, json!({}))
}

fn numbers(tokens: &Value) -> Vec<u64> {
    tokens
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(Value::as_u64)
        .collect()
}

/// An answer laid over the tokens before it, and how many numbers it brought.
fn applied(before: &[u64], answer: &Value) -> (Vec<u64>, usize) {
    let Some(edits) = answer["edits"].as_array() else {
        let data = numbers(&answer["data"]);
        let count = data.len();
        return (data, count);
    };
    let (mut tokens, mut sent) = (before.to_vec(), 0);
    for edit in edits.iter().rev() {
        let (start, count) = (
            edit["start"].as_u64().unwrap() as usize,
            edit["deleteCount"].as_u64().unwrap() as usize,
        );
        let data = numbers(&edit["data"]);
        sent += data.len();
        tokens.splice(start..start + count, data);
    }
    (tokens, sent)
}

/// The same numbers in every run.
struct Dice(u64);

impl Dice {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % end
    }
}

/// Edits a text at random places, and holds the tokens that differences lead to against those of the whole text.
fn check(uri: &str, language: &str, text: &str, pieces: &[&str]) {
    let mut client = start();
    client.open_text(uri, language, text);
    let document = json!({ "textDocument": { "uri": uri } });
    let full = |client: &mut Client| {
        client
            .request("textDocument/semanticTokens/full", document.clone())
            .unwrap()
    };
    let first = full(&mut client);
    let (mut tokens, mut id) = (numbers(&first["data"]), first["resultId"].clone());
    let (mut dice, mut differences) = (Dice(7), 0);
    let lines = text.lines().count();
    for version in 2..60 {
        let line = dice.below(lines);
        let end = line + dice.below(3);
        let changes = json!([{
            "range": { "start": { "line": line, "character": dice.below(4) }, "end": { "line": end, "character": dice.below(6) } },
            "text": pieces[dice.below(pieces.len())],
        }]);
        client.notify("textDocument/didChange", json!({ "textDocument": { "uri": uri, "version": version }, "contentChanges": changes }));
        let params = json!({ "textDocument": { "uri": uri }, "previousResultId": id });
        let answer = client
            .request("textDocument/semanticTokens/full/delta", params)
            .unwrap();
        differences += usize::from(answer.get("edits").is_some());
        tokens = applied(&tokens, &answer).0;
        id = answer["resultId"].clone();
        assert_eq!(tokens, numbers(&full(&mut client)["data"]), "{changes}");
    }
    assert_eq!(differences, 58, "every answer is a difference");
    client.shut_down();
}

#[test]
fn differences_lead_to_the_tokens_of_the_whole_text() {
    let pieces = ["", "\n", "10\n1.5\n", "ü", "0\nLINE\n", "999\nn\n", "x"];
    check(
        "file:///plate.dxf",
        "dxf",
        &dxf_of(&[("2A", &TIGHT), ("2B", &TIGHT)]),
        &pieces,
    );
    let program = "N1 B9900B0B9900GXL1 ; in\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n".repeat(6);
    check(
        "file:///hole.3b",
        "3b",
        &program,
        &["", "\n", "B", "B1B2B3GXL1\n", "; ü\n", "9", "DD"],
    );
    check(
        "file:///hole.nc",
        "wire-iso",
        &"G90\nG01 X1.0 Y2.0\n(x)\nG02 X2. Y3. I1. J0.\n".repeat(6),
        &["", "\n", "G01", "X1", "(ü)\n"],
    );
}

#[test]
fn an_edit_costs_its_tokens_and_an_unknown_answer_the_whole() {
    let uri = "file:///plate.dxf";
    let text = dxf_of(&[("2A", &TIGHT), ("2B", &TIGHT)]);
    let mut client = start();
    client.open_text(uri, "dxf", &text);
    let delta = |client: &mut Client, id: &Value| {
        let params = json!({ "textDocument": { "uri": uri }, "previousResultId": id });
        client
            .request("textDocument/semanticTokens/full/delta", params)
            .unwrap()
    };
    let first = client
        .request(
            "textDocument/semanticTokens/full",
            json!({ "textDocument": { "uri": uri } }),
        )
        .unwrap();
    let unchanged = delta(&mut client, &first["resultId"]);
    assert_eq!(
        unchanged,
        json!({ "resultId": first["resultId"], "edits": [] })
    );
    let top =
        json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 0, "character": 0 } });
    let changes = json!([{ "range": top, "text": "999\nn\n" }]);
    client.notify(
        "textDocument/didChange",
        json!({ "textDocument": { "uri": uri, "version": 2 }, "contentChanges": changes }),
    );
    let answer = delta(&mut client, &first["resultId"]);
    assert!(
        applied(&numbers(&first["data"]), &answer).1 <= 3 * 5,
        "{answer}"
    );
    // A result of long ago, or of another server.
    for id in [json!("0"), first["resultId"].clone()] {
        assert_eq!(
            numbers(&delta(&mut client, &id)["data"]).len(),
            5 * (text.lines().count() + 2),
            "{id}"
        );
    }
    client.shut_down();
}
