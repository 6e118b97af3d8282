//! The table of methods, and the framework's face: every handler hands its message to the state thread before its first
//! wait, and does nothing else.

use super::client::Weight;
use super::context::{About, Asked, Reach, RequestContext};
use super::drawings::{self, Sent, SentChanges};
use super::errors::internal;
use super::handlers::*;
use super::state::{Mailbox, Reply, State};
use super::transport::Written;
use super::{parent, texts};
use crate::protocol::RulePageText;
use crate::protocol::method::{Message, SCALE_COMMAND, messages};
use crate::rule::Rule;
use ls_types::request::*;
use ls_types::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use tower_lsp::jsonrpc::{Error, Result};
use tower_lsp::{LanguageServer, LspService, LspServiceBuilder};

/// A request about an open document. Its result leaves as text, whatever its size.
struct Method<P, R> {
    name: &'static str,
    /// The title of its progress.
    title: &'static str,
    reach: Reach,
    handler: fn(&RequestContext, P) -> Result<R>,
}

/// Requests of LSP: method of the framework's trait, request, what its handler holds of the document, handler.
macro_rules! requests {
    ($($name:ident: $request:ty, $reach:ident $(, $title:ident)? => $handler:path;)*) => {$(
        async fn $name(
            &self,
            params: <$request as Request>::Params,
        ) -> Result<<$request as Request>::Result> {
            let method = Method {
                name: <$request>::METHOD,
                title: ["" $(, say!($title))?].last().copied().unwrap_or_default(),
                reach: Reach::$reach,
                handler: $handler,
            };
            self.answer(method, About::from(&params), params).await
        }
    )*};
}

/// Requests of the name space `wedm/`: name, message, what the handler holds, title of the progress, handler. What a
/// handler takes and answers are the types of the published schema.
macro_rules! own_requests {
    ($($name:ident: $message:ident, $reach:ident, $title:ident => $handler:path;)*) => {
        impl Backend {$(
            async fn $name(&self, params: Value) -> Result<Value> {
                let (params, about) = read(params)?;
                let method = Method::<
                    <messages::$message as Message>::Params,
                    <messages::$message as Message>::Answer,
                > {
                    name: messages::$message::NAME,
                    title: say!($title),
                    reach: Reach::$reach,
                    handler: $handler,
                };
                self.answer(method, about, params).await
            }
        )*}

        fn with_own_requests(build: LspServiceBuilder<Backend>) -> LspServiceBuilder<Backend> {
            build$(.custom_method(messages::$message::NAME, Backend::$name))*
        }
    };
}

own_requests! {
    inspect: Inspect, Document, listing_radii => inspect::inspect;
    contours: Contours, Document, listing_contours => contours::contours;
    toolpath: Toolpath, Document, laying_the_wires_path => toolpath::toolpath;
    picture: Picture, Document, drawing_the_picture => picture::picture;
    export: Export, Document, drawing_the_picture => picture::export;
    holes: Holes, Document, laying_the_wires_path => toolpath::holes;
    repairs: Repairs, Document, looking_for_fixes => picture::repairs;
    generate: Generate, Long, generating_the_program => generate::generate;
    fit: Fit, Document, holding_the_parts_in_each_other => pair::fit;
    pair: Pair, Long, generating_the_programs => pair::pair;
    simulate: Simulate, Document, following_the_program => simulate::simulate;
    locate: Locate, Place, locating => locate::locate;
}

impl LanguageServer for Backend {
    requests! {
        hover: HoverRequest, Place => hover::hover;
        completion: Completion, Place => completion::completion;
        signature_help: SignatureHelpRequest, Place => signature::signature_help;
        selection_range: SelectionRangeRequest, Place => selection::selection_range;
        inlay_hint: InlayHintRequest, Place => hints::inlay_hint;
        prepare_rename: PrepareRenameRequest, Place => rename::prepare;
        rename: Rename, Document => rename::rename;
        goto_definition: GotoDefinition, Text => navigation::definition;
        references: References, Text => navigation::references;
        document_highlight: DocumentHighlightRequest, Text => navigation::highlight;
        document_symbol: DocumentSymbolRequest, Outline => symbols::document_symbol;
        folding_range: FoldingRangeRequest, Text => folding::folding_range;
        code_lens: CodeLensRequest, Text => lenses::code_lens;
        semantic_tokens_full: SemanticTokensFullRequest, Text => tokens::full;
        semantic_tokens_full_delta: SemanticTokensFullDeltaRequest, Text => tokens::delta;
        semantic_tokens_range: SemanticTokensRangeRequest, Place => tokens::range;
        formatting: Formatting, Text => formatting::whole;
        range_formatting: RangeFormatting, Text => formatting::range;
        on_type_formatting: OnTypeFormatting, Place => formatting::left_line;
        code_action: CodeActionRequest, Document, looking_for_fixes => code_action::code_action;
        code_action_resolve: CodeActionResolveRequest, Document, looking_for_fixes => code_action::resolve;
    }

    async fn initialize(&self, params: InitializeParams) -> Result<InitializeResult> {
        if let (Some(orphaned), Some(pid)) = (self.orphaned, params.process_id) {
            parent::watch(pid, orphaned);
        }
        self.ask(Initialize::METHOD, None, move |state, reply| {
            let _ = reply.send(lifecycle::initialize(state, params));
        })
        .await
    }

    async fn initialized(&self, _: InitializedParams) {
        self.tell("initialized", None, lifecycle::initialized);
    }

    async fn shutdown(&self) -> Result<()> {
        self.flags.shut_down.store(true, Ordering::Release);
        Ok(())
    }

    async fn did_open(&self, params: DidOpenTextDocumentParams) {
        let TextDocumentItem {
            uri,
            language_id,
            version,
            text,
        } = params.text_document;
        let uri: Arc<str> = uri.as_str().into();
        self.tell("textDocument/didOpen", Some(uri.clone()), move |state| {
            texts::open(state, uri, &language_id, version.into(), text);
        });
    }

    async fn did_change(&self, params: DidChangeTextDocumentParams) {
        let uri: Arc<str> = params.text_document.uri.as_str().into();
        let version = params.text_document.version.into();
        self.tell_change("textDocument/didChange", uri.clone(), move |state| {
            texts::change(state, &uri, version, params.content_changes);
        });
    }

    async fn did_save(&self, params: DidSaveTextDocumentParams) {
        // A project's file may be new on disk, and so may partners of documents; not every client watches files.
        let uri = params.text_document.uri;
        let of_settings = uri.as_str().ends_with(crate::settings::FILE_NAME);
        self.tell("textDocument/didSave", None, move |state| {
            if of_settings {
                state.settings_changed();
            }
            state.ask_all_beside();
        });
    }

    async fn did_close(&self, params: DidCloseTextDocumentParams) {
        let uri: Arc<str> = params.text_document.uri.as_str().into();
        self.tell("textDocument/didClose", Some(uri.clone()), move |state| {
            texts::close(state, &uri)
        });
    }

    async fn did_change_configuration(&self, params: DidChangeConfigurationParams) {
        self.tell("workspace/didChangeConfiguration", None, move |state| {
            state.configuration_changed(&params.settings)
        });
    }

    async fn did_change_watched_files(&self, params: DidChangeWatchedFilesParams) {
        let of_settings = |uri: &str| uri.ends_with(crate::settings::FILE_NAME);
        let changes = &params.changes;
        let (settings, others) = (
            changes.is_empty() || changes.iter().any(|one| of_settings(one.uri.as_str())),
            changes.iter().any(|one| !of_settings(one.uri.as_str())),
        );
        self.tell("workspace/didChangeWatchedFiles", None, move |state| {
            if settings {
                state.settings_changed();
            }
            if others {
                state.ask_all_beside();
            }
        });
    }

    async fn did_change_workspace_folders(&self, params: DidChangeWorkspaceFoldersParams) {
        self.tell("workspace/didChangeWorkspaceFolders", None, move |state| {
            state.folders_changed(&params.event)
        });
    }

    async fn execute_command(&self, params: ExecuteCommandParams) -> Result<Option<LSPAny>> {
        if params.command != SCALE_COMMAND {
            let edit = commands::drawing_edit(&params.command, params.arguments)?;
            let about = Some(edit.uri.as_str().into());
            return self
                .ask(ExecuteCommand::METHOD, about, move |state, reply| {
                    commands::apply_drawing_edit(state, edit, reply)
                })
                .await;
        }
        let factor = commands::scale_program(params.arguments)?;
        let scaling = Method {
            name: ExecuteCommand::METHOD,
            title: "",
            reach: Reach::Document,
            handler: commands::scaled,
        };
        let about = About {
            uri: factor.uri.as_str().into(),
            ..About::default()
        };
        let edit = self
            .perform(scaling, about, factor, |result| result)
            .await?;
        self.ask(ExecuteCommand::METHOD, None, move |state, reply| {
            commands::apply_edit(state, edit, reply)
        })
        .await
    }
}

/// What the handlers share with the transport.
#[derive(Default)]
pub(super) struct Flags {
    /// `shutdown` was answered: the exit code is 0.
    pub(crate) shut_down: AtomicBool,
    /// Notifications that reached their handler.
    pub(crate) taken: AtomicUsize,
}

pub(super) struct Backend {
    mailbox: Mailbox,
    flags: Arc<Flags>,
    /// Called when the client's process has died; `None` where it is not watched.
    orphaned: Option<fn()>,
}

/// The service with every method of the protocol.
pub(super) fn service(
    mailbox: Mailbox,
    flags: Arc<Flags>,
    orphaned: Option<fn()>,
) -> LspService<Backend> {
    // The framework's own client waits for answers; ours does not.
    let build = LspService::build(|_client| Backend {
        mailbox,
        flags,
        orphaned,
    });
    let build = with_own_requests(build)
        .custom_method(messages::DidOpenDrawing::NAME, Backend::did_open_drawing)
        .custom_method(
            messages::DidChangeDrawing::NAME,
            Backend::did_change_drawing,
        )
        .custom_method(messages::DidCloseDrawing::NAME, Backend::did_close_drawing)
        .custom_method(messages::Settings::NAME, Backend::settings)
        .custom_method(messages::RulePage::NAME, Backend::rule_page)
        .custom_method(messages::Calibrate::NAME, Backend::calibrate);
    #[cfg(feature = "testing")]
    let build = build
        .custom_method("wedm/test/panic", Backend::test_panic)
        .custom_method("wedm/test/ask", Backend::test_ask);
    let (service, _socket) = build.finish();
    service
}

impl Backend {
    fn tell(
        &self,
        name: &'static str,
        about: Option<Arc<str>>,
        act: impl FnOnce(&mut State) + Send + 'static,
    ) {
        self.flags.taken.fetch_add(1, Ordering::Relaxed);
        self.mailbox.tell(name, about, act);
    }

    fn tell_change(
        &self,
        name: &'static str,
        about: Arc<str>,
        act: impl FnOnce(&mut State) + Send + 'static,
    ) {
        self.flags.taken.fetch_add(1, Ordering::Relaxed);
        self.mailbox.tell_change(name, about, act);
    }

    /// Hands a request over and waits for its answer.
    async fn ask<T: Send + 'static>(
        &self,
        name: &'static str,
        about: Option<Arc<str>>,
        act: impl FnOnce(&mut State, Reply<T>) + Send + 'static,
    ) -> Result<T> {
        let (reply, answer) = tokio::sync::oneshot::channel();
        self.tell(name, about, move |state| act(state, reply));
        answer
            .await
            .unwrap_or_else(|_| Err(internal(say!(internal_error_in, name))))
    }

    /// Has a request about a document answered in its turn; `finish` makes the result. It is cancelled with this
    /// future.
    async fn perform<P: Send + 'static, R: 'static, T: Send + 'static>(
        &self,
        method: Method<P, R>,
        about: About,
        params: P,
        finish: impl FnOnce(Result<R>) -> Result<T> + Send + 'static,
    ) -> Result<T> {
        let alive = Arc::new(());
        let Method {
            name,
            title,
            reach,
            handler,
        } = method;
        let uri = about.uri.clone();
        let asked = Asked {
            name,
            title,
            reach,
            about,
            client: Arc::downgrade(&alive),
        };
        self.ask(name, Some(uri), move |state, reply| {
            state.answer(asked, reply, move |context| {
                finish(handler(context, params))
            });
        })
        .await
    }

    /// Answers with text, which replaces the framework's empty result.
    async fn answer<P: Send + 'static, R: Serialize + 'static, T: Default>(
        &self,
        method: Method<P, R>,
        about: About,
        params: P,
    ) -> Result<T> {
        let written =
            |result: Result<R>| Written::of(&result?).map_err(|error| internal(error.to_string()));
        self.perform(method, about, params, written).await?.leave();
        Ok(T::default())
    }

    fn ignored(&self, method: &str, reason: &str) {
        let message = say!(was_ignored, method, reason);
        self.tell("log", None, move |state| {
            state.client.log(Weight::Warning, message)
        });
    }

    async fn did_open_drawing(&self, params: Value) {
        match Sent::read(params) {
            Ok(sent) => {
                let about = sent.uri.clone();
                self.tell(messages::DidOpenDrawing::NAME, Some(about), move |state| {
                    drawings::open(state, sent)
                });
            }
            Err(reason) => self.ignored(messages::DidOpenDrawing::NAME, &reason),
        }
    }

    async fn did_change_drawing(&self, params: Value) {
        match SentChanges::read(params) {
            Ok(sent) => {
                let about = sent.uri.clone();
                self.tell_change(messages::DidChangeDrawing::NAME, about, move |state| {
                    drawings::change(state, sent)
                });
            }
            Err(reason) => self.ignored(messages::DidChangeDrawing::NAME, &reason),
        }
    }

    async fn did_close_drawing(&self, params: <messages::DidCloseDrawing as Message>::Params) {
        let uri: Arc<str> = params.drawing.uri.into();
        self.tell(
            messages::DidCloseDrawing::NAME,
            Some(uri.clone()),
            move |state| drawings::close(state, &uri),
        );
    }

    /// The settings in force do not depend on the document's content: this does not wait for judging.
    async fn settings(&self, params: Value) -> Result<Value> {
        let (params, _) = read::<<messages::Settings as Message>::Params>(params)?;
        self.ask(messages::Settings::NAME, None, move |state, reply| {
            let folder = state.config.folder_of(&params.uri);
            state.look_for_file(folder, Vec::new(), move |state, file| {
                let in_force = settings::settings(state, &params.uri, file.as_deref());
                let in_force = serde_json::to_value(in_force);
                let _ = reply.send(in_force.map_err(|error| internal(error.to_string())));
            });
        })
        .await
    }

    /// Does not depend on any document.
    async fn rule_page(
        &self,
        params: <messages::RulePage as Message>::Params,
    ) -> Result<<messages::RulePage as Message>::Answer> {
        let unknown = || Error::invalid_params(say!(there_is_no_rule_named, params.rule));
        let rule = Rule::named(&params.rule).ok_or_else(unknown)?;
        Ok(RulePageText { text: rule.page() })
    }

    /// About no document: what was measured stands in the params.
    async fn calibrate(
        &self,
        params: <messages::Calibrate as Message>::Params,
    ) -> Result<<messages::Calibrate as Message>::Answer> {
        calibrate::calibrate(params)
    }

    #[cfg(feature = "testing")]
    #[expect(clippy::panic, reason = "that is what it is asked for")]
    async fn test_panic(&self, params: probe::Panic) -> Result<Value> {
        if params.site == probe::Site::Handler {
            panic!("asked for by wedm/test/panic");
        }
        let about = Some(params.uri.as_str().into());
        self.ask("wedm/test/panic", about, move |state, reply| {
            probe::panic(state, params.site, reply)
        })
        .await
    }

    #[cfg(feature = "testing")]
    async fn test_ask(&self, _: Value) -> Result<Value> {
        self.ask("wedm/test/ask", None, probe::ask).await
    }
}

/// Params of a request in `wedm/`, with the ones that they all share.
fn read<P: DeserializeOwned>(mut params: Value) -> Result<(P, About)> {
    let mut take = |key: &str| params.get_mut(key).map(Value::take);
    let about = About {
        token: take("workDoneToken").filter(|token| token.is_string() || token.is_number()),
        // The settings' own reader reads them, and reports what does not fit.
        options: take("options"),
        uri: params
            .get("uri")
            .and_then(Value::as_str)
            .unwrap_or_default()
            .into(),
        position: None,
    };
    let params =
        serde_json::from_value(params).map_err(|error| Error::invalid_params(error.to_string()))?;
    Ok((params, about))
}
