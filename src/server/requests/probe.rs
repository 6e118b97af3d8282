//! Hidden methods for the tests of the real process: panics at each place that must survive one, and handlers that wait
//! for the client.

use super::Errand;
use crate::server::state::{Reply, State};
use serde::Deserialize;
use serde_json::Value;

/// Where a panic is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(in crate::server) enum Site {
    Handler,
    State,
    Worker,
}

#[derive(Deserialize)]
pub(in crate::server) struct Panic {
    pub site: Site,
    /// The document whose derived data the panic leaves in doubt.
    #[serde(default)]
    pub uri: String,
}

pub(in crate::server) fn panic_on_state_thread() -> ! {
    panic!("asked for by wedm/test/panic")
}

pub(in crate::server) fn panic_on_worker(state: &mut State, errand: Errand) {
    let Errand { reply, cancel, .. } = errand;
    let workers = state.workers.clone();
    workers.run(
        "wedm/test/panic",
        cancel,
        |_| -> Vec<u8> { panic!("asked for by wedm/test/panic") },
        move |_, result| {
            let _ = reply
                .send(result.map_err(|panic| super::internal(format!("internal error: {panic}"))));
        },
    );
}

/// Waits for the client's answer to `wedm/test/question`.
pub(in crate::server) fn ask(state: &mut State, reply: Reply<Value>) {
    state
        .client
        .ask("wedm/test/question", Value::Null, move |_, answer| {
            let _ = reply.send(answer.map_err(super::internal));
        });
}
