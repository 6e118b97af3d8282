//! One block of 3B as typed numbers in micrometres; its text is the matter of `layout` and `parse`.

#![warn(clippy::indexing_slicing)]

pub(crate) use crate::program::grid::Node;

/// G: the axis whose projections the controller counts.
pub use crate::finding::Axis as CountingAxis;

/// A quadrant, 1 to 4.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quadrant {
    First,
    Second,
    Third,
    Fourth,
}

impl Quadrant {
    pub(crate) const ALL: [Quadrant; 4] = [
        Quadrant::First,
        Quadrant::Second,
        Quadrant::Third,
        Quadrant::Fourth,
    ];

    /// The quadrant by its number, `None` except for 1 to 4.
    pub fn from_number(number: u8) -> Option<Quadrant> {
        let index = usize::from(number.checked_sub(1)?);
        Quadrant::ALL.get(index).copied()
    }

    pub(crate) fn number(self) -> u8 {
        self as u8 + 1
    }

    /// Signs of x and y in the quadrant.
    pub(crate) fn signs(self) -> (f64, f64) {
        match self {
            Quadrant::First => (1.0, 1.0),
            Quadrant::Second => (-1.0, 1.0),
            Quadrant::Third => (-1.0, -1.0),
            Quadrant::Fourth => (1.0, -1.0),
        }
    }

    /// The axis that a line at 45° in it counts on: the last step counts.
    pub(crate) fn counts_at_45_degrees(self) -> CountingAxis {
        match self {
            Quadrant::First | Quadrant::Third => CountingAxis::Y,
            Quadrant::Second | Quadrant::Fourth => CountingAxis::X,
        }
    }

    /// The quadrant of a direction, or of a point that is left counter-clockwise: each axis belongs to the quadrant after it.
    pub(crate) fn counter_clockwise(x: i64, y: i64) -> Quadrant {
        match (x, y) {
            (x, y) if x > 0 && y >= 0 => Quadrant::First,
            (x, y) if x <= 0 && y > 0 => Quadrant::Second,
            (x, y) if x < 0 && y <= 0 => Quadrant::Third,
            _ => Quadrant::Fourth,
        }
    }

    /// The quadrant of a point that is left clockwise: each axis belongs to the quadrant before it.
    pub(crate) fn clockwise(x: i64, y: i64) -> Quadrant {
        match (x, y) {
            (x, y) if x >= 0 && y > 0 => Quadrant::First,
            (x, y) if x < 0 && y >= 0 => Quadrant::Second,
            (x, y) if x <= 0 && y < 0 => Quadrant::Third,
            _ => Quadrant::Fourth,
        }
    }
}

/// Z: the kind of motion, and the quadrant of a line's direction or of an arc's start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// `L1` to `L4`.
    Line(Quadrant),
    /// `SR1` to `SR4`.
    Clockwise(Quadrant),
    /// `NR1` to `NR4`.
    CounterClockwise(Quadrant),
}

impl Motion {
    pub(crate) fn all() -> impl Iterator<Item = Motion> {
        let kinds: [fn(Quadrant) -> Motion; 3] =
            [Motion::Line, Motion::CounterClockwise, Motion::Clockwise];
        kinds.into_iter().flat_map(|kind| Quadrant::ALL.map(kind))
    }

    /// An arc from a point, seen from its centre.
    pub(crate) fn arc(counter_clockwise: bool, x: i64, y: i64) -> Motion {
        match counter_clockwise {
            true => Motion::CounterClockwise(Quadrant::counter_clockwise(x, y)),
            false => Motion::Clockwise(Quadrant::clockwise(x, y)),
        }
    }

    /// Z as it is written.
    pub(crate) fn name(self) -> &'static str {
        let [first, second, third, fourth] = match self {
            Motion::Line(_) => ["L1", "L2", "L3", "L4"],
            Motion::Clockwise(_) => ["SR1", "SR2", "SR3", "SR4"],
            Motion::CounterClockwise(_) => ["NR1", "NR2", "NR3", "NR4"],
        };
        match self.quadrant() {
            Quadrant::First => first,
            Quadrant::Second => second,
            Quadrant::Third => third,
            Quadrant::Fourth => fourth,
        }
    }

    pub(crate) fn is_line(self) -> bool {
        matches!(self, Motion::Line(_))
    }

    pub(crate) fn quadrant(self) -> Quadrant {
        match self {
            Motion::Line(quadrant)
            | Motion::Clockwise(quadrant)
            | Motion::CounterClockwise(quadrant) => quadrant,
        }
    }
}

/// `B X B Y B J G Z`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// µm, not negative: a line's end relative to its start, or an arc's start relative to its centre.
    pub x: i64,
    pub y: i64,
    /// µm, not negative: how far the controller counts on `axis` before it stops.
    pub j: i64,
    pub axis: CountingAxis,
    pub motion: Motion,
}

impl Block {
    /// X and Y of a line, which leaves both out where it runs along its counting axis.
    pub(crate) fn extent(&self) -> [i64; 2] {
        match (self.x, self.y, self.axis) {
            (0, 0, CountingAxis::X) => [self.j, 0],
            (0, 0, CountingAxis::Y) => [0, self.j],
            (x, y, _) => [x, y],
        }
    }
}

/// How far the radius of a 4B block may lie from √(X² + Y²), µm: its centre and it are rounded.
const RADIUS_TOLERANCE: f64 = 4.0;

/// The additional part of a 4B block: the controller changes each arc by its correction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PartArc {
    /// µm.
    pub(crate) radius: i64,
    /// `DD`: the wire runs inside of the arc, whose radius the correction makes smaller. `D`: outside.
    pub(crate) concave: bool,
}

impl PartArc {
    /// True where the radius is that of the block, or none is stated. A line has none.
    pub(crate) fn fits(&self, block: &Block) -> bool {
        let own = (block.x as f64).hypot(block.y as f64);
        let is_own = (self.radius as f64 - own).abs() <= RADIUS_TOLERANCE;
        !block.motion.is_line() && (self.radius == 0 || is_own)
    }
}
