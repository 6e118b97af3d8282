//! Faults that once were made worse, or should be set right: what fix-all makes of each, and what the first fix does.

use super::contours::Group;
use super::judge::{findings, read};
use wedm::document::{Document, ROUNDS};
use wedm::finding::{Edit, FixKind};
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

/// Two half circles.
const HALVES: &str = "B8000B0B8000GXL1\nB8000B0B16000GYNR1\nB8000B0B16000GYNR3\nDD\n";

fn after(document: &Document, edit: &Edit) -> String {
    let Edit::Text(edits) = edit else {
        panic!("a fix of a program edits its text")
    };
    String::from_utf8(edited(document.text().unwrap().bytes(), edits).unwrap()).unwrap()
}

fn fixed(text: &str) -> String {
    let mut text = text.to_owned();
    for _ in 0..ROUNDS {
        let document = read(Group::Compact, &text);
        let Some(edit) = document.fix_all() else {
            break;
        };
        text = after(&document, &edit);
    }
    text
}

/// A program with one text in it replaced.
fn with(program: &str, found: &str, other: &str) -> String {
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
fn check(program: &str, found: &str, other: &str) {
    let faulty = with(program, found, other);
    assert!(
        !findings(&mut read(Group::Compact, &faulty)).is_empty(),
        "nothing is said of\n{faulty}"
    );
    let document = read(Group::Compact, &faulty);
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
fn check_untouched(program: &str, found: &str, other: &str) {
    let faulty = with(program, found, other);
    assert_eq!(fixed(&faulty), faulty);
}

/// The first fix of some finding sets it right, and fix-all does not make it.
#[track_caller]
fn check_first(program: &str, found: &str, other: &str) {
    check_untouched(program, found, other);
    let faulty = with(program, found, other);
    let mut document = read(Group::Compact, &faulty);
    let first = findings(&mut document)
        .iter()
        .find_map(|finding| document.fixes(finding).into_iter().next());
    let first = first.unwrap_or_else(|| panic!("no fix for\n{faulty}"));
    assert!(!first.preferred, "{first:?}");
    assert_eq!(
        tight(&after(&document, &first.edit)),
        tight(program),
        "by {:?}",
        first.kind
    );
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
fn a_lost_block_is_put_in_only_by_hand() {
    check_first(CHECKED, CHECKED.split_inclusive('\n').nth(3).unwrap(), "");
    check_first(CHECKED, CHECKED.split_inclusive('\n').nth(5).unwrap(), "");
    // The one that runs smoothly between its neighbours.
    check_first(PLATE, "B0B2000B2000GYNR4\n", "");
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
    let mut document = read(Group::Compact, open);
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
        findings(&mut read(Group::Compact, &fixed)).is_empty(),
        "{fixed}"
    );
    assert!(!fixed.contains('e'), "{fixed}");
}
