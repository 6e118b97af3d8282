//! Single cases.

use super::*;

/// Figures that were told by a corner of theirs alone: the outline, how deep it is where it is deepest beyond the corner, and the segment.
#[test]
fn what_was_told_as_a_corner_is_told_with_its_depth() {
    let ring = |points: &[[f64; 2]]| {
        points
            .iter()
            .map(|&[x, y]| Vertex::new(x, y, 0.0))
            .collect::<Vec<_>>()
    };
    let fillet: Vec<[f64; 2]> = (0..=8)
        .map(|k| f64::from(k) * PI / 16.0)
        .map(|angle| [0.08 - 0.08 * angle.cos(), 0.08 - 0.08 * angle.sin()])
        .collect();
    let slot = |width: f64| {
        ring(&[
            [0., 0.],
            [10., 0.],
            [10., 5.],
            [5.15, 5.],
            [5. + width / 2., 8.],
            [5. - width / 2., 8.],
            [4.85, 5.],
            [0., 5.],
        ])
    };
    let shares = |vertices: &[Vertex], of: usize| {
        let (drawing, analysis) = analysed(vertices, Role::Opening);
        let (id, _) = drawing.entities().next()?;
        let uncut = |finding: &Finding| match finding.detail {
            Detail::SharpCorner { uncut, .. } => Some((uncut * 1e3).round() / 1e3),
            _ => None,
        };
        analysis.each_at(&drawing, (id, of)).iter().find_map(uncut)
    };
    for (name, vertices, corner, share) in [
        ("a slot that tapers", slot(0.15), 4, Some(0.040)),
        ("its other corner", slot(0.15), 5, Some(0.040)),
        (
            "a chamfer",
            ring(&[[0.03, 0.], [10., 0.], [10., 5.], [0., 5.], [0., 0.03]]),
            0,
            Some(0.008),
        ),
    ] {
        assert_eq!(shares(&vertices, corner), share, "{name}");
    }
    for (name, vertices, expected) in [
        ("a slot that tapers", slot(0.15), Some((4, 0.904))),
        (
            "a slot as wide at its end as the wire needs",
            slot(0.2),
            None,
        ),
        (
            "a chamfer",
            ring(&[[0.03, 0.], [10., 0.], [10., 5.], [0., 5.], [0., 0.03]]),
            Some((4, 0.022)),
        ),
        (
            "a chamfer that the wire comes to",
            ring(&[[0.06, 0.], [10., 0.], [10., 5.], [0., 5.], [0., 0.06]]),
            None,
        ),
        (
            "a fillet as chords",
            ring(&[&fillet[..], &[[10., 0.], [10., 5.], [0., 5.]]].concat()),
            Some((3, 0.008)),
        ),
        (
            "a notch",
            ring(&[
                [0., 0.],
                [10., 0.],
                [10., 5.],
                [5.05, 5.],
                [5., 5.5],
                [4.95, 5.],
                [0., 5.],
            ]),
            Some((3, 0.487)),
        ),
        (
            "a notch that the wire comes into",
            ring(&[
                [0., 0.],
                [10., 0.],
                [10., 5.],
                [5.5, 5.],
                [5., 10.],
                [4.5, 5.],
                [0., 5.],
            ]),
            None,
        ),
        (
            "a step",
            ring(&[
                [0., 0.],
                [10., 0.],
                [10., 5.],
                [5., 5.],
                [5., 5.03],
                [0., 5.03],
            ]),
            None,
        ),
        (
            "a square",
            ring(&[[0., 0.], [10., 0.], [10., 5.], [0., 5.]]),
            None,
        ),
    ] {
        for role in [Role::Opening, Role::Both] {
            let findings = found(&vertices, role);
            let told: Vec<(usize, f64)> = dead_ends(&findings)
                .iter()
                .map(|end| (end.0, (end.2 * 1e3).round() / 1e3))
                .collect();
            assert_eq!(
                told,
                Vec::from_iter(expected),
                "{name} as {role:?}: {findings:#?}"
            );
            // Where nobody has said the side, the wire may never come there.
            let severity = match role {
                Role::Both => Severity::Warning,
                _ => Severity::Error,
            };
            let lost = findings
                .iter()
                .filter(|finding| finding.rule == Rule::LostPocket);
            let mut severities = lost.map(|finding| finding.severity);
            assert!(severities.all(|own| own == severity), "{name} as {role:?}");
        }
        assert_eq!(dead_ends(&found(&vertices, Role::Punch)), [], "{name}");
    }
}

/// A fillet of many chords about the wire and beyond is followed, and so are the chords of a curve beside a corner.
#[test]
fn chords_of_an_arc_that_the_wire_follows_are_no_dead_ends() {
    let place = |center: [f64; 2], radius: f64, angle: f64| {
        Point::from(center) + Vector::new(angle.cos(), angle.sin()) * radius
    };
    for (radius, chords) in [(0.105, 8), (0.105, 40), (0.5, 8), (0.5, 100), (3.0, 400)] {
        let fillet = (0..=chords).map(|k| {
            place(
                [radius, radius],
                radius,
                PI + PI / 2.0 * f64::from(k) / f64::from(chords),
            )
        });
        let points: Vec<Point> = fillet
            .chain([(9.0, 0.0), (9.0, 9.0), (0.0, 9.0)].map(|(x, y)| Point::new(x, y)))
            .collect();
        let vertices: Vec<Vertex> = points
            .iter()
            .map(|&point| Vertex { point, bulge: 0.0 })
            .collect();
        let findings = found(&vertices, Role::Opening);
        assert_eq!(dead_ends(&findings), [], "R {radius} in {chords} chords");
        // A half round, with a sharp corner at both its ends.
        let half = (0..=chords).map(|k| {
            place(
                [0.0, 0.0],
                radius.max(0.5),
                PI * f64::from(k) / f64::from(chords),
            )
        });
        let vertices: Vec<Vertex> = half.map(|point| Vertex { point, bulge: 0.0 }).collect();
        assert_eq!(
            dead_ends(&found(&vertices, Role::Opening)),
            [],
            "half round in {chords} chords"
        );
    }
}

/// Trimming leaves crumbs of nanometres where two curves meet; a corner with one in it is as deep as it is without.
#[test]
fn crumbs_in_a_corner_are_no_walls() {
    for bulge in [0.0, 0.1, -0.1, 0.4] {
        for half in [0.05, 0.2, 0.7, 1.2, 1.5] {
            let (sine, cosine) = f64::sin_cos(half);
            let tip = Point::new(0.0, 0.0);
            let [right, left] =
                [1.0, -1.0].map(|side| Point::new(side * 4.0 * sine, -4.0 * cosine));
            let plain = [
                Vertex {
                    point: right,
                    bulge,
                },
                Vertex { point: tip, bulge },
                Vertex {
                    point: left,
                    bulge: 0.0,
                },
            ];
            let without = [Role::Opening, Role::Punch, Role::Both].map(|role| {
                let found = found(&plain, role);
                (
                    count(&found, Rule::LostPocket),
                    count(&found, Rule::UnprovedPath),
                )
            });
            for (length, step) in [(2e-6, 7), (5e-5, 5), (3e-4, 3)] {
                for turned in (0..16).step_by(step) {
                    let crumb = tip + direction(f64::from(turned) * TAU / 16.0) * length;
                    let mut vertices = plain.to_vec();
                    vertices[1].bulge = 0.0;
                    vertices.insert(
                        2,
                        Vertex {
                            point: crumb,
                            bulge,
                        },
                    );
                    let with = [Role::Opening, Role::Punch, Role::Both].map(|role| {
                        let found = found(&vertices, role);
                        (
                            count(&found, Rule::LostPocket),
                            count(&found, Rule::UnprovedPath),
                        )
                    });
                    let lost = with.map(|(lost, _)| lost);
                    assert_eq!(
                        lost,
                        without.map(|(lost, _)| lost),
                        "{half} at the tip, bulge {bulge}, a crumb of {length} to {turned}/16: {vertices:?}"
                    );
                }
            }
        }
    }
}
