//! `textDocument/hover`: what a group code or its value means.

use super::{dxf_in, offset_of};
use crate::dxf::language;
use crate::server::convert::{lsp_range, range_of};
use crate::server::state::State;
use ls_types::{Hover, HoverContents, HoverParams, MarkupContent, MarkupKind};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn hover(state: &mut State, params: &HoverParams) -> Result<Option<Hover>> {
    let at = &params.text_document_position_params;
    let encoding = state.encoding;
    let open = state.document(at.text_document.uri.as_str())?;
    let settings = open.document().map(|document| document.settings().clone());
    let (Some(dxf), Some(settings)) = (dxf_in(open), settings) else { return Ok(None) };
    let unit = settings.unit_of(dxf.drawing());
    let found = language::hover(dxf, offset_of(dxf.text(), at.position, encoding), unit);
    Ok(found.map(|found| Hover {
        contents: HoverContents::Markup(MarkupContent { kind: MarkupKind::Markdown, value: found.text }),
        range: Some(lsp_range(range_of(dxf.text(), found.range, encoding))),
    }))
}
