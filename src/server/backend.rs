//! The framework's face: every handler hands its message to the state thread before its first wait, and does nothing else.

use super::client::{Abilities, Weight};
use super::config::{Level, path_of};
use super::drawings::{self, Sent, SentChanges};
use super::jobs::Cancel;
use super::requests::code_action::FIX_ALL;
use super::requests::language::formatting::Scope;
use super::requests::language::navigate::{Question, navigate};
#[cfg(feature = "testing")]
use super::requests::probe;
use super::requests::{
    Errand, code_action, contours, drawing_edit, generate, inspect, internal, language, locate,
    picture, scale, settings, simulate, toolpath,
};
use super::state::{Mailbox, Reply, State};
use super::transport::Prepared;
use super::{parent, texts};
use crate::protocol::{self, method};
use crate::text::Encoding;
use ls_types::*;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use tower_lsp::jsonrpc::{Error, Result};
use tower_lsp::{LanguageServer, LspService};

/// What the handlers share with the transport.
#[derive(Default)]
pub(super) struct Flags {
    /// `shutdown` was answered: the end is a good one.
    pub shut_down: AtomicBool,
    /// Notifications that reached their handler.
    pub taken: AtomicUsize,
}

pub(super) struct Backend {
    mailbox: Mailbox,
    prepared: Prepared,
    flags: Arc<Flags>,
    /// Called when the client's process has died; `None` where it is not watched.
    orphaned: Option<fn()>,
}

/// The service with every method of the protocol.
pub(super) fn service(
    mailbox: Mailbox,
    prepared: Prepared,
    flags: Arc<Flags>,
    orphaned: Option<fn()>,
) -> LspService<Backend> {
    // The framework's own client waits for answers; ours does not.
    let build = LspService::build(|_client| Backend {
        mailbox,
        prepared,
        flags,
        orphaned,
    });
    let build = build
        .custom_method(method::DID_OPEN_DRAWING, Backend::did_open_drawing)
        .custom_method(method::DID_CHANGE_DRAWING, Backend::did_change_drawing)
        .custom_method(method::DID_CLOSE_DRAWING, Backend::did_close_drawing)
        .custom_method(method::INSPECT, Backend::inspect)
        .custom_method(method::CONTOURS, Backend::contours)
        .custom_method(method::TOOLPATH, Backend::toolpath)
        .custom_method(method::PICTURE, Backend::picture)
        .custom_method(method::GENERATE, Backend::generate)
        .custom_method(method::LOCATE, Backend::locate)
        .custom_method(method::SETTINGS, Backend::settings)
        .custom_method(method::SIMULATE, Backend::simulate);
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
            .unwrap_or_else(|_| Err(internal(format!("internal error in {name}"))))
    }

    /// A request that may take long. It is cancelled with its handler.
    async fn errand<T: Send + 'static>(
        &self,
        name: &'static str,
        uri: &str,
        token: Option<Value>,
        act: impl FnOnce(&mut State, Errand<T>) + Send + 'static,
    ) -> Result<T> {
        let cancel = Cancel::default();
        let _cancel_when_dropped = cancel.on_drop();
        self.ask(name, Some(uri.into()), move |state, reply| {
            act(
                state,
                Errand {
                    reply,
                    cancel,
                    token,
                },
            )
        })
        .await
    }

    /// An errand whose result is JSON text already.
    async fn written(
        &self,
        name: &'static str,
        uri: &str,
        token: Option<Value>,
        act: impl FnOnce(&mut State, Errand) + Send + 'static,
    ) -> Result<Value> {
        Ok(self
            .prepared
            .token(self.errand(name, uri, token, act).await?))
    }

    /// A request that the state thread answers at once.
    async fn look<T: Send + 'static>(
        &self,
        name: &'static str,
        about: Arc<str>,
        look: impl FnOnce(&mut State) -> Result<T> + Send + 'static,
    ) -> Result<T> {
        let act = move |state: &mut State, reply: Reply<T>| {
            let _ = reply.send(look(state));
        };
        self.ask(name, Some(about), act).await
    }

    /// A request about a name, whose answer is short enough for the framework's types.
    async fn navigate<T: DeserializeOwned>(
        &self,
        name: &'static str,
        at: TextDocumentPositionParams,
        question: Question,
    ) -> Result<Option<T>> {
        let cancel = Cancel::default();
        let _cancel_when_dropped = cancel.on_drop();
        let about = shared(&at.text_document.uri);
        let act = move |state: &mut State, reply| {
            navigate(
                state,
                &at,
                question,
                Errand {
                    reply,
                    cancel,
                    token: None,
                },
            )
        };
        let answer = self.ask(name, Some(about), act).await?;
        serde_json::from_slice(&answer).map_err(|error| internal(error.to_string()))
    }

    async fn formatted(
        &self,
        name: &'static str,
        uri: Uri,
        scope: Scope,
    ) -> Result<Option<Vec<TextEdit>>> {
        let about = shared(&uri);
        let act = move |state: &mut State, errand: Errand| {
            language::formatting::formatting(state, &uri, scope, errand)
        };
        let token = self.written(name, &about, None, act).await?;
        Ok(Some(language::formatting::standing_for(token)))
    }

    fn log(&self, message: String) {
        self.tell("log", None, move |state| {
            state.client.log(Weight::Warning, message)
        });
    }

    async fn did_open_drawing(&self, params: Value) {
        match Sent::read(params) {
            Ok(sent) => {
                let about = sent.uri.clone();
                self.tell(method::DID_OPEN_DRAWING, Some(about), move |state| {
                    drawings::open(state, sent)
                });
            }
            Err(reason) => self.log(format!(
                "{} was ignored: {reason}",
                method::DID_OPEN_DRAWING
            )),
        }
    }

    async fn did_change_drawing(&self, params: Value) {
        match SentChanges::read(params) {
            Ok(sent) => {
                let about = sent.uri.clone();
                self.tell_change(method::DID_CHANGE_DRAWING, about, move |state| {
                    drawings::change(state, sent)
                });
            }
            Err(reason) => self.log(format!(
                "{} was ignored: {reason}",
                method::DID_CHANGE_DRAWING
            )),
        }
    }

    async fn did_close_drawing(&self, params: protocol::CloseDrawing) {
        let uri: Arc<str> = params.drawing.uri.into();
        self.tell(method::DID_CLOSE_DRAWING, Some(uri.clone()), move |state| {
            drawings::close(state, &uri)
        });
    }

    async fn inspect(&self, params: Value) -> Result<Value> {
        let (params, token) = read::<protocol::Inspect>(params)?;
        let uri = params.uri.clone();
        self.written(method::INSPECT, &uri, token, move |state, errand| {
            inspect::inspect(state, params, errand)
        })
        .await
    }

    async fn contours(&self, params: Value) -> Result<Value> {
        let (params, token) = read::<protocol::DrawingName>(params)?;
        let uri = params.uri.clone();
        self.written(method::CONTOURS, &uri, token, move |state, errand| {
            contours::contours(state, params, errand)
        })
        .await
    }

    async fn toolpath(&self, params: Value) -> Result<Value> {
        let (params, token) = read::<WithOptions>(params)?;
        let WithOptions { uri, options } = params;
        let about = uri.clone();
        self.written(method::TOOLPATH, &about, token, move |state, errand| {
            toolpath::toolpath(state, &uri, options.as_ref(), errand)
        })
        .await
    }

    async fn picture(&self, params: Value) -> Result<Value> {
        let (params, token) = read::<WithOptions>(params)?;
        let WithOptions { uri, options } = params;
        let about = uri.clone();
        self.written(method::PICTURE, &about, token, move |state, errand| {
            picture::picture(state, &uri, options.as_ref(), errand)
        })
        .await
    }

    async fn generate(&self, params: Value) -> Result<Value> {
        let about = params
            .get("uri")
            .and_then(Value::as_str)
            .unwrap_or_default()
            .to_owned();
        let (params, token) = read::<generate::Params>(params)?;
        self.written(method::GENERATE, &about, token, move |state, errand| {
            generate::generate(state, params, errand)
        })
        .await
    }

    async fn locate(&self, params: Value) -> Result<Value> {
        let (params, _) = read::<protocol::Locate>(params)?;
        let about: Arc<str> = params.uri.as_str().into();
        let located = self
            .look(method::LOCATE, about, move |state| {
                locate::locate(state, &params)
            })
            .await?;
        serde_json::to_value(located).map_err(|error| internal(error.to_string()))
    }

    async fn settings(&self, params: Value) -> Result<Value> {
        let (params, _) = read::<protocol::DrawingName>(params)?;
        // What holds for a document does not hang on what it holds: nobody waits for its judging.
        let act = move |state: &mut State, reply: Reply<protocol::SettingsInForce>| {
            let _ = reply.send(Ok(settings::settings(state, &params.uri)));
        };
        let in_force = self.ask(method::SETTINGS, None, act).await?;
        serde_json::to_value(in_force).map_err(|error| internal(error.to_string()))
    }

    async fn simulate(&self, params: Value) -> Result<Value> {
        let (params, token) = read::<protocol::Simulate>(params)?;
        let uri = params.uri.clone();
        self.written(method::SIMULATE, &uri, token, move |state, errand| {
            simulate::simulate(state, params, errand)
        })
        .await
    }

    #[cfg(feature = "testing")]
    async fn test_panic(&self, params: probe::Panic) -> Result<Value> {
        match params.site {
            probe::Site::Handler => panic!("asked for by wedm/test/panic"),
            probe::Site::State => {
                let panic = |_: &mut State, _: Reply<Value>| probe::panic_on_state_thread();
                self.ask("wedm/test/panic", Some(params.uri.into()), panic)
                    .await
            }
            probe::Site::Worker => {
                self.written("wedm/test/panic", &params.uri, None, probe::panic_on_worker)
                    .await
            }
        }
    }

    #[cfg(feature = "testing")]
    async fn test_ask(&self, _: Value) -> Result<Value> {
        self.ask("wedm/test/ask", None, probe::ask).await
    }
}

#[derive(serde::Deserialize)]
struct WithOptions {
    uri: String,
    options: Option<Value>,
}

/// Params and the token for progress beside them.
fn read<P: DeserializeOwned>(mut params: Value) -> Result<(P, Option<Value>)> {
    let token = params
        .get_mut("workDoneToken")
        .map(Value::take)
        .filter(|token| token.is_string() || token.is_number());
    let params =
        serde_json::from_value(params).map_err(|error| Error::invalid_params(error.to_string()))?;
    Ok((params, token))
}

fn shared(uri: &Uri) -> Arc<str> {
    uri.as_str().into()
}

impl LanguageServer for Backend {
    async fn initialize(&self, params: InitializeParams) -> Result<InitializeResult> {
        if let (Some(orphaned), Some(pid)) = (self.orphaned, params.process_id) {
            parent::watch(pid, orphaned);
        }
        self.ask("initialize", None, move |state, reply| {
            let _ = reply.send(Ok(initialize(state, params)));
        })
        .await
    }

    async fn initialized(&self, _: InitializedParams) {
        self.tell("initialized", None, initialized);
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
        let uri = shared(&uri);
        self.tell("textDocument/didOpen", Some(uri.clone()), move |state| {
            texts::open(state, uri, &language_id, version.into(), text);
        });
    }

    async fn did_change(&self, params: DidChangeTextDocumentParams) {
        let uri = shared(&params.text_document.uri);
        let version = params.text_document.version.into();
        self.tell_change("textDocument/didChange", uri.clone(), move |state| {
            texts::change(state, &uri, version, params.content_changes);
        });
    }

    async fn did_save(&self, params: DidSaveTextDocumentParams) {
        // A project's file may be new on disk, and not every client watches files.
        if params
            .text_document
            .uri
            .as_str()
            .ends_with(crate::settings::FILE_NAME)
        {
            self.tell("textDocument/didSave", None, State::settings_changed);
        }
    }

    async fn did_close(&self, params: DidCloseTextDocumentParams) {
        let uri = shared(&params.text_document.uri);
        self.tell("textDocument/didClose", Some(uri.clone()), move |state| {
            texts::close(state, &uri)
        });
    }

    async fn did_change_configuration(&self, params: DidChangeConfigurationParams) {
        self.tell("workspace/didChangeConfiguration", None, move |state| {
            if !params.settings.is_null() {
                set_level(state, Level::Pushed, &params.settings);
                state.settings_changed();
            }
            pull_configuration(state);
        });
    }

    async fn did_change_watched_files(&self, _: DidChangeWatchedFilesParams) {
        self.tell(
            "workspace/didChangeWatchedFiles",
            None,
            State::settings_changed,
        );
    }

    async fn did_change_workspace_folders(&self, params: DidChangeWorkspaceFoldersParams) {
        self.tell("workspace/didChangeWorkspaceFolders", None, move |state| {
            let paths = |folders: &[WorkspaceFolder]| {
                folders
                    .iter()
                    .filter_map(|folder| path_of(folder.uri.as_str()))
                    .collect::<Vec<_>>()
            };
            state
                .config
                .change_folders(&paths(&params.event.removed), paths(&params.event.added));
            state.settings_changed();
        });
    }

    async fn code_action(&self, params: CodeActionParams) -> Result<Option<CodeActionResponse>> {
        let uri = params.text_document.uri.as_str().to_owned();
        let token = params
            .work_done_progress_params
            .work_done_token
            .as_ref()
            .and_then(|token| serde_json::to_value(token).ok());
        self.errand(
            "textDocument/codeAction",
            &uri,
            token,
            move |state, errand| code_action::code_action(state, params, errand),
        )
        .await
    }

    async fn hover(&self, params: HoverParams) -> Result<Option<Hover>> {
        let about = shared(&params.text_document_position_params.text_document.uri);
        self.look("textDocument/hover", about, move |state| {
            language::hover::hover(state, &params)
        })
        .await
    }

    async fn document_symbol(
        &self,
        params: DocumentSymbolParams,
    ) -> Result<Option<DocumentSymbolResponse>> {
        let uri = params.text_document.uri;
        let about = shared(&uri);
        let act = move |state: &mut State, errand: Errand| {
            language::symbols::document_symbol(state, uri, errand)
        };
        let token = self
            .written("textDocument/documentSymbol", &about, None, act)
            .await?;
        Ok(Some(language::symbols::standing_for(token)))
    }

    async fn folding_range(&self, params: FoldingRangeParams) -> Result<Option<Vec<FoldingRange>>> {
        let uri = params.text_document.uri;
        let about = shared(&uri);
        let act = move |state: &mut State, errand: Errand| {
            language::folding::folding_range(state, &uri, errand)
        };
        let token = self
            .written("textDocument/foldingRange", &about, None, act)
            .await?;
        Ok(Some(language::folding::standing_for(token)))
    }

    async fn formatting(&self, params: DocumentFormattingParams) -> Result<Option<Vec<TextEdit>>> {
        self.formatted(
            "textDocument/formatting",
            params.text_document.uri,
            Scope::Whole,
        )
        .await
    }

    async fn range_formatting(
        &self,
        params: DocumentRangeFormattingParams,
    ) -> Result<Option<Vec<TextEdit>>> {
        self.formatted(
            "textDocument/rangeFormatting",
            params.text_document.uri,
            Scope::Range(params.range),
        )
        .await
    }

    async fn on_type_formatting(
        &self,
        params: DocumentOnTypeFormattingParams,
    ) -> Result<Option<Vec<TextEdit>>> {
        let at = params.text_document_position;
        self.formatted(
            "textDocument/onTypeFormatting",
            at.text_document.uri,
            Scope::Left(at.position),
        )
        .await
    }

    async fn completion(&self, params: CompletionParams) -> Result<Option<CompletionResponse>> {
        let about = shared(&params.text_document_position.text_document.uri);
        self.look("textDocument/completion", about, move |state| {
            language::completion::completion(state, &params)
        })
        .await
    }

    async fn selection_range(
        &self,
        params: SelectionRangeParams,
    ) -> Result<Option<Vec<SelectionRange>>> {
        let about = shared(&params.text_document.uri);
        self.look("textDocument/selectionRange", about, move |state| {
            language::selection::selection_range(state, &params)
        })
        .await
    }

    async fn code_lens(&self, params: CodeLensParams) -> Result<Option<Vec<CodeLens>>> {
        let uri = params.text_document.uri;
        let about = shared(&uri);
        let act = move |state: &mut State, errand: Errand| {
            language::lenses::code_lens(state, &uri, errand)
        };
        let answer = self
            .errand("textDocument/codeLens", &about, None, act)
            .await?;
        serde_json::from_slice(&answer).map_err(|error| internal(error.to_string()))
    }

    async fn signature_help(&self, params: SignatureHelpParams) -> Result<Option<SignatureHelp>> {
        let about = shared(&params.text_document_position_params.text_document.uri);
        self.look("textDocument/signatureHelp", about, move |state| {
            language::signature::signature_help(state, &params)
        })
        .await
    }

    async fn prepare_rename(
        &self,
        params: TextDocumentPositionParams,
    ) -> Result<Option<PrepareRenameResponse>> {
        let about = shared(&params.text_document.uri);
        self.look("textDocument/prepareRename", about, move |state| {
            language::rename::prepare(state, &params)
        })
        .await
    }

    async fn rename(&self, params: RenameParams) -> Result<Option<WorkspaceEdit>> {
        let about = shared(&params.text_document_position.text_document.uri);
        self.look("textDocument/rename", about, move |state| {
            language::rename::rename(state, &params)
        })
        .await
    }

    async fn inlay_hint(&self, params: InlayHintParams) -> Result<Option<Vec<InlayHint>>> {
        let about = shared(&params.text_document.uri);
        self.look("textDocument/inlayHint", about, move |state| {
            language::hints::inlay_hint(state, &params)
        })
        .await
    }

    async fn semantic_tokens_range(
        &self,
        params: SemanticTokensRangeParams,
    ) -> Result<Option<SemanticTokensRangeResult>> {
        let about = shared(&params.text_document.uri);
        self.look("textDocument/semanticTokens/range", about, move |state| {
            language::tokens::range(state, &params.text_document.uri, params.range)
        })
        .await
    }

    async fn semantic_tokens_full(
        &self,
        params: SemanticTokensParams,
    ) -> Result<Option<SemanticTokensResult>> {
        let uri = params.text_document.uri;
        let about = shared(&uri);
        let act = move |state: &mut State, errand: Errand| {
            language::tokens::full(state, &uri, None, errand)
        };
        let token = self
            .written("textDocument/semanticTokens/full", &about, None, act)
            .await?;
        Ok(Some(SemanticTokensResult::Tokens(
            language::tokens::standing_for(token),
        )))
    }

    async fn semantic_tokens_full_delta(
        &self,
        params: SemanticTokensDeltaParams,
    ) -> Result<Option<SemanticTokensFullDeltaResult>> {
        let uri = params.text_document.uri;
        let about = shared(&uri);
        let previous = Some(params.previous_result_id);
        let act = move |state: &mut State, errand: Errand| {
            language::tokens::full(state, &uri, previous, errand)
        };
        let token = self
            .written("textDocument/semanticTokens/full/delta", &about, None, act)
            .await?;
        Ok(Some(SemanticTokensFullDeltaResult::Tokens(
            language::tokens::standing_for(token),
        )))
    }

    async fn goto_definition(
        &self,
        params: GotoDefinitionParams,
    ) -> Result<Option<GotoDefinitionResponse>> {
        let at = params.text_document_position_params;
        let found = self
            .navigate("textDocument/definition", at, Question::Definition)
            .await?;
        Ok(found.map(GotoDefinitionResponse::Array))
    }

    async fn references(&self, params: ReferenceParams) -> Result<Option<Vec<Location>>> {
        let question = Question::References {
            with_definition: params.context.include_declaration,
        };
        self.navigate(
            "textDocument/references",
            params.text_document_position,
            question,
        )
        .await
    }

    async fn document_highlight(
        &self,
        params: DocumentHighlightParams,
    ) -> Result<Option<Vec<DocumentHighlight>>> {
        self.navigate(
            "textDocument/documentHighlight",
            params.text_document_position_params,
            Question::Highlight,
        )
        .await
    }

    async fn execute_command(&self, params: ExecuteCommandParams) -> Result<Option<LSPAny>> {
        let about = params
            .arguments
            .first()
            .and_then(|argument| argument.get("uri")?.as_str())
            .map(Arc::from);
        self.ask("workspace/executeCommand", about, move |state, reply| {
            if params.command == method::SCALE_COMMAND {
                scale::execute(state, params.arguments, reply);
            } else {
                drawing_edit::execute(state, &params.command, params.arguments, reply);
            }
        })
        .await
    }
}

fn initialize(state: &mut State, params: InitializeParams) -> InitializeResult {
    let capabilities = &params.capabilities;
    let offered = capabilities
        .general
        .as_ref()
        .and_then(|general| general.position_encodings.as_ref());
    let utf8 = offered.is_some_and(|offered| offered.contains(&PositionEncodingKind::UTF8));
    state.encoding = if utf8 {
        Encoding::Utf8
    } else {
        Encoding::Utf16
    };
    state.set_abilities(abilities(capabilities));
    state.config.set_folders(folders(&params));
    set_level(
        state,
        Level::Initialization,
        &params.initialization_options.unwrap_or_default(),
    );
    InitializeResult {
        capabilities: ServerCapabilities {
            position_encoding: Some(if utf8 {
                PositionEncodingKind::UTF8
            } else {
                PositionEncodingKind::UTF16
            }),
            text_document_sync: Some(TextDocumentSyncCapability::Options(
                TextDocumentSyncOptions {
                    open_close: Some(true),
                    change: Some(TextDocumentSyncKind::INCREMENTAL),
                    save: Some(TextDocumentSyncSaveOptions::Supported(true)),
                    ..TextDocumentSyncOptions::default()
                },
            )),
            code_action_provider: Some(CodeActionProviderCapability::Options(CodeActionOptions {
                code_action_kinds: Some(vec![
                    CodeActionKind::QUICKFIX,
                    CodeActionKind::new(FIX_ALL),
                    CodeActionKind::REFACTOR_REWRITE,
                ]),
                work_done_progress_options: WorkDoneProgressOptions {
                    work_done_progress: Some(true),
                },
                resolve_provider: None,
            })),
            execute_command_provider: Some(ExecuteCommandOptions {
                commands: vec![
                    method::APPLY_DRAWING_EDIT_COMMAND.into(),
                    method::SCALE_COMMAND.into(),
                ],
                ..ExecuteCommandOptions::default()
            }),
            completion_provider: Some(language::completion::options()),
            definition_provider: Some(OneOf::Left(true)),
            references_provider: Some(OneOf::Left(true)),
            document_highlight_provider: Some(OneOf::Left(true)),
            selection_range_provider: Some(SelectionRangeProviderCapability::Simple(true)),
            rename_provider: Some(OneOf::Right(RenameOptions {
                prepare_provider: Some(true),
                work_done_progress_options: WorkDoneProgressOptions::default(),
            })),
            code_lens_provider: state.client.abilities.code_lens.then_some(CodeLensOptions {
                resolve_provider: Some(false),
            }),
            signature_help_provider: Some(language::signature::options()),
            inlay_hint_provider: Some(OneOf::Left(true)),
            semantic_tokens_provider: Some(language::tokens::capabilities()),
            hover_provider: Some(HoverProviderCapability::Simple(true)),
            document_symbol_provider: Some(OneOf::Left(true)),
            document_formatting_provider: Some(OneOf::Left(true)),
            document_range_formatting_provider: Some(OneOf::Left(true)),
            document_on_type_formatting_provider: Some(language::formatting::on_type()),
            folding_range_provider: Some(FoldingRangeProviderCapability::Simple(true)),
            workspace: Some(WorkspaceServerCapabilities {
                workspace_folders: Some(WorkspaceFoldersServerCapabilities {
                    supported: Some(true),
                    change_notifications: Some(OneOf::Left(true)),
                }),
                ..WorkspaceServerCapabilities::default()
            }),
            experimental: Some(json!({ "wedm": { "protocol": protocol::PROTOCOL } })),
            ..ServerCapabilities::default()
        },
        server_info: Some(ServerInfo {
            name: "wedm".into(),
            version: Some(env!("CARGO_PKG_VERSION").into()),
        }),
        ..InitializeResult::default()
    }
}

fn abilities(capabilities: &ClientCapabilities) -> Abilities {
    let ours = |key: &str| {
        capabilities
            .experimental
            .as_ref()
            .and_then(|ours| ours.pointer(key))
            .and_then(Value::as_bool)
            == Some(true)
    };
    let workspace = capabilities.workspace.as_ref();
    let text = capabilities.text_document.as_ref();
    let related = text.and_then(|text| text.publish_diagnostics.as_ref()?.related_information);
    let registers = |dynamic: Option<bool>| dynamic == Some(true);
    let text = capabilities.text_document.as_ref();
    let folding = text.and_then(|text| text.folding_range.as_ref());
    Abilities {
        hierarchical_symbols: text.and_then(|text| {
            text.document_symbol
                .as_ref()?
                .hierarchical_document_symbol_support
        }) == Some(true),
        folding_limit: folding.and_then(|folding| usize::try_from(folding.range_limit?).ok()),
        apply_drawing_edit: ours("/wedm/applyDrawingEdit"),
        apply_edit: workspace.and_then(|workspace| workspace.apply_edit) == Some(true),
        disabled_actions: text.and_then(|text| text.code_action.as_ref()?.disabled_support)
            == Some(true),
        code_lens: ours("/wedm/codeLens"),
        snippets: text.and_then(|text| {
            text.completion
                .as_ref()?
                .completion_item
                .as_ref()?
                .snippet_support
        }) == Some(true),
        resend_drawing: ours("/wedm/resendDrawing"),
        document_changes: workspace
            .and_then(|workspace| workspace.workspace_edit.as_ref()?.document_changes)
            == Some(true),
        configuration: workspace.and_then(|workspace| workspace.configuration) == Some(true),
        register_configuration: registers(workspace.and_then(|workspace| {
            workspace
                .did_change_configuration
                .as_ref()?
                .dynamic_registration
        })),
        register_watched_files: registers(workspace.and_then(|workspace| {
            workspace
                .did_change_watched_files
                .as_ref()?
                .dynamic_registration
        })),
        related_information: related == Some(true),
        token_deltas: matches!(
            text.and_then(|text| text.semantic_tokens.as_ref()?.requests.full.as_ref()),
            Some(SemanticTokensFullOptions::Delta { delta: Some(true) })
        ),
    }
}

#[expect(
    deprecated,
    reason = "clients that know no workspace folders send the root"
)]
fn folders(params: &InitializeParams) -> Vec<std::path::PathBuf> {
    match &params.workspace_folders {
        Some(folders) if !folders.is_empty() => folders
            .iter()
            .filter_map(|folder| path_of(folder.uri.as_str()))
            .collect(),
        _ => params
            .root_uri
            .iter()
            .filter_map(|root| path_of(root.as_str()))
            .collect(),
    }
}

fn initialized(state: &mut State) {
    let mut registrations = Vec::new();
    if state.client.abilities.register_watched_files {
        registrations.push(json!({
            "id": "wedm-files",
            "method": "workspace/didChangeWatchedFiles",
            "registerOptions": { "watchers": [{ "globPattern": format!("**/{}", crate::settings::FILE_NAME) }] },
        }));
    }
    if state.client.abilities.register_configuration {
        registrations.push(json!({
            "id": "wedm-configuration",
            "method": "workspace/didChangeConfiguration",
            "registerOptions": { "section": "wedm" },
        }));
    }
    if !registrations.is_empty() {
        state.client.ask(
            "client/registerCapability",
            json!({ "registrations": registrations }),
            |state, answer| {
                if let Err(reason) = answer {
                    state.client.log(Weight::Info, reason);
                }
            },
        );
    }
    pull_configuration(state);
}

/// Asks for the section `wedm`, where the client can be asked.
fn pull_configuration(state: &mut State) {
    if !state.client.abilities.configuration {
        return;
    }
    state.client.ask(
        "workspace/configuration",
        json!({ "items": [{ "section": "wedm" }] }),
        |state, answer| match answer {
            Ok(answer) => {
                set_level(state, Level::Pulled, answer.get(0).unwrap_or(&Value::Null));
                state.settings_changed();
            }
            Err(reason) => state.client.log(Weight::Warning, reason),
        },
    );
}

fn set_level(state: &mut State, level: Level, json: &Value) {
    for misfit in state.config.set_level(level, json) {
        state.client.show(Weight::Warning, misfit);
    }
}
