//! Faults that once were made worse, or should be set right: what fix-all makes of each, and what the first fix does.

use super::contours::Group;
use super::judge::{findings, read};
use wedm::document::Document;
use wedm::finding::{Edit, Fix, FixKind};
use wedm::job::ROUNDS;
use wedm::text::edited;

/// A plate with a rounded corner, entered at another one.
const PLATE: &str = "B0B3000B3000GYL2\nB8000B0B8000GXL1\nB0B2000B2000GYNR4\nB0B6000B6000GYL2\nB10000B0B10000GXL3\nB0B8000B8000GYL4\n\
                     B0B3000B3000GYL4\nDD\n";

const CHECKED: &str = "; Start Point = 0.000 , 0.000\n\
                       N    1: B      0 B   3000 B   3000 GY L2  ;      0.000 ,      3.000\n\
                       N    2: B   8000 B      0 B   8000 GX L1  ;      8.000 ,      3.000\n\
                       N    3: B      0 B   2000 B   2000 GY NR4 ;     10.000 ,      5.000\n\
                       N    4: B      0 B   6000 B   6000 GY L2  ;     10.000 ,     11.000\n\
                       N    5: B  10000 B      0 B  10000 GX L3  ;      0.000 ,     11.000\n\
                       N    6: B      0 B   8000 B   8000 GY L4  ;      0.000 ,      3.000\n\
                       N    7: B      0 B   3000 B   3000 GY L4  ;      0.000 ,      0.000\n\
                       DD\n";

/// Two contours, with numbers and coordinates.
const TWO: &str = "; Start Point = 28.500 , 2.000\n\
                   N    1: B      0 B   2000 B   2000 GY L4  ;     28.500 ,      0.000\n\
                   N    2: B  25500 B      0 B  25500 GX L1  ;     54.000 ,      0.000\n\
                   N    3: B      0 B   6460 B   6460 GY L2  ;     54.000 ,      6.460\n\
                   N    4: B  54000 B      0 B  54000 GX L3  ;      0.000 ,      6.460\n\
                   N    5: B      0 B   6460 B   6460 GY L4  ;      0.000 ,      0.000\n\
                   N    6: B  28500 B      0 B  28500 GX L1  ;     28.500 ,      0.000\n\
                   N    7: B      0 B   2000 B   2000 GY L2  ;     28.500 ,      2.000\n\
                   D\n\
                   N    8: B 120295 B   1000 B 120295 GX L1  ;    148.795 ,      3.000\n\
                   D\n\
                   N    9: B      0 B   5000 B   5000 GY L2  ;    148.795 ,      8.000\n\
                   N   10: B  28795 B      0 B  28795 GX L3  ;    120.000 ,      8.000\n\
                   N   11: B      0 B   8000 B  16000 GX NR2 ;    120.000 ,     -8.000\n\
                   N   12: B  57590 B      0 B  57590 GX L1  ;    177.590 ,     -8.000\n\
                   N   13: B      0 B   8000 B  16000 GX NR4 ;    177.590 ,      8.000\n\
                   N   14: B  28795 B      0 B  28795 GX L3  ;    148.795 ,      8.000\n\
                   N   15: B      0 B   5000 B   5000 GY L4  ;    148.795 ,      3.000\n\
                   DD\n";

/// A triangle with two rounded corners, entered in the middle of a side.
const ROUNDED: &str = "B130B1996B1996GYL1\nB16619B1081B16619GXL2\nB129B1996B3108GYNR1\nB18143B27391B27391GYL4\n\
                       B1667B1103B2055GXNR3\nB16523B3260B16523GXL1\nB387B1962B757GXNR4\nB15173B10585B15173GXL1\n\
                       B1144B1640B1724GXNR4\nB16602B11384B16602GXL2\nB1132B1649B1001GXNR1\nB16619B1081B16619GXL2\n\
                       B130B1996B1996GYL3\nDD\n";

/// A staircase of equal steps.
const STEPS: &str = "B0B1000B1000GYL4\nB16800B0B16800GXL1\nB0B10000B10000GYL2\nB5600B0B5600GXL3\nB0B3250B3250GYL2\nB5600B0B5600GXL3\n\
                     B0B3250B3250GYL4\nB5600B0B5600GXL3\nB0B3730B3730GYL2\nB5600B0B5600GXL3\nB0B3730B3730GYL4\nB5600B0B5600GXL3\n\
                     B0B4500B4500GYL2\nB5600B0B5600GXL3\nB0B14500B14500GYL4\nB16800B0B16800GXL1\nB0B1000B1000GYL2\nDD\n";

/// The same plate as [`PLATE`] in ISO, absolute and incremental.
const WORDS: &str = "%\nG21\nG90\nG92 X0.000 Y0.000\nG01 X0.000 Y3.000\nG01 X8.000 Y3.000\nG03 X10.000 Y5.000 I0.000 J2.000\n\
                     G01 X10.000 Y9.000\nG03 X8.000 Y11.000 I-2.000 J0.000\nG01 X0.000 Y11.000\nG01 X0.000 Y3.000\nG01 X0.000 Y0.000\nM02\n%\n";
const STEPWISE: &str = "%\nG21\nG91\nG01 X0.000 Y3.000\nG01 X8.000 Y0.000\nG03 X2.000 Y2.000 I0.000 J2.000\n\
                        G01 X0.000 Y4.000\nG03 X-2.000 Y2.000 I-2.000 J0.000\nG01 X-8.000 Y0.000\nG01 X0.000 Y-8.000\nG01 X0.000 Y-3.000\nM02\n%\n";

/// Corners that the control makes.
const CORNERS: &str = "%\nG21\nG90\nG92 X0.000 Y0.000\nG01 X0.000 Y3.000\nG01 X10.000 Y3.000 ,R2.000\n\
                       G01 X10.000 Y11.000 ,C1.000\nG01 X0.000 Y11.000\nG01 X0.000 Y3.000\nG01 X0.000 Y0.000\nM02\n%\n";

/// A contour in the main program, and another one in a subprogram.
const CALLS: &str = "%\nG21\nG90\nG92 X0.000 Y0.000\nG01 X0.000 Y3.000\nG01 X10.000 Y3.000\nG01 X10.000 Y11.000\nG01 X0.000 Y11.000\n\
                     G01 X0.000 Y3.000\nG01 X0.000 Y0.000\nM00\nG00 X40.000 Y0.000\nM98 P7\nM02\n\
                     O0007\nG91\nG01 X0.000 Y3.000\nG01 X10.000 Y0.000\nG01 X0.000 Y8.000\nG01 X-10.000 Y0.000\nG01 X0.000 Y-8.000\n\
                     G01 X0.000 Y-3.000\nG90\nM99\n%\n";

/// Two half circles.
const HALVES: &str = "B8000B0B8000GXL1\nB8000B0B16000GYNR1\nB8000B0B16000GYNR3\nDD\n";

fn after(document: &Document, edit: &Edit) -> String {
    let Edit::Text(edits) = edit else {
        panic!("a fix of a program edits its text")
    };
    String::from_utf8(edited(document.text().unwrap().bytes(), edits).unwrap()).unwrap()
}

fn group_of(text: &str) -> Group {
    if text.starts_with('%') {
        Group::Iso
    } else {
        Group::Compact
    }
}

pub(super) fn fixed(text: &str) -> String {
    let mut text = text.to_owned();
    for _ in 0..ROUNDS {
        let document = read(group_of(&text), &text);
        let Some(edit) = document.fix_all() else {
            break;
        };
        text = after(&document, &edit);
    }
    text
}

/// A program with one text in it replaced.
pub(super) fn with(program: &str, found: &str, other: &str) -> String {
    assert!(program.contains(found), "{found}");
    program.replacen(found, other, 1)
}

/// Spaces in columns do not count.
fn tight(text: &str) -> String {
    text.lines()
        .map(|line| line.split_whitespace().collect::<String>() + "\n")
        .collect()
}

#[track_caller]
pub(super) fn check(program: &str, found: &str, other: &str) {
    let faulty = with(program, found, other);
    assert!(
        !findings(&mut read(group_of(&faulty), &faulty)).is_empty(),
        "nothing is reported of\n{faulty}"
    );
    let document = read(group_of(&faulty), &faulty);
    let offered = |finding: &wedm::finding::Finding| {
        document
            .fixes(finding)
            .into_iter()
            .map(|fix| format!("{:?} {:?}", finding.rule, fix))
            .collect::<Vec<_>>()
    };
    let fixes: Vec<_> = findings(&mut document.clone())
        .iter()
        .flat_map(offered)
        .collect();
    assert_eq!(
        tight(&fixed(&faulty)),
        tight(program),
        "of\n{faulty}{fixes:#?}"
    );
}

#[track_caller]
pub(super) fn check_untouched(program: &str, found: &str, other: &str) {
    let faulty = with(program, found, other);
    assert_eq!(fixed(&faulty), faulty);
}

/// The first fix of some finding sets it right, and fix-all does not make it.
#[track_caller]
fn check_first(program: &str, found: &str, other: &str) {
    check_untouched(program, found, other);
    let first = check_first_of(program, found, other);
    assert!(!first.preferred, "{first:?}");
}

/// The first fix of some finding sets it right.
#[track_caller]
fn check_first_of(program: &str, found: &str, other: &str) -> Fix<Edit> {
    let faulty = with(program, found, other);
    let mut document = read(group_of(&faulty), &faulty);
    let first = findings(&mut document)
        .iter()
        .find_map(|finding| document.fixes(finding).into_iter().next());
    let first = first.unwrap_or_else(|| panic!("no fix for\n{faulty}"));
    assert_eq!(
        tight(&after(&document, &first.edit)),
        tight(program),
        "by {:?}",
        first.kind
    );
    first
}

#[test]
fn a_block_twice_goes_and_becomes_no_full_circle() {
    check(
        PLATE,
        "B0B6000B6000GYL2\n",
        "B0B6000B6000GYL2\nB0B6000B6000GYL2\n",
    );
    check(
        PLATE,
        "B0B2000B2000GYNR4\n",
        "B0B2000B2000GYNR4\nB0B2000B2000GYNR4\n",
    );
    let line = "N    5: B  10000 B      0 B  10000 GX L3  ;      0.000 ,     11.000\n";
    check(CHECKED, line, &line.repeat(2));
    check_untouched(
        HALVES,
        "B8000B0B16000GYNR1\n",
        "B8000B0B16000GYNR1\nB8000B0B16000GYNR1\n",
    );
}

#[test]
fn turns_quadrants_and_kinds_are_put_right_once() {
    check(PLATE, "NR4", "SR4");
    check(CHECKED, "NR4", "SR4");
    check(CHECKED, "NR4", "SR3");
    check(CHECKED, "GY NR4", "GY L4 ");
    check(PLATE, "B6000GYL2", "B6000GYL4");
    check(PLATE, "B2000GYNR4", "B2000GXNR4");
}

#[test]
fn blocks_that_changed_places_change_back() {
    let [two, three] = [2, 3].map(|line| CHECKED.split_inclusive('\n').nth(line).unwrap());
    check(CHECKED, &format!("{two}{three}"), &format!("{three}{two}"));
}

#[test]
fn a_lost_block_is_put_in_only_by_hand_but_a_way_in() {
    check_first(CHECKED, CHECKED.split_inclusive('\n').nth(3).unwrap(), "");
    check_first(CHECKED, CHECKED.split_inclusive('\n').nth(5).unwrap(), "");
    // The one that runs smoothly between its neighbours.
    check_first(PLATE, "B0B2000B2000GYNR4\n", "");
    // Beside a pause: the way to the next contour is as it was, since a number is left out.
    check_first(TWO, TWO.split_inclusive('\n').nth(7).unwrap(), "");
    // A way in is the way out backwards.
    check(TWO, TWO.split_inclusive('\n').nth(1).unwrap(), "");
    // Another J of one digit closes the contour as well.
    check_untouched(ROUNDED, "B1132B1649B1001GXNR1\n", "");
    // Between two lines that would have been written as one.
    check_first(
        STEPS,
        "B5600B0B5600GXL3\nB0B3730B3730GYL4\nB5600",
        "B5600B0B5600GXL3\nB5600",
    );
}

#[test]
fn what_a_straight_line_explains_as_well_is_no_digit_for_sure() {
    let unnumbered: String = TWO
        .lines()
        .map(|line| {
            format!(
                "{}\n",
                line.split_once(':').map_or(line, |(_, block)| block)
            )
        })
        .collect();
    let lost = unnumbered.split_inclusive('\n').nth(7).unwrap();
    check_untouched(&unnumbered, lost, "");
}

#[test]
fn a_lost_line_of_iso_is_offered_where_it_leads_to_an_arc_or_closes_the_cut() {
    check_first(WORDS, "G01 X10.000 Y9.000\n", "");
    for lost in [
        "G03 X2.000 Y2.000 I0.000 J2.000\n",
        "G03 X-2.000 Y2.000 I-2.000 J0.000\n",
    ] {
        check_first(STEPWISE, lost, "");
    }
}

#[test]
fn slips_are_looked_for_beside_corners_that_the_control_makes_and_in_programs_with_subprograms() {
    check(
        CORNERS,
        "X0.000 Y3.000\nG01 X0.000 Y0",
        "X0.0O0 Y3.000\nG01 X0.000 Y0",
    );
    check_first_of(CORNERS, "Y11.000 ,C", "Y-11.000 ,C");
    check_first_of(CALLS, "G01 X10.000 Y11.000", "G01 X10.000 Y-11.000");
    check_first_of(CALLS, "G01 X-10.000 Y0.000", "G01 X-100.000 Y0.000");
}

#[test]
fn x_and_y_exchanged_are_exchanged_again() {
    for program in [PLATE, HALVES] {
        let exchanged = if program == PLATE {
            ("B0B2000B2000GYNR4", "B2000B0B2000GYNR4")
        } else {
            ("B8000B0B8000GXL1", "B0B8000B8000GXL1")
        };
        let faulty = with(program, exchanged.0, exchanged.1);
        let left = fixed(&faulty);
        assert!(left == program || left == faulty, "{left}");
    }
    check(PLATE, "B0B2000B2000GYNR4", "B2000B0B2000GYNR4");
    let skew =
        "B5000B3000B5000GXL1\nB5000B3000B5000GXL2\nB5000B3000B5000GXL3\nB5000B3000B5000GXL4\nDD\n";
    check(skew, "B5000B3000B5000GXL1", "B3000B5000B5000GXL1");
}

#[test]
fn what_is_lost_in_a_block_is_put_back() {
    for (found, other) in [
        ("B8000GXL1", "B8000XL1"),
        ("B8000GXL1", "B8000GL1"),
        ("B8000GXL1", "B8000L1"),
        ("GXL1", "GX"),
        ("GXL1", "GXL"),
        ("GYNR4", "GYN4"),
        ("GYNR4", "GYR4"),
        ("GYNR4", "GY"),
        ("B8000B0B8000", "B-8000B0B8000"),
        ("B8000B0B8000", "B8.000B0B8000"),
        ("B8000B0B8000", "B8000B0B8,000"),
        ("B8000B0B8000", "B8OOOB0B8000"),
        ("B8000B0B8000", "8000B0B8000"),
        ("B8000B0B8000", "B8000B8000"),
    ] {
        check(PLATE, found, other);
    }
}

#[test]
fn a_block_that_cannot_be_read_is_put_right_by_its_coordinates_where_another_one_cannot_be_read_either()
 {
    let torn = with(
        CHECKED,
        "B   8000 B      0 B   8000 GX",
        "B   8000 B      0 B GX",
    );
    let torn = with(
        &torn,
        "B      0 B   6000 B   6000 GY",
        "B      0 B   6000 GY",
    );
    let mut document = read(Group::Compact, &torn);
    let finding = &findings(&mut document)[0];
    let first = document.fixes(finding).into_iter().next();
    let FixKind::RestoreBlock { block } = first.expect("a fix").kind else {
        panic!("of\n{torn}")
    };
    assert_eq!(tight(&block), "B8000B0B8000GXL1\n");
}

#[test]
fn a_block_keeps_one_number_and_a_text_its_line_ends() {
    check(CHECKED, "N    4:", "N    3:");
    let windows = PLATE.replace('\n', "\r\n");
    check(&windows, "DD\r\n", "");
    let endless = with(&windows, "DD\r\n", "");
    assert_eq!(fixed(&endless).trim_end(), windows.trim_end());
}

#[test]
fn of_a_line_alone_both_ways_along_its_axis_are_offered() {
    for (line, expected) in [
        ("GXL2", ["L3", "L1"]),
        ("GXL4", ["L1", "L3"]),
        ("GYL1", ["L2", "L4"]),
        ("GYL3", ["L4", "L2"]),
    ] {
        let text = format!("B0B0B5000{line}\nDD\n");
        let mut document = read(Group::Compact, &text);
        let offered: Vec<&str> = findings(&mut document)
            .iter()
            .flat_map(|finding| document.fixes(finding))
            .filter_map(|fix| match fix.kind {
                FixKind::SetMotion { name } => Some(name),
                _ => None,
            })
            .collect();
        assert_eq!(offered, expected, "{text}");
    }
}

#[test]
fn what_nothing_but_the_quadrant_says_follows_from_what_closes() {
    for line in [
        "B8000B0B8000GXL1",
        "B10000B0B10000GXL3",
        "B0B6000B6000GYL2",
        "B0B8000B8000GYL4",
    ] {
        let (length, motion) = (
            line.split(['B', 'G']).nth(3).unwrap(),
            &line[line.len() - 4..],
        );
        let bare = with(PLATE, line, &format!("B0B0B{length}{motion}"));
        let other = if motion.starts_with("GX") {
            "GXL2"
        } else {
            "GYL3"
        };
        check(
            &bare,
            &format!("B0B0B{length}{motion}"),
            &format!("B0B0B{length}{other}"),
        );
    }
}

#[test]
fn one_digit_of_one_number_is_put_right() {
    for (found, other) in [
        ("B8000B0B8000GXL1", "B80000B0B8000GXL1"),
        ("B8000B0B8000GXL1", "B8000B0B800GXL1"),
        ("B0B2000B2000GYNR4", "B0B2000B200GYNR4"),
        ("B0B2000B2000GYNR4", "B0B2000B2300GYNR4"),
    ] {
        check(PLATE, found, other);
    }
    check(CHECKED, "B   2000 B   2000 GY", "B   2100 B   2000 GY");
}

/// A long line that closes a contour is nobody's wish that one could know of.
#[test]
fn a_line_that_closes_is_offered_and_not_preferred() {
    let open = "B0B90000B90000GYL2\nB50000B0B50000GXL1\nB20000B70000B70000GYL1\nDD\n";
    let mut document = read(group_of(open), open);
    let fixes: Vec<_> = findings(&mut document)
        .iter()
        .flat_map(|finding| document.fixes(finding))
        .collect();
    let draws =
        |kind: &FixKind| matches!(kind, FixKind::Close { .. } | FixKind::InsertBlock { .. });
    assert!(fixes.iter().any(|fix| draws(&fix.kind)), "{fixes:?}");
    assert!(
        fixes
            .iter()
            .all(|fix| !draws(&fix.kind) || !fix.preferred && !fix.in_fix_all),
        "{fixes:?}"
    );
    assert_eq!(fixed(open), open);
}

#[test]
fn coordinates_are_replaced_whole() {
    let text = "; Start Point = 0 , 0\nB9900B0B9900GXL1 ; 1e9 , 0.000\nB9900B0B39600GYNR1 ; 9.900 , 0.000\nB9900B0B9900GXL3 ; 0 , 0\nDD\n";
    let fixed = fixed(text);
    assert!(
        findings(&mut read(group_of(&fixed), &fixed)).is_empty(),
        "{fixed}"
    );
    assert!(!fixed.contains('e'), "{fixed}");
}
