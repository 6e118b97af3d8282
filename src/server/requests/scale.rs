//! `workspace/executeCommand` of `wedm.scale`: a program is scaled by a factor that the user has named.

use super::{Target, internal, refused, workspace_edit};
use crate::program::language::scaled;
use crate::protocol::ScaleProgram;
use crate::server::convert::lsp_edits;
use crate::server::state::{Reply, State};
use ls_types::{ApplyWorkspaceEditParams, Uri, WorkspaceEdit};
use serde_json::Value;
use tower_lsp::jsonrpc::{Error, Result};

/// Asks the client to apply the edit; the command is answered when the client has.
pub(in crate::server) fn execute(
    state: &mut State,
    arguments: Vec<Value>,
    reply: Reply<Option<Value>>,
) {
    let edit = match prepared(state, arguments) {
        Ok(edit) => edit,
        Err(error) => {
            let _ = reply.send(Err(error));
            return;
        }
    };
    let params = ApplyWorkspaceEditParams {
        label: Some("Scale".into()),
        edit,
    };
    state
        .client
        .ask("workspace/applyEdit", params, move |_, answer| {
            let _ = reply.send(answer.map(Some).map_err(internal));
        });
}

fn prepared(state: &mut State, mut arguments: Vec<Value>) -> Result<WorkspaceEdit> {
    let argument: ScaleProgram = match arguments
        .pop()
        .filter(|_| arguments.is_empty())
        .map(serde_json::from_value)
    {
        Some(Ok(argument)) => argument,
        Some(Err(error)) => {
            return Err(Error::invalid_params(format!(
                "the argument does not fit: {error}"
            )));
        }
        None => {
            return Err(Error::invalid_params(
                "the command takes one argument { uri, factor }",
            ));
        }
    };
    if !state.client.abilities.apply_edit {
        return Err(refused(
            "the client did not declare workspace.applyEdit, so it cannot be asked to change its text",
        ));
    }
    let uri: Uri = argument
        .uri
        .parse()
        .map_err(|_| Error::invalid_params(format!("{:?} is no URI", argument.uri)))?;
    let target = Target::of(state, &uri)?;
    let open = state.document(uri.as_str())?;
    let document = open.document().cloned();
    let program = document
        .as_ref()
        .and_then(|document| Some((document.program()?, document.settings())));
    let Some((program, settings)) = program else {
        return Err(refused(format!("{} is no program", uri.as_str())));
    };
    let edits = scaled(program, settings, argument.factor).map_err(refused)?;
    Ok(workspace_edit(
        &target,
        lsp_edits(program.text(), edits, target.encoding),
    ))
}
