//! `wedm holes`: the drill list, and what a program comes to.

use super::{Desk, check};

fn polyline(handle: &str, points: &[[f64; 2]]) -> String {
    let count = points.len();
    let points: String = points
        .iter()
        .map(|[x, y]| format!("10\n{x}\n20\n{y}\n"))
        .collect();
    format!(
        "0\nLWPOLYLINE\n5\n{handle}\n100\nAcDbEntity\n8\n0\n100\nAcDbPolyline\n90\n{count}\n70\n1\n{points}"
    )
}

/// A plate with an opening in the form of an L and a round one.
fn desk() -> Desk {
    let desk = Desk::new();
    let entities = [
        polyline(
            "A0",
            &[[-10.0, -10.0], [90.0, -10.0], [90.0, 70.0], [-10.0, 70.0]],
        ),
        polyline(
            "A1",
            &[
                [0.0, 0.0],
                [30.0, 0.0],
                [30.0, 10.0],
                [12.0, 10.0],
                [12.0, 40.0],
                [0.0, 40.0],
            ],
        ),
        "0\nCIRCLE\n5\nA2\n100\nAcDbEntity\n8\n0\n100\nAcDbCircle\n10\n50\n20\n10\n40\n5\n".into(),
    ]
    .concat();
    write(&desk, &entities);
    desk
}

/// A drawing of these entities.
fn write(desk: &Desk, entities: &str) {
    desk.write(
        "plate.dxf",
        format!("0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1021\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"),
    );
}

const LIST: &str = "\
drawing,x_mm,y_mm,diameter_mm,contour,hole,number
plate.dxf,6.5080,6.5080,2,A1,found,1
plate.dxf,50.0000,10.0000,2,A2,found,2
plate.dxf,40.0000,-13.0000,2,A0,found,3
";

#[test]
fn the_drill_list_is_a_table_and_a_layer_that_is_not_cut() {
    let desk = desk();
    let options = "--side auto --start-hole 2";
    let list = desk.run(&format!("holes plate.dxf {options}"));
    assert_eq!((list.code, list.stdout.as_str()), (Some(0), LIST));
    check(
        &desk,
        &format!("holes plate.dxf {options} -o list.csv --overwrite"),
        0,
        &["!written list.csv: 3 holes"],
    );
    assert_eq!(desk.read("list.csv"), LIST.as_bytes());
    check(
        &desk,
        &format!("holes plate.dxf {options} -o drilled.dxf --overwrite"),
        0,
        &["!written drilled.dxf: 3 holes"],
    );
    // Read again the holes are cut by nobody, and lie where they lay.
    let program = desk.run(&format!("generate plate.dxf {options}")).stdout;
    let again = desk.run(&format!("generate drilled.dxf {options}"));
    assert_eq!((again.code, again.stdout), (Some(0), program));
    let again = desk.run(&format!("holes drilled.dxf {options}"));
    let places = |text: &str| -> Vec<String> {
        let rows = text.lines().skip(1);
        let row = |line: &str| {
            line.split(',')
                .skip(1)
                .take(3)
                .collect::<Vec<_>>()
                .join(",")
        };
        rows.map(row).collect()
    };
    assert_eq!(places(&again.stdout), places(LIST), "{again:?}");
    assert_eq!(again.stdout.matches(",given,").count(), 3, "{again:?}");
    check(&desk, "check drilled.dxf --side auto", 0, &["START-HOLES"]);
    // Without a diameter the places alone.
    check(
        &desk,
        "holes plate.dxf --side auto",
        0,
        &["plate.dxf,50.0000,10.0000,,A2,found,2"],
    );
    check(
        &desk,
        "holes plate.dxf clean.dxf --side auto --start-hole 2 --lead-in 3",
        0,
        &["plate.dxf,", "clean.dxf,"],
    );
}

#[test]
fn a_drill_list_that_cannot_be_is_said() {
    let desk = desk();
    let rows: [(&str, i32, &str); 6] = [
        (
            "holes plate.dxf --side auto --start-hole 12",
            1,
            "error[start-hole]: no start hole of Ø 12.000 mm has room in contour A2",
        ),
        (
            "holes plate.dxf clean.dxf --side auto -o both.dxf",
            2,
            "the holes of 2 drawings are written as .csv",
        ),
        (
            "holes plate.dxf --side auto -o list.txt",
            2,
            "holes are written as .csv or .dxf, not as .txt",
        ),
        ("holes plate.dxf --side auto -o list", 2, ".csv"),
        ("holes plate.dxf --side auto -o plate.dxf", 2, "plate.dxf"),
        (
            "holes plate.dxf --side auto --start-hole 0",
            2,
            "start-hole",
        ),
    ];
    let before = desk.read("plate.dxf");
    for (arguments, code, said) in rows {
        check(&desk, arguments, code, &[&format!("!{said}")]);
    }
    assert_eq!(desk.read("plate.dxf"), before);
    for name in ["both.dxf", "list.txt", "list"] {
        assert!(!desk.path(name).exists(), "{name}");
    }
}

#[test]
fn a_program_says_what_it_comes_to() {
    let desk = desk();
    desk.write(
        "wedm.toml",
        "side = \"auto\"\ngap = 0.02\n[passes]\nrates = [100]\n[job]\nthickness = 40\nmachine-rate = 60\n",
    );
    let ended = desk.run("generate plate.dxf -o plate.3b --overwrite");
    for part in [
        "cut: ",
        ", which costs ",
        "  contour A2, pass 1: ",
        "slug of contour A2: 24.7 g",
        "leads: at most 90.0° to the contour",
        "largest wire: Ø 9.960 mm, limited by R 5.000 mm of A2, segment 0",
    ] {
        assert!(ended.stderr.contains(part), "{part} in {ended:?}");
    }
    let ended = desk.run("generate plate.dxf -o plate.3b --overwrite --lang zh");
    assert!(ended.stderr.contains("轮廓 A2 的废料：24.7 g"), "{ended:?}");
    // What is asked for and cannot be said names its keys; where nothing is asked nothing is reported.
    desk.write("wedm.toml", "side = \"auto\"\n[job]\nthickness = 40\n");
    check(
        &desk,
        "generate plate.dxf -o plate.3b --overwrite",
        0,
        &["!not known, since not set: passes.rates, job.machine-rate, gap"],
    );
    desk.write("wedm.toml", "side = \"auto\"\n");
    let ended = desk.run("generate plate.dxf -o plate.3b --overwrite");
    assert!(!ended.stderr.contains("not known"), "{ended:?}");
}

/// Squares by their widths: what of the hole is listed, the code, and what is said.
#[test]
fn a_hole_without_room_is_not_listed_and_one_too_near_is() {
    let desk = Desk::new();
    for (width, listed, code, said) in [
        (
            1.9,
            false,
            1,
            "error[start-hole]: no start hole of Ø 2.000 mm has room in contour A0",
        ),
        (
            2.1,
            true,
            0,
            "warning[start-hole]: the start hole of Ø 2.000 mm at (1.050, 1.050) leaves 0.050 mm beside contour A0",
        ),
        (2.5, true, 0, ""),
    ] {
        let corners = [[0.0, 0.0], [width, 0.0], [width, width], [0.0, width]];
        write(&desk, &polyline("A0", &corners));
        let options = "--side opening --start-hole 2";
        let ended = desk.run(&format!("holes plate.dxf {options}"));
        assert_eq!(ended.code, Some(code), "{width}: {ended:?}");
        assert_eq!(ended.stdout.contains(",A0,found,"), listed, "{ended:?}");
        assert!(ended.stderr.contains(said), "{ended:?}");
        // There is nothing to repair in the drawing; the program says what the list says.
        let ended = desk.run(&format!("generate plate.dxf {options}"));
        assert_eq!(ended.code, Some(code), "{width}: {ended:?}");
        assert!(ended.stderr.contains(said), "{ended:?}");
        assert!(!ended.stderr.contains("wedm fix"), "{ended:?}");
    }
}

/// An island in a round opening: the hole beside it, and that in the deepest point of the opening, would meet.
#[test]
fn proposed_holes_keep_apart() {
    let desk = Desk::new();
    let plate = polyline("A0", &[[0.0, 0.0], [60.0, 0.0], [60.0, 40.0], [0.0, 40.0]]);
    let island = polyline("A1", &[[9.0, 9.0], [11.0, 9.0], [11.0, 11.0], [9.0, 11.0]]);
    let opening = "0\nCIRCLE\n5\nA2\n100\nAcDbEntity\n8\n0\n100\nAcDbCircle\n10\n9.8118\n20\n9.6994\n40\n7.453\n";
    write(&desk, &[&*plate, &island, opening].concat());
    let ended = desk.run("holes plate.dxf --side auto --start-hole 3");
    assert_eq!(ended.code, Some(0), "{ended:?}");
    let places: Vec<(f64, f64)> = ended
        .stdout
        .lines()
        .skip(1)
        .map(|row| {
            let mut cells = row
                .split(',')
                .skip(1)
                .map(|cell| cell.parse::<f64>().unwrap());
            (cells.next().unwrap(), cells.next().unwrap())
        })
        .collect();
    assert_eq!(places.len(), 3, "{ended:?}");
    for (at, one) in places.iter().enumerate() {
        for other in &places[at + 1..] {
            let apart = (one.0 - other.0).hypot(one.1 - other.1);
            assert!(apart > 3.099, "{ended:?}");
        }
    }
}

/// All of the text stays, byte for byte, except the next free handle; what is new has handles of its own.
#[test]
fn a_drawing_with_the_holes_is_the_drawing() {
    let layer = |handle: &str, name: &str| {
        format!(
            "0\nLAYER\n5\n{handle}\n330\n2\n100\nAcDbSymbolTableRecord\n100\nAcDbLayerTableRecord\n2\n{name}\n70\n0\n62\n7\n6\nCONTINUOUS\n390\nF\n"
        )
    };
    let entities = "0\nELLIPSE\n5\nB1\n330\n1F\n100\nAcDbEntity\n67\n1\n8\n0\n100\nAcDbEllipse\n10\n80\n20\n10\n30\n0\n11\n9\n21\n0\n31\n0\n40\n0.5\n41\n0\n42\n6.283185307179586\n\
        0\nHATCH\n5\nB2\n330\n1E\n100\nAcDbEntity\n8\n0\n2\nANSI31\n\
        0\nCIRCLE\n5\nB3\n330\n1E\n100\nAcDbEntity\n8\n0\n100\nAcDbCircle\n10\n10\n20\n10\n40\n5\n\
        0\nLINE\n5\nB0\n330\n1F\n100\nAcDbEntity\n67\n1\n8\n0\n10\n0\n20\n0\n11\n9\n21\n9\n";
    let text = |layers: &str, seed: &str| {
        format!(
            "999\nby hand\n0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n9\n$HANDSEED\n5\n{seed}\n0\nENDSEC\n0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n5\n2\n70\n1\n{layers}0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"
        )
    };
    let desk = Desk::new();
    let options = "--side opening --start-hole 2";
    for (line_end, there) in [("\n", false), ("\r\n", true)] {
        let own = layer("10", "0") + &layer("11", "start-holes").repeat(usize::from(there));
        let drawn = text(&own, "F0").replace('\n', line_end);
        desk.write("plate.dxf", &drawn);
        check(
            &desk,
            &format!("holes plate.dxf {options} -o drilled.dxf --overwrite"),
            0,
            &["!1 hole"],
        );
        let made = String::from_utf8(desk.read("drilled.dxf").to_vec()).unwrap();
        let (layers, [circle, mark], seed) = match there {
            true => (own, ["F1", "F2"], "F3"),
            false => (own + &layer("F1", "START-HOLES"), ["F2", "F3"], "F4"),
        };
        let holes = format!(
            "0\nCIRCLE\n5\n{circle}\n330\n1E\n100\nAcDbEntity\n8\nSTART-HOLES\n100\nAcDbCircle\n10\n10.0\n20\n10.0\n30\n0.0\n40\n1.0\n\
             0\nTEXT\n5\n{mark}\n330\n1E\n100\nAcDbEntity\n8\nSTART-HOLES\n100\nAcDbText\n10\n10.0\n20\n10.0\n30\n0.0\n40\n1.0\n1\nO\n100\nAcDbText\n"
        );
        let expected = text(&layers, seed).replace(
            "0\nENDSEC\n0\nEOF\n",
            &format!("{holes}0\nENDSEC\n0\nEOF\n"),
        );
        assert_eq!(made.replace(line_end, "\n"), expected);
        assert_eq!(made.matches(line_end).count(), expected.lines().count());
        // The holes are there now.
        let again = format!("holes drilled.dxf {options} -o again.dxf --overwrite");
        check(&desk, &again, 0, &["!1 hole"]);
        assert_eq!(desk.read("again.dxf"), desk.read("drilled.dxf"));
    }
}
