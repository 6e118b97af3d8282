//! Text documents: opened, changed, closed.

use super::changes;
use super::client::Weight;
use super::content::Content;
use super::judge::Task;
use super::kind::Kind;
use super::open::Open;
use super::state::State;
use ls_types::TextDocumentContentChangeEvent;
use std::sync::Arc;

pub(super) fn open(state: &mut State, uri: Arc<str>, language: &str, version: i64, text: String) {
    let kind = Kind::of(language, &uri);
    let settings = state.settings_for(&uri);
    let stamp = state.next_stamp();
    state.log_if_open(&uri);
    state.insert(Open::new(
        uri,
        version,
        Task::Text { kind, text },
        settings,
        stamp,
    ));
    if kind == Kind::Settings {
        state.settings_changed();
    }
}

pub(super) fn change(
    state: &mut State,
    uri: &Arc<str>,
    version: i64,
    changes: Vec<TextDocumentContentChangeEvent>,
) {
    let encoding = state.encoding;
    let Some(open) = state.documents.get_mut(uri).filter(|open| !open.is_drawing) else {
        state
            .client
            .log(Weight::Warning, say!(was_changed_without_being_open, uri));
        return;
    };
    if !matches!(open.content, Content::Settings(_)) {
        state.add_task(uri, Task::Change { version, changes });
        return;
    }
    open.version = open.version.max(version);
    changes::make(&mut open.content, changes, encoding);
    state.mark_dirty(uri);
    state.settings_changed();
}

pub(super) fn close(state: &mut State, uri: &Arc<str>) {
    match state.documents.get(uri).map(|open| {
        (
            open.is_drawing,
            matches!(open.content, Content::Settings(_)),
        )
    }) {
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
