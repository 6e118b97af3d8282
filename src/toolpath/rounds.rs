//! The ways round one contour without leads: what a program is compared with.

use super::contour_path::{Along, Laid};
use super::corners::Element;
use super::job::Job;
use super::path::{PathSegment, Refusal};
use super::skim::Rough;
use crate::drawing::{ContourSegment, Drawing};
use crate::geometry::Side;
use crate::settings::Effective;

/// The paths of all passes beside a contour whose segments are in the direction of travel, in that direction, from anywhere;
/// corrections in mm. A pass that has no path is `None`. Everything else is in a unit of `unit_mm` mm.
pub(crate) fn rounds(
    segments: &[ContourSegment],
    (side, closed): (Side, bool),
    corrections: &[f64],
    settings: &Effective,
    unit_mm: f64,
) -> Vec<Option<Vec<PathSegment>>> {
    let (drawing, side) = (Drawing::default(), side.sign());
    let job = Job {
        unit_mm,
        ..Job::of(&drawing, &[], settings)
    };
    let rough = job.units(corrections.iter().copied().fold(0.0, f64::max));
    let segment = |at: usize| segments.get(at).copied();
    let Ok((walls, own, first)) = job.along(segments.len(), segment, side, rough, closed) else {
        return Vec::new();
    };
    let mut first = Some(first);
    let mut before: Option<Rough> = None;
    let mut pass = |correction: f64| -> Result<Option<Vec<PathSegment>>, Refusal> {
        let along = Along {
            side,
            correction,
            closed,
        };
        let laid = match (first.take_if(|_| correction == rough), &before) {
            (Some(first), _) => first,
            (None, Some(rough)) => job.skim(&walls, &own, rough, along)?,
            (None, None) => job.laid(&walls, &own, along)?,
        };
        let Ok(Laid::Path(path)) = laid else {
            return Ok(None);
        };
        if before.is_none() {
            let path = path.clone();
            before = Some(Rough { correction, path });
        }
        let written = job.with_corners(path, (&walls, &own), correction, &|_| false);
        Ok(Some(written.iter().map(Element::piece).collect()))
    };
    corrections
        .iter()
        .map(|&mm| pass(job.units(mm)).unwrap_or_default())
        .collect()
}
