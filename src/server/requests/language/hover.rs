//! `textDocument/hover`: what a group code or its value means; where a block goes.

use super::{dxf_in, offset_of, program_in};
use crate::dxf;
use crate::program;
use crate::server::convert::{lsp_range, range_of};
use crate::server::state::State;
use ls_types::{Hover, HoverContents, HoverParams, MarkupContent, MarkupKind};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn hover(state: &mut State, params: &HoverParams) -> Result<Option<Hover>> {
    let at = &params.text_document_position_params;
    let encoding = state.encoding;
    let open = state.document(at.text_document.uri.as_str())?;
    let markdown = |value: String, range| Hover {
        contents: HoverContents::Markup(MarkupContent {
            kind: MarkupKind::Markdown,
            value,
        }),
        range: Some(lsp_range(range)),
    };
    if let Some(program) = program_in(open).and_then(|document| document.program()) {
        let found =
            program::language::hover(program, offset_of(program.text(), at.position, encoding));
        return Ok(found
            .map(|found| markdown(found.text, range_of(program.text(), found.range, encoding))));
    }
    let settings = open.document().map(|document| document.settings().clone());
    let (Some(dxf), Some(settings)) = (dxf_in(open), settings) else {
        return Ok(None);
    };
    let unit = settings.unit_of(dxf.drawing());
    let found = dxf::language::hover(dxf, offset_of(dxf.text(), at.position, encoding), unit);
    Ok(found.map(|found| markdown(found.text, range_of(dxf.text(), found.range, encoding))))
}
