//! A request about an open document: the data it reads, whether its answer is still wanted, and where it is answered.

use super::client::Abilities;
use super::config::{self, ProjectFile};
use super::content::Content;
use super::convert::{lsp_edits, lsp_range, range_of};
use super::errors::{internal, moved_on, refused};
use super::jobs::Progress;
use super::state::{Reply, State};
use super::token_memory::TokenMemory;
use super::transport::panic_text;
use crate::document::{self, Document, Source};
use crate::dxf;
use crate::finding::Severity;
use crate::ide::Whole;
use crate::ide::dxf::{Name, name_at};
use crate::program;
use crate::settings::{Effective, FILE_NAME, SettingsError, from_json};
use crate::text::{Encoding, SourceText, TextEdit};
use ls_types::request::{CodeActionRequest, Request};
use ls_types::{
    CreateFile, CreateFileOptions, DocumentChangeOperation, DocumentChanges, OneOf,
    OptionalVersionedTextDocumentIdentifier, Position, Range, ResourceOp, TextDocumentEdit, Uri,
    WorkspaceEdit,
};
use serde_json::Value;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Weak};
use tower_lsp::jsonrpc::{Error, Result};

/// The part of its document that a request holds while it is answered. An edit meanwhile copies that part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reach {
    /// The document, for a question about one place: it does not wait behind long work.
    Place,
    /// The document, for work that may be long.
    Document,
    /// The document, for work that is long however small the document is.
    Long,
    /// A program, or for DXF only the text: editors ask about the whole of it after every edit.
    Text,
    /// The same, and the contours of the drawing.
    Outline,
}

/// The common params of requests about a document.
#[derive(Default)]
pub(super) struct About {
    pub(crate) uri: Arc<str>,
    pub(crate) position: Option<Position>,
    /// Settings for this request alone.
    pub(crate) options: Option<Value>,
    /// The token for progress.
    pub(crate) token: Option<Value>,
}

/// A request in progress: its name for the log, and for the user where progress is shown.
pub(super) struct Asked {
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
    pub(crate) reach: Reach,
    pub(crate) about: About,
    /// Gone when the client has cancelled the request.
    pub(crate) client: Weak<()>,
}

impl Asked {
    /// Whether its answer hangs on the project's file as it is now: settings of its own lie over those, and actions edit it.
    fn needs_file(&self) -> bool {
        let options = self.about.options.as_ref();
        options.is_some_and(|options| !options.is_null()) || self.name == CodeActionRequest::METHOD
    }
}

/// More findings than this go to a worker.
const FEW_FINDINGS: usize = 2_000;

/// The argument of a handler: the document as it stood when the request's turn came.
pub(super) struct RequestContext {
    pub(crate) uri: Arc<str>,
    pub(crate) version: i64,
    /// Differs after every change.
    pub(crate) stamp: u64,
    pub(crate) encoding: Encoding,
    pub(crate) abilities: Arc<Abilities>,
    pub(crate) progress: Progress,
    /// The semantic tokens that the client holds.
    pub(crate) tokens: Arc<TokenMemory>,
    held: Held,
    /// The file with the settings of the document; only set for its actions.
    settings_file: Option<SettingsFile>,
    options: Result<Option<Arc<Effective>>>,
    wanted: Wanted,
}

/// The `wedm.toml` that applies to a document, or the one that would.
pub(super) struct SettingsFile {
    uri: Uri,
    pub(crate) text: SourceText,
    is_new: bool,
}

enum Held {
    Document(Arc<Document>),
    Text {
        text: SourceText,
        /// The name at the place that is asked about.
        name: Option<Name>,
        snapshot: Option<document::Snapshot>,
    },
    /// Neither drawing nor program.
    Nothing,
}

/// Whether an answer is still wanted: the client waits for it, and the document is unchanged.
#[derive(Clone)]
struct Wanted {
    client: Weak<()>,
    revision: Weak<()>,
}

impl Wanted {
    fn check(&self) -> Result<()> {
        if self.client.strong_count() == 0 {
            Err(Error::request_cancelled())
        } else if self.revision.strong_count() == 0 {
            Err(moved_on())
        } else {
            Ok(())
        }
    }
}

impl State {
    /// Answers a request by `work`: at once where the document is small, else on a worker. An answer about a document
    /// that has changed in the meantime is dropped.
    pub(crate) fn answer<T: Send + 'static>(
        &mut self,
        asked: Asked,
        reply: Reply<T>,
        work: impl FnOnce(&RequestContext) -> Result<T> + Send + 'static,
    ) {
        if !asked.needs_file() {
            return self.answer_with(None, asked, reply, work);
        }
        let uri = asked.about.uri.clone();
        self.with_file(asked.name, uri, move |state, file| {
            state.answer_with(file.as_deref(), asked, reply, work);
        });
    }

    fn answer_with<T: Send + 'static>(
        &mut self,
        file: Option<&ProjectFile>,
        asked: Asked,
        reply: Reply<T>,
        work: impl FnOnce(&RequestContext) -> Result<T> + Send + 'static,
    ) {
        let (name, reach) = (asked.name, asked.reach);
        let (context, is_small) = match RequestContext::new(self, asked, file) {
            Ok(context) => context,
            Err(error) => {
                let _ = reply.send(Err(error));
                return;
            }
        };
        if is_small {
            let result = work(&context);
            drop(context);
            let _ = reply.send(result);
            return;
        }
        let wanted = context.wanted.clone();
        let is_wanted = {
            let wanted = wanted.clone();
            move || wanted.client.strong_count() > 0
        };
        self.workers.run(reach == Reach::Place, is_wanted, move || {
            let result = wanted.check().and_then(|()| {
                catch_unwind(AssertUnwindSafe(|| work(&context))).unwrap_or_else(|panic| {
                    let text = panic_text(&*panic);
                    tracing::error!("{name} panicked: {text}");
                    Err(internal(say!(internal_error, text)))
                })
            });
            // Progress ends before the answer comes.
            drop(context);
            let _ = reply.send(wanted.check().and(result));
        });
    }
}

impl RequestContext {
    /// And whether the document is small enough to answer at once.
    fn new(
        state: &mut State,
        asked: Asked,
        file: Option<&ProjectFile>,
    ) -> Result<(RequestContext, bool)> {
        let Asked {
            name,
            title,
            reach,
            about,
            client,
            ..
        } = asked;
        let options = with_options(state, &about.uri, about.options.as_ref(), file);
        let (encoding, abilities) = (state.encoding, state.client.abilities.clone());
        let progress = Progress::begin(state.client.writer(), about.token, title);
        let settings_file = if name == CodeActionRequest::METHOD {
            SettingsFile::of(&about.uri, file)
        } else {
            None
        };
        let open = state.document(&about.uri)?;
        if matches!(open.content, Content::Lost(_)) {
            return Err(moved_on());
        }
        let is_small =
            reach != Reach::Long && open.content.is_small() && open.findings <= FEW_FINDINGS;
        let context = RequestContext {
            uri: open.uri.clone(),
            version: open.version,
            stamp: open.stamp,
            encoding,
            abilities,
            progress,
            tokens: open.tokens.clone(),
            held: open.document().map_or(Held::Nothing, |document| {
                Held::of(document, reach, about.position, encoding)
            }),
            settings_file,
            options,
            wanted: Wanted {
                client,
                revision: open.revision(),
            },
        };
        Ok((context, is_small))
    }

    /// True when the result is no longer wanted.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.check().is_err()
    }

    /// The error for that.
    pub(crate) fn check(&self) -> Result<()> {
        self.wanted.check()
    }

    /// Drawing or program.
    pub(crate) fn document(&self) -> Option<&Arc<Document>> {
        match &self.held {
            Held::Document(document) => Some(document),
            Held::Text { .. } | Held::Nothing => None,
        }
    }

    pub(crate) fn program(&self) -> Option<&program::Document> {
        self.document()?.program()
    }

    /// The document, where it has a text.
    pub(crate) fn document_and_text(&self) -> Option<(&Document, &SourceText)> {
        let document = self.document()?;
        Some((document, document.text()?))
    }

    pub(crate) fn dxf(&self) -> Option<&dxf::Document> {
        match self.document()?.source() {
            Source::Dxf(dxf) => Some(dxf),
            Source::Cad(_) | Source::Program(_) => None,
        }
    }

    /// The text, for a question about the whole of it.
    pub(crate) fn whole(&self) -> Option<Whole<'_>> {
        match &self.held {
            Held::Text {
                text,
                name,
                snapshot,
            } => Some(Whole::Dxf {
                text,
                name: name.as_ref(),
                snapshot: snapshot.as_ref(),
            }),
            Held::Document(document) => document.program().map(Whole::Program),
            Held::Nothing => None,
        }
    }

    /// A document that holds a drawing.
    pub(crate) fn drawn(&self) -> Result<&Arc<Document>> {
        let document = self
            .document()
            .ok_or_else(|| refused(say!(holds_no_drawing, self.uri)))?;
        match document.drawing() {
            Some(_) => Ok(document),
            None => Err(refused(say!(is_a_program_expected_a_drawing, self.uri))),
        }
    }

    /// The settings of the document with the request's own over them, if any.
    pub(crate) fn options(&self) -> Result<Option<Arc<Effective>>> {
        self.options.clone()
    }

    pub(crate) fn offset(&self, text: &SourceText, position: Position) -> usize {
        text.offset_of(
            position.line as usize,
            position.character as usize,
            self.encoding,
        )
    }

    pub(crate) fn range(&self, text: &SourceText, bytes: std::ops::Range<usize>) -> Range {
        lsp_range(range_of(text, bytes, self.encoding))
    }

    pub(crate) fn lsp_uri(&self) -> Result<Uri> {
        self.uri
            .parse()
            .map_err(|_| Error::invalid_params(say!(is_no_uri, self.uri)))
    }

    pub(crate) fn settings_file(&self) -> Option<&SettingsFile> {
        self.settings_file.as_ref()
    }

    /// Edits of the settings file in the form that the client accepts; `None` where it cannot make a new one.
    pub(crate) fn settings_edit(
        &self,
        file: &SettingsFile,
        edits: Vec<TextEdit>,
    ) -> Option<WorkspaceEdit> {
        let edits = lsp_edits(&file.text, edits, self.encoding);
        let uri = file.uri.clone();
        if !file.is_new && !self.abilities.document_changes {
            return Some(WorkspaceEdit {
                changes: Some([(uri, edits)].into()),
                ..WorkspaceEdit::default()
            });
        }
        let change = TextDocumentEdit {
            text_document: OptionalVersionedTextDocumentIdentifier {
                uri: uri.clone(),
                version: None,
            },
            edits: edits.into_iter().map(OneOf::Left).collect(),
        };
        let changes = if !file.is_new {
            DocumentChanges::Edits(vec![change])
        } else if self.abilities.create_files {
            let options = CreateFileOptions {
                overwrite: Some(false),
                ignore_if_exists: Some(true),
            };
            let create = CreateFile {
                uri,
                options: Some(options),
                annotation_id: None,
            };
            DocumentChanges::Operations(vec![
                DocumentChangeOperation::Op(ResourceOp::Create(create)),
                DocumentChangeOperation::Edit(change),
            ])
        } else {
            return None;
        };
        Some(WorkspaceEdit {
            document_changes: Some(changes),
            ..WorkspaceEdit::default()
        })
    }

    /// Edits of the document's text in the form that the client accepts.
    pub(crate) fn workspace_edit(
        &self,
        text: &SourceText,
        edits: Vec<TextEdit>,
    ) -> Result<WorkspaceEdit> {
        let edits = lsp_edits(text, edits, self.encoding);
        let uri = self.lsp_uri()?;
        if !self.abilities.document_changes {
            return Ok(WorkspaceEdit {
                changes: Some([(uri, edits)].into()),
                ..WorkspaceEdit::default()
            });
        }
        let change = TextDocumentEdit {
            text_document: OptionalVersionedTextDocumentIdentifier {
                uri,
                version: i32::try_from(self.version).ok(),
            },
            edits: edits.into_iter().map(OneOf::Left).collect(),
        };
        Ok(WorkspaceEdit {
            document_changes: Some(DocumentChanges::Edits(vec![change])),
            ..WorkspaceEdit::default()
        })
    }
}

impl SettingsFile {
    fn of(uri: &str, found: Option<&ProjectFile>) -> Option<SettingsFile> {
        let path = match found {
            Some(file) => file.path.clone(),
            None => config::path_of(uri)?.parent()?.join(FILE_NAME),
        };
        Some(SettingsFile {
            uri: config::uri_of(&path)?.parse().ok()?,
            text: found.map_or_else(|| SourceText::new(Vec::new()), |file| file.text.clone()),
            is_new: found.is_none(),
        })
    }
}

impl Held {
    fn of(
        document: &Arc<Document>,
        reach: Reach,
        position: Option<Position>,
        encoding: Encoding,
    ) -> Held {
        match (document.source(), reach) {
            (Source::Dxf(dxf), Reach::Text | Reach::Outline) => {
                let offset = |at: Position| {
                    dxf.text()
                        .offset_of(at.line as usize, at.character as usize, encoding)
                };
                Held::Text {
                    text: dxf.text().clone(),
                    name: position.and_then(|at| Some(name_at(dxf, offset(at))?.0)),
                    snapshot: (reach == Reach::Outline)
                        .then(|| document.snapshot())
                        .flatten(),
                }
            }
            _ => Held::Document(document.clone()),
        }
    }
}

/// The request's own settings over those of the document, if any.
fn with_options(
    state: &State,
    uri: &str,
    options: Option<&Value>,
    file: Option<&ProjectFile>,
) -> Result<Option<Arc<Effective>>> {
    let Some(options) = options.filter(|options| !options.is_null()) else {
        return Ok(None);
    };
    let misfit =
        |error: &SettingsError| Err(Error::invalid_params(format!("options: {}", error.message)));
    let (settings, errors) = from_json(options);
    if let Some(error) = errors.iter().find(|error| !error.of_levels) {
        return misfit(error);
    }
    let of_document = state.config.settings_for(file);
    let all = of_document.overlaid(&settings);
    let is_error = |error: &&SettingsError| error.severity == Severity::Error;
    // Faults that do not come from the options are reported elsewhere.
    let is_wrong_already = || {
        of_document
            .contradictions(&|_| None)
            .iter()
            .any(|error| is_error(&error))
    };
    match all.contradictions(&|_| None).iter().find(is_error) {
        Some(error) if !is_wrong_already() => misfit(error),
        _ => Ok(Some(Arc::new(Effective {
            origins: state.config.origins(file, Some(&settings)),
            ..Effective::of_document(&all, config::name_of(uri))
        }))),
    }
}
