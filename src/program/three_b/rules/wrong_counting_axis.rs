//! `wrong-counting-axis`: G names the axis on which the block hardly moves at its end.
//!
//! A line counts its larger projection. An arc counts the axis along which it runs at its end: X where the end lies nearer to the Y
//! axis of its centre, Y where it lies nearer to the X axis. Counted on the other axis, one µm of J is many µm of the way.

use super::{ARC_TIE, Counts, Seen, Sight, Site, Spot, TIE, TextFix, axis_of, one_edit};
use crate::finding::{Axis, Fault, FixKind};
use crate::geometry::{Arc, Point, Segment};
use crate::program::three_b::block::{Block, CountingAxis, Motion};
use crate::program::three_b::decode::decode;
use crate::program::three_b::encode::counted;

pub(super) fn look(seen: &Seen) -> Option<Sight> {
    let axis = seen.axis();
    if seen.is_line() {
        let Block { x, y, j, .. } = *seen.block;
        let (counted, other) = if axis == Axis::X { (x, y) } else { (y, x) };
        // A ratio is as near to a tie as the line that it stands for.
        let scale = if other > 0 && j > other { j / other } else { 1 };
        let contradicts = other > 0 && (other - counted).saturating_mul(scale) > TIE;
        return contradicts.then(|| {
            Sight::at(
                Spot::Axis,
                Fault::SmallerProjection {
                    axis,
                    counted,
                    larger: other,
                },
            )
        });
    }
    let Ok(Segment::Arc(arc)) = decode(seen.block, Point::origin()) else {
        return None;
    };
    let out = arc.end - arc.center;
    let (along, across) = if axis == Axis::X {
        (out.x.abs(), out.y.abs())
    } else {
        (out.y.abs(), out.x.abs())
    };
    let sight = || {
        Sight::at(
            Spot::Axis,
            Fault::ArcEndAxis {
                axis,
                x: out.x,
                y: out.y,
            },
        )
    };
    (along > across + ARC_TIE).then(|| Sight {
        counts: Counts::Always,
        ..sight()
    })
}

pub(super) fn fixes(site: &Site, fault: &Fault) -> Vec<TextFix> {
    let axis = site.block.axis.other();
    let name = axis_of(axis);
    let only_axis = |in_fix_all| {
        one_edit(
            FixKind::SetAxis {
                axis: name,
                j: None,
            },
            vec![site.set_axis(name)],
            true,
            in_fix_all,
        )
    };
    if let Fault::AxisKeepsOpen { is_sure, .. } = fault {
        return vec![only_axis(*is_sure)];
    }
    let flipped = Block { axis, ..site.block };
    if let Motion::Line(_) = site.block.motion {
        let larger = site.block.x.max(site.block.y);
        let is_ratio = site.block.j > larger + 2;
        if (site.block.j - larger).abs() <= 2 || (is_ratio && (site.closes_with)(&[flipped])) {
            return vec![only_axis(true)];
        }
        // J counted the smaller projection; of a ratio, the scale goes with it.
        let smaller = site.block.x.min(site.block.y);
        let j = match (is_ratio, smaller) {
            (true, 1..) => (site.block.j as f64 * larger as f64 / smaller as f64).round() as i64,
            _ => larger,
        };
        return vec![with_j(site, name, j, true)];
    }
    let Ok(Segment::Arc(arc)) = decode(&site.block, Point::origin()) else {
        return Vec::new();
    };
    let same_end = counted_on(&arc, axis);
    let with_same_end = with_j(site, name, same_end, true);
    if (site.closes_with)(&[flipped]) {
        return vec![
            only_axis(true),
            one_edit(with_same_end.kind, with_same_end.edit, false, false),
        ];
    }
    vec![with_same_end]
}

/// What an axis counts along the arc.
fn counted_on(arc: &Arc, axis: CountingAxis) -> i64 {
    counted(arc, axis).round() as i64
}

fn with_j(site: &Site, axis: Axis, j: i64, in_fix_all: bool) -> TextFix {
    let mut edit = vec![site.set_j(j), site.set_axis(axis)];
    edit.sort_by_key(|edit| edit.range.start);
    one_edit(
        FixKind::SetAxis { axis, j: Some(j) },
        edit,
        true,
        in_fix_all,
    )
}
