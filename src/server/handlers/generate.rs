//! `wedm/generate`: a proved program, or the reason why there is none.

use super::{Task, no_entity};
use crate::document::Source;
use crate::finding::Finding;
use crate::job::{self, Wanted};
use crate::program::Format;
use crate::protocol::{Generate, Program};
use crate::server::context::RequestContext;
use crate::server::convert;
use std::sync::Arc;
use tower_lsp::jsonrpc::{Error, Result};

/// The requested part of a drawing.
pub(super) fn wanted<'a>(params: &'a Generate, task: &Task) -> Result<Wanted<'a>> {
    for handle in params.handles.iter().flatten() {
        if task.snapshot.drawing.find(handle).is_none() {
            return Err(no_entity(handle));
        }
    }
    Ok(Wanted {
        format: Format::of(&params.format).map_err(Error::invalid_params)?,
        handles: params.handles.as_deref(),
        layers: params.layers.as_deref(),
        force: params.force.unwrap_or(false),
    })
}

pub(in crate::server) fn generate(context: &RequestContext, params: Generate) -> Result<Program> {
    // An unknown format is reported whatever the document is.
    Format::of(&params.format).map_err(Error::invalid_params)?;
    let mut task = Task::of(context)?;
    let wanted = wanted(&params, &task)?;
    if wanted.format == Format::Milling {
        task.mill();
    }
    let made = job::generate(&task.snapshot, findings(&task), &wanted, context);
    context.check()?;
    let made = made.map_err(|refusal| task.refused(context, &refusal))?;
    let warnings = convert::diagnostics(&task.subject, &made.warnings, context.encoding);
    Ok(Program::new(
        &made.snapshot,
        made.program,
        made.finished,
        (&made.holes, &made.work),
        made.unattended,
        warnings,
    ))
}

/// The findings of the reader, and those of the rules under the request's options.
pub(super) fn findings(task: &Task) -> Vec<Finding> {
    let of_rules = task.findings();
    if Arc::ptr_eq(&task.document, &task.subject) {
        return of_rules;
    }
    let Source::Dxf(dxf) = task.subject.source() else {
        return of_rules;
    };
    let of_source = dxf.findings().iter().filter_map(|finding| {
        let severity = task.snapshot.settings.severity_of(finding)?;
        Some(Finding {
            severity,
            ..finding.clone()
        })
    });
    of_source.chain(of_rules).collect()
}
