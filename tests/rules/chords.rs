//! Chords that the path of the wire takes for arcs, under `chord-fit`.

use super::drawing_of;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Geometry, Role, Vertex};
use wedm::geometry::{Point, Segment, Vector, direction, left_normal};
use wedm::settings::{Compensation, Effective, Settings};
use wedm::toolpath::{Source, WirePath, plan};

const CORRECTION: f64 = 0.1;

fn settings(chord_fit: f64) -> Effective {
    Effective::of(&Settings {
        correction: Some(CORRECTION),
        chord_fit: Some(chord_fit),
        ..Settings::default()
    })
}

/// Rounded to a micrometre.
fn vertex(point: Point) -> Vertex {
    let [x, y] = [point.x, point.y].map(|it| (it * 1e3).round() / 1e3);
    Vertex::new(x, y, 0.0)
}

/// Tangent arcs about these centres, one after the other counter-clockwise, with lines between them; each arc by so many chords.
fn rounded(corners: &[(Point, f64, usize)]) -> Vec<Vertex> {
    let count = corners.len();
    // The outer tangent from each circle to the next: its normal to the outside.
    let normal = |index: usize| {
        let ((from, own, _), (to, next, _)) =
            (corners[index % count], corners[(index + 1) % count]);
        let way = to - from;
        let out = -left_normal(way) / way.norm();
        let rise = (own - next) / way.norm();
        out * (1.0 - rise * rise).sqrt() + way / way.norm() * rise
    };
    let angle = |normal: Vector| normal.y.atan2(normal.x);
    let mut vertices = Vec::new();
    for (index, &(center, radius, chords)) in corners.iter().enumerate() {
        let from = angle(normal(index + count - 1));
        let sweep = (angle(normal(index)) - from).rem_euclid(TAU);
        let at = |share: usize| from + sweep * share as f64 / chords as f64;
        let points = (0..=chords).map(|share| center + direction(at(share)) * radius);
        vertices.extend(points.map(vertex));
    }
    vertices
}

fn circle(chords: usize, radius: f64) -> Vec<Vertex> {
    let at = |number: usize| direction(TAU * number as f64 / chords as f64) * radius;
    (0..chords)
        .map(|number| vertex(Point::origin() + at(number)))
        .collect()
}

fn as_polyline(vertices: &[Vertex]) -> Drawing {
    let polyline = Geometry::Polyline {
        closed: true,
        vertices: vertices.to_vec(),
    };
    drawing_of([polyline], Some(Role::Punch))
}

fn as_lines(vertices: &[Vertex]) -> Drawing {
    let behind = vertices.iter().cycle().skip(1);
    let line = |(from, to): (&Vertex, &Vertex)| Geometry::Line {
        start: from.point,
        end: to.point,
    };
    drawing_of(vertices.iter().zip(behind).map(line), Some(Role::Opening))
}

fn paths(drawing: &Drawing, settings: &Effective) -> Vec<WirePath> {
    let analysis = Analysis::new(drawing, settings.clone().into());
    plan(drawing, analysis.outlines(drawing), settings, None).unwrap()
}

/// What of a path runs along the outline.
fn along(path: &WirePath) -> Vec<Segment> {
    let is_along = |source| matches!(source, Source::Segment { .. } | Source::Corner { .. });
    let pieces = path.segments.iter().filter(|piece| is_along(piece.source));
    pieces.map(|piece| piece.geometry).collect()
}

fn distance(segments: &[Segment], point: Point) -> f64 {
    let distances = segments.iter().map(|it| it.distance_to(point));
    distances.fold(f64::INFINITY, f64::min)
}

/// Asserts that the contour of the path has at most this many pieces and lies `within` this of the vertices, and its offset likewise.
fn check(vertices: &[Vertex], most: usize, within: f64) {
    for drawing in [as_polyline(vertices), as_lines(vertices)] {
        let as_drawn = Effective {
            compensation: Compensation::None,
            ..settings(within)
        };
        let outline = along(&paths(&drawing, &as_drawn)[0]);
        assert!(
            outline.len() <= most,
            "{} of {}: {outline:#?}",
            outline.len(),
            vertices.len()
        );
        for vertex in vertices {
            let off = distance(&outline, vertex.point);
            assert!(off <= within + 1e-9, "{off} at {}", vertex.point);
        }
        let offset = along(&paths(&drawing, &settings(within))[0]);
        // The way round a corner that is not quite one, before and behind each arc.
        assert!(
            offset.len() <= 2 * most + 2,
            "{} beside {most}",
            offset.len()
        );
        for piece in &offset {
            let off = distance(&outline, piece.point_at(0.5)) - CORRECTION;
            assert!(off.abs() <= 1e-6, "{off} beside {piece:?}");
        }
    }
}

#[test]
fn circles_become_one_arc() {
    for (chords, within) in [
        (24, 0.09),
        (36, 0.04),
        (100, 0.006),
        (360, 0.002),
        (1000, 0.002),
    ] {
        check(&circle(chords, 10.0), 1, within);
    }
    // A hexagon stays a hexagon.
    let hexagon = as_polyline(&circle(6, 10.0));
    let [as_chords, fitted] = [0.0, 0.1].map(|within| paths(&hexagon, &settings(within)));
    assert_eq!(as_chords, fitted);
}

#[test]
fn slots_and_rounded_rectangles_become_lines_and_arcs() {
    for (chords, within) in [(12, 0.03), (40, 0.005), (500, 0.002)] {
        let slot = [
            (Point::new(0.0, 0.0), 3.0, chords),
            (Point::new(20.0, 0.0), 3.0, chords),
        ];
        check(&rounded(&slot), 4, within);
        let corner = |x, y| (Point::new(x, y), 2.0, chords);
        let rectangle = [
            corner(0.0, 0.0),
            corner(15.0, 0.0),
            corner(15.0, 9.0),
            corner(0.0, 9.0),
        ];
        check(&rounded(&rectangle), 8, within);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn rounded_outlines_become_few_pieces(
        corners in prop::collection::vec((1.0_f64..6.0, 10_usize..80, 0.7_f64..1.0), 3..8),
        begin in 0_usize..400,
    ) {
        let count = corners.len();
        let corner = |(index, &(radius, chords, reach)): (usize, &(f64, usize, f64))| {
            let at = direction(TAU * index as f64 / count as f64) * (40.0 * reach);
            (Point::origin() + at, radius, chords)
        };
        let corners: Vec<_> = corners.iter().enumerate().map(corner).collect();
        let mut vertices = rounded(&corners);
        // Ends that are rounded to 0.001 mm turn two chords by up to 0.003 / length: arcs turn more, at a stride of which there are five.
        let mut begin_of_corner = 0;
        let is_clear = corners.iter().all(|&(_, radius, chords)| {
            let ends = [0, 1].map(|end| vertices[begin_of_corner + end].point);
            begin_of_corner += chords + 1;
            let length = (ends[1] - ends[0]).norm();
            let mut strides = [1, 4, 16].into_iter().filter(|stride| chords >= 5 * stride);
            strides.any(|stride: usize| (stride * stride) as f64 * length * length / radius > 0.003)
        });
        let among = begin % vertices.len();
        vertices.rotate_left(among);
        prop_assume!(is_clear);
        // Half a turn at most for each.
        let facet = |&(_, radius, chords): &(Point, f64, usize)| radius * (1.0 - (PI / 2.0 / chords as f64).cos());
        let within = corners.iter().map(facet).fold(0.0, f64::max) + 0.002;
        prop_assume!(within <= 0.1);
        // A line and an arc for each corner, and here and there one more.
        check(&vertices, 3 * count, within);
    }
}
