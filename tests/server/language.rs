//! What editors ask about DXF text, over the real process.

use crate::size::by_day;
use crate::support::{Client, TIGHT, capabilities, dxf_of, tight_plate};
use serde_json::{Value, json};

const URI: &str = "file:///plate.dxf";

fn start() -> Client {
    let mut all = capabilities();
    all["textDocument"] =
        json!({ "documentSymbol": { "hierarchicalDocumentSymbolSupport": true } });
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
    text.lines()
        .position(|line| line == wanted)
        .unwrap_or_else(|| panic!("there is a line {wanted}")) as u64
}

/// Names of a symbol and of those in it, indented by depth.
fn names(symbols: &Value, depth: usize, list: &mut Vec<String>) {
    for symbol in symbols.as_array().into_iter().flatten() {
        list.push(format!(
            "{}{}",
            "  ".repeat(depth),
            symbol["name"].as_str().unwrap_or_default()
        ));
        names(&symbol["children"], depth + 1, list);
    }
}

/// Where the shop's wires are known, an arc says what it costs, at its vertex, and its polyline as a whole says nothing.
#[test]
fn hover_says_what_a_radius_costs() {
    let shop = json!({
        "side": "opening",
        "job": { "thickness": 40, "wires": [0.25, 0.06], "wireGaps": [0.03, 0.01], "wireRates": [100, 20] },
    });
    let mut client = Client::start_with(capabilities(), shop);
    let text = dxf_of(&[("2A", &TIGHT)]);
    client.open_text(URI, "dxf", &text);
    let mut said = |line: u64| -> String {
        let hover = client.request("textDocument/hover", at(line, 0)).unwrap();
        hover["contents"]["value"].as_str().unwrap().to_owned()
    };
    let bulge = said(line_of(&text, "0.41421356237309503"));
    assert!(
        bulge.contains("bulge")
            && bulge.ends_with("\n\nR 0.050 mm needs the wire Ø 0.06 mm: +53.66 min against Ø 0.25 mm, from R 0.155 mm on"),
        "{bulge}"
    );
    let head = said(line_of(&text, "LWPOLYLINE"));
    assert!(!head.contains("needs the wire"), "{head}");
    client.shut_down();
}

#[test]
fn hover_symbols_and_folds_of_a_plate() {
    let mut client = start();
    let text = dxf_of(&[("2A", &TIGHT)]);
    client.open_text(URI, "dxf", &text);
    let bulge = line_of(&text, "0.41421356237309503");
    let hover = client.request("textDocument/hover", at(bulge, 3)).unwrap();
    let said = hover["contents"]["value"].as_str().unwrap();
    assert!(
        said.contains("bulge")
            && said.contains("90°")
            && said.contains("radius 0.05 mm")
            && said.contains("(9.95, 9.95)"),
        "{said}"
    );
    let mut list = Vec::new();
    names(
        &client
            .request("textDocument/documentSymbol", document())
            .unwrap(),
        0,
        &mut list,
    );
    assert_eq!(
        list,
        [
            "HEADER",
            "ENTITIES",
            "  Contours",
            "    contour 1",
            "  LWPOLYLINE 2A"
        ]
    );
    let folds = client
        .request("textDocument/foldingRange", document())
        .unwrap();
    assert_eq!(folds.as_array().unwrap().len(), 3, "{folds}");
    client.shut_down();
}

#[test]
fn what_can_be_asked_is_declared() {
    let mut client = Client::raw();
    let result = client.shake_hands(json!({ "processId": null, "capabilities": {} }));
    for provider in [
        "hover",
        "completion",
        "definition",
        "references",
        "documentHighlight",
        "documentSymbol",
        "foldingRange",
        "selectionRange",
        "inlayHint",
        "semanticTokens",
    ] {
        assert!(
            !result["capabilities"][format!("{provider}Provider")].is_null(),
            "{provider}"
        );
    }
    client.shut_down();
}

/// Every request of an editor, at a line; the answers by method.
fn ask_all(client: &mut Client, line: u64) -> Vec<(&'static str, Value)> {
    let lines =
        json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 100, "character": 0 } });
    let in_range = json!({ "textDocument": { "uri": URI }, "range": lines });
    let mut references = at(line, 0);
    references["context"] = json!({ "includeDeclaration": true });
    let places =
        json!({ "textDocument": { "uri": URI }, "positions": [{ "line": line, "character": 0 }] });
    let all = [
        ("textDocument/hover", at(line, 0)),
        ("textDocument/completion", at(line, 0)),
        ("textDocument/definition", at(line, 0)),
        ("textDocument/references", references),
        ("textDocument/documentHighlight", at(line, 0)),
        ("textDocument/documentSymbol", document()),
        ("textDocument/foldingRange", document()),
        ("textDocument/selectionRange", places),
        ("textDocument/inlayHint", in_range.clone()),
        ("textDocument/semanticTokens/full", document()),
        ("textDocument/semanticTokens/range", in_range),
    ];
    all.into_iter()
        .map(|(method, params)| {
            (
                method,
                client
                    .request(method, params)
                    .unwrap_or_else(|error| panic!("{method}: {error}")),
            )
        })
        .collect()
}

fn answer(answers: &[(&str, Value)], method: &str) -> Value {
    answers
        .iter()
        .find(|(name, _)| name.ends_with(method))
        .map(|(_, answer)| answer.clone())
        .unwrap_or_default()
}

#[test]
fn one_round_of_each_and_again_after_an_edit() {
    let mut client = start();
    let text = dxf_of(&[("2A", &TIGHT)]);
    client.open_text(URI, "dxf", &text);
    let handle = line_of(&text, "2A");
    let answers = ask_all(&mut client, handle);
    assert!(
        answers
            .iter()
            .all(|(name, answer)| !answer.is_null() || name.ends_with("completion")),
        "{answers:?}"
    );
    let place = json!({ "start": { "line": handle, "character": 0 }, "end": { "line": handle, "character": 2 } });
    assert_eq!(
        answer(&answers, "definition"),
        json!([{ "uri": URI, "range": place }])
    );
    assert_eq!(answer(&answers, "selectionRange")[0]["range"], place);
    let hints = answer(&answers, "inlayHint");
    assert!(
        hints
            .as_array()
            .is_some_and(|hints| hints.iter().any(|hint| hint["label"] == "R 0.05 mm, 90°")),
        "{hints}"
    );
    let (full, range) = (
        answer(&answers, "semanticTokens/full"),
        answer(&answers, "semanticTokens/range"),
    );
    assert_eq!(full["data"], range["data"]);
    assert_eq!(
        full["data"].as_array().map(Vec::len),
        Some(5 * text.lines().count())
    );
    // Two lines before everything, and everything is two lines further down.
    let top =
        json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 0, "character": 0 } });
    let changes = json!([{ "range": top, "text": "999\n\u{fc}\n" }]);
    client.notify(
        "textDocument/didChange",
        json!({ "textDocument": { "uri": URI, "version": 2 }, "contentChanges": changes }),
    );
    let answers = ask_all(&mut client, handle + 2);
    assert_eq!(
        answer(&answers, "definition")[0]["range"]["start"]["line"],
        handle + 2
    );
    assert_eq!(
        answer(&answers, "semanticTokens/full")["data"]
            .as_array()
            .map(Vec::len),
        Some(5 * (text.lines().count() + 2))
    );
    assert_eq!(
        answer(&answers, "documentSymbol")[0]["range"]["start"]["line"],
        2
    );
    client.shut_down();
}

#[test]
fn odd_texts_are_answered_too() {
    let text = dxf_of(&[("2A", &TIGHT)]);
    let damaged = text.replacen("10\n", "", 1) + "junk";
    for text in [
        "",
        "\n",
        &damaged,
        &text.replace('\n', "\r\n"),
        &text[..text.len() / 2],
        "0\nEOF",
    ] {
        let mut client = start();
        client.open_text(URI, "dxf", text);
        for line in [0, 1, 15, 22, 9_999] {
            ask_all(&mut client, line);
        }
        assert!(client.settle().iter().all(|message| {
            !message["params"]["message"]
                .as_str()
                .unwrap_or_default()
                .contains("internal error")
        }));
        client.shut_down();
    }
}

#[test]
fn what_is_neither_dxf_nor_program_is_answered_with_nothing() {
    let mut client = start();
    client.open_drawing(URI, json!([tight_plate("2A")]));
    let answers = ask_all(&mut client, 0);
    assert!(
        answers.iter().all(|(_, answer)| answer.is_null()),
        "{answers:?}"
    );
    client.shut_down();
}

#[test]
fn symbols_are_a_list_for_clients_that_know_no_trees() {
    let mut client = Client::start();
    client.open_text(URI, "dxf", &dxf_of(&[("2A", &TIGHT)]));
    let symbols = client
        .request("textDocument/documentSymbol", document())
        .unwrap();
    let last = symbols
        .as_array()
        .and_then(|list| list.last())
        .cloned()
        .unwrap_or_default();
    assert_eq!(
        (&last["name"], &last["containerName"]),
        (&json!("LWPOLYLINE 2A"), &json!("ENTITIES"))
    );
    client.shut_down();
}

#[test]
fn a_long_text_is_answered_and_a_text_that_moved_on_is_not() {
    let handles: Vec<String> = (0..by_day(9_000, 36_000))
        .map(|i| format!("{i:X}"))
        .collect();
    let text = dxf_of(
        &handles
            .iter()
            .map(|handle| (handle.as_str(), &TIGHT[..]))
            .collect::<Vec<_>>(),
    );
    let mut client = start();
    client.open_text(URI, "dxf", &text);
    let began = std::time::Instant::now();
    for (method, answer) in ask_all(&mut client, line_of(&text, "2A")) {
        println!(
            "{} bytes of text, {method}: {} bytes",
            text.len(),
            answer.to_string().len()
        );
    }
    println!("all of them took {:?}", began.elapsed());
    let id = client.ask("textDocument/documentSymbol", document());
    let top =
        json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 0, "character": 0 } });
    let changes = json!([{ "range": top, "text": "999\nx\n" }]);
    client.notify(
        "textDocument/didChange",
        json!({ "textDocument": { "uri": URI, "version": 2 }, "contentChanges": changes }),
    );
    assert_eq!(client.answer(id).unwrap_err()["code"], -32801);
    client.shut_down();
}

#[test]
fn names_of_a_program_are_found_and_those_that_nothing_else_speaks_of_where_they_stand() {
    let mut client = start();
    let text = "N10 H1=0.1 H2=0.2\nN20 G41 H1 G01 X1.\nC001 = ON 8\nC1 E5\nM98 P30\nM02\nN30 G01 X0.\nM99\n";
    client.open_text(URI, "wire-iso", text);
    // The cursor; where that is given, every place of it.
    for (cursor, given, all) in [
        ((0, 4), vec![(0, 4)], vec![(0, 4), (1, 8)]),
        ((1, 8), vec![(0, 4)], vec![(0, 4), (1, 8)]),
        ((0, 12), vec![(0, 11)], vec![(0, 11)]),
        ((3, 0), vec![(2, 0)], vec![(2, 0), (3, 0)]),
        ((3, 4), vec![], vec![(3, 3)]),
        ((4, 5), vec![(6, 0)], vec![(4, 4), (6, 0)]),
        ((6, 1), vec![(6, 0)], vec![(4, 4), (6, 0)]),
    ] {
        let places = |answer: Value| -> Vec<(u64, u64)> {
            let place = |found: &Value| {
                let start = &found["range"]["start"];
                (
                    start["line"].as_u64().unwrap(),
                    start["character"].as_u64().unwrap(),
                )
            };
            answer.as_array().into_iter().flatten().map(place).collect()
        };
        let mut asked = at(cursor.0, cursor.1);
        let found = client
            .request("textDocument/definition", asked.clone())
            .unwrap();
        assert_eq!(places(found), given, "{cursor:?}");
        asked["context"] = json!({ "includeDeclaration": true });
        let found = client.request("textDocument/references", asked).unwrap();
        assert_eq!(places(found), all, "{cursor:?}");
    }
    client.shut_down();
}

/// A sum of nothing is nothing: no length of an answer is -0.
#[test]
fn no_number_of_an_answer_is_minus_nothing() {
    fn check(at: &str, value: &Value) {
        match value {
            Value::Number(number) => {
                let number = number.as_f64().unwrap();
                assert!(number != 0.0 || number.is_sign_positive(), "{at}");
            }
            Value::Array(all) => all.iter().for_each(|value| check(at, value)),
            Value::Object(all) => {
                for (key, value) in all {
                    check(&format!("{at}.{key}"), value);
                }
            }
            _ => {}
        }
    }
    let mut client = Client::start_with(capabilities(), json!({ "side": "opening" }));
    let square: [[f64; 3]; 4] = [[0., 0., 0.], [20., 0., 0.], [20., 10., 0.], [0., 10., 0.]];
    let sound = dxf_of(&[("2A", &square)]);
    client.open_text(URI, "dxf", &sound);
    for (method, params) in [
        ("wedm/toolpath", json!({ "uri": URI })),
        ("wedm/generate", json!({ "uri": URI, "format": "3b" })),
        ("wedm/generate", json!({ "uri": URI, "format": "iso" })),
    ] {
        let answer = client.request(method, params).unwrap();
        assert!(answer["work"]["jumps"].is_number(), "{answer}");
        check(method, &answer["work"]);
        check(method, &answer["jumps"]);
    }
    client.shut_down();
}
