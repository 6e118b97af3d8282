//! Which way round a closed outline runs.
//!
//! What the rules use is [`orientation`], the signed area with the arcs counted in. The two published methods stand beside it by
//! name, for comparison: both look at the vertices alone and are wrong on outlines that occur. Their tests show which.

use crate::geometry::{Point, Segment, cross};

/// A way round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Orientation {
    CounterClockwise,
    Clockwise,
}

impl Orientation {
    /// Counter-clockwise for a positive number, clockwise for a negative one, `None` for neither.
    fn of_sign(number: f64) -> Option<Orientation> {
        match number {
            n if n > 0.0 => Some(Orientation::CounterClockwise),
            n if n < 0.0 => Some(Orientation::Clockwise),
            _ => None,
        }
    }
}

/// The way round by the signed area, `Σ (x₀ y₁ − x₁ y₀) + Σ r² (sweep − sin sweep)`; `None` for an outline without area.
pub(crate) fn orientation(segments: &[Segment]) -> Option<Orientation> {
    let origin = segments.first()?.start();
    Orientation::of_sign(
        segments
            .iter()
            .map(|segment| segment.twice_area(origin))
            .sum(),
    )
}

/// The way round by counting left and right turns at the vertices, arcs taken as their chords; `None` for a tie.
///
/// Right for every polygon of at most five vertices. A polygon of six may tie (three corners out, three in), one of seven may have
/// more turns against its direction than with it. With arcs or with collinear vertices no count is safe.
pub(crate) fn orientation_by_turns(segments: &[Segment]) -> Option<Orientation> {
    let turns = around(segments).map(|[before, at, behind]| cross(at - before, behind - at));
    let balance: i64 = turns
        .map(|turn| {
            if turn > 0.0 {
                1
            } else if turn < 0.0 {
                -1
            } else {
                0
            }
        })
        .sum();
    Orientation::of_sign(balance as f64)
}

/// The way round by the turn at the lowest vertex (the first of several), arcs taken as their chords; `None` where that
/// vertex does not turn.
///
/// The lowest vertex of a polygon is convex, so its turn tells the direction. It tells nothing where the vertex is doubled or lies
/// between collinear neighbours, and the wrong thing where an arc runs round the outside of its chord's polygon.
pub(crate) fn orientation_by_extreme_point(segments: &[Segment]) -> Option<Orientation> {
    let [before, at, behind] =
        around(segments).min_by(|[_, a, _], [_, b, _]| a.y.total_cmp(&b.y))?;
    Orientation::of_sign(cross(at - before, behind - at))
}

/// Each vertex with the one before and the one behind it.
fn around(segments: &[Segment]) -> impl Iterator<Item = [Point; 3]> + '_ {
    let count = segments.len();
    (0..count).map(move |k| {
        [
            segments[(k + count - 1) % count].start(),
            segments[k].start(),
            segments[(k + 1) % count].start(),
        ]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use Orientation::{Clockwise, CounterClockwise};

    fn outline(vertices: &[[f64; 3]]) -> Vec<Segment> {
        let point = |[x, y, _]: [f64; 3]| Point::new(x, y);
        (0..vertices.len())
            .map(|k| {
                Segment::from_bulge(
                    point(vertices[k]),
                    point(vertices[(k + 1) % vertices.len()]),
                    vertices[k][2],
                )
            })
            .collect()
    }

    /// The same outline the other way round.
    fn turned(segments: &[Segment]) -> Vec<Segment> {
        segments.iter().rev().map(Segment::reversed).collect()
    }

    /// What the three say of a counter-clockwise outline; of the same one turned round they say the opposite.
    fn check(
        name: &str,
        vertices: &[[f64; 3]],
        turns: Option<Orientation>,
        extreme: Option<Orientation>,
    ) {
        let opposite = |way: Option<Orientation>| {
            way.map(|way| {
                if way == Clockwise {
                    CounterClockwise
                } else {
                    Clockwise
                }
            })
        };
        let forward = outline(vertices);
        let said = |segments: &[Segment]| {
            [
                orientation(segments),
                orientation_by_turns(segments),
                orientation_by_extreme_point(segments),
            ]
        };
        let expected = [Some(CounterClockwise), turns, extreme];
        assert_eq!(said(&forward), expected, "{name}");
        assert_eq!(
            said(&turned(&forward)),
            expected.map(opposite),
            "{name}, turned"
        );
    }

    #[test]
    fn the_published_methods_fail_where_the_area_does_not() {
        let ccw = Some(CounterClockwise);
        let cw = Some(Clockwise);
        check(
            "a square",
            &[[0., 0., 0.], [4., 0., 0.], [4., 4., 0.], [0., 4., 0.]],
            ccw,
            ccw,
        );
        check(
            "an angle",
            &[
                [0., 0., 0.],
                [4., 0., 0.],
                [4., 1., 0.],
                [1., 1., 0.],
                [1., 4., 0.],
                [0., 4., 0.],
            ],
            ccw,
            ccw,
        );
        let star = [
            [0., 0., 0.],
            [3., 1., 0.],
            [6., 0., 0.],
            [4., 2., 0.],
            [3., 5., 0.],
            [2., 2., 0.],
        ];
        check("three corners out, three in", &star, None, ccw);
        let dented = [
            [0., 0., 0.],
            [2., 1., 0.],
            [4., 1., 0.],
            [6., 0., 0.],
            [4., 2., 0.],
            [3., 5., 0.],
            [2., 2., 0.],
        ];
        check("three corners out, four in", &dented, cw, ccw);
        check(
            "collinear at the lowest vertex",
            &[
                [1., 0., 0.],
                [2., 0., 0.],
                [2., 2., 0.],
                [0., 2., 0.],
                [0., 0., 0.],
            ],
            ccw,
            None,
        );
        let flat = [
            [0., 0., 0.],
            [0., 0., 0.],
            [2., 0., 0.],
            [2., 2., 0.],
            [0., 2., 0.],
        ];
        check("a doubled vertex", &flat, ccw, None);
        check(
            "two half circles",
            &[[0., 0., 1.], [2., 0., 1.]],
            None,
            None,
        );
        // From right to left over the top in an arc that the chords know nothing of.
        check(
            "an arc round its polygon",
            &[[4., 0., 1.], [0., 0., 0.], [2., 0.5, 0.]],
            cw,
            cw,
        );
    }
}
