//! The reply of `wedm/contours`: what is chained to what.

use super::segment::SegmentShape;
use crate::drawing::{Drawing, Outline, Role};
use crate::geometry::Tolerances;
use crate::settings::Effective;
use crate::toolpath;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Contours in machining order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub struct Contours {
    /// Millimetres in one drawing unit.
    pub(crate) units_to_mm: f64,
    pub(crate) contours: Vec<ContoursContour>,
}

/// Direction in which a closed contour is travelled as it was drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Direction {
    Ccw,
    Cw,
}

/// A contour; `area` and `direction` are those of a closed one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct ContoursContour {
    pub(crate) closed: bool,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) direction: Option<Direction>,
    pub(crate) role: Role,
    /// Square drawing units, arcs counted in.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) area: Option<f64>,
    /// Drawing units, along the segments.
    pub(crate) length: f64,
    /// Its place among the cuts, from 0: as drawn, but what lies within another contour before it. Missing for what is not cut, and in
    /// a drawing of more than 20,000 contours.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) order: Option<usize>,
    /// The start mark beside it: a TEXT or MTEXT "O", or a POINT.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) mark: Option<[f64; 2]>,
    /// In the direction of travel.
    pub(crate) segments: Vec<ContourPiece>,
    /// The handles of its entities, where they are asked for instead.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) handles: Vec<String>,
    /// Ends that lay apart within the join tolerance and were taken as one.
    pub(crate) gaps: Vec<Gap>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct ContourPiece {
    pub(crate) handle: String,
    /// Index within the entity.
    pub(crate) segment: usize,
    /// Travelled against the entity's own direction.
    pub(crate) reversed: bool,
    #[serde(flatten)]
    pub(crate) shape: SegmentShape,
}

/// A gap that chaining closed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Gap {
    /// Index in the contour's `segments` of the one that ends here.
    pub(crate) after: usize,
    /// Drawing units.
    pub(crate) distance: f64,
}

impl Contours {
    pub fn new(drawing: &Drawing, outlines: &[Outline], settings: &Effective) -> Contours {
        Contours::listed(drawing, outlines, settings, false)
    }

    /// The same; `in_short` with handles instead of segments.
    pub(crate) fn listed(
        drawing: &Drawing,
        outlines: &[Outline],
        settings: &Effective,
        in_short: bool,
    ) -> Contours {
        let unit_mm = settings.unit_of(drawing).mm;
        let mut contours = Contours::unordered(drawing, outlines, unit_mm, in_short);
        for (order, cut) in toolpath::cuts(drawing, outlines, settings)
            .into_iter()
            .flatten()
            .enumerate()
        {
            if let Some(contour) = contours.contours.get_mut(cut.outline) {
                contour.order = Some(order);
                contour.mark = cut.mark.map(|at| [at.x, at.y]);
            }
        }
        contours
    }

    /// `unit_mm` is the drawing's unit in mm.
    fn unordered(
        drawing: &Drawing,
        outlines: &[Outline],
        unit_mm: f64,
        in_short: bool,
    ) -> Contours {
        Contours {
            units_to_mm: unit_mm,
            contours: outlines
                .iter()
                .map(|outline| contour(drawing, outline, unit_mm, in_short))
                .collect(),
        }
    }
}

fn contour(drawing: &Drawing, outline: &Outline, unit_mm: f64, in_short: bool) -> ContoursContour {
    // What is smaller is no gap, see `Limits::least`.
    let least = Tolerances::default().in_units(unit_mm).resolution;
    let segments: Vec<_> = outline.contour.segments(drawing).collect();
    let count = segments.len();
    let closed = outline.contour.closed;
    let joints = if closed {
        count
    } else {
        count.saturating_sub(1)
    };
    let gaps = (0..joints).filter_map(|after| {
        let (end, start) = (
            segments.get(after)?.geometry.end(),
            segments.get((after + 1) % count)?.geometry.start(),
        );
        let distance = (start - end).norm();
        (distance > least).then_some(Gap { after, distance })
    });
    let direction = if outline.twice_area < 0.0 {
        Direction::Cw
    } else {
        Direction::Ccw
    };
    let entities = outline.contour.pieces.iter().map(|piece| piece.entity);
    let handles = entities.filter_map(|entity| Some(drawing.get(entity)?.handle.to_string()));
    ContoursContour {
        closed,
        direction: (closed && outline.twice_area != 0.0).then_some(direction),
        role: outline.role,
        area: closed.then_some(outline.twice_area.abs() / 2.0),
        length: segments
            .iter()
            .map(|segment| segment.geometry.length())
            .sum(),
        order: None,
        mark: None,
        gaps: gaps.collect(),
        handles: match in_short {
            true => handles.collect(),
            false => Vec::new(),
        },
        segments: (segments.iter().filter(|_| !in_short))
            .filter_map(|segment| {
                Some(ContourPiece {
                    handle: drawing.get(segment.entity)?.handle.to_string(),
                    segment: segment.segment,
                    reversed: segment.reversed,
                    shape: SegmentShape::from(&segment.geometry),
                })
            })
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Contour, Entity, Geometry, Kind};
    use crate::geometry::Point;
    use std::f64::consts::PI;

    /// Two half circles meet except for the last digits of the sine; gaps that the rule `gap`
    /// reports are listed.
    #[test]
    fn rounding_is_no_gap() {
        for (off, expected) in [(0.0, vec![]), (0.002, vec![(0, 0.002), (1, 0.002)])] {
            let mut drawing = Drawing::new(None);
            let half = |x: f64, start_angle: f64| Geometry::Arc {
                center: Point::new(x, 0.0),
                radius: 5.0,
                start_angle,
                end_angle: start_angle + PI,
            };
            let ids = [half(0.0, 0.0), half(off, PI)].map(|geometry| {
                drawing.push(Entity {
                    handle: "A".into(),
                    layer: "0".into(),
                    role: None,
                    kind: Kind::Arc,
                    geometry,
                })
            });
            let contour = Contour::new(&drawing, ids.map(|id| (id, false)), true);
            let outline = Outline {
                contour,
                role: Role::Both,
                twice_area: 1.0,
            };
            let listed = Contours::unordered(&drawing, &[outline], 1.0, false)
                .contours
                .remove(0)
                .gaps;
            let listed: Vec<_> = listed
                .into_iter()
                .map(|gap| (gap.after, (gap.distance * 1e9).round() / 1e9))
                .collect();
            assert_eq!(listed, expected);
        }
    }
    /// A plate that is drawn before its hole, and a mark in the hole.
    #[test]
    fn what_is_cut_first_and_where_it_is_marked() {
        let mut drawing = Drawing::new(None);
        let circle = |x: f64, radius: f64| Geometry::Circle {
            center: Point::new(x, 0.0),
            radius,
        };
        let mark = Geometry::Text {
            at: Point::new(5.0, 0.5),
            text: "O".into(),
        };
        let outline = |drawing: &mut Drawing, geometry: Geometry, kind: Kind| {
            let id = drawing.push(Entity {
                handle: "A".into(),
                layer: "0".into(),
                role: None,
                kind,
                geometry,
            });
            Outline {
                contour: Contour::new(drawing, [(id, false)], true),
                role: Role::Opening,
                twice_area: 1.0,
            }
        };
        let outlines = [circle(0.0, 20.0), circle(5.0, 2.0)]
            .map(|geometry| outline(&mut drawing, geometry, Kind::Circle));
        drawing.push(Entity {
            handle: "M".into(),
            layer: "0".into(),
            role: None,
            kind: Kind::Text,
            geometry: mark,
        });
        let listed = Contours::new(
            &drawing,
            &outlines,
            &Effective::of(&crate::settings::Settings::default()),
        )
        .contours;
        let told: Vec<_> = listed
            .iter()
            .map(|contour| (contour.order, contour.mark))
            .collect();
        assert_eq!(told, [(Some(1), None), (Some(0), Some([5.0, 0.5]))]);
    }
}
