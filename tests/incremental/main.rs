//! What an analysis knows after any sequence of edits is what a fresh one knows.

mod drawings;
mod hatched;
mod left_out;
mod pairs;
mod random;
mod spliced;
mod told;
use proptest::prelude::*;
use std::fmt::Write;
use std::sync::Arc;
use wedm::analysis::Analysis;
use wedm::document::{Document, Source};
use wedm::drawing::{
    Chains, Contour, Delta, Drawing, Entity, EntityId, Geometry, Role, Touched, Vertex,
};
use wedm::dxf;
use wedm::finding::Place;
use wedm::geometry::Point;
use wedm::settings::{Budget, Effective, Settings, SideSetting};

#[derive(Clone, Debug)]
enum Edit {
    Add(usize, Geometry, Option<Role>),
    Replace(usize, Geometry, Option<Role>),
    Remove(usize),
    Splice(usize, usize, usize, Vec<Vertex>),
}

/// Points of a coarse grid, so that ends often coincide and nodes branch; now and then a little off.
fn point() -> impl Strategy<Value = Point> {
    (
        0..4i32,
        0..4i32,
        prop_oneof![7 => Just(0.0), 1 => Just(3e-7), 1 => Just(0.004), 1 => Just(0.02)],
    )
        .prop_map(|(x, y, off)| Point::new(f64::from(x) + off, f64::from(y)))
}

fn vertex() -> impl Strategy<Value = Vertex> {
    (point(), prop_oneof![2 => Just(0.0), 1 => -1.5..1.5f64])
        .prop_map(|(point, bulge)| Vertex { point, bulge })
}

fn geometry() -> impl Strategy<Value = Geometry> {
    prop_oneof![
        6 => (point(), point()).prop_map(|(start, end)| Geometry::Line { start, end }),
        3 => (point(), 0..4i32, 1..4i32).prop_map(|(center, from, sweep)| {
            let quarter = std::f64::consts::FRAC_PI_2;
            Geometry::Arc { center, radius: 1.0, start_angle: f64::from(from) * quarter, end_angle: f64::from(from + sweep) * quarter }
        }),
        2 => (any::<bool>(), proptest::collection::vec(vertex(), 0..6)).prop_map(|(closed, vertices)| Geometry::Polyline { closed, vertices }),
        1 => (point(), 0.2..2.0f64).prop_map(|(center, radius)| Geometry::Circle { center, radius }),
    ]
}

fn role() -> impl Strategy<Value = Option<Role>> {
    prop_oneof![6 => Just(None), 1 => Just(Some(Role::Opening)), 1 => Just(Some(Role::Punch)), 1 => Just(Some(Role::Ignore)), 1 => Just(Some(Role::Line))]
}

fn edit() -> impl Strategy<Value = Edit> {
    prop_oneof![
        3 => (0..20usize, geometry(), role()).prop_map(|(at, geometry, role)| Edit::Add(at, geometry, role)),
        3 => (0..20usize, geometry(), role()).prop_map(|(at, geometry, role)| Edit::Replace(at, geometry, role)),
        2 => (0..20usize).prop_map(Edit::Remove),
        6 => (0..20usize, 0..7usize, 0..3usize, proptest::collection::vec(vertex(), 0..3))
            .prop_map(|(at, start, count, insert)| Edit::Splice(at, start, count, insert)),
    ]
}

fn entity(geometry: Geometry, role: Option<Role>) -> Entity {
    Entity {
        handle: "A".into(),
        layer: "0".into(),
        role,
        kind: wedm::drawing::Kind::Line,
        geometry,
    }
}

fn apply(drawing: &mut Drawing, edit: &Edit) -> Option<Touched> {
    let pick = |drawing: &Drawing, at: usize| {
        (!drawing.is_empty()).then(|| drawing.order()[at % drawing.len()])
    };
    match edit {
        Edit::Add(at, geometry, role) => {
            let position = at % (drawing.len() + 1);
            let id = drawing.insert_at(position, entity(geometry.clone(), *role));
            Some(Touched::Entity { entity: id })
        }
        Edit::Replace(at, geometry, role) => {
            let id = pick(drawing, *at)?;
            drawing.replace(id, entity(geometry.clone(), *role));
            Some(Touched::Entity { entity: id })
        }
        Edit::Remove(at) => {
            let id = pick(drawing, *at)?;
            drawing.remove(id);
            Some(Touched::Removed { entity: id })
        }
        Edit::Splice(at, start, count, insert) => drawing
            .splice(pick(drawing, *at)?, *start, *count, insert)
            .ok(),
    }
}

/// Number of cases: `usual`, and no more than the environment allows (`PROPTEST_CASES`).
fn cases(usual: u32) -> u32 {
    std::env::var("PROPTEST_CASES")
        .ok()
        .and_then(|number| number.parse().ok())
        .map_or(usual, |cases: u32| cases.min(usual))
}

/// Findings and where they lie, entities by their place in the machining order.
fn told(drawing: &Drawing) -> Vec<String> {
    let order = |id| drawing.order().iter().position(|&other| other == id);
    let place = |place: &Place| match *place {
        Place::Segment { entity, segment } => format!("{:?}/{segment}", order(entity)),
        _ => String::new(),
    };
    let (findings, _) =
        Analysis::new(drawing, Arc::new(Effective::default())).findings(drawing, usize::MAX);
    findings
        .iter()
        .map(|finding| {
            format!(
                "{:?} {} {:?}",
                finding.rule,
                place(&finding.place),
                finding.related.iter().map(place).collect::<Vec<_>>()
            )
        })
        .collect()
}
