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
        (say!(field_date), today()),
        (
            say!(field_correction),
            format!("{} mm", corrections.join(" / ")),
        ),
    ]
}

/// The day, UTC, as ISO 8601 has it.
fn today() -> String {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    let days = now.map_or(0, |since| since.as_secs() / 86_400);
    day_of(days)
}

/// The date of a day that is so many days after 1 January 1970.
fn day_of(days: u64) -> String {
    // Years begin in March, so that the day that leap years have more is their last one.
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 {
        (month + 3, 0)
    } else {
        (month - 9, 1)
    };
    format!("{:04}-{month:02}-{day:02}", year + era * 400 + next)
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

#[cfg(test)]
mod tests {
    use super::day_of;

    #[test]
    fn days_have_dates() {
        for (days, date) in [
            (0, "1970-01-01"),
            (11_016, "2000-02-29"),
            (11_017, "2000-03-01"),
            (20_787, "2026-11-30"),
        ] {
            assert_eq!(day_of(days), date);
        }
    }
}
