//! A panic costs one request and no document.

use crate::support::{Client, TIGHT, dxf_of, small, tight_plate};
use serde_json::json;

#[test]
fn a_panic_costs_its_own_request_and_no_document() {
    for site in ["handler", "state", "worker"] {
        let mut client = Client::start();
        let uri = "cad:///1";
        client.open_drawing(uri, json!([tight_plate("2A")]));
        let text = dxf_of(&[("2A", &TIGHT)]);
        assert_eq!(client.open_text("file:///t.dxf", "dxf", &text).len(), 1);
        for panicked in [uri, "file:///t.dxf"] {
            for _ in 0..3 {
                assert_eq!(
                    client.code("wedm/test/panic", json!({ "site": site, "uri": panicked })),
                    -32603,
                    "{site}"
                );
            }
        }
        // Both documents are as they were, and go on to change.
        let list = client
            .request("wedm/inspect", json!({ "uri": uri }))
            .unwrap();
        assert_eq!(
            list["entities"][0]["segments"][2]["verdict"], "small-radius",
            "{site}"
        );
        client.change_drawing(uri, 2, json!([{ "handle": "2A", "vertices": { "start": 2, "deleteCount": 1, "insert": [[10, 9.95, 0]] } }]));
        assert_eq!(small(&client.diagnostics(uri, 2)), 0, "{site}");
        let end = json!({ "line": 100_000, "character": 0 });
        let change = json!({ "range": { "start": end, "end": end }, "text": "999\na comment\n" });
        client.notify(
            "textDocument/didChange",
            json!({ "textDocument": { "uri": "file:///t.dxf", "version": 2 }, "contentChanges": [change] }),
        );
        assert_eq!(small(&client.diagnostics("file:///t.dxf", 2)), 1, "{site}");
        client.shut_down();
    }
}

#[test]
fn the_id_of_a_request_that_panicked_may_be_used_again() {
    let mut client = Client::start();
    for _ in 0..3 {
        client.send(&json!({ "jsonrpc": "2.0", "id": "again", "method": "wedm/test/panic", "params": { "site": "handler" } }));
        assert_eq!(
            client.wait_for("an answer", |message| message["id"] == "again")["error"]["code"],
            -32603
        );
    }
    client.shut_down();
}
