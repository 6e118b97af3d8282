//! Random paths and blocks.

use super::{blocks, written};
use crate::geometry::{Arc, Point, Segment, Vector, direction};
use crate::program::three_b::block::{Block, CountingAxis, Motion, Node, Quadrant};
use crate::program::three_b::decode::decode;
use crate::program::three_b::encode::{END_TOLERANCE, Encoded, encode, point_of, snap};
use crate::program::three_b::parse::{Item, read};
use crate::program::three_b::words::Words;
use crate::settings::{Effective, Layout};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

/// A closed path of lines and arcs about the origin, in mm: vertices on a wavy ring, a bulge for each side.
fn closed_path() -> impl Strategy<Value = Vec<Segment>> {
    prop::collection::vec(
        (
            0.3_f64..40.0,
            prop_oneof![Just(0.0), -1.5_f64..1.5, -1e-3..1e-3],
        ),
        3..24,
    )
    .prop_map(|sides| {
        let count = sides.len();
        let vertex = |index: usize| {
            Point::origin() + direction(TAU * index as f64 / count as f64) * sides[index].0
        };
        (0..count)
            .map(|index| {
                Segment::from_bulge(vertex(index), vertex((index + 1) % count), sides[index].1)
            })
            .collect()
    })
}

/// The path turned, mirrored, shifted and travelled backwards.
fn moved(
    path: &[Segment],
    angle: f64,
    mirror: bool,
    shift: Vector,
    backwards: bool,
) -> Vec<Segment> {
    let (cos, sin) = (angle.cos(), angle.sin());
    let place = |p: Point| {
        let y = if mirror { -p.y } else { p.y };
        Point::new(p.x * cos - y * sin, p.x * sin + y * cos) + shift
    };
    let segment = |s: &Segment| {
        Segment::from_bulge(
            place(s.start()),
            place(s.end()),
            if mirror { -s.bulge() } else { s.bulge() },
        )
    };
    let mut moved: Vec<Segment> = path.iter().map(segment).collect();
    if backwards {
        moved.reverse();
        moved = moved.iter().map(Segment::reversed).collect();
    }
    moved
}

fn any_block() -> impl Strategy<Value = Block> {
    let number = || prop_oneof![0_i64..20, 0_i64..1_000_000, 0_i64..1_000_000_000_000];
    (
        number(),
        number(),
        number(),
        any::<bool>(),
        1_u8..=4,
        0_usize..3,
    )
        .prop_map(|(x, y, j, on_x, quadrant, kind)| {
            let quadrant = Quadrant::from_number(quadrant).expect("1 to 4");
            let motion = [
                Motion::Line(quadrant),
                Motion::Clockwise(quadrant),
                Motion::CounterClockwise(quadrant),
            ][kind];
            Block {
                x,
                y,
                j,
                axis: if on_x {
                    CountingAxis::X
                } else {
                    CountingAxis::Y
                },
                motion,
            }
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_written_program_decodes_to_its_path(
        path in closed_path(), angle in -PI..PI, mirror: bool, backwards: bool,
        shift in prop_oneof![Just([0.0, 0.0]), [-1e5_f64..1e5, -1e5_f64..1e5]],
    ) {
        let path = moved(&path, angle, mirror, Vector::from(shift), backwards);
        let program = written(path.clone());
        // From where the program stands: ends are snapped, arcs run about centres on the grid, J is rounded.
        prop_assert!(program.deviation <= 3.0, "{}", program.deviation);
        // Decoded from the text alone, from end to end, as a controller runs it.
        let mut at = point_of(snap(path[0].start() * 1000.0).expect("near"));
        let (begin, mut arcs) = (at, 0);
        for block in blocks(&program.text) {
            let decoded = decode(&block, at).expect("a decodable block");
            arcs += usize::from(decoded.as_arc().is_some());
            at = decoded.end();
        }
        let drift = at - begin;
        prop_assert!((drift - Vector::from(program.closure)).norm() < 1e-6 * (1.0 + begin.coords.norm() * 1e-6));
        prop_assert!(drift.norm() <= crate::program::path::tolerance(arcs));
    }

    #[test]
    fn single_arcs_of_any_size_stay_on_their_path(
        radius in prop_oneof![0.0005_f64..0.02, 0.02..2.0, 2.0..300.0, 300.0..3e3], start in -PI..PI, sweep in prop_oneof![-TAU..TAU, -0.01..0.01],
        center in [-50.0_f64..50.0, -50.0_f64..50.0],
    ) {
        let arc = Arc::from_center(Point::from(center) * 1000.0, radius * 1000.0, start, sweep);
        let (from, to) = (snap(arc.start).expect("near"), snap(arc.end).expect("near"));
        let mut encoded: Vec<Encoded> = Vec::new();
        prop_assert!(encode(&Segment::Arc(arc), from, to, Effective::default().largest_number(), &mut encoded).is_some());
        let mut node = from;
        for block in &encoded {
            prop_assert_eq!(block.from, node);
            node = block.to;
            prop_assert!(block.block.x.max(block.block.y).max(block.block.j) <= Effective::default().largest_number());
            let decoded = decode(&block.block, point_of(block.from)).expect("a decodable block");
            prop_assert!((decoded.end() - point_of(block.to)).norm() <= END_TOLERANCE);
            for share in [0.1, 0.3, 0.5, 0.7, 0.9] {
                let distance = arc.distance_to(decoded.point_at(share));
                prop_assert!(distance <= 2.6, "{:?} runs {} µm beside", block, distance);
            }
        }
        prop_assert_eq!(node, to);
    }

    #[test]
    fn every_layout_reads_back_as_the_same_blocks(list in prop::collection::vec(any_block(), 1..20)) {
        for layout in [Layout::Compact, Layout::Aligned, Layout::Checking] {
            let mut out = Vec::new();
            for (index, block) in list.iter().enumerate() {
                crate::program::three_b::layout::push_block(&mut out, layout, index + 1, block, None, Node { x: -block.x, y: block.y });
            }
            prop_assert_eq!(&blocks(&String::from_utf8(out).expect("ASCII")), &list);
        }
    }

    #[test]
    fn reading_and_decoding_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200), block in any_block()) {
        let (_, faults) = read(&bytes, &Words { pause: "", end: "" });
        for fault in faults {
            prop_assert!(fault.range.start <= fault.range.end && fault.range.end <= bytes.len());
        }
        if let Ok(decoded) = decode(&block, Point::origin()) {
            prop_assert!(decoded.end().x.is_finite() && decoded.end().y.is_finite());
        }
    }

    #[test]
    fn damaged_programs_never_panic(text in "(N?[0-9]{0,3}:? ?[Bb][0-9]{0,22} ?B[0-9]{0,5}B[0-9]{0,9} ?G[XYZ]? ?(L|SR|NR|S)?[0-6]?( ?;.{0,9})?[\r\n]{1,2}|DD?\n|Start Point = ){0,8}") {
        for item in read(text.as_bytes(), &Words::default()).0 {
            if let Item::Block { block, .. } = item {
                let _ = decode(&block, Point::new(1e9, -1e9));
            }
        }
    }
}
