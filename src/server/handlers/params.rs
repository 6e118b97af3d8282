//! Where the params of each request say which document it is about.

use super::generate;
use crate::protocol::{DrawingName, Inspect, Locate, ScaleProgram, Simulate};
use crate::server::context::About;
use ls_types::*;
use serde_json::Value;

/// Params of `wedm/toolpath` and `wedm/picture`; the options are read by the settings' own reader, which names a misfit.
#[derive(serde::Deserialize)]
pub(in crate::server) struct WithOptions {
    uri: String,
    options: Option<Value>,
}

macro_rules! about {
    ($($params:path: $($uri:ident).+ $(, at $($at:ident).+)? $(, options $options:ident)? $(, token $($token:ident).+)?;)*) => {$(
        impl About for $params {
            fn uri(&self) -> &str {
                self.$($uri).+.as_str()
            }
            $(fn position(&self) -> Option<Position> {
                Some(self.$($at).+)
            })?
            $(fn options(&self) -> Option<&Value> {
                self.$options.as_ref()
            })?
            $(fn token(&self) -> Option<Value> {
                serde_json::to_value(self.$($token).+.as_ref()?).ok()
            })?
        }
    )*};
}

about! {
    CodeActionParams: text_document.uri, token work_done_progress_params.work_done_token;
    CodeLensParams: text_document.uri;
    CompletionParams: text_document_position.text_document.uri;
    DocumentFormattingParams: text_document.uri;
    DocumentHighlightParams: text_document_position_params.text_document.uri,
        at text_document_position_params.position;
    DocumentOnTypeFormattingParams: text_document_position.text_document.uri;
    DocumentRangeFormattingParams: text_document.uri;
    DocumentSymbolParams: text_document.uri;
    DrawingName: uri;
    FoldingRangeParams: text_document.uri;
    GotoDefinitionParams: text_document_position_params.text_document.uri,
        at text_document_position_params.position;
    HoverParams: text_document_position_params.text_document.uri;
    InlayHintParams: text_document.uri;
    Inspect: uri;
    Locate: uri;
    ReferenceParams: text_document_position.text_document.uri, at text_document_position.position;
    RenameParams: text_document_position.text_document.uri;
    ScaleProgram: uri;
    SelectionRangeParams: text_document.uri;
    SemanticTokensDeltaParams: text_document.uri;
    SemanticTokensParams: text_document.uri;
    SemanticTokensRangeParams: text_document.uri;
    SignatureHelpParams: text_document_position_params.text_document.uri;
    Simulate: uri;
    TextDocumentPositionParams: text_document.uri;
    WithOptions: uri, options options;
    generate::Params: uri, options options;
}
