//! One file a request. Each runs on the state thread and hands what takes long to a worker.

pub(super) mod code_action;
pub(super) mod contours;
pub(super) mod drawing_edit;
pub(super) mod generate;
pub(super) mod inspect;
pub(super) mod language;
pub(super) mod locate;
pub(super) mod picture;
#[cfg(feature = "testing")]
pub(super) mod probe;
pub(super) mod scale;
pub(super) mod settings;
pub(super) mod simulate;
pub(super) mod toolpath;

use super::convert;
use super::jobs::{Cancel, Progress};
use super::state::{Reply, State};
use crate::document::{Document, Snapshot, Source};
use crate::drawing::{Drawing, Outline};
use crate::finding::{Finding, Rule, Severity};
use crate::message::readable;
use crate::protocol::{Diagnostic, Refused};
use crate::settings::{Effective, Settings, SettingsError, from_json};
use crate::text::Encoding;
use crate::toolpath::Refusal;
use ls_types::{
    DocumentChanges, OneOf, OptionalVersionedTextDocumentIdentifier, TextDocumentEdit, TextEdit,
    Uri, WorkspaceEdit,
};
use serde::Serialize;
use serde_json::Value;
use std::sync::Arc;
use tower_lsp::jsonrpc::{Error, ErrorCode, Result};

/// What every long request brings along beside its params.
pub(super) struct Errand<T = Vec<u8>> {
    pub reply: Reply<T>,
    pub cancel: Cancel,
    /// `workDoneToken` of the params.
    pub token: Option<Value>,
}

/// More segments than this are worth a worker; fewer are answered at once.
const SMALL: usize = 2_000;

/// −32803: refused for what the drawing is.
pub(super) fn refused(message: impl Into<String>) -> Error {
    Error {
        code: ErrorCode::ServerError(-32803),
        message: readable(&message.into()).into_owned().into(),
        data: None,
    }
}

pub(super) fn refused_with(message: impl Into<String>, diagnostics: Vec<Diagnostic>) -> Error {
    let data = serde_json::to_value(Refused { diagnostics }).ok();
    Error {
        data,
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
        message: "the document has changed meanwhile".into(),
        data: None,
    }
}

/// The result as JSON text.
pub(super) fn written(result: &impl Serialize) -> Result<Vec<u8>> {
    serde_json::to_vec(result).map_err(|error| internal(error.to_string()))
}

/// A drawing as it stands now, to be looked at from any thread.
pub(super) struct Subject {
    pub document: Arc<Document>,
    pub stamp: u64,
    /// Little enough to be looked at here and now.
    pub small: bool,
}

pub(super) fn subject_of(state: &mut State, uri: &str) -> Result<Subject> {
    let open = state.document(uri)?;
    let document = open
        .document()
        .ok_or_else(|| refused(format!("{uri} holds no drawing")))?
        .clone();
    let drawing = document
        .drawing()
        .ok_or_else(|| refused(format!("{uri} is a program, expected a drawing")))?;
    let small = is_small(drawing) && open.findings <= SMALL;
    Ok(Subject {
        stamp: open.stamp,
        small,
        document,
    })
}

/// A program as it stands now, to be looked at from any thread.
pub(super) fn program_of(state: &mut State, uri: &str) -> Result<Subject> {
    let open = state.document(uri)?;
    let document = open
        .document()
        .ok_or_else(|| refused(format!("{uri} holds no program")))?
        .clone();
    if document.program().is_none() {
        return Err(refused(format!("{uri} is a drawing, expected a program")));
    }
    let small = document
        .text()
        .is_none_or(|text| text.line_count() <= SMALL);
    Ok(Subject {
        stamp: open.stamp,
        small,
        document,
    })
}

fn is_small(drawing: &Drawing) -> bool {
    let mut left = SMALL;
    drawing.entities().all(|(_, entity)| {
        let count = entity.geometry.segment_count().max(1);
        let fits = count <= left;
        left = left.saturating_sub(count);
        fits
    })
}

/// The request's own settings over those of the document, where it brings any.
pub(super) fn with_options(
    state: &mut State,
    uri: &str,
    options: Option<&Value>,
) -> Result<Option<Arc<Effective>>> {
    let Some(options) = options.filter(|options| !options.is_null()) else {
        return Ok(None);
    };
    let (settings, errors): (Settings, _) = from_json(options);
    if let Some(error) = errors.iter().find(|error| error.rule == Rule::Settings) {
        return Err(Error::invalid_params(format!("options: {}", error.message)));
    }
    let file = state.file_for(uri);
    let of_document = state.config.settings_for(file.as_deref());
    let all = of_document.overlaid(&settings);
    let is_error = |error: &SettingsError| error.severity == Severity::Error;
    // What is wrong without the options is said elsewhere.
    if let Some(error) = all
        .pass_errors(&|_| None)
        .iter()
        .find(|error| is_error(error))
        && !of_document.pass_errors(&|_| None).iter().any(is_error)
    {
        return Err(Error::invalid_params(format!("options: {}", error.message)));
    }
    Ok(Some(Arc::new(Effective::of(&all))))
}

/// A document as one request looks at it: under its own options, where it brings any.
pub(super) struct Task {
    /// As it is open: findings have their places here.
    pub subject: Arc<Document>,
    /// Under the options.
    pub document: Arc<Document>,
    pub drawing: Arc<Drawing>,
    pub outlines: Arc<Vec<Outline>>,
    pub settings: Arc<Effective>,
}

impl Task {
    /// Errors: the document is a program.
    pub fn new(subject: Arc<Document>, options: Option<Arc<Effective>>) -> Result<Task> {
        let under_options = options
            .filter(|options| options != subject.settings())
            .and_then(|options| {
                let drawing = subject.drawing()?.clone();
                Some(Arc::new(Document::new(Source::Cad(drawing), options)))
            });
        let document = under_options.unwrap_or_else(|| subject.clone());
        let Snapshot {
            drawing,
            outlines,
            settings,
        } = document
            .snapshot()
            .ok_or_else(|| refused("the document is a program, expected a drawing"))?;
        Ok(Task {
            subject,
            document,
            drawing,
            outlines,
            settings,
        })
    }

    pub fn unit_mm(&self) -> f64 {
        self.settings.unit_of(&self.drawing).mm
    }

    /// All findings under the task's settings; of the rules alone where the options made a document without its text.
    pub fn findings(&self) -> Vec<Finding> {
        self.document.all_findings().to_vec()
    }
}

/// Where an edit of a text goes.
pub(super) struct Target {
    pub uri: Uri,
    pub version: i64,
    pub encoding: Encoding,
    pub document_changes: bool,
    pub shows_related: bool,
    /// Actions that cannot be done are shown with their reason.
    pub shows_disabled: bool,
}

impl Target {
    pub fn of(state: &mut State, uri: &Uri) -> Result<Target> {
        let abilities = &state.client.abilities;
        let (document_changes, shows_related) =
            (abilities.document_changes, abilities.related_information);
        let shows_disabled = abilities.disabled_actions;
        let encoding = state.encoding;
        let version = state.document(uri.as_str())?.version;
        Ok(Target {
            uri: uri.clone(),
            version,
            encoding,
            document_changes,
            shows_related,
            shows_disabled,
        })
    }
}

/// Edits of one text in the form that the client takes.
pub(super) fn workspace_edit(target: &Target, edits: Vec<TextEdit>) -> WorkspaceEdit {
    if !target.document_changes {
        return WorkspaceEdit {
            changes: Some([(target.uri.clone(), edits)].into()),
            ..WorkspaceEdit::default()
        };
    }
    let version = i32::try_from(target.version).ok();
    let text_document = OptionalVersionedTextDocumentIdentifier {
        uri: target.uri.clone(),
        version,
    };
    let edits = edits.into_iter().map(OneOf::Left).collect();
    let changes = DocumentChanges::Edits(vec![TextDocumentEdit {
        text_document,
        edits,
    }]);
    WorkspaceEdit {
        document_changes: Some(changes),
        ..WorkspaceEdit::default()
    }
}

/// What `toolpath` refused, for the client.
pub(super) fn refusal(task: &Task, refusal: Refusal, encoding: Encoding) -> Error {
    match refusal {
        Refusal::Sentence(sentence) => refused(sentence),
        Refusal::Cancelled => Error::request_cancelled(),
        Refusal::Findings(findings) => {
            let diagnostics = convert::diagnostics(&task.subject, &findings, encoding);
            let first = diagnostics.first().map_or_else(
                || "no path can be made".into(),
                |first| first.message.clone(),
            );
            refused_with(first, diagnostics)
        }
    }
}

/// Runs `work` at once when it is small, else on a worker; the result of a worker counts only when the document stands
/// as it was.
pub(super) fn run<T: Send + 'static>(
    state: &mut State,
    name: &'static str,
    uri: &str,
    (stamp, small): (u64, bool),
    errand: Errand<T>,
    work: impl FnOnce(&Cancel, &Progress) -> Result<T> + Send + 'static,
) {
    let Errand {
        reply,
        cancel,
        token,
    } = errand;
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
            let current = state
                .documents
                .get(&uri)
                .is_some_and(|open| open.stamp == stamp);
            let _ = reply.send(match result {
                Err(panic) => Err(internal(format!("internal error: {panic}"))),
                Ok(_) if !current => Err(moved_on()),
                Ok(result) => result,
            });
        },
    );
}
