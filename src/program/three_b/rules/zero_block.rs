//! `zero-block`: a block that moves nothing.

use super::{Seen, Sight, Site, Spot, TextFix};
use crate::finding::{Fault, FixKind};

pub(super) fn look(seen: &Seen) -> Option<Sight> {
    let block = seen.block;
    let is_zero = block.j == 0 && (!seen.is_line() || (block.x == 0 && block.y == 0));
    is_zero.then(|| Sight::at(Spot::Block, Fault::ZeroBlock))
}

pub(super) fn fixes(site: &Site) -> Vec<TextFix> {
    vec![site.delete(FixKind::DeleteBlock, true)]
}
