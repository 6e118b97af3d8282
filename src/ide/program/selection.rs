//! The steps of a growing selection: the word, the block, its line, the contour, everything between two pauses,
//! everything.

use super::words_of;
use crate::ide::widen;
use crate::program::Document;
use crate::program::steps::CutAt;
use std::ops::Range;

/// Ranges of bytes around a byte, each within the next.
pub(crate) fn selections(document: &Document, offset: usize) -> Vec<Range<usize>> {
    let text = document.text();
    let line = text.line_of(offset);
    let mut found: Vec<Range<usize>> = Vec::new();
    let mut wider = |range| widen(&mut found, offset, range);
    if let Some(part) = words_of(document, line)
        .into_iter()
        .find(|part| part.range.start <= offset && offset <= part.range.end)
    {
        wider(part.range);
    }
    let own = document.steps_in(text.line_range(line));
    let touching = own
        .iter()
        .find(|step| step.range.start <= offset && offset <= step.range.end);
    if let Some(step) = touching {
        wider(step.range.clone());
    }
    wider(text.line_range(line));
    let step = touching.or_else(|| own.iter().find(|step| step.line == line));
    if let Some(CutAt {
        steps: held,
        cut,
        nth,
    }) = step
        .filter(|step| step.moves())
        .and_then(|step| document.cut_at(step.range.start))
    {
        let lines = |steps: Range<usize>| {
            let (first, last) = (held.get(steps.start)?, held.get(steps.end.checked_sub(1)?)?);
            Some(text.line_start(first.line)..text.line_range(last.line).end)
        };
        if cut.contour_steps().contains(&nth) {
            lines(cut.contour_steps()).into_iter().for_each(&mut wider);
        }
        lines(cut.steps).into_iter().for_each(&mut wider);
    }
    wider(0..text.len());
    if found.is_empty() {
        found.push(0..text.len());
    }
    found
}
