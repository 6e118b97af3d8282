//! `wrong-j`: J of a line is neither its projection nor the scale of a ratio.
//!
//! Where X or Y has one digit too many or too few, that number is wrong and J is right: the change that makes the
//! contour close decides.

use super::projection::{Length, length};
use super::{Counts, Observation, Outlook, Site, Spot, TextFix};
use crate::finding::{Axis, Fault};
use crate::program::three_b::block::Block;

pub(super) fn check(outlook: &Outlook) -> Option<Observation> {
    let Block { x, y, j, .. } = *outlook.block;
    if !outlook.is_line() {
        return None;
    }
    let Length::Misfit { is_certain } = length(outlook) else {
        return None;
    };
    let axis = if x >= y { Axis::X } else { Axis::Y };
    let observation = Observation::at(
        Spot::J,
        Fault::WrongJ {
            j,
            projection: x.max(y),
            axis,
        },
    );
    Some(Observation {
        counts: if is_certain {
            Counts::Always
        } else {
            Counts::IfOpen
        },
        ..observation
    })
}

pub(super) fn fixes(site: &Site) -> Vec<TextFix> {
    let Block { x, y, j, .. } = site.block;
    let projection = x.max(y);
    let by_j = Block {
        j: projection,
        ..site.block
    };
    // The larger number with the digits that J has.
    let by_number = match x >= y {
        true => Block { x: j, ..site.block },
        false => Block { y: j, ..site.block },
    };
    let is_shifted = projection == 10 * j || 10 * projection == j || projection == 100 * j;
    let may_be_number = j > 0 && x.min(y) <= j;
    match may_be_number {
        true if is_shifted => site.one_of([by_number, by_j]),
        true if (site.closes_with)(&[by_number]) => site.one_of([by_j, by_number]),
        _ => site.one_of([by_j]),
    }
}
