//! Text documents: opened, changed, closed.

use super::changes;
use super::client::Weight;
use super::content::Content;
use super::drawings;
use super::judge::Task;
use super::kind::Kind;
use super::open::Open;
use super::state::State;
use super::transport::LostChange;
use crate::text::SourceText;
use ls_types::TextDocumentContentChangeEvent;
use std::sync::Arc;

pub(super) fn open(state: &mut State, uri: Arc<str>, language: &str, version: i64, text: String) {
    if state.config.bars(&uri) {
        return state
            .client
            .show(Weight::Error, say!(says, uri, say!(it_lies_outside)));
    }
    let kind = Kind::of(language, &uri);
    state.log_if_open(&uri);
    state.with_file("textDocument/didOpen", uri.clone(), move |state, file| {
        let settings = state.config.effective_for(&uri, file.as_deref());
        let first = Task::Text { kind, text };
        let stamp = state.next_stamp();
        state.insert(Open::new(uri, version, first, settings, stamp));
        if kind == Kind::Settings {
            state.settings_changed();
        }
    });
}

pub(super) fn change(
    state: &mut State,
    uri: &Arc<str>,
    version: i64,
    changes: Vec<TextDocumentContentChangeEvent>,
) {
    let Some(open) = state.documents.get_mut(uri).filter(|open| !open.is_drawing) else {
        state
            .client
            .log(Weight::Warning, say!(was_changed_without_being_open, uri));
        return;
    };
    let mut changes = changes;
    if let Content::Lost(kind) = open.content {
        // Only the whole text helps; what comes before it is of no meaning.
        let Some(whole) = changes.iter().rposition(|change| change.range.is_none()) else {
            return;
        };
        changes.drain(..whole);
        match kind {
            Kind::Settings => open.content = Content::Settings(SourceText::default()),
            kind => {
                let text = String::new();
                state.add_task(uri, Task::Text { kind, text });
            }
        }
    }
    make(state, uri, version, changes);
}

fn make(
    state: &mut State,
    uri: &Arc<str>,
    version: i64,
    changes: Vec<TextDocumentContentChangeEvent>,
) {
    let encoding = state.encoding;
    match state.documents.get_mut(uri) {
        Some(open) if matches!(open.content, Content::Settings(_)) => {
            open.version = open.version.max(version);
            changes::make(&mut open.content, changes, encoding);
            state.mark_dirty(uri);
            state.settings_changed();
        }
        _ => state.add_task(uri, Task::Change { version, changes }),
    }
}

/// Called when a change could not be read. The text here is no longer the one that the user sees, and the next changes would be
/// made at wrong places: nothing is said of it until the client sends the whole.
pub(super) fn lost(state: &mut State, change: &LostChange) {
    let is_meant = |uri: &str| change.uris.is_empty() || change.uris.iter().any(|own| own == uri);
    let uris = state.documents.keys().filter(|uri| is_meant(uri)).cloned();
    let mut uris: Vec<Arc<str>> = uris.collect();
    uris.sort_unstable();
    for uri in uris {
        state.in_turn("lost", uri.clone(), move |state| lose(state, &uri));
    }
}

fn lose(state: &mut State, uri: &Arc<str>) {
    let Some(open) = state.documents.get_mut(uri) else {
        return;
    };
    if open.is_drawing {
        let reason = say!(a_change_could_not_be_read);
        return drawings::does_not_apply(state, uri, reason);
    }
    if matches!(open.content, Content::Lost(_) | Content::Foreign) {
        return;
    }
    let kind = open.content.kind();
    open.content = Content::Lost(kind);
    open.form = None;
    state
        .client
        .show(Weight::Error, say!(says, uri, say!(the_text_is_not_known)));
    state.mark_dirty(uri);
    state.poke_partners(uri);
    if kind == Kind::Settings {
        state.settings_changed();
    }
}

pub(super) fn close(state: &mut State, uri: &Arc<str>) {
    match state
        .documents
        .get(uri)
        .map(|open| (open.is_drawing, open.content.kind() == Kind::Settings))
    {
        Some((false, is_settings)) => {
            state.close(uri);
            if is_settings {
                state.settings_changed();
            }
        }
        _ => state
            .client
            .log(Weight::Warning, say!(was_closed_without_being_open, uri)),
    }
}
