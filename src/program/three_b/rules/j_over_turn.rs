//! `j-over-turn`: J of an arc counts more than once round, 4R.

use super::super::decode::J_TOLERANCE;
use super::{Observation, Outlook, Site, Spot, TextFix};
use crate::finding::Fault;
use crate::program::three_b::block::Block;

pub(super) fn check(outlook: &Outlook) -> Option<Observation> {
    let turn = 4.0 * outlook.radius();
    let is_over = !outlook.is_line() && outlook.block.j as f64 > turn + J_TOLERANCE;
    is_over.then(|| {
        Observation::at(
            Spot::J,
            Fault::JOverTurn {
                j: outlook.block.j,
                turn: turn.round() as i64,
            },
        )
    })
}

pub(super) fn fixes(site: &Site) -> Vec<TextFix> {
    let turn = (4.0 * (site.block.x as f64).hypot(site.block.y as f64)).round() as i64;
    let meant = [turn, site.block.j / 10, site.block.j - turn].into_iter();
    let meant = meant.filter(|j| (1..=turn).contains(j));
    site.one_of(meant.map(|j| Block { j, ..site.block }))
}
