//! Random sound programs with one fault each: what fix-all makes of one is what stood there before the fault, or nothing.

use super::chance::Chance;
use super::contours::{self, Group};
use super::inject::{inject, kinds};
use super::judge::{Left, findings, left_of, read};
use crate::size::by_day;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use wedm::geometry::{Point, Segment};

/// How the programs of one round are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    ThreeB,
    Checking,
    FourB,
    /// G90 or G91, by the decimals of its numbers; none are whole micrometres.
    Iso {
        is_absolute: bool,
        decimals: usize,
    },
}

const KINDS: [Kind; 8] = [
    Kind::ThreeB,
    Kind::Checking,
    Kind::FourB,
    Kind::Iso {
        is_absolute: false,
        decimals: 0,
    },
    Kind::Iso {
        is_absolute: false,
        decimals: 2,
    },
    Kind::Iso {
        is_absolute: false,
        decimals: 3,
    },
    Kind::Iso {
        is_absolute: true,
        decimals: 2,
    },
    Kind::Iso {
        is_absolute: true,
        decimals: 3,
    },
];

impl Kind {
    fn group(self) -> Group {
        match self {
            Kind::ThreeB | Kind::FourB => Group::Compact,
            Kind::Checking => Group::Checking,
            Kind::Iso { .. } => Group::Iso,
        }
    }

    fn program(self, chance: &mut Chance) -> Option<String> {
        match self {
            Kind::ThreeB => contours::written(&ways(1000, chance), "layout = \"compact\""),
            Kind::Checking => contours::written(&ways(1000, chance), "layout = \"checking\""),
            Kind::FourB => four_b(chance),
            Kind::Iso {
                is_absolute,
                decimals,
            } => Some(iso(is_absolute, decimals, chance)),
        }
    }
}

/// Faults that are one slip of a hand or a line.
fn is_slip(kind: &str) -> bool {
    let others = [
        "off by",
        "word lost",
        "letter lost",
        "comma",
        "point",
        "O for 0",
        "B lost",
        "Z lost",
        "R lost",
        "G lost",
    ];
    !others.iter().any(|other| kind.contains(other))
}

/// A contour as its start and its pieces.
type Contour = Vec<Segment>;

/// Contours with their ways in and out, mm, on a grid of so many steps in a millimetre.
fn ways(steps: i64, chance: &mut Chance) -> Vec<Vec<Segment>> {
    let count = chance.of(&[1, 1, 2]);
    let scale = chance.of(&[3.0, 20.0, 90.0]);
    let grid = |point: Point| {
        let on = |mm: f64| (mm * steps as f64).round() / steps as f64;
        Point::new(on(point.x), on(point.y))
    };
    (0..count)
        .map(|nth| {
            let shift = wedm::geometry::Vector::new(200.0 * nth as f64, nth as f64);
            let drawn: Contour = match chance.one_in(3) {
                true => contours::contour(chance),
                false => random(scale, chance),
            };
            let bulge = |segment: &Segment| match segment {
                Segment::Arc(arc) if !arc.is_full_turn() => (arc.sweep / 4.0).tan(),
                _ => 0.0,
            };
            let mut pieces: Contour = drawn
                .iter()
                .map(|segment| {
                    let (from, to) = (grid(segment.start() + shift), grid(segment.end() + shift));
                    match bulge(segment) {
                        0.0 if segment.as_arc().is_some() => segment.moved(shift),
                        0.0 => Segment::line(from, to),
                        bulge => Segment::from_bulge(from, to, bulge),
                    }
                })
                .filter(|segment| segment.length() > 1e-6)
                .collect();
            let entry = pieces[0].start();
            let by = |chance: &mut Chance| 0.5 + chance.share() * 2.5;
            let hole = grid(entry + wedm::geometry::Vector::new(by(chance), by(chance)));
            pieces.insert(0, Segment::line(hole, entry));
            pieces.push(Segment::line(entry, hole));
            pieces
        })
        .collect()
}

/// Corners about the middle, joined by lines and by arcs that are tangent to nothing.
fn random(scale: f64, chance: &mut Chance) -> Contour {
    let count = 3 + chance.below(7);
    let corners: Vec<Point> = (0..count)
        .map(|index| {
            let angle = (index as f64 + 0.8 * chance.share()) / count as f64 * TAU;
            let radius = scale * (0.4 + 0.6 * chance.share());
            Point::new(radius * angle.cos(), radius * angle.sin())
        })
        .collect();
    (0..count)
        .map(|index| {
            let (from, to) = (corners[index], corners[(index + 1) % count]);
            let bulge = chance.share() * 1.6 - 0.6;
            match chance.one_in(2) || bulge.abs() < 0.05 {
                true => Segment::line(from, to),
                false => Segment::from_bulge(from, to, bulge),
            }
        })
        .collect()
}

/// Arcs get their radius, and a side.
fn four_b(chance: &mut Chance) -> Option<String> {
    let text = contours::written(&ways(1000, chance), "layout = \"compact\"")?;
    let line = |line: &str| {
        let Some((numbers, end)) = line.split_once('G').filter(|(_, end)| end.contains('R')) else {
            return line.to_owned();
        };
        let mut fields = numbers.split('B').skip(1).map(|field| field.parse::<f64>());
        let (Some(Ok(x)), Some(Ok(y))) = (fields.next(), fields.next()) else {
            return line.to_owned();
        };
        let (axis, motion) = end.split_at(1);
        format!("{numbers}B{}G{axis}D{motion}", x.hypot(y).round())
    };
    Some(text.lines().map(|own| line(own) + "\n").collect())
}

fn iso(is_absolute: bool, decimals: usize, chance: &mut Chance) -> String {
    let steps = 10_i64.pow(if decimals == 0 { 3 } else { decimals as u32 });
    let all = ways(steps, chance);
    let is_modal = chance.one_in(2);
    let space = chance.of(&["", " "]);
    let number = |mm: f64| {
        let whole = (mm * steps as f64).round() as i64;
        match decimals {
            0 => whole.to_string(),
            _ => format!("{:.*}", decimals, whole as f64 / steps as f64),
        }
    };
    let mut lines = vec![if is_absolute { "G90" } else { "G91" }.to_owned()];
    let mut at = all[0][0].start();
    lines.push(
        [
            "G92".to_owned(),
            format!("X{}", number(at.x)),
            format!("Y{}", number(at.y)),
        ]
        .join(space),
    );
    let mut last = 0;
    let words = |from: Point, to: Point| {
        let [x, y] = match is_absolute {
            true => [to.x, to.y],
            false => [to.x - from.x, to.y - from.y],
        };
        let is_still = [to.x == from.x, to.y == from.y];
        let mut words = Vec::new();
        if !is_still[0] || !is_modal || is_still[1] {
            words.push(format!("X{}", number(x)));
        }
        if !(is_modal && is_still[1]) {
            words.push(format!("Y{}", number(y)));
        }
        words
    };
    for (nth, pieces) in all.iter().enumerate() {
        if nth > 0 {
            let hole = pieces[0].start();
            lines.push("M00".into());
            lines.push(
                [vec!["G00".to_owned()], words(at, hole)]
                    .concat()
                    .join(space),
            );
            lines.push("M00".into());
            (at, last) = (hole, 0);
        }
        for piece in pieces {
            let to = piece.end();
            let motion = match piece {
                Segment::Arc(arc) if arc.sweep > 0.0 => 3,
                Segment::Arc(_) => 2,
                Segment::Line(..) => 1,
            };
            let mut own = Vec::new();
            if !(is_modal && motion == last) {
                own.push(format!("G0{motion}"));
            }
            own.extend(words(at, to));
            if let Segment::Arc(arc) = piece {
                own.push(format!("I{}", number(arc.center.x - at.x)));
                own.push(format!("J{}", number(arc.center.y - at.y)));
            }
            lines.push(own.join(space));
            (at, last) = (to, motion);
        }
    }
    lines.push("M02".into());
    if chance.one_in(3) {
        lines = (1..)
            .zip(lines)
            .map(|(nth, line)| format!("N{}{space}{line}", 10 * nth))
            .collect();
    }
    lines.join("\n") + "\n"
}

/// How the faults of one kind came out: given back, left alone, made something else.
type Counts = [usize; 3];

fn run(
    seed: u64,
    programs: usize,
) -> (
    BTreeMap<Kind, Counts>,
    BTreeMap<&'static str, Counts>,
    Vec<String>,
) {
    let (mut counts, mut by_fault, mut wrong) = (BTreeMap::new(), BTreeMap::new(), Vec::new());
    for kind in KINDS {
        let chance = &mut Chance::of_seed(seed);
        let group = kind.group();
        let mut taken = 0;
        for _ in 0..6 * programs {
            if taken == programs {
                break;
            }
            let Some(sound) = kind.program(chance) else {
                continue;
            };
            if !findings(&mut read(group, &sound)).is_empty() {
                continue;
            }
            taken += 1;
            for fault in kinds(group).into_iter().filter(|fault| is_slip(fault)) {
                let Some(faulty) = inject(group, fault, &sound, chance) else {
                    continue;
                };
                let (how, left) = left_of(group, &sound, &faulty.text);
                let column = match how {
                    Left::Right => 0,
                    Left::Alone => 1,
                    Left::Wrong => {
                        let line = faulty.lines[0] + 1;
                        wrong.push(format!("--- {kind:?}: {fault}, line {line}\n{}\n--- of\n{sound}\n--- left\n{left}", faulty.text));
                        2
                    }
                };
                counts.entry(kind).or_insert([0; 3])[column] += 1;
                by_fault.entry(fault).or_insert([0; 3])[column] += 1;
            }
        }
        assert!(taken > programs / 2, "{kind:?}: {taken} of {programs}");
    }
    (counts, by_fault, wrong)
}

#[test]
fn what_fix_all_edits_is_what_it_was() {
    let seed = std::env::var("WEDM_ALONE").unwrap_or_default();
    let mut numbers = seed
        .split(',')
        .map(|number| number.trim().parse::<u64>().ok());
    let seed = numbers.next().flatten().unwrap_or(7);
    let programs = numbers.next().flatten().unwrap_or(by_day(1, 2)) as usize;
    let (counts, by_fault, wrong) = run(seed, programs);
    for (kind, counts) in &counts {
        println!("{kind:?}: {counts:?}");
    }
    for (fault, counts) in &by_fault {
        println!("{fault}: {counts:?}");
    }
    let right: usize = counts.values().map(|counts| counts[0]).sum();
    let all: usize = counts.values().flatten().sum();
    assert!(
        wrong.is_empty(),
        "{} of {all} wrong, {right} right:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
    assert!(3 * right > all, "{right} of {all}");
}
