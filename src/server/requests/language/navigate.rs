//! `textDocument/definition`, `references` and `documentHighlight`: handles, layers, blocks, linetypes, text styles.

use super::{dxf_in, offset_of, whole};
use crate::dxf::language::{Occurrence, name_at, occurrences};
use crate::server::convert::{lsp_range, range_of};
use crate::server::requests::{Errand, written};
use crate::server::state::State;
use crate::text::{Encoding, SourceText};
use ls_types::{DocumentHighlight, DocumentHighlightKind, Location, TextDocumentPositionParams, Uri};

/// Places of one answer.
const LIMIT: usize = 10_000;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::server) enum Question {
    Definition,
    References { with_definition: bool },
    Highlight,
}

pub(in crate::server) fn navigate(state: &mut State, at: &TextDocumentPositionParams, question: Question, errand: Errand) {
    let encoding = state.encoding;
    let uri = at.text_document.uri.clone();
    let dxf = state.documents.get(uri.as_str()).and_then(dxf_in);
    let name = dxf.and_then(|dxf| name_at(dxf, offset_of(dxf.text(), at.position, encoding)));
    let Some((name, _)) = name else {
        let known = state.document(uri.as_str()).map(|_| b"null".to_vec());
        let _ = errand.reply.send(known);
        return;
    };
    whole(state, "Looking for names", at.text_document.uri.as_str(), errand, move |text, stop| {
        let found = occurrences(text, &name, LIMIT, stop)?;
        Some(match question {
            Question::Highlight => {
                let highlight = |found: &Occurrence| DocumentHighlight {
                    range: lsp_range(range_of(text, found.range.clone(), encoding)),
                    kind: Some(if found.defines { DocumentHighlightKind::WRITE } else { DocumentHighlightKind::READ }),
                };
                written(&found.iter().map(highlight).collect::<Vec<_>>())
            }
            Question::Definition => written(&locations(text, &uri, &found, |found| found.defines, encoding)),
            Question::References { with_definition } => {
                written(&locations(text, &uri, &found, |found| with_definition || !found.defines, encoding))
            }
        })
    });
}

fn locations(
    text: &SourceText,
    uri: &Uri,
    found: &[Occurrence],
    wanted: impl Fn(&Occurrence) -> bool,
    encoding: Encoding,
) -> Vec<Location> {
    let location = |found: &Occurrence| Location { uri: uri.clone(), range: lsp_range(range_of(text, found.range.clone(), encoding)) };
    found.iter().filter(|found| wanted(found)).map(location).collect()
}
