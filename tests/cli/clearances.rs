//! The clearance of a pair beside the corrections of its passes.

use super::Desk;

/// The corrections of each part, and what is said of the side on which its wire runs.
#[test]
fn a_clearance_above_corrections_of_several_passes_is_made() {
    let wire = "--wire-diameter 0.26 --gap 0.02 --passes 0.2,0.15";
    for (pair, part, corrections, says) in [
        (
            "--drawn-as punch --clearance 0.3",
            "plate",
            "0.1000 / 0.1500",
            "on what is drawn or on its other side",
        ),
        (
            "--drawn-as plate --clearance 0.3",
            "punch",
            "0.1000 / 0.1500",
            "on what is drawn or on its other side",
        ),
        (
            "--drawn-as punch --clearance 0.17",
            "plate",
            "0.0300 / -0.0200",
            "on the other side of what is drawn in pass 2",
        ),
        (
            "--drawn-as punch --clearance 0.15",
            "plate",
            "0.0500 / 0.0000",
            "",
        ),
        (
            "--drawn-as plate --clearance 0.01 --stripper 0.3",
            "stripper",
            "0.0900 / 0.1400",
            "on what is drawn or on its other side",
        ),
    ] {
        let desk = Desk::new();
        let made = desk.run(&format!("pair clean.dxf {wire} {pair}"));
        let told = format!("{part}, correction {corrections} mm");
        assert!(
            made.code == Some(0) && made.stderr.contains(&told) && made.stderr.contains(says),
            "{pair}: {made:?}"
        );
    }
}

/// A control offsets a contour to one side: where passes run on both, that is said before anything is made, by `check`, too.
#[test]
fn passes_on_both_sides_are_refused_where_the_control_offsets() {
    let says =
        "pair.clearance 0.17 mm lies between the corrections 0.2, 0.15: some passes of the plate";
    let desk = Desk::new();
    let wire =
        "--wire-diameter 0.26 --gap 0.02 --passes 0.2,0.15 --drawn-as punch --clearance 0.17";
    for command in [
        format!("pair clean.dxf {wire} --format iso --compensation controller"),
        format!("pair clean.dxf {wire} --format 4b"),
    ] {
        let refused = desk.run(&command);
        assert!(
            refused.code != Some(0) && refused.stderr.contains(says),
            "{refused:?}"
        );
    }
    desk.write(
        "wedm.toml",
        "wire-diameter = 0.26\ngap = 0.02\nprogram.compensation = \"controller\"\n[passes]\ncorrections = [0.2, 0.15]\n\
         [pair]\ndrawn-as = \"punch\"\nclearance = 0.17\n",
    );
    let checked = desk.run("check clean.dxf");
    assert!(
        checked.code == Some(1) && checked.stdout.contains(says),
        "{checked:?}"
    );
}

/// Workpieces whose names become one name of a file are refused before anything is written.
#[test]
fn two_parts_never_share_a_file() {
    for (one, other, is_made) in [
        ("a b", "a_b", false),
        ("Die", "die", false),
        ("a", "b", true),
    ] {
        let desk = Desk::new();
        let circle = |handle: &str, layer: &str, radius: &str| {
            format!("0\nCIRCLE\n5\n{handle}\n8\n{layer}\n10\n0.0\n20\n0.0\n40\n{radius}\n")
        };
        let (punch, plate) = (circle("2A", "PU", "5.0"), circle("2B", "PL", "5.02"));
        desk.write(
            "x.dxf",
            format!("0\nSECTION\n2\nENTITIES\n{punch}{plate}0\nENDSEC\n0\nEOF\n"),
        );
        desk.write(
            "wedm.toml",
            format!(
                "wire-diameter = 0.18\ngap = 0.01\nunits = \"mm\"\npair.clearance = 0.02\n\
                 [workpieces]\n\"{one}\" = [\"PU\"]\n\"{other}\" = [\"PL\"]\n"
            ),
        );
        let made = desk.run("pair x.dxf -o out --overwrite");
        let said = format!("the parts {one} and {other} would both be written to this file");
        assert_eq!(made.code, Some(i32::from(!is_made) * 2), "{made:?}");
        assert_eq!(made.stderr.contains(&said), !is_made, "{made:?}");
        assert_eq!(desk.path("out").exists(), is_made, "{made:?}");
    }
}
