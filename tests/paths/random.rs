//! Leads among random parts, compared with distances alone.

use super::{CORRECTION, along, circle, drawing, handle, rectangle, settings, threads};
use proptest::prelude::*;
use wedm::drawing::Role;
use wedm::finding::Rule;
use wedm::geometry::{Point, Segment};
use wedm::settings::Effective;
use wedm::toolpath::{Refusal, plan};

/// Points along a segment.
fn samples(segment: &Segment) -> impl Iterator<Item = Point> {
    let segment = *segment;
    (0..=400).map(move |step| segment.point_at(f64::from(step) / 400.0))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Parts beside each other, thread holes anywhere: a lead that comes out is clear of every part, and one that is refused is not.
    #[test]
    fn leads_are_clear_of_all_parts(
        parts in prop::collection::vec((0.3_f64..6.0, 0.3_f64..6.0, any::<bool>(), any::<bool>()), 2..6),
        holes in prop::collection::vec(prop::option::of((-3.0_f64..40.0, -3.0_f64..12.0)), 6),
        gap in 0.45_f64..3.0,
    ) {
        let mut entities = Vec::new();
        let mut x = 0.0;
        let names = ["A", "B", "C", "D", "E", "F"];
        for (&(width, height, round, opening), name) in parts.iter().zip(names) {
            let role = if opening { Role::Opening } else { Role::Punch };
            let geometry = if round { circle(x + width / 2.0, height / 2.0, width / 2.0) } else { rectangle([x, 0.0], [width, height]) };
            entities.push((name, Some(role), geometry));
            x += width + gap;
        }
        let (drawing, outlines) = drawing(&entities);
        let given: Vec<(&str, [f64; 2])> =
            entities.iter().zip(&holes).filter_map(|((name, ..), hole)| hole.map(|(x, y)| (*name, [x, y]))).collect();
        let settings = Effective { thread: threads(&given), ..settings() };
        let walls: Vec<Segment> = outlines.iter().flat_map(|outline| outline.contour.segments(&drawing)).map(|s| s.geometry).collect();
        let clear = |at: Point, by: f64| walls.iter().all(|wall| wall.distance_to(at) >= by);
        match plan(&drawing, &outlines, &settings, None) {
            Ok(paths) => {
                for path in &paths {
                    for piece in &path.segments {
                        prop_assert!(samples(&piece.geometry).all(|at| clear(at, CORRECTION - 1e-5)), "{:?}", piece);
                    }
                    let own = along(&drawing, path)[0].clone();
                    if let Some((_, at)) = given.iter().find(|(name, _)| **name == own) {
                        prop_assert!((path.thread_hole - Point::from(*at)).norm() < 0.2, "{} is threaded where it is said", own);
                    }
                }
            }
            Err(Refusal::Findings(found)) => {
                for finding in found {
                    prop_assert_eq!(finding.rule, Rule::LeadIn);
                    let name = handle(&drawing, &finding.place);
                    let hole = given.iter().find(|(other, _)| **other == name);
                    prop_assert!(hole.is_some(), "none is given for {} and none found: {:?}", name, finding);
                    // The straight way from the hole to the contour comes near some wall, or near what is cut along another.
                    let hole = Point::from(hole.unwrap().1);
                    let own: Vec<Segment> = outlines.iter().find(|outline| drawing.get(outline.contour.pieces[0].entity).unwrap().handle == *name)
                        .unwrap().contour.segments(&drawing).map(|s| s.geometry).collect();
                    let nearest = own.iter().map(|wall| wall.point_at(wall.share_of(hole).clamp(0.0, 1.0)))
                        .min_by(|a, b| (a - hole).norm().total_cmp(&(b - hole).norm())).unwrap();
                    let way = Segment::line(hole, nearest + (hole - nearest) * 1e-9);
                    let others = |at: Point| walls.iter().filter(|wall| !own.contains(wall)).map(|wall| wall.distance_to(at)).fold(f64::INFINITY, f64::min);
                    let crossing = samples(&way).any(|at| others(at) < 3.0 * CORRECTION + 0.02);
                    prop_assert!(crossing || finding.related.iter().any(|place| handle(&drawing, place) == name) || finding.related.is_empty(), "{:?}", finding);
                }
            }
            Err(refusal) => prop_assert!(false, "{:?}", refusal),
        }
    }
}
