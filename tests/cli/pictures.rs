//! Pictures and new drawings.

use super::{Desk, check};
use std::path::Path;

#[test]
fn a_picture_is_well_formed_enough_to_be_shown() {
    let desk = Desk::new();
    check(
        &desk,
        "draw narrow.dxf -o narrow.svg",
        0,
        &["!drawn without the path of the wire"],
    );
    let picture = String::from_utf8(desk.read("narrow.svg")).unwrap();
    assert!(picture.starts_with("<svg xmlns=") && picture.ends_with("</svg>\n"));
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
    check(&desk, "draw clean.dxf --side opening -o clean.svg", 0, &[]);
    assert!(
        String::from_utf8(desk.read("clean.svg"))
            .unwrap()
            .contains("class=\"wire\"")
    );
}

/// A lens enlarges a hair beside a line of 800 m: what makes pixels of it once ended the whole process.
#[test]
fn what_lies_far_beside_a_fault_is_no_hindrance() {
    let line = |[from, to]: [[f64; 3]; 2]| {
        let vertex = |[x, y, bulge]: [f64; 3]| format!("10\n{x}\n20\n{y}\n42\n{bulge}\n");
        let vertices = [from, to].map(vertex).concat();
        format!("0\nLWPOLYLINE\n90\n2\n70\n1\n{vertices}")
    };
    for (nth, lines) in [
        [
            [[0.0, 8e5, 0.0], [0.0; 3]],
            [[0.0, 0.0, 1.0], [0.0, 0.1, 0.0]],
        ],
        [
            [[0.0, 0.01, 3.3], [0.0, 0.0, 1.0]],
            [[-3e5, 0.0, 0.0], [0.0; 3]],
        ],
    ]
    .into_iter()
    .enumerate()
    {
        let desk = Desk::new();
        let all = lines.map(line).concat();
        let text = format!("0\nSECTION\n2\nENTITIES\n{all}0\nENDSEC\n0\nEOF\n");
        desk.write("far.dxf", &text);
        for ending in ["svg", "png", "pdf"] {
            let made = desk.run(&format!("draw far.dxf -o far.{ending} --overwrite"));
            assert!(
                desk.read(&format!("far.{ending}")).len() > 1000,
                "{nth}: {}",
                made.stderr
            );
        }
    }
}

/// Two holes, of which the second is cut first.
const HOLES: &str = "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n5\n2A\n10\n0\n20\n0\n40\n5\n\
    0\nCIRCLE\n5\n2B\n10\n20\n20\n0\n40\n5\n0\nENDSEC\n0\nEOF\n";

#[test]
fn a_picture_says_what_it_is_in_which_order_and_how_long() {
    let desk = Desk::new();
    desk.write("holes.dxf", HOLES);
    desk.write(
        "wedm.toml",
        "side = \"opening\"\n[drawings.\"holes.dxf\".contours.2B]\norder = 1\n",
    );
    let lengths = "cut 81.2 mm";
    desk.run("draw holes.dxf -o holes.svg");
    let picture = String::from_utf8(desk.read("holes.svg")).unwrap();
    for said in [
        "holes.dxf · contours and wire path</text>",
        "2 contours · 30.000 × 10.000 mm · contour 62.8 mm · cut 81.2 mm · jumps 20.0 mm",
        "class=\"jump\"",
        ">1</text>",
        ">2</text>",
    ] {
        assert!(picture.contains(said), "{said}: {picture}");
    }
    // The program of it speaks of the same lengths.
    let made = desk.run("generate holes.dxf --format 3b -o holes.3b");
    let said = made.stderr;
    assert!(
        said.contains(lengths) && said.contains("jumps 20.0 mm"),
        "{said}"
    );
    let told = desk.run("simulate holes.3b");
    let said = told.stdout;
    assert!(
        said.contains(lengths) && said.contains("jumps 20.0 mm"),
        "{said}"
    );
    desk.run("draw holes.3b -o program.svg");
    let picture = String::from_utf8(desk.read("program.svg")).unwrap();
    assert!(picture.contains("holes.3b · path of the wire"), "{picture}");
    assert!(picture.contains("cut 81.2 mm · jumps 20.0 mm"), "{picture}");
    // Where the side is not known there is no path, and the picture says why.
    desk.write("wedm.toml", "");
    desk.run("draw holes.dxf -o none.svg");
    let picture = String::from_utf8(desk.read("none.svg")).unwrap();
    assert!(
        picture.contains("contours, no wire path</text>"),
        "{picture}"
    );
    assert!(
        picture.contains("no wire path: side of contour 1 (2A) at"),
        "{picture}"
    );
}

#[test]
fn pictures_are_written_as_png_and_pdf_too() {
    let desk = Desk::new();
    desk.write("holes.dxf", HOLES);
    for (target, begins) in [
        ("a.PNG", &b"\x89PNG"[..]),
        ("a.pdf", b"%PDF-"),
        ("a.svg", b"<svg "),
    ] {
        let ended = desk.run(&format!("--lang zh draw holes.dxf -o {target} --overwrite"));
        assert_eq!(ended.code, Some(0), "{ended:?}");
        let bytes = desk.read(target);
        assert!(bytes.starts_with(begins), "{target}: {} bytes", bytes.len());
    }
    let ended = desk.run("draw holes.dxf -o a.jpg");
    let said = ended.stderr;
    assert!(
        said.contains(".jpg is not written, expected .svg, .png, .pdf or .dxf"),
        "{said}"
    );
}

/// `UPDATE_EXPECT=1 cargo test --test command_line cli` makes the pictures again.
#[test]
fn the_pictures_of_the_documentation_are_current() {
    let desk = Desk::new();
    let drawing = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/pictures/small-radius.dxf");
    desk.write("small-radius.dxf", std::fs::read(drawing).unwrap());
    check(
        &desk,
        "check small-radius.dxf --side opening",
        1,
        &["3 errors"],
    );
    let faulty = desk.run("draw small-radius.dxf --side opening").stdout;
    check(
        &desk,
        "fix small-radius.dxf --side opening --in-place",
        0,
        &["!3 arcs repaired"],
    );
    let fixed = desk.run("draw small-radius.dxf --side opening").stdout;
    expect_test::expect_file!["../../docs/pictures/small-radius.svg"].assert_eq(&faulty);
    expect_test::expect_file!["../../docs/pictures/small-radius-fixed.svg"].assert_eq(&fixed);
}

#[test]
fn a_new_drawing_holds_the_contours_and_the_path_of_the_wire() {
    let desk = Desk::new();
    check(&desk, "draw clean.dxf --side opening -o path.dxf", 0, &[]);
    let list = desk
        .run("inspect path.dxf --output json --side opening")
        .json();
    let layers = |layer: &str| {
        list["entities"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|entity| entity["layer"] == layer)
            .count()
    };
    // A lead in and out, and a piece of path for each segment and for the one that is cut in two by the entry.
    let contour = desk.run("inspect clean.dxf --output json").json();
    let segments = contour["entities"][0]["segments"].as_array().unwrap().len();
    assert_eq!((layers("DIE"), layers("WIRE")), (1, segments + 3));
}

/// A picture of what an electrode mills speaks of no wire and of no hole to thread it through.
#[test]
fn pictures_of_milling_speak_of_the_electrode() {
    let desk = Desk::new();
    desk.write(
        "wedm.toml",
        "[milling]\ntool-diameter = 1.0\ngap = 0.05\nlayer = 0.05\ndepth = 0.2\nwear = 0.001\n",
    );
    desk.write(
        "slot.dxf",
        "0\nSECTION\n2\nENTITIES\n0\nLINE\n5\n2A\n8\n0\n10\n0\n20\n0\n11\n10\n21\n0\n0\nENDSEC\n0\nEOF\n",
    );
    check(
        &desk,
        "generate slot.dxf --format milling -o milled.iso",
        0,
        &[],
    );
    for (file, title, language) in [
        (
            "slot.dxf",
            "slot.dxf · contours and path of the electrode",
            "en",
        ),
        ("milled.iso", "milled.iso · path of the electrode", "en"),
        ("slot.dxf", "slot.dxf · 轮廓和电极轨迹", "zh"),
        ("milled.iso", "milled.iso · 电极轨迹", "zh"),
    ] {
        let drawn = desk.run(&format!("--lang {language} draw {file}"));
        assert_eq!(drawn.code, Some(0), "{drawn:?}");
        assert!(
            drawn.stdout.contains(title),
            "no {title} in {}",
            drawn.stdout
        );
        for wire in ["wire<", "wire's", "thread hole", "电极丝", "穿丝"] {
            assert!(!drawn.stdout.contains(wire), "{wire} in {}", drawn.stdout);
        }
    }
}

/// A long name ends in an ellipsis and is whole in the tooltip; a way out along the way in is no line of its own.
#[test]
fn a_heading_fits_and_leads_stay_dashed() {
    let desk = Desk::new();
    let name = "n".repeat(120) + ".dxf";
    desk.write(&name, desk.read("clean.dxf"));
    let drawn = desk.run(&format!("draw {name} --side opening -o long.svg"));
    assert_eq!(drawn.code, Some(0), "{drawn:?}");
    let svg = String::from_utf8(desk.read("long.svg")).unwrap();
    let heading = svg.split_once(r#"<text class="heading""#).unwrap().1;
    let heading = heading.split_once("</text>").unwrap().0;
    let (whole, shown) = heading.split_once("</title>").unwrap();
    assert!(whole.contains(&name), "{heading}");
    assert!(
        shown.ends_with('…') && shown.chars().count() <= 86,
        "{shown}"
    );
    let count = |class: &str| {
        svg.matches(&format!(r#"<path class="{class}" data-pass"#))
            .count()
    };
    assert_eq!((count("lead"), count("lead back")), (1, 1));
}
