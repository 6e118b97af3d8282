//! Settings: their levels, their changes at run time, and their faults.

use crate::size::by_day;
use crate::support::{Client, TIGHT, capabilities, dxf_of, tight_plate};
use serde_json::{Value, json};
use std::path::Path;

const URI: &str = "cad:///1";

fn uri_of(path: &Path) -> String {
    format!("file://{}", path.display())
}

fn with(key: &str, value: Value) -> Value {
    let mut all = capabilities();
    all["workspace"][key] = value;
    all
}

/// The correction that the fault of [`tight_plate`] is compared with.
fn required(client: &mut Client, uri: &str, version: i64) -> Value {
    let found = client.diagnostics(uri, version);
    found
        .first()
        .map_or(Value::Null, |found| found["data"]["required"].clone())
}

fn open(client: &mut Client, uri: &str) {
    client.notify(
        "wedm/didOpenDrawing",
        json!({ "drawing": { "uri": uri, "version": 1, "entities": [tight_plate("2A")] } }),
    );
}

#[test]
fn initialization_options_hold_bare_or_as_a_section() {
    for options in [
        json!({ "correction": 0.07 }),
        json!({ "wedm": { "correction": 0.07 } }),
        json!({ "wireDiameter": 0.12, "gap": 0.01 }),
    ] {
        let mut client = Client::start_with(capabilities(), options);
        open(&mut client, URI);
        let correction = required(&mut client, URI, 1).as_f64().unwrap();
        assert!((correction - 0.07).abs() < 1e-12, "{correction}");
        client.shut_down();
    }
}

#[test]
fn settings_that_are_pushed_change_the_diagnostics() {
    let mut client = Client::start();
    open(&mut client, URI);
    assert_eq!(required(&mut client, URI, 1), 0.1);
    let mut check = |settings: Value, expected: Value| {
        client.notify(
            "workspace/didChangeConfiguration",
            json!({ "settings": settings }),
        );
        assert_eq!(required(&mut client, URI, 1), expected, "{settings}");
    };
    check(json!({ "wedm": { "correction": 0.2 } }), json!(0.2));
    check(json!({ "correction": 0.3 }), json!(0.3));
    check(json!({ "wedm": { "correction": 0.04 } }), Value::Null);
    check(
        json!({ "wedm": { "rules": { "small-radius": "hint" } } }),
        json!(0.1),
    );
    check(
        json!({ "wedm": { "rules": { "small-radius": "off" } } }),
        Value::Null,
    );
    check(json!({ "wedm": {} }), json!(0.1));
    client.shut_down();
}

#[test]
fn settings_are_asked_for_at_the_start_and_after_each_change() {
    let mut client = Client::start_with(
        with("configuration", json!(true)),
        json!({ "correction": 0.2 }),
    );
    let asked = client.asked("workspace/configuration");
    assert_eq!(asked.params, json!({ "items": [{ "section": "wedm" }] }));
    open(&mut client, URI);
    assert_eq!(required(&mut client, URI, 1), 0.2);
    client.respond(&asked, json!([{ "correction": 0.3, "wireDiameter": null }]));
    assert_eq!(required(&mut client, URI, 1), 0.3);
    client.notify(
        "workspace/didChangeConfiguration",
        json!({ "settings": null }),
    );
    let asked = client.asked("workspace/configuration");
    client.respond(&asked, json!([null]));
    assert_eq!(required(&mut client, URI, 1), 0.2);
    client.shut_down();
}

#[test]
fn misfits_are_shown_by_name_and_the_other_keys_hold() {
    let mut client = Client::start_with(
        capabilities(),
        json!({ "correction": 0.2, "side": "inside", "wiredia": 1 }),
    );
    let first = client.told("window/showMessage")["message"].clone();
    let second = client.told("window/showMessage")["message"].clone();
    assert!(
        first
            .as_str()
            .unwrap()
            .contains("initializationOptions: side is \"inside\""),
        "{first}"
    );
    assert!(
        second.as_str().unwrap().contains("wiredia is not known"),
        "{second}"
    );
    open(&mut client, URI);
    assert_eq!(required(&mut client, URI, 1), 0.2);
    client.shut_down();
}

/// A profile may be named at another level of settings than the one where it stands.
#[test]
fn a_request_names_a_profile_of_the_client() {
    let profiles = json!({ "shop": { "base": "fast-wire", "end": ["M30"] } });
    let mut client = Client::start_with(capabilities(), json!({ "profiles": profiles }));
    open(&mut client, URI);
    let mut generate = |profile: &str| {
        let options = json!({ "side": "opening", "rules": { "small-radius": "off" }, "program": { "profile": profile } });
        let params = json!({ "uri": URI, "format": "iso", "options": options });
        client.request("wedm/generate", params)
    };
    let made = generate("shop").unwrap();
    assert!(
        made["program"].as_str().unwrap().ends_with("M30\n"),
        "{made}"
    );
    let error = generate("shed").unwrap_err();
    let message = error["message"].as_str().unwrap();
    assert!(
        message.contains("expected fast-wire, generic, robofil, shop"),
        "{error}"
    );
    client.shut_down();
}

/// Lua and PHP send an empty table as an empty list.
#[test]
fn an_empty_list_is_an_empty_table() {
    for options in [
        json!([]),
        json!({ "wedm": [] }),
        json!({ "layers": [], "program": [], "passes": [], "rules": [], "drawings": [], "pair": [] }),
        json!({ "drawings": { "a.dxf": [] }, "profiles": { "mine": [] } }),
    ] {
        let mut client = Client::start_with(capabilities(), options);
        for settings in [
            json!([]),
            json!({ "wedm": [] }),
            json!({ "wedm": { "milling": [] } }),
        ] {
            client.notify(
                "workspace/didChangeConfiguration",
                json!({ "settings": settings }),
            );
        }
        // A message would come before the one about this.
        client.notify(
            "workspace/didChangeConfiguration",
            json!({ "settings": { "wedm": { "layers": [1] } } }),
        );
        let told = client.told("window/showMessage")["message"].clone();
        let told = told.as_str().unwrap();
        assert!(
            told.contains("layers is a list, expected a table"),
            "{told}"
        );
        client.shut_down();
    }
}

#[test]
fn the_file_upwards_wins_and_is_read_again_when_it_changes() {
    let folder = tempfile::tempdir().unwrap();
    let deep = folder.path().join("a/b");
    std::fs::create_dir_all(&deep).unwrap();
    let (file, uri) = (folder.path().join("wedm.toml"), uri_of(&deep.join("x.dxf")));
    std::fs::write(&file, "correction = 0.2\n").unwrap();
    let watched = with(
        "didChangeWatchedFiles",
        json!({ "dynamicRegistration": true }),
    );
    let mut client = Client::start_with(watched, json!({ "correction": 0.3 }));
    let registered = client.asked("client/registerCapability");
    assert_eq!(
        registered.params["registrations"][0]["registerOptions"]["watchers"][0]["globPattern"],
        "**/wedm.toml"
    );
    client.respond(&registered, Value::Null);
    open(&mut client, &uri);
    assert_eq!(required(&mut client, &uri, 1), 0.2);
    let mut check = |text: Option<&str>, expected: f64| {
        match text {
            Some(text) => std::fs::write(&file, text).unwrap(),
            None => std::fs::remove_file(&file).unwrap(),
        }
        client.notify(
            "workspace/didChangeWatchedFiles",
            json!({ "changes": [{ "uri": uri_of(&file), "type": 2 }] }),
        );
        assert_eq!(required(&mut client, &uri, 1), expected, "{text:?}");
    };
    check(Some("correction = 0.4\n"), 0.4);
    check(None, 0.3);
    check(Some("wire-diameter = 0.5\n"), 0.26);
    client.shut_down();
}

#[test]
fn a_file_that_cannot_be_read_is_said_at_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("wedm.toml");
    let said = |what: &str| {
        let mut client = Client::start();
        open(&mut client, &uri_of(&folder.path().join("x.dxf")));
        client.wait_for(what, |message| {
            message["params"]["uri"] == json!(uri_of(&file))
                && message["params"]["diagnostics"][0]["message"]
                    .as_str()
                    .is_some_and(|said| said.contains(what))
        });
        client.shut_down();
    };
    std::fs::create_dir(&file).unwrap();
    said("it is a folder");
    std::fs::remove_dir(&file).unwrap();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("nowhere.toml", &file).unwrap();
        said("a link to a file that is not there");
    }
}

/// Nothing is read from it, and the file further up holds.
#[cfg(unix)]
#[test]
fn a_pipe_in_the_place_of_the_file_holds_up_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let deep = folder.path().join("deep");
    std::fs::create_dir(&deep).unwrap();
    std::fs::write(folder.path().join("wedm.toml"), "correction = 0.2\n").unwrap();
    let made = std::process::Command::new("mkfifo")
        .arg(deep.join("wedm.toml"))
        .status();
    assert!(made.unwrap().success());
    let mut client = Client::start();
    let uri = uri_of(&deep.join("x.dxf"));
    open(&mut client, &uri);
    assert_eq!(required(&mut client, &uri, 1), 0.2);
    let in_force = client
        .request("wedm/settings", json!({ "uri": uri }))
        .unwrap();
    assert_eq!(in_force["correction"], 0.2);
    client.shut_down();
}

/// What is sent while a worker looks for the file keeps its order: a document is opened, changed and closed, and opened again, in a
/// folder with thousands of others.
#[test]
fn messages_about_a_document_keep_their_order_while_its_file_is_looked_for() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("wedm.toml");
    std::fs::write(&file, "correction = 0.2\n").unwrap();
    let uri = |number: usize| uri_of(&folder.path().join(format!("{number}.dxf")));
    let text = dxf_of(&[("2A", &TIGHT)]);
    let mut client = Client::start();
    let count = by_day(100, 1_000);
    for number in 0..count {
        let uri = uri(number);
        let document = |version: i64, text: &str| json!({ "uri": uri, "languageId": "dxf", "version": version, "text": text });
        client.notify(
            "textDocument/didOpen",
            json!({ "textDocument": document(1, "") }),
        );
        client.notify(
            "textDocument/didClose",
            json!({ "textDocument": { "uri": uri } }),
        );
        client.notify(
            "textDocument/didOpen",
            json!({ "textDocument": document(2, "") }),
        );
        client.notify(
            "textDocument/didChange",
            json!({ "textDocument": { "uri": uri, "version": 3 }, "contentChanges": [{ "text": text }] }),
        );
        if number == count / 2 {
            std::fs::write(&file, "correction = 0.3\n").unwrap();
            client.notify("workspace/didChangeWatchedFiles", json!({ "changes": [] }));
        }
    }
    for number in 0..count {
        let in_force = json!({ "uri": uri(number) });
        let options = json!({ "uri": uri(number), "options": { "margin": 0.01 } });
        let settings = client.request("wedm/settings", in_force).unwrap();
        assert_eq!(settings["correction"], 0.3, "{number}");
        let found = client.request("wedm/contours", options).unwrap();
        assert_eq!(found["contours"].as_array().unwrap().len(), 1, "{number}");
    }
    client.shut_down();
}

#[test]
fn a_drawing_without_a_file_takes_the_file_of_the_folder() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("wedm.toml"), "correction = 0.2\n").unwrap();
    let mut client = Client::raw();
    let folders = json!([{ "uri": uri_of(folder.path()), "name": "w" }]);
    client.shake_hands(
        json!({ "processId": null, "capabilities": capabilities(), "workspaceFolders": folders }),
    );
    open(&mut client, URI);
    assert_eq!(required(&mut client, URI, 1), 0.2);
    client.shut_down();
}

#[test]
fn errors_of_the_file_are_shown_in_it_on_disk_and_open() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("wedm.toml");
    let (file_uri, uri) = (uri_of(&file), uri_of(&folder.path().join("x.dxf")));
    std::fs::write(&file, "margin = 0\ncorrection = -2\n").unwrap();
    let mut client = Client::start();
    open(&mut client, &uri);
    let shown = client.published(&file_uri);
    assert_eq!(
        shown["diagnostics"][0]["range"]["start"],
        json!({ "line": 1, "character": 13 })
    );
    assert!(
        shown["diagnostics"][0]["message"]
            .as_str()
            .unwrap()
            .contains("correction is -2"),
        "{shown}"
    );
    assert_eq!(required(&mut client, &uri, 1), 0.1);
    // Open in the editor: its text counts, saved or not.
    let found = client.open_text(&file_uri, "toml", "correction = 0.2\nside = 3\n");
    assert!(
        found[0]["message"].as_str().unwrap().contains("side is 3"),
        "{found:?}"
    );
    assert_eq!(required(&mut client, &uri, 1), 0.2);
    client.notify(
        "textDocument/didChange",
        json!({ "textDocument": { "uri": file_uri, "version": 2 }, "contentChanges": [{ "text": "correction = 0.3\n" }] }),
    );
    assert_eq!(client.diagnostics(&file_uri, 2).len(), 0);
    assert_eq!(required(&mut client, &uri, 1), 0.3);
    // Closed unsaved: the disk counts again, and its error is shown again.
    client.notify(
        "textDocument/didClose",
        json!({ "textDocument": { "uri": file_uri } }),
    );
    assert_eq!(client.published(&file_uri)["diagnostics"], json!([]));
    assert_eq!(
        client.published(&file_uri)["diagnostics"]
            .as_array()
            .unwrap()
            .len(),
        1
    );
    assert_eq!(required(&mut client, &uri, 1), 0.1);
    // Repaired on disk.
    std::fs::write(&file, "correction = 0.4\n").unwrap();
    client.notify("workspace/didChangeWatchedFiles", json!({ "changes": [] }));
    assert_eq!(client.published(&file_uri)["diagnostics"], json!([]));
    assert_eq!(required(&mut client, &uri, 1), 0.4);
    client.shut_down();
}

#[test]
fn an_edit_does_not_wait_until_all_documents_are_judged_under_other_settings() {
    let count = by_day(400, 1_500);
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("wedm.toml"), "correction = 0.07\n").unwrap();
    // Its own file says what holds for it: it is not among those that are judged again.
    let edited = uri_of(&folder.path().join("edited.dxf"));
    let mut client = Client::start();
    client.open_text(&edited, "dxf", &dxf_of(&[("2A", &TIGHT)]));
    let others: Vec<String> = (0..count)
        .map(|number| format!("cad:///{number}"))
        .collect();
    for uri in &others {
        open(&mut client, uri);
    }
    for uri in &others {
        assert_eq!(required(&mut client, uri, 1), 0.1);
    }
    client.seen.clear();
    let settings = json!({ "settings": { "correction": 0.06 } });
    client.notify("workspace/didChangeConfiguration", settings);
    let at = json!({ "line": 0, "character": 0 });
    let change = json!({ "range": { "start": at, "end": at }, "text": "999\n\n" });
    client.notify(
        "textDocument/didChange",
        json!({ "textDocument": { "uri": edited, "version": 2 }, "contentChanges": [change] }),
    );
    client.diagnostics(&edited, 2);
    let before = client
        .seen
        .iter()
        .filter(|message| message["method"] == "textDocument/publishDiagnostics")
        .count();
    assert!(before < count, "all others were judged before the edit");
    for uri in &others {
        assert_eq!(required(&mut client, uri, 1), 0.06, "{uri}");
    }
    client.shut_down();
}
