//! What is said of a folder, of one chosen contour, and of what the control has to be told.

use super::{Desk, check};

/// Commands that take one file, given a folder.
#[test]
fn a_folder_is_called_one() {
    let desk = Desk::new();
    desk.write("parts.dxf/a.dxf", desk.read("clean.dxf"));
    desk.write("parts/a.dxf", desk.read("clean.dxf"));
    for command in [
        "generate",
        "pair",
        "fit",
        "holes -o h.csv",
        "inspect",
        "draw -o x.svg",
        "contours",
        "convert -o x.iso",
        "simulate",
    ] {
        let (name, rest) = command.split_once(' ').unwrap_or((command, ""));
        for folder in ["parts", "parts.dxf"] {
            check(
                &desk,
                &format!("{name} {folder} {rest}"),
                2,
                &[&format!("!{folder}: it is a folder, expected one file")],
            );
        }
    }
}

/// What the control has to offset by stands in the program where a header is asked for.
#[test]
fn corrections_of_the_control_are_told() {
    let desk = Desk::new();
    let generate = "generate clean.dxf --side opening --compensation controller --passes 0.09,0.05";
    let told = "!to be entered at the control: D0 = 0.0900 mm, D1 = 0.0500 mm";
    let own = format!("{generate} --format iso --profile robofil");
    check(&desk, &own, 0, &[told]);
    assert!(!desk.run(&own).stdout.contains('('));
    desk.write("wedm.toml", "program.header = true\n");
    let written = desk.run(&own).stdout;
    assert!(
        written.contains("G38\r\n(D0 = 0.0900)\r\n(D1 = 0.0500)\r\n"),
        "{written}"
    );
    desk.write("p.iso", &written);
    check(&desk, "check p.iso", 0, &["nothing found"]);
    let four_b = "generate clean.dxf --side opening --format 4b --correction 0.05";
    check(
        &desk,
        four_b,
        0,
        &["!to be entered at the control: correction = 0.0500 mm"],
    );
    let by_path = desk.run("generate clean.dxf --side opening --format iso");
    assert!(!by_path.stderr.contains("control"), "{by_path:?}");
}

/// What is given once for two contours is not told where one of them is chosen.
#[test]
fn a_chosen_contour_has_its_entry() {
    let desk = Desk::new();
    let square = |handle: &str, x: f64| {
        format!(
            "0\nLWPOLYLINE\n5\n{handle}\n8\n0\n90\n4\n70\n1\n10\n{x}\n20\n0\n10\n{0}\n20\n0\n10\n{0}\n20\n9\n10\n{x}\n20\n9\n",
            x + 9.0
        )
    };
    desk.write(
        "two.dxf",
        format!(
            "0\nSECTION\n2\nENTITIES\n{}{}0\nENDSEC\n0\nEOF\n",
            square("2A", 0.0),
            square("2B", 20.0)
        ),
    );
    desk.write("wedm.toml", "side = \"punch\"\nprogram.entry = [0.5, 0]\n");
    check(
        &desk,
        "check two.dxf",
        0,
        &["one entry is given for 2 contours"],
    );
    check(
        &desk,
        "generate two.dxf",
        1,
        &["!one entry is given for 2 contours"],
    );
    let ended = desk.run("generate two.dxf --handle 2A");
    assert!(
        ended.code == Some(0) && !ended.stderr.contains("2 contours"),
        "{ended:?}"
    );
}

/// A file or folder in the place of a command leads to `check`.
#[test]
fn a_path_is_no_command() {
    let desk = Desk::new();
    desk.write("parts/a.dxf", desk.read("clean.dxf"));
    for path in ["clean.dxf", "nosuch.dxf", "parts"] {
        let said = format!("!{path} is no command: wedm check {path}");
        check(&desk, path, 2, &[&said]);
    }
}
