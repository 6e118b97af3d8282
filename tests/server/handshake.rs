//! Lifecycle, and what client and server tell each other first.

use crate::support::{Client, capabilities, frame, tight_plate};
use serde_json::json;

#[test]
fn the_server_says_what_it_is_and_which_protocol_it_speaks() {
    let mut client = Client::raw();
    let result =
        client.shake_hands(json!({ "processId": null, "rootUri": null, "capabilities": {} }));
    assert_eq!(result["serverInfo"]["name"], "wedm");
    assert_eq!(result["serverInfo"]["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(
        result["capabilities"]["experimental"]["wedm"]["protocol"],
        1
    );
    assert_eq!(result["capabilities"]["textDocumentSync"]["change"], 2);
    assert_eq!(
        result["capabilities"]["executeCommandProvider"]["commands"],
        json!(["wedm.applyDrawingEdit", "wedm.scale"])
    );
    client.shut_down();
}

#[test]
fn positions_are_counted_in_utf_8_where_it_is_offered() {
    let check = |general: serde_json::Value, expected: &str| {
        let mut client = Client::raw();
        let result = client
            .shake_hands(json!({ "processId": null, "capabilities": { "general": general } }));
        assert_eq!(
            result["capabilities"]["positionEncoding"], expected,
            "{general}"
        );
    };
    check(json!({ "positionEncodings": ["utf-16", "utf-8"] }), "utf-8");
    check(
        json!({ "positionEncodings": ["utf-16", "utf-32"] }),
        "utf-16",
    );
    check(json!({}), "utf-16");
}

#[test]
fn each_state_of_life_has_its_own_refusal() {
    let mut client = Client::raw();
    assert_eq!(
        client.code("wedm/inspect", json!({ "uri": "cad:///1" })),
        -32002
    );
    assert_eq!(client.code("textDocument/codeAction", json!({})), -32002);
    assert_eq!(
        client.code("initialize", json!({ "capabilities": 3 })),
        -32602
    );
    client.shake_hands(json!({ "processId": null, "capabilities": capabilities() }));
    assert_eq!(
        client.code("initialize", json!({ "capabilities": {} })),
        -32600
    );
    assert_eq!(client.code("wedm/unheardOf", json!({})), -32601);
    assert_eq!(
        client.code(
            "textDocument/prepareTypeHierarchy",
            json!({ "textDocument": { "uri": "a:b" }, "position": { "line": 0, "character": 0 } })
        ),
        -32601
    );
    assert_eq!(client.code("wedm/inspect", json!({ "uri": 3 })), -32602);
    assert_eq!(client.code("wedm/inspect", json!([])), -32602);
    assert_eq!(
        client.code("wedm/inspect", json!({ "uri": "cad:///never" })),
        -32602
    );
    assert_eq!(
        client.code("textDocument/codeAction", json!({ "textDocument": {} })),
        -32602
    );
    client.notify("wedm/unheardOf", json!({}));
    client.request("shutdown", serde_json::Value::Null).unwrap();
    assert_eq!(
        client.code("wedm/inspect", json!({ "uri": "cad:///1" })),
        -32600
    );
    client.notify("exit", serde_json::Value::Null);
    assert_eq!(client.end().0, Some(0));
}

#[test]
fn what_is_sent_right_behind_initialize_is_not_lost() {
    let mut client = Client::raw();
    let drawing = json!({ "uri": "cad:///1", "version": 1, "entities": [tight_plate("2A")] });
    let mut bytes = frame(&json!({ "jsonrpc": "2.0", "id": 1, "method": "initialize", "params": { "capabilities": {} } }).to_string());
    bytes.extend(frame(
        &json!({ "jsonrpc": "2.0", "method": "initialized", "params": {} }).to_string(),
    ));
    bytes.extend(frame(&json!({ "jsonrpc": "2.0", "method": "wedm/didOpenDrawing", "params": { "drawing": drawing } }).to_string()));
    client.send_bytes(&bytes);
    assert_eq!(client.diagnostics("cad:///1", 1).len(), 1);
}
