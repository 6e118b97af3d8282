//! After each block, its end and its radius.

use super::words::WordKind;
use super::words_of;
use crate::geometry::Segment;
use crate::ide::amounts::{degrees, mm};
use crate::ide::{HINT_LINES, Hint};
use crate::program::Document;
use crate::program::path::Kind;
use std::ops::Range;

/// Hints for the blocks that begin in a range of bytes, in the order of the text.
///
/// An end point that the text states is not repeated, nor that of an ISO block under G90, whose
/// words state it.
pub(crate) fn hints(document: &Document, range: Range<usize>) -> Vec<Hint> {
    let text = document.text();
    let end = text
        .line_start(text.line_of(range.start) + HINT_LINES)
        .min(range.end);
    let looked_at = range.start..end.max(range.start);
    let mut found = Vec::new();
    for step in document.steps_in(looked_at) {
        if !step.moves() || step.range.start < range.start || step.range.start > end {
            continue;
        }
        let Some(ideal) = step.ideal else { continue };
        let mut parts = Vec::new();
        if let Segment::Arc(arc) = ideal {
            parts.push(format!("R {}, {}", mm(arc.radius), degrees(arc.sweep)));
        }
        let is_stated = || {
            words_of(document, step.line)
                .iter()
                .any(|part| part.kind == WordKind::Stated)
        };
        if step.is_relative && !is_stated() && step.kind != Kind::Pause {
            parts.push(format!("→ {}, {}", mm(step.end.x), mm(step.end.y)));
        }
        if !parts.is_empty() {
            found.push(Hint {
                offset: step.range.end,
                text: parts.join(" "),
            });
        }
    }
    found
}
