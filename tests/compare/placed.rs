//! Contours, vertices, and ways in that lie elsewhere than the drawing has them.

use super::{Shape, document, program_of, settings_of, traced};
use wedm::compare::{Difference, DifferenceKind, Drawn, compare};
use wedm::document::Document;
use wedm::drawing::Role;
use wedm::program::Format;

fn rectangle([x, y]: [f64; 2], [width, height]: [f64; 2], role: Role) -> (Shape, Role) {
    let vertices = vec![
        [x, y, 0.0],
        [x + width, y, 0.0],
        [x + width, y + height, 0.0],
        [x, y + height, 0.0],
    ];
    (Shape::Polyline(vertices), role)
}

fn polygon(vertices: &[[f64; 2]], role: Role) -> (Shape, Role) {
    let vertices = vertices.iter().map(|[x, y]| [*x, *y, 0.0]);
    (Shape::Polyline(vertices.collect()), role)
}

fn told(of: &Document, text: &str, format: Format) -> Option<Vec<Difference>> {
    let snapshot = of.snapshot().unwrap();
    let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
    let found = compare(&drawn, &traced(text, format, &snapshot.settings));
    found.map(|found| found.differences)
}

#[track_caller]
fn lines_of(of: &Document, text: &str, format: Format) -> Vec<usize> {
    let found = told(of, text, format).unwrap_or_else(|| panic!("nothing is alike\n{text}"));
    found.iter().map(|one| one.line + 1).collect()
}

#[test]
fn a_contour_out_of_place_is_named_at_the_way_to_it() {
    for format in [Format::ThreeB, Format::Iso, Format::FourB] {
        for keys in [
            "",
            "lead = \"arc\"",
            "compensation = \"controller\"",
            "tab = 1.5",
        ] {
            if format != Format::Iso && keys.starts_with('c')
                || format == Format::FourB && keys.starts_with("lead")
            {
                continue;
            }
            let settings = settings_of(&format!("correction = 0.1\n[program]\n{keys}\n"));
            let of = |by: [f64; 2]| {
                let second = rectangle([30.0 + by[0], 2.0 + by[1]], [8.0, 6.0], Role::Opening);
                document(
                    &[rectangle([0.0, 0.0], [20.0, 12.0], Role::Opening), second],
                    &settings,
                )
            };
            let Some(text) = program_of(&of([0.0, 0.0]), format) else {
                continue;
            };
            assert_eq!(
                told(&of([0.0, 0.0]), &text, format),
                Some(vec![]),
                "{keys}\n{text}"
            );
            for by in [[0.06, 0.0], [0.0, 0.2], [1.0, 0.0], [3.0, 2.0], [0.0, -0.5]] {
                let found = told(&of(by), &text, format).unwrap();
                let off = by[0].hypot(by[1]);
                assert!(
                    matches!(&found[..], [one] if one.segment.is_some() && one.kind == DifferenceKind::Moved && (one.off - off).abs() < 4e-3),
                    "{format:?} {keys} {by:?}: {found:?}\n{text}"
                );
            }
        }
    }
}

/// Programs from elsewhere than where ours begin, with one vertex elsewhere: its block is named, however few there are.
#[test]
fn one_vertex_of_a_few_is_named_where_it_is() {
    let corner = [
        [0.0, 0.0],
        [20.0, 0.0],
        [20.0, 12.0],
        [8.0, 12.0],
        [8.0, 6.0],
        [0.0, 6.0],
    ];
    let own = document(
        &[polygon(&corner, Role::Opening)],
        &settings_of("correction = 0.1\n"),
    );
    let places = [
        [0.1, 0.1],
        [19.9, 0.1],
        [19.9, 11.9],
        [8.1, 11.9],
        [8.1, 5.9],
        [0.1, 5.9],
    ];
    let lines = |places: &[[f64; 2]]| {
        let um = |mm: f64| (mm * 1e3).round() as i64;
        let hole = [7.0, 3.0];
        let mut text = "; Start Point = 7.000 , 3.000\n".to_owned();
        let (mut at, ways) = (hole, places.iter().chain([&places[0], &hole]));
        for to in ways {
            let [x, y] = [um(to[0]) - um(at[0]), um(to[1]) - um(at[1])];
            let axis = if x.abs() >= y.abs() { 'X' } else { 'Y' };
            let kind = match (x.signum(), y.signum()) {
                (1, 0 | 1) => 1,
                (0 | -1, 1) => 2,
                (-1, _) => 3,
                _ => 4,
            };
            let j = x.abs().max(y.abs());
            text += &format!("B{}B{}B{j}G{axis}L{kind}\n", x.abs(), y.abs());
            at = *to;
        }
        text + "DD\n"
    };
    assert_eq!(lines_of(&own, &lines(&places), Format::ThreeB), [0; 0]);
    for vertex in 1..places.len() {
        for by in [[0.5, 0.0], [0.0, 0.5], [0.05, 0.0], [0.0, -0.05]] {
            let mut wrong = places;
            wrong[vertex] = [wrong[vertex][0] + by[0], wrong[vertex][1] + by[1]];
            let text = lines(&wrong);
            let found = lines_of(&own, &text, Format::ThreeB);
            // The block that leads there, or the one from there.
            assert!(
                matches!(found[..], [line] if (vertex + 2..=vertex + 3).contains(&line)),
                "{vertex} {by:?}: {found:?}\n{text}"
            );
        }
    }
}

/// A program that says nothing of where it lies: which of its sides are off, the others say.
#[test]
fn a_rectangle_that_is_drawn_longer_is_named_at_both_long_sides() {
    let from_a_corner = "B5000B5000B5000GYL3\nB19800B0B19800GXL1\nB0B9800B9800GYL2\nB19800B0B19800GXL3\nB0B9800B9800GYL4\nB5000B5000B5000GYL1\nDD\n";
    let from_a_side = "B5000B5000B5000GYL4\nB9900B0B9900GXL1\nB0B9800B9800GYL2\nB19800B0B19800GXL3\nB0B9800B9800GYL4\nB9900B0B9900GXL1\nB5000B5000B5000GYL2\nDD\n";
    for text in [from_a_corner, from_a_side] {
        for longer in [0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 0.9] {
            let shape = rectangle([0.0, 0.0], [20.0 + longer, 10.0], Role::Opening);
            let own = document(&[shape], &settings_of("correction = 0.12\n"));
            let found = lines_of(&own, text, Format::ThreeB);
            let expected = if longer > 0.0 { vec![2, 4] } else { vec![] };
            assert_eq!(found, expected, "{longer}\n{text}");
        }
    }
}

#[test]
fn a_way_in_that_ends_beside_its_contour_is_named() {
    let shape = polygon(
        &[
            [0.0, 0.0],
            [20.0, 0.0],
            [20.0, 10.0],
            [8.0, 14.0],
            [0.0, 10.0],
        ],
        Role::Punch,
    );
    let own = document(&[shape], &settings_of("correction = 0.1\n"));
    for by in [0.0, 0.04, 0.06, 0.3, 1.0] {
        let text = format!(
            "G21\nG90\nG92 X10. Y-3.\nG42 D1\nG01 X10.000 Y{by:.3}\nG01 X20.000 Y0.000\nG01 X20.000 Y10.000\nG01 X8.000 Y14.000\nG01 X0.000 Y10.000\nG01 X0.000 Y0.000\nG01 X10.000 Y0.000\nG40\nG01 X10. Y-3.\nM02\n"
        );
        let found = lines_of(&own, &text, Format::Iso);
        assert_eq!(found, if by > 0.0 { vec![5] } else { vec![] }, "{by}");
        let path = format!(
            "G21\nG90\nG92 X10.000 Y-3.000\nG01 X10.000 Y{:.3}\nG01 X20.000 Y-0.100\nG03 X20.100 Y0.000 I0.000 J0.100\nG01 X20.100 Y10.000\nG03 X20.032 Y10.095 I-0.100 J0.000\nG01 X8.032 Y14.095\nG03 X7.955 Y14.089 I-0.032 J-0.095\nG01 X-0.045 Y10.089\nG03 X-0.100 Y10.000 I0.045 J-0.089\nG01 X-0.100 Y0.000\nG03 X0.000 Y-0.100 I0.100 J0.000\nG01 X10.000 Y-0.100\nG01 X10.000 Y-3.000\nM02\n",
            by - 0.1
        );
        let found = lines_of(&own, &path, Format::Iso);
        assert_eq!(found, if by > 0.0 { vec![4] } else { vec![] }, "{by}");
    }
}

#[test]
fn a_vertex_of_three_in_one_of_two_passes_is_named() {
    let shape = polygon(&[[0.0, 0.0], [20.0, 0.0], [4.0, 15.0]], Role::Punch);
    let own = document(
        &[shape],
        &settings_of("[passes]\ncorrections = [0.2, 0.13]\n"),
    );
    let text = |y: f64| {
        format!(
            "G21\nG90\nG92 X10.000 Y-3.000\nG42 D1\nG01 X10.000 Y0.000\nG01 X20.000 Y{y:.3}\nG01 X4.000 Y15.000\nG01 X0.000 Y0.000\nG01 X10.000 Y0.000\nG40\nG01 X10.000 Y-3.000\nM00\nG41 D2\nG01 X10.000 Y0.000\nG01 X0.000 Y0.000\nG01 X4.000 Y15.000\nG01 X20.000 Y0.000\nG01 X10.000 Y0.000\nG40\nG01 X10.000 Y-3.000\nM02\n"
        )
    };
    assert_eq!(lines_of(&own, &text(0.0), Format::Iso), [0; 0]);
    for y in [0.03, 0.3, 1.0, -1.0] {
        assert_eq!(lines_of(&own, &text(y), Format::Iso), [6], "{y}");
    }
}

#[test]
fn a_program_on_the_other_side_is_named_at_its_first_block() {
    let of = |role| {
        document(
            &[rectangle([0.0, 0.0], [20.0, 12.0], role)],
            &settings_of("correction = 0.1\n"),
        )
    };
    for format in [Format::ThreeB, Format::Iso] {
        for (made, meant) in [(Role::Punch, Role::Opening), (Role::Opening, Role::Punch)] {
            let text = program_of(&of(made), format).unwrap();
            let found = told(&of(meant), &text, format).unwrap_or_default();
            assert!(
                matches!(&found[..], [one] if one.kind == DifferenceKind::OtherSide),
                "{found:?}\n{text}"
            );
        }
    }
}
