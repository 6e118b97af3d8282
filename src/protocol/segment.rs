//! A line, arc or circle in a reply: the same keys in the radius list, in contours and in wire paths.

use crate::geometry::Xy as Point;
use crate::geometry::{Arc, Segment};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum SegmentKind {
    Line,
    Arc,
    Circle,
}

/// Geometry of one segment in drawing units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct SegmentShape {
    pub(crate) kind: SegmentKind,
    pub(crate) start: Point,
    pub(crate) end: Point,
    pub(crate) length: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) center: Option<Point>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) radius: Option<f64>,
    /// Degrees, positive counter-clockwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) sweep: Option<f64>,
    /// `tan(sweep / 4)`; left out for lines and for a full turn, which has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) bulge: Option<f64>,
}

impl SegmentShape {
    /// An arc whose radius is 0.
    pub(super) fn point(at: Point) -> SegmentShape {
        SegmentShape {
            kind: SegmentKind::Arc,
            start: at,
            end: at,
            length: 0.0,
            center: Some(at),
            radius: Some(0.0),
            sweep: Some(0.0),
            bulge: None,
        }
    }
}

impl From<&Segment> for SegmentShape {
    fn from(segment: &Segment) -> SegmentShape {
        let arc = segment.as_arc();
        let kind = match arc {
            None => SegmentKind::Line,
            Some(arc) if arc.is_full_turn() => SegmentKind::Circle,
            Some(_) => SegmentKind::Arc,
        };
        SegmentShape {
            kind,
            start: segment.start().into(),
            end: segment.end().into(),
            length: segment.length(),
            center: arc.map(|arc| arc.center.into()),
            radius: arc.map(|arc| arc.radius),
            sweep: arc.map(|arc| arc.sweep.to_degrees()),
            bulge: arc.filter(|arc| !arc.is_full_turn()).map(Arc::bulge),
        }
    }
}
