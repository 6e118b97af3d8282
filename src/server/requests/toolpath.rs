//! `wedm/toolpath`: the path of the wire's centre.

use super::{Errand, Task, is_small, places_of, refusal, run, snapshot_of, with_options, written};
use crate::protocol::Toolpath;
use crate::server::state::State;
use crate::toolpath::plan;
use serde_json::Value;

pub(in crate::server) fn toolpath(state: &mut State, uri: &str, options: Option<&Value>, errand: Errand) {
    let prepared = snapshot_of(state, uri).and_then(|snapshot| Ok((snapshot, with_options(state, uri, options)?, places_of(state, uri)?)));
    match prepared {
        Err(error) => {
            let _ = errand.reply.send(Err(error));
        }
        Ok(((snapshot, stamp), options, places)) => {
            let marks = (stamp, is_small(&snapshot.drawing));
            run(state, "Laying the wire's path", uri, marks, errand, move |_, _| {
                let task = Task::new(snapshot, options);
                let paths = plan(&task.drawing, &task.outlines, &task.settings, None).map_err(|reason| refusal(&task, reason, &places))?;
                written(&Toolpath::new(&task.drawing, &paths, task.unit_mm()))
            });
        }
    }
}
