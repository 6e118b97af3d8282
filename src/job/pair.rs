//! The programs of all parts of a pair.

use super::{Generated, Refusal, Wanted, Watch, generate};
use crate::analysis::Analysis;
use crate::document::Snapshot;
use crate::drawing::Role;
use crate::finding::{Finding, Severity};
use crate::fit;
use crate::program::Format;
use crate::rule::Rule;
use crate::settings::{Compensation, Effective, Partners, Use};
use std::sync::Arc;

/// The program of one part.
pub struct PartProgram {
    /// `punch`, `plate`, `stripper`, `holder`, or the name of a workpiece.
    pub part: String,
    /// The correction of each pass, mm; below 0 for passes on the other side of the drawn outline, where not all run there.
    pub corrections: Vec<f64>,
    /// The wire runs on the other side of the drawn outline.
    pub is_other_side: bool,
    pub made: Generated,
}

/// One part before its program is made.
struct Planned {
    part: String,
    settings: Effective,
    is_other_side: bool,
    /// Contours that state a role belong to the drawn part alone.
    with_stated: bool,
}

/// Writes and proves the program of each part of a pair; `findings` are all of its drawing.
pub fn pair(
    snapshot: &Snapshot,
    findings: &[Finding],
    wanted: &Wanted,
    watch: &dyn Watch,
) -> Result<Vec<PartProgram>, Refusal> {
    let settings = &snapshot.settings;
    if wanted.format == Format::Milling {
        return Err(Refusal::Sentence(say!(a_pair_is_not_milled).into()));
    }
    let (partners, _) = settings
        .fit()
        .map_err(|missing| Refusal::Sentence(say!(a_pair_needs, missing.listed())))?;
    if let Some(sentence) = settings.pair_error().or_else(|| settings.pass_error()) {
        return Err(Refusal::Sentence(sentence));
    }
    // Each part is checked under its own settings.
    let of_all = |finding: &&Finding| {
        finding.severity == Severity::Error
            && matches!(finding.rule, Rule::DoesNotFit | Rule::Syntax)
    };
    let errors: Vec<Finding> = findings.iter().filter(of_all).cloned().collect();
    if !errors.is_empty() && !wanted.force {
        return Err(Refusal::Errors(errors));
    }
    let planned = match partners {
        Partners::CutTwice(drawn_as) => {
            let uses = settings.uses().into_iter().map(|of| {
                let is_offset_by_control = settings.compensation == Compensation::Controller
                    || wanted.format == Format::FourB;
                if let Some(sentence) = settings
                    .sides_of_passes(of)
                    .filter(|_| is_offset_by_control)
                {
                    return Err(Refusal::Sentence(sentence));
                }
                let (own, is_other_side) = settings
                    .of_use(of)
                    .ok_or_else(|| Refusal::Sentence(say!(no_path_can_be_made).into()))?;
                Ok(Planned {
                    part: of.name().into(),
                    settings: own,
                    is_other_side,
                    with_stated: of == Use::from(drawn_as),
                })
            });
            uses.collect::<Result<Vec<_>, Refusal>>()?
        }
        Partners::Drawn => {
            let roles = roles_of_partners(snapshot);
            if roles.is_empty() && !wanted.force {
                return Err(Refusal::Sentence(say!(no_contour_has_a_partner).into()));
            }
            let names = settings.workpieces.names().iter().zip(1..);
            let planned = names.map(|(name, number)| {
                let mut own = settings.of_workpiece(number);
                own.contours.extend(roles.iter().cloned());
                Planned {
                    part: name.clone(),
                    settings: own,
                    is_other_side: false,
                    with_stated: true,
                }
            });
            planned.collect()
        }
    };
    planned
        .into_iter()
        .map(|planned| one(snapshot, planned, wanted, watch))
        .collect()
}

/// The role of each contour that has a partner, by the handle of its first entity.
fn roles_of_partners(snapshot: &Snapshot) -> Vec<(String, Role)> {
    let (drawing, outlines) = (&snapshot.drawing, &snapshot.outlines);
    let (drawn, _) = fit::partners(
        drawing,
        outlines,
        &snapshot.settings,
        &mut |_, outline| fit::walls_of(drawing, &outline.contour),
        &|_| false,
    );
    let both = drawn
        .pairs
        .iter()
        .flat_map(|[punch, plate]| [(*punch, Role::Punch), (*plate, Role::Opening)]);
    let named = both.filter_map(|(index, role)| {
        let first = outlines.get(index)?.contour.pieces.first()?;
        Some((drawing.get(first.entity)?.handle.to_string(), role))
    });
    named.collect()
}

fn one(
    snapshot: &Snapshot,
    planned: Planned,
    wanted: &Wanted,
    watch: &dyn Watch,
) -> Result<PartProgram, Refusal> {
    let Planned {
        part,
        settings,
        is_other_side,
        with_stated,
    } = planned;
    let drawing = snapshot.drawing.clone();
    let corrections = settings.each_correction();
    // Its passes have been checked against the wire; a correction reduced by the clearance may be below the wire's
    // radius, and still leaves the part that is meant.
    let mut settings = Effective {
        wire_diameter: None,
        ..settings
    };
    settings.severities.insert(Rule::PassOrder, None);
    let settings = Arc::new(settings);
    let mut analysis = Analysis::new(&drawing, settings.clone());
    let (mut findings, _) = analysis.findings(&drawing, usize::MAX);
    // The fit decides whether the wire leaves too much in a tight arc.
    if settings.compensation == Compensation::Path {
        findings.retain(|finding| finding.rule != Rule::SmallRadius);
    }
    let of_part = Snapshot {
        outlines: analysis.outlines(&drawing).clone(),
        drawing,
        settings,
    };
    let cut_twice: Option<Vec<String>> = (!with_stated && wanted.handles.is_none()).then(|| {
        let twice = snapshot
            .outlines
            .iter()
            .filter(|outline| outline.role == Role::Both && outline.contour.double_of.is_none());
        let first = twice.filter_map(|outline| {
            let first = outline.contour.pieces.first()?;
            Some(snapshot.drawing.get(first.entity)?.handle.to_string())
        });
        first.collect()
    });
    let wanted = Wanted {
        handles: cut_twice.as_deref().or(wanted.handles),
        ..*wanted
    };
    Ok(PartProgram {
        part,
        corrections,
        is_other_side,
        made: generate(&of_part, findings, &wanted, watch)?,
    })
}
