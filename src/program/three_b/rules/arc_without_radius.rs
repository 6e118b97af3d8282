//! `arc-without-radius`: an arc that begins in its own centre.

use super::{Observation, Outlook, Site, Spot, TextFix};
use crate::finding::{Fault, FixKind};

pub(super) fn check(outlook: &Outlook) -> Option<Observation> {
    let has_none = !outlook.is_line() && outlook.block.x == 0 && outlook.block.y == 0;
    has_none.then(|| Observation::at(Spot::Block, Fault::ArcWithoutRadius))
}

/// Without it the way is the same: safe if the contour then closes.
pub(super) fn fixes(site: &Site) -> Vec<TextFix> {
    vec![site.delete(FixKind::DeleteBlock, (site.closes_with)(&[]))]
}
