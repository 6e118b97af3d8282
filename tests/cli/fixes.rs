//! Repairs as `wedm fix` writes them.

use super::{Desk, check};

#[test]
fn a_fix_changes_its_numbers_and_no_other_byte() {
    let desk = Desk::new();
    for (name, lines) in [
        ("tight.dxf", 2),
        ("chain.dxf", 5),
        ("code_page.dxf", 2),
        ("inch.dxf", 2),
    ] {
        let before = desk.read(name);
        let ended = desk.run(&format!("fix {name} -o fixed.dxf --overwrite"));
        assert_eq!(ended.code, Some(0), "{ended:?}");
        assert_eq!(desk.read(name), before, "{name} has been changed");
        let after = desk.read("fixed.dxf");
        let (old, new): (Vec<_>, Vec<_>) = (
            before.split(|&byte| byte == b'\n').collect(),
            after.split(|&byte| byte == b'\n').collect(),
        );
        assert_eq!(old.len(), new.len(), "{name}");
        let changed: Vec<_> = old.iter().zip(&new).filter(|(a, b)| a != b).collect();
        assert_eq!(changed.len(), lines, "{name}: {changed:?}");
        assert!(
            changed
                .iter()
                .all(|(a, b)| a.ends_with(b"\r") == b.ends_with(b"\r")),
            "{name}"
        );
        check(&desk, "check fixed.dxf", 0, &["nothing found"]);
    }
}

/// What is repeated goes, and is counted beside the arcs.
#[test]
fn repairs_of_every_rule_are_said() {
    let desk = Desk::new();
    let text = String::from_utf8(desk.read("tight.dxf")).unwrap();
    let circles: String = ["2B", "2C"]
        .iter()
        .map(|handle| format!("  0\nCIRCLE\n  5\n{handle}\n  8\nDIE\n 10\n50\n 20\n0\n 40\n3\n"))
        .collect();
    let end = text.rfind("  0\nENDSEC").unwrap();
    desk.write(
        "doubled.dxf",
        format!("{}{circles}{}", &text[..end], &text[end..]),
    );
    check(
        &desk,
        "fix doubled.dxf -o fixed.dxf",
        0,
        &["!doubled.dxf: 1 arc, 1 duplicate repaired in 2 rounds"],
    );
    check(&desk, "check fixed.dxf", 0, &["nothing found"]);
}

/// A repair that the text cannot take does not stand in the way of the others.
#[test]
fn what_cannot_be_repaired_is_said_and_the_rest_is_repaired() {
    let desk = Desk::new();
    let text = String::from_utf8(desk.read("tight.dxf")).unwrap();
    // A line is missing just before the second of two circles: how the text goes on there is told from the circle's lines.
    let circle =
        |handle: &str| format!("  0\nCIRCLE\n  5\n{handle}\n  8\nDIE\n 10\n50\n 20\n0\n 40\n3\n");
    let damaged = "  0\nLINE\n  5\n2D\n  8\nDIE\n 10\n1\n 20\n2\n 11\n3\n 21\n";
    let end = text.rfind("  0\nENDSEC").unwrap();
    desk.write(
        "both.dxf",
        format!(
            "{}{}{damaged}{}{}",
            &text[..end],
            circle("2B"),
            circle("2C"),
            &text[end..]
        ),
    );
    check(
        &desk,
        "fix both.dxf -o fixed.dxf --overwrite",
        1,
        &[
            "!1 arc repaired",
            "!not repaired: both.dxf:",
            "!which is damaged: repair that first",
        ],
    );
    check(&desk, "inspect fixed.dxf --output json", 1, &["0.101"]);
    check(
        &desk,
        "fix fixed.dxf -o again.dxf --overwrite",
        1,
        &[
            "!nothing could be repaired safely",
            "!not repaired: fixed.dxf:",
        ],
    );
}

#[test]
fn a_fix_in_place_writes_what_a_fix_beside_writes() {
    let desk = Desk::new();
    check(
        &desk,
        "fix code_page.dxf -o beside.dxf",
        0,
        &["!1 arc repaired"],
    );
    let printed = desk
        .command("fix code_page.dxf -o -")
        .output()
        .unwrap()
        .stdout;
    check(
        &desk,
        "fix code_page.dxf --in-place",
        0,
        &["!1 arc repaired"],
    );
    assert_eq!(desk.read("code_page.dxf"), desk.read("beside.dxf"));
    assert_eq!(printed, desk.read("beside.dxf"));
    let names: Vec<_> = std::fs::read_dir(desk.0.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    assert!(
        names
            .iter()
            .all(|name| !name.to_string_lossy().starts_with(".wedm")),
        "{names:?}"
    );
}

#[cfg(unix)]
#[test]
fn a_fix_in_place_keeps_permissions_and_links() {
    use std::os::unix::fs::PermissionsExt;
    let desk = Desk::new();
    std::fs::set_permissions(
        desk.path("tight.dxf"),
        std::fs::Permissions::from_mode(0o640),
    )
    .unwrap();
    std::os::unix::fs::symlink("tight.dxf", desk.path("link.dxf")).unwrap();
    check(&desk, "fix link.dxf --in-place", 0, &["!1 arc repaired"]);
    assert!(
        std::fs::symlink_metadata(desk.path("link.dxf"))
            .unwrap()
            .is_symlink()
    );
    assert_eq!(
        std::fs::metadata(desk.path("tight.dxf"))
            .unwrap()
            .permissions()
            .mode()
            & 0o777,
        0o640
    );
    check(&desk, "check tight.dxf", 0, &[]);
}
