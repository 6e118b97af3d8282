//! `textDocument/prepareRename` and `rename`: the number of a block.

use super::{offset_of, program_in};
use crate::program::language::{number_at, renamed};
use crate::server::convert::{lsp_edits, lsp_range, range_of};
use crate::server::requests::{Target, refused, workspace_edit};
use crate::server::state::State;
use ls_types::{PrepareRenameResponse, RenameParams, TextDocumentPositionParams, WorkspaceEdit};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn prepare(
    state: &mut State,
    at: &TextDocumentPositionParams,
) -> Result<Option<PrepareRenameResponse>> {
    let encoding = state.encoding;
    let open = state.document(at.text_document.uri.as_str())?;
    let Some(program) = program_in(open).and_then(|document| document.program()) else {
        return Ok(None);
    };
    let found = number_at(program, offset_of(program.text(), at.position, encoding));
    Ok(found.map(
        |(range, number)| PrepareRenameResponse::RangeWithPlaceholder {
            range: lsp_range(range_of(program.text(), range, encoding)),
            placeholder: number.to_string(),
        },
    ))
}

pub(in crate::server) fn rename(
    state: &mut State,
    params: &RenameParams,
) -> Result<Option<WorkspaceEdit>> {
    let at = &params.text_document_position;
    let target = Target::of(state, &at.text_document.uri)?;
    let open = state.document(at.text_document.uri.as_str())?;
    let Some(program) = program_in(open).and_then(|document| document.program()) else {
        return Err(refused(format!(
            "{} is no program, expected one with block numbers",
            at.text_document.uri.as_str()
        )));
    };
    let edits = renamed(
        program,
        offset_of(program.text(), at.position, target.encoding),
        &params.new_name,
    )
    .map_err(refused)?;
    let edits = lsp_edits(program.text(), edits, target.encoding);
    Ok(Some(workspace_edit(&target, edits)))
}
