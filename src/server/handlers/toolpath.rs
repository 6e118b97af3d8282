//! `wedm/toolpath`: the path of the wire's centre; `wedm/holes`: the thread holes as a file for the drill.

use super::Task;
use crate::job::drill;
use crate::protocol::{Exported, HoleForm, Holes, OptionsOf, Toolpath};
use crate::server::config::name_of;
use crate::server::context::RequestContext;
use crate::server::errors::internal;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn toolpath(context: &RequestContext, _: OptionsOf) -> Result<Toolpath> {
    let task = Task::of(context)?;
    let planned = task.planned(context)?;
    let snapshot = &task.snapshot;
    Ok(Toolpath::new(
        &snapshot.drawing,
        &snapshot.outlines,
        &snapshot.settings,
        &planned,
    ))
}

pub(in crate::server) fn holes(context: &RequestContext, asked: Holes) -> Result<Exported> {
    let task = Task::of(context)?;
    let planned = task.planned(context)?;
    let (snapshot, holes) = (&task.snapshot, &drill::drilled(planned.holes));
    let bytes = match asked.format {
        HoleForm::Dxf => {
            let source = task.subject.source();
            let drawn = drill::as_dxf(source, snapshot, holes);
            drawn.map_err(internal)?.bytes
        }
        HoleForm::Csv => {
            let name = name_of(&asked.uri).unwrap_or(asked.uri);
            [drill::HEAD, &drill::rows(&name, snapshot, holes)]
                .concat()
                .into_bytes()
        }
    };
    Ok(Exported::new(&bytes))
}
