//! Published and computed 3B examples: geometry in, the very blocks out, and the published text back to its geometry.
//! Some of them are a whole wire path: a line in, a circle from where it ends, the same line out.
//!
//! Each example in `data/published_3b.json` says where it comes from.

use serde_json::Value;
use wedm::analysis::Analysis;
use wedm::drawing::{Contour, Drawing, Entity, Geometry, Outline, Role, Unit, Vertex};
use wedm::geometry::{Arc, Point, Segment};
use wedm::program::three_b::{Block, Item, Motion, Words, decode, read, write};
use wedm::settings::{Compensation, Direction, Effective, PointSetting};
use wedm::toolpath::plan;

fn examples() -> Vec<Value> {
    let text = include_str!("data/published_3b.json");
    serde_json::from_str(text).expect("the examples are JSON")
}

fn point(value: &Value) -> Point {
    Point::new(value[0].as_f64().expect("x"), value[1].as_f64().expect("y"))
}

/// The path as an example states it; a full circle is an arc whose ends coincide.
fn segments(list: &Value) -> Vec<Segment> {
    let segment = |value: &Value| {
        let (start, end) = (point(&value["start"]), point(&value["end"]));
        match value["type"].as_str() {
            Some("line") => Segment::line(start, end),
            _ => Segment::Arc(Arc::about(
                point(&value["center"]),
                start,
                end,
                value["dir"] == "ccw",
            )),
        }
    };
    list.as_array()
        .expect("a list")
        .iter()
        .map(segment)
        .collect()
}

fn entity(geometry: Geometry) -> Entity {
    Entity {
        handle: "2A".into(),
        layer: "0".into(),
        role: None,
        kind: wedm::drawing::Kind::LightPolyline,
        geometry,
    }
}

/// LINE, ARC and CIRCLE entities, chained as the server chains them.
fn as_entities(path: &[Segment]) -> (Drawing, Vec<Outline>) {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    for segment in path {
        let geometry = match segment {
            Segment::Line(line) => Geometry::Line {
                start: line.start,
                end: line.end,
            },
            Segment::Arc(arc) if arc.is_full_turn() => Geometry::Circle {
                center: arc.center,
                radius: arc.radius,
            },
            Segment::Arc(arc) => {
                let (start, end) = (arc.start_angle, arc.start_angle + arc.sweep);
                let (start_angle, end_angle) = if arc.sweep > 0.0 {
                    (start, end)
                } else {
                    (end, start)
                };
                Geometry::Arc {
                    center: arc.center,
                    radius: arc.radius,
                    start_angle,
                    end_angle,
                }
            }
        };
        drawing.push(entity(geometry));
    }
    let outlines = Analysis::new(&drawing, settings_from(Point::origin()).into())
        .outlines(&drawing)
        .to_vec();
    (drawing, outlines)
}

fn as_polyline(path: &[Segment]) -> (Drawing, Vec<Outline>) {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    let mut vertices: Vec<Vertex> = path
        .iter()
        .map(|s| Vertex {
            point: s.start(),
            bulge: s.bulge(),
        })
        .collect();
    vertices.extend(path.last().map(|last| Vertex {
        point: last.end(),
        bulge: 0.0,
    }));
    let id = drawing.push(entity(Geometry::Polyline {
        closed: false,
        vertices,
    }));
    let contour = Contour::new(&drawing, [(id, false)], false);
    (
        drawing,
        Vec::from([Outline {
            contour,
            role: Role::Both,
            twice_area: 0.0,
        }]),
    )
}

fn settings_from(start: Point) -> Effective {
    let at = PointSetting::One([start.x, start.y]);
    Effective {
        compensation: Compensation::None,
        thread: Some(at.clone()),
        entry: Some(at),
        ..Effective::default()
    }
}

fn blocks(text: &str) -> Vec<Block> {
    let (items, faults) = read(text.as_bytes(), &Words::default());
    assert!(faults.is_empty(), "{text}: {faults:?}");
    let block = |item| match item {
        Item::Block { block, .. } => Some(block),
        _ => None,
    };
    items.into_iter().filter_map(block).collect()
}

/// X, Y and Z equal, J within 2 µm, G where the example has it; a line that leaves its numbers out or reduces them is compared as it decodes.
fn assert_same(id: &str, written: &[Block], expected: &[Block]) {
    assert_eq!(written.len(), expected.len(), "{id}: {written:?}");
    for (written, expected) in written.iter().zip(expected) {
        let same = (written.x, written.y) == (expected.x, expected.y)
            || matches!(expected.motion, Motion::Line(_));
        let end = |block| {
            decode(block, Point::origin())
                .expect("a decodable block")
                .end()
        };
        let near = (end(written) - end(expected)).norm() <= 3.0;
        let tie = (expected.x - expected.y).abs() <= 1;
        assert!(
            same && near
                && written.motion == expected.motion
                && (written.axis == expected.axis || tie)
                && (written.j - expected.j).abs() <= 2,
            "{id}: {written:?}, expected {expected:?}"
        );
    }
}

fn program(drawing: &Drawing, outlines: &[Outline], settings: &Effective) -> String {
    let paths = plan(drawing, outlines, settings, None).expect("a path");
    write(&paths, 1.0, settings).expect("a program").text
}

/// One way to put a path into a drawing.
type Drawer = fn(&[Segment]) -> (Drawing, Vec<Outline>);

#[test]
fn wire_paths_give_the_published_blocks() {
    let mut compared = 0;
    for example in examples() {
        let id = example["id"].as_str().expect("id");
        let path = segments(&example["geometry"]["wire_path"]);
        let lines: Vec<&str> = example["program"]
            .as_array()
            .expect("blocks")
            .iter()
            .filter_map(Value::as_str)
            .collect();
        let expected = blocks(&lines.join("\n"));
        let circle = path
            .iter()
            .any(|s| s.as_arc().is_some_and(Arc::is_full_turn));
        let drawn: &[Drawer] = if circle {
            &[as_entities]
        } else {
            &[as_entities, as_polyline]
        };
        for draw in drawn {
            let (drawing, outlines) = draw(&path);
            let clockwise = matches!(path[..], [Segment::Arc(arc)] if arc.sweep < 0.0);
            let direction = if clockwise {
                Direction::Cw
            } else {
                Direction::Ccw
            };
            let settings = Effective {
                direction,
                ..settings_from(point(&example["geometry"]["wire_start"]))
            };
            assert_same(
                id,
                &blocks(&program(&drawing, &outlines, &settings)),
                &expected,
            );
        }
        compared += 1;
    }
    println!("{compared} examples compared");
}

#[test]
fn nominal_contours_give_the_published_blocks_of_the_offset() {
    for example in examples() {
        let nominal = &example["geometry"]["nominal_contour"];
        let circle = &nominal[0];
        if circle["type"] != "circle" {
            assert!(
                nominal.is_null(),
                "{}: only circles are known here",
                example["id"]
            );
            continue;
        }
        let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
        let radius = circle["radius"].as_f64().expect("radius");
        let id = drawing.push(entity(Geometry::Circle {
            center: point(&circle["center"]),
            radius,
        }));
        let contour = Contour::new(&drawing, [(id, false)], true);
        let outline = Outline {
            twice_area: contour.twice_area(&drawing),
            contour,
            role: Role::Opening,
        };
        let start = point(&example["geometry"]["wire_start"]);
        let correction = example["offset_mm"].as_f64().expect("offset");
        let settings = Effective {
            correction,
            thread: Some(PointSetting::One([start.x, start.y])),
            ..Effective::default()
        };
        let lines: Vec<&str> = example["program"]
            .as_array()
            .expect("blocks")
            .iter()
            .filter_map(Value::as_str)
            .collect();
        assert_same(
            example["id"].as_str().expect("id"),
            &blocks(&program(&drawing, &[outline], &settings)),
            &blocks(&lines.join("\n")),
        );
    }
}

#[test]
fn published_text_decodes_to_its_path() {
    for example in examples() {
        let lines: Vec<&str> = example["program"]
            .as_array()
            .expect("blocks")
            .iter()
            .filter_map(Value::as_str)
            .collect();
        let mut at = point(&example["geometry"]["wire_start"]) * 1000.0;
        for (block, expected) in blocks(&lines.join("\n"))
            .iter()
            .zip(segments(&example["geometry"]["wire_path"]))
        {
            let decoded = decode(block, at).expect("a decodable block");
            let distance = (decoded.end() - expected.end() * 1000.0).norm();
            assert!(
                distance <= 2.0,
                "{}: {block:?} ends {distance} µm away",
                example["id"]
            );
            let middle = (decoded.point_at(0.5) - expected.point_at(0.5) * 1000.0).norm();
            assert!(
                middle <= 3.0,
                "{}: {block:?} runs {middle} µm beside",
                example["id"]
            );
            at = decoded.end();
        }
    }
}

/// The checked example of a hole of R 10 with a correction of 0.1, drawn as the wire goes.
#[test]
fn a_circle_and_its_leads_drawn_are_one_path() {
    let (hole, edge) = (Point::origin(), Point::new(9.9, 0.0));
    let path = [
        Segment::line(hole, edge),
        Segment::Arc(Arc::about(hole, edge, edge, true)),
        Segment::line(edge, hole),
    ];
    let (drawing, outlines) = as_entities(&path);
    let written = program(&drawing, &outlines, &settings_from(hole));
    assert_eq!(
        written.split_whitespace().collect::<Vec<_>>(),
        [
            "B9900B0B9900GXL1",
            "B9900B0B39600GYNR1",
            "B9900B0B9900GXL3",
            "DD"
        ]
    );
}

/// The rules let such a drawing pass: with compensation "none" what touches and doubles is the wire's way, not a fault.
#[test]
fn no_error_stands_in_a_wire_path_that_is_drawn() {
    let (hole, edge) = (Point::origin(), Point::new(9.9, 0.0));
    let path = [
        Segment::line(hole, edge),
        Segment::Arc(Arc::about(hole, edge, edge, true)),
        Segment::line(edge, hole),
    ];
    let (drawing, _) = as_entities(&path);
    let settings = Effective {
        compensation: Compensation::None,
        ..Effective::default()
    };
    let (findings, _) = Analysis::new(&drawing, settings.into()).findings(&drawing, usize::MAX);
    let errors: Vec<_> = findings
        .iter()
        .filter(|finding| finding.severity == wedm::finding::Severity::Error)
        .collect();
    assert!(errors.is_empty(), "{errors:?}");
}

/// A line there and back is drawn twice: neither is left out of the wire's own path.
#[test]
fn a_way_there_and_back_that_is_drawn_twice_is_cut_twice() {
    let (hole, edge) = (Point::origin(), Point::new(9.9, 0.0));
    let path = [Segment::line(hole, edge), Segment::line(edge, hole)];
    let (drawing, outlines) = as_entities(&path);
    let written = program(&drawing, &outlines, &settings_from(hole));
    assert_eq!(
        written.split_whitespace().collect::<Vec<_>>(),
        ["B9900B0B9900GXL1", "B9900B0B9900GXL3", "DD"]
    );
}
