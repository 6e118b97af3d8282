//! Random outlines: what the rules find there and what dense samples and the offset library find.

use crate::star::star;
use cavalier_contours::polyline::internal::pline_intersects::all_self_intersects_as_basic;
use cavalier_contours::polyline::{PlineBasicIntersect, PlineSource, PlineSourceMut, Polyline};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Entity, Geometry, Role, Vertex};
use wedm::finding::{Detail, Finding, Place, Rule};
use wedm::geometry::{Point, Segment};
use wedm::settings::{Effective, Settings};

fn drawing_of(vertices: &[Vertex], role: Role) -> Drawing {
    let mut drawing = Drawing::new(None);
    let geometry = Geometry::Polyline {
        closed: true,
        vertices: vertices.to_vec(),
    };
    let role = (role != Role::Both).then_some(role);
    drawing.push(Entity {
        handle: "2A".into(),
        layer: "0".into(),
        role,
        kind: wedm::drawing::Kind::LightPolyline,
        geometry,
    });
    drawing
}

fn findings(drawing: &Drawing, correction: f64) -> Vec<Finding> {
    let settings = Arc::new(Effective::of(&Settings {
        correction: Some(correction),
        ..Settings::default()
    }));
    Analysis::new(drawing, settings)
        .findings(drawing, usize::MAX)
        .0
}

/// The outline for the judge, which takes no arc beyond a half turn: those are cut in two.
fn pline(vertices: &[Vertex]) -> Polyline<f64> {
    let mut outline = Polyline::new_closed();
    for (k, vertex) in vertices.iter().enumerate() {
        let whole = Segment::from_bulge(
            vertex.point,
            vertices[(k + 1) % vertices.len()].point,
            vertex.bulge,
        );
        let parts = if vertex.bulge.abs() > 0.9 {
            vec![whole.part(0.0, 0.5), whole.part(0.5, 1.0)]
        } else {
            vec![whole]
        };
        parts
            .iter()
            .for_each(|part| outline.add(part.start().x, part.start().y, part.bulge()));
    }
    outline
}

/// Points where the offset library sees the outline meet itself.
fn judged(vertices: &[Vertex]) -> Vec<Point> {
    let outline = pline(vertices);
    let found =
        all_self_intersects_as_basic(&outline, &outline.create_approx_aabb_index(), false, 1e-7);
    let basic = found
        .iter()
        .map(|PlineBasicIntersect { point, .. }| Point::new(point.x, point.y));
    basic.collect()
}

/// Points along the outline, each with its segment and its share of it.
fn samples(segments: &[Segment], spacing: f64) -> Vec<(Point, usize)> {
    let on = |(index, segment): (usize, &Segment)| {
        let count = (segment.length() / spacing).ceil().max(1.0) as usize;
        let segment = *segment;
        (0..count).map(move |k| (segment.point_at(k as f64 / count as f64), index))
    };
    segments.iter().enumerate().flat_map(on).collect()
}

/// The outline with one corner pulled over to the other side, so that it is likely to cross itself.
fn pulled(mut vertices: Vec<Vertex>, at: usize, by: f64) -> Vec<Vertex> {
    let at = at % vertices.len();
    vertices[at].point *= by;
    vertices
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, rng_seed: RngSeed::Fixed(20261122), ..ProptestConfig::default() })]

    #[test]
    fn crossings_are_those_of_another_judge(star in star(), at in 0..40usize, by in -1.2..1.0f64) {
        let vertices = pulled(star.vertices(), at, by);
        let drawing = drawing_of(&vertices, Role::Both);
        let found = findings(&drawing, 0.2);
        let contacts: Vec<(Point, bool)> = found.iter().filter_map(|finding| match finding.detail {
            Detail::SelfIntersection { at, touches, .. } => Some((at, touches)),
            _ => None,
        }).collect();
        let judged = judged(&vertices);
        for &(at, touches) in &contacts {
            prop_assert!(touches || judged.iter().any(|point| (point - at).norm() < 1e-2), "{at} is no crossing: {judged:?}");
        }
        let overlaps = found.iter().any(|finding| finding.rule == Rule::Overlap);
        for &point in &judged {
            // Near a joint ends may reach past each other, and a sliver thinner than the touch tolerance is none.
            let near_joint = vertices.iter().any(|vertex| (vertex.point - point).norm() < 0.05);
            prop_assert!(overlaps || near_joint || !contacts.is_empty(), "{point} is not found");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, rng_seed: RngSeed::Fixed(20261123), ..ProptestConfig::default() })]

    #[test]
    fn narrow_places_are_those_of_dense_samples(star in star(), role in 0..3usize, correction in 0.2..0.8f64) {
        const SPACING: f64 = 0.03;
        let vertices = star.vertices();
        prop_assume!(judged(&vertices).is_empty());
        let role = [Role::Opening, Role::Punch, Role::Both][role];
        let drawing = drawing_of(&vertices, role);
        let found = findings(&drawing, correction);
        let slots: Vec<(f64, usize, usize)> = found.iter().filter_map(|finding| match (&finding.detail, &finding.place, finding.related.first()) {
            (Detail::NarrowSlot { width, .. }, Place::Segment { segment: one, .. }, Some(Place::Segment { segment: other, .. })) => Some((*width, *one, *other)),
            _ => None,
        }).collect();
        let segments: Vec<Segment> = Geometry::Polyline { closed: true, vertices: vertices.clone() }.segments().collect();
        let nearest = |point: Point| segments.iter().map(|segment| segment.distance_to(point)).fold(f64::INFINITY, f64::min);
        let inside = |point: Point| pline(&vertices).winding_number(cavalier_contours::core::math::Vector2::new(point.x, point.y)) != 0;
        let on_wire_side = |point: Point| match role {
            Role::Opening => inside(point),
            Role::Punch => !inside(point),
            Role::Both | Role::Left | Role::Right | Role::Line | Role::Ignore => true,
        };
        // Each finding is a disc that fits between its two segments and nowhere else.
        for &(width, one, other) in &slots {
            prop_assert!(width < 2.0 * correction);
            let (a, b) = (samples(&segments[one..=one], 0.01), samples(&segments[other..=other], 0.01));
            let ends = |index: usize| [(segments[index].start(), index), (segments[index].end(), index)];
            let (a, b) = ([&a[..], &ends(one)].concat(), [&b[..], &ends(other)].concat());
            let fits = |p: Point, q: Point| {
                let center = p + (q - p) * 0.5;
                ((q - p).norm() - width).abs() < 0.02 && nearest(center) > width / 2.0 - 0.02 && on_wire_side(center)
            };
            prop_assert!(a.iter().any(|a| b.iter().any(|b| fits(a.0, b.0))), "nothing fits between {one} and {other} with {width}");
        }
        // Each place that is narrower than all about it is found.
        let samples = samples(&segments, SPACING);
        let count = samples.len();
        let tight = found.iter().any(|finding| finding.rule == Rule::SmallRadius);
        for i in 0..count {
            for j in i + 1..count {
                let width = |i: usize, j: usize| (samples[i % count].0 - samples[j % count].0).norm();
                let own = width(i, j);
                if own > 2.0 * correction - 0.05 || own < 0.1 {
                    continue;
                }
                let minimum = (0..9).all(|a| (0..9).all(|b| (a, b) == (4, 4) || width(i + count + a - 4, j + count + b - 4) > own + 1e-4));
                let center = samples[i].0 + (samples[j].0 - samples[i].0) * 0.5;
                if minimum && nearest(center) > own / 2.0 - 1e-3 && on_wire_side(center) && !tight {
                    prop_assert!(slots.iter().any(|&(width, ..)| width < own + 1e-3), "{own} at {center} is not found: {slots:?}");
                }
            }
        }
        // Where the offset falls apart there is a narrow place, or an arc below the correction.
        if role == Role::Opening {
            let inward = if star.clockwise { -correction } else { correction };
            if pline(&vertices).parallel_offset(inward).len() > 1 {
                prop_assert!(tight || !slots.is_empty(), "the offset falls apart");
                let lost = found.iter().any(|finding| finding.rule == Rule::LostPocket);
                prop_assert!(tight || lost, "the pocket is not said to be lost");
            }
        }
    }
}
