//! `length-in-j`: J holds the length of the line, where the controller counts its projection.

use super::projection::{Length, length};
use super::{Seen, Sight, Site, Spot, TextFix, one_edit};
use crate::finding::{Fault, FixKind};

pub(super) fn look(seen: &Seen) -> Option<Sight> {
    if !seen.is_line() || length(seen) != Length::Euclid {
        return None;
    }
    let projection = seen.block.x.max(seen.block.y);
    Some(Sight::at(
        Spot::J,
        Fault::LengthInJ {
            j: seen.block.j,
            projection,
            axis: larger_axis(seen),
        },
    ))
}

fn larger_axis(seen: &Seen) -> crate::finding::Axis {
    match seen.block.x.cmp(&seen.block.y) {
        std::cmp::Ordering::Greater => crate::finding::Axis::X,
        std::cmp::Ordering::Less => crate::finding::Axis::Y,
        std::cmp::Ordering::Equal => seen.axis(),
    }
}

pub(super) fn fixes(site: &Site) -> Vec<TextFix> {
    let projection = site.block.x.max(site.block.y);
    vec![one_edit(
        FixKind::SetJ { j: projection },
        vec![site.set_j(projection)],
        true,
        true,
    )]
}
