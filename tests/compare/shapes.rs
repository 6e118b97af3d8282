//! Random contours.

use super::Shape;
use proptest::prelude::*;
use std::f64::consts::TAU;
use wedm::drawing::Role;

pub(super) fn shape() -> impl Strategy<Value = Vec<(Shape, Role)>> {
    let outer = (
        4usize..12,
        prop::collection::vec(
            (15.0..30.0f64, -0.35..0.35f64, 0.0..0.8f64, prop::bool::ANY),
            12,
        ),
    )
        .prop_map(|(count, values)| {
            let vertex = |index: usize| {
                let (radius, bulge, aside, is_arc) = values[index];
                let angle = (index as f64 + aside) / count as f64 * TAU;
                // Drawn on no grid.
                [
                    angle.cos() * radius,
                    angle.sin() * radius,
                    if is_arc { bulge } else { 0.0 },
                ]
            };
            Shape::Polyline((0..count).map(vertex).collect())
        });
    let circle =
        (2.0..4.0f64, -3.0..3.0f64).prop_map(|(radius, x)| Shape::Circle([x, 4.0], radius));
    let slot = (3.0..8.0f64, 1.0..2.0f64, -3.0..3.0f64).prop_map(|(length, radius, x)| {
        Shape::Polyline(vec![
            [x - length / 2.0, -6.0 - radius, 0.0],
            [x + length / 2.0, -6.0 - radius, 1.0],
            [x + length / 2.0, -6.0 + radius, 0.0],
            [x - length / 2.0, -6.0 + radius, 1.0],
        ])
    });
    (outer, prop::option::of(circle), prop::option::of(slot)).prop_map(|(outer, circle, slot)| {
        let mut shapes = vec![(outer, Role::Punch)];
        shapes.extend(circle.map(|shape| (shape, Role::Opening)));
        shapes.extend(slot.map(|shape| (shape, Role::Opening)));
        shapes
    })
}
