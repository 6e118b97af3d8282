//! The source's name for an entity.

use std::fmt;

/// The name of an entity in DXF; for a CAD program's entity that of the equivalent DXF entity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    Line,
    Arc,
    Circle,
    /// LWPOLYLINE.
    LightPolyline,
    Polyline,
    Ellipse,
    Spline,
    Text,
    /// MTEXT.
    LongText,
    Point,
}

impl Kind {
    pub fn name(self) -> &'static str {
        match self {
            Kind::Line => "LINE",
            Kind::Arc => "ARC",
            Kind::Circle => "CIRCLE",
            Kind::LightPolyline => "LWPOLYLINE",
            Kind::Polyline => "POLYLINE",
            Kind::Ellipse => "ELLIPSE",
            Kind::Spline => "SPLINE",
            Kind::Text => "TEXT",
            Kind::LongText => "MTEXT",
            Kind::Point => "POINT",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
