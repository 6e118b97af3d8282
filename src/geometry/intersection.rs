//! Where infinite lines and full circles meet. Tangent contact within rounding counts as one point.

use super::{Few, Point, Vector, cross};

/// Where two lines or circles meet.
pub(crate) type Meetings = Few<Point, 2>;

/// The point where the line through `p` along `u` meets the line through `q` along `v`.
/// `None` for parallel lines (the sine of their angle below 1e-12) and for a direction of length zero.
pub(crate) fn line_line(p: Point, u: Vector, q: Point, v: Vector) -> Option<Point> {
    let denominator = cross(u, v);
    if denominator.abs() <= 1e-12 * u.norm() * v.norm() {
        return None;
    }
    Some(p + u * (cross(q - p, v) / denominator))
}

/// The points where the line through `p` along `u` meets a circle, in the order of `u`.
///
/// A line that misses the circle by less than 1e-9 of its radius counts as touching and gives one point.
pub(crate) fn line_circle(p: Point, u: Vector, center: Point, radius: f64) -> Meetings {
    let Some(along) = u.try_normalize(0.0) else {
        return Meetings::default();
    };
    let to_center = center - p;
    let foot = p + along * to_center.dot(&along);
    let distance = cross(along, to_center).abs();
    let mut met = Meetings::default();
    match half_chord(distance, radius) {
        None => {}
        Some(0.0) => met.push(foot),
        Some(half) => met.extend([foot - along * half, foot + along * half]),
    }
    met
}

/// The points where two circles meet: none, one (touching within 1e-9 of the larger radius) or two,
/// first the one to the left of the way from `a` to `b`. Concentric circles give none.
pub(crate) fn circle_circle(a: Point, radius_a: f64, b: Point, radius_b: f64) -> Meetings {
    let between = b - a;
    let distance = between.norm();
    let mut met = Meetings::default();
    let Some(along) = between.try_normalize(1e-300) else {
        return met;
    };
    let offset =
        (distance * distance + (radius_a - radius_b) * (radius_a + radius_b)) / (2.0 * distance);
    let scale = radius_a.max(radius_b);
    let squared = (radius_a - offset) * (radius_a + offset);
    let foot = a + along * offset;
    if squared > 0.0 {
        let half = super::left_normal(along) * squared.sqrt();
        met.extend([foot + half, foot - half]);
        return met;
    }
    // Touching within rounding: the gap between the circles decides, not its square.
    let gap = (distance - radius_a - radius_b).max((radius_a - radius_b).abs() - distance);
    if squared == 0.0 || gap <= 1e-9 * scale {
        met.push(foot);
    }
    met
}

/// Half the chord that a circle cuts out of a line at `distance` from its centre.
fn half_chord(distance: f64, radius: f64) -> Option<f64> {
    let squared = (radius - distance) * (radius + distance);
    if squared >= 0.0 {
        return Some(squared.sqrt());
    }
    (distance - radius <= 1e-9 * radius).then_some(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_meet_once_or_are_parallel() {
        let (p, q) = (Point::new(0.0, 0.0), Point::new(2.0, -5.0));
        assert_eq!(
            line_line(p, Vector::x(), q, Vector::y()),
            Some(Point::new(2.0, 0.0))
        );
        assert_eq!(line_line(p, Vector::x(), q, Vector::x() * 3.0), None);
    }

    #[test]
    fn a_touching_line_gives_one_point() {
        assert_eq!(
            line_circle(Point::new(-5.0, 1.0), Vector::x(), Point::origin(), 1.0).len(),
            1
        );
        assert_eq!(
            line_circle(
                Point::new(-5.0, 1.0 + 1e-6),
                Vector::x(),
                Point::origin(),
                1.0
            )
            .len(),
            0
        );
        let two = line_circle(Point::new(-5.0, 0.0), Vector::x(), Point::origin(), 1.0);
        assert!(two[0].x < two[1].x);
    }

    #[test]
    fn circles_meet_on_both_sides() {
        let two = circle_circle(Point::origin(), 5.0, Point::new(6.0, 0.0), 5.0);
        assert!(
            (two[0] - Point::new(3.0, 4.0)).norm() < 1e-12
                && (two[1] - Point::new(3.0, -4.0)).norm() < 1e-12
        );
        assert_eq!(
            circle_circle(Point::origin(), 1.0, Point::new(2.0, 0.0), 1.0).len(),
            1
        );
        assert!(circle_circle(Point::origin(), 1.0, Point::origin(), 1.0).is_empty());
    }
}
