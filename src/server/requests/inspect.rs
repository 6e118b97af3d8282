//! `wedm/inspect`: the radius list.

use super::{Errand, is_small, refused, run, written};
use crate::protocol::{Inspect, Inspection};
use crate::server::state::State;
use tower_lsp::jsonrpc::{Error, Result};

pub(in crate::server) fn inspect(state: &mut State, params: Inspect, errand: Errand) {
    match prepare(state, &params) {
        Err(error) => {
            let _ = errand.reply.send(Err(error));
        }
        Ok((marks, work)) => run(state, "Listing radii", &params.uri, marks, errand, move |_, _| written(&work())),
    }
}

/// The findings are taken on the state thread, which keeps them; the list is made from a snapshot.
fn prepare(state: &mut State, params: &Inspect) -> Result<((u64, bool), impl FnOnce() -> Inspection + Send + use<>)> {
    let uri = &params.uri;
    let open = state.document(uri)?;
    let stamp = open.stamp;
    let document = open.document().ok_or_else(|| refused(format!("{uri} holds no drawing")))?;
    let (findings, _) = document.findings(usize::MAX);
    let drawing = document.drawing().ok_or_else(|| refused(format!("{uri} is a program, expected a drawing")))?.clone();
    let handle = params.handle.clone();
    if let Some(handle) = handle.as_deref().filter(|handle| drawing.find(handle).is_none()) {
        return Err(Error::invalid_params(format!("there is no entity {handle}")));
    }
    let settings = document.settings().clone();
    let marks = (stamp, is_small(&drawing));
    Ok((marks, move || {
        let unit = settings.unit_of(&drawing);
        let zero_length = settings.tolerances.in_units(unit.mm).zero_length;
        Inspection::new(&drawing, unit.mm, zero_length, &findings, handle.as_deref())
    }))
}
