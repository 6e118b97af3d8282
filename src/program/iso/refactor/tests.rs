//! Each refactoring leads where it should. The cursor is `|` in the text.

use crate::geometry::{Point, Segment};
use crate::program::Language;
use crate::program::iso::document::Document;
use crate::program::numbering::Numbers;
use crate::program::refactor::tests;
use crate::text::edited;
use proptest::prelude::*;

fn read(text: &str) -> Document {
    Document::read(text.as_bytes().to_vec())
}

fn after(text: &str, id: &str) -> Result<String, String> {
    tests::refactored(Language::Iso, id, text)
}

fn scaled_by(text: &str, factor: f64) -> Result<String, String> {
    tests::scaled_by(Language::Iso, text, factor)
}

#[track_caller]
fn check(id: &str, text: &str, expected: &str) {
    tests::check(Language::Iso, id, text, expected);
}

#[track_caller]
fn refuses(id: &str, text: &str, expected: &str) {
    tests::refused(Language::Iso, id, text, expected);
}

/// A hole of R 5 with a flat, from its middle: absolute, start to centre.
const HOLE: &str = "%\nN1 G92 X0. Y0. ; start\nN2 G90\nN3 G41 D1\nN4 G01 X5. Y0. F3.\nN5 G03 X0. Y5. I-5. J0. (quarter)\nN6 G01 X-5. Y0.\nN7 G03 X5. Y0. I5. J0.\nN8 G40\nN9 G01 X0. Y0.\nM02\n%\n";

#[test]
fn contours_are_cut_the_other_way() {
    check(
        "reverse",
        HOLE,
        "%\nN1 G92 X0. Y0. ; start\nN2 G90\nN3 G42 D1\nN4 G01 X5. Y0. F3.\nN5 G02 X-5. Y0. I-5. J0. (quarter)\nN6 G01 X0. Y5.\nN7 G02 X5. Y0. I0. J-5.\nN8 G40\nN9 G01 X0. Y0.\nM02\n%\n",
    );
    refuses(
        "reverse",
        "G91\nG01 X5.\nG01 Y5.\nG01 X-4.\nG01 Y-4.\nM02\n",
        "is open",
    );
    refuses(
        "reverse",
        "G01 X5.\nG03 X6. I4. J0.\nM02\n",
        "line 2: the arc leads nowhere",
    );
    refuses("reverse", "M98 P5\nM02\nN5 G01 X5.\nM99\n", "subprograms");
}

#[test]
fn a_contour_begins_where_the_cursor_stands() {
    check(
        "startHere",
        "G92 X0 Y0\nG90\nG01 X5 Y5\nG01 X5 Y-5\n|X-5\nY5\nX5\nX0 Y0\nM02\n",
        "G92 X0 Y0\nG90\nG01 X5 Y-5\nG01 X-5 Y-5\nX-5 Y5\nX5 Y5\nX5 Y-5\nX0 Y0\nM02\n",
    );
    refuses(
        "startHere",
        "G92 X0 Y20\nG90\nG01 X0 Y10\nX10\nY0\n|X-10\nY10\nX0\nG01 X0 Y20\nM02\n",
        "would cut the contour in line",
    );
    refuses(
        "startHere",
        "G92 X0 Y0\nG90\n|G01 X5 Y5\nX5 Y-5\nX-5\nY5\nX5\nX0 Y0\nM02\n",
        "expected one of the contour",
    );
}

#[test]
fn programs_are_mirrored_and_turned_about_their_zero() {
    check(
        "mirror.x",
        HOLE,
        "%\nN1 G92 X0. Y0. ; start\nN2 G90\nN3 G42 D1\nN4 G01 X-5. Y0. F3.\nN5 G02 X0. Y5. I5. J0. (quarter)\nN6 G01 X5. Y0.\nN7 G02 X-5. Y0. I-5. J0.\nN8 G40\nN9 G01 X0. Y0.\nM02\n%\n",
    );
    check(
        "rotate.left",
        "G92 X3. Y1.5\nG01 X5.\nG03 Y5.5 X5. I0. J2.\nM02\n",
        "G92 X-1.5 Y3.\nG01 Y5.\nG03 Y5. X-5.5 I-2. J0.\nM02\n",
    );
    check(
        "rotate.half",
        "G91\nG01 X5 Y-3\nG02 X4 R-2\nM02\n",
        "G91\nG01 X-5 Y3\nG02 X-4 R-2\nM02\n",
    );
    refuses(
        "rotate.left",
        "G91\nG01 X5 U1\nM02\n",
        "line 2: the moves of the upper guide",
    );
    refuses("mirror.y", "G51 A1.\nG01 X5.\nM02\n", "a taper");
}

#[test]
fn what_would_part_the_upper_guide_from_the_wire_is_refused() {
    let square = |words: &str| {
        format!("G92 X0 Y0\nG90\nG01 X5. Y0.\n{words}Y5.\n|X-5.\nY-5.\nX5.\nY0.\nX0.\nM02\n")
    };
    for (words, about) in [
        ("U1. V0.\n", "the upper guide"),
        ("X5. U.5 ", "the upper guide"),
        ("G01 X5. Y2. : X5. Y2.1\n", ""),
    ] {
        for id in ["reverse", "coordinates.incremental", "startHere", "profile"] {
            refuses(id, &square(words), about);
        }
    }
    for words in ["G51 A1.\n", "G52 T2.\n", "G140 A1.\n"] {
        for id in ["reverse", "startHere", "profile"] {
            refuses(id, &square(words), "a taper");
        }
    }
    // Before the way in a taper is in force all the same: at a corner the upper end would begin beside its profile.
    let ahead = |words: &str, begin: &str| {
        let before = "G92 X10. Y5.\nG90\n";
        let (mut contour, mut lines) = (String::new(), 0);
        for line in ["X20.\n", "Y10.\n", "X10.\n", "X0.\n", "Y0.\n", "X10.\n"] {
            lines += 1;
            let here = if begin == line && lines > 1 { "|" } else { "" };
            contour += &format!("{here}{line}");
        }
        format!("{before}{words}G01 X10. Y0.\n{contour}G50\nG01 Y5.\nM02\n")
    };
    for words in ["G51 A2.\n", "G52 A2.\n", "G142 A2.\n", "G50\nG51 A2.\n"] {
        refuses("startHere", &ahead(words, "Y10.\n"), "beside that corner");
        assert!(
            after(&ahead(words, "X0.\n"), "startHere").is_ok(),
            "{words}"
        );
    }
    for words in ["", "G51 A2.\nG50\n", "(G51 A2.)\n"] {
        assert!(
            after(&ahead(words, "Y10.\n"), "startHere").is_ok(),
            "{words}"
        );
    }
    // In a comment they mean nothing.
    let harmless = square("(U1 G51) ");
    assert!(after(&harmless, "reverse").is_ok());
    assert!(scaled_by("G91\nG01 X5. U1.\nM02\n", 2.0).is_err());
}

#[test]
fn the_stop_before_a_tab_stays_where_it_is() {
    let text =
        "G92 X0 Y0\nG90\nG01 X4. Y0.\nY5.\n|X24.\nY-15.\nX4.\nY-3.\nM00\nG01 Y0.\nX0.\nM02\n";
    for id in ["reverse", "startHere"] {
        refuses(id, text, "the contour pauses before line 10");
    }
    refuses(
        "profile",
        text,
        "line 9: the stop before the tab would be lost",
    );
}

#[test]
fn coordinates_become_absolute_and_back() {
    let absolute = "G92 X1. Y2.\nG90\nG01 X5. Y2.\nY7.\nG03 X3. Y9. I-2. J0.\nG01 X1.\nY2.\nM02\n";
    let incremental =
        "G92 X1. Y2.\nG91\nG01 X4. Y0.\nY5.\nG03 X-2. Y2. I-2. J0.\nG01 X-2.\nY-7.\nM02\n";
    check("coordinates.incremental", absolute, incremental);
    check("coordinates.absolute", incremental, absolute);
    check("coordinates.absolute", absolute, absolute);
    // Where nothing says G90, G91 is put before the first move.
    check(
        "coordinates.incremental",
        "N1 G92 X1 Y0\nN2 G01 X5\nN3 X7\n",
        "N1 G92 X1 Y0\nN2 G91 G01 X4\nN3 X2\n",
    );
}

#[test]
fn centres_are_written_in_every_convention() {
    let to_center = "G90\nG01 X5. Y0.\nG03 X0. Y5. I-5. J0.\nG01 Y8.\nG02 X2. Y10. I2.\nM02\n";
    let to_start = "G90\nG01 X5. Y0.\nG03 X0. Y5. I5. J0.\nG01 Y8.\nG02 X2. Y10. I-2. J0.\nM02\n";
    let absolute = "G90\nG01 X5. Y0.\nG03 X0. Y5. I0. J0.\nG01 Y8.\nG02 X2. Y10. I2.\nM02\n";
    check("centers.centerToStart", to_center, to_start);
    check("centers.absolute", to_center, absolute);
    check("centers.startToCenter", absolute, to_center);
    check("centers.startToCenter", to_center, to_center);
    refuses(
        "centers.absolute",
        "G91\nG03 X-5. Y5. I-5. J0.\nM02\n",
        "under G91",
    );
    // A full circle alone does not show its convention.
    refuses(
        "centers.centerToStart",
        "G90\nG01 X5. Y0.\nG03 X5. Y0. I-5. J0.\nM02\n",
        "would no longer tell",
    );
}

#[test]
fn blocks_are_numbered_and_calls_follow() {
    check(
        "number",
        "%\nG92 X0 Y0\nM98 P7\n(note)\nM02\nN7 G01 X1\nN7000 M99\n",
        "%\nN10 G92 X0 Y0\nN20 M98 P40\n(note)\nN30 M02\nN40 G01 X1\nN50 M99\n",
    );
    check(
        "withoutNumbers",
        "N1 G01 X5\nN2 M98 P7\nN3 M02\nN7 X1\nN8 M99\n",
        "G01 X5\nM98 P7\nM02\nN7 X1\nM99\n",
    );
    refuses("number", "N1 G01 X5\nGOTO 1\nM02\n", "GOTO");
    let document = read("M98 P7\nM02\nN7 G01 X1\nN8 M99\n");
    let edits = document.renamed(12..13, 7, "70", 70).unwrap();
    assert_eq!(
        String::from_utf8(edited(document.text().bytes(), &edits).unwrap()).unwrap(),
        "M98 P70\nM02\nN70 G01 X1\nN8 M99\n"
    );
    assert_eq!(
        document.renamed(12..13, 7, "8", 8),
        Err("N8 is the block in line 4".into())
    );
}

#[test]
fn the_planes_of_a_taper_go_into_another_unit_and_are_scaled_by_nothing_else() {
    let tapered = "TP0.0\nTN1.25\nG92 X0. Y0.\nG51 A2.\nG01 X1.0000 Y0.\nG50\nG01 X0. Y0.\nM02\n";
    let in_mm = after(tapered, "scale.inchToMm").unwrap();
    let other = in_mm.lines().nth(1);
    assert_eq!(other, Some("TN31.75"), "{in_mm}");
    let refused = scaled_by(tapered, 2.0).unwrap_err();
    assert!(refused.contains("TP, TN"), "{refused}");
}

#[test]
fn programs_are_scaled_and_stay_in_their_steps() {
    // An arc whose ends would meet becomes no circle.
    let arc =
        "G92 X0 Y0\nG01 X5.000 Y0.000\nG03 X5.000 Y0.010 I-5.000 J0.005\nG01 X0.000 Y0.000\nM02\n";
    refuses("scale.mmToInch", arc, "becomes shorter");
    // One step of R near a half turn moves its middle by ten.
    let bow = "G90\nG92X15.189Y15.318\nG21\nG01X12.767Y12.67\nG03X-12.016Y-7.469R-16.014\nG01X-6.793Y-16.164\nG01X12.767Y12.67\nG01X15.189Y15.318\nM02\n";
    refuses("scale.mmToInch", bow, "line 5: its arc cannot be written");
    assert_eq!(
        scaled_by(
            "H1=110\nG92 X0 Y1000\nG91\nG01 X5000\nG03 X5000 Y5000 J5000\nM02\n",
            0.5
        )
        .as_deref(),
        Ok("H1=110\nG92 X0 Y500\nG91\nG01 X2500\nG03 X2500 Y2500 I0 J2500\nM02\n")
    );
    assert_eq!(
        scaled_by("G90\nG01 X1.\nG02 X3. R1.\nM02\n", 25.4).as_deref(),
        Ok("G90\nG01 X25.4\nG02 X76.2 R25.4\nM02\n")
    );
    assert!(
        scaled_by("G01 X1.\n", 0.0)
            .unwrap_err()
            .contains("expected one between")
    );
    assert!(
        scaled_by("G01 X1.\nG28 X0. Y0.\n", 2.0)
            .unwrap_err()
            .contains("line 2")
    );
}

#[test]
fn a_program_is_written_anew_as_each_profile_has_it() {
    let found = tests::proposed(
        Language::Iso,
        "profile",
        "G92 X0. Y0.\nG91\nG01 X5. ; in\nG03 X-10. I-5.\nX10. I5.\nG01 X-5.\nM02\n",
    );
    let of = |name: &str| {
        let proposal = found
            .iter()
            .find(|proposal| proposal.title.contains(name))
            .unwrap();
        proposal.edits.clone().unwrap()[0].text.clone()
    };
    assert_eq!(found.len(), 3);
    assert!(
        of("robofil").contains("G03 X-5.000 Y0.000 I0.000 J0.000\r\n"),
        "{}",
        of("robofil")
    );
    assert!(
        of("fast-wire").contains("G91\nG01 X5000 Y0\nG03 X-10000 Y0 I-5000 J0\n"),
        "{}",
        of("fast-wire")
    );
}

/// A closed cut of lines and arcs with a way in and out; in mm with three decimals or in µm.
fn program() -> impl Strategy<Value = String> {
    let corner = (any::<bool>(), 400_i64..2_000, 0_usize..3);
    (
        prop::collection::vec(corner, 3..9),
        any::<bool>(),
        any::<bool>(),
        prop::sample::select(vec!["G41 D1", "G42 D1", "G40"]),
    )
        .prop_map(|(corners, fine, incremental, side)| {
            // A staircase outwards along the corners of a polygon, with quarter turns between its lines.
            let mut at = [0_i64, 0];
            let mut steps: Vec<([i64; 2], Option<[i64; 2]>, bool)> = vec![([1000, 0], None, false)];
            at[0] += 1000;
            for (arc, size, turn) in &corners {
                let by = [[*size, *size], [-*size, *size], [*size, -*size]][*turn];
                let center = arc.then(|| [at[0], at[1] + by[1]]);
                // About a centre straight above or below: counter-clockwise where it turns left.
                let left = (by[0] > 0) == (by[1] > 0);
                at = [at[0] + by[0], at[1] + by[1]];
                steps.push((at, center, left));
            }
            steps.push(([1000, 0], None, false));
            steps.push(([0, 0], None, false));
            let number = |um: i64| {
                if fine {
                    um.to_string()
                } else {
                    format!("{:.3}", um as f64 / 1e3)
                }
            };
            let mut text = format!(
                "G92 X{0} Y{0}\n{1}\n{side}\n",
                number(0),
                if incremental { "G91" } else { "G90" }
            );
            let mut from = [0_i64, 0];
            let count = steps.len();
            for (index, (to, center, left)) in steps.into_iter().enumerate() {
                if index + 1 == count {
                    text += "G40\n";
                }
                let base = if incremental { from } else { [0, 0] };
                let motion = match (center, left) {
                    (None, _) => "G01",
                    (Some(_), true) => "G03",
                    (Some(_), false) => "G02",
                };
                text += &format!(
                    "{motion} X{} Y{}",
                    number(to[0] - base[0]),
                    number(to[1] - base[1])
                );
                if let Some(center) = center {
                    text += &format!(
                        " I{} J{}",
                        number(center[0] - from[0]),
                        number(center[1] - from[1])
                    );
                }
                text += "\n";
                from = to;
            }
            text + "M02\n"
        })
}

fn way(text: &str) -> Vec<Segment> {
    read(text)
        .trace()
        .steps
        .into_iter()
        .filter_map(|step| step.ideal)
        .collect()
}

fn apart(one: &[Segment], other: &[Segment]) -> f64 {
    assert_eq!(one.len(), other.len());
    let points = |segment: &Segment| [0.0, 0.3, 0.5, 1.0].map(|share| segment.point_at(share));
    one.iter()
        .zip(other)
        .flat_map(|(a, b)| points(a).into_iter().zip(points(b)))
        .map(|(a, b)| (a - b).norm())
        .fold(0.0, f64::max)
}

proptest! {
    #[test]
    fn the_way_stays_or_changes_exactly(text in program()) {
        let before = way(&text);
        // These write the same way otherwise.
        for id in ["coordinates.absolute", "coordinates.incremental", "centers.startToCenter", "centers.centerToStart", "centers.absolute", "number"] {
            if let Ok(text) = after(&text, id) {
                prop_assert!(apart(&way(&text), &before) < 1e-6, "{id}: {text}");
            }
        }
        // There and back gives the same text where nothing was left out.
        let turned = after(&text, "rotate.left").unwrap();
        let quarter = |point: Point| Point::new(-point.y, point.x);
        let ends = |way: &[Segment]| way.iter().map(Segment::end).collect::<Vec<_>>();
        prop_assert_eq!(ends(&way(&turned)), ends(&before).into_iter().map(quarter).collect::<Vec<_>>());
        prop_assert_eq!(&after(&turned, "rotate.right").unwrap(), &text);
        let mirrored = after(&text, "mirror.x").unwrap();
        prop_assert_eq!(&after(&mirrored, "mirror.x").unwrap(), &text);
        // Reversed, the contour has the same points in the other order; reversed again it is the same way.
        let reversed = after(&text, "reverse").unwrap();
        prop_assert!(apart(&way(&after(&reversed, "reverse").unwrap()), &before) < 1e-6);
        let own = &before[1..before.len() - 1];
        let back: Vec<Segment> = way(&reversed)[1..before.len() - 1].iter().rev().map(Segment::reversed).collect();
        prop_assert!(apart(own, &back) < 1e-6, "{reversed}");
        // Where a random path lies on itself, the number of crossings found depends on where the search starts. Whether a
        // single arc fits another reading depends on where it begins, and the writing decides which slip is the likeliest.
        // A block without movement counts as doubled only where the block before it has the same words.
        let rules = |text: &str| {
            let names = read(text).findings().into_iter().map(|finding| finding.rule.name());
            let mut names: Vec<_> = names.filter(|name| !matches!(*name, "path-crosses-itself" | "ambiguous-center" | "suspect-block" | "doubled-block")).collect();
            names.sort_unstable();
            names
        };
        prop_assert_eq!(rules(&reversed), rules(&text));
        // Twice as large, and no further off than a step.
        let larger = scaled_by(&text, 2.0).unwrap();
        let halved: Vec<Point> = way(&larger).iter().map(|segment| segment.point_at(0.5) / 2.0).collect();
        for (half, whole) in halved.iter().zip(&before) {
            prop_assert!((half - whole.point_at(0.5)).norm() < 1.5, "{larger}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn every_refactoring_of_every_program_is_edits_or_a_reason(
        text in "((N[0-9] )?(G0[0123] )?(X-?[0-9]{1,2}\\.?[05]? ?)?(Y-?[0-9]{1,2}\\. ?)?(I-?[0-9]\\. ?)?(J-?[0-9]\\. ?)?(R2\\.|G4[012] ?D1|G9[012]|G20|U1\\.|M0[012]|M30|M98 P[12]|M99|G51|H1=110|%|G28)?( \\(c\\))?\n){0,24}",
        copies in 1_usize..4,
        (start, length) in (0_usize..200, 0_usize..60),
    ) {
        tests::are_edits_or_reasons(Language::Iso, &text.repeat(copies), start..start + length)?;
    }
}

#[test]
fn a_number_that_is_called_and_stands_elsewhere_is_given_to_no_block() {
    let number = |text: &str| after(text, "number").unwrap();
    // Subprogram 20 is in the control, 40 begins with O.
    let text = "M98 P20\nG01 X1.\nM98 P40\nM02\nO40\nG01 X2.\nM99\n";
    assert_eq!(
        number(text),
        "N10 M98 P20\nN30 G01 X1.\nN50 M98 P40\nN60 M02\nO40\nN70 G01 X2.\nN80 M99\n"
    );
}
