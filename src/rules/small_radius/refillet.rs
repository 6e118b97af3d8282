//! The new arc of a run: where its centre lies, whether it fits, and how far it moves the contour.

use super::Travel;
use super::in_the_way::{InTheWay, Meets};
use crate::finding::NoFix;
use crate::geometry::Locus;
use crate::geometry::{Arc, Point, Segment, positive_angle};
use crate::rules::Limits;
use rustc_hash::FxHashMap;
use std::f64::consts::PI;
use std::ops::RangeInclusive;

/// How many segments at one end may be swallowed. Each must lie within the correction of the new arc, so only contours
/// of many tiny segments come near it.
const MOST_SWALLOWED: usize = 24;

/// One arc of the fix radius that replaces a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Replacement {
    /// Positions of the two neighbours that stay; everything between them goes.
    pub(crate) before: isize,
    pub(crate) after: isize,
    /// The new arc, travelled with the wire on its left; it starts on the one neighbour and ends on the other.
    pub(crate) arc: Arc,
    /// Number of arcs of the run.
    pub(crate) arcs: usize,
    /// Largest distance by which the contour moves.
    pub(crate) moved: f64,
}

/// Looks for the arc of radius `limits.fix_radius` that replaces `run`.
///
/// Its centre lies on two loci, one for each end: at a line the parallel, at an arc the concentric circle shifted to
/// the wire side, or the circle about the end vertex itself. A solution counts when its feet lie on the neighbours, it
/// turns by at most a half turn, and its disc keeps clear of the whole contour. Where none fits, short neighbours are
/// swallowed, as long as that moves the contour by no more than the correction.
pub(crate) fn refillet(
    travel: &Travel,
    run: &RangeInclusive<isize>,
    limits: &Limits,
) -> Result<Replacement, NoFix> {
    Search::new(travel, limits, run.clone()).search()
}

/// The arc at `position`, with its radius, made tangent to its neighbour at its end (or, with `at_end` false, at its
/// start). At the other end it is tangent too, or keeps the vertex. It may move the contour by any distance.
pub(crate) fn made_tangent(
    travel: &Travel,
    position: isize,
    at_end: bool,
    limits: &Limits,
) -> Vec<Replacement> {
    let (before, after) = (position - 1, position + 1);
    let (Some(one), Some(other), Some(Segment::Arc(old))) = (
        travel.segment(before).map(|place| place.geometry),
        travel.segment(after).map(|place| place.geometry),
        travel.segment(position).map(|place| place.geometry),
    ) else {
        return Vec::new();
    };
    let of_radius = Limits {
        fix_radius: old.radius,
        ..*limits
    };
    let search = Search::new(travel, &of_radius, position..=position);
    let mut found = Vec::new();
    for elsewhere in [Hold::Neighbour, Hold::Vertex] {
        let (at_start, at_end) = if at_end {
            (elsewhere, Hold::Neighbour)
        } else {
            (Hold::Neighbour, elsewhere)
        };
        // An arc held by a vertex must end where the neighbour does.
        for arc in search.arcs(&one, at_start, &other, at_end) {
            found.push(Replacement {
                before,
                after,
                arc,
                arcs: 1,
                moved: search.moved(&arc, before, after),
            });
        }
    }
    found
}

/// The arc of radius `limits.fix_radius` that rounds the corner between the segments at `before` and after it, which
/// turns to the left, and the largest distance by which the contour moves. `None` where it does not fit: its feet must lie on the two and its
/// disc keep clear of the contour.
pub(crate) fn corner_arc(travel: &Travel, before: isize, limits: &Limits) -> Option<(Arc, f64)> {
    let (one, other) = (
        travel.segment(before)?.geometry,
        travel.segment(before + 1)?.geometry,
    );
    let mut search = Search::new(travel, limits, before..=before);
    search.old_center = one.end();
    let mut arcs = search.arcs(&one, Hold::Neighbour, &other, Hold::Neighbour);
    arcs.sort_by(|a, b| {
        (a.center - one.end())
            .norm()
            .total_cmp(&(b.center - one.end()).norm())
    });
    let least = limits.tolerances.short;
    let leaves_enough = |arc: &Arc| {
        one.share_of(arc.start) * one.length() >= least
            && (1.0 - other.share_of(arc.end)) * other.length() >= least
    };
    let mut arcs = arcs.into_iter();
    let arc = arcs.find(|arc| leaves_enough(arc) && search.is_clear(arc, before, before + 1))?;
    Some((arc, search.moved(&arc, before, before + 1)))
}

/// What holds the new arc at one end.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Hold {
    /// Tangent to the neighbour.
    Neighbour,
    /// Through the neighbour's end.
    Vertex,
}

struct Search<'a> {
    travel: &'a Travel<'a>,
    limits: &'a Limits,
    run: RangeInclusive<isize>,
    /// The segments looked at so far, by position.
    seen: FxHashMap<isize, Option<Segment>>,
    in_the_way: InTheWay,
    /// Some disc met nothing but rounding.
    met_rounding: bool,
    would_seal: bool,
    /// Whether a neighbour may be left too short to cut, and whether one would have been.
    leaves_crumbs: bool,
    would_leave_crumb: bool,
    /// How far the disc may dip into the replaced segments.
    slack: f64,
    old_center: Point,
    arcs: usize,
}

impl<'a> Search<'a> {
    fn new(travel: &'a Travel<'a>, limits: &'a Limits, run: RangeInclusive<isize>) -> Search<'a> {
        let arcs = (run.end() - run.start() + 1) as usize;
        let slack = limits.tolerances.clearance;
        Search {
            travel,
            limits,
            run,
            seen: FxHashMap::default(),
            in_the_way: InTheWay::default(),
            met_rounding: false,
            would_seal: false,
            leaves_crumbs: true,
            would_leave_crumb: false,
            slack,
            old_center: Point::origin(),
            arcs,
        }
    }

    /// The arcs held this way at their two ends.
    fn arcs(&self, one: &Segment, at_start: Hold, other: &Segment, at_end: Hold) -> Vec<Arc> {
        let (Some(first), Some(second)) = (
            self.locus(one, one.end(), at_start),
            self.locus(other, other.start(), at_end),
        ) else {
            return Vec::new();
        };
        first
            .meet(&second)
            .into_iter()
            .filter_map(|center| self.arc_about(center, one, at_start, other, at_end))
            .collect()
    }

    fn search(&mut self) -> Result<Replacement, NoFix> {
        let (first, last) = (*self.run.start(), *self.run.end());
        let count = self.travel.len() as isize;
        let mut longest = 0.0;
        for position in self.run.clone() {
            if let Some(Segment::Arc(arc)) = self.look_at(position)
                && arc.length() >= longest
            {
                (longest, self.old_center) = (arc.length(), arc.center);
            }
        }
        if self.arcs as isize >= count {
            // A hole, or an outline of tight arcs only, has no neighbour to be tangent to.
            return Err(if self.travel.contour.closed {
                NoFix::NarrowSlot
            } else {
                NoFix::NoNeighbour
            });
        }
        if self.look_at(first - 1).is_none() || self.look_at(last + 1).is_none() {
            return Err(NoFix::NoNeighbour);
        }
        // First exactly. Then with the slack that a drawing rounded to three decimals needs: its fillets kink a little
        // at their ends, and the replaced segments may stick out by as much. A neighbour is swallowed if only a crumb
        // of it would be left.
        self.leaves_crumbs = false;
        let mut found = self.search_outward(first, last, count);
        if found.is_none() && self.met_rounding {
            self.slack = self.limits.tolerances.arc_fit;
            found = self.search_outward(first, last, count);
        }
        found.ok_or(match () {
            () if self.would_leave_crumb => NoFix::ShortSegment,
            () if self.would_seal => NoFix::SealsContour,
            () => NoFix::NarrowSlot,
        })
    }

    /// Tries the neighbours themselves, then swallows one more segment at either end each time.
    fn search_outward(&mut self, first: isize, last: isize, count: isize) -> Option<Replacement> {
        let (before, after) = (self.reach(first - 1, -1), self.reach(last + 1, 1));
        for swallowed in 0..=before + after {
            for left in swallowed.saturating_sub(after)..=swallowed.min(before) {
                let (one, other) = (
                    first - 1 - left as isize,
                    last + 1 + (swallowed - left) as isize,
                );
                // Both neighbours may be one and the same segment, but may not pass each other.
                if other - one > count {
                    continue;
                }
                if let Some(found) = self.best(one, other, swallowed > 0) {
                    return Some(found);
                }
            }
        }
        None
    }

    /// How many segments from `position` on may be swallowed in the direction `step`: their length is bounded by that
    /// of a detour round the disc.
    fn reach(&mut self, position: isize, step: isize) -> usize {
        let most = 4.0 * (self.limits.fix_radius + self.limits.correction);
        let mut length = 0.0;
        for swallowed in 0..MOST_SWALLOWED {
            let at = position + step * swallowed as isize;
            let (Some(segment), Some(_)) = (self.look_at(at), self.look_at(at + step)) else {
                return swallowed;
            };
            length += segment.length();
            if length > most {
                return swallowed;
            }
        }
        MOST_SWALLOWED
    }

    /// The segment at a position.
    fn look_at(&mut self, position: isize) -> Option<Segment> {
        if let Some(seen) = self.seen.get(&position) {
            return *seen;
        }
        let segment = self.travel.segment(position).map(|place| place.geometry);
        self.seen.insert(position, segment);
        segment
    }

    /// The valid replacement between two neighbours that lies nearest to the old arc.
    fn best(&mut self, before: isize, after: isize, swallows: bool) -> Option<Replacement> {
        let (one, other) = (self.look_at(before)?, self.look_at(after)?);
        let mut candidates = Vec::new();
        for at_start in [Hold::Neighbour, Hold::Vertex] {
            for at_end in [Hold::Neighbour, Hold::Vertex] {
                let (Some(first), Some(second)) = (
                    self.locus(&one, one.end(), at_start),
                    self.locus(&other, other.start(), at_end),
                ) else {
                    continue;
                };
                let vertices = [at_start, at_end]
                    .iter()
                    .filter(|&&hold| hold == Hold::Vertex)
                    .count();
                for center in first.meet(&second) {
                    // Where both neighbours are one segment, its two ends must not be cut off past each other.
                    let same = (after - before) as usize == self.travel.len();
                    if let Some(arc) = self.arc_about(center, &one, at_start, &other, at_end)
                        && !(same && one.share_of(arc.start) <= one.share_of(arc.end))
                    {
                        candidates.push(((center - self.old_center).norm(), vertices, arc));
                    }
                }
            }
        }
        // Of solutions that agree within rounding the tangent one wins: a fillet with noise at its
        // ends is not a notch.
        let noise = self.limits.tolerances.arc_fit;
        candidates.sort_by(|a, b| {
            if (a.0 - b.0).abs() <= noise {
                a.1.cmp(&b.1).then(a.0.total_cmp(&b.0))
            } else {
                a.0.total_cmp(&b.0)
            }
        });
        for (_, _, arc) in candidates {
            if !self.is_clear(&arc, before, after) {
                continue;
            }
            if !self.leaves_crumbs && self.is_crumb(&arc, &one, &other) {
                self.would_leave_crumb = true;
                continue;
            }
            let moved = self.moved(&arc, before, after);
            if swallows && moved > self.limits.correction {
                self.would_seal = true;
                continue;
            }
            return Some(Replacement {
                before,
                after,
                arc,
                arcs: self.arcs,
                moved,
            });
        }
        None
    }

    /// Where the centre may lie so that the new arc is held by a neighbour, or by the vertex at its end.
    fn locus(&self, neighbour: &Segment, vertex: Point, hold: Hold) -> Option<Locus> {
        let radius = self.limits.fix_radius;
        match hold {
            Hold::Vertex => Some(Locus::about(vertex, radius)),
            Hold::Neighbour => {
                Locus::beside(neighbour, 1.0, radius, self.limits.tolerances.zero_length)
            }
        }
    }

    /// The arc about `center` from its foot on one neighbour to that on the other, if the feet lie on them and it turns
    /// to the left by at most a half turn.
    fn arc_about(
        &self,
        center: Point,
        one: &Segment,
        at_start: Hold,
        other: &Segment,
        at_end: Hold,
    ) -> Option<Arc> {
        let start = match at_start {
            Hold::Vertex => one.end(),
            Hold::Neighbour => self.foot(center, one, true)?,
        };
        let end = match at_end {
            Hold::Vertex => other.start(),
            Hold::Neighbour => self.foot(center, other, false)?,
        };
        let angle = |point: Point| (point.y - center.y).atan2(point.x - center.x);
        let sweep = positive_angle(angle(end) - angle(start));
        if !(1e-9..=PI + 1e-6).contains(&sweep) {
            return None;
        }
        Some(Arc {
            center,
            radius: self.limits.fix_radius,
            start_angle: angle(start),
            sweep,
            start,
            end,
        })
    }

    /// The point of a neighbour nearest to `center`, if it lies on it. At the end towards the run it may lie beyond by
    /// rounding noise: the neighbour is then lengthened by as much.
    fn foot(&self, center: Point, neighbour: &Segment, run_behind: bool) -> Option<Point> {
        let share = neighbour.share_of(center);
        let length = neighbour.length();
        let noise = self.limits.tolerances.arc_fit / length;
        let least = self.limits.tolerances.zero_length / length;
        let (low, high) = if run_behind {
            (least, 1.0 + noise)
        } else {
            (-noise, 1.0 - least)
        };
        if !(low..=high).contains(&share) {
            return None;
        }
        Some(match neighbour {
            Segment::Line(line) => line.start + (line.end - line.start) * share,
            Segment::Arc(arc) => arc.center + (center - arc.center).normalize() * arc.radius,
        })
    }

    /// True when the new arc leaves a neighbour too short to cut that was long enough before.
    fn is_crumb(&self, arc: &Arc, one: &Segment, other: &Segment) -> bool {
        let short = self.limits.tolerances.short;
        let left = |segment: &Segment, share: f64| {
            segment.length() >= short && share * segment.length() < short
        };
        let (from, to) = (one.share_of(arc.start), other.share_of(arc.end));
        if one == other {
            return left(one, from - to);
        }
        left(one, from)
            || left(other, 1.0 - to)
            || (arc.length() < short && self.arcs_length() >= short)
    }

    /// The length of the arcs that are replaced.
    fn arcs_length(&self) -> f64 {
        self.run
            .clone()
            .filter_map(|position| self.travel.segment(position))
            .map(|place| place.geometry.length())
            .sum()
    }

    /// True when the disc of the new arc keeps clear of the contour. Replaced segments may come as near as the slack.
    fn is_clear(&mut self, arc: &Arc, before: isize, after: isize) -> bool {
        let tolerances = &self.limits.tolerances;
        let met = self
            .in_the_way
            .met_by(arc, self.travel, tolerances, [before, after]);
        self.met_rounding |= met == Meets::Rounding;
        match met {
            Meets::Nothing => true,
            Meets::Rounding => self.slack > tolerances.clearance,
            Meets::Something => false,
        }
    }

    /// Largest distance of the replaced part, with the cut-off ends of the neighbours, from the new arc.
    fn moved(&self, arc: &Arc, before: isize, after: isize) -> f64 {
        let mut moved: f64 = 0.0;
        for position in before..=after {
            let Some(segment) = self.travel.segment(position) else {
                continue;
            };
            let whole = segment.geometry;
            let gone = match position {
                p if p == before => whole.part(whole.share_of(arc.start).clamp(0.0, 1.0), 1.0),
                p if p == after => whole.part(0.0, whole.share_of(arc.end).clamp(0.0, 1.0)),
                _ => whole,
            };
            moved = farthest(&gone, arc.center)
                .into_iter()
                .map(|point| arc.distance_to(point))
                .fold(moved, f64::max);
        }
        moved
    }
}

/// Points of a segment that include the farthest from the new arc: its ends, its middle and, on an arc, the place
/// farthest from the new centre.
fn farthest(segment: &Segment, center: Point) -> Vec<Point> {
    let mut points = vec![
        segment.start(),
        segment.point_at(0.25),
        segment.point_at(0.5),
        segment.point_at(0.75),
        segment.end(),
    ];
    if let Segment::Arc(arc) = segment
        && let Some(away) = (arc.center - center).try_normalize(1e-12)
    {
        let point = arc.center + away * arc.radius;
        if (0.0..=1.0).contains(&arc.share_of(point)) {
            points.push(point);
        }
    }
    points
}
