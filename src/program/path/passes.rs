//! Passes: one contour that is cut several times in one go, each time on the same way or a little beside it.

use super::crossing::BESIDE;
use super::way::Way;
use crate::geometry::{Bounds, Point, Segment};
use std::ops::Range;

/// The most blocks before the first pass, or from one to the next.
const BETWEEN: usize = 6;

/// The most passes of a way that are looked at.
pub(super) const MOST_PASSES: usize = 64;

/// The passes of a way, the ways in and out with the first and the last of them; empty for a way with a single round.
pub(crate) fn passes(way: &Way) -> Vec<Range<usize>> {
    let found = may_have_passes(way).then(|| found(way));
    found.filter(|passes| passes.len() > 1).unwrap_or_default()
}

/// False where the way does not return to one of its first nodes long before it ends.
fn may_have_passes(way: &Way) -> bool {
    let (count, tolerance) = (way.count(), way.tolerance());
    let last = count.saturating_sub(2);
    (0..=BETWEEN.min(count)).any(|index| {
        let node = way.node(index).ideal;
        let behind = way.pieces().get(index + 2..=last).unwrap_or_default();
        let is_back = |piece: &Segment| (piece.start() - node).norm() <= tolerance;
        behind.iter().any(is_back)
    })
}

fn found(way: &Way) -> Vec<Range<usize>> {
    let tolerance = way.tolerance();
    let mut passes: Vec<Range<usize>> = Vec::new();
    let mut first_box: Option<Bounds> = None;
    let mut from = 0;
    while passes.len() < MOST_PASSES {
        let Some((end, bounds)) = round_from(way, from, tolerance, first_box.as_ref()) else {
            break;
        };
        first_box.get_or_insert(bounds);
        // The way between two passes belongs to the next.
        passes.push(passes.last().map_or(0, |before| before.end)..end);
        from = end;
    }
    let is_all = passes.len() < MOST_PASSES;
    if let Some(last) = passes.last_mut().filter(|_| is_all) {
        last.end = way.count();
    }
    passes
}

/// True where two closed ways may be passes of one contour by their boxes, µm.
pub(crate) fn lie_beside(one: &Bounds, other: &Bounds) -> bool {
    let apart = |a: Point, b: Point| (a - b).amax();
    apart(one.min, other.min) <= BESIDE && apart(one.max, other.max) <= BESIDE
}

/// A way that may come back to its start.
struct Begun {
    first: Segment,
    pieces: usize,
    bounds: Bounds,
}

/// Among the rounds that begin with one of the next pieces, the end of the one that returns to its
/// start first, and its box, which is that of the first pass: the way in and out may return to
/// their own start, after all passes.
fn round_from(
    way: &Way,
    from: usize,
    tolerance: f64,
    first_box: Option<&Bounds>,
) -> Option<(usize, Bounds)> {
    let around = first_box.map(|first| first.grown(BESIDE + 1.0));
    let mut begun: Vec<Begun> = Vec::with_capacity(BETWEEN + 1);
    for (index, piece) in way.pieces().iter().copied().enumerate().skip(from) {
        if index <= from + BETWEEN {
            begun.push(Begun {
                first: piece,
                pieces: 0,
                bounds: Bounds::EMPTY,
            });
        }
        let (own, mut found) = (piece.bounds(), None);
        begun.retain_mut(|round| {
            round.pieces += 1;
            round.bounds.merge(&own);
            let is_back = (piece.end() - round.first.start()).norm() <= tolerance;
            let goes_round = match round.pieces {
                1 => piece.as_arc().is_some_and(|arc| arc.is_full_turn()),
                2 => [round.first, piece]
                    .iter()
                    .any(|piece| piece.as_arc().is_some()),
                _ => true,
            };
            let is_large = round.bounds.width().min(round.bounds.height()) > 4.0 * tolerance;
            let is_round = is_back && goes_round && is_large;
            if is_round && first_box.is_none_or(|first| lie_beside(first, &round.bounds)) {
                found.get_or_insert(round.bounds);
            }
            !is_round && around.is_none_or(|around| around.holds(&round.bounds))
        });
        if let Some(bounds) = found {
            return Some((index + 1, bounds));
        }
        if begun.is_empty() && index >= from + BETWEEN {
            return None;
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use crate::program::{Document, Language};
    use crate::settings::Effective;

    /// A star, R 10 and 5, at a distance beside it.
    fn star(beside: f64) -> Vec<[f64; 2]> {
        let at = |index: usize| {
            let (angle, radius) = (
                index as f64 * 0.2 * std::f64::consts::PI,
                if index.is_multiple_of(2) { 10.0 } else { 5.0 },
            );
            [
                angle.cos() * (radius + beside),
                angle.sin() * (radius + beside),
            ]
        };
        (0..=10).map(at).collect()
    }

    #[track_caller]
    fn crossings(way: &[[f64; 2]]) -> usize {
        let way: Vec<Option<[f64; 2]>> = way.iter().copied().map(Some).collect();
        with_stops(&way)
    }

    /// Crossings that are reported for a way in each language, mm; `None` is a stop.
    #[track_caller]
    fn with_stops(way: &[Option<[f64; 2]>]) -> usize {
        let line = |step: &Option<[f64; 2]>| match step {
            Some([x, y]) => format!("G01 X{x:.3} Y{y:.3}\n"),
            None => "M00\n".to_owned(),
        };
        let iso = format!(
            "G92 X0. Y0.\nG90\n{}M02\n",
            way.iter().map(line).collect::<String>()
        );
        let mut at = [0_i64, 0];
        let block = |step: &Option<[f64; 2]>| {
            let Some(to) = step else {
                return "D\n".to_owned();
            };
            let to = to.map(|mm| (mm * 1e3).round() as i64);
            let (dx, dy) = (to[0] - at[0], to[1] - at[1]);
            at = to;
            let quadrant = match (dx, dy) {
                (dx, dy) if dx > 0 && dy >= 0 => 1,
                (dx, dy) if dx <= 0 && dy > 0 => 2,
                (dx, dy) if dx < 0 && dy <= 0 => 3,
                _ => 4,
            };
            let axis = if dx.abs() > dy.abs() { 'X' } else { 'Y' };
            format!(
                "B{}B{}B{}G{axis}L{quadrant}\n",
                dx.abs(),
                dy.abs(),
                dx.abs().max(dy.abs())
            )
        };
        let three_b = format!("{}DD\n", way.iter().map(block).collect::<String>());
        let count = |language: Language, text: &str| {
            let document = Document::read(language, text.into(), &Effective::default());
            let (findings, _) = document.findings(&Effective::default(), usize::MAX);
            let of_rule = |name: &str| {
                let named = findings
                    .iter()
                    .filter(|finding| finding.rule.name() == name);
                named.count()
            };
            assert_eq!(of_rule("not-closed"), 0, "{text}");
            of_rule("path-crosses-itself")
        };
        let (of_iso, of_three_b) = (
            count(Language::Iso, &iso),
            count(Language::ThreeB, &three_b),
        );
        assert_eq!(of_iso, of_three_b, "{iso}\n{three_b}");
        of_iso
    }

    #[test]
    fn passes_on_one_way_and_beside_each_other_cross_nothing() {
        let out = [[0.0, 0.0]];
        let back: Vec<[f64; 2]> = star(0.0).into_iter().rev().collect();
        assert_eq!(crossings(&[&star(0.0)[..], &out].concat()), 0);
        // Three times the same, to and fro, and a second one inside the first.
        assert_eq!(
            crossings(&[&star(0.0)[..], &star(0.0)[1..], &star(0.0)[1..], &out].concat()),
            0
        );
        assert_eq!(
            crossings(&[&star(0.0)[..], &back[1..], &star(0.0)[1..], &out].concat()),
            0
        );
        assert_eq!(
            crossings(&[&star(0.0)[..], &star(0.03)[..], &out].concat()),
            0
        );
        assert_eq!(
            crossings(
                &[
                    &star(0.0)[..],
                    &star(0.03)[..],
                    &star(0.04)[..],
                    &[[12.0, 3.0]]
                ]
                .concat()
            ),
            0
        );
        // A way out on the other side of the first pass.
        assert_eq!(
            crossings(&[&star(0.0)[..], &star(0.0)[1..], &[[13.0, 0.0]]].concat()),
            0
        );
    }

    #[test]
    fn a_pass_that_crosses_itself_does() {
        let mut wrong = star(0.0);
        wrong.swap(2, 7);
        assert!(crossings(&[&star(0.0)[..], &wrong[1..], &[[0.0, 0.0]]].concat()) > 0);
        assert!(crossings(&[&wrong[..], &[[0.0, 0.0]]].concat()) > 0);
        // Two contours of which one cuts through the other.
        let aside: Vec<[f64; 2]> = star(0.0).into_iter().map(|[x, y]| [x + 6.0, y]).collect();
        assert!(crossings(&[&star(0.0)[..], &aside, &[[16.0, 9.0]]].concat()) > 0);
    }

    #[test]
    fn of_many_passes_the_first_are_looked_at_and_it_is_said() {
        let told = |rounds: usize| {
            let way = [&star(0.0)[..1], &star(0.0)[1..].repeat(rounds)[..]].concat();
            let line = |[x, y]: &[f64; 2]| format!("G01 X{x:.3} Y{y:.3}\n");
            let text = format!(
                "G92 X0. Y0.\nG90\n{}M02\n",
                way.iter().map(line).collect::<String>()
            );
            let document = Document::read(Language::Iso, text.into(), &Effective::default());
            let (findings, _) = document.findings(&Effective::default(), usize::MAX);
            findings.iter().any(|one| one.rule.name() == "not-judged")
        };
        assert!(!told(super::MOST_PASSES - 2));
        assert!(told(super::MOST_PASSES + 2));
    }

    #[test]
    fn passes_that_part_from_the_first_are_not_held_against_each_other_without_bound() {
        let squares = "B9000B0B9000GXL1\nB0B9000B9000GYL2\nB9000B0B9000GXL3\nB0B9000B9000GYL4\n";
        let (before, behind) = (squares.repeat(3), squares.repeat(3_000));
        let turned = squares.replacen("GYL2", "GYL4", 1);
        let text = format!("{before}{turned}{behind}DD\n");
        let document = Document::read(Language::ThreeB, text.into(), &Effective::default());
        let (findings, _) = document.findings(&Effective::default(), usize::MAX);
        assert!(findings.iter().any(|one| one.rule.name() == "not-judged"));
    }

    /// A way with a stop after the first `before` of its places.
    fn stopping(way: &[[f64; 2]], before: usize) -> Vec<Option<[f64; 2]>> {
        let mut way: Vec<_> = way.iter().copied().map(Some).collect();
        way.insert(before, None);
        way
    }

    const SQUARE: [[f64; 2]; 5] = [
        [2.0, 0.0],
        [12.0, 0.0],
        [12.0, 10.0],
        [2.0, 10.0],
        [2.0, 3.0],
    ];

    #[test]
    fn a_cut_off_that_runs_through_the_part_crosses_its_contour() {
        let cut_off = |way: &[[f64; 2]]| with_stops(&stopping(&[&SQUARE[..], way].concat(), 5));
        // Straight back to where the contour began, and out.
        assert_eq!(cut_off(&[[2.0, 0.0], [0.0, 0.0]]), 0);
        assert_eq!(cut_off(&[[2.0, 0.0]]), 0);
        assert_eq!(cut_off(&[[3.0, 1.5], [2.0, 0.0], [0.0, 0.0]]), 0);
        // Through the wall on the other side, and round to the start.
        assert_eq!(
            cut_off(&[
                [14.0, 3.0],
                [14.0, -2.0],
                [2.0, -2.0],
                [2.0, 0.0],
                [0.0, 0.0]
            ]),
            1
        );
        assert_eq!(
            cut_off(&[[6.0, 3.0], [6.0, -2.0], [2.0, -2.0], [2.0, 0.0], [0.0, 0.0]]),
            1
        );
        assert_eq!(
            cut_off(&[[6.0, 12.0], [0.0, 12.0], [0.0, 0.0], [2.0, 0.0]]),
            1
        );
    }

    #[test]
    fn passes_to_and_fro_that_leave_the_tab_cross_nothing() {
        let beside = |by: f64| {
            [
                [2.0 - by, -by],
                [12.0 + by, -by],
                [12.0 + by, 10.0 + by],
                [2.0 - by, 10.0 + by],
                [2.0 - by, 3.0],
            ]
        };
        let reversed = |mut way: [[f64; 2]; 5]| {
            way.reverse();
            way
        };
        let out: [[f64; 2]; 2] = [[2.0, 0.0], [0.0, 0.0]];
        for by in [0.0, -0.03] {
            let (first, second, third) = (beside(0.0), reversed(beside(by)), beside(1.5 * by));
            let mut three = [&first[..], &second[..], &third[..]].concat();
            three.dedup();
            let cut_off = [[2.0 - 1.5 * by, -1.5 * by], [0.0, 0.0]];
            assert_eq!(
                with_stops(&stopping(&[&three[..], &cut_off].concat(), three.len())),
                0,
                "three passes, {by} beside"
            );
            // The tab in passes of its own, to and fro.
            let end = [2.0 - 1.5 * by, 3.0];
            let tab = [cut_off[0], end, cut_off[0], [0.0, 0.0]];
            assert_eq!(
                with_stops(&stopping(&[&three[..], &tab].concat(), three.len())),
                0,
                "passes of the tab, {by} beside"
            );
            // Each pass from the thread hole and back there.
            let entry = [[0.0, 0.0]];
            let apart = [&first[..], &second[..], &entry, &third[..]].concat();
            assert_eq!(
                with_stops(&stopping(&[&apart[..], &cut_off].concat(), apart.len())),
                0,
                "passes by the thread hole, {by} beside"
            );
        }
        // A tab alone, in the slug: the way out meets the pass of the way in where that begins.
        let alone = [
            [-3.969, 1.565],
            [-4.621, -1.363],
            [-4.660, -1.354],
            [-4.008, 1.574],
            [0.0, 0.0],
        ];
        assert_eq!(crossings(&alone), 0);
        // It cuts the part where the pass back is none.
        let mut through = alone;
        through[3] = [-4.2, -0.2];
        through[4] = [-4.4, -0.6];
        assert_eq!(
            crossings(&[&through[..], &[[-4.0, 0.4], [0.0, 0.0]]].concat()),
            1
        );
        let two = [&SQUARE[..], &reversed(SQUARE)[..4], &out].concat();
        assert_eq!(crossings(&two), 0);
    }
}
