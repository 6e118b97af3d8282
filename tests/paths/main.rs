//! Paths of several contours: leads that stay clear of what lies beside, order, marks, what the selection says.

mod common_line;
mod crowded;
mod doubles;
mod leads;
mod on_line;
mod order;
mod random;
mod threads;

use std::collections::BTreeMap;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Outline, Role, Vertex};
use wedm::finding::Place;
use wedm::geometry::Point;
use wedm::settings::{Effective, PointSetting};
use wedm::toolpath::{Source, WirePath};

const CORRECTION: f64 = 0.1;

fn push(drawing: &mut Drawing, handle: &str, role: Option<Role>, geometry: Geometry) {
    drawing.push(Entity {
        handle: handle.into(),
        layer: "0".into(),
        role,
        kind: Kind::Line,
        geometry,
    });
}

fn rectangle([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Geometry {
    let corners = [
        (x, y),
        (x + width, y),
        (x + width, y + height),
        (x, y + height),
    ];
    Geometry::Polyline {
        closed: true,
        vertices: corners.map(|(x, y)| Vertex::new(x, y, 0.0)).to_vec(),
    }
}

fn circle(x: f64, y: f64, radius: f64) -> Geometry {
    Geometry::Circle {
        center: Point::new(x, y),
        radius,
    }
}

/// Entities with their handles and roles.
fn drawing(entities: &[(&str, Option<Role>, Geometry)]) -> (Drawing, Arc<Vec<Outline>>) {
    let mut drawing = Drawing::new(None);
    entities
        .iter()
        .for_each(|(handle, role, geometry)| push(&mut drawing, handle, *role, geometry.clone()));
    let outlines = Analysis::new(&drawing, Arc::new(Effective::default()))
        .outlines(&drawing)
        .clone();
    (drawing, outlines)
}

fn threads(points: &[(&str, [f64; 2])]) -> Option<PointSetting> {
    Some(PointSetting::ByHandle(
        points
            .iter()
            .map(|(handle, at)| (handle.to_string(), *at))
            .collect::<BTreeMap<_, _>>(),
    ))
}

fn settings() -> Effective {
    Effective {
        correction: CORRECTION,
        ..Effective::default()
    }
}

fn handle(drawing: &Drawing, place: &Place) -> String {
    match place {
        Place::Segment { entity, .. } | Place::Entity { entity } => {
            drawing.get(*entity).unwrap().handle.to_string()
        }
        _ => "?".into(),
    }
}

/// Handles along a path without its leads, one after the other.
fn along(drawing: &Drawing, path: &WirePath) -> Vec<String> {
    let of = path.segments.iter().filter_map(|piece| match piece.source {
        Source::Segment { entity, .. } => Some(drawing.get(entity).unwrap().handle.to_string()),
        _ => None,
    });
    let mut handles: Vec<String> = of.collect();
    handles.dedup();
    handles
}
