//! `textDocument/completion`: group codes, names of records, layers; the fields of a block.

use crate::ide::{Completion, CompletionKind, completions};
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
    let Some((document, text)) = context.document_and_text() else {
        return Ok(None);
    };
    let item = |(index, found): (usize, Completion)| {
        let is_snippet = found.kind == CompletionKind::Snippet;
        let typed = text.bytes().get(found.range.clone()).unwrap_or_default();
        CompletionItem {
            label: found.label,
            kind: Some(match found.kind {
                CompletionKind::Code => CompletionItemKind::PROPERTY,
                CompletionKind::Record => CompletionItemKind::KEYWORD,
                CompletionKind::Name | CompletionKind::Word => CompletionItemKind::VALUE,
                CompletionKind::Snippet => CompletionItemKind::SNIPPET,
            }),
            detail: Some(found.about.into_owned()),
            // Codes must not be sorted as words.
            sort_text: Some(format!("{index:04}")),
            filter_text: match found.kind {
                CompletionKind::Word | CompletionKind::Snippet if !typed.is_empty() => {
                    Some(String::from_utf8_lossy(typed).into_owned())
                }
                _ => None,
            },
            insert_text_format: is_snippet.then_some(InsertTextFormat::SNIPPET),
            text_edit: Some(CompletionTextEdit::Edit(TextEdit {
                range: context.range(text, found.range),
                new_text: found.text,
            })),
            ..CompletionItem::default()
        }
    };
    let mut found = completions(document, context.offset(text, position));
    found.retain(|found| context.abilities.snippets || found.kind != CompletionKind::Snippet);
    Ok(Some(CompletionResponse::Array(
        found.into_iter().enumerate().map(item).collect(),
    )))
}
