//! The server behind the WebSocket, and how long the process stays for it.

use super::*;
use crate::support::{Client, capabilities};
use std::time::{Duration, Instant};

fn hello(path: &Path) -> Value {
    json!({
        "processId": null,
        "capabilities": capabilities(),
        "workspaceFolders": [{ "uri": uri_of(path), "name": "all" }],
        "initializationOptions": { "side": "opening" },
    })
}

#[test]
fn a_page_gets_what_a_client_at_the_pipes_gets() {
    let (_folder, path) = folder();
    std::fs::write(path.join("wedm.toml"), "correction = 0.12\n").unwrap();
    let (uri, text) = (uri_of(&path.join("tight.dxf")), drawing());
    let view = View::of(&path);
    let (mut page, mut client) = (view.session(), Client::raw());
    assert_eq!(page.start(hello(&path)), client.shake_hands(hello(&path)));
    page.open(&uri, "dxf", &text);
    let of_client = client.open_text(&uri, "dxf", &text);
    let of_page = page.diagnostics(&uri);
    assert_eq!(of_page["diagnostics"], json!(of_client));
    assert_eq!(of_client.len(), 1);
    let change = json!({ "textDocument": { "uri": uri, "version": 2 },
        "contentChanges": [{ "text": text.replace("9.95", "9.5") }] });
    page.notify("textDocument/didChange", change.clone());
    client.notify("textDocument/didChange", change);
    assert_eq!(page.diagnostics(&uri)["diagnostics"], json!([]));
    assert_eq!(client.diagnostics(&uri, 2).len(), 0);
    for format in ["3b", "4b", "iso"] {
        let asked = json!({ "uri": uri, "format": format });
        let program = page.request("wedm/generate", asked.clone());
        let expected = client.request("wedm/generate", asked).unwrap();
        assert_eq!(program["result"], expected, "{format}");
        assert!(expected["program"].as_str().unwrap().len() > 20);
    }
    let refused = page.request("wedm/inspect", json!({ "uri": "none:" }));
    let expected = client.request("wedm/inspect", json!({ "uri": "none:" }));
    assert_eq!(refused["error"], expected.unwrap_err());
}

#[test]
fn broken_messages_cost_themselves_alone() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let mut page = view.session();
    for text in ["{", "", "[]", "Content-Length: 2\r\n\r\n{}", "\u{0}"] {
        page.socket.send(Message::text(text)).unwrap();
        let answer = page.wait_for(text, |message| message.get("error").is_some());
        assert_eq!(answer["id"], Value::Null, "{text}");
    }
    assert_eq!(page.start(hello(&path))["serverInfo"]["name"], "wedm");
    page.socket.send(Message::binary(vec![1, 2, 3])).unwrap();
    assert_eq!(closed(&mut page), Some(1003));
}

/// The code with which the server closes.
fn closed(page: &mut Session) -> Option<u16> {
    loop {
        match page.socket.read() {
            Ok(Message::Close(frame)) => return frame.map(|frame| frame.code.into()),
            Ok(_) => {}
            Err(_) => return None,
        }
    }
}

#[test]
fn exit_ends_the_session_and_not_the_process() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let (mut page, mut other) = (view.session(), view.session());
    page.start(hello(&path));
    other.start(hello(&path));
    assert_eq!(page.request("shutdown", Value::Null)["result"], Value::Null);
    page.notify("exit", Value::Null);
    assert_eq!(closed(&mut page), Some(1000));
    let uri = uri_of(&path.join("tight.dxf"));
    other.open(&uri, "dxf", &drawing());
    assert_eq!(
        other.diagnostics(&uri)["diagnostics"]
            .as_array()
            .unwrap()
            .len(),
        1
    );
    assert_eq!(
        view.session().start(hello(&path))["serverInfo"]["name"],
        "wedm"
    );
}

#[test]
fn each_page_has_documents_of_its_own() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let (mut one, mut other) = (view.session(), view.session());
    one.start(hello(&path));
    other.start(hello(&path));
    one.open("untitled:a.dxf", "dxf", &drawing());
    assert_eq!(one.diagnostics("untitled:a.dxf")["version"], 1);
    let inspected = json!({ "uri": "untitled:a.dxf" });
    assert!(
        one.request("wedm/inspect", inspected.clone())
            .get("result")
            .is_some()
    );
    assert_eq!(
        other.request("wedm/inspect", inspected)["error"]["code"],
        -32602
    );
}

#[test]
fn a_session_opens_and_reads_nothing_outside() {
    let (_folder, path) = folder();
    let (_beside, beside) = folder_with_program();
    std::fs::write(
        path.join("wedm.toml"),
        format!("[program]\ndrawing = \"{}/plate.dxf\"\n", beside.display()),
    )
    .unwrap();
    let view = View::of(&path);
    let mut page = view.session();
    // A root outside is no root.
    page.start(hello(&beside));
    for outside in [
        uri_of(&beside.join("plate.dxf")),
        format!(
            "{}/../{}/plate.dxf",
            uri_of(&path),
            beside.file_name().unwrap().display()
        ),
        "file:///plate.dxf".to_owned(),
        "FILE:///plate.dxf".to_owned(),
        "file://127.0.0.1/share/plate.dxf".to_owned(),
    ] {
        page.open(&outside, "dxf", &drawing());
        let shown = page.wait_for(&outside, |message| {
            message["method"] == "window/showMessage"
        });
        let said = shown["params"]["message"].as_str().unwrap();
        assert!(
            said.contains("outside of the folders that are shown"),
            "{said}"
        );
        let asked = page.request("wedm/inspect", json!({ "uri": outside }));
        assert_eq!(asked["error"]["code"], -32602, "{outside}");
        page.notify(
            "wedm/didOpenDrawing",
            json!({ "drawing": { "uri": outside, "version": 1, "entities": [] } }),
        );
        page.wait_for(&outside, |message| {
            message["method"] == "window/showMessage"
        });
    }
    // Settings of another folder hold for nothing here.
    std::fs::write(beside.join("wedm.toml"), "correction = 0.77\n").unwrap();
    for uri in [uri_of(&beside.join("a.dxf")), "untitled:a.dxf".to_owned()] {
        let settings = page.request("wedm/settings", json!({ "uri": uri }));
        assert_ne!(settings["result"]["correction"], 0.77, "{uri}");
    }
    // The drawing that the settings name lies outside, and is not read.
    let program = uri_of(&path.join("plate.3b"));
    page.open(&program, "3b", PROGRAM);
    let is_it = |message: &Value| {
        message["params"]["uri"] == *program
            && message["params"]["diagnostics"]
                .to_string()
                .contains("outside of the folders")
    };
    page.wait_for("the drawing is not read", is_it);
}

const PROGRAM: &str = "B5000B5000B5000GYL3\nB19800B0B19800GXL1\nB0B9800B9800GYL2\nB19800B0B19800GXL3\nB0B9800B9800GYL4\nB5000B5000B5000GYL1\nDD\n";

fn folder_with_program() -> (tempfile::TempDir, PathBuf) {
    let (folder, path) = folder();
    std::fs::write(path.join("plate.dxf"), drawing()).unwrap();
    (folder, path)
}

#[test]
fn settings_above_the_folder_hold() {
    let (_folder, path) = folder();
    let below = path.join("below");
    std::fs::create_dir(&below).unwrap();
    std::fs::write(path.join("wedm.toml"), "correction = 0.33\n").unwrap();
    let view = View::of(&below);
    assert_eq!(view.get("/api/start").json()["hasSettings"], true);
    let mut page = view.session();
    page.start(hello(&below));
    for uri in [uri_of(&below.join("a.dxf")), "untitled:a.dxf".to_owned()] {
        let settings = page.request("wedm/settings", json!({ "uri": uri }));
        assert_eq!(settings["result"]["correction"], 0.33, "{uri}");
    }
}

#[test]
fn the_process_ends_when_the_last_page_has_gone() {
    let (_folder, path) = folder();
    let mut view = View::with(&path, &[], &[("WEDM_VIEW_LINGER_MS", "300")]);
    // Nobody has been there yet: what is asked in passing counts for nothing.
    for _ in 0..10 {
        view.get("/api/files");
        std::thread::sleep(Duration::from_millis(50));
    }
    assert!(view.child.try_wait().unwrap().is_none());
    let (mut page, changes) = (view.session(), view.changes());
    page.start(hello(&path));
    drop(page);
    std::thread::sleep(Duration::from_millis(900));
    assert!(
        view.child.try_wait().unwrap().is_none(),
        "a stream of changes is left"
    );
    drop(changes);
    let began = Instant::now();
    let status = loop {
        if let Some(status) = view.child.try_wait().unwrap() {
            break status;
        }
        assert!(began.elapsed() < PATIENCE);
        std::thread::sleep(Duration::from_millis(10));
    };
    assert_eq!(status.code(), Some(0));
}

/// A shell lets what it starts in the background ignore Ctrl-C, and all that those start.
#[cfg(unix)]
fn is_ignored(signal: u32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    ignored.unwrap_or_default() & (1 << (signal - 1)) != 0
}

#[cfg(unix)]
#[test]
fn signals_end_the_process() {
    let signals = [("INT", 2), ("TERM", 15)].into_iter();
    for (signal, _) in signals.filter(|(_, number)| !is_ignored(*number)) {
        let (_folder, path) = folder();
        let mut view = View::of(&path);
        let page = view.session();
        let id = view.child.id().to_string();
        let sent = Command::new("kill").args(["-s", signal, &id]).status();
        assert!(sent.unwrap().success());
        assert!(!view.child.wait().unwrap().success());
        drop(page);
    }
}
