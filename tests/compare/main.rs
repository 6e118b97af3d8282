//! Programs that wedm writes follow the drawings that they are of, every block of them; of those with one wrong block just that one is named.

mod changes;
mod edited;
mod foreign;
mod long;
mod numbers;
mod passes;
mod placed;
mod published;
mod said;
mod score;
mod shapes;
mod switched;
mod unchanged;
mod uneven;
mod unknown;

use std::sync::Arc;
use wedm::compare::{Drawn, Traced, compare};
use wedm::document::{Document, Source};
use wedm::drawing::{Drawing, Entity, Geometry, Kind, Role, Unit, Vertex};
use wedm::geometry::Point;
use wedm::job::{self, Wanted};
use wedm::program::{self, Format};
use wedm::settings::{Effective, from_toml};

/// A contour: vertices `[x, y, bulge]`, or a circle.
#[derive(Clone, Debug)]
enum Shape {
    Polyline(Vec<[f64; 3]>),
    Circle([f64; 2], f64),
}

/// A drawing, the settings that hold for it, and the format of its program.
#[derive(Clone, Debug)]
struct Case {
    shapes: Vec<(Shape, Role)>,
    settings: String,
    format: Format,
}

fn settings_of(text: &str) -> Arc<Effective> {
    let (settings, mut errors) = from_toml(text);
    // A control has no constant stock: its programs are those of sharp corners.
    errors.retain(|error| !error.message.contains("beside the drawn contour"));
    assert!(errors.is_empty(), "{errors:?}\n{text}");
    Arc::new(Effective::of(&settings))
}

fn document(shapes: &[(Shape, Role)], settings: &Arc<Effective>) -> Document {
    let mut drawing = Drawing::new(Some(Unit::MILLIMETRE));
    for (index, (shape, role)) in shapes.iter().enumerate() {
        let (kind, geometry) = match shape {
            Shape::Polyline(vertices) => (
                Kind::LightPolyline,
                Geometry::Polyline {
                    closed: true,
                    vertices: vertices
                        .iter()
                        .map(|&[x, y, bulge]| Vertex::new(x, y, bulge))
                        .collect(),
                },
            ),
            Shape::Circle([x, y], radius) => (
                Kind::Circle,
                Geometry::Circle {
                    center: Point::new(*x, *y),
                    radius: *radius,
                },
            ),
        };
        drawing.push(Entity {
            handle: format!("{:X}", 42 + index).as_str().into(),
            layer: "0".into(),
            role: Some(*role),
            kind,
            geometry,
        });
    }
    Document::new(Source::Cad(Arc::new(drawing)), settings.clone())
}

/// The program of a drawing; `None` where none is made.
fn program_of(document: &Document, format: Format) -> Option<String> {
    let wanted = Wanted {
        format,
        handles: None,
        layers: None,
        force: true,
    };
    let made = job::generate(&document.snapshot()?, Vec::new(), &wanted, &());
    made.ok().map(|made| made.program.text)
}

fn traced(text: &str, format: Format, settings: &Effective) -> Traced {
    let language = format.language();
    Traced::of(&program::Document::read(language, text.into(), settings))
}

/// A plate, its lower right corner moved by this many mm.
fn plate(moved: f64) -> [(Shape, Role); 1] {
    let vertices = vec![
        [0.1234, 0.2345, 0.0],
        [20.3456 + moved, 0.4567, 0.0],
        [20.4567, 15.5678, 0.3],
        [10.1111, 18.2222, -0.2],
        [0.3333, 14.4444, 0.0],
    ];
    [(Shape::Polyline(vertices), Role::Punch)]
}
