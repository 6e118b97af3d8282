//! `wedm/locate`: from a position in the text to the segment that is written there, and back.

use super::diagnostic::{Position, Range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Params of `wedm/locate`: either `position`, or `handle` with or without `segment`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Locate {
    pub(crate) uri: String,
    /// A place in the text; the answer is what is written there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) position: Option<Position>,
    /// An entity; the answer is where it is written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) handle: Option<String>,
    /// One of its segments.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) segment: Option<usize>,
}

/// Result of `wedm/locate`; null where nothing with geometry is written.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Located {
    pub(crate) handle: String,
    /// Missing where the place is of the entity, and of none of its segments: the head of a polyline.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) segment: Option<usize>,
    /// The number that a finding on the segment stands at, or the entity's name.
    pub(crate) range: Range,
}
