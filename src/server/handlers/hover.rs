//! `textDocument/hover`: what a group code or its value means; where a block goes.

use crate::dxf;
use crate::program;
use crate::server::context::RequestContext;
use ls_types::{Hover, HoverContents, HoverParams, MarkupContent, MarkupKind};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn hover(
    context: &RequestContext,
    params: HoverParams,
) -> Result<Option<Hover>> {
    let position = params.text_document_position_params.position;
    let found = if let Some(program) = context.program() {
        let text = program.text();
        program::language::hover(program, context.offset(text, position))
            .map(|found| (context.range(text, found.range), found.text))
    } else if let (Some(dxf), Some(document)) = (context.dxf(), context.document()) {
        let text = dxf.text();
        let unit = document.settings().unit_of(dxf.drawing());
        dxf::language::hover(dxf, context.offset(text, position), unit)
            .map(|found| (context.range(text, found.range), found.text))
    } else {
        None
    };
    Ok(found.map(|(range, value)| Hover {
        contents: HoverContents::Markup(MarkupContent {
            kind: MarkupKind::Markdown,
            value,
        }),
        range: Some(range),
    }))
}
