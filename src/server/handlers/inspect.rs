//! `wedm/inspect`: the radius list.

use super::no_entity;
use crate::protocol::{Inspect, Inspection};
use crate::server::context::RequestContext;
use crate::server::errors::refused;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn inspect(context: &RequestContext, params: Inspect) -> Result<Inspection> {
    let document = context.drawn()?;
    let handle = params.handle.as_deref();
    if let (Some(handle), Some(drawing)) = (handle, document.drawing())
        && drawing.find(handle).is_none()
    {
        return Err(no_entity(handle));
    }
    Inspection::of(document, handle).ok_or_else(|| refused(say!(the_document_is_a_program)))
}
