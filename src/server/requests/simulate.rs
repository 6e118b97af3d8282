//! `wedm/simulate`: where the machine goes.

use super::{Errand, program_of, run, written};
use crate::protocol::{Simulate, Simulation};
use crate::server::state::State;
use tower_lsp::jsonrpc::Error;

pub(in crate::server) fn simulate(state: &mut State, params: Simulate, errand: Errand) {
    if let Some(feed) = params.feed.filter(|feed| *feed <= 0.0) {
        let _ = errand.reply.send(Err(Error::invalid_params(format!(
            "feed is {feed}, expected mm/min above 0"
        ))));
        return;
    }
    match program_of(state, &params.uri) {
        Err(error) => {
            let _ = errand.reply.send(Err(error));
        }
        Ok(subject) => {
            let feed = params.feed;
            run(
                state,
                "Following the program",
                &params.uri,
                (subject.stamp, subject.small),
                errand,
                move |_, _| {
                    let trace = subject
                        .document
                        .program()
                        .map(crate::program::Document::trace)
                        .unwrap_or_default();
                    written(&Simulation::of(&trace, feed))
                },
            );
        }
    }
}
