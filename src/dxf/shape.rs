//! The shape of an entity before it is placed: block references move, turn and stretch it, and curves are fitted last.

use crate::drawing::{Geometry, Kind, Vertex};
use crate::geometry::{
    BEYOND_A_TURN, Chain, Curve, EllipticArc, Point, Segment, Spline, SplineCurve, Unfit, Vector,
    cross, fit, positive_angle,
};
use std::f64::consts::TAU;

/// The shape of an entity, in the coordinates of its block or of the modelspace.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Shape {
    Plain(Geometry),
    Ellipse(EllipticArc),
    Spline(Box<Spline>),
}

/// Axes whose lengths differ by less than this share count as equal.
const ALIKE: f64 = 1e-9;

/// `p ↦ x_axis · p.x + y_axis · p.y + origin`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine {
    pub(super) x_axis: Vector,
    pub(super) y_axis: Vector,
    pub(super) origin: Point,
}

impl Affine {
    pub(super) const IDENTITY: Affine = Affine {
        x_axis: Vector::new(1.0, 0.0),
        y_axis: Vector::new(0.0, 1.0),
        origin: Point::new(0.0, 0.0),
    };

    pub(super) fn vector(&self, vector: Vector) -> Vector {
        self.x_axis * vector.x + self.y_axis * vector.y
    }

    pub(super) fn point(&self, point: Point) -> Point {
        self.origin + self.vector(point.coords)
    }

    /// The scale, and whether it mirrors, of a transformation that keeps angles; `None` of any other.
    pub(super) fn similarity(&self) -> Option<(f64, bool)> {
        let (x, y) = (self.x_axis.norm(), self.y_axis.norm());
        let alike =
            (x - y).abs() <= ALIKE * x && self.x_axis.dot(&self.y_axis).abs() <= ALIKE * x * y;
        (alike && x > 0.0).then(|| (x, cross(self.x_axis, self.y_axis) < 0.0))
    }
}

/// The arcs that each curve may take, and those that all curves of a drawing together may take
/// beyond that: a line of text can ask for hundreds.
const FREE_ARCS: usize = 50;
pub(super) const MOST_CURVE_ARCS: u64 = if cfg!(test) { 8_000 } else { 400_000 };

/// The arcs of a fitted curve beyond its free allowance.
pub(super) fn curve_arcs(kind: Kind, geometry: &Geometry) -> u64 {
    if matches!(kind, Kind::Ellipse | Kind::Spline) {
        geometry.segment_count().saturating_sub(FREE_ARCS) as u64
    } else {
        0
    }
}

/// How much coarser a curve with too many arcs is drawn; each step saves half of them.
const COARSER: [f64; 4] = [1.0, 8.0, 64.0, 512.0];

fn fitted(curve: &impl Curve, tolerance: f64) -> Result<(Geometry, f64), Unfit> {
    let mut last = Unfit::NoCurve;
    for times in COARSER {
        match fit(curve, tolerance * times) {
            Ok(chain) => {
                return polyline(chain)
                    .map(|geometry| (geometry, times))
                    .ok_or(Unfit::NoCurve);
            }
            Err(Unfit::NoCurve) => return Err(Unfit::NoCurve),
            Err(too_many) => last = too_many,
        }
    }
    Err(last)
}

impl Shape {
    /// The number of segments that it becomes: an upper bound, or for a curve an estimate.
    pub(super) fn cost(&self) -> u64 {
        match self {
            Shape::Plain(geometry) => geometry.segment_count().max(1) as u64,
            Shape::Ellipse(_) => 64,
            Shape::Spline(spline) => 24 * spline.point_count() as u64,
        }
    }

    /// The shape as geometry of the drawing, curves as arcs within `tolerance`. A curve that would take far too many
    /// arcs, as in a drawing in millimetres that states metres, is fitted within a multiple of it. An error where
    /// nothing can be drawn: a curve without length, numbers that overflow, or still too many arcs.
    pub(super) fn drawn(self, tolerance: f64) -> Result<(Geometry, f64), Unfit> {
        match self {
            Shape::Plain(geometry) => Ok((geometry, 1.0)),
            Shape::Ellipse(arc) if !arc.is_sound() => Err(Unfit::NoCurve),
            Shape::Ellipse(arc) => fitted(&arc, tolerance),
            Shape::Spline(spline) => fitted(&SplineCurve::from(&*spline), tolerance),
        }
    }

    /// The shape after a transformation: its parts, each with the name of its new kind.
    pub(super) fn placed(&self, map: &Affine, kind: Kind, put: &mut impl FnMut(Kind, Shape)) {
        match self {
            Shape::Ellipse(arc) => {
                let (center, u, v) = (map.point(arc.center), map.vector(arc.u), map.vector(arc.v));
                put(
                    kind,
                    Shape::Ellipse(EllipticArc {
                        center,
                        u,
                        v,
                        ..*arc
                    }),
                );
            }
            Shape::Spline(spline) => put(
                kind,
                Shape::Spline(Box::new(spline.mapped(|point| map.point(point)))),
            ),
            Shape::Plain(geometry) => match (geometry, map.similarity()) {
                (Geometry::Line { start, end }, _) => {
                    put(
                        kind,
                        Shape::Plain(Geometry::Line {
                            start: map.point(*start),
                            end: map.point(*end),
                        }),
                    );
                }
                (Geometry::Text { at, text }, _) => {
                    put(
                        kind,
                        Shape::Plain(Geometry::Text {
                            at: map.point(*at),
                            text: text.clone(),
                        }),
                    );
                }
                (geometry, Some((scale, mirrors))) => {
                    put(kind, Shape::Plain(similar(geometry, map, scale, mirrors)))
                }
                (Geometry::Polyline { closed, vertices }, None)
                    if vertices.iter().all(|vertex| vertex.bulge == 0.0) =>
                {
                    let vertices = vertices
                        .iter()
                        .map(|vertex| Vertex {
                            point: map.point(vertex.point),
                            bulge: 0.0,
                        })
                        .collect();
                    put(
                        kind,
                        Shape::Plain(Geometry::Polyline {
                            closed: *closed,
                            vertices,
                        }),
                    );
                }
                (geometry, None) => {
                    for segment in geometry.segments() {
                        match segment {
                            Segment::Line(line) => {
                                put(
                                    Kind::Line,
                                    Shape::Plain(Geometry::Line {
                                        start: map.point(line.start),
                                        end: map.point(line.end),
                                    }),
                                );
                            }
                            Segment::Arc(arc) => put(
                                Kind::Ellipse,
                                Shape::Ellipse(EllipticArc {
                                    center: map.point(arc.center),
                                    u: map.x_axis * arc.radius,
                                    v: map.y_axis * arc.radius,
                                    start: arc.start_angle,
                                    sweep: arc.sweep,
                                }),
                            ),
                        }
                    }
                }
            },
        }
    }
}

/// Geometry that keeps its form: moved, turned, scaled, mirrored.
fn similar(geometry: &Geometry, map: &Affine, scale: f64, mirrors: bool) -> Geometry {
    match geometry {
        Geometry::Polyline { closed, vertices } => {
            let bulge = |bulge: f64| if mirrors { 0.0 - bulge } else { bulge };
            let vertices = vertices.iter().map(|vertex| Vertex {
                point: map.point(vertex.point),
                bulge: bulge(vertex.bulge),
            });
            Geometry::Polyline {
                closed: *closed,
                vertices: vertices.collect(),
            }
        }
        Geometry::Arc {
            center,
            radius,
            start_angle,
            end_angle,
        } => {
            let turned = map.x_axis.y.atan2(map.x_axis.x);
            let (start_angle, end_angle) = if mirrors {
                (turned - end_angle, turned - start_angle)
            } else {
                (turned + start_angle, turned + end_angle)
            };
            Geometry::Arc {
                center: map.point(*center),
                radius: radius * scale,
                start_angle,
                end_angle,
            }
        }
        Geometry::Circle { center, radius } => Geometry::Circle {
            center: map.point(*center),
            radius: radius * scale,
        },
        Geometry::Line { start, end } => Geometry::Line {
            start: map.point(*start),
            end: map.point(*end),
        },
        Geometry::Text { at, text } => Geometry::Text {
            at: map.point(*at),
            text: text.clone(),
        },
    }
}

/// A chain that ends where it begins is closed.
fn polyline(chain: Chain) -> Option<Geometry> {
    let mut vertices: Vec<Vertex> = chain
        .into_iter()
        .map(|(point, bulge)| Vertex { point, bulge })
        .collect();
    let (first, last) = (vertices.first()?.point, vertices.last()?.point);
    let size = vertices
        .iter()
        .map(|vertex| (vertex.point - first).norm())
        .fold(0.0, f64::max);
    let closed = vertices.len() > 2 && (last - first).norm() <= ALIKE * size;
    if closed {
        vertices.pop();
    }
    vertices
        .iter()
        .all(Vertex::is_finite)
        .then_some(Geometry::Polyline { closed, vertices })
}

/// An ellipse by its half axes: `major`, and the second one, `ratio` times as long, to the left of it (to the right
/// where `mirrored`).
pub(super) fn ellipse(
    center: Point,
    major: Vector,
    ratio: f64,
    mirrored: bool,
    from: f64,
    to: f64,
) -> EllipticArc {
    let side = if mirrored { -ratio } else { ratio };
    let forward = positive_angle(to - from);
    let is_beyond = (0.0..BEYOND_A_TURN.to_radians()).contains(&(to - from - TAU));
    let sweep = if is_beyond || forward < ALIKE || TAU - forward < ALIKE {
        TAU
    } else {
        forward
    };
    EllipticArc {
        center,
        u: major,
        v: crate::geometry::left_normal(major) * side,
        start: from,
        sweep,
    }
}
