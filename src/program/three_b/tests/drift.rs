//! Where a control stands at each node of a program, not only at its end.

use super::{blocks, written};
use crate::geometry::{Point, Segment, Vector, direction};
use crate::program::grid::point_of;
use crate::program::three_b::decode::decode;
use crate::program::three_b::encode::snap;
use crate::program::three_b::machine::travel;
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Lines and arcs of any size, in mm: an outline, or the tooth of a gear of as much as 400 pieces.
fn outline() -> impl Strategy<Value = Vec<Segment>> {
    let bulge = prop_oneof![2 => Just(0.0), 5 => -0.6_f64..0.6];
    let sides = prop::collection::vec((-2.0_f64..2.0, bulge), 4..40);
    let places = [-9.0_f64..9.0, -9.0_f64..9.0];
    let teeth = prop_oneof![Just(1_usize), Just(100)];
    (sides, teeth, 1.0_f64..50.0, 0.0..TAU, places).prop_map(
        |(sides, teeth, radius, turned, center)| {
            let count = sides.len() * teeth.min(400 / sides.len());
            let vertex = |index: usize| {
                let (away, _) = sides[index % sides.len()];
                let angle = turned + TAU * (index % count) as f64 / count as f64;
                Point::from(center) + direction(angle) * (radius * (1.0 + away / count as f64))
            };
            let side = |index: usize| {
                let (_, bulge) = sides[index % sides.len()];
                Segment::from_bulge(vertex(index), vertex(index + 1), bulge)
            };
            (0..count).map(side).collect()
        },
    )
}

/// The largest distance of a program from the nodes of its path, as a control counts and in exact arcs, µm. An arc may
/// have become many blocks: one whose centre is farther away than the numbers reach is written as chords.
fn farthest(path: &[Segment], text: &str) -> [f64; 2] {
    let begin = snap(path[0].start() * 1000.0).expect("near");
    let (mut machine, mut exact) = (point_of(begin), point_of(begin));
    let mut ends = Vec::new();
    for block in blocks(text) {
        let before = machine;
        machine += point_of(travel(&block).expect("an end")).coords;
        exact = decode(&block, exact).expect("a decodable block").end();
        ends.push((block, machine - before, [machine, exact]));
    }
    let (mut at, mut worst) = (0, [0.0_f64; 2]);
    for piece in path {
        let node = piece.end() * 1000.0;
        let off = |index: &usize| (ends[*index].2[0] - node).norm();
        let next = at..ends.len().min(at + 64);
        let own = next
            .min_by(|a, b| off(a).total_cmp(&off(b)))
            .expect("a block");
        at = own + 1;
        let (block, by, own) = &ends[own];
        for reading in 0..2 {
            worst[reading] = worst[reading].max((own[reading] - node).norm());
        }
        // A straight side is tilted by no more than its nodes are rounded.
        if block.motion.is_line() && piece.as_arc().is_none() {
            let along = piece.end_tangent();
            assert!((along.x * by.y - along.y * by.x).abs() <= 1.5, "{block:?}");
            assert!(along.x * along.y != 0.0 || by.x * by.y == 0.0, "{block:?}");
        }
    }
    assert_eq!(at, ends.len());
    worst
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn every_node_is_where_it_should_be(path in outline()) {
        let program = written(path.clone());
        let [machine, exact] = farthest(&path, &program.text);
        prop_assert!(machine <= 2.0 && exact <= 3.0, "{machine} {exact}");
        // What is said is never less.
        prop_assert!(program.deviation >= machine.max(exact) - 1e-6, "{} {machine} {exact}", program.deviation);
        prop_assert!(program.deviation <= 3.0, "{}", program.deviation);
    }
}

/// Each arc misses its end by the same part of a micrometre, which does not add up, nor do many blocks of a few micrometres.
#[test]
fn what_equal_arcs_in_a_row_miss_does_not_add_up() {
    for (pitch, bulge) in [
        (0.004, 0.075),
        (0.02, -0.2),
        (0.05, 0.0125),
        (0.3, 0.55),
        (0.3, 0.9),
        (0.777, -0.61),
        (2.5, 1.0),
        (1.001, 0.173),
    ] {
        let count = 600;
        let at = |index: usize| Point::new(index as f64 * pitch, 0.0);
        let mut path: Vec<Segment> = (0..count)
            .map(|index| Segment::from_bulge(at(index), at(index + 1), bulge))
            .collect();
        let corners = [
            at(count),
            at(count) + Vector::new(0.0, 50.0),
            Point::new(0.0, 50.0),
            at(0),
        ];
        path.extend(
            corners
                .windows(2)
                .map(|pair| Segment::line(pair[0], pair[1])),
        );
        let program = written(path.clone());
        let [machine, exact] = farthest(&path, &program.text);
        assert!(
            machine <= 2.0 && exact <= 3.0,
            "{pitch} {bulge}: {machine} {exact}"
        );
        assert!(program.deviation <= 3.0, "{}", program.deviation);
    }
}
