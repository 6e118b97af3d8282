//! How a CAD program shows an entity, as far as that decides whether it is cut: the keys of an entity, to and from the core's
//! appearance. Which of them are cut is decided by the core alone, for drawings and for DXF text.

use crate::drawing::{Appearance, Color, Linetype, Visibility};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};
use serde_json::Value;
use std::sync::Arc;

/// As the CAD program shows it: what the entity takes from its layer or its block is theirs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Look {
    /// Name of its linetype; left out: continuous. What is drawn in CENTER, HIDDEN and their like is not cut.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) linetype: Option<String>,
    /// True where it has the linetype from its layer: a role of the layer then counts for it all the same.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    #[schemars(default)]
    pub(crate) linetype_by_layer: bool,
    /// 1 to 255 of AutoCAD's colours, or `#rrggbb`; for `[colors]` of the settings.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) color: Option<EntityColor>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) visible: Option<Visible>,
    /// Its extended data (XDATA) of the application WEDM, such as `suppress gap: as the customer drew it`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default)]
    pub(crate) xdata: Vec<String>,
}

/// 1 to 255 of AutoCAD's colours, or "#rrggbb".
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EntityColor(Color);

impl Serialize for EntityColor {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            Color::Index(index) => to.serialize_u8(index),
            Color::True(rgb) => to.serialize_str(&format!("#{rgb:06x}")),
        }
    }
}

impl JsonSchema for EntityColor {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "EntityColor".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "anyOf": [
                { "type": "integer", "minimum": 1, "maximum": 255 },
                { "type": "string", "pattern": "^#[0-9A-Fa-f]{6}$" }
            ]
        })
    }
}

/// False for an entity that the CAD program does not show: it is not cut. `off` and `frozen` are those of its own layer, whose role brings
/// it back.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub(crate) enum Visible {
    Itself(bool),
    Layer(LayerState),
}

/// Why a layer is not shown.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum LayerState {
    Off,
    Frozen,
}

/// The linetype of the entity `name`. Error: one that is not resolved.
pub(super) fn linetype(name: &str, linetype: Option<String>) -> Result<Option<String>, String> {
    let relative = ["BYLAYER", "BYBLOCK"];
    let is_relative = |it: &str| relative.iter().any(|of| it.eq_ignore_ascii_case(of));
    match linetype {
        Some(linetype) if is_relative(&linetype) => {
            Err(say!(the_linetype_names_none, name, linetype))
        }
        linetype => Ok(linetype),
    }
}

/// The colour of the entity `name`. Error: there is no such colour.
pub(super) fn color(name: &str, color: Option<Value>) -> Result<Option<EntityColor>, String> {
    let read = |color: Value| {
        let named = match &color {
            Value::String(text) => Color::named(text),
            number => Color::named(&number.to_string()),
        };
        let named = named.map(EntityColor);
        named.ok_or_else(|| say!(there_is_no_such_color, name, color))
    };
    color.map(read).transpose()
}

/// Whether the entity `name` is shown. Error: a value of no meaning.
pub(super) fn visible(name: &str, visible: Option<Value>) -> Result<Option<Visible>, String> {
    let read = |visible: Value| match &visible {
        Value::Bool(is) => Ok(Visible::Itself(*is)),
        Value::String(state) if state == "off" => Ok(Visible::Layer(LayerState::Off)),
        Value::String(state) if state == "frozen" => Ok(Visible::Layer(LayerState::Frozen)),
        _ => Err(say!(there_is_no_such_visibility, name, visible)),
    };
    visible.map(read).transpose()
}

impl Look {
    /// The appearance of an entity on a layer.
    pub(super) fn into_core(self, layer: &Arc<str>) -> Appearance {
        let visibility = match self.visible {
            None | Some(Visible::Itself(true)) => None,
            Some(Visible::Itself(false)) => Some(Visibility::Invisible),
            Some(Visible::Layer(LayerState::Off)) => Some(Visibility::Off),
            Some(Visible::Layer(LayerState::Frozen)) => Some(Visibility::Frozen),
        };
        let marks: Vec<Arc<str>> = self.xdata.into_iter().map(Arc::from).collect();
        Appearance {
            unseen: visibility.map(|visibility| (visibility, layer.clone())),
            linetype: self
                .linetype
                .and_then(|name| Linetype::named(name.into(), self.linetype_by_layer)),
            color: self.color.map(|EntityColor(color)| color),
            marks: (!marks.is_empty()).then(|| marks.into()),
        }
    }

    /// The look of an entity on a layer. What another layer hides, as that of a block reference does, is invisible itself.
    pub(super) fn of(appearance: &Appearance, layer: &str) -> Look {
        let visible = appearance.unseen.as_ref().and_then(|(visibility, by)| {
            let is_own = **by == *layer;
            match visibility {
                Visibility::Shown | Visibility::Unplotted => None,
                Visibility::Off if is_own => Some(Visible::Layer(LayerState::Off)),
                Visibility::Frozen if is_own => Some(Visible::Layer(LayerState::Frozen)),
                Visibility::Off | Visibility::Frozen | Visibility::Invisible => {
                    Some(Visible::Itself(false))
                }
            }
        });
        let linetype = appearance.linetype.as_ref();
        let marks = appearance.marks.iter().flat_map(|marks| marks.iter());
        Look {
            linetype: linetype.map(|it| it.name.to_string()),
            linetype_by_layer: linetype.is_some_and(|it| it.of_layer),
            color: appearance.color.map(EntityColor),
            visible,
            xdata: marks.map(|mark| mark.to_string()).collect(),
        }
    }
}
