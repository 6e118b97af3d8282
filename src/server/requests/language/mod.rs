//! What editors ask about DXF text and programs. Questions about one place are answered at once; those about the whole text are answered
//! by a worker from a copy of it, which all that ask between two edits share.

pub(in crate::server) mod completion;
pub(in crate::server) mod folding;
pub(in crate::server) mod formatting;
pub(in crate::server) mod hints;
pub(in crate::server) mod hover;
pub(in crate::server) mod lenses;
pub(in crate::server) mod navigate;
pub(in crate::server) mod rename;
pub(in crate::server) mod selection;
pub(in crate::server) mod signature;
pub(in crate::server) mod symbols;
pub(in crate::server) mod token_memory;
pub(in crate::server) mod tokens;

use super::{Errand, moved_on, run};
use crate::document::{Document, Source};
use crate::dxf;
use crate::program;
use crate::server::content::Content;
use crate::server::open::Open;
use crate::server::state::State;
use crate::settings::Effective;
use crate::text::{Encoding, SourceText};
use ls_types::Position;
use std::sync::Arc;
use tower_lsp::jsonrpc::Result;

/// Texts up to this size are looked through at once: a worker costs more.
const AT_ONCE: usize = 64 * 1024;

/// The DXF document that is open; `None` where it is something else.
fn dxf_in(open: &Open) -> Option<&dxf::Document> {
    match &open.content {
        Content::Read(document) => match document.source() {
            Source::Dxf(dxf) => Some(dxf),
            Source::Cad(_) | Source::Program(_) => None,
        },
        _ => None,
    }
}

/// The program that is open; `None` where it is something else.
fn program_in(open: &Open) -> Option<&Arc<Document>> {
    open.document()
        .filter(|document| document.program().is_some())
}

fn offset_of(text: &SourceText, position: Position, encoding: Encoding) -> usize {
    text.offset_of(
        position.line as usize,
        position.character as usize,
        encoding,
    )
}

/// Looks at a whole text, on a worker where it is long. Documents that are no DXF are answered with null.
///
/// `work` gets the text and a question that is true when nobody wants the result any more; it answers `None` then.
fn whole(
    state: &mut State,
    name: &'static str,
    uri: &str,
    errand: Errand,
    work: impl FnOnce(&SourceText, &dyn Fn() -> bool) -> Option<Result<Vec<u8>>> + Send + 'static,
) {
    let open = match state.document(uri) {
        Ok(open) => open,
        Err(error) => {
            let _ = errand.reply.send(Err(error));
            return;
        }
    };
    let stamp = open.stamp;
    let shot = dxf_in(open).is_some().then(|| open.shot()).flatten();
    let Some(shot) = shot else {
        let _ = errand.reply.send(Ok(b"null".to_vec()));
        return;
    };
    let at_once = shot.text.len() <= AT_ONCE;
    run(
        state,
        name,
        uri,
        (stamp, at_once),
        errand,
        move |cancel, _| {
            let stop = || cancel.is_cancelled() || shot.is_outdated();
            work(&shot.text, &stop).unwrap_or_else(|| Err(moved_on()))
        },
    );
}

/// Looks at a whole program, on a worker where it is long. Documents that are no program are answered with null.
fn whole_program(
    state: &mut State,
    name: &'static str,
    uri: &str,
    errand: Errand,
    work: impl FnOnce(&program::Document, &Effective) -> Result<Vec<u8>> + Send + 'static,
) {
    let open = match state.document(uri) {
        Ok(open) => open,
        Err(error) => {
            let _ = errand.reply.send(Err(error));
            return;
        }
    };
    let stamp = open.stamp;
    let Some(document) = program_in(open).cloned() else {
        let _ = errand.reply.send(Ok(b"null".to_vec()));
        return;
    };
    let at_once = document.text().is_none_or(|text| text.len() <= AT_ONCE);
    run(
        state,
        name,
        uri,
        (stamp, at_once),
        errand,
        move |_, _| match document.program() {
            Some(program) => work(program, document.settings()),
            None => Ok(b"null".to_vec()),
        },
    );
}
