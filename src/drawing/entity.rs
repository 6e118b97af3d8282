//! One entity of a drawing.

use super::{Handle, Kind};
use crate::geometry::{
    Arc, Bounds, Point, Segment, Tolerances, Xy, positive_angle, serialize_degrees,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use std::sync::Arc as Shared;

/// Identifies an entity in its drawing: stays the same until the entity is removed, and is not used again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EntityId(pub u32);

/// A vertex of a polyline with the bulge of the segment that starts in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    pub point: Point,
    /// `tan(sweep / 4)` of the segment to the next vertex; 0 is a line.
    pub bulge: f64,
}

impl Vertex {
    pub fn new(x: f64, y: f64, bulge: f64) -> Vertex {
        Vertex {
            point: Point::new(x, y),
            bulge,
        }
    }

    /// The largest bulge of an arc: beyond it coordinates cannot tell the arc from its full circle.
    pub(crate) const MOST_BULGE: f64 = 1e12;

    /// True where all numbers are finite, and the bulge is small enough for the radius of its arc
    /// to be determined.
    pub(crate) fn is_finite(&self) -> bool {
        self.point.x.is_finite()
            && self.point.y.is_finite()
            && self.bulge.abs() <= Vertex::MOST_BULGE
    }
}

/// The kind of outline: it decides on which side the wire runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// A die opening: the wire runs inside.
    Opening,
    /// A punch, or the outer outline of a part: the wire runs outside.
    Punch,
    /// Cut once as the punch and once as the plate: every arc must survive both sides.
    Both,
    /// An open contour: the wire runs to the left of its direction, which is that of the entity that was drawn first.
    Left,
    /// The same to the right.
    Right,
    /// Cut on the line: the wire's centre runs on the contour, without correction. Slits, clamps, marks.
    Line,
    /// Not cut.
    Ignore,
}

impl Role {
    /// Its name in the settings.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Role::Opening => "opening",
            Role::Punch => "punch",
            Role::Both => "both",
            Role::Left => "left",
            Role::Right => "right",
            Role::Line => "line",
            Role::Ignore => "ignore",
        }
    }
}

/// The geometry of an entity. Messages give its angles in degrees.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(
    tag = "type",
    rename_all = "lowercase",
    rename_all_fields = "camelCase"
)]
pub enum Geometry {
    /// Segment i runs from vertex i to vertex i + 1; the last vertex of a closed polyline starts the closing segment.
    Polyline { closed: bool, vertices: Vec<Vertex> },
    Line {
        #[serde(serialize_with = "Xy::serialize_point")]
        #[schemars(with = "Xy")]
        start: Point,
        #[serde(serialize_with = "Xy::serialize_point")]
        #[schemars(with = "Xy")]
        end: Point,
    },
    /// Counter-clockwise from `start_angle` to `end_angle`, radians.
    #[schemars(description = "Angles in degrees, counter-clockwise, as in DXF.")]
    Arc {
        #[serde(serialize_with = "Xy::serialize_point")]
        #[schemars(with = "Xy")]
        center: Point,
        radius: f64,
        #[serde(serialize_with = "serialize_degrees")]
        start_angle: f64,
        #[serde(serialize_with = "serialize_degrees")]
        end_angle: f64,
    },
    Circle {
        #[serde(serialize_with = "Xy::serialize_point")]
        #[schemars(with = "Xy")]
        center: Point,
        radius: f64,
    },
    /// "O" marks a starting point; a point without a word is not cut.
    Text {
        #[serde(serialize_with = "Xy::serialize_point")]
        #[schemars(with = "Xy")]
        at: Point,
        text: String,
    },
}

impl Geometry {
    /// What remains of an arc without a radius: nothing that is cut.
    pub(crate) fn point(at: Point) -> Geometry {
        Geometry::Text {
            at,
            text: String::new(),
        }
    }

    /// A POINT: it may mark where a cut starts, as the text "O" does.
    pub(crate) fn mark(at: Point) -> Geometry {
        Geometry::Text {
            at,
            text: "O".into(),
        }
    }

    /// A line, an arc or a circle as it lies in the drawing, without the direction of an arc.
    pub(crate) fn of_segment(segment: &Segment) -> Geometry {
        match segment {
            Segment::Line(line) => Geometry::Line {
                start: line.start,
                end: line.end,
            },
            Segment::Arc(arc) if arc.is_full_turn() => Geometry::Circle {
                center: arc.center,
                radius: arc.radius,
            },
            Segment::Arc(arc) if arc.sweep < 0.0 => Geometry::of_arc(&arc.reversed()),
            Segment::Arc(arc) => Geometry::of_arc(arc),
        }
    }

    /// An arc that runs counter-clockwise, its angles from 0 to below a full turn.
    pub(crate) fn of_arc(arc: &Arc) -> Geometry {
        Geometry::Arc {
            center: arc.center,
            radius: arc.radius,
            start_angle: positive_angle(arc.start_angle),
            end_angle: positive_angle(arc.start_angle + arc.sweep),
        }
    }

    /// The kind of an entity that consists of this geometry alone.
    pub(crate) fn kind(&self) -> Kind {
        match self {
            Geometry::Polyline { .. } => Kind::LightPolyline,
            Geometry::Line { .. } => Kind::Line,
            Geometry::Arc { .. } => Kind::Arc,
            Geometry::Circle { .. } => Kind::Circle,
            Geometry::Text { .. } => Kind::Text,
        }
    }

    /// Number of segments: 0 for text and for a polyline of less than two vertices.
    pub fn segment_count(&self) -> usize {
        match self {
            Geometry::Polyline { closed, vertices } => match vertices.len() {
                0 | 1 => 0,
                count if *closed => count,
                count => count - 1,
            },
            Geometry::Line { .. } | Geometry::Arc { .. } | Geometry::Circle { .. } => 1,
            Geometry::Text { .. } => 0,
        }
    }

    /// Segment `index` as `Geometry::segment_of` gives it for a drawing in millimetres.
    pub(crate) fn segment(&self, index: usize) -> Option<Segment> {
        self.segment_of(index, Tolerances::default().flat)
    }

    /// Segment `index` in the entity's own direction. An ARC whose angles coincide is a full turn, as a CIRCLE is,
    /// which starts at its +X-most point. A segment that rises less than `flat` (see [`Drawing::flat`]) above its chord
    /// is a line.
    ///
    /// [`Drawing::flat`]: super::Drawing::flat
    pub(crate) fn segment_of(&self, index: usize, flat: f64) -> Option<Segment> {
        match self {
            Geometry::Polyline { vertices, .. } => {
                if index >= self.segment_count() {
                    return None;
                }
                let (from, to) = (vertices[index], vertices[(index + 1) % vertices.len()]);
                Some(Segment::from_bulge(from.point, to.point, from.bulge).straightened(flat))
            }
            _ if index > 0 => None,
            Geometry::Line { start, end } => Some(Segment::line(*start, *end)),
            Geometry::Arc {
                center,
                radius,
                start_angle,
                end_angle,
            } => {
                let forward = positive_angle(end_angle - start_angle);
                let sweep = if forward == 0.0 { TAU } else { forward };
                Some(
                    Segment::Arc(Arc::from_center(*center, *radius, *start_angle, sweep))
                        .straightened(flat),
                )
            }
            Geometry::Circle { center, radius } => {
                Some(Segment::Arc(Arc::from_center(*center, *radius, 0.0, TAU)))
            }
            Geometry::Text { .. } => None,
        }
    }

    /// All segments in the entity's own direction, as in a drawing in millimetres.
    pub fn segments(&self) -> impl Iterator<Item = Segment> + '_ {
        self.segments_of(Tolerances::default().flat)
    }

    /// All segments in the entity's own direction: see `Geometry::segment_of`.
    pub(crate) fn segments_of(&self, flat: f64) -> impl Iterator<Item = Segment> + '_ {
        (0..self.segment_count()).filter_map(move |index| self.segment_of(index, flat))
    }

    /// True where the geometry is a contour of its own and has no free ends.
    pub(crate) fn is_closed(&self) -> bool {
        match self {
            Geometry::Polyline { closed, .. } => *closed,
            Geometry::Circle { .. } => true,
            Geometry::Arc { .. } => self
                .segment(0)
                .is_some_and(|s| s.as_arc().is_some_and(Arc::is_full_turn)),
            Geometry::Line { .. } | Geometry::Text { .. } => false,
        }
    }

    /// The two free ends, start first; `None` for closed geometry and for geometry without segments.
    pub(crate) fn ends(&self) -> Option<(Point, Point)> {
        match self {
            Geometry::Line { start, end } => Some((*start, *end)),
            Geometry::Circle { .. }
            | Geometry::Text { .. }
            | Geometry::Polyline { closed: true, .. } => None,
            Geometry::Polyline { vertices, .. } if vertices.len() < 2 => None,
            Geometry::Polyline { vertices, .. } => {
                Some((vertices.first()?.point, vertices.last()?.point))
            }
            Geometry::Arc { .. } => {
                let segment = self.segment(0)?;
                let is_full_turn = segment.as_arc().is_some_and(Arc::is_full_turn);
                (!is_full_turn).then(|| (segment.start(), segment.end()))
            }
        }
    }

    /// The box of all segments, see `Geometry::segment_of`, or of a text's place.
    pub(crate) fn bounds(&self, flat: f64) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        self.segments_of(flat)
            .for_each(|segment| bounds.merge(&segment.bounds()));
        if let Geometry::Text { at, .. } = self {
            bounds.include(*at);
        }
        bounds
    }

    /// True when every number is finite and every radius is positive.
    pub fn is_sound(&self) -> bool {
        let finite = |point: &Point| point.x.is_finite() && point.y.is_finite();
        match self {
            Geometry::Polyline { vertices, .. } => vertices.iter().all(Vertex::is_finite),
            Geometry::Line { start, end } => finite(start) && finite(end),
            Geometry::Arc {
                center,
                radius,
                start_angle,
                end_angle,
            } => {
                finite(center)
                    && radius.is_finite()
                    && *radius > 0.0
                    && start_angle.is_finite()
                    && end_angle.is_finite()
            }
            Geometry::Circle { center, radius } => {
                finite(center) && radius.is_finite() && *radius > 0.0
            }
            Geometry::Text { at, .. } => finite(at),
        }
    }
}

/// One entity: its handle, layer, role, kind and geometry.
#[derive(Clone, Debug, PartialEq)]
pub struct Entity {
    pub handle: Handle,
    pub layer: Shared<str>,
    /// The role that the entity itself states; it wins over layers and settings.
    pub role: Option<Role>,
    pub kind: Kind,
    pub geometry: Geometry,
}

impl Entity {
    /// An entity that states no role and is only its geometry.
    pub(crate) fn new(
        handle: impl Into<Handle>,
        layer: impl Into<Shared<str>>,
        geometry: Geometry,
    ) -> Entity {
        Entity {
            handle: handle.into(),
            layer: layer.into(),
            role: None,
            kind: geometry.kind(),
            geometry,
        }
    }

    /// The place of an arc whose radius is 0: it is drawn and has no segment.
    pub(crate) fn point_of_arc(&self) -> Option<Point> {
        match (self.kind, &self.geometry) {
            (Kind::Arc, Geometry::Text { at, .. }) => Some(*at),
            _ => None,
        }
    }
}
