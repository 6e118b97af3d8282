//! `wedm/toolpath`: the path of the wire's centre.

use super::{Errand, Subject, Task, refusal, run, subject_of, with_options, written};
use crate::protocol::Toolpath;
use crate::server::state::State;
use crate::toolpath::plan_while;
use serde_json::Value;

pub(in crate::server) fn toolpath(
    state: &mut State,
    uri: &str,
    options: Option<&Value>,
    errand: Errand,
) {
    let encoding = state.encoding;
    let prepared = subject_of(state, uri)
        .and_then(|subject| Ok((subject, with_options(state, uri, options)?)));
    match prepared {
        Err(error) => {
            let _ = errand.reply.send(Err(error));
        }
        Ok((
            Subject {
                document,
                stamp,
                small,
            },
            options,
        )) => {
            run(
                state,
                "Laying the wire's path",
                uri,
                (stamp, small),
                errand,
                move |cancel, _| {
                    let task = Task::new(document, options)?;
                    let paths =
                        plan_while(&task.drawing, &task.outlines, &task.settings, None, &|| {
                            !cancel.is_cancelled()
                        })
                        .map_err(|reason| refusal(&task, reason, encoding))?;
                    written(&Toolpath::new(&task.drawing, &paths, task.unit_mm()))
                },
            );
        }
    }
}
