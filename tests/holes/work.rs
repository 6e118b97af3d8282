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
    let text = "[passes]\nrates = [100]\n[job]\nthickness = 40\nmachine-rate = 60\n[program]\nthread = [10.4723, 0]\nentry = [10.4723, 0]\n";
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
        let found = wedm::toolpath::largest_wire(&drawing, &outlines, &settings, &|_| true);
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
    // The wire runs outside of it.
    check(Role::Punch, "gap = 0.02\n", None);
    check(Role::Opening, "", None);
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
