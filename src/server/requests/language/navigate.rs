//! `textDocument/definition`, `references` and `documentHighlight`: handles, layers, blocks, linetypes, text styles; what belongs
//! together in a program.

use super::{dxf_in, offset_of, program_in, whole, whole_program};
use crate::dxf::language::{Occurrence, name_at, occurrences};
use crate::program::language::{highlights, match_of, pauses};
use crate::server::convert::{lsp_range, range_of};
use crate::server::requests::{Errand, written};
use crate::server::state::State;
use crate::text::{Encoding, SourceText};
use ls_types::{
    DocumentHighlight, DocumentHighlightKind, Location, Position, TextDocumentPositionParams, Uri,
};

/// Places of one answer.
const LIMIT: usize = 10_000;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::server) enum Question {
    Definition,
    References { with_definition: bool },
    Highlight,
}

pub(in crate::server) fn navigate(
    state: &mut State,
    at: &TextDocumentPositionParams,
    question: Question,
    errand: Errand,
) {
    let encoding = state.encoding;
    let uri = at.text_document.uri.clone();
    if state
        .documents
        .get(uri.as_str())
        .and_then(program_in)
        .is_some()
    {
        navigate_program(state, uri, at.position, question, errand);
        return;
    }
    let dxf = state.documents.get(uri.as_str()).and_then(dxf_in);
    let name = dxf.and_then(|dxf| name_at(dxf, offset_of(dxf.text(), at.position, encoding)));
    let Some((name, _)) = name else {
        let known = state.document(uri.as_str()).map(|_| b"null".to_vec());
        let _ = errand.reply.send(known);
        return;
    };
    whole(
        state,
        "Looking for names",
        at.text_document.uri.as_str(),
        errand,
        move |text, stop| {
            let found = occurrences(text, &name, LIMIT, stop)?;
            Some(match question {
                Question::Highlight => {
                    let highlight = |found: &Occurrence| DocumentHighlight {
                        range: lsp_range(range_of(text, found.range.clone(), encoding)),
                        kind: Some(if found.defines {
                            DocumentHighlightKind::WRITE
                        } else {
                            DocumentHighlightKind::READ
                        }),
                    };
                    written(&found.iter().map(highlight).collect::<Vec<_>>())
                }
                Question::Definition => written(&locations(
                    text,
                    &uri,
                    &found,
                    |found| found.defines,
                    encoding,
                )),
                Question::References { with_definition } => written(&locations(
                    text,
                    &uri,
                    &found,
                    |found| with_definition || !found.defines,
                    encoding,
                )),
            })
        },
    );
}

fn navigate_program(
    state: &mut State,
    uri: Uri,
    position: Position,
    question: Question,
    errand: Errand,
) {
    let encoding = state.encoding;
    let name = uri.as_str().to_owned();
    whole_program(
        state,
        "Looking for what belongs together",
        &name,
        errand,
        move |program, _| {
            let text = program.text();
            let offset = offset_of(text, position, encoding);
            let place = |range| lsp_range(range_of(text, range, encoding));
            let location = |range| Location {
                uri: uri.clone(),
                range: place(range),
            };
            match question {
                Question::Definition => written(
                    &match_of(program, offset)
                        .into_iter()
                        .map(location)
                        .collect::<Vec<_>>(),
                ),
                Question::References { .. } => {
                    let all = pauses(program);
                    let asked = all
                        .iter()
                        .any(|range| range.start <= offset && offset <= range.end);
                    written(
                        &all.into_iter()
                            .filter(|_| asked)
                            .take(LIMIT)
                            .map(location)
                            .collect::<Vec<_>>(),
                    )
                }
                Question::Highlight => {
                    let highlight = |range| DocumentHighlight {
                        range: place(range),
                        kind: Some(DocumentHighlightKind::TEXT),
                    };
                    written(
                        &highlights(program, offset)
                            .into_iter()
                            .map(highlight)
                            .collect::<Vec<_>>(),
                    )
                }
            }
        },
    );
}

fn locations(
    text: &SourceText,
    uri: &Uri,
    found: &[Occurrence],
    wanted: impl Fn(&Occurrence) -> bool,
    encoding: Encoding,
) -> Vec<Location> {
    let location = |found: &Occurrence| Location {
        uri: uri.clone(),
        range: lsp_range(range_of(text, found.range.clone(), encoding)),
    };
    found
        .iter()
        .filter(|found| wanted(found))
        .map(location)
        .collect()
}
