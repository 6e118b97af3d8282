//! `wedm/simulate`: the path of the machine.

use crate::protocol::{Simulate, Simulation};
use crate::server::context::RequestContext;
use crate::server::errors::refused;
use tower_lsp::jsonrpc::{Error, Result};

pub(in crate::server) fn simulate(
    context: &RequestContext,
    params: Simulate,
) -> Result<Simulation> {
    if let Some(feed) = params.feed.filter(|feed| *feed <= 0.0) {
        let message = say!(the_feed_is_not_above_0, feed);
        return Err(Error::invalid_params(message));
    }
    let document = context
        .document()
        .ok_or_else(|| refused(say!(holds_no_program, context.uri)))?;
    let program = document
        .program()
        .ok_or_else(|| refused(say!(is_a_drawing_expected_a_program, context.uri)))?;
    Ok(Simulation::of(&program.trace(), params.feed))
}
