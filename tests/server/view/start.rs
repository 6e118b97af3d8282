//! How the page is started, and what is said where it cannot be.

use super::*;
use std::net::TcpListener;

/// The end of a command that ends by itself: exit code, stdout, stderr.
fn ended(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_wedm"))
        .args(arguments)
        .current_dir(folder)
        .env("LC_ALL", "C")
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

#[test]
fn what_cannot_be_shown_is_said() {
    let (_folder, path) = folder();
    std::fs::write(path.join("notes.rs"), "").unwrap();
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let check = |arguments: &[&str], expected: &str| {
        let (code, out, error) = ended(&path, &[&["view", "--no-open"], arguments].concat());
        assert_eq!((code, &*out), (Some(2), ""), "{arguments:?}");
        assert_eq!(error.trim_end(), expected, "{arguments:?}");
    };
    check(&["gone"], "error: gone: no such file or directory");
    check(
        &["gone/a.dxf"],
        "error: gone/a.dxf: no such file or directory",
    );
    check(
        &["notes.rs"],
        "error: notes.rs: it is no drawing, program or wedm.toml that could be shown",
    );
    check(
        &["--port", &port],
        &format!(
            "error: port {port} is taken by another program: choose another with --port, or none"
        ),
    );
    check(
        &["--port", &port, "--lang", "zh"],
        &format!("错误：端口 {port} 已被其他程序占用：请用 --port 另选一个，或不指定"),
    );
}

#[test]
fn a_port_may_be_chosen() {
    let (_folder, path) = folder();
    let free = TcpListener::bind("127.0.0.1:0")
        .unwrap()
        .local_addr()
        .unwrap();
    let view = View::with(&path, &["--port", &free.port().to_string()], &[]);
    assert_eq!(view.port, free.port());
}

#[test]
fn the_page_speaks_the_language_of_the_browser_unless_one_is_chosen() {
    let (_folder, path) = folder();
    let language = |view: &View, accepted: &str| {
        let headers = [("Accept-Language", accepted)];
        view.ask("GET", "/api/start", &headers, b"").json()["language"].take()
    };
    let view = View::with(&path, &[], &[("LC_ALL", "C")]);
    assert_eq!(language(&view, "tlh"), "en");
    assert_eq!(language(&view, "zh-CN,zh;q=0.9,en;q=0.8"), "zh");
    assert_eq!(view.get("/nothing").text(), "此地址没有内容\n");
    assert_eq!(language(&view, "en-GB"), "en");
    assert_eq!(
        view.get("/nothing").text(),
        "there is nothing at this address\n"
    );
    let view = View::with(&path, &["--lang", "zh"], &[("LC_ALL", "C")]);
    assert_eq!(language(&view, "en-GB"), "zh");
}

/// A program of this name that writes down what it was called with.
#[cfg(all(unix, not(target_os = "macos")))]
#[test]
fn the_browser_is_opened_with_the_address() {
    use std::os::unix::fs::PermissionsExt;
    let (_folder, path) = folder();
    let programs = tempfile::tempdir().unwrap();
    let (opener, called) = (
        programs.path().join("xdg-open"),
        programs.path().join("called"),
    );
    let script = format!(
        "#!/bin/sh\necho \"$@\" > {0}.new && mv {0}.new {0}\n",
        called.display()
    );
    std::fs::write(&opener, script).unwrap();
    std::fs::set_permissions(&opener, PermissionsExt::from_mode(0o755)).unwrap();
    let start = |search: &str| {
        Command::new(env!("CARGO_BIN_EXE_wedm"))
            .args(["view", "--lang", "en"])
            .current_dir(&path)
            .env("PATH", search)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap()
    };
    let first_line = |stream: &mut dyn Read| {
        let mut line = String::new();
        BufReader::new(stream).read_line(&mut line).unwrap();
        line
    };
    let mut child = start(&format!("{}:/usr/bin:/bin", programs.path().display()));
    let address = first_line(child.stdout.as_mut().unwrap());
    while !called.exists() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    assert_eq!(std::fs::read_to_string(&called).unwrap(), address);
    child.kill().unwrap();
    child.wait().unwrap();
    // Without a browser the address is still there.
    let mut child = start("/nonexistent");
    let mut said = BufReader::new(child.stderr.take().unwrap()).lines();
    let said: Vec<String> = [said.next(), said.next()]
        .into_iter()
        .flatten()
        .flatten()
        .collect();
    assert!(said[0].contains("Ctrl-C"), "{said:?}");
    assert!(said[1].contains("no browser could be opened"), "{said:?}");
    child.kill().unwrap();
    child.wait().unwrap();
}
