//! Several passes: the path of each, its program, and what all of them leave.

#[path = "support/generate.rs"]
mod support;

use std::sync::Arc;
use support::generate;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Outline, Role, Unit, Vertex};
use wedm::finding::{Rule, Severity};
use wedm::geometry::Point;
use wedm::job;
use wedm::program::{Document, Format, Language, convert};
use wedm::settings::{Effective, from_toml};
use wedm::toolpath::{Source, WirePath, plan};

/// A wire of 0.25, gaps 0.03 and 0.015, 0.06 left by the rough pass.
const THREE: &str = "wire-diameter = 0.25\n[passes]\ncorrections = [0.215, 0.170, 0.140]\ngaps = [0.03, 0.015, 0.015]\n";

fn settings(text: &str) -> Effective {
    let (settings, errors) = from_toml(text);
    assert_eq!(errors, [], "{text}");
    Effective::of(&settings)
}

/// One closed polyline `[x, y, bulge]`, handle 2A.
fn drawing(role: Role, vertices: &[[f64; 3]]) -> Drawing {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    drawing.push(Entity {
        handle: "2A".into(),
        layer: "0".into(),
        role: Some(role),
        kind: Kind::LightPolyline,
        geometry: Geometry::Polyline {
            closed: true,
            vertices: vertices
                .iter()
                .map(|&[x, y, bulge]| Vertex::new(x, y, bulge))
                .collect(),
        },
    });
    drawing
}

const SQUARE: [[f64; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [10.0, 0.0, 0.0],
    [10.0, 10.0, 0.0],
    [0.0, 10.0, 0.0],
];

fn outlines(drawing: &Drawing, settings: &Effective) -> Arc<Vec<Outline>> {
    Analysis::new(drawing, Arc::new(settings.clone()))
        .outlines(drawing)
        .clone()
}

fn paths(drawing: &Drawing, settings: &Effective) -> Vec<WirePath> {
    plan(drawing, &outlines(drawing, settings), settings, None).expect("paths")
}

fn document(drawing: &Drawing, settings: &Effective) -> wedm::document::Document {
    let source = wedm::document::Source::Cad(Arc::new(drawing.clone()));
    wedm::document::Document::new(source, Arc::new(settings.clone()))
}

fn generated(drawing: &Drawing, settings: &Effective, format: Format) -> job::Generated {
    match generate(&document(drawing, settings), format, false) {
        Ok(generated) => generated,
        Err(refusal) => panic!("{refusal:?}"),
    }
}

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
fn one_pass_is_what_it_was() {
    let made = generated(
        &drawing(Role::Punch, &SQUARE),
        &settings("correction = 0.14\n"),
        Format::ThreeB,
    );
    assert_eq!((made.finished, made.warnings.len()), (None, 0));
    assert_eq!(made.program.text.matches("D\n").count(), 1, "DD alone");
}

#[test]
fn passes_are_written_with_a_pause_between_them_and_read_back_without_a_fault() {
    let drawing = drawing(Role::Punch, &SQUARE);
    for corner in ["arc", "intersection"] {
        for (format, language) in [
            (Format::ThreeB, Language::ThreeB),
            (Format::Iso, Language::Iso),
        ] {
            let settings = settings(&format!("{THREE}[program]\ncorner = \"{corner}\"\n"));
            let made = generated(&drawing, &settings, format);
            let text = made.program.text;
            assert_eq!(made.contours, 1);
            assert_eq!(made.warnings, []);
            let pause = if format == Format::Iso { "M00" } else { "D" };
            let pauses = text.lines().filter(|line| line.trim() == pause).count();
            assert_eq!(pauses, 2, "{text}");
            let document = Document::read(language, text.clone().into(), &settings);
            let (findings, _) = document.findings(&settings, usize::MAX);
            assert_eq!(findings, [], "{text}");
        }
    }
}

#[test]
fn the_control_offsets_each_pass_by_its_own_register_on_the_side_of_its_direction() {
    let words = |text: &str| -> Vec<String> {
        let made = generated(
            &drawing(Role::Opening, &SQUARE),
            &settings(text),
            Format::Iso,
        );
        let lines = made.program.text.lines();
        lines
            .filter(|line| line.starts_with("G4"))
            .map(str::to_owned)
            .collect()
    };
    let controller = "[program]\ncompensation = \"controller\"\n";
    assert_eq!(
        words(&format!("{THREE}{controller}")),
        ["G41 D1", "G40", "G42 D2", "G40", "G41 D3", "G40"]
    );
    assert_eq!(
        words(&format!(
            "{THREE}sequence = \"one-way\"\nregisters = [\"H101\", \"H102\", \"H105\"]\n{controller}profile = \"robofil\"\n"
        )),
        ["G41 H101", "G40", "G41 H102", "G40", "G41 H105", "G40"]
    );
    // A profile that names no register would cut all passes alike.
    let own = "[profiles.mine]\ncontour-begin = [\"{side} D7\"]\n";
    let settings = settings(&format!("{THREE}{controller}profile = \"mine\"\n{own}"));
    let drawing = drawing(Role::Opening, &SQUARE);
    let refused = Format::Iso
        .write(&paths(&drawing, &settings), 1.0, &settings, &mut |_, _| {
            true
        })
        .expect_err("one register");
    assert!(refused.to_string().contains("{register}"), "{refused}");
}

#[test]
fn four_b_holds_the_parts_contour_once_for_each_pass() {
    let corner = (std::f64::consts::PI / 8.0).tan();
    // A rounded punch, entered in a line.
    let punch = [
        [2.0, 0.0, 0.0],
        [18.0, 0.0, corner],
        [20.0, 2.0, 0.0],
        [20.0, 8.0, corner],
        [18.0, 10.0, 0.0],
        [2.0, 10.0, corner],
        [0.0, 8.0, 0.0],
        [0.0, 2.0, corner],
    ];
    let made = generated(
        &drawing(Role::Punch, &punch),
        &settings(THREE),
        Format::FourB,
    );
    let text = &made.program.text;
    assert_eq!(
        text.lines().filter(|line| *line == "D").count(),
        2,
        "{text}"
    );
    assert_eq!(
        text.matches("SR").count(),
        text.matches("NR").count() / 2,
        "{text}"
    );
}

#[test]
fn four_b_stops_before_its_tab_and_goes_on_in_one_contour() {
    let drawing = drawing(Role::Punch, &PLATE);
    let whole = generated(&drawing, &settings(""), Format::FourB).program;
    let tab = generated(&drawing, &settings("[program]\ntab = 3\n"), Format::FourB).program;
    let lines: Vec<&str> = tab.text.lines().collect();
    let stop = lines.iter().position(|line| *line == "D").expect("a stop");
    assert_eq!(lines.iter().filter(|line| **line == "D").count(), 1);
    // What stands behind it is the tab and the way out.
    assert!(
        lines[stop + 1].starts_with("B3000B0B3000GX"),
        "{}",
        tab.text
    );
    assert_eq!(tab.blocks, whole.blocks + 1);
    assert!((tab.length - whole.length).abs() < 1e-9);
    let several = settings(
        "[passes]\ncorrections = [0.17, 0.14]\n[program]\ntab = 3\ncompensation = \"controller\"\n",
    );
    let refused = Format::FourB
        .write(&paths(&drawing, &several), 1.0, &several, &mut |_, _| true)
        .expect_err("one contour for all passes");
    assert!(refused.to_string().contains("one pass"), "{refused}");
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

/// 40 × 20, entered in the middle of its lower side.
const PLATE: [[f64; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [40.0, 0.0, 0.0],
    [40.0, 20.0, 0.0],
    [0.0, 20.0, 0.0],
];

fn length(path: &WirePath, is_it: impl Fn(&Source) -> bool) -> f64 {
    let pieces = path.segments.iter().filter(|piece| is_it(&piece.source));
    pieces.map(|piece| piece.geometry.length()).sum()
}

fn is_of_contour(source: &Source) -> bool {
    matches!(source, Source::Segment { .. } | Source::Corner { .. })
}

/// What a program says when it is read again.
#[track_caller]
fn held(drawing: &Drawing, settings: &Effective, format: Format) -> Document {
    let made = generated(drawing, settings, format);
    assert_eq!(made.contours, 1);
    let language = match format {
        Format::Iso | Format::Milling => Language::Iso,
        _ => Language::ThreeB,
    };
    let text = made.program.text;
    let document = Document::read(language, text.clone().into(), settings);
    let (findings, _) = document.findings(settings, usize::MAX);
    assert_eq!(findings, [], "{text}");
    document
}

#[test]
fn a_punch_stands_on_its_tab_until_it_is_cut_off() {
    let text = "correction = 0.155\n[program]\nlead-in = 4\ntab = 3\n";
    let settings = settings(text);
    let drawing = drawing(Role::Punch, &PLATE);
    let found = paths(&drawing, &settings);
    let [cut, tab] = &found[..] else {
        panic!("{found:?}")
    };
    assert_eq!((cut.cut_off, tab.cut_off, tab.pass), (false, true, 1));
    // The lead is counted from the wire's path.
    assert!((cut.thread_hole - Point::new(20.0, -4.155)).norm() < 1e-9);
    assert!((length(tab, is_of_contour) - 3.0).abs() < 1e-9, "{tab:?}");
    let round = 2.0 * (40.0 + 20.0) + 2.0 * std::f64::consts::PI * 0.155;
    let both = length(cut, is_of_contour) + length(tab, is_of_contour);
    assert!((both - round).abs() < 1e-9);
    // It goes on where the others stopped, and ends where the wire was threaded.
    assert_eq!(cut.end(), tab.begin());
    assert_eq!((cut.begin(), tab.end()), (cut.thread_hole, cut.thread_hole));
    for format in [Format::ThreeB, Format::Iso] {
        let document = held(&drawing, &settings, format);
        let contours = document.trace().steps.last().map_or(0, |step| step.contour);
        assert_eq!(contours, 0, "one contour");
    }
}

#[test]
fn passes_leave_the_tab_and_cut_it_off_in_passes_of_its_own() {
    {
        for corrections in ["0.17, 0.14", "0.215, 0.17, 0.14"] {
            for compensation in ["path", "controller"] {
                let text = format!(
                    "[passes]\ncorrections = [{corrections}]\n[program]\ntab = 3\ncompensation = \"{compensation}\"\n"
                );
                let settings = settings(&text);
                let drawing = drawing(Role::Punch, &PLATE);
                let found = paths(&drawing, &settings);
                let count = settings.corrections.len();
                assert_eq!(found.len(), 2 * count, "{text}");
                for (number, path) in found.iter().enumerate() {
                    assert_eq!(path.cut_off, number >= count);
                    assert_eq!(path.pass, number % count + 1);
                    let own = length(path, is_of_contour);
                    assert!((own - 3.0).abs() < 1e-9 || own > 116.0, "{own}: {text}");
                    // Nothing is left out between one path and the next but jumps from the thread hole or to it.
                    if let Some(next) = found.get(number + 1) {
                        assert_eq!(path.end(), next.begin(), "{number}: {text}");
                    }
                }
                held(&drawing, &settings, Format::Iso);
                if compensation == "path" {
                    held(&drawing, &settings, Format::ThreeB);
                }
            }
        }
    }
}

#[test]
fn passes_one_way_come_back_from_the_tab_to_the_thread_hole() {
    for compensation in ["path", "controller"] {
        let settings = settings(&format!(
            "{THREE}sequence = \"one-way\"\n[program]\ntab = 3\ncompensation = \"{compensation}\"\n"
        ));
        let drawing = drawing(Role::Punch, &PLATE);
        let found = paths(&drawing, &settings);
        assert_eq!(found.len(), 6);
        for (number, path) in found.iter().enumerate() {
            assert_eq!((path.cut_off, path.pass), (number >= 3, number % 3 + 1));
            assert_eq!(path.counter_clockwise, Some(true));
            assert_eq!(
                (path.begin(), path.end()),
                (path.thread_hole, path.thread_hole)
            );
            let own = length(path, is_of_contour);
            assert!((own - 3.0).abs() < 1e-9 || own > 116.0, "{own}");
            // The leads at the tab keep clear of the part, too.
            for piece in path
                .segments
                .iter()
                .filter(|piece| matches!(piece.source, Source::LeadIn | Source::LeadOut))
            {
                assert!(piece.geometry.start().y.max(piece.geometry.end().y) <= 0.0);
            }
        }
        let made = generated(&drawing, &settings, Format::Iso);
        assert_eq!(made.program.text.matches("M00").count(), 5);
    }
}

/// A program of passes, its tabs cut off in whatever order, is one closed contour for each pass as a drawing: the last is the contour,
/// those before it are on layers of their own, each as large as its correction makes it.
#[test]
fn passes_and_their_tabs_are_drawn_as_closed_contours() {
    let mut made = 0;
    for number in 0..2 * 2 * 2 * 3 * 3 * 2 {
        let mut left = number;
        let mut pick = |count: usize| {
            let own = left % count;
            left /= count;
            own
        };
        let corrections = [&[0.215, 0.17, 0.14][..], &[0.2, 0.15]][pick(2)];
        let sequence = ["alternate", "one-way"][pick(2)];
        let (tab, overlap) = ([0, 3][pick(2)], [0.0, 0.5, 1.5][pick(3)]);
        let lead = ["perpendicular", "arc", "straight"][pick(3)];
        let (format, compensation) = [
            (Format::ThreeB, "path"),
            (Format::Iso, "path"),
            (Format::Iso, "controller"),
        ][(number / 72 + number) % 3];
        let role = [Role::Punch, Role::Opening][pick(2)];
        let text = format!(
            "wire-diameter = 0.25\ngap = 0.015\n[job]\nthickness = 40\nslug-limit = 1\n[passes]\ncorrections = {corrections:?}\n\
             sequence = \"{sequence}\"\n[program]\ntab = {tab}\nclosing-overlap = {overlap:?}\nlead = \"{lead}\"\n\
             compensation = \"{compensation}\"\n"
        );
        let settings = settings(&text);
        let program = held(&drawing(role, &PLATE), &settings, format);
        let drawn = convert::cuts(&program).drawing();
        let mut contours = Vec::new();
        for (_, entity) in drawn.entities() {
            let Geometry::Polyline { closed, .. } = &entity.geometry else {
                assert_eq!(&*entity.layer, "LEAD", "{text}");
                continue;
            };
            if &*entity.layer != "LEAD" {
                assert!(closed, "{text}");
                let ends = || entity.geometry.segments().map(|it| it.start());
                let size = |axis: usize| {
                    let (least, most) = (
                        ends().map(|at| at[axis]).fold(f64::INFINITY, f64::min),
                        ends().map(|at| at[axis]).fold(f64::NEG_INFINITY, f64::max),
                    );
                    most - least
                };
                contours.push((entity.layer.to_string(), size(0), size(1)));
            }
        }
        assert_eq!(contours.len(), corrections.len(), "{text}{contours:?}");
        for (index, correction) in corrections.iter().enumerate() {
            let (layer, width, height) = &contours[index];
            let wanted = match index + 1 == corrections.len() {
                true => "CUT".to_owned(),
                false => format!("PASS{}", index + 1),
            };
            assert_eq!(*layer, wanted, "{text}");
            let beside = match (compensation, role) {
                ("controller", _) => 0.0,
                (_, Role::Punch) => 2.0 * correction,
                _ => -2.0 * correction,
            };
            let off = (width - 40.0 - beside)
                .abs()
                .max((height - 20.0 - beside).abs());
            assert!(off < 0.003, "{text}{contours:?}");
        }
        made += 1;
    }
    assert_eq!(made, 144);
}

#[test]
fn the_machine_stops_before_the_tab_by_its_own_word() {
    let text = "[program]\ntab = 3\ntab-stop = \"M01\"\n";
    let drawing = drawing(Role::Punch, &PLATE);
    let made = generated(&drawing, &settings(text), Format::Iso);
    let stops: Vec<&str> = made
        .program
        .text
        .lines()
        .filter(|line| line.starts_with('M'))
        .collect();
    assert_eq!(stops, ["M01", "M02"]);
    let refused = Format::ThreeB
        .write(
            &paths(&drawing, &settings(text)),
            1.0,
            &settings(text),
            &mut |_, _| true,
        )
        .expect_err("3B has no such word");
    assert!(refused.to_string().contains("\"M01\""), "{refused}");
}

#[test]
fn a_slug_above_its_limit_keeps_a_tab_and_a_tab_is_shorter_than_its_contour() {
    let count = |text: &str| paths(&drawing(Role::Opening, &PLATE), &settings(text)).len();
    // 7.85 g/cm³ × 8 cm² × 4 cm = 251.2 g.
    let tab = "[program]\ntab = 3\n";
    assert_eq!(count(tab), 1);
    assert_eq!(
        count(&format!("{tab}[job]\nthickness = 40\nslug-limit = 251\n")),
        2
    );
    assert_eq!(
        count(&format!("{tab}[job]\nthickness = 40\nslug-limit = 252\n")),
        1
    );
    for (text, says) in [
        (
            "[program]\ntab = 120\n",
            "the tab of 120.000 mm leaves nothing of contour 2A, which is 120.000 mm long",
        ),
        (
            "[program]\nclosing-overlap = 130\n",
            "the overlap of 130.000 mm goes all round contour 2A",
        ),
    ] {
        let settings = settings(text);
        let drawing = drawing(Role::Punch, &PLATE);
        let refused = plan(&drawing, &outlines(&drawing, &settings), &settings, None);
        assert!(format!("{refused:?}").contains(says), "{refused:?}");
    }
}

#[test]
fn a_pass_goes_on_past_its_start_round_a_corner() {
    let of_punch = "entry = [39.8, 0]\nthread = [43, -3]\n";
    let of_opening = "entry = [39.7, 0]\n";
    for (role, rest) in [
        (Role::Punch, of_punch.to_owned()),
        (
            Role::Punch,
            format!("{of_punch}corner = \"intersection\"\n"),
        ),
        (Role::Opening, of_opening.to_owned()),
        (Role::Opening, format!("{of_opening}lead = \"arc\"\n")),
    ] {
        let settings = settings(&format!("[program]\nclosing-overlap = 0.5\n{rest}"));
        let drawing = drawing(role, &PLATE);
        held(&drawing, &settings, Format::ThreeB);
        held(&drawing, &settings, Format::Iso);
    }
}

#[test]
fn a_pass_goes_on_past_its_start() {
    for (text, count) in [
        ("[program]\nclosing-overlap = 0.5\n", 1),
        ("[program]\nclosing-overlap = 0.5\ntab = 2\n", 2),
        (
            "[passes]\ncorrections = [0.17, 0.14]\n[program]\nclosing-overlap = 0.5\n",
            2,
        ),
    ] {
        let settings = settings(text);
        let drawing = drawing(Role::Punch, &PLATE);
        let found = paths(&drawing, &settings);
        assert_eq!(found.len(), count);
        let over: f64 = found
            .iter()
            .map(|path| length(path, |source| matches!(source, Source::Overlap { .. })))
            .sum();
        let times = if text.contains("tab") { 1 } else { count };
        assert!((over - 0.5 * times as f64).abs() < 1e-9, "{over}: {text}");
        held(&drawing, &settings, Format::ThreeB);
        held(&drawing, &settings, Format::Iso);
    }
}
