//! `textDocument/inlayHint`: radius and sweep beside each bulge; end point and radius behind each block.

use crate::dxf;
use crate::program;
use crate::server::context::RequestContext;
use crate::server::convert::bytes_of;
use crate::text::SourceText;
use ls_types::{InlayHint, InlayHintLabel, InlayHintParams};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn inlay_hint(
    context: &RequestContext,
    params: InlayHintParams,
) -> Result<Option<Vec<InlayHint>>> {
    let bytes = |text: &SourceText| bytes_of(text, params.range, context.encoding);
    let hint = |text: &SourceText, offset: usize, label: String| InlayHint {
        position: context.range(text, offset..offset).start,
        label: InlayHintLabel::String(label),
        kind: None,
        text_edits: None,
        tooltip: None,
        padding_left: Some(true),
        padding_right: None,
        data: None,
    };
    if let Some(program) = context.program() {
        let text = program.text();
        let found = program::language::hints(program, bytes(text)).into_iter();
        return Ok(Some(
            found
                .map(|found| hint(text, found.offset, found.text))
                .collect(),
        ));
    }
    let (Some(dxf), Some(document)) = (context.dxf(), context.document()) else {
        return Ok(None);
    };
    let (text, unit) = (dxf.text(), document.settings().unit_of(dxf.drawing()));
    let found = dxf::language::hints(dxf, bytes(text), unit).into_iter();
    Ok(Some(
        found
            .map(|found| hint(text, found.offset, found.text))
            .collect(),
    ))
}
