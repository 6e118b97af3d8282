//! Parts that share an edge, in each format, and their programs read back beside the drawing.

use super::Desk;

/// Two plates that share an edge of which one is longer, and a hole in the first.
const DRAWING: &str = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n\
0\nLWPOLYLINE\n5\n10\n8\nPART\n90\n4\n70\n1\n10\n0\n20\n0\n10\n20\n20\n0\n10\n20\n20\n30\n10\n0\n20\n30\n\
0\nLWPOLYLINE\n5\n11\n8\nPART\n90\n4\n70\n1\n10\n20\n20\n0\n10\n40\n20\n0\n10\n40\n20\n20\n10\n20\n20\n20\n\
0\nCIRCLE\n5\n12\n8\nHOLES\n10\n8\n20\n15\n40\n4\n0\nENDSEC\n0\nEOF\n";

fn desk(more: &str) -> Desk {
    let desk = Desk::new();
    desk.write("plates.dxf", DRAWING);
    let settings = format!(
        "wire-diameter = 0.18\ngap = 0.01\nside = \"auto\"\n[program]\ncommon-line = true\n{more}"
    );
    desk.write("wedm.toml", settings);
    desk
}

#[test]
fn programs_of_parts_that_share_an_edge_are_read_back_as_their_drawing() {
    for (format, more, ending, switched) in [
        ("3b", "", "3b", 0),
        ("iso", "", "iso", 0),
        ("iso", "compensation = \"controller\"\n", "iso", 2),
        ("3b", "[passes]\ncorrections = [0.12, 0.1]\n", "3b", 0),
    ] {
        let desk = desk(more);
        let made = desk.run(&format!(
            "generate plates.dxf --format {format} -o plates.{ending} --overwrite"
        ));
        assert_eq!(made.code, Some(0), "{format} {more}: {made:?}");
        assert!(made.stderr.contains("3 contours"), "{format}: {made:?}");
        let lost = "and each loses";
        assert!(made.stderr.contains(lost), "{format}: {made:?}");
        let checked = desk.run(&format!("check plates.{ending}"));
        assert_eq!(checked.code, Some(0), "{format} {more}: {checked:?}");
        assert!(
            !checked.stdout.contains("not-the-drawing"),
            "{format} {more}: {checked:?}"
        );
        let program = String::from_utf8(desk.read(&format!("plates.{ending}"))).unwrap();
        let count = program.matches("G41").count() + program.matches("G42").count();
        assert_eq!(count, switched, "{format} {more}:\n{program}");
    }
}

#[test]
fn what_a_part_loses_is_said_and_what_falls_before() {
    let desk = desk("");
    let checked = desk.run("check plates.dxf");
    assert_eq!(checked.code, Some(0), "{checked:?}");
    assert!(
        checked.stdout.contains(
            "contours 10, 11 share an edge of 20.000 mm: one cut on this line parts them, and each loses 0.100 mm along it; \
             10 measures 19.900 mm across it in place of 20.000; 11 measures 19.900 mm across it in place of 20.000"
        ),
        "{checked:?}"
    );
    let refused = desk.run("generate plates.dxf --common-line false -o no.3b");
    assert_eq!(refused.code, Some(1), "{refused:?}");
    assert!(refused.stderr.contains("share this wall"), "{refused:?}");
    let with_tab = desk.run("generate plates.dxf --tab 1 -o tab.3b");
    assert!(
        with_tab.stderr.contains("program.tab holds only the part"),
        "{with_tab:?}"
    );
    // The hole, the common line and what goes round both.
    let contours = desk.run("contours plates.dxf").stdout;
    assert!(contours.ends_with("3 contours\n"), "{contours}");
    let holes = desk.run("holes plates.dxf").stdout;
    assert_eq!(holes.lines().count(), 4, "{holes}");
    let refused = desk.run("generate plates.dxf --format 4b");
    assert!(refused.stderr.contains("3B or ISO"), "{refused:?}");
}
