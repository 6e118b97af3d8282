//! Corners rounded by just the correction, but for rounding.

use super::{C, unled, wrong_by};
use crate::drawing::Role;
use crate::geometry::{Point, direction};
use crate::settings::Direction;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

/// A path that is 20 nm farther away turns in a pointed corner up to five times as much earlier, mm.
const SLACK: f64 = 1e-4;

/// A polygon whose corners are rounded, with `[x, y, bulge]` of its vertices; `None` where there is no room for that.
fn rounded(corners: &[Point], radii: &[f64]) -> Option<Vec<[f64; 3]>> {
    let count = corners.len();
    let mut vertices = Vec::new();
    for index in 0..count {
        let corner = corners[index];
        let [before, behind] = [
            corners[(index + count - 1) % count],
            corners[(index + 1) % count],
        ];
        let (come, go) = ((corner - before).normalize(), (behind - corner).normalize());
        let turned = crate::geometry::turn(come, go);
        let radius = radii[index];
        if radius == 0.0 {
            vertices.push([corner.x, corner.y, 0.0]);
            continue;
        }
        let from = radius * (turned.abs() / 2.0).tan();
        let room = (corner - before).norm().min((corner - behind).norm()) / 2.0;
        if !(0.1..PI - 0.4).contains(&turned.abs()) || from >= room {
            return None;
        }
        let [start, end] = [corner - come * from, corner + go * from];
        vertices.extend([
            [start.x, start.y, (turned / 4.0).tan()],
            [end.x, end.y, 0.0],
        ]);
    }
    Some(vertices)
}

/// What a radius is beside the correction: nothing at all, the most that counts as nothing, or of any order.
fn beside() -> impl Strategy<Value = f64> {
    prop_oneof![
        2 => Just(0.0),
        2 => Just(1e-6),
        2 => Just(-1e-6),
        3 => (-9.0..-4.0).prop_map(|order: f64| 10_f64.powf(order)),
        2 => (-9.0..-6.0).prop_map(|order: f64| -(10_f64.powf(order))),
    ]
}

fn radius() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => beside().prop_map(|more| C + more),
        1 => Just(0.0),
        1 => Just(0.5),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { max_global_rejects: 100_000, ..ProptestConfig::with_cases(64) })]

    /// There is a path, wherever the contour begins and whatever rounding leaves of its arcs.
    #[test]
    fn a_path_turns_in_corners_of_just_the_correction(
        away in prop::collection::vec((4.0..20.0, radius()), 3..8),
        at in prop_oneof![Just([0.0, 0.0]), Just([100.0, 50.0]), [-200.0..200.0, -200.0..200.0]],
        first in 0_usize..16,
        is_opening: bool,
    ) {
        let count = away.len();
        let corner = |index: usize| {
            let angle = TAU * index as f64 / count as f64;
            Point::from(at) + direction(angle) * away[index].0
        };
        let corners: Vec<Point> = (0..count).map(corner).collect();
        let radii: Vec<f64> = away.iter().map(|(_, radius)| *radius).collect();
        let outline = rounded(&corners, &radii);
        prop_assume!(outline.is_some());
        let mut outline = outline.unwrap_or_default();
        let from = first % outline.len();
        outline.rotate_left(from);
        let role = if is_opening { Role::Opening } else { Role::Punch };
        let settings = unled(&outline, Direction::Ccw);
        prop_assert_eq!(wrong_by(SLACK, &outline, role, &settings), None);
    }

    /// The same of rectangles, whose tangents are exact.
    #[test]
    fn a_path_turns_in_right_corners_of_just_the_correction(
        radii in prop::collection::vec(radius(), 4),
        at in prop_oneof![Just([0.0, 0.0]), Just([100.0, 50.0])],
        first in 0_usize..16,
    ) {
        let [x, y] = at;
        let corners = [[x, y], [x + 10.0, y], [x + 10.0, y + 6.0], [x, y + 6.0]].map(Point::from);
        let outline = rounded(&corners, &radii);
        prop_assume!(outline.is_some());
        let mut outline = outline.unwrap_or_default();
        let from = first % outline.len();
        outline.rotate_left(from);
        let settings = unled(&outline, Direction::Ccw);
        prop_assert_eq!(wrong_by(SLACK, &outline, Role::Opening, &settings), None);
    }
}
