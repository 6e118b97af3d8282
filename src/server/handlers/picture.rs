//! `wedm/picture` and `wedm/export`: contours, faults and wire path of a drawing, or the path of a program, as SVG or
//! as a file; `wedm/repairs`: the segments that each repair of a finding adds.

use super::Task;
use crate::drawing::{Drawing, DrawingEdit, Touched};
use crate::finding::{Edit, Finding, Place};
use crate::job;
use crate::picture::{Drawn, Image};
use crate::protocol::{
    Export, Exported, Picture, PictureForm, PictureOf, Repair, Repairs, RepairsOf, SegmentShape,
};
use crate::server::context::RequestContext;
use crate::server::errors::{internal, refused};
use tower_lsp::jsonrpc::Result;

pub(in crate::server) fn picture(context: &RequestContext, asked: PictureOf) -> Result<Picture> {
    let Drawn { svg, pieces } = drawn(context, asked.pieces)?;
    Ok(Picture { svg, pieces })
}

pub(in crate::server) fn export(context: &RequestContext, params: Export) -> Result<Exported> {
    let form = match params.format {
        PictureForm::Svg => Image::Svg,
        PictureForm::Png => Image::Png,
        PictureForm::Pdf => Image::Pdf,
    };
    let bytes = form.of_svg(&drawn(context, false)?.svg).map_err(internal)?;
    Ok(Exported::new(&bytes))
}

fn drawn(context: &RequestContext, in_pieces: bool) -> Result<Drawn> {
    if let (Some(document), Some(program)) = (context.document(), context.program()) {
        return Ok(job::program_drawn(document, program, in_pieces));
    }
    let task = Task::of(context)?;
    // Without a path the picture shows the contours and says why.
    Ok(job::drawn(&task.snapshot, &task.findings(), context, in_pieces).1)
}

pub(in crate::server) fn repairs(context: &RequestContext, asked: RepairsOf) -> Result<Repairs> {
    let document = context.drawn()?;
    let Some(drawing) = document.drawing() else {
        return Err(refused(say!(the_document_is_a_program)));
    };
    let is_asked_for = |finding: &&Finding| {
        let (Place::Segment { entity, .. } | Place::Entity { entity }) = finding.place else {
            return false;
        };
        let segment = match finding.place {
            Place::Segment { segment, .. } => Some(segment),
            _ => None,
        };
        finding.rule.name() == asked.rule
            && segment == asked.segment
            && drawing
                .get(entity)
                .is_some_and(|entity| *entity.handle == *asked.handle)
    };
    let findings = document.all_findings();
    let Some(finding) = findings.iter().find(is_asked_for) else {
        return Ok(Repairs::default());
    };
    let unit_mm = document.unit_mm();
    let repairs = document.fixes(finding).into_iter().filter_map(|fix| {
        let Edit::Drawing(edit) = &fix.edit else {
            return None;
        };
        Some(Repair {
            title: fix.kind.title(unit_mm),
            segments: ghost(drawing, edit)?,
        })
    });
    Ok(Repairs {
        repairs: repairs.collect(),
    })
}

/// The segments that an edit adds.
fn ghost(drawing: &Drawing, edit: &DrawingEdit) -> Option<Vec<SegmentShape>> {
    let mut after = drawing.clone();
    let delta = after.apply(edit).ok()?;
    let mut entities: Vec<_> = delta.touched.iter().filter_map(Touched::entity).collect();
    entities.dedup();
    let mut segments = Vec::new();
    for id in entities {
        let before: Vec<_> = drawing
            .get(id)
            .map(|entity| entity.geometry.segments_of(drawing.flat()).collect())
            .unwrap_or_default();
        let Some(entity) = after.get(id) else {
            continue;
        };
        let new = entity.geometry.segments_of(after.flat());
        segments.extend(
            new.filter(|segment| !before.contains(segment))
                .map(|segment| SegmentShape::from(&segment)),
        );
    }
    Some(segments)
}
