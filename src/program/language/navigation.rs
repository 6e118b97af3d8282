//! From one end of something to the other: pause to pause, way in to way out, first block of a contour to its last.

use super::passages::passages;
use crate::program::trace::{Kind, Step};
use crate::program::{Document, iso};
use std::ops::Range;

/// The place that belongs to the one at a byte.
///
/// Of a pause, the next pause or the end; of the end word, where the program begins; of a way in the way out and back; of any other
/// block the last one of its contour, and of that one the first.
pub fn match_of(document: &Document, offset: usize) -> Option<Range<usize>> {
    pair(document, offset).map(|(_, other)| other)
}

/// The place at a byte and the one that belongs to it.
pub fn highlights(document: &Document, offset: usize) -> Vec<Range<usize>> {
    pair(document, offset).map_or_else(Vec::new, |(own, other)| if own == other { vec![own] } else { vec![own, other] })
}

/// All pauses and ends.
pub fn pauses(document: &Document) -> Vec<Range<usize>> {
    let trace = document.trace();
    trace.steps.into_iter().filter(|step| !step.moves()).map(|step| step.range).collect()
}

fn pair(document: &Document, offset: usize) -> Option<(Range<usize>, Range<usize>)> {
    if let Document::Iso(program) = document
        && let Some(pair) = iso::language::partner(program, offset)
    {
        return Some(pair);
    }
    let trace = document.trace();
    let steps = &trace.steps;
    let holds = |step: &Step| step.range.start <= offset && offset <= step.range.end;
    let index = steps.iter().position(|step| holds(step) && offset < step.range.end).or_else(|| steps.iter().position(holds))?;
    let own = &steps[index];
    let other = match own.kind {
        Kind::Pause => steps[index + 1..].iter().find(|step| !step.moves())?,
        Kind::End => steps.iter().find(|step| step.moves())?,
        Kind::Line | Kind::Arc | Kind::Rapid => {
            let passage = passages(&trace).into_iter().find(|passage| passage.steps.contains(&index))?;
            let contour = passage.contour_steps();
            let lead_out = contour.end..passage.steps.end;
            let target = if index < contour.start {
                // The n-th block of the way in has the n-th from the end of the way out.
                let back = index - passage.steps.start;
                if lead_out.is_empty() { contour.start } else { passage.steps.end.checked_sub(1 + back)?.max(lead_out.start) }
            } else if lead_out.contains(&index) {
                (passage.steps.start + (passage.steps.end - 1 - index)).min(contour.start.saturating_sub(1).max(passage.steps.start))
            } else if index + 1 == contour.end {
                contour.start
            } else {
                contour.end.checked_sub(1)?
            };
            steps.get(target)?
        }
    };
    Some((own.range.clone(), other.range.clone()))
}
