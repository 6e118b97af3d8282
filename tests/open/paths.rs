//! Paths and programs along open contours.

use super::*;

fn program(drawing: &Drawing, settings: &Effective, format: Format) -> Result<String, Refusal> {
    let made = generate(&document(drawing, settings), format, true)?;
    Ok(made.program.text)
}

fn read(text: &str, format: Format, settings: &Effective) -> Document {
    let language = format.language();
    Document::read(language, text.to_owned().into(), settings)
}

/// The program, and that nothing is wrong with it where it is read again.
#[track_caller]
fn held(drawing: &Drawing, settings: &Effective, format: Format) -> String {
    let text = program(drawing, settings, format).expect("a program");
    let (findings, _) = read(&text, format, settings).findings(settings, usize::MAX);
    assert_eq!(findings, [], "{text}");
    text
}

/// What the tests know of a contour, by formulas of their own: centre, radius, begin and sweep of each arc.
struct Walls(Vec<Wall>);

/// Start and end; of an arc also what it is.
type Wall = (Point, Point, Option<(Point, f64, f64, f64)>);

impl Walls {
    fn of(corners: Corners) -> Walls {
        let wall = |pair: &[[f64; 3]]| {
            let ([px, py, bulge], [qx, qy, _]) = (pair[0], pair[1]);
            let (dx, dy) = (qx - px, qy - py);
            let arc = (bulge != 0.0).then(|| {
                let chord = dx.hypot(dy);
                let radius = chord * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
                let share = (1.0 - bulge * bulge) / (4.0 * bulge);
                let center = Point::new((px + qx) / 2.0 - share * dy, (py + qy) / 2.0 + share * dx);
                let begin = (py - center.y).atan2(px - center.x);
                (center, radius, begin, 4.0 * bulge.atan())
            });
            (Point::new(px, py), Point::new(qx, qy), arc)
        };
        Walls(corners.windows(2).map(wall).collect())
    }

    fn distance(&self, at: Point) -> f64 {
        let of_wall = |(from, to, arc): &Wall| {
            let ends = (at - from).norm().min((at - to).norm());
            match arc {
                Some((center, radius, begin, sweep)) => {
                    let angle = (at.y - center.y).atan2(at.x - center.x);
                    let along = (angle - begin) * sweep.signum();
                    let is_on = along.rem_euclid(std::f64::consts::TAU) <= sweep.abs();
                    let beside = ((at - center).norm() - radius).abs();
                    if is_on { beside.min(ends) } else { ends }
                }
                None => {
                    let along = to - from;
                    let share = (at - from).dot(&along) / along.norm_squared();
                    match (0.0..=1.0).contains(&share) {
                        true => (at - (from + along * share)).norm(),
                        false => ends,
                    }
                }
            }
        };
        self.0.iter().map(of_wall).fold(f64::INFINITY, f64::min)
    }

    /// Where the wire's centre would be beside places all along the contour, `side` +1 to the left; it says nothing of corners.
    fn beside(&self, side: f64, correction: f64) -> Vec<Point> {
        let mut places = Vec::new();
        for (from, to, arc) in &self.0 {
            for step in 0..=40 {
                let share = f64::from(step) / 40.0;
                places.push(match arc {
                    Some((center, radius, begin, sweep)) => {
                        let angle = begin + sweep * share;
                        let out = radius - side * sweep.signum() * correction;
                        Point::new(center.x + out * angle.cos(), center.y + out * angle.sin())
                    }
                    None => {
                        let along = (to - from).normalize();
                        let at = from + (to - from) * share;
                        let normal = [-along.y * side * correction, along.x * side * correction];
                        Point::new(at.x + normal[0], at.y + normal[1])
                    }
                });
                // An arc that is too tight has no such place.
                if let Some((_, radius, _, sweep)) = arc
                    && radius - side * sweep.signum() * correction < 0.0
                {
                    places.pop();
                }
            }
        }
        places
    }
}

fn is_led(source: Source) -> bool {
    matches!(source, Source::LeadIn | Source::LeadOut | Source::Tab)
}

/// What is wrong with a path on a side of a contour, by distances alone.
fn wrong(corners: Corners, side: f64, path: &WirePath) -> Option<String> {
    let walls = Walls::of(corners);
    let correction = path.correction;
    let pieces: Vec<_> = path
        .segments
        .iter()
        .filter(|piece| !is_led(piece.source))
        .map(|piece| piece.geometry)
        .collect();
    for pair in pieces.windows(2) {
        if (pair[0].end() - pair[1].start()).norm() > 1e-9 {
            return Some(format!("a gap at {:?}", pair[0].end()));
        }
    }
    for piece in &pieces {
        for step in 0..=32 {
            let at = piece.point_at(f64::from(step) / 32.0);
            let away = walls.distance(at);
            if (away - correction).abs() > 2e-6 {
                return Some(format!("{away} from the contour at {at:?}"));
            }
        }
    }
    let nearest = |at: Point| {
        let distances = pieces.iter().map(|piece| piece.distance_to(at));
        distances.fold(f64::INFINITY, f64::min)
    };
    let missing = walls
        .beside(side, correction)
        .into_iter()
        .filter(|&at| walls.distance(at) >= correction - 1e-9)
        .find(|&at| nearest(at) > 3e-6);
    missing.map(|at| format!("{at:?} is missing"))
}

/// The cuts of a program as it is read again lie at the correction, or are leads.
fn followed(corners: Corners, correction: f64, text: &str, format: Format) -> Option<String> {
    let walls = Walls::of(corners);
    let settings = Effective::default();
    let trace = read(text, format, &settings).trace();
    let cut: Vec<_> = trace.steps.iter().filter_map(|step| step.ideal).collect();
    // A control that counts 3B stops a little beside the end of an arc. The first block is the lead.
    let tolerance = if format == Format::Iso { 2.5e-3 } else { 15e-3 };
    for piece in &cut[1..] {
        for step in 0..=16 {
            let at = piece.point_at(f64::from(step) / 16.0);
            let at = Point::new(at.x / 1e3, at.y / 1e3);
            let away = walls.distance(at);
            if (away - correction).abs() > tolerance {
                return Some(format!("{away} from the contour at {at:?}\n{text}"));
            }
        }
    }
    None
}

#[test]
fn a_path_runs_beside_an_open_contour_from_end_to_end() {
    for (side, sign, begin, end) in [
        ("left", 1.0, [0.0, 0.1], [30.0, 8.1]),
        ("right", -1.0, [0.0, -0.1], [30.0, 7.9]),
    ] {
        let settings = settings(&format!("side = \"{side}\"\n[program]\nheader = true\n"));
        let drawing = drawing(&[("2A", false, &STRIP)]);
        let found = paths(&drawing, &settings).expect("a path");
        assert_eq!(found.len(), 1);
        assert_eq!(wrong(&STRIP, sign, &found[0]), None, "{side}");
        let cut: Vec<_> = found[0]
            .segments
            .iter()
            .filter(|piece| !is_led(piece.source))
            .collect();
        let ends = [cut[0].geometry.start(), cut[cut.len() - 1].geometry.end()];
        assert!((ends[0] - Point::from(begin)).norm() < 1e-9, "{ends:?}");
        assert!((ends[1] - Point::from(end)).norm() < 1e-9, "{ends:?}");
        // The lead is square to the contour, 3 mm from it, and there is none at the end.
        assert!((found[0].thread_hole - Point::new(0.0, 3.0 * sign)).norm() < 1e-9);
        assert_eq!(
            found[0].segments.last().map(|last| last.geometry.end()),
            Some(ends[1])
        );
        for format in [Format::ThreeB, Format::Iso, Format::FourB] {
            let settings = match format {
                Format::FourB => settings_of_four_b(side),
                _ => settings.clone(),
            };
            let text = held(&drawing, &settings, format);
            if format != Format::FourB {
                assert_eq!(followed(&STRIP, 0.1, &text, format), None);
            }
        }
    }
}

fn settings_of_four_b(side: &str) -> Effective {
    settings(&format!(
        "side = \"{side}\"\n[program]\ncompensation = \"controller\"\n"
    ))
}

#[test]
fn passes_go_to_and_fro_along_an_open_contour() {
    let drawing = drawing(&[
        ("2A", false, &STRIP),
        ("2B", false, &[[0.0, 20.0, 0.0], [9.0, 20.0, 0.0]]),
    ]);
    let three = "side = \"left\"\n[passes]\ncorrections = [0.2, 0.15, 0.1]\n";
    for more in ["", "skim-corner = \"constant-stock\"\n"] {
        let settings = settings(&format!("{three}{more}"));
        let found = paths(&drawing, &settings).expect("paths");
        assert_eq!(found.len(), 6);
        for (path, correction) in found.iter().zip([0.2, 0.15, 0.1]) {
            assert_eq!(path.correction, correction);
            if more.is_empty() {
                assert_eq!(wrong(&STRIP, 1.0, path), None);
            }
        }
        // Each goes on from where the one before ended, or from the thread hole.
        assert_eq!(found[0].end(), found[1].begin());
        assert_eq!(
            [found[1].end(), found[2].begin()],
            [found[0].thread_hole; 2]
        );
        for format in [Format::ThreeB, Format::Iso] {
            let text = held(&drawing, &settings, format);
            let trace = read(&text, format, &settings).trace();
            let rapids = trace
                .steps
                .iter()
                .filter(|step| step.kind == wedm::program::path::Kind::Rapid);
            assert_eq!(rapids.count(), 1, "{text}");
        }
    }
    let words = |sequence: &str| -> Vec<String> {
        let text =
            format!("{three}sequence = \"{sequence}\"\n[program]\ncompensation = \"controller\"\n");
        let text = held(&drawing, &settings(&text), Format::Iso);
        let lines = text.lines().filter(|line| line.starts_with("G4"));
        lines.map(str::to_owned).collect()
    };
    let once = ["G41 D1", "G40", "G42 D2", "G40", "G41 D3", "G40"];
    assert_eq!(words("alternate"), [once, once].concat());
    // From the end of the first one the straight way back would cut the part, and no arc goes round it through the stock.
    for lead in ["straight", "perpendicular", "arc"] {
        let text = format!("{three}sequence = \"one-way\"\n[program]\nlead = \"{lead}\"\n");
        let refused = paths(&drawing, &settings(&text)).expect_err("a lead");
        assert!(
            matches!(&refused, Refusal::Findings(found) if found[0].rule == Rule::LeadIn)
                && refused.sentence(1.0).contains("straight way back"),
            "{lead}: {refused:?}"
        );
    }
}

#[test]
fn an_open_contour_is_begun_from_its_thread_hole_and_keeps_no_tab() {
    let drawing = drawing(&[("2A", false, &STRIP)]);
    let of = |text: &str| {
        paths(
            &drawing,
            &settings(&format!("side = \"left\"\n[program]\n{text}")),
        )
    };
    let found = of("thread = [30.0, 12.0]\n").expect("a path");
    assert_eq!(found[0].thread_hole, Point::new(30.0, 12.0));
    assert!((found[0].end() - Point::new(0.0, 0.1)).norm() < 1e-9);
    assert_eq!(wrong(&STRIP, 1.0, &found[0]), None);
    let found = of("entry = [30.0, 8.0]\n").expect("a path");
    assert!((found[0].thread_hole - Point::new(30.0, 11.0)).norm() < 1e-9);
    assert!(of("entry = [5.0, 0.0]\n").is_err());
    let refused = of("tab = 2\n").expect_err("no tab");
    assert!(refused.sentence(1.0).contains("2A is open"), "{refused:?}");
}

/// A contour that goes on to the right, with arcs either way.
fn gentle() -> impl Strategy<Value = Vec<[f64; 3]>> {
    let step = (1.0..6.0, -3.0..3.0, prop_oneof![Just(0.0), -0.6..0.6]);
    proptest::collection::vec(step, 1..9).prop_map(|steps| {
        let mut at = [0.0, 0.0];
        let mut corners = Vec::new();
        for (dx, dy, bulge) in steps {
            let rounded = |value: f64| (value * 1000.0).round() / 1000.0;
            corners.push([at[0], at[1], rounded(bulge)]);
            at = [rounded(at[0] + dx), rounded(at[1] + dy)];
        }
        corners.push([at[0], at[1], 0.0]);
        corners
    })
}

/// One that turns as it likes.
fn wild() -> impl Strategy<Value = Vec<[f64; 3]>> {
    let step = (0.05..3.0, -2.2..2.2_f64, prop_oneof![Just(0.0), -0.9..0.9]);
    proptest::collection::vec(step, 1..10).prop_map(|steps| {
        let (mut at, mut angle) = ([0.0, 0.0], 0.0_f64);
        let mut corners = Vec::new();
        for (length, turn, bulge) in steps {
            corners.push([at[0], at[1], bulge]);
            angle += turn;
            at = [at[0] + length * angle.cos(), at[1] + length * angle.sin()];
        }
        corners.push([at[0], at[1], 0.0]);
        corners
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn paths_beside_random_open_contours_are_right(corners in wild(), left: bool, large: bool) {
        let side = if left { "left" } else { "right" };
        let correction = if large { 0.3 } else { 0.1 };
        // Threaded on the path, so that leads have no say.
        let settings = settings(&format!("correction = {correction}\nside = \"{side}\"\n[program]\nlead-in = 1e-9\n"));
        let drawing = drawing(&[("2A", false, &corners)]);
        if let Ok(found) = paths(&drawing, &settings) {
            let sign = if left { 1.0 } else { -1.0 };
            prop_assert_eq!(wrong(&corners, sign, &found[0]), None);
        }
    }

    #[test]
    fn programs_of_random_open_contours_follow_them(corners in gentle(), left: bool) {
        let side = if left { "left" } else { "right" };
        let settings = settings(&format!("side = \"{side}\"\n[program]\nheader = true\n"));
        let drawing = drawing(&[("2A", false, &corners)]);
        let Ok(found) = paths(&drawing, &settings) else { return Ok(()) };
        for format in [Format::ThreeB, Format::Iso] {
            let text = program(&drawing, &settings, format);
            let Ok(text) = text else {
                return Err(TestCaseError::fail(format!("{text:?}")));
            };
            prop_assert_eq!(followed(&corners, found[0].correction, &text, format), None);
            let (findings, _) = read(&text, format, &settings).findings(&settings, usize::MAX);
            let told = findings.iter().any(|finding| finding.rule == Rule::NotClosed);
            prop_assert!(!told, "{}", text);
        }
    }
}

/// Runs the program with arguments: how it ended, and what it said.
type Run<'a> = dyn Fn(&[&str]) -> (Option<i32>, String) + 'a;

/// A line of the contour that is 30 µm or 0.3 mm longer in a program, or shorter, is named, wherever it stands, and nothing else is.
fn each_line_that_is_longer_is_named(program: &Path, run: &Run<'_>) {
    let name = program
        .file_name()
        .and_then(|name| name.to_str())
        .expect("a name");
    let sound = std::fs::read_to_string(program).expect("the program");
    let lines: Vec<&str> = sound.lines().collect();
    let is_line = |text: &str| text.starts_with('B') && text.contains('L');
    for (at, line) in lines
        .iter()
        .enumerate()
        .skip(1)
        .filter(|(_, line)| is_line(line))
    {
        for by in [30_i64, 300, -300] {
            let (numbers, way) = line.split_once('G').expect("a block");
            let mut numbers: Vec<i64> = numbers
                .split('B')
                .filter_map(|number| number.parse().ok())
                .collect();
            numbers[usize::from(way.starts_with('Y'))] += by;
            numbers[2] += by;
            let longer = format!("B{}B{}B{}G{way}", numbers[0], numbers[1], numbers[2]);
            let text: Vec<&str> = (0..lines.len())
                .map(|index| if index == at { &*longer } else { lines[index] })
                .collect();
            std::fs::write(program, text.join("\n")).expect("written");
            let (_, said) = run(&["check", name, "--output", "concise"]);
            let place = format!("{name}:{}:1: error[not-the-drawing]", at + 1);
            let told = said.matches("not-the-drawing").count();
            assert!(
                said.contains(&place) && told == 1,
                "{longer} in line {}: {said}",
                at + 1
            );
        }
    }
}

/// Nothing that is said of an open contour stands in the way of the binary either: drawing, program, and the program beside its drawing.
#[test]
fn the_binary_cuts_open_contours_and_reads_them_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let lines = |corners: Corners| {
        let vertices = corners
            .iter()
            .map(|[x, y, bulge]| format!("10\n{x}\n20\n{y}\n42\n{bulge}\n"));
        let count = corners.len();
        format!(
            "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n5\n2A\n8\n0\n90\n{count}\n70\n0\n{}0\nENDSEC\n0\nEOF\n",
            vertices.collect::<String>()
        )
    };
    let file = |name: &str| folder.path().join(name);
    std::fs::write(file("strip.dxf"), lines(&STRIP)).expect("written");
    let run = |arguments: &[&str]| {
        let done = Command::new(env!("CARGO_BIN_EXE_wedm"))
            .args(arguments)
            .current_dir(folder.path())
            .output()
            .expect("the binary");
        let said = [done.stdout, done.stderr].concat();
        let said = String::from_utf8_lossy(&said);
        (done.status.code(), said.into_owned())
    };
    for (side, ending) in [("left", "3b"), ("right", "iso"), ("right", "4b")] {
        std::fs::write(
            file("wedm.toml"),
            format!("[drawings.\"strip.dxf\".contours.2A]\nside = \"{side}\"\n[rules]\nsharp-corner = \"off\"\n"),
        )
        .expect("written");
        let name = format!("strip.{ending}");
        let (code, said) = run(&["generate", "strip.dxf", "--format", ending, "-o", &name]);
        assert_eq!(code, Some(0), "{said}");
        let (code, said) = run(&["check", "strip.dxf", &name]);
        assert_eq!(code, Some(0), "{said}");
        assert!(said.contains("nothing found"), "{said}");
        if ending == "3b" {
            each_line_that_is_longer_is_named(&file(&name), &run);
        }
        std::fs::remove_file(file(&name)).expect("removed");
    }
}
