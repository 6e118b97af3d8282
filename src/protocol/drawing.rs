//! A drawing as a CAD program sends it, and the way to and from the core's drawing.

use super::look::{self, Look};
use super::number::Number;
use crate::drawing::{self as core, Appearance, EntityId, Geometry, Kind, Role, Unit, Vertex};
use crate::geometry::{Point, Xy, radians_of_arc};
use schemars::JsonSchema;
use serde::de::Error as _;
use serde::ser::SerializeStruct;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;
use std::sync::Arc;

/// The unit of a drawing's coordinates; the settings decide where it is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Units {
    Mm,
    Inch,
}

impl From<Units> for Unit {
    fn from(units: Units) -> Unit {
        match units {
            Units::Mm => Unit::MILLIMETRE,
            Units::Inch => Unit::INCH,
        }
    }
}

/// A drawing without text behind it, entities in machining order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Drawing {
    pub(crate) uri: String,
    pub(crate) version: i64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) units: Option<Units>,
    pub(crate) entities: Vec<Entity>,
}

/// One entity: what it is called, where it belongs, how it is shown, what it is.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub(crate) struct Entity {
    pub handle: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layer: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub role: Option<Role>,
    #[serde(flatten)]
    pub look: Look,
    #[serde(flatten)]
    pub shape: Shape,
}

/// What an entity is. A POINT is a text "O" to the core, of another kind.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shape {
    pub kind: Kind,
    pub geometry: Geometry,
}

impl Serialize for Shape {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match (self.kind, &self.geometry) {
            (Kind::Point, Geometry::Text { at, .. }) => {
                let mut keys = to.serialize_struct("Point", 2)?;
                keys.serialize_field("type", "point")?;
                keys.serialize_field("at", &Xy::from(*at))?;
                keys.end()
            }
            _ => self.geometry.serialize(to),
        }
    }
}

impl JsonSchema for Shape {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Shape".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(types: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let mut schema = Geometry::json_schema(types);
        let point = serde_json::json!({
            "type": "object",
            "properties": {
                "type": { "type": "string", "const": "point" },
                "at": types.subschema_for::<Xy>()
            },
            "required": ["type", "at"]
        });
        if let Some(Value::Array(shapes)) = schema.get_mut("oneOf") {
            shapes.push(point);
        }
        schema
    }
}

/// Every key an entity may have. Read as one flat struct: a tagged enum would hold a million vertices twice.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Keys {
    handle: String,
    layer: Option<String>,
    role: Option<Role>,
    r#type: String,
    closed: Option<bool>,
    vertices: Option<Vec<Vertex>>,
    start: Option<Xy>,
    end: Option<Xy>,
    center: Option<Xy>,
    #[serde(default, deserialize_with = "given")]
    radius: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    start_angle: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    end_angle: Option<f64>,
    at: Option<Xy>,
    text: Option<String>,
    linetype: Option<String>,
    linetype_by_layer: Option<bool>,
    color: Option<Value>,
    visible: Option<Value>,
    xdata: Option<Vec<String>>,
}

fn given<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    Number::deserialize(deserializer).map(|number| Some(number.0))
}

impl<'de> Deserialize<'de> for Entity {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let keys = Keys::deserialize(deserializer)?;
        let kind = keys.r#type;
        let name = keys.handle.clone();
        let missing = |key: &str| D::Error::custom(say!(an_entity_needs, name, kind, key));
        let point =
            |key: &str, point: Option<Xy>| point.map(Point::from).ok_or_else(|| missing(key));
        let angles = || -> Result<(f64, f64), D::Error> {
            let from = keys.start_angle.ok_or_else(|| missing("startAngle"))?;
            let to = keys.end_angle.ok_or_else(|| missing("endAngle"))?;
            Ok(radians_of_arc(from, to))
        };
        let geometry = match kind.as_str() {
            "polyline" => Geometry::Polyline {
                closed: keys.closed.ok_or_else(|| missing("closed"))?,
                vertices: keys.vertices.ok_or_else(|| missing("vertices"))?,
            },
            "line" => Geometry::Line {
                start: point("start", keys.start)?,
                end: point("end", keys.end)?,
            },
            "arc" => {
                let center = point("center", keys.center)?;
                let radius = keys.radius.ok_or_else(|| missing("radius"))?;
                let (start_angle, end_angle) = angles()?;
                Geometry::Arc {
                    center,
                    radius,
                    start_angle,
                    end_angle,
                }
            }
            "circle" => Geometry::Circle {
                center: point("center", keys.center)?,
                radius: keys.radius.ok_or_else(|| missing("radius"))?,
            },
            "text" => Geometry::Text {
                at: point("at", keys.at)?,
                text: keys.text.ok_or_else(|| missing("text"))?,
            },
            "point" => Geometry::mark(point("at", keys.at)?),
            _ => {
                let message = say!(the_entity_is_of_no_known_type, name, kind);
                return Err(D::Error::custom(message));
            }
        };
        let look = Look {
            linetype: look::linetype(&name, keys.linetype).map_err(D::Error::custom)?,
            linetype_by_layer: keys.linetype_by_layer.unwrap_or_default(),
            color: look::color(&name, keys.color).map_err(D::Error::custom)?,
            visible: look::visible(&name, keys.visible).map_err(D::Error::custom)?,
            xdata: keys.xdata.unwrap_or_default(),
        };
        let shape = Shape {
            kind: match kind.as_str() {
                "point" => Kind::Point,
                _ => geometry.kind(),
            },
            geometry,
        };
        Ok(Entity {
            handle: keys.handle,
            layer: keys.layer,
            role: keys.role,
            look,
            shape,
        })
    }
}

impl Drawing {
    /// The core's drawing. Errors: a handle that occurs twice, a number that is not finite, a
    /// radius that is not above 0.
    pub(crate) fn into_core(self) -> Result<core::Drawing, String> {
        let mut drawing = core::Drawing::new(self.units.map(Unit::from));
        for entity in self.entities {
            let (entity, appearance) = entity.into_core()?;
            if drawing.find(&entity.handle).is_some() {
                return Err(say!(the_handle_stands_twice, entity.handle));
            }
            let id = drawing.push(entity);
            drawing.set_appearance(id, appearance);
        }
        Ok(drawing)
    }
}

impl Entity {
    /// The core's entity, and how it is shown. Errors: a number that is not finite, a radius that is not above 0.
    pub(crate) fn into_core(self) -> Result<(core::Entity, Appearance), String> {
        self.check()?;
        let layer: Arc<str> = self.layer.as_deref().unwrap_or("0").into();
        let appearance = self.look.into_core(&layer);
        let entity = core::Entity {
            role: self.role,
            kind: self.shape.kind,
            ..core::Entity::new(self.handle, layer, self.shape.geometry)
        };
        Ok((entity, appearance))
    }

    /// An entity of the core's drawing with another geometry; `None` where it is not there.
    pub(crate) fn reshaped(
        drawing: &core::Drawing,
        id: EntityId,
        geometry: Geometry,
    ) -> Option<Entity> {
        let entity = drawing.get(id)?;
        let appearance = Appearance {
            color: drawing.color(id),
            ..drawing.appearance(id)
        };
        let kind = match entity.kind {
            Kind::Point => Kind::Point,
            _ => geometry.kind(),
        };
        Some(Entity {
            handle: entity.handle.to_string(),
            layer: Some(entity.layer.to_string()),
            role: entity.role,
            look: Look::of(&appearance, &entity.layer),
            shape: Shape { kind, geometry },
        })
    }

    /// The error names the number of the entity that is not finite, or the radius that is not above
    /// 0.
    pub(crate) fn check(&self) -> Result<(), String> {
        let name = &self.handle;
        let point = |key: &str, at: &Point| match at.x.is_finite() && at.y.is_finite() {
            true => Ok(()),
            false => Err(say!(not_two_finite_numbers, name, key)),
        };
        let radius_is_sound = |radius: f64| match radius.is_finite() && radius > 0.0 {
            true => Ok(()),
            false => Err(say!(the_radius_is_not_finite_and_above_0, name, radius)),
        };
        let angle = |key: &str, angle: f64| match angle.is_finite() {
            true => Ok(()),
            false => Err(say!(not_a_finite_number, name, key)),
        };
        match &self.shape.geometry {
            Geometry::Polyline { vertices, .. } => {
                match vertices.iter().position(|vertex| !vertex.is_finite()) {
                    Some(index) => Err(say!(a_vertex_is_not_finite, name, index)),
                    None => Ok(()),
                }
            }
            Geometry::Line { start, end } => point("start", start).and(point("end", end)),
            Geometry::Arc {
                center,
                radius,
                start_angle,
                end_angle,
            } => {
                point("center", center)?;
                radius_is_sound(*radius)?;
                angle("startAngle", *start_angle).and(angle("endAngle", *end_angle))
            }
            Geometry::Circle { center, radius } => {
                point("center", center).and(radius_is_sound(*radius))
            }
            Geometry::Text { at, .. } => point("at", at),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    fn read(entities: Value) -> Result<core::Drawing, String> {
        let drawing = json!({ "uri": "cad:///1", "version": 1, "entities": entities });
        let drawing: Drawing =
            serde_json::from_value(drawing).map_err(|error| error.to_string())?;
        drawing.into_core()
    }

    #[test]
    fn an_unsound_drawing_is_refused_and_the_fault_named() {
        let check = |entities: Value, expected: &str| {
            let error = read(entities).expect_err(expected);
            assert!(error.contains(expected), "{error}");
        };
        let polyline = |vertices: Value| json!([{ "handle": "2A", "type": "polyline", "closed": true, "vertices": vertices }]);
        check(
            polyline(json!([[0, 0], [1, null]])),
            "entity 2A: vertex 1 has a number that is not finite",
        );
        check(
            polyline(json!([["NaN", 0], [1, 2]])),
            "entity 2A: vertex 0 has a number that is not finite",
        );
        check(
            polyline(json!([[0, 0, null], [1, 2]])),
            "entity 2A: vertex 0 has a number that is not finite",
        );
        check(polyline(json!([[0], [1, 2]])), "[x, y] or [x, y, bulge]");
        check(polyline(json!([[0, 1, 2, 3]])), "[x, y] or [x, y, bulge]");
        check(
            json!([{ "handle": "1", "type": "circle", "center": [0, 0], "radius": 0 }]),
            "entity 1: radius is 0, expected",
        );
        check(
            json!([{ "handle": "1", "type": "circle", "center": [0, 0], "radius": null }]),
            "entity 1: radius is NaN, expected",
        );
        check(
            json!([{ "handle": "1", "type": "circle", "center": [0, 0] }]),
            "entity 1: a circle needs radius",
        );
        check(
            json!([{ "handle": "1", "type": "spline" }]),
            "entity 1: type is \"spline\"",
        );
        let looks = |keys: &str| -> Value {
            let entity = json!({ "handle": "1", "type": "circle", "center": [0, 0], "radius": 1 });
            let mut entities = json!([entity]);
            let keys: Value = serde_json::from_str(keys).unwrap();
            let own = entities[0].as_object_mut().unwrap();
            own.extend(keys.as_object().unwrap().clone());
            entities
        };
        for (keys, expected) in [
            (
                r#"{ "linetype": "ByLayer" }"#,
                "entity 1: linetype is ByLayer, expected the name",
            ),
            (
                r#"{ "color": 256 }"#,
                "entity 1: color is 256, expected 1 to 255",
            ),
            (
                r#"{ "color": 1.5 }"#,
                "entity 1: color is 1.5, expected 1 to 255",
            ),
            (
                r#"{ "color": [1] }"#,
                "entity 1: color is [1], expected 1 to 255",
            ),
            (
                r#"{ "visible": "locked" }"#,
                "entity 1: visible is \"locked\", expected true",
            ),
            (
                r#"{ "visible": 0 }"#,
                "entity 1: visible is 0, expected true",
            ),
        ] {
            check(looks(keys), expected);
        }
        let line = json!({ "handle": "7", "type": "line", "start": [0, 0], "end": [1, 0] });
        check(json!([line, line]), "handle 7 is repeated");
    }

    #[test]
    fn an_entity_survives_the_way_to_the_core_and_back() {
        for entity in [
            json!({ "handle": "1", "layer": "DIE", "role": "opening", "type": "polyline", "closed": true, "vertices": [[0.0, 0.0, 0.5], [1.0, 0.0, 0.0]] }),
            json!({ "handle": "2", "layer": "0", "type": "line", "start": [0.0, 0.0], "end": [1.0, 2.0] }),
            json!({ "handle": "3", "layer": "0", "type": "arc", "center": [0.0, 0.0], "radius": 2.0, "startAngle": 0.0, "endAngle": 90.0 }),
            json!({ "handle": "4", "layer": "0", "type": "circle", "center": [0.0, 0.0], "radius": 2.0 }),
            json!({ "handle": "5", "layer": "0", "type": "text", "at": [0.0, 0.0], "text": "O" }),
            json!({ "handle": "8", "layer": "0", "type": "point", "at": [0.0, 0.0] }),
            json!({ "handle": "6", "layer": "A", "linetype": "HIDDEN", "linetypeByLayer": true, "color": 3, "visible": "frozen",
                "type": "circle", "center": [0.0, 0.0], "radius": 2.0 }),
            json!({ "handle": "7", "layer": "A", "color": "#ff8000", "visible": false, "xdata": ["suppress gap: as drawn"],
                "type": "circle", "center": [0.0, 0.0], "radius": 2.0 }),
        ] {
            let drawing = read(json!([entity])).unwrap();
            let id = drawing.order()[0];
            let geometry = drawing.get(id).unwrap().geometry.clone();
            let back = Entity::reshaped(&drawing, id, geometry).unwrap();
            assert_eq!(serde_json::to_value(back).unwrap(), entity);
        }
    }

    #[test]
    fn what_says_nothing_of_the_look_is_the_same_as_nothing() {
        let circle = |keys: Value| {
            let mut entity =
                json!({ "handle": "1", "type": "circle", "center": [0, 0], "radius": 2 });
            entity
                .as_object_mut()
                .unwrap()
                .extend(keys.as_object().unwrap().clone());
            let drawing = read(json!([entity])).unwrap();
            format!("{:?}", drawing.appearance(drawing.order()[0]))
        };
        let plain = circle(json!({}));
        assert_eq!(
            circle(
                json!({ "linetype": "Continuous", "linetypeByLayer": true, "visible": true, "xdata": [] })
            ),
            plain
        );
        assert_eq!(
            circle(json!({ "linetype": null, "color": null, "visible": null })),
            plain
        );
        assert_eq!(
            circle(json!({ "color": "#ff0000" })),
            circle(json!({ "color": 1 }))
        );
    }
}
