//! `wedm/toolpath`: the path of the wire's centre.

use super::Task;
use crate::protocol::{DrawingName, Toolpath};
use crate::server::context::RequestContext;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn toolpath(context: &RequestContext, _: DrawingName) -> Result<Toolpath> {
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
