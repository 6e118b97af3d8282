//! A real Neovim opens a drawing, shows the fault, applies the fix, writes it.

use std::path::Path;
use std::process::{Command, Stdio};

/// A die opening with one fillet of R 0.05 between two lines.
const DRAWING: &str = include_str!("data/tight_fillet.dxf");

#[test]
fn neovim_shows_the_fault_and_applies_the_fix() {
    if Command::new("nvim").arg("--version").output().is_err() {
        assert!(std::env::var_os("CI").is_none(), "nvim is not installed");
        println!("skipped: nvim is not installed");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let drawing = folder.path().join("die.dxf");
    std::fs::write(&drawing, DRAWING).unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let output = Command::new("timeout")
        .args(["60", "nvim", "--headless", "-u", "NONE", "-i", "NONE", "-n", "-S"])
        .arg(root.join("tests/neovim/session.lua"))
        .env("WEDM", env!("CARGO_BIN_EXE_wedm"))
        .env("WEDM_LUA", root.join("clients/editors/neovim/wedm.lua"))
        .env("WEDM_DRAWING", &drawing)
        .env("HOME", folder.path())
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let seen = String::from_utf8_lossy(&output.stdout).replace('\r', "");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{seen}\n{errors}");
    for expected in [
        "arc R 0.050 mm is below the correction 0.100 mm",
        "offered: Replace the arc by one of R 0.101 mm",
        "faults: 1, then 0",
        "after undo: 1",
    ] {
        assert!(seen.contains(expected), "no {expected:?} in:\n{seen}\n{errors}");
    }
    // Only numbers of the two vertices have changed.
    let fixed = std::fs::read_to_string(&drawing).unwrap();
    let changed = DRAWING.lines().zip(fixed.lines()).filter(|(old, new)| old != new).count();
    assert_eq!(DRAWING.lines().count(), fixed.lines().count());
    assert!((1..=4).contains(&changed), "{changed} lines differ");
    let check = Command::new(env!("CARGO_BIN_EXE_wedm")).args(["check", "--side", "opening"]).arg(&drawing).output().unwrap();
    assert_eq!(check.status.code(), Some(0), "{}", String::from_utf8_lossy(&check.stdout));
}
