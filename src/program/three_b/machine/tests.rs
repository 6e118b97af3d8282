use super::stepped::interpolate;
use super::*;
use crate::geometry::{Point, Segment};
use crate::program::three_b::{Item, Words, decode, read};
use proptest::prelude::*;

fn block(text: &str) -> Block {
    let (items, faults) = read(text.as_bytes(), &Words::default());
    assert!(faults.is_empty(), "{text}: {faults:?}");
    match items.first() {
        Some(Item::Block { block, .. }) => *block,
        other => panic!("{text}: {other:?}"),
    }
}

fn check(text: &str, expected: (i64, i64)) {
    let end = travel(&block(text)).map(|node| (node.x, node.y));
    assert_eq!(end, Some(expected), "{text}");
}

#[test]
fn sound_blocks_end_where_they_mean() {
    check("B9900B0B9900GXL1", (9900, 0));
    check("B9900B0B9900GXL3", (-9900, 0));
    check("BBB021500GYL2", (0, 21500));
    check("BBB021500GYL4", (0, -21500));
    check("B17000B5000B017000GXL1", (17000, 5000));
    check("B1B9B090000GYL1", (10000, 90000));
    check("B1B9B090000GYL4", (10000, -90000));
    check("B9900B0B39600GYNR1", (0, 0));
    check("B3000B4000B20000GXNR1", (0, 0));
    check("B5000B0B5000GXNR1", (-5000, 5000));
    check("B0B5000B5000GYSR1", (5000, -5000));
    check("B30000B40000B060000GXNR1", (-60000, 0));
    // As far as two kilometres.
    check("B2000000000B0B2000000000GXL1", (FARTHEST, 0));
}

#[test]
fn a_line_at_45_degrees_ends_exactly_on_the_axis_that_the_convention_names() {
    for (text, exact) in [
        ("GYL1", true),
        ("GXL2", true),
        ("GYL3", true),
        ("GXL4", true),
        ("GXL1", false),
        ("GYL2", false),
    ] {
        let end = travel(&block(&format!("B7B7B7{text}"))).unwrap();
        assert_eq!(
            (end.x.abs(), end.y.abs()) == (7, 7),
            exact,
            "{text}: {end:?}"
        );
    }
}

#[test]
fn where_the_machine_would_not_stop_there_is_no_end() {
    for text in [
        "B0B5000B5000GXL1",
        "B5000B0B5000GYL1",
        "B0B0B5000GXNR1",
        "B3000000000B0B5GXL1",
    ] {
        assert_eq!(travel(&block(text)), None, "{text}");
    }
    assert_eq!(travel(&block("B5B5B0GXL1")), Some(Node { x: 0, y: 0 }));
}

fn any_block() -> impl Strategy<Value = Block> {
    let size = prop_oneof![0_i64..12, 0_i64..400];
    (
        size.clone(),
        size,
        1_i64..1600,
        any::<bool>(),
        0_u8..3,
        1_u8..5,
    )
        .prop_map(|(x, y, j, counts_x, kind, quadrant)| {
            let quadrant = Quadrant::from_number(quadrant).unwrap_or(Quadrant::First);
            let motion = match kind {
                0 => Motion::Line(quadrant),
                1 => Motion::Clockwise(quadrant),
                _ => Motion::CounterClockwise(quadrant),
            };
            Block {
                x,
                y,
                j,
                axis: if counts_x {
                    CountingAxis::X
                } else {
                    CountingAxis::Y
                },
                motion,
            }
        })
}

/// How many µm the counted axis moves from the ideal end to that of the machine along the arc, and for a line their
/// distance.
fn counted_miss(ideal: &Segment, axis: CountingAxis, machine: Node) -> f64 {
    let machine = Point::new(machine.x as f64, machine.y as f64);
    let Some(arc) = ideal.as_arc() else {
        return (ideal.end() - machine).norm();
    };
    let (ideal, machine) = (arc.end - arc.center, machine - arc.center);
    let turn = crate::geometry::cross(ideal, machine).atan2(ideal.dot(&machine));
    let counted = |share: f64| {
        let angle = ideal.y.atan2(ideal.x) + share * turn;
        arc.radius
            * if axis == CountingAxis::X {
                angle.cos()
            } else {
                angle.sin()
            }
    };
    const PARTS: i32 = 256;
    (0..PARTS)
        .map(|part| {
            (counted(f64::from(part + 1) / f64::from(PARTS))
                - counted(f64::from(part) / f64::from(PARTS)))
            .abs()
        })
        .sum()
}

/// Twice at an end of the counted axis the machine steps to 12 where the circle turns at 11.18: 3.28 of the 42 counts are used up there,
/// and the arc ends on the axis instead of 8 µm before it.
#[test]
fn steps_beyond_the_circle_are_counted_on_the_way_out_and_back() {
    let block = block("B5B10B42GXSR2");
    let ideal = decode(&block, Point::origin()).unwrap();
    let machine = travel(&block).unwrap();
    assert_eq!((machine.x, machine.y), (-6, -10));
    assert_eq!(interpolate(&block, 1000, |_| {}), Some(machine));
    assert!(
        (ideal.end() - Point::new(-2.721, -1.914)).norm() < 0.001,
        "{:?}",
        ideal.end()
    );
    assert!((counted_miss(&ideal, block.axis, machine) - 3.459).abs() < 0.01);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, ..ProptestConfig::default() })]

    #[test]
    fn the_closed_form_is_every_step(block in any_block()) {
        let mut farthest_from_circle = 0.0_f64;
        let start = {
            let (sign_x, sign_y) = match block.motion {
                Motion::Line(quadrant) | Motion::Clockwise(quadrant) | Motion::CounterClockwise(quadrant) => quadrant.signs(),
            };
            (block.x as f64 * sign_x, block.y as f64 * sign_y)
        };
        let radius = (start.0).hypot(start.1);
        let stepped = interpolate(&block, 2_000_000, |at| {
            let from_center = (start.0 + at.x as f64).hypot(start.1 + at.y as f64);
            farthest_from_circle = farthest_from_circle.max((from_center - radius).abs());
        });
        prop_assert_eq!(travel(&block), stepped);
        if !matches!(block.motion, Motion::Line(_)) && stepped.is_some() {
            prop_assert!(farthest_from_circle <= 1.0, "{}", farthest_from_circle);
        }
    }

    #[test]
    fn a_block_that_counts_the_right_axis_ends_near_its_ideal_end(block in any_block()) {
        if let Ok(ideal) = decode(&block, Point::origin()) {
            let end = ideal.end();
            let Some(machine) = travel(&block) else { return Err(TestCaseError::fail("no end")) };
            let counts_right = match ideal {
                crate::geometry::Segment::Line(_) => (end.x.abs() >= end.y.abs()) == (block.axis == CountingAxis::X),
                crate::geometry::Segment::Arc(arc) => {
                    let out = arc.end - arc.center;
                    arc.radius > 10.0 && (out.x.abs() < out.y.abs()) == (block.axis == CountingAxis::X)
                }
            };
            if counts_right {
                let miss = counted_miss(&ideal, block.axis, machine);
                // At each end of the counted axis the machine may run one step too far, which counts on the way out and back. Near it the
                // arc runs across the axis: there few counts are a long way.
                let ends = ideal.as_arc().map_or(0.0, |arc| (arc.sweep.abs() / std::f64::consts::PI).ceil());
                prop_assert!(miss <= 2.5 + 2.0 * ends, "{:?} ends {} beside, counted", block, miss);
            }
        }
    }
}
