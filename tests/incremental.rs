//! What an analysis knows after any sequence of edits is what a fresh one knows.

use proptest::prelude::*;
use std::fmt::Write;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::document::{Document, Source};
use wedm::drawing::{
    Chains, Contour, Delta, Drawing, Entity, EntityId, Geometry, Role, Touched, Vertex,
};
use wedm::dxf;
use wedm::finding::Place;
use wedm::geometry::Point;
use wedm::settings::{Budget, Effective, Settings, SideSetting};

#[derive(Clone, Debug)]
enum Edit {
    Add(usize, Geometry, Option<Role>),
    Replace(usize, Geometry, Option<Role>),
    Remove(usize),
    Splice(usize, usize, usize, Vec<Vertex>),
}

/// Points of a coarse grid, so that ends often coincide and nodes branch; now and then a little off.
fn point() -> impl Strategy<Value = Point> {
    (
        0..4i32,
        0..4i32,
        prop_oneof![8 => Just(0.0), 1 => Just(0.004), 1 => Just(0.02)],
    )
        .prop_map(|(x, y, off)| Point::new(f64::from(x) + off, f64::from(y)))
}

fn vertex() -> impl Strategy<Value = Vertex> {
    (point(), prop_oneof![2 => Just(0.0), 1 => -1.5..1.5f64])
        .prop_map(|(point, bulge)| Vertex { point, bulge })
}

fn geometry() -> impl Strategy<Value = Geometry> {
    prop_oneof![
        6 => (point(), point()).prop_map(|(start, end)| Geometry::Line { start, end }),
        3 => (point(), 0..4i32, 1..4i32).prop_map(|(center, from, sweep)| {
            let quarter = std::f64::consts::FRAC_PI_2;
            Geometry::Arc { center, radius: 1.0, start_angle: f64::from(from) * quarter, end_angle: f64::from(from + sweep) * quarter }
        }),
        2 => (any::<bool>(), proptest::collection::vec(vertex(), 0..6)).prop_map(|(closed, vertices)| Geometry::Polyline { closed, vertices }),
        1 => (point(), 0.2..2.0f64).prop_map(|(center, radius)| Geometry::Circle { center, radius }),
    ]
}

fn role() -> impl Strategy<Value = Option<Role>> {
    prop_oneof![6 => Just(None), 1 => Just(Some(Role::Opening)), 1 => Just(Some(Role::Punch)), 1 => Just(Some(Role::Ignore))]
}

fn edit() -> impl Strategy<Value = Edit> {
    prop_oneof![
        3 => (0..20usize, geometry(), role()).prop_map(|(at, geometry, role)| Edit::Add(at, geometry, role)),
        3 => (0..20usize, geometry(), role()).prop_map(|(at, geometry, role)| Edit::Replace(at, geometry, role)),
        2 => (0..20usize).prop_map(Edit::Remove),
        6 => (0..20usize, 0..7usize, 0..3usize, proptest::collection::vec(vertex(), 0..3))
            .prop_map(|(at, start, count, insert)| Edit::Splice(at, start, count, insert)),
    ]
}

fn entity(geometry: Geometry, role: Option<Role>) -> Entity {
    Entity {
        handle: "A".into(),
        layer: "0".into(),
        role,
        kind: wedm::drawing::Kind::Line,
        geometry,
    }
}

fn apply(drawing: &mut Drawing, edit: &Edit) -> Option<Touched> {
    let pick = |drawing: &Drawing, at: usize| {
        (!drawing.is_empty()).then(|| drawing.order()[at % drawing.len()])
    };
    match edit {
        Edit::Add(at, geometry, role) => {
            let position = at % (drawing.len() + 1);
            let id = drawing.insert_at(position, entity(geometry.clone(), *role));
            Some(Touched::Entity { entity: id })
        }
        Edit::Replace(at, geometry, role) => {
            let id = pick(drawing, *at)?;
            drawing.replace(id, entity(geometry.clone(), *role));
            Some(Touched::Entity { entity: id })
        }
        Edit::Remove(at) => {
            let id = pick(drawing, *at)?;
            drawing.remove(id);
            Some(Touched::Removed { entity: id })
        }
        Edit::Splice(at, start, count, insert) => drawing
            .splice(pick(drawing, *at)?, *start, *count, insert)
            .ok(),
    }
}

/// Number of cases: `usual`, unless the environment asks for another one (`PROPTEST_CASES`).
fn cases(usual: u32) -> u32 {
    std::env::var("PROPTEST_CASES")
        .ok()
        .and_then(|number| number.parse().ok())
        .unwrap_or(usual)
}

/// A place on a circle of many chords: now and then a little off it, or where the next chord is a different one.
fn on_circle(at: usize, off: f64) -> Vertex {
    let angle = at as f64 * std::f64::consts::TAU / 40.0;
    Vertex::new((5.0 + off) * angle.cos(), (5.0 + off) * angle.sin(), 0.0)
}

/// Chords in a row from a place on.
fn chords(most: usize) -> impl Strategy<Value = Vec<Vertex>> {
    let off = prop_oneof![12 => Just(0.0), 1 => Just(0.001), 1 => Just(0.3)];
    (0..40usize, proptest::collection::vec(off, 0..most)).prop_map(|(from, offs)| {
        offs.into_iter()
            .enumerate()
            .map(|(at, off)| on_circle(from + at, off))
            .collect()
    })
}

/// An outline of many short segments with a corner now and then; half of it is a polyline that is travelled as it is drawn, or
/// backwards, half of it lines.
fn mixed_outline(backwards: bool) -> (Drawing, EntityId) {
    const SIDES: usize = 24;
    const PARTS: usize = 12;
    const ALL: usize = SIDES * PARTS;
    let point = |at: usize| {
        let corner = |side: usize| {
            let angle = side as f64 * std::f64::consts::TAU / SIDES as f64;
            Point::new(100.0 * angle.cos(), 100.0 * angle.sin())
        };
        let (from, to) = (corner(at / PARTS), corner(at / PARTS + 1));
        from + (to - from) * ((at % PARTS) as f64 / PARTS as f64)
    };
    let mut drawing = Drawing::new(None);
    let line = |at: usize| {
        entity(
            Geometry::Line {
                start: point(at),
                end: point(at + 1),
            },
            Some(Role::Opening),
        )
    };
    // The first entity says which way the contour is travelled.
    drawing.push(line(0));
    let mut vertices: Vec<Vertex> = (1..=ALL / 2)
        .map(|at| Vertex {
            point: point(at),
            bulge: 0.0,
        })
        .collect();
    if backwards {
        vertices.reverse();
    }
    let polyline = drawing.push(entity(
        Geometry::Polyline {
            closed: false,
            vertices,
        },
        Some(Role::Opening),
    ));
    for at in ALL / 2..ALL {
        drawing.push(line(at));
    }
    (drawing, polyline)
}

/// Two outlines of many runs that lie on each other and begin in different places, edited far from both beginnings.
#[test]
fn outlines_that_come_to_lie_on_each_other_are_told_as_if_afresh() {
    const COUNT: usize = 300;
    let vertex = |at: usize| {
        let (angle, radius) = (
            at as f64 * std::f64::consts::TAU / COUNT as f64,
            if at.is_multiple_of(2) { 100.0 } else { 101.0 },
        );
        Vertex::new(radius * angle.cos(), radius * angle.sin(), 0.0)
    };
    let ring = |from: usize| {
        (0..COUNT)
            .map(|at| vertex((from + at) % COUNT))
            .collect::<Vec<_>>()
    };
    let settings = Arc::new(Effective::of(&Settings::default()));
    for edited in 0..2 {
        let mut drawing = Drawing::new(None);
        let ids = [0, 150].map(|from| {
            drawing.push(entity(
                Geometry::Polyline {
                    closed: true,
                    vertices: ring(from),
                },
                None,
            ))
        });
        let mut analysis = Analysis::new(&drawing, settings.clone());
        let home = ring([0, 150][edited])[230];
        let away = Vertex {
            point: home.point * 0.9,
            bulge: 0.0,
        };
        for (to, doubles) in [(away, 0), (home, 1)] {
            let touched = drawing.splice(ids[edited], 230, 1, &[to]).unwrap();
            analysis.update(
                &drawing,
                &Delta {
                    touched: vec![touched],
                },
            );
            let told = analysis.findings(&drawing, usize::MAX).0;
            let fresh = Analysis::new(&drawing, settings.clone())
                .findings(&drawing, usize::MAX)
                .0;
            assert_eq!(told, fresh, "polyline {edited}");
            assert_eq!(
                told.iter()
                    .filter(|finding| finding.rule == wedm::finding::Rule::DuplicateEntity)
                    .count(),
                doubles
            );
        }
    }
}

/// What local rules saw behind a splice has other indices now: in the pieces behind, and in a piece that is travelled backwards in
/// what lies before it in the entity.
#[test]
fn a_splice_that_changes_the_count_moves_what_was_seen_behind_it() {
    for (backwards, start, removed, inserted) in [
        (false, 20, 0, 1),
        (true, 20, 0, 1),
        (false, 90, 2, 0),
        (true, 90, 2, 0),
        (true, 140, 1, 3),
        (false, 5, 1, 3),
    ] {
        let settings = Arc::new(Effective::of(&Settings::default()));
        let (mut drawing, polyline) = mixed_outline(backwards);
        let mut analysis = Analysis::new(&drawing, settings.clone());
        let inserted: Vec<Vertex> = (0..inserted)
            .map(|at| Vertex::new(at as f64, 3.0, 0.0))
            .collect();
        let touched = drawing.splice(polyline, start, removed, &inserted).unwrap();
        analysis.update(
            &drawing,
            &Delta {
                touched: vec![touched],
            },
        );
        let mut fresh = Analysis::new(&drawing, settings.clone());
        let case = (backwards, start, removed, inserted.len());
        assert_eq!(
            analysis.findings(&drawing, usize::MAX),
            fresh.findings(&drawing, usize::MAX),
            "{case:?}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(400), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn sequences_of_chords_are_seen_alike(
        closed: bool,
        role in role(),
        start in chords(90),
        loose in proptest::collection::vec((0..40usize, 0..40usize), 0..12),
        edits in proptest::collection::vec((0..90usize, 0..8usize, chords(8), 0..4usize), 1..12),
        by_point: bool,
    ) {
        let mut settings = Effective::of(&Settings { side: Some(SideSetting::Auto), ..Settings::default() });
        if by_point {
            // An edit moves the polyline off and onto the points.
            settings.points = vec![(on_circle(0, 0.0).point, Role::Opening), (on_circle(45, 0.0).point, Role::Ignore)];
        }
        let settings = Arc::new(settings);
        let mut drawing = Drawing::new(None);
        let polyline = drawing.push(entity(Geometry::Polyline { closed, vertices: start }, role));
        let line = |from: usize, to: usize| Geometry::Line { start: on_circle(from, 0.0).point, end: on_circle(to, 0.0).point };
        for (from, step) in loose {
            drawing.push(entity(line(from, from + 1 + step / 20), None));
        }
        let mut analysis = Analysis::new(&drawing, settings.clone());
        for (from, count, insert, kind) in edits {
            let touched = match kind {
                0 => {
                    let id = drawing.order()[from % drawing.len()];
                    if id == polyline { continue };
                    drawing.replace(id, entity(line(count * 5, count * 5 + 1), None));
                    Touched::Entity { entity: id }
                }
                1 => Touched::Entity { entity: drawing.push(entity(line(from, from + 1), None)) },
                _ => match drawing.splice(polyline, from, count, &insert) {
                    Ok(touched) => touched,
                    Err(_) => continue,
                },
            };
            analysis.update(&drawing, &Delta { touched: vec![touched] });
            let mut fresh = Analysis::new(&drawing, settings.clone());
            prop_assert_eq!(analysis.findings(&drawing, usize::MAX), fresh.findings(&drawing, usize::MAX));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(1000), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn incremental_equals_fresh(
        start in proptest::collection::vec((geometry(), role()), 0..12),
        // Now and then so much at once that all is looked at anew.
        edits in proptest::collection::vec(
            prop_oneof![8 => proptest::collection::vec(edit(), 1..3), 1 => proptest::collection::vec(edit(), 18..22)],
            1..12,
        ),
        side in 0..4usize,
    ) {
        let side = [SideSetting::Both, SideSetting::Auto, SideSetting::Opening, SideSetting::Punch][side];
        let settings = Arc::new(Effective::of(&Settings { correction: Some(0.8), side: Some(side), ..Settings::default() }));
        let mut drawing = Drawing::new(None);
        for (geometry, role) in start {
            drawing.push(entity(geometry, role));
        }
        let mut analysis = Analysis::new(&drawing, settings.clone());
        for batch in edits {
            let touched = batch.iter().filter_map(|edit| apply(&mut drawing, edit)).collect();
            analysis.update(&drawing, &Delta { touched });
            let mut fresh = Analysis::new(&drawing, settings.clone());
            let (now, then) = (analysis.outlines(&drawing).clone(), fresh.outlines(&drawing).clone());
            prop_assert_eq!(now.len(), then.len(), "{:?}\n{:?}", now, then);
            for (a, b) in now.iter().zip(then.iter()) {
                prop_assert_eq!(&a.contour, &b.contour);
                prop_assert_eq!(a.role, b.role);
                prop_assert!((a.twice_area - b.twice_area).abs() < 1e-9, "{} {}", a.twice_area, b.twice_area);
            }
            prop_assert_eq!(analysis.findings(&drawing, usize::MAX), fresh.findings(&drawing, usize::MAX));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(200), failure_persistence: None, ..ProptestConfig::default() })]

    /// Pairs: of contours that are cut twice, and of two workpieces that are drawn in one place, entities that go from the one to the other.
    #[test]
    fn pairs_are_held_against_each_other_as_if_afresh(
        start in proptest::collection::vec((geometry(), 0..3usize), 0..10),
        edits in proptest::collection::vec(proptest::collection::vec((edit(), 0..3usize), 1..3), 1..10),
        is_drawn in any::<bool>(),
    ) {
        let what = match is_drawn {
            true => "[workpieces]\nA = [\"A\"]\nB = [\"B\"]\n",
            false => "",
        };
        let drawn_as = if is_drawn { "" } else { "drawn-as = \"punch\"\n" };
        let text = format!("wire-diameter = 0.4\ngap = 0.1\n[pair]\nclearance = 0.05\n{drawn_as}{what}");
        let (settings, errors) = wedm::settings::from_toml(&text);
        prop_assert_eq!(errors, []);
        let settings = Arc::new(Effective::of(&settings));
        let on_layer = |geometry: Geometry, layer: usize| Entity {
            layer: ["0", "A", "B"][layer].into(),
            ..entity(geometry, None)
        };
        let mut drawing = Drawing::new(None);
        for (geometry, layer) in start {
            drawing.push(on_layer(geometry, layer));
        }
        // A pair that is there from the begin.
        for (layer, by) in [(1, 0.0), (2, 0.05)] {
            let (low, high) = (-10.0 - by, -4.0 + by);
            let vertices = [(low, low), (high, low), (high, high), (low, high)];
            let vertices = vertices.map(|(x, y)| Vertex { point: Point::new(x, y), bulge: 0.0 }).to_vec();
            drawing.push(on_layer(Geometry::Polyline { closed: true, vertices }, layer));
        }
        let mut analysis = Analysis::new(&drawing, settings.clone());
        prop_assert!(analysis.findings(&drawing, usize::MAX).0.iter().any(|finding| finding.rule == wedm::finding::Rule::DoesNotFit));
        for batch in edits {
            let mut touched = Vec::new();
            for (edit, layer) in batch {
                if let Edit::Replace(at, ..) = edit
                    && !drawing.is_empty()
                    && layer > 0
                {
                    // The same entity on another layer.
                    let id = drawing.order()[at % drawing.len()];
                    if let Some(old) = drawing.get(id).cloned() {
                        drawing.replace(id, on_layer(old.geometry, layer));
                        touched.push(Touched::Entity { entity: id });
                    }
                    continue;
                }
                touched.extend(apply(&mut drawing, &edit));
            }
            analysis.update(&drawing, &Delta { touched });
            let mut fresh = Analysis::new(&drawing, settings.clone());
            let (now, then) = (analysis.outlines(&drawing).clone(), fresh.outlines(&drawing).clone());
            prop_assert_eq!(now.len(), then.len(), "{:?}\n{:?}", now, then);
            for (a, b) in now.iter().zip(then.iter()) {
                prop_assert_eq!(&a.contour, &b.contour);
            }
            prop_assert_eq!(analysis.findings(&drawing, usize::MAX), fresh.findings(&drawing, usize::MAX));
        }
    }
}

/// A vertex of a zigzag between whose teeth the wire does not come, and beside it.
fn of_zigzag(at: usize, (x, y, bulge): (f64, f64, f64)) -> Vertex {
    let tooth = (at % 2) as f64 * 1.5;
    Vertex::new(at as f64 * 0.08 + x, tooth + y, bulge)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(8), failure_persistence: None, ..ProptestConfig::default() })]

    /// Of several runs of segments: what is left beyond dead ends is not asked again where theirs stay.
    #[test]
    fn dead_ends_of_a_zigzag_are_told_as_if_afresh(
        closed in any::<bool>(),
        edits in proptest::collection::vec(
            (
                0..200usize,
                prop_oneof![1 => Just(1), 4 => Just(0)],
                proptest::collection::vec((-0.1..0.1f64, -0.8..0.8f64, prop_oneof![3 => Just(0.0), 1 => -0.5..0.5f64]), 1..7),
            ),
            1..8,
        ),
    ) {
        let settings = Arc::new(Effective::default());
        let vertices = (0..200).map(|at| of_zigzag(at, (0.0, 0.0, 0.0))).collect();
        let mut drawing = Drawing::new(None);
        let polyline = drawing.push(entity(Geometry::Polyline { closed, vertices }, None));
        let mut analysis = Analysis::new(&drawing, settings.clone());
        analysis.findings(&drawing, usize::MAX);
        for (from, fewer, moved) in edits {
            let count = moved.len() - fewer;
            let insert: Vec<Vertex> = (from..).zip(moved).map(|(at, by)| of_zigzag(at, by)).collect();
            let Ok(touched) = drawing.splice(polyline, from, count, &insert) else {
                continue;
            };
            analysis.update(&drawing, &Delta { touched: vec![touched] });
            let mut fresh = Analysis::new(&drawing, settings.clone());
            prop_assert_eq!(analysis.findings(&drawing, usize::MAX), fresh.findings(&drawing, usize::MAX));
        }
    }
}

#[test]
fn a_contour_that_goes_back_on_itself_has_no_side_wherever_its_area_is_summed_from() {
    let settings = Arc::new(Effective::of(&Settings {
        correction: Some(0.8),
        side: Some(SideSetting::Opening),
        ..Settings::default()
    }));
    for number in 1..60 {
        let place = |share: f64| {
            Point::new(
                0.1 * f64::from(number) + 1.1 * share,
                0.3 + 0.7 / f64::from(number) * share,
            )
        };
        let vertex = |point: Point| Vertex { point, bulge: 0.0 };
        let mut drawing = Drawing::new(None);
        let vertices = [Point::new(-7.3, 91.7), place(9.0), place(4.0)]
            .map(vertex)
            .to_vec();
        let polyline = drawing.push(entity(
            Geometry::Polyline {
                closed: true,
                vertices,
            },
            None,
        ));
        let mut analysis = Analysis::new(&drawing, settings.clone());
        let touched = drawing
            .splice(polyline, 0, 1, &[vertex(place(0.1))])
            .unwrap();
        analysis.update(
            &drawing,
            &Delta {
                touched: vec![touched],
            },
        );
        let mut fresh = Analysis::new(&drawing, settings.clone());
        assert_eq!(
            analysis.findings(&drawing, usize::MAX),
            fresh.findings(&drawing, usize::MAX),
            "{number}"
        );
    }
}

/// Findings and where they lie, entities by their place in the machining order.
fn told(drawing: &Drawing) -> Vec<String> {
    let order = |id| drawing.order().iter().position(|&other| other == id);
    let place = |place: &Place| match *place {
        Place::Segment { entity, segment } => format!("{:?}/{segment}", order(entity)),
        _ => String::new(),
    };
    let (findings, _) =
        Analysis::new(drawing, Arc::new(Effective::default())).findings(drawing, usize::MAX);
    findings
        .iter()
        .map(|finding| {
            format!(
                "{:?} {} {:?}",
                finding.rule,
                place(&finding.place),
                finding.related.iter().map(place).collect::<Vec<_>>()
            )
        })
        .collect()
}

#[test]
fn what_was_drawn_later_in_between_is_told_as_if_it_had_always_stood_there() {
    let triangle = |corners: [(f64, f64); 3]| {
        entity(
            Geometry::Polyline {
                closed: true,
                vertices: corners.map(|(x, y)| Vertex::new(x, y, 0.0)).into(),
            },
            None,
        )
    };
    let outlines = [
        triangle([(0.0, 0.0), (4.0, 4.0), (4.0, 0.0)]),
        triangle([(0.0, 4.0), (4.0, 0.0), (0.0, 0.0)]),
        triangle([(1.0, -1.0), (1.0, 5.0), (2.0, 5.0)]),
        triangle([(0.0, 0.0), (4.0, 4.0), (4.0, 0.0)]),
    ];
    let mut fresh = Drawing::new(None);
    outlines.iter().for_each(|outline| {
        fresh.push(outline.clone());
    });
    for drawn in [[3, 2, 1, 0], [2, 3, 0, 1], [1, 3, 0, 2]] {
        let mut drawing = Drawing::new(None);
        let mut stand: Vec<usize> = Vec::new();
        for at in drawn {
            let position = stand.iter().filter(|&&other| other < at).count();
            stand.push(at);
            drawing.insert_at(position, outlines[at].clone());
        }
        assert_eq!(told(&drawing), told(&fresh), "drawn as {drawn:?}");
    }
    assert!(told(&fresh).len() > 5);
}

#[test]
fn ranks_rise_in_machining_order_however_often_something_goes_in_between() {
    let mut drawing = Drawing::new(None);
    let line = entity(
        Geometry::Line {
            start: Point::origin(),
            end: Point::new(1.0, 0.0),
        },
        None,
    );
    for _ in 0..3 {
        drawing.push(line.clone());
    }
    for at in 0..200 {
        drawing.insert_at(1 + at % 2, line.clone());
    }
    let ranks: Vec<u64> = drawing.order().iter().map(|&id| drawing.rank(id)).collect();
    assert!(ranks.windows(2).all(|pair| pair[0] < pair[1]), "{ranks:?}");
}

/// Contours in the machining order of their first entities.
fn contours(drawing: &Drawing, chains: &Chains) -> Vec<Contour> {
    let mut keys: Vec<_> = drawing
        .order()
        .iter()
        .filter_map(|&id| chains.contour_of(id))
        .collect();
    let mut seen = std::collections::HashSet::new();
    keys.retain(|key| seen.insert(*key));
    keys.iter()
        .filter_map(|&key| chains.get(key).cloned())
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(300), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn many_entities_that_move_at_once_are_chained_as_if_afresh(
        start in proptest::collection::vec(geometry(), 30..60),
        moves in proptest::collection::vec(proptest::collection::vec((0..60usize, geometry(), 0..4usize), 17..40), 1..4),
    ) {
        let mut drawing = Drawing::new(None);
        for geometry in start {
            drawing.push(entity(geometry, None));
        }
        let is_cut = |drawing: &Drawing, id: EntityId| drawing.get(id).is_some_and(|entity| entity.geometry.segment_count() > 0);
        let mut chains = Chains::new(&drawing, 0.01, &|id| is_cut(&drawing, id));
        for batch in moves {
            let touched: Vec<EntityId> = batch
                .into_iter()
                .filter_map(|(at, geometry, kind)| {
                    let id = drawing.order().get(at).copied();
                    match (kind, id) {
                        (0, _) => Some(drawing.insert_at(at, entity(geometry, None))),
                        (1, Some(id)) => drawing.remove(id).map(|_| id),
                        (_, Some(id)) => {
                            drawing.replace(id, entity(geometry, None));
                            Some(id)
                        }
                        (_, None) => None,
                    }
                })
                .collect();
            let rechained = chains.update(&drawing, &touched, &|id| is_cut(&drawing, id));
            let fresh = Chains::new(&drawing, 0.01, &|id| is_cut(&drawing, id));
            prop_assert_eq!(contours(&drawing, &chains), contours(&drawing, &fresh));
            prop_assert!(rechained.gone.iter().all(|&key| chains.get(key).is_none()));
            for &id in drawing.order() {
                prop_assert_eq!(chains.piece_of(id).map(|piece| piece.entity), chains.contour_of(id).map(|_| id));
            }
        }
    }
}

/// Polylines that come near themselves and each other, and a line.
fn typed_text() -> String {
    let outlines: [&[(f64, f64)]; 4] = [
        &[
            (0.0, 0.0),
            (10.0, 0.0),
            (10.0, 4.0),
            (5.1, 4.0),
            (5.1, 1.0),
            (5.0, 1.0),
            (5.0, 4.0),
            (0.0, 4.0),
        ],
        &[(0.0, 4.1), (10.0, 4.1), (10.0, 8.0), (0.0, 8.0)],
        &[(2.0, 9.0), (4.0, 9.0), (4.0, 12.0), (2.0, 9.001)],
        &[(20.0, 0.0), (21.0, 0.0), (20.5, 0.9)],
    ];
    let mut text = String::from("0\nSECTION\n2\nENTITIES\n");
    for (number, outline) in outlines.iter().enumerate() {
        let _ = write!(
            text,
            "0\nLWPOLYLINE\n5\n{:X}\n8\nDIE\n90\n{}\n70\n1\n",
            number + 1,
            outline.len()
        );
        for (at, (x, y)) in outline.iter().enumerate() {
            let _ = write!(
                text,
                "10\n{x}\n20\n{y}\n42\n{}\n",
                if at % 3 == 2 { 0.4 } else { 0.0 }
            );
        }
    }
    text + "0\nLINE\n5\nA\n8\nDIE\n10\n0.0\n20\n9.0\n11\n3.0\n21\n4.05\n0\nENDSEC\n0\nEOF\n"
}

/// Findings with their places in the text, and the contours.
fn shown(document: &mut Document) -> (Vec<String>, Vec<String>) {
    let (findings, _) = document.findings(usize::MAX);
    let line = |finding: &wedm::finding::Finding| {
        let related: Vec<_> = finding
            .related
            .iter()
            .map(|place| document.range_of(place))
            .collect();
        format!(
            "{:?} {:?} {:?} {:?} {related:?}",
            finding.rule,
            finding.severity,
            document.range_of(&finding.place),
            finding.detail
        )
    };
    let findings = findings.iter().map(line).collect();
    let Some(snapshot) = document.snapshot() else {
        return (findings, Vec::new());
    };
    let handles = |contour: &Contour| {
        let pieces = contour.pieces.iter().map(|piece| {
            snapshot
                .drawing
                .get(piece.entity)
                .map(|entity| entity.handle.to_string())
        });
        format!("{:?} {}", pieces.collect::<Vec<_>>(), contour.closed)
    };
    (
        findings,
        snapshot
            .outlines
            .iter()
            .map(|outline| handles(&outline.contour))
            .collect(),
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(300), failure_persistence: None, ..ProptestConfig::default() })]

    /// Somebody types in the numbers of one vertex, now and then elsewhere: the number is none for a while, and is one again.
    #[test]
    fn a_number_that_is_being_typed_is_read_as_if_afresh(
        polyline in 0..4usize,
        vertex in 0..9usize,
        side in 0..3usize,
        strokes in proptest::collection::vec((0..24usize, 0..3usize, prop::sample::select(vec!["", "1", "-", ".", "x", "0.5", "\n"]), 0..12usize), 1..14),
    ) {
        let side = [SideSetting::Both, SideSetting::Auto, SideSetting::Opening][side];
        let settings = Arc::new(Effective::of(&Settings { side: Some(side), ..Settings::default() }));
        let mut text = typed_text();
        let at = text.match_indices("LWPOLYLINE").nth(polyline).map_or(0, |(at, _)| at);
        let home = at + text[at..].match_indices("\n10\n").nth(vertex).map_or(0, |(at, _)| at + 4);
        let mut document = Document::new(Source::Dxf(dxf::Document::read(text.clone().into_bytes())), settings.clone());
        for (along, count, new, elsewhere) in strokes {
            let start = if elsewhere == 0 { along * text.len() / 24 } else { home + along };
            let start = start.min(text.len());
            let range = start..(start + count).min(text.len());
            text.replace_range(range.clone(), new);
            document.edit_text(range, new);
            let mut fresh = Document::new(Source::Dxf(dxf::Document::read(text.clone().into_bytes())), settings.clone());
            prop_assert_eq!(shown(&mut document), shown(&mut fresh), "{}", text);
        }
    }
}

/// What is found, entities by their place in the machining order: that of another drawing with the same entities is the same.
fn found(drawing: &Drawing, mut analysis: Analysis) -> Vec<String> {
    let order: std::collections::HashMap<EntityId, usize> = drawing
        .order()
        .iter()
        .enumerate()
        .map(|(at, &id)| (id, at))
        .collect();
    let place = |place: &Place| match *place {
        Place::Segment { entity, segment } => format!("{:?}/{segment}", order.get(&entity)),
        _ => String::new(),
    };
    let (findings, _) = analysis.findings(drawing, usize::MAX);
    let said = |finding: &wedm::finding::Finding| {
        let related: Vec<String> = finding.related.iter().map(place).collect();
        format!(
            "{:?} {} {:?} {:?}",
            finding.rule,
            place(&finding.place),
            finding.detail,
            related
        )
    };
    findings.iter().map(said).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(300), failure_persistence: None, ..ProptestConfig::default() })]

    /// More lies on and across each other than is compared: what is left out hangs on the drawing alone.
    #[test]
    fn what_is_left_out_is_what_is_left_out_afresh(
        start in proptest::collection::vec((geometry(), role()), 0..40),
        edits in proptest::collection::vec(proptest::collection::vec(edit(), 1..3), 1..10),
        budget in (0..4000u64, 0..200usize),
        side in 0..2usize,
    ) {
        let budget = Budget { looks: budget.0, looks_of_a_segment: 4, most_seen: budget.1 };
        let side = [SideSetting::Both, SideSetting::Opening][side];
        let settings = Effective::of(&Settings { correction: Some(0.3), side: Some(side), ..Settings::default() });
        let settings = Arc::new(Effective { budget, ..settings });
        let mut drawing = Drawing::new(None);
        for (geometry, role) in start {
            drawing.push(entity(geometry, role));
        }
        let mut analysis = Analysis::new(&drawing, settings.clone());
        for batch in edits {
            let touched = batch.iter().filter_map(|edit| apply(&mut drawing, edit)).collect();
            analysis.update(&drawing, &Delta { touched });
            let mut again = Drawing::new(None);
            for &id in drawing.order() {
                again.push(drawing.get(id).unwrap().clone());
            }
            let now = found(&drawing, analysis.clone());
            prop_assert_eq!(&now, &found(&drawing, Analysis::new(&drawing, settings.clone())));
            prop_assert_eq!(&now, &found(&again, Analysis::new(&again, settings.clone())));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(20), failure_persistence: None, ..ProptestConfig::default() })]

    /// A comb finer than the wire, in which enough is seen near its beginning: an edit behind that looks at no more than itself.
    #[test]
    fn a_comb_of_which_the_end_is_not_compared_is_read_as_if_afresh(
        rows in 1..4usize,
        apart in prop::sample::select(vec![1.6, 2.0, 3.0]),
        most_seen in prop_oneof![Just(40usize), Just(200), Just(700), Just(1_000_000)],
        closed in any::<bool>(),
        edits in proptest::collection::vec((0..800usize, -1.0..1.0f64, -1.0..1.0f64, 0..8usize), 1..5),
    ) {
        const ROW: usize = 200;
        let settings = Effective::of(&Settings { correction: Some(0.1), ..Settings::default() });
        let budget = Budget { most_seen, ..settings.budget };
        let settings = Arc::new(Effective { budget, ..settings });
        let vertex = |i: usize| {
            let (row, step) = (i / ROW, i % ROW);
            let along = if row % 2 == 0 { step } else { ROW - 1 - step };
            let point = Point::new(along as f64 * 0.08, row as f64 * apart + (i % 2) as f64 * 1.5);
            Vertex { point, bulge: 0.0 }
        };
        let mut drawing = Drawing::new(None);
        let comb = Geometry::Polyline { closed, vertices: (0..rows * ROW).map(vertex).collect() };
        drawing.push(entity(comb, None));
        let line = Geometry::Line { start: Point::new(-3.0, 0.0), end: Point::new(-3.0, 1.0) };
        drawing.push(entity(line, None));
        let mut analysis = Analysis::new(&drawing, settings.clone());
        for (at, x, y, kind) in edits {
            let at = at % (rows * ROW);
            let point = vertex(at).point + nalgebra::Vector2::new(x, y);
            let moved = Vertex { point, bulge: if kind == 1 { x } else { 0.0 } };
            let edit = match kind {
                0 => Edit::Splice(0, at, 1, vec![moved, moved]),
                2 => Edit::Replace(1, Geometry::Line { start: point, end: Point::new(-3.0, 1.0) }, None),
                _ => Edit::Splice(0, at, 1, vec![moved]),
            };
            let touched = apply(&mut drawing, &edit).into_iter().collect();
            analysis.update(&drawing, &Delta { touched });
            prop_assert_eq!(found(&drawing, analysis.clone()), found(&drawing, Analysis::new(&drawing, settings.clone())));
        }
    }
}
