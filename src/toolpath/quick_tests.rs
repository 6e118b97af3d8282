//! What is seen at once of how a segment lies beside a wall.

use crate::geometry::{Line, Point, Segment, Vector, cross};

/// The middle of a segment, for an arc from its ends where these say it well.
pub(super) fn middle(segment: &Segment) -> Point {
    match segment {
        Segment::Arc(arc) if !arc.is_shallow() && arc.sweep.abs() < 3.0 => {
            let out = (arc.start - arc.center) + (arc.end - arc.center);
            let way = out.try_normalize(0.0);
            way.map_or(arc.center, |way| arc.center + way * arc.radius)
        }
        _ => segment.point_at(0.5),
    }
}

/// True when a segment is seen to run beside another of its kind, between so near and so far from it all along. False says nothing.
pub(super) fn runs_beside(segment: &Segment, wall: &Segment, [least, most]: [f64; 2]) -> bool {
    match (segment, wall) {
        (Segment::Line(segment), Segment::Line(wall)) => {
            // All of it times the length of the wall.
            let along = wall.end - wall.start;
            let squared = along.norm_squared();
            let (start, end) = (segment.start - wall.start, segment.end - wall.start);
            let is_over = |from: Vector| (0.0..=squared).contains(&along.dot(&from));
            let (first, last) = (cross(along, start), cross(along, end));
            let (nearest, farthest) = (
                (first * first).min(last * last),
                (first * first).max(last * last),
            );
            first * last > 0.0
                && nearest >= least * least * squared
                && farthest <= most * most * squared
                && is_over(start)
                && is_over(end)
        }
        (Segment::Arc(segment), Segment::Arc(wall)) => {
            let is_at = |radius: f64| (least..=most).contains(&(radius - wall.radius).abs());
            let is_near = |point: Point, end: Point| (point - end).norm_squared() <= most * most;
            let is_end = |end: Point| {
                is_at((end - wall.center).norm())
                    && (wall.spans(end) || is_near(end, wall.start) || is_near(end, wall.end))
            };
            segment.center == wall.center
                && !segment.is_shallow()
                && !wall.is_shallow()
                && wall.is_minor()
                && segment.sweep * wall.sweep > 0.0
                && segment.sweep.abs() <= wall.sweep.abs() + 1e-9
                && is_at(segment.radius)
                && is_end(segment.start)
                && is_end(segment.end)
        }
        _ => false,
    }
}

/// The corners of what a stretch of a raw element lies within, and its middle. `None` for an arc that turns too far.
fn hull(stretch: &Segment) -> Option<([Point; 3], Point)> {
    let (start, end) = (stretch.start(), stretch.end());
    match stretch {
        Segment::Line(_) => Some(([start, end, start], start + (end - start) * 0.5)),
        Segment::Arc(arc) if arc.sweep.abs() > 2.0 => None,
        Segment::Arc(arc) => {
            let half_way = middle(stretch);
            let out = half_way - arc.center;
            let apex = arc.center + out * (out.norm_squared() / out.dot(&(start - arc.center)));
            Some(([start, end, apex], half_way))
        }
    }
}

/// True when a stretch is seen to lie within `distance` of the place of a wall that is nearest to one of its ends, all but its ends nearer
/// than that: so it is at most corners. False says nothing.
pub(super) fn is_all_about_foot(stretch: &Segment, wall: &Segment, distance: f64) -> bool {
    let Some((corners, half_way)) = hull(stretch) else {
        return false;
    };
    let (least, most) = (distance * (1.0 - 1e-7), distance * (1.0 + 1e-9));
    let is_about = |foot: Point| {
        let is_within = |corner: &Point| (corner - foot).norm_squared() <= most * most;
        (half_way - foot).norm_squared() < least * least && corners.iter().all(is_within)
    };
    let ends = [corners[0], corners[1]].into_iter();
    let mut feet = ends.filter_map(|end| foot_of(wall, end));
    feet.any(is_about)
}

/// The place of a wall that is nearest to a point; `None` beside an arc that does not reach there.
fn foot_of(wall: &Segment, point: Point) -> Option<Point> {
    match wall {
        Segment::Line(line) => {
            let share = line.share_of(point).clamp(0.0, 1.0);
            Some(line.start + (line.end - line.start) * share)
        }
        Segment::Arc(arc) if arc.is_shallow() || !arc.spans(point) => None,
        Segment::Arc(arc) => {
            let out = (point - arc.center).try_normalize(0.0)?;
            Some(arc.center + out * arc.radius)
        }
    }
}

/// The same of the way along a raw element, from a place of it to one of its ends, about the place of a wall that is nearest to the first,
/// at less cost.
pub(super) fn is_rest_about_foot(
    raw: &Segment,
    [from, to]: [Point; 2],
    wall: &Segment,
    distance: f64,
) -> bool {
    // Nothing of it lies farther out than this.
    let apex = match raw {
        Segment::Line(line) => {
            let along = line.end - line.start;
            let is_on = (0.0..=along.norm_squared()).contains(&along.dot(&(from - line.start)));
            is_on.then(|| from + (to - from) * 0.5)
        }
        Segment::Arc(arc) => {
            let (out, last) = (from - arc.center, to - arc.center);
            let (squared, is_narrow) = (arc.radius * arc.radius, arc.sweep.abs() <= 2.0);
            let is_on = is_narrow && !arc.is_shallow() && arc.spans(from);
            is_on.then(|| arc.center + (out + last) * (squared / (squared + out.dot(&last))))
        }
    };
    let Some((apex, foot)) = apex.zip(foot_of(wall, from)) else {
        return false;
    };
    let is_within = |point: Point, most: f64| (point - foot).norm_squared() <= most * most;
    let most = distance * (1.0 + 1e-9);
    is_within(from, most) && is_within(to, most) && is_within(apex, distance * (1.0 - 2e-7))
}

/// True when a stretch is seen to lie within `distance` of a wall, all but its ends nearer than that. False says nothing.
///
/// The distance from a line is convex: it is nowhere larger than at the corners of what the stretch lies within. Beside an arc of no more than
/// a half turn these corners lie in its sector, which is convex, too: there only how far they are from the centre counts.
pub(super) fn is_all_within(stretch: &Segment, wall: &Segment, distance: f64) -> bool {
    let Some((corners, half_way)) = hull(stretch) else {
        return false;
    };
    let [start, end, apex] = corners;
    let most = distance * (1.0 + 1e-9);
    let is_within = |point: &Point| wall.distance_to(*point) <= most;
    if wall.distance_to(half_way) >= distance * (1.0 - 1e-7) || !corners.iter().all(is_within) {
        return false;
    }
    let Segment::Arc(arc) = wall else {
        return true;
    };
    let least = arc.radius - most;
    let sides = [(start, end), (end, apex), (apex, start)];
    let keeps_out = |&(start, end): &(Point, Point)| {
        least <= 0.0 || Line { start, end }.distance_to(arc.center) >= least
    };
    !arc.is_shallow()
        && arc.is_minor()
        && corners.iter().all(|corner| arc.spans(*corner))
        && sides.iter().all(keeps_out)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of lines and arcs cut at a place beside lines and arcs, from a fixed sequence: what is said to lie about a foot is nearer to the wall
    /// everywhere between its ends.
    #[test]
    fn what_is_seen_to_lie_about_a_foot_does() {
        let mut state = 11_u64;
        let mut number = || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 33) as f64 / (1_u64 << 31) as f64
        };
        let mut seen = 0;
        for _ in 0..200_000 {
            let mut segment = |size: f64| {
                let start = Point::new(number(), number());
                let way = Vector::new(number() - 0.5, number() - 0.5) * size;
                let bulge = if number() < 0.4 {
                    0.0
                } else {
                    1.6 * number() - 0.8
                };
                Segment::from_bulge(start, start + way, bulge)
            };
            let (raw, wall) = (segment(0.8), segment(2.0));
            let share = number();
            let (from, to) = (raw.point_at(share), if number() < 0.5 { 0.0 } else { 1.0 });
            let distance = wall.distance_to(from) * (1.0 + 1e-12);
            if !is_rest_about_foot(&raw, [from, raw.point_at(to)], &wall, distance) {
                continue;
            }
            seen += 1;
            for part in 1..20 {
                let at = raw.point_at(share + (to - share) * f64::from(part) / 20.0);
                assert!(
                    wall.distance_to(at) < distance,
                    "{raw:?} {wall:?} {share} {to}"
                );
            }
        }
        assert!(seen > 10_000, "{seen}");
    }
}
