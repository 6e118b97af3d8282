//! Reading ISO: the meaning of lines and centres, the findings, and that an edited text equals a fresh reading.

mod corners;
mod edits;
mod numbers;
mod repairs;
mod variables;
mod writing;

use super::document::Document;
use super::moves::CenterRule;
use super::plain::words;
use super::word::{Number, Token, WordFault};
use crate::finding;
use crate::program::numbering::Renumbering;
use crate::program::path::Kind;
use crate::program::steps::Program;
use crate::settings::{Effective, SideSetting};
use repairs::fixed;

/// The lines and arcs that a program runs along.
fn way(text: &str) -> Vec<crate::geometry::Segment> {
    let steps = read(text).trace().steps.into_iter();
    steps.filter_map(|step| step.ideal).collect()
}

fn read(text: &str) -> Document {
    Document::read(text.as_bytes().to_vec())
}

/// Line (from 1) and rule of each finding.
fn faults(text: &str, settings: &Effective) -> Vec<(usize, &'static str)> {
    let document = Document::read_with(text.as_bytes().to_vec(), settings);
    let line = |finding: &crate::finding::Finding| match &finding.place {
        crate::finding::Place::Text { range } => document.text().line_of(range.start) + 1,
        _ => 0,
    };
    document
        .findings()
        .iter()
        .map(|finding| (line(finding), finding.rule.name()))
        .collect()
}

fn check(text: &str, expected: &[(usize, &str)]) {
    assert_eq!(faults(text, &Effective::default()), expected, "{text}");
}

/// A square of 10 mm with one rounded corner, cut from outside: absolute, from start to centre, µm.
const ROUNDED: &str = "%\nN10 G92 X-5000 Y0\nN20 G90\nG41 D1\nG01 X0 Y0\nY-10000\nX10000\nY-5000\nG03 X5000 Y0 I-5000 J0\nG01 X0\nG40\nX-5000\nM02\n%\n";

#[test]
fn a_right_program_has_no_fault() {
    check(ROUNDED, &[]);
}

#[test]
fn each_fault_is_named_at_its_line() {
    let body = "G92 X0 Y0\nG91\n";
    let with = |text: &str| format!("{body}{text}\nM02\n");
    check(
        &with("G01 X1000\nG01 X1000 Y\nG01 Y1000\nG01 X-2000 Y-1000"),
        &[(4, "syntax")],
    );
    check(
        &with("G01 X1000 Y0\nG02 X1000 Y0 I400 J0\nG01 X-2000 Y0"),
        &[(4, "arc-off-radius")],
    );
    check(
        &with("G01 X1000\nG02 X1000\nG01 X-2000"),
        &[(4, "arc-without-radius")],
    );
    check(
        &with("G01 X1000\nG02 X1000 I0 J0\nG01 X-2000"),
        &[(4, "arc-without-radius")],
    );
    check(
        &with("G01 X1000\nG01 Y1000\nG01 X-500\nG01 X-300"),
        &[(6, "not-closed")],
    );
    check(
        "G92 X0 Y0\nG91\nG01 X1000\nG01 Y1000\nG01 X-1000 Y-1000\n",
        &[(5, "missing-end")],
    );
    check(
        &(with("G01 X1000\nG01 Y1000\nG01 X-1000 Y-1000") + "G01 X5\nG01 X-5\n%\n"),
        &[(7, "text-after-end")],
    );
    check(
        &with("N1 G01 X1000\nN2 G01 Y1000\nN1 G01 X-1000 Y-1000"),
        &[(5, "block-number")],
    );
    check(
        &with("G61\nG60\nT84\nT85\nM50 G01 X1000\nG01 Y1000\nG01 X-1000 Y-1000"),
        &[
            (3, "machine-dependent"),
            (5, "machine-dependent"),
            (7, "machine-dependent"),
        ],
    );
    check(
        &with("G42 D1\nG03 X1000 I500 J0\nG01 Y1000\nG40\nG01 X-1000 Y-1000"),
        &[(4, "compensation-switch")],
    );
    check(
        &with("G42 D1\nG00 X1000\nG01 Y1000\nG01 X1000\nG01 X-1000 Y-1000\nG40\nG00 X-1000"),
        &[(4, "compensation-switch")],
    );
    // A full turn fits whatever I and J mean.
    check(
        &with("G01 X1000\nG03 X0 Y0 I-1000 J0\nG01 X-1000"),
        &[(4, "ambiguous-center")],
    );
    // Corners of 1 µm about centres in the coordinates of the program: about any other they would be lines.
    check(
        "G92 X0 Y0\nG60\nG38\nG90\nG01 X2.900 Y0.000\nG01 X2.900 Y8.525\nG03 X2.899 Y8.526 I2.899 J8.525\nG01 X-1.317 Y8.526\nG03 X-1.318 Y8.525 I-1.317 J8.525\nG01 X-1.318 Y-8.526\n\
         G03 X-1.317 Y-8.527 I-1.317 J-8.526\nG01 X2.899 Y-8.527\nG03 X2.900 Y-8.526 I2.899 J-8.526\nG01 X2.900 Y0.000\nG01 X0.000 Y0.000\nM02\n",
        &[],
    );
}

#[test]
fn a_cut_that_goes_through_itself_is_told_at_both_places() {
    // A bow tie, absolute and incremental, cut by the wire's own path and by the part's contour.
    let bow = |side: &str| {
        format!(
            "G92 X0. Y0.\nG90\n{side}\nG01 X10. Y0.\nX20. Y10.\nX20. Y0.\nX10. Y10.\nX10. Y0.\nG40\nX0. Y0.\nM02\n"
        )
    };
    check(&bow("G40"), &[(7, "path-crosses-itself")]);
    check(&bow("G41 D1"), &[(7, "path-crosses-itself")]);
    check(
        "G92 X0 Y0\nG91\nG01 X10000\nX10000 Y10000\nY-10000\nX-10000 Y10000\nY-10000\nX-10000\nM02\n",
        &[(6, "path-crosses-itself")],
    );
    let document = read(&bow("G40"));
    let finding = &document.findings()[0];
    assert_eq!(
        finding::sentence(finding, 1.0),
        "the wire crosses its own path of line 5 here, at (15.000, 5.000) mm from the contour's start: it cuts the part in two"
    );
    // An arc through a line; a line that only touches; the same contour twice, as in a second pass.
    check(
        "G92 X0. Y0.\nG91\nG01 X5.\nX10.\nG03 X-4. Y4. I-4. J0.\nG01 X-4. Y-8.\nX-7. Y4.\nM02\n",
        &[(6, "path-crosses-itself")],
    );
    check(
        "G92 X0. Y0.\nG90\nG01 X10. Y0.\nX20. Y10.\nX10. Y20.\nX15. Y10.\nX10. Y0.\nX0. Y0.\nM02\n",
        &[],
    );
    check(
        "G92 X0. Y0.\nG90\nG01 X5. Y0.\nY5.\nX0.\nY0.\nX5. Y0.\nY5.\nX0.\nY0.\nM02\n",
        &[],
    );
    // Other cuts lie elsewhere, whatever lies between them in the text; a cut with a wrong arc is not judged further.
    check(
        "G92 X0. Y0.\nG90\nG01 X9. Y9.\nX0.\nY0.\nM00\nG00 X0. Y5.\nG01 X9.\nY0.\nX0. Y5.\nM02\n",
        &[],
    );
    check(
        &bow("G40").replace("X20. Y0.\n", "X20. Y0.\nG02 X20. Y0. R0\nG01 "),
        &[(7, "arc-without-radius")],
    );
    // Far apart in the text, and beyond a stop.
    let mut long = String::from("G92 X0 Y0\nG91\nG01 X1000\n");
    (0..700).for_each(|step| long += if step % 2 == 0 { "X10\n" } else { "Y10\n" });
    long += "Y3000\nX-2000\nY-5000\nX700 Y-3000\nX1000 Y6000\nX-700\nM02\n";
    let found = faults(&long, &Effective::default());
    assert!(
        found
            .iter()
            .any(|(line, rule)| *rule == "path-crosses-itself" && *line == 708),
        "{found:?}"
    );
}

#[test]
fn the_wire_runs_where_the_role_and_its_way_in_say() {
    let opening = Effective {
        side: SideSetting::Opening,
        ..Effective::default()
    };
    let punch = Effective {
        side: SideSetting::Punch,
        ..Effective::default()
    };
    // From the middle of a square hole, counter-clockwise, the wire on the left.
    let hole = |word: &str| {
        format!(
            "G92 X0 Y0\nG90\n{word} D1\nG01 X5000 Y0\nY5000\nX-5000\nY-5000\nX5000\nY0\nG40\nX0\nM02\n"
        )
    };
    let check = |text: &str, settings: &Effective, expected: &[(usize, &str)]| {
        assert_eq!(faults(text, settings), expected, "{text}")
    };
    check(&hole("G41"), &Effective::default(), &[]);
    check(&hole("G41"), &opening, &[]);
    check(&hole("G41"), &punch, &[(3, "wrong-side")]);
    check(&hole("G42"), &opening, &[(3, "wrong-side")]);
    // The settings do not say what it is, but the wire comes from inside.
    check(&hole("G42"), &Effective::default(), &[(3, "wrong-side")]);
    let document = Document::read_with(hole("G42").into_bytes(), &opening);
    let finding = &document.findings()[0];
    assert_eq!(
        finding::sentence(finding, 1.0),
        "G42 puts the wire on the right, which is outside this contour: the settings say opening, so the wire cuts into the part"
    );
    let fix = &document.offered(finding, Renumbering::Offered)[0];
    let mut fixed = document.clone();
    fixed.edit(fix.edit[0].range.clone(), &fix.edit[0].text);
    assert_eq!(fixed.findings(), []);
}

#[test]
fn arcs_are_held_against_the_correction_under_compensation_only() {
    // A slot's end of R 0.09 mm, concave to a wire on the left.
    let program = |word: &str, table: &str| {
        format!(
            "{table}G92 X0 Y0\nG90\n{word}\nG01 X90 Y0\nY1000\nG03 X-90 Y1000 I-90 J0\nG01 Y-1000\nG03 X90 Y-1000 I90\nG01 Y0\nG40\nG01 X0\nM02\n"
        )
    };
    check(
        &program("G41 D1", ""),
        &[
            (5, "narrow-slot"),
            (5, "offset-collapse"),
            (6, "small-radius"),
            (8, "small-radius"),
        ],
    );
    // The wire outside.
    let outside = program("G42 D1", "")
        .replace("X0 Y0\nG90", "X500 Y0\nG90")
        .replace("G01 X0\n", "G01 X500\n");
    check(&outside, &[]);
    check(&program("G41 H1", "H1=80\n"), &[]);
    check(
        &program("G41 H1", "H1=95\n"),
        &[
            (6, "narrow-slot"),
            (6, "offset-collapse"),
            (7, "small-radius"),
            (9, "small-radius"),
        ],
    );
    check(&program("G40", ""), &[]);
    let none = Effective {
        compensation: crate::settings::Compensation::None,
        ..Effective::default()
    };
    assert_eq!(
        faults(&program("G40", ""), &none),
        [(6, "small-radius"), (8, "small-radius")]
    );
    let punch = Effective {
        side: SideSetting::Punch,
        ..none
    };
    assert_eq!(faults(&program("G40", ""), &punch), []);
}

/// Programs in the forms of the field's machines, found in their programs and manuals: the only findings are the
/// machine's own words.
#[test]
fn the_dialects_of_the_field_are_no_faults() {
    let square = "G01 X10.000 Y0.000\nG01 X10.000 Y10.000\nG01 X0.000 Y10.000\nG01 X0.000 Y0.000\n";
    for text in [
        // Rough and skim pass in one go, conditions by E, the wire threaded and fed by M words.
        format!("%\nO0001 (ROBOCUT)\nG90 G21\nG92 X0 Y0\nE0001 (ROUGH)\nM06\nM50\nM80 M81\nG42 H01 (RIGHT)\n{square}G40\nE0002\nG42 H02\n{square}G40\nM82 M83\nM51\nM02\n%\n"),
        // The taper, and conditions by C.
        format!("%\nO0010\nG90 G21\nG92 X0. Y0.\nC100 (IP8 ON12)\nM50\nG51 U3.500\nG42 D01\n{square}G40\nG50\nM51\nM02\n%\n"),
        // Fast wire: pump and wire switched by T words, blocks that end with a semicolon, a subprogram for each pass.
        "N10 T84 T86 G90 G92X0.000Y0.000;\nN12 G01 X5.000Y0.000;\nN14 G03 X-5.000 Y0.000 I-5.000 J0.000;\nN16 G03 X5.000 Y0.000 I5.000 J0.000;\nN18 G01 X0.000 Y0.000;\nN20 T85 T87 M02;\n".into(),
        "H000=+00000000 H001=+00000110;\nH005=+00000000;T84 T86 G54 G90 G92X+0Y+0;\nC007;\nG01X+3000Y+0;G04X0.0+H005;\nG41H000;\nC001;\nG41H000;\nG01X+4000Y+0;G04X0.0+H005;\nG41H001;\nX+4000Y+4000;\nX-4000Y+4000;\nX-4000Y-4000;\nX+4000Y-4000;\nX+4000Y+0;\nG40H000G01X+3000Y+0;\nM00;\nT85 T87 M02;\n".into(),
        // Robofil: the centre's own coordinates, the prologue before G90.
        "G92 X0 Y0\r\nG60\r\nG38\r\nG42 D0\r\nG90\r\nG01 X10.000 Y0.000\r\nG02 X0.000 Y-10.000 I0.000 J0.000\r\nG02 X10.000 Y0.000 I0.000 J0.000\r\nG40\r\nG01 X0.000 Y0.000\r\nM02\r\n".into(),
        // Numbers without zeros, R in the place of I and J, M30.
        "%\nN1G21G90\nN2G92X-5.Y0\nN3G42D1\nN4G1X0.Y0\nN5Y-9.\nN6G3X1.Y-10.R1.\nN7G1X9.\nN8G3X10.Y-9.R1.\nN9G1Y0\nN10X0.\nN11G40\nN12X-5.\nN13M30\n%\n".into(),
    ] {
        let found = faults(&text, &Effective::default());
        assert!(found.iter().all(|(_, rule)| *rule == "machine-dependent"), "{found:?}\n{text}");
    }
}

/// A plate of 40 by 20 with corners of R 2, cut from a hole in it: absolute, in mm.
const PLATE: &str = "G92 X20.000 Y5.000\nG90\nG01 X20.000 Y0.000\nG01 X38.000 Y0.000\nG03 X40.000 Y2.000 I0.000 J2.000\nG01 X40.000 Y18.000\nG03 X38.000 Y20.000 I-2.000 J0.000\nG01 X2.000 Y20.000\nG03 X0.000 Y18.000 I0.000 J-2.000\nG01 X0.000 Y2.000\nG03 X2.000 Y0.000 I2.000 J0.000\nG01 X20.000 Y0.000\nG01 X20.000 Y5.000\nM02\n";

#[test]
fn compensation_and_subprograms_are_ended_and_complete() {
    let hole = |on: &str, mid: &str, off: &str| {
        format!(
            "G92 X0 Y0\nG90\n{on}\nG01 X5000 Y0\nY5000\n{mid}X-5000\nY-5000\nX5000\nY0\n{off}X0\nM02\n"
        )
    };
    check(&hole("G41 D1", "", "G40\n"), &[]);
    check(&hole("G41", "", "G40\n"), &[(3, "missing-offset")]);
    check(&hole("D3\nG41", "", "G40\n"), &[]);
    check(&hole("G41 D1", "G42\n", "G40\n"), &[(6, "side-change")]);
    check(&hole("G41 D1", "", ""), &[(11, "missing-cancel")]);
    assert_eq!(
        fixed(
            &hole("G41 D1", "G42\n", "G40\n"),
            "side-change",
            "Let the wire"
        ),
        hole("G41 D1", "G41\n", "G40\n")
    );
    assert_eq!(
        fixed(
            &hole("G41 D1", "", ""),
            "missing-cancel",
            "Insert the block G40"
        ),
        hole("G41 D1", "", "G40\n")
    );
    let two = |on: &str| {
        hole(on, "", "G40\n").replace("M02\n", "") + "M00\n" + &hole("G41 D1", "", "G40\n")
    };
    assert_eq!(
        fixed(&two("G41"), "missing-offset", "Write D1"),
        two("G41 D1")
    );
    let sub = |end: &str| format!("G92 X0 Y0\nM98 P1\nM02\nO1\nG01 X1000\nY1000\nX0 Y0{end}\n");
    check(&sub("\nM99"), &[]);
    check(&sub(""), &[(7, "missing-return")]);
    assert_eq!(
        fixed(&sub(""), "missing-return", "Insert the block M99"),
        sub("\nM99")
    );
}

#[test]
fn ways_that_come_back_are_no_faults() {
    // The next pass, back along the same contour, has the wire on its other side: from where the first began.
    check(
        "G92 X0. Y0.\nG90\nG41 D1\nG01 X5. Y0.\nY5.\nX-5.\nY-5.\nX5.\nY0.\nG42 D1\nY-5.\nX-5.\nY5.\nX5.\nY0.\nG40\nX0.\nM02\n",
        &[],
    );
    // A lens: two arcs about two centres that nearly turn back on each other.
    check(
        "G92 X99. Y-9.\nG90\nG01 X99. Y0.\nG03 X-99. Y0. I-99. J-4900.\nG03 X99. Y0. I99. J4900.\nG01 X108. Y9.\nM02\n",
        &[],
    );
}
