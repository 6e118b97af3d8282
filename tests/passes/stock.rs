//! The path of each pass, and the stock that it finds and leaves.

use super::{SQUARE, THREE, document, drawing, generated, paths, settings};
use wedm::drawing::Role;
use wedm::finding::{Rule, Severity};
use wedm::geometry::Point;
use wedm::program::Format;
use wedm::toolpath::{Source, WirePath};

/// How near to a point the wire's centre comes.
fn nearest(path: &WirePath, point: Point) -> f64 {
    let distances = path
        .segments
        .iter()
        .map(|piece| piece.geometry.distance_to(point));
    distances.fold(f64::INFINITY, f64::min)
}

#[test]
fn each_pass_has_a_path_at_its_own_correction_that_goes_back_along_the_one_before() {
    let check = |sequence: &str, ways: [bool; 3]| {
        let settings = settings(&format!("{THREE}sequence = \"{sequence}\"\n"));
        let found = paths(&drawing(Role::Opening, &SQUARE), &settings);
        assert_eq!(found.len(), 3);
        for (number, path) in found.iter().enumerate() {
            let correction = [0.215, 0.170, 0.140][number];
            assert_eq!(path.pass, number + 1);
            assert!((path.correction - correction).abs() < 1e-12);
            assert_eq!(path.counter_clockwise, Some(ways[number]), "{sequence}");
            // In from the thread hole and back there.
            assert_eq!(path.thread_hole, found[0].thread_hole);
            assert_eq!(
                (path.begin(), path.end()),
                (path.thread_hole, path.thread_hole)
            );
            assert_eq!(path.segments[0].source, Source::LeadIn);
            assert_eq!(path.segments.last().unwrap().source, Source::LeadOut);
            for piece in &path.segments[1..path.segments.len() - 1] {
                let [x, y] = <[f64; 2]>::from(piece.geometry.point_at(0.5));
                let beside = x.min(y).min(10.0 - x).min(10.0 - y);
                assert!((beside - correction).abs() < 1e-9, "{beside}");
            }
        }
        // The wire's own way round.
        for pair in found.windows(2) {
            assert!((nearest(&pair[1], pair[0].segments[0].geometry.end())) < 1e-9);
        }
    };
    check("alternate", [true, false, true]);
    check("one-way", [true, true, true]);
}

/// What a skim finds in the first corner: how much further it reaches there than the pass before it, by the half kerfs of both.
fn corner_stock(paths: &[WirePath], halves: [f64; 2], corner: Point) -> f64 {
    let reach = |pass: usize| nearest(&paths[pass], corner) - halves[pass];
    reach(0) - reach(1)
}

/// An opening that is a regular polygon: each corner turns by as much.
fn polygon(turn: f64) -> Vec<[f64; 3]> {
    let count = (360.0 / turn).round() as usize;
    (0..count)
        .map(|corner| (turn * corner as f64).to_radians())
        .map(|angle| [20.0 * angle.cos(), 20.0 * angle.sin(), 0.0])
        .collect()
}

#[test]
fn skims_find_more_stock_in_corners_but_where_it_is_to_be_constant() {
    let check = |turn: f64, text: &str, expected: f64| {
        let settings = settings(text);
        let vertices = polygon(turn);
        let drawing = drawing(Role::Opening, &vertices);
        let found = paths(&drawing, &settings);
        let halves = [0, 1].map(|pass| settings.half_kerf(pass).expect("gaps"));
        let corner = Point::new(vertices[0][0], vertices[0][1]);
        let stock = corner_stock(&found, halves, corner);
        assert!(
            (stock - expected).abs() < 5e-5,
            "{turn}° {text}: {stock}, expected {expected}"
        );
    };
    check(90.0, THREE, 0.0486);
    let constant = format!("{THREE}skim-corner = \"constant-stock\"\n");
    check(90.0, &constant, 0.0300);
    check(60.0, &constant, 0.0300);
    check(120.0, &constant, 0.0300);
    // With equal gaps the stock of the wall by the turn alone.
    let equal = "wire-diameter = 0.25\ngap = 0.02\n[passes]\ncorrections = [0.245, 0.145]\n";
    check(60.0, equal, 0.1155);
    check(90.0, equal, 0.1414);
    check(120.0, equal, 0.2);
}

#[test]
fn what_all_passes_leave_is_the_radius_of_the_last_in_corners() {
    let check = |role: Role, text: &str, uncut: f64, overcut: f64| {
        let made = generated(&drawing(role, &SQUARE), &settings(text), Format::ThreeB);
        let finished = made.finished.expect("several passes");
        assert!(
            (finished.uncut - uncut).abs() < 1e-5 && (finished.overcut - overcut).abs() < 1e-9,
            "{text}: {finished:?}"
        );
    };
    let beyond = 2.0_f64.sqrt() - 1.0;
    check(Role::Opening, THREE, 0.140 * beyond, 0.0);
    let constant = format!("{THREE}skim-corner = \"constant-stock\"\n");
    check(Role::Opening, &constant, 0.215 * beyond, 0.0);
    // Round a punch the wire leaves every corner sharp.
    check(Role::Punch, THREE, 0.0, 0.0);
    // Without wire and gap the last correction is half its kerf.
    let unknown = "[passes]\ncorrections = [0.215, 0.140]\n";
    check(Role::Opening, unknown, 0.140 * beyond, 0.0);
    // A last pass with more stock than its kerf takes, and a rough one that takes more than it should.
    let stays = "wire-diameter = 0.25\ngap = 0.01\n[passes]\ncorrections = [0.2, 0.14]\n";
    check(Role::Punch, stays, 0.005, 0.0);
    let gouges =
        "wire-diameter = 0.25\n[passes]\ngaps = [0.05, 0.01]\ncorrections = [0.16, 0.135]\n";
    check(Role::Punch, gouges, 0.0, 0.015);
}

#[test]
fn a_radius_that_only_a_later_pass_can_follow_is_a_warning_with_its_stock() {
    let check = |radius: f64, compensation: &str, severity: Option<Severity>, says: &str| {
        let corner = (std::f64::consts::PI / 8.0).tan();
        let opening = [
            [0.0, 0.0, 0.0],
            [10.0 - radius, 0.0, corner],
            [10.0, radius, 0.0],
            [10.0, 10.0, 0.0],
            [0.0, 10.0, 0.0],
        ];
        let text = format!(
            "[passes]\ncorrections = [0.175, 0.146, 0.140]\n[program]\ncompensation = \"{compensation}\"\n"
        );
        let settings = settings(&text);
        let drawing = drawing(Role::Opening, &opening);
        let document = document(&drawing, &settings);
        let found = document.all_findings().to_vec();
        let found: Vec<_> = found
            .iter()
            .filter(|finding| finding.rule == Rule::SmallRadius)
            .collect();
        assert_eq!(
            found.first().map(|finding| finding.severity),
            severity,
            "{radius} {compensation}"
        );
        let sentence = found
            .first()
            .map(|finding| wedm::finding::sentence(finding, 1.0))
            .unwrap_or_default();
        assert!(sentence.contains(says), "{sentence}");
        if severity != Some(Severity::Error) {
            assert!(document.fix_all().is_none(), "nothing is wrong");
            assert_eq!(paths(&drawing, &settings).len(), 3);
        }
    };
    check(0.18, "path", None, "");
    check(
        0.15,
        "path",
        Some(Severity::Warning),
        "below the correction 0.175 mm of pass 1: the later passes find 0.010 mm more stock there",
    );
    check(0.13, "path", Some(Severity::Error), "0.130");
    check(0.15, "controller", Some(Severity::Error), "of pass 1");
}
