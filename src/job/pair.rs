//! The parts of a pair: the path of each, and its program.

use super::{Generated, Refusal, Wanted, Watch, planned, written};
use crate::analysis::Analysis;
use crate::document::Snapshot;
use crate::drawing::{Drawing, EntityId, Outline, Role};
use crate::finding::{Finding, Severity};
use crate::fit;
use crate::program::Format;
use crate::rule::Rule;
use crate::settings::{Compensation, Effective, Partners, Use};
use crate::toolpath::{Planned, WirePath, entities_of};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;
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

/// One part of a pair.
pub(crate) struct PairPart {
    /// The same as in [`PartProgram`], as are the two after it.
    pub(crate) name: String,
    pub(crate) corrections: Vec<f64>,
    pub(crate) is_other_side: bool,
    /// The drawing under the settings of the part, with the contours of that alone where it is drawn.
    pub(crate) snapshot: Snapshot,
    /// The same drawing judged.
    analysis: Analysis,
    /// The contours that the part is cut along, where that are not all.
    handles: Option<Vec<String>>,
}

/// A part with its program, or why there is none.
type Programmed = (PairPart, Result<Generated, Refusal>);

/// What is cut of a drawing: one part of a pair, or everything where the drawing is no pair.
pub(crate) struct Cut {
    pub(crate) part: Option<PairPart>,
    /// Its outlines are those of `snapshot`.
    pub(crate) planned: Planned,
    pub(crate) snapshot: Snapshot,
    /// By outline of the part its place among those of the whole drawing.
    pub(crate) places: Vec<usize>,
}

/// The parts of a pair, or what is missing for that.
fn partners(settings: &Effective) -> Result<Partners, Refusal> {
    let fit = settings.fit();
    let (partners, _) =
        fit.map_err(|missing| Refusal::Sentence(say!(a_pair_needs, missing.listed())))?;
    Ok(partners)
}

/// The same where the drawing is a pair of which everything is set, and any contour of drawn parts has a partner.
fn partners_in(snapshot: &Snapshot) -> Option<Partners> {
    let settings = &snapshot.settings;
    let (partners, _) = settings.fit().ok()?;
    let has_partners = || partners != Partners::Drawn || !roles_of_partners(snapshot).is_empty();
    (settings.pair_error().is_none() && has_partners()).then_some(partners)
}

/// The paths of a drawing, part for part where it is a pair.
pub(crate) fn cuts(snapshot: &Snapshot, watch: &dyn Watch) -> Result<Vec<Cut>, Refusal> {
    let settings = &snapshot.settings;
    if settings.mills || settings.pair_error().is_some() {
        return Ok(vec![whole(snapshot, watch)?]);
    }
    if settings.pair.drawn_as.is_some() {
        partners(settings)?;
    }
    let Some(partners) = partners_in(snapshot) else {
        return Ok(vec![whole(snapshot, watch)?]);
    };
    let by_control = settings.compensation == Compensation::Controller;
    let parts = parts(snapshot, partners, by_control, false)?.into_iter();
    let cut = |part: PairPart| {
        let own = part.snapshot.clone();
        let planned = planned(&own, &own.settings, part.handles.as_deref(), false, watch)?;
        let (places, snapshot) = (places(snapshot, &own.outlines), own);
        let part = Some(part);
        Ok(Cut {
            part,
            planned,
            snapshot,
            places,
        })
    };
    parts.map(cut).collect()
}

fn whole(snapshot: &Snapshot, watch: &dyn Watch) -> Result<Cut, Refusal> {
    Ok(Cut {
        part: None,
        planned: planned(snapshot, &snapshot.settings, None, false, watch)?,
        snapshot: snapshot.clone(),
        places: (0..snapshot.outlines.len()).collect(),
    })
}

/// By outline of a part its place among those of the whole drawing: that which begins with the same entity.
fn places(whole: &Snapshot, own: &[Outline]) -> Vec<usize> {
    let first = |outline: &Outline| outline.contour.pieces.first().map(|piece| piece.entity);
    let all = whole.outlines.iter().enumerate();
    let held = all.flat_map(|(index, outline)| {
        let pieces = outline.contour.pieces.iter();
        pieces.map(move |piece| (piece.entity, index))
    });
    let by_entity: FxHashMap<EntityId, usize> = held.collect();
    let place = |outline: &Outline| by_entity.get(&first(outline)?).copied();
    own.iter()
        .map(|outline| place(outline).unwrap_or_default())
        .collect()
}

impl Cut {
    /// Its paths, along the outlines of the whole drawing.
    pub(crate) fn paths_of_whole(&self) -> impl Iterator<Item = WirePath> {
        let of_whole = |path: &WirePath| WirePath {
            outline: self.places.get(path.outline).copied().unwrap_or_default(),
            ..path.clone()
        };
        self.planned.paths.iter().map(of_whole)
    }

    /// The name of the part; nothing where the drawing is no pair.
    pub(crate) fn name(&self) -> Option<&str> {
        self.part.as_ref().map(|part| part.name.as_str())
    }
}

/// Writes and proves the program of each part of a pair; `findings` are all of its drawing.
pub fn pair(
    snapshot: &Snapshot,
    findings: &[Finding],
    wanted: &Wanted,
    watch: &dyn Watch,
) -> Result<Vec<PartProgram>, Refusal> {
    let made = programs(snapshot, findings, wanted, watch)?.into_iter();
    let made = made.map(|(part, made)| {
        Ok(PartProgram {
            part: part.name,
            corrections: part.corrections,
            is_other_side: part.is_other_side,
            made: made?,
        })
    });
    made.collect()
}

/// The parts of a pair, each with its program or why there is none.
pub(crate) fn programs(
    snapshot: &Snapshot,
    findings: &[Finding],
    wanted: &Wanted,
    watch: &dyn Watch,
) -> Result<Vec<Programmed>, Refusal> {
    let settings = &snapshot.settings;
    if wanted.format == Format::Milling {
        return Err(Refusal::Sentence(say!(a_pair_is_not_milled).into()));
    }
    let partners = partners(settings)?;
    if let Some(sentence) = settings.pair_error().or_else(|| settings.pass_error()) {
        return Err(Refusal::Sentence(sentence));
    }
    refuse_errors_of_all(findings, wanted)?;
    let by_control =
        settings.compensation == Compensation::Controller || wanted.format == Format::FourB;
    let parts = parts(snapshot, partners, by_control, wanted.force)?.into_iter();
    let made = parts.map(|mut part| {
        let made = part.program(wanted, watch);
        (part, made)
    });
    Ok(made.collect())
}

/// Refuses parts of a pair that the wire leaves without a part of their outline, such as a slot that is narrower than the kerf.
pub(super) fn refuse_lost_parts(snapshot: &Snapshot) -> Result<(), Refusal> {
    let parts = parts(snapshot, partners(&snapshot.settings)?, false, true)?;
    let lost = parts.into_iter().flat_map(|mut part| {
        let (findings, _) = part.analysis.findings(&part.snapshot.drawing, usize::MAX);
        let is_lost = |it: &Finding| it.rule == Rule::LostPocket && it.severity == Severity::Error;
        findings.into_iter().filter(is_lost)
    });
    let lost: Vec<Finding> = lost.collect();
    match lost.is_empty() {
        true => Ok(()),
        false => Err(Refusal::Errors(lost)),
    }
}

/// Each part is checked under its own settings; errors that concern all of them refuse the request here.
fn refuse_errors_of_all(findings: &[Finding], wanted: &Wanted) -> Result<(), Refusal> {
    let of_all = |finding: &&Finding| {
        finding.severity == Severity::Error
            && matches!(finding.rule, Rule::DoesNotFit | Rule::Syntax)
    };
    let errors: Vec<Finding> = findings.iter().filter(of_all).cloned().collect();
    match errors.is_empty() || wanted.force {
        true => Ok(()),
        false => Err(Refusal::Errors(errors)),
    }
}

/// The program of the part whose contours alone are wanted, where that is one that is drawn. Refused where several parts would
/// be cut by it; `None` where the drawing is no pair, or nothing of it that is wanted.
pub(super) fn alone(
    snapshot: &Snapshot,
    findings: &[Finding],
    wanted: &Wanted,
    watch: &dyn Watch,
) -> Option<Result<Generated, Refusal>> {
    let settings = &snapshot.settings;
    let partners = partners_in(snapshot)?;
    let chosen = match wanted.chosen(snapshot) {
        Ok(chosen) => chosen,
        Err(refusal) => return Some(Err(refusal)),
    };
    let (drawing, outlines) = (&*snapshot.drawing, &*snapshot.outlines);
    let entities = entities_of(drawing, outlines, settings, chosen.as_deref());
    let is_wanted = |outline: &&Outline| {
        let mut pieces = outline.contour.pieces.iter();
        let is_chosen = |entity| entities.as_ref().is_none_or(|all| all.contains(entity));
        outline.contour.double_of.is_none() && pieces.any(|piece| is_chosen(&piece.entity))
    };
    let mut wanted_outlines = outlines.iter().filter(is_wanted);
    match partners {
        Partners::CutTwice(_) => {
            let is_twice = |outline: &Outline| outline.contour.closed && outline.role == Role::Both;
            let names = || settings.uses().into_iter().map(|of| of.name().to_owned());
            wanted_outlines
                .any(is_twice)
                .then(|| Err(Refusal::Parts(names().collect())))
        }
        Partners::Drawn => {
            let number = |outline: &Outline| {
                let number = settings.workpieces.of_contour(drawing, &outline.contour);
                (number > 0).then_some(number)
            };
            let numbers: BTreeSet<u16> = wanted_outlines.filter_map(number).collect();
            let names = numbers
                .iter()
                .filter_map(|&number| settings.workpieces.name(number));
            let names: Vec<String> = names.map(str::to_owned).collect();
            match names.as_slice() {
                [] => None,
                [name] => Some(refuse_errors_of_all(findings, wanted).and_then(|()| {
                    let mut parts = parts(snapshot, partners, false, wanted.force)?.into_iter();
                    let part = parts.find(|part| part.name == *name);
                    let none = || Refusal::Sentence(say!(no_path_can_be_made).into());
                    part.ok_or_else(none)?.program(wanted, watch)
                })),
                _ => Some(Err(Refusal::Parts(names))),
            }
        }
    }
}

/// The parts of a pair of which everything is set; `by_control`: the control offsets them. `force`: also where no contour has a partner.
fn parts(
    snapshot: &Snapshot,
    partners: Partners,
    by_control: bool,
    force: bool,
) -> Result<Vec<PairPart>, Refusal> {
    let settings = &snapshot.settings;
    match partners {
        Partners::CutTwice(drawn_as) => {
            let part = |of: Use| {
                if let Some(sentence) = settings.sides_of_passes(of).filter(|_| by_control) {
                    return Err(Refusal::Sentence(sentence));
                }
                let (own, is_other_side) = settings
                    .of_use(of)
                    .ok_or_else(|| Refusal::Sentence(say!(no_path_can_be_made).into()))?;
                Ok(PairPart {
                    is_other_side,
                    // Contours that state a role belong to the drawn part alone.
                    handles: (of != Use::from(drawn_as)).then(|| cut_twice(snapshot)),
                    ..PairPart::of(snapshot, of.name(), own)
                })
            };
            settings.uses().into_iter().map(part).collect()
        }
        Partners::Drawn => {
            let roles = roles_of_partners(snapshot);
            if roles.is_empty() && !force {
                return Err(Refusal::Sentence(say!(no_contour_has_a_partner).into()));
            }
            let names = settings.workpieces.names().iter().zip(1..);
            let part = |(name, number): (&String, u16)| {
                let mut own = settings.of_workpiece(number);
                own.contours.extend(roles.iter().cloned());
                PairPart::of(snapshot, name, own)
            };
            Ok(names.map(part).collect())
        }
    }
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
    let named =
        both.filter_map(|(index, role)| Some((first_handle(drawing, outlines.get(index)?)?, role)));
    named.collect()
}

/// The contours that are cut twice, by the handle of the first entity of each.
fn cut_twice(snapshot: &Snapshot) -> Vec<String> {
    let twice = snapshot
        .outlines
        .iter()
        .filter(|outline| outline.role == Role::Both && outline.contour.double_of.is_none());
    let first = twice.filter_map(|outline| first_handle(&snapshot.drawing, outline));
    first.collect()
}

fn first_handle(drawing: &Drawing, outline: &Outline) -> Option<String> {
    let first = outline.contour.pieces.first()?;
    Some(drawing.get(first.entity)?.handle.to_string())
}

impl PairPart {
    /// A part under its own settings, cut along all contours that these leave.
    fn of(snapshot: &Snapshot, name: &str, settings: Effective) -> PairPart {
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
        let analysis = Analysis::new(&drawing, settings.clone());
        let outlines = analysis.outlines(&drawing).clone();
        PairPart {
            name: name.to_owned(),
            corrections,
            is_other_side: false,
            snapshot: Snapshot {
                outlines,
                drawing,
                settings,
            },
            analysis,
            handles: None,
        }
    }

    fn program(&mut self, wanted: &Wanted, watch: &dyn Watch) -> Result<Generated, Refusal> {
        let Snapshot {
            drawing, settings, ..
        } = &self.snapshot;
        let (mut findings, _) = self.analysis.findings(drawing, usize::MAX);
        // The fit decides whether the wire leaves too much in a tight arc.
        if settings.compensation == Compensation::Path {
            findings.retain(|finding| finding.rule != Rule::SmallRadius);
        }
        let wanted = Wanted {
            handles: wanted.handles.or(self.handles.as_deref()),
            ..*wanted
        };
        if let Some(sentence) = settings.pass_error() {
            return Err(Refusal::Sentence(sentence));
        }
        written(&self.snapshot, findings, &wanted, watch)
    }
}
