//! `textDocument/signatureHelp`: which number of a block the cursor is in.

use super::{offset_of, program_in};
use crate::program::language::signature;
use crate::server::state::State;
use ls_types::{
    Documentation, MarkupContent, MarkupKind, ParameterInformation, ParameterLabel, SignatureHelp,
    SignatureHelpOptions, SignatureHelpParams, SignatureInformation, WorkDoneProgressOptions,
};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn options() -> SignatureHelpOptions {
    SignatureHelpOptions {
        trigger_characters: Some(
            ["B", "b", "X", "x", "I", "i", "D", "P"]
                .map(Into::into)
                .to_vec(),
        ),
        retrigger_characters: Some(
            ["G", "g", "Y", "y", "J", "j", "R", " "]
                .map(Into::into)
                .to_vec(),
        ),
        work_done_progress_options: WorkDoneProgressOptions::default(),
    }
}

pub(in crate::server) fn signature_help(
    state: &mut State,
    params: &SignatureHelpParams,
) -> Result<Option<SignatureHelp>> {
    let at = &params.text_document_position_params;
    let encoding = state.encoding;
    let open = state.document(at.text_document.uri.as_str())?;
    let Some(program) = program_in(open).and_then(|document| document.program()) else {
        return Ok(None);
    };
    let Some(found) = signature(program, offset_of(program.text(), at.position, encoding)) else {
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
