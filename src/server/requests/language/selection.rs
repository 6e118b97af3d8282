//! `textDocument/selectionRange`: value, tag, vertex, entity, section.

use super::{dxf_in, offset_of};
use crate::dxf::language::selections;
use crate::server::convert::{lsp_range, range_of};
use crate::server::state::State;
use ls_types::{SelectionRange, SelectionRangeParams};
use tower_lsp::jsonrpc::{Error, Result};

/// Places of one question.
const PLACES: usize = 1000;

pub(in crate::server) fn selection_range(state: &mut State, params: &SelectionRangeParams) -> Result<Option<Vec<SelectionRange>>> {
    let encoding = state.encoding;
    let Some(dxf) = dxf_in(state.document(params.text_document.uri.as_str())?) else { return Ok(None) };
    if params.positions.len() > PLACES {
        return Err(Error::invalid_params(format!("{} positions are asked for, expected at most {PLACES}", params.positions.len())));
    }
    let around = |position: &ls_types::Position| {
        let ranges = selections(dxf, offset_of(dxf.text(), *position, encoding));
        let wrap = |parent: Option<SelectionRange>, range| {
            Some(SelectionRange { range: lsp_range(range_of(dxf.text(), range, encoding)), parent: parent.map(Box::new) })
        };
        let nothing = || SelectionRange { range: ls_types::Range { start: *position, end: *position }, parent: None };
        ranges.into_iter().rev().fold(None, wrap).unwrap_or_else(nothing)
    };
    Ok(Some(params.positions.iter().map(around).collect()))
}
