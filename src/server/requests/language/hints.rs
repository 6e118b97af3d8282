//! `textDocument/inlayHint`: radius and sweep beside each bulge; end point and radius behind each block.

use super::{dxf_in, program_in};
use crate::dxf::language::hints;
use crate::program;
use crate::server::convert::{bytes_of, lsp_range, range_of};
use crate::server::state::State;
use crate::text::{Encoding, SourceText};
use ls_types::{InlayHint, InlayHintLabel, InlayHintParams};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn inlay_hint(
    state: &mut State,
    params: &InlayHintParams,
) -> Result<Option<Vec<InlayHint>>> {
    let encoding = state.encoding;
    let open = state.document(params.text_document.uri.as_str())?;
    if let Some(program) = program_in(open).and_then(|document| document.program()) {
        let text = program.text();
        let found = program::language::hints(program, bytes_of(text, params.range, encoding));
        return Ok(Some(
            found
                .into_iter()
                .map(|found| hint(text, found.offset, found.text, encoding))
                .collect(),
        ));
    }
    let settings = open.document().map(|document| document.settings().clone());
    let (Some(dxf), Some(settings)) = (dxf_in(open), settings) else {
        return Ok(None);
    };
    let found = hints(
        dxf,
        bytes_of(dxf.text(), params.range, encoding),
        settings.unit_of(dxf.drawing()),
    );
    Ok(Some(
        found
            .into_iter()
            .map(|found| hint(dxf.text(), found.offset, found.text, encoding))
            .collect(),
    ))
}

fn hint(text: &SourceText, offset: usize, label: String, encoding: Encoding) -> InlayHint {
    InlayHint {
        position: lsp_range(range_of(text, offset..offset, encoding)).start,
        label: InlayHintLabel::String(label),
        kind: None,
        text_edits: None,
        tooltip: None,
        padding_left: Some(true),
        padding_right: None,
        data: None,
    }
}
