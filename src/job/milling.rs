//! A drawing as an electrode mills it, under other settings than those for a wire.

use super::Refusal;
use crate::analysis::Analysis;
use crate::document::Snapshot;
use crate::finding::{Detail, Finding, Place, Severity};
use crate::rule::Rule;
use crate::toolpath::{Milled, WirePath, Work, short_layers};
use std::sync::Arc;

/// A contour whose ends are nearer than this, mm, was most likely meant to be closed, and milled beside its line, not
/// along it.
const MEANT_CLOSED: f64 = 1.0;

/// The drawing under the settings of the electrode, and its findings there. Of `findings`, those for a wire, only the
/// reader's stay.
pub(super) fn judged(
    snapshot: &Snapshot,
    findings: &[Finding],
) -> Result<(Snapshot, Vec<Finding>), Refusal> {
    let settings = snapshot.settings.milled().map_err(Refusal::Sentence)?;
    let (drawing, settings) = (snapshot.drawing.clone(), Arc::new(settings));
    let mut analysis = Analysis::new(&drawing, settings.clone());
    let (mut of_rules, _) = analysis.findings(&drawing, usize::MAX);
    let unit_mm = settings.unit_of(&drawing).mm;
    for finding in &mut of_rules {
        if let Detail::OpenContour { distance, .. } = finding.detail
            && distance * unit_mm < MEANT_CLOSED
        {
            finding.severity = Severity::Error;
        }
    }
    let of_reader = findings
        .iter()
        .filter(|finding| finding.rule == Rule::Syntax);
    let findings = of_reader.cloned().chain(of_rules).collect();
    let outlines = analysis.outlines(&drawing).clone();
    let milled = Snapshot {
        drawing,
        outlines,
        settings,
    };
    Ok((milled, findings))
}

/// The contours with a layer that is shorter than the step of linear compensation.
pub(super) fn too_short(snapshot: &Snapshot, paths: &[WirePath]) -> Result<(), Refusal> {
    let Snapshot {
        drawing,
        outlines,
        settings,
    } = snapshot;
    let short = short_layers(drawing, outlines, settings, paths);
    match short.is_empty() {
        true => Ok(()),
        false => Err(Refusal::Findings(short)),
    }
}

/// The contours along which the electrode loses more than a layer in each layer.
pub(super) fn uneven(snapshot: &Snapshot, milled: &Milled) -> Vec<Finding> {
    let worn = milled.contours.iter();
    worn.filter(|contour| contour.wear_of_layer > 1.0)
        .map(|contour| {
            let sentence = say!(
                the_floor_is_uneven,
                contour.wear_of_layer,
                contour.floor[1],
                contour.floor[2]
            );
            finding(snapshot, contour.outline, Severity::Warning, sentence)
        })
        .collect()
}

/// The totals of the job over all layers, without what only concerns a wire.
pub(super) fn in_layers(work: Work, milled: &Milled) -> Work {
    let layers = milled.electrode.layers() as f64;
    let mut cuts = work.cuts;
    for cut in &mut cuts {
        cut.length *= layers;
        cut.minutes = None;
    }
    Work {
        length: work.length * layers,
        jumps: work.jumps,
        cuts,
        ..Work::default()
    }
}

/// A setting that does not suit a contour.
fn finding(snapshot: &Snapshot, outline: usize, severity: Severity, sentence: String) -> Finding {
    let outline = snapshot.outlines.get(outline);
    let first = outline.and_then(|outline| outline.contour.pieces.first());
    Finding {
        rule: Rule::Settings,
        severity,
        place: first.map_or(Place::Document, |piece| Place::Entity {
            entity: piece.entity,
        }),
        detail: Detail::Said(sentence),
        related: Vec::new(),
    }
}
