//! How the process ends.

use crate::support::{Client, capabilities, tight_plate};
use serde_json::{Value, json};
use std::time::Duration;

/// The protocol grants a second; a busy machine gets some more.
const SOON: Duration = Duration::from_secs(4);

#[test]
fn the_exit_code_tells_whether_shutdown_came_before() {
    let check = |what: &str, end: fn(&mut Client), expected: i32| {
        let mut client = Client::start();
        client.open_drawing("cad:///1", json!([tight_plate("2A")]));
        end(&mut client);
        let (code, time) = client.end();
        assert_eq!(code, Some(expected), "{what}");
        assert!(time < SOON, "{what} took {time:?}");
    };
    check("exit", |client| client.notify("exit", Value::Null), 1);
    check("end of stdin", Client::close_stdin, 1);
    check(
        "shutdown, exit",
        |client| {
            client.request("shutdown", Value::Null).unwrap();
            client.notify("exit", Value::Null);
        },
        0,
    );
    check(
        "shutdown with empty params, exit",
        |client| {
            client.request("shutdown", json!({})).unwrap();
            client.notify("exit", json!({}));
        },
        0,
    );
    check(
        "shutdown with a list of none, exit",
        |client| {
            client.request("shutdown", json!([])).unwrap();
            client.notify("exit", json!([]));
        },
        0,
    );
    check(
        "shutdown, end of stdin",
        |client| {
            client.request("shutdown", Value::Null).unwrap();
            client.close_stdin();
        },
        0,
    );
    check(
        "end of stdin within a frame",
        |client| {
            client.send_bytes(b"Content-Length: 100\r\n\r\n{");
            client.close_stdin();
        },
        1,
    );
}

#[test]
fn a_server_that_was_never_spoken_to_ends_as_well() {
    let mut client = Client::raw();
    client.close_stdin();
    assert_eq!(client.end().0, Some(1));
    let mut client = Client::raw();
    client.notify("exit", Value::Null);
    assert_eq!(client.end().0, Some(1));
}

#[test]
fn requests_before_the_end_of_stdin_are_answered() {
    let mut client = Client::start();
    client.open_drawing("cad:///1", json!([tight_plate("2A")]));
    let ids: Vec<i64> = (0..50)
        .map(|_| client.ask("wedm/inspect", json!({ "uri": "cad:///1" })))
        .collect();
    client.close_stdin();
    for id in ids {
        assert!(client.answer(id).is_ok());
    }
    assert_eq!(client.end().0, Some(1));
}

#[test]
fn a_client_that_has_gone_without_reading_ends_the_server() {
    let mut client = Client::silent();
    client.send(&json!({ "jsonrpc": "2.0", "id": 1, "method": "initialize", "params": { "capabilities": {} } }));
    client.send(&json!({ "jsonrpc": "2.0", "method": "initialized", "params": {} }));
    client.close_stdin();
    assert_eq!(client.end().0, Some(1));
}

#[cfg(unix)]
#[test]
fn the_death_of_the_clients_process_ends_the_server() {
    let mut editor = std::process::Command::new("sleep")
        .arg("60")
        .spawn()
        .unwrap();
    let mut client = Client::raw();
    client.shake_hands(json!({ "processId": editor.id(), "capabilities": capabilities() }));
    assert!(
        client
            .request("wedm/inspect", json!({ "uri": "cad:///1" }))
            .is_err()
    );
    editor.kill().unwrap();
    // Nobody has asked for its exit code yet: a zombie is dead as well.
    let (code, time) = client.end();
    editor.wait().unwrap();
    assert_eq!(code, Some(1));
    assert!(time < Duration::from_secs(10), "{time:?}");
}
