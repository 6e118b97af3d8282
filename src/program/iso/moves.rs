//! A move of the control: its end, its arc, and how its numbers are read.
//!
//! Places are whole nanometres, so that a micrometre, four decimals of an inch and six of a millimetre are all exact,
//! and sums do not depend on their order.

use super::block::{Corner, Motion, Register};
use super::word::Number;
use crate::finding::Side;
use crate::geometry::{Arc, Point, Segment, Vector};
use crate::program::path::{Kind, Step, Writing};
pub(crate) use crate::settings::CenterRule;

/// Nanometres in a micrometre.
pub(crate) const MICROMETRE: i64 = 1_000;

/// The largest length that a word may give, nm: 10 km, which is 10 m where µm were read as mm. No machine travels so far, and
/// the sum of hundreds of thousands of lines still has room in an `i64`.
pub(super) const FARTHEST: i64 = 10_000_000_000_000;

/// The same in mm.
pub(super) const FARTHEST_MM: i64 = FARTHEST / 1_000_000;

/// A place in nm.
pub(crate) type Place = [i64; 2];

/// How the numbers of a program are read: found from the program as a whole.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reading {
    /// A number without decimal point is in µm (tenths of a thousandth of an inch); else it is in mm (inches) like the
    /// others.
    pub(crate) whole_numbers_are_fine: bool,
    /// For arcs under G90.
    pub(crate) absolute: CenterRule,
    /// For arcs under G91; never [`CenterRule::Absolute`].
    pub(crate) incremental: CenterRule,
    /// The largest difference of the distances of an arc's ends from its centre, nm.
    pub(crate) tolerance: i64,
}

impl Reading {
    pub(crate) fn rule(&self, incremental: bool) -> CenterRule {
        if incremental {
            self.incremental
        } else {
            self.absolute
        }
    }

    /// The same with I and J by another rule: under G91, where a centre has no coordinates, only by one that counts.
    pub(super) fn with_rule(self, rule: CenterRule) -> Reading {
        Reading {
            absolute: rule,
            incremental: match rule {
                CenterRule::Absolute => self.incremental,
                rule => rule,
            },
            ..self
        }
    }

    /// How the program gives the end of its moves.
    pub(crate) fn writing(&self) -> Writing {
        Writing {
            names_places: true,
            slack: self.tolerance as f64 / 1e3,
        }
    }

    /// Whether a length is more than [`FARTHEST`].
    pub(super) fn is_too_far(&self, number: Number, inch: bool) -> bool {
        // With so few digits it is not, whatever the unit.
        number.mantissa.unsigned_abs() > 390_000
            && self.length(number, inch).unsigned_abs() > FARTHEST.unsigned_abs()
    }

    /// A length as it is written, in nm; `None` for one that is too far.
    pub(super) fn length_within(&self, number: Number, inch: bool) -> Option<i64> {
        (!self.is_too_far(number, inch)).then(|| self.length(number, inch))
    }

    /// A length as it is written, in nm.
    pub(crate) fn length(&self, number: Number, inch: bool) -> i64 {
        if !number.point && self.whole_numbers_are_fine {
            return number.mantissa * if inch { 2_540 } else { MICROMETRE };
        }
        let unit: i128 = if inch { 25_400_000 } else { 1_000_000 };
        let divisor = 10_i128.pow(u32::from(number.decimals));
        let scaled = i128::from(number.mantissa) * unit;
        if scaled % divisor == 0 {
            return (scaled / divisor) as i64;
        }
        let half = if scaled < 0 {
            -divisor / 2
        } else {
            divisor / 2
        };
        ((scaled + half) / divisor) as i64
    }
}

/// How an arc gives its centre.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Bend {
    /// I and J in nm, as written, and their place as absolute coordinates; the origin under G91, where no centre is absolute.
    Center { i: i64, j: i64, absolute: Place },
    /// R in nm; negative for more than a half turn.
    Radius(i64),
    /// Neither.
    Nothing,
}

/// One move of the wire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Move {
    pub(crate) motion: Motion,
    pub(crate) from: Place,
    pub(crate) to: Place,
    pub(crate) bend: Bend,
    /// It was written under G91.
    pub(crate) incremental: bool,
    /// The side of travel on which the control lets the wire run beside this move.
    pub(crate) side: Option<Side>,
    pub(crate) offset: Option<Register>,
    /// G41 or G42 (true) or G40 (false) takes effect with this move.
    pub(crate) switches: Option<bool>,
    /// The corner that the control makes at its end.
    pub(crate) corner: Option<Corner>,
}

/// The curve of an arc, or why there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Course {
    Line,
    /// µm.
    Arc(Arc),
    /// The ends' distances from the centre differ, µm.
    OffRadius {
        start: f64,
        end: f64,
        center: Point,
    },
    NoRadius,
}

impl Move {
    pub(crate) fn is_arc(&self) -> bool {
        self.motion.is_arc()
    }

    /// False for a straight move from a place to itself.
    pub(crate) fn goes_anywhere(&self) -> bool {
        self.from != self.to || self.is_arc()
    }

    pub(crate) fn is_cut(&self) -> bool {
        self.motion != Motion::Rapid
    }

    /// The centre under a rule, nm; `None` without I and J.
    pub(crate) fn center(&self, rule: CenterRule) -> Option<Place> {
        let Bend::Center { i, j, absolute } = self.bend else {
            return None;
        };
        Some(match rule {
            CenterRule::StartToCenter => added(self.from, [i, j]),
            CenterRule::CenterToStart => apart(self.from, [i, j]),
            CenterRule::Absolute => absolute,
        })
    }

    /// The coordinate along an axis, nm, of the centre that has the other one of `center` and is as far from both ends;
    /// `None` where the ends do not determine it.
    pub(crate) fn center_along(&self, axis: usize, center: Place) -> Option<i64> {
        let end = apart(self.to, self.from).map(|length| length as f64);
        let other = 1 - axis;
        if end[axis].abs() < MICROMETRE as f64 {
            return None;
        }
        let square = end[0] * end[0] + end[1] * end[1];
        let across = apart(center, self.from)[other] as f64 * end[other];
        let place = (square / 2.0 - across) / end[axis];
        (place.abs() < 1e13).then(|| self.from[axis].wrapping_add(place.round() as i64))
    }

    /// The start's distance from the centre minus that of the end under a rule, nm. 0 where there is no centre.
    pub(crate) fn difference(&self, rule: CenterRule) -> f64 {
        self.center(rule).map_or(0.0, |center| {
            distance(self.from, center) - distance(self.to, center)
        })
    }

    /// The curve of the move.
    pub(crate) fn course(&self, reading: &Reading) -> Course {
        if !self.is_arc() {
            return Course::Line;
        }
        let counter_clockwise = self.motion == Motion::CounterClockwise;
        match self.bend {
            Bend::Nothing => Course::NoRadius,
            Bend::Radius(radius) => self.about_radius(radius, counter_clockwise, reading),
            Bend::Center { .. } => {
                let Some(center) = self.center(reading.rule(self.incremental)) else {
                    return Course::NoRadius;
                };
                let (start, end) = (distance(self.from, center), distance(self.to, center));
                if start == 0.0 || end == 0.0 {
                    return Course::NoRadius;
                }
                if (start - end).abs() > reading.tolerance as f64 {
                    return Course::OffRadius {
                        start: start / 1e3,
                        end: end / 1e3,
                        center: micrometres(center),
                    };
                }
                Course::Arc(Arc::about(
                    micrometres(center),
                    micrometres(self.from),
                    micrometres(self.to),
                    counter_clockwise,
                ))
            }
        }
    }

    /// The arc with a given radius: at most a half turn, or more where R is negative.
    fn about_radius(&self, radius: i64, counter_clockwise: bool, reading: &Reading) -> Course {
        let (from, to) = (micrometres(self.from), micrometres(self.to));
        let radius = radius as f64 / 1e3;
        let (half, given) = ((to - from).norm() / 2.0, radius.abs());
        if half == 0.0 || given == 0.0 {
            return Course::NoRadius;
        }
        if half - given > reading.tolerance as f64 / 1e3 {
            return Course::OffRadius {
                start: given,
                end: half,
                center: from + (to - from) / 2.0,
            };
        }
        Course::Arc(Arc::of_radius(from, to, radius, counter_clockwise))
    }

    /// The line or arc in µm; `None` where an arc leads nowhere.
    pub(crate) fn curve(&self, reading: &Reading) -> Option<Segment> {
        match self.course(reading) {
            Course::Line => Some(self.chord()),
            Course::Arc(arc) => Some(Segment::Arc(arc)),
            Course::OffRadius { .. } | Course::NoRadius => None,
        }
    }

    /// The same; the chord where an arc leads nowhere.
    pub(crate) fn segment(&self, reading: &Reading) -> Segment {
        self.curve(reading).unwrap_or_else(|| self.chord())
    }

    pub(super) fn chord(&self) -> Segment {
        Segment::line(micrometres(self.from), micrometres(self.to))
    }

    /// What the machine does; its text and its contour are still to be said.
    pub(super) fn step(&self, ideal: Option<Segment>) -> Step {
        Step {
            kind: match self.motion {
                Motion::Rapid => Kind::Rapid,
                Motion::Line => Kind::Line,
                Motion::Clockwise | Motion::CounterClockwise => Kind::Arc,
            },
            end: micrometres(self.to),
            ideal,
            side: self.side,
            register: self.offset,
            is_relative: self.incremental,
            radius: match self.bend {
                Bend::Radius(nm) => Some(nm as f64 / 1e3),
                Bend::Center { .. } | Bend::Nothing => None,
            },
            ..Step::stop(Kind::Pause, micrometres(self.from))
        }
    }

    /// The same move from the zero of the plane.
    pub(crate) fn at_origin(self) -> Move {
        self.seen_from(self.from)
    }

    /// The same move with `place` as the zero of the plane.
    pub(crate) fn seen_from(self, place: Place) -> Move {
        self.shifted(apart([0, 0], place))
    }

    /// The same move elsewhere, with its centre.
    pub(crate) fn shifted(mut self, by: Place) -> Move {
        self.from = added(self.from, by);
        self.to = added(self.to, by);
        if let (false, Bend::Center { absolute, .. }) = (self.incremental, &mut self.bend) {
            *absolute = added(*absolute, by);
        }
        self
    }
}

/// I and J for a centre, as the program's arcs have them.
pub(crate) fn bend_about(center: Place, from: Place, incremental: bool, reading: &Reading) -> Bend {
    // An absolute centre counts from the start of the arc.
    let [i, j] = to_center(reading.rule(incremental), center, from, from);
    let absolute = if incremental { [0, 0] } else { center };
    Bend::Center { i, j, absolute }
}

/// I and J for a centre, nm, where absolute ones count from `zero`.
pub(crate) fn to_center(rule: CenterRule, center: Place, from: Place, zero: Place) -> Place {
    match rule {
        CenterRule::StartToCenter => apart(center, from),
        CenterRule::CenterToStart => apart(from, center),
        CenterRule::Absolute => apart(center, zero),
    }
}

pub(crate) fn micrometres(place: Place) -> Point {
    Point::new(place[0] as f64 / 1e3, place[1] as f64 / 1e3)
}

pub(crate) fn added(place: Place, by: Place) -> Place {
    [place[0].wrapping_add(by[0]), place[1].wrapping_add(by[1])]
}

/// From `b` to `a`.
pub(crate) fn apart(a: Place, b: Place) -> Place {
    [a[0].wrapping_sub(b[0]), a[1].wrapping_sub(b[1])]
}

/// A way in µm as nm.
pub(crate) fn nanometres(way: Vector) -> Place {
    [way.x, way.y].map(|um| (um * 1e3).round() as i64)
}

pub(crate) fn distance(a: Place, b: Place) -> f64 {
    let [x, y] = apart(a, b);
    (x as f64).hypot(y as f64)
}

/// Whether two places are one, within this many µm.
pub(super) fn meet(one: Place, other: Place, tolerance: f64) -> bool {
    distance(one, other) / 1e3 <= tolerance
}
