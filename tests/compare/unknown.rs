//! Programs beside drawings whose settings say nothing of how they were written.

use super::{Shape, document, plate, program_of, settings_of, traced};
use crate::size::by_day;
use wedm::compare::compare;
use wedm::drawing::Role;
use wedm::program::Format;

/// What is asked of one program: its drawing, its language and the settings that it was written under.
struct Row {
    shape: Shape,
    role: Role,
    format: Format,
    settings: String,
}

/// Passes and sides in every language, each with what else may be set.
fn rows() -> Vec<Row> {
    let corrections = [
        "correction = 0.12",
        "[passes]\ncorrections = [0.215, 0.195]\nsequence = \"one-way\"",
        "[passes]\ncorrections = [0.2159, 0.1626, 0.1473]",
        "[passes]\ncorrections = [0.215, 0.17, 0.14]\nskim-corner = \"constant-stock\"",
    ];
    let keys = [
        "lead = \"straight\"\nlead-in = 2",
        "direction = \"cw\"\ntab = 2.5",
        "corner = \"intersection\"\nclosing-overlap = 0.5",
        "lead = \"arc\"\nlead-in = 1.5",
        "compensation = \"controller\"\nlead-in = 4",
    ];
    let mut rows = Vec::new();
    for (nth, correction) in corrections.into_iter().enumerate() {
        for (more, keys) in keys.into_iter().enumerate() {
            for (other, role) in [Role::Punch, Role::Opening].into_iter().enumerate() {
                let formats = [Format::ThreeB, Format::Iso, Format::FourB];
                let format = formats[(nth + more + other) % formats.len()];
                let is_fit = match format {
                    Format::Iso => true,
                    Format::ThreeB => !keys.contains("controller"),
                    _ => nth == 0 || !keys.contains("tab") && !keys.contains("overlap"),
                };
                let shape = match (nth + more) % 3 {
                    0 => Shape::Circle([2.0, 1.0], 8.0),
                    _ => plate(0.0)[0].0.clone(),
                };
                rows.extend(is_fit.then(|| Row {
                    shape,
                    role,
                    format,
                    settings: format!("{correction}\n[program]\n{keys}\n"),
                }));
            }
        }
    }
    rows
}

/// Neither the side of a contour, nor correction, passes, lead, tab or overlap is known: of an unchanged program nothing is reported.
/// `WEDM_CASES=1 cargo test --test core compare::unknown::without_settings` asks it of every row, else of some.
#[test]
fn without_settings_nothing_is_said_of_an_unchanged_program() {
    // Settings that nobody has said are found by trying, which takes minutes without optimization: by night alone.
    if by_day(true, false) {
        return;
    }
    let rows = rows();
    let (mut followed, mut all) = (0, 0);
    for row in &rows {
        let written = settings_of(&row.settings);
        let made = document(&[(row.shape.clone(), row.role)], &written);
        let Some(text) = program_of(&made, row.format) else {
            continue;
        };
        let settings = settings_of("");
        let drawn = document(&[(row.shape.clone(), Role::Both)], &settings)
            .drawn()
            .unwrap();
        let found = compare(&drawn, &traced(&text, row.format, &settings));
        all += 1;
        followed += usize::from(found.is_some());
        let said = found.map_or(Vec::new(), |found| found.differences);
        assert_eq!(
            said,
            [],
            "{:?} {:?} {}\n{text}",
            row.role,
            row.format,
            row.settings
        );
    }
    // It is not only that nothing was compared.
    assert!(all > 3 && 2 * followed >= all, "{followed} of {all}");
}

/// A correction of four places is not guessed to the last of them, nor is an overlap on a circle: of an unchanged program nothing is reported.
#[test]
fn a_correction_of_four_places_and_an_overlap_name_nothing_of_a_circle() {
    let settings = settings_of("");
    for (radius, correction, overlap, role, format) in [
        (4.0, 0.0875, 0.3, Role::Punch, Format::Iso),
        (4.0, 0.0875, 1.5, Role::Punch, Format::Iso),
        (8.0, 0.0875, 0.5, Role::Punch, Format::Iso),
        (12.0, 0.0875, 1.0, Role::Punch, Format::Iso),
    ] {
        let circle = Shape::Circle([7.0, 2.5], radius);
        let written = settings_of(&format!(
            "correction = {correction}\n[program]\nlead-in = 3\nclosing-overlap = {overlap}\n"
        ));
        let made = document(&[(circle.clone(), role)], &written);
        let text = program_of(&made, format).unwrap();
        let drawn = document(&[(circle, Role::Both)], &settings)
            .drawn()
            .unwrap();
        let found = compare(&drawn, &traced(&text, format, &settings));
        let said = found.map_or(Vec::new(), |found| found.differences);
        assert_eq!(said, [], "{radius} {correction} {overlap} {role:?}\n{text}");
    }
}
