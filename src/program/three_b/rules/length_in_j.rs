//! `length-in-j`: J holds the length of the line, where the controller counts its projection.

use super::projection::{Length, length};
use super::{BlockRule, Seen, Sight, Site, Spot, TextFix, one_edit};
use crate::finding::{Axis, Fault, FixKind, Rule};
use crate::program::three_b::block::Block;

pub(super) const RULE: BlockRule = BlockRule {
    rule: Rule::LengthInJ,
    look,
    fixes,
};

fn look(seen: &Seen) -> Option<Sight> {
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

fn larger_axis(seen: &Seen) -> Axis {
    match seen.block.x.cmp(&seen.block.y) {
        std::cmp::Ordering::Greater => Axis::X,
        std::cmp::Ordering::Less => Axis::Y,
        std::cmp::Ordering::Equal => seen.block.axis,
    }
}

fn fixes(site: &Site, _: &Fault) -> Vec<TextFix> {
    let projection = site.block.x.max(site.block.y);
    vec![one_edit(
        FixKind::SetJ { j: projection },
        site.made(&Block {
            j: projection,
            ..site.block
        }),
        true,
        true,
    )]
}
