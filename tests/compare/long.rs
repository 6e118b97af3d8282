//! Long programs of short arcs.

use super::changes::{changed, line_of};
use super::{Shape, document, program_of, settings_of, traced};
use std::f64::consts::TAU;
use wedm::compare::{DifferenceKind, Drawn, compare, compare_within};
use wedm::drawing::Role;
use wedm::program::Format;

/// A ring of short arcs and chords, drawn on no grid, the same one at every run.
fn ring(count: usize) -> Vec<[f64; 3]> {
    let mut seed = 20_261_u64;
    let mut random = || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let radius = count as f64 * 0.04;
    let vertex = |index: usize| {
        let angle = (index as f64 + 0.6 * random()) / count as f64 * TAU;
        let away = radius + 0.05 * random();
        let bulge = match index % 3 {
            0 => 0.0,
            _ => 0.02 + 0.1 * random(),
        };
        [angle.cos() * away, angle.sin() * away, bulge]
    };
    (0..count).map(vertex).collect()
}

/// Where a machine that counts has drifted to after thousands of arcs is no fault of any of them.
#[test]
fn long_programs_of_short_arcs_follow_their_drawing() {
    for (count, format, keys) in [
        (2_000, Format::ThreeB, "layout = \"compact\""),
        (
            800,
            Format::ThreeB,
            "layout = \"checking\"\ndirection = \"cw\"",
        ),
        (800, Format::Iso, "profile = \"fast-wire\""),
        (800, Format::Iso, "compensation = \"controller\""),
    ] {
        let settings = settings_of(&format!("correction = 0.1\n[program]\n{keys}\n"));
        let shapes = [(Shape::Polyline(ring(count)), Role::Punch)];
        let document = document(&shapes, &settings);
        let text = program_of(&document, format).unwrap();
        let snapshot = document.snapshot().unwrap();
        let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
        let begin = std::time::Instant::now();
        let whole = compare(&drawn, &traced(&text, format, &settings)).unwrap();
        println!("{count} {format:?}: {:?}", begin.elapsed());
        assert_eq!(whole.differences, [], "{keys}");
        assert!(
            whole.follows.len() >= count,
            "{} {keys}",
            whole.follows.len()
        );
        let block = &whole.follows[whole.follows.len() / 3];
        let wrong = [0, 1]
            .into_iter()
            .find_map(|axis| changed(&text, block, 3, axis));
        let Some(wrong) = wrong else { continue };
        let found = compare(&drawn, &traced(&wrong, format, &settings)).unwrap();
        let lines: Vec<usize> = found.differences.iter().map(|found| found.line).collect();
        assert_eq!(lines, [line_of(&text, block.start)], "{keys}");
    }
}

/// What we write for a drawing of several contours in several passes is what is read, to every block.
#[test]
fn long_programs_of_several_contours_follow_their_drawing() {
    let corrections = ["correction = 0.1", "[passes]\ncorrections = [0.15, 0.1]"];
    let rows = [
        (Format::ThreeB, 0, ""),
        (Format::ThreeB, 1, "layout = \"checking\""),
        (Format::ThreeB, 0, "jumps = \"none\"\nheader = true"),
        (Format::ThreeB, 0, "tab = 2.5\nclosing-overlap = 0.5"),
        (Format::FourB, 0, "layout = \"aligned\""),
        (
            Format::Iso,
            0,
            "profile = \"robofil\"\ncompensation = \"controller\"",
        ),
        (Format::Iso, 1, "profile = \"fast-wire\""),
        (Format::Iso, 0, "jumps = \"none\""),
    ];
    for (format, passes, keys) in rows {
        let settings = settings_of(&format!("{}\n[program]\n{keys}\n", corrections[passes]));
        let circle = |at: f64, radius| (Shape::Circle([at, 0.0], radius), Role::Opening);
        let ring = (Shape::Polyline(ring(400)), Role::Punch);
        let document = document(&[ring, circle(-5.0, 4.0), circle(6.0, 5.0)], &settings);
        let text = program_of(&document, format).unwrap();
        let snapshot = document.snapshot().unwrap();
        let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
        let found = compare(&drawn, &traced(&text, format, &settings)).unwrap();
        assert_eq!(found.differences, [], "{format:?} {keys}");
        let block = &found.follows[found.follows.len() / 2];
        let wrong = [0, 1]
            .into_iter()
            .find_map(|axis| changed(&text, block, 3, axis));
        if let Some(wrong) = wrong {
            let line = line_of(&text, block.start);
            let found = compare(&drawn, &traced(&wrong, format, &settings)).unwrap();
            let lines: Vec<usize> = found.differences.iter().map(|found| found.line).collect();
            assert_eq!(lines, [line], "{format:?} {keys}");
        }
    }
}

/// What the steps do not reach is not judged: nothing is wrong there, and one information says where it begins.
#[test]
fn what_the_steps_do_not_reach_is_said_to_be_beyond() {
    let shapes = [0.0, 30.0, 60.0].map(|x| (Shape::Circle([x, 0.0], 5.0), Role::Opening));
    let text = program_of(
        &document(&shapes, &settings_of("correction = 0.12\n")),
        Format::ThreeB,
    )
    .unwrap();
    let settings = settings_of("correction = 0.1\n");
    let document = document(&shapes, &settings);
    let drawn = document.drawn().unwrap();
    let traced = traced(&text, Format::ThreeB, &settings);
    let (mut few, mut most) = (0, 0);
    for steps in (0..4_000).step_by(100) {
        let found = compare_within(&drawn, &traced, steps).unwrap();
        let kinds: Vec<DifferenceKind> = found
            .differences
            .iter()
            .map(|one| one.kind.clone())
            .collect();
        match kinds[..] {
            [DifferenceKind::Beyond] => few += 1,
            [] => most += 1,
            _ => panic!("{steps}: {kinds:?}"),
        }
    }
    assert!(few > 1 && most > 1, "{few} {most}");
}
