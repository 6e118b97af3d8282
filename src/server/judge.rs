//! Makes a document's pending changes, and judges it: small work at once, the rest on a worker, so that no
//! document waits for another.

use super::changes;
use super::content::{Content, Remains, is_small_drawing, is_small_text};
use super::kind::Kind;
use super::transport::Written;
use crate::compare::{Beside, Form};
use crate::drawing::Drawing;
use crate::protocol::DrawingChange;
use crate::settings::Effective;
use crate::text::{Encoding, SourceText};
use ls_types::TextDocumentContentChangeEvent;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A pending change of a document.
pub(super) enum Task {
    /// The document is now this text.
    Text { kind: Kind, text: String },
    /// The document is now this drawing.
    Drawing(Box<Drawing>),
    /// The client has changed its text.
    Change {
        version: i64,
        changes: Vec<TextDocumentContentChangeEvent>,
    },
    /// The client has changed its drawing.
    ChangeDrawing {
        version: i64,
        changes: Vec<DrawingChange>,
    },
    /// Other settings hold for it.
    Settings,
    /// The derived data are in doubt.
    Rebuild,
    /// The documents beside it may have changed or been replaced.
    Beside,
    /// It has been read and shown: what its first edit needs is to be prepared.
    Ready,
}

/// A document whose pending changes are being made.
pub(super) struct Job {
    pub(crate) uri: Arc<str>,
    pub(crate) version: i64,
    pub(crate) content: Content,
    pub(crate) tasks: Vec<Task>,
    pub(crate) settings: Arc<Effective>,
    pub(crate) encoding: Encoding,
    /// The client shows the other places of a finding.
    pub(crate) shows_related: bool,
    /// The last judging took long.
    pub(crate) is_slow: bool,
    pub(crate) beside: Beside,
    /// Other documents are compared with it.
    pub(crate) wants_form: bool,
    /// It has its form already.
    pub(crate) has_form: bool,
}

/// The result.
pub(super) struct Judged {
    pub(crate) uri: Arc<str>,
    pub(crate) version: i64,
    pub(crate) content: Content,
    /// The findings for the client and how many there are in all; `None` where nothing has changed.
    pub(crate) told: Option<(Written, usize)>,
    /// Judging took long.
    pub(crate) is_slow: bool,
    /// It is another text or drawing than before, or under other settings.
    pub(crate) is_other: bool,
    /// The data for comparing others with it, where they are wanted and may have changed.
    pub(crate) form: Option<Form>,
    /// For the client's log.
    pub(crate) remarks: Vec<String>,
    /// Why changes of a drawing failed.
    pub(crate) refused: Vec<String>,
}

/// The most changes, in one message and in all, that are made at once.
const FEW: usize = 16;

/// Judging that takes longer than this is long: waiting changes are then made together.
const LONG: Duration = Duration::from_millis(100);

impl Job {
    /// True where there is little to do, whatever the document contains.
    pub(crate) fn is_small(&self) -> bool {
        let kind = self.kind();
        let is_small_text = |text: &[u8]| is_small_text(kind, text);
        let is_small_task = |task: &Task| match task {
            Task::Text { text, .. } => is_small_text(text.as_bytes()),
            Task::Drawing(drawing) => is_small_drawing(drawing),
            Task::Change { changes, .. } => {
                changes.len() <= FEW
                    && changes
                        .iter()
                        .all(|change| is_small_text(change.text.as_bytes()))
            }
            Task::ChangeDrawing { changes, .. } => changes.len() <= FEW,
            Task::Settings | Task::Rebuild | Task::Beside | Task::Ready => true,
        };
        self.content.is_small() && self.tasks.len() <= FEW && self.tasks.iter().all(is_small_task)
    }

    /// True where all of the document is read, which leaves memory behind.
    pub(crate) fn reads(&self) -> bool {
        let is_whole =
            |task: &Task| matches!(task, Task::Text { .. } | Task::Drawing(_) | Task::Rebuild);
        self.tasks.iter().any(is_whole)
    }

    fn kind(&self) -> Kind {
        let of_task = |task: &Task| match task {
            Task::Text { kind, .. } => Some(*kind),
            _ => None,
        };
        let newest = self.tasks.iter().rev().find_map(of_task);
        newest.unwrap_or_else(|| self.content.kind())
    }

    pub(crate) fn run(self) -> Judged {
        let began = Instant::now();
        let Job {
            uri,
            mut version,
            mut content,
            tasks,
            settings,
            encoding,
            shows_related,
            is_slow,
            beside,
            wants_form,
            has_form,
        } = self;
        let (mut remarks, mut refused) = (Vec::new(), Vec::new());
        let changes = tasks
            .iter()
            .filter(|task| matches!(task, Task::Change { .. } | Task::ChangeDrawing { .. }))
            .count();
        if is_slow && changes > 1 {
            // All of them are judged once, not one by one.
            content.forget();
        }
        // Without a change it is only published.
        let mut is_changed = tasks.is_empty();
        let mut is_other = false;
        for task in tasks {
            let refusals = refused.len();
            match task {
                Task::Text { kind, text } => {
                    content = Content::Unread(Remains::Text {
                        kind,
                        text: SourceText::new(SourceText::with_room(text.into_bytes())),
                    })
                }
                Task::Drawing(drawing) => {
                    content = Content::Unread(Remains::Drawing(Arc::new(*drawing)))
                }
                Task::Change {
                    version: newer,
                    changes,
                } => {
                    if newer < version {
                        remarks.push(say!(was_changed_to_an_older_version, uri, newer, version));
                    }
                    version = version.max(newer);
                    changes::make(&mut content, changes, encoding);
                }
                Task::ChangeDrawing { version: newer, .. } if newer <= version => {
                    refused.push(say!(version_is_not_newer_than, newer, version));
                }
                Task::ChangeDrawing {
                    version: newer,
                    changes,
                } => match content.change_drawing(changes) {
                    Ok(()) => version = newer,
                    Err(reason) => refused.push(reason),
                },
                Task::Settings => content.set_settings(&settings),
                Task::Rebuild => content.forget(),
                Task::Beside => continue,
                Task::Ready => {
                    content.make_ready();
                    continue;
                }
            }
            is_changed |= refused.len() == refusals;
            is_other = true;
        }
        // A text or drawing that a panic has left unread is read again.
        is_changed |= matches!(content, Content::Unread(_));
        is_other |= matches!(content, Content::Unread(_));
        content.read(&settings);
        is_changed |= content.set_beside(beside);
        let is_asked = wants_form && (is_other || !has_form);
        let form = if is_asked { content.form() } else { None };
        let related_of = shows_related.then_some(&*uri);
        let told = is_changed.then(|| content.diagnostics(encoding, related_of, &settings));
        Judged {
            version,
            content,
            told,
            is_slow: began.elapsed() > LONG,
            remarks,
            refused,
            is_other,
            form,
            uri,
        }
    }
}
