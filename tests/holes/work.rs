//! What the job comes to: lengths, times, slugs, tabs.

use super::*;

#[test]
fn the_way_between_two_contours_is_no_cut() {
    let both = || {
        drawing(vec![
            circle("2A", Role::Opening, [0.0, 0.0], 5.0),
            circle("2B", Role::Opening, [100.0, 0.0], 5.0),
        ])
    };
    let settings = settings("");
    let round = 2.0 * (std::f64::consts::TAU * 4.9 + 2.0 * 4.9);
    for format in [Format::ThreeB, Format::Iso] {
        let made = generated(&both(), &settings, format);
        assert!(
            (made.program.length - round).abs() < 0.01,
            "{format:?}: {}",
            made.program.length
        );
        assert!((made.work.length - round).abs() < 1e-6);
        assert!((made.work.jumps - 100.0).abs() < 1e-9);
    }
}

#[test]
fn the_cut_takes_its_length_by_its_rate() {
    // 66.428 mm of path: a circle of that circumference about the correction, without a lead.
    let radius = 66.428 / std::f64::consts::TAU;
    let punch = drawing(vec![circle("2A", Role::Punch, [0.0, 0.0], radius - 0.1)]);
    let text = "[passes]\nrates = [100]\n[job]\nthickness = 40\nmachine-rate = 60\n[program]\nthread = [10.5723, 0]\nentry = [10.4723, 0]\n";
    let made = generated(&punch, &settings(text), Format::ThreeB);
    let minutes = made.work.minutes.expect("all is set");
    assert!(
        (made.work.length - 66.428).abs() < 2e-3 && (minutes - 26.57).abs() < 2e-3,
        "{:?}",
        made.work
    );
    assert!((made.work.cost.unwrap() - minutes).abs() < 1e-9);
    assert_eq!(made.work.missing, ["gap"]);
    // What is not set is named, and nothing is guessed.
    let bare = generated(&punch, &settings(""), Format::ThreeB).work;
    assert_eq!(
        (bare.minutes, bare.cost, bare.largest_wire),
        (None, None, None)
    );
    assert_eq!(
        bare.missing,
        ["job.thickness", "passes.rates", "job.machine-rate", "gap"]
    );
}

#[test]
fn each_pass_has_its_own_rate_and_each_opening_its_slug() {
    let text = "wire-diameter = 0.25\ngap = 0.015\n[passes]\ncorrections = [0.2, 0.14]\nrates = [100, 200]\n[job]\nthickness = 40\n";
    let plate = drawing(vec![rectangle(
        "2A",
        Role::Opening,
        [0.0, 0.0],
        [40.0, 20.0],
    )]);
    let work = generated(&plate, &settings(text), Format::Iso).work;
    assert_eq!(work.cuts.len(), 2);
    for (cut, rate) in work.cuts.iter().zip([100.0, 200.0]) {
        assert!((cut.minutes.unwrap() - cut.length * 40.0 / rate).abs() < 1e-9);
    }
    // 7.85 g/cm³ × 8 cm² × 4 cm.
    assert!(
        (work.slugs[0].mass - 251.2).abs() < 1e-9,
        "{:?}",
        work.slugs
    );
}

#[test]
fn a_slug_weighs_what_is_left_when_it_drops() {
    let text = "[job]\nthickness = 40\n";
    let within = |role| rectangle("2B", role, [10.0, 5.0], [20.0, 15.0]);
    // 7.85 g/cm³ × 4 cm × (8 cm² less 1 cm²): what lies within is cut out first, whatever it is.
    for (role, masses) in [(Role::Opening, &[31.4, 219.8][..]), (Role::Punch, &[219.8])] {
        let outer = rectangle("2A", Role::Opening, [0.0, 0.0], [40.0, 20.0]);
        let plate = drawing(vec![outer, within(role)]);
        let work = generated(&plate, &settings(text), Format::Iso).work;
        let found: Vec<f64> = work.slugs.iter().map(|slug| slug.mass).collect();
        let is_near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-9;
        assert!(
            found.len() == masses.len() && found.iter().zip(masses).all(is_near),
            "{role:?}: {found:?}"
        );
    }
    // One in a part that lies in the slug is gone with that part.
    let nested = drawing(vec![
        rectangle("2A", Role::Opening, [0.0, 0.0], [40.0, 20.0]),
        within(Role::Punch),
        rectangle("2C", Role::Opening, [12.0, 7.0], [16.0, 11.0]),
    ]);
    let work = generated(&nested, &settings(text), Format::Iso).work;
    let last = work.slugs.last().map(|slug| slug.mass);
    assert!(
        last.is_some_and(|mass| (mass - 219.8).abs() < 1e-9),
        "{last:?}"
    );
}

#[test]
fn the_smallest_radius_names_the_largest_wire() {
    let fillet = (std::f64::consts::PI / 8.0).tan();
    let rounded = |role| {
        drawing(vec![polygon(
            "2A",
            role,
            &[
                [0.0, 0.0, 0.0],
                [9.8, 0.0, fillet],
                [10.0, 0.2, 0.0],
                [10.0, 10.0, 0.0],
                [0.0, 10.0, 0.0],
            ],
        )])
    };
    let check = |role, text: &str, expected: Option<f64>| {
        let (drawing, settings) = (rounded(role), settings(text));
        let outlines = Analysis::new(&drawing, Arc::new(settings.clone()))
            .outlines(&drawing)
            .clone();
        let found = wedm::analysis::largest_wire(&drawing, &outlines, &settings, &|_| true);
        let diameter = found.map(|found| (found.diameter * 1e6).round() / 1e6);
        assert_eq!(diameter, expected, "{text}");
    };
    check(Role::Opening, "gap = 0.02\n", Some(0.36));
    check(Role::Both, "gap = 0.02\n", Some(0.36));
    check(
        Role::Opening,
        "[passes]\ncorrections = [0.2, 0.14]\ngaps = [0.03, 0.01]\n",
        Some(0.38),
    );
    // Of a pair the wire of the plate runs inside of it, whose arc is larger by the clearance where the punch is drawn.
    let pair = "wire-diameter = 0.2\ngap = 0.02\n[pair]\nclearance = 0.05\n";
    check(
        Role::Both,
        &format!("{pair}drawn-as = \"punch\"\n"),
        Some(0.46),
    );
    check(
        Role::Both,
        &format!("{pair}drawn-as = \"plate\"\n"),
        Some(0.36),
    );
    // The holder is as much narrower.
    check(
        Role::Both,
        &format!("{pair}drawn-as = \"punch\"\nholder = 0.01\n"),
        Some(0.34),
    );
    // The wire runs outside of it.
    check(Role::Punch, "gap = 0.02\n", None);
    check(Role::Opening, "", None);
}

/// What is drawn, what names the wire, and its diameter with a gap of 0.02.
type Narrow<'a> = (&'a str, Vec<Entity>, (&'a str, Option<&'a str>), f64);

#[test]
fn a_place_narrower_than_the_smallest_radius_names_the_largest_wire() {
    let (out, quarter) = (-quarter(), quarter());
    // Two rooms with fillets of R 2, and a neck of 0.5 mm with R 1 at its mouths.
    let rooms: &[[f64; 3]] = &[
        [-8.0, -5.0, 0.0],
        [-6.0, -5.0, quarter],
        [-4.0, -3.0, 0.0],
        [-4.0, -1.25, out],
        [-3.0, -0.25, 0.0],
        [3.0, -0.25, out],
        [4.0, -1.25, 0.0],
        [4.0, -3.0, quarter],
        [6.0, -5.0, 0.0],
        [8.0, -5.0, quarter],
        [10.0, -3.0, 0.0],
        [10.0, 3.0, quarter],
        [8.0, 5.0, 0.0],
        [6.0, 5.0, quarter],
        [4.0, 3.0, 0.0],
        [4.0, 1.25, out],
        [3.0, 0.25, 0.0],
        [-3.0, 0.25, out],
        [-4.0, 1.25, 0.0],
        [-4.0, 3.0, quarter],
        [-6.0, 5.0, 0.0],
        [-8.0, 5.0, quarter],
        [-10.0, 3.0, 0.0],
        [-10.0, -3.0, quarter],
    ];
    let ring = |handle, at: f64| circle(handle, Role::Opening, [at, 0.0], 3.0);
    let punch = |at: f64| rectangle("2C", Role::Punch, [at, -5.0], [at + 10.0, 5.0]);
    let rows: Vec<Narrow> = vec![
        (
            "a neck",
            vec![polygon("2A", Role::Opening, rooms)],
            ("2A", Some("2A")),
            0.46,
        ),
        // The other side of the same walls is wide.
        (
            "the part",
            vec![polygon("2A", Role::Punch, rooms)],
            ("2A", None),
            1.96,
        ),
        (
            "an opening alone",
            vec![ring("2A", 0.0)],
            ("2A", None),
            5.96,
        ),
        (
            "two openings",
            vec![ring("2A", 0.0), ring("2B", 6.3)],
            ("2A", None),
            5.96,
        ),
        (
            "two punches",
            vec![
                ring("2A", 50.0),
                punch(0.0),
                Entity {
                    handle: "2D".into(),
                    ..punch(10.8)
                },
            ],
            ("2C", Some("2D")),
            0.76,
        ),
    ];
    for (what, entities, (handle, facing), diameter) in rows {
        let (drawing, settings) = (drawing(entities), settings("gap = 0.02\n"));
        let outlines = Analysis::new(&drawing, Arc::new(settings.clone()))
            .outlines(&drawing)
            .clone();
        let largest = |is_cut: &dyn Fn(usize) -> bool| {
            wedm::analysis::largest_wire(&drawing, &outlines, &settings, is_cut)
        };
        let found = largest(&|_| true).unwrap_or_else(|| panic!("{what}"));
        let handle_of = |entity| drawing.get(entity).map(|it| it.handle.to_string());
        assert!(
            (found.diameter - diameter).abs() < 1e-9,
            "{what}: {found:?}"
        );
        assert_eq!(handle_of(found.entity).as_deref(), Some(handle), "{what}");
        let other = found.facing.and_then(|(entity, _)| handle_of(entity));
        assert_eq!(other.as_deref(), facing, "{what}");
        assert!(
            (found.diameter - 2.0 * (found.radius - 0.02)).abs() < 1e-9,
            "{what}"
        );
        // What is not cut limits nothing.
        let of_first = largest(&|outline| outline == 0).map(|it| it.diameter);
        assert!(
            of_first.is_some_and(|first| first >= found.diameter),
            "{what}"
        );
    }
    // Walls are as wide apart as a wire that just passes: by the proof of its path.
    let passes = |correction: f64| {
        let text = format!("correction = {correction}\n[program]\nlead-in = {correction}\n");
        let drawing = drawing(vec![polygon("2A", Role::Opening, rooms)]);
        let source = Of::Cad(Arc::new(drawing));
        let document = Document::new(source, Arc::new(settings(&text)));
        generate(&document, Format::ThreeB, false).is_ok()
    };
    assert!(passes(0.2499) && !passes(0.2501));
}

fn quarter() -> f64 {
    (std::f64::consts::PI / 8.0).tan()
}

#[test]
fn a_contour_may_have_a_tab_of_its_own() {
    let both = drawing(vec![
        rectangle("2A", Role::Punch, [0.0, 0.0], [40.0, 20.0]),
        rectangle("2B", Role::Punch, [60.0, 0.0], [90.0, 20.0]),
        rectangle("2C", Role::Punch, [120.0, 0.0], [140.0, 20.0]),
    ]);
    let paths = planned(&both, &settings("[program]\ntab = { 2A = 5, 2C = 3 }\n")).paths;
    let tabs: Vec<(usize, f64)> = paths
        .iter()
        .filter(|path| path.cut_off)
        .map(|path| {
            let own = path
                .segments
                .iter()
                .filter(|piece| matches!(piece.source, Source::Segment { .. }));
            (
                path.outline,
                own.map(|piece| piece.geometry.length()).sum::<f64>(),
            )
        })
        .collect();
    let [(0, a), (2, c)] = tabs[..] else {
        panic!("{tabs:?}")
    };
    assert!((a - 5.0).abs() < 1e-9 && (c - 3.0).abs() < 1e-9, "{tabs:?}");
}

#[test]
fn a_tab_of_a_contour_that_is_not_there_is_said() {
    let punch = drawing(vec![rectangle("2A", Role::Punch, [0.0, 0.0], [40.0, 20.0])]);
    let said = refusal(&punch, &settings("[program]\ntab = { 2Z = 5 }\n"));
    assert_eq!(said, "there is no entity with the handle 2Z");
}

/// A neck of an opening and a notch of its outside, each 0.5 mm wide and away from all arcs: the wire of the plate runs in the neck, that of the
/// punch in the notch.
#[test]
fn a_narrow_place_of_a_pair_is_that_of_the_part_that_is_cut_there() {
    let bump = quarter();
    let neck: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [8.0, 0.0, bump],
        [10.0, 2.0, 0.0],
        [10.0, 4.75, 0.0],
        [14.0, 4.75, 0.0],
        [14.0, 0.0, 0.0],
        [24.0, 0.0, 0.0],
        [24.0, 10.0, 0.0],
        [14.0, 10.0, 0.0],
        [14.0, 5.25, 0.0],
        [10.0, 5.25, 0.0],
        [10.0, 10.0, 0.0],
        [0.0, 10.0, 0.0],
    ];
    let notch: &[[f64; 3]] = &[
        [0.0, 0.0, 0.0],
        [8.0, 0.0, bump],
        [10.0, 2.0, 0.0],
        [10.0, 4.75, 0.0],
        [4.0, 4.75, 0.0],
        [4.0, 5.25, 0.0],
        [10.0, 5.25, 0.0],
        [10.0, 10.0, 0.0],
        [0.0, 10.0, 0.0],
    ];
    let check = |vertices: &[[f64; 3]], pair: &str, expected: f64| {
        let text = format!("wire-diameter = 0.2\ngap = 0.02\n[pair]\nclearance = 0.05\n{pair}");
        let settings = settings(&text);
        let drawing = drawing(vec![polygon("2A", Role::Both, vertices)]);
        let outlines = Analysis::new(&drawing, Arc::new(settings.clone()))
            .outlines(&drawing)
            .clone();
        let found = wedm::analysis::largest_wire(&drawing, &outlines, &settings, &|_| true);
        let found = found.map_or(0.0, |found| found.diameter);
        assert!((found - expected).abs() < 1e-9, "{pair}: {found}");
    };
    // 0.5 less two gaps, and two clearances more where the wire runs nearer to its contour by one.
    check(neck, "drawn-as = \"punch\"\n", 0.56);
    check(neck, "drawn-as = \"plate\"\n", 0.46);
    check(notch, "drawn-as = \"punch\"\n", 0.46);
    check(notch, "drawn-as = \"plate\"\n", 0.56);
    check(neck, "drawn-as = \"punch\"\nholder = 0.01\n", 0.44);
    check(neck, "drawn-as = \"plate\"\nholder = 0.01\n", 0.34);
    check(notch, "drawn-as = \"plate\"\nholder = 0.01\n", 0.56);
}
