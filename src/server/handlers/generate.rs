//! `wedm/generate`: a proved program, or the reason why there is none.

use super::{Task, no_entity};
use crate::document::Source;
use crate::finding::{Finding, Severity};
use crate::program::{Format, ProofError};
use crate::protocol::{Diagnostic, Program};
use crate::server::context::RequestContext;
use crate::server::convert;
use crate::server::errors::{internal, refusal, refused, refused_with};
use crate::toolpath::{Refusal, entities_of};
use serde::Deserialize;
use std::sync::Arc;
use tower_lsp::jsonrpc::{Error, Result};

/// Params of the request, beside the document and the options.
#[derive(Deserialize)]
pub(in crate::server) struct Params {
    format: String,
    handles: Option<Vec<String>>,
    force: Option<bool>,
}

pub(in crate::server) fn generate(context: &RequestContext, params: Params) -> Result<Program> {
    let format = Format::of(&params.format).map_err(Error::invalid_params)?;
    let task = Task::of(context)?;
    for handle in params.handles.iter().flatten() {
        if task.drawing.find(handle).is_none() {
            return Err(no_entity(handle));
        }
    }
    if let Some(sentence) = task.settings.pass_error() {
        return Err(refused(sentence));
    }
    let force = params.force.unwrap_or(false);
    let handles = params.handles.as_deref();
    let entities = entities_of(&task.drawing, &task.outlines, handles);
    let mut findings = findings(&task);
    findings.retain(|finding| finding.concerns(entities.as_ref()));
    let diagnostics = |wanted: &dyn Fn(Severity) -> bool| -> Vec<Diagnostic> {
        let wanted = findings
            .iter()
            .filter(|finding| wanted(finding.severity))
            .take(convert::PUBLISH_LIMIT);
        wanted
            .map(|finding| convert::diagnostic(&task.subject, finding, context.encoding, None))
            .collect()
    };
    let errors = findings
        .iter()
        .filter(|finding| finding.severity == Severity::Error)
        .count();
    if errors > 0 && !force {
        let message = match errors {
            1 => say!(an_error_stands_in_the).to_string(),
            _ => say!(errors_stand_in_the_drawing, errors),
        };
        return Err(refused_with(
            message,
            diagnostics(&|severity| severity == Severity::Error),
        ));
    }
    context.check()?;
    context.progress.report(say!(laying_the_wire_path));
    let settings = format.settings(&task.settings);
    let paths = task.paths(context, &settings, handles)?;
    if paths.is_empty() {
        return Err(refused(say!(the_drawing_holds_no_contour)));
    }
    context.check()?;
    let mut go_on = |done: usize, all: usize| {
        context
            .progress
            .share(say!(writing_and_proving_the_program), done, all);
        !context.is_cancelled()
    };
    let program = format
        .write(&paths, task.unit_mm(), &task.settings, &mut go_on)
        .map_err(|error| match error {
            ProofError::Refused(sentence) => refused(sentence),
            ProofError::Unwritable(finding) => refusal(
                &task.subject,
                Refusal::Findings(vec![*finding]),
                context.encoding,
            ),
            ProofError::Cancelled => Error::request_cancelled(),
            // What comes of errors that were passed over is theirs.
            ProofError::Mismatch(reason) if force => {
                let message = say!(no_program_could_be_proved, reason);
                refused_with(
                    message,
                    diagnostics(&|severity| severity == Severity::Error),
                )
            }
            ProofError::Mismatch(reason) => internal(say!(the_program_does_not_hold, reason)),
        })?;
    let one_pass = task
        .settings
        .one_pass()
        .map(|finding| convert::diagnostic(&task.subject, &finding, context.encoding, None));
    let warnings = one_pass
        .into_iter()
        .chain(diagnostics(&|severity| severity <= Severity::Warning));
    Ok(Program::new(
        program,
        warnings.take(convert::PUBLISH_LIMIT).collect(),
    ))
}

/// What the reader of the text found, and what the rules say under the request's options.
fn findings(task: &Task) -> Vec<Finding> {
    let of_rules = task.findings();
    if Arc::ptr_eq(&task.document, &task.subject) {
        return of_rules;
    }
    let Source::Dxf(dxf) = task.subject.source() else {
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
