//! `wedm/picture`: contours, faults and wire path of a drawing, or the path of a program, as SVG.

use super::{Errand, Subject, Task, program_of, run, subject_of, with_options, written};
use crate::document::Document;
use crate::finding;
use crate::finding::{Finding, Severity};
use crate::picture::{program_svg, svg};
use crate::protocol::Picture;
use crate::server::state::State;
use crate::toolpath::plan_while;
use serde_json::Value;

pub(in crate::server) fn picture(
    state: &mut State,
    uri: &str,
    options: Option<&Value>,
    errand: Errand,
) {
    if state.document(uri).is_ok_and(|open| {
        open.document()
            .is_some_and(|document| document.program().is_some())
    }) {
        return of_program(state, uri, errand);
    }
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
                "Drawing the picture",
                uri,
                (stamp, small),
                errand,
                move |cancel, _| {
                    let task = Task::new(document, options)?;
                    // Where no path can be made the picture shows the contours, and the findings say why.
                    let paths =
                        plan_while(&task.drawing, &task.outlines, &task.settings, None, &|| {
                            !cancel.is_cancelled()
                        })
                        .unwrap_or_default();
                    written(&Picture {
                        svg: svg(
                            &task.drawing,
                            &task.outlines,
                            &task.findings(),
                            &paths,
                            task.unit_mm(),
                        ),
                    })
                },
            );
        }
    }
}

fn of_program(state: &mut State, uri: &str, errand: Errand) {
    match program_of(state, uri) {
        Err(error) => {
            let _ = errand.reply.send(Err(error));
        }
        Ok(Subject {
            document,
            stamp,
            small,
        }) => run(
            state,
            "Drawing the picture",
            uri,
            (stamp, small),
            errand,
            move |_, _| {
                let trace = document
                    .program()
                    .map(crate::program::Document::trace)
                    .unwrap_or_default();
                written(&Picture {
                    svg: program_svg(&trace, &faults(&document)),
                })
            },
        ),
    }
}

/// What is wrong, by lines from 0.
fn faults(document: &Document) -> Vec<(usize, Severity, String)> {
    let line = |finding: &Finding| {
        Some(
            document
                .text()?
                .line_of(document.range_of(&finding.place)?.start),
        )
    };
    document
        .all_findings()
        .iter()
        .filter_map(|finding| {
            Some((
                line(finding)?,
                finding.severity,
                finding::sentence(finding, 1.0),
            ))
        })
        .collect()
}
