//! Text, blocks and paths held against each other.

mod four_b;
mod reading;

use super::Document;
use super::around::StatedPoint;
use super::block::{Block, CountingAxis, Motion, Node, Quadrant};
use super::decode::{DecodeFault, decode};
use super::encode::{ASIDE_TOLERANCE, END_TOLERANCE, Encoded, encode, point_of, snap};
use super::parse::{Item, read};
use super::words::{Word, Words};
use super::write::{write, write_with};
use crate::drawing::EntityId;
use crate::geometry::{Arc, Point, Segment, Vector, direction, turn};
use crate::program::{ProofError, ProvedProgram};
use crate::settings::{Compensation, Effective, Jumps, Layout};
use crate::toolpath::{PathSegment, Source, WirePath};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

fn path_of(segments: Vec<Segment>) -> WirePath {
    let source = Source::Segment {
        entity: EntityId(0),
        segment: 0,
    };
    let thread_hole = segments.first().map_or_else(Point::origin, Segment::start);
    let segments = segments
        .into_iter()
        .map(|geometry| PathSegment { geometry, source })
        .collect();
    WirePath {
        outline: 0,
        pass: 1,
        counter_clockwise: None,
        cut_off: false,
        correction: 0.0,
        thread_hole,
        side: None,
        segments,
    }
}

fn written(segments: Vec<Segment>) -> ProvedProgram {
    write(&[path_of(segments)], 1.0, &Effective::default()).expect("a program")
}

fn blocks(text: &str) -> Vec<Block> {
    let (items, faults) = read(text.as_bytes(), &Words::default());
    assert_eq!(faults, [], "{text}");
    items
        .iter()
        .filter_map(|item| {
            if let Item::Block { block, .. } = item {
                Some(*block)
            } else {
                None
            }
        })
        .collect()
}

fn line(from: [f64; 2], to: [f64; 2]) -> Segment {
    Segment::line(from.into(), to.into())
}

fn arc(center: [f64; 2], from: [f64; 2], to: [f64; 2], counter_clockwise: bool) -> Segment {
    Segment::Arc(Arc::about(
        center.into(),
        from.into(),
        to.into(),
        counter_clockwise,
    ))
}

/// One piece of path in mm and its compact block.
fn check(segment: Segment, expected: &str) {
    assert_eq!(written(vec![segment]).text, format!("{expected}\nDD\n"));
}

#[test]
fn lines_of_every_quadrant_and_axis() {
    check(line([0.0, 0.0], [17.0, 5.0]), "B17000B5000B17000GXL1");
    check(line([17.0, 5.0], [0.0, 0.0]), "B17000B5000B17000GXL3");
    check(line([0.0, 0.0], [0.0, 21.5]), "B0B21500B21500GYL2");
    check(line([0.0, 0.0], [0.0, -21.5]), "B0B21500B21500GYL4");
    check(line([0.0, 0.0], [3.0, 0.0]), "B3000B0B3000GXL1");
    check(line([0.0, 0.0], [-3.0, 0.0]), "B3000B0B3000GXL3");
    check(line([0.0, 0.0], [5.0, 5.0]), "B5000B5000B5000GYL1");
    check(line([0.0, 0.0], [-5.0, 5.0]), "B5000B5000B5000GXL2");
    check(line([0.0, 0.0], [-5.0, -5.0]), "B5000B5000B5000GYL3");
    check(line([0.0, 0.0], [5.0, -5.0]), "B5000B5000B5000GXL4");
}

#[test]
fn arcs_of_the_textbook() {
    check(
        arc([0.0, 0.0], [-2.0, 9.0], [9.0, -2.0], true),
        "B2000B9000B25439GYNR2",
    );
    check(
        arc([0.0, 0.0], [9.0, -2.0], [-2.0, 9.0], false),
        "B9000B2000B25439GXSR4",
    );
    check(
        arc([20.0, 50.0], [50.0, 90.0], [-10.0, 90.0], true),
        "B30000B40000B60000GXNR1",
    );
    check(
        arc([0.0, 0.0], [9.9, 0.0], [9.9, 0.0], true),
        "B9900B0B39600GYNR1",
    );
    check(
        arc([0.0, 0.0], [-4.0, -3.0], [-4.0, -3.0], false),
        "B4000B3000B20000GYSR3",
    );
}

#[test]
fn an_arc_that_starts_on_an_axis_enters_a_quadrant() {
    for (from, to, expected) in [
        ([5.0, 0.0], [0.0, 5.0], "B5000B0B5000GXNR1"),
        ([0.0, 5.0], [-5.0, 0.0], "B0B5000B5000GYNR2"),
        ([-5.0, 0.0], [0.0, -5.0], "B5000B0B5000GXNR3"),
        ([0.0, -5.0], [5.0, 0.0], "B0B5000B5000GYNR4"),
    ] {
        check(arc([0.0, 0.0], from, to, true), expected);
    }
    for (from, to, expected) in [
        ([5.0, 0.0], [0.0, -5.0], "B5000B0B5000GXSR4"),
        ([0.0, 5.0], [5.0, 0.0], "B0B5000B5000GYSR1"),
        ([-5.0, 0.0], [0.0, 5.0], "B5000B0B5000GXSR2"),
        ([0.0, -5.0], [-5.0, 0.0], "B0B5000B5000GYSR3"),
    ] {
        check(arc([0.0, 0.0], from, to, false), expected);
    }
}

#[test]
fn long_pieces_are_split_below_the_digit_limit() {
    for segment in [
        line([0.0, 0.0], [2500.0, 1.0]),
        line([-1e5, 3.0], [1e5, -7.0]),
        arc([0.0, 0.0], [400.0, 0.0], [400.0, 0.0], true),
        arc([0.0, 0.0], [0.0, 700.0], [0.001, 700.0], true),
        arc(
            [0.0, -5000.0],
            [0.0, 0.0],
            [100.0, (5000.0_f64.powi(2) - 1e4).sqrt() - 5000.0],
            false,
        ),
    ] {
        for digits in [5, 6, 7, 9] {
            let settings = Effective {
                digits,
                ..Effective::default()
            };
            let program = write(&[path_of(vec![segment])], 1.0, &settings).expect("a program");
            let blocks = blocks(&program.text);
            let largest = settings.largest_number();
            assert!(
                blocks.iter().all(|b| b.x.max(b.y).max(b.j) <= largest),
                "{segment:?}: {blocks:?}"
            );
            let counted: i64 = blocks.iter().map(|b| b.j).sum();
            assert!(
                blocks.len() > 1 || counted <= largest,
                "{segment:?} with {digits} digits: {blocks:?}"
            );
            assert!((program.length - segment.length()).abs() < 1e-6);
        }
    }
}

#[test]
fn how_many_digits_a_controller_has_is_a_setting() {
    let text = "B1500000B0B1500000GXL1\nB0B1500000B1500000GYL2\nB1500000B0B1500000GXL3\nB0B1500000B1500000GYL4\nDD\n";
    let faults = |digits: u32| {
        let settings = Effective {
            digits,
            ..Effective::default()
        };
        let document = Document::read_with(text.as_bytes().to_vec(), &settings);
        let findings = document.findings();
        assert!(
            findings
                .iter()
                .all(|finding| finding.rule.name() == "too-many-digits"),
            "{findings:?}"
        );
        let pieces = findings
            .iter()
            .map(|finding| document.fixes(finding)[0].edit[0].text.lines().count());
        (findings.len(), pieces.max())
    };
    assert_eq!(
        [5, 6, 7].map(faults),
        [(4, Some(16)), (4, Some(2)), (0, None)]
    );
}

#[test]
fn pieces_without_length_on_the_grid_are_left_out() {
    let program = written(vec![
        line([0.0, 0.0], [1.0, 0.0]),
        line([1.0, 0.0], [1.0002, 0.0]),
        arc([1.0002, 0.0], [1.0002, 0.0], [1.0002, 0.0], true),
        line([1.0002, 0.0], [1.0, 1.0]),
    ]);
    assert_eq!(program.text, "B1000B0B1000GXL1\nB0B1000B1000GYL2\nDD\n");
}

#[test]
fn several_contours_are_joined_by_pauses_and_a_jump() {
    let paths = [
        path_of(vec![line([0.0, 0.0], [1.0, 0.0])]),
        path_of(vec![line([5.0, 2.0], [5.0, 3.0])]),
    ];
    let text = |jumps, layout| {
        write(
            &paths,
            1.0,
            &Effective {
                jumps,
                layout,
                header: layout != Layout::Compact,
                ..Effective::default()
            },
        )
        .expect("a program")
    };
    let with = text(Jumps::Blocks, Layout::Compact);
    assert_eq!(
        with.text,
        "B1000B0B1000GXL1\nD\nB4000B2000B4000GXL1\nD\nB0B1000B1000GYL2\nDD\n"
    );
    // The jump is a block, and no cut.
    assert_eq!(
        (with.blocks, with.length, with.jumps),
        (3, 2.0, 20.0_f64.sqrt())
    );
    let without = text(Jumps::None, Layout::Compact);
    assert_eq!(without.text, "B1000B0B1000GXL1\nD\nB0B1000B1000GYL2\nDD\n");
    assert_eq!(
        text(Jumps::Blocks, Layout::Checking).text,
        "; Start Point = 0.000 , 0.000\n\
         N    1: B   1000 B      0 B   1000 GX L1  ;      1.000 ,      0.000\n\
         D\n\
         N    2: B   4000 B   2000 B   4000 GX L1  ;      5.000 ,      2.000\n\
         D\n\
         N    3: B      0 B   1000 B   1000 GY L2  ;      5.000 ,      3.000\n\
         DD\n"
    );
    assert!(
        text(Jumps::Blocks, Layout::Aligned)
            .text
            .starts_with("; Start Point = 0.000 , 0.000\nB   1000 B      0 B   1000 GX L1\nD\n")
    );
}

#[test]
fn what_is_not_a_path_is_never_a_program() {
    let gap = [path_of(vec![
        line([0.0, 0.0], [1.0, 0.0]),
        line([1.1, 0.0], [2.0, 0.0]),
    ])];
    let far = [path_of(vec![line([0.0, 0.0], [1e12, 0.0])])];
    let lost = [path_of(vec![line([0.0, 0.0], [f64::NAN, 0.0])])];
    assert!(matches!(
        write(&gap, 1.0, &Effective::default()),
        Err(ProofError::Mismatch(_))
    ));
    // No number holds these: the drawing's fault, not ours.
    for paths in [&far[..], &lost, &[]] {
        assert!(matches!(
            write(paths, 1.0, &Effective::default()),
            Err(ProofError::Refused(_))
        ));
    }
    let odd = Effective {
        end: "B1B2\nDD".into(),
        ..Effective::default()
    };
    assert!(write(&[path_of(vec![line([0.0, 0.0], [1.0, 0.0])])], 1.0, &odd).is_err());
}

#[test]
fn a_program_that_is_not_wanted_any_more_ends() {
    let paths = [path_of(
        (0..10_000)
            .map(|i| line([f64::from(i), 0.0], [f64::from(i + 1), 0.0]))
            .collect(),
    )];
    let mut heard = Vec::new();
    let outcome = write_with(&paths, 1.0, &Effective::default(), &mut |done, total| {
        heard.push((done, total));
        done < 8000
    });
    assert_eq!(outcome, Err(ProofError::Cancelled));
    assert_eq!(heard, [(0, 10_000), (4096, 10_000), (8192, 10_000)]);
}

/// A closed path of lines and arcs about the origin, in mm: vertices on a wavy ring, a bulge for each side.
fn closed_path() -> impl Strategy<Value = Vec<Segment>> {
    prop::collection::vec(
        (
            0.3_f64..40.0,
            prop_oneof![Just(0.0), -1.5_f64..1.5, -1e-3..1e-3],
        ),
        3..24,
    )
    .prop_map(|sides| {
        let count = sides.len();
        let vertex = |index: usize| {
            Point::origin() + direction(TAU * index as f64 / count as f64) * sides[index].0
        };
        (0..count)
            .map(|index| {
                Segment::from_bulge(vertex(index), vertex((index + 1) % count), sides[index].1)
            })
            .collect()
    })
}

/// The path turned, mirrored, shifted and travelled backwards.
fn moved(
    path: &[Segment],
    angle: f64,
    mirror: bool,
    shift: Vector,
    backwards: bool,
) -> Vec<Segment> {
    let (cos, sin) = (angle.cos(), angle.sin());
    let place = |p: Point| {
        let y = if mirror { -p.y } else { p.y };
        Point::new(p.x * cos - y * sin, p.x * sin + y * cos) + shift
    };
    let segment = |s: &Segment| {
        Segment::from_bulge(
            place(s.start()),
            place(s.end()),
            if mirror { -s.bulge() } else { s.bulge() },
        )
    };
    let mut moved: Vec<Segment> = path.iter().map(segment).collect();
    if backwards {
        moved.reverse();
        moved = moved.iter().map(Segment::reversed).collect();
    }
    moved
}

/// Each arc misses its end by the same part of a micrometre: a controller that counts would drift on and on.
#[test]
fn equal_arcs_in_a_row_do_not_drift() {
    for (pitch, bulge) in [
        (1.0, 0.37),
        (0.777, -0.61),
        (2.5, 1.0),
        (0.3, 0.9),
        (1.001, 0.173),
    ] {
        let count = 600;
        let at = |index: usize| Point::new(index as f64 * pitch, 0.0);
        let mut path: Vec<Segment> = (0..count)
            .map(|index| Segment::from_bulge(at(index), at(index + 1), bulge))
            .collect();
        let corners = [
            at(count),
            Point::new(count as f64 * pitch, 50.0),
            Point::new(0.0, 50.0),
            at(0),
        ];
        path.extend(
            corners
                .windows(2)
                .map(|pair| Segment::line(pair[0], pair[1])),
        );
        let program = written(path);
        let drift = program.closure[0].hypot(program.closure[1]);
        assert!(
            drift <= crate::program::path::tolerance(count),
            "{pitch} {bulge}: {drift}"
        );
        assert!(
            program.deviation <= 2.0,
            "{pitch} {bulge}: {}",
            program.deviation
        );
    }
}

fn any_block() -> impl Strategy<Value = Block> {
    let number = || prop_oneof![0_i64..20, 0_i64..1_000_000, 0_i64..1_000_000_000_000];
    (
        number(),
        number(),
        number(),
        any::<bool>(),
        1_u8..=4,
        0_usize..3,
    )
        .prop_map(|(x, y, j, on_x, quadrant, kind)| {
            let quadrant = Quadrant::from_number(quadrant).expect("1 to 4");
            let motion = [
                Motion::Line(quadrant),
                Motion::Clockwise(quadrant),
                Motion::CounterClockwise(quadrant),
            ][kind];
            Block {
                x,
                y,
                j,
                axis: if on_x {
                    CountingAxis::X
                } else {
                    CountingAxis::Y
                },
                motion,
            }
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_written_program_decodes_to_its_path(
        path in closed_path(), angle in -PI..PI, mirror: bool, backwards: bool,
        shift in prop_oneof![Just([0.0, 0.0]), [-1e5_f64..1e5, -1e5_f64..1e5]],
    ) {
        let path = moved(&path, angle, mirror, Vector::from(shift), backwards);
        let program = written(path.clone());
        // Over whole blocks: their ends are snapped, arcs run about centres on the grid, J is rounded.
        prop_assert!(program.deviation <= ASIDE_TOLERANCE, "{}", program.deviation);
        // Decoded from the text alone, from end to end, as a controller runs it.
        let mut at = point_of(snap(path[0].start() * 1000.0).expect("near"));
        let (begin, mut arcs) = (at, 0);
        for block in blocks(&program.text) {
            let decoded = decode(&block, at).expect("a decodable block");
            arcs += usize::from(decoded.as_arc().is_some());
            at = decoded.end();
        }
        let drift = at - begin;
        prop_assert!((drift - Vector::from(program.closure)).norm() < 1e-6 * (1.0 + begin.coords.norm() * 1e-6));
        prop_assert!(drift.norm() <= crate::program::path::tolerance(arcs));
    }

    #[test]
    fn single_arcs_of_any_size_stay_on_their_path(
        radius in prop_oneof![0.0005_f64..0.02, 0.02..2.0, 2.0..300.0, 300.0..3e3], start in -PI..PI, sweep in prop_oneof![-TAU..TAU, -0.01..0.01],
        center in [-50.0_f64..50.0, -50.0_f64..50.0],
    ) {
        let arc = Arc::from_center(Point::from(center) * 1000.0, radius * 1000.0, start, sweep);
        let (from, to) = (snap(arc.start).expect("near"), snap(arc.end).expect("near"));
        let mut encoded: Vec<Encoded> = Vec::new();
        prop_assert!(encode(&Segment::Arc(arc), from, to, Effective::default().largest_number(), &mut encoded).is_some());
        let mut node = from;
        for block in &encoded {
            prop_assert_eq!(block.from, node);
            node = block.to;
            prop_assert!(block.block.x.max(block.block.y).max(block.block.j) <= Effective::default().largest_number());
            let decoded = decode(&block.block, point_of(block.from)).expect("a decodable block");
            prop_assert!((decoded.end() - point_of(block.to)).norm() <= END_TOLERANCE);
            for share in [0.1, 0.3, 0.5, 0.7, 0.9] {
                let distance = arc.distance_to(decoded.point_at(share));
                prop_assert!(distance <= 2.6, "{:?} runs {} µm beside", block, distance);
            }
        }
        prop_assert_eq!(node, to);
    }

    #[test]
    fn every_layout_reads_back_as_the_same_blocks(list in prop::collection::vec(any_block(), 1..20)) {
        for layout in [Layout::Compact, Layout::Aligned, Layout::Checking] {
            let mut out = Vec::new();
            for (index, block) in list.iter().enumerate() {
                super::layout::push_block(&mut out, layout, index + 1, block, None, Node { x: -block.x, y: block.y });
            }
            prop_assert_eq!(&blocks(&String::from_utf8(out).expect("ASCII")), &list);
        }
    }

    #[test]
    fn reading_and_decoding_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200), block in any_block()) {
        let (_, faults) = read(&bytes, &Words { pause: "", end: "" });
        for fault in faults {
            prop_assert!(fault.range.start <= fault.range.end && fault.range.end <= bytes.len());
        }
        if let Ok(decoded) = decode(&block, Point::origin()) {
            prop_assert!(decoded.end().x.is_finite() && decoded.end().y.is_finite());
        }
    }

    #[test]
    fn damaged_programs_never_panic(text in "(N?[0-9]{0,3}:? ?[Bb][0-9]{0,22} ?B[0-9]{0,5}B[0-9]{0,9} ?G[XYZ]? ?(L|SR|NR|S)?[0-6]?( ?;.{0,9})?[\r\n]{1,2}|DD?\n|Start Point = ){0,8}") {
        for item in read(text.as_bytes(), &Words::default()).0 {
            if let Item::Block { block, .. } = item {
                let _ = decode(&block, Point::new(1e9, -1e9));
            }
        }
    }
}
