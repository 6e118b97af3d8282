//! Params and results that are a few keys each.

use super::change::DrawingChange;
use super::drawing::Drawing;
use super::segment::SegmentShape;
use crate::picture::Piece;
use crate::settings::Settings;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Params of `wedm/didOpenDrawing`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct OpenDrawing {
    pub(crate) drawing: Drawing,
}

/// Which drawing, and the version that it has after the change.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct DrawingVersion {
    pub(crate) uri: String,
    pub(crate) version: i64,
}

/// Params of `wedm/didChangeDrawing`: changes apply one after another, all or none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct ChangeDrawing {
    pub(crate) drawing: DrawingVersion,
    pub(crate) changes: Vec<DrawingChange>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct DrawingName {
    pub(crate) uri: String,
}

/// Params of `wedm/didCloseDrawing`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct CloseDrawing {
    pub(crate) drawing: DrawingName,
}

/// Params of the server's request `wedm/resendDrawing`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct ResendDrawing {
    pub(crate) uri: String,
}

/// Result of `wedm/resendDrawing`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Resent {
    pub(crate) drawing: Drawing,
}

/// The only argument of the command `wedm.applyDrawingEdit`: changes of one version of a drawing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct DrawingEdit {
    pub(crate) uri: String,
    pub(crate) version: i64,
    pub changes: Vec<DrawingChange>,
}

/// The `data` of an action of the kind `source.fixAll.wedm`: what it would do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct FixAllData {
    /// The document that it is made for, and its version.
    pub(crate) uri: String,
    pub(crate) version: i64,
    /// Number of findings that go.
    pub(crate) repaired: usize,
    /// Number of errors and warnings that are left.
    pub(crate) left: usize,
    /// Both as a sentence to be shown: `3 findings repaired, 2 left`.
    pub(crate) said: String,
}

/// The only argument of the command `wedm.scale`: a program, and the factor by which all its lengths grow.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ScaleProgram {
    pub(crate) uri: String,
    pub(crate) factor: f64,
}

/// Params of the server's request `wedm/applyDrawingEdit`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct ApplyDrawingEdit {
    pub(crate) edit: DrawingEdit,
}

/// Result of `wedm/applyDrawingEdit`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Applied {
    pub(crate) applied: bool,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) failure_reason: Option<String>,
}

/// Params of `wedm/inspect`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Inspect {
    pub(crate) uri: String,
    /// Only this entity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) handle: Option<String>,
}

/// Params of `wedm/toolpath` and `wedm/fit`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct OptionsOf {
    pub(crate) uri: String,
    /// Laid over every other level of settings for this request.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) options: Option<Settings>,
}

/// Params of `wedm/picture`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct PictureOf {
    pub(crate) uri: String,
    /// Laid over every other level of settings for this request.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) options: Option<Settings>,
    /// A picture of more than 2,000 elements is wanted in pieces.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(crate) pieces: bool,
}

/// Result of `wedm/picture`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Picture {
    /// With `pieces` it has the heading and the legend only.
    pub(crate) svg: String,
    /// The drawing, from the bottom up, where it is wanted in pieces and has many.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) pieces: Option<Vec<Piece>>,
}

/// Params of `wedm/contours`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct ContoursOf {
    pub(crate) uri: String,
    /// `false`: instead of its segments each contour has the handles of its entities.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) segments: Option<bool>,
}

/// What a picture can be written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum PictureForm {
    Svg,
    Png,
    Pdf,
}

/// Params of `wedm/export`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Export {
    pub(crate) uri: String,
    pub(crate) format: PictureForm,
    /// Laid over every other level of settings for this request.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) options: Option<Settings>,
}

/// What a drill list can be written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum HoleForm {
    Csv,
    Dxf,
}

/// Params of `wedm/holes`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Holes {
    pub(crate) uri: String,
    pub(crate) format: HoleForm,
    /// Laid over every other level of settings for this request.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) options: Option<Settings>,
}

/// Result of `wedm/export` and `wedm/holes`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Exported {
    /// The file, in base64.
    pub(crate) data: String,
}

impl Exported {
    pub(crate) fn new(file: &[u8]) -> Exported {
        let data = STANDARD.encode(file);
        Exported { data }
    }
}

/// Params of `wedm/repairs`: the rule of a finding in a drawing, and its place as in `data`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct RepairsOf {
    pub(crate) uri: String,
    pub(crate) rule: String,
    pub(crate) handle: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) segment: Option<usize>,
}

/// Result of `wedm/repairs`: the preferred one first; none where the finding is no longer there.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Repairs {
    pub(crate) repairs: Vec<Repair>,
}

/// What a repair would bring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Repair {
    /// That of its code action.
    pub(crate) title: String,
    /// The segments that were not there before, in drawing units.
    pub(crate) segments: Vec<SegmentShape>,
}

/// Params of `wedm/rulePage`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct RulePage {
    /// Name of the rule, which is the `code` of its findings.
    pub(crate) rule: String,
}

/// Result of `wedm/rulePage`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct RulePageText {
    /// Markdown without pictures. Links lead to pages of other rules only, as `NAME.md`.
    pub(crate) text: String,
}
