//! `textDocument/completion`: group codes, names of records, layers; the fields of a block.

use crate::dxf::language::{Completion, CompletionKind, completions};
use crate::program;
use crate::server::context::RequestContext;
use ls_types::{
    CompletionItem, CompletionItemKind, CompletionParams, CompletionResponse, CompletionTextEdit,
    InsertTextFormat, TextEdit,
};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn completion(
    context: &RequestContext,
    params: CompletionParams,
) -> Result<Option<CompletionResponse>> {
    let position = params.text_document_position.position;
    let snippets = context.abilities.snippets;
    if let Some(program) = context.program() {
        let text = program.text();
        let item = |(index, found): (usize, program::language::Completion)| CompletionItem {
            label: found.label,
            kind: Some(if found.is_snippet {
                CompletionItemKind::SNIPPET
            } else {
                CompletionItemKind::VALUE
            }),
            detail: Some(found.about),
            sort_text: Some(format!("{index:04}")),
            filter_text: Some(
                String::from_utf8_lossy(text.bytes().get(found.range.clone()).unwrap_or_default())
                    .into_owned(),
            )
            .filter(|typed| !typed.is_empty()),
            insert_text_format: found.is_snippet.then_some(InsertTextFormat::SNIPPET),
            text_edit: Some(CompletionTextEdit::Edit(TextEdit {
                range: context.range(text, found.range),
                new_text: found.text,
            })),
            ..CompletionItem::default()
        };
        let found = program::language::completions(program, context.offset(text, position));
        let found = found
            .into_iter()
            .filter(|found| snippets || !found.is_snippet);
        return Ok(Some(CompletionResponse::Array(
            found.enumerate().map(item).collect(),
        )));
    }
    let Some(dxf) = context.dxf() else {
        return Ok(None);
    };
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
            range: context.range(dxf.text(), found.range),
            new_text: found.text,
        })),
        ..CompletionItem::default()
    };
    let found = completions(dxf, context.offset(dxf.text(), position));
    Ok(Some(CompletionResponse::Array(
        found.into_iter().enumerate().map(item).collect(),
    )))
}
