//! Every number of a program, changed alone.

use super::changes::{lengths, with_number};
use super::{Shape, document, plate, program_of, settings_of, traced};
use crate::size::by_day;
use wedm::beside::{Drawn, compare};
use wedm::drawing::Role;
use wedm::program::Format;
use wedm::settings::Lead;

/// An ISO program in millimetres that counts from block to block, or whose arcs of less than a third of a turn say their radius.
fn in_other_words(text: &str, counts: bool, by_radius: bool) -> String {
    let number = |line: &str, letter: char| -> Option<f64> {
        let rest = &line[line.find(letter)? + 1..];
        let end = rest.find(' ').unwrap_or(rest.len());
        rest[..end].parse().ok()
    };
    let mut at = [0.0, 0.0];
    let mut lines: Vec<String> = Vec::new();
    for line in text.lines() {
        let (Some(x), Some(y)) = (number(line, 'X'), number(line, 'Y')) else {
            lines.push(line.into());
            continue;
        };
        let before = std::mem::replace(&mut at, [x, y]);
        if line.starts_with("G92") {
            lines.push(line.into());
            lines.extend(counts.then(|| "G91".into()));
            continue;
        }
        let to = if counts {
            [x - before[0], y - before[1]]
        } else {
            at
        };
        let mut own = format!("{} X{:.3} Y{:.3}", &line[..3], to[0], to[1]);
        if let (Some(i), Some(j)) = (number(line, 'I'), number(line, 'J')) {
            let (radius, chord) = (i.hypot(j), (x - before[0]).hypot(y - before[1]));
            let is_left = line.starts_with("G03");
            // The centre lies to the left of the chord where less than half of the turn is gone.
            let side = (x - before[0]) * j - (y - before[1]) * i;
            let is_short = (side > 0.0) == is_left && chord < 1.7 * radius && chord > 0.5 * radius;
            own += &match by_radius && is_short {
                true => format!(" R{radius:.3}"),
                false => format!(" I{i:.3} J{j:.3}"),
            };
        }
        lines.push(own);
    }
    lines.join("\n") + "\n"
}

/// Each number of each line of programs in every dialect, changed alone: told at that line and nowhere else. So it is in programs that
/// say the same in other words, and in those that were written with other settings than the drawing has now.
#[test]
fn every_number_is_held_against_the_drawing() {
    let shapes = [
        plate(0.0)[0].clone(),
        (Shape::Circle([8.0, 8.0], 2.7), Role::Opening),
    ];
    let own = "correction = 0.12\n";
    let rows = [
        (Format::ThreeB, own, own),
        (
            Format::ThreeB,
            "correction = 0.12\n[program]\nlayout = \"checking\"\n",
            own,
        ),
        (Format::FourB, own, own),
        (Format::Iso, own, own),
        (
            Format::Iso,
            "correction = 0.12\n[program]\nprofile = \"fast-wire\"\n",
            "correction = 0.12\n[program]\nprofile = \"fast-wire\"\n",
        ),
        (
            Format::Iso,
            "correction = 0.12\n[program]\nprofile = \"robofil\"\n",
            "correction = 0.12\n[program]\nprofile = \"robofil\"\n",
        ),
        (
            Format::Iso,
            "correction = 0.12\n[program]\ntab = 2.0\n",
            "correction = 0.12\n[program]\ntab = 2.0\n",
        ),
        (
            Format::ThreeB,
            "correction = 0.12\n[program]\ntab = 1.79\nclosing-overlap = 0.4\n",
            "correction = 0.12\n[program]\ntab = 1.79\nclosing-overlap = 0.4\n",
        ),
        (
            Format::ThreeB,
            "correction = 0.12\n[program]\nlead = \"arc\"\n",
            "correction = 0.12\n[program]\nlead = \"arc\"\n",
        ),
        (
            Format::Iso,
            "correction = 0.12\n[program]\nlead = \"arc\"\n",
            "correction = 0.12\n[program]\nlead = \"arc\"\n",
        ),
        (
            Format::Iso,
            "correction = 0.12\n[program]\nlead = \"arc\"\nprofile = \"fast-wire\"\n",
            "correction = 0.12\n[program]\nlead = \"arc\"\nprofile = \"fast-wire\"\n",
        ),
        (
            Format::Iso,
            "correction = 0.12\n[program]\nlead = \"arc\"\ncompensation = \"controller\"\n",
            "correction = 0.12\n[program]\nlead = \"arc\"\ncompensation = \"controller\"\n",
        ),
        (
            Format::Iso,
            "correction = 0.12\n[program]\ncompensation = \"controller\"\n",
            own,
        ),
        (Format::ThreeB, "correction = 0.15\n", own),
        (
            Format::FourB,
            "correction = 0.15\n[program]\ndirection = \"cw\"\n",
            own,
        ),
        (
            Format::ThreeB,
            "correction = 0.137\n[program]\ncorner = \"intersection\"\n",
            own,
        ),
        (
            Format::Iso,
            "correction = 0.137\n[program]\ndirection = \"cw\"\nlead-in = 2\n",
            own,
        ),
    ];
    for (format, written, now) in rows {
        let is_own = written == now;
        let [written, now] = [written, now].map(settings_of);
        let text = program_of(&document(&shapes, &written), format).unwrap();
        let own = document(&shapes, &now);
        let snapshot = own.snapshot().unwrap();
        let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
        let mut texts = vec![text.clone()];
        // Our own words of other controls count otherwise. In those, only who reads the program tells of a lead that is no arc any more.
        let has_arc_leads = now.lead == Lead::Arc;
        if format == Format::Iso && text.contains("G21") && !has_arc_leads {
            texts.extend(
                [(true, false), (false, true), (true, true)]
                    .into_iter()
                    // Radii that are rounded, counted from block to block, say too little of settings that are not known.
                    .filter(|both| is_own || *both != (true, true))
                    .map(|(counts, by_radius)| in_other_words(&text, counts, by_radius)),
            );
        }
        for (nth, text) in texts.iter().enumerate() {
            let told = |text: &str| -> Vec<usize> {
                let found = compare(&drawn, &traced(text, format, &now));
                found
                    .unwrap_or_else(|| panic!("nothing is alike\n{text}"))
                    .differences
                    .iter()
                    .map(|found| found.line)
                    .collect()
            };
            assert_eq!(told(text), [0; 0], "{text}");
            let (mut at, mut count) = (0, 0);
            // Other settings are found out by trying, which takes its time.
            let step = if is_own && nth == 0 {
                by_day(16, 1)
            } else {
                by_day(90, 9)
            };
            for (line, own) in text.split_inclusive('\n').enumerate() {
                let range = at..at + own.trim_end().len();
                at += own.len();
                let is_block = own.contains('B') || own.contains("X");
                // A program that lies elsewhere says so where it begins.
                if !is_block || own.starts_with(';') || nth > 0 && own.starts_with("G92") {
                    continue;
                }
                for number in lengths(
                    text,
                    &(range.start
                        ..range
                            .end
                            .min(range.start + own.find(';').unwrap_or(own.len()))),
                ) {
                    for by in [3, -3] {
                        let Some(wrong) = with_number(text, &number, by) else {
                            continue;
                        };
                        count += 1;
                        if count % step != 0 {
                            continue;
                        }
                        assert_eq!(told(&wrong), [line], "line {} of\n{wrong}", line + 1);
                    }
                }
            }
            assert!(count > 50);
        }
    }
}
