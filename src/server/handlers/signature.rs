//! `textDocument/signatureHelp`: which number of a block the cursor is in.

use crate::ide::signature;
use crate::server::context::RequestContext;
use ls_types::{
    Documentation, MarkupContent, MarkupKind, ParameterInformation, ParameterLabel, SignatureHelp,
    SignatureHelpParams, SignatureInformation,
};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn signature_help(
    context: &RequestContext,
    params: SignatureHelpParams,
) -> Result<Option<SignatureHelp>> {
    let position = params.text_document_position_params.position;
    let Some((document, text)) = context.document_and_text() else {
        return Ok(None);
    };
    let Some(found) = signature(document, context.offset(text, position)) else {
        return Ok(None);
    };
    let markdown = |value: String| {
        Documentation::MarkupContent(MarkupContent {
            kind: MarkupKind::Markdown,
            value,
        })
    };
    let parameter = |(label, about): &(&str, &str)| ParameterInformation {
        label: ParameterLabel::Simple((*label).to_owned()),
        documentation: Some(markdown((*about).to_owned())),
    };
    let active = u32::try_from(found.active).ok();
    Ok(Some(SignatureHelp {
        signatures: vec![SignatureInformation {
            label: found.label.into(),
            documentation: None,
            parameters: Some(found.parameters.iter().map(parameter).collect()),
            active_parameter: active,
        }],
        active_signature: Some(0),
        active_parameter: active,
    }))
}
