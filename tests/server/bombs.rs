//! Documents that ask for absurd amounts of work: the others are answered all the same, and what was left out is said.

use crate::size::by_day;
use crate::support::{Client, PATIENCE, TIGHT, codes, dxf_of, small};
use serde_json::{Value, json};
use std::time::Instant;

/// Circles about one point, which come near each other everywhere.
fn circles(count: usize) -> String {
    let circle = |number: usize| {
        format!(
            "0\nCIRCLE\n10\n{}\n20\n0\n40\n{}\n",
            1e-4 * number as f64,
            1.0 + 0.01 * number as f64
        )
    };
    let circles: String = (0..count).map(circle).collect();
    // A text as long as this is handed to a worker, whatever it holds.
    let comments = "999\n\n".repeat(5_000);
    format!("{comments}0\nSECTION\n2\nENTITIES\n{circles}0\nENDSEC\n0\nEOF\n")
}

/// A block in rows and columns of a block in rows and columns.
fn nested_arrays(side: usize) -> String {
    let insert = |name: &str, step: usize| {
        format!(
            "0\nINSERT\n2\n{name}\n10\n0\n20\n0\n70\n{side}\n71\n{side}\n44\n{step}\n45\n{step}\n"
        )
    };
    let block =
        |name: &str, holds: &str| format!("0\nBLOCK\n2\n{name}\n10\n0\n20\n0\n{holds}0\nENDBLK\n");
    let blocks = block("A", "0\nCIRCLE\n10\n0\n20\n0\n40\n0.4\n") + &block("B", &insert("A", 1));
    format!(
        "0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n",
        insert("B", 1000)
    )
}

/// A subprogram of many small moves, called as often as a word can say.
fn calls(moves: usize) -> String {
    let body: String = (0..moves)
        .map(|number| format!("G01X{}.Y{}.\n", number * 7 % 13, number * 5 % 11))
        .collect();
    format!("G91\nM98P100L9999\nM02\nO100\n{body}M99\n")
}

fn open(client: &mut Client, uri: &str, language: &str, text: &str) {
    client.notify("textDocument/didOpen", json!({ "textDocument": { "uri": uri, "languageId": language, "version": 1, "text": text } }));
}

/// Opens a bomb a few `times` and edits another document while one is judged, however fast another one is; gives back what is said of
/// the bomb.
fn edits_beside(uri: &str, language: &str, bomb: &str, times: usize) -> Vec<Value> {
    let mut client = Client::start();
    let other = "file:///plate.dxf";
    let text = format!("999\n\n{}", dxf_of(&[("2A", &TIGHT)]));
    assert_eq!(small(&client.open_text(other, "dxf", &text)), 1);
    let is_told = |client: &Client| {
        client
            .seen
            .iter()
            .any(|message| message["params"]["uri"] == uri)
    };
    let mut beside = 0;
    for round in 0..times {
        let name = if round == 0 {
            uri.into()
        } else {
            format!("{uri}.{round}")
        };
        open(&mut client, &name, language, bomb);
    }
    let mut asked = Vec::new();
    for version in 2..12 {
        // Whatever is asked about one place of the bomb takes its time beside the state thread.
        let place =
            json!({ "textDocument": { "uri": uri }, "position": { "line": 4, "character": 2 } });
        for method in [
            "hover",
            "completion",
            "signatureHelp",
            "prepareRename",
            "definition",
        ] {
            asked.push(client.ask(&format!("textDocument/{method}"), place.clone()));
        }
        let began = Instant::now();
        let at = json!({ "line": 1, "character": 0 });
        let change = json!({ "range": { "start": at, "end": at }, "text": "x" });
        client
            .notify("textDocument/didChange", json!({ "textDocument": { "uri": other, "version": version }, "contentChanges": [change] }));
        assert_eq!(small(&client.diagnostics(other, version)), 1);
        // A busy machine takes its time; one that waits for the bombs takes longer.
        assert!(began.elapsed() < PATIENCE / 4, "{:?}", began.elapsed());
        beside += usize::from(!is_told(&client));
    }
    assert!(beside > 0, "every edit was answered behind the bomb");
    for id in asked {
        assert!(client.answer(id).is_ok());
    }
    // A request about the bomb is answered from what was judged, or not any more where that is closed before; closing and opening it
    // again are done in their order.
    let actions = json!({ "textDocument": { "uri": uri }, "range": { "start": { "line": 0, "character": 0 }, "end": { "line": 0, "character": 0 } },
        "context": { "diagnostics": [], "only": ["quickfix"] } });
    let asked = client.ask("textDocument/codeAction", actions);
    client.notify(
        "textDocument/didClose",
        json!({ "textDocument": { "uri": uri } }),
    );
    open(&mut client, uri, language, "");
    let told = client.diagnostics(uri, 1);
    if let Err(error) = client.answer(asked) {
        assert_eq!(error["code"], -32801);
    }
    assert_eq!(client.published(uri)["diagnostics"], json!([]), "closed");
    assert!(client.diagnostics(uri, 1).len() < 3, "opened again");
    told
}

#[test]
fn an_edit_is_answered_while_circles_about_one_point_are_compared() {
    assert!(
        codes(&edits_beside(
            "file:///circles.dxf",
            "dxf",
            &circles(200),
            3
        ))
        .contains(&"narrow-slot")
    );
}

#[test]
fn an_edit_is_answered_while_subprograms_are_followed() {
    assert!(
        codes(&edits_beside(
            "file:///calls.nc",
            "wire-iso",
            &calls(40),
            by_day(1, 3)
        ))
        .contains(&"not-judged")
    );
}

#[test]
fn arrays_in_each_other_are_not_drawn_and_that_is_an_error() {
    let mut client = Client::start();
    let uri = "file:///arrays.dxf";
    let told = client.open_text(uri, "dxf", &nested_arrays(30));
    let finding = told
        .iter()
        .find(|finding| finding["code"] == "not-judged")
        .expect("it is said");
    assert_eq!(
        (&finding["severity"], &finding["data"]["count"]),
        (&json!(1), &json!(900))
    );
    // A program would lack what is not drawn.
    assert_eq!(
        client.code("wedm/generate", json!({ "uri": uri, "format": "3b" })),
        -32803
    );
    let told = client.open_text("file:///few.dxf", "dxf", &nested_arrays(5));
    assert!(!codes(&told).contains(&"not-judged"), "{told:?}");
    client.shut_down();
}

#[test]
fn a_burst_of_changes_of_what_takes_long_is_judged_in_one() {
    let mut client = Client::start();
    let uri = "file:///circles.dxf";
    open(&mut client, uri, "dxf", &circles(200));
    client.diagnostics(uri, 1);
    for version in 2..102 {
        let at = json!({ "line": 1, "character": 0 });
        let change = json!({ "range": { "start": at, "end": at }, "text": "x" });
        client.notify("textDocument/didChange", json!({ "textDocument": { "uri": uri, "version": version }, "contentChanges": [change] }));
    }
    let mut judged = 1;
    let mut last = client.published(uri);
    while last["version"] != 101 {
        (judged, last) = (judged + 1, client.published(uri));
    }
    let told = last["diagnostics"].as_array().expect("a list");
    assert!(codes(told).contains(&"narrow-slot"));
    assert!(judged < 30, "a hundred changes were judged {judged} times");
    client.shut_down();
}
