//! One file a request. Each runs on the state thread and hands what takes long to a worker.

pub(super) mod code_action;
pub(super) mod contours;
pub(super) mod drawing_edit;
pub(super) mod generate;
pub(super) mod inspect;
pub(super) mod language;
pub(super) mod picture;
pub(super) mod probe;
pub(super) mod toolpath;

use super::convert::Places;
use super::jobs::{Cancel, Progress};
use super::state::{Reply, State};
use crate::document::{Document, Snapshot, Source};
use crate::drawing::{Drawing, Outline};
use crate::protocol::{Diagnostic, Refused};
use crate::settings::{Effective, Settings, from_json};
use crate::toolpath::Refusal;
use serde::Serialize;
use serde_json::Value;
use std::sync::Arc;
use tower_lsp::jsonrpc::{Error, ErrorCode, Result};

/// What every long request brings along beside its params.
pub(super) struct Errand {
    pub reply: Reply<Vec<u8>>,
    pub cancel: Cancel,
    /// `workDoneToken` of the params.
    pub token: Option<Value>,
}

/// More segments than this are worth a worker; fewer are answered at once.
const SMALL: usize = 2_000;

/// −32803: refused for what the drawing is.
pub(super) fn refused(message: impl Into<String>) -> Error {
    Error { code: ErrorCode::ServerError(-32803), message: message.into().into(), data: None }
}

pub(super) fn refused_with(message: impl Into<String>, diagnostics: Vec<Diagnostic>) -> Error {
    let data = serde_json::to_value(Refused { diagnostics }).ok();
    Error { data, ..refused(message) }
}

pub(super) fn internal(message: impl Into<String>) -> Error {
    Error { code: ErrorCode::InternalError, message: message.into().into(), data: None }
}

pub(super) fn moved_on() -> Error {
    Error { code: ErrorCode::ContentModified, message: "the document has changed meanwhile".into(), data: None }
}

/// The result as JSON text.
pub(super) fn written(result: &impl Serialize) -> Result<Vec<u8>> {
    serde_json::to_vec(result).map_err(|error| internal(error.to_string()))
}

/// The drawing of an open document as it is now.
pub(super) fn snapshot_of(state: &mut State, uri: &str) -> Result<(Snapshot, u64)> {
    let open = state.document(uri)?;
    let stamp = open.stamp;
    let document = open.document().ok_or_else(|| refused(format!("{uri} holds no drawing")))?;
    let snapshot = document.snapshot().ok_or_else(|| refused(format!("{uri} is a program, expected a drawing")))?;
    Ok((snapshot, stamp))
}

pub(super) fn is_small(drawing: &Drawing) -> bool {
    let mut left = SMALL;
    drawing.entities().all(|(_, entity)| {
        let count = entity.geometry.segment_count().max(1);
        let fits = count <= left;
        left = left.saturating_sub(count);
        fits
    })
}

/// Where the findings of an open document's drawing stand.
pub(super) fn places_of(state: &mut State, uri: &str) -> Result<Places> {
    let encoding = state.encoding;
    let document = state.document(uri)?.document().ok_or_else(|| refused(format!("{uri} holds no drawing")))?;
    Ok(Places::of(document, encoding))
}

/// The request's own settings over those of the document, where it brings any.
pub(super) fn with_options(state: &mut State, uri: &str, options: Option<&Value>) -> Result<Option<Arc<Effective>>> {
    let Some(options) = options.filter(|options| !options.is_null()) else { return Ok(None) };
    let (settings, errors): (Settings, _) = from_json(options);
    if let Some(error) = errors.first() {
        return Err(Error::invalid_params(format!("options: {}", error.message)));
    }
    let file = state.file_for(uri);
    Ok(Some(Arc::new(Effective::of(&state.config.settings_for(file.as_deref()).overlaid(&settings)))))
}

/// A drawing and its contours, looked at anew where the request's options ask for it.
pub(super) struct Task {
    pub drawing: Arc<Drawing>,
    pub outlines: Arc<Vec<Outline>>,
    pub settings: Arc<Effective>,
}

impl Task {
    pub fn new(snapshot: Snapshot, options: Option<Arc<Effective>>) -> Task {
        let Snapshot { drawing, outlines, settings } = snapshot;
        let Some(settings) = options.filter(|options| *options != settings) else { return Task { drawing, outlines, settings } };
        let document = Document::new(Source::Cad(drawing.clone()), settings.clone());
        let outlines = document.snapshot().map_or(outlines, |snapshot| snapshot.outlines);
        Task { drawing, outlines, settings }
    }

    pub fn unit_mm(&self) -> f64 {
        self.settings.unit_of(&self.drawing).mm
    }

    /// The drawing as a document of its own, for findings under the task's settings.
    pub fn document(&self) -> Document {
        Document::new(Source::Cad(self.drawing.clone()), self.settings.clone())
    }
}

/// What `toolpath` refused, for the client.
pub(super) fn refusal(task: &Task, refusal: Refusal, places: &Places) -> Error {
    match refusal {
        Refusal::Sentence(sentence) => refused(sentence),
        Refusal::Findings(findings) => {
            let document = task.document();
            let diagnostics: Vec<_> = findings.iter().map(|finding| places.diagnostic(&document, finding)).collect();
            let first = diagnostics.first().map_or_else(|| "no path can be made".into(), |first| first.message.clone());
            refused_with(first, diagnostics)
        }
    }
}

/// Runs `work` at once when it is small, else on a worker; the result of a worker counts only when the document stands
/// as it was.
pub(super) fn run(
    state: &mut State,
    name: &'static str,
    uri: &str,
    (stamp, small): (u64, bool),
    errand: Errand,
    work: impl FnOnce(&Cancel, &Progress) -> Result<Vec<u8>> + Send + 'static,
) {
    let Errand { reply, cancel, token } = errand;
    let progress = Progress::begin(state.client.writer(), token, name);
    if small {
        let result = work(&cancel, &progress);
        drop(progress);
        let _ = reply.send(result);
        return;
    }
    let uri: Arc<str> = uri.into();
    let workers = state.workers.clone();
    workers.run(
        name,
        cancel,
        move |cancel| {
            let result = work(cancel, &progress);
            drop(progress);
            result
        },
        move |state, result| {
            let current = state.documents.get(&uri).is_some_and(|open| open.stamp == stamp);
            let _ = reply.send(match result {
                Err(panic) => Err(internal(format!("internal error: {panic}"))),
                Ok(_) if !current => Err(moved_on()),
                Ok(result) => result,
            });
        },
    );
}
