//! All safe fixes of a document, until none is left.

use crate::document::{Document, Source};
use crate::drawing::{Drawing, DrawingEdit};
use crate::finding::Edit;
use crate::text::{Patch, TextEdit};
use std::sync::Arc;

/// Repairs in several rounds, since one may make room for another.
#[derive(Debug)]
pub(crate) enum Repairs {
    /// For a text, as one edit of its present state; and the document after the repairs.
    OfText {
        edits: Vec<TextEdit>,
        rounds: usize,
        repaired: Box<Document>,
    },
    /// For a drawing without text, each with the drawing that it applies to.
    OfDrawing(Vec<(Arc<Drawing>, DrawingEdit)>),
}

/// At most this many rounds. Each leaves less to repair than the one before, so that they end by themselves long before.
pub const ROUNDS: usize = 100;

/// Every safe fix, repeated until none is left that repairs anything.
pub(crate) fn fix_all(document: &Document) -> Option<Repairs> {
    if let Source::Cad(_) = document.source() {
        let mut present = document.clone();
        let mut rounds = Vec::new();
        while rounds.len() < ROUNDS
            && let Some(Edit::Drawing(edit)) = present.fix_all()
            && let Some(before) = present.drawing().cloned()
        {
            let left = present.left_to_repair();
            let made = present.edit_drawing(|drawing| drawing.apply(&edit));
            if !matches!(made, Some(Ok(()))) || present.left_to_repair() >= left {
                break;
            }
            rounds.push((before, edit));
        }
        return (!rounds.is_empty()).then_some(Repairs::OfDrawing(rounds));
    }
    let mut patch = Patch::of(document.text()?.len());
    let mut repaired = None;
    let mut rounds = 0;
    while rounds < ROUNDS
        && let present = repaired.as_ref().unwrap_or(document)
        && let Some((edits, after)) = present.round()
        && let Some(longer) = patch.then(&edits)
    {
        rounds += 1;
        patch = longer;
        repaired = Some(after);
    }
    Some(Repairs::OfText {
        edits: patch.edits(),
        rounds,
        repaired: Box::new(repaired?),
    })
}
