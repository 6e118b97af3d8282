//! Parts whose wire runs on the other side of what is drawn: it comes from what drops out, across the contour, and nowhere into the part.

use super::{circle, corner, drawing, notch, polyline, settings, snapshot};
use crate::size::by_day;
use wedm::drawing::{Drawing, Vertex};
use wedm::geometry::{Point, Segment};
use wedm::job::{self, Wanted};
use wedm::program::Format;

/// The places of the wire along an absolute ISO program, close to each other.
fn places(text: &str) -> Vec<Point> {
    places_between_stops(text).concat()
}

/// The same, of each stretch between two stops.
fn places_between_stops(text: &str) -> Vec<Vec<Point>> {
    let mut stretches = Vec::new();
    let mut places: Vec<Point> = Vec::new();
    for line in text.lines() {
        if line.starts_with("M00") {
            let stands = places.last().copied();
            stretches.push(std::mem::take(&mut places));
            places.extend(stands);
        }
        let number = |letter: char| {
            let word = line.split(' ').find(|word| word.starts_with(letter))?;
            word[1..].parse::<f64>().ok()
        };
        let (Some(x), Some(y)) = (number('X'), number('Y')) else {
            continue;
        };
        let to = Point::new(x, y);
        let Some(&from) = places.last() else {
            places.push(to);
            continue;
        };
        let way = match (number('I'), number('J')) {
            (Some(i), Some(j)) => {
                let center = Point::new(from.x + i, from.y + j);
                let is_left = line.contains("G03");
                Segment::Arc(wedm::geometry::Arc::about(center, from, to, is_left))
            }
            _ => Segment::line(from, to),
        };
        let steps = (way.length() / 0.1).ceil().max(1.0) as usize;
        places.extend((1..=steps).map(|step| way.point_at(step as f64 / steps as f64)));
    }
    stretches.push(places);
    stretches
}

/// How far a point lies outside of a polygon, below 0 inside.
fn outside(polygon: &[Point], at: Point) -> f64 {
    let (mut away, mut is_inside) = (f64::INFINITY, false);
    for index in 0..polygon.len() {
        let (from, to) = (polygon[index], polygon[(index + 1) % polygon.len()]);
        let along = to - from;
        let share = ((at - from).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        away = away.min((at - (from + along * share)).norm());
        let crosses = (from.y > at.y) != (to.y > at.y);
        if crosses && at.x < from.x + (at.y - from.y) / (to.y - from.y) * (to.x - from.x) {
            is_inside = !is_inside;
        }
    }
    if is_inside { -away } else { away }
}

/// The contour of a drawing with one outline.
fn outline(drawing: &Drawing, settings: &wedm::settings::Effective) -> Vec<Point> {
    let snapshot = snapshot(drawing, settings);
    let segments = snapshot.outlines[0].contour.segments(drawing);
    let points = segments.flat_map(|segment| {
        let steps = match segment.geometry {
            Segment::Line(_) => 1,
            Segment::Arc(_) => 200,
        };
        (0..steps).map(move |step| {
            segment
                .geometry
                .point_at(f64::from(step) / f64::from(steps))
        })
    });
    points.collect()
}

fn square() -> Vec<Vertex> {
    let corners = [(0.0, 0.0), (20.0, 0.0), (20.0, 12.0), (0.0, 12.0)];
    corners.map(|(x, y)| Vertex::new(x, y, 0.0)).into()
}

/// One closed polyline as a drawing.
fn of(vertices: Vec<Vertex>) -> Drawing {
    drawing(vec![polyline("0", "2A", vertices)])
}

#[test]
fn the_wire_comes_from_what_drops_out() {
    let drawings = [
        circle(6.0),
        of(square()),
        of(corner(70.0, 1.0)),
        of(notch(60.0, 1.0)),
    ];
    for (shape, drawing) in drawings.iter().enumerate() {
        for drawn_as in ["punch", "plate"] {
            for (nth, clearance) in [0.1, 0.15, 0.3].into_iter().enumerate() {
                for (number, keys) in [
                    "",
                    "start-hole = 1.0",
                    "lead = \"perpendicular\"",
                    "lead = \"arc\"",
                    "lead-in = 0.4",
                    "tab = 2.0",
                ]
                .into_iter()
                .enumerate()
                {
                    let is_left_out = !(number + shape + nth).is_multiple_of(by_day(5, 1));
                    if is_left_out || !keys.is_empty() && clearance != 0.15 {
                        continue;
                    }
                    let label = format!("{shape} {drawn_as} {clearance} {keys}");
                    let own = settings(&format!(
                        "wire-diameter = 0.18\ngap = 0.01\n[pair]\ndrawn-as = \"{drawn_as}\"\nclearance = {clearance:?}\n[program]\n{keys}\n"
                    ));
                    let wanted = Wanted {
                        format: Format::Iso,
                        handles: None,
                        layers: None,
                        force: true,
                    };
                    let made = job::pair(&snapshot(drawing, &own), &[], &wanted, &());
                    let made =
                        made.unwrap_or_else(|refusal| panic!("{label}: {}", refusal.sentence(1.0)));
                    let polygon = outline(drawing, &own);
                    let others: Vec<_> = made.iter().filter(|part| part.is_other_side).collect();
                    assert_eq!(others.len(), 1, "{label}");
                    let sign = if drawn_as == "punch" { 1.0 } else { -1.0 };
                    let into_part = |at: &Point| sign * outside(&polygon, *at);
                    let places = places(&others[0].made.program.text);
                    let deepest = places.iter().map(into_part).fold(f64::MIN, f64::max);
                    let correction = others[0].corrections[0];
                    assert!((correction - (clearance - 0.1)).abs() < 1e-9, "{label}");
                    assert!((deepest - correction).abs() < 2e-3, "{label}: {deepest}");
                    let threaded = into_part(&places[0]);
                    assert!(threaded < -0.2, "{label}: {threaded}");
                }
            }
        }
    }
}

/// A clearance above the corrections of all passes, of some, and as large as one of them: each pass runs at its own distance from the drawn
/// contour, on the side where the table says, and the finished parts have the clearance.
#[test]
fn passes_beyond_the_contour_follow_each_other() {
    let drawings = [circle(6.0), of(square()), of(notch(60.0, 1.0))];
    let corrections = [0.15, 0.12, 0.1];
    for (shape, drawing) in drawings.iter().enumerate() {
        let clearances = [0.11, 0.1, 0.12, 0.13, 0.15, 0.2, 0.4];
        for (nth, clearance) in clearances.into_iter().enumerate() {
            for (number, keys) in [
                "",
                "start-hole = 1.0",
                "lead = \"arc\"\ncorner = \"intersection\"",
                "lead-in = 0.4",
                "tab = 2.0",
                "closing-overlap = 0.5\n[passes]\nskim-corner = \"constant-stock\"",
                "tab = 2.0\n[passes]\nskim-corner = \"constant-stock\"",
                "[passes]\nsequence = \"one-way\"",
            ]
            .into_iter()
            .enumerate()
            {
                let is_left_out = !(number + shape + nth).is_multiple_of(by_day(3, 1));
                if is_left_out || !keys.is_empty() && ![0.13, 0.2].contains(&clearance) {
                    continue;
                }
                let drawn_as = ["punch", "plate"][(number + shape) % 2];
                let label = format!("{shape} {drawn_as} {clearance} {keys}");
                let (program, passes) = keys.split_once("[passes]").unwrap_or((keys, ""));
                let own = settings(&format!(
                    "wire-diameter = 0.18\ngap = 0.01\n[pair]\ndrawn-as = \"{drawn_as}\"\nclearance = {clearance:?}\n\
                     [passes]\ncorrections = {corrections:?}{passes}\n[program]\npause-between-passes = \"M00\"\n{program}\n"
                ));
                let snapshot = snapshot(drawing, &own);
                let wanted = Wanted {
                    format: Format::Iso,
                    handles: None,
                    layers: None,
                    force: true,
                };
                let made = job::pair(&snapshot, &[], &wanted, &());
                let made =
                    made.unwrap_or_else(|refusal| panic!("{label}: {}", refusal.sentence(1.0)));
                let (polygon, shifted) = (outline(drawing, &own), usize::from(drawn_as == "punch"));
                let part = &made[shifted];
                let meant = corrections.map(|correction| correction - clearance);
                let is_other = meant.iter().all(|correction| *correction < 1e-9);
                assert_eq!(part.is_other_side, is_other, "{label}");
                let sign = if drawn_as == "punch" { 1.0 } else { -1.0 };
                let into_part = |at: &Point| sign * outside(&polygon, *at);
                let stretches = places_between_stops(&part.made.program.text);
                for ((stretch, meant), told) in stretches.iter().zip(meant).zip(&part.corrections) {
                    let told = if is_other { -told } else { *told };
                    assert!((told - meant).abs() < 1e-9, "{label}: {told} {meant}");
                    let deepest = stretch
                        .iter()
                        .step_by(5)
                        .map(into_part)
                        .fold(f64::MIN, f64::max);
                    let is_tip = keys.contains("intersection") && deepest > -meant;
                    assert!(
                        (deepest + meant).abs() < 2e-3 || is_tip,
                        "{label}: {deepest}, expected {}",
                        -meant
                    );
                }
                let threaded = into_part(&stretches[0][0]);
                assert!(threaded < -0.2, "{label}: {threaded}");
                let found = super::fit_of(drawing, &own);
                assert!(found.fits(), "{label}: {}", found.least());
                if !keys.contains("constant-stock") {
                    assert!((found.least() - clearance).abs() < 1e-6, "{label}");
                }
            }
        }
    }
}

/// The rough pass turns in a point inside the drawn corner, and the last one runs beside it, on the other side of the contour.
#[test]
fn a_constant_stock_is_left_across_the_contour() {
    let k = f64::sqrt(2.0) - 1.0;
    for (corrections, clearance) in [
        ([0.15, 0.11], 0.12),
        ([0.2, 0.11], 0.13),
        ([0.2, 0.11], 0.11),
    ] {
        for drawn_as in ["punch", "plate"] {
            let own = settings(&format!(
                "wire-diameter = 0.18\ngap = 0.02\n[pair]\ndrawn-as = \"{drawn_as}\"\nclearance = {clearance:?}\n\
                 [passes]\ncorrections = {corrections:?}\nskim-corner = \"constant-stock\"\n"
            ));
            let square = [(0.0, 0.0), (20.0, 0.0), (20.0, 12.0), (0.0, 12.0)];
            let square = match drawn_as {
                "punch" => square.map(|(x, y)| Vertex::new(x, y, 0.0)).to_vec(),
                // The corner of a notch is the one that the punch's wire runs inside of.
                _ => notch(90.0, 0.0),
            };
            let found = super::fit_of(&drawing(vec![polyline("0", "2A", square)]), &own);
            let expected = clearance - k * (corrections[0] - clearance);
            assert!(
                (found.least() - expected).abs() < 1e-6,
                "{drawn_as} {corrections:?} {clearance}: {}, expected {expected}",
                found.least()
            );
        }
    }
}
