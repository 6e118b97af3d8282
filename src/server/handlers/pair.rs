//! `wedm/fit` and `wedm/pair`: whether the parts of a pair fit, and the program of each.

use super::{Task, generate};
use crate::job;
use crate::picture;
use crate::protocol::{Fit, Generate, OptionsOf, PairProgram, PairPrograms, Program};
use crate::server::context::RequestContext;
use crate::server::convert;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn fit(context: &RequestContext, _: OptionsOf) -> Result<Fit> {
    let task = Task::of(context)?;
    let fit = job::fit(&task.document, &task.snapshot, context);
    let fit = fit.map_err(|refusal| task.refused(context, &refusal))?;
    let drawing = &task.snapshot.drawing;
    let svg = picture::fit_svg(drawing, &fit, task.unit_mm());
    Ok(Fit::new(drawing, &fit, svg, task.unit_mm()))
}

pub(in crate::server) fn pair(context: &RequestContext, params: Generate) -> Result<PairPrograms> {
    let task = Task::of(context)?;
    let wanted = generate::wanted(&params, &task)?;
    let made = job::pair(&task.snapshot, &generate::findings(&task), &wanted, context);
    context.check()?;
    let made = made.map_err(|refusal| task.refused(context, &refusal))?;
    let programs = made.into_iter().map(|part| {
        let warnings = convert::diagnostics(&task.subject, &part.made.warnings, context.encoding);
        let made = part.made;
        PairProgram {
            part: part.part,
            corrections: part.corrections,
            other_side: part.is_other_side,
            program: Program::new(
                &made.snapshot,
                made.program,
                made.finished,
                (&made.holes, &made.work),
                made.unattended,
                warnings,
            ),
        }
    });
    Ok(PairPrograms {
        programs: programs.collect(),
    })
}
