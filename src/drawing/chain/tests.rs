//! Contours of small drawings, whatever the order of their entities; after each edit they equal a fresh chaining.

mod kept;

use super::*;
use crate::drawing::joints::CROWD;
use crate::drawing::{Entity, Geometry, Vertex};
use proptest::prelude::*;
use std::collections::BTreeSet;

type Coordinates = (f64, f64, f64, f64);

fn lines(lines: &[Coordinates]) -> Drawing {
    let mut drawing = Drawing::new(None);
    for (i, &(x0, y0, x1, y1)) in lines.iter().enumerate() {
        let geometry = Geometry::Line {
            start: Point::new(x0, y0),
            end: Point::new(x1, y1),
        };
        drawing.push(Entity {
            handle: format!("{i}").into(),
            layer: "0".into(),
            role: None,
            kind: crate::drawing::Kind::Line,
            geometry,
        });
    }
    drawing
}

/// Contours as text, in machining order: entity numbers in order of travel, `'` where reversed, `o` where closed.
fn check(input: &[Coordinates], expected: &[&str]) {
    let drawing = lines(input);
    let chains = Chains::new(&drawing, 0.01, &|_| true);
    let mut keys: Vec<Key> = drawing
        .order()
        .iter()
        .filter_map(|&id| chains.contour_of(id))
        .collect();
    keys.dedup();
    keys.sort_unstable_by_key(|key| {
        chains
            .get(*key)
            .map(|contour| contour.pieces.iter().map(|piece| piece.entity).min())
    });
    keys.dedup();
    let text = |key: &Key| {
        let contour = chains.get(*key).unwrap();
        let pieces = contour
            .pieces
            .iter()
            .map(|p| format!("{}{}", p.entity.0, if p.reversed { "'" } else { "" }));
        pieces.collect::<Vec<_>>().join(" ") + if contour.closed { " o" } else { "" }
    };
    assert_eq!(keys.iter().map(text).collect::<Vec<_>>(), expected);
}

#[test]
fn a_square_out_of_order_and_half_turned_about_is_one_loop() {
    check(
        &[
            (0.0, 0.0, 1.0, 0.0),
            (1.0, 1.0, 0.0, 1.0),
            (1.0, 1.0, 1.0, 0.0),
            (0.0, 0.0, 0.0, 1.0),
        ],
        &["0 2' 1 3' o"],
    );
}

#[test]
fn gaps_up_to_the_tolerance_are_joined_and_wider_ones_are_not() {
    check(
        &[
            (0.0, 0.0, 1.0, 0.0),
            (1.009, 0.0, 1.0, 1.0),
            (1.0, 1.0, 0.0, 0.0),
        ],
        &["0 1 2 o"],
    );
    check(
        &[
            (0.0, 0.0, 1.0, 0.0),
            (1.02, 0.0, 1.0, 1.0),
            (1.0, 1.0, 0.0, 0.0),
        ],
        &["1 2 0"],
    );
}

#[test]
fn two_loops_that_touch_in_a_point_stay_two() {
    let (one, other) = (
        [
            (0.0, 0.0, 1.0, 0.0),
            (1.0, 0.0, 0.0, 1.0),
            (0.0, 1.0, 0.0, 0.0),
        ],
        [
            (0.0, 0.0, -1.0, 0.0),
            (-1.0, 0.0, 0.0, -1.0),
            (0.0, -1.0, 0.0, 0.0),
        ],
    );
    check(&[one, other].concat(), &["0 1 2 o", "3 4 5 o"]);
}

#[test]
fn a_lead_line_is_no_part_of_the_loop_that_it_leads_to() {
    check(
        &[
            (2.0, 0.0, 1.0, 0.0),
            (1.0, 0.0, 0.0, 1.0),
            (0.0, 1.0, -1.0, 0.0),
            (-1.0, 0.0, 1.0, 0.0),
        ],
        &["0", "1 2 3 o"],
    );
}

#[test]
fn a_line_shorter_than_the_tolerance_is_not_skipped() {
    check(
        &[
            (0.0, 0.0, 1.0, 0.0),
            (1.0, 0.0, 1.005, 0.0),
            (1.005, 0.0, 1.0, 1.0),
            (1.0, 1.0, 0.0, 0.0),
        ],
        &["0 1 2 3 o"],
    );
    check(&[(0.0, 0.0, 0.005, 0.0)], &["0"]);
}

/// Handles of the entities of each contour, and whether it is closed.
type Sets = BTreeSet<(BTreeSet<String>, bool)>;

/// The contours of lines and, by bulge, arcs, drawn in an order; the handles tell the entities apart.
fn sets(shapes: &[(f64, f64, f64, f64, f64)], order: &[usize]) -> Sets {
    let mut drawing = Drawing::new(None);
    for &number in order {
        let (x0, y0, x1, y1, bulge) = shapes[number];
        let vertices = vec![Vertex::new(x0, y0, bulge), Vertex::new(x1, y1, 0.0)];
        let geometry = match bulge {
            0.0 => Geometry::Line {
                start: Point::new(x0, y0),
                end: Point::new(x1, y1),
            },
            _ => Geometry::Polyline {
                closed: false,
                vertices,
            },
        };
        let kind = crate::drawing::Kind::Line;
        drawing.push(Entity {
            handle: format!("{number}").into(),
            layer: "0".into(),
            role: None,
            kind,
            geometry,
        });
    }
    let chains = Chains::new(&drawing, 0.01, &|_| true);
    let handle = |piece: &Piece| drawing.get(piece.entity).unwrap().handle.to_string();
    let set = |key: Key| {
        chains
            .get(key)
            .map(|contour| (contour.pieces.iter().map(handle).collect(), contour.closed))
    };
    let sets: Sets = chains.contours.keys().copied().filter_map(set).collect();
    assert_eq!(
        sets.iter().map(|(handles, _)| handles.len()).sum::<usize>(),
        shapes.len(),
        "each entity in one contour"
    );
    sets
}

fn permutations(count: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for number in 0..count {
        all = all
            .iter()
            .flat_map(|begun: &Vec<usize>| {
                (0..=number).map(move |at| {
                    let mut order = begun.clone();
                    order.insert(at, number);
                    order
                })
            })
            .collect();
    }
    all
}

/// Closed contours as text, the same in every order of up to seven entities, each line also with its ends exchanged.
#[track_caller]
fn check_in_every_order(shapes: &[(f64, f64, f64, f64, f64)], closed: &[&str]) {
    let first = sets(shapes, &(0..shapes.len()).collect::<Vec<_>>());
    let loops: Vec<String> = first
        .iter()
        .filter(|(_, closed)| *closed)
        .map(|(handles, _)| handles.iter().cloned().collect::<Vec<_>>().join(" "))
        .collect();
    assert_eq!(loops, closed, "{first:?}");
    for order in permutations(shapes.len()) {
        assert_eq!(sets(shapes, &order), first, "{order:?}");
    }
    let counts = |sets: &Sets| {
        sets.iter()
            .map(|(handles, closed)| (handles.len(), *closed))
            .collect::<BTreeSet<_>>()
    };
    for turned in 0..shapes.len() {
        let mut shapes = shapes.to_vec();
        let (x0, y0, x1, y1, bulge) = shapes[turned];
        shapes[turned] = (x1, y1, x0, y0, -bulge);
        assert_eq!(
            counts(&sets(&shapes, &(0..shapes.len()).collect::<Vec<_>>())),
            counts(&first),
            "{turned} turned round"
        );
    }
}

const SQUARE: [(f64, f64, f64, f64, f64); 4] = [
    (0.0, 0.0, 10.0, 0.0, 0.0),
    (10.0, 0.0, 10.0, 10.0, 0.0),
    (10.0, 10.0, 0.0, 10.0, 0.0),
    (0.0, 10.0, 0.0, 0.0, 0.0),
];

#[test]
fn a_double_does_not_spoil_an_outline_in_any_order() {
    let with = |others: &[(f64, f64, f64, f64, f64)]| [&SQUARE[..], others].concat();
    check_in_every_order(&with(&[(10.0, 0.0, 0.0, 0.0, 0.0)]), &["0 1 2 3"]);
    check_in_every_order(
        &with(&[(0.0, 0.0, 10.0, 0.0, 0.0), (0.0, 0.0, 10.0, 0.0, 0.0)]),
        &["0 1 2 3"],
    );
    check_in_every_order(
        &with(&[(0.0, 0.003, 10.0, 0.002, 0.0), (10.0, 10.0, 10.0, 0.0, 0.0)]),
        &["0 1 2 3"],
    );
    // The one that lies off to the side is left out.
    check_in_every_order(
        &[
            (0.0, -0.004, 10.0, -0.004, 0.0),
            SQUARE[1],
            SQUARE[2],
            SQUARE[3],
            SQUARE[0],
        ],
        &["1 2 3 4"],
    );
    // Two lines in one place, and nothing else, are a double; two arcs on one chord are a circle.
    check_in_every_order(&[SQUARE[0], SQUARE[0]], &[]);
    check_in_every_order(
        &[
            (0.0, 0.0, 10.0, 0.0, 1.0),
            (10.0, 0.0, 0.0, 0.0, 1.0),
            (0.0, 0.0, 10.0, 0.0, 1.0),
        ],
        &["0 1"],
    );
    // Everything twice.
    check_in_every_order(
        &[
            SQUARE[0],
            SQUARE[1],
            (10.0, 10.0, 0.0, 0.0, 0.0),
            SQUARE[0],
            SQUARE[1],
            (0.0, 0.0, 10.0, 10.0, 0.0),
        ],
        &["0 1 2"],
    );
}

#[test]
fn a_line_off_a_corner_does_not_spoil_an_outline_in_any_order() {
    let with = |others: &[(f64, f64, f64, f64, f64)]| [&SQUARE[..], others].concat();
    check_in_every_order(&with(&[(10.0, 10.0, 15.0, 12.0, 0.0)]), &["0 1 2 3"]);
    check_in_every_order(&with(&[(0.0, 0.0, 3.0, 3.0, 0.0)]), &["0 1 2 3"]);
    check_in_every_order(
        &with(&[
            (10.0, 10.0, 15.0, 12.0, 0.0),
            (15.0, 12.0, 20.0, 12.0, 0.4),
            (0.0, 0.0, -3.0, 0.0, 0.0),
        ]),
        &["0 1 2 3"],
    );
    // Off a corner whose own ends are a little apart.
    check_in_every_order(
        &[
            (0.005, 0.0, 10.0, 0.0, 0.0),
            SQUARE[1],
            SQUARE[2],
            SQUARE[3],
            (0.0, 0.0, -5.0, 1.0, 0.0),
        ],
        &["0 1 2 3"],
    );
    // Across: the outline closes, not the line.
    check_in_every_order(&with(&[(0.0, 0.0, 10.0, 10.0, 0.0)]), &["0 1 2 3"]);
    check_in_every_order(
        &with(&[(0.0, 0.0, 10.0, 10.0, 0.2), (0.0, 10.0, -4.0, 14.0, 0.0)]),
        &["0 1 2 3"],
    );
    // Two triangles that share a point, and with a bridge between them.
    let triangles = [
        (0.0, 0.0, 4.0, 2.0, 0.0),
        (4.0, 2.0, 4.0, -2.0, 0.0),
        (4.0, -2.0, 0.0, 0.0, 0.0),
        (0.0, 0.0, -4.0, 2.0, 0.0),
        (-4.0, 2.0, -4.0, -2.0, 0.0),
        (-4.0, -2.0, 0.0, 0.0, 0.0),
    ];
    check_in_every_order(&triangles, &["0 1 2", "3 4 5"]);
    let apart = triangles.map(|(x0, y0, x1, y1, bulge)| {
        if x0 + x1 > 0.0 {
            (x0 + 5.0, y0, x1 + 5.0, y1, bulge)
        } else {
            (x0, y0, x1, y1, bulge)
        }
    });
    check_in_every_order(
        &[&apart[..], &[(0.0, 0.0, 5.0, 0.0, 0.0)]].concat(),
        &["0 1 2", "3 4 5"],
    );
    // Rounded coordinates where two loops meet.
    let rounded = triangles.map(|(x0, y0, x1, y1, bulge)| {
        (x0 + 4e-7 * (y1 - x1), y0, x1, y1 + 3e-7 * (x0 - y0), bulge)
    });
    check_in_every_order(&rounded, &["0 1 2", "3 4 5"]);
}

#[test]
fn crumbs_and_notches_narrower_than_the_tolerance_stay_in_their_outline_in_any_order() {
    check_in_every_order(
        &[
            (0.0, 0.0, 1.0, 0.0, 0.0),
            (1.0, 0.0, 1.005, 0.0, 0.0),
            (1.005, 0.0, 1.0, 1.0, 0.0),
            (1.0, 1.0, 0.0, 0.0, 0.0),
        ],
        &["0 1 2 3"],
    );
    check_in_every_order(
        &[
            SQUARE[0],
            SQUARE[1],
            SQUARE[2],
            (0.0, 10.0, 0.0, 0.008, 0.0),
            (0.0, 0.008, 5.0, 0.002, 0.0),
            (5.0, 0.002, 0.0, 0.0, 0.0),
        ],
        &["0 1 2 3 4 5"],
    );
    // A triangle of crumbs.
    check_in_every_order(
        &[
            (0.0, 0.0, 0.006, 0.0, 0.0),
            (0.006, 0.0, 0.0, 0.006, 0.0),
            (0.0, 0.006, 0.0, 0.0, 0.0),
        ],
        &["0 1 2"],
    );
}

/// A number of lines that start near one point, and a triangle with a corner there.
fn star(count: usize) -> Drawing {
    let line = |number: usize| {
        let angle = number as f64 * 0.003;
        let (x, y) = (
            1.001 + 0.0001 * (number % 7) as f64,
            1.001 + 0.0001 * (number % 11) as f64,
        );
        (x, y, x + 9.0 * angle.cos(), y + 9.0 * angle.sin())
    };
    let triangle = [
        (1.001, 1.001, -5.0, 1.0),
        (-5.0, 1.0, -5.0, -5.0),
        (-5.0, -5.0, 1.0012, 1.0011),
    ];
    lines(&(0..count).map(line).chain(triangle).collect::<Vec<_>>())
}

fn pieces(drawing: &Drawing, chains: &Chains) -> Vec<Vec<(EntityId, bool)>> {
    let mut keys: Vec<Key> = chains.contours.keys().copied().collect();
    keys.sort_unstable_by_key(|&key| drawing.rank(chains.first_of(key).unwrap()));
    let pieces = |key| {
        chains
            .get(key)
            .unwrap()
            .pieces
            .iter()
            .map(|piece| (piece.entity, piece.reversed))
            .collect()
    };
    keys.into_iter().map(pieces).collect()
}

#[test]
fn thousands_of_ends_nearly_in_one_point_are_chained_in_machining_order() {
    let count = 8 * CROWD;
    let drawing = star(count);
    let chains = Chains::new(&drawing, 0.01, &|_| true);
    let id = |number: usize| EntityId(number as u32);
    let pair = |pair: usize| vec![(id(2 * pair + 1), true), (id(2 * pair), false)];
    let mut expected: Vec<Vec<(EntityId, bool)>> = (0..count / 2).map(pair).collect();
    expected.push([0, 1, 2].map(|number| (id(count + number), false)).to_vec());
    let found = pieces(&drawing, &chains);
    let differs = (0..)
        .zip(&found)
        .zip(&expected)
        .find(|((_, found), expected)| found != expected);
    assert!(
        found.len() == expected.len() && differs.is_none(),
        "{} contours, {differs:?}",
        found.len()
    );
    assert!(
        chains
            .contours
            .keys()
            .copied()
            .filter(|&key| chains.get(key).unwrap().closed)
            .count()
            == 1
    );
}

#[test]
fn an_edit_among_thousands_of_ends_chains_them_as_a_fresh_start_does() {
    let mut drawing = star(CROWD + 40);
    let mut chains = Chains::new(&drawing, 0.01, &|_| true);
    for number in [3, CROWD as u32, 17] {
        drawing.remove(EntityId(number));
        chains.update(&drawing, &[EntityId(number)], &|_| true);
        let fresh = Chains::new(&drawing, 0.01, &|_| true);
        assert!(
            pieces(&drawing, &chains) == pieces(&drawing, &fresh),
            "without entity {number}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// Lines and arcs between a few places, some of them a little apart, in other orders.
    #[test]
    fn contours_do_not_depend_on_the_order_of_entities(
        shapes in prop::collection::vec(((0..3usize, 0..3usize, 0..5usize), (0..3usize, 0..3usize, 0..5usize), 0..6usize), 1..24),
        orders in prop::collection::vec(prop::collection::vec(any::<prop::sample::Index>(), 24), 6),
    ) {
        let off = |number: usize| [0.0, 0.0, 0.004, -0.003, 4e-7][number];
        type Grid = (usize, usize, usize);
        let shape = |&(from, to, bulge): &(Grid, Grid, usize)| {
            let place = |(x, y, n): Grid| (x as f64 * 3.0 + off(n), y as f64 * 2.0 - off((n + 2) % 5));
            let ((x0, y0), (x1, y1)) = (place(from), place(to));
            (x0, y0, x1, y1, [0.0, 0.0, 0.0, 0.3, -0.3, 1.5][bulge])
        };
        let shapes: Vec<_> = shapes.iter().map(shape).filter(|(x0, y0, x1, y1, _)| (x0, y0) != (x1, y1)).collect();
        let first = sets(&shapes, &(0..shapes.len()).collect::<Vec<_>>());
        for picks in orders {
            let mut rest: Vec<usize> = (0..shapes.len()).collect();
            let order: Vec<usize> = picks.iter().map_while(|pick| (!rest.is_empty()).then(|| rest.swap_remove(pick.index(rest.len())))).collect();
            prop_assert_eq!(&sets(&shapes, &order), &first, "{:?} {:?}", order, shapes);
        }
    }

    /// Ends on a few places, some of them a little apart; the first lie on borders of cells.
    #[test]
    fn contours_with_ends_near_each_other_are_of_one_group(
        lines in prop::collection::vec(((0..3usize, 0..4usize), (0..3usize, 0..4usize)), 1..14),
    ) {
        let place = |(at, off): (usize, usize)| at as f64 + [0.0, 0.004, -1e-16, 0.009][off];
        let lines: Vec<Coordinates> = lines.into_iter().map(|(from, to)| (place(from), 0.0, place(to), 0.0)).collect();
        let drawing = self::lines(&lines);
        let chains = Chains::new(&drawing, 0.01, &|_| true);
        let ends: Vec<(EntityId, Point)> =
            drawing.order().iter().filter_map(|&id| Some((id, chains.ends_of(id)?))).flat_map(|(id, (a, b))| [(id, a), (id, b)]).collect();
        for (one, at) in &ends {
            for (other, there) in ends.iter().filter(|(_, there)| (at - there).norm() <= 0.01) {
                let [a, b] = [one, other].map(|id| chains.contour_of(*id).unwrap());
                let group = |key: Key| chains.group_of.get(&key);
                prop_assert!(a == b || (group(a).is_some() && group(a) == group(b)), "{one:?} at {at} and {other:?} at {there}");
            }
        }
    }
}
