//! `textDocument/selectionRange`: value, tag, vertex, entity, section; word, block, contour of a program.

use crate::ide;
use crate::server::context::RequestContext;
use ls_types::{Position, Range, SelectionRange, SelectionRangeParams};
use tower_lsp::jsonrpc::{Error, Result};

/// The most places in one question.
const PLACES: usize = 1000;

pub(in crate::server) fn selection_range(
    context: &RequestContext,
    params: SelectionRangeParams,
) -> Result<Option<Vec<SelectionRange>>> {
    let SelectionRangeParams { positions, .. } = params;
    if positions.len() > PLACES {
        return Err(Error::invalid_params(say!(
            too_many_positions_are_asked_for,
            positions.len(),
            PLACES
        )));
    }
    let Some((document, text)) = context.document_and_text() else {
        return Ok(None);
    };
    let around = |position: Position| {
        let wrap = |parent: Option<SelectionRange>, range| {
            Some(SelectionRange {
                range: context.range(text, range),
                parent: parent.map(Box::new),
            })
        };
        let ranges = ide::selections(document, context.offset(text, position)).into_iter();
        let nothing = || SelectionRange {
            range: Range::new(position, position),
            parent: None,
        };
        ranges.rev().fold(None, wrap).unwrap_or_else(nothing)
    };
    Ok(Some(positions.into_iter().map(around).collect()))
}
