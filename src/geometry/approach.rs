//! How two segments lie relative to each other: where they meet, where they face each other, how
//! far they coincide.

use super::intersection::Meetings;
use super::{Arc, Few, Line, Locus, Point, Segment, Vector, cross};

/// Places where two segments face each other.
type Facing = Few<(Point, Point), 6>;

/// Two directions closer than this (sine of their angle) count as parallel, two centres closer than this share of the radius as one.
const PARALLEL: f64 = 1e-6;

/// The points that two segments have in common, except those of a stretch that they share.
pub(crate) fn meetings(a: &Segment, b: &Segment) -> Meetings {
    let met = Locus::of(a).meet(&Locus::of(b));
    met.into_iter()
        .filter(|&point| a.spans(point) && b.spans(point))
        .collect()
}

/// Pairs of points, one inside each segment, whose connection is perpendicular to both: every place where their
/// distance has a minimum, a maximum or a saddle. Where the distance is constant, the middle of that stretch.
pub(crate) fn facing(a: &Segment, b: &Segment) -> Facing {
    match (a, b) {
        (Segment::Line(one), Segment::Line(other)) => {
            facing_lines(one, other).into_iter().collect()
        }
        (Segment::Line(line), Segment::Arc(arc)) => facing_line_and_arc(line, arc),
        (Segment::Arc(arc), Segment::Line(line)) => facing_line_and_arc(line, arc)
            .into_iter()
            .map(|(p, q)| (q, p))
            .collect(),
        (Segment::Arc(one), Segment::Arc(other)) => facing_arcs(one, other),
    }
}

/// The length over which two segments of one kind coincide within `tolerance`, measured along `a`.
pub(crate) fn shared_length(a: &Segment, b: &Segment, tolerance: f64) -> f64 {
    let length = a.length();
    let shared = shared_stretches(a, b, tolerance);
    shared
        .into_iter()
        .map(|[from, to]| (to - from) * length)
        .sum()
}

/// The stretches over which two segments of one kind coincide within `tolerance`, as shares of `a`.
///
/// Each lies between the feet of the ends; all of it must lie within the tolerance.
pub(crate) fn shared_stretches(a: &Segment, b: &Segment, tolerance: f64) -> Few<[f64; 2], 3> {
    if std::mem::discriminant(a) != std::mem::discriminant(b) {
        return Few::default();
    }
    let foot = |point: Point| a.share_of(point).clamp(0.0, 1.0);
    let mut cuts = [0.0, foot(b.start()), foot(b.end()), 1.0];
    cuts.sort_by(f64::total_cmp);
    let lies_on = |share: f64| b.distance_to(a.point_at(share)) <= tolerance;
    let stretches = cuts.windows(2).filter(|cut| cut[1] > cut[0]);
    let shared = stretches.filter(|cut| {
        [0.0, 0.25, 0.5, 0.75, 1.0]
            .iter()
            .all(|t| lies_on(cut[0] + (cut[1] - cut[0]) * t))
    });
    shared.map(|cut| [cut[0], cut[1]]).collect()
}

/// Curvature of a segment at a point of it: positive where its centre lies in the direction `toward`.
pub(crate) fn curvature(segment: &Segment, at: Point, toward: Vector) -> f64 {
    match segment {
        Segment::Line(_) => 0.0,
        Segment::Arc(arc) => (arc.center - at).dot(&toward).signum() / arc.radius,
    }
}

/// The nearest point of a segment's line or circle, `None` where it lies outside the segment or at an end of it.
pub(crate) fn foot_inside(segment: &Segment, point: Point) -> Option<Point> {
    let share = segment.share_of(point);
    if share <= 0.0 || share >= 1.0 {
        return None;
    }
    match segment {
        Segment::Line(line) => Some(line.start + (line.end - line.start) * share),
        Segment::Arc(arc) => {
            Some(arc.center + (point - arc.center).try_normalize(1e-12 * arc.radius)? * arc.radius)
        }
    }
}

fn facing_lines(a: &Line, b: &Line) -> Option<(Point, Point)> {
    if cross(a.direction(), b.direction()).abs() > PARALLEL {
        return None;
    }
    let (from, to) = (a.share_of(b.start), a.share_of(b.end));
    let (low, high) = (from.min(to).max(0.0), from.max(to).min(1.0));
    if low >= high {
        return None;
    }
    let p = a.start + (a.end - a.start) * ((low + high) / 2.0);
    let share = b.share_of(p).clamp(0.0, 1.0);
    Some((p, b.start + (b.end - b.start) * share))
}

/// The point of an arc in a direction from its centre; `None` where the arc does not reach there.
pub(crate) fn reached(arc: &Arc, way: Vector) -> Option<Point> {
    let point = arc.center + way * arc.radius;
    arc.spans(point).then_some(point)
}

fn facing_line_and_arc(line: &Line, arc: &Arc) -> Facing {
    let share = line.share_of(arc.center);
    if !(0.0..=1.0).contains(&share) {
        return Facing::default();
    }
    let foot = line.start + (line.end - line.start) * share;
    let away = (foot - arc.center)
        .try_normalize(0.0)
        .unwrap_or_else(|| super::left_normal(line.direction()));
    [away, -away]
        .into_iter()
        .filter_map(|way| reached(arc, way))
        .map(|point| (foot, point))
        .collect()
}

fn facing_arcs(a: &Arc, b: &Arc) -> Facing {
    let between = b.center - a.center;
    let mut found = Facing::default();
    if between.norm() <= PARALLEL * a.radius.max(b.radius) {
        // Concentric: the distance is the same wherever both reach.
        let shares = [b.start, b.end].map(|end| a.share_of(end).clamp(0.0, 1.0));
        let mut cuts = [0.0, shares[0], shares[1], 1.0];
        cuts.sort_by(f64::total_cmp);
        for cut in cuts.windows(2).filter(|cut| cut[1] > cut[0]) {
            let p = a.point_at((cut[0] + cut[1]) / 2.0);
            let way = (p - a.center) / a.radius;
            found.extend(
                [way, -way]
                    .into_iter()
                    .filter_map(|way| reached(b, way))
                    .map(|q| (p, q)),
            );
        }
        return found;
    }
    let Some(axis) = between.try_normalize(0.0) else {
        return found;
    };
    for way in [axis, -axis] {
        if let Some(p) = reached(a, way) {
            found.extend(
                [axis, -axis]
                    .into_iter()
                    .filter_map(|way| reached(b, way))
                    .map(|q| (p, q)),
            );
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn line(a: [f64; 2], b: [f64; 2]) -> Segment {
        Segment::line(a.into(), b.into())
    }

    fn arc(center: [f64; 2], radius: f64, from: f64, sweep: f64) -> Segment {
        Segment::Arc(Arc::from_center(center.into(), radius, from, sweep))
    }

    #[test]
    fn segments_share_what_they_share() {
        let cases = [
            (line([0., 0.], [10., 0.]), line([4., 0.001], [6., 0.]), 2.0),
            (line([0., 0.], [10., 0.]), line([12., 0.], [6., 0.]), 4.0),
            (line([0., 0.], [10., 0.]), line([10., 0.], [12., 0.]), 0.0),
            (line([0., 0.], [10., 0.]), line([5., 0.], [5., 3.]), 0.0),
            (line([0., 0.], [10., 0.]), line([0., 0.], [10., 1.]), 0.0),
            (
                arc([0., 0.], 2.0, 0.0, PI),
                arc([0., 0.], 2.001, PI / 2.0, PI),
                PI,
            ),
            (
                arc([0., 0.], 2.0, 0.0, PI),
                arc([0.1, 0.], 2.0, 0.0, PI),
                0.0,
            ),
        ];
        for (a, b, expected) in cases {
            assert!(
                (shared_length(&a, &b, 0.005) - expected).abs() < 1e-6,
                "{a:?} {b:?}"
            );
        }
    }

    #[test]
    fn segments_face_each_other_where_both_are_perpendicular() {
        let cases = [
            (
                line([0., 0.], [10., 0.]),
                line([8., 1.], [2., 1.]),
                vec![1.0],
            ),
            (line([0., 0.], [1., 0.]), line([8., 1.], [2., 1.]), vec![]),
            (
                line([-5., 0.], [5., 0.]),
                arc([0., 3.], 1.0, 0.0, 2.0 * PI),
                vec![2.0, 4.0],
            ),
            (
                arc([0., 0.], 1.0, 0.0, 2.0 * PI),
                arc([5., 0.], 1.0, 0.0, 2.0 * PI),
                vec![3.0, 5.0, 5.0, 7.0],
            ),
            (
                arc([0., 0.], 1.0, 0.0, 1.0),
                arc([0., 0.], 1.5, 0.2, 0.5),
                vec![0.5],
            ),
        ];
        for (a, b, expected) in cases {
            let mut widths: Vec<f64> = facing(&a, &b).iter().map(|(p, q)| (p - q).norm()).collect();
            widths.sort_by(f64::total_cmp);
            assert_eq!(widths.len(), expected.len(), "{a:?} {b:?} {widths:?}");
            assert!(
                widths
                    .iter()
                    .zip(&expected)
                    .all(|(w, e)| (w - e).abs() < 1e-9),
                "{widths:?}"
            );
        }
    }
}
