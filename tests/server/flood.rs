//! More than a client should send, and less than it should read.

use crate::support::{Client, TIGHT, capabilities, dxf_of, frame, small, tight_plate};
use serde_json::{Value, json};

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
    let list = client.request("wedm/inspect", json!({ "uri": "cad:///1" })).unwrap();
    assert_eq!(list["entities"][0]["segments"][0]["start"][0], -((COUNT - 1) as f64) / 1e6);
    assert_eq!(small(&client.diagnostics("cad:///1", COUNT + 1)), 1);
    // The comment is empty again: the bulge stands where it stood.
    let action = json!({ "textDocument": { "uri": URI }, "range": { "start": { "line": 0, "character": 0 }, "end": { "line": 1000, "character": 0 } },
        "context": { "diagnostics": [], "only": ["quickfix"] } });
    let actions = client.request("textDocument/codeAction", action).unwrap();
    let line = text.lines().position(|line| line == "0.41421356237309503").unwrap();
    assert_eq!(actions[0]["diagnostics"][0]["range"]["start"], json!({ "line": line, "character": 0 }));
    assert!(
        client.seen.iter().all(|message| message["method"] != "window/logMessage"),
        "{:?}",
        client.seen.iter().find(|message| message["method"] == "window/logMessage")
    );
    for id in requests {
        assert!(client.answer(id).is_ok());
    }
    client.shut_down();
}

#[cfg(target_os = "linux")]
fn resident_mib(client: &Client) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{}/status", client.child.id())).unwrap();
    let line = status.lines().find(|line| line.starts_with("VmRSS:")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse::<u64>().unwrap() / 1024
}

/// A drawing whose findings fill a publish.
#[cfg(target_os = "linux")]
fn many_faults() -> Value {
    let plate = |index: i32| {
        let mut plate = tight_plate(&format!("H{index}"));
        plate["vertices"]
            .as_array_mut()
            .unwrap()
            .iter_mut()
            .for_each(|vertex| vertex[0] = json!(vertex[0].as_f64().unwrap() + 20.0 * f64::from(index)));
        plate
    };
    json!((0..600).map(plate).collect::<Vec<_>>())
}

/// Sends in the background until the server takes no more, or `count` messages are through.
#[cfg(target_os = "linux")]
fn flood_unread(message: fn(i64) -> Value, count: i64) -> u64 {
    use std::sync::atomic::{AtomicI64, Ordering};
    let mut client = Client::silent();
    client.send(&json!({ "jsonrpc": "2.0", "id": 1, "method": "initialize", "params": { "capabilities": capabilities() } }));
    client.notify("initialized", json!({}));
    client.notify("wedm/didOpenDrawing", json!({ "drawing": { "uri": "cad:///1", "version": 1, "entities": many_faults() } }));
    let sent = AtomicI64::new(0);
    let mut peak = 0;
    let mut pipe = client.take_stdin();
    std::thread::scope(|scope| {
        let sent = &sent;
        scope.spawn(move || {
            for number in 0..count {
                let body = frame(&message(number).to_string());
                if std::io::Write::write_all(&mut pipe, &body).is_err() {
                    return;
                }
                sent.store(number + 1, Ordering::Relaxed);
            }
        });
        let (mut last, mut still) = (-1, 0);
        // Done when all is through, or the server has held back for a while.
        while still < 20 && last < count {
            std::thread::sleep(std::time::Duration::from_millis(100));
            peak = peak.max(resident_mib(&client));
            let now = sent.load(Ordering::Relaxed);
            still = if now == last { still + 1 } else { 0 };
            last = now;
        }
        let _ = client.child.kill();
    });
    peak
}

#[cfg(target_os = "linux")]
#[test]
fn a_client_that_stops_reading_does_not_make_memory_grow() {
    // Each publish is some 400 KB, each list some 900 KB: unbounded, both would be gigabytes.
    let splice = |number: i64| {
        json!({ "jsonrpc": "2.0", "method": "wedm/didChangeDrawing", "params": { "drawing": { "uri": "cad:///1", "version": number + 2 },
            "changes": [{ "handle": "H0", "vertices": { "start": 0, "deleteCount": 1, "insert": [[-(number as f64) / 1e6, 0]] } }] } })
    };
    let peak = flood_unread(splice, 5_000);
    assert!(peak < 300, "{peak} MiB with unread diagnostics");
    let list = |number: i64| json!({ "jsonrpc": "2.0", "id": number + 2, "method": "wedm/inspect", "params": { "uri": "cad:///1" } });
    let peak = flood_unread(list, 5_000);
    assert!(peak < 400, "{peak} MiB with unread lists");
}
