//! `reversed-arc`: the fixes for an arc that runs the wrong way round. Its joints reveal it ([`crate::program::path`]).

use super::{Site, TextFix};
use crate::geometry::{Arc, Point, Segment};
use crate::program::three_b::block::{Block, Motion};
use crate::program::three_b::decode::meant;
use crate::program::three_b::encode::counted;
use std::f64::consts::TAU;

/// The arc about the same centre between the same ends, the other way round.
pub(super) fn fixes(site: &Site) -> Vec<TextFix> {
    site.one_of(exchanged(&site.block))
}

fn exchanged(block: &Block) -> Option<Block> {
    let Segment::Arc(arc) = meant(block, Point::origin())? else {
        return None;
    };
    let other = Arc {
        sweep: arc.sweep - TAU.copysign(arc.sweep),
        ..arc
    };
    let start = arc.start - arc.center;
    let [x, y] = [start.x, start.y].map(|um| um.round() as i64);
    let motion = Motion::arc(arc.sweep < 0.0, x, y);
    let j = counted(&other, block.axis).round() as i64;
    Some(Block {
        j,
        motion,
        ..*block
    })
}
