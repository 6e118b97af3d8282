//! `wedm/simulate`: where the machine goes.

use super::{Errand, program_of, run, written};
use crate::protocol::{Simulate, Simulation};
use crate::server::state::State;

pub(in crate::server) fn simulate(state: &mut State, params: Simulate, errand: Errand) {
    match program_of(state, &params.uri) {
        Err(error) => {
            let _ = errand.reply.send(Err(error));
        }
        Ok(subject) => {
            let feed = params.feed;
            run(state, "Following the program", &params.uri, (subject.stamp, subject.small), errand, move |_, _| {
                let trace = subject.document.program().map(crate::program::Document::trace).unwrap_or_default();
                written(&Simulation::of(&trace, feed))
            });
        }
    }
}
