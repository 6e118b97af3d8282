//! Text documents: opened, changed, closed.

use super::client::Weight;
use super::convert;
use super::open::{Content, Kind, Open};
use super::state::State;
use crate::text::SourceText;
use ls_types::TextDocumentContentChangeEvent;
use std::sync::Arc;

pub(super) fn open(state: &mut State, uri: Arc<str>, language: &str, version: i64, text: String) {
    let kind = Kind::of(language, &uri);
    let settings = state.settings_for(&uri);
    let stamp = state.next_stamp();
    state.log_if_open(&uri);
    state.insert(Open::text(uri, version, kind, text, &settings, stamp));
    if kind == Kind::Settings {
        state.settings_changed();
    }
}

pub(super) fn change(state: &mut State, uri: &Arc<str>, version: i64, changes: Vec<TextDocumentContentChangeEvent>) {
    let encoding = state.encoding;
    let Some(open) = state.documents.get(uri).filter(|open| !open.is_drawing()) else {
        state.client.log(Weight::Warning, format!("{uri} was changed without being open as a text: nothing was done"));
        return;
    };
    if version < open.version {
        let message = format!("{uri} was changed to version {version}, which is older than {}: applied all the same", open.version);
        state.client.log(Weight::Warning, message);
    }
    let settings = match &open.content {
        Content::Read(document) => document.settings().clone(),
        _ => state.settings_for(uri),
    };
    let Some(open) = state.documents.get_mut(uri) else { return };
    open.version = open.version.max(version);
    for change in changes {
        let length = open.source_text().map_or(0, SourceText::len);
        let range = match (change.range, open.source_text()) {
            (Some(range), Some(text)) => convert::bytes_of(text, range, encoding),
            _ => 0..length,
        };
        open.edit_text(range, &change.text, &settings);
    }
    let is_settings = matches!(open.content, Content::Settings(_));
    state.mark_dirty(uri);
    if is_settings {
        state.settings_changed();
    }
}

pub(super) fn close(state: &mut State, uri: &Arc<str>) {
    match state.documents.get(uri).map(|open| (open.is_drawing(), matches!(open.content, Content::Settings(_)))) {
        Some((false, is_settings)) => {
            state.close(uri);
            if is_settings {
                state.settings_changed();
            }
        }
        _ => state.client.log(Weight::Warning, format!("{uri} was closed without being open as a text")),
    }
}
