//! A role, a thread hole or an entry that one contour is given in two ways: the documented order decides, and it is said.

use super::{Desk, check};

/// A square on the layer A with the handle A0, and marks O at these places.
fn square(marks: &[[f64; 2]]) -> String {
    let mut text = String::from(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n5\nA0\n8\nA\n62\n1\n90\n4\n70\n1\n",
    );
    for [x, y] in [[0.0, 0.0], [20.0, 0.0], [20.0, 10.0], [0.0, 10.0]] {
        text += &format!("10\n{x:?}\n20\n{y:?}\n");
    }
    for [x, y] in marks {
        text += &format!("0\nTEXT\n8\nA\n10\n{x:?}\n20\n{y:?}\n40\n1.0\n1\nO\n");
    }
    text + "0\nENDSEC\n0\nEOF\n"
}

const OWN: &str = "[drawings.\"x.dxf\".contours.A0]\n";

#[test]
fn what_is_given_twice_is_said_with_both_places() {
    let desk = Desk::new();
    let said = |settings: &str, marks: &[[f64; 2]]| {
        desk.write("wedm.toml", settings);
        desk.write("x.dxf", square(marks));
        let checked = desk.run("check x.dxf --select settings");
        let made = desk.run("generate x.dxf --format 3b -o x.3b --overwrite --force");
        assert_eq!(
            checked.stdout.contains("warning[settings]"),
            made.stderr.contains("warning[settings]"),
            "{settings}: {checked:?} {made:?}"
        );
        checked.stdout
    };
    let outside = [[-5.0, 5.0], [25.0, 5.0]];
    for (settings, marks, expected) in [
        (
            "layers.A = \"opening\"\ncontours.A0 = \"punch\"\n".to_owned(),
            &outside[..0],
            "contour A0 is given two roles: punch by contours.A0, which counts, and opening by layers.A",
        ),
        (
            "layers.A = \"opening\"\ncolors.red = \"punch\"\n".to_owned(),
            &outside[..0],
            "opening by layers.A, which counts, and punch by its colour",
        ),
        (
            "side = \"punch\"\n".to_owned(),
            &outside,
            "the thread hole of contour A0 is given twice: (-5, 5) by a mark O, which counts, and (25, 5) by a mark O",
        ),
        (
            "side = \"punch\"\nprogram.thread = [10, -5]\n".to_owned(),
            &outside[..1],
            "(10, -5) by program.thread, which counts, and (-5, 5) by a mark O",
        ),
        (
            format!("side = \"punch\"\nprogram.thread.A0 = [10, -5]\n{OWN}thread = [10, -6]\n"),
            &outside[..0],
            "(10, -6) by drawings.\"x.dxf\".contours.\"A0\".thread, which counts, and (10, -5) by program.thread.A0",
        ),
        (
            format!("side = \"punch\"\nprogram.entry.A0 = [10, 0]\n{OWN}entry = [5, 0]\n"),
            &outside[..0],
            "the entry of contour A0 is given twice: (5, 0) by",
        ),
    ] {
        let found = said(&settings, marks);
        assert!(found.contains(expected), "{settings}: {found}");
    }
    for (settings, marks) in [
        (
            "layers.A = \"punch\"\ncontours.A0 = \"punch\"\n".to_owned(),
            &outside[..0],
        ),
        // The exception that one drawing makes of its layer.
        (
            format!("layers.A = \"opening\"\n{OWN}side = \"punch\"\n"),
            &outside[..0],
        ),
        (
            "side = \"punch\"\nprogram.thread = [-5, 5]\n".to_owned(),
            &outside[..1],
        ),
    ] {
        let found = said(&settings, marks);
        assert!(!found.contains("[settings]"), "{settings}: {found}");
    }
    check(&desk, "check clean.dxf", 0, &[]);
}
