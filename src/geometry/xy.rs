//! Points and angles as messages have them.

use super::Point;
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

/// A point `[x, y]` in drawing units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "Point")]
pub(crate) struct Xy(pub f64, pub f64);

impl From<Point> for Xy {
    fn from(point: Point) -> Xy {
        Xy(point.x, point.y)
    }
}

impl From<Xy> for Point {
    fn from(Xy(x, y): Xy) -> Point {
        Point::new(x, y)
    }
}

impl Xy {
    pub(crate) fn serialize_point<S: Serializer>(point: &Point, to: S) -> Result<S::Ok, S::Error> {
        Xy::from(*point).serialize(to)
    }
}

/// Radians as degrees.
pub(crate) fn serialize_degrees<S: Serializer>(angle: &f64, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_f64(angle.to_degrees())
}
