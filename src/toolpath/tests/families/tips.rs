//! Paths with tips: near-full arcs that end in two convex corners, and corners that point at another part.

use super::{C, distance, unled, walls_of, without_leads, wrong};
use crate::drawing::Role;
use crate::geometry::Segment;
use crate::settings::{Corner, Direction, Effective};
use crate::toolpath::plan;
use crate::toolpath::tests::{defaults, drawing, samples};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// The bulge of a circle of a radius that a gap leaves open.
fn rest_of_circle(radius: f64, gap: f64) -> f64 {
    ((TAU - 2.0 * (gap / 2.0 / radius).asin()) / 4.0).tan()
}

fn turned(outline: &[[f64; 3]], by: f64) -> Vec<[f64; 3]> {
    let (sin, cos) = by.sin_cos();
    let turn = |&[x, y, bulge]: &[f64; 3]| [x * cos - y * sin, x * sin + y * cos, bulge];
    outline.iter().map(turn).collect()
}

fn check(outline: &[[f64; 3]], by: f64, role: Role) -> Result<(), TestCaseError> {
    let outline = turned(outline, by);
    for corner in [Corner::Arc, Corner::Intersection] {
        let settings = Effective {
            corner,
            ..unled(&outline, Direction::AsDrawn)
        };
        prop_assert_eq!(wrong(&outline, role, &settings), None, "{:?}", corner);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(24) })]

    /// A disc with a slit that the wire just enters: its arc goes nearly round, and both of its ends are convex corners.
    #[test]
    fn a_disc_with_a_slit_is_cut_all_round(radius in 2.0_f64..14.0, gap in 0.203_f64..0.6, depth in 0.3_f64..1.2, by in 0.0..TAU) {
        let (half, depth) = (gap / 2.0, depth * radius);
        let x = (radius * radius - half * half).sqrt();
        let outline = [
            [x, half, rest_of_circle(radius, gap)],
            [x, -half, 0.0],
            [x - depth, -half, 0.0],
            [x - depth, half, 0.0],
        ];
        check(&outline, by, Role::Punch)?;
    }

    /// A bulb behind a neck that the wire just passes, and a bulb of the part on a neck.
    #[test]
    fn a_bulb_behind_a_neck_is_cut_all_round(radius in 0.4_f64..3.0, gap in 0.203_f64..0.7, neck in 0.3_f64..2.0, by in 0.0..TAU, of_part: bool) {
        let (half, bulge) = (gap / 2.0, rest_of_circle(radius, gap));
        let (neck, bulge) = if of_part { (neck, -bulge) } else { (-neck, bulge) };
        let outline = [
            [0.0, 0.0, 0.0],
            [5.0 - half, 0.0, 0.0],
            [5.0 - half, neck, bulge],
            [5.0 + half, neck, 0.0],
            [5.0 + half, 0.0, 0.0],
            [10.0, 0.0, 0.0],
            [10.0, 10.0, 0.0],
            [0.0, 10.0, 0.0],
        ];
        check(&outline, by, Role::Opening)?;
    }

    /// The point of a part beside another one: no pass comes nearer to either than its correction.
    #[test]
    fn a_tip_keeps_off_the_next_part(point in 0.1_f64..1.0, gap in 0.205_f64..0.7, aside in -0.6_f64..0.6, by in 0.0..TAU, opening: bool) {
        let rise = 6.0 * (point / 2.0).tan();
        let corner = [[-6.0, -rise, 0.0], [0.0, 0.0, 0.0], [-6.0, rise, 0.0]];
        let outline = match opening {
            false => corner.to_vec(),
            // The point stands into an opening.
            true => [&[[-6.0, -8.0, 0.0], [8.0, -8.0, 0.0], [8.0, 8.0, 0.0], [-6.0, 8.0, 0.0]][..], &[corner[2], corner[1], corner[0]]].concat(),
        };
        let next = [[gap, aside - 1.5, 0.0], [gap + 2.0, aside - 1.5, 0.0], [gap + 2.0, aside + 1.5, 0.0], [gap, aside + 1.5, 0.0]];
        let own = if opening { Role::Opening } else { Role::Punch };
        let (outline, next) = (turned(&outline, by), turned(&next, by));
        let (drawing, outlines) = drawing(&[(&outline, Some(own)), (&next, Some(Role::Punch))]);
        let walls: Vec<Segment> = outlines.iter().flat_map(|outline| walls_of(&drawing, outline)).collect();
        let settings = Effective {
            corner: Corner::Intersection,
            corrections: vec![C, 0.8 * C],
            ..defaults()
        };
        let paths = plan(&drawing, &outlines, &settings, None).expect("paths");
        for path in paths {
            let least = path.correction - 3e-6;
            for place in samples(&without_leads(&path), 0.01) {
                prop_assert!(distance(&walls, place) >= least, "{place:?}");
            }
        }
    }
}

/// Two parts with less than two corrections between them: the path along one would cut into the other.
#[test]
fn a_path_that_would_cut_into_another_part_is_refused() {
    let square = |x: f64| {
        [
            [x, 0.0, 0.0],
            [x + 5.0, 0.0, 0.0],
            [x + 5.0, 5.0, 0.0],
            [x, 5.0, 0.0],
        ]
    };
    for (gap, fits) in [(0.19, false), (0.2, true), (0.3, true)] {
        let [one, other] = [square(0.0), square(5.0 + gap)];
        let (drawing, outlines) =
            drawing(&[(&one, Some(Role::Punch)), (&other, Some(Role::Punch))]);
        let planned = plan(&drawing, &outlines, &defaults(), None);
        assert_eq!(planned.is_ok(), fits, "{gap}: {planned:?}");
    }
}
