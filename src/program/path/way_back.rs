//! The way back along a pass that leaves a tab: where all passes go the same way, the wire returns along its own cut.

use crate::geometry::Segment;

/// Runs without those that go back along the one before.
pub(crate) fn without_ways_back(runs: Vec<&[Segment]>, near: f64) -> Vec<&[Segment]> {
    let mut kept: Vec<&[Segment]> = Vec::with_capacity(runs.len());
    let mut is_behind_way_back = false;
    for run in runs {
        let before = kept.last().filter(|_| !is_behind_way_back);
        is_behind_way_back = before.is_some_and(|before| goes_back(before, run, near));
        kept.extend((!is_behind_way_back).then_some(run));
    }
    kept
}

/// Whether a run retraces the one before, block for block, within `near`, in the unit of both. From a run that has come
/// round to its start there is no way back. Of two passes beside the same contour in opposite directions, each at its
/// own correction, none does; under the control's correction, where both have the same coordinates, it says nothing.
fn goes_back(before: &[Segment], run: &[Segment], near: f64) -> bool {
    let is_back = |one: &Segment, other: &Segment| {
        let pairs = [
            (one.start(), other.end()),
            (one.point_at(0.5), other.point_at(0.5)),
            (one.end(), other.start()),
        ];
        pairs
            .iter()
            .all(|(one, other)| (one - other).norm() <= near)
    };
    let comes_round = match (before.first(), before.last()) {
        (Some(first), Some(last)) => (first.start() - last.end()).norm() <= near,
        _ => true,
    };
    !comes_round
        && before.len() == run.len()
        && before
            .iter()
            .rev()
            .zip(run)
            .all(|(one, other)| is_back(one, other))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;

    #[test]
    fn only_the_same_way_back_goes_back() {
        let line = |from: [f64; 2], to: [f64; 2]| Segment::line(from.into(), to.into());
        let there = [
            line([0.0, 0.0], [10.0, 0.0]),
            Segment::from_bulge(Point::new(10.0, 0.0), Point::new(14.0, 4.0), 0.4142),
        ];
        let back: Vec<Segment> = there.iter().rev().map(Segment::reversed).collect();
        assert!(goes_back(&there, &back, 1e-6));
        assert!(!goes_back(&there, &there, 1e-6));
        assert!(!goes_back(&there, &back[..1], 1e-6));
        let beside = [line([14.0, 4.0], [10.0, 0.0]), back[1]];
        assert!(!goes_back(&there, &beside, 0.1), "the chord of the arc");
        assert!(!goes_back(&[], &[], 1e-6));
        let runs = vec![&there[..], &back[..], &there[..], &beside[..]];
        let kept = without_ways_back(runs, 1e-6);
        assert_eq!(kept, [&there[..], &there[..], &beside[..]]);
    }
}
