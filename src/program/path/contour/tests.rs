use crate::finding::Rule;
use crate::ide::SymbolKind;
use crate::ide::program::symbols;
use crate::program::path::cuts;
use crate::program::path::tolerance;
use crate::program::{Document, Language, convert};
use crate::settings::Effective;
use proptest::prelude::*;

/// The verdict of every reader of a program on its one contour: closed or not.
#[track_caller]
fn answers(language: Language, text: &str) -> bool {
    let document = Document::read(language, text.into(), &Effective::default());
    let (findings, _) = document.findings(&Effective::default(), usize::MAX);
    let by_rule = !findings
        .iter()
        .any(|finding| finding.rule == Rule::NotClosed);
    let contours: Vec<_> = cuts(&document.trace())
        .into_iter()
        .filter(|cut| !cut.is_way)
        .collect();
    let by_cuts = contours.iter().all(|cut| cut.closed);
    let outline = symbols(&document);
    let mut contours_of_outline = outline
        .iter()
        .filter(|symbol| symbol.kind == SymbolKind::Cut);
    let by_outline = contours_of_outline.all(|symbol| symbol.detail.starts_with("closed"));
    let converted = convert::cuts(&document);
    let by_conversion = converted.cuts.iter().all(|cut| cut.closed);
    let all = [by_rule, by_cuts, by_outline, by_conversion];
    assert!(
        all.iter().all(|one| *one == by_rule),
        "rule, cuts, outline, conversion: {all:?}\n{text}"
    );
    assert_eq!(converted.cuts.len(), contours.len(), "{text}");
    for (own, cut) in converted.cuts.iter().zip(&contours) {
        // Where a cut meets itself within a segment, that is split.
        assert!(
            own.lead_in - cut.lead_in <= 1 && own.lead_out - cut.lead_out <= 1,
            "{text}"
        );
    }
    by_rule
}

/// A way through places in µm; `None` is a stop.
fn three_b(way: &[Option<[i64; 2]>]) -> String {
    let mut text = String::new();
    let mut at = [0, 0];
    for step in way {
        let Some([x, y]) = *step else {
            text.push_str("D\n");
            continue;
        };
        let (dx, dy) = (x - at[0], y - at[1]);
        at = [x, y];
        let quadrant = match (dx, dy) {
            (dx, dy) if dx > 0 && dy >= 0 => 1,
            (dx, dy) if dx <= 0 && dy > 0 => 2,
            (dx, dy) if dx < 0 && dy <= 0 => 3,
            _ => 4,
        };
        let (a, b) = (dx.abs(), dy.abs());
        let axis = if a > b || (a == b && quadrant % 2 == 0) {
            'X'
        } else {
            'Y'
        };
        text.push_str(&format!("B{a}B{b}B{}G{axis}L{quadrant}\n", a.max(b)));
    }
    text + "DD\n"
}

fn iso(way: &[Option<[i64; 2]>]) -> String {
    let line = |step: &Option<[i64; 2]>| match step {
        Some([x, y]) => format!("G01 X{:.3} Y{:.3}\n", *x as f64 / 1e3, *y as f64 / 1e3),
        None => "M00\n".to_owned(),
    };
    format!(
        "G92 X0. Y0.\nG90\n{}M02\n",
        way.iter().map(line).collect::<String>()
    )
}

#[track_caller]
fn check(way: &[Option<[i64; 2]>], expected: bool) {
    assert_eq!(
        answers(Language::ThreeB, &three_b(way)),
        expected,
        "{}",
        three_b(way)
    );
    assert_eq!(answers(Language::Iso, &iso(way)), expected, "{}", iso(way));
}

fn some(way: &[[i64; 2]]) -> Vec<Option<[i64; 2]>> {
    way.iter().map(|at| Some(*at)).collect()
}

#[test]
fn the_tolerance_grows_as_a_random_walk() {
    assert_eq!(tolerance(0), 2.0);
    assert_eq!(tolerance(1), 3.0);
    assert_eq!(tolerance(156).round(), 14.0);
}

#[test]
fn ways_run_along_each_other_there_and_back_and_not_beside() {
    use super::runs_along;
    use crate::geometry::Vector;
    let [lead, across, steep] = [[4.0, 5.0], [5.0, -4.0], [4.0, -5.0]].map(Vector::from);
    for along in [2.0, 0.5, -1.0] {
        assert!(runs_along(lead, lead * along));
        assert!(!runs_along(lead, across * along));
        assert!(!runs_along(lead, steep * along));
    }
}

#[test]
fn a_square_closes_behind_a_bent_way_in() {
    let square = [
        [9000, 2000],
        [9000, 12000],
        [-1000, 12000],
        [-1000, 2000],
        [4000, 2000],
    ];
    let bent = [[0, -3000], [4000, -3000], [4000, 2000]];
    check(&some(&[&bent[..], &square[..]].concat()), true);
    // A way out that goes elsewhere, and one back along the way in.
    check(
        &some(&[&bent[..], &square[..], &[[5000, -4000]]].concat()),
        true,
    );
    check(
        &some(&[&bent[..], &square[..], &[[4000, -3000], [0, -3000], [0, 0]]].concat()),
        true,
    );
    // It ends 1 mm beside the end of its way in.
    check(
        &some(&[&bent[..], &square[..4], &[[3000, 2000]]].concat()),
        false,
    );
    check(&some(&square), false);
}

#[test]
fn a_stop_before_the_tab_does_not_end_a_contour() {
    let [hole, entry] = [[0, 0], [4000, 0]];
    let main = [
        entry,
        [4000, 5000],
        [24000, 5000],
        [24000, -15000],
        [4000, -15000],
        [4000, -3000],
    ];
    let with = |behind: &[Option<[i64; 2]>]| [&some(&main)[..], &[None], behind].concat();
    // The tab closes the contour; with and without a way out; or meets it past its entry; or stops twice.
    check(&with(&some(&[entry])), true);
    check(&with(&some(&[entry, hole])), true);
    check(&with(&some(&[[4000, 300]])), true);
    check(
        &with(&[Some([4000, -1000]), None, Some(entry), Some(hole)]),
        true,
    );
    // The tab is left standing.
    check(&[&some(&main)[..], &[None]].concat(), false);
    check(&with(&some(&[[3000, -9000]])), false);
    for (language, text) in [
        (Language::ThreeB, three_b(&with(&some(&[entry, hole])))),
        (Language::Iso, iso(&with(&some(&[entry, hole])))),
    ] {
        let document = Document::read(language, text.clone().into(), &Effective::default());
        let trace = document.trace();
        let contours = cuts(&trace);
        assert_eq!(contours.len(), 1, "{text}");
        assert_eq!(
            (
                contours[0].lead_in,
                contours[0].lead_out,
                contours[0].closed
            ),
            (1, 1, true),
            "{text}"
        );
        assert!(
            trace
                .steps
                .iter()
                .filter(|step| step.moves())
                .all(|step| step.contour == 0),
            "{text}"
        );
        let converted = convert::cuts(&document);
        assert_eq!(
            (converted.cuts.len(), converted.stops.len()),
            (1, 1),
            "{text}"
        );
        assert_eq!(converted.cuts[0].contour().len(), 6, "{text}");
    }
}

#[test]
fn two_stops_with_a_way_between_are_a_jump() {
    let text = "B4000B0B4000GXL1\nB4000B0B16000GYNR1\nB4000B0B4000GXL3\nD\nB50000B0B50000GXL1\nD\nB4000B0B4000GXL1\n\
                B4000B0B16000GYNR1\nB4000B0B4000GXL3\nDD\n";
    assert!(answers(Language::ThreeB, text));
    let document = Document::read(Language::ThreeB, text.into(), &Effective::default());
    let contours: Vec<_> = cuts(&document.trace())
        .iter()
        .map(|cut| (cut.contour, cut.is_way))
        .collect();
    assert_eq!(contours, [(0, false), (1, true), (2, false)]);
}

/// The ways in and out of each contour of a program, and whether it closes.
fn leads(language: Language, text: &str) -> Vec<(usize, usize, bool)> {
    let document = Document::read(language, text.into(), &Effective::default());
    let all = cuts(&document.trace());
    let contours = all.iter().filter(|cut| !cut.is_way);
    contours
        .map(|cut| (cut.lead_in, cut.lead_out, cut.closed))
        .collect()
}

/// A way in and out, and a contour between, that begins and ends in one place: each as its program is written.
#[test]
fn leads_that_part_are_no_part_of_their_contour() {
    let programs = [
        // Tangent arcs, each with a straight piece.
        (
            "B2450B1415B2450GXL4\nB816B1416B1852GYNR3\nB4900B0B19600GYNR1\nB1634B1B2450GXNR1\nB2450B1415B2450GXL3\nDD\n",
            (2, 2),
        ),
        // A full circle, an arc further, and straight back.
        (
            "B500B0B500GXL3\nB5146B0B20584GYSR4\nB5146B0B300GYSR4\nB509B300B509GXL1\nDD\n",
            (1, 2),
        ),
        // The same turned round: it begins along its end.
        (
            "B509B300B509GXL3\nB5137B304B300GYNR4\nB5146B0B20584GYNR1\nB500B0B500GXL1\nDD\n",
            (2, 1),
        ),
        // One way, there and back.
        (
            "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n",
            (1, 1),
        ),
        ("B5000B0B20000GYNR1\nDD\n", (0, 0)),
    ];
    for (text, (lead_in, lead_out)) in programs {
        let expected = [(lead_in, lead_out, true)];
        assert_eq!(leads(Language::ThreeB, text), expected, "{text}");
    }
    // A small triangle on the way is a way in and out; one that is as large as what it leads to is a part of the
    // contour, which touches itself there.
    let touching = |size: i64| {
        let lobe = [[5000, 0], [9000, -4000], [9000, 4000], [5000, 0]];
        some(&[&lobe[..], &[[5000 - size, size], [0, 0]]].concat())
    };
    for (size, expected) in [(500, (1, 2, true)), (5000, (0, 0, true))] {
        let mut way = touching(size);
        if size == 500 {
            // From nearby.
            let near = |at: [i64; 2]| Some([at[0] - 4800, at[1]]);
            way = way.into_iter().flatten().map(near).collect();
            way.pop();
            way.push(Some([0, 0]));
        }
        assert_eq!(
            leads(Language::ThreeB, &three_b(&way)),
            [expected],
            "{way:?}"
        );
        assert_eq!(leads(Language::Iso, &iso(&way)), [expected], "{way:?}");
    }
}

#[test]
fn a_way_between_two_stops_is_a_jump_however_many_blocks_it_has() {
    let square = [
        [1000, 0],
        [1000, 2000],
        [-1000, 2000],
        [-1000, 0],
        [1000, 0],
        [0, 0],
    ];
    let program = |way: &[[i64; 2]]| {
        let mut steps = some(&square);
        steps.push(None);
        steps.extend(some(way));
        steps.push(None);
        let [x, y] = way[way.len() - 1];
        steps.extend(square.map(|[a, b]| Some([a + x, b + y])));
        three_b(&steps)
    };
    let is_way = |way: &[[i64; 2]]| {
        let text = program(way);
        let document = Document::read(Language::ThreeB, text.clone().into(), &Effective::default());
        let trace = document.trace();
        let all = cuts(&trace);
        assert_eq!(all.len(), 3, "{text}");
        assert!(answers(Language::ThreeB, &text) || !all[1].is_way, "{text}");
        all[1].is_way
    };
    // Straight on, in any direction, cut into blocks of whole micrometres.
    for (x, y) in [(70_000, 0), (-70_001, 3), (12_345, 67_890), (-999, -70_000)] {
        for blocks in 1..60_i64 {
            let node = |nth: i64| [x * nth / blocks, y * nth / blocks];
            assert!(
                is_way(&(1..=blocks).map(node).collect::<Vec<_>>()),
                "{x} {y} {blocks}"
            );
        }
    }
    // Stairs of some steps.
    for blocks in 2..9_i64 {
        let node = |nth: i64| [9_000 * ((nth + 1) / 2), 9_000 * (nth / 2)];
        assert!(
            is_way(&(1..=blocks).map(node).collect::<Vec<_>>()),
            "{blocks}"
        );
    }
    // A square with one wrong number is none.
    for wrong in 0..4 {
        let mut square = [[9_000, 0], [0, 9_000], [-9_000, 0], [0, -9_000]];
        let longer = |side: &mut [i64; 2]| side.iter_mut().for_each(|by| *by *= 3);
        longer(&mut square[wrong]);
        let nodes = square.iter().scan([0, 0], |at: &mut [i64; 2], by| {
            *at = [at[0] + by[0], at[1] + by[1]];
            Some(*at)
        });
        assert!(!is_way(&nodes.collect::<Vec<_>>()), "{wrong}");
    }
}

/// A ring of places about a middle, none of which lie on one line.
fn ring() -> impl Strategy<Value = Vec<[i64; 2]>> {
    (
        prop::collection::vec(3_000.0_f64..20_000.0, 3..12),
        0.0_f64..1.0,
    )
        .prop_map(|(radii, turned)| {
            let count = radii.len() as f64;
            let at = |(index, radius): (usize, &f64)| {
                let angle = (index as f64 + turned) / count * std::f64::consts::TAU;
                [
                    (radius * angle.cos()).round() as i64,
                    (radius * angle.sin()).round() as i64,
                ]
            };
            radii.iter().enumerate().map(at).collect()
        })
}

fn ways() -> impl Strategy<Value = Vec<[i64; 2]>> {
    prop::collection::vec(
        (20_500_i64..60_000, 20_500_i64..60_000).prop_map(|(x, y)| [x, y]),
        0..10,
    )
}

proptest! {
    #[test]
    fn all_say_the_same_however_long_the_ways_are(
        ring in ring(), way_in in ways(), way_out in ways(),
        (back, stop, miss) in (any::<bool>(), 0_usize..40, prop_oneof![3 => Just(0), 1 => 40_i64..900]),
    ) {
        // From the origin, inside the ring, or from outside.
        let mut way: Vec<Option<[i64; 2]>> = some(&way_in);
        way.extend(some(&ring));
        let begin = ring[0];
        way.push(Some([begin[0] + miss, begin[1]]));
        if back {
            way.extend(some(&way_in).into_iter().rev().skip(1));
            way.push(Some([0, 0]));
        } else if miss == 0 {
            way.extend(some(&way_out));
        }
        if stop > way_in.len() + 1 && stop < way_in.len() + ring.len() {
            way.insert(stop, None);
        }
        let expected = miss == 0 || back;
        for (language, text) in [(Language::ThreeB, three_b(&way)), (Language::Iso, iso(&way))] {
            let said = answers(language, &text);
            // A way out from a contour that no way leads to is none.
            let is_plain = !way_in.is_empty() || back || way_out.is_empty();
            prop_assert!(!is_plain || said == expected, "{said}, expected {expected}\n{text}");
        }
    }

    #[test]
    fn arcs_that_run_along_a_contour_where_they_meet_it_lead_there(
        ring in ring(), (hole, radii) in ((-9_000_i64..9_000, -9_000_i64..9_000), (200.0_f64..3_000.0, 200.0_f64..3_000.0)),
    ) {
        use crate::geometry::{Point, Vector};
        let place = |at: [i64; 2]| Point::new(at[0] as f64, at[1] as f64);
        let begin = place(ring[0]);
        let hole = begin + Vector::new(hole.0 as f64 * 0.5 + 50.0, hole.1 as f64 * 0.5);
        // To the left of the first and the last side, which is inside.
        let arc = |along: Vector, radius: f64| {
            let left = Vector::new(-along.y, along.x) * (radius / along.norm());
            (begin + left, left)
        };
        let (center_in, left_in) = arc(place(ring[1]) - begin, radii.0);
        let (center_out, left_out) = arc(begin - place(ring[ring.len() - 1]), radii.1);
        let [start, end] = [
            center_in - Vector::new(left_in.y, -left_in.x),
            center_out + Vector::new(left_out.y, -left_out.x),
        ];
        let mut text = "G92 X0. Y0.\nG90\n".to_owned();
        let shift = |at: Point| format!("X{:.3} Y{:.3}", (at.x - hole.x) / 1e3, (at.y - hole.y) / 1e3);
        let from_start = |center: Point, start: Point| format!("I{:.3} J{:.3}", (center.x - start.x) / 1e3, (center.y - start.y) / 1e3);
        text += &format!("G01 {}\n", shift(start));
        text += &format!("G03 {} {}\n", shift(begin), from_start(center_in, start));
        for at in ring[1..].iter().chain([&ring[0]]) {
            text += &format!("G01 {}\n", shift(place(*at)));
        }
        text += &format!("G03 {} {}\n", shift(end), from_start(center_out, begin));
        text += &format!("G01 {}\nM02\n", shift(hole));
        let found = leads(Language::Iso, &text);
        prop_assert_eq!(found, [(2, 2, true)], "{}", text);
    }
}
