//! `wrong-j`: J of a line is neither its projection nor the scale of a ratio.
//!
//! Where X or Y has one digit too many or too few, that number is wrong and J is right: the change that makes the
//! contour close decides.

use super::projection::{Length, length};
use super::{BlockRule, Counts, Observation, Outlook, Site, Spot, TextFix};
use crate::finding::{Axis, Fault, FixKind, Rule};
use crate::program::three_b::block::Block;

pub(super) const RULE: BlockRule = BlockRule {
    rule: Rule::WrongJ,
    check,
    fixes,
};

fn check(outlook: &Outlook) -> Option<Observation> {
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

fn fixes(site: &Site, fault: &Fault) -> Vec<TextFix> {
    if let Fault::JKeepsOpen { meant, is_sure, .. } = *fault {
        return vec![site.set_j(meant, is_sure)];
    }
    let Block { x, y, j, .. } = site.block;
    let projection = x.max(y);
    let by_j = Block {
        j: projection,
        ..site.block
    };
    // The larger number with the digits that J has.
    let other = x.min(y);
    let by_number = if x >= y {
        Block { x: j, ..site.block }
    } else {
        Block { y: j, ..site.block }
    };
    let is_shifted = j > 0
        && other <= j
        && (projection == 10 * j || 10 * projection == j || projection == 100 * j);
    let number_closes = j > 0 && other <= j && (site.closes_with)(&[by_number]);
    let j_closes = (site.closes_with)(&[by_j]);
    let number_first = number_closes || (is_shifted && !j_closes);
    let field = if x >= y { Axis::X } else { Axis::Y };
    let set_j = site.set_j(projection, j_closes || j == 0);
    let mut fixes = vec![set_j.preferred_if(!number_first)];
    if number_closes || is_shifted {
        let kind = FixKind::SetEnd {
            axis: field,
            value: j,
        };
        let set_number = site.fix(kind, &by_number, number_closes);
        let set_number = set_number.preferred_if(number_first);
        fixes.insert(if number_first { 0 } else { 1 }, set_number);
        // The contour says which of the two is wrong.
        if number_closes && !j_closes {
            fixes.truncate(1);
        }
    }
    fixes
}
