//! `textDocument/hover`: the meaning of a group code or its value; the end of a block.

use crate::ide;
use crate::server::context::RequestContext;
use ls_types::{Hover, HoverContents, HoverParams, MarkupContent, MarkupKind};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn hover(
    context: &RequestContext,
    params: HoverParams,
) -> Result<Option<Hover>> {
    let position = params.text_document_position_params.position;
    let Some((document, text)) = context.document_and_text() else {
        return Ok(None);
    };
    let found = ide::hover(document, context.offset(text, position));
    Ok(found.map(|found| Hover {
        contents: HoverContents::Markup(MarkupContent {
            kind: MarkupKind::Markdown,
            value: found.text,
        }),
        range: Some(context.range(text, found.range)),
    }))
}
