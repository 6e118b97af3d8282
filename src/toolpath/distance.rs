//! How near two segments come to each other.

use crate::geometry::{
    Arc, Line, Point, Segment, circle_circle, left_normal, line_circle, line_line, reached,
};

/// Smallest distance between two segments, 0 where they cross or touch.
pub(super) fn distance_between(a: &Segment, b: &Segment) -> f64 {
    let ends = a
        .distance_to(b.start())
        .min(a.distance_to(b.end()))
        .min(b.distance_to(a.start()))
        .min(b.distance_to(a.end()));
    ends.min(match (a, b) {
        (Segment::Line(a), Segment::Line(b)) => between_lines(a, b),
        (Segment::Line(line), Segment::Arc(arc)) | (Segment::Arc(arc), Segment::Line(line)) => {
            between_line_and_arc(line, arc)
        }
        (Segment::Arc(a), Segment::Arc(b)) => between_arcs(a, b),
    })
}

fn between_lines(a: &Line, b: &Line) -> f64 {
    let within = |share: f64| (0.0..=1.0).contains(&share);
    let crossing = line_line(a.start, a.end - a.start, b.start, b.end - b.start);
    match crossing {
        Some(point) if within(a.share_of(point)) && within(b.share_of(point)) => 0.0,
        _ => f64::INFINITY,
    }
}

fn between_line_and_arc(line: &Line, arc: &Arc) -> f64 {
    let along = line.end - line.start;
    let within = |share: f64| (0.0..=1.0).contains(&share);
    let crosses = |&point: &Point| within(line.share_of(point)) && arc.spans(point);
    if line_circle(line.start, along, arc.center, arc.radius)
        .iter()
        .any(crosses)
    {
        return 0.0;
    }
    let share = line.share_of(arc.center);
    let foot = line.start + along * share;
    if within(share) && arc.spans(foot) {
        arc.rise_of(foot).abs()
    } else {
        f64::INFINITY
    }
}

fn between_arcs(a: &Arc, b: &Arc) -> f64 {
    let crosses = |&point: &Point| a.spans(point) && b.spans(point);
    if circle_circle(a.center, a.radius, b.center, b.radius)
        .iter()
        .any(crosses)
    {
        return 0.0;
    }
    // The nearest inner points of two circles lie on the line of their centres.
    let Some(axis) = (b.center - a.center).try_normalize(0.0) else {
        return f64::INFINITY;
    };
    let mut nearest = f64::INFINITY;
    for (on_a, on_b) in [(axis, axis), (axis, -axis), (-axis, axis), (-axis, -axis)] {
        if let (Some(p), Some(q)) = (reached(a, on_a), reached(b, on_b)) {
            nearest = nearest.min((p - q).norm());
        }
    }
    nearest
}

/// True where two segments are seen to be at least `distance` apart by what carries one of them, at less cost than their distance. False
/// says nothing.
pub(super) fn are_apart(a: &Segment, b: &Segment, distance: f64) -> bool {
    keeps_off(a, b, distance)
        || keeps_off(b, a, distance)
        || lies_beyond(a, b, distance)
        || lies_beyond(b, a, distance)
        || lies_behind(a, b, distance)
        || lies_behind(b, a, distance)
}

/// True where `segment` is a line, and `other` lies beyond one of its ends, which is then the point
/// of the line nearest to all of `other`, and keeps the distance from it. The wall of a round
/// corner that the path comes out of lies like that.
fn lies_beyond(segment: &Segment, other: &Segment, distance: f64) -> bool {
    let Segment::Line(line) = segment else {
        return false;
    };
    let along = line.end - line.start;
    let ends = [(line.end, along), (line.start, -along)];
    ends.into_iter().any(|(end, way)| {
        let past = |point: Point| (point - end).dot(&way);
        let is_past = |round: &Arc| {
            let length = way.norm();
            let nearest = || round.center - way * (round.radius / length);
            !round.is_shallow()
                && (past(round.center) >= round.radius * length || !round.spans(nearest()))
        };
        past(other.start()) >= 0.0
            && past(other.end()) >= 0.0
            && other.as_arc().is_none_or(is_past)
            && other.distance_to(end) >= distance
    })
}

/// True where `segment` is an arc, and `other` lies behind it: nowhere further out than its radius less `distance`, in the direction of any
/// place of the arc. So lie the walls beside a corner that the wire rolls about.
fn lies_behind(segment: &Segment, other: &Segment, distance: f64) -> bool {
    let Segment::Arc(arc) = segment else {
        return false;
    };
    let ways = [arc.start, arc.end].map(|end| (end - arc.center) / arc.radius);
    // Every direction between two that are no more than 120° apart is the sum of them, times factors that are at least 0 and come to no
    // more than 2 together.
    let room = (arc.radius - distance) / 2.0;
    let is_narrow = arc.is_minor() && ways[0].dot(&ways[1]) >= -0.5;
    let is_shallow = |it: &Segment| it.as_arc().is_some_and(Arc::is_shallow);
    if !(is_narrow && room >= 0.0) || is_shallow(segment) || is_shallow(other) {
        return false;
    }
    ways.iter().all(|way| {
        let out = |point: Point| (point - arc.center).dot(way);
        out(other.start()) <= room
            && out(other.end()) <= room
            && other.as_arc().is_none_or(|round| {
                out(round.center) + round.radius <= room
                    || !round.spans(round.center + way * round.radius)
            })
    })
}

/// True where all of `segment` keeps a distance from the line or circle that carries `other`, on one side of it.
fn keeps_off(segment: &Segment, other: &Segment, distance: f64) -> bool {
    let is_shallow = |it: &Segment| it.as_arc().is_some_and(Arc::is_shallow);
    if is_shallow(segment) || is_shallow(other) {
        // The centre of what is nearly straight is not known well enough.
        return false;
    }
    match other {
        Segment::Line(line) => keeps_off_line(segment, line, distance),
        Segment::Arc(circle) => keeps_off_circle(segment, circle, distance),
    }
}

fn keeps_off_line(segment: &Segment, line: &Line, distance: f64) -> bool {
    // All of it times the length of the line.
    let normal = left_normal(line.end - line.start);
    let rise = |point: Point| normal.dot(&(point - line.start));
    let (start, end) = (rise(segment.start()), rise(segment.end()));
    let sense = start.signum();
    let (least, squared) = ((start * sense).min(end * sense), normal.norm_squared());
    if least <= 0.0 || squared == 0.0 || least * least < distance * distance * squared {
        return false;
    }
    let Segment::Arc(arc) = segment else {
        return true;
    };
    // Between its ends it comes nearest where it is square to the line, beyond its centre.
    let length = squared.sqrt();
    let top = arc.center - normal * (sense * arc.radius / length);
    rise(top) * sense >= distance * length || !arc.spans(top)
}

fn keeps_off_circle(segment: &Segment, circle: &Arc, distance: f64) -> bool {
    let away = |point: Point| (point - circle.center).norm_squared();
    let (start, end) = (away(segment.start()), away(segment.end()));
    let (near, far) = (circle.radius - distance, circle.radius + distance);
    let is_beyond = start > circle.radius * circle.radius;
    let is_off = |squared: f64| match is_beyond {
        true => squared >= far * far,
        false => near >= 0.0 && squared <= near * near,
    };
    if !is_off(start) || !is_off(end) {
        return false;
    }
    match segment {
        Segment::Line(line) => !is_beyond || line.distance_to(circle.center) >= far,
        Segment::Arc(arc) => {
            // Between its ends it comes nearest, or farthest, on the line of the two centres.
            let between = arc.center - circle.center;
            let apart = between.norm();
            let (nearest, farthest) = ((apart - arc.radius).abs(), apart + arc.radius);
            let is_all_off = match is_beyond {
                true => nearest >= far,
                false => farthest <= near,
            };
            let reach = between * (arc.radius / apart);
            let is_off_at = |top: Point| !arc.spans(top) || is_off(away(top));
            is_all_off
                || apart == 0.0
                || is_off_at(arc.center + reach) && is_off_at(arc.center - reach)
        }
    }
}
