//! A program and its drawing: an edit of either says again what is unlike in both.

use crate::support::{Client, capabilities};
use serde_json::{Value, json};
use std::path::Path;

fn uri_of(path: &Path) -> String {
    format!("file://{}", path.display())
}

/// A plate of 20 × 10 mm, so much longer, as DXF.
fn plate(longer: f64) -> String {
    let x = 20.0 + longer;
    format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n5\n2A\n8\n0\n90\n4\n70\n1\n\
         10\n0\n20\n0\n10\n{x}\n20\n0\n10\n{x}\n20\n10\n10\n0\n20\n10\n0\nENDSEC\n0\nEOF\n"
    )
}

/// The way inside the plate at a correction of 0.1 mm, from its lower left corner on.
const PROGRAM: &str = "B5000B5000B5000GYL3\nB19800B0B19800GXL1\nB0B9800B9800GYL2\nB19800B0B19800GXL3\nB0B9800B9800GYL4\nB5000B5000B5000GYL1\nDD\n";

/// Lines, from 0, and sentences of what is unlike, once a publish says as many as are expected.
fn unlike(client: &mut Client, uri: &str, count: usize) -> Vec<(u64, String)> {
    let told = |message: &Value| -> Vec<(u64, String)> {
        let own = message["params"]["diagnostics"]
            .as_array()
            .into_iter()
            .flatten();
        let own = own.filter(|one| one["code"] == "not-the-drawing");
        own.map(|one| {
            let line = one["range"]["start"]["line"].as_u64().unwrap();
            (line, one["message"].as_str().unwrap().to_owned())
        })
        .collect()
    };
    let message = client.wait_for(&format!("{count} of {uri}"), |message| {
        message["method"] == "textDocument/publishDiagnostics"
            && message["params"]["uri"] == uri
            && told(message).len() == count
    });
    told(&message)
}

fn start(folder: &Path) -> Client {
    std::fs::write(folder.join("wedm.toml"), "side = \"opening\"\n").unwrap();
    Client::start_with(capabilities(), json!({}))
}

fn open(client: &mut Client, uri: &str, language: &str, text: &str) {
    client.notify(
        "textDocument/didOpen",
        json!({ "textDocument": { "uri": uri, "languageId": language, "version": 1, "text": text } }),
    );
}

fn change(client: &mut Client, uri: &str, version: i64, text: &str) {
    client.notify(
        "textDocument/didChange",
        json!({ "textDocument": { "uri": uri, "version": version }, "contentChanges": [{ "text": text }] }),
    );
}

#[test]
fn an_edit_of_either_is_said_at_both() {
    let folder = tempfile::tempdir().unwrap();
    let mut client = start(folder.path());
    let (drawing, program) = (
        uri_of(&folder.path().join("plate.dxf")),
        uri_of(&folder.path().join("plate.3b")),
    );
    open(&mut client, &drawing, "dxf", &plate(0.05));
    open(&mut client, &program, "3b", PROGRAM);
    // Both long sides; what lies between them is moved, and follows.
    let said = unlike(&mut client, &program, 2);
    assert_eq!([said[0].0, said[1].0], [1, 3]);
    assert_eq!(
        said[0].1,
        "block does not follow segment 0 of 2A in plate.dxf: it ends 0.050 mm from where the drawing has it"
    );
    let said = unlike(&mut client, &drawing, 2);
    assert!(
        said[0].1.contains("plate.3b") && said[0].1.contains("line 2"),
        "{said:?}"
    );
    // The drawing is as it was.
    change(&mut client, &drawing, 2, &plate(0.0));
    unlike(&mut client, &program, 0);
    unlike(&mut client, &drawing, 0);
    // The program is another.
    change(
        &mut client,
        &program,
        2,
        &PROGRAM.replace("B0B9800B9800GYL2", "B0B9830B9830GYL2"),
    );
    assert_eq!(unlike(&mut client, &program, 1)[0].0, 2);
    assert_eq!(unlike(&mut client, &drawing, 1).len(), 1);
    // It names another drawing.
    let named = format!("; drawing: other.dxf\n{PROGRAM}");
    std::fs::write(folder.path().join("other.dxf"), plate(0.5)).unwrap();
    change(&mut client, &program, 3, &named);
    let said = unlike(&mut client, &program, 2);
    assert!(said[0].1.contains("0.500 mm"), "{said:?}");
    unlike(&mut client, &drawing, 0);
    client.shut_down();
}

#[test]
fn what_is_not_open_is_read_from_disk_and_read_anew() {
    let folder = tempfile::tempdir().unwrap();
    let mut client = start(folder.path());
    let (drawing, program) = (
        folder.path().join("plate.dxf"),
        folder.path().join("plate.3b"),
    );
    std::fs::write(&drawing, plate(0.05)).unwrap();
    std::fs::write(&program, PROGRAM).unwrap();
    let changed = |client: &mut Client, path: &Path| {
        let changes = json!([{ "uri": uri_of(path), "type": 2 }]);
        client.notify(
            "workspace/didChangeWatchedFiles",
            json!({ "changes": changes }),
        );
    };
    open(&mut client, &uri_of(&program), "3b", PROGRAM);
    unlike(&mut client, &uri_of(&program), 2);
    std::fs::write(&drawing, plate(0.0)).unwrap();
    changed(&mut client, &drawing);
    unlike(&mut client, &uri_of(&program), 0);
    client.notify(
        "textDocument/didClose",
        json!({ "textDocument": { "uri": uri_of(&program) } }),
    );
    open(&mut client, &uri_of(&drawing), "dxf", &plate(0.05));
    unlike(&mut client, &uri_of(&drawing), 2);
    // Nothing of the text is open on disk any more.
    std::fs::write(&program, "").unwrap();
    changed(&mut client, &program);
    unlike(&mut client, &uri_of(&drawing), 0);
    client.shut_down();
}

#[test]
fn a_program_that_comes_to_a_drawing_is_found_at_its_next_edit() {
    let folder = tempfile::tempdir().unwrap();
    let mut client = start(folder.path());
    // So long unchanged that it is not read again while it stays so.
    let long_ago = std::time::SystemTime::now() - std::time::Duration::from_secs(3600);
    let opened = std::fs::File::open(folder.path()).unwrap();
    opened.set_modified(long_ago).unwrap();
    let drawing = uri_of(&folder.path().join("plate.dxf"));
    open(&mut client, &drawing, "dxf", &plate(0.05));
    for (version, longer) in [(2, 0.06), (3, 0.05)] {
        change(&mut client, &drawing, version, &plate(longer));
    }
    unlike(&mut client, &drawing, 0);
    std::fs::write(folder.path().join("plate.3b"), PROGRAM).unwrap();
    change(&mut client, &drawing, 4, &plate(0.05));
    unlike(&mut client, &drawing, 2);
    client.shut_down();
}

#[test]
fn nothing_alike_is_one_information() {
    let folder = tempfile::tempdir().unwrap();
    let mut client = start(folder.path());
    let (drawing, program) = (
        uri_of(&folder.path().join("plate.dxf")),
        uri_of(&folder.path().join("plate.3b")),
    );
    let other = "B0B7000B7000GYL2\nB3000B4000B4000GYL1\nB3000B4000B4000GYL4\nB6000B3000B6000GXL3\nB0B4000B4000GYL4\nDD\n";
    open(&mut client, &program, "3b", other);
    open(&mut client, &drawing, "dxf", &plate(0.0));
    assert!(
        unlike(&mut client, &program, 1)[0]
            .1
            .starts_with("nothing in it matches plate.dxf")
    );
    unlike(&mut client, &drawing, 1);
    client.shut_down();
}

#[test]
fn a_drawing_that_the_settings_name_at_last_is_compared_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let mut client = start(folder.path());
    std::fs::write(path("other.dxf"), plate(0.05)).unwrap();
    let program = uri_of(&path("plate.3b"));
    open(&mut client, &program, "3b", PROGRAM);
    unlike(&mut client, &program, 0);
    let settings = uri_of(&path("wedm.toml"));
    open(&mut client, &settings, "toml", "side = \"opening\"\n");
    let named = "side = \"opening\"\n[program]\ndrawing = \"other.dxf\"\n";
    change(&mut client, &settings, 2, named);
    unlike(&mut client, &program, 2);
    client.shut_down();
}

/// What has been found before is no matter: a program that is closed is the one on disk.
#[test]
fn a_program_that_is_closed_unsaved_belongs_to_its_drawing_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let mut client = start(folder.path());
    std::fs::write(path("other.dxf"), plate(0.5)).unwrap();
    std::fs::write(path("plate.3b"), PROGRAM).unwrap();
    let (drawing, program) = (uri_of(&path("plate.dxf")), uri_of(&path("plate.3b")));
    open(&mut client, &drawing, "dxf", &plate(0.05));
    unlike(&mut client, &drawing, 2);
    open(&mut client, &program, "3b", PROGRAM);
    unlike(&mut client, &program, 2);
    change(&mut client, &program, 2, &format!("; other.dxf\n{PROGRAM}"));
    unlike(&mut client, &drawing, 0);
    client.notify(
        "textDocument/didClose",
        json!({ "textDocument": { "uri": program } }),
    );
    unlike(&mut client, &drawing, 2);
    client.shut_down();
}

#[test]
fn a_drawing_that_the_settings_no_longer_name_is_compared_no_longer() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let mut client = start(folder.path());
    std::fs::write(path("other.dxf"), plate(0.0)).unwrap();
    std::fs::write(path("plate.3b"), PROGRAM).unwrap();
    let drawing = uri_of(&path("plate.dxf"));
    open(&mut client, &drawing, "dxf", &plate(0.05));
    unlike(&mut client, &drawing, 2);
    let settings = uri_of(&path("wedm.toml"));
    let named = "side = \"opening\"\n[program]\ndrawing = \"other.dxf\"\n";
    open(&mut client, &settings, "toml", named);
    unlike(&mut client, &drawing, 0);
    // Its text counts while it is open; on disk there is none such.
    client.notify(
        "textDocument/didClose",
        json!({ "textDocument": { "uri": settings } }),
    );
    unlike(&mut client, &drawing, 2);
    client.shut_down();
}

#[cfg(unix)]
#[test]
fn a_pipe_beside_a_drawing_holds_up_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let mut client = start(folder.path());
    let made = std::process::Command::new("mkfifo")
        .args([path("a.3b"), path("b.dxf")])
        .status();
    assert!(made.unwrap().success());
    std::fs::write(path("plate.3b"), PROGRAM).unwrap();
    let drawing = uri_of(&path("plate.dxf"));
    open(&mut client, &drawing, "dxf", &plate(0.05));
    unlike(&mut client, &drawing, 2);
    let program = uri_of(&path("c.3b"));
    open(&mut client, &program, "3b", &format!("; b.dxf\n{PROGRAM}"));
    unlike(&mut client, &program, 0);
    client.shut_down();
}
