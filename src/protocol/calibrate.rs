//! `wedm/calibrate`: the kerf of each pass, from what was measured on a cut test piece.

use crate::calibration::Kerf;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Params of `wedm/calibrate`; mm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Calibrate {
    pub(crate) measurements: Vec<Measured>,
    /// With which the piece was cut, of each pass.
    pub(crate) corrections: Vec<f64>,
    /// Without it no gap follows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) wire_diameter: Option<f64>,
    /// Of a single measurement, 0.002 unless stated: 95 of 100 are nearer to the truth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) uncertainty: Option<f64>,
}

/// A size that was measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Measured {
    /// Measurements of the same name are of the same feature; without one each is of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) feature: Option<String>,
    pub(crate) kind: FeatureKind,
    /// After which it was measured, from 1; without it the last one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) pass: Option<usize>,
    pub(crate) nominal: f64,
    pub(crate) measured: f64,
}

/// Material between the faces that were measured, as of a punch, or room, as in an opening.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) enum FeatureKind {
    Outer,
    Inner,
}

/// Result of `wedm/calibrate`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Calibrated {
    /// The passes that were measured.
    pub(crate) passes: Vec<CalibratedPass>,
}

/// Half of the kerf of a pass; mm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct CalibratedPass {
    pub(crate) pass: usize,
    /// With which it was cut.
    pub(crate) correction: f64,
    pub(crate) half_kerf: f64,
    /// At 95 % confidence.
    pub(crate) uncertainty: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) gap: Option<f64>,
    /// The count of measured features.
    pub(crate) features: usize,
    /// By the outer features alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) outer: Option<f64>,
    /// By the inner features alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) inner: Option<f64>,
}

impl From<&Kerf> for CalibratedPass {
    fn from(kerf: &Kerf) -> CalibratedPass {
        let [outer, inner] = kerf.by_kind;
        CalibratedPass {
            pass: kerf.pass,
            correction: kerf.correction,
            half_kerf: kerf.half,
            uncertainty: kerf.uncertainty,
            gap: kerf.gap,
            features: kerf.features,
            outer,
            inner,
        }
    }
}
