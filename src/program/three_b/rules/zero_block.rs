//! `zero-block`: a block that moves nothing.

use super::{BlockRule, Seen, Sight, Site, Spot, TextFix};
use crate::finding::{Fault, FixKind, Rule};

pub(super) const RULE: BlockRule = BlockRule {
    rule: Rule::ZeroBlock,
    look,
    fixes,
};

fn look(seen: &Seen) -> Option<Sight> {
    let block = seen.block;
    let is_zero = block.j == 0 && (!seen.is_line() || (block.x == 0 && block.y == 0));
    let sentence = || say!(the_block_moves_nothing);
    is_zero.then(|| Sight::at(Spot::Block, Fault::said(Rule::ZeroBlock, sentence())))
}

fn fixes(site: &Site, _: &Fault) -> Vec<TextFix> {
    vec![site.delete(FixKind::DeleteBlock, true)]
}
