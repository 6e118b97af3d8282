//! `wedm/contours`: the chained contours.

use super::Task;
use crate::protocol::{Contours, DrawingName};
use crate::server::context::RequestContext;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn contours(context: &RequestContext, _: DrawingName) -> Result<Contours> {
    let task = Task::of(context)?;
    Ok(Contours::new(
        &task.snapshot.drawing,
        &task.snapshot.outlines,
        &task.snapshot.settings,
    ))
}
