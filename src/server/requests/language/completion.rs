//! `textDocument/completion`: group codes, names of records, layers.

use super::{dxf_in, offset_of};
use crate::dxf::language::{Completion, CompletionKind, completions};
use crate::server::convert::{lsp_range, range_of};
use crate::server::state::State;
use ls_types::{CompletionItem, CompletionItemKind, CompletionParams, CompletionResponse, CompletionTextEdit, TextEdit};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn completion(state: &mut State, params: &CompletionParams) -> Result<Option<CompletionResponse>> {
    let at = &params.text_document_position;
    let encoding = state.encoding;
    let Some(dxf) = dxf_in(state.document(at.text_document.uri.as_str())?) else { return Ok(None) };
    let item = |(index, found): (usize, Completion)| CompletionItem {
        label: found.text.clone(),
        kind: Some(match found.kind {
            CompletionKind::Code => CompletionItemKind::PROPERTY,
            CompletionKind::Record => CompletionItemKind::KEYWORD,
            CompletionKind::Name => CompletionItemKind::VALUE,
        }),
        detail: Some(found.about.into()),
        // Codes are not to be sorted as words.
        sort_text: Some(format!("{index:04}")),
        text_edit: Some(CompletionTextEdit::Edit(TextEdit {
            range: lsp_range(range_of(dxf.text(), found.range, encoding)),
            new_text: found.text,
        })),
        ..CompletionItem::default()
    };
    let found = completions(dxf, offset_of(dxf.text(), at.position, encoding));
    Ok(Some(CompletionResponse::Array(found.into_iter().enumerate().map(item).collect())))
}
