//! `wedm/picture`: contours, faults and wire path as SVG.

use super::{Errand, Subject, Task, run, subject_of, with_options, written};
use crate::picture::svg;
use crate::protocol::Picture;
use crate::server::state::State;
use crate::toolpath::plan_while;
use serde_json::Value;

pub(in crate::server) fn picture(state: &mut State, uri: &str, options: Option<&Value>, errand: Errand) {
    let prepared = subject_of(state, uri).and_then(|subject| Ok((subject, with_options(state, uri, options)?)));
    match prepared {
        Err(error) => {
            let _ = errand.reply.send(Err(error));
        }
        Ok((Subject { document, stamp, small }, options)) => {
            run(state, "Drawing the picture", uri, (stamp, small), errand, move |cancel, _| {
                let task = Task::new(document, options)?;
                // Where no path can be made the picture shows the contours, and the findings say why.
                let paths = plan_while(&task.drawing, &task.outlines, &task.settings, None, &|| !cancel.is_cancelled()).unwrap_or_default();
                written(&Picture { svg: svg(&task.drawing, &task.outlines, &task.findings(), &paths, task.unit_mm()) })
            });
        }
    }
}
