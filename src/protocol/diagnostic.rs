//! A diagnostic as LSP has it, where it stands inside a `wedm/` message.

use super::data::FindingData;
use crate::finding::Severity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Zero-based line and character, counted as the client and the server agreed on in the handshake.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
pub(crate) struct Position {
    pub(crate) line: u32,
    pub(crate) character: u32,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Range {
    pub(crate) start: Position,
    pub(crate) end: Position,
}

impl Range {
    /// The place of a drawing's finding: the line is the segment's index within its entity.
    pub(crate) fn of_segment(segment: usize) -> Range {
        let position = Position {
            line: segment.try_into().unwrap_or(u32::MAX),
            character: 0,
        };
        Range {
            start: position,
            end: position,
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct CodeDescription {
    /// The rule's page of documentation.
    pub(crate) href: String,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Location {
    pub(crate) uri: String,
    pub(crate) range: Range,
}

/// Another place that a finding concerns, and what is there.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct RelatedInformation {
    pub(crate) location: Location,
    pub(crate) message: String,
}

/// One finding. In a drawing's diagnostics the line is the segment's index within its entity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Diagnostic {
    pub(crate) range: Range,
    /// 1 error, 2 warning, 3 information, 4 hint.
    pub(crate) severity: u8,
    /// Name of the rule.
    pub(crate) code: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) code_description: Option<CodeDescription>,
    /// Always `wedm`.
    pub(crate) source: String,
    pub(crate) message: String,
    /// Sent to clients that can show it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) related_information: Option<Vec<RelatedInformation>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) data: Option<FindingData>,
}

/// The number that LSP has for a severity.
pub(crate) fn severity_number(severity: Severity) -> u8 {
    match severity {
        Severity::Error => 1,
        Severity::Warning => 2,
        Severity::Information => 3,
        Severity::Hint => 4,
    }
}
