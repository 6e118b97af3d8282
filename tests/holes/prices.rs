//! What small radii cost by the wires of the shop's table.

use super::*;
use wedm::analysis::{RadiusPrices, price_of_segment, radius_prices};

const SHOP: &str = "[job]\nthickness = 40\nwires = [0.1, 0.25, 0.2]\nwire-gaps = [0.01, 0.03, 0.02]\nwire-rates = [10, 100, 50]\n";

/// A square of 10 mm with its four corners rounded; 0 is a sharp one.
fn square(role: Role, radii: [f64; 4]) -> Drawing {
    let bulge = (std::f64::consts::PI / 8.0).tan();
    let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
    let ways = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];
    let mut vertices = Vec::new();
    for (index, ([x, y], r)) in corners.into_iter().zip(radii).enumerate() {
        let (before, behind) = (ways[index], ways[(index + 1) % 4]);
        if r == 0.0 {
            vertices.push([x, y, 0.0]);
            continue;
        }
        vertices.push([x - before[0] * r, y - before[1] * r, bulge]);
        vertices.push([x + behind[0] * r, y + behind[1] * r, 0.0]);
    }
    drawing(vec![polygon("2A", role, &vertices)])
}

fn outlines(drawing: &Drawing, settings: &Effective) -> Vec<Outline> {
    let analysis = Analysis::new(drawing, Arc::new(settings.clone()));
    analysis.outlines(drawing).to_vec()
}

fn prices(drawing: &Drawing, settings: &Effective) -> Option<RadiusPrices> {
    radius_prices(drawing, &outlines(drawing, settings), settings)
}

/// Side, radii of the corners, settings, a segment, and what is said of it.
type Priced<'a> = (Role, [f64; 4], &'a str, usize, Option<&'a str>);

#[test]
fn a_radius_says_what_it_costs() {
    let money = format!("{SHOP}machine-rate = 60\n");
    let rows: [Priced; 11] = [
        // 40 mm of contour less 2 R − R · π / 2, times 40 mm, by 50 and by 100 mm²/min.
        (
            Role::Opening,
            [0.12, 1.0, 1.0, 1.0],
            SHOP,
            0,
            Some(
                "R 0.120 mm needs the wire Ø 0.2 mm: +15.46 min against Ø 0.25 mm, from R 0.155 mm on",
            ),
        ),
        (
            Role::Opening,
            [0.12, 1.0, 1.0, 1.0],
            &money,
            0,
            Some(
                "R 0.120 mm needs the wire Ø 0.2 mm: +15.46 min (15.46) against Ø 0.25 mm, from R 0.155 mm on",
            ),
        ),
        // In the order in which they could be used.
        (
            Role::Opening,
            [0.06, 0.5, 0.5, 0.5],
            SHOP,
            0,
            Some(
                "R 0.060 mm needs the wire Ø 0.1 mm: +2 h 06 min against Ø 0.2 mm, from R 0.120 mm on, +2 h 22 min against Ø 0.25 mm, from R 0.155 mm on",
            ),
        ),
        // The radius alone gains nothing where others are as small.
        (
            Role::Opening,
            [0.12, 0.13, 0.06, 1.0],
            SHOP,
            0,
            Some(
                "R 0.120 mm needs the wire Ø 0.2 mm: +15.78 min against Ø 0.25 mm, from R 0.155 mm on; 2 places beside it keep that wire out, too",
            ),
        ),
        (
            Role::Opening,
            [0.05, 1.0, 1.0, 1.0],
            SHOP,
            0,
            Some(
                "R 0.050 mm is cut by no wire of job.wires: the thinnest, Ø 0.1 mm, leaves R 0.060 mm",
            ),
        ),
        (Role::Opening, [0.155, 1.0, 1.0, 1.0], SHOP, 0, None),
        // The wire runs outside of it.
        (Role::Punch, [0.05, 1.0, 1.0, 1.0], SHOP, 0, None),
        // A sharp corner keeps no wire out, and is sharper by a thinner one.
        (
            Role::Opening,
            [0.0, 1.0, 1.0, 1.0],
            SHOP,
            0,
            Some(
                "sharp corner: R 0.155 mm is left by the wire Ø 0.25 mm, R 0.120 mm for +15.48 min by Ø 0.2 mm, R 0.060 mm for +2 h 19 min by Ø 0.1 mm",
            ),
        ),
        (Role::Opening, [0.0, 1.0, 1.0, 1.0], SHOP, 2, None),
        (Role::Punch, [0.0, 1.0, 1.0, 1.0], SHOP, 0, None),
        (
            Role::Opening,
            [0.12, 1.0, 1.0, 1.0],
            "job.thickness = 40\n",
            0,
            None,
        ),
    ];
    for (role, radii, text, segment, expected) in rows {
        let (drawing, settings) = (square(role, radii), settings(text));
        let outlines = outlines(&drawing, &settings);
        let at = (outlines[0].contour.pieces[0].entity, segment);
        let said = price_of_segment(&drawing, &outlines, &settings, at);
        assert_eq!(said.as_deref(), expected, "{radii:?}");
    }
}

/// A slot keeps a wire out as a radius does, and without the height or a list nothing has a price.
#[test]
fn a_slot_counts_and_nothing_is_guessed() {
    let slot = drawing(vec![rectangle(
        "2A",
        Role::Opening,
        [0.0, 0.0],
        [20.0, 0.28],
    )]);
    for gap in ["", "gap = 0.02\n"] {
        let found = prices(&slot, &settings(&format!("{gap}{SHOP}"))).unwrap();
        let widths: Vec<f64> = found.places.iter().map(|place| place.radius).collect();
        assert!(
            matches!(widths[..], [half] if (half - 0.14).abs() < 1e-9),
            "{widths:?}"
        );
        assert_eq!(found.chosen().map(|wire| wire.diameter), Some(0.2));
    }
    let rounded = square(Role::Opening, [0.12; 4]);
    for missing in ["thickness", "wires", "wire-gaps", "wire-rates"] {
        let lines = SHOP
            .lines()
            .filter(|line| !line.starts_with(&format!("{missing} ")));
        let text: String = lines.map(|line| format!("{line}\n")).collect();
        let (stated, _) = from_toml(&text);
        assert_eq!(prices(&rounded, &Effective::of(&stated)), None, "{missing}");
    }
}

proptest! {
    /// Against the plain meaning: of the wires that cut every radius the quickest, and for each wire the radii below half
    /// of its kerf.
    #[test]
    fn the_wire_is_the_quickest_that_cuts_every_radius(
        radii in prop::array::uniform4(0.03..1.0_f64),
        shop in prop::collection::vec((0.03..0.3_f64, 0.005..0.05_f64, 5.0..200.0_f64), 1..6),
        height in 5.0..100.0_f64,
    ) {
        let list = |which: fn(&(f64, f64, f64)) -> f64| {
            let all: Vec<String> = shop.iter().map(|wire| which(wire).to_string()).collect();
            all.join(", ")
        };
        let text = format!(
            "[job]\nthickness = {height}\nwires = [{}]\nwire-gaps = [{}]\nwire-rates = [{}]\n",
            list(|wire| wire.0), list(|wire| wire.1), list(|wire| wire.2)
        );
        let found = prices(&square(Role::Opening, radii), &settings(&text)).unwrap();
        let smallest = radii.into_iter().fold(f64::INFINITY, f64::min);
        let round = 40.0 - radii.iter().map(|r| r * (2.0 - std::f64::consts::FRAC_PI_2)).sum::<f64>();
        let cutting = shop.iter().filter(|(diameter, gap, _)| diameter / 2.0 + gap <= smallest);
        let least = cutting.map(|(.., rate)| round * height / rate).min_by(f64::total_cmp);
        let chosen = found.chosen().map(|wire| wire.minutes);
        prop_assert_eq!(chosen.is_some(), least.is_some());
        let (chosen, least) = (chosen.unwrap_or(0.0), least.unwrap_or(0.0));
        prop_assert!((chosen - least).abs() < 1e-6 * (1.0 + least), "{} {}", chosen, least);
        for wire in &found.wires {
            let barring = radii.iter().filter(|radius| **radius < wire.least).count();
            prop_assert_eq!(found.barring(wire).len(), barring);
        }
    }
}
