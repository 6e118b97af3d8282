//! `length-in-j`: J holds the length of the line, where the controller counts its projection.

use super::projection::{Length, length};
use super::{Observation, Outlook, Site, Spot, TextFix};
use crate::finding::{Axis, Fault};
use crate::program::three_b::block::Block;

pub(super) fn check(outlook: &Outlook) -> Option<Observation> {
    if !outlook.is_line() || length(outlook) != Length::Euclid {
        return None;
    }
    let projection = outlook.block.x.max(outlook.block.y);
    Some(Observation::at(
        Spot::J,
        Fault::LengthInJ {
            j: outlook.block.j,
            projection,
            axis: larger_axis(outlook),
        },
    ))
}

fn larger_axis(outlook: &Outlook) -> Axis {
    match outlook.block.x.cmp(&outlook.block.y) {
        std::cmp::Ordering::Greater => Axis::X,
        std::cmp::Ordering::Less => Axis::Y,
        std::cmp::Ordering::Equal => outlook.block.axis,
    }
}

pub(super) fn fixes(site: &Site) -> Vec<TextFix> {
    let j = site.block.x.max(site.block.y);
    vec![site.fix(&Block { j, ..site.block }, true)]
}
