//! One drawing in several units: people read the same of it, and say points in the same unit.

use super::Desk;

/// A plate with a round hole and a notch, its numbers as many of the unit as make these mm.
fn plate(insunits: u8, mm: f64) -> String {
    let n = |length: f64| length / mm;
    let corners = [
        (0.0, 0.0),
        (40.0, 0.0),
        (40.0, 25.0),
        (22.0, 25.0),
        (20.0, 12.0),
        (18.0, 25.0),
        (0.0, 25.0),
    ];
    let corners: String = corners
        .iter()
        .map(|&(x, y)| format!("10\n{}\n20\n{}\n", n(x), n(y)))
        .collect();
    let (x, y, radius) = (n(8.0), n(8.0), n(3.0));
    format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{insunits}\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n\
         0\nLWPOLYLINE\n5\n2A\n90\n7\n70\n1\n{corners}0\nCIRCLE\n5\n2B\n10\n{x}\n20\n{y}\n40\n{radius}\n\
         0\nENDSEC\n0\nEOF\n"
    )
}

#[test]
fn points_are_said_and_read_in_mm_whatever_the_drawing_is_in() {
    let desk = Desk::new();
    desk.write(
        "wedm.toml",
        "side = \"auto\"\n[drawings.\"plate.dxf\".contours.\"30,0\"]\nthread = [-3.0, 4.0]\nentry = [0.0, 5.0]\n\
         [drawings.\"plate.dxf\".contours.2B]\nthread = [8.5, 7.0]\n",
    );
    let asked = [
        "check plate.dxf",
        "contours plate.dxf",
        "generate plate.dxf",
        "generate plate.dxf --format iso --handle 2A --thread=-2,3",
        "generate plate.dxf --handle 2A --entry 7,7",
        "generate plate.dxf --handle 2B --thread 8,-7",
        "generate plate.dxf --handle 2A --thread=-90,3",
        "holes plate.dxf",
    ];
    let told_of = |insunits: u8, mm: f64| -> Vec<String> {
        desk.write("plate.dxf", plate(insunits, mm));
        let told = |arguments: &&str| {
            let ended = desk.run(arguments);
            // The unit itself is another, and excerpts of the drawing show its own numbers.
            let lines = |text: &str| {
                let is_same = |line: &&str| !line.contains('|') && !line.starts_with("against: ");
                let own = text.lines().filter(is_same);
                own.collect::<Vec<_>>().join("\n")
            };
            format!(
                "{arguments}\n{}\n{}",
                lines(&ended.stdout),
                lines(&ended.stderr)
            )
        };
        asked.iter().map(told).collect()
    };
    let in_mm = told_of(4, 1.0);
    for (insunits, mm) in [(1, 25.4), (5, 10.0)] {
        for (own, other) in told_of(insunits, mm).iter().zip(&in_mm) {
            assert_eq!(own, other, "unit of {mm} mm");
        }
    }
    assert!(in_mm[2].contains("threaded at"), "{}", in_mm[2]);
    assert!(in_mm[4].contains("(7, 7)"), "{}", in_mm[4]);
    assert!(in_mm[6].contains("warning[lead-in]"), "{}", in_mm[6]);
    assert!(in_mm[0].contains("inside corner of 17."), "{}", in_mm[0]);
}

/// The name is spelled otherwise in the drawing, or was read in another code page.
#[test]
fn a_role_of_a_layer_that_is_not_there_is_said() {
    let desk = Desk::new();
    let drawing = plate(4, 1.0).replace("5\n2A\n", "5\n2A\n8\nPlatte\n");
    desk.write("plate.dxf", &drawing);
    for (roles, is_said) in [
        ("Plate = \"punch\"", true),
        ("PLATTE = \"punch\"\nHOLE = \"opening\"", true),
        ("PLATTE = \"punch\"", false),
        (
            "PLATTE = \"punch\"\n0 = \"opening\"\nHOLE = \"opening\"",
            false,
        ),
    ] {
        desk.write("wedm.toml", format!("[layers]\n{roles}\n"));
        let checked = desk.run("check plate.dxf");
        let said = "no layer of the drawing has that name: its layers are 0, Platte";
        assert_eq!(checked.stdout.contains(said), is_said, "{checked:?}");
    }
}
