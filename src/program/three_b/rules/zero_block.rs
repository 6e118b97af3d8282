//! `zero-block`: a block that moves nothing.

use super::{Observation, Outlook, Site, Spot, TextFix};
use crate::finding::{Fault, FixKind, Rule};

pub(super) fn check(outlook: &Outlook) -> Option<Observation> {
    let block = outlook.block;
    let is_zero = block.j == 0 && (!outlook.is_line() || (block.x == 0 && block.y == 0));
    let sentence = || say!(the_block_moves_nothing);
    is_zero.then(|| Observation::at(Spot::Block, Fault::said(Rule::ZeroBlock, sentence())))
}

pub(super) fn fixes(site: &Site) -> Vec<TextFix> {
    vec![site.delete(FixKind::DeleteBlock, true)]
}
