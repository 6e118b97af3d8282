//! The head of a page: its heading, the fields of a set-up sheet, and where the contours lie.

use super::super::output;
use crate::document::Snapshot;
use crate::geometry::Bounds;
use crate::program::Format;
use crate::settings::Effective;
use std::path::Path;

/// The heading of a page.
pub(super) fn titled(settings: &Effective, path: &Path) -> String {
    let job = &settings.job;
    let stated = job.title.clone().or_else(|| job.part.clone());
    stated.unwrap_or_else(|| output::name(path))
}

/// The name of a file without its folder and its ending.
pub(super) fn stem_of(name: &str) -> String {
    let stem = Path::new(name).file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}

/// What a set-up sheet has on top. What is not set can be written by hand.
pub(super) fn head(
    settings: &Effective,
    format: Format,
    path: &Path,
) -> Vec<(&'static str, String)> {
    let job = &settings.job;
    let mm = |length: Option<f64>| length.map_or_else(String::new, |mm| format!("{mm} mm"));
    let name = output::name(path);
    let ending = format.endings().first().copied().unwrap_or_default();
    let tool = match settings.mills {
        true => (say!(field_electrode), settings.milling.tool_diameter),
        false => (say!(field_wire), settings.wire_diameter),
    };
    let corrections = settings.each_correction().into_iter();
    let corrections: Vec<String> = corrections.map(|mm| format!("{mm:.4}")).collect();
    vec![
        (say!(field_part), job.part.clone().unwrap_or_default()),
        (say!(field_drawing), name.clone()),
        (
            say!(field_material),
            job.material.clone().unwrap_or_default(),
        ),
        (
            say!(field_revision),
            job.revision.clone().unwrap_or_default(),
        ),
        (say!(field_thickness), mm(job.thickness)),
        (say!(field_program), format!("{}.{ending}", stem_of(&name))),
        (say!(field_machine), job.machine.clone().unwrap_or_default()),
        (
            say!(field_programmer),
            job.programmer.clone().unwrap_or_default(),
        ),
        (
            tool.0,
            tool.1.map_or_else(String::new, |mm| format!("Ø {mm} mm")),
        ),
        // The day, UTC, as ISO 8601 has it.
        (
            say!(field_date),
            chrono::Utc::now().date_naive().to_string(),
        ),
        (
            say!(field_correction),
            format!("{} mm", corrections.join(" / ")),
        ),
    ]
}

/// Where the contours lie, from the drawing's zero.
pub(super) fn extents(snapshot: &Snapshot) -> String {
    let Snapshot {
        drawing,
        outlines,
        settings,
    } = snapshot;
    let mut bounds = Bounds::EMPTY;
    for outline in outlines.iter() {
        bounds.merge(&outline.contour.bounds(drawing));
    }
    if bounds.is_empty() {
        return String::new();
    }
    let mm = settings.unit_of(drawing).mm;
    let [left, right] = [bounds.min.x, bounds.max.x].map(|x| x * mm);
    let [low, high] = [bounds.min.y, bounds.max.y].map(|y| y * mm);
    say!(the_contours_lie_from_the_zero, left, right, low, high)
}
