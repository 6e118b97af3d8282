//! `textDocument/selectionRange`: value, tag, vertex, entity, section; word, block, contour of a program.

use crate::dxf;
use crate::program;
use crate::server::context::RequestContext;
use crate::text::SourceText;
use ls_types::{Position, Range, SelectionRange, SelectionRangeParams};
use tower_lsp::jsonrpc::{Error, Result};

/// Places of one question.
const PLACES: usize = 1000;

pub(in crate::server) fn selection_range(
    context: &RequestContext,
    params: SelectionRangeParams,
) -> Result<Option<Vec<SelectionRange>>> {
    let SelectionRangeParams { positions, .. } = params;
    if positions.len() > PLACES {
        return Err(Error::invalid_params(say!(
            positions_are_asked_for_expected,
            positions.len(),
            PLACES
        )));
    }
    type Ranges = Vec<std::ops::Range<usize>>;
    let around = |text: &SourceText, selections: &dyn Fn(usize) -> Ranges| {
        let around = |position: &Position| {
            let wrap = |parent: Option<SelectionRange>, range| {
                Some(SelectionRange {
                    range: context.range(text, range),
                    parent: parent.map(Box::new),
                })
            };
            let ranges = selections(context.offset(text, *position)).into_iter();
            ranges
                .rev()
                .fold(None, wrap)
                .unwrap_or_else(|| SelectionRange {
                    range: Range::new(*position, *position),
                    parent: None,
                })
        };
        positions.iter().map(around).collect()
    };
    Ok(match (context.program(), context.dxf()) {
        (Some(program), _) => Some(around(program.text(), &|offset| {
            program::language::selections(program, offset)
        })),
        (_, Some(dxf)) => Some(around(dxf.text(), &|offset| {
            dxf::language::selections(dxf, offset)
        })),
        _ => None,
    })
}
