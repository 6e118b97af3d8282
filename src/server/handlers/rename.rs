//! `textDocument/prepareRename` and `rename`: the number of a block.

use crate::ide::program::{number_at, renamed};
use crate::server::context::RequestContext;
use crate::server::errors::refused;
use ls_types::{PrepareRenameResponse, RenameParams, TextDocumentPositionParams, WorkspaceEdit};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn prepare(
    context: &RequestContext,
    at: TextDocumentPositionParams,
) -> Result<Option<PrepareRenameResponse>> {
    let Some(program) = context.program() else {
        return Ok(None);
    };
    let text = program.text();
    let found = number_at(program, context.offset(text, at.position));
    Ok(found.map(
        |(range, number)| PrepareRenameResponse::RangeWithPlaceholder {
            range: context.range(text, range),
            placeholder: number.to_string(),
        },
    ))
}

pub(in crate::server) fn rename(
    context: &RequestContext,
    params: RenameParams,
) -> Result<Option<WorkspaceEdit>> {
    let Some(program) = context.program() else {
        return Err(refused(say!(is_no_program_with_block_numbers, context.uri)));
    };
    let text = program.text();
    let offset = context.offset(text, params.text_document_position.position);
    let edits = renamed(program, offset, &params.new_name).map_err(refused)?;
    context.workspace_edit(text, edits).map(Some)
}
