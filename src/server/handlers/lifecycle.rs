//! `initialize` and `initialized`: the capabilities of client and server.

use super::code_action::FIX_ALL;
use super::tokens;
use crate::message::{Asker, Language, speak};
use crate::protocol::{self, method};
use crate::server::client::{Abilities, Weight};
use crate::server::config::{Level, path_of};
use crate::server::errors::internal;
use crate::server::state::State;
use crate::text::Encoding;
use ls_types::{CodeActionKind, InitializeParams, InitializeResult, TextDocumentSyncKind};
use serde_json::{Value, json};
use std::path::PathBuf;
use std::sync::Arc;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn initialize(
    state: &mut State,
    params: InitializeParams,
) -> Result<InitializeResult> {
    if let Some(language) = params.locale.as_deref().and_then(Language::of) {
        speak(language, Asker::Client);
    }
    let unsound = |error: serde_json::Error| internal(error.to_string());
    let able = serde_json::to_value(&params.capabilities).map_err(unsound)?;
    let offered = able.pointer("/general/positionEncodings");
    let offered = offered.and_then(Value::as_array);
    let encoding = match offered.is_some_and(|offered| offered.iter().any(|name| name == "utf-8")) {
        true => Encoding::Utf8,
        false => Encoding::Utf16,
    };
    state.encoding = encoding;
    state.client.abilities = Arc::new(abilities(&able));
    let config = Arc::make_mut(&mut state.config);
    config.rule_pages = state.client.abilities.rule_pages;
    config.set_folders(folders(&params));
    let options = params.initialization_options.unwrap_or_default();
    state.set_level(Level::Initialization, &options);
    let result = json!({
        "capabilities": offers(encoding, &state.client.abilities),
        "serverInfo": { "name": "wedm", "version": env!("CARGO_PKG_VERSION") },
    });
    serde_json::from_value(result).map_err(unsound)
}

/// The server's capabilities.
fn offers(encoding: Encoding, abilities: &Abilities) -> Value {
    json!({
        "positionEncoding": match encoding {
            Encoding::Utf8 => "utf-8",
            Encoding::Utf16 => "utf-16",
        },
        "textDocumentSync": {
            "openClose": true,
            "change": TextDocumentSyncKind::INCREMENTAL,
            "save": true,
        },
        "codeActionProvider": {
            "codeActionKinds": [CodeActionKind::QUICKFIX, FIX_ALL, CodeActionKind::REFACTOR_REWRITE],
            "workDoneProgress": true,
            "resolveProvider": abilities.resolves_actions.then_some(true),
        },
        "executeCommandProvider": {
            "commands": [method::APPLY_DRAWING_EDIT_COMMAND, method::SCALE_COMMAND],
        },
        // A letter among digits begins no new word: editors ask there only at trigger characters.
        "completionProvider": { "triggerCharacters": ["B", "G", "M", "I", "J", "D", "H", "P"] },
        "signatureHelpProvider": {
            "triggerCharacters": ["B", "b", "X", "x", "I", "i", "D", "P"],
            "retriggerCharacters": ["G", "g", "Y", "y", "J", "j", "R", " "],
        },
        "definitionProvider": true,
        "referencesProvider": true,
        "documentHighlightProvider": true,
        "selectionRangeProvider": true,
        "renameProvider": { "prepareProvider": true },
        "codeLensProvider": abilities.code_lens.then(|| json!({ "resolveProvider": false })),
        "inlayHintProvider": true,
        "semanticTokensProvider": {
            "legend": { "tokenTypes": tokens::types(), "tokenModifiers": [] },
            "range": true,
            "full": { "delta": true },
        },
        "hoverProvider": true,
        "documentSymbolProvider": true,
        "documentFormattingProvider": true,
        "documentRangeFormattingProvider": true,
        "documentOnTypeFormattingProvider": { "firstTriggerCharacter": "\n" },
        "foldingRangeProvider": true,
        "workspace": { "workspaceFolders": { "supported": true, "changeNotifications": true } },
        "experimental": { "wedm": { "protocol": protocol::PROTOCOL } },
    })
}

fn abilities(client: &Value) -> Abilities {
    let able = |path: &str| client.pointer(path).and_then(Value::as_bool) == Some(true);
    let folds = client.pointer("/textDocument/foldingRange/rangeLimit");
    let of_files = client.pointer("/workspace/workspaceEdit/resourceOperations");
    let resolved = client.pointer("/textDocument/codeAction/resolveSupport/properties");
    let has_edit = |properties: &Vec<Value>| properties.iter().any(|property| property == "edit");
    let creates = |kinds: &Vec<Value>| kinds.iter().any(|kind| kind == "create");
    Abilities {
        apply_drawing_edit: able("/experimental/wedm/applyDrawingEdit"),
        resend_drawing: able("/experimental/wedm/resendDrawing"),
        code_lens: able("/experimental/wedm/codeLens"),
        rule_pages: able("/experimental/wedm/rulePages"),
        apply_edit: able("/workspace/applyEdit"),
        document_changes: able("/workspace/workspaceEdit/documentChanges"),
        create_files: of_files.and_then(Value::as_array).is_some_and(creates),
        configuration: able("/workspace/configuration"),
        register_configuration: able("/workspace/didChangeConfiguration/dynamicRegistration"),
        register_watched_files: able("/workspace/didChangeWatchedFiles/dynamicRegistration"),
        related_information: able("/textDocument/publishDiagnostics/relatedInformation"),
        disabled_actions: able("/textDocument/codeAction/disabledSupport"),
        resolves_actions: able("/textDocument/codeAction/dataSupport")
            && resolved.and_then(Value::as_array).is_some_and(has_edit),
        snippets: able("/textDocument/completion/completionItem/snippetSupport"),
        hierarchical_symbols: able(
            "/textDocument/documentSymbol/hierarchicalDocumentSymbolSupport",
        ),
        token_deltas: able("/textDocument/semanticTokens/requests/full/delta"),
        folding_limit: folds
            .and_then(Value::as_u64)
            .and_then(|limit| usize::try_from(limit).ok()),
    }
}

#[expect(
    deprecated,
    reason = "clients that know no workspace folders send the root"
)]
fn folders(params: &InitializeParams) -> Vec<PathBuf> {
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
            "registerOptions": { "watchers": [
                { "globPattern": format!("**/{}", crate::settings::FILE_NAME) },
                { "globPattern": "**/*.{dxf,dxb,3b,4b,iso,nc,DXF,DXB,3B,4B,ISO,NC}" },
            ] },
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
    state.pull_configuration();
}
