//! What an editor selects step by step: the word, the block, its line, the contour, everything between two pauses, everything.

use super::passages::passages;
use super::words::words_of;
use crate::program::Document;
use crate::program::trace::Trace;
use std::ops::Range;

/// Ranges of bytes around a byte, each within the next. `trace` is the document's own.
pub fn selections(document: &Document, trace: &Trace, offset: usize) -> Vec<Range<usize>> {
    let text = document.text();
    let line = text.line_of(offset);
    let mut found: Vec<Range<usize>> = Vec::new();
    let mut wider = |range: Range<usize>| {
        let grows = match found.last() {
            None => range.start <= offset && offset <= range.end,
            Some(last) => range.start <= last.start && last.end <= range.end && range != *last,
        };
        if grows {
            found.push(range);
        }
    };
    if let Some(part) = words_of(document, line).into_iter().find(|part| part.range.start <= offset && offset <= part.range.end) {
        wider(part.range);
    }
    let index = trace.steps.iter().position(|step| step.range.start <= offset && offset <= step.range.end);
    if let Some(step) = index.and_then(|index| trace.steps.get(index)) {
        wider(step.range.clone());
    }
    wider(text.line_range(line));
    let of_line = || trace.steps.iter().position(|step| step.line == line);
    if let Some(index) = index.or_else(of_line)
        && let Some(passage) = passages(trace).into_iter().find(|passage| passage.steps.contains(&index))
    {
        let lines = |steps: Range<usize>| {
            let steps = trace.steps.get(steps)?;
            let (first, last) = (steps.first()?, steps.last()?);
            Some(text.line_start(first.line)..text.line_range(last.line).end)
        };
        if passage.contour_steps().contains(&index) {
            lines(passage.contour_steps()).into_iter().for_each(&mut wider);
        }
        lines(passage.steps).into_iter().for_each(&mut wider);
    }
    wider(0..text.len());
    if found.is_empty() {
        found.push(0..text.len());
    }
    found
}
