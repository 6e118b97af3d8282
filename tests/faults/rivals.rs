//! Faults that more than one repair explains, and what else tells which is the right one.

use super::chance::Chance;
use super::known::{check, check_untouched, fixed, with};

/// A contour with a way out after its tab.
const TAB: &str = "B250B144B250GXL4\nB84B143B190GYNR3\nB0B2507B2507GYL2\nB151B1B150GXSR2\nB1199B0B1199GXL1\nB0B2976B2976GYL2\n\
                   B165B0B165GXSR2\nB116B0B116GXL1\nB0B219B219GYSR1\nB0B2922B2922GYL4\nB1143B0B1143GXL1\nB0B217B218GYSR1\n\
                   B0B4946B4946GYL4\nB138B0B137GXSR4\nB2934B0B2934GXL3\nB1B139B138GYSR3\nB0B1507B1507GYL2\nD\n\
                   B0B1000B1000GYL2\nB0B1000B1000GYL2\nB372B0B837GYNR1\nB233B907B907GYL4\nDD\n";

#[test]
fn a_fault_before_a_tab_is_put_right_there_and_not_behind_it() {
    check(TAB, "B1199B0B1199GXL1", "B1199B0B1199GYL1");
    let behind = "B233B907B907GYL4";
    for (found, other) in [
        ("B2934B0B2934GXL3", "B2934B0B1934GXL3"),
        ("B0B2976B2976GYL2", "B0B2796B2976GYL2"),
        ("B116B0B116GXL1", "B116B0B116GXL3"),
    ] {
        let left = fixed(&with(TAB, found, other));
        assert!(left.contains(behind), "{left}");
    }
}

/// Two passes with ways in and out at a corner.
const PASSES: &str = "B839B1816B1816GYL2\nB6525B0B6525GXL3\nB0B6000B6000GYL4\nB6525B0B6525GXL1\nB0B6000B6000GYL2\nB839B1816B1816GYL4\nD\n\
                      B839B1836B1836GYL2\nB6525B0B6525GXL3\nB0B6000B6000GYL4\nB6525B0B6525GXL1\nB0B6000B6000GYL2\nB839B1836B1836GYL4\nDD\n";

#[test]
fn a_way_in_or_out_is_told_by_the_other_pass_or_left_alone() {
    check(PASSES, "B839B1816B1816GYL4", "B839B1816B1816GYL2");
    check(PASSES, "B839B1836B1836GYL4", "B839B1836B1836GYL2");
    check(PASSES, "B839B1816B1816GYL2", "B839B1816B1816GYL4");
    let (one, _) = PASSES.split_once("D\n").unwrap();
    check_untouched(
        &format!("{one}DD\n"),
        "B839B1816B1816GYL4",
        "B839B1816B1816GYL2",
    );
}

/// The text of a wrong program.
macro_rules! wrong {
    ($name:literal) => {
        include_str!(concat!("../data/programs/wrong/", $name))
    };
}

#[test]
fn another_pass_of_iso_tells_which_block_is_wrong() {
    for (text, found, meant) in [
        (wrong!("another_pass_tells.iso"), "Y44.75", "Y4.75"),
        (
            wrong!("another_pass_backwards_tells.iso"),
            "Y-11.2",
            "Y-1.2",
        ),
    ] {
        assert_eq!(fixed(text), text.replace(found, meant));
    }
}

#[test]
fn what_two_slips_explain_as_plainly_is_left_alone() {
    for text in [
        wrong!("digit_lost_before_the_point.iso"),
        wrong!("either_quadrant_of_a_way_in.3b"),
        wrong!("half_circle_lost.3b"),
    ] {
        assert_eq!(fixed(text), text);
    }
    let padded = wrong!("padded_digit.3b");
    assert_eq!(fixed(padded), padded.replace("B 01024", "B 24"));
}

/// A circle with arcs for its ways in and out.
const FORKED: &str = "B500B289B500GXL2\nB166B290B377GYNR1\nB7258B0B29032GYSR4\nB334B1B500GXNR3\nB500B289B500GXL1\nDD\n";

#[test]
fn a_way_in_that_looks_like_the_way_out_by_a_wrong_quadrant_is_left_alone() {
    check_untouched(FORKED, "B500B289B500GXL2", "B500B289B500GXL3");
}

const JUMP: &str = "B2000B0B2000GXL1\nB2000B0B8000GYNR1\nB2000B0B2000GXL3\nD\nB41178B7984B41178GXL1\nD\n\
                    B2000B0B2000GXL1\nB2000B0B8000GYNR1\nB2000B0B2000GXL3\nDD\n";

#[test]
fn the_counting_axis_of_a_way_that_closes_nothing_is_left_alone_where_j_counts_on_it() {
    check_untouched(JUMP, "B41178B7984B41178GX", "B41178B79841B41178GX");
    check_untouched(JUMP, "B41178B7984B41178GX", "B2316B3857B32316GX");
    // X and Y may have changed places, but not along an axis.
    check_untouched(JUMP, "B41178B7984B41178GX", "B41178B7984B41178GY");
    let along = with(JUMP, "B41178B7984B41178GX", "B41178B0B41178GX");
    check(&along, "B41178B0B41178GX", "B41178B0B41178GY");
}

/// A circle of 4B: R says which of X, Y and J is wrong.
const CIRCLE: &str = "B1000B0B1000GXL1\nB1301B0B5204B1301GYDNR1\nB1000B0B1000GXL3\nDD\n";

#[test]
fn the_radius_of_4b_tells_which_number_is_wrong() {
    for (found, other) in [
        ("B1301B0", "B0301B0"),
        ("B1301B0", "B1391B0"),
        ("B5204", "B1204"),
        ("B5204", "B52004"),
        ("B1301GY", "B1801GY"),
        ("B1301B0", "B0B1301"),
        ("NR1", "NR3"),
    ] {
        let faulty = with(CIRCLE, found, other);
        let left = fixed(&faulty);
        assert!(left == CIRCLE || left == faulty, "{left}\nof\n{faulty}");
    }
    check(CIRCLE, "B1301B0", "B0301B0");
    check(CIRCLE, "B1301GY", "B1801GY");
    check(CIRCLE, "B5204", "B1204");
}

#[test]
fn i_and_j_that_are_calculated_from_ends_which_may_be_wrong_are_not_made_unasked() {
    let halves = "%\nG92 X0 Y0\nG90\nG01 X0.500 Y0.000\nG02 X14.054 Y0.000 I-6.777 J0.000\nG02 X0.500 Y0.000 I-6.777 J0.000\nG01 X0.000 Y0.000\nM02\n";
    let lost = with(halves, "G02 X14.054", "G02 X-14.054");
    let left = fixed(&lost);
    assert!(left.contains("X-14.054 Y0.000 I-6.777"), "{left}");
}

#[test]
fn behind_a_cut_that_has_missed_its_start_nothing_is_put_right_unasked() {
    let pass = |radius: &str, out: &str| {
        format!(
            "G01 X6.9 Y-2.341\nG03 X-5.4 Y-2.341 I-{radius} J0.\nG03 X6.9 Y-2.341 I{radius} J0.\nG03 X6.893 Y-2.041 I-{radius} J0.\n{out}\nM00\n"
        )
    };
    let home = "G01 X8.994 Y-2.341";
    let text = format!(
        "%\nG21\nG90\nG92 X8.994 Y-2.341\n{}{}{home}\nM02\n",
        pass("6.15", "G01 X8.994"),
        pass("6.15", home).replace(&format!("{home}\nM00\n"), ""),
    );
    let left = fixed(&text);
    assert!(left.contains(&format!("{home}\nM02")), "{left}");
}

/// Any key of any number of a circle: the circle that was, or nothing.
#[test]
fn a_circle_with_a_wrong_key_becomes_no_other_circle() {
    let chance = &mut Chance::of_seed(21);
    let (mut right, mut failures) = (0, Vec::new());
    for _ in 0..400 {
        let radius = 300 + chance.below(9000);
        let is_four_b = chance.one_in(3);
        let part = if is_four_b {
            format!("B{radius}GYD")
        } else {
            "GY".into()
        };
        let circle = format!("B{radius}B0B{}{part}NR1", 4 * radius);
        let sound = format!("B250B0B250GXL1\n{circle}\nB250B0B250GXL3\nDD\n");
        let mut keys = circle.clone();
        let digits: Vec<usize> = (0..keys.len() - 1)
            .filter(|at| keys.as_bytes()[*at].is_ascii_digit())
            .collect();
        let at = chance.of(&digits);
        let digit = chance.below(10).to_string();
        match chance.below(3) {
            0 => keys.replace_range(at..at + 1, &digit),
            1 => keys.insert_str(at, &digit),
            _ => keys.replace_range(at..at + 1, ""),
        }
        let faulty = with(&sound, &circle, &keys);
        let left = fixed(&faulty);
        right += usize::from(left == sound && faulty != sound);
        if left != sound && left != faulty {
            failures.push(format!("{faulty}{left}"));
        }
    }
    assert!(
        failures.is_empty(),
        "{}:\n{}",
        failures.len(),
        failures.join("\n")
    );
    assert!(right > 100, "{right}");
}

/// One digit more or less in two different blocks closes it as well.
const ALIKE: &str = "G91\nG01 X-3000 Y500\nG01 X10000 Y-500\nG01 X5500 Y4100\nG01 X-6300 Y6800\nG01 X-6200 Y-10900\nG01 X-3000 Y500\nG01 X3000 Y-500\nM02\n";

#[test]
fn a_number_is_not_calculated_where_a_digit_was_lost() {
    let faulty = format!("%\n{}", with(ALIKE, "X-6200", "X-620"));
    let left = fixed(&faulty);
    assert!(left == faulty || left == format!("%\n{ALIKE}"), "{left}");
}

#[test]
fn a_circle_without_its_quadrant_is_left_alone_where_its_centre_may_lie_elsewhere() {
    for way in ["B3000B0B3000GX", "B1000B3000B3000GY"] {
        let circle = format!("{way}L1\nB17427B0B69708GYSR2\n{way}L3\nDD\n");
        check_untouched(&circle, "SR2", "SR");
        check_untouched(&circle, "SR2", "SR8");
    }
}

#[test]
fn of_two_digits_of_two_blocks_that_close_a_contour_none_is_chosen() {
    let three_b = "B2817B2266B2817GXL2\nB6977B5739B6977GXL2\nB720B8977B6102GYNR2\nB1101B7206B11318GXNR1\nB14260B7773B14260GXL4\n\
                   B3668B1812B3668GXL1\nB9237B4153B9237GXL1\nB6910B15217B15217GYL2\nB2817B2266B2817GXL4\nDD\n";
    check_untouched(three_b, "B5739B", "B5639B");
    let iso = "%\nG91\nG92X6736Y69498\nG01X-2935Y-1680\nG01X-14757Y-16981\nG02X-41356Y-24768R25633\nG03X-3251Y-33187R16705\n\
               G03X43994Y-47848R34195\nG01X26470Y-17324\nG01X37904Y65716\nG03X-49004Y74392R44781\nG01X2935Y1680\nM02\n";
    let faulty = with(iso, "X-14757", "X-1457");
    let left = fixed(&faulty);
    // The way out is the way in backwards, and stays.
    assert!(left.contains("G01X2935Y1680\n"), "{left}");
}

#[test]
fn a_doubled_arc_goes_alone() {
    let iso = "%\nG90\nG92X0Y0\nG01X5000Y0\nG02X5000Y10000I0J5000\nG01X15000Y10000\nG02X15000Y0I0J-5000\nG01X5000Y0\nG01X0Y0\nM02\n";
    let arc = "G02X5000Y10000I0J5000\n";
    let left = fixed(&with(iso, arc, &arc.repeat(2)));
    assert!(
        left == iso || left == with(iso, arc, &arc.repeat(2)),
        "{left}"
    );
}
