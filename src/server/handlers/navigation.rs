//! `textDocument/definition`, `references` and `documentHighlight`: handles, layers, blocks, linetypes, text styles; what belongs
//! together in a program.

use crate::ide::{Question, Role};
use crate::server::context::RequestContext;
use ls_types::{
    DocumentHighlight, DocumentHighlightKind, DocumentHighlightParams, GotoDefinitionParams,
    GotoDefinitionResponse, Location, Position, Range, ReferenceParams,
};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn definition(
    context: &RequestContext,
    params: GotoDefinitionParams,
) -> Result<Option<GotoDefinitionResponse>> {
    let at = params.text_document_position_params.position;
    let found = locations(context, at, Question::Definition)?;
    Ok(found.map(GotoDefinitionResponse::Array))
}

pub(in crate::server) fn references(
    context: &RequestContext,
    params: ReferenceParams,
) -> Result<Option<Vec<Location>>> {
    let with_definition = params.context.include_declaration;
    let question = Question::References { with_definition };
    locations(context, params.text_document_position.position, question)
}

pub(in crate::server) fn highlight(
    context: &RequestContext,
    params: DocumentHighlightParams,
) -> Result<Option<Vec<DocumentHighlight>>> {
    let at = params.text_document_position_params.position;
    let highlight = |(range, role)| DocumentHighlight {
        range,
        kind: Some(match role {
            Role::Defines => DocumentHighlightKind::WRITE,
            Role::Uses => DocumentHighlightKind::READ,
            Role::Partner => DocumentHighlightKind::TEXT,
        }),
    };
    let found = occurrences(context, at, Question::Highlights)?;
    Ok(found.map(|found| found.into_iter().map(highlight).collect()))
}

fn locations(
    context: &RequestContext,
    at: Position,
    question: Question,
) -> Result<Option<Vec<Location>>> {
    let uri = context.lsp_uri()?;
    let location = |(range, _)| Location {
        uri: uri.clone(),
        range,
    };
    let found = occurrences(context, at, question)?;
    Ok(found.map(|found| found.into_iter().map(location).collect()))
}

fn occurrences(
    context: &RequestContext,
    at: Position,
    question: Question,
) -> Result<Option<Vec<(Range, Role)>>> {
    let Some(whole) = context.whole() else {
        return Ok(None);
    };
    let text = whole.text();
    let offset = context.offset(text, at);
    let found = whole.occurrences(offset, question, &|| context.is_cancelled())?;
    Ok(found.map(|found| {
        let range = |found: crate::ide::Occurrence| (context.range(text, found.range), found.role);
        found.into_iter().map(range).collect()
    }))
}
