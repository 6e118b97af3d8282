//! `wedm/contours`: what is chained to what.

use super::{Errand, Subject, Task, run, subject_of, written};
use crate::protocol::{Contours, DrawingName};
use crate::server::state::State;

pub(in crate::server) fn contours(state: &mut State, params: DrawingName, errand: Errand) {
    match subject_of(state, &params.uri) {
        Err(error) => {
            let _ = errand.reply.send(Err(error));
        }
        Ok(Subject {
            document,
            stamp,
            small,
        }) => {
            run(
                state,
                "Listing contours",
                &params.uri,
                (stamp, small),
                errand,
                move |_, _| {
                    let task = Task::new(document, None)?;
                    written(&Contours::new(
                        &task.drawing,
                        &task.outlines,
                        &task.settings,
                    ))
                },
            );
        }
    }
}
