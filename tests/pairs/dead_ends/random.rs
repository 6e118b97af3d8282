//! Random openings.

use super::*;
use crate::size::by_day;

/// What pokes into the side of a part, as the vertices from its right mouth to its left one.
type Feature = Vec<(f64, f64, f64)>;

/// The corner rounded with R, as this many chords between points of the arc.
fn chorded(at: Point, before: Point, behind: Point, radius: f64, chords: usize) -> Vec<Point> {
    let (to_before, to_behind) = ((before - at).normalize(), (behind - at).normalize());
    let half = to_before.dot(&to_behind).clamp(-1.0, 1.0).acos() / 2.0;
    let center = at + (to_before + to_behind).normalize() * (radius / half.sin());
    let (from, to) = (
        at + to_before * (radius / half.tan()) - center,
        at + to_behind * (radius / half.tan()) - center,
    );
    let swept = turn(from, to);
    let angle = from.y.atan2(from.x);
    (0..=chords)
        .map(|k| center + direction(angle + swept * k as f64 / chords as f64) * radius)
        .collect()
}

/// A feature of one of several kinds; the numbers lie between 0 and 1.
fn feature(kind: usize, n: [f64; 6]) -> Feature {
    let between = |low: f64, high: f64, at: usize| low + (high - low) * n[at];
    let plain = |points: &[Point]| {
        points
            .iter()
            .map(|point| (point.x, point.y, 0.0))
            .collect::<Feature>()
    };
    // A wide pocket of which the two inner corners are what is looked at.
    let slant = between(-0.3, 0.3, 0);
    let pocket = [
        (0.5, 0.0),
        (0.5 + slant, 1.0),
        (-0.5 - slant, 1.0),
        (-0.5, 0.0),
    ]
    .map(|(x, y)| Point::new(x, y));
    let corners = |round: &dyn Fn(Point, Point, Point, usize) -> Vec<Point>| {
        let inner = [1, 2]
            .map(|at| round(pocket[at], pocket[at - 1], pocket[at + 1], at))
            .concat();
        plain(&[&pocket[..1], &inner[..], &pocket[3..]].concat())
    };
    match kind {
        // Slots that taper, with straight or bent walls, and one corner of the end a little higher.
        0 | 1 => {
            let (mouth, end, length) = (
                between(0.21, 0.5, 0),
                between(0.02, 0.19, 1),
                between(0.4, 3.0, 2),
            );
            let (shift, rise, bend) = (
                between(-0.1, 0.1, 3),
                between(-0.1, 0.1, 4),
                if kind == 1 {
                    between(-0.03, 0.03, 5)
                } else {
                    0.0
                },
            );
            vec![
                (mouth / 2.0, 0.0, bend),
                (shift + end / 2.0, length, 0.0),
                (shift - end / 2.0, length + rise * end, -bend / 2.0),
                (-mouth / 2.0, 0.0, 0.0),
            ]
        }
        2 => corners(&|at, before, behind, which| {
            chamfer(
                at,
                before,
                behind,
                [between(0.005, 0.15, which), between(0.005, 0.15, which + 2)],
            )
        }),
        3 => corners(&|at, before, behind, which| {
            chorded(
                at,
                before,
                behind,
                between(0.02, 0.2, which),
                2 + (n[which + 2] * 9.0) as usize,
            )
        }),
        // Notches, pointed or with a flat ground.
        4 => {
            let (mouth, depth, ground) = (
                between(0.02, 0.5, 0),
                between(0.05, 1.0, 1),
                between(-0.1, 0.1, 2).max(0.0),
            );
            // Hardly slanted: the nearest that is cut lies on this side of its walls.
            let shift = between(-0.3, 0.3, 3) * mouth;
            let mut points = vec![
                Point::new(mouth / 2.0, 0.0),
                Point::new(shift + ground.min(mouth) / 2.0, depth),
            ];
            points
                .extend((ground > 0.0).then(|| Point::new(shift - ground.min(mouth) / 2.0, depth)));
            points.push(Point::new(-mouth / 2.0, 0.0));
            plain(&points)
        }
        // Both inner corners as chains of short segments that turn as they like.
        _ => corners(&|at, before, behind, which| {
            let mut points = chamfer(
                at,
                before,
                behind,
                [between(0.02, 0.15, which), between(0.02, 0.15, which + 1)],
            );
            let (from, to) = (points[0], points[1]);
            let bulge = |share: f64, by: f64| {
                from + (to - from) * share + (at - (from + (to - from) * 0.5)) * by
            };
            let more = [
                bulge(between(0.2, 0.45, which + 2), between(0.0, 0.7, which + 1)),
                bulge(between(0.55, 0.8, which), between(0.0, 0.7, which + 3)),
            ];
            points.splice(1..1, more);
            points
        }),
    }
}

/// The outline of an opening that the feature pokes out of, or of a punch that it pokes into.
fn outline(feature: &Feature, role: Role) -> Vec<Vertex> {
    let around: [(f64, f64); 4] = if role == Role::Opening {
        [(-0.9, 0.0), (-0.9, -0.5), (0.9, -0.5), (0.9, 0.0)]
    } else {
        [(-4.0, 0.0), (-4.0, 7.0), (4.0, 7.0), (4.0, 0.0)]
    };
    let rest = around.into_iter().map(|(x, y)| (x, y, 0.0));
    feature
        .iter()
        .copied()
        .chain(rest)
        .map(|(x, y, bulge)| Vertex::new(x, y, bulge))
        .collect()
}

/// The same contour turned, mirrored, begun elsewhere, and the other way round.
fn moved(
    vertices: &[Vertex],
    angle: f64,
    mirrored: bool,
    begin: usize,
    reversed: bool,
) -> Vec<Vertex> {
    let (sine, cosine) = angle.sin_cos();
    let place = |vertex: &Vertex| {
        let x = if mirrored {
            -vertex.point.x
        } else {
            vertex.point.x
        };
        Vertex::new(
            x * cosine - vertex.point.y * sine,
            x * sine + vertex.point.y * cosine,
            if mirrored {
                -vertex.bulge
            } else {
                vertex.bulge
            },
        )
    };
    let mut moved: Vec<Vertex> = vertices.iter().map(place).collect();
    let count = moved.len();
    moved.rotate_left(begin % count);
    if reversed {
        moved = (0..count)
            .map(|at| Vertex {
                point: moved[count - 1 - at].point,
                bulge: -moved[(2 * count - 2 - at) % count].bulge,
            })
            .collect();
    }
    moved
}

fn check(vertices: &[Vertex], role: Role) -> Result<(), TestCaseError> {
    let findings = found(vertices, role);
    let opening = Opening::new(vertices, role);
    let others = [
        Rule::NarrowSlot,
        Rule::SmallRadius,
        Rule::SelfIntersection,
        Rule::OffsetCollapse,
    ]
    .map(|rule| count(&findings, rule));
    let ends = dead_ends(&findings);
    for &(_, near, uncut) in &ends {
        let depth = opening.depth(near);
        prop_assert!(
            (depth - uncut).abs() < OFF,
            "{uncut} is told at {near}, which is {depth} deep: {findings:#?}"
        );
    }
    if others.iter().any(|&count| count > 0) {
        return Ok(());
    }
    // Whatever is deeper than a corner is told, with its depth.
    let corners: Vec<usize> = (0..opening.segments.len())
        .filter(|&index| opening.turn(index) > 0.02)
        .collect();
    for &index in &corners {
        let (beyond, at) = (opening.beyond(index), opening.segments[index].start());
        if beyond > OFF {
            let depth = opening.depth(at);
            let told = ends
                .iter()
                .any(|(_, near, uncut)| *uncut > depth - OFF && (near - at).norm() < uncut + 1.0);
            prop_assert!(
                told,
                "{at} is {depth} deep, {beyond} more than a corner: {findings:#?}"
            );
        }
    }
    // And nothing else is, but a notch that the wire does not come into.
    let is_deep = corners.iter().any(|&index| opening.beyond(index) > -OFF);
    let is_pointed = corners.iter().any(|&index| opening.turn(index) > PI / 2.0);
    prop_assert!(ends.is_empty() || is_deep || is_pointed, "{ends:?}");
    // The figure of each corner is that of this corner: what stays beyond it is told of the dead end.
    for finding in &findings {
        if let (Place::Segment { segment, .. }, Detail::SharpCorner { uncut, .. }) =
            (&finding.place, &finding.detail)
        {
            let (at, share) = (vertices[*segment].point, opening.share(*segment));
            let depth = opening.depth(at);
            let is_straight = [*segment, (segment + vertices.len() - 1) % vertices.len()]
                .iter()
                .all(|&beside| vertices[beside].bulge == 0.0);
            let is_own = (depth.min(share) - uncut).abs() < OFF;
            prop_assert!(
                is_own || !is_straight && (depth - uncut).abs() < OFF,
                "{uncut} is told of the corner at {at}, {depth} is left, {share} of it by this corner"
            );
        }
    }
    Ok(())
}

fn cases(usual: u32) -> u32 {
    std::env::var("PROPTEST_CASES")
        .ok()
        .and_then(|number| number.parse().ok())
        .map_or(usual, |cases: u32| cases.min(usual))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(by_day(20, 60)), failure_persistence: None, rng_seed: RngSeed::Fixed(20261122), ..ProptestConfig::default() })]

    #[test]
    fn what_is_left_beyond_a_dead_end_is_told(
        kind in 0..6usize,
        numbers in proptest::array::uniform6(0.0..1.0f64),
        is_punch: bool,
        angle in prop_oneof![Just(0.0), 0.0..TAU],
        mirrored: bool,
        begin in 0..16usize,
        reversed: bool,
    ) {
        let role = if is_punch { Role::Punch } else { Role::Opening };
        check(&moved(&outline(&feature(kind, numbers), role), angle, mirrored, begin, reversed), role)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(600), failure_persistence: None, rng_seed: RngSeed::Fixed(20261123), ..ProptestConfig::default() })]

    /// Arcs of kilometres are told what the lines are told of that they hardly differ from.
    #[test]
    fn arcs_that_are_nearly_flat_are_told_what_lines_are(
        corners in proptest::collection::vec((5.0..60.0f64, prop_oneof![Just(f64::NEG_INFINITY), -9.0..-3.5f64], any::<bool>()), 3..9),
        at in (-50.0..50.0f64, -50.0..50.0f64),
        punch: bool,
    ) {
        let count = corners.len() as f64;
        let bent: Vec<Vertex> = corners
            .iter()
            .enumerate()
            .map(|(index, &(radius, power, negative))| {
                let point = direction(TAU * index as f64 / count) * radius;
                let rounded = |value: f64| (value * 1e3).round() / 1e3;
                let bulge = 10.0f64.powf(power);
                Vertex::new(rounded(point.x + at.0), rounded(point.y + at.1), if negative { -bulge } else { bulge })
            })
            .collect();
        let flat: Vec<Vertex> = bent.iter().map(|vertex| Vertex { bulge: 0.0, ..*vertex }).collect();
        let role = if punch { Role::Punch } else { Role::Opening };
        let errors = |vertices: &[Vertex]| -> Vec<(Rule, String)> {
            let found = found(vertices, role);
            let errors = found.iter().filter(|finding| finding.severity == Severity::Error);
            errors.map(|finding| (finding.rule, format!("{:?}", finding.detail))).collect()
        };
        let rules = |errors: &[(Rule, String)]| -> Vec<Rule> { errors.iter().map(|error| error.0).collect() };
        let (told, expected) = (errors(&bent), errors(&flat));
        prop_assert_eq!(rules(&told), rules(&expected), "{:?} for {:?}", told, expected);
    }
}
