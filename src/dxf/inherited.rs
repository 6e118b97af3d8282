//! What a reference to a block passes on to its parts: layer, colour, linetype, visibility; and where a shape in it
//! ends up.

use super::entity::{Appearance, Insert, Paint, Stroke};
use super::layer_table::LayerStates;
use super::shape::{Affine, Shape};
use super::space::{FLAT, Lies, Space, Vector3, in_space};
use crate::drawing::{Color, Geometry, Kind, Linetype, Visibility};
use crate::geometry::Point;
use std::borrow::Cow;
use std::sync::Arc;

/// What a reference passes on to its parts.
pub(super) struct Inherited {
    /// The layer of parts on layer 0.
    pub(super) layer: Arc<str>,
    /// The colour of parts that take their block's.
    color: Option<Color>,
    /// The linetype of parts that take their block's.
    linetype: Option<Linetype>,
    /// Set where none of it is visible: on a frozen layer, or for an invisible reference. A layer that is off hides
    /// only what lies on it.
    hidden: Option<(Visibility, Arc<str>)>,
}

impl Inherited {
    pub(super) fn from(
        insert: &Insert,
        layer: &Arc<str>,
        around: Option<&Inherited>,
        states: &mut LayerStates,
    ) -> Inherited {
        let around_hidden = around.and_then(|around| around.hidden.clone());
        let own = match states.of(layer) {
            _ if insert.appearance.invisible => Some((Visibility::Invisible, layer.clone())),
            Visibility::Frozen => Some((Visibility::Frozen, layer.clone())),
            _ => None,
        };
        let color = match insert.appearance.paint {
            Paint::Own(color) => Some(color),
            Paint::ByBlock => around.and_then(|around| around.color),
            Paint::ByLayer => None,
        };
        let around_linetype = around.and_then(|around| around.linetype.as_ref());
        Inherited {
            layer: layer.clone(),
            color,
            linetype: stroke(&insert.appearance.stroke, around_linetype, layer, states),
            hidden: match own {
                Some((Visibility::Invisible, _)) => own,
                _ => around_hidden.or(own),
            },
        }
    }

    /// Whether a part with its own appearance is visible, with the layer that decides it; its colour; its linetype.
    pub(super) fn hand_on(
        &self,
        appearance: &Appearance,
        layer: &Arc<str>,
        states: &mut LayerStates,
    ) -> ((Visibility, Arc<str>), Option<Color>, Option<Linetype>) {
        let visibility = match &self.hidden {
            _ if appearance.invisible => (Visibility::Invisible, layer.clone()),
            Some(hidden) => hidden.clone(),
            None => (states.of(layer), layer.clone()),
        };
        let color = match appearance.paint {
            Paint::Own(color) => Some(color),
            Paint::ByBlock => self.color,
            Paint::ByLayer => None,
        };
        let linetype = stroke(&appearance.stroke, self.linetype.as_ref(), layer, states);
        (visibility, color, linetype)
    }
}

/// The linetype of something on a layer, inside a reference that passes on the linetype `around`; `None` is a
/// continuous one.
pub(super) fn stroke(
    own: &Stroke,
    around: Option<&Linetype>,
    layer: &Arc<str>,
    states: &mut LayerStates,
) -> Option<Linetype> {
    match own {
        Stroke::ByLayer => states.linetype_of(layer),
        Stroke::ByBlock => around.cloned(),
        Stroke::Own(name) => Linetype::named(name.clone(), false),
    }
}

/// A shape in its plane, and the way from there to the drawing; `None` where it does not end level with the drawing.
pub(super) fn level<'a>(
    map: &Space,
    shape: &'a Shape,
    lies: &Lies,
    kind: Kind,
) -> Option<(Cow<'a, Shape>, Affine)> {
    let placed = match lies {
        Lies::Level(height) => map.after(&Space {
            origin: Vector3::new(0.0, 0.0, *height),
            ..Space::IDENTITY
        }),
        Lies::Aslant(plane, _) => map.after(plane),
        Lies::Rising(ends) => {
            let ends = ends.map(|end| map.point(end));
            let line = Geometry::Line {
                start: ends[0].xy().into(),
                end: ends[1].xy().into(),
            };
            // As in the modelspace, a line is cut as seen from above where the block itself is not tilted.
            return (map.is_flat() || are_level(&ends))
                .then_some((Cow::Owned(Shape::Plain(line)), Affine::IDENTITY));
        }
    };
    // Points on one line, and a single one, have no plane of their own.
    let point = |at: Point| placed.point(in_space(at.coords, 0.0));
    let is_level = placed.is_flat()
        || match shape {
            Shape::Plain(Geometry::Line { start, end }) => are_level(&[point(*start), point(*end)]),
            Shape::Plain(Geometry::Polyline { vertices, .. })
                if vertices.iter().all(|vertex| vertex.bulge == 0.0) =>
            {
                are_level(
                    &vertices
                        .iter()
                        .map(|vertex| point(vertex.point))
                        .collect::<Vec<_>>(),
                )
            }
            _ => kind == Kind::Point,
        };
    is_level.then(|| (Cow::Borrowed(shape), placed.seen_from_above()))
}

fn are_level(points: &[Vector3]) -> bool {
    let Some(first) = points.first() else {
        return true;
    };
    let spread = points
        .iter()
        .map(|point| (point - first).norm())
        .fold(0.0, f64::max);
    points
        .iter()
        .all(|point| (point.z - first.z).abs() <= FLAT * spread)
}
