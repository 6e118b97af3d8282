//! Hidden methods for the tests of the real process: panics at each place that must survive one, and handlers that wait
//! for the client.

use crate::server::errors::internal;
use crate::server::state::{Reply, State};
use serde::Deserialize;
use serde_json::Value;

/// Where to panic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(in crate::server) enum Site {
    Handler,
    State,
    Worker,
}

#[derive(Deserialize)]
pub(in crate::server) struct Panic {
    pub(crate) site: Site,
    /// The document whose derived data the panic leaves in doubt.
    #[serde(default)]
    pub(crate) uri: String,
}

pub(in crate::server) fn panic(state: &mut State, site: Site, reply: Reply<Value>) {
    match site {
        Site::Worker => state.workers.run(false, || true, || panic_holding(reply)),
        Site::Handler | Site::State => panic_holding(reply),
    }
}

#[expect(clippy::panic, reason = "that is what it is asked for")]
fn panic_holding(_held: Reply<Value>) {
    panic!("asked for by wedm/test/panic")
}

/// Waits for the client's answer to `wedm/test/question`.
pub(in crate::server) fn ask(state: &mut State, reply: Reply<Value>) {
    state
        .client
        .ask("wedm/test/question", Value::Null, move |_, answer| {
            let _ = reply.send(answer.map_err(internal));
        });
}
