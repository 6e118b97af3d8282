//! Parts that share an edge: one cut on it, one contour round all of them, and nothing taken of a part elsewhere.

mod cases;

use super::{CORRECTION, circle, push, rectangle, settings};
use cases::cases;
use proptest::prelude::*;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Geometry, Outline, Vertex};
use wedm::finding::{Detail, Finding, Rule, Severity};
use wedm::geometry::{Point, Segment};
use wedm::settings::{Effective, SideSetting};
use wedm::toolpath::{Refusal, WirePath, plan};

struct Planned {
    drawing: Drawing,
    outlines: Arc<Vec<Outline>>,
    findings: Vec<Finding>,
    paths: Result<Vec<WirePath>, Refusal>,
}

fn common() -> Effective {
    Effective {
        common_line: true,
        side: SideSetting::Auto,
        ..settings()
    }
}

fn planned(entities: &[(&str, Geometry)], settings: Effective) -> Planned {
    let mut drawing = Drawing::new(None);
    for (handle, geometry) in entities {
        push(&mut drawing, handle, None, geometry.clone());
    }
    let settings = Arc::new(settings);
    let mut analysis = Analysis::new(&drawing, settings.clone());
    let outlines = analysis.outlines(&drawing).clone();
    let (findings, _) = analysis.findings(&drawing, usize::MAX);
    let paths = plan(&drawing, &outlines, &settings, None);
    Planned {
        drawing,
        outlines,
        findings,
        paths,
    }
}

impl Planned {
    /// The sentences of the rule `narrow-slot`, the errors among them first.
    fn said(&self) -> Vec<(Severity, String)> {
        let said = self
            .findings
            .iter()
            .filter_map(|found| match &found.detail {
                Detail::Said(sentence) if found.rule == Rule::NarrowSlot => {
                    Some((found.severity, sentence.clone()))
                }
                _ => None,
            });
        said.collect()
    }

    fn errors(&self) -> Vec<&'static str> {
        let errors = self.findings.iter();
        let errors = errors.filter(|found| found.severity == Severity::Error);
        let mut rules: Vec<&str> = errors.map(|found| found.rule.name()).collect();
        rules.dedup();
        rules
    }

    /// The first point of each cut on a line, and its last.
    fn cuts_on_lines(&self) -> Vec<[[f64; 2]; 2]> {
        let paths = self.paths.as_ref().unwrap().iter();
        let lines = paths.filter(|path| path.on_line).map(|path| {
            let drawn = path
                .segments
                .iter()
                .filter(|it| matches!(it.source, wedm::toolpath::Source::Segment { .. }));
            let drawn: Vec<Segment> = drawn.map(|it| it.geometry).collect();
            [drawn[0].start(), drawn[drawn.len() - 1].end()]
                .map(|at| [at.x, at.y].map(|it| (it * 1e3).round() / 1e3))
        });
        lines.collect()
    }
}

fn line(x: f64, y: f64, x1: f64, y1: f64) -> Geometry {
    Geometry::Line {
        start: Point::new(x, y),
        end: Point::new(x1, y1),
    }
}

fn polygon(points: &[(f64, f64)]) -> Geometry {
    Geometry::Polyline {
        closed: true,
        vertices: points
            .iter()
            .map(|&(x, y)| Vertex::new(x, y, 0.0))
            .collect(),
    }
}

fn named(all: Vec<Geometry>) -> Vec<(&'static str, Geometry)> {
    const NAMES: [&str; 12] = ["1", "2", "3", "4", "5", "6", "7", "8", "9", "A", "B", "C"];
    NAMES.into_iter().zip(all).collect()
}

#[test]
fn parts_that_share_an_edge_are_cut_apart_on_it() {
    for (name, drawn, contours, lines, said) in cases() {
        let planned = planned(&named(drawn), common());
        assert_eq!(planned.errors(), [""; 0], "{name}: {:?}", planned.findings);
        assert_eq!(planned.outlines.len(), contours, "{name}");
        let paths = planned
            .paths
            .as_ref()
            .unwrap_or_else(|why| panic!("{name}: {why:?}"));
        assert_eq!(planned.cuts_on_lines(), lines, "{name}");
        // What goes round all of them is cut last.
        let last = paths.last().unwrap();
        assert!(!last.on_line, "{name}");
        let found = planned.said();
        assert_eq!(found.len(), lines.len(), "{name}: {found:?}");
        assert!(found[0].1.starts_with(said), "{name}: {found:?}");
        assert!(
            found.iter().all(|(of, _)| *of == Severity::Information),
            "{name}"
        );
    }
}

/// Without the setting, for a pair, and where the contour is the path, an edge that parts share stays what it was.
#[test]
fn without_the_setting_a_shared_edge_is_refused_as_ever() {
    for (name, drawn, ..) in cases() {
        let entities = named(drawn);
        let off = planned(
            &entities,
            Effective {
                common_line: false,
                ..common()
            },
        );
        let refused = ["narrow-slot", "open-contour", "self-intersection"];
        assert!(
            off.errors().iter().any(|rule| refused.contains(rule)),
            "{name}: {:?}",
            off.findings
        );
        assert!(off.paths.is_err(), "{name}");
        assert_eq!(off.said(), [], "{name}");
        let mut of_pair = common();
        of_pair.pair.clearance = Some(0.02);
        let of_pair = planned(&entities, of_pair);
        assert_eq!(of_pair.errors(), off.errors(), "{name}");
    }
}

/// What is drawn, and the rule and reason of what is refused.
#[test]
fn what_cannot_be_cut_apart_is_refused_with_the_reason() {
    let lower = rectangle([0.0, 0.0], [20.0, 10.0]);
    for (name, drawn, reason) in [
        (
            "a place between them",
            vec![
                polygon(&[
                    (0.0, 0.0),
                    (30.0, 0.0),
                    (30.0, 10.0),
                    (20.0, 10.0),
                    (20.0, 5.0),
                    (10.0, 5.0),
                    (10.0, 10.0),
                    (0.0, 10.0),
                ]),
                rectangle([0.0, 10.0], [30.0, 10.0]),
            ],
            "they enclose a place at",
        ),
        (
            "a corner in which stock stays",
            vec![
                lower.clone(),
                polygon(&[(5.0, 10.0), (15.0, 10.0), (20.0, 14.0), (0.0, 14.0)]),
            ],
            "stock would hold them together",
        ),
        (
            "one on the other",
            vec![
                lower.clone(),
                rectangle([20.0, 0.0], [20.0, 10.0]),
                rectangle([25.0, 0.0], [15.0, 5.0]),
            ],
            "they lie on the same side of it",
        ),
        (
            "a part between two that meet in a corner",
            vec![
                lower.clone(),
                rectangle([20.0, 0.0], [20.0, 10.0]),
                rectangle([40.0, 10.0], [20.0, 10.0]),
                rectangle([20.0, 10.0], [20.0, 10.0]),
            ],
            "",
        ),
    ] {
        let side = SideSetting::Punch;
        let planned = planned(&named(drawn), Effective { side, ..common() });
        if reason.is_empty() {
            // Two cuts on lines, and the outline round all.
            assert_eq!(planned.errors(), [""; 0], "{name}: {:?}", planned.findings);
            assert!(planned.paths.is_ok(), "{name}: {:?}", planned.paths);
            continue;
        }
        let said = planned.said();
        assert!(
            said.iter()
                .any(|(severity, sentence)| *severity == Severity::Error
                    && sentence.contains(reason)),
            "{name}: {said:?}"
        );
        assert!(planned.paths.is_err(), "{name}");
    }
}

/// Neither a hole beside the line nor the neighbour may be cut into.
#[test]
fn a_common_line_keeps_clear_of_what_else_is_drawn() {
    let [left, right] = [0.0, 20.0].map(|x| rectangle([x, 0.0], [20.0, 10.0]));
    for (name, more, is_cut) in [
        ("a hole at a distance", circle(17.0, 5.0, 2.0), true),
        ("a hole beside the line", circle(17.95, 5.0, 2.0), false),
        (
            "a part above the line's end",
            rectangle([10.0, 10.3], [20.0, 5.0]),
            true,
        ),
        (
            "a part too near to the outline",
            rectangle([10.0, 10.15], [20.0, 5.0]),
            false,
        ),
    ] {
        let planned = planned(&named(vec![left.clone(), right.clone(), more]), common());
        assert_eq!(
            planned.errors().is_empty(),
            is_cut,
            "{name}: {:?}",
            planned.findings
        );
        assert_eq!(planned.paths.is_ok(), is_cut, "{name}: {:?}", planned.paths);
    }
}

#[test]
fn whoever_asks_for_a_part_gets_all_that_its_outline_goes_round() {
    let drawn = [0.0, 20.0, 50.0].map(|x| rectangle([x, 0.0], [20.0, 10.0]));
    let settings = common();
    let Planned {
        drawing, outlines, ..
    } = planned(&named(drawn.to_vec()), settings.clone());
    for (handle, cuts) in [("1", 2), ("2", 2), ("3", 1)] {
        let asked = [handle.to_owned()];
        let paths = plan(&drawing, &outlines, &settings, Some(&asked)).unwrap();
        assert_eq!(paths.len(), cuts, "{handle}");
    }
}

/// How far a point is from a path.
fn from(path: &[Segment], at: Point) -> f64 {
    let distances = path.iter().map(|piece| piece.distance_to(at));
    distances.fold(f64::INFINITY, f64::min)
}

/// Rectangles side by side along a line, each with its place along it and its size.
fn pair() -> impl Strategy<Value = ([f64; 2], [f64; 2], f64, f64, [bool; 2])> {
    let size = || [0.8_f64..12.0, 0.8_f64..12.0];
    (
        size(),
        size(),
        -0.9_f64..0.9,
        0.0_f64..6.3,
        any::<[bool; 2]>(),
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// Two rectangles of any sizes that share a stretch of an edge, at any angle and drawn as polylines or lines: what either loses lies
    /// along the common stretch, the wire comes to everything else of both outlines, and the line parts them.
    #[test]
    fn a_part_loses_something_only_along_the_common_line(
        (one, other, along, angle, as_lines) in pair(),
    ) {
        // The second lies to the right of the first, `along` of the way that still leaves a stretch in common.
        let low = if along.abs() < 0.1 { 0.0 } else if along < 0.0 { along * other[1] } else { along * one[1] };
        let turned = |x: f64, y: f64| {
            let (sine, cosine) = angle.sin_cos();
            Point::new(x * cosine - y * sine + 3.0, x * sine + y * cosine - 7.0)
        };
        let corners = |x: f64, y: f64, [width, height]: [f64; 2]| {
            [(x, y), (x + width, y), (x + width, y + height), (x, y + height)].map(|(x, y)| turned(x, y))
        };
        let parts = [corners(0.0, 0.0, one), corners(one[0], low, other)];
        let shared = [low.max(0.0), (low + other[1]).min(one[1])];
        prop_assume!(shared[1] - shared[0] > 0.5);
        let common_edge = Segment::line(turned(one[0], shared[0]), turned(one[0], shared[1]));
        let mut entities = Vec::new();
        for (part, as_lines) in parts.iter().zip(as_lines) {
            let ends = part.iter().zip(part.iter().cycle().skip(1));
            match as_lines {
                true => entities.extend(ends.map(|(from, to)| Geometry::Line { start: *from, end: *to })),
                false => entities.push(polygon(&part.map(|at| (at.x, at.y)))),
            }
        }
        let planned = planned(&named(entities), common());
        prop_assert_eq!(planned.errors(), [""; 0], "{:?}", planned.findings);
        let paths = planned.paths.as_ref().unwrap();
        let path: Vec<Segment> = paths.iter().flat_map(|path| path.segments.iter().map(|it| it.geometry)).collect();
        let inside = |part: &[Point; 4], share: [f64; 2]| {
            part[0] + (part[1] - part[0]) * share[0] + (part[3] - part[0]) * share[1]
        };
        // A lead that comes from a corner between both takes as far beyond the end of the line.
        let lost = CORRECTION * 2.0_f64.sqrt() + 1e-6;
        for part in &parts {
            for step in 0..=24 {
                let share = f64::from(step) / 24.0;
                for at in [[share, 0.0], [1.0, share], [share, 1.0], [0.0, share], [share, 0.02], [0.02, share], [share, 0.98], [0.98, share], [share, 0.5]] {
                    let at = inside(part, at);
                    let (away, along) = (from(&path, at), common_edge.distance_to(at));
                    prop_assert!(away >= CORRECTION - 1e-6 || along <= lost, "{at:?} of {part:?} is lost: {away} from the wire, {along} from the common line");
                }
                // On an outline the wire is everywhere at the correction, or on the line.
                for at in [[share, 0.0], [1.0, share], [share, 1.0], [0.0, share]] {
                    let at = inside(part, at);
                    let (away, along) = (from(&path, at), common_edge.distance_to(at));
                    prop_assert!(away <= CORRECTION + 1e-6 || along <= 2.0 * CORRECTION, "{at:?} of {part:?} is not cut: {away}");
                    prop_assert!(along > 1e-9 || away <= 1e-6, "{at:?} on the common line is not cut: {away}");
                }
            }
        }
    }
}

/// Cells on each side of a square sheet, and how large each is.
const CELLS: usize = 4;
const SIZE: f64 = 3.0;

/// The part that a cell is of; 0 for none, as beyond the sheet.
fn part_at(cells: &[usize], x: i32, y: i32) -> usize {
    let is_on_sheet = |at: i32| (0..CELLS as i32).contains(&at);
    match is_on_sheet(x) && is_on_sheet(y) {
        true => cells[y as usize * CELLS + x as usize],
        false => 0,
    }
}

/// The edges of the cells of a part towards others, with it on their left, and what lies beyond each.
fn edges(cells: &[usize], part: usize) -> Vec<([i32; 2], [i32; 2], usize)> {
    let mut edges = Vec::new();
    for y in 0..CELLS as i32 {
        for x in (0..CELLS as i32).filter(|&x| part_at(cells, x, y) == part) {
            let sides = [
                ([x, y], [x + 1, y], part_at(cells, x, y - 1)),
                ([x + 1, y], [x + 1, y + 1], part_at(cells, x + 1, y)),
                ([x + 1, y + 1], [x, y + 1], part_at(cells, x, y + 1)),
                ([x, y + 1], [x, y], part_at(cells, x - 1, y)),
            ];
            edges.extend(sides.into_iter().filter(|(.., beyond)| *beyond != part));
        }
    }
    edges
}

/// The corners of a part in one piece without holes, in its direction.
fn corners(cells: &[usize], part: usize) -> Option<Vec<[i32; 2]>> {
    let edges = edges(cells, part);
    let first = edges.first()?.0;
    let (mut corners, mut at) = (vec![first], first);
    loop {
        let mut next = edges.iter().filter(|(from, ..)| *from == at);
        let (_, to, _) = next.next()?;
        if next.next().is_some() {
            return None;
        }
        if *to == first {
            break;
        }
        corners.push(*to);
        at = *to;
    }
    (corners.len() == edges.len()).then_some(corners)
}

/// Up to three parts that have grown cell by cell, each in one piece and without holes.
fn grown(steps: &[(usize, usize)]) -> Vec<usize> {
    let mut cells = vec![0; CELLS * CELLS];
    for &(part, at) in steps {
        let is_free = |at: &usize| cells[*at] == 0;
        let beside = |at: &usize| {
            let (x, y) = ((at % CELLS) as i32, (at / CELLS) as i32);
            let beside = [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)];
            !cells.contains(&part) || beside.iter().any(|&(x, y)| part_at(&cells, x, y) == part)
        };
        let free: Vec<usize> = (0..cells.len()).filter(is_free).filter(beside).collect();
        if let Some(&cell) = free.get(at % free.len().max(1)) {
            cells[cell] = part;
            if corners(&cells, part).is_none() {
                cells[cell] = 0;
            }
        }
    }
    cells
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    /// Parts of a sheet of squares, of any outline: what is cut apart loses something only along edges with others, and all of those
    /// are cut; what is not has an error.
    #[test]
    fn parts_of_any_outline_lose_something_only_along_common_lines(
        steps in prop::collection::vec((1..4usize, any::<usize>()), 4..24),
    ) {
        let cells = grown(&steps);
        let outlines: Vec<_> = (1..4).filter_map(|part| Some((part, corners(&cells, part)?))).collect();
        let place = |[x, y]: [i32; 2]| Point::new(f64::from(x) * SIZE, f64::from(y) * SIZE);
        let drawn = outlines.iter().map(|(_, corners)| {
            let corners: Vec<(f64, f64)> = corners.iter().map(|&at| (place(at).x, place(at).y)).collect();
            polygon(&corners)
        });
        let planned = planned(&named(drawn.collect()), common());
        let Ok(paths) = &planned.paths else {
            prop_assert!(!planned.errors().is_empty(), "{cells:?}: {:?}", planned.paths);
            return Ok(());
        };
        prop_assert_eq!(planned.errors(), [""; 0], "{:?}: {:?}", cells, planned.findings);
        let path: Vec<Segment> = paths.iter().flat_map(|path| path.segments.iter().map(|it| it.geometry)).collect();
        let all: Vec<_> = outlines.iter().flat_map(|(part, _)| edges(&cells, *part)).collect();
        let shared: Vec<Segment> = all.iter().filter(|(.., beyond)| *beyond > 0).map(|(from, to, _)| Segment::line(place(*from), place(*to))).collect();
        for (start, end, beyond) in &all {
            let edge = Segment::line(place(*start), place(*end));
            for step in 0..=20 {
                let at = edge.point_at(f64::from(step) / 20.0);
                let (away, along) = (from(&path, at), from(&shared, at));
                if *beyond > 0 {
                    prop_assert!(away <= 1e-6, "{cells:?}: {at:?} on a common line is not cut: {away}");
                    continue;
                }
                let corner = CORRECTION * 2.0_f64.sqrt() + 1e-6;
                prop_assert!(away >= CORRECTION - 1e-6 || along <= corner, "{cells:?}: {at:?} is lost");
                prop_assert!(away <= corner, "{cells:?}: {at:?} is not cut: {away}");
            }
        }
    }
}
