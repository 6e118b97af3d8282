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
}
