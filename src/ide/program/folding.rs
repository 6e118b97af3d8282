//! Folding: contours, and comments of several lines.

use super::words::WordKind;
use super::words_of;
use crate::ide::{Fold, FoldKind};
use crate::program::Document;
use crate::program::path::cuts;

/// Contours first, then comments; at most `limit` of them, in the order of the text.
pub(crate) fn folds(document: &Document, limit: usize) -> Vec<Fold> {
    let trace = document.trace();
    let mut found: Vec<Fold> = Vec::new();
    for cut in cuts(&trace) {
        let steps = trace.steps.get(cut.steps).unwrap_or_default();
        let lines = || steps.iter().map(|step| step.line);
        if let (Some(first), Some(last)) = (lines().min(), lines().max())
            && last > first
        {
            found.push(Fold {
                first,
                last,
                kind: FoldKind::Contour,
            });
        }
    }
    found.truncate(limit);
    found.extend(comments(document).into_iter().take(limit - found.len()));
    found.sort_by_key(|fold| fold.first);
    found.dedup();
    found
}

/// Runs of at least two lines that hold only comments.
fn comments(document: &Document) -> Vec<Fold> {
    let text = document.text();
    let bytes = text.bytes();
    let mut found = Vec::new();
    let mut run: Option<(usize, usize)> = None;
    for line in 0..text.line_count() {
        let range = text.line_range(line);
        let begins = bytes
            .get(range)
            .and_then(|line| line.iter().find(|byte| !matches!(byte, b' ' | b'\t')));
        // Nearly every line begins with a letter of its language: only the others are cut into pieces.
        let may_be_comment = begins.is_some_and(|byte| !byte.is_ascii_alphanumeric());
        let is_comment = may_be_comment && {
            let parts = words_of(document, line);
            !parts.is_empty()
                && parts
                    .iter()
                    .all(|part| matches!(part.kind, WordKind::Comment | WordKind::Stated))
        };
        match (&mut run, is_comment) {
            (Some((_, last)), true) => *last = line,
            (None, true) => run = Some((line, line)),
            (_, false) => found.extend(run.take()),
        }
    }
    found.extend(run);
    found
        .into_iter()
        .filter(|(first, last)| last > first)
        .map(|(first, last)| Fold {
            first,
            last,
            kind: FoldKind::Comment,
        })
        .collect()
}
