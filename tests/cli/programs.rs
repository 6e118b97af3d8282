//! Programs: formatted, generated, converted.

use super::{Desk, check};
use serde_json::Value;
use std::path::Path;

#[test]
fn programs_are_formatted_where_they_are_told_to_be() {
    let desk = Desk::new();
    let untidy =
        "b9900b0b9900gxl1 ; in\r\nB9900B0B39600GYNR1\r\nB99B9900GXL3\r\n9900B0B9900GXL3\r\ndd\r\n";
    desk.write("shop/untidy.3b", untidy);
    desk.write("shop/tidy.3b", "B9900B0B9900GXL1\nDD\n");
    desk.write("shop/plate.dxf", "0\nEOF\n");
    let cases: &[(&str, i32, &[&str])] = &[
        (
            "format hole.3b",
            0,
            &["B9900B0B9900GXL1\nB9900B0B39600GYNR1\n"],
        ),
        (
            "format hole.3b --layout checking",
            0,
            &["B   9900 B      0 B   9900 GX L1\nB   9900 B      0 B  39600 GY NR1\n"],
        ),
        (
            "format --check hole.3b",
            0,
            &["!0 programs would be formatted, 1 unchanged"],
        ),
        (
            "format --check shop",
            1,
            &[
                "would be formatted: shop/untidy.3b\n",
                "!1 program would be formatted, 1 unchanged",
                "!2 lines with a syntax error",
            ],
        ),
        (
            "format --diff shop",
            1,
            &[
                "-b9900b0b9900gxl1 ; in",
                "+B9900B0B9900GXL1 ; in",
                " 9900B0B9900GXL3",
            ],
        ),
        ("format shop", 2, &["!2 programs found, expected one"]),
        (
            "format clean.dxf",
            2,
            &["!clean.dxf: it is a drawing, expected a program"],
        ),
        (
            "format missing.3b --check",
            2,
            &["!missing.3b: no such file"],
        ),
        ("format hole.3b -o hole.3b", 2, &["!is the input"]),
        (
            "format hole.3b --check --diff",
            2,
            &["!cannot be used with"],
        ),
        (
            "format hole.3b --layout wide",
            2,
            &["!compact, aligned, checking"],
        ),
        ("format", 2, &["!PATH"]),
    ];
    for (arguments, code, texts) in cases {
        check(&desk, arguments, *code, texts);
    }
    assert_eq!(desk.read("shop/untidy.3b"), untidy.as_bytes());
    desk.write("shop/wedm.toml", "[program]\nlayout = \"compact\"\n");
    check(
        &desk,
        "format --in-place shop",
        0,
        &["!1 program formatted, 1 unchanged"],
    );
    let tidy =
        "B9900B0B9900GXL1 ; in\r\nB9900B0B39600GYNR1\r\nB99B9900GXL3\r\n9900B0B9900GXL3\r\nDD\r\n";
    assert_eq!(
        String::from_utf8(desk.read("shop/untidy.3b")).unwrap(),
        tidy
    );
    check(
        &desk,
        "format --in-place shop --layout checking --pause D",
        0,
        &["!2 programs formatted"],
    );
    // ISO: words in upper case, apart or closed up; no number is written otherwise, and lines that cannot be read stay.
    let untidy = "%\r\nn10 g01 x1.50y-0 (in)\r\nG02  X3.  Y4. i1.\r\ng01 x1,5\r\nm02\r\n";
    desk.write("iso/untidy.nc", untidy);
    let parted = "%\r\nN10 G01 X1.50 Y-0 (in)\r\nG02 X3. Y4. I1.\r\ng01 x1,5\r\nM02\r\n";
    check(&desk, "format iso/untidy.nc", 0, &[parted]);
    check(
        &desk,
        "format iso/untidy.nc --layout compact",
        0,
        &["N10G01X1.50Y-0 (in)\r\nG02X3.Y4.I1.\r\ng01 x1,5\r\nM02\r\n"],
    );
    check(
        &desk,
        "format --check iso",
        1,
        &["would be formatted: iso/untidy.nc\n"],
    );
    check(&desk, "format --in-place iso", 0, &["!1 program formatted"]);
    assert_eq!(
        String::from_utf8(desk.read("iso/untidy.nc")).unwrap(),
        parted
    );
    check(
        &desk,
        "format --check iso",
        0,
        &["!0 programs would be formatted, 1 unchanged"],
    );
}

/// A program of a square, as an editor of Chinese Windows writes it: its third block stops too early, and its spaces are no layout's.
fn program_in_gb_18030(comment: &[u8]) -> Vec<u8> {
    let line = |block: &str, comment: &[u8]| [block.as_bytes(), b" ; ", comment, b"\r\n"].concat();
    [
        line("B9000B0B9000GXL1", comment),
        line("B0 B9000 B9000 GYL2", b"\x81\x40\x81\x7c"),
        line("B9000B0B900GXL3", b"\x95\x32\x82\x36"),
        line("B0B9000B9000GYL4", comment),
        b"DD\r\n".to_vec(),
    ]
    .concat()
}

#[test]
fn a_program_in_gb_18030_is_written_as_it_was() {
    let punch: &[u8] = b"\xcd\xb9\xc4\xa3 \xb5\xda 1 \xb6\xce";
    let desk = Desk::new();
    let program = program_in_gb_18030(punch);
    desk.write("gb.3b", &program);
    let comments = |bytes: &[u8]| -> Vec<Vec<u8>> {
        let lines = bytes.split(|byte| *byte == b'\n');
        let behind = lines.filter_map(|line| {
            let at = line.iter().position(|byte| *byte == b';')?;
            Some(line[at..].to_vec())
        });
        behind.collect()
    };
    let note = "!note: what is not UTF-8 is read as GB 18030, and written back as such";
    check(
        &desk,
        "check gb.3b",
        1,
        &["B9000B0B900GXL3 ; \u{20000}", note],
    );
    let checked = desk.run("check gb.3b . --output concise");
    assert_eq!(checked.stderr.matches("GB 18030").count(), 1, "{checked:?}");

    check(&desk, "fix gb.3b --in-place", 0, &[note]);
    let repaired = desk.read("gb.3b");
    let expected = String::from_utf8_lossy(&program).replace("B900G", "B9000G");
    assert_eq!(String::from_utf8_lossy(&repaired), expected);
    assert_eq!(comments(&repaired), comments(&program));

    check(&desk, "format gb.3b --in-place", 0, &[]);
    let formatted = desk.read("gb.3b");
    assert_ne!(formatted, repaired);
    assert_eq!(comments(&formatted), comments(&program));
    desk.write("gb.3b", &program);
    let diff = desk.command("fix gb.3b --diff").output().unwrap();
    assert!(diff.stdout.windows(punch.len()).any(|part| part == punch));

    // One byte that is none of GB 18030: nothing is known of the file, and nothing of it is lost.
    desk.write("odd.3b", program_in_gb_18030(b"\xcd\xb9\xff"));
    let odd = desk.read("odd.3b");
    let ended = desk.run("fix odd.3b --in-place");
    assert!(!ended.stderr.contains("GB 18030"), "{ended:?}");
    assert_eq!(comments(&desk.read("odd.3b")), comments(&odd));

    // The same text in UTF-8 comes out the same, and a byte-order mark stays.
    let text = "\u{feff}B9000B0B9000GXL1 ; 凸模\r\nDD\r\n";
    desk.write("plain.3b", text);
    check(&desk, "format plain.3b --in-place", 0, &[]);
    let plain = String::from_utf8(desk.read("plain.3b")).unwrap();
    assert!(
        plain.starts_with('\u{feff}') && plain.contains("; 凸模"),
        "{plain:?}"
    );
}

/// A small part in the program of each profile: its numbers are millimetres, as they are written.
#[test]
fn programs_of_small_parts_are_not_taken_for_inches() {
    let desk = Desk::new();
    let fillet = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/pictures/fillet.dxf");
    desk.write("small.dxf", std::fs::read(fillet).unwrap());
    assert_eq!(
        desk.run("fix small.dxf --in-place --side opening").code,
        Some(0)
    );
    for profile in ["robofil", "fast-wire", "generic"] {
        for compensation in ["path", "controller"] {
            let name = format!("{profile}-{compensation}.iso");
            let generate = format!(
                "generate small.dxf --side opening --format iso --profile {profile} --compensation {compensation} -o {name} --overwrite"
            );
            assert_eq!(desk.run(&generate).code, Some(0), "{generate}");
            let checked = desk.run(&format!("check {name} --output concise"));
            assert!(!checked.stdout.contains("[units]"), "{}", checked.stdout);
        }
    }
}

/// Where the wire is threaded is told whatever the layout, and in the program where the settings want it there.
#[test]
fn the_thread_hole_is_always_told() {
    let desk = Desk::new();
    let generate = "generate clean.dxf --side punch --thread -3,-2";
    let hole = "the wire is threaded at -3.000, -2.000 mm";
    for (header, layout, stands) in [
        ("", "compact", false),
        ("", "aligned", true),
        ("", "checking", true),
        ("header = true", "compact", true),
        ("header = false", "aligned", false),
    ] {
        desk.write("wedm.toml", format!("[program]\n{header}\n"));
        let ended = desk.run(&format!("{generate} --layout {layout}"));
        assert!(ended.stderr.contains(hole), "{ended:?}");
        let comment = ended
            .stdout
            .starts_with("; Start Point = -3.000 , -2.000\n");
        assert_eq!(comment, stands, "{header} {layout}: {ended:?}");
        desk.write("made.3b", &ended.stdout);
        check(&desk, "check made.3b", 0, &["nothing found"]);
    }
    check(
        &desk,
        &format!("{generate} --format iso"),
        0,
        &[&format!("!{hole}")],
    );
}

#[test]
fn a_program_decodes_to_where_it_began_and_lands_in_its_file() {
    let desk = Desk::new();
    check(
        &desk,
        "generate clean.dxf --side opening -o clean.3b",
        0,
        &["!written clean.3b", "!1 contour"],
    );
    let program = String::from_utf8(desk.read("clean.3b")).unwrap();
    assert!(
        program
            .lines()
            .all(|line| line == "DD" || line.starts_with('B')),
        "{program}"
    );
    check(&desk, "check clean.3b", 0, &["nothing found"]);
    check(
        &desk,
        "generate tight.dxf --side opening --correction 0.07",
        0,
        &["DD"],
    );
    check(
        &desk,
        "generate tight.dxf --side opening --force",
        0,
        &["DD"],
    );
}

/// Errors of contours that are not cut do not stand in the way of those that are.
/// tight_fillet.dxf as a pair: it does not fit, and fits with a thinner wire; then there are two programs, which stay as they are.
#[test]
fn a_pair_is_held_in_each_other_and_its_programs_are_written_once() {
    let desk = Desk::new();
    let pair = "--drawn-as punch --clearance 0.01";
    let thick = format!("{pair} --wire-diameter 0.18 --gap 0.01");
    let thin = format!("{pair} --wire-diameter 0.1 --gap 0.01");
    let bound = desk.run(&format!(
        "fit tight_fillet.dxf {thick} -o fit.svg --overwrite"
    ));
    assert_eq!(bound.code, Some(1), "{bound:?}");
    assert!(
        bound
            .stdout
            .contains("does not fit: the parts overlap by 0.0066 mm"),
        "{bound:?}"
    );
    let svg = String::from_utf8(desk.read("fit.svg")).unwrap();
    assert!(
        svg.contains("binds by 0.0066 mm, 0.0100 wanted")
            && svg.contains("the parts bind by 0.0066 mm where it is tightest")
            && svg.ends_with("</svg>\n"),
        "{svg}"
    );
    let json = desk.run(&format!("fit tight_fillet.dxf {thin} --format json"));
    let fit: Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!((json.code, &fit["fits"]), (Some(0), &Value::Bool(true)));
    let refused = desk.run(&format!("pair tight_fillet.dxf {thick}"));
    assert!(
        refused.code == Some(1) && refused.stderr.contains("does-not-fit"),
        "{refused:?}"
    );
    assert!(!desk.path("tight_fillet-punch.3b").exists());
    let written = desk.run(&format!("pair tight_fillet.dxf {thin} --holder 0.005"));
    assert_eq!(written.code, Some(0), "{written:?}");
    for (part, correction) in [
        ("punch", "0.0600"),
        ("plate", "0.0500"),
        ("holder", "0.0650"),
    ] {
        assert!(desk.path(&format!("tight_fillet-{part}.3b")).is_file());
        assert!(
            written
                .stderr
                .contains(&format!("{part}, correction {correction} mm")),
            "{written:?}"
        );
    }
    desk.write("tight_fillet-plate.3b", "mine");
    let again = desk.run(&format!("pair tight_fillet.dxf {thin}"));
    assert!(
        again.code == Some(2) && again.stderr.contains("it already exists"),
        "{again:?}"
    );
    assert_eq!(desk.read("tight_fillet-plate.3b"), b"mine");
    assert_eq!(
        desk.run(&format!("pair tight_fillet.dxf {thin} --overwrite"))
            .code,
        Some(0)
    );
    let missing = desk.run("pair tight_fillet.dxf --drawn-as plate");
    assert!(
        missing.code == Some(2)
            && missing
                .stderr
                .contains("has no effect without pair.clearance"),
        "{missing:?}"
    );
    let missing = desk.run("fit tight_fillet.dxf");
    assert!(
        missing.code == Some(2)
            && missing
                .stderr
                .contains("pair.drawn-as, pair.clearance, wire-diameter and gap"),
        "{missing:?}"
    );
}

#[test]
fn only_what_is_cut_refuses_a_program() {
    let desk = Desk::new();
    let hole = |handle: &str, x: f64, radius: f64| {
        format!("0\nCIRCLE\n5\n{handle}\n8\n0\n10\n{x}\n20\n0\n40\n{radius}\n")
    };
    let holes = [
        hole("2A", 0.0, 5.0),
        hole("2B", 20.0, 0.05),
        hole("2C", 30.0, 0.1),
    ]
    .concat();
    desk.write(
        "holes.dxf",
        format!("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{holes}0\nENDSEC\n0\nEOF\n"),
    );
    check(
        &desk,
        "generate holes.dxf --side opening",
        1,
        &["!error[small-radius]", "!has 1 error"],
    );
    check(
        &desk,
        "generate holes.dxf --side opening --handle 2B",
        1,
        &["!error[small-radius]"],
    );
    check(
        &desk,
        "generate holes.dxf --side opening --handle 2A",
        0,
        &["DD", "!1 contour"],
    );
    let on_layers = String::from_utf8(desk.read("holes.dxf")).unwrap();
    let on_layers = on_layers.replace("2A\n8\n0\n", "2A\n8\nFINE\n");
    desk.write("layers.dxf", on_layers);
    check(
        &desk,
        "generate layers.dxf --side opening --layer FINE",
        0,
        &["DD", "!1 contour"],
    );
    check(
        &desk,
        "generate layers.dxf --side opening --layer FINE --handle 2C",
        0,
        &["D\n", "!2 contours"],
    );
    check(
        &desk,
        "generate layers.dxf --side opening --layer 0",
        1,
        &["!error[small-radius]"],
    );
    check(
        &desk,
        "generate layers.dxf --side opening --layer FIN",
        1,
        &["!no contour that is cut has an entity on the layer \"FIN\""],
    );
    check(
        &desk,
        "generate holes.dxf --side opening --handle 2C --handle 2A",
        0,
        &["D\n", "!warning[offset-collapse]", "!2 contours"],
    );
    check(
        &desk,
        "check holes.dxf --side opening",
        1,
        &["warning[offset-collapse]", "1 error"],
    );
}

/// A line costs what it is long, whatever stands in it: each of these took minutes, five times as long, when every word looked at the rest of the line.
#[test]
fn one_long_line_is_formatted() {
    let desk = Desk::new();
    for (ending, piece) in [
        ("3b", "D "),
        ("3b", "B"),
        ("3b", "b1000b0b1000gxl1"),
        ("3b", "1.5 "),
        ("3b", "ab B1 "),
        ("iso", "g01x1y1 "),
        ("iso", "(a)"),
    ] {
        desk.write(
            &format!("long.{ending}"),
            piece.repeat(40_000 / piece.len()),
        );
        let ended = desk.run(&format!("format --check --layout aligned long.{ending}"));
        assert!(matches!(ended.code, Some(0 | 1)), "{piece:?}: {ended:?}");
    }
}

/// What is drawn and not in the program is said, unless contours were chosen.
#[test]
fn what_a_program_leaves_out_is_said() {
    let desk = Desk::new();
    let clean = String::from_utf8(desk.read("clean.dxf")).unwrap();
    let line = "0\nLINE\n5\nF1\n8\n0\n10\n8\n20\n5\n11\n12\n21\n5\n";
    let end = clean.rfind("0\nENDSEC").expect("entities");
    let hatched = format!("{}{line}{}", &clean[..end], &clean[end..]);
    desk.write("hatched.dxf", hatched);
    let says = "left out: 1 entity is ignored as annotation: 1 lone line within closed contours";
    for (options, is_said) in [("", true), ("--handle 2A", false)] {
        let ended = desk.run(&format!("generate hatched.dxf --side opening {options}"));
        assert_eq!(ended.code, Some(0), "{ended:?}");
        assert_eq!(ended.stderr.contains(says), is_said, "{options}: {ended:?}");
    }
    let ended = desk.run("generate clean.dxf --side opening");
    assert!(!ended.stderr.contains("left out"), "{ended:?}");
}

/// Beyond what any machine travels no program is written, and the drawing is no fault of wedm.
#[test]
fn a_drawing_too_far_out_is_refused_in_words() {
    let desk = Desk::new();
    let outline = |at: f64| {
        let corners = [[0.0, 0.0], [20.0, 0.0], [20.0, 10.0], [0.0, 10.0]];
        let corners = corners.map(|[x, y]| format!("10\n{}\n20\n{}\n", at + x, at + y));
        format!(
            "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n5\n31\n8\n0\n90\n4\n70\n1\n{}0\nENDSEC\n0\nEOF\n",
            corners.concat()
        )
    };
    for (at, code) in [(1e6, 0), (1e7, 1), (1e8, 1)] {
        desk.write("far.dxf", outline(at));
        let ended = desk.run("generate far.dxf --side punch --format iso");
        assert_eq!(ended.code, Some(code), "{ended:?}");
        let says = ended.stderr.contains("too far out for a program");
        assert_eq!(says, code == 1, "{ended:?}");
        assert!(!ended.stderr.contains("internal error"), "{ended:?}");
    }
}
