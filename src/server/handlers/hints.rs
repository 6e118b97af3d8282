//! `textDocument/inlayHint`: radius and sweep beside each bulge; end point and radius after each block.

use crate::ide;
use crate::server::context::RequestContext;
use crate::server::convert::bytes_of;
use ls_types::{InlayHint, InlayHintLabel, InlayHintParams};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn inlay_hint(
    context: &RequestContext,
    params: InlayHintParams,
) -> Result<Option<Vec<InlayHint>>> {
    let Some((document, text)) = context.document_and_text() else {
        return Ok(None);
    };
    let hint = |found: ide::Hint| InlayHint {
        position: context.range(text, found.offset..found.offset).start,
        label: InlayHintLabel::String(found.text),
        kind: None,
        text_edits: None,
        tooltip: None,
        padding_left: Some(true),
        padding_right: None,
        data: None,
    };
    let found = ide::hints(document, bytes_of(text, params.range, context.encoding));
    Ok(Some(found.into_iter().map(hint).collect()))
}
