//! What lies outside of the folders that are shown, by its name or by a link, is neither read nor written.

use super::*;

#[test]
fn no_spelling_of_a_path_leads_outside() {
    let (_beside, beside) = folder();
    let (_folder, path) = folder();
    std::fs::create_dir_all(path.join("sub/.git")).unwrap();
    let beside_name = beside.file_name().unwrap().to_str().unwrap();
    let inside = uri_of(&path);
    for name in [
        "plain.rs",
        ".env",
        ".a.dxf",
        "sub/.git/a.dxf",
        "wedm.toml.bak",
    ] {
        std::fs::write(path.join(name), "secret").unwrap();
    }
    let view = View::of(&path);
    let outside = [
        uri_of(&beside.join("tight.dxf")),
        format!("{inside}/../{beside_name}/tight.dxf"),
        format!("{inside}/%2e%2e/{beside_name}/tight.dxf"),
        format!("{inside}/%2E%2E%2F{beside_name}%2Ftight.dxf"),
        format!("{inside}/..%2f{beside_name}/tight.dxf"),
        format!("{inside}/sub/../../{beside_name}/tight.dxf"),
        format!("{inside}/..\\{beside_name}\\tight.dxf"),
        format!("{inside}/%252e%252e/{beside_name}/tight.dxf"),
        format!("FILE://{}/tight.dxf", beside.display()),
        format!("file://localhost{}/tight.dxf", beside.display()),
        format!("file:{}/tight.dxf", beside.display()),
        format!("file:////{}/tight.dxf", beside.display()),
        format!("file://10.0.0.9/share{}/tight.dxf", path.display()),
        format!("{}/tight.dxf", beside.display()),
        format!("../{beside_name}/tight.dxf"),
        format!("http://127.0.0.1{}/tight.dxf", path.display()),
        format!("{inside}-beside/tight.dxf"),
        format!("{inside}/tight.dxf%00.txt"),
        "file:///etc/passwd".to_owned(),
        "file:///proc/self/environ".to_owned(),
        format!("{inside}/plain.rs"),
        format!("{inside}/.env"),
        format!("{inside}/.a.dxf"),
        format!("{inside}/sub/.git/a.dxf"),
        format!("{inside}/wedm.toml.bak"),
        format!("{inside}/"),
        inside.clone(),
        String::new(),
    ];
    for uri in &outside {
        let read = view.read(uri);
        assert!(
            [400, 403, 404].contains(&read.status),
            "{uri}: {}",
            read.status
        );
        assert!(read.body.len() < 200, "{uri}: {}", read.text());
        for condition in [("If-None-Match", "*"), ("If-Match", "\"1-0\"")] {
            let written = view.write(uri, condition, b"written");
            assert!(
                [400, 403, 404].contains(&written.status),
                "{uri}: {}",
                written.status
            );
        }
    }
    assert_eq!(
        std::fs::read_to_string(beside.join("tight.dxf")).unwrap(),
        drawing()
    );
    assert_eq!(std::fs::read_dir(&beside).unwrap().count(), 1);
    assert_eq!(
        std::fs::read_to_string(path.join(".env")).unwrap(),
        "secret"
    );
    let new = [
        "a.exe",
        "a.sh",
        "a.js",
        "a",
        ".b.dxf",
        ".vscode/settings.json",
        "sub/.git/config.txt",
        "no/a.dxf",
        "Wedm.TOML",
    ];
    for name in new {
        let written = view.write(
            &format!("{inside}/{name}"),
            ("If-None-Match", "*"),
            b"written",
        );
        assert!(
            [403, 404].contains(&written.status),
            "{name}: {}",
            written.status
        );
        assert!(!path.join(name).exists(), "{name}");
    }
    for name in [
        "a.DXF",
        "sub/a b ä模.3b",
        "sub/wedm.toml",
        "a.svg",
        "a.json",
    ] {
        let uri = encoded(name).replace("%2F", "/");
        let written = view.write(
            &format!("{inside}/{uri}"),
            ("If-None-Match", "*"),
            b"written",
        );
        assert_eq!(written.status, 200, "{name}: {}", written.text());
        assert_eq!(std::fs::read(path.join(name)).unwrap(), b"written");
    }
}

#[cfg(unix)]
#[test]
fn links_are_followed_within_and_not_out() {
    use std::os::unix::fs::symlink;
    let (_beside, beside) = folder();
    let (_folder, path) = folder();
    std::fs::create_dir(path.join("sub")).unwrap();
    symlink(beside.join("tight.dxf"), path.join("out.dxf")).unwrap();
    symlink(&beside, path.join("folder")).unwrap();
    symlink(beside.join("new.dxf"), path.join("nothing.dxf")).unwrap();
    symlink("tight.dxf", path.join("in.dxf")).unwrap();
    symlink("loop.dxf", path.join("loop.dxf")).unwrap();
    symlink("/dev/zero", path.join("zero.dxf")).unwrap();
    symlink("/etc/passwd", path.join("wedm.toml")).unwrap();
    let made = Command::new("mkfifo").arg(path.join("fifo.dxf")).status();
    assert!(made.unwrap().success());
    std::fs::create_dir(path.join("is_folder.dxf")).unwrap();
    let view = View::of(&path);
    let uri = |name: &str| uri_of(&path.join(name));
    let outside = [
        "out.dxf",
        "folder/tight.dxf",
        "nothing.dxf",
        "folder/new.dxf",
        "loop.dxf",
        "zero.dxf",
        "wedm.toml",
        "fifo.dxf",
        "is_folder.dxf",
    ];
    for name in outside {
        let read = view.read(&uri(name));
        assert!([403, 404].contains(&read.status), "{name}: {}", read.status);
        let revision = view.read(&uri("tight.dxf")).revision();
        let written = view.write(&uri(name), ("If-Match", &revision), b"written");
        assert!(
            [403, 404, 412].contains(&written.status),
            "{name}: {}",
            written.status
        );
        let written = view.write(&uri(name), ("If-None-Match", "*"), b"written");
        assert!(
            [403, 404, 412].contains(&written.status),
            "{name}: {}",
            written.status
        );
    }
    assert_eq!(std::fs::read_dir(&beside).unwrap().count(), 1);
    assert_eq!(
        std::fs::read_to_string(beside.join("tight.dxf")).unwrap(),
        drawing()
    );
    let revision = view.read(&uri("in.dxf")).revision();
    assert_eq!(
        view.write(&uri("in.dxf"), ("If-Match", &revision), b"x")
            .status,
        200
    );
    assert_eq!(std::fs::read(path.join("tight.dxf")).unwrap(), b"x");
    assert!(path.join("in.dxf").is_symlink(), "a link stays a link");
    // A link out is listed with its trouble, and not counted.
    let files = view.files();
    let out = files.iter().find(|file| file["path"] == "out.dxf").unwrap();
    assert_eq!(
        (&out["errors"], &out["trouble"]),
        (
            &Value::Null,
            &json!("it lies outside of the folders that are shown")
        )
    );
    assert!(
        !files.iter().any(|file| file["path"] == "fifo.dxf"),
        "{files:?}"
    );
}

#[test]
fn the_drawing_that_settings_name_outside_is_not_read_while_files_are_counted() {
    let (_beside, beside) = folder();
    let (_folder, path) = folder();
    std::fs::write(path.join("plate.3b"), "B5000B5000B5000GYL3\nDD\n").unwrap();
    std::fs::write(
        path.join("wedm.toml"),
        format!("[program]\ndrawing = \"{}/tight.dxf\"\n", beside.display()),
    )
    .unwrap();
    // A pipe would be waited for, if anybody opened it.
    std::fs::remove_file(beside.join("tight.dxf")).unwrap();
    if cfg!(unix) {
        Command::new("mkfifo")
            .arg(beside.join("tight.dxf"))
            .status()
            .unwrap();
    }
    let view = View::of(&path);
    let files = view.files();
    assert_eq!(files.len(), 3, "{files:?}");
}

/// Somebody who may write in the folder exchanges the file for a link while it is asked for.
#[cfg(unix)]
#[test]
fn a_link_that_takes_the_place_of_a_file_meanwhile_is_not_followed() {
    use std::os::unix::fs::symlink;
    use std::sync::atomic::{AtomicBool, Ordering};
    let (_beside, beside) = folder();
    std::fs::write(beside.join("secret.dxf"), "secret").unwrap();
    let (_folder, path) = folder();
    let view = View::of(&path);
    let is_done = AtomicBool::new(false);
    std::thread::scope(|threads| {
        threads.spawn(|| {
            let (place, other) = (path.join("a.dxf"), path.join("other"));
            while !is_done.load(Ordering::Relaxed) {
                std::fs::write(&other, "open").unwrap();
                std::fs::rename(&other, &place).unwrap();
                symlink(beside.join("secret.dxf"), &other).unwrap();
                std::fs::rename(&other, &place).unwrap();
            }
        });
        let uri = uri_of(&path.join("a.dxf"));
        for _ in 0..300 {
            let read = view.read(&uri);
            assert_ne!(read.text(), "secret");
            let _ = view.write(
                &uri,
                ("If-Match", &revision_of_secret(&view, &path)),
                b"written",
            );
        }
        is_done.store(true, Ordering::Relaxed);
    });
    assert_eq!(
        std::fs::read_to_string(beside.join("secret.dxf")).unwrap(),
        "secret"
    );
}

/// The revision that a file with the same bytes has.
#[cfg(unix)]
fn revision_of_secret(view: &View, path: &Path) -> String {
    std::fs::write(path.join("same.dxf"), "secret").unwrap();
    view.read(&uri_of(&path.join("same.dxf"))).revision()
}
