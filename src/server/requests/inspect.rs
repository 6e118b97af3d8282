//! `wedm/inspect`: the radius list.

use super::{Errand, Subject, refused, run, subject_of, written};
use crate::protocol::{Inspect, Inspection};
use crate::server::state::State;
use tower_lsp::jsonrpc::{Error, Result};

pub(in crate::server) fn inspect(state: &mut State, params: Inspect, errand: Errand) {
    match prepare(state, &params) {
        Err(error) => {
            let _ = errand.reply.send(Err(error));
        }
        Ok(Subject {
            document,
            stamp,
            small,
        }) => {
            let Inspect { uri, handle } = params;
            run(
                state,
                "Listing radii",
                &uri,
                (stamp, small),
                errand,
                move |_, _| {
                    let list = Inspection::of(&document, handle.as_deref());
                    written(
                        &list.ok_or_else(|| {
                            refused("the document is a program, expected a drawing")
                        })?,
                    )
                },
            );
        }
    }
}

fn prepare(state: &mut State, params: &Inspect) -> Result<Subject> {
    let subject = subject_of(state, &params.uri)?;
    if let Some(handle) = &params.handle
        && subject
            .document
            .drawing()
            .is_none_or(|drawing| drawing.find(handle).is_none())
    {
        return Err(Error::invalid_params(format!(
            "there is no entity {handle}"
        )));
    }
    Ok(subject)
}
