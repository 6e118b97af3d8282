//! `wedm/contours`: the chained contours.

use super::Task;
use crate::protocol::{Contours, ContoursOf};
use crate::server::context::RequestContext;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn contours(context: &RequestContext, asked: ContoursOf) -> Result<Contours> {
    let task = Task::of(context)?;
    let list = match asked.segments {
        Some(false) => Contours::in_short,
        _ => Contours::new,
    };
    let snapshot = &task.snapshot;
    Ok(list(
        &snapshot.drawing,
        &snapshot.outlines,
        &snapshot.settings,
    ))
}
