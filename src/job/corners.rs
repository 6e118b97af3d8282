//! What is said of the corners that a program cuts off.

use super::Snapshot;
use crate::finding::{Detail, Finding, Place, Severity};
use crate::program::{CutCorner, ProvedProgram};
use crate::rule::Rule;

/// At most this many corners are named, those that lose most.
const MOST: usize = 24;

/// The corners that the wire goes round and that are arcs in the program, one finding each, except where a corner loses less than
/// the resolution.
pub(super) fn cut_off(snapshot: &Snapshot, program: &ProvedProgram) -> Vec<Finding> {
    let settings = &snapshot.settings;
    let unit_mm = settings.unit_of(&snapshot.drawing).mm;
    let least = settings.tolerances.in_units(unit_mm).resolution * unit_mm;
    let Some(severity) = settings.severity_over(Rule::SharpCorner, Severity::Warning) else {
        return Vec::new();
    };
    let loses = |corner: &&CutCorner| corner.depth >= least;
    let mut corners: Vec<CutCorner> = program.cut_corners.iter().filter(loses).copied().collect();
    corners.sort_by(|one, other| other.depth.total_cmp(&one.depth));
    let mut found: Vec<Finding> = Vec::new();
    for corner in corners {
        let place = corner.source.place().unwrap_or(Place::Document);
        // Each pass goes round it.
        if found.iter().any(|one| one.place == place) {
            continue;
        }
        if found.len() == MOST {
            break;
        }
        let sentence = say!(four_b_cuts_a_corner_off, corner.depth, corner.radius);
        found.push(Finding {
            rule: Rule::SharpCorner,
            severity,
            place,
            detail: Detail::Said(sentence),
            related: Vec::new(),
        });
    }
    found
}

/// True for a finding of [`cut_off`], and for what parts lose along a common line: a program is handed out with it.
pub(crate) fn is_of_program(finding: &Finding) -> bool {
    let is_of_common_line =
        finding.rule == Rule::NarrowSlot && finding.severity == Severity::Information;
    (finding.rule == Rule::SharpCorner || is_of_common_line)
        && matches!(finding.detail, Detail::Said(_))
}
