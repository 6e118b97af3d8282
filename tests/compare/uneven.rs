//! Contours of one program at different corrections: each follows its drawing, and still they do not belong together.

use super::*;
use wedm::compare::DifferenceKind;

fn square(x: f64) -> Shape {
    let corners = [[x, 0.0], [x + 10.0, 0.0], [x + 10.0, 10.0], [x, 10.0]];
    Shape::Polyline(corners.map(|[x, y]| [x, y, 0.0]).to_vec())
}

/// The first contour as it is cut at one correction, and the second as at another, from one thread hole each.
fn mixed(shapes: &[(Shape, Role)], keys: &str, format: Format, corrections: [f64; 2]) -> String {
    let [first, second] = corrections.map(|mm| {
        let settings = settings_of(&format!("{keys}correction = {mm}\n"));
        program_of(&document(shapes, &settings), format).expect("a program")
    });
    let stop = |text: &str| {
        let mut lines = text.lines().enumerate();
        let is_stop = |line: &str| line == "D" || line == "M00";
        lines.find(|(_, line)| is_stop(line)).expect("a stop").0
    };
    let head = first.lines().take(stop(&first));
    let rest = second.lines().skip(stop(&second));
    head.chain(rest).map(|line| format!("{line}\n")).collect()
}

#[test]
fn a_contour_at_another_correction_is_named() {
    let slanted = Shape::Polyline(vec![
        [30.0, 0.0, 0.0],
        [38.0, 3.0, 0.0],
        [35.0, 12.0, 0.2],
        [27.0, 9.0, 0.0],
    ]);
    for shapes in [
        vec![(square(0.0), Role::Opening), (square(20.0), Role::Opening)],
        vec![(square(0.0), Role::Opening), (slanted, Role::Opening)],
    ] {
        for format in [Format::ThreeB, Format::Iso] {
            for (set, corrections, named) in [
                ("correction = 0.1\n", [0.1, 0.15], "2B"),
                ("correction = 0.15\n", [0.1, 0.15], "2A"),
                ("correction = 0.2\n", [0.1, 0.15], "2B"),
                ("correction = 0.2\n", [0.15, 0.1], "2B"),
                ("correction = 0.1\n", [0.1, 0.11], "2B"),
            ] {
                let text = mixed(&shapes, "side = \"opening\"\n", format, corrections);
                let own = document(&shapes, &settings_of(set));
                let snapshot = own.snapshot().expect("a drawing");
                let drawn = wedm::compare::Drawn::of(
                    &snapshot.drawing,
                    &snapshot.outlines,
                    &snapshot.settings,
                );
                let traced = traced(&text, format, &snapshot.settings);
                let found = wedm::compare::compare(&drawn, &traced).expect("compared");
                let handles: Vec<String> = found
                    .differences
                    .iter()
                    .filter(|one| matches!(one.kind, DifferenceKind::Correction { .. }))
                    .filter_map(|one| {
                        let entity = snapshot.drawing.get(one.segment?.0)?;
                        Some(entity.handle.to_string())
                    })
                    .collect();
                assert_eq!(
                    (handles.as_slice(), found.differences.len()),
                    (&[named.to_owned()][..], 1),
                    "{format:?} {set} {corrections:?}: {:?}\n{text}",
                    found.differences
                );
                // One correction for both is none of this, whatever the settings say.
                let even = mixed(&shapes, "", format, [corrections[1]; 2]);
                let traced = super::traced(&even, format, &snapshot.settings);
                let found = wedm::compare::compare(&drawn, &traced).expect("compared");
                assert_eq!(found.differences, [], "{format:?} {set} {corrections:?}");
            }
        }
    }
}
