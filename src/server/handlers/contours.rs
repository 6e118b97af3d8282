//! `wedm/contours`: the chained contours.

use super::Task;
use crate::protocol::{Contours, ContoursOf};
use crate::server::context::RequestContext;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn contours(context: &RequestContext, asked: ContoursOf) -> Result<Contours> {
    let task = Task::of(context)?;
    let snapshot = &task.snapshot;
    let in_short = asked.segments == Some(false);
    Ok(Contours::listed(
        &snapshot.drawing,
        &snapshot.outlines,
        &snapshot.settings,
        in_short,
    ))
}
