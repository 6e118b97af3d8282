//! Where the params of each LSP request name their document.

use super::code_action::Unresolved;
use crate::server::context::About;
use ls_types::*;

macro_rules! about {
    ($($params:path: $($uri:ident).+ $(, at $($at:ident).+)? $(, token $($token:ident).+)?;)*) => {$(
        impl From<&$params> for About {
            fn from(params: &$params) -> About {
                About {
                    uri: params.$($uri).+.as_str().into(),
                    $(position: Some(params.$($at).+),)?
                    $(token: params.$($token).+.as_ref().and_then(|token| serde_json::to_value(token).ok()),)?
                    ..About::default()
                }
            }
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
    FoldingRangeParams: text_document.uri;
    GotoDefinitionParams: text_document_position_params.text_document.uri,
        at text_document_position_params.position;
    HoverParams: text_document_position_params.text_document.uri;
    InlayHintParams: text_document.uri;
    ReferenceParams: text_document_position.text_document.uri, at text_document_position.position;
    RenameParams: text_document_position.text_document.uri;
    SelectionRangeParams: text_document.uri;
    SemanticTokensDeltaParams: text_document.uri;
    SemanticTokensParams: text_document.uri;
    SemanticTokensRangeParams: text_document.uri;
    SignatureHelpParams: text_document_position_params.text_document.uri;
    TextDocumentPositionParams: text_document.uri;
}

/// An action names its document in its `data`.
impl From<&CodeAction> for About {
    fn from(action: &CodeAction) -> About {
        let data = action.data.clone().map(serde_json::from_value);
        let uri = |data: Unresolved| data.uri.as_str().into();
        About {
            uri: data.and_then(Result::ok).map_or_else(|| "".into(), uri),
            ..About::default()
        }
    }
}
