//! `lost-pocket`, found at its mouth: a disc of the correction touches two walls and gets no further between them.
//!
//! The wire never cuts what lies beyond, along the contour from one wall to the other. A single sharp corner is such an
//! end too; `sharp-corner` says how much it leaves, R (1 / cos(θ/2) − 1). If more is left, it is an error whatever its
//! shape: the end of a tapering slot, a chamfer or chorded fillet smaller than the wire, a V between facing walls that
//! the wire cannot enter at all. An arc below the correction is `small-radius`, as long as that explains everything
//! that is left.

use super::arc_as_chords::are_between_chords;
use super::disc::{Touch, loci, slack, touch};
use super::sharp_corner::inner_side;
use super::wall::{Wall, parting};
use super::{Limits, NEIGHBOURS, Outlook, PairObservation, PairRule, small_radius};
use crate::finding::{Rule, Side};
use crate::geometry::{Point, Segment, cross, turn};
use std::f64::consts::FRAC_PI_2;

pub(crate) const RULE: PairRule = PairRule {
    rule: Rule::LostPocket,
    reach: |limits| 2.0 * limits.correction,
    check,
    // `left` accounts for what lies between the two.
    pair_by_pair: false,
    ..PairRule::PLAIN
};

/// Two facing walls are parallel up to this turn (radians): the normals of arcs with radii of
/// kilometres are not known any better.
const OPPOSITE: f64 = 1e-6;

/// A remainder below this, mm, may come from rounding the contour to three decimals.
const LEAST_MM: f64 = 5e-4;

/// The two walls of a corner face each other above this turn (radians).
const FACING: f64 = FRAC_PI_2 + 1e-3;

/// A disc of the correction that touches two walls of a contour, and what lies beyond it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DeadEnd {
    pub(crate) center: Point,
    radius: f64,
    side: Side,
    /// In the direction of travel, what lies beyond the disc runs from the first to the second.
    from: Touch,
    to: Touch,
    /// The number of segments from the first to the second.
    steps: usize,
}

/// What the wire leaves beyond a dead end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Left {
    /// The largest distance of the contour from what is cut.
    pub(crate) depth: f64,
    pub(crate) near: Point,
    /// The segment farthest from the wire.
    pub(crate) index: usize,
}

/// The disc that the wire's centre carries. The wire still follows an arc of the correction and a slot twice as wide.
fn radius(limits: &Limits) -> f64 {
    limits.correction - limits.tolerances.report
}

fn check(one: &Wall, other: &Wall, same_contour: bool) -> Vec<PairObservation> {
    let mut observations = Vec::new();
    let limits = one.outlook.limits;
    let radius = radius(limits);
    let is_small = radius <= limits.tolerances.touch;
    if !same_contour || one.outlook.on_line || is_small || run_on(one, other, radius) {
        return observations;
    }
    let parting = parting(one, other);
    for side in [Side::Left, Side::Right] {
        if parting.is_some_and(|(before, behind)| let_pass(before, behind, side, radius)) {
            continue;
        }
        let of_one = loci(one, side, radius);
        for locus in loci(other, side, radius).iter().flatten() {
            for center in of_one.iter().flatten().flat_map(|own| own.meet(locus)) {
                if let Some(end) = DeadEnd::between(one, other, side, center)
                    && end.is_clear_nearby(one, other)
                    && end.may_matter(&one.outlook)
                {
                    let disc = Some((center, radius));
                    observations.push(PairObservation {
                        sides: (Some(side), Some(side)),
                        disc,
                        own_disc: true,
                        mildest: None,
                    });
                }
            }
        }
    }
    observations
}

/// True for neighbours that part for good, where every disc on a side that touches both gets past
/// their joint: they meet without a corner, or both are straight. Only a tip at the start of the
/// first may still hold a disc against the second.
fn let_pass(before: &Wall, behind: &Wall, side: Side, radius: f64) -> bool {
    let limits = before.outlook.limits;
    let (first, second) = (before.geometry(), behind.geometry());
    let are_joined_lines = || {
        let is_line = |segment: &Segment| matches!(segment, Segment::Line(_));
        let gap = (second.start() - first.end()).norm();
        is_line(first) && is_line(second) && gap <= limits.tolerances.resolution
    };
    let is_far = || second.distance_to(first.start()) > 2.0 * (radius + slack(limits, radius));
    (behind.starts_smoothly() || are_joined_lines()) && (!before.starts_in_tip(side) || is_far())
}

/// Two lines may continue each other up to this turn (as the distance of unit vectors).
const RUNS_ON: f64 = 0.25;

/// True for two lines in the same direction, in line with each other and too far apart for one disc
/// to touch both: the places where a disc touches two walls are as far apart as the two normals
/// times its radius. Among many short lines most neighbours are like this.
fn run_on(one: &Wall, other: &Wall, radius: f64) -> bool {
    let (Segment::Line(line), Segment::Line(next)) = (one.geometry(), other.geometry()) else {
        return false;
    };
    let (along, length, next_length) = (
        line.end - line.start,
        one.geometry().length(),
        other.geometry().length(),
    );
    if length.min(next_length) <= one.outlook.limits.tolerances.zero_length {
        return false;
    }
    let along = along / length;
    let mut turned = ((next.end - next.start) / next_length - along).norm();
    if turned > RUNS_ON {
        return false;
    }
    // In its start vertex a wall is touched from any direction between its own normal and the normal of the wall
    // before.
    for wall in [one, other] {
        turned = turned.max(
            wall.before
                .map_or(0.0, |before| (before.end_tangent() - along).norm()),
        );
    }
    let count = one.outlook.contour.len();
    let are_neighbours = one.index.abs_diff(other.index) == 1
        || (one.outlook.contour.closed && one.index.abs_diff(other.index) + 1 == count);
    let gap = if are_neighbours {
        // Where they meet there is one corner.
        length.min(next_length) / 2.0
    } else {
        let reached = |point: Point| along.dot(&(point - line.start));
        let (start, end) = (reached(next.start), reached(next.end));
        (start.min(end) - length).max(-start.max(end))
    };
    let rounding = 4.0 * slack(one.outlook.limits, radius);
    turned <= RUNS_ON && 2.0 * turned * radius + rounding < gap
}

/// True when two segments, by their indices, both lie in or touch the part beyond a disc. In the
/// direction of travel that part runs from the first to the second of its walls; `count` is the
/// number of the contour's segments.
pub(crate) fn holds([from, to]: [usize; 2], count: usize, segments: [usize; 2]) -> bool {
    let along = |index: usize| (index + count - from) % count.max(1);
    segments.into_iter().all(|index| along(index) <= along(to))
}

impl DeadEnd {
    /// The end that a disc about `center` makes between two walls of a contour. `None` where it does not touch both,
    /// where it may pass, and for a single corner no deeper than its turn explains.
    pub(crate) fn between(one: &Wall, other: &Wall, side: Side, center: Point) -> Option<DeadEnd> {
        let (outlook, limits) = (&one.outlook, one.outlook.limits);
        let radius = radius(limits);
        let (first, second) = (
            touch(one, side, center, radius)?,
            touch(other, side, center, radius)?,
        );
        let spin = cross(first.normal, second.normal) * side.sign();
        // Walls exactly opposite each other let it pass.
        if spin.abs() < OPPOSITE {
            return None;
        }
        let (from, to) = if spin > 0.0 {
            (first, second)
        } else {
            (second, first)
        };
        let count = outlook.contour.len();
        let steps = if outlook.contour.closed {
            (to.index + count - from.index) % count
        } else {
            to.index.checked_sub(from.index)?
        };
        let end = DeadEnd {
            center,
            radius,
            side,
            from,
            to,
            steps,
        };
        match end.joints().count() {
            _ if end.is_at_one_joint(outlook) => None,
            0 => None,
            1 => (end.is_between_tips()
                && end
                    .joints()
                    .any(|joint| end.turn_at(outlook, joint) > FACING))
            .then_some(end),
            _ => Some(end),
        }
    }

    /// The segments whose starts are the joints between the two places that the disc touches.
    fn joints(&self) -> impl Iterator<Item = isize> + use<> {
        let first = self.from.index as isize + 1;
        first..first + (self.steps - usize::from(self.to.at_vertex && self.steps > 0)) as isize
    }

    /// The segments that lie wholly beyond the disc.
    fn segments(&self) -> impl Iterator<Item = isize> + use<> {
        let from = self.from.index as isize;
        from + isize::from(!self.from.at_vertex)..from + self.steps as isize
    }

    /// True where both places are at the same corner that turns away from the wire, so that the
    /// whole contour seems to lie beyond it: ends that miss each other by g let the disc touch the
    /// wall before the corner up to √(2 g r) away from it.
    fn is_at_one_joint(&self, outlook: &Outlook) -> bool {
        let before = (self.from.index + outlook.contour.len() - 1) % outlook.contour.len();
        if self.steps == 0 || !self.from.at_vertex || self.to.index != before {
            return false;
        }
        let [Some(before), Some(behind)] =
            [before, self.from.index].map(|index| outlook.segment(index as isize))
        else {
            return false;
        };
        let gap = (behind.geometry.start() - before.geometry.end()).norm();
        let apart = self.radius * (self.from.normal - self.to.normal).norm();
        apart * apart <= 8.0 * self.radius * (gap + slack(outlook.limits, self.radius))
    }

    fn is_between_tips(&self) -> bool {
        self.from.at_vertex && self.to.at_vertex
    }

    /// The turn (radians) towards the wire in the joint where a segment starts.
    fn turn_at(&self, outlook: &Outlook, joint: isize) -> f64 {
        let (Some(before), Some(behind)) = (outlook.segment(joint - 1), outlook.segment(joint))
        else {
            return 0.0;
        };
        turn(
            before.geometry.end_tangent(),
            behind.geometry.start_tangent(),
        ) * self.side.sign()
    }

    /// True when no segment near the two walls reaches into the disc.
    fn is_clear_nearby(&self, one: &Wall, other: &Wall) -> bool {
        let least = self.radius - slack(one.outlook.limits, self.radius);
        let reach = NEIGHBOURS as isize;
        let mut near = [one, other]
            .into_iter()
            .flat_map(|wall| (-reach..=reach).filter_map(|steps| wall.beside(steps)));
        near.all(|segment| segment.distance_to(self.center) >= least)
    }

    /// False where a look at a few segments shows that no more is left than in a single corner.
    fn may_matter(&self, outlook: &Outlook) -> bool {
        self.steps > NEIGHBOURS || self.is_more_than_a_corner(outlook, false)
    }

    /// The distance of a point from what the wire cuts with its centre here.
    fn depth(&self, point: Point) -> f64 {
        (point - self.center).norm() - self.radius
    }

    /// The two segments that the disc touches.
    pub(crate) fn walls(&self) -> [usize; 2] {
        [self.from.index, self.to.index]
    }

    /// Points beyond the disc; the deepest point is among them.
    fn points<'a>(&'a self, outlook: &'a Outlook) -> impl Iterator<Item = (isize, Point)> + 'a {
        let joints = self
            .joints()
            .filter_map(|joint| Some((joint, outlook.segment(joint)?.geometry.start())));
        let bellies = self.segments().filter_map(|index| {
            let Segment::Arc(arc) = outlook.segment(index)?.geometry else {
                return None;
            };
            let away = (arc.center - self.center).try_normalize(0.0)?;
            let point = arc.center + away * arc.radius;
            (0.0..=1.0)
                .contains(&arc.share_of(point))
                .then_some((index, point))
        });
        joints.chain(bellies)
    }

    /// What is left beyond the disc, where that is more than `sharp-corner` and `small-radius` explain.
    pub(crate) fn left(&self, outlook: &Outlook) -> Option<Left> {
        if !self.is_more_than_a_corner(outlook, true) {
            return None;
        }
        let rank = |index: isize| {
            let segment = outlook.segment(index)?;
            Some((outlook.drawing.rank(segment.entity), segment.segment))
        };
        let points: Vec<(isize, f64, Point)> = self
            .points(outlook)
            .map(|(at, point)| (at, self.depth(point), point))
            .collect();
        let depth = points.iter().map(|point| point.1).fold(0.0, f64::max);
        // The choice among equally deep points must not depend on where the contour begins or which way it runs.
        let named = |least: f64| move |value: &f64| *value >= least - 1e-9;
        let near = points
            .iter()
            .filter(|point| named(depth)(&point.1))
            .min_by_key(|point| rank(point.0))?
            .2;
        let missed = |index: isize| {
            outlook
                .segment(index)
                .map_or(0.0, |segment| segment.geometry.distance_to(self.center))
        };
        let most = self.segments().map(missed).fold(0.0, f64::max);
        let index = self
            .segments()
            .filter(|&index| named(most)(&missed(index)))
            .min_by_key(|&index| rank(index))?;
        Some(Left {
            depth,
            near,
            index: index as usize % outlook.contour.len().max(1),
        })
    }

    /// Whether more is left than the single corners and the arcs below the correction explain: a wall between two
    /// corners that the wire does not reach, or a corner deeper than its own turn explains. With `spares_chords`,
    /// joints between the chords of an arc that the wire can follow do not count as corners.
    fn is_more_than_a_corner(&self, outlook: &Outlook, spares_chords: bool) -> bool {
        let limits = outlook.limits;
        let least = LEAST_MM / limits.unit_mm;
        let told = |index: isize| {
            let segment = outlook.segment(index)?;
            small_radius::check(&segment, Some(self.side), limits).map(|told| told.stock_left)
        };
        let told = self
            .segments()
            .filter_map(told)
            .fold(None, |most: Option<f64>, stock| {
                Some(most.map_or(stock, |most| most.max(stock)))
            });
        let is_deeper = |depth: f64| {
            self.points(outlook)
                .any(|(_, point)| self.depth(point) > depth + least)
        };
        if let Some(told) = told {
            // A run holds only arcs that bend about the wire; `small-radius` mends it as one.
            let is_of_run = |index: isize| {
                let segment = outlook.segment(index).map(|segment| segment.geometry);
                segment.is_some_and(|segment| {
                    segment
                        .as_arc()
                        .is_some_and(|arc| arc.sweep * self.side.sign() > 0.0)
                })
            };
            return is_deeper(told) && !self.segments().all(is_of_run);
        }
        let corners = self.corners(outlook, spares_chords);
        let faces = |corner: &TurnedIn| corner.turn > FACING;
        if self.is_between_tips() && corners.iter().any(faces) && is_deeper(0.0) {
            return true;
        }
        let (Some(first), Some(last)) = (corners.first(), corners.last()) else {
            return false;
        };
        let is_missed = |index: isize| {
            let distance = outlook
                .segment(index)
                .map_or(0.0, |segment| segment.geometry.distance_to(self.center));
            distance - self.radius > least
        };
        let is_beyond = |corner: &TurnedIn| {
            let share = self.radius * (1.0 / (corner.turn / 2.0).cos() - 1.0);
            outlook
                .segment(corner.last)
                .is_some_and(|segment| self.depth(segment.geometry.start()) > share + least)
        };
        (first.last..last.first).any(is_missed)
            && corners
                .iter()
                .any(|corner| faces(corner) || is_beyond(corner))
    }

    /// The corners that turn towards the wire, in order. Joints with only crumbs between them are one corner.
    fn corners(&self, outlook: &Outlook, spares_chords: bool) -> Vec<TurnedIn> {
        let least = LEAST_MM / outlook.limits.unit_mm;
        let mut corners = Vec::new();
        let mut joints = self.joints().peekable();
        while let Some(first) = joints.next() {
            let mut last = first;
            let is_crumb = |index: isize| {
                let segment = outlook.segment(index);
                segment.is_some_and(|segment| segment.geometry.length() <= least)
            };
            while let Some(next) = joints.next_if(|_| is_crumb(last)) {
                last = next;
            }
            corners.extend(self.corner_at(outlook, [first, last], spares_chords));
        }
        corners
    }

    /// The corner between the segment before the first of some joints and the segment after the last, if it turns
    /// towards the wire.
    fn corner_at(
        &self,
        outlook: &Outlook,
        [first, last]: [isize; 2],
        spares_chords: bool,
    ) -> Option<TurnedIn> {
        let (before, behind) = (
            outlook.segment(first - 1)?.geometry,
            outlook.segment(last)?.geometry,
        );
        let turn = turn(before.end_tangent(), behind.start_tangent()) * self.side.sign();
        inner_side(turn).filter(|&side| side == Side::Left)?;
        if spares_chords
            && before.length().max(behind.length()) >= 2.0 * self.radius * (turn / 2.0).tan()
        {
            let index = first as usize % outlook.contour.len().max(1);
            if are_between_chords(outlook, index..index + 1).contains(&true) {
                return None;
            }
        }
        Some(TurnedIn { first, last, turn })
    }
}

/// A corner that turns towards the wire, by `turn` radians, between the joints where two segments start.
struct TurnedIn {
    first: isize,
    last: isize,
    turn: f64,
}
