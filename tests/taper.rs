//! Wires that lean: where the upper end goes, and which arcs have no room for it.

use proptest::prelude::*;
use wedm::finding::{Rule, Severity, sentence};
use wedm::geometry::{Point, Segment};
use wedm::program::{Document, Language};
use wedm::settings::{Effective, from_toml};

fn settings(text: &str) -> Effective {
    let (settings, errors) = from_toml(text);
    assert_eq!(errors, [], "{text}");
    Effective::of(&settings)
}

const HEIGHT: &str = "correction = 0.12\n[job]\nthickness = 40\n";

fn read(text: &str, settings: &Effective) -> Document {
    Document::read(Language::Iso, text.to_owned().into(), settings)
}

/// What the rule says, with the line from 1.
fn said(text: &str, settings: &Effective) -> Vec<(usize, Severity, String)> {
    let document = read(text, settings);
    let (found, _) = document.findings(settings, usize::MAX);
    let own = found.iter().filter(|found| found.rule == Rule::Taper);
    own.map(|found| {
        let line = match &found.place {
            wedm::finding::Place::Text { range } => document.text().line_of(range.start) + 1,
            place => panic!("{place:?}"),
        };
        (line, found.severity, sentence(found, 1.0))
    })
    .collect()
}

/// Where the upper end of each move begins and ends, mm; nothing where it goes with the lower one.
fn upper(text: &str, settings: &Effective) -> Vec<Option<[Point; 2]>> {
    let trace = read(text, settings).trace();
    let ends =
        |pieces: &Vec<Segment>| Some([pieces.first()?.start() / 1e3, pieces.last()?.end() / 1e3]);
    trace.upper.iter().map(ends).collect()
}

fn near(found: Point, expected: [f64; 2]) -> bool {
    (found - Point::from(expected)).norm() < 5e-5
}

#[test]
fn the_upper_profile_lies_beside_the_programmed_one() {
    // 40 × 20, counter-clockwise, from outside.
    let round = |tilt: &str| {
        format!(
            "G92 X20. Y-5.\nG90\n{tilt}\nG01 X20. Y0.\nX40.\nY20.\nX0.\nY0.\nX20.\nG50\nY-5.\nM02\n"
        )
    };
    let by = 2_f64.to_radians().tan() * 40.0;
    assert!((by - 1.3968).abs() < 5e-5);
    let rows = [
        ("G51 A2.", HEIGHT, by),
        ("G52 A2.", HEIGHT, -by),
        ("G51 T2.", HEIGHT, by),
        ("G141 A2.", HEIGHT, by),
        ("G142 A2.", HEIGHT, -by),
        ("TP0.0 TN40.0\nG51 A2.", "", by),
        ("TP40.0 TN0.0\nG51 A2.", "", -by),
        ("TP0.0 TN20.0\nG51 A2.", HEIGHT, by / 2.0),
    ];
    for (tilt, height, by) in rows {
        let found = upper(&round(tilt), &settings(height));
        // The upper end leaves the lower one on the way in, and comes back to it on the way out.
        let expected = [
            Some([[20.0, -5.0], [20.0, by]]),
            Some([[20.0, by], [40.0 - by, by]]),
            Some([[40.0 - by, by], [40.0 - by, 20.0 - by]]),
            Some([[40.0 - by, 20.0 - by], [by, 20.0 - by]]),
            Some([[by, 20.0 - by], [by, by]]),
            Some([[by, by], [20.0, by]]),
            Some([[20.0, by], [20.0, -5.0]]),
        ];
        assert_eq!(found.len(), expected.len(), "{tilt}: {found:?}");
        for (found, expected) in found.iter().zip(expected) {
            let (found, expected) = (found.unwrap(), expected.unwrap());
            assert!(
                near(found[0], expected[0]) && near(found[1], expected[1]),
                "{tilt}: {found:?}, expected {expected:?}"
            );
        }
    }
    // What is not said is not shown, and the reason is.
    for (tilt, height, why) in [
        ("G51 A2.", "", "job.thickness"),
        ("G51", HEIGHT, "line 3 says no angle"),
        ("G51 U3.500", HEIGHT, "line 3 says no angle"),
    ] {
        let settings = settings(height);
        assert!(upper(&round(tilt), &settings).iter().all(Option::is_none));
        let picture = read(&round(tilt), &settings);
        let trace = picture.trace();
        assert!(format!("{trace:?}").contains(why), "{tilt}");
    }
    assert!(upper(&round(""), &settings(HEIGHT)).is_empty());
}

#[test]
fn the_upper_guide_and_a_second_contour_are_followed() {
    let guide =
        "G92 X0 Y0\nG90\nG01 X10. Y0. U1. V0.5\nY10. U2.\nX0.\nG91\nY-10. U-2. V-0.5\nM02\n";
    let found = upper(guide, &settings(""));
    let expected = [
        Some([[0.0, 0.0], [11.0, 0.5]]),
        Some([[11.0, 0.5], [12.0, 10.5]]),
        Some([[12.0, 10.5], [2.0, 10.5]]),
        Some([[2.0, 10.5], [0.0, 0.0]]),
    ];
    for (found, expected) in found.iter().zip(expected) {
        let (found, expected) = (found.unwrap(), expected.unwrap());
        assert!(
            near(found[0], expected[0]) && near(found[1], expected[1]),
            "{found:?}"
        );
    }
    let second = "TP0.0; TN20.0;\nG92 X0. Y0.\nG90\nG01 X20. Y0. : G01 X19. Y1.;\nG03 X20. Y10. I0. J5. : G03 X19. Y9. I0. J4.;\nG01 X0. Y0. : G01 X0. Y0.;\nM02\n";
    let document = read(second, &settings(""));
    let trace = document.trace();
    let ends: Vec<Point> = trace
        .upper
        .iter()
        .filter_map(|own| Some(own.last()?.end() / 1e3))
        .collect();
    let expected = [[19.0, 1.0], [19.0, 9.0], [0.0, 0.0]];
    assert!(
        ends.len() == 3
            && ends
                .iter()
                .zip(expected)
                .all(|(found, expected)| near(*found, expected)),
        "{ends:?}"
    );
    assert!(matches!(trace.upper[1][0], Segment::Arc(arc) if (arc.radius - 4000.0).abs() < 1.0));
}

/// A contour with one arc of R at a corner: an opening's when it is cut with the wire to its left.
fn with_corner(radius: f64, words: &str) -> String {
    let begin = 30.0 - radius;
    format!(
        "G92 X15. Y10.\nG90\n{words}\nG01 X15. Y0.\nX{begin:.4}\nG03 X30. Y{radius:.4} I0. J{radius:.4}\nG01 Y20.\nX0.\nY0.\nX15.\nG40\nG50\nY10.\nM02\n"
    )
}

#[test]
fn an_arc_that_narrows_needs_its_correction_and_the_height() {
    // c / cos β + H tan β, and what holds without one of them.
    let least = |c: f64, degrees: f64, h: f64| {
        let angle = degrees.to_radians();
        c / angle.cos() + h * angle.tan()
    };
    assert!((least(0.12, 2.0, 40.0) - 1.5169).abs() < 5e-5);
    let rows: [(&str, f64, f64, f64, f64); 6] = [
        // The wire within the arc, which narrows: to the left, as the way turns.
        ("G41 D1\nG51 A2.", 0.12, 2.0, 40.0, least(0.12, 2.0, 40.0)),
        ("G41 D1\nG51 A0.5", 0.2, 0.5, 25.0, least(0.2, 0.5, 25.0)),
        ("G41 D1\nG51 A15.", 0.1, 15.0, 10.0, least(0.1, 15.0, 10.0)),
        // Within one that widens.
        ("G41 D1\nG52 A30.", 0.12, 30.0, 40.0, least(0.12, 30.0, 0.0)),
        // Outside of one that narrows, and where nobody offsets: something is left.
        ("G42 D1\nG51 A2.", 0.12, 2.0, 40.0, least(0.0, 2.0, 40.0)),
        ("G51 A2.", 0.12, 2.0, 40.0, least(0.0, 2.0, 40.0)),
    ];
    for (words, correction, _, height, least) in rows {
        let settings = settings(&format!(
            "correction = {correction}\n[job]\nthickness = {height}\n"
        ));
        let line = 5 + words.lines().count();
        let below = said(&with_corner(least - 0.002, words), &settings);
        assert!(
            matches!(&below[..], [(at, Severity::Error, _)] if *at == line),
            "{words}: {below:?}"
        );
        assert_eq!(
            said(&with_corner(least + 0.002, words), &settings),
            [],
            "{words}"
        );
    }
    let settings = settings(HEIGHT);
    let told = said(&with_corner(1.5, "G41 D1\nG51 A2."), &settings);
    assert_eq!(
        told[0].2,
        "arc R 1.500 mm is below 1.517 mm: under a taper of 2.000° it narrows by 1.397 mm up to the other plane, and the wire needs its correction in addition"
    );
    // An arc that widens needs room only for the wire itself.
    let told = said(&with_corner(0.12, "G41 D1\nG52 A15."), &settings);
    assert_eq!(
        told[0].2,
        "arc R 0.1200 mm is below 0.1242 mm: under a taper of 15.000° it widens up to the other plane, but in its own plane the leaning wire's axis keeps the correction divided by the cosine of that angle"
    );
    // The program's own table says the correction.
    let own = with_corner(1.55, "H1=0.2\nG41 H1\nG51 A2.");
    assert_eq!(said(&own, &settings).len(), 1);
    // What is followed is no longer left to the machine.
    let document = read(&with_corner(1.6, "G41 D1\nTP0. TN40.\nG51 A2."), &settings);
    assert_eq!(document.findings(&settings, usize::MAX).0, []);
    // An outer arc that widens, and a program that does not lean, have room.
    assert_eq!(said(&with_corner(0.3, "G42 D1\nG52 A2."), &settings), []);
    assert_eq!(said(&with_corner(0.3, "G41 D1"), &settings), []);
    assert_eq!(
        said(&with_corner(0.3, "G41 D1\nG51 A2.\nG50"), &settings),
        []
    );
}

#[test]
fn a_height_that_is_missing_is_said_once() {
    let text = with_corner(0.3, "G41 D1\nG51 A2.");
    let found = said(&text, &settings("correction = 0.12\n"));
    assert!(
        matches!(&found[..], [(4, Severity::Information, said)] if said.contains("job.thickness")),
        "{found:?}"
    );
    assert_eq!(said(&text, &settings("[rules]\ntaper = \"off\"\n")), []);
    // TP and TN stand for it.
    let planes = with_corner(0.3, "G41 D1\nTP0. TN40.\nG51 A2.");
    assert_eq!(said(&planes, &settings("correction = 0.12\n")).len(), 1);
}

#[test]
fn an_edit_leaves_what_is_said_as_read_afresh() {
    let settings = settings(HEIGHT);
    let text = with_corner(1.5, "G41 D1\nG51 A2.");
    let mut document = read(&text, &settings);
    for (from, to) in [
        ("A2.", "A1."),
        ("A1.", "A9."),
        ("G51", "G52"),
        ("G52", "G51"),
        ("G50\n", ""),
    ] {
        let at = std::str::from_utf8(document.text().bytes())
            .unwrap()
            .find(from)
            .unwrap();
        document.edit(at..at + from.len(), to);
        let now = String::from_utf8(document.text().bytes().to_vec()).unwrap();
        let fresh = read(&now, &settings);
        assert_eq!(
            document.findings(&settings, usize::MAX),
            fresh.findings(&settings, usize::MAX),
            "{now}"
        );
        assert_eq!(document.trace().upper, fresh.trace().upper, "{now}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Round any convex contour of lines and arcs the upper profile goes on where it ended, and lies by the height and the angle beside the
    /// programmed one.
    #[test]
    fn the_upper_profile_is_one_way_at_one_distance(
        corners in 3..9_usize,
        size in 15.0..60.0_f64,
        radius in 0.0..3.0_f64,
        degrees in 0.1..5.0_f64,
        left in any::<bool>(),
    ) {
        let corner = |nth: usize| {
            let angle = std::f64::consts::TAU * nth as f64 / corners as f64;
            Point::new(size * angle.cos(), size * angle.sin())
        };
        let cut = |at: Point, to: Point| at + (to - at).normalize() * radius * (std::f64::consts::PI / corners as f64).tan();
        let mut text = String::from("G92 X0 Y0\nG90\nTP0. TN30.\n");
        text += &format!("{} A{degrees:.3}\n", if left { "G51" } else { "G52" });
        let begin = corner(0) + (corner(1) - corner(0)) * 0.5;
        text += &format!("G01 X{:.4} Y{:.4}\n", begin.x, begin.y);
        for nth in 1..=corners {
            let (before, at, next) = (corner(nth - 1), corner(nth % corners), corner((nth + 1) % corners));
            let (from, to) = (cut(at, before), cut(at, next));
            text += &format!("G01 X{:.4} Y{:.4}\n", from.x, from.y);
            if radius > 0.05 {
                text += &format!("G03 X{:.4} Y{:.4} R{radius:.4}\n", to.x, to.y);
            }
        }
        text += &format!("G01 X{:.4} Y{:.4}\nG50\nX0. Y0.\nM02\n", begin.x, begin.y);
        let trace = read(&text, &settings("")).trace();
        let by = f64::round(degrees * 1e3) / 1e3;
        let by = by.to_radians().tan() * 30.0e3;
        prop_assume!(!left || radius <= 0.05 || radius * 1e3 > by + 20.0);
        let pieces: Vec<Segment> = trace.upper.iter().flatten().copied().collect();
        for pair in pieces.windows(2) {
            prop_assert!((pair[0].end() - pair[1].start()).norm() < 3.0, "{text}\n{pair:?}");
        }
        let lower: Vec<Segment> = trace.steps.iter().filter_map(|step| step.ideal).collect();
        let round = &lower[1..lower.len() - 1];
        for piece in &pieces[1..pieces.len() - 1] {
            for share in [0.1, 0.5, 0.9] {
                let at = piece.point_at(share);
                let away = round.iter().map(|own| own.distance_to(at)).fold(f64::INFINITY, f64::min);
                // A corner of lines stays sharp on the outside.
                let sharp = by / (std::f64::consts::PI / corners as f64).cos();
                prop_assert!(away > by - 3.0 && away < sharp + 3.0, "{away} of {by}: {text}");
            }
        }
    }
}

/// A block that leads only the upper end elsewhere is no block that is repeated, and is not deleted.
#[test]
fn a_block_that_moves_only_the_upper_end_is_not_doubled() {
    let settings = settings("");
    for second in ["G01 X20. Y0. U0. V1.", "G01 X20. Y0. : X19. Y1."] {
        let text = format!(
            "G92 X0. Y0.\nG90\nG01 X10. Y0. U1. V0.\nG01 X20. Y0. U2. V0.\n{second}\nG01 X20. Y20. U1. V1.\nG01 X0. Y20.\nG01 X0. Y0. U0. V0.\nM02\n"
        );
        let doubled = |text: &str| {
            let (found, _) = read(text, &settings).findings(&settings, usize::MAX);
            let of_rule = found.iter().filter(|one| one.rule == Rule::DoubledBlock);
            of_rule.count()
        };
        assert_eq!(doubled(&text), 0, "{text}");
        let upright = text.replace(second, "G01 X20. Y0.").replace(" U2. V0.", "");
        assert_eq!(doubled(&upright), 1, "{upright}");
    }
}

/// What would part the upper end from the lower one, or turn the side to which the wire leans, is refused.
#[test]
fn no_refactoring_parts_the_upper_end_from_the_lower_one() {
    let settings = settings("");
    let second = "G92 X0. Y0.\nG90\nG01 X10. Y0. : X11. Y-1.\nG01 X20. Y0. : X21. Y-1.\nG01 X20. Y20. : X21. Y21.\nG01 X0. Y0. : X-1. Y-1.\nM02\n";
    let guide = second
        .replace(": X11. Y-1.", "U1. V-1.")
        .replace(": X21. Y-1.", "U2.")
        .replace(": X21. Y21.", "V0.")
        .replace(": X-1. Y-1.", "U0.");
    let side = "G92 X0. Y0.\nG90\nG141 A2.\nG01 X20. Y0.\nX20. Y20.\nX0.\nY0.\nG140\nM02\n";
    let all = ["mirror", "rotate", "scale", "coordinates"];
    for (text, refused) in [(second, &all[..]), (&guide, &all), (side, &["mirror"])] {
        let program = read(text, &settings);
        let mut count = 0;
        for proposal in wedm::program::refactorings(&program, &settings, 0..0, |_| true) {
            if refused.iter().any(|kind| proposal.id.contains(kind)) {
                assert!(proposal.edits.is_err(), "{}: {text}", proposal.id);
                count += 1;
            }
        }
        assert!(count >= 2, "{text}");
    }
}

/// Whole numbers in micrometres make angles of thousandths of a degree, and nobody leans a wire by 89°.
#[test]
fn an_angle_that_is_hardly_meant_is_named() {
    let program = |angle: &str, at: &str| {
        format!(
            "G92 X{at} Y0\nG90\nG51 {angle}\nG01 X9000 Y0\nG03 X10000 Y1000 I0 J1000\nG01 X10000 Y9000\nG50\nG01 X20000 Y9000\nM02\n"
        )
    };
    let whole = |angle: &str| program(angle, "0");
    let millimetres = |angle: &str| program(angle, "0").replace("000", ".");
    let set = settings(HEIGHT);
    for (text, severity, part) in [
        (
            whole("A2"),
            Some(Severity::Hint),
            "the wire leans by 0.002°",
        ),
        (whole("A99"), Some(Severity::Hint), "0.099°"),
        (whole("A2000"), Some(Severity::Error), "nothing is left"),
        (whole("A2."), Some(Severity::Error), "nothing is left"),
        (millimetres("A.002"), None, ""),
        (
            millimetres("A61."),
            Some(Severity::Warning),
            "no machine leans it by more than 60°",
        ),
        (
            millimetres("A89."),
            Some(Severity::Warning),
            "lean by 89.000°",
        ),
        (millimetres("A90."), Some(Severity::Warning), "not followed"),
    ] {
        let found = said(&text, &set);
        let first = found.first().map(|(_, severity, _)| *severity);
        assert_eq!(first, severity, "{text}: {found:?}");
        assert!(
            found.iter().all(|(_, _, said)| said.contains(part)),
            "{text}: {found:?}"
        );
        // What is not followed leads nowhere.
        let is_near = |ends: &[Point; 2]| ends.iter().all(|end| end.coords.norm() < 1e3);
        assert!(upper(&text, &set).iter().flatten().all(is_near), "{text}");
    }
}
