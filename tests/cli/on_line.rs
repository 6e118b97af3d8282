//! A slit that is cut on the line beside contours with a correction, in each format, and the program read back beside its drawing.

use super::Desk;

const DRAWING: &str = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n\
0\nLWPOLYLINE\n5\n10\n8\nPART\n90\n4\n70\n1\n10\n0\n20\n0\n10\n60\n20\n0\n10\n60\n20\n40\n10\n0\n20\n40\n\
0\nLWPOLYLINE\n5\n11\n8\nPART\n90\n4\n70\n1\n10\n20\n20\n15\n10\n40\n20\n15\n10\n40\n20\n25\n10\n20\n20\n25\n\
0\nLINE\n5\n12\n8\nSLIT\n10\n50\n20\n20\n11\n40\n21\n20\n0\nENDSEC\n0\nEOF\n";

fn desk(more: &str) -> Desk {
    let desk = Desk::new();
    desk.write("clamp.dxf", DRAWING);
    desk.write(
        "wedm.toml",
        format!("correction = 0.1\nside = \"auto\"\n{more}\n[layers]\nSLIT = \"line\"\n"),
    );
    desk
}

#[test]
fn programs_with_a_slit_are_read_back_as_their_drawing() {
    for (format, more, ending) in [
        ("3b", "", "3b"),
        ("iso", "", "iso"),
        ("iso", "[program]\ncompensation = \"controller\"\n", "iso"),
        (
            "iso",
            "[passes]\ncorrections = [0.12, 0.1]\n[program]\ncompensation = \"controller\"\n",
            "iso",
        ),
        ("3b", "[program]\nlayout = \"checking\"\n", "3b"),
    ] {
        let desk = desk(more);
        let made = desk.run(&format!(
            "generate clamp.dxf --format {format} -o clamp.{ending} --overwrite"
        ));
        assert_eq!(made.code, Some(0), "{format} {more}: {made:?}");
        let checked = desk.run(&format!("check clamp.{ending}"));
        assert_eq!(checked.code, Some(0), "{format} {more}: {checked:?}");
        assert!(
            !checked.stdout.contains("not-the-drawing"),
            "{format} {more}: {checked:?}"
        );
        let program = String::from_utf8(desk.read(&format!("clamp.{ending}"))).unwrap();
        let switched = program.matches("G41").count() + program.matches("G42").count();
        let passes = if more.contains("passes") { 2 } else { 1 };
        let wanted = if more.contains("controller") {
            2 * passes
        } else {
            0
        };
        assert_eq!(switched, wanted, "{format} {more}:\n{program}");
    }
}

#[test]
fn what_cannot_be_is_refused_and_what_is_threaded_in_an_opening_is_not_drilled() {
    let desk = desk("");
    let made = desk.run("generate clamp.dxf --format 4b");
    assert_eq!(made.code, Some(1), "{made:?}");
    assert!(made.stderr.contains("3B or ISO"), "{made:?}");
    let made = desk.run("generate clamp.dxf --format 4b --layer PART");
    assert_eq!(made.code, Some(0), "{made:?}");
    let list = desk.run("holes clamp.dxf");
    let rows: Vec<&str> = list.stdout.lines().skip(1).collect();
    assert_eq!(rows.len(), 2, "{list:?}");
    assert!(rows.iter().all(|row| !row.contains(",12,")), "{list:?}");
    let contours = desk.run("contours clamp.dxf").stdout;
    assert!(contours.contains("cut on the line"), "{contours}");
}
