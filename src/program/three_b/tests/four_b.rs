//! The part's contour in 4B.

use super::{arc, line, path_of};
use crate::geometry::{Point, Segment, turn};
use crate::program::ProofError;
use crate::program::three_b::Document;
use crate::program::three_b::decode::decode;
use crate::program::three_b::parse::{Item, read};
use crate::program::three_b::words::Words;
use crate::program::three_b::write_four_b;
use crate::settings::{Compensation, Effective};

/// A plate of 20 by 10 mm, entered in the middle of its lower side, and its 4B program for a wire on `side` of the travel.
fn four_b(side: crate::finding::Side, last: [f64; 2]) -> Result<String, ProofError> {
    let corners = [
        [10.0, 0.0],
        [20.0, 0.0],
        [20.0, 10.0],
        last,
        [0.0, 0.0],
        [10.0, 0.0],
    ];
    let out = if side == crate::finding::Side::Left {
        3.0
    } else {
        -3.0
    };
    let mut path = path_of(
        corners
            .windows(2)
            .map(|pair| line(pair[0], pair[1]))
            .collect(),
    );
    path.thread_hole = Point::new(10.0, out);
    path.side = Some(side);
    write_four_b(&[path], 1.0, &Effective::default(), None, &mut |_, _| true)
        .map(|program| program.text)
}

#[test]
fn the_parts_contour_in_four_b_turns_in_arcs_only() {
    use crate::finding::Side;
    for (side, concave) in [(Side::Left, true), (Side::Right, false)] {
        let text = four_b(side, [0.0, 10.0]).unwrap();
        let (items, faults) = read(text.as_bytes(), &Words::default());
        assert_eq!(faults, [], "{text}");
        let parts = items.iter().filter_map(|item| {
            if let Item::Block { block, part, .. } = item {
                Some((*block, *part))
            } else {
                None
            }
        });
        let parts: Vec<_> = parts.collect();
        let arcs: Vec<_> = parts.iter().filter_map(|(_, part)| *part).collect();
        assert_eq!((parts.len(), arcs.len()), (11, 4), "{text}");
        assert!(
            arcs.iter()
                .all(|part| part.radius == 101 && part.concave == concave),
            "{text}"
        );
        // The blocks lead back to the thread hole, and the contour is as long as the plate's without its corners.
        let end = parts.iter().fold(Point::origin(), |at, (block, _)| {
            decode(block, at).unwrap().end()
        });
        assert!(end.coords.norm() <= 4.0, "{end:?} {text}");
        assert_eq!(
            (parts[0].0.j, parts[1].0.j, parts[5].0.j),
            (2900, 9899, 19_798),
            "{text}"
        );
    }
    // A corner that its lines are too short for, and a path whose side nobody knows.
    let refused = |program: Result<String, ProofError>, expected: &str| match program {
        Err(refused @ (ProofError::Refused(_) | ProofError::Unwritable(_))) => {
            assert!(refused.to_string().contains(expected), "{refused}")
        }
        other => panic!("{other:?}"),
    };
    refused(
        four_b(Side::Left, [19.95, 10.0]),
        "needs a transition arc of R 0.101 mm at the corner (20.000, 10.000) of 90.0°: none",
    );
    let unknown = write_four_b(
        &[path_of(vec![line([0.0, 0.0], [1.0, 0.0])])],
        1.0,
        &Effective::default(),
        None,
        &mut |_, _| true,
    );
    refused(unknown.map(|program| program.text), "say opening or punch");
    let mut tight = path_of(vec![arc([0.0, 0.0], [0.1, 0.0], [0.1, 0.0], true)]);
    tight.side = Some(Side::Left);
    let tight = write_four_b(&[tight], 1.0, &Effective::default(), None, &mut |_, _| true);
    refused(
        tight.map(|program| program.text),
        "expected more than the correction 0.100 mm",
    );
}

/// Contours from vertices with bulges, the first of them in the middle of a straight side, as 4B; the arcs of the program with their side.
fn part_of(
    vertices: &[[f64; 3]],
    side: crate::finding::Side,
    settings: &Effective,
) -> Result<Vec<(Segment, Option<bool>)>, ProofError> {
    let next = |index: usize| {
        Point::new(
            vertices[(index + 1) % vertices.len()][0],
            vertices[(index + 1) % vertices.len()][1],
        )
    };
    let piece = |(index, &[x, y, bulge]): (usize, &[f64; 3])| {
        Segment::from_bulge(Point::new(x, y), next(index), bulge)
    };
    let mut path = path_of(vertices.iter().enumerate().map(piece).collect());
    path.side = Some(side);
    let program = write_four_b(&[path], 1.0, settings, None, &mut |_, _| true)?;
    let (items, faults) = read(program.text.as_bytes(), &Words::default());
    assert_eq!(faults, [], "{}", program.text);
    let mut at = Point::origin();
    let mut pieces = Vec::new();
    for item in items {
        if let Item::Block { block, part, .. } = item {
            let piece = decode(&block, at).unwrap();
            at = piece.end();
            pieces.push((piece, part.map(|part| part.concave)));
        }
    }
    Ok(pieces)
}

#[test]
fn corners_beside_arcs_get_their_transition_in_four_b() {
    use crate::finding::Side;
    // A side that ends in a half turn, with a corner at both ends of it: line to arc, arc to line; two arcs that meet in a corner.
    let tongue = [
        [0.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [10.0, 4.0, 0.0],
        [8.0, 4.0, 1.0],
        [2.0, 4.0, 0.0],
        [-10.0, 4.0, 0.0],
        [-10.0, 0.0, 0.0],
    ];
    let lens = [
        [0.0, 0.0, 0.0],
        [10.0, 0.0, 0.5],
        [0.0, 8.0, 0.5],
        [-10.0, 0.0, 0.0],
    ];
    let bites = [
        [0.0, 0.0, 0.0],
        [10.0, 0.0, -0.3],
        [0.0, 8.0, -0.3],
        [-10.0, 0.0, 0.0],
    ];
    for (vertices, corners) in [(&tongue[..], 6), (&lens, 3), (&bites, 3)] {
        for side in [Side::Left, Side::Right] {
            let settings = Effective {
                correction: 0.2,
                ..Effective::default()
            };
            let pieces = part_of(vertices, side, &settings).unwrap();
            let transitions = pieces.iter().filter(|(piece, _)| {
                piece
                    .as_arc()
                    .is_some_and(|arc| (200.5..206.0).contains(&arc.radius))
            });
            assert_eq!(
                transitions.count(),
                corners,
                "{vertices:?} {side:?}: {pieces:?}"
            );
            // Between the ways in and out the wire's path joins: every joint is tangent, as far as the grid goes.
            for pair in pieces[1..pieces.len() - 1].windows(2) {
                let kink = turn(pair[0].0.end_tangent(), pair[1].0.start_tangent()).abs();
                assert!(kink * 200.0 <= 3.0, "{kink} {pair:?}");
            }
            // A transition is concave where the wire runs inside of it.
            for (piece, concave) in &pieces {
                let inside = piece
                    .as_arc()
                    .map(|arc| (arc.sweep > 0.0) == (side == Side::Left));
                assert_eq!(*concave, inside, "{piece:?}");
            }
        }
    }
    // No arc of 0.6 mm is tangent to both sides within 0.5 mm of them.
    let narrow = [
        [0.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [10.0, 0.5, 0.4],
        [0.0, 8.0, 0.0],
        [-10.0, 0.0, 0.0],
    ];
    let wide = Effective {
        correction: 0.6,
        ..Effective::default()
    };
    assert!(
        matches!(part_of(&narrow, Side::Left, &wide), Err(ProofError::Unwritable(finding)) if finding.place == crate::finding::Place::Segment { entity: crate::drawing::EntityId(0), segment: 0 })
    );
}

/// A part's contour as 4B assumes the controller's correction; `none` makes it the wire's own path, and its arcs are
/// checked against the correction all the same.
#[test]
fn tight_arcs_of_four_b_are_found_whatever_the_compensation() {
    let arc = |radius: i64, side: &str| {
        format!(
            "B0B1000B1000GYL2\nB{radius}B0B{radius}B{radius}GY{side}NR1\nB1000B0B1000GXL3\nDD\n"
        )
    };
    for compensation in [
        Compensation::None,
        Compensation::Controller,
        Compensation::Path,
    ] {
        let settings = Effective {
            compensation,
            ..Effective::default()
        };
        let tight = |text: &str| {
            let document = Document::read_with(text.as_bytes().to_vec(), &settings);
            document
                .findings()
                .iter()
                .filter(|finding| finding.rule.name() == "small-radius")
                .count()
        };
        assert_eq!(
            (
                tight(&arc(90, "DD")),
                tight(&arc(100, "DD")),
                tight(&arc(101, "DD")),
                tight(&arc(90, "D"))
            ),
            (1, 1, 0, 0)
        );
    }
    let three_b = |compensation| {
        let settings = Effective {
            compensation,
            ..Effective::default()
        };
        let document = Document::read_with(b"B90B0B90GYNR1\nDD\n".to_vec(), &settings);
        document
            .findings()
            .iter()
            .filter(|finding| finding.rule.name() == "small-radius")
            .count()
    };
    assert_eq!(
        [
            Compensation::None,
            Compensation::Controller,
            Compensation::Path
        ]
        .map(three_b),
        [1, 1, 0]
    );
}

proptest::proptest! {
    /// However slight the corner, the transition must not become a block of a micrometre, whose
    /// direction is arbitrary.
    #[test]
    fn a_corner_of_any_turn_is_written(
        turned in 0.0..std::f64::consts::TAU,
        [along, bent] in [0.1..0.9, -5.0..-1.5],
        is_inwards: bool,
        correction in 0.08..0.4,
        bulge in proptest::prop_oneof![proptest::strategy::Just(0.0), 0.02..0.5],
        is_left: bool,
    ) {
        use crate::finding::Side;
        let aside = 10_f64.powf(bent) * 10.0 * if is_inwards { -1.0 } else { 1.0 };
        let outline = [
            [0.0, 0.0, 0.0],
            [10.0, 0.0, 0.0],
            [10.0 + aside, 10.0 * along, bulge],
            [10.0, 10.0, 0.0],
            [-10.0, 10.0, 0.0],
            [-10.0, 0.0, 0.0],
        ];
        let (sine, cosine) = turned.sin_cos();
        let vertices = outline.map(|[x, y, bulge]| [cosine * x - sine * y, sine * x + cosine * y, bulge]);
        let settings = Effective { correction, ..Effective::default() };
        let side = if is_left { Side::Left } else { Side::Right };
        let pieces = part_of(&vertices, side, &settings).unwrap();
        for pair in pieces[1..pieces.len() - 1].windows(2) {
            let kink = turn(pair[0].0.end_tangent(), pair[1].0.start_tangent()).abs();
            proptest::prop_assert!(kink * correction * 1e3 <= 3.01, "{} {:?}", kink, pair);
        }
    }
}
