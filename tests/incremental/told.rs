//! Findings of outlines that are edited.

use super::*;
use crate::size::by_day;

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

/// What local rules saw after a splice has other indices now: in the pieces after, and in a piece that is travelled backwards in
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

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(by_day(1, 4)), failure_persistence: None, ..ProptestConfig::default() })]

    /// Of many runs, in rows over each other, with teeth that are pointed or square: what depends on runs that an edit does not reach
    /// is kept, also while a vertex that is thrown across them makes the contour cross itself.
    #[test]
    fn dead_ends_of_many_runs_are_told_as_if_afresh(
        closed in any::<bool>(),
        side in prop::sample::select(vec![SideSetting::Both, SideSetting::Opening, SideSetting::Auto]),
        square in any::<bool>(),
        row in prop::sample::select(vec![130usize, 400, 2_000]),
        edits in proptest::collection::vec(
            (0..900usize, prop_oneof![3 => -0.1..0.1f64, 1 => -30.0..30.0f64], prop_oneof![3 => -0.8..0.8f64, 1 => -6.0..6.0f64], prop_oneof![8 => Just(0), 1 => Just(1)]),
            1..5,
        ),
    ) {
        let at = |index: usize, (x, y): (f64, f64)| {
            let (line, step) = (index / row, index % row);
            let along = if line % 2 == 0 { step } else { row - 1 - step };
            let (across, tooth) = if square { (along / 2, along.div_ceil(2) % 2) } else { (along, along % 2) };
            Vertex::new(across as f64 * 0.08 + x, line as f64 * 3.0 + tooth as f64 * 1.5 + y, 0.0)
        };
        let settings = Arc::new(Effective::of(&Settings { side: Some(side), ..Settings::default() }));
        let vertices = (0..900).map(|index| at(index, (0.0, 0.0))).collect();
        let mut drawing = Drawing::new(None);
        let polyline = drawing.push(entity(Geometry::Polyline { closed, vertices }, None));
        let mut analysis = Analysis::new(&drawing, settings.clone());
        analysis.findings(&drawing, 500);
        // While no vertex has been removed, what was moved comes back to where it was.
        let mut at_rest = Some(Analysis::new(&drawing, settings.clone()).findings(&drawing, usize::MAX));
        for (index, x, y, removed) in edits {
            at_rest = at_rest.filter(|_| removed == 0);
            for moved in [(x, y), (0.0, 0.0)] {
                let Ok(touched) = drawing.splice(polyline, index, 1 + removed, &[at(index, moved)]) else {
                    continue;
                };
                analysis.update(&drawing, &Delta { touched: vec![touched] });
                let known = at_rest.clone().filter(|_| moved == (0.0, 0.0));
                let afresh = || Analysis::new(&drawing, settings.clone()).findings(&drawing, usize::MAX);
                prop_assert_eq!(analysis.findings(&drawing, usize::MAX), known.unwrap_or_else(afresh));
            }
        }
    }
}

/// A notch that tapers leaves something of itself to a wire outside of the contour alone: which side that is depends on the contour about it.
#[test]
fn dead_ends_are_told_where_another_contour_turns_the_wire_to_their_side() {
    let settings = Arc::new(Effective::of(&Settings {
        side: Some(SideSetting::Auto),
        ..Settings::default()
    }));
    let ring = |corners: &[[f64; 2]]| {
        let vertices = corners.iter().map(|[x, y]| Vertex::new(*x, *y, 0.0));
        let vertices = vertices.collect();
        entity(
            Geometry::Polyline {
                closed: true,
                vertices,
            },
            None,
        )
    };
    let mut drawing = Drawing::new(None);
    drawing.push(ring(&[
        [0.0, 0.0],
        [10.0, 0.0],
        [10.0, 10.0],
        [5.15, 10.0],
        [5.05, 9.0],
        [4.95, 9.0],
        [4.85, 10.0],
        [0.0, 10.0],
    ]));
    let about = |far: f64| ring(&[[-far, -far], [20.0, -far], [20.0, 20.0], [-far, 20.0]]);
    let other = drawing.push(about(5.0));
    let mut analysis = Analysis::new(&drawing, settings.clone());
    let mut told = Vec::new();
    for far in [5.0, -15.0, 5.0, -15.0] {
        drawing.replace(other, about(far));
        let touched = vec![Touched::Entity { entity: other }];
        analysis.update(&drawing, &Delta { touched });
        let now = analysis.findings(&drawing, usize::MAX);
        let mut fresh = Analysis::new(&drawing, settings.clone());
        assert_eq!(now, fresh.findings(&drawing, usize::MAX), "{far}");
        let lost =
            |finding: &&wedm::finding::Finding| finding.rule == wedm::finding::Rule::LostPocket;
        told.push(now.0.iter().filter(lost).count());
    }
    assert!(told.contains(&0) && told.contains(&1), "{told:?}");
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

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(by_day(150, 400)), failure_persistence: None, ..ProptestConfig::default() })]

    /// Whether an arc that is too tight can be replaced depends on all of its run, and on what the run meets.
    #[test]
    fn what_crowded_arcs_are_told_is_told_as_if_afresh(
        bulges in proptest::collection::vec(prop_oneof![Just(0.9), Just(0.3), Just(0.0), -1.0..1.0f64], 2..9),
        size in prop_oneof![Just(0.04), Just(0.1), Just(0.3)],
        edits in proptest::collection::vec((0..9usize, prop_oneof![Just(0.0), Just(0.05), Just(0.5), -1.0..1.0f64]), 1..4),
    ) {
        let count = bulges.len();
        let at = |index: usize, bulge: f64| {
            let (sine, cosine) = (index as f64 / count as f64 * std::f64::consts::TAU).sin_cos();
            let away = size * [1.0, 0.7][index % 2];
            Vertex::new(away * cosine, away * sine, bulge)
        };
        let vertices = bulges.iter().enumerate().map(|(index, &bulge)| at(index, bulge)).collect();
        let mut drawing = Drawing::new(None);
        let polyline = drawing.push(entity(Geometry::Polyline { closed: true, vertices }, None));
        let settings = Arc::new(Effective::default());
        let mut analysis = Analysis::new(&drawing, settings.clone());
        analysis.findings(&drawing, usize::MAX);
        for (index, bulge) in edits {
            let index = index % count;
            let touched = drawing.splice(polyline, index, 1, &[at(index, bulge)]).unwrap();
            analysis.update(&drawing, &Delta { touched: vec![touched] });
            let mut fresh = Analysis::new(&drawing, settings.clone());
            prop_assert_eq!(analysis.findings(&drawing, usize::MAX), fresh.findings(&drawing, usize::MAX));
        }
    }
}
