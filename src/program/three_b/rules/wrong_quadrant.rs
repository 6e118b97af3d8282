//! `wrong-quadrant`: Z contradicts a line along an axis, or keeps the contour open.
//!
//! +X is `L1`, +Y `L2`, −X `L3`, −Y `L4`. Since a zero has no sign, the other quadrant at the same half axis leads to
//! the same place; it is an error only where Z alone gives the direction, or where the contour does not close.

use super::{Counts, Observation, Outlook, Site, Spot, TextFix};
use crate::finding::{Axis, Fault};
use crate::program::three_b::block::{Block, Motion, Quadrant};

pub(super) fn check(outlook: &Outlook) -> Option<Observation> {
    let Motion::Line(quadrant) = outlook.block.motion else {
        return None;
    };
    let Block { x, y, j, .. } = *outlook.block;
    let axis = outlook.block.axis;
    let along = match (x, y) {
        (0, 0) => axis,
        (_, 0) => Axis::X,
        (0, _) => Axis::Y,
        _ => return None,
    };
    let belongs = match along {
        Axis::X => matches!(quadrant, Quadrant::First | Quadrant::Third),
        Axis::Y => matches!(quadrant, Quadrant::Second | Quadrant::Fourth),
    };
    if belongs || j == 0 || along != axis {
        return None;
    }
    let expected = if along == Axis::X {
        ["L1", "L3"]
    } else {
        ["L2", "L4"]
    };
    let observation = Observation::at(
        Spot::Motion,
        Fault::AxisQuadrant {
            found: outlook.block.motion.name(),
            expected,
            axis: along,
        },
    );
    Some(Observation {
        counts: if (x, y) == (0, 0) {
            Counts::Always
        } else {
            Counts::MildIfClosed
        },
        ..observation
    })
}

pub(super) fn fixes(site: &Site, fault: &Fault) -> Vec<TextFix> {
    let (Fault::AxisQuadrant { expected, .. } | Fault::UnusualQuadrant { expected, .. }) = fault
    else {
        return Vec::new();
    };
    let [one, other] = expected.map(|name| named(&site.block, name));
    // The half axis that the controller takes it for now.
    let [same, opposite] = match (site.block.motion, expected[0]) {
        (Motion::Line(Quadrant::Fourth), "L1") | (Motion::Line(Quadrant::First), "L2") => {
            [one, other]
        }
        _ => [other, one],
    };
    match fault {
        Fault::AxisQuadrant { .. } => site.one_of([same, opposite]),
        // The other one leads the other way, which nobody wants where the contour closes.
        _ => vec![site.fix(&same, false)],
    }
}

/// The block with the Z of a name.
fn named(block: &Block, name: &str) -> Block {
    let motion = Motion::all().find(|motion| motion.name() == name);
    Block {
        motion: motion.unwrap_or(block.motion),
        ..*block
    }
}
