//! The path of the wire's centre: offset, corners, leads, order.
//!
//! Each piece of a path remembers the segment of the drawing that it comes from. A path never comes nearer to its contour than the
//! correction, lies at it everywhere but on the tips of corners, and leaves out nothing that the wire can reach: `proof`. Where that
//! cannot be, there is an error finding at the place and no path. Everything is in drawing units; settings are in mm.

mod at_limit;
mod chords;
mod clearance;
mod containment;
mod contour_path;
mod contours;
mod cores;
mod corners;
mod crowd;
mod distance;
mod drawn_path;
mod entry;
mod finished;
mod hole;
mod job;
mod lead_form;
mod leads;
mod loops;
pub(crate) mod milling;
mod nearby;
mod nest;
mod offset;
mod on_line;
mod open_contour;
mod order;
mod others;
mod part;
mod path;
mod paths;
mod proof;
mod quick_tests;
mod requested;
mod ring;
mod rotated;
mod rounds;
mod said_twice;
mod settings_check;
mod skim;
mod skim_sweep;
mod standing;
mod tab;
#[cfg(test)]
mod tests;
mod threading;
mod tips;
mod vicinity;
mod work;

pub(crate) use clearance::Walls;
pub(crate) use cores::each;
pub(crate) use crowd::looks_beside;
pub(crate) use finished::Finished;
pub use hole::StartHole;
pub(crate) use hole::hole_faults;
pub use milling::{Milled, MilledContour};
pub(crate) use nearby::Nearby;
pub(crate) use on_line::line_faults;
pub(crate) use part::{Cutting, Part, part};
pub(crate) use path::lengths;
pub use path::{PathSegment, Refusal, Source, WirePath};
pub(crate) use rounds::rounds;
pub(crate) use said_twice::{MOST_SEGMENTS as MOST_SEGMENTS_SAID_TWICE, said_twice};
pub(crate) use settings_check::{
    is_stated, long_leads, short_layers, shortened_leads, stated_faults,
};
pub(crate) use standing::holds;
pub use work::LargestWire;
pub use work::Work;
pub(crate) use work::{inner_arcs, largest_of_arcs, last_gap, uses_of, work};

use crate::drawing::{Drawing, EntityId, Outline};
use crate::finding::{Detail, Finding, Rule, Severity};
use crate::geometry::Point;
use crate::settings::{Compensation, Effective, LengthSetting, Order};
use containment::{Nesting, Places};
use contour_path::{Fault, Laid};
use contours::Contours;
use job::Job;
use order::Chosen;
use requested::Requested;
use rustc_hash::{FxHashMap, FxHashSet};

/// The paths of all `outlines`, or of those that hold one of `handles`, in machining order.
pub fn plan(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    handles: Option<&[String]>,
) -> Result<Vec<WirePath>, Refusal> {
    let planned = plan_while(drawing, outlines, settings, handles, false, &|| true)?;
    Ok(planned.paths)
}

/// The paths of one request.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Planned {
    /// In machining order, the passes of a contour one after another.
    pub paths: Vec<WirePath>,
    /// What all passes leave, where several are cut and it is asked for.
    pub(crate) finished: Option<Finished>,
    /// Where the wire is threaded, in the order of the cuts.
    pub holes: Vec<StartHole>,
    /// The largest distance of an arc of the paths' outlines from the chords for which it stands; 0 where none does.
    pub(crate) off_chords: f64,
}

impl Planned {
    /// Adds what is planned after it.
    pub(crate) fn add(&mut self, next: Planned) {
        self.paths.extend(next.paths);
        self.holes.extend(next.holes);
        self.finished = match (self.finished.take(), next.finished) {
            (Some(before), Some(next)) => Some(before.merged(next)),
            (before, next) => before.or(next),
        };
    }
}

/// One contour among the cuts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ContourToCut {
    /// Index into the outlines.
    pub(crate) outline: usize,
    /// The start mark that is nearest to it, of those that are nearer to no other contour.
    pub(crate) mark: Option<Point>,
}

/// All contours in the order in which they are cut. `None` for a drawing of so many contours or marks that finding out takes longer than
/// a question may. Where there is no path, the nearest is not known: the order is as drawn then.
pub(crate) fn cuts(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
) -> Option<Vec<ContourToCut>> {
    const MOST_CONTOURS: usize = 20_000;
    const MOST_COMPARED: usize = 20_000_000;
    /// A path is laid for the order of the nearest.
    const MOST_LAID: usize = 10_000;
    if outlines.len() > MOST_CONTOURS {
        return None;
    }
    let job = Job::of(drawing, outlines, settings);
    let segments: usize = outlines.iter().map(|outline| outline.contour.len()).sum();
    let chosen: Vec<usize> = match settings.order {
        Order::Nearest if segments > MOST_LAID => return None,
        Order::Nearest => {
            let paths = plan(drawing, outlines, settings, None).unwrap_or_default();
            let first = paths.iter().filter(|path| path.is_first());
            first.map(|path| path.outline).collect()
        }
        _ => Vec::new(),
    };
    let chosen = match chosen.is_empty() {
        true => {
            let chosen = job.chosen(None, settings.order, &job.places());
            chosen.unwrap_or_default().outlines
        }
        false => chosen,
    };
    let marks = job.marks(MOST_COMPARED / segments.max(1))?;
    Some(
        chosen
            .into_iter()
            .map(|outline| ContourToCut {
                outline,
                mark: requested::mark_of(&marks, outline),
            })
            .collect(),
    )
}

/// The same for as long as `goes_on` says so, which is asked every few milliseconds. `finishes`: what all passes leave is asked for, too.
pub(crate) fn plan_while(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    handles: Option<&[String]>,
    finishes: bool,
    goes_on: &(dyn Fn() -> bool + Sync),
) -> Result<Planned, Refusal> {
    let job = Job::of(drawing, outlines, settings);
    let places = job.places();
    // Contours that are asked for come in the order in which they are asked for, unless another one is set.
    let order = match handles.is_some() && !settings.states_order {
        true => Order::InsideFirst,
        false => settings.order,
    };
    let Chosen {
        outlines: chosen,
        picks,
    } = job.chosen(handles, order, &places)?;
    if settings.compensation == Compensation::None
        && let Some(path) = drawn_path::one_path(&job, &chosen)
    {
        let hole = StartHole {
            outline: path.outline,
            at: path.thread_hole,
            is_given: settings.thread.is_some(),
            cuts: false,
            is_open: false,
        };
        return Ok(Planned {
            paths: vec![path],
            holes: vec![hole],
            ..Planned::default()
        });
    }
    if let LengthSetting::ByHandle(tabs) = &settings.tab {
        for handle in tabs.keys() {
            job.outline_of(handle)?;
        }
    }
    let mut job = Job {
        picks,
        finishes,
        fits_chords: true,
        goes_on,
        ..job
    };
    let (mut all, mut faults) = (Planned::default(), Vec::new());
    let wanted = job.wanted(&chosen)?;
    for (chosen, wanted) in job.by_workpiece(&chosen, wanted) {
        if settings.job.slug_limit.is_some() {
            job.cut_out = Nesting::new(drawing, outlines, &chosen).cut_out(outlines, &chosen);
        }
        match of_workpiece(&job, order, (&chosen, &wanted), &places) {
            Ok(planned) => all.add(planned),
            Err(Refusal::Findings(findings)) => faults.extend(findings),
            Err(refusal) => return Err(refusal),
        }
    }
    all.off_chords = f64::from_bits(job.off_chords.into_inner());
    match faults.is_empty() {
        true => Ok(all),
        false => Err(Refusal::Findings(faults)),
    }
}

/// The paths of contours that lie in one workpiece.
fn of_workpiece(
    job: &Job,
    order: Order,
    (chosen, wanted): (&[usize], &[Requested]),
    places: &Places,
) -> Result<Planned, Refusal> {
    let settings = job.settings;
    job.go_on()?;
    let contours = Contours::about(job, chosen);
    let (planned, mut findings) = job.all_paths(chosen, wanted, &contours)?;
    let Planned {
        paths, finished, ..
    } = planned;
    let paths = if order == Order::Nearest {
        job.by_nearest(paths, places)
    } else {
        paths
    };
    findings.extend(job.jumps_that_cut(&paths, &contours));
    findings.extend(job.cut_through(&paths));
    if findings.is_empty() {
        let is_given: FxHashMap<usize, bool> = chosen
            .iter()
            .zip(wanted)
            .map(|(&outline, wanted)| (outline, wanted.thread.is_some()))
            .collect();
        let openings = job.openings_of_lines(chosen);
        let hole = |path: &WirePath| {
            let is_given = is_given.get(&path.outline) == Some(&true);
            let is_open = job.is_threaded_in_opening(path, &openings);
            let is_found = !is_given && !is_open;
            StartHole {
                outline: path.outline,
                at: path.thread_hole,
                is_given,
                cuts: is_found && job.finds_no_room(path.thread_hole, &contours),
                is_open,
            }
        };
        // An electrode comes from above.
        let firsts = paths
            .iter()
            .filter(|path| path.is_first() && !settings.mills);
        Ok(Planned {
            holes: firsts.map(hole).collect(),
            paths,
            finished,
            ..Planned::default()
        })
    } else {
        Err(Refusal::Findings(findings))
    }
}

/// The entities of the contours that hold one of `handles`; `None` where none is named, which means all.
pub(crate) fn entities_of(
    drawing: &Drawing,
    outlines: &[Outline],
    settings: &Effective,
    handles: Option<&[String]>,
) -> Option<FxHashSet<EntityId>> {
    let job = Job::of(drawing, outlines, settings);
    let holders = handles?
        .iter()
        .filter_map(|handle| job.outline_of(handle).ok());
    let pieces = holders.flat_map(|outline| &outlines[outline].contour.pieces);
    Some(pieces.map(|piece| piece.entity).collect())
}

/// A contour of more segments is not asked at every edit: its path would take longer than an edit may take.
pub(crate) const MOST_SEGMENTS_OF_MISFITS: usize = 5_000;

/// What prevents a path along one contour under the settings' correction, as findings: errors where there is none, a
/// warning where the wire can only stand. Nothing where there is a path, and where the side of the wire is not known.
pub(crate) fn misfits(drawing: &Drawing, outline: &Outline, settings: &Effective) -> Vec<Finding> {
    let Some(side) = outline.wire_side() else {
        return Vec::new();
    };
    let job = Job::of(drawing, &[], settings);
    let correction = job.units(settings.correction);
    let contour = &outline.contour;
    let segment = |at: usize| contour.segment(drawing, at);
    let Ok((walls, _, laid)) = job.along(
        contour.len(),
        segment,
        side.sign(),
        correction,
        contour.closed,
    ) else {
        return Vec::new();
    };
    match laid {
        Ok(Laid::Path(_)) => Vec::new(),
        Ok(Laid::Point(_)) => {
            let severity = settings.severity_over(Rule::OffsetCollapse, Severity::Warning);
            let mut found = job.no_path(&Fault::Nothing, &walls, correction);
            for finding in &mut found {
                finding.severity = severity.unwrap_or(finding.severity);
                finding.detail = Detail::OffsetCollapse {
                    required: correction,
                    point: true,
                };
            }
            found
        }
        Err(fault) => job.no_path(&fault, &walls, correction),
    }
}
