//! Params and results that are a few keys each.

use super::change::DrawingChange;
use super::drawing::Drawing;
use crate::settings::Settings;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Params of `wedm/didOpenDrawing`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OpenDrawing {
    pub drawing: Drawing,
}

/// Which drawing, and the version that it has after the change.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct DrawingVersion {
    pub uri: String,
    pub version: i64,
}

/// Params of `wedm/didChangeDrawing`: changes apply one after another, all or none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ChangeDrawing {
    pub drawing: DrawingVersion,
    pub changes: Vec<DrawingChange>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct DrawingName {
    pub uri: String,
}

/// Params of `wedm/didCloseDrawing`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct CloseDrawing {
    pub drawing: DrawingName,
}

/// Params of the server's request `wedm/resendDrawing`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct ResendDrawing {
    pub uri: String,
}

/// Result of `wedm/resendDrawing`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Resent {
    pub drawing: Drawing,
}

/// The only argument of the command `wedm.applyDrawingEdit`: changes of one version of a drawing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DrawingEdit {
    pub uri: String,
    pub version: i64,
    pub changes: Vec<DrawingChange>,
}

/// The only argument of the command `wedm.scale`: a program, and the factor by which all its lengths grow.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScaleProgram {
    pub uri: String,
    pub factor: f64,
}

/// Params of the server's request `wedm/applyDrawingEdit`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ApplyDrawingEdit {
    pub edit: DrawingEdit,
}

/// Result of `wedm/applyDrawingEdit`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub struct Applied {
    pub applied: bool,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub failure_reason: Option<String>,
}

/// Params of `wedm/inspect`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Inspect {
    pub uri: String,
    /// Only this entity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub handle: Option<String>,
}

/// Params of `wedm/toolpath` and `wedm/picture`; `wedm/contours` takes the `uri` alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OptionsOf {
    pub uri: String,
    /// Laid over every other level of settings for this request.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub options: Option<Settings>,
}

/// Result of `wedm/picture`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Picture {
    pub svg: String,
}

/// Params of `wedm/rulePage`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct RulePage {
    /// Name of the rule, which is the `code` of its findings.
    pub rule: String,
}

/// Result of `wedm/rulePage`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct RulePageText {
    /// Markdown without pictures. Links lead to pages of other rules only, as `NAME.md`.
    pub text: String,
}
