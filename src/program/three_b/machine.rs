//! The controller to the micron: point-by-point comparison, one µm at a time, J counted down on the counting axis.
//!
//! The machine compares its position with the line or circle: on it or on the far side it steps towards it, on the near
//! side along it. A line in a quadrant is worked in that quadrant's own axes, the first of which is that of +X, +Y, −X,
//! −Y for `L1` to `L4`; that is why a line at 45° counts Y in the quadrants I and III and X in II and IV: the last step
//! counts. An arc steps towards the axis at the end of its quadrant when the machine is on the circle or outside of it,
//! and away from the axis that it comes from when it is inside. (Point-by-point comparison is in every textbook on
//! these controllers; makers differ in the step exactly on the curve, which makes a difference of at most one µm.)
//!
//! [`travel`] gives the end in closed form. Tests compare it with a controller that takes every step.

use super::block::{Block, CountingAxis, Motion, Node, Quadrant};

/// The largest number that is followed, µm: two kilometres. Squares of it and their sums fit into 64 bits.
const FARTHEST: i64 = 2_000_000_000;

/// The machine's position at the end of a block, relative to its start, µm.
///
/// `None` where it would not stop (a line that does not move on the counted axis) or has no direction (an arc about its
/// own start), and for numbers beyond two kilometres. A J of 0 moves nothing.
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

/// A line as its controller works it: its extent on the first and second axis of its quadrant, and whether the first
/// counts.
struct Ramp {
    first: i64,
    second: i64,
    first_counts: bool,
}

/// `None` where the counted axis does not move.
fn ramp(block: &Block, quadrant: Quadrant) -> Option<Ramp> {
    let [x, y] = block.extent();
    if block.axis.of([x, y]) == 0 {
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

    /// The machine's distance from the axis at the quadrant's beginning when it takes the step that begins at `left`.
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
            // From the second axis on all quadrants are alike: whole turns are left out.
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

/// The least whole number whose square is not below `square`; 0 for negative ones.
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

#[cfg(any(test, feature = "testing"))]
pub(super) mod stepped;
#[cfg(test)]
mod tests;
