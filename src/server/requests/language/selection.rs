//! `textDocument/selectionRange`: value, tag, vertex, entity, section; word, block, contour of a program.

use super::{dxf_in, offset_of, program_in};
use crate::dxf::language::selections;
use crate::program;
use crate::server::convert::{lsp_range, range_of};
use crate::server::state::State;
use crate::text::SourceText;
use ls_types::{Position, SelectionRange, SelectionRangeParams};
use std::ops::Range;
use tower_lsp::jsonrpc::{Error, Result};

/// Places of one question.
const PLACES: usize = 1000;

pub(in crate::server) fn selection_range(
    state: &mut State,
    params: &SelectionRangeParams,
) -> Result<Option<Vec<SelectionRange>>> {
    let encoding = state.encoding;
    if params.positions.len() > PLACES {
        return Err(Error::invalid_params(format!(
            "{} positions are asked for, expected at most {PLACES}",
            params.positions.len()
        )));
    }
    let open = state.document(params.text_document.uri.as_str())?;
    let around = |text: &SourceText, position: &Position, ranges: Vec<Range<usize>>| {
        let wrap = |parent: Option<SelectionRange>, range| {
            Some(SelectionRange {
                range: lsp_range(range_of(text, range, encoding)),
                parent: parent.map(Box::new),
            })
        };
        let nothing = || SelectionRange {
            range: ls_types::Range {
                start: *position,
                end: *position,
            },
            parent: None,
        };
        ranges
            .into_iter()
            .rev()
            .fold(None, wrap)
            .unwrap_or_else(nothing)
    };
    if let Some(program) = program_in(open).and_then(|document| document.program()) {
        let text = program.text();
        let of = |position: &Position| {
            let offset = offset_of(text, *position, encoding);
            around(
                text,
                position,
                program::language::selections(program, offset),
            )
        };
        return Ok(Some(params.positions.iter().map(of).collect()));
    }
    let Some(dxf) = dxf_in(open) else {
        return Ok(None);
    };
    let of = |position: &Position| {
        around(
            dxf.text(),
            position,
            selections(dxf, offset_of(dxf.text(), *position, encoding)),
        )
    };
    Ok(Some(params.positions.iter().map(of).collect()))
}
