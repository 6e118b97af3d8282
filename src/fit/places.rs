//! Each place in which two parts bind, once: the walls that meet in a corner say the same as the corner itself.

use super::observations::{Lies, Verdict, verdict_on};

/// The numbers of what was seen of walls of the punch, without what a neighbour or a corner already says of the same place. Clearances and places
/// that differ by less than the rounding count as equal. The punch has `count` edges.
pub(super) fn own_places(all: &[Vec<Verdict>; 3], count: u32, rounding: f64) -> Vec<u32> {
    let [of_punch, of_plate, of_walls] = all;
    // By the edge of the punch.
    let corners = of_punch.iter().map(|verdict| (verdict.edge, verdict));
    let of_plate = of_plate.iter();
    let mut corners: Vec<_> = corners
        .chain(of_plate.map(|verdict| (verdict.other, verdict)))
        .collect();
    corners.sort_by_key(|(edge, _)| *edge);
    let neighbours = |edge: u32| [(edge + count - 1) % count, (edge + 1) % count];
    let is_in_corner = |verdict: &Verdict| {
        let [before, next] = neighbours(verdict.edge);
        [before, verdict.edge, next].into_iter().any(|edge| {
            let first = corners.partition_point(|(known, _)| *known < edge);
            let known = corners[first..]
                .iter()
                .take_while(|(known, _)| *known == edge);
            known.map(|(_, corner)| corner).any(|corner| {
                let Lies::InCorner { away } = corner.lies else {
                    return false;
                };
                corner.clearance <= verdict.clearance + rounding
                    && (corner.at_other - verdict.at).norm() <= away
            })
        })
    };
    let is_told_by = |other: &Verdict, verdict: &Verdict| {
        let is_deeper = other.clearance < verdict.clearance - rounding;
        let is_same = (other.at - verdict.at).norm() <= rounding
            && other.clearance <= verdict.clearance + rounding;
        match verdict.lies {
            Lies::AtEnd { .. } if is_deeper => true,
            Lies::AtEnd { .. } if matches!(other.lies, Lies::OnWall | Lies::AllAlong) => true,
            // An arc of the other part that more than one wall stands beyond.
            Lies::OnTip if other.other == verdict.other && is_deeper => true,
            Lies::AtEnd { .. } | Lies::OnTip => is_same && other.edge < verdict.edge,
            Lies::OnWall | Lies::AllAlong | Lies::InCorner { .. } => false,
        }
    };
    let is_beside = |verdict: &Verdict| {
        let [before, next] = neighbours(verdict.edge);
        let mut told = match verdict.lies {
            Lies::AtEnd { is_last: false } => [Some(before), None],
            Lies::AtEnd { is_last: true } => [Some(next), None],
            _ => [Some(before), Some(next)],
        }
        .into_iter()
        .flatten();
        told.any(|edge| {
            verdict_on(of_walls, edge as usize).is_some_and(|other| is_told_by(other, verdict))
        })
    };
    let is_own = |verdict: &Verdict| match verdict.lies {
        Lies::AllAlong => true,
        _ => !is_in_corner(verdict) && !is_beside(verdict),
    };
    let walls = (0..).zip(of_walls);
    let own = walls.filter(|(_, verdict)| is_own(verdict));
    own.map(|(number, _)| number).collect()
}
