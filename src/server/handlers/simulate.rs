//! `wedm/simulate`: where the machine goes.

use crate::protocol::{Simulate, Simulation};
use crate::server::context::RequestContext;
use crate::server::errors::refused;
use tower_lsp::jsonrpc::{Error, Result};

pub(in crate::server) fn simulate(
    context: &RequestContext,
    params: Simulate,
) -> Result<Simulation> {
    if let Some(feed) = params.feed.filter(|feed| *feed <= 0.0) {
        let message = format!("feed is {feed}, expected mm/min above 0");
        return Err(Error::invalid_params(message));
    }
    let document = context
        .document()
        .ok_or_else(|| refused(format!("{} holds no program", context.uri)))?;
    let program = document
        .program()
        .ok_or_else(|| refused(format!("{} is a drawing, expected a program", context.uri)))?;
    Ok(Simulation::of(&program.trace(), params.feed))
}
