//! Jumps between counterparts: pause to pause, way in to way out, first block of a contour to its last.

use super::iso;
use crate::program::Document;
use crate::program::path::Kind;
use crate::program::steps::CutAt;
use std::ops::Range;

/// The counterpart of the place at a byte.
///
/// For a pause, the next pause or the end; for the end word, the program's beginning; for a way in the way out and
/// back; for any other block the last one of its contour, and for that one the first.
pub(crate) fn match_of(document: &Document, offset: usize) -> Option<Range<usize>> {
    pair(document, offset).map(|(_, other)| other)
}

/// The place at a byte and its counterpart.
pub(crate) fn highlights(document: &Document, offset: usize) -> Vec<Range<usize>> {
    pair(document, offset).map_or_else(Vec::new, |(own, other)| {
        if own == other {
            vec![own]
        } else {
            vec![own, other]
        }
    })
}

/// All pauses and ends.
pub(crate) fn pauses(document: &Document) -> Vec<Range<usize>> {
    let trace = document.trace();
    trace
        .steps
        .into_iter()
        .filter(|step| !step.moves())
        .map(|step| step.range)
        .collect()
}

fn pair(document: &Document, offset: usize) -> Option<(Range<usize>, Range<usize>)> {
    if let Document::Iso(program) = document
        && let Some(pair) = iso::partner(program, offset)
    {
        return Some(pair);
    }
    let touching = document.steps_in(offset..offset);
    let own = touching
        .iter()
        .find(|step| offset < step.range.end)
        .or(touching.first())?;
    let other = match own.kind {
        Kind::Pause => document.stop_behind(own.range.start)?,
        Kind::End => document.first_move()?,
        Kind::Line | Kind::Arc | Kind::Rapid => {
            let CutAt {
                steps,
                cut,
                nth: index,
            } = document.cut_at(own.range.start)?;
            let contour = cut.contour_steps();
            let lead_out = contour.end..cut.steps.end;
            let target = if index < contour.start {
                // The n-th block of the way in corresponds to the n-th from the end of the way out.
                if lead_out.is_empty() {
                    contour.start
                } else {
                    cut.steps.end.checked_sub(1 + index)?.max(lead_out.start)
                }
            } else if lead_out.contains(&index) {
                (cut.steps.end - 1 - index).min(contour.start.saturating_sub(1))
            } else if index + 1 == contour.end {
                contour.start
            } else {
                contour.end.checked_sub(1)?
            };
            steps.get(target)?.range.clone()
        }
    };
    Some((own.range.clone(), other))
}
