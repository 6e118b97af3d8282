//! Drawings without text: opened, changed by splices, closed, and requested again when a change does not fit.

use super::client::Weight;
use super::judge::Task;
use super::open::Open;
use super::state::State;
use crate::drawing::Drawing;
use crate::protocol::method::{Message, messages};
use crate::protocol::{self, DrawingChange, ResendDrawing, Resent};
use serde_json::Value;
use std::sync::Arc;

/// A drawing as it came, or why it is not sound.
pub(super) struct Sent {
    pub(crate) uri: Arc<str>,
    pub(crate) drawing: Result<(i64, Drawing), String>,
}

impl Sent {
    /// Reads the params of `wedm/didOpenDrawing`; `Err` where not even the URI can be read.
    pub(crate) fn read(mut params: Value) -> Result<Sent, String> {
        let drawing = params
            .get_mut("drawing")
            .map(Value::take)
            .unwrap_or_default();
        let uri = drawing
            .get("uri")
            .and_then(Value::as_str)
            .ok_or(say!(drawing_uri_is_no_string))?;
        let uri: Arc<str> = uri.into();
        let read =
            serde_json::from_value::<protocol::Drawing>(drawing).map_err(|error| error.to_string());
        let drawing = read.and_then(|drawing| Ok((drawing.version, drawing.into_core()?)));
        Ok(Sent { uri, drawing })
    }
}

pub(super) fn open(state: &mut State, sent: Sent) {
    let Sent { uri, drawing } = sent;
    match drawing {
        Ok((version, drawing)) => {
            state.log_if_open(&uri);
            insert(state, uri, version, drawing);
        }
        Err(reason) => refuse(state, &uri, &say!(the_drawing_is_not_sound, uri, reason)),
    }
}

fn insert(state: &mut State, uri: Arc<str>, version: i64, drawing: Drawing) {
    if state.config.bars(&uri) {
        return state
            .client
            .show(Weight::Error, say!(says, uri, say!(it_lies_outside)));
    }
    let name = messages::DidOpenDrawing::NAME;
    state.with_file(name, uri.clone(), move |state, file| {
        let settings = state.config.effective_for(&uri, file.as_deref());
        let first = Task::Drawing(Box::new(drawing));
        let stamp = state.next_stamp();
        state.insert(Open::new(uri, version, first, settings, stamp));
    });
}

/// Changes as they came, or why they cannot be read.
pub(super) struct SentChanges {
    pub(crate) uri: Arc<str>,
    pub(crate) changes: Result<(i64, Vec<DrawingChange>), String>,
}

impl SentChanges {
    /// Reads the params of `wedm/didChangeDrawing`; `Err` where not even the URI can be read.
    pub(crate) fn read(params: Value) -> Result<SentChanges, String> {
        let uri = params
            .pointer("/drawing/uri")
            .and_then(Value::as_str)
            .ok_or(say!(drawing_uri_is_no_string))?;
        let uri: Arc<str> = uri.into();
        let changes = serde_json::from_value::<protocol::ChangeDrawing>(params);
        let changes = changes
            .map(|params| (params.drawing.version, params.changes))
            .map_err(|error| error.to_string());
        Ok(SentChanges { uri, changes })
    }
}

pub(super) fn change(state: &mut State, sent: SentChanges) {
    let SentChanges { uri, changes } = sent;
    let is_open = state
        .documents
        .get(&uri)
        .is_some_and(|open| open.is_drawing);
    match changes {
        Ok((version, changes)) if is_open => {
            state.add_task(&uri, Task::ChangeDrawing { version, changes })
        }
        Ok(_) => does_not_apply(state, &uri, say!(there_is_no_such_drawing_open)),
        Err(reason) => does_not_apply(state, &uri, &reason),
    }
}

/// Called when a change of a drawing was not made.
pub(super) fn does_not_apply(state: &mut State, uri: &Arc<str>, reason: &str) {
    refuse(
        state,
        uri,
        &say!(a_change_of_the_drawing_does_not_apply, uri, reason),
    );
}

pub(super) fn close(state: &mut State, uri: &Arc<str>) {
    state.resending.remove(uri);
    let is_open = state.documents.get(uri).is_some_and(|open| open.is_drawing);
    if !is_open || !state.close(uri) {
        state.client.log(
            Weight::Warning,
            say!(the_drawing_was_closed_without_being_open, uri),
        );
    }
}

/// Reports why nothing was changed, and requests the whole drawing, once at a time.
pub(super) fn refuse(state: &mut State, uri: &Arc<str>, reason: &str) {
    state.client.log(Weight::Warning, reason);
    if !state.client.abilities.resend_drawing || !state.resending.insert(uri.clone()) {
        return;
    }
    let params = ResendDrawing {
        uri: uri.to_string(),
    };
    let uri = uri.clone();
    let about = uri.clone();
    let take = move |state: &mut State, answer: Result<Resent, String>| {
        // A drawing that was closed meanwhile stays closed.
        if !state.resending.remove(&uri) {
            return;
        }
        let drawing = answer.and_then(|resent| resent_drawing(state, &uri, resent));
        if let Err(reason) = drawing {
            state
                .client
                .log(Weight::Warning, say!(the_drawing_was_not_sent, uri, reason));
        }
    };
    state
        .client
        .ask_own::<messages::ResendDrawing>(params, move |state, answer| {
            state.in_turn(messages::ResendDrawing::NAME, about, move |state| {
                take(state, answer)
            });
        });
}

fn resent_drawing(state: &mut State, uri: &Arc<str>, resent: Resent) -> Result<(), String> {
    let drawing = resent.drawing;
    if *drawing.uri != **uri {
        return Err(say!(its_uri_is, drawing.uri));
    }
    let version = drawing.version;
    if let Some(open) = state
        .documents
        .get(uri)
        .filter(|open| open.version > version)
    {
        return Err(say!(version_is_older_than, version, open.version));
    }
    insert(state, uri.clone(), version, drawing.into_core()?);
    Ok(())
}
