//! Output that cannot be written.

use super::{Desk, Ended, check};
use std::io::Read;
use std::process::Stdio;

#[test]
fn a_target_that_cannot_be_written_is_named_and_nothing_is_left_behind() {
    let desk = Desk::new();
    check(
        &desk,
        "fix tight.dxf -o no/such/folder/out.dxf",
        2,
        &["!no/such/folder/out.dxf could not be written"],
    );
    desk.write("folder/x", "");
    check(
        &desk,
        "fix tight.dxf -o folder",
        2,
        &["!folder could not be written"],
    );
}

/// A reader that goes away is no reason to panic.
#[test]
fn stdout_may_close_early() {
    let desk = Desk::new();
    for arguments in [
        "check tight.dxf --output sarif",
        "inspect tight.dxf",
        "draw tight.dxf",
        "completions bash",
        "fix tight.dxf -o -",
    ] {
        let mut child = desk
            .command(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let mut stderr = String::new();
        child
            .stderr
            .take()
            .unwrap()
            .read_to_string(&mut stderr)
            .unwrap();
        let status = child.wait().unwrap();
        assert!(
            matches!(status.code(), Some(0 | 1)),
            "wedm {arguments}: {status}"
        );
        assert!(
            !stderr.contains("panicked") && !stderr.contains("pipe"),
            "wedm {arguments}: {stderr}"
        );
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let desk = Desk::new();
    let full = std::fs::File::options()
        .write(true)
        .open("/dev/full")
        .unwrap();
    let ended = Ended::of(
        desk.command("draw tight.dxf")
            .stdout(full)
            .output()
            .unwrap(),
    );
    assert_eq!(ended.code, Some(2), "{ended:?}");
    assert!(
        ended.stderr.contains("stdout could not be written"),
        "{ended:?}"
    );
}
