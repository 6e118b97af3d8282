//! `initialize`, `initialized`, and what the client says of its settings and folders.

use super::code_action::FIX_ALL;
use super::{completion, formatting, signature, tokens};
use crate::protocol::{self, method};
use crate::server::client::{Abilities, Weight};
use crate::server::config::{Level, path_of};
use crate::server::state::State;
use crate::text::Encoding;
use ls_types::*;
use serde_json::{Value, json};

pub(in crate::server) fn initialize(
    state: &mut State,
    params: InitializeParams,
) -> InitializeResult {
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
    state.client.abilities = abilities(capabilities).into();
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
            completion_provider: Some(completion::options()),
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
            signature_help_provider: Some(signature::options()),
            inlay_hint_provider: Some(OneOf::Left(true)),
            semantic_tokens_provider: Some(tokens::capabilities()),
            hover_provider: Some(HoverProviderCapability::Simple(true)),
            document_symbol_provider: Some(OneOf::Left(true)),
            document_formatting_provider: Some(OneOf::Left(true)),
            document_range_formatting_provider: Some(OneOf::Left(true)),
            document_on_type_formatting_provider: Some(formatting::on_type()),
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

pub(in crate::server) fn initialized(state: &mut State) {
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

pub(in crate::server) fn configuration_changed(state: &mut State, settings: &Value) {
    if !settings.is_null() {
        set_level(state, Level::Pushed, settings);
        state.settings_changed();
    }
    pull_configuration(state);
}

pub(in crate::server) fn folders_changed(state: &mut State, event: &WorkspaceFoldersChangeEvent) {
    let paths = |folders: &[WorkspaceFolder]| -> Vec<std::path::PathBuf> {
        folders
            .iter()
            .filter_map(|folder| path_of(folder.uri.as_str()))
            .collect()
    };
    state
        .config
        .change_folders(&paths(&event.removed), paths(&event.added));
    state.settings_changed();
}
