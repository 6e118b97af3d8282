//! Error answers to requests.

use super::convert;
use crate::document::Document;
use crate::ide::Stopped;
use crate::job::Refusal;
use crate::message::readable;
use crate::protocol::{Diagnostic, Refused};
use crate::text::Encoding;
use tower_lsp::jsonrpc::{Error, ErrorCode};

/// −32803: refused because of what the document is, or what the client can do.
pub(super) fn refused(message: impl Into<String>) -> Error {
    Error {
        code: ErrorCode::ServerError(-32803),
        message: readable(&message.into()).into_owned().into(),
        data: None,
    }
}

fn refused_with(message: impl Into<String>, diagnostics: Vec<Diagnostic>) -> Error {
    Error {
        data: serde_json::to_value(Refused { diagnostics }).ok(),
        ..refused(message)
    }
}

pub(super) fn internal(message: impl Into<String>) -> Error {
    Error {
        code: ErrorCode::InternalError,
        message: message.into().into(),
        data: None,
    }
}

pub(super) fn moved_on() -> Error {
    Error {
        code: ErrorCode::ContentModified,
        message: say!(the_document_has_changed_meanwhile).into(),
        data: None,
    }
}

impl From<Stopped> for Error {
    fn from(_: Stopped) -> Error {
        moved_on()
    }
}

/// Why there is no result; the findings' places are in `document`.
pub(super) fn refusal(document: &Document, refusal: &Refusal, encoding: Encoding) -> Error {
    match refusal {
        Refusal::Cancelled => Error::request_cancelled(),
        Refusal::Fault(sentence) => internal(sentence),
        Refusal::Sentence(sentence) => refused(sentence),
        Refusal::Parts(_) => refused(refusal.sentence(document.telling())),
        Refusal::Errors(_) | Refusal::Findings(_) | Refusal::Unproved(..) => refused_with(
            refusal.sentence(document.telling()),
            convert::diagnostics(document, refusal.findings(), encoding),
        ),
    }
}
