//! `workspace/executeCommand` of `wedm.applyDrawingEdit`: the client is asked to change its drawing.

use super::{moved_on, refused};
use crate::protocol::{Applied, ApplyDrawingEdit, DrawingEdit, method};
use crate::server::state::{Reply, State};
use serde_json::Value;
use tower_lsp::jsonrpc::Error;

/// Asks the client; the command is answered when the client has.
pub(in crate::server) fn execute(
    state: &mut State,
    command: &str,
    mut arguments: Vec<Value>,
    reply: Reply<Option<Value>>,
) {
    if command != method::APPLY_DRAWING_EDIT_COMMAND {
        let message = format!(
            "command is \"{command}\", expected \"{}\"",
            method::APPLY_DRAWING_EDIT_COMMAND
        );
        let _ = reply.send(Err(Error::invalid_params(message)));
        return;
    }
    let edit = match arguments
        .pop()
        .filter(|_| arguments.is_empty())
        .map(serde_json::from_value::<DrawingEdit>)
    {
        Some(Ok(edit)) => edit,
        Some(Err(error)) => {
            let _ = reply.send(Err(Error::invalid_params(format!(
                "the argument is no drawing edit: {error}"
            ))));
            return;
        }
        None => {
            let _ = reply.send(Err(Error::invalid_params(
                "the command takes one argument { uri, version, changes }",
            )));
            return;
        }
    };
    if let Err(error) = check(state, &edit) {
        let _ = reply.send(Err(error));
        return;
    }
    state.client.ask(
        method::APPLY_DRAWING_EDIT,
        ApplyDrawingEdit { edit },
        move |_, answer| {
            let applied = answer.and_then(|answer| {
                serde_json::from_value::<Applied>(answer).map_err(|error| error.to_string())
            });
            let applied = applied.unwrap_or_else(|reason| Applied {
                applied: false,
                failure_reason: Some(reason),
            });
            let _ = reply.send(
                serde_json::to_value(applied)
                    .map(Some)
                    .map_err(|error| super::internal(error.to_string())),
            );
        },
    );
}

fn check(state: &mut State, edit: &DrawingEdit) -> Result<(), Error> {
    let open = state.document(&edit.uri)?;
    if !open.is_drawing {
        return Err(Error::invalid_params(format!(
            "{} is a text, expected a drawing",
            edit.uri
        )));
    }
    if open.version != edit.version {
        return Err(moved_on());
    }
    match state.client.abilities.apply_drawing_edit {
        true => Ok(()),
        false => Err(refused(
            "the client did not declare experimental.wedm.applyDrawingEdit: apply the argument yourself",
        )),
    }
}
