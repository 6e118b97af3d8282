//! A diagnostic as LSP has it, where it stands inside a `wedm/` message.

use super::data::FindingData;
use crate::finding::Severity;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Zero-based line and character, counted as the client and the server agreed on in the handshake.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
pub struct Position {
    pub line: u32,
    pub character: u32,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Range {
    pub start: Position,
    pub end: Position,
}

impl Range {
    /// The place of a drawing's finding: the line is the segment's index within its entity.
    pub fn of_segment(segment: usize) -> Range {
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
pub struct CodeDescription {
    /// The rule's page of documentation.
    pub href: String,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Location {
    pub uri: String,
    pub range: Range,
}

/// Another place that a finding concerns, and what is there.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct RelatedInformation {
    pub location: Location,
    pub message: String,
}

/// One finding. In a drawing's diagnostics the line is the segment's index within its entity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "camelCase")]
pub struct Diagnostic {
    pub range: Range,
    /// 1 error, 2 warning, 3 information, 4 hint.
    pub severity: u8,
    /// Name of the rule.
    pub code: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub code_description: Option<CodeDescription>,
    /// Always `wedm`.
    pub source: String,
    pub message: String,
    /// Sent to clients that can show it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub related_information: Option<Vec<RelatedInformation>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub data: Option<FindingData>,
}

/// The number that LSP has for a severity.
pub fn severity_number(severity: Severity) -> u8 {
    match severity {
        Severity::Error => 1,
        Severity::Warning => 2,
        Severity::Information => 3,
        Severity::Hint => 4,
    }
}
