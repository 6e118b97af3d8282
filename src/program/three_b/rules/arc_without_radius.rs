//! `arc-without-radius`: an arc that begins in its own centre.

use super::{Seen, Sight, Site, Spot, TextFix};
use crate::finding::{Fault, FixKind};

pub(super) fn look(seen: &Seen) -> Option<Sight> {
    let has_none = !seen.is_line() && seen.block.x == 0 && seen.block.y == 0;
    has_none.then(|| Sight::at(Spot::Block, Fault::ArcWithoutRadius))
}

/// Without it the way is the same: safe where the contour closes then.
pub(super) fn fixes(site: &Site) -> Vec<TextFix> {
    vec![site.delete(FixKind::DeleteBlock, (site.closes_with)(&[]))]
}
