//! Programs written by profiles equal the path.

use crate::drawing::EntityId;
use crate::finding::{Severity, Side};
use crate::geometry::{Arc, Point, Segment};
use crate::program::iso::{Document, write};
use crate::program::path::Kind;
use crate::program::{ProofError, ProvedProgram};
use crate::settings::{CenterRule, Effective, Jumps, from_toml, shipped_profiles};
use crate::toolpath::{PathSegment, Source, WirePath};
use proptest::prelude::*;

fn settings(text: &str) -> Effective {
    let (settings, errors) = from_toml(text);
    assert_eq!(errors, [], "{text}");
    Effective::of(&settings)
}

fn profile(name: &str) -> Effective {
    settings(&format!("[program]\nprofile = \"{name}\"\n"))
}

fn path_of(segments: &[Segment], side: Option<Side>) -> WirePath {
    let source = Source::Segment {
        entity: EntityId(0),
        segment: 0,
    };
    let thread_hole = segments.first().map_or_else(Point::origin, Segment::start);
    let mut segments: Vec<PathSegment> = segments
        .iter()
        .map(|&geometry| PathSegment { geometry, source })
        .collect();
    if let Some(last) = segments.last_mut().filter(|_| side.is_some()) {
        last.source = Source::LeadOut;
    }
    WirePath {
        side,
        ..WirePath::along(thread_hole, segments)
    }
}

fn line(from: [f64; 2], to: [f64; 2]) -> Segment {
    Segment::line(from.into(), to.into())
}

/// Into a hole of R 10 about (20, 0), once round, and back to the middle.
fn hole() -> Vec<Segment> {
    let circle = Arc::about(
        Point::new(20.0, 0.0),
        Point::new(30.0, 0.0),
        Point::new(30.0, 0.0),
        true,
    );
    vec![
        line([20.0, 0.0], [30.0, 0.0]),
        Segment::Arc(circle),
        line([30.0, 0.0], [20.0, 0.0]),
    ]
}

fn check(settings: &Effective, paths: &[WirePath], expected: &str) -> ProvedProgram {
    let program = write(paths, 1.0, settings).expect("a program");
    assert_eq!(program.text, expected);
    program
}

#[test]
fn each_profile_writes_as_its_machine_wants_it() {
    let with = [path_of(&hole(), Some(Side::Left))];
    let without = [path_of(&hole(), None)];
    check(
        &profile("fast-wire"),
        &with,
        "G92 X20000 Y0\nG91\nG41 D0\nG01 X10000 Y0\nG03 X-20000 Y0 I-10000 J0\nG03 X20000 Y0 I10000 J0\nG40\nG01 X-10000 Y0\nM02\n",
    );
    check(
        &profile("robofil"),
        &with,
        "G92 X0 Y0\r\nG60\r\nG38\r\nG41 D0\r\nG90\r\nG01 X10.000 Y0.000\r\nG03 X-10.000 Y0.000 I0.000 J0.000\r\n\
         G03 X10.000 Y0.000 I0.000 J0.000\r\nG40\r\nG01 X0.000 Y0.000\r\nM02\r\n",
    );
    check(
        &profile("robofil"),
        &[path_of(&hole(), Some(Side::Right))],
        "G92 X0 Y0\r\nG60\r\nG38\r\nG42 D0\r\nG90\r\nG01 X10.000 Y0.000\r\nG03 X-10.000 Y0.000 I0.000 J0.000\r\n\
         G03 X10.000 Y0.000 I0.000 J0.000\r\nG40\r\nG01 X0.000 Y0.000\r\nM02\r\n",
    );
    let program = check(
        &profile("generic"),
        &without,
        "%\nG21\nG90\nG92 X20.000 Y0.000\nG01 X30.000 Y0.000\nG03 X10.000 Y0.000 I-10.000 J0.000\nG03 X30.000 Y0.000 I10.000 J0.000\n\
         G01 X20.000 Y0.000\nM02\n%\n",
    );
    assert_eq!((program.blocks, program.closure), (4, [0.0, 0.0]));
    assert!((program.length + program.jumps - (20.0 + 20.0 * std::f64::consts::PI)).abs() < 1e-9);
}

#[test]
fn a_users_profile_is_data() {
    let mine = settings(
        "[program]\nprofile = \"mine\"\n[profiles.mine]\nnumbers = 5\nspaces = false\nmodal = true\nfull-circles = true\ncenter = \"center-to-start\"\n\
         decimals = 4\nbegin = [\"G90\"]\nend = [\"M30\"]\n",
    );
    check(
        &mine,
        &[path_of(&hole(), None)],
        "G90\nN5G01X30.0000\nN10G03X30.0000Y0.0000I10.0000J0.0000\nN15G01X20.0000\nM30\n",
    );
    // Of a step of 0.1 µm.
    let fine = [path_of(&[line([0.0, 0.0], [0.00014, 1.00006])], None)];
    check(&mine, &fine, "G90\nN5G01X0.0001Y1.0001\nM30\n");
}

#[test]
fn a_profile_that_does_not_do_what_it_says_is_refused() {
    let check = |profile: &str, side: Option<Side>, expected: &str| {
        let settings = settings(&format!(
            "[program]\nprofile = \"mine\"\n[profiles.mine]\n{profile}\n"
        ));
        let outcome = write(&[path_of(&hole(), side)], 1.0, &settings);
        let Err(ProofError::Refused(sentence)) = &outcome else {
            panic!("{profile}: {outcome:?}")
        };
        assert!(
            sentence.starts_with("profile mine: ") && sentence.contains(expected),
            "{sentence}"
        );
    };
    check(
        "begin = [\"G92 X0 Y0\"]",
        None,
        "does not say that the wire stands at the start",
    );
    check(
        "begin = [\"G92 X{x} Y{y}\", \"G91\"]",
        None,
        "G90 or G91 as coordinates say",
    );
    check(
        "begin = [\"G92 X{x} Y{y}\", \"G20\"]",
        None,
        "lead elsewhere",
    );
    check("begin = [\"G90\", \"G01 X5 Y5\"]", None, "moves the wire");
    check("begin = [\"G90 X\"]", None, "cannot be read again");
    check(
        "contour-begin = [\"G90\"]",
        Some(Side::Left),
        "does not switch the correction on",
    );
    let unknown = Effective {
        profile: Err("there is no profile \"x\", expected generic".into()),
        ..Effective::default()
    };
    assert_eq!(
        write(&[path_of(&hole(), None)], 1.0, &unknown),
        Err(ProofError::Refused(
            "there is no profile \"x\", expected generic".into()
        ))
    );
}

#[test]
fn several_contours_are_joined_by_stops_and_a_rapid() {
    let paths = [
        path_of(
            &[
                line([0.0, 0.0], [1.0, 0.0]),
                line([1.0, 0.0], [1.0, 1.0]),
                line([1.0, 1.0], [0.0, 0.0]),
            ],
            None,
        ),
        path_of(
            &[
                line([5.0, 2.0], [6.0, 2.0]),
                line([6.0, 2.0], [6.0, 3.0]),
                line([6.0, 3.0], [5.0, 2.0]),
            ],
            None,
        ),
    ];
    let text = |jumps| {
        write(
            &paths,
            1.0,
            &Effective {
                jumps,
                ..profile("fast-wire")
            },
        )
        .expect("a program")
        .text
    };
    let (first, second) = (
        "G01 X1000 Y0\nG01 X0 Y1000\nG01 X-1000 Y-1000\n",
        "G01 X1000 Y0\nG01 X0 Y1000\nG01 X-1000 Y-1000\nM02\n",
    );
    assert_eq!(
        text(Jumps::Blocks),
        format!("G92 X0 Y0\nG91\n{first}M00\nG00 X5000 Y2000\nM00\n{second}")
    );
    assert_eq!(
        text(Jumps::None),
        format!("G92 X0 Y0\nG91\n{first}M00\nG92 X5000 Y2000\n{second}")
    );
    for jumps in [Jumps::Blocks, Jumps::None] {
        let document = Document::read(text(jumps).into_bytes());
        assert_eq!(document.findings(), []);
        assert_eq!(document.trace().end(), Point::new(5000.0, 2000.0));
    }
}

/// A closed contour of lines and arcs about a middle, entered from there; mm.
fn contour() -> impl Strategy<Value = Vec<Segment>> {
    let corner = (
        2.0_f64..30.0,
        prop_oneof![3 => Just(0.0), 2 => -1.5_f64..1.5, 1 => -0.02_f64..0.02],
    );
    let corners = prop::collection::vec(corner, 3..12);
    (corners, -200.0_f64..200.0, -200.0_f64..200.0, 0.0_f64..1.0).prop_map(
        |(corners, x, y, turned)| {
            let middle = Point::new(x, y);
            let count = corners.len();
            let at = |index: usize| {
                let angle = (index as f64 + turned) / count as f64 * std::f64::consts::TAU;
                middle + crate::geometry::direction(angle) * corners[index % count].0
            };
            let mut segments = vec![Segment::line(middle, at(0))];
            segments.extend((0..count).map(|index| {
                Segment::from_bulge(at(index), at((index + 1) % count), corners[index].1)
            }));
            segments.push(Segment::line(at(0), middle));
            segments
        },
    )
}

proptest! {
    #[test]
    fn what_any_profile_writes_is_read_as_the_path(
        segments in contour(),
        name in prop::sample::select(shipped_profiles().collect::<Vec<_>>()),
        side in prop::option::of(prop::sample::select(vec![Side::Left, Side::Right])),
        extra in prop::sample::select(vec!["", "modal = true", "spaces = false\nnumbers = 10", "center = \"center-to-start\"", "decimals = 5\nunit = \"mm\"", "full-circles = true"]),
    ) {
        let settings = settings(&format!("[program]\nprofile = \"mine\"\n[profiles.mine]\nbase = \"{name}\"\n{extra}\n"));
        let program = write(&[path_of(&segments, side)], 1.0, &settings).unwrap();
        // Ends are snapped, and the arcs between them run about centres on the grid.
        prop_assert!(program.deviation <= 1.5, "{}", program.deviation);
        // Read without knowing the profile.
        let document = Document::read(program.text.clone().into_bytes());
        let findings = document.findings();
        prop_assert!(findings.iter().all(|finding| !matches!(finding.rule.name(), "syntax" | "arc-off-radius" | "arc-without-radius" | "not-closed")), "{findings:?}\n{}", program.text);
        // A random contour may return to itself at both ends of an arc, which nobody draws: that is reported.
        prop_assert!(findings.iter().all(|finding| finding.severity != Severity::Error || matches!(finding.rule.name(), "small-radius" | "reversed-arc")), "{findings:?}");
        let trace = document.trace();
        let moves: Vec<_> = trace.steps.iter().filter(|step| step.moves()).collect();
        prop_assert_eq!(moves.len(), program.blocks);
        prop_assert!(moves.iter().all(|step| step.kind != Kind::Rapid));
        // Every corner of the path is passed within the grid's step, and every move runs on the path.
        let zero = if settings.profile.as_ref().unwrap().zero == crate::settings::Zero::Start { segments[0].start() } else { Point::origin() };
        let zero = Point::new((zero.x * 1e3).round(), (zero.y * 1e3).round());
        for step in &moves {
            let Some(ideal) = step.ideal else { prop_assert!(false, "{step:?}"); continue };
            let middle = (ideal.point_at(0.5) + zero.coords) / 1e3;
            let off = segments.iter().map(|segment| segment.distance_to(middle)).fold(f64::INFINITY, f64::min);
            prop_assert!(off <= 0.004, "{off} {step:?}");
        }
        let length: f64 = moves.iter().filter_map(|step| step.ideal).map(|ideal| ideal.length()).sum();
        prop_assert!((length / 1e3 - program.length - program.jumps).abs() <= 0.01 * moves.len() as f64);
        prop_assert!(trace.closure().norm() < 1e-9);
    }
}

#[test]
fn centres_are_told_from_what_is_written() {
    for (rule, name) in [
        (CenterRule::StartToCenter, "generic"),
        (CenterRule::Absolute, "robofil"),
    ] {
        let program = write(&[path_of(&hole(), None)], 1.0, &profile(name)).unwrap();
        assert_eq!(
            Document::read(program.text.into_bytes()).reading().absolute,
            rule
        );
    }
}
