//! What `draw`, `holes`, `report` and `generate` say of a pair: the parts that `wedm pair` cuts.

use super::{Desk, check};

/// A square from a corner, with rounded corners.
fn square(handle: &str, layer: &str, from: f64, size: f64) -> String {
    let to = from + size;
    let round = 1.0 - from;
    let bulge = (std::f64::consts::PI / 8.0).tan();
    let vertices = [
        (from + round, from, 0.0),
        (to - round, from, bulge),
        (to, from + round, 0.0),
        (to, to - round, bulge),
        (to - round, to, 0.0),
        (from + round, to, bulge),
        (from, to - round, 0.0),
        (from, from + round, bulge),
    ];
    let vertex = |(x, y, bulge): &(f64, f64, f64)| format!("10\n{x}\n20\n{y}\n42\n{bulge}\n");
    let vertices: String = vertices.iter().map(vertex).collect();
    format!("0\nLWPOLYLINE\n5\n{handle}\n8\n{layer}\n90\n8\n70\n1\n{vertices}")
}

fn drawing(entities: &[String]) -> String {
    let header = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n";
    let entities = entities.concat();
    format!("{header}0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n")
}

const WIRE: &str = "wire-diameter = 0.18\ngap = 0.01\njob.thickness = 40\n[passes]\ncorrections = [0.16, 0.1]\nrates = [100, 100]\n";

/// One contour that is cut twice, in the folder `twice`, and one drawn for each part, in `drawn`; each with the names of its parts.
const PAIRS: [(&str, [&str; 2]); 2] = [("twice", ["punch", "plate"]), ("drawn", ["DIE", "STAMP"])];

fn desk() -> Desk {
    let desk = Desk::new();
    desk.write("twice/a.dxf", drawing(&[square("2A", "0", 0.0, 20.0)]));
    let twice = "[pair]\ndrawn-as = \"punch\"\nclearance = 0.01\n";
    desk.write("twice/wedm.toml", format!("{WIRE}{twice}"));
    let both = [
        square("2A", "STAMP", 0.0, 20.0),
        square("2B", "DIE", -0.02, 20.04),
    ];
    desk.write("drawn/a.dxf", drawing(&both));
    let drawn = "[layers]\nSTAMP = \"punch\"\nDIE = \"opening\"\n[pair]\nclearance = 0.02\n\
                 [workpieces]\nSTAMP = [\"STAMP\"]\nDIE = [\"DIE\"]\n";
    desk.write("drawn/wedm.toml", format!("{WIRE}{drawn}"));
    desk
}

/// The text of a program in a page, without what leads to it.
fn program(desk: &Desk, name: &str) -> String {
    String::from_utf8(desk.read(name))
        .unwrap()
        .trim_end()
        .to_owned()
}

#[test]
fn a_page_has_paths_totals_holes_and_program_of_each_part() {
    let desk = desk();
    for (folder, parts) in PAIRS {
        check(&desk, &format!("pair {folder}/a.dxf"), 0, &[]);
        check(
            &desk,
            &format!("report {folder}/a.dxf -o {folder}/pages"),
            0,
            &[],
        );
        let page = program(&desk, &format!("{folder}/pages/a.html"));
        assert!(!page.contains("class=\"error\""), "{page}");
        for part in parts {
            let own = page.split(&format!("<h1>{part}</h1>")).nth(1);
            let own = own.unwrap_or_else(|| panic!("no {part} in {page}"));
            let text = program(&desk, &format!("{folder}/a-{part}.3b"));
            let head = ["Passes", "Time and material", "Start holes", " min"];
            for content in head.into_iter().chain([text.as_str()]) {
                assert!(own.contains(content), "no {content} of {part} in {own}");
            }
        }
    }
}

#[test]
fn a_picture_and_a_drawing_hold_the_path_of_each_part() {
    let desk = desk();
    for (folder, parts) in PAIRS {
        let svg = desk.run(&format!("draw {folder}/a.dxf")).stdout;
        desk.run(&format!("draw {folder}/a.dxf -o {folder}/path.dxf"));
        let paths = String::from_utf8(desk.read(&format!("{folder}/path.dxf"))).unwrap();
        for part in parts {
            assert!(
                svg.contains(&format!("<title>{part}: path of the wire")),
                "{part}: {svg}"
            );
            for layer in [format!("\nWIRE-{part}"), format!("\nWIRE2-{part}")] {
                let is_there = paths.replace('\r', "").contains(&format!("{layer}\n"));
                assert!(is_there, "no {layer} in {paths}");
            }
        }
        let first = if folder == "twice" { "0.150" } else { "0.160" };
        let told = format!("{}: correction {first} / ", parts[1]);
        assert!(svg.contains(&told), "no {told}: {svg}");
    }
}

#[test]
fn the_drill_list_names_the_part_of_each_hole() {
    let desk = desk();
    check(
        &desk,
        "holes twice/a.dxf drawn/a.dxf",
        0,
        &[
            "contour,hole,part,number\n",
            "twice/a.dxf,10.0000,-3.0000,,2A,found,punch,1\n",
            "twice/a.dxf,10.0000,3.0000,,2A,found,plate,2\n",
            ",2B,found,DIE,1\n",
            "drawn/a.dxf,10.0000,-3.0000,,2A,found,STAMP,2\n",
        ],
    );
    check(
        &desk,
        "holes twice/a.dxf -o holes.dxf",
        2,
        &["!the holes of a pair are written as .csv"],
    );
}

/// One program cannot cut several parts; that of one that is drawn is the one that `wedm pair` writes.
#[test]
fn a_program_is_that_of_one_part() {
    let desk = desk();
    for (folder, parts) in PAIRS {
        let command = format!("`wedm pair {folder}/a.dxf` writes them");
        let told = [format!("!{}", parts.join(", ")), format!("!{command}")];
        check(
            &desk,
            &format!("generate {folder}/a.dxf"),
            1,
            &[&told[0], &told[1]],
        );
    }
    check(&desk, "pair drawn/a.dxf", 0, &[]);
    let alone = desk.run("generate drawn/a.dxf --layer STAMP");
    assert_eq!(alone.code, Some(0), "{alone:?}");
    assert_eq!(alone.stdout.trim_end(), program(&desk, "drawn/a-STAMP.3b"));
}

/// Without a clearance the drawn workpieces are no pair, and still no lead meets a contour of the other.
#[test]
fn leads_meet_no_contour_of_another_workpiece() {
    let desk = desk();
    let settings = program(&desk, "drawn/wedm.toml");
    let settings = settings.replace("[pair]\nclearance = 0.02\n", "");
    desk.write("drawn/wedm.toml", settings);
    check(
        &desk,
        "generate drawn/a.dxf",
        0,
        &["!the wire is threaded at"],
    );
    check(
        &desk,
        "holes drawn/a.dxf --start-hole 2",
        0,
        &[",2A,found,1\n", ",2B,found,2\n"],
    );
}

/// An option for the side wins over the pair of a `wedm.toml`, and options for the pair over its side.
#[test]
fn an_option_wins_over_the_pair() {
    let desk = desk();
    let generate = "generate twice/a.dxf -o - --format 3b";
    check(&desk, generate, 1, &["!it is a pair"]);
    let alone = |side: &str| {
        desk.write("alone/wedm.toml", WIRE);
        desk.write("alone/a.dxf", desk.read("twice/a.dxf"));
        desk.run(&format!(
            "generate alone/a.dxf -o - --format 3b --side {side}"
        ))
    };
    for side in ["opening", "punch", "auto"] {
        let made = desk.run(&format!("{generate} --side {side}"));
        assert_eq!(made.code, Some(0), "{made:?}");
        assert_eq!(made.stdout, alone(side).stdout);
        check(&desk, &format!("check twice/a.dxf --side {side}"), 0, &[]);
    }
    check(
        &desk,
        &format!("{generate} --side both"),
        1,
        &["!it is a pair"],
    );
    // A pair is cut on both sides: there is none on one.
    check(
        &desk,
        "pair twice/a.dxf --side punch",
        2,
        &["!--side: side is \"punch\""],
    );
    check(
        &desk,
        "fit twice/a.dxf --side punch",
        2,
        &["!--side: side is \"punch\""],
    );
    desk.write("alone/wedm.toml", format!("side = \"opening\"\n{WIRE}"));
    let pair =
        "pair alone/a.dxf -o out --drawn-as plate --clearance 0.01 --gap 0.01 --wire-diameter 0.18";
    check(
        &desk,
        pair,
        0,
        &["!a-punch.3b", "!a-plate.3b", "!both sides (default)"],
    );
}
