//! `wedm/picture`: contours, faults and wire path as SVG.

use super::{Errand, Task, is_small, run, snapshot_of, with_options, written};
use crate::picture::svg;
use crate::protocol::Picture;
use crate::server::state::State;
use crate::toolpath::plan;
use serde_json::Value;

pub(in crate::server) fn picture(state: &mut State, uri: &str, options: Option<&Value>, errand: Errand) {
    let prepared = snapshot_of(state, uri).and_then(|snapshot| Ok((snapshot, with_options(state, uri, options)?)));
    match prepared {
        Err(error) => {
            let _ = errand.reply.send(Err(error));
        }
        Ok(((snapshot, stamp), options)) => {
            let marks = (stamp, is_small(&snapshot.drawing));
            run(state, "Drawing the picture", uri, marks, errand, move |_, _| {
                let task = Task::new(snapshot, options);
                // Where no path can be made the picture shows the contours, and the findings say why.
                let paths = plan(&task.drawing, &task.outlines, &task.settings, None).unwrap_or_default();
                let (findings, _) = task.document().findings(usize::MAX);
                written(&Picture { svg: svg(&task.drawing, &task.outlines, &findings, &paths, task.unit_mm()) })
            });
        }
    }
}
