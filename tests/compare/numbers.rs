//! Every number of a program of ours, changed alone.

use super::changes::{lengths, with_number};
use super::{Shape, document, plate, program_of, settings_of, traced};
use wedm::compare::compare;
use wedm::drawing::Role;
use wedm::program::Format;

/// Each number of each line of programs in every dialect, changed by 3 µm alone: named at that line and nowhere else.
/// By day every seventh; all with `WEDM_CASES`.
#[test]
fn every_number_is_compared_with_the_drawing() {
    let shapes = [
        plate(0.0)[0].clone(),
        (Shape::Circle([8.0, 8.0], 2.7), Role::Opening),
    ];
    let step = if std::env::var("WEDM_CASES").is_ok() {
        1
    } else {
        7
    };
    let mut wrong = Vec::new();
    let mut count = 0;
    for (format, keys) in [
        (Format::ThreeB, ""),
        (Format::ThreeB, "layout = \"checking\""),
        (Format::ThreeB, "tab = 1.79\nclosing-overlap = 0.4"),
        (Format::ThreeB, "lead = \"arc\""),
        (Format::FourB, ""),
        (Format::Iso, ""),
        (Format::Iso, "profile = \"fast-wire\""),
        (Format::Iso, "profile = \"robofil\""),
        (Format::Iso, "tab = 2.0"),
        (Format::Iso, "lead = \"arc\""),
        (Format::Iso, "lead = \"arc\"\nprofile = \"fast-wire\""),
        (Format::Iso, "lead = \"arc\"\ncompensation = \"controller\""),
    ] {
        let settings = settings_of(&format!("correction = 0.12\n[program]\n{keys}\n"));
        let own = document(&shapes, &settings);
        let text = program_of(&own, format).unwrap();
        let drawn = own.drawn().unwrap();
        let named = |text: &str| -> Option<Vec<usize>> {
            let found = compare(&drawn, &traced(text, format, &settings))?;
            Some(found.differences.iter().map(|found| found.line).collect())
        };
        assert_eq!(named(&text), Some(Vec::new()), "{text}");
        let mut at = 0;
        for (line, own) in text.split_inclusive('\n').enumerate() {
            let start = at;
            at += own.len();
            if !own.contains(['B', 'X']) || own.starts_with(';') {
                continue;
            }
            let end = own.find(';').unwrap_or(own.trim_end().len());
            for number in lengths(&text, &(start..start + end)) {
                for by in [3, -3] {
                    count += 1;
                    let changed = with_number(&text, &number, by).filter(|_| count % step == 0);
                    let Some(changed) = changed else { continue };
                    let found = named(&changed);
                    if found != Some(vec![line]) {
                        wrong.push(format!(
                            "{format:?} {keys}, line {line}: {found:?}\n{changed}"
                        ));
                    }
                }
            }
        }
    }
    assert!(count > 500);
    assert!(
        wrong.is_empty(),
        "{} of {}\n{}",
        wrong.len(),
        count / step,
        wrong.join("\n")
    );
}
