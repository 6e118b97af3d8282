//! Broken frames, broken messages, odd ids: each costs itself alone.

use crate::support::{Client, frame, tight_plate};
use serde_json::{Value, json};

#[test]
fn valid_requests_between_broken_frames_are_all_answered_and_an_open_drawing_stays() {
    const COUNT: usize = 400;
    let mut client = Client::start();
    assert_eq!(client.open_drawing("cad:///kept", json!([tight_plate("2A")])).len(), 1);
    let broken: [&[u8]; 10] = [
        b"Content-Length: 7\r\n\r\n{\"a\": 1",
        b"Content-Length: abc\r\n\r\n{}",
        b"Content-Length: -1\r\n\r\n{}",
        b"Content-Length: 99999999999\r\n\r\n{\"jsonrpc\"",
        b"Content-Length: 300\r\n\r\n{\"jsonrpc\":\"2.0\"}",
        b"Content-Length: 4\r\n\r\n{\"jsonrpc\":\"2.0\",\"id\":1}",
        b"no header at all\r\n\r\n",
        b"Content-Type: application/json\r\n\r\n{\"jsonrpc\":\"2.0\"}",
        b"Content-Length: 4\r\n\r\n\xff\xfe\x00\x01",
        b"{\"jsonrpc\":\"2.0\",\"id\":77,\"method\":\"shutdown\"}",
    ];
    let mut ids = Vec::new();
    for index in 0..COUNT {
        ids.push(client.ask("wedm/inspect", json!({ "uri": "cad:///kept" })));
        client.send_bytes(broken[index % broken.len()]);
    }
    ids.push(client.ask("wedm/inspect", json!({ "uri": "cad:///kept" })));
    for id in ids {
        assert_eq!(client.answer(id).unwrap()["entities"][0]["segments"][2]["verdict"], "small-radius");
    }
    let errors: Vec<i64> = client
        .settle()
        .iter()
        .filter(|message| message["id"].is_null() && message.get("error").is_some())
        .filter_map(|message| message["error"]["code"].as_i64())
        .collect();
    assert_eq!(errors.len(), COUNT);
    assert!(errors.iter().all(|code| [-32700, -32600].contains(code)));
    client.shut_down();
}

#[test]
fn a_message_that_is_none_is_answered_with_its_fault() {
    let check = |body: &str, id: Value, code: i64| {
        let mut client = Client::start();
        client.send_bytes(&frame(body));
        let answer = client.wait_for(body, |message| message.get("error").is_some());
        assert_eq!((&answer["id"], &answer["error"]["code"]), (&id, &json!(code)), "{body}");
        client.shut_down();
    };
    check("", Value::Null, -32700);
    check("{", Value::Null, -32700);
    check("nonsense", Value::Null, -32700);
    check(r#"{"jsonrpc":"2.0","id":1,"method":"wedm/inspect","params":{"uri":NaN}}"#, Value::Null, -32700);
    check(&"[".repeat(100_000), Value::Null, -32700);
    check("[]", Value::Null, -32600);
    check(r#"[{"jsonrpc":"2.0","id":1,"method":"shutdown"}]"#, Value::Null, -32600);
    check("42", Value::Null, -32600);
    check(r#"{"jsonrpc":"2.0"}"#, Value::Null, -32600);
    check(r#"{"jsonrpc":"2.0","id":4711}"#, Value::Null, -32600);
    check(r#"{"jsonrpc":"1.0","id":4711,"method":"wedm/inspect"}"#, json!(4711), -32600);
    check(r#"{"jsonrpc":"2.0","id":{},"method":"wedm/inspect"}"#, Value::Null, -32600);
    check(r#"{"jsonrpc":"2.0","id":4711,"method":7}"#, json!(4711), -32600);
    check(r#"{"jsonrpc":"2.0","id":4711,"method":"wedm/inspect"}"#, json!(4711), -32602);
    check(r#"{"jsonrpc":"2.0","id":4711,"method":"wedm/inspect","params":"x"}"#, json!(4711), -32602);
    check(r#"{"jsonrpc":"2.0","id":4711,"method":"wedm/didOpenDrawing","params":{}}"#, json!(4711), -32600);
}

#[test]
fn ids_of_every_kind_are_given_back_and_a_doubled_one_harms_nobody() {
    let mut client = Client::start();
    client.open_drawing("cad:///1", json!([tight_plate("2A")]));
    for id in [json!("a string"), json!(-5), json!(9_007_199_254_740_993_i64), json!(0)] {
        client.send(&json!({ "jsonrpc": "2.0", "id": id, "method": "wedm/inspect", "params": { "uri": "cad:///1" } }));
        let answer = client.wait_for("an answer", |message| message["id"] == id);
        assert!(answer["result"].is_object(), "{answer}");
    }
    // The first waits for the client, the second comes while it waits.
    for _ in 0..2 {
        client.send(&json!({ "jsonrpc": "2.0", "id": "twice", "method": "wedm/test/ask", "params": {} }));
    }
    let second = client.wait_for("a refusal", |message| message["id"] == "twice");
    assert_eq!(second["error"]["code"], -32600);
    let asked = client.asked("wedm/test/question");
    client.respond(&asked, json!("yes"));
    assert_eq!(client.wait_for("the first answer", |message| message["id"] == "twice")["result"], "yes");
    client.shut_down();
}

#[test]
fn handlers_that_wait_for_the_client_do_not_stop_the_others() {
    let mut client = Client::start();
    client.open_drawing("cad:///1", json!([tight_plate("2A")]));
    let waiting: Vec<i64> = (0..40).map(|_| client.ask("wedm/test/ask", json!({}))).collect();
    let fifth = client.request("wedm/inspect", json!({ "uri": "cad:///1" })).unwrap();
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

#[test]
fn answers_to_nothing_are_logged() {
    let mut client = Client::start();
    client.send(&json!({ "jsonrpc": "2.0", "id": "wedm-999", "result": null }));
    client.logged("wedm-999");
    client.shut_down();
}

#[test]
fn notifications_with_broken_params_are_said_to_be_ignored() {
    let mut client = Client::start();
    client.notify("textDocument/didChange", json!({ "textDocument": { "uri": "file:///a.dxf" } }));
    client.logged("textDocument/didChange was ignored");
    client.notify("wedm/didOpenDrawing", json!({ "drawing": [] }));
    client.logged("wedm/didOpenDrawing was ignored");
    client.notify("wedm/didCloseDrawing", json!({}));
    client.logged("wedm/didCloseDrawing was ignored");
    client.shut_down();
}
