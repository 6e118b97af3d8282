//! More than a client should send, and less than it should read.

use crate::support::{Client, PATIENCE, capabilities, frame, tight_plate};
use serde_json::{Value, json};

#[cfg(target_os = "linux")]
fn resident_mib(client: &Client) -> u64 {
    memory_mib(client, "VmRSS:")
}

/// A row of the process's status, such as `RssAnon:`, which leaves the program itself out.
#[cfg(target_os = "linux")]
fn memory_mib(client: &Client, row: &str) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{}/status", client.child.id())).unwrap();
    let line = status.lines().find(|line| line.starts_with(row)).unwrap();
    line.split_whitespace()
        .nth(1)
        .unwrap()
        .parse::<u64>()
        .unwrap()
        / 1024
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
            .for_each(|vertex| {
                vertex[0] = json!(vertex[0].as_f64().unwrap() + 20.0 * f64::from(index))
            });
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
    client.notify(
        "wedm/didOpenDrawing",
        json!({ "drawing": { "uri": "cad:///1", "version": 1, "entities": many_faults() } }),
    );
    let sent = AtomicI64::new(0);
    let mut peak = 0;
    let mut pipe = client.take_stdin();
    std::thread::scope(|scope| {
        let sent = &sent;
        // The pipe stays open until the server is stopped: one that closes ends it, and what has ended uses no memory.
        let _open = scope.spawn(move || {
            for number in 0..count {
                let body = frame(&message(number).to_string());
                if std::io::Write::write_all(&mut pipe, &body).is_err() {
                    break;
                }
                sent.store(number + 1, Ordering::Relaxed);
            }
            pipe
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

/// However long the reading took: on a busy machine it ends after what is given back for its message.
#[cfg(target_os = "linux")]
#[test]
fn what_reading_a_document_leaves_behind_is_given_back() {
    let squares = (0..60_000).map(|square| {
        let x = square * 10;
        format!(
            "G00 X{x}. Y0.\nM00\nG01 X{}. Y0.5\nX{}.5 Y5.\nX{x}. Y0.\nM00\n",
            x + 5,
            x + 4
        )
    });
    let text = format!("%\nG90\nG92 X0. Y0.\n{}M02\n", squares.collect::<String>());
    let mut client = Client::start();
    client.open_text("file:///squares.iso", "wire-iso", &text);
    // 4 MB of text, of which the reading takes some 55 MiB.
    let began = std::time::Instant::now();
    while memory_mib(&client, "RssAnon:") > 35 {
        assert!(
            began.elapsed() < PATIENCE,
            "{} MiB",
            memory_mib(&client, "RssAnon:")
        );
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
}
