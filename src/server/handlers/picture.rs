//! `wedm/picture`: contours, faults and wire path of a drawing, or the path of a program, as SVG.

use super::Task;
use crate::document::Document;
use crate::finding::{self, Finding, Severity};
use crate::picture::{program_svg, svg};
use crate::protocol::{DrawingName, Picture};
use crate::server::context::RequestContext;
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn picture(context: &RequestContext, _: DrawingName) -> Result<Picture> {
    if let (Some(document), Some(program)) = (context.document(), context.program()) {
        return Ok(Picture {
            svg: program_svg(&program.trace(), &faults(document)),
        });
    }
    let task = Task::of(context)?;
    // Where no path can be made the picture shows the contours, and the findings say why.
    let paths = task.planned(context).unwrap_or_default().paths;
    Ok(Picture {
        svg: svg(
            &task.snapshot.drawing,
            &task.snapshot.outlines,
            &task.findings(),
            &paths,
            &task.snapshot.settings,
        ),
    })
}

/// What is wrong, by lines from 0.
fn faults(document: &Document) -> Vec<(usize, Severity, String)> {
    let line = |finding: &Finding| {
        let start = document.range_of(&finding.place)?.start;
        Some(document.text()?.line_of(start))
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
