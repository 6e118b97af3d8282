//! `wrong-quadrant`: Z contradicts a line along an axis, or keeps the contour open.
//!
//! +X is `L1`, +Y `L2`, −X `L3`, −Y `L4`. Since a zero has no sign, the other quadrant at the same half axis leads to
//! the same place; it is an error only where Z alone gives the direction, or where the contour does not close.

use super::{BlockRule, Counts, Observation, Outlook, Site, Spot, TextFix};
use crate::finding::{Axis, Fault, FixKind, Rule};
use crate::program::three_b::block::{Block, Motion, Quadrant};

pub(super) const RULE: BlockRule = BlockRule {
    rule: Rule::WrongQuadrant,
    check,
    fixes,
};

fn check(outlook: &Outlook) -> Option<Observation> {
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

fn fixes(site: &Site, fault: &Fault) -> Vec<TextFix> {
    match fault {
        Fault::QuadrantKeepsOpen { meant, is_sure, .. } => {
            let kind = FixKind::SetMotion { name: meant };
            vec![site.fix(kind, &named(&site.block, meant), *is_sure)]
        }
        Fault::AxisQuadrant { expected, .. } | Fault::UnusualQuadrant { expected, .. } => {
            let is_fault = matches!(fault, Fault::AxisQuadrant { .. });
            let closes = |name: &&str| (site.closes_with)(&[named(&site.block, name)]);
            let mut all_closing = expected.iter().copied().filter(closes);
            let (closing, is_only) = (all_closing.next(), all_closing.next().is_none());
            // The half axis that the controller takes it for now.
            let same = match (site.block.motion, expected[0]) {
                (Motion::Line(Quadrant::Fourth), "L1") | (Motion::Line(Quadrant::First), "L2") => {
                    expected[0]
                }
                _ => expected[1],
            };
            let first = if is_fault {
                closing.unwrap_or(same)
            } else {
                same
            };
            let mut names = vec![first];
            // The other one leads the other way, which nobody wants where the contour closes.
            names.extend(
                expected
                    .iter()
                    .copied()
                    .filter(|name| is_fault && *name != first),
            );
            let fix = |(index, name): (usize, &'static str)| {
                let is_safe = index == 0 && is_fault && closing.is_some() && is_only;
                let made = named(&site.block, name);
                let fix = site.fix(FixKind::SetMotion { name }, &made, is_safe);
                fix.preferred_if(index == 0)
            };
            names.into_iter().enumerate().map(fix).collect()
        }
        _ => Vec::new(),
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
