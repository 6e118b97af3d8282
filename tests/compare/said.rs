//! Words that carry no coordinate: the side of the correction and where it is taken from, stops, D and DD.

use super::{Shape, document, program_of, settings_of, traced};
use wedm::compare::{DifferenceKind, Drawn, compare};
use wedm::document::Document;
use wedm::drawing::Role;
use wedm::program::Format;

/// Two openings, or two punches: a plate with a round corner, and a rectangle beside it.
fn shapes(role: Role) -> Vec<(Shape, Role)> {
    let plate = vec![
        [0.0, 0.0, 0.0],
        [20.0, 0.0, 0.0],
        [20.0, 10.0, 0.414_213_562_373_095],
        [18.0, 12.0, 0.0],
        [0.0, 12.0, 0.0],
    ];
    let beside = vec![
        [30.0, 0.0, 0.0],
        [39.0, 0.0, 0.0],
        [39.0, 7.0, 0.0],
        [30.0, 7.0, 0.0],
    ];
    [plate, beside]
        .map(|vertices| (Shape::Polyline(vertices), role))
        .into()
}

/// The lines that are told of a text, from 0.
fn told(of: &Document, text: &str, format: Format) -> Vec<(usize, DifferenceKind)> {
    let snapshot = of.snapshot().unwrap();
    let drawn = Drawn::of(&snapshot.drawing, &snapshot.outlines, &snapshot.settings);
    let found = compare(&drawn, &traced(text, format, &snapshot.settings));
    let found = found.unwrap_or_else(|| panic!("nothing is alike\n{text}"));
    let all = found.differences.into_iter();
    all.map(|one| (one.line, one.kind)).collect()
}

fn with_line(text: &str, number: usize, by: Option<&str>) -> String {
    let lines = text.lines().enumerate();
    let lines = lines.filter_map(|(at, line)| match at == number {
        true => by.map(str::to_owned),
        false => Some(line.to_owned()),
    });
    lines.collect::<Vec<_>>().join("\n") + "\n"
}

#[test]
fn each_word_of_the_correction_is_compared() {
    let mut count = 0;
    for role in [Role::Opening, Role::Punch] {
        for passes in ["correction = 0.1", "[passes]\ncorrections = [0.2, 0.13]"] {
            for keys in [
                "",
                "closing-overlap = 0.3",
                "lead = \"arc\"",
                "direction = \"cw\"",
                "profile = \"robofil\"",
                "profile = \"fast-wire\"",
            ] {
                let keys = format!("{passes}\n[program]\ncompensation = \"controller\"\n{keys}\n");
                let own = document(&shapes(role), &settings_of(&keys));
                let Some(text) = program_of(&own, Format::Iso) else {
                    continue;
                };
                assert_eq!(told(&own, &text, Format::Iso), [], "{keys}\n{text}");
                for (number, line) in text.lines().enumerate() {
                    let flipped = match line {
                        _ if line.contains("G41") => line.replace("G41", "G42"),
                        _ if line.contains("G42") => line.replace("G42", "G41"),
                        _ => continue,
                    };
                    let lost = told(&own, &with_line(&text, number, None), Format::Iso);
                    assert!(
                        matches!(lost[..], [(at, DifferenceKind::Side { stated: None, .. })] if at.abs_diff(number) <= 2),
                        "{keys} {line}: {lost:?}\n{text}"
                    );
                    let other = told(&own, &with_line(&text, number, Some(&flipped)), Format::Iso);
                    assert!(
                        matches!(other[..], [(at, DifferenceKind::Side { .. })] if at == number),
                        "{keys} {line}: {other:?}\n{text}"
                    );
                    let other = match line.contains("D1") {
                        true => line.replace("D1", "D2"),
                        false => line.replace("D0", "D1").replace("D2", "D1"),
                    };
                    let wrong = told(&own, &with_line(&text, number, Some(&other)), Format::Iso);
                    let is_told = wrong.iter().any(|(at, _)| *at == number);
                    assert!(
                        is_told || passes.starts_with('c'),
                        "{keys} {line}: {wrong:?}\n{text}"
                    );
                    count += 1;
                }
            }
        }
    }
    assert!(count > 50, "{count}");
}

#[test]
fn a_stop_that_is_lost_is_told_where_it_should_be() {
    let mut count = 0;
    for (format, passes, keys) in [
        (
            Format::Iso,
            "[passes]\ncorrections = [0.2, 0.13]",
            "compensation = \"controller\"",
        ),
        (Format::Iso, "[passes]\ncorrections = [0.2, 0.13]", ""),
        (Format::ThreeB, "[passes]\ncorrections = [0.2, 0.13]", ""),
        (Format::ThreeB, "correction = 0.1", "tab = 2.0"),
        (Format::ThreeB, "correction = 0.1", ""),
        (Format::Iso, "correction = 0.1", "tab = 2.0"),
    ] {
        let keys = format!("{passes}\n[program]\n{keys}\n");
        let own = document(&shapes(Role::Punch), &settings_of(&keys));
        let text = program_of(&own, format).unwrap();
        assert_eq!(told(&own, &text, format), [], "{keys}\n{text}");
        for (number, line) in text.lines().enumerate() {
            if !["M00", "D"].contains(&line.trim()) {
                continue;
            }
            let lost = told(&own, &with_line(&text, number, None), format);
            assert!(
                matches!(lost[..], [(at, DifferenceKind::Unstopped)] if (number..number + 2).contains(&at)),
                "{keys} {number}: {lost:?}
{text}"
            );
            count += 1;
        }
    }
    assert!(count > 12, "{count}");
    // The only one, before a tab.
    let own = document(
        &shapes(Role::Punch)[..1],
        &settings_of("correction = 0.1\n[program]\ntab = 2.0\n"),
    );
    for format in [Format::ThreeB, Format::Iso] {
        let text = program_of(&own, format).unwrap();
        let stop = text
            .lines()
            .position(|line| ["M00", "D"].contains(&line))
            .unwrap();
        let lost = told(&own, &with_line(&text, stop, None), format);
        assert_eq!(lost, [(stop, DifferenceKind::Unstopped)], "{text}");
    }
}

#[test]
fn an_arc_of_4b_with_the_wire_on_its_other_side_is_told() {
    let mut count = 0;
    for role in [Role::Punch, Role::Opening] {
        let settings = settings_of("correction = 0.1\n");
        let own = document(&shapes(role), &settings);
        let Some(text) = program_of(&own, Format::FourB) else {
            continue;
        };
        assert_eq!(told(&own, &text, Format::FourB), [], "{text}");
        for (number, line) in text.lines().enumerate() {
            let Some((words, rest)) = line.split_once('G') else {
                continue;
            };
            let other = match rest.matches('D').count() {
                0 => continue,
                1 => rest.replace('D', "DD"),
                _ => rest.replace("DD", "D"),
            };
            let wrong = with_line(&text, number, Some(&format!("{words}G{other}")));
            let found = told(&own, &wrong, Format::FourB);
            assert!(
                matches!(found[..], [(at, DifferenceKind::Turned { .. })] if at == number),
                "{line}: {found:?}\n{text}"
            );
            count += 1;
        }
    }
    assert!(count > 5, "{count}");
}

/// A program of another writer, from the middle of a side, whose blocks are none of ours.
#[test]
fn a_contour_without_its_correction_is_told_whoever_wrote_it() {
    const LINES: [&str; 27] = [
        "G21",
        "G90",
        "G92 X7.000 Y3.000",
        "G41 D1",
        "G01 X5.500 Y0.000",
        "G01 X20.000 Y0.000",
        "G01 X20.000 Y5.000",
        "G01 X20.000 Y10.000",
        "G03 X18.000 Y12.000 I-2.000 J0.000",
        "G01 X9.000 Y12.000",
        "G01 X0.000 Y12.000",
        "G01 X0.000 Y0.000",
        "G01 X5.500 Y0.000",
        "G40",
        "G01 X7.000 Y3.000",
        "M00",
        "G00 X33.000 Y3.000",
        "M00",
        "G41 D1",
        "G01 X34.500 Y0.000",
        "G01 X39.000 Y0.000",
        "G01 X39.000 Y7.000",
        "G01 X30.000 Y7.000",
        "G01 X30.000 Y0.000",
        "G01 X34.500 Y0.000",
        "G40",
        "G01 X33.000 Y3.000",
    ];
    for keys in [
        "correction = 0.1\n",
        "correction = 0.1\n[program]\ncompensation = \"controller\"\n",
    ] {
        let own = document(&shapes(Role::Opening), &settings_of(keys));
        let text = LINES.join("\n") + "\nM02\n";
        assert_eq!(told(&own, &text, Format::Iso), [], "{keys}");
        for number in [3, 18] {
            let lost = told(&own, &with_line(&text, number, None), Format::Iso);
            assert!(
                matches!(lost[..], [(at, DifferenceKind::Side { stated: None, .. })] if at.abs_diff(number) <= 2),
                "{lost:?}"
            );
            let flipped = told(&own, &with_line(&text, number, Some("G42 D1")), Format::Iso);
            assert!(
                matches!(flipped[..], [(at, DifferenceKind::Side { stated: Some(_), .. })] if at == number),
                "{flipped:?}"
            );
        }
    }
}
