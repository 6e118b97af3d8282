//! The sizes and corrections of punch, plate and what stands beside them.

use super::{circle, fit_of, pair, snapshot};
use wedm::job::{self, Wanted};
use wedm::program::Format;

/// A washer Ø53 / Ø34, 2.5 thick: published sizes of punch and plate, and a stripper and a holder beside them.
#[test]
fn a_published_pair_comes_out_with_its_sizes() {
    for (drawn_as, drawn, punch, plate) in [
        ("plate", 52.63, 52.45, 52.63),
        ("punch", 34.31, 34.31, 34.49),
        ("plate", 34.49, 34.31, 34.49),
        ("punch", 52.45, 52.45, 52.63),
    ] {
        let mut own = pair(drawn_as, 0.10, 0.09);
        own.pair.stripper = Some(0.05);
        own.pair.holder = Some(0.005);
        let drawing = circle(drawn / 2.0);
        let found = fit_of(&drawing, &own);
        assert!(found.fits() && found.spots().count() == 0, "{found:?}");
        let diameter =
            |outline: &[wedm::geometry::Segment]| 2.0 * outline[0].as_arc().unwrap().radius;
        assert!(
            (diameter(&found.pairs[0].punch) - punch).abs() < 1e-9,
            "{found:?}"
        );
        assert!(
            (diameter(&found.pairs[0].plate) - plate).abs() < 1e-9,
            "{found:?}"
        );
        let snapshot = snapshot(&drawing, &own);
        let wanted = Wanted {
            format: Format::Iso,
            handles: None,
            layers: None,
            force: false,
        };
        let made = match job::pair(&snapshot, &[], &wanted, &()) {
            Ok(made) => made,
            Err(refusal) => panic!("{refusal:?}"),
        };
        let corrections: Vec<(&str, f64)> = made
            .iter()
            .map(|part| (part.part.as_str(), part.corrections[0]))
            .collect();
        let within = if drawn_as == "plate" { 0.09 } else { 0.0 };
        let expected = [
            ("punch", 0.10 - within),
            ("plate", 0.01 + within),
            ("stripper", 0.10 + within - 0.05),
            ("holder", 0.10 + within + 0.005),
        ];
        for ((part, correction), (name, wanted)) in corrections.iter().zip(expected) {
            assert_eq!(*part, name);
            assert!(
                (correction - wanted).abs() < 1e-12,
                "{drawn_as} {part} {correction} {wanted}"
            );
        }
    }
}

#[test]
fn a_clearance_above_the_correction_turns_the_wire_to_the_other_side() {
    let drawing = circle(10.0);
    let own = pair("punch", 0.10, 0.15);
    let found = fit_of(&drawing, &own);
    let radius = found.pairs[0].plate[0].as_arc().unwrap().radius;
    assert!((radius - 10.15).abs() < 1e-9 && found.fits(), "{found:?}");
    let wanted = Wanted {
        format: Format::ThreeB,
        handles: None,
        layers: None,
        force: false,
    };
    let made = job::pair(&snapshot(&drawing, &own), &[], &wanted, &())
        .ok()
        .unwrap();
    let flags: Vec<bool> = made.iter().map(|part| part.is_other_side).collect();
    assert_eq!(flags, [false, true]);
    assert!((made[1].corrections[0] - 0.05).abs() < 1e-12);
}
