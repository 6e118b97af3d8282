//! All safe fixes of a document, until none is left.

use crate::document::{Document, Source};
use crate::drawing::{Drawing, DrawingEdit};
use crate::finding::Edit;
use crate::text::{Patch, TextEdit, edited};
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

/// At most this many rounds: more change nothing.
pub const ROUNDS: usize = 12;

/// Every safe fix, repeated until none is left.
pub(crate) fn fix_all(document: &Document) -> Option<Repairs> {
    if let Source::Cad(_) = document.source() {
        let mut present = document.clone();
        let mut rounds = Vec::new();
        while rounds.len() < ROUNDS
            && let Some(Edit::Drawing(edit)) = present.fix_all()
            && let Some(before) = present.drawing().cloned()
            && let Some(Ok(())) = present.edit_drawing(|drawing| drawing.apply(&edit))
        {
            rounds.push((before, edit));
        }
        return (!rounds.is_empty()).then_some(Repairs::OfDrawing(rounds));
    }
    let mut patch = Patch::of(document.text()?.len());
    let mut repaired = None;
    let mut rounds = 0;
    while rounds < ROUNDS
        && let present = repaired.as_ref().unwrap_or(document)
        && let Some(edits) = present.fix_all_in_text()
        && let Some(longer) = patch.then(&edits)
        && let Some(bytes) = present.text().and_then(|text| edited(text.bytes(), &edits))
    {
        rounds += 1;
        patch = longer;
        repaired = Some(present.reread(bytes));
    }
    Some(Repairs::OfText {
        edits: patch.edits(),
        rounds,
        repaired: Box::new(repaired?),
    })
}
