//! Pockets in which the legs of the way overlap: as deep as they are asked for, in a grid of places that knows nothing of feeds.

use super::programs::run;
use super::*;
use crate::size::by_day;

/// Side of a place, mm.
const PLACE: f64 = 0.05;

/// The mean depth of all places that the electrode of [`ELECTRODE`] comes to, where the moves of a program lead it.
fn eroded(text: &str, wear: f64) -> f64 {
    let (half, section) = (0.55, std::f64::consts::PI / 4.0);
    let (columns, rows) = (480, 160);
    let mut depths = vec![0.0_f64; columns * rows];
    let mut worn = 0.0;
    let mut comes = |[x, y]: [f64; 2], fed: f64, depths: &mut Vec<f64>| {
        let around = |at: f64| {
            let place = |at: f64| ((at + 1.0) / PLACE) as usize;
            place(at - half)..=place(at + half)
        };
        for row in around(y) {
            for column in around(x) {
                let middle = |index: usize| (index as f64 + 0.5) * PLACE - 1.0;
                let away = (middle(column) - x).hypot(middle(row) - y);
                let depth = &mut depths[row * columns + column];
                let left = fed - worn - *depth;
                if away <= half && left > 0.0 {
                    *depth += left;
                    worn += wear * PLACE * PLACE * left / section;
                }
            }
        }
    };
    for step in run(text, 1.0).iter().filter(|step| step.is_level()) {
        let fed = -step.to[2];
        assert!(step.center.is_none(), "a pocket of lines");
        let count = (step.length() / PLACE).ceil().max(1.0);
        for nth in 0..=count as usize {
            let share = nth as f64 / count;
            let at = [0, 1].map(|axis| step.from[axis] + (step.to[axis] - step.from[axis]) * share);
            comes(at, fed, &mut depths);
        }
    }
    let reached: Vec<f64> = depths.into_iter().filter(|depth| *depth > 0.0).collect();
    reached.iter().sum::<f64>() / reached.len() as f64
}

#[test]
fn a_narrow_pocket_is_as_deep_as_it_is_asked_for() {
    for width in [1.2, 1.6, 2.0, 4.0].into_iter().step_by(by_day(3, 1)) {
        let pocket = [
            [0.0, 0.0, 0.0],
            [20.0, 0.0, 0.0],
            [20.0, width, 0.0],
            [0.0, width, 0.0],
        ];
        for compensation in [
            "wear-compensation = \"uniform\"\n",
            "wear-compensation = \"linear\"\nstep = 0.5\n",
        ] {
            let text = format!(
                "{}{compensation}",
                ELECTRODE.replace("wear = 0.02", "wear = 0.01")
            );
            let made = milled(&drawing(&[(true, &pocket)]), &text);
            let mean = eroded(&made.program.text, 0.01);
            assert!(
                (mean - 0.2).abs() < 0.004,
                "{width} {compensation}: {mean}, {:?}",
                made.program.milled
            );
            // The simulation beside the program says the same.
            let said = made.program.milled.as_ref().expect("milled").contours[0].floor[0];
            assert!((said - mean).abs() < 0.004, "{width}: {said}, {mean}");
        }
    }
}
