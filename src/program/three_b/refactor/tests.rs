use crate::geometry::{Arc, Point, Segment, direction};
use crate::program::Language;
use crate::program::path::cuts;
use crate::program::refactor::tests;
use crate::program::three_b::Document;
use crate::program::three_b::block::Node;
use crate::program::three_b::encode::{encode, point_of, snap};
use crate::program::three_b::layout::push_fields;
use crate::program::{Offer, offers};
use crate::settings::Effective;
use proptest::prelude::*;
use std::f64::consts::TAU;

const LARGEST: i64 = 999_999;

fn read(text: &str) -> Document {
    Document::read(text.as_bytes().to_vec())
}

fn refactored(id: &str, text: &str) -> Result<String, String> {
    tests::refactored(Language::ThreeB, id, text)
}

#[track_caller]
fn check(id: &str, text: &str, expected: &str) {
    tests::check(Language::ThreeB, id, text, expected);
}

#[track_caller]
fn refused(id: &str, text: &str, reason: &str) {
    tests::refused(Language::ThreeB, id, text, reason);
}

const HOLE: &str = "; R10\nN1 B9900B0B9900GXL1 ; in\nN2 B9900B0B19800GYNR1 ; half\nN3 B9900B0B19800GYNR3\nN4 B9900B0B9900GXL3\nDD\n";

#[test]
fn contours_are_reversed_between_their_ways() {
    let reversed = "; R10\nN1 B9900B0B9900GXL1 ; in\nN2 B9900B0B19800GYSR4\nN3 B9900B0B19800GYSR2 ; half\nN4 B9900B0B9900GXL3\nDD\n";
    check("reverse", HOLE, reversed);
    check("reverse", reversed, HOLE);
    // Leads that differ are turned round with it: arcs, and an overlap.
    let arcs = "B2450B1415B2450GXL4\nB816B1416B1852GYNR3\nB4900B0B19600GYNR1\nB1634B1B2450GXNR1\nB2450B1415B2450GXL3\nDD\n";
    let turned = "B2450B1415B2450GXL1\nB816B1416B1852GYSR2\nB4900B0B19600GYSR4\nB1634B1B2450GXSR4\nB2450B1415B2450GXL2\nDD\n";
    check("reverse", arcs, turned);
    let past = "B0B900B900GYL2\nB2000B0B2000GXL1\nB0B3000B3000GYL2\nB4000B0B4000GXL3\nB0B3000B3000GYL4\nB2000B0B2000GXL1\nB300B0B300GXL1\nB300B900B900GYL3\nDD\n";
    let begun = "B300B900B900GYL1\nB300B0B300GXL3\nB2000B0B2000GXL3\nB0B3000B3000GYL2\nB4000B0B4000GXL1\nB0B3000B3000GYL4\nB2000B0B2000GXL3\nB0B900B900GYL4\nDD\n";
    check("reverse", past, begun);
    check("reverse", begun, past);
    assert_eq!(read(past).findings(), []);
    assert_eq!(read(begun).findings(), []);
    // Only the contour that the cursor is in.
    check(
        "reverse",
        "B5B0B5GXL1\nB0B5B5GYL2\nB5B0B5GXL3\nB0B5B5GYL4\nD\n|B7B0B7GXL1\nB0B7B7GYL2\nB7B7B7GYL3\nDD\n",
        "B5B0B5GXL1\nB0B5B5GYL2\nB5B0B5GXL3\nB0B5B5GYL4\nD\nB7B7B7GYL1\nB0B7B7GYL4\nB7B0B7GXL3\nDD\n",
    );
    check(
        "reverse",
        "; Start Point = 1 , 2\nB5B0B5GXL1\nB0B9B9GYL2\nDD\n",
        "; Start Point = 1.005 , 2.009\nB0B9B9GYL4\nB5B0B5GXL3\nDD\n",
    );
    refused(
        "reverse",
        "B5B0B5GXL1\nB0B9B9GYL2\nD\nB0B9B9GYL2\nDD\n",
        "contour 1 is open",
    );
    refused(
        "reverse",
        "B5B0B5GXL1\nB0B9GYL2\nDD\n",
        "line 2: column 5: found `GYL2`",
    );
}

#[test]
fn a_contour_begins_where_the_cursor_is() {
    check(
        "startHere",
        "B5000B0B5000GXL1\nB0B5000B5000GYL2\nB10000B0B10000GXL3\n|B0B10000B10000GYL4\nB10000B0B10000GXL1\nB0B5000B5000GYL2\nB5000B0B5000GXL3\nDD\n",
        "B5000B5000B5000GXL2\nB0B10000B10000GYL4\nB10000B0B10000GXL1\nB0B5000B5000GYL2\nB0B5000B5000GYL2\nB10000B0B10000GXL3\nB5000B5000B5000GXL4\nDD\n",
    );
    check(
        "startHere",
        "B5B0B5GXL1\n|B0B5B5GYL2\nB5B5B5GYL3\nDD\n",
        "B0B5B5GYL2\nB5B5B5GYL3\nB5B0B5GXL1\nDD\n",
    );
    refused(
        "startHere",
        "|B5000B0B5000GXL1\nB5000B0B20000GYNR1\nB5000B0B5000GXL3\n",
        "the block is a lead-in or lead-out",
    );
    refused("startHere", "; x|\nB5B0B5GXL1\n", "no block is selected");
    // The wire stands beside the contour of a 4B program, by a correction in the direction in which it begins there.
    let four_b = |first: &str, last: &str| {
        format!(
            "B0B2900B2900GYL4\nB7250B0B7250GXL1\nB0B500B500B500GYDDNR4\nB0B4500B4500GYL2\n{first}B5000B0B5000B5000GXDDNR1\nB10000B0B10000GXL3\n{last}B0B5000B10000B5000GXDDNR2\nB7250B0B7250GXL1\nB0B2900B2900GYL2\nDD\n"
        )
    };
    refused(
        "startHere",
        &four_b("|", ""),
        "a correction that the program does not state",
    );
    refused(
        "startHere",
        &four_b("", "|"),
        "a correction that the program does not state",
    );
}

#[test]
fn a_way_that_would_cut_the_contour_is_refused() {
    // A U whose thread hole lies in one leg.
    let legs = "B5000B2000B5000GXL2\nB0B20000B20000GYL4\nB30000B0B30000GXL1\nB0B20000B20000GYL2\n|B10000B0B10000GXL3\nB0B10000B10000GYL4\n\
                B10000B0B10000GXL3\nB0B10000B10000GYL2\nB10000B0B10000GXL3\nB5000B2000B5000GXL4\nDD\n";
    refused("startHere", legs, "would cut the contour in line");
}

#[test]
fn programs_are_mirrored_and_rotated_to_the_last_micron() {
    check(
        "mirror.x",
        HOLE,
        "; R10\nN1 B9900B0B9900GXL3 ; in\nN2 B9900B0B19800GYSR2 ; half\nN3 B9900B0B19800GYSR4\nN4 B9900B0B9900GXL1\nDD\n",
    );
    check("mirror.y", "B3B4B4GYL1\n", "B3B4B4GYL4\n");
    check(
        "rotate.left",
        "BBB5GXL1\nB4B4B4GYL1\n; Start Point = 1 , 2\n",
        "B0B0B5GYL2\nB4B4B4GXL2\n; Start Point = 1 , 2\n",
    );
    check(
        "rotate.right",
        "; Start Point = 1.0 , 2.0\nB3000B4000B4000GYL1 ; 4.0 , 6.0\n",
        "; Start Point = 2.000 , -1.000\nB4000B3000B4000GXL4  ;      6.000 ,     -4.000\n",
    );
    check(
        "rotate.half",
        "B0B5000B10000B5000GXDDNR2\n",
        "B0B5000B10000B5000GXDDNR4\n",
    );
}

#[test]
fn programs_are_scaled_and_close_again() {
    check(
        "scale.inchToMm",
        "B100B0B100GXL1\nB100B0B400GYNR1\nB100B0B100GXL3\nDD\n",
        "B2540B0B2540GXL1\nB2540B0B10160GYNR1\nB2540B0B2540GXL3\nDD\n",
    );
    refused(
        "scale.mmToInch",
        "B10B0B10GXL1\nDD\n",
        "line 1: the block becomes shorter than 1 µm",
    );
    // Arcs too large for a block take thousands of chords each.
    let circles = "B99000B0B396000GYNR1\n".repeat(60);
    let refused = tests::scaled_by(Language::ThreeB, &circles, 25.4).unwrap_err();
    assert!(refused.contains("more than 20960 blocks"), "{refused}");
    let scaled = |factor| tests::scaled_by(Language::ThreeB, "B10B0B10GXL1\n", factor);
    for factor in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9] {
        assert!(
            scaled(factor).is_err_and(|reason| reason.contains("expected one between")),
            "{factor}"
        );
    }
}

#[test]
fn long_blocks_are_split_and_merge_again() {
    let long = "N1 B1500000B0B1500000GXL1\nN2 B0B5B5GYL2\nDD\n";
    let split = "N1 B750000B0B750000GXL1\nN2 B750000B0B750000GXL1\nN3 B0B5B5GYL2\nDD\n";
    check("split", long, split);
    check("merge", split, split);
    check(
        "merge",
        "N1 B2000B1000B2000GXL1\nN2 B4000B2000B4000GXL1\nN3 B0B5B5GYL2\n",
        "N1 B6000B3000B6000GXL1\nN2 B0B5B5GYL2\n",
    );
    // A comment marks a place, and back is not on.
    check(
        "merge",
        "B2B0B2GXL1\nB2B0B2GXL1 ; here\nB2B0B2GXL1\n",
        "B2B0B2GXL1\nB4B0B4GXL1 ; here\n",
    );
    check(
        "merge",
        "B2B0B2GXL1\nB1B0B1GXL3\n",
        "B2B0B2GXL1\nB1B0B1GXL3\n",
    );
}

#[test]
fn the_correction_is_applied_to_the_parts_contour() {
    // Where no lead-in leads to the contour, the start changes, and the header says so.
    check(
        "correct.opening",
        "B5000B0B20000GYNR1\nDD\n",
        "; Start Point = -0.100 , 0.000\nB4900B0B19600GYNR1\nDD\n",
    );
    check(
        "correct.punch",
        "; Start Point = 5.000 , 0.000\nB5000B0B20000GYNR1\nDD\n",
        "; Start Point = 5.100 , 0.000\nB5100B0B20400GYNR1\nDD\n",
    );
    let part = "; plate\nB10000B0B10000GXL1\nB10000B0B40000GYNR1\nB10000B0B10000GXL3\nDD\n";
    check(
        "correct.opening",
        part,
        "; plate\nB9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n",
    );
    refused("correct.punch", part, "lead");
    refused(
        "correct.opening",
        "B10000B0B10000GXL1\nB50B0B200GYNR1\nB10000B0B10000GXL3\nDD\n",
        "does not fit",
    );
    refused(
        "correct.opening",
        "B10000B0B10000GXL1\nB0B5B5GYL2\nDD\n",
        "is open",
    );
}

#[test]
fn what_changes_nothing_is_not_offered() {
    let document = read("B5B0B5GXL1\nB0B5B5GYL2\nB5B5B5GYL3\nDD\n");
    let document = crate::program::Document::ThreeB(document);
    let settings = Effective::default();
    let all = offers(&document, &settings, 0..0, |_| true).into_iter();
    let ids: Vec<&str> = all.filter_map(Offer::tried).map(|it| it.id).collect();
    for absent in [
        "refactor.rewrite.merge",
        "refactor.rewrite.split",
        "refactor.rewrite.layout.compact",
        "refactor.rewrite.coordinates.remove",
        "refactor.rewrite.startHere",
    ] {
        assert!(!ids.contains(&absent), "{absent} in {ids:?}");
    }
    assert!(
        ids.contains(&"refactor.rewrite.reverse") && ids.contains(&"refactor.rewrite.number"),
        "{ids:?}"
    );
}

/// A closed contour of lines and arcs about the origin, cut from there: its nodes on the grid and its bulges.
fn any_contour() -> impl Strategy<Value = Vec<(i64, i64, f64)>> {
    let corner = (
        5_000_i64..25_000,
        prop_oneof![2 => Just(0.0), 1 => 0.05_f64..0.6, 1 => -0.3_f64..-0.05],
    );
    prop::collection::vec(corner, 4..14).prop_map(|corners| {
        let step = std::f64::consts::TAU / corners.len() as f64;
        let vertex = |(index, (radius, bulge)): (usize, (i64, f64))| {
            let (sin, cos) = (index as f64 * step).sin_cos();
            (
                (radius as f64 * cos).round() as i64,
                (radius as f64 * sin).round() as i64,
                bulge,
            )
        };
        corners.into_iter().enumerate().map(vertex).collect()
    })
}

fn program_of(contour: &[(i64, i64, f64)]) -> Option<String> {
    let mut blocks = Vec::new();
    let node = |&(x, y, _): &(i64, i64, f64)| Node { x, y };
    let point = |node: Node| Point::new(node.x as f64, node.y as f64);
    let origin = Node { x: 0, y: 0 };
    let first = node(contour.first()?);
    encode(
        &Segment::line(point(origin), point(first)),
        origin,
        first,
        LARGEST,
        &mut blocks,
    )?;
    for (index, vertex) in contour.iter().enumerate() {
        let (from, to) = (node(vertex), node(&contour[(index + 1) % contour.len()]));
        encode(
            &Segment::from_bulge(point(from), point(to), vertex.2),
            from,
            to,
            LARGEST,
            &mut blocks,
        )?;
    }
    encode(
        &Segment::line(point(first), point(origin)),
        first,
        origin,
        LARGEST,
        &mut blocks,
    )?;
    let mut text = Vec::new();
    for block in &blocks {
        super::super::layout::push_fields(
            &mut text,
            crate::settings::Layout::Compact,
            &block.block,
            None,
        );
        text.push(b'\n');
    }
    String::from_utf8(text).ok().map(|text| text + "DD\n")
}

/// Twice the area of the contour, and its length, µm.
fn measure(text: &str) -> (f64, f64) {
    let trace = read(text).trace();
    let found = cuts(&trace);
    assert_eq!(
        (
            found.len(),
            found[0].lead_in,
            found[0].lead_out,
            found[0].closed
        ),
        (1, 1, 1, true),
        "{text}"
    );
    let steps = &trace.steps[found[0].contour_steps()];
    let ideals = || steps.iter().filter_map(|step| step.ideal.as_ref());
    (
        ideals().map(|ideal| ideal.twice_area(steps[0].start)).sum(),
        ideals().map(Segment::length).sum(),
    )
}

proptest! {
    #[test]
    fn refactorings_change_the_path_exactly_as_they_say(contour in any_contour(), cursor in 0_usize..16) {
        let Some(text) = program_of(&contour) else { return Ok(()) };
        let (area, length) = measure(&text);
        let run = |id: &str, text: &str| refactored(id, text);
        let again = |id: &str, times: usize| (0..times).try_fold(text.clone(), |text, _| run(id, &text));
        // Area and length within the effect of 2 µm at each node.
        let blocks = text.lines().count() as f64;
        let near = |found: (f64, f64), sign: f64, scale: f64| {
            let room = 6.0 * blocks * scale.max(1.0);
            (found.0 - sign * area * scale * scale).abs() <= room * length * scale.max(1.0) && (found.1 - length * scale).abs() <= room
        };
        let reversed = run("reverse", &text).map_err(TestCaseError::fail)?;
        prop_assert!(near(measure(&reversed), -1.0, 1.0), "{text}\n{reversed}");
        let back = run("reverse", &reversed).map_err(TestCaseError::fail)?;
        prop_assert!(near(measure(&back), 1.0, 1.0), "{text}\n{back}");
        for id in ["mirror.x", "mirror.y"] {
            let mirrored = run(id, &text).map_err(TestCaseError::fail)?;
            let found = measure(&mirrored);
            prop_assert!((found.0 + area).abs() <= 1e-3 * area.abs().max(1.0) && (found.1 - length).abs() < 1e-3 * length, "{text}\n{mirrored}");
            prop_assert_eq!(again(id, 2).map_err(TestCaseError::fail)?, text.clone());
        }
        for id in ["rotate.left", "rotate.right"] {
            prop_assert_eq!(again(id, 4).map_err(TestCaseError::fail)?, text.clone());
        }
        prop_assert_eq!(again("rotate.half", 2).map_err(TestCaseError::fail)?, text.clone());
        let scaled = run("scale.inchToMm", &text).map_err(TestCaseError::fail)?;
        prop_assert!(near(measure(&scaled), 1.0, 25.4), "{text}\n{scaled}");
        let smaller = run("scale.mmToInch", &scaled).map_err(TestCaseError::fail)?;
        prop_assert!(near(measure(&smaller), 1.0, 1.0), "{text}\n{smaller}");
        // The way in may cut the contour; then it is refused, and nothing else is wrong.
        let line = cursor % (text.lines().count() - 1);
        let at: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
        let mut marked = text.clone();
        marked.insert(at, '|');
        match run("startHere", &marked) {
            Ok(moved) => prop_assert!(near(measure(&moved), 1.0, 1.0), "{text}\n{moved}"),
            Err(reason) => prop_assert!(reason.contains("cut the contour") || reason.contains("is a lead-in or lead-out"), "{reason}\n{text}"),
        }
    }
}

/// A circle about the origin, or nearly one, between quarter arcs in and out of it and lines to its thread hole.
fn circle_of(radius: i64, way: i64, start: f64, sweep: f64) -> Option<String> {
    let mut blocks = Vec::new();
    let at = |radius: f64, angle: f64| Point::from(direction(angle) * radius);
    let hole = snap(at((radius - 2 * way) as f64, start))?;
    let turn = std::f64::consts::FRAC_PI_2.copysign(sweep);
    let lead = |angle: f64, from: f64| {
        let center = at((radius - way) as f64, angle);
        Segment::Arc(Arc::from_center(center, way as f64, angle + from, turn))
    };
    let circle = Segment::Arc(Arc::from_center(
        Point::origin(),
        radius as f64,
        start,
        sweep,
    ));
    let (into, out) = (lead(start, -turn), lead(start + sweep, 0.0));
    let begin = snap(into.start())?;
    let end = snap(out.end())?;
    let line = |from, to| (Segment::line(point_of(from), point_of(to)), from, to);
    let node = |point| snap(point);
    let pieces = [
        line(hole, begin),
        (into, begin, node(into.end())?),
        (circle, node(into.end())?, node(out.start())?),
        (out, node(out.start())?, end),
        line(end, hole),
    ];
    for (piece, from, to) in pieces {
        encode(&piece, from, to, LARGEST, &mut blocks)?;
    }
    let mut text = String::new();
    for block in &blocks {
        let mut line = Vec::new();
        push_fields(
            &mut line,
            crate::settings::Layout::Compact,
            &block.block,
            None,
        );
        text += &String::from_utf8(line).ok()?;
        text += "\n";
    }
    Some(text + "DD\n")
}

proptest! {
    #[test]
    fn circles_stay_circles(
        (radius, way) in (300_i64..12_000, 30_i64..140),
        start in prop_oneof![Just(0.0), -3.0_f64..3.0],
        sweep in prop_oneof![3 => Just(TAU), 1 => 5.0..TAU],
        turns_left: bool,
    ) {
        let sweep = if turns_left { sweep } else { -sweep };
        let Some(text) = circle_of(radius, way, start, sweep) else { return Ok(()) };
        let length = |text: &str| -> f64 {
            let trace = read(text).trace();
            trace.steps.iter().filter_map(|step| step.ideal.as_ref()).map(Segment::length).sum()
        };
        for (id, scale) in [("reverse", 1.0), ("scale.inchToMm", 25.4), ("scale.mmToInch", 1.0 / 25.4), ("mirror.x", 1.0)] {
            // What becomes too short, or is not closed, is refused.
            let Ok(after) = refactored(id, &text) else { continue };
            let miss = (length(&after) - length(&text) * scale).abs();
            prop_assert!(miss <= 30.0 * scale.max(1.0), "{id}: {miss} µm\n{text}\n{after}");
        }
    }
}

#[test]
fn a_circle_between_arcs_is_reversed_as_a_circle() {
    check(
        "reverse",
        "B200B100B200GXL2\nB133B100B233GYNR1\nB7423B0B29692GYSR4\nB167B0B234GYNR3\nB200B100B200GXL1\nDD\n",
        "B200B100B200GXL3\nB133B100B233GYSR4\nB7423B0B29692GYNR1\nB166B0B232GYSR2\nB200B100B200GXL4\nDD\n",
    );
}

#[test]
fn end_words_of_other_controllers_end_no_program_before_its_own() {
    check(
        "mirror.x",
        "B5B0B5GXL1\nE\nB0B5B5GYL2\nE\n",
        "B5B0B5GXL3\nE\nB0B5B5GYL2\nE\n",
    );
    check(
        "mirror.x",
        "B5B0B5GXL1\nE\nB0B5B5GYL2\nDD B7B0B7GXL1\n",
        "B5B0B5GXL3\nE\nB0B5B5GYL2\nDD B7B0B7GXL1\n",
    );
}

#[test]
fn the_pause_before_a_tab_stays_where_it_is() {
    let text = "B4000B0B4000GXL1\nB0B5000B5000GYL2\n|B20000B0B20000GXL1\nB0B20000B20000GYL4\nB20000B0B20000GXL3\nB0B12000B12000GYL2\nD\n\
                B0B3000B3000GYL2\nB4000B0B4000GXL3\nDD\n";
    for id in ["reverse", "startHere"] {
        refused(id, text, "the contour pauses before line 8");
    }
    check("merge", text, &text.replace('|', ""));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn every_refactoring_of_every_program_is_edits_or_a_reason(
        text in "(((N[0-9] )?B[0-9]{1,4}B[0-9]{1,4}B[0-9]{1,5}G[XY](L|SR|NR)[1-4]( ; [0-9]\\.[0-9]{3} , 1\\.0)?|B5B0B5GXL1|B0B5B5GYL2|B5B5B5GYL3|B4B4B4GXDDNR1|D|DD|E|FF|A|text|; Start Point = 1 , 2|)(\n| | ; x\n)){0,24}",
        copies in 1_usize..4,
        (start, length) in (0_usize..200, 0_usize..60),
    ) {
        tests::are_edits_or_reasons(Language::ThreeB, &text.repeat(copies), start..start + length)?;
    }
}
