//! `arc-without-radius`: an arc that begins in its own centre.

use super::{BlockRule, Seen, Sight, Site, Spot, TextFix};
use crate::finding::{Fault, FixKind, Rule};

pub(super) const RULE: BlockRule = BlockRule {
    rule: Rule::ArcWithoutRadius,
    look,
    fixes,
};

fn look(seen: &Seen) -> Option<Sight> {
    let has_none = !seen.is_line() && seen.block.x == 0 && seen.block.y == 0;
    has_none.then(|| Sight::at(Spot::Block, Fault::ArcWithoutRadius))
}

/// Without it the way is the same: safe where the contour closes then.
fn fixes(site: &Site, _: &Fault) -> Vec<TextFix> {
    vec![site.delete(FixKind::DeleteBlock, (site.closes_with)(&[]))]
}
