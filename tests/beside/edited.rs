//! Blocks that were exchanged, and a drawing that was edited.

use super::{document, plate, program_of, settings_of, traced};
use wedm::beside::{Drawn, compare};
use wedm::document::Document;
use wedm::program::Format;

#[test]
fn exchanged_blocks_and_an_edited_drawing_are_named_once() {
    for (format, keys) in [
        (Format::ThreeB, "layout = \"compact\""),
        (Format::ThreeB, "layout = \"checking\""),
        (Format::Iso, "profile = \"fast-wire\""),
    ] {
        let settings = settings_of(&format!("correction = 0.1\n[program]\n{keys}\n"));
        let own = document(&plate(0.0), &settings);
        let text = program_of(&own, format).unwrap();
        let told = |of: &Document, text: &str| {
            let snapshot = of.snapshot().unwrap();
            let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
            let found = compare(&drawn, &traced(text, format, &settings));
            found.map(|found| found.differences)
        };
        assert_eq!(told(&own, &text), Some(vec![]), "{keys}");
        let edited = told(&document(&plate(0.003), &settings), &text).unwrap();
        let segments: Vec<usize> = edited
            .iter()
            .filter_map(|one| Some(one.segment?.1))
            .collect();
        assert!(matches!(segments[..], [0 | 1]), "{keys}: {edited:?}");
        // Two blocks of the contour, one for the other.
        let mut lines: Vec<&str> = text.lines().collect();
        let middle = lines.len() / 2;
        lines.swap(middle, middle + 1);
        let exchanged = told(&own, &(lines.join("\n") + "\n")).unwrap();
        assert!(
            exchanged
                .iter()
                .any(|one| (middle - 1..=middle + 1).contains(&one.line)),
            "{keys}: {exchanged:?}"
        );
    }
}
