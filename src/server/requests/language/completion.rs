//! `textDocument/completion`: group codes, names of records, layers; the fields of a block.

use super::{dxf_in, offset_of, program_in};
use crate::dxf::language::{Completion, CompletionKind, completions};
use crate::program;
use crate::server::convert::{lsp_range, range_of};
use crate::server::state::State;
use ls_types::{
    CompletionItem, CompletionItemKind, CompletionOptions, CompletionParams, CompletionResponse,
    CompletionTextEdit, InsertTextFormat, TextEdit,
};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn options() -> CompletionOptions {
    // A digit is no word: editors ask at these of their own accord.
    CompletionOptions {
        trigger_characters: Some(
            ["B", "G", "M", "I", "J", "D", "H", "P"]
                .map(Into::into)
                .to_vec(),
        ),
        ..CompletionOptions::default()
    }
}

pub(in crate::server) fn completion(
    state: &mut State,
    params: &CompletionParams,
) -> Result<Option<CompletionResponse>> {
    let at = &params.text_document_position;
    let encoding = state.encoding;
    let snippets = state.client.abilities.snippets;
    let open = state.document(at.text_document.uri.as_str())?;
    if let Some(program) = program_in(open).and_then(|document| document.program()) {
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
                range: lsp_range(range_of(text, found.range, encoding)),
                new_text: found.text,
            })),
            ..CompletionItem::default()
        };
        let found = program::language::completions(program, offset_of(text, at.position, encoding));
        let found = found
            .into_iter()
            .filter(|found| snippets || !found.is_snippet);
        return Ok(Some(CompletionResponse::Array(
            found.enumerate().map(item).collect(),
        )));
    }
    let Some(dxf) = dxf_in(open) else {
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
            range: lsp_range(range_of(dxf.text(), found.range, encoding)),
            new_text: found.text,
        })),
        ..CompletionItem::default()
    };
    let found = completions(dxf, offset_of(dxf.text(), at.position, encoding));
    Ok(Some(CompletionResponse::Array(
        found.into_iter().enumerate().map(item).collect(),
    )))
}
