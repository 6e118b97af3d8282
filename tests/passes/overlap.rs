//! Passes that go on past their start.

use super::{PLATE, drawing, held, length, paths, settings};
use wedm::drawing::Role;
use wedm::program::Format;
use wedm::toolpath::Source;

#[test]
fn a_pass_goes_on_past_its_start_round_a_corner() {
    let of_punch = "entry = [39.8, 0]\nthread = [43, -3]\n";
    let of_opening = "entry = [39.7, 0]\n";
    for (role, rest) in [
        (Role::Punch, of_punch.to_owned()),
        (
            Role::Punch,
            format!("{of_punch}corner = \"intersection\"\n"),
        ),
        (Role::Opening, of_opening.to_owned()),
        (Role::Opening, format!("{of_opening}lead = \"arc\"\n")),
    ] {
        let settings = settings(&format!("[program]\nclosing-overlap = 0.5\n{rest}"));
        let drawing = drawing(role, &PLATE);
        held(&drawing, &settings, Format::ThreeB);
        held(&drawing, &settings, Format::Iso);
    }
}

#[test]
fn a_pass_goes_on_past_its_start() {
    for (text, count) in [
        ("[program]\nclosing-overlap = 0.5\n", 1),
        ("[program]\nclosing-overlap = 0.5\ntab = 2\n", 2),
        (
            "[passes]\ncorrections = [0.17, 0.14]\n[program]\nclosing-overlap = 0.5\n",
            2,
        ),
    ] {
        let settings = settings(text);
        let drawing = drawing(Role::Punch, &PLATE);
        let found = paths(&drawing, &settings);
        assert_eq!(found.len(), count);
        let over: f64 = found
            .iter()
            .map(|path| length(path, |source| matches!(source, Source::Overlap { .. })))
            .sum();
        let times = if text.contains("tab") { 1 } else { count };
        assert!((over - 0.5 * times as f64).abs() < 1e-9, "{over}: {text}");
        held(&drawing, &settings, Format::ThreeB);
        held(&drawing, &settings, Format::Iso);
    }
}
