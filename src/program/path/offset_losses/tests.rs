use super::*;
use crate::program::path::Writing;
use proptest::prelude::*;

/// A closed way through some points, mm.
fn way(points: &[[f64; 2]]) -> Way {
    let at = |[x, y]: [f64; 2]| Point::new(x * UM_IN_MM, y * UM_IN_MM);
    let mut way = Way::from(Node::at(at(points[0])), Writing::default());
    let ends = points.iter().skip(1).chain([&points[0]]);
    for (from, to) in points.iter().zip(ends) {
        way.push(Segment::line(at(*from), at(*to)), false, Node::at(at(*to)));
    }
    way
}

fn found(points: &[[f64; 2]], side: Side, correction: f64) -> Vec<(Rule, usize, Option<usize>)> {
    let offset = ControlOffset { side, correction };
    let way = way(points);
    let all = losses(&way, way.count(), offset).unwrap();
    let place = |loss: &Loss| (loss.rule, loss.block, loss.other);
    all.iter().map(place).collect()
}

#[test]
fn only_the_side_of_the_wire_has_narrow_places() {
    use Side::{Left, Right};
    // Counter-clockwise: inside is left. A slot of 0.15 mm from above, a wall of 0.15 mm beside it.
    let slot = [
        [0.0, 0.0],
        [10.0, 0.0],
        [10.0, 4.0],
        [9.85, 4.0],
        [9.85, 2.0],
        [9.7, 2.0],
        [9.7, 4.0],
        [0.0, 4.0],
    ];
    let square = [[0.0, 0.0], [10.0, 0.0], [10.0, 4.0], [0.0, 4.0]];
    let chamber = [
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 1.9],
        [6.0, 1.9],
        [6.0, 0.0],
        [10.0, 0.0],
        [10.0, 4.0],
        [6.0, 4.0],
        [6.0, 2.1],
        [4.0, 2.1],
        [4.0, 4.0],
        [0.0, 4.0],
    ];
    let narrow = |block, other| (Rule::NarrowSlot, block, Some(other));
    for (points, side, correction, expected) in [
        (&slot[..], Right, 70.0, vec![]),
        (&slot, Right, 76.0, vec![narrow(3, 5)]),
        (&slot, Left, 76.0, vec![narrow(1, 3)]),
        (&square, Left, 1_999.0, vec![]),
        (
            &square,
            Left,
            2_100.0,
            vec![(Rule::OffsetCollapse, 0, None), narrow(0, 2)],
        ),
        (&square, Right, 2_100.0, vec![]),
        (&chamber, Left, 90.0, vec![]),
        (
            &chamber,
            Left,
            110.0,
            vec![narrow(2, 8), (Rule::LostPocket, 6, None)],
        ),
    ] {
        let mut all = found(points, side, correction);
        all.sort_by_key(|one| (one.1, one.2));
        assert_eq!(all, expected, "{points:?} {side:?} {correction}");
    }
}

#[test]
fn a_micrometre_of_rounding_makes_no_slot_narrow() {
    let slot = |width: f64| {
        [
            [0.0, 0.0],
            [10.0, 0.0],
            [10.0, 4.0],
            [5.0 + width, 4.0],
            [5.0 + width, 2.0],
            [5.0, 2.0],
            [5.0, 4.0],
            [0.0, 4.0],
        ]
    };
    for (width, is_narrow) in [(0.2, false), (0.1995, false), (0.198, true)] {
        let all = found(&slot(width), Side::Right, 100.0);
        assert_eq!(!all.is_empty(), is_narrow, "{width}");
    }
}

#[test]
fn a_contour_of_too_many_blocks_is_not_looked_at() {
    let ring = |count: usize| -> Vec<[f64; 2]> {
        let angle = |nth: usize| nth as f64 / count as f64 * std::f64::consts::TAU;
        (0..count)
            .map(|nth| [100.0 * angle(nth).cos(), 100.0 * angle(nth).sin()])
            .collect()
    };
    let offset = ControlOffset {
        side: Side::Left,
        correction: 100.0,
    };
    assert_eq!(
        losses(&way(&ring(MOST_BLOCKS)), MOST_BLOCKS, offset),
        Some(Vec::new())
    );
    assert_eq!(
        losses(&way(&ring(MOST_BLOCKS + 1)), MOST_BLOCKS + 1, offset),
        None
    );
}

#[test]
fn what_touches_itself_has_no_sides() {
    let touching = [
        [1.0, 0.0],
        [0.6, 0.4],
        [1.0, 0.4],
        [1.0, 0.0],
        [1.4, -0.4],
        [1.0, -0.4],
    ];
    let back_along_itself = [
        [0.0, 0.0],
        [0.15, 0.0],
        [0.15, 0.15],
        [0.15, 1.0],
        [0.15, 0.1],
    ];
    for side in [Side::Left, Side::Right] {
        assert_eq!(found(&touching, side, 100.0), []);
        assert_eq!(found(&back_along_itself, side, 100.0), []);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// Contours that are passed over lose nothing: stars of a few points, with bent sides.
    #[test]
    fn what_is_passed_over_loses_nothing(
        radii in proptest::collection::vec((300.0..2_000.0, -0.6..0.6, any::<bool>()), 3..14),
        correction in 20.0..400.0,
        is_left in any::<bool>(),
    ) {
        let turn = std::f64::consts::TAU / radii.len() as f64;
        let at = |nth: usize| {
            let (radius, angle) = (radii[nth % radii.len()].0, nth as f64 * turn);
            Point::new(radius * angle.cos(), radius * angle.sin())
        };
        let piece = |nth: usize| match radii[nth] {
            (_, bulge, true) => Segment::from_bulge(at(nth), at(nth + 1), bulge),
            _ => Segment::line(at(nth), at(nth + 1)),
        };
        let pieces: Vec<Segment> = (0..radii.len()).map(piece).collect();
        let contour = Contour { blocks: (0..pieces.len()).collect(), pieces };
        let side = if is_left { Side::Left } else { Side::Right };
        let offset = ControlOffset { side, correction };
        let is_inside = contour.twice_area() * side.sign() > 0.0;
        if !contour.may_lose(offset.checked(), is_inside) {
            prop_assert_eq!(contour.judged(offset, is_inside), Vec::new());
        }
    }
}
