//! Programs that others have published.

use super::changes::{lengths, with_number};
use super::{settings_of, traced};
use std::sync::Arc;
use wedm::compare::compare;
use wedm::document::{Document, Source};
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Role, Unit};
use wedm::geometry::Point;
use wedm::program::Format;

/// The segments of a published example, a circle as the circle.
fn geometry_of(list: &serde_json::Value) -> Vec<Geometry> {
    let point = |value: &serde_json::Value| {
        Point::new(value[0].as_f64().expect("x"), value[1].as_f64().expect("y"))
    };
    let of = |value: &serde_json::Value| {
        let (start, end) = (&value["start"], &value["end"]);
        let center = || point(&value["center"]);
        match value["type"].as_str() {
            Some("line") => Geometry::Line {
                start: point(start),
                end: point(end),
            },
            Some("circle") => Geometry::Circle {
                center: center(),
                radius: value["radius"].as_f64().expect("a radius"),
            },
            _ if start == end => Geometry::Circle {
                center: center(),
                radius: (point(start) - center()).norm(),
            },
            _ => {
                let (from, to) = match value["dir"] == "ccw" {
                    true => (point(start), point(end)),
                    false => (point(end), point(start)),
                };
                let angle = |at: Point| (at.y - center().y).atan2(at.x - center().x);
                Geometry::Arc {
                    center: center(),
                    radius: (from - center()).norm(),
                    start_angle: angle(from),
                    end_angle: angle(to),
                }
            }
        }
    };
    list.as_array().into_iter().flatten().map(of).collect()
}

/// Programs that others have published follow the contours that they are of: where those are known, under their correction; else the path
/// of the wire. Of those of more than two blocks each that is 50 µm too long is named, and no other.
#[test]
fn a_published_program_follows_its_contours() {
    let examples: Vec<serde_json::Value> =
        serde_json::from_str(include_str!("../data/published_3b.json")).expect("examples");
    let mut named = 0;
    for example in &examples {
        let id = example["id"].as_str().expect("id");
        let nominal = geometry_of(&example["geometry"]["nominal_contour"]);
        let (geometry, settings) = match nominal.is_empty() {
            true => (
                geometry_of(&example["geometry"]["wire_path"]),
                "[program]\ncompensation = \"none\"\n".to_owned(),
            ),
            false => (nominal, format!("correction = {}\n", example["offset_mm"])),
        };
        let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
        for (index, geometry) in geometry.into_iter().enumerate() {
            let closed = matches!(geometry, Geometry::Circle { .. });
            drawing.push(Entity {
                handle: format!("{:X}", 42 + index).as_str().into(),
                layer: "0".into(),
                role: closed.then_some(Role::Opening),
                kind: Kind::Line,
                geometry,
            });
        }
        let settings = settings_of(&settings);
        let document = Document::new(Source::Cad(Arc::new(drawing)), settings.clone());
        let drawn = document.drawn().unwrap();
        let blocks: Vec<&str> = example["program"]
            .as_array()
            .expect("blocks")
            .iter()
            .filter_map(serde_json::Value::as_str)
            .collect();
        let told = |blocks: &[&str]| {
            let text = blocks.join("\n") + "\nDD\n";
            let found = compare(&drawn, &traced(&text, Format::ThreeB, &settings));
            found.map(|found| found.differences)
        };
        assert_eq!(told(&blocks), Some(Vec::new()), "{id}: {blocks:?}");
        if blocks.len() < 3 {
            continue;
        }
        for index in 0..blocks.len() {
            let text = blocks[index];
            let numbers = lengths(text, &(0..text.len()));
            // J says how far it goes, whatever X and Y are reduced to.
            let longer = numbers
                .last()
                .and_then(|number| with_number(text, number, 50));
            let Some(longer) = longer else {
                continue;
            };
            let mut wrong = blocks.clone();
            wrong[index] = &longer;
            let lines: Option<Vec<usize>> =
                told(&wrong).map(|found| found.iter().map(|found| found.line).collect());
            assert_eq!(lines, Some(vec![index]), "{id}: {wrong:?}");
            named += 1;
        }
    }
    assert!(examples.len() >= 30 && named >= 20, "{named}");
}
