//! `wedm/generate`: a proved program, or the reason why there is none.

use super::{
    Errand, Subject, Task, internal, refusal, refused, refused_with, run, subject_of, with_options,
    written,
};
use crate::document::{Document, Source};
use crate::finding::{Finding, Severity};
use crate::program::{Format, ProofError};
use crate::protocol::{Diagnostic, Program};
use crate::server::convert;
use crate::server::jobs::{Cancel, Progress};
use crate::server::state::State;
use crate::settings::Effective;
use crate::text::Encoding;
use crate::toolpath::{entities_of, plan_while};
use serde::Deserialize;
use serde_json::Value;
use std::sync::Arc;
use tower_lsp::jsonrpc::{Error, Result};

/// Params of the request; the options are read by the settings' own reader, which names a misfit.
#[derive(Deserialize)]
pub(in crate::server) struct Params {
    uri: String,
    format: String,
    handles: Option<Vec<String>>,
    options: Option<Value>,
    force: Option<bool>,
}

pub(in crate::server) fn generate(state: &mut State, params: Params, errand: Errand) {
    match prepare(state, &params) {
        Err(error) => {
            let _ = errand.reply.send(Err(error));
        }
        Ok(job) => {
            let stamp = job.stamp;
            run(
                state,
                "Generating the program",
                &params.uri,
                (stamp, false),
                errand,
                move |cancel, progress| job.run(cancel, progress),
            );
        }
    }
}

struct Job {
    format: Format,
    document: Arc<Document>,
    stamp: u64,
    options: Option<Arc<Effective>>,
    handles: Option<Vec<String>>,
    force: bool,
    encoding: Encoding,
}

fn prepare(state: &mut State, params: &Params) -> Result<Job> {
    let uri = &params.uri;
    let format = Format::of(&params.format).map_err(Error::invalid_params)?;
    let options = with_options(state, uri, params.options.as_ref())?;
    let Subject {
        document, stamp, ..
    } = subject_of(state, uri)?;
    for handle in params.handles.iter().flatten() {
        if document
            .drawing()
            .is_none_or(|drawing| drawing.find(handle).is_none())
        {
            return Err(Error::invalid_params(format!(
                "there is no entity {handle}"
            )));
        }
    }
    let force = params.force.unwrap_or(false);
    Ok(Job {
        format,
        document,
        stamp,
        options,
        handles: params.handles.clone(),
        force,
        encoding: state.encoding,
    })
}

impl Job {
    fn run(self, cancel: &Cancel, progress: &Progress) -> Result<Vec<u8>> {
        let task = Task::new(self.document.clone(), self.options.clone())?;
        if let Some(sentence) = task.settings.pass_error() {
            return Err(refused(sentence));
        }
        let handles = self.handles.as_deref();
        let entities = entities_of(&task.drawing, &task.outlines, handles);
        let mut findings = self.findings(&task);
        findings.retain(|finding| finding.concerns(entities.as_ref()));
        let diagnostics = |wanted: &dyn Fn(Severity) -> bool| -> Vec<Diagnostic> {
            let wanted = findings
                .iter()
                .filter(|finding| wanted(finding.severity))
                .take(convert::PUBLISH_LIMIT);
            wanted
                .map(|finding| convert::diagnostic(&self.document, finding, self.encoding, None))
                .collect()
        };
        let errors = findings
            .iter()
            .filter(|finding| finding.severity == Severity::Error)
            .count();
        if errors > 0 && !self.force {
            let message = match errors {
                1 => "an error stands in the drawing".to_string(),
                _ => format!("{errors} errors stand in the drawing"),
            };
            return Err(refused_with(
                message,
                diagnostics(&|severity| severity == Severity::Error),
            ));
        }
        stop_if(cancel)?;
        progress.report("laying the wire's path");
        let settings = self.format.settings(&task.settings);
        let paths = plan_while(&task.drawing, &task.outlines, &settings, handles, &|| {
            !cancel.is_cancelled()
        })
        .map_err(|reason| refusal(&task, reason, self.encoding))?;
        if paths.is_empty() {
            return Err(refused("the drawing holds no contour to cut"));
        }
        stop_if(cancel)?;
        let mut go_on = |done: usize, all: usize| {
            progress.share("writing and proving the program", done, all);
            !cancel.is_cancelled()
        };
        let program = self
            .format
            .write(&paths, task.unit_mm(), &task.settings, &mut go_on)
            .map_err(|error| match error {
                ProofError::Refused(sentence) => refused(sentence),
                ProofError::Cancelled => Error::request_cancelled(),
                // What comes of errors that were passed over is theirs.
                ProofError::Mismatch(reason) if self.force => {
                    let message = format!("no program could be proved for this drawing: {reason}");
                    refused_with(
                        message,
                        diagnostics(&|severity| severity == Severity::Error),
                    )
                }
                ProofError::Mismatch(reason) => {
                    internal(format!("the program does not hold its proof: {reason}"))
                }
            })?;
        let one_pass = task
            .settings
            .one_pass()
            .map(|finding| convert::diagnostic(&self.document, &finding, self.encoding, None));
        let warnings = one_pass
            .into_iter()
            .chain(diagnostics(&|severity| severity <= Severity::Warning));
        written(&Program::new(
            program,
            warnings.take(convert::PUBLISH_LIMIT).collect(),
        ))
    }
}

impl Job {
    /// What the reader of the text found, and what the rules say under the request's options.
    fn findings(&self, task: &Task) -> Vec<Finding> {
        let of_rules = task.findings();
        if Arc::ptr_eq(&task.document, &self.document) {
            return of_rules;
        }
        let Source::Dxf(dxf) = self.document.source() else {
            return of_rules;
        };
        let of_source = dxf.findings().iter().filter_map(|finding| {
            let severity = task.settings.severity_of(finding)?;
            Some(Finding {
                severity,
                ..finding.clone()
            })
        });
        of_source.chain(of_rules).collect()
    }
}

fn stop_if(cancel: &Cancel) -> Result<()> {
    if cancel.is_cancelled() {
        Err(Error::request_cancelled())
    } else {
        Ok(())
    }
}
