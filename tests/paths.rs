//! Paths of several contours: leads that stay clear of what lies beside, order, marks, what the selection says.

use proptest::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Outline, Role, Vertex};
use wedm::finding::{Detail, Finding, Place, Rule};
use wedm::geometry::{Point, Segment};
use wedm::settings::{Compensation, Direction, Effective, Order, PointSetting};
use wedm::toolpath::{Refusal, Source, WirePath, plan};

const CORRECTION: f64 = 0.1;

fn push(drawing: &mut Drawing, handle: &str, role: Option<Role>, geometry: Geometry) {
    drawing.push(Entity {
        handle: handle.into(),
        layer: "0".into(),
        role,
        kind: Kind::Line,
        geometry,
    });
}

fn rectangle([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Geometry {
    let corners = [
        (x, y),
        (x + width, y),
        (x + width, y + height),
        (x, y + height),
    ];
    Geometry::Polyline {
        closed: true,
        vertices: corners.map(|(x, y)| Vertex::new(x, y, 0.0)).to_vec(),
    }
}

fn circle(x: f64, y: f64, radius: f64) -> Geometry {
    Geometry::Circle {
        center: Point::new(x, y),
        radius,
    }
}

fn mark(x: f64, y: f64) -> Geometry {
    Geometry::Text {
        at: Point::new(x, y),
        text: "O".into(),
    }
}

/// Entities with their handles and roles.
fn drawing(entities: &[(&str, Option<Role>, Geometry)]) -> (Drawing, Arc<Vec<Outline>>) {
    let mut drawing = Drawing::new(None);
    entities
        .iter()
        .for_each(|(handle, role, geometry)| push(&mut drawing, handle, *role, geometry.clone()));
    let outlines = Analysis::new(&drawing, Arc::new(Effective::default()))
        .outlines(&drawing)
        .clone();
    (drawing, outlines)
}

fn threads(points: &[(&str, [f64; 2])]) -> Option<PointSetting> {
    Some(PointSetting::ByHandle(
        points
            .iter()
            .map(|(handle, at)| (handle.to_string(), *at))
            .collect::<BTreeMap<_, _>>(),
    ))
}

fn settings() -> Effective {
    Effective {
        correction: CORRECTION,
        ..Effective::default()
    }
}

fn handle(drawing: &Drawing, place: &Place) -> String {
    match place {
        Place::Segment { entity, .. } | Place::Entity { entity } => {
            drawing.get(*entity).unwrap().handle.to_string()
        }
        _ => "?".into(),
    }
}

/// The one finding `lead-in` that refuses a path: the contours that it stands at and that are in the way, and its sentence.
#[track_caller]
fn refused(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    handles: Option<&[String]>,
) -> (String, Vec<String>, String) {
    match plan(drawing, outlines, settings, handles) {
        Err(Refusal::Findings(found)) => {
            let [
                Finding {
                    rule: Rule::LeadIn,
                    place,
                    related,
                    detail: Detail::Said(sentence),
                    ..
                },
            ] = &found[..]
            else {
                panic!("{found:?}")
            };
            (
                handle(drawing, place),
                related.iter().map(|place| handle(drawing, place)).collect(),
                sentence.clone(),
            )
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_lead_through_another_part_is_an_error_at_both() {
    let punch = Some(Role::Punch);
    let two = [
        ("2A", punch, rectangle([0.0, 0.0], [10.0, 10.0])),
        ("2B", punch, rectangle([12.0, 0.0], [8.0, 10.0])),
    ];
    let (drawing, outlines) = drawing(&two);
    let with = |at: [f64; 2]| Effective {
        thread: threads(&[("2A", at)]),
        ..settings()
    };
    for (at, says) in [
        ([25.0, 5.0], "cuts into contour 2B"),
        (
            [11.95, 5.0],
            "cuts into contour 2B or comes nearer to it than the correction 0.100 mm",
        ),
        ([11.85, 5.0], "runs into the cut along contour 2B"),
        ([19.0, 5.0], "cuts into contour 2B"),
        ([16.0, 5.0], "cuts into contour 2B"),
        ([12.0, 5.0], "cuts into contour 2B"),
    ] {
        let (at_contour, others, sentence) = refused(&drawing, &outlines, &with(at), None);
        assert_eq!(
            (at_contour.as_str(), &others[..]),
            ("2A", &["2B".to_string()][..]),
            "{at:?}: {sentence}"
        );
        assert!(sentence.contains(says), "{at:?}: {sentence}");
        // Also where the other one is not cut in this program: it stands in the drawing.
        if !says.starts_with("runs") {
            assert_eq!(
                refused(&drawing, &outlines, &with(at), Some(&["2A".into()])).1,
                ["2B"],
                "{at:?}"
            );
        }
    }
    for at in [[11.0, 5.0], [11.69, 5.0], [5.0, -4.0], [11.0, 12.0]] {
        assert!(plan(&drawing, &outlines, &with(at), None).is_ok(), "{at:?}");
    }
    // One that is found goes round nothing: it is shortened until it is clear of the other part.
    let near = [
        ("2A", punch, rectangle([0.0, 0.0], [10.0, 11.0])),
        ("2B", punch, rectangle([11.0, -3.0], [8.0, 30.0])),
    ];
    let (drawing, outlines) = self::drawing(&near);
    let paths = plan(
        &drawing,
        &outlines,
        &Effective {
            entry: threads(&[("2A", [10.0, 5.0])]),
            ..settings()
        },
        None,
    )
    .unwrap();
    assert_eq!(paths[0].thread_hole, Point::new(10.375, 5.0));
}

#[test]
fn without_compensation_a_lead_does_not_cut_through_a_closed_contour() {
    let both = None;
    let two = [
        ("2A", both, rectangle([0.0, 0.0], [10.0, 10.0])),
        ("2B", both, rectangle([12.0, 0.0], [8.0, 10.0])),
    ];
    let (drawing, outlines) = drawing(&two);
    let with = |at| Effective {
        thread: threads(&[("2A", at)]),
        compensation: Compensation::None,
        ..settings()
    };
    let (at_contour, others, sentence) = refused(&drawing, &outlines, &with([25.0, 5.0]), None);
    assert_eq!(
        (at_contour.as_str(), &others[..]),
        ("2A", &["2B".to_string()][..]),
        "{sentence}"
    );
    assert!(plan(&drawing, &outlines, &with([11.5, 5.0]), None).is_ok());
}

#[test]
fn the_way_between_contours_is_checked_where_the_wire_stays_threaded() {
    let opening = Some(Role::Opening);
    let three = [
        ("2A", opening, circle(0.0, 0.0, 3.0)),
        ("2B", opening, circle(20.0, 0.0, 3.0)),
    ];
    let (drawing, outlines) = drawing(&three);
    assert!(plan(&drawing, &outlines, &settings(), None).is_ok());
    let (at_contour, _, sentence) = refused(
        &drawing,
        &outlines,
        &Effective {
            stays_threaded: true,
            ..settings()
        },
        None,
    );
    assert_eq!(at_contour, "2B");
    assert!(sentence.contains("the wire stays threaded"), "{sentence}");
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

/// Four lines in a square, drawn about, with the handles 21 to 24 counter-clockwise from the bottom.
fn square_of_lines() -> (Drawing, Arc<Vec<Outline>>) {
    let line = |x0: f64, y0: f64, x1: f64, y1: f64| Geometry::Line {
        start: Point::new(x0, y0),
        end: Point::new(x1, y1),
    };
    let opening = Some(Role::Opening);
    drawing(&[
        ("23", opening, line(10.0, 10.0, 0.0, 10.0)),
        ("21", opening, line(0.0, 0.0, 10.0, 0.0)),
        ("24", opening, line(0.0, 0.0, 0.0, 10.0)),
        ("22", opening, line(10.0, 10.0, 10.0, 0.0)),
    ])
}

/// Handles along a path without its leads, one after the other.
fn along(drawing: &Drawing, path: &WirePath) -> Vec<String> {
    let of = path.segments.iter().filter_map(|piece| match piece.source {
        Source::Segment { entity, .. } => Some(drawing.get(entity).unwrap().handle.to_string()),
        _ => None,
    });
    let mut handles: Vec<String> = of.collect();
    handles.dedup();
    handles
}

#[test]
fn as_picked_the_selection_says_where_a_chain_begins_and_which_way_it_goes() {
    let (drawing, outlines) = square_of_lines();
    let check = |picked: &[&str], direction: Option<Direction>, expected: &str| {
        let handles: Vec<String> = picked.iter().map(|handle| handle.to_string()).collect();
        let direction = Effective {
            stated_direction: direction,
            direction: direction.unwrap_or_default(),
            ..settings()
        };
        let paths = plan(
            &drawing,
            &outlines,
            &Effective {
                order: Order::AsPicked,
                ..direction
            },
            Some(&handles),
        )
        .unwrap();
        assert_eq!(along(&drawing, &paths[0]).join(" "), expected, "{picked:?}");
        // Begins where the first entity begins, not in its middle.
        let begin = paths[0].segments[1].geometry;
        assert!((begin.length() - 9.8).abs() < 1e-9, "{picked:?}: {begin:?}");
    };
    check(&["21", "22", "23"], None, "21 22 23 24");
    check(&["23", "22", "21"], None, "23 22 21 24");
    check(&["22", "21"], None, "22 21 24 23");
    check(&["22"], None, "22 23 24 21");
    // No way is shorter.
    check(&["22", "24"], None, "22 23 24 21");
    check(&["22", "24", "21"], None, "22 21 24 23");
    // A direction that is set wins.
    check(&["23", "22", "21"], Some(Direction::Ccw), "23 24 21 22");
    check(&["21", "22", "23"], Some(Direction::Cw), "21 24 23 22");
    // Any other order takes the handles for a selection alone.
    let handles = ["23".to_string(), "22".to_string()];
    let paths = plan(&drawing, &outlines, &settings(), Some(&handles)).unwrap();
    assert_eq!(paths, plan(&drawing, &outlines, &settings(), None).unwrap());
}

#[test]
fn contours_are_cut_in_the_order_that_is_asked_for() {
    let opening = Some(Role::Opening);
    let holes = [30.0, 0.0, 20.0, 10.0].map(|x| circle(x, 0.0, 2.0));
    let [a, b, c, d] = holes;
    let plate = rectangle([-5.0, -5.0], [50.0, 10.0]);
    let (drawing, outlines) = drawing(&[
        ("A", opening, a),
        ("P", Some(Role::Punch), plate),
        ("B", opening, b),
        ("C", opening, c),
        ("D", opening, d),
    ]);
    let ordered = |order: Order, handles: Option<&[&str]>| {
        let handles: Option<Vec<String>> =
            handles.map(|handles| handles.iter().map(|handle| handle.to_string()).collect());
        let paths = plan(
            &drawing,
            &outlines,
            &Effective {
                order,
                ..settings()
            },
            handles.as_deref(),
        )
        .unwrap();
        paths
            .iter()
            .map(|path| along(&drawing, path)[0].clone())
            .collect::<Vec<_>>()
            .join("")
    };
    assert_eq!(ordered(Order::AsDrawn, None), "ABCDP");
    assert_eq!(ordered(Order::InsideFirst, None), "ABCDP");
    assert_eq!(ordered(Order::Nearest, None), "ACDBP");
    assert_eq!(ordered(Order::AsPicked, Some(&["C", "P", "A"])), "CAP");
    assert_eq!(
        ordered(Order::AsPicked, Some(&["D", "B", "A", "C", "P"])),
        "DBACP"
    );
    assert_eq!(ordered(Order::Nearest, Some(&["D", "B", "A", "C"])), "DBCA");
}

#[test]
fn the_nearest_contour_is_not_the_one_whose_x_is_nearest() {
    let opening = Some(Role::Opening);
    for far in [-100.0, 0.0, 100.0] {
        for side in [-1.0, 1.0] {
            let hole = |x: f64, y: f64| circle(far + side * x, y, 2.0);
            let (drawing, outlines) = drawing(&[
                ("A", opening, hole(0.0, 0.0)),
                ("B", opening, hole(-1.0, 30.0)),
                ("C", opening, hole(10.0, 0.0)),
            ]);
            let nearest = Effective {
                order: Order::Nearest,
                ..settings()
            };
            let paths = plan(&drawing, &outlines, &nearest, None).unwrap();
            let order = paths.iter().map(|path| along(&drawing, path)[0].clone());
            assert_eq!(order.collect::<Vec<_>>().join(""), "ACB", "{far} {side}");
        }
    }
}

/// Points along a segment.
fn samples(segment: &Segment) -> impl Iterator<Item = Point> {
    let segment = *segment;
    (0..=400).map(move |step| segment.point_at(f64::from(step) / 400.0))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..ProptestConfig::default() })]

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

/// A double that was set aside is no contour to cut, wherever it stands in the drawing; its handle means the contour that is.
#[test]
fn a_double_is_no_contour_to_cut() {
    let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
    let side = |at: usize| Geometry::Line {
        start: corners[at % 4].into(),
        end: corners[(at + 1) % 4].into(),
    };
    let reversed = |at: usize| Geometry::Line {
        start: corners[(at + 1) % 4].into(),
        end: corners[at % 4].into(),
    };
    for double in 0..4 {
        for place in 0..5 {
            for geometry in [side(double), reversed(double)] {
                let mut sides: Vec<(&str, Option<Role>, Geometry)> = ["20", "21", "22", "23"]
                    .into_iter()
                    .enumerate()
                    .map(|(at, handle)| (handle, None, side(at)))
                    .collect();
                sides.insert(place, ("24", None, geometry));
                let (drawing, _) = drawing(&sides);
                let opening = Effective {
                    side: wedm::settings::SideSetting::Opening,
                    ..settings()
                };
                let outlines = Analysis::new(&drawing, Arc::new(opening.clone()))
                    .outlines(&drawing)
                    .clone();
                for compensation in [
                    Compensation::Path,
                    Compensation::Controller,
                    Compensation::None,
                ] {
                    let settings = Effective {
                        compensation,
                        ..opening.clone()
                    };
                    let all = plan(&drawing, &outlines, &settings, None).unwrap();
                    assert_eq!(all.len(), 1, "{sides:?}");
                    assert!(outlines[all[0].outline].contour.closed);
                    for handle in ["20", "24", &format!("2{double}")] {
                        let chosen = [handle.to_string()];
                        assert_eq!(
                            plan(&drawing, &outlines, &settings, Some(&chosen)).unwrap(),
                            all
                        );
                    }
                }
            }
        }
    }
}
