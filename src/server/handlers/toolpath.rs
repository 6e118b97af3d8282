//! `wedm/toolpath`: the path of the wire's centre.

use super::{Task, WithOptions};
use crate::protocol::Toolpath;
use crate::server::context::RequestContext;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn toolpath(context: &RequestContext, _: WithOptions) -> Result<Toolpath> {
    let task = Task::of(context)?;
    let paths = task.paths(context, &task.settings, None)?;
    Ok(Toolpath::new(&task.drawing, &paths, task.unit_mm()))
}
