//! `self-intersection`: a contour crosses or touches itself or another one.
//!
//! The offset of such an outline is not one path: the wire cuts into the part, or cuts a piece of it off. A crossing is
//! an error. Touching is an error too between closed outlines; where an open contour ends on another one, as a drawn
//! lead-in does, it is a warning. What is cut on the line, as a slit is, may begin at a contour or cross it: that is said
//! as an information. Segments that run along each other are `overlap`.

use super::wall::{Corner, Joints, Wall};
use super::{PairObservation, PairRule};
use crate::finding::{Detail, Rule, Severity};
use crate::geometry::{
    Few, Point, Segment, Vector, cross, facing, foot_inside, meetings, positive_angle,
    shared_length,
};

pub(crate) const RULE: PairRule = PairRule {
    rule: Rule::SelfIntersection,
    reach: |limits| limits.tolerances.touch,
    check: |one, other, same_contour| {
        // Slots that meet are one cavity, and one that touches a wall cuts into it.
        let middles = [one, other].map(|wall| wall.outlook.is_middle());
        let lines = [one, other].map(|wall| wall.outlook.on_line);
        if middles == [true, true] || lines == [true, true] {
            return Vec::new();
        }
        let is_outline = |wall: &Wall| wall.outlook.contour.closed || wall.outlook.is_middle();
        let both_closed = is_outline(one) && is_outline(other);
        let observation = |contact: Contact| PairObservation {
            mildest: match lines {
                [false, false] => (contact.touches && !both_closed).then_some(Severity::Warning),
                _ => Some(Severity::Information),
            },
            ..PairObservation::default()
        };
        contact(one, other, same_contour)
            .map(observation)
            .into_iter()
            .collect()
    },
    detail: |one, other, same_contour| {
        let Contact { at, touches } = contact(one, other, same_contour)?;
        Some(Detail::SelfIntersection {
            at,
            touches,
            count: 1,
            on_line: one.outlook.on_line || other.outlook.on_line,
        })
    },
    silent_for_doubles: true,
    silent_where_they_part: true,
    ..PairRule::PLAIN
};

#[derive(Clone, Copy, Debug, PartialEq)]
struct Contact {
    at: Point,
    touches: bool,
}

/// Where two segments cross, else where they touch, apart from their joints.
///
/// A vertex that lies on the other segment within the touch tolerance belongs to the segment that starts in it, so that
/// one pair reports each place. The sides that the contour comes from and goes to decide whether it crosses there.
fn contact(one: &Wall, other: &Wall, same_contour: bool) -> Option<Contact> {
    let tolerances = &one.outlook.limits.tolerances;
    let (a, b) = (one.geometry(), other.geometry());
    if a.length() <= tolerances.zero_length || b.length() <= tolerances.zero_length {
        return None;
    }
    let joints = Joints::of(one, other, same_contour, tolerances.certain);
    // Ends that are joined from farther apart may reach past each other.
    let about_joint = match joints.gap > tolerances.certain {
        true => tolerances.join,
        false => tolerances.certain,
    };
    if shared_length(a, b, tolerances.same_place) > tolerances.same_place {
        return None;
    }
    let near = Near {
        a,
        b,
        touch: tolerances.touch,
        same_place: tolerances.same_place,
    };
    let at_joint = |point: Point| joints.are_at(point, about_joint);
    // Where the two come this near without crossing, another contact close by is not a separate
    // one.
    let ends_of = |ends: &Segment, on: Segment| {
        [ends.start(), ends.end()]
            .into_iter()
            .filter(move |&end| on.distance_to(end) <= tolerances.touch)
    };
    let tangential: Few<Point, 6> = match (a, b) {
        (Segment::Line(_), Segment::Line(_)) => Few::default(),
        _ => facing(a, b)
            .into_iter()
            .filter(|(p, q)| (p - q).norm() <= near.touch)
            .map(|(p, _)| p)
            .collect(),
    };
    let mut anchors: Few<Point, 14> = ends_of(a, *b).chain(ends_of(b, *a)).collect();
    anchors.extend(joints.points.iter().copied());
    anchors.extend(tangential.iter().copied());
    if let Some(at) = meetings(a, b).into_iter().find(|&point| {
        !at_joint(point) && !anchors.iter().any(|&anchor| near.all_along(point, anchor))
    }) {
        return Some(Contact { at, touches: false });
    }
    let mut touch = None;
    for (mine, theirs, on) in [(one, other, b), (other, one, a)] {
        for corner in mine.corners() {
            if at_joint(corner.at) || on.distance_to(corner.at) > near.touch {
                continue;
            }
            let meets = |vertex: Point| (vertex - corner.at).norm() <= near.touch;
            let contact = match theirs.corners().find(|corner| meets(corner.at)) {
                Some(met) => near.at_vertices(&corner, &met),
                // The vertex there belongs to the segment that follows.
                None if meets(on.start()) || meets(on.end()) => None,
                None => near.on_segment(&corner, on),
            };
            match contact {
                Some(contact) if !contact.touches => return Some(contact),
                contact => touch = touch.or(contact),
            }
        }
    }
    let touching_inside = || {
        tangential
            .iter()
            .copied()
            .find(|&point| !at_joint(point) && !near.is_at_end(point))
    };
    touch.or_else(|| {
        Some(Contact {
            at: touching_inside()?,
            touches: true,
        })
    })
}

/// Two segments, and the distance that counts as near.
struct Near<'a> {
    a: &'a Segment,
    b: &'a Segment,
    touch: f64,
    same_place: f64,
}

impl Near<'_> {
    /// True when the two touch all the way from `point` to `anchor`.
    fn all_along(&self, point: Point, anchor: Point) -> bool {
        let (from, to) = (
            self.a.share_of(point).clamp(0.0, 1.0),
            self.a.share_of(anchor).clamp(0.0, 1.0),
        );
        [0.25, 0.5, 0.75, 1.0]
            .iter()
            .all(|t| self.b.distance_to(self.a.point_at(from + (to - from) * t)) <= self.touch)
    }

    fn is_at_end(&self, point: Point) -> bool {
        [self.a.start(), self.a.end(), self.b.start(), self.b.end()]
            .iter()
            .any(|end| (end - point).norm() <= self.touch)
    }

    /// A point of a segment some way from one of its ends, far enough that rounding does not decide its side.
    fn some_way_from(&self, segment: &Segment, start: bool) -> Point {
        let share = (50.0 * self.touch / segment.length().max(f64::MIN_POSITIVE)).min(0.5);
        segment.point_at(if start { share } else { 1.0 - share })
    }

    fn runs_along(&self, segment: Option<Segment>, on: Option<Segment>) -> bool {
        let (Some(segment), Some(on)) = (segment, on) else {
            return false;
        };
        shared_length(&segment, &on, self.same_place) > self.same_place
    }

    /// A vertex on a segment, away from its ends.
    fn on_segment(&self, corner: &Corner, on: &Segment) -> Option<Contact> {
        if self.runs_along(corner.incoming, Some(*on))
            || self.runs_along(corner.outgoing, Some(*on))
        {
            return None;
        }
        let at = foot_inside(on, corner.at).unwrap_or(corner.at);
        let (Some(incoming), Some(outgoing)) = (corner.incoming, corner.outgoing) else {
            return Some(Contact { at, touches: true });
        };
        let (from, to) = (
            side(on, self.some_way_from(&incoming, false)),
            side(on, self.some_way_from(&outgoing, true)),
        );
        let crosses = from * to < 0.0 && from.abs().min(to.abs()) > self.touch;
        Some(Contact {
            at,
            touches: !crosses,
        })
    }

    /// A vertex on a vertex.
    fn at_vertices(&self, one: &Corner, other: &Corner) -> Option<Contact> {
        let open = |corner: &Corner| corner.incoming.is_none() || corner.outgoing.is_none();
        let along = [
            (one.incoming, other.incoming),
            (one.incoming, other.outgoing),
            (one.outgoing, other.incoming),
            (one.outgoing, other.outgoing),
        ];
        // Open ends that meet are left to chaining.
        if open(one) && open(other) || along.into_iter().any(|(a, b)| self.runs_along(a, b)) {
            return None;
        }
        let touches = Contact {
            at: one.at,
            touches: true,
        };
        let (Some(in_one), Some(out_one), Some(in_other), Some(out_other)) =
            (one.incoming, one.outgoing, other.incoming, other.outgoing)
        else {
            return Some(touches);
        };
        let angle = |point: Point, vertex: Point| {
            let way: Vector = point - vertex;
            way.y.atan2(way.x)
        };
        let from = angle(self.some_way_from(&in_one, false), one.at);
        let relative = |angle: f64| positive_angle(angle - from);
        let to = relative(angle(self.some_way_from(&out_one, true), one.at));
        let (in_other, out_other) = (
            self.some_way_from(&in_other, false),
            self.some_way_from(&out_other, true),
        );
        let within = |point: Point| relative(angle(point, other.at)) < to;
        Some(Contact {
            touches: within(in_other) == within(out_other),
            ..touches
        })
    }
}

/// Distance of a point from a segment's line or circle, positive to the left of travel.
fn side(segment: &Segment, point: Point) -> f64 {
    match segment {
        Segment::Line(line) => cross(line.direction(), point - line.start),
        Segment::Arc(arc) => (arc.radius - (point - arc.center).norm()) * arc.sweep.signum(),
    }
}
