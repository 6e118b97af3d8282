//! Handlers that wait for the client hold up nothing: no message, no cancellation, no end.

use crate::support::{Client, TIGHT, dxf_of, small, tight_plate};
use serde_json::{Value, json};
use std::time::Duration;

#[test]
fn a_doubled_id_harms_nobody() {
    let mut client = Client::start();
    // The first waits for the client, the second comes while it waits.
    for _ in 0..2 {
        client.send(
            &json!({ "jsonrpc": "2.0", "id": "twice", "method": "wedm/test/ask", "params": {} }),
        );
    }
    let second = client.wait_for("a refusal", |message| message["id"] == "twice");
    assert_eq!(second["error"]["code"], -32600);
    let asked = client.asked("wedm/test/question");
    client.respond(&asked, json!("yes"));
    assert_eq!(
        client.wait_for("the first answer", |message| message["id"] == "twice")["result"],
        "yes"
    );
    client.shut_down();
}

#[test]
fn handlers_that_wait_for_the_client_do_not_stop_the_others() {
    let mut client = Client::start();
    client.open_drawing("cad:///1", json!([tight_plate("2A")]));
    let waiting: Vec<i64> = (0..40)
        .map(|_| client.ask("wedm/test/ask", json!({})))
        .collect();
    let fifth = client
        .request("wedm/inspect", json!({ "uri": "cad:///1" }))
        .unwrap();
    assert_eq!(fifth["entities"].as_array().unwrap().len(), 1);
    // The waiting ones are answered in any order, one of them by a cancellation.
    client.notify("$/cancelRequest", json!({ "id": waiting[7] }));
    assert_eq!(client.answer(waiting[7]).unwrap_err()["code"], -32800);
    for number in 0..40 {
        let asked = client.asked("wedm/test/question");
        client.respond(&asked, json!(number));
    }
    for id in waiting.iter().filter(|&&id| id != waiting[7]) {
        assert!(client.answer(*id).is_ok());
    }
    client.shut_down();
}

const URI: &str = "file:///plate.dxf";

#[test]
fn ten_thousand_changes_between_slow_requests_are_applied_in_order() {
    const COUNT: i64 = 10_000;
    let mut client = Client::start();
    let text = format!("999\n\n{}", dxf_of(&[("2A", &TIGHT)]));
    client.open_text(URI, "dxf", &text);
    client.open_drawing("cad:///1", json!([tight_plate("2A")]));
    let mut requests = Vec::new();
    for number in 0..COUNT {
        // Every change appends to the comment; only in order does the last one leave it as it should be.
        let edit = match number {
            last if last == COUNT - 1 => {
                json!({ "range": { "start": { "line": 1, "character": 0 }, "end": { "line": 1, "character": COUNT - 1 } }, "text": "" })
            }
            _ => {
                json!({ "range": { "start": { "line": 1, "character": number }, "end": { "line": 1, "character": number } }, "text": "x" })
            }
        };
        client.notify("textDocument/didChange", json!({ "textDocument": { "uri": URI, "version": number + 2 }, "contentChanges": [edit] }));
        let splice = json!([{ "handle": "2A", "vertices": { "start": 0, "deleteCount": 1, "insert": [[-(number as f64) / 1e6, 5, 1]] } }]);
        client.change_drawing("cad:///1", number + 2, splice);
        if number % 500 == 0 {
            requests.push(client.ask("wedm/test/ask", json!({})));
            requests.push(client.ask("wedm/picture", json!({ "uri": "cad:///1" })));
            // Its handler waits for this answer, which must not be longer than a busy machine takes for everything else.
            let asked = client.asked("wedm/test/question");
            client.respond(&asked, Value::Null);
        }
    }
    assert_eq!(client.diagnostics(URI, COUNT + 1).len(), 1);
    let list = client
        .request("wedm/inspect", json!({ "uri": "cad:///1" }))
        .unwrap();
    assert_eq!(
        list["entities"][0]["segments"][0]["start"][0],
        -((COUNT - 1) as f64) / 1e6
    );
    assert_eq!(small(&client.diagnostics("cad:///1", COUNT + 1)), 1);
    // The comment is empty again: the bulge stands where it stood.
    let action = json!({ "textDocument": { "uri": URI }, "range": { "start": { "line": 0, "character": 0 }, "end": { "line": 1000, "character": 0 } },
        "context": { "diagnostics": [], "only": ["quickfix"] } });
    let actions = client.request("textDocument/codeAction", action).unwrap();
    let line = text
        .lines()
        .position(|line| line == "0.41421356237309503")
        .unwrap();
    assert_eq!(
        actions[0]["diagnostics"][0]["range"]["start"],
        json!({ "line": line, "character": 0 })
    );
    assert!(
        client
            .seen
            .iter()
            .all(|message| message["method"] != "window/logMessage"),
        "{:?}",
        client
            .seen
            .iter()
            .find(|message| message["method"] == "window/logMessage")
    );
    for id in requests {
        assert!(client.answer(id).is_ok());
    }
    client.shut_down();
}

#[test]
fn the_end_does_not_wait_for_them() {
    let mut client = Client::start();
    client.open_drawing("cad:///1", json!([tight_plate("2A")]));
    for _ in 0..5 {
        client.ask("wedm/test/ask", json!({}));
    }
    client.notify("exit", Value::Null);
    let (code, time) = client.end();
    assert_eq!(code, Some(1));
    assert!(time < Duration::from_secs(4), "{time:?}");
}
