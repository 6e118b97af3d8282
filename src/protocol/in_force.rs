//! `wedm/settings`: the settings that hold for a document, and which level the correction comes from.

use crate::settings::{ContourSettings, Origin, SideSetting};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The level that has the last word on the correction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum CorrectionSource {
    /// Nobody has set one.
    Default,
    /// `initializationOptions`, `workspace/didChangeConfiguration` or `workspace/configuration`.
    Client,
    /// `wedm.toml`.
    File,
}

/// Result of `wedm/settings`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct SettingsInForce {
    /// mm; what radii are compared with: the largest of `corrections`.
    pub(crate) correction: f64,
    /// mm; that of each pass.
    pub(crate) corrections: Vec<f64>,
    pub(crate) correction_from: CorrectionSource,
    pub(crate) side: SideSetting,
    /// The level that the side comes from.
    pub(crate) side_from: Origin,
    /// Millimetres in one unit of the drawing, where it is an open one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) units_to_mm: Option<f64>,
    /// What says that unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) units_from: Option<Origin>,
    /// Correction, side and the unit of an open drawing, each with where it comes from: a sentence to be shown.
    pub(crate) said: String,
    /// URI of the `wedm.toml` that holds for the document, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) file: Option<String>,
    /// Settings of single contours of this drawing, by handle or by a point.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(crate) contours: BTreeMap<String, ContourSettings>,
}
