//! `workspace/executeCommand`: asks the client to change its drawing, or its program's text.

use crate::program;
use crate::protocol::method::{self, messages};
use crate::protocol::{Applied, ApplyDrawingEdit, DrawingEdit, ScaleProgram};
use crate::server::context::RequestContext;
use crate::server::errors::{internal, moved_on, refused};
use crate::server::state::{Reply, State};
use ls_types::{ApplyWorkspaceEditParams, WorkspaceEdit};
use serde::de::DeserializeOwned;
use serde_json::Value;
use tower_lsp::jsonrpc::{Error, Result};

/// The only argument of a command; `misfit` and `shape` say what is wrong with any other, and what is expected.
fn argument<T: DeserializeOwned>(arguments: Vec<Value>, misfit: &str, shape: &str) -> Result<T> {
    let [argument] = <[Value; 1]>::try_from(arguments)
        .map_err(|_| Error::invalid_params(say!(the_command_takes_one_argument, shape)))?;
    serde_json::from_value(argument)
        .map_err(|error| Error::invalid_params(say!(the_argument_misfits, misfit, error)))
}

/// The argument of `wedm.applyDrawingEdit`.
pub(in crate::server) fn drawing_edit(command: &str, arguments: Vec<Value>) -> Result<DrawingEdit> {
    if command != method::APPLY_DRAWING_EDIT_COMMAND {
        let expected = method::APPLY_DRAWING_EDIT_COMMAND;
        let message = say!(the_command_is_not_known, command, expected);
        return Err(Error::invalid_params(message));
    }
    argument(
        arguments,
        say!(is_no_drawing_edit),
        "{ uri, version, changes }",
    )
}

/// Asks the client to change its drawing; the command is answered when the client has.
pub(in crate::server) fn apply_drawing_edit(
    state: &mut State,
    edit: DrawingEdit,
    reply: Reply<Option<Value>>,
) {
    if let Err(error) = check(state, &edit) {
        let _ = reply.send(Err(error));
        return;
    }
    let params = ApplyDrawingEdit { edit };
    let client = &mut state.client;
    client.ask_own::<messages::ApplyDrawingEdit>(params, move |_, answer| {
        let applied = answer.unwrap_or_else(|reason| Applied {
            applied: false,
            failure_reason: Some(reason),
        });
        let applied = serde_json::to_value(applied).map(Some);
        let _ = reply.send(applied.map_err(|error| internal(error.to_string())));
    });
}

fn check(state: &mut State, edit: &DrawingEdit) -> Result<()> {
    let open = state.document(&edit.uri)?;
    if !open.is_drawing {
        return Err(Error::invalid_params(say!(
            is_a_text_expected_a_drawing,
            edit.uri
        )));
    }
    if open.version != edit.version {
        return Err(moved_on());
    }
    match state.client.abilities.apply_drawing_edit {
        true => Ok(()),
        false => Err(refused(say!(the_client_applies_no_drawing_edits))),
    }
}

/// The argument of `wedm.scale`.
pub(in crate::server) fn scale_program(arguments: Vec<Value>) -> Result<ScaleProgram> {
    argument(arguments, say!(does_not_fit), "{ uri, factor }")
}

/// The edit that scales a program by the user's factor.
pub(in crate::server) fn scaled(
    context: &RequestContext,
    params: ScaleProgram,
) -> Result<WorkspaceEdit> {
    if !context.abilities.apply_edit {
        return Err(refused(say!(the_client_applies_no_text_edits)));
    }
    let (Some(program), Some(document)) = (context.program(), context.document()) else {
        return Err(refused(say!(is_no_program, context.uri)));
    };
    let edits = program::scaled(program, document.settings(), params.factor).map_err(refused)?;
    context.workspace_edit(program.text(), edits)
}

/// Asks the client to change its text; the command is answered when the client has.
pub(in crate::server) fn apply_edit(
    state: &mut State,
    edit: WorkspaceEdit,
    reply: Reply<Option<Value>>,
) {
    let params = ApplyWorkspaceEditParams {
        label: Some("Scale".into()),
        edit,
    };
    let client = &mut state.client;
    client.ask("workspace/applyEdit", params, move |_, answer| {
        let _ = reply.send(answer.map(Some).map_err(internal));
    });
}
