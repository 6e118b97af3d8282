//! Where a contour is threaded and entered: marks, and the centre of round openings.

use super::{CORRECTION, circle, drawing, rectangle, settings, threads};
use wedm::drawing::{Geometry, Role, Vertex};
use wedm::geometry::{Point, Segment};
use wedm::settings::{Effective, PointSetting};
use wedm::toolpath::{Source, plan};

fn mark(x: f64, y: f64) -> Geometry {
    Geometry::Text {
        at: Point::new(x, y),
        text: "O".into(),
    }
}

#[test]
fn a_mark_on_the_parts_side_or_at_the_contour_means_the_entry() {
    let check = |role: Role, at: [f64; 2], thread: Option<[f64; 2]>, entry: [f64; 2]| {
        let (drawing, outlines) = drawing(&[
            ("2A", Some(role), rectangle([0.0, 0.0], [10.0, 10.0])),
            ("M", None, mark(at[0], at[1])),
        ]);
        let paths = plan(&drawing, &outlines, &settings(), None)
            .unwrap_or_else(|refusal| panic!("{role:?} {at:?}: {refusal:?}"));
        let begin = paths[0]
            .segments
            .iter()
            .find(|piece| piece.source != Source::LeadIn)
            .unwrap()
            .geometry
            .start();
        let to_entry = begin - Point::from(entry);
        assert!(
            (to_entry.norm() - CORRECTION).abs() < 1e-9,
            "{role:?} {at:?}: {begin}"
        );
        match thread {
            Some(thread) => assert!(
                (paths[0].thread_hole - Point::from(thread)).norm() < 1e-9,
                "{role:?} {at:?}"
            ),
            // Found from the entry, on the wire's side.
            None => assert!(
                (paths[0].thread_hole - (Point::from(entry) + to_entry / CORRECTION * 3.0)).norm()
                    < 1e-9,
                "{role:?} {at:?}"
            ),
        }
    };
    check(Role::Opening, [3.0, 2.0], Some([3.0, 2.0]), [3.0, 0.0]);
    check(Role::Opening, [3.0, -2.0], None, [3.0, 0.0]);
    check(Role::Opening, [3.0, 0.05], None, [3.0, 0.0]);
    check(Role::Opening, [3.0, 0.0], None, [3.0, 0.0]);
    check(Role::Punch, [3.0, -2.0], Some([3.0, -2.0]), [3.0, 0.0]);
    check(Role::Punch, [3.0, 2.0], None, [3.0, 0.0]);
    check(Role::Punch, [10.06, 7.0], None, [10.0, 7.0]);
    // A thread hole that is given stands beside a mark that means the entry.
    let (drawing, outlines) = drawing(&[
        (
            "2A",
            Some(Role::Opening),
            rectangle([0.0, 0.0], [10.0, 10.0]),
        ),
        ("M", None, mark(3.0, -2.0)),
    ]);
    let path = plan(
        &drawing,
        &outlines,
        &Effective {
            thread: threads(&[("2A", [5.0, 5.0])]),
            ..settings()
        },
        None,
    )
    .unwrap()
    .remove(0);
    assert_eq!(
        path.segments[0].geometry,
        Segment::line(Point::new(5.0, 5.0), Point::new(3.0, 0.1))
    );
}

#[test]
fn a_round_opening_is_threaded_in_its_centre() {
    let halves = |bulge: f64| {
        let vertices = vec![Vertex::new(1.0, 4.0, bulge), Vertex::new(5.0, 4.0, bulge)];
        Geometry::Polyline {
            closed: true,
            vertices,
        }
    };
    let hole_of = |geometry: Geometry, role: Role, settings: Effective| {
        let (drawing, outlines) = drawing(&[("2A", Some(role), geometry)]);
        plan(&drawing, &outlines, &settings, None)
            .unwrap()
            .remove(0)
            .thread_hole
    };
    assert_eq!(
        hole_of(circle(0.0, 0.0, 10.0), Role::Opening, settings()),
        Point::origin()
    );
    assert_eq!(
        hole_of(halves(1.0), Role::Opening, settings()),
        Point::new(3.0, 4.0)
    );
    assert_eq!(
        hole_of(circle(0.0, 0.0, 0.3), Role::Opening, settings()),
        Point::origin()
    );
    // What is said otherwise holds.
    let lead_in = Effective {
        lead_in: 4.0,
        stated_lead_in: Some(4.0),
        ..settings()
    };
    assert_eq!(
        hole_of(circle(0.0, 0.0, 10.0), Role::Opening, lead_in),
        Point::new(5.9, 0.0)
    );
    let entry = Effective {
        entry: Some(PointSetting::One([0.0, 10.0])),
        ..settings()
    };
    assert!(
        (hole_of(circle(0.0, 0.0, 10.0), Role::Opening, entry) - Point::new(0.0, 7.0)).norm()
            < 1e-9
    );
    let thread = Effective {
        thread: Some(PointSetting::One([1.0, 1.0])),
        ..settings()
    };
    assert_eq!(
        hole_of(circle(0.0, 0.0, 10.0), Role::Opening, thread),
        Point::new(1.0, 1.0)
    );
    assert_eq!(
        hole_of(circle(0.0, 0.0, 10.0), Role::Punch, settings()),
        Point::new(13.0, 0.0)
    );
    // An island stands in the centre.
    let ring = [
        ("2A", Some(Role::Opening), circle(0.0, 0.0, 10.0)),
        ("2B", Some(Role::Punch), circle(0.0, 0.0, 2.0)),
    ];
    let (drawing, outlines) = drawing(&ring);
    let paths = plan(&drawing, &outlines, &settings(), None).unwrap();
    assert_eq!(
        paths
            .iter()
            .find(|path| path.outline == 0)
            .unwrap()
            .thread_hole,
        Point::new(7.0, 0.0)
    );
}
