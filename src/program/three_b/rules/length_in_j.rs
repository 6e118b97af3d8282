//! `length-in-j`: J holds the length of the line, where the controller counts its projection.

use super::projection::{Length, length};
use super::{BlockRule, Observation, Outlook, Site, Spot, TextFix};
use crate::finding::{Axis, Fault, Rule};
use crate::program::three_b::block::Block;

pub(super) const RULE: BlockRule = BlockRule {
    rule: Rule::LengthInJ,
    check,
    fixes,
};

fn check(outlook: &Outlook) -> Option<Observation> {
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

fn fixes(site: &Site, _: &Fault) -> Vec<TextFix> {
    let j = site.block.x.max(site.block.y);
    vec![site.fix(&Block { j, ..site.block }, true)]
}
