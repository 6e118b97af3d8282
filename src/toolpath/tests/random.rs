//! Paths of random outlines, compared with those of another library.

use super::{at, defaults, drawing, samples};
use crate::drawing::Role;
use crate::finding::Rule;
use crate::geometry::{Arc, Point, Segment, direction};
use crate::settings::{Direction, Effective};
use crate::toolpath::{Refusal, plan};
use cavalier_contours::polyline::internal::pline_intersects::all_self_intersects_as_basic;
use cavalier_contours::polyline::{PlineSource, PlineSourceMut, PlineVertex, Polyline};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// A closed outline about the origin with filleted or sharp corners and now and then a bowed side.
fn random_outline() -> impl Strategy<Value = Vec<[f64; 3]>> {
    let corner = (
        2.0_f64..12.0,
        prop_oneof![
            Just(0.0),
            0.01_f64..0.0999,
            0.1001_f64..0.12,
            0.1001_f64..3.0
        ],
        prop_oneof![3 => Just(0.0), 1 => -0.5_f64..0.5],
    );
    (prop::collection::vec(corner, 3..14), 0.0_f64..TAU).prop_map(|(corners, turned)| {
        let count = corners.len();
        let point = |index: usize| {
            Point::origin()
                + direction(turned + TAU * (index % count) as f64 / count as f64)
                    * corners[index % count].0
        };
        let mut outline = Vec::new();
        for (index, &(_, radius, bow)) in corners.iter().enumerate() {
            let (before, vertex, after) =
                (point(index + count - 1), point(index), point(index + 1));
            let (arriving, leaving) = ((vertex - before).normalize(), (after - vertex).normalize());
            let turned = crate::geometry::turn(arriving, leaving);
            let back = radius * (turned.abs() / 2.0).tan();
            let room = (vertex - before).norm().min((after - vertex).norm()) * 0.45;
            let straight = bow == 0.0 && corners[(index + count - 1) % count].2 == 0.0;
            if straight && back > 1e-3 && back < room {
                let (foot, next) = (vertex - arriving * back, vertex + leaving * back);
                outline.push([foot.x, foot.y, (turned / 4.0).tan()]);
                outline.push([next.x, next.y, bow]);
            } else {
                outline.push([vertex.x, vertex.y, bow]);
            }
        }
        outline
    })
}

fn furthest(points: &[Point], segments: &[Segment]) -> f64 {
    let away = |point: &Point| {
        segments
            .iter()
            .map(|segment| segment.distance_to(*point))
            .fold(f64::INFINITY, f64::min)
    };
    points.iter().map(away).fold(0.0, f64::max)
}

/// The offset by the other library; `None` where the outline crosses itself.
pub(super) fn judged(outline: &[[f64; 3]], offset: f64) -> Option<Vec<Vec<Segment>>> {
    let mut polyline = Polyline::new_closed();
    outline
        .iter()
        .for_each(|&[x, y, bulge]| polyline.add(x, y, bulge));
    let index = polyline.create_approx_aabb_index();
    if !all_self_intersects_as_basic(&polyline, &index, false, 1e-7).is_empty() {
        return None;
    }
    let segments = |pline: &Polyline| {
        let vertices: Vec<PlineVertex> = pline.iter_vertexes().collect();
        let next = |index: usize| vertices[(index + 1) % vertices.len()];
        let segment = |(index, v): (usize, &PlineVertex)| {
            Segment::from_bulge(
                [v.x, v.y].into(),
                [next(index).x, next(index).y].into(),
                v.bulge,
            )
        };
        vertices.iter().enumerate().map(segment).collect()
    };
    Some(
        polyline
            .parallel_offset(offset)
            .iter()
            .map(segments)
            .collect(),
    )
}

proptest! {
    #![proptest_config(ProptestConfig { max_global_rejects: 100_000, ..ProptestConfig::with_cases(32) })]

    #[test]
    fn a_path_is_what_another_library_offsets(outline in random_outline(), punch: bool, clockwise: bool) {
        let role = if punch { Role::Punch } else { Role::Opening };
        let (drawing, outlines) = drawing(&[(&outline, Some(role))]);
        let side = outlines[0].wire_side().map_or(0.0, |side| side.sign());
        let settings = Effective { direction: if clockwise { Direction::Cw } else { Direction::Ccw }, lead_in: 0.0, ..defaults() };
        let settings = Effective { entry: at(outline[0][0], outline[0][1]), ..settings };
        let judged = judged(&outline, 0.1 * side);
        prop_assume!(judged.is_some());
        let expected = judged.unwrap_or_default();
        match plan(&drawing, &outlines, &settings, None) {
            Err(Refusal::Findings(found)) => {
                let rules: Vec<Rule> = found.iter().map(|finding| finding.rule).collect();
                prop_assert!(matches!(rules[..], [Rule::LostPocket, ..] | [Rule::OffsetCollapse]), "{:?}", found);
                // A refusal is right only where the wire cannot follow the contour all the way round.
                let walls: Vec<Segment> = outlines[0].contour.segments(&drawing).map(|s| s.geometry).collect();
                let followed: Vec<Segment> = expected.iter().flatten().copied().collect();
                let lost = furthest(&samples(&walls, 0.05), &followed) > 0.1 + 1e-4;
                prop_assert!(lost || expected.len() != 1, "{:?}", found);
            }
            Err(refusal) => prop_assert!(false, "{:?}", refusal),
            Ok(paths) => {
                let path: Vec<Segment> = paths[0].segments.iter().map(|piece| piece.geometry).collect();
                prop_assert_eq!(expected.len(), 1);
                // The other library merges points 1e-5 apart; the walls tell how exact the offset is.
                let points = samples(&path, 0.25);
                prop_assert!(furthest(&points, &expected[0]) < 2e-5);
                prop_assert!(furthest(&samples(&expected[0], 0.25), &path) < 2e-5);
                let walls: Vec<Segment> = outlines[0].contour.segments(&drawing).map(|s| s.geometry).collect();
                for point in points {
                    prop_assert!((furthest(&[point], &walls) - 0.1).abs() < 1e-6);
                }
                for pair in path.windows(2) {
                    prop_assert_eq!(pair[0].end(), pair[1].start());
                }
                prop_assert_eq!(path[path.len() - 1].end(), path[0].start());
                let consistent = |arc: &Arc| ((arc.start - arc.center).norm() - arc.radius).abs() < 1e-6 && ((arc.end - arc.center).norm() - arc.radius).abs() < 1e-6;
                prop_assert!(path.iter().filter_map(Segment::as_arc).all(consistent));
                let program = crate::program::three_b::write(&paths, 1.0, &settings);
                prop_assert!(program.is_ok(), "{:?}", program);
            }
        }
    }
}
