//! Text, blocks and paths compared with each other.

mod drift;
mod four_b;
mod random;
mod reading;

use super::Document;
use super::block::Block;
use super::parse::{Item, read};
use super::words::Words;
use super::write::{write, write_with};
use crate::drawing::EntityId;
use crate::geometry::{Arc, Point, Segment};
use crate::program::numbering::Renumbering;
use crate::program::{ProofError, ProvedProgram};
use crate::settings::{Effective, Jumps, Layout};
use crate::toolpath::{PathSegment, Source, WirePath};

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
    WirePath::along(thread_hole, segments)
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
        let pieces = findings.iter().map(|finding| {
            document.offered(finding, Renumbering::Offered)[0].edit[0]
                .text
                .lines()
                .count()
        });
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
fn the_wire_is_taken_to_the_next_contour_where_its_coordinates_say_so() {
    let square = |x: f64, y: f64| {
        let corners = [
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 5.0],
            [-2.0, 5.0],
            [-2.0, 0.0],
            [2.0, 0.0],
            [0.0, 0.0],
        ];
        let at = corners.map(|[a, b]| [a + x, b + y]);
        path_of(at.windows(2).map(|pair| line(pair[0], pair[1])).collect())
    };
    let settings = Effective {
        jumps: Jumps::None,
        layout: Layout::Checking,
        header: true,
        ..Effective::default()
    };
    let places = [[0.0, 0.0], [30.0, 1.0], [30.0, -40.0], [0.35, 0.2]];
    let paths = places.map(|[x, y]| square(x, y));
    let text = write(&paths, 1.0, &settings).expect("a program").text;
    let document = Document::read(text.clone().into_bytes());
    assert_eq!(document.findings(), [], "{text}");
    let all = crate::program::convert::cuts(&crate::program::Document::ThreeB(document.clone()));
    let begins: Vec<[f64; 2]> = all
        .cuts
        .iter()
        .map(|cut| cut.segments[0].start() / 1e3)
        .map(|at| [at.x, at.y])
        .collect();
    assert_eq!(begins, places);
    // Each refactoring keeps them where they are, relative to the start.
    let trace = document.trace();
    assert_eq!(trace.end(), Point::new(350.0, 200.0));
    // A wrong number in a second pass from the same hole takes the wire nowhere.
    let twice = write(&[square(0.0, 0.0), square(0.0, 0.0)], 1.0, &settings)
        .expect("a program")
        .text;
    let behind = twice.find("D\n").unwrap();
    let slip = twice[behind..].replacen(
        "B   2000 B      0 B   2000",
        "B   2900 B      0 B   2900",
        1,
    );
    let wrong = Document::read(format!("{}{slip}", &twice[..behind]).into_bytes());
    let rules: Vec<&str> = wrong
        .findings()
        .iter()
        .map(|finding| finding.rule.name())
        .collect();
    assert!(rules.contains(&"position-mismatch"), "{rules:?}");
    // An edit says the same as a fresh reading, wherever it is.
    for at in (0..text.len()).step_by(7) {
        for new in ["", "7", "D\n"] {
            let mut edited = document.clone();
            edited.edit(at..at + 1, new);
            let fresh = Document::read(edited.text().bytes().to_vec());
            assert_eq!(edited.trace(), fresh.trace(), "{at} {new:?}");
            assert_eq!(edited.findings(), fresh.findings(), "{at} {new:?}");
        }
    }
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
    let outcome = write_with(
        &paths,
        1.0,
        &Effective::default(),
        None,
        &mut |done, total| {
            heard.push((done, total));
            done < 8000
        },
    );
    assert_eq!(outcome, Err(ProofError::Cancelled));
    assert_eq!(heard, [(0, 10_000), (4096, 10_000), (8192, 10_000)]);
}
