//! What is listed, read and written, and what is not.

use super::*;

#[test]
fn files_are_listed_with_what_check_finds() {
    let (_folder, path) = folder();
    std::fs::create_dir_all(path.join("sub/.hidden")).unwrap();
    std::fs::write(path.join("sub/garbage.dxf"), "no drawing").unwrap();
    std::fs::write(path.join("sub/.hidden/a.dxf"), drawing()).unwrap();
    std::fs::write(path.join("sub/clean.3b"), "DD\n").unwrap();
    std::fs::write(path.join("sub/main.iso"), "M02\n").unwrap();
    std::fs::write(path.join("wedm.toml"), "correction = -1\n").unwrap();
    std::fs::write(path.join("notes.txt"), "").unwrap();
    let view = View::of(&path);
    let start = view.get("/api/start").json();
    let name = path.file_name().unwrap().to_str().unwrap();
    assert_eq!(
        start["roots"],
        json!([{ "name": name, "uri": uri_of(&path) }])
    );
    assert_eq!(start["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(
        (&start["hasSettings"], &start["opened"]),
        (&json!(true), &json!([]))
    );
    let files = view.files();
    let shown: Vec<_> = files
        .iter()
        .map(|file| file["path"].as_str().unwrap())
        .collect();
    assert_eq!(
        shown,
        [
            "sub/clean.3b",
            "sub/garbage.dxf",
            "sub/main.iso",
            "tight.dxf",
            "wedm.toml"
        ]
    );
    let languages: Vec<_> = files
        .iter()
        .map(|file| file["language"].as_str().unwrap())
        .collect();
    assert_eq!(languages, ["3b", "dxf", "wire-iso", "dxf", "toml"]);
    for file in files.iter().filter(|file| file["language"] != "toml") {
        let shown = file["path"].as_str().unwrap();
        let checked = Command::new(env!("CARGO_BIN_EXE_wedm"))
            .args(["check", "--output", "json", shown])
            .current_dir(&path)
            .output()
            .unwrap();
        let checked: Value = serde_json::from_slice(&checked.stdout).unwrap();
        let rows = checked["diagnostics"].as_array().unwrap();
        let count = |severity: &str| {
            rows.iter()
                .filter(|row| row["severity"] == severity)
                .count()
        };
        assert_eq!(file["errors"], count("error"), "{file} {rows:?}");
        assert_eq!(file["warnings"], count("warning"), "{file} {rows:?}");
        let metadata = std::fs::metadata(path.join(shown)).unwrap();
        assert_eq!(file["bytes"], metadata.len());
        assert_eq!(file["uri"], uri_of(&path.join(shown)));
        assert_eq!(file["trouble"], Value::Null);
    }
    assert_eq!(files[4]["errors"], 1, "{}", files[4]);
}

#[test]
fn a_file_is_shown_with_its_folder_and_not_with_those_below() {
    let (_folder, path) = folder();
    std::fs::create_dir(path.join("sub")).unwrap();
    std::fs::write(path.join("sub/a.dxf"), drawing()).unwrap();
    std::fs::write(path.join("b.dxf"), drawing()).unwrap();
    let view = View::with(&path, &["tight.dxf"], &[]);
    let start = view.get("/api/start").json();
    assert_eq!(start["opened"], json!([uri_of(&path.join("tight.dxf"))]));
    let files = view.files();
    let shown: Vec<_> = files
        .iter()
        .map(|file| file["path"].as_str().unwrap())
        .collect();
    assert_eq!(shown, ["b.dxf", "tight.dxf"]);
}

#[test]
fn a_file_is_read_and_replaced_by_its_revision() {
    let (_folder, path) = folder();
    let (file, uri) = (path.join("tight.dxf"), uri_of(&path.join("tight.dxf")));
    let view = View::of(&path);
    let read = view.read(&uri);
    assert_eq!((read.status, read.text()), (200, drawing()));
    let revision = read.revision();
    assert!(revision.starts_with('"') && revision.ends_with('"'));
    let written = view.write(&uri, ("If-Match", &revision), b"new");
    assert_eq!(
        (written.status, std::fs::read(&file).unwrap()),
        (200, b"new".to_vec())
    );
    assert_eq!(written.revision(), view.read(&uri).revision());
    // The old revision is gone, whoever has changed it.
    assert_eq!(
        view.write(&uri, ("If-Match", &revision), b"newer").status,
        412
    );
    let revision = view.read(&uri).revision();
    std::fs::write(&file, "mew").unwrap();
    let late = view.write(&uri, ("If-Match", &revision), b"newer");
    assert_eq!(
        (late.status, std::fs::read(&file).unwrap()),
        (412, b"mew".to_vec())
    );
    std::fs::remove_file(&file).unwrap();
    assert_eq!(
        view.write(&uri, ("If-Match", &revision), b"newer").status,
        412
    );
    assert!(!file.exists());
    assert_eq!(view.read(&uri).status, 404);
    // What is made anew takes the place of nothing.
    let made = view.write(&uri, ("If-None-Match", "*"), b"made");
    assert_eq!(
        (made.status, std::fs::read(&file).unwrap()),
        (200, b"made".to_vec())
    );
    assert_eq!(
        view.write(&uri, ("If-None-Match", "*"), b"again").status,
        412
    );
    // One condition is stated, and one alone.
    let address = format!("/api/file?uri={}", encoded(&uri));
    let put = |headers: &[(&str, &str)]| {
        let origin = view.origin();
        let all = [&[("Origin", &*origin)], headers].concat();
        view.ask("PUT", &address, &all, b"x").status
    };
    assert_eq!(put(&[]), 428);
    assert_eq!(put(&[("If-Match", "*")]), 400);
    assert_eq!(put(&[("If-None-Match", "\"a\"")]), 400);
    let revision = made.revision();
    assert_eq!(put(&[("If-Match", &revision), ("If-None-Match", "*")]), 400);
    assert_eq!(std::fs::read(&file).unwrap(), b"made");
    let left = std::fs::read_dir(&path).unwrap().count();
    assert_eq!(left, 1, "a temporary file is left");
}

#[test]
fn of_many_that_replace_one_revision_one_does() {
    let (_folder, path) = folder();
    let uri = uri_of(&path.join("tight.dxf"));
    let view = View::of(&path);
    let revision = view.read(&uri).revision();
    let statuses: Vec<u16> = std::thread::scope(|threads| {
        let put = |body: u8| view.write(&uri, ("If-Match", &revision), &[body]).status;
        let writers: Vec<_> = (0..8)
            .map(|body| threads.spawn(move || put(body)))
            .collect();
        writers
            .into_iter()
            .map(|writer| writer.join().unwrap())
            .collect()
    });
    assert_eq!(
        statuses.iter().filter(|status| **status == 200).count(),
        1,
        "{statuses:?}"
    );
    assert_eq!(
        statuses.iter().filter(|status| **status == 412).count(),
        7,
        "{statuses:?}"
    );
}

#[test]
fn a_body_over_the_limit_is_refused_before_it_comes() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let address = format!("/api/file?uri={}", encoded(&uri_of(&path.join("new.dxf"))));
    let origin = view.origin();
    let length = (128 * 1024 * 1024 + 1).to_string();
    let headers = [
        ("Origin", &*origin),
        ("If-None-Match", "*"),
        ("Content-Length", &length),
    ];
    assert_eq!(view.ask("PUT", &address, &headers, b"").status, 413);
    assert_eq!(view.get("/api/start").status, 200);
    // One that does not say how long it is.
    let head = format!(
        "PUT {address} HTTP/1.1\r\nHost: {}\r\nCookie: {}\r\nOrigin: {origin}\r\nIf-None-Match: *\r\nTransfer-Encoding: chunked\r\n\r\n",
        view.host(),
        view.cookie
    );
    let mut stream = view.connect();
    stream.write_all(head.as_bytes()).unwrap();
    let chunk = [b"100000\r\n".as_slice(), &vec![b'a'; 0x100000], b"\r\n"].concat();
    let mut sent = 0;
    while sent < 200 && stream.write_all(&chunk).is_ok() {
        sent += 1;
    }
    assert!(sent < 200, "a body without end was taken");
    assert!(!path.join("new.dxf").exists());
    assert_eq!(view.get("/api/start").status, 200);
}

#[test]
fn a_file_over_the_limit_is_listed_with_its_trouble() {
    let (_folder, path) = folder();
    let large = std::fs::File::create(path.join("large.dxf")).unwrap();
    large.set_len(128 * 1024 * 1024 + 1).unwrap();
    let view = View::of(&path);
    assert_eq!(view.read(&uri_of(&path.join("large.dxf"))).status, 413);
    let files = view.files();
    let trouble = files[0]["trouble"].as_str().unwrap();
    assert!(trouble.contains("134217729 bytes"), "{trouble}");
}

#[test]
fn more_files_than_are_listed_are_counted() {
    let (_folder, path) = folder();
    for number in 0..2010 {
        std::fs::write(path.join(format!("{number}.3b")), "DD\n").unwrap();
    }
    let view = View::with(&path, &[".", "tight.dxf"], &[]);
    let files = view.files();
    assert_eq!(files.len(), 2000);
    assert_eq!(view.get("/api/files").json()["left"], 11);
    assert!(
        files.iter().any(|file| file["path"] == "tight.dxf"),
        "what was named is shown"
    );
}

#[test]
fn a_page_is_told_what_changes() {
    let (_folder, path) = folder();
    std::fs::write(path.join("b.dxf"), drawing()).unwrap();
    let view = View::of(&path);
    view.files();
    let (mut changes, uri) = (view.changes(), uri_of(&path.join("tight.dxf")));
    std::fs::write(path.join("tight.dxf"), drawing().replace("9.95", "9.5")).unwrap();
    assert_eq!(changes.next("writing"), json!({ "uri": uri }));
    let saved = changes.next("saved");
    assert_eq!(saved["uri"], uri);
    let is_counted =
        |listed: &[Value]| listed[1]["errors"] == 0 && listed[1]["modified"] == saved["modified"];
    while !is_counted(&view.files()) {
        changes.next("files");
    }
    // As many programs save: beside it, and renamed.
    std::fs::write(path.join("~new"), drawing()).unwrap();
    std::fs::rename(path.join("~new"), path.join("tight.dxf")).unwrap();
    assert_eq!(changes.next("saved")["uri"], uri);
    // A new file, one in a new folder, and one that goes.
    std::fs::create_dir(path.join("sub")).unwrap();
    std::fs::write(path.join("sub/c.3b"), "DD\n").unwrap();
    let has = |name: &str| view.files().iter().any(|file| file["path"] == name);
    let until = |changes: &mut Changes, what: &dyn Fn() -> bool| {
        while !what() {
            changes.next("files");
        }
    };
    until(&mut changes, &|| has("sub/c.3b"));
    std::fs::remove_file(path.join("b.dxf")).unwrap();
    until(&mut changes, &|| !has("b.dxf"));
    std::fs::remove_dir_all(path.join("sub")).unwrap();
    until(&mut changes, &|| !has("sub/c.3b"));
    // Settings change the counts of what is below them.
    std::fs::write(path.join("wedm.toml"), "[rules]\nsmall-radius = \"off\"\n").unwrap();
    until(&mut changes, &|| {
        let files = view.files();
        files[0]["path"] == "tight.dxf" && files[0]["errors"] == 0
    });
}

#[test]
fn what_the_page_writes_is_told_to_every_page() {
    let (_folder, path) = folder();
    let view = View::of(&path);
    let mut changes = view.changes();
    let uri = uri_of(&path.join("tight-fixed.dxf"));
    assert_eq!(
        view.write(&uri, ("If-None-Match", "*"), drawing().as_bytes())
            .status,
        200
    );
    assert_eq!(changes.next("saved")["uri"], uri);
}

#[test]
fn the_report_of_a_drawing_is_that_of_the_command() {
    let (_folder, path) = folder();
    std::fs::write(path.join("a.3b"), "DD\n").unwrap();
    let view = View::of(&path);
    let report = |name: &str| {
        let uri = uri_of(&path.join(name));
        view.get(&format!("/api/report?uri={}", encoded(&uri)))
    };
    let made = report("tight.dxf");
    assert_eq!(made.status, 200, "{}", made.text());
    let command = Command::new(env!("CARGO_BIN_EXE_wedm"))
        .arg("report")
        .arg(path.join("tight.dxf"))
        .current_dir(&path)
        .output()
        .unwrap();
    assert!(command.status.code() < Some(2), "{command:?}");
    let written = std::fs::read_to_string(path.join("report/tight.html")).unwrap();
    // That one is among others, and leads to their index.
    let link = written.find("<span class=\"screen\"> · <a").unwrap();
    let end = link + written[link..].find("</a></span>").unwrap() + "</a></span>".len();
    assert_eq!(made.text(), written[..link].to_owned() + &written[end..]);
    assert_eq!(report("a.3b").status, 400);
    assert_eq!(report("nothing.dxf").status, 404);
    assert_eq!(report("../outside.dxf").status, 403);
}
