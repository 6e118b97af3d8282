//! What is made of a document: the repaired document, the program of a drawing, a program in another language.
//!
//! One pipeline for the server and the command line. These supply a document with its settings and
//! present the result; refusals are decided and worded here. Nothing here reads or writes a file,
//! or knows who asked.

mod convert;
mod corners;
pub(crate) mod drill;
mod milling;
mod night;
mod pair;
mod repairs;
mod shown;
mod tabs;

pub(crate) use convert::{Converted, Target, convert};
pub(crate) use corners::is_of_program;
pub(crate) use night::{Watch as NightWatch, alone, night, unattended};
pub(crate) use pair::{Cut, cuts, programs};
pub use pair::{PartProgram, pair};
pub use repairs::ROUNDS;
pub(crate) use repairs::{Outcome, REPAIRED, Repairs, fix_all};
pub(crate) use shown::{drawn, picture, picture_of_program, program_drawn};

use crate::analysis;
use crate::document::{Document, Snapshot};
use crate::drawing::Entity;
use crate::finding::{Detail, Finding, Place, Severity, Telling};
use crate::fit::{self, Fit};
use crate::program::{Format, ProofError, ProvedProgram};
use crate::rule::Rule;
use crate::settings::{Effective, Order, part_title};
use crate::toolpath::{
    self, Finished, Planned, StartHole, WirePath, Work, entities_of, plan_while,
};
use std::collections::BTreeSet;

/// The caller while it waits: whether it still wants the result, and the progress that it is shown.
pub trait Watch: Sync {
    fn is_wanted(&self) -> bool {
        true
    }

    /// A step of the work; how much is done of how much, where that is known.
    fn at(&self, _step: &'static str, _share: Option<(usize, usize)>) {}
}

/// A caller that never cancels.
impl Watch for () {}

/// Why there is no result.
#[derive(Debug)]
pub enum Refusal {
    Sentence(String),
    /// These parts of a pair have a program each.
    Parts(Vec<String>),
    /// There are errors in what would be cut.
    Errors(Vec<Finding>),
    /// The refusals of the geometry, at their places.
    Findings(Vec<Finding>),
    /// The program did not pass its proof, perhaps because of errors that were overridden by
    /// `force`.
    Unproved(String, Vec<Finding>),
    /// Nothing could be proved although there are no errors: a fault of wedm.
    Fault(String),
    /// The caller cancelled.
    Cancelled,
}

impl Refusal {
    /// An error where the drawing is at fault, not where something is still to be set.
    fn severity(&self) -> Severity {
        match self {
            Refusal::Sentence(_) | Refusal::Parts(_) | Refusal::Cancelled => Severity::Information,
            Refusal::Findings(findings) => {
                let severities = findings.iter().map(|finding| finding.severity);
                severities.min().unwrap_or(Severity::Error)
            }
            _ => Severity::Error,
        }
    }

    /// The refusal for a person.
    pub fn sentence(&self, telling: impl Into<Telling>) -> String {
        match self {
            Refusal::Sentence(sentence)
            | Refusal::Unproved(sentence, _)
            | Refusal::Fault(sentence) => sentence.clone(),
            Refusal::Parts(parts) => say!(parts_have_a_program_each, listed(parts)),
            Refusal::Errors(errors) if errors.len() == 1 => {
                say!(an_error_stands_in_the_drawing).into()
            }
            Refusal::Errors(errors) => say!(errors_stand_in_the_drawing, errors.len()),
            Refusal::Findings(findings) => findings.first().map_or_else(
                || say!(no_path_can_be_made).into(),
                |finding| crate::finding::sentence(finding, telling),
            ),
            Refusal::Cancelled => say!(the_path_was_given_up).into(),
        }
    }

    /// The faults at their places.
    pub(crate) fn findings(&self) -> &[Finding] {
        match self {
            Refusal::Errors(findings)
            | Refusal::Findings(findings)
            | Refusal::Unproved(_, findings) => findings,
            Refusal::Sentence(_) | Refusal::Parts(_) | Refusal::Fault(_) | Refusal::Cancelled => {
                &[]
            }
        }
    }

    /// The refusal of a program that was not proved. Where errors were overridden, they are the reason.
    fn of_proof(
        error: ProofError,
        errors: Option<Vec<Finding>>,
        unproved: fn(&str) -> String,
    ) -> Refusal {
        match (error, errors) {
            (ProofError::Refused(sentence), _) => Refusal::Sentence(sentence),
            (ProofError::Unwritable(finding), _) => Refusal::Findings(vec![*finding]),
            (ProofError::Cancelled, _) => Refusal::Cancelled,
            (ProofError::Mismatch(reason), Some(errors)) => {
                Refusal::Unproved(unproved(&reason), errors)
            }
            (ProofError::Mismatch(reason), None) => {
                Refusal::Fault(say!(the_program_does_not_hold_its_proof, reason))
            }
        }
    }
}

/// The names of parts for people.
pub(crate) fn listed(parts: &[String]) -> String {
    let titles: Vec<String> = parts.iter().map(|part| part_title(part)).collect();
    titles.join(say!(comma))
}

impl From<toolpath::Refusal> for Refusal {
    fn from(refusal: toolpath::Refusal) -> Refusal {
        match refusal {
            toolpath::Refusal::Sentence(sentence) => Refusal::Sentence(sentence),
            toolpath::Refusal::Findings(findings) => Refusal::Findings(findings),
            toolpath::Refusal::Cancelled => Refusal::Cancelled,
        }
    }
}

/// At most `limit` findings, errors first, then one that counts the rest; and how many there are in all.
pub(crate) fn check(document: &mut Document, limit: usize) -> (Vec<Finding>, usize) {
    let (mut findings, count) = document.findings(limit);
    let more = count - findings.len();
    if more > 0
        && let Some(severity) = document.settings().severity(Rule::More)
    {
        findings.push(Finding {
            rule: Rule::More,
            severity,
            place: Place::Document,
            detail: Detail::More { count: more },
            related: Vec::new(),
        });
    }
    (findings, count)
}

/// Whether the parts of a drawing fit, of which this is the snapshot; what its findings have shown of that is not worked out again.
/// Parts that fit although the wire does not reach all of an outline are refused, as their programs are.
pub fn fit(document: &Document, snapshot: &Snapshot, watch: &dyn Watch) -> Result<Fit, Refusal> {
    let (drawing, outlines) = (&snapshot.drawing, &snapshot.outlines);
    let goes_on = || watch.is_wanted();
    let fit = match document.laid() {
        Some(laid) => laid.compared(drawing, outlines, &snapshot.settings)?,
        None => fit::fit(drawing, outlines, &snapshot.settings, &goes_on)?,
    };
    if fit.fits() {
        pair::refuse_lost_parts(snapshot)?;
    }
    Ok(fit)
}

/// The wire's paths of the contours that hold one of `handles`, or of all, with the thread holes, and on request with the contours that all passes leave.
pub fn planned(
    snapshot: &Snapshot,
    settings: &Effective,
    handles: Option<&[String]>,
    finishes: bool,
    watch: &dyn Watch,
) -> Result<Planned, Refusal> {
    let (drawing, outlines) = (&snapshot.drawing, &snapshot.outlines);
    let goes_on = || watch.is_wanted();
    let planned = plan_while(drawing, outlines, settings, handles, finishes, &goes_on)?;
    Ok(planned)
}

/// What is asked for in a program.
#[derive(Clone, Copy)]
pub struct Wanted<'a> {
    pub format: Format,
    /// Only the contours that hold one of these entities.
    pub handles: Option<&'a [String]>,
    /// Only the contours that have an entity on one of these layers; together with `handles` the contours of both.
    pub layers: Option<&'a [String]>,
    /// Make the program even if there are errors in the drawing.
    pub force: bool,
}

impl Wanted<'_> {
    /// The handles that choose the contours, `None` for all: the named ones, then the first entity of each contour on
    /// one of the layers, in the order of the drawing.
    fn chosen(&self, snapshot: &Snapshot) -> Result<Option<Vec<String>>, Refusal> {
        let mut chosen = self.handles.map(<[String]>::to_vec);
        let Some(layers) = self.layers else {
            return Ok(chosen);
        };
        let mut unmet: BTreeSet<&str> = layers.iter().map(String::as_str).collect();
        let handles = chosen.get_or_insert_default();
        for outline in snapshot.outlines.iter() {
            let pieces = outline.contour.pieces.iter();
            let entities: Vec<&Entity> = pieces
                .filter_map(|piece| snapshot.drawing.get(piece.entity))
                .collect();
            let is_called = |name: &str, layer: &str| {
                name == layer || name.to_uppercase() == layer.to_uppercase()
            };
            let on = |layer: &&String| {
                let mut on_layers = entities.iter().map(|entity| &*entity.layer);
                on_layers.any(|own| is_called(own, layer))
            };
            let met: Vec<&String> = layers.iter().filter(on).collect();
            if let Some(first) = entities.first()
                && !met.is_empty()
                && outline.contour.double_of.is_none()
            {
                met.into_iter().for_each(|layer| {
                    unmet.remove(layer.as_str());
                });
                handles.push(first.handle.to_string());
            }
        }
        match unmet.pop_first() {
            Some(layer) => Err(Refusal::Sentence(say!(
                no_contour_that_is_cut_is_on_the_layer,
                layer
            ))),
            None => Ok(chosen),
        }
    }
}

/// The program of a drawing.
pub struct Generated {
    /// What it was made of, of a pair the part alone: outlines are counted in it.
    pub(crate) snapshot: Snapshot,
    pub program: ProvedProgram,
    /// The paths of the wire that it follows, in drawing units.
    pub paths: Vec<WirePath>,
    pub contours: usize,
    /// The contours that all passes leave, in mm and the drawing's coordinates, if there are several passes.
    pub finished: Option<Finished>,
    /// The thread holes, in the order of the cuts.
    pub holes: Vec<StartHole>,
    /// Lengths, times and costs of the program on the machine.
    pub work: Work,
    /// What happens at the machine while nobody stands by, in sentences.
    pub(crate) unattended: Vec<String>,
    /// Additional findings.
    pub warnings: Vec<Finding>,
    /// What is drawn and not cut, where all of the drawing was asked for.
    pub left_out: Vec<Finding>,
}

/// Writes and proves the program of a drawing; `findings` are all of the drawing. Of a pair it is that of the part whose contours
/// are wanted, where both are drawn.
pub fn generate(
    snapshot: &Snapshot,
    findings: Vec<Finding>,
    wanted: &Wanted,
    watch: &dyn Watch,
) -> Result<Generated, Refusal> {
    if wanted.format == Format::Milling {
        let (milled, findings) = milling::judged(snapshot, &findings)?;
        return written(&milled, findings, wanted, watch);
    }
    let settings = &snapshot.settings;
    if settings.mills {
        let format = wanted.format.name();
        return Err(Refusal::Sentence(say!(nothing_is_said_of_a_wire, format)));
    }
    if let Some(sentence) = settings.pass_error() {
        return Err(Refusal::Sentence(sentence));
    }
    if let Some(made) = pair::alone(snapshot, &findings, wanted, watch) {
        return made;
    }
    written(snapshot, findings, wanted, watch)
}

/// The refusal of a program that only threads the wire, with those findings of the drawing that say why.
fn cuts_nothing(mut findings: Vec<Finding>) -> Refusal {
    findings.retain(|one| matches!(one.detail, Detail::OffsetCollapse { point: true, .. }));
    match findings.is_empty() {
        true => Refusal::Sentence(say!(it_cuts_nothing).into()),
        false => Refusal::Findings(findings),
    }
}

fn written(
    snapshot: &Snapshot,
    mut findings: Vec<Finding>,
    wanted: &Wanted,
    watch: &dyn Watch,
) -> Result<Generated, Refusal> {
    let settings = &snapshot.settings;
    let is_error = |finding: &Finding| finding.severity == Severity::Error;
    // Differences from an existing program do not count against the drawing, and the path itself
    // refuses leads and steps.
    findings.retain(|found| match found.rule {
        Rule::NotTheDrawing | Rule::LeadIn => false,
        Rule::Settings => !is_error(found),
        _ => true,
    });
    let any_errors = findings.iter().any(is_error);
    let chosen = wanted.chosen(snapshot)?;
    let (drawing, outlines) = (&*snapshot.drawing, &*snapshot.outlines);
    let entities = entities_of(drawing, outlines, settings, chosen.as_deref());
    findings.retain(|finding| finding.concerns(entities.as_ref()));
    if chosen.is_some() {
        // A fault of all contours at once need not concern the chosen ones; if it does, their path says so.
        let of_all = toolpath::stated_faults(drawing, outlines, settings);
        let is_of_all = |found: &Finding| {
            found.place == Place::Document && of_all.iter().any(|one| one.detail == found.detail)
        };
        findings.retain(|found| !is_of_all(found));
    }
    let errors: Vec<Finding> = findings
        .iter()
        .filter(|one| is_error(one))
        .cloned()
        .collect();
    if !errors.is_empty() && !wanted.force {
        return Err(Refusal::Errors(errors));
    }
    watch.at(say!(laying_the_path), None);
    let of_format = wanted.format.settings(settings);
    let Planned {
        paths,
        finished,
        holes,
        off_chords,
    } = planned(snapshot, &of_format, chosen.as_deref(), true, watch)?;
    if settings.mills {
        milling::too_short(snapshot, &paths)?;
    }
    if paths.iter().all(|path| path.segments.is_empty()) {
        return Err(cuts_nothing(findings));
    }
    let mut go_on = |done, all| {
        watch.at(say!(writing_and_proving), Some((done, all)));
        watch.is_wanted()
    };
    let unit_mm = settings.unit_of(&snapshot.drawing).mm;
    let mut program = wanted
        .format
        .write(&paths, unit_mm, settings, &mut go_on)
        .map_err(|error| {
            let errors = (wanted.force || any_errors).then_some(errors);
            Refusal::of_proof(error, errors, |reason| {
                say!(no_program_of_this_drawing, reason)
            })
        })?;
    program.off_chords = off_chords * unit_mm * 1000.0;
    let is_left_out = |one: &&Finding| chosen.is_none() && one.rule == Rule::UnsupportedEntity;
    let left_out = findings.iter().filter(is_left_out).cloned().collect();
    let mut warnings = findings;
    warnings.retain(|finding| finding.severity <= Severity::Warning || is_of_program(finding));
    if snapshot
        .outlines
        .iter()
        .map(|outline| outline.contour.len())
        .sum::<usize>()
        > toolpath::MOST_SEGMENTS_SAID_TWICE
    {
        warnings.extend(toolpath::said_twice(
            &snapshot.drawing,
            &snapshot.outlines,
            settings,
        ));
    }
    warnings.extend(toolpath::shortened_leads(
        &snapshot.drawing,
        &snapshot.outlines,
        &of_format,
        &paths,
        &holes,
    ));
    warnings.extend(toolpath::long_leads(
        &snapshot.drawing,
        &snapshot.outlines,
        &of_format,
        &paths,
    ));
    warnings.extend(picked_without_picks(settings, chosen.as_deref()));
    warnings.extend(corners::cut_off(snapshot, &program));
    warnings.extend(tabs::none_kept(snapshot, &paths));
    warnings.extend(tabs::missed(snapshot, &paths));
    warnings.extend(toolpath::holds(
        &snapshot.drawing,
        &snapshot.outlines,
        &of_format,
        &paths,
    ));
    let mut work = analysis::work(&snapshot.drawing, &snapshot.outlines, settings, &paths);
    if let Some(milled) = &program.milled {
        // The finding of the simulation about the floor replaces the earlier one.
        let uneven = milling::uneven(snapshot, milled);
        let is_said = |one: &Finding| uneven.iter().any(|own| own.place == one.place);
        warnings.retain(|one| one.rule != Rule::Settings || !is_said(one));
        warnings.extend(uneven);
        work = milling::in_layers(work, milled);
    }
    let finished = finished_by(finished, &program);
    let night = match program.milled {
        Some(_) => Vec::new(),
        None => night(snapshot, &paths, &work, wanted.format),
    };
    Ok(Generated {
        snapshot: snapshot.clone(),
        unattended: unattended(snapshot, &night),
        program,
        contours: paths.iter().filter(|path| path.is_first()).count(),
        paths,
        work,
        holes,
        finished: finished.map(|finished| Finished {
            uncut: finished.uncut * unit_mm,
            overcut: finished.overcut * unit_mm,
            ..finished
        }),
        warnings,
        left_out,
    })
}

/// A warning where contours are to be cut in the order in which they are picked, and none is.
fn picked_without_picks(settings: &Effective, picked: Option<&[String]>) -> Option<Finding> {
    let is_idle = settings.order == Order::AsPicked && picked.is_none();
    is_idle.then(|| Finding {
        rule: Rule::Settings,
        severity: Severity::Warning,
        place: Place::Document,
        detail: Detail::Said(say!(nothing_is_picked, "program.order", "as-drawn")),
        related: Vec::new(),
    })
}

/// What is left by a program that holds other corners than the paths.
fn finished_by(of_paths: Option<Finished>, program: &ProvedProgram) -> Option<Finished> {
    match (of_paths, program.corners) {
        (Some(of_paths), Some(corners)) => Some(of_paths.merged(corners)),
        (of_paths, corners) => of_paths.or(corners),
    }
}
