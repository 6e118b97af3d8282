//! Passes in one go, as other writers have them: only the words that switch the correction say where one ends.

use super::{Shape, document, settings_of, traced};
use crate::size::by_day;
use wedm::compare::compare;
use wedm::drawing::Role;
use wedm::program::Format;

/// A block: where it leads, mm, and the turn about a centre, if it is an arc.
type Step = ([f64; 2], Option<([f64; 2], bool)>);

/// A contour from its start on, with the hole that the wire is threaded through.
struct Round {
    shape: Vec<[f64; 3]>,
    hole: [f64; 2],
    start: [f64; 2],
    steps: Vec<Step>,
}

fn rectangle() -> Round {
    let corners = [[9.0, -2.0], [9.0, 6.0], [-9.0, 6.0], [-9.0, -2.0]];
    let straight = |[x, y]: [f64; 2]| ([x, y], None);
    Round {
        shape: corners.map(|[x, y]| [x, y, 0.0]).to_vec(),
        hole: [0.0, 0.0],
        start: [0.0, -2.0],
        steps: corners
            .into_iter()
            .chain([[0.0, -2.0]])
            .map(straight)
            .collect(),
    }
}

/// Two corners of it are round.
fn rounded() -> Round {
    let shape = vec![
        [9.0, -2.0, 0.0],
        [9.0, 5.0, 0.41421356237],
        [8.0, 6.0, 0.0],
        [-9.0, 6.0, 0.0],
        [-9.0, -1.0, 0.41421356237],
        [-8.0, -2.0, 0.0],
    ];
    Round {
        shape,
        hole: [0.0, 1.0],
        start: [1.0, -2.0],
        steps: vec![
            ([9.0, -2.0], None),
            ([9.0, 5.0], None),
            ([8.0, 6.0], Some(([8.0, 5.0], true))),
            ([-9.0, 6.0], None),
            ([-9.0, -1.0], None),
            ([-8.0, -2.0], Some(([-8.0, -1.0], true))),
            ([1.0, -2.0], None),
        ],
    }
}

/// How a program is written.
#[derive(Clone, Copy, Debug)]
struct How {
    passes: usize,
    alternates: bool,
    counts: bool,
    calls: bool,
}

/// A program, and for each block of a contour its line, from 0. The first and the last block of a pass are left out: where it begins and
/// ends within a side of the contour, none but the program itself says where.
fn written(round: &Round, how: How) -> (Vec<String>, Vec<usize>) {
    let mut at = round.hole;
    let mut words = |to: [f64; 2]| {
        let from = std::mem::replace(&mut at, to);
        let word = |axis: usize, letter: char| match (how.counts, to[axis] == from[axis]) {
            (_, true) => String::new(),
            (true, false) => format!(" {letter}{:.3}", to[axis] - from[axis]),
            (false, false) => format!(" {letter}{:.3}", to[axis]),
        };
        word(0, 'X') + &word(1, 'Y')
    };
    let [x, y] = round.hole;
    let mut main = vec![
        if how.counts { "G91" } else { "G90" }.to_owned(),
        format!("G92 X{x:.3} Y{y:.3}"),
    ];
    let mut called: Vec<Vec<String>> = Vec::new();
    for pass in 0..how.passes {
        let is_back = how.alternates && pass % 2 == 1;
        main.push(format!(
            "G{} D{} G01{}",
            if is_back { 42 } else { 41 },
            pass + 1,
            words(round.start)
        ));
        let mut steps = round.steps.clone();
        if is_back {
            let mut to: Vec<[f64; 2]> = steps.iter().rev().skip(1).map(|step| step.0).collect();
            to.push(round.start);
            let turned = steps.iter().rev().zip(to);
            steps = turned
                .map(|((_, arc), to)| (to, arc.map(|(center, left)| (center, !left))))
                .collect();
        }
        let mut from = round.start;
        let lines: Vec<String> = steps
            .into_iter()
            .map(|(to, arc)| {
                let start = std::mem::replace(&mut from, to);
                match arc {
                    None => format!("G01{}", words(to)),
                    Some(([x, y], left)) => format!(
                        "G0{}{} I{:.3} J{:.3}",
                        if left { 3 } else { 2 },
                        words(to),
                        x - start[0],
                        y - start[1]
                    ),
                }
            })
            .collect();
        if how.calls {
            main.push(format!("M98 P{}", pass + 1));
            called.push(lines);
        } else {
            main.extend(lines);
        }
        main.push(format!("G40 G01{}", words(round.hole)));
    }
    main.push("M02".to_owned());
    for (nth, lines) in called.into_iter().enumerate() {
        main.push(format!("N{}", nth + 1));
        main.extend(lines);
        main.push("M99".to_owned());
    }
    let is_of_contour = |line: &String| {
        line.starts_with(['G'])
            && line.contains(['X', 'Y'])
            && !line.starts_with("G4")
            && !line.starts_with("G9")
    };
    let is_inner = |&line: &usize| {
        [line - 1, line, line + 1]
            .into_iter()
            .all(|line| is_of_contour(&main[line]))
    };
    let lines = (1..main.len() - 1).filter(is_inner).collect();
    (main, lines)
}

/// A line with its first coordinate changed.
fn changed(line: &str, by: f64) -> String {
    let at = line.find(['X', 'Y']).unwrap() + 1;
    let end = line[at..]
        .find(' ')
        .map_or(line.len(), |length| at + length);
    let value: f64 = line[at..end].parse().unwrap();
    format!("{}{:.3}{}", &line[..at], value + by, &line[end..])
}

/// Each block of each pass is compared with the drawing: where one is changed, it is named, or one beside it, three times
/// of four at least; where none is, nothing.
#[test]
fn each_pass_of_a_program_in_one_go_is_compared() {
    let settings = settings_of("side = \"opening\"\nwire-diameter = 0.18\ngap = 0.01\n");
    let (mut tried, mut wrong) = (0, Vec::new());
    for (nth, round) in [rectangle(), rounded()].iter().enumerate() {
        let shape = (Shape::Polyline(round.shape.clone()), Role::Opening);
        let drawn = document(&[shape], &settings).drawn().unwrap();
        for &number in by_day(&[3, 15][..], &[0, 3, 4, 6, 9, 15]) {
            let how = How {
                passes: 2 + number % 2,
                alternates: number & 2 != 0,
                counts: number & 4 != 0,
                calls: number & 8 != 0,
            };
            let (program, lines) = written(round, how);
            let named = |program: &[String]| {
                let text = program.join("\n") + "\n";
                let seen = compare(&drawn, &traced(&text, Format::Iso, &settings));
                let seen = seen.map(|seen| seen.differences);
                seen.map(|all| {
                    all.iter()
                        .map(|one| (one.line, one.off))
                        .collect::<Vec<_>>()
                })
            };
            assert_eq!(named(&program), Some(Vec::new()), "{}", program.join("\n"));
            for &line in lines.iter().step_by(by_day(16, 1)) {
                for by in [0.05, -1.0] {
                    let mut program = program.clone();
                    program[line] = changed(&program[line], by);
                    tried += 1;
                    let found = named(&program);
                    // Where hardly anything is left behind it, the first block of its pass may be named with it.
                    let is_it = found.as_ref().is_some_and(|all| {
                        all.len() <= 2 && all.iter().any(|(at, _)| at.abs_diff(line) <= 1)
                    });
                    if !is_it {
                        wrong.push(format!(
                            "{nth} {how:?} line {line} {} {found:?}",
                            program[line]
                        ));
                    }
                }
            }
        }
    }
    println!("{}\n{} of {tried} missed", wrong.join("\n"), wrong.len());
    assert!(
        4 * wrong.len() <= tried,
        "{} of {tried} missed",
        wrong.len()
    );
}
