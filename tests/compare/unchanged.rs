//! Unchanged programs under settings that do not say what they were written with.

use super::{Shape, document, plate, program_of, settings_of, traced};
use std::f64::consts::TAU;
use wedm::compare::{Drawn, compare};
use wedm::drawing::Role;
use wedm::program::Format;

/// Where a guess has another tab than the program, it parts from it before the stop and after it: that says nothing of the program.
#[test]
fn an_unchanged_program_with_a_tab_that_the_settings_do_not_know_has_nothing_said() {
    let written = "correction = 0.137\n[program]\ntab = 2.5\nlead = \"straight\"\n";
    for teeth in [7, 9, 13] {
        let vertex = |index: usize| {
            let (share, high, bulge) = [
                (0.0, 0.0, 0.0),
                (0.15, 1.0, -0.4),
                (0.5, 1.0, 0.0),
                (0.65, 0.0, 0.4),
            ][index % 4];
            let angle = -((index / 4) as f64 + share + 0.3) / teeth as f64 * TAU;
            let radius = 2.0 * teeth as f64 + high;
            [radius * angle.cos(), radius * angle.sin(), bulge]
        };
        let gear = [(
            Shape::Polyline((0..4 * teeth).map(vertex).collect()),
            Role::Punch,
        )];
        let text = program_of(&document(&gear, &settings_of(written)), Format::ThreeB).unwrap();
        let settings = settings_of("correction = 0.1\n");
        let snapshot = document(&gear, &settings).snapshot().unwrap();
        let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
        let found = compare(&drawn, &traced(&text, Format::ThreeB, &settings));
        let said = found.map_or(Vec::new(), |found| found.differences);
        assert_eq!(said, [], "{teeth} teeth\n{text}");
    }
}

/// A circle alone says nothing of the correction, nor of the way in: under settings that do not know them its program is as it should be.
#[test]
fn an_unchanged_program_of_a_circle_has_nothing_said() {
    for role in [Role::Punch, Role::Opening] {
        // Where no way in is set the wire of an opening is threaded in the centre, and the way in is the path's radius.
        for (correction, lead, at, radius) in [
            (0.12, "lead-in = 3", 0.0, 10.0),
            (0.09, "lead-in = 2", 5.0, 10.0),
            (0.155, "lead-in = 4", -3.5, 10.0),
            (0.2, "lead-in = 3", 12.345, 10.0),
            (0.11, "", 0.0, 5.0),
            (0.14, "", 0.0, 5.0),
            (0.3, "", 0.0, 5.0),
        ] {
            for format in [Format::ThreeB, Format::Iso] {
                let shapes = [(Shape::Circle([at, 0.0], radius), role)];
                let written =
                    settings_of(&format!("correction = {correction}\n[program]\n{lead}\n"));
                let text = program_of(&document(&shapes, &written), format).unwrap();
                let settings = settings_of("");
                let drawn = document(&shapes, &settings).drawn().unwrap();
                let found = compare(&drawn, &traced(&text, format, &settings));
                let said = found.map_or(Vec::new(), |found| found.differences);
                assert_eq!(said, [], "{correction} {lead} {role:?}\n{text}");
            }
        }
    }
}

/// The wire of a program is threaded where it is, whatever the settings say since: the contour is entered, and closes, elsewhere.
#[test]
fn a_thread_hole_that_was_moved_since_is_no_fault_of_the_program() {
    let (p, q) = (plate(0.0)[0].0.clone(), Shape::Circle([8.0, 8.0], 4.0));
    for (shape, role, places) in [
        (
            p.clone(),
            Role::Opening,
            [[8.0, 4.0], [9.0, 5.0], [8.1, 4.0]],
        ),
        (p, Role::Punch, [[8.0, -4.0], [9.0, -5.0], [8.1, -4.0]]),
        (q, Role::Opening, [[8.0, 8.0], [8.0, 9.0], [8.0, 8.1]]),
    ] {
        let under = |[x, y]: [f64; 2], keys: &str| {
            settings_of(&format!(
                "correction = 0.1\n[program]\nthread = [{x:?}, {y:?}]\n{keys}"
            ))
        };
        let shapes = [(shape, role)];
        for format in [Format::ThreeB, Format::Iso, Format::FourB] {
            for keys in ["", "tab = 2.0\n"] {
                let keys = if format == Format::FourB { "" } else { keys };
                let written = under(places[0], keys);
                let text = program_of(&document(&shapes, &written), format).unwrap();
                for place in places {
                    let settings = under(place, keys);
                    let drawn = document(&shapes, &settings).drawn().unwrap();
                    let found = compare(&drawn, &traced(&text, format, &settings));
                    let said = found.map_or(Vec::new(), |found| found.differences);
                    assert_eq!(said, [], "{keys} {format:?} {place:?}\n{text}");
                }
            }
        }
    }
}
