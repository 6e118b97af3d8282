//! Broken frames, broken messages, odd ids: each costs itself alone.

use crate::support::{Client, frame, tight_plate};
use serde_json::{Value, json};

#[test]
fn valid_requests_between_broken_frames_are_all_answered_and_an_open_drawing_stays() {
    const COUNT: usize = 400;
    let mut client = Client::start();
    assert_eq!(
        client
            .open_drawing("cad:///kept", json!([tight_plate("2A")]))
            .len(),
        1
    );
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
        assert_eq!(
            client.answer(id).unwrap()["entities"][0]["segments"][2]["verdict"],
            "small-radius"
        );
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
        assert_eq!(
            (&answer["id"], &answer["error"]["code"]),
            (&id, &json!(code)),
            "{body}"
        );
        client.shut_down();
    };
    check("", Value::Null, -32700);
    check("{", Value::Null, -32700);
    check("nonsense", Value::Null, -32700);
    check(
        r#"{"jsonrpc":"2.0","id":1,"method":"wedm/inspect","params":{"uri":NaN}}"#,
        Value::Null,
        -32700,
    );
    check(&"[".repeat(100_000), Value::Null, -32700);
    check("[]", Value::Null, -32600);
    check(
        r#"[{"jsonrpc":"2.0","id":1,"method":"shutdown"}]"#,
        Value::Null,
        -32600,
    );
    check("42", Value::Null, -32600);
    check(r#"{"jsonrpc":"2.0"}"#, Value::Null, -32600);
    check(r#"{"jsonrpc":"2.0","id":4711}"#, Value::Null, -32600);
    check(
        r#"{"jsonrpc":"1.0","id":4711,"method":"wedm/inspect"}"#,
        json!(4711),
        -32600,
    );
    check(
        r#"{"jsonrpc":"2.0","id":{},"method":"wedm/inspect"}"#,
        Value::Null,
        -32600,
    );
    check(
        r#"{"jsonrpc":"2.0","id":4711,"method":7}"#,
        json!(4711),
        -32600,
    );
    check(
        r#"{"jsonrpc":"2.0","id":4711,"method":"wedm/inspect"}"#,
        json!(4711),
        -32602,
    );
    check(
        r#"{"jsonrpc":"2.0","id":4711,"method":"wedm/inspect","params":"x"}"#,
        json!(4711),
        -32602,
    );
    check(
        r#"{"jsonrpc":"2.0","id":4711,"method":"wedm/didOpenDrawing","params":{}}"#,
        json!(4711),
        -32600,
    );
}

#[test]
fn ids_of_every_kind_are_given_back() {
    let mut client = Client::start();
    client.open_drawing("cad:///1", json!([tight_plate("2A")]));
    for id in [
        json!("a string"),
        json!(-5),
        json!(9_007_199_254_740_993_i64),
        json!(0),
    ] {
        client.send(&json!({ "jsonrpc": "2.0", "id": id, "method": "wedm/inspect", "params": { "uri": "cad:///1" } }));
        let answer = client.wait_for("an answer", |message| message["id"] == id);
        assert!(answer["result"].is_object(), "{answer}");
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
    client.notify(
        "textDocument/didChange",
        json!({ "textDocument": { "uri": "file:///a.dxf" } }),
    );
    client.logged("textDocument/didChange was ignored");
    client.notify("wedm/didOpenDrawing", json!({ "drawing": [] }));
    client.logged("wedm/didOpenDrawing was ignored");
    client.notify("wedm/didCloseDrawing", json!({}));
    client.logged("wedm/didCloseDrawing was ignored");
    client.shut_down();
}

#[test]
fn a_header_at_fault_is_said_once_and_the_message_behind_it_is_answered() {
    for bad in [
        "Content-Length: 5\r\nx\r\n",
        "Content-Length: 2\r\n{}",
        "Content-Length: 2\r\nContent Type: x\r\n\r\n{}",
        "Content Type: x\r\n",
        "the server is ready",
        "log: ready",
        "Content-Length: 1",
    ] {
        let mut client = Client::start();
        client.send_bytes(bad.as_bytes());
        assert_eq!(
            client.code("wedm/inspect", json!({ "uri": "none:" })),
            -32602,
            "{bad:?}"
        );
        let is_error =
            |message: &&Value| message["id"].is_null() && message["error"]["code"] == -32700;
        assert_eq!(
            client.settle().iter().filter(is_error).count(),
            1,
            "{bad:?}"
        );
        client.shut_down();
    }
}

#[test]
fn requests_that_may_be_ignored_are_answered_all_the_same() {
    let mut client = Client::start();
    for method in ["$/nothing", "$/setTrace", "$/cancelRequest", "$/"] {
        assert_eq!(
            client.code(method, json!({ "id": 7, "value": "off" })),
            -32601,
            "{method}"
        );
        client.notify(method, json!({ "id": 7, "value": "off" }));
    }
    assert_eq!(client.settle(), [] as [Value; 0]);
    client.shut_down();
}

/// A short body that would be a tree of gigabytes is refused; a drawing as long is read.
#[test]
fn a_body_whose_values_would_fill_the_memory_is_refused() {
    let mut client = Client::start();
    client.send_bytes(&frame(&format!("[{}[]]", "[],".repeat(6_000_000))));
    let answer = client.wait_for("a refusal", |message| message.get("error").is_some());
    assert_eq!(
        (&answer["id"], &answer["error"]["code"]),
        (&Value::Null, &json!(-32600)),
        "{answer}"
    );
    #[cfg(target_os = "linux")]
    {
        let status =
            std::fs::read_to_string(format!("/proc/{}/status", client.child.id())).unwrap();
        let peak = status
            .lines()
            .find(|line| line.starts_with("VmHWM:"))
            .unwrap();
        assert!(
            peak.split_whitespace()
                .nth(1)
                .unwrap()
                .parse::<u64>()
                .unwrap()
                < 100 * 1024,
            "{peak}"
        );
    }
    client.shut_down();
}

#[cfg(not(feature = "testing"))]
#[test]
fn the_shipped_server_has_no_hidden_methods() {
    let mut client = Client::start();
    for method in ["wedm/test/panic", "wedm/test/ask"] {
        assert_eq!(
            client.code(method, json!({ "site": "handler" })),
            -32601,
            "{method}"
        );
    }
    client.shut_down();
}
