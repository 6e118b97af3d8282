//! `wrong-counting-axis`: G names the axis on which the block hardly moves at its end.
//!
//! A line counts its larger projection. An arc counts the axis along which it runs at its end: X where the end lies
//! nearer to the Y axis of its centre, Y where it lies nearer to the X axis. On the other axis, one µm of J is many µm
//! of the way.

use super::{ARC_TIE, Observation, Outlook, Site, Spot, TIE, TextFix};
use crate::finding::{Fault, Rule};
use crate::geometry::{Point, Segment};
use crate::program::three_b::block::{Block, Quadrant};
use crate::program::three_b::decode::decode;
use crate::program::three_b::encode::counted;

pub(super) fn check(outlook: &Outlook) -> Option<Observation> {
    let axis = outlook.block.axis;
    if outlook.is_line() {
        let Block { x, y, j, .. } = *outlook.block;
        let [counted, other] = [axis, axis.other()].map(|axis| axis.of([x, y]));
        // A ratio is as near to a tie as its line.
        let scale = if other > 0 && j > other { j / other } else { 1 };
        let contradicts = other > 0 && (other - counted).saturating_mul(scale) > TIE;
        return contradicts.then(|| {
            Observation::at(
                Spot::Axis,
                Fault::SmallerProjection {
                    axis,
                    counted,
                    larger: other,
                },
            )
        });
    }
    let Ok(Segment::Arc(arc)) = decode(outlook.block, Point::origin()) else {
        return None;
    };
    let out = arc.end - arc.center;
    let [along, across] = [axis, axis.other()].map(|axis| axis.of([out.x, out.y]).abs());
    let fault = || {
        let sentence = say!(
            g_does_not_fit_the_end_of_the_arc,
            axis.letter(),
            out.x,
            out.y,
            axis.other().letter()
        );
        Fault::said(Rule::WrongCountingAxis, sentence)
    };
    (along > across + ARC_TIE).then(|| Observation::at(Spot::Axis, fault()))
}

pub(super) fn fixes(site: &Site) -> Vec<TextFix> {
    let axis = site.block.axis.other();
    let flipped = Block { axis, ..site.block };
    let with_j = |j: i64| Block { j, ..flipped };
    if let Ok(Segment::Arc(arc)) = decode(&site.block, Point::origin()) {
        let same_end = counted(&arc, axis).round() as i64;
        return match (site.closes_with)(&[flipped]) {
            true => site.one_of([flipped, with_j(same_end)]),
            false => site.one_of([with_j(same_end)]),
        };
    }
    if !site.block.motion.is_line() {
        return Vec::new();
    }
    let Block { x, y, j, .. } = site.block;
    let (larger, smaller) = (x.max(y), x.min(y));
    if (j - larger).abs() <= 2 && has_its_quadrant(&site.block) {
        return vec![site.fix(&flipped, true)];
    }
    let is_ratio = j > larger + 2;
    if (j - larger).abs() <= 2 || (is_ratio && (site.closes_with)(&[flipped])) {
        return site.one_of([flipped]);
    }
    // J counted the smaller projection; the scale of a ratio changes with it.
    site.one_of([with_j(match (is_ratio, smaller) {
        (true, 1..) => (j as f64 * larger as f64 / smaller as f64).round() as i64,
        _ => larger,
    })])
}

/// True for a line along an axis whose quadrant is the one for that axis: X and Y have not changed places.
fn has_its_quadrant(block: &Block) -> bool {
    let quadrant = block.motion.quadrant();
    let (sign_x, sign_y) = quadrant.signs();
    let is_usual = |x: i64, y: i64| {
        Quadrant::counter_clockwise(x * sign_x as i64, y * sign_y as i64) == quadrant
    };
    is_usual(block.x, block.y) && !is_usual(block.y, block.x)
}
