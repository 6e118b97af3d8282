//! Points and vertices of a drawing as lists of numbers.

use super::number::Number;
use crate::drawing::Vertex;
use crate::geometry::Xy;
use schemars::JsonSchema;
use serde::de::{Error as _, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

impl<'de> Deserialize<'de> for Xy {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Number2(x, y) = Number2::deserialize(deserializer)?;
        Ok(Xy(x.0, y.0))
    }
}

#[derive(Deserialize)]
struct Number2(Number, Number);

/// A vertex is `[x, y, bulge]`; the bulge may be left out and is 0 then.
impl Serialize for Vertex {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        (self.point.x, self.point.y, self.bulge).serialize(to)
    }
}

impl<'de> Deserialize<'de> for Vertex {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Numbers;
        impl<'de> Visitor<'de> for Numbers {
            type Value = Vertex;

            fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                f.write_str("a vertex [x, y] or [x, y, bulge]")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut numbers: A) -> Result<Vertex, A::Error> {
                let mut next = |missing: Option<f64>| -> Result<f64, A::Error> {
                    let number: Option<Number> = numbers.next_element()?;
                    number
                        .map(|number| number.0)
                        .or(missing)
                        .ok_or_else(|| A::Error::invalid_length(1, &"[x, y] or [x, y, bulge]"))
                };
                let vertex = Vertex::new(next(None)?, next(None)?, next(Some(0.0))?);
                match numbers.next_element::<Number>()? {
                    None => Ok(vertex),
                    Some(_) => Err(A::Error::invalid_length(4, &"[x, y] or [x, y, bulge]")),
                }
            }
        }
        deserializer.deserialize_seq(Numbers)
    }
}

impl JsonSchema for Vertex {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Vertex".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "description": "A vertex [x, y, bulge] of a polyline; the bulge may be left out and is 0 then.",
            "type": "array",
            "items": { "type": "number" },
            "minItems": 2,
            "maxItems": 3
        })
    }
}
