//! The controller to the micron: point-by-point comparison, one µm at a time, J counted down on the counting axis.
//!
//! The machine compares where it stands with the line or circle: on it or on the far side it steps towards it, on the near side
//! along it. A line in a quadrant is worked in that quadrant's own axes, the first of which is that of +X, +Y, −X, −Y for `L1` to
//! `L4`; that is why a line at 45° counts Y in the quadrants I and III and X in II and IV: the last step counts. An arc steps
//! towards the axis at the end of its quadrant when it stands on the circle or outside of it, and away from the axis that it comes
//! from when it stands inside. (Point-by-point comparison is in every textbook on these controllers; makers differ in what a step
//! exactly on the curve does, which is worth at most one µm.)
//!
//! [`travel`] gives the end in closed form. [`interpolate`] takes every step and is what tests hold it against.

use super::block::{Block, CountingAxis, Motion, Node, Quadrant};

/// The largest number that is followed, µm: two kilometres. Squares of it and their sums fit into 64 bits.
const FARTHEST: i64 = 2_000_000_000;

/// Where the machine stands at the end of a block, seen from its start, µm.
///
/// `None` where it would not stop (a line that does not move on the axis it counts) or does not know where to go (an arc about
/// its own start), and for numbers beyond two kilometres. A J of 0 moves nothing.
pub fn travel(block: &Block) -> Option<Node> {
    let Block { x, y, j, .. } = *block;
    if x > FARTHEST || y > FARTHEST || j > FARTHEST || x < 0 || y < 0 || j < 0 {
        return None;
    }
    match block.motion {
        _ if j == 0 => Some(Node { x: 0, y: 0 }),
        Motion::Line(quadrant) => line(block, quadrant),
        Motion::Clockwise(quadrant) => arc(block, quadrant, false),
        Motion::CounterClockwise(quadrant) => arc(block, quadrant, true),
    }
}

/// Steps on X and on Y as a displacement in a quadrant.
fn signed(quadrant: Quadrant, along_x: i64, along_y: i64) -> Node {
    let (sign_x, sign_y) = quadrant.signs();
    Node {
        x: sign_x as i64 * along_x,
        y: sign_y as i64 * along_y,
    }
}

/// True where the first axis of a quadrant's own is Y.
fn is_turned(quadrant: Quadrant) -> bool {
    matches!(quadrant, Quadrant::Second | Quadrant::Fourth)
}

/// A line as its controller works it: how far it reaches on the first and second axis of its quadrant, and whether the first counts.
struct Ramp {
    first: i64,
    second: i64,
    first_counts: bool,
}

/// `None` where the counted axis does not move.
fn ramp(block: &Block, quadrant: Quadrant) -> Option<Ramp> {
    // An axis-parallel line may leave both numbers out.
    let (x, y) = match (block.x, block.y, block.axis) {
        (0, 0, CountingAxis::X) => (block.j, 0),
        (0, 0, CountingAxis::Y) => (0, block.j),
        (x, y, _) => (x, y),
    };
    let counted = if block.axis == CountingAxis::X { x } else { y };
    if counted == 0 {
        return None;
    }
    let turned = is_turned(quadrant);
    let (first, second) = if turned { (y, x) } else { (x, y) };
    Some(Ramp {
        first,
        second,
        first_counts: (block.axis == CountingAxis::X) != turned,
    })
}

fn line(block: &Block, quadrant: Quadrant) -> Option<Node> {
    let Ramp {
        first,
        second,
        first_counts,
    } = ramp(block, quadrant)?;
    let j = block.j;
    let (a, b) = match (first, second) {
        // Along an axis there is nothing to compare.
        (_, 0) => (j, 0),
        (0, _) => (0, j),
        // The J-th step on the first axis is taken as soon as the second has kept up with the J − 1 before.
        _ if first_counts => (j, ratio(j - 1, second, first, true)),
        // The J-th step on the second axis is taken as soon as the first is ahead of the J − 1 before.
        _ => (ratio(j - 1, first, second, false) + 1, j),
    };
    let (x, y) = if is_turned(quadrant) { (b, a) } else { (a, b) };
    Some(signed(quadrant, x, y))
}

/// `count · over / under`, rounded up or down.
fn ratio(count: i64, over: i64, under: i64, up: bool) -> i64 {
    match count
        .checked_mul(over)
        .and_then(|product| product.checked_add(if up { under - 1 } else { 0 }))
    {
        Some(product) => product / under,
        None => {
            let product =
                i128::from(count) * i128::from(over) + if up { i128::from(under) - 1 } else { 0 };
            i64::try_from(product / i128::from(under)).unwrap_or(i64::MAX)
        }
    }
}

/// The circle of an arc and where it begins on it.
struct Round {
    /// R², µm².
    square: i64,
    quadrant: Quadrant,
    counter_clockwise: bool,
    axis: CountingAxis,
    /// Distance from the axis at the end of the quadrant, and from the one at its beginning.
    left: i64,
    done: i64,
}

impl Round {
    fn of(block: &Block, quadrant: Quadrant, counter_clockwise: bool) -> Option<Round> {
        let square = block.x * block.x + block.y * block.y;
        if square == 0 {
            return None;
        }
        let mut round = Round {
            square,
            quadrant,
            counter_clockwise,
            axis: block.axis,
            left: 0,
            done: 0,
        };
        (round.left, round.done) = if round.x_is_left() {
            (block.x, block.y)
        } else {
            (block.y, block.x)
        };
        Some(round)
    }

    /// True where the axis at the end of the quadrant is reached by steps on X.
    fn x_is_left(&self) -> bool {
        is_turned(self.quadrant) != self.counter_clockwise
    }

    fn left_counts(&self) -> bool {
        self.x_is_left() == (self.axis == CountingAxis::X)
    }

    /// Into the next quadrant, from the axis on.
    fn turn(&mut self) {
        let next = match (self.quadrant, self.counter_clockwise) {
            (Quadrant::First, true) | (Quadrant::Third, false) => Quadrant::Second,
            (Quadrant::Second, true) | (Quadrant::Fourth, false) => Quadrant::Third,
            (Quadrant::Third, true) | (Quadrant::First, false) => Quadrant::Fourth,
            (Quadrant::Fourth, true) | (Quadrant::Second, false) => Quadrant::First,
        };
        (self.quadrant, self.left, self.done) = (next, self.done, self.left);
    }

    fn is_at_axis(&self) -> bool {
        self.left == 0 && self.done > 0
    }

    fn point(&self) -> Node {
        let (x, y) = if self.x_is_left() {
            (self.left, self.done)
        } else {
            (self.done, self.left)
        };
        signed(self.quadrant, x, y)
    }

    /// How far the machine is from the axis at the quadrant's beginning when it takes the step that begins at `left`.
    fn done_at(&self, left: i64) -> i64 {
        self.done.max(root_up(self.square - left * left))
    }
}

fn arc(block: &Block, quadrant: Quadrant, counter_clockwise: bool) -> Option<Node> {
    let mut round = Round::of(block, quadrant, counter_clockwise)?;
    let start = round.point();
    let mut count = block.j;
    let mut reach = None;
    loop {
        if round.is_at_axis() {
            round.turn();
            // From the second axis on every quadrant is like the one before: whole turns are left out.
            if round.done == 0 && reach == Some(round.left) {
                count = (count - 1) % (4 * round.left) + 1;
            }
            reach = (round.done == 0).then_some(round.left);
        }
        // At a radius of 1 µm the machine steps into the centre, and out of it.
        let done_at_axis = if round.left == 0 {
            round.done
        } else {
            round.done_at(1)
        }
        .max(1);
        let in_quadrant = if round.left_counts() {
            round.left
        } else {
            done_at_axis - round.done
        };
        if count <= in_quadrant {
            break;
        }
        count -= in_quadrant;
        (round.left, round.done) = (0, done_at_axis);
    }
    if round.left_counts() {
        let before = round.left - count + 1;
        (round.left, round.done) = (round.left - count, round.done_at(before));
    } else {
        let before = round.done + count - 1;
        // The largest distance that is still inside of the circle.
        let inside = root_up(round.square - before * before) - 1;
        (round.left, round.done) = (round.left.min(inside.max(0)), round.done + count);
    }
    let end = round.point();
    Some(Node {
        x: end.x - start.x,
        y: end.y - start.y,
    })
}

/// The least whole number whose square is not below `square`; 0 for what is not above 0.
fn root_up(square: i64) -> i64 {
    if square <= 0 {
        return 0;
    }
    let mut root = (square as f64).sqrt() as i64;
    // 64 bits hold more digits than the root of a float.
    while root * root < square {
        root += 1;
    }
    while (root - 1) * (root - 1) >= square {
        root -= 1;
    }
    root
}

/// The same as [`travel`], step by step: `each` hears where the machine stands after every step, seen from the block's start.
///
/// Takes as long as the wire's way has µm. Ends after `most` steps.
pub fn interpolate(block: &Block, most: usize, mut each: impl FnMut(Node)) -> Option<Node> {
    let mut left_to_count = block.j;
    let mut at = Node { x: 0, y: 0 };
    if left_to_count == 0 {
        return Some(at);
    }
    let (quadrant, turn) = match block.motion {
        Motion::Line(quadrant) => (quadrant, None),
        Motion::Clockwise(quadrant) => (quadrant, Some(false)),
        Motion::CounterClockwise(quadrant) => (quadrant, Some(true)),
    };
    if let Some(counter_clockwise) = turn {
        let mut round = Round::of(block, quadrant, counter_clockwise)?;
        let start = round.point();
        for _ in 0..most {
            if round.is_at_axis() {
                round.turn();
            }
            let is_outside = round.left * round.left + round.done * round.done >= round.square;
            let counts = if is_outside {
                round.left -= 1;
                round.left_counts()
            } else {
                round.done += 1;
                !round.left_counts()
            };
            let point = round.point();
            at = Node {
                x: point.x - start.x,
                y: point.y - start.y,
            };
            each(at);
            left_to_count -= i64::from(counts);
            if left_to_count == 0 {
                return Some(at);
            }
        }
        return None;
    }
    let Ramp {
        first,
        second,
        first_counts,
    } = ramp(block, quadrant)?;
    let (mut a, mut b) = (0_i64, 0_i64);
    for _ in 0..most {
        let is_above = i128::from(b) * i128::from(first) >= i128::from(a) * i128::from(second);
        // Along the second axis there is nothing to compare.
        let steps_first = is_above && first > 0;
        if steps_first {
            a += 1;
        } else {
            b += 1;
        }
        let (x, y) = if is_turned(quadrant) { (b, a) } else { (a, b) };
        at = signed(quadrant, x, y);
        each(at);
        left_to_count -= i64::from(steps_first == first_counts);
        if left_to_count == 0 {
            return Some(at);
        }
    }
    None
}

#[cfg(test)]
mod tests {
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

    /// How many µm the counted axis moves from the ideal end to that of the machine along the arc, and for a line how far they are apart.
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
        #![proptest_config(ProptestConfig { cases: 4000, ..ProptestConfig::default() })]

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
}
