//! `textDocument/inlayHint`: radius and sweep beside each bulge.

use super::dxf_in;
use crate::dxf::language::{Hint, hints};
use crate::server::convert::{bytes_of, lsp_range, range_of};
use crate::server::state::State;
use ls_types::{InlayHint, InlayHintLabel, InlayHintParams};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn inlay_hint(state: &mut State, params: &InlayHintParams) -> Result<Option<Vec<InlayHint>>> {
    let encoding = state.encoding;
    let open = state.document(params.text_document.uri.as_str())?;
    let settings = open.document().map(|document| document.settings().clone());
    let (Some(dxf), Some(settings)) = (dxf_in(open), settings) else { return Ok(None) };
    let hint = |hint: Hint| InlayHint {
        position: lsp_range(range_of(dxf.text(), hint.offset..hint.offset, encoding)).start,
        label: InlayHintLabel::String(hint.text),
        kind: None,
        text_edits: None,
        tooltip: None,
        padding_left: Some(true),
        padding_right: None,
        data: None,
    };
    let found = hints(dxf, bytes_of(dxf.text(), params.range, encoding), settings.unit_of(dxf.drawing()));
    Ok(Some(found.into_iter().map(hint).collect()))
}
