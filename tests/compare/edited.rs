//! Blocks that were exchanged, and a drawing that was edited.

use super::{Shape, document, plate, program_of, settings_of, traced};
use wedm::compare::{Drawn, compare};
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

/// A way in, or from one contour to the next, that is moved by a millimetre moves the contour, too: that is no other hole.
#[test]
fn a_contour_that_a_way_leads_astray_is_named_at_the_way() {
    let settings = settings_of("correction = 0.1\n[program]\nlayout = \"compact\"\n");
    let [(shape, role)] = plate(0.0);
    let Shape::Polyline(vertices) = &shape else {
        panic!("{shape:?}");
    };
    let beside = vertices
        .iter()
        .map(|[x, y, bulge]| [x + 60.0, y + 5.0, *bulge]);
    let beside = (Shape::Polyline(beside.collect()), role);
    let own = document(&[(shape, role), beside], &settings);
    for format in [Format::ThreeB, Format::Iso] {
        let text = program_of(&own, format).unwrap();
        let snapshot = own.snapshot().unwrap();
        let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
        let lines: Vec<&str> = text.lines().collect();
        let (way, moved) = match format {
            // The way to the next contour, by its length.
            Format::ThreeB => {
                let way = lines.iter().position(|line| *line == "D").unwrap() + 1;
                let (words, count) = lines[way].rsplit_once('B').unwrap();
                let (count, rest) = count.split_once('G').unwrap();
                let count = count.parse::<i64>().unwrap() + 1000;
                (way, format!("{words}B{count}G{rest}"))
            }
            // The way in.
            _ => {
                let way = lines.iter().position(|line| line.contains("G01")).unwrap();
                let (words, y) = lines[way].split_once('Y').unwrap();
                (
                    way,
                    format!("{words}Y{:.3}", y.parse::<f64>().unwrap() + 1.0),
                )
            }
        };
        let mut changed = lines.clone();
        changed[way] = &moved;
        let found = compare(
            &drawn,
            &traced(&(changed.join("\n") + "\n"), format, &settings),
        );
        let found = found.unwrap().differences;
        assert!(
            found
                .iter()
                .any(|one| one.line.abs_diff(way) <= 1 && one.off > 0.9),
            "{text}: {found:?}"
        );
    }
}
