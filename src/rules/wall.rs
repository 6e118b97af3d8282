//! One segment of a contour as the rules on pairs see it, with its neighbours.

use super::{NEIGHBOURS, Outlook};
use crate::drawing::ContourSegment;
use crate::finding::Side;
use crate::geometry::{Few, Point, Segment, Vector, cross};
use std::f64::consts::{FRAC_PI_2, PI};

/// Two segments that turn by less than this (radians) are one wall.
const SMOOTH: f64 = 1e-6;

/// A segment of a contour in the contour's direction of travel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wall<'a> {
    pub(crate) outlook: Outlook<'a>,
    pub(crate) index: usize,
    pub(crate) segment: ContourSegment,
    /// The segment before it.
    pub(crate) before: Option<Segment>,
    /// The cosine and the sine of the angle by which the contour turns between the two; both 0 beside a line without length.
    turned: Option<Vector>,
}

/// A vertex of a contour: where one segment ends and the next begins. One of the two is missing at the end of an open
/// contour.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    pub(crate) at: Point,
    pub(crate) incoming: Option<Segment>,
    pub(crate) outgoing: Option<Segment>,
}

impl<'a> Wall<'a> {
    pub(crate) fn new(outlook: &Outlook<'a>, index: usize) -> Option<Wall<'a>> {
        let before = outlook.segment(index as isize - 1);
        let before = before.map(|segment| segment.geometry);
        let segment = outlook.segment(index as isize)?;
        Some(Wall::behind(before, outlook, index, segment))
    }

    /// Whether it is the first segment of its entity that counts, in the entity's own direction; and the last.
    pub(super) fn is_at_start(&self) -> bool {
        let contour = self.outlook.contour;
        let starts = |(first, last)| self.index == if self.segment.reversed { last } else { first };
        match contour.leaves_out() {
            false => self.segment.segment == 0,
            true => contour.ends_of_piece(self.index).is_some_and(starts),
        }
    }

    pub(super) fn is_at_end(&self) -> bool {
        let ends = self.outlook.contour.ends_of_piece(self.index);
        ends.is_some_and(|(first, last)| {
            self.index == if self.segment.reversed { first } else { last }
        })
    }

    /// True for one of several entities that make a closed contour, which is open without it.
    pub(super) fn is_edge(&self) -> bool {
        self.outlook.contour.closed && self.outlook.contour.pieces.len() > 1
    }

    /// The segment at an index after the one before it, both of which are known.
    pub(crate) fn behind(
        before: Option<Segment>,
        outlook: &Outlook<'a>,
        index: usize,
        segment: ContourSegment,
    ) -> Wall<'a> {
        let starts = segment.geometry.start_tangent();
        let turned = |before: Segment| {
            let ends = before.end_tangent();
            Vector::new(ends.dot(&starts), cross(ends, starts))
        };
        Wall {
            outlook: *outlook,
            index,
            segment,
            before,
            turned: before.map(turned),
        }
    }

    /// The angle by which the contour turns where the segment starts.
    fn turn(&self) -> Option<f64> {
        self.turned.map(|turned| turned.y.atan2(turned.x))
    }

    /// True where the segment goes on from the one before it without a corner that counts.
    pub(crate) fn starts_smoothly(&self) -> bool {
        self.turned
            .is_some_and(|turned| turned.y.abs() <= SMOOTH * turned.x)
    }

    /// True where the segment starts at a corner that counts and turns away from the given side.
    pub(crate) fn starts_in_tip(&self, side: Side) -> bool {
        !self.starts_smoothly() && self.turn().is_some_and(|turn| turn * side.sign() < -SMOOTH)
    }

    pub(crate) fn geometry(&self) -> &Segment {
        &self.segment.geometry
    }

    /// The segment `steps` further in the direction of travel.
    pub(crate) fn beside(&self, steps: isize) -> Option<Segment> {
        self.outlook
            .segment(self.index as isize + steps)
            .map(|segment| segment.geometry)
    }

    /// The start vertex of the segment, and its end vertex if no other segment starts there. So each vertex belongs to
    /// one segment.
    pub(crate) fn corners(&self) -> impl Iterator<Item = Corner> + use<> {
        let geometry = *self.geometry();
        let start = Corner {
            at: geometry.start(),
            incoming: self.before,
            outgoing: Some(geometry),
        };
        let is_last = !self.outlook.contour.closed && self.index + 1 == self.outlook.contour.len();
        let end = is_last.then(|| Corner {
            at: geometry.end(),
            incoming: Some(geometry),
            outgoing: None,
        });
        std::iter::once(start).chain(end)
    }

    /// The number of steps forward from this segment to `other` of the same contour; up to `NEIGHBOURS`.
    fn steps_to(&self, other: &Wall) -> Option<usize> {
        let count = self.outlook.contour.len();
        let steps = if self.outlook.contour.closed {
            (other.index + count - self.index) % count.max(1)
        } else {
            other.index.checked_sub(self.index)?
        };
        (1..=NEIGHBOURS).contains(&steps).then_some(steps)
    }
}

/// How two segments of one contour are connected.
#[derive(Clone, Debug, Default)]
pub(crate) struct Joints {
    /// The ends of the two that are one joint, or have only short segments between them.
    pub(crate) points: Few<Point, 4>,
    /// One directly follows the other, at one end only.
    pub(crate) neighbours: bool,
    /// The largest distance of two ends that are one joint.
    pub(crate) gap: f64,
}

impl Joints {
    /// The joints of two segments. The segments between them count as part of a joint where they are together no longer
    /// than `short`.
    pub(crate) fn of(one: &Wall, other: &Wall, same_contour: bool, short: f64) -> Joints {
        let mut joints = Joints::default();
        if !same_contour {
            return joints;
        }
        let mut direct = 0;
        for (from, to) in [(one, other), (other, one)] {
            let Some(steps) = from.steps_to(to) else {
                continue;
            };
            let mut between = 0.0;
            let is_short = |step| {
                between += from.beside(step).map_or(0.0, |segment| segment.length());
                between <= short
            };
            if (1..steps as isize).all(is_short) {
                joints
                    .points
                    .extend([from.geometry().end(), to.geometry().start()]);
                if steps == 1 {
                    let apart = to.geometry().start() - from.geometry().end();
                    joints.gap = joints.gap.max(apart.norm());
                    direct += 1;
                }
            }
        }
        joints.neighbours = direct == 1;
        joints
    }

    /// True when a point lies at a joint.
    pub(crate) fn are_at(&self, point: Point, tolerance: f64) -> bool {
        self.points
            .iter()
            .any(|joint| (joint - point).norm() <= tolerance)
    }
}

/// True for two segments of one contour of which one directly follows the other, at one end only, and that turn so
/// little together that they cannot come near each other again.
pub(crate) fn part_for_good(one: &Wall, other: &Wall, same_contour: bool) -> bool {
    same_contour && parting(one, other).is_some()
}

/// Two segments of one contour that part for good, in the order of travel.
pub(super) fn parting<'w, 'a>(
    one: &'w Wall<'a>,
    other: &'w Wall<'a>,
) -> Option<(&'w Wall<'a>, &'w Wall<'a>)> {
    let follows = |from: &Wall, to: &Wall| from.steps_to(to) == Some(1);
    let (before, behind) = match (follows(one, other), follows(other, one)) {
        (true, false) => (one, other),
        (false, true) => (other, one),
        _ => return None,
    };
    let sweep = |wall: &Wall| wall.geometry().as_arc().map_or(0.0, |arc| arc.sweep.abs());
    let swept = sweep(one) + sweep(other);
    // Most turn by less than a quarter turn at their joint.
    let turns_less = |most: f64| match behind.turned {
        Some(turned) if turned.x < 0.0 || most <= FRAC_PI_2 => {
            turned.y.atan2(turned.x).abs() < most
        }
        _ => true,
    };
    let most = 0.999 * PI - swept;
    (most > 0.0 && turns_less(most)).then_some((before, behind))
}

impl Corner {
    /// True at an end of an open contour.
    pub(crate) fn is_free_end(&self) -> bool {
        self.incoming.is_none() || self.outgoing.is_none()
    }

    /// True when no step along the contour brings the vertex nearer to what lies in the unit vector `direction` from
    /// it.
    pub(crate) fn is_nearest(&self, direction: Vector) -> bool {
        const ROUNDING: f64 = 1e-6;
        self.outgoing
            .is_none_or(|segment| direction.dot(&segment.start_tangent()) <= ROUNDING)
            && self
                .incoming
                .is_none_or(|segment| direction.dot(&segment.end_tangent()) >= -ROUNDING)
    }

    /// Side of travel on which `direction` leaves the vertex; `None` at an open end and at the tip of a spike.
    pub(crate) fn side(&self, direction: Vector) -> Option<Side> {
        let along = self.incoming?.end_tangent() + self.outgoing?.start_tangent();
        (along.norm() > 1e-6).then(|| side_of(along, direction))
    }
}

/// Side of `along` on which `direction` lies.
pub(crate) fn side_of(along: Vector, direction: Vector) -> Side {
    if cross(along, direction) > 0.0 {
        Side::Left
    } else {
        Side::Right
    }
}
