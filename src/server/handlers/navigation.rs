//! `textDocument/definition`, `references` and `documentHighlight`: handles, layers, blocks, linetypes, text styles; what belongs
//! together in a program.

use crate::ide::dxf::{Occurrence, occurrences};
use crate::ide::program::{highlights, match_of, pauses};
use crate::server::context::RequestContext;
use crate::server::errors::moved_on;
use crate::text::SourceText;
use ls_types::{
    DocumentHighlight, DocumentHighlightKind, DocumentHighlightParams, GotoDefinitionParams,
    GotoDefinitionResponse, Location, ReferenceParams,
};
use std::ops::Range;
use tower_lsp::jsonrpc::Result;

/// Places of one answer.
const LIMIT: usize = 10_000;

pub(in crate::server) fn definition(
    context: &RequestContext,
    params: GotoDefinitionParams,
) -> Result<Option<GotoDefinitionResponse>> {
    let places = if let Some(program) = context.program() {
        let position = params.text_document_position_params.position;
        let found = match_of(program, context.offset(program.text(), position));
        locations(context, program.text(), found)?
    } else if let Some((text, found)) = named(context)? {
        let found = found.into_iter().filter(|found| found.defines);
        locations(context, text, found.map(|found| found.range))?
    } else {
        return Ok(None);
    };
    Ok(Some(GotoDefinitionResponse::Array(places)))
}

pub(in crate::server) fn references(
    context: &RequestContext,
    params: ReferenceParams,
) -> Result<Option<Vec<Location>>> {
    if let Some(program) = context.program() {
        let offset = context.offset(program.text(), params.text_document_position.position);
        let all = pauses(program);
        let is_one = all
            .iter()
            .any(|range| range.start <= offset && offset <= range.end);
        let all = all.into_iter().filter(|_| is_one).take(LIMIT);
        return locations(context, program.text(), all).map(Some);
    }
    let Some((text, found)) = named(context)? else {
        return Ok(None);
    };
    let with_definition = params.context.include_declaration;
    let found = found
        .into_iter()
        .filter(|found| with_definition || !found.defines);
    locations(context, text, found.map(|found| found.range)).map(Some)
}

pub(in crate::server) fn highlight(
    context: &RequestContext,
    params: DocumentHighlightParams,
) -> Result<Option<Vec<DocumentHighlight>>> {
    let highlight = |text, range, kind| DocumentHighlight {
        range: context.range(text, range),
        kind: Some(kind),
    };
    if let Some(program) = context.program() {
        let (text, at) = (program.text(), params.text_document_position_params);
        let found = highlights(program, context.offset(text, at.position)).into_iter();
        return Ok(Some(
            found
                .map(|range| highlight(text, range, DocumentHighlightKind::TEXT))
                .collect(),
        ));
    }
    let Some((text, found)) = named(context)? else {
        return Ok(None);
    };
    let kind = |found: &Occurrence| match found.defines {
        true => DocumentHighlightKind::WRITE,
        false => DocumentHighlightKind::READ,
    };
    Ok(Some(
        found
            .into_iter()
            .map(|found| highlight(text, found.range.clone(), kind(&found)))
            .collect(),
    ))
}

/// Where DXF holds the name that is asked about.
fn named(context: &RequestContext) -> Result<Option<(&SourceText, Vec<Occurrence>)>> {
    let (Some(text), Some(name)) = (context.text(), context.name()) else {
        return Ok(None);
    };
    let found = occurrences(text, name, LIMIT, &|| context.is_cancelled()).ok_or_else(moved_on)?;
    Ok(Some((text, found)))
}

fn locations(
    context: &RequestContext,
    text: &SourceText,
    found: impl IntoIterator<Item = Range<usize>>,
) -> Result<Vec<Location>> {
    let uri = context.lsp_uri()?;
    let location = |range| Location {
        uri: uri.clone(),
        range: context.range(text, range),
    };
    Ok(found.into_iter().map(location).collect())
}
