//! Programs of passes, tabs and overlaps.

use super::{Shape, document, program_of, settings_of, traced};
use wedm::compare::compare;
use wedm::drawing::Role;
use wedm::finding::Severity;
use wedm::program::{self, Format};

/// What is asked of a drawing's own program: passes, sequence, tab, overlap, lead, control. Nothing is wrong in it, and it follows its
/// drawing.
#[test]
fn programs_of_passes_tabs_and_overlaps_have_nothing_wrong() {
    const PASSES: [&str; 5] = [
        "correction = 0.15",
        "[passes]\ncorrections = [0.215, 0.18, 0.15]",
        "[passes]\ncorrections = [0.215, 0.18, 0.15]\nsequence = \"one-way\"",
        "[passes]\ncorrections = [0.2, 0.15]",
        "[passes]\ncorrections = [0.2, 0.15]\nsequence = \"one-way\"",
    ];
    const FORMATS: [(Format, &str); 4] = [
        (Format::ThreeB, "path"),
        (Format::Iso, "path"),
        (Format::Iso, "controller"),
        (Format::FourB, "path"),
    ];
    let polyline = |vertices: &[[f64; 3]]| Shape::Polyline(vertices.to_vec());
    let shapes = [
        Shape::Circle([0.0, 0.0], 7.2),
        polyline(&[
            [0.0, 0.0, 0.0],
            [40.0, 0.0, 0.0],
            [40.0, 20.0, 0.0],
            [0.0, 20.0, 0.0],
        ]),
        polyline(&[
            [0.0, 0.0, 0.0],
            [30.0, 0.0, 0.0],
            [30.0, 10.0, 0.0],
            [10.0, 10.0, 0.0],
            [10.0, 30.0, 0.0],
            [0.0, 30.0, 0.0],
        ]),
        polyline(&[
            [2.0, 0.0, 0.0],
            [38.0, 0.0, 0.41421356],
            [40.0, 2.0, 0.0],
            [40.0, 20.0, -0.3],
            [0.0, 20.0, 0.0],
            [0.0, 2.0, 0.41421356],
        ]),
    ];
    // Every so manieth of all combinations.
    let each = std::env::var("WEDM_EACH").map_or(23, |each| each.parse().unwrap());
    let (mut made, mut wrong) = (0, Vec::new());
    for number in (0..2 * 4 * 5 * 4 * 2 * 2 * 3 * 2).step_by(each) {
        let mut left = number;
        let mut pick = |count: usize| {
            let own = left % count;
            left /= count;
            own
        };
        let role = [Role::Punch, Role::Opening][pick(2)];
        let shape = &shapes[pick(4)];
        let passes = PASSES[pick(5)];
        let (format, compensation) = FORMATS[pick(4)];
        let (tab, overlap) = ([0.0, 2.0][pick(2)], [0.0, 0.5][pick(2)]);
        let lead = ["perpendicular", "arc", "straight"][pick(3)];
        let corner = ["arc", "intersection"][pick(2)];
        let keys = format!(
            "{passes}\n[program]\ntab = {tab}\nclosing-overlap = {overlap}\nlead = \"{lead}\"\n\
             corner = \"{corner}\"\ncompensation = \"{compensation}\"\n"
        );
        let side = if role == Role::Punch {
            "punch"
        } else {
            "opening"
        };
        let settings = settings_of(&format!(
            "side = \"{side}\"\nwire-diameter = 0.2\ngap = 0.01\n{keys}"
        ));
        let document = document(&[(shape.clone(), role)], &settings);
        let Some(text) = program_of(&document, format) else {
            // 4B keeps no tab in several passes.
            assert_eq!(format, Format::FourB, "{keys}");
            continue;
        };
        made += 1;
        let language = format.language();
        let read = program::Document::read(language, text.clone().into(), &settings);
        let (mut found, _) = read.findings(&settings, usize::MAX);
        found.retain(|finding| finding.severity <= Severity::Warning);
        let drawn = document.drawn().unwrap();
        let beside = compare(&drawn, &traced(&text, format, &settings));
        let beside = beside.map(|beside| beside.differences);
        if !found.is_empty() || beside != Some(Vec::new()) {
            let keys = keys.replace('\n', " ");
            wrong.push(format!(
                "{number} {format:?} {side} {keys}\n{found:?}\n{beside:?}\n{text}"
            ));
        }
    }
    println!("{made} programs");
    assert!(
        made > 0 && wrong.is_empty(),
        "{}\n{} of {made} programs",
        wrong.join("\n"),
        wrong.len()
    );
}
