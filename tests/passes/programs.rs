//! The programs of passes in every language.

use super::{SQUARE, THREE, drawing, generated, paths, settings};
use wedm::drawing::Role;
use wedm::finding::{Finding, Rule};
use wedm::program::{Document, Format, Language};

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
fn passes_are_parted_by_the_pause_that_is_set_and_read_back_without_a_fault() {
    let drawing = drawing(Role::Punch, &SQUARE);
    const NONE: &str = "pause-between-passes = \"\"";
    for corner in ["arc", "intersection"] {
        for (format, language, keys, expected) in [
            (Format::ThreeB, Language::ThreeB, "", 2),
            (Format::ThreeB, Language::ThreeB, NONE, 0),
            (Format::Iso, Language::Iso, "", 0),
            (Format::Iso, Language::Iso, "profile = \"robofil\"", 0),
            (Format::Iso, Language::Iso, "profile = \"fast-wire\"", 2),
            (
                Format::Iso,
                Language::Iso,
                "pause-between-passes = \"M00\"",
                2,
            ),
        ] {
            let settings = settings(&format!(
                "{THREE}[program]\ncorner = \"{corner}\"\n{keys}\n"
            ));
            let made = generated(&drawing, &settings, format);
            let text = made.program.text;
            assert_eq!(made.contours, 1);
            // But that it keeps no tab.
            let is_of_drawing = |said: &&Finding| said.rule != Rule::Settings;
            assert_eq!(made.warnings.iter().filter(is_of_drawing).count(), 0);
            let pause = if format == Format::Iso { "M00" } else { "D" };
            let pauses = text.lines().filter(|line| line.trim() == pause).count();
            assert_eq!(pauses, expected, "{text}");
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

/// The control brings the wire to its correction along the move after the register: no such move is shorter than that.
#[test]
fn each_move_that_starts_a_correction_is_at_least_as_long() {
    let corrections = [0.215, 0.17, 0.14, 0.13];
    for count in 1..=corrections.len() {
        for role in [Role::Punch, Role::Opening] {
            for tab in [0.0, 1.0] {
                let own = settings(&format!(
                    "passes.corrections = {:?}\n[program]\ncompensation = \"controller\"\ntab = {tab:?}\n",
                    &corrections[..count]
                ));
                let made = generated(&drawing(role, &SQUARE), &own, Format::Iso);
                let text = made.program.text;
                let (mut at, mut starts) = ([0.0, 0.0], None);
                for line in text.lines() {
                    let words = || line.split_whitespace();
                    let number = |letter: char| {
                        words().find_map(|word| word.strip_prefix(letter)?.parse().ok())
                    };
                    if line.starts_with("G41") || line.starts_with("G42") {
                        starts =
                            number('D').map(|register: f64| corrections[register as usize - 1]);
                    }
                    if let (Some(x), Some(y)) = (number('X'), number('Y')) {
                        let length = f64::hypot(x - at[0], y - at[1]);
                        if let Some(correction) = starts.take_if(|_| line.contains("G01")) {
                            assert!(length >= correction, "{line} in {text}");
                        }
                        at = [x, y];
                    }
                }
            }
        }
    }
}
