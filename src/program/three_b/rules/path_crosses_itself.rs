//! `path-crosses-itself`: two blocks of one contour go through each other.
//!
//! A touch is no crossing: lead-in and lead-out may lie on each other and end on the contour, and what a closed contour misses its
//! own beginning by makes no crossing there. So two pieces cross only where each reaches further to both sides than that.

use super::not_closed::tolerance;
use crate::geometry::{Bounds, Point, Segment, meetings};

/// Two pieces, by their index, and where they cross.
#[derive(Clone, Debug, PartialEq)]
pub(in super::super) struct Crossing {
    pub first: usize,
    pub second: usize,
    pub at: Point,
}

/// Crossings that are looked for in one contour; more tell nobody more.
const MOST: usize = 50;

/// Pieces that are compared before the search ends: a way that lies upon itself everywhere is no contour.
const MOST_PAIRS: usize = 20_000_000;

/// Where consecutive pieces of a way cross others, in the order of the way.
pub(in super::super) fn crossings(pieces: &[Segment], arcs: usize) -> Vec<Crossing> {
    // Half a millimetre, however many arcs: a crossing on a part is wider.
    let margin = tolerance(arcs).min(500.0);
    let mut found = Vec::new();
    let mut pairs_left = MOST_PAIRS;
    let tree = Boxes::of(pieces);
    tree.pairs(&mut |first, second| {
        pairs_left = pairs_left.saturating_sub(1);
        if second > first + 1
            && let (Some(a), Some(b)) = (pieces.get(first), pieces.get(second))
            && let Some(at) = meetings(a, b).into_iter().find(|&at| goes_through(a, b, at, margin) && goes_through(b, a, at, margin))
        {
            found.push(Crossing { first, second, at });
        }
        pairs_left > 0 && found.len() < MOST
    });
    found.sort_by_key(|crossing| (crossing.second, crossing.first));
    found
}

/// True where `piece` comes from one side of `other` and goes to its other side at `at`, further than `margin` on both.
fn goes_through(piece: &Segment, other: &Segment, at: Point, margin: f64) -> bool {
    let share = piece.share_of(at);
    let length = piece.length();
    let ends = [piece.start(), piece.end()].map(|end| (end - at).norm());
    if ends.iter().any(|&distance| distance <= margin) || length == 0.0 {
        return false;
    }
    // A little way off on both sides, and at the ends.
    let reach = (4.0 * margin / length).min(0.5);
    let sides = [share - reach, share + reach].map(|share| side(other, piece.point_at(share.clamp(0.0, 1.0))));
    let far = [0.0, 1.0].map(|end| other.distance_to(piece.point_at(end)) > margin);
    sides[0] * sides[1] < 0.0 && far[0] && far[1]
}

/// On which side of a segment's line or circle a point lies.
fn side(segment: &Segment, point: Point) -> f64 {
    match segment {
        Segment::Line(line) => crate::geometry::cross(line.end - line.start, point - line.start).signum(),
        Segment::Arc(arc) => ((point - arc.center).norm() - arc.radius).signum(),
    }
}

/// Boxes about pieces, about pairs of boxes, and so on up to one: neighbours on the way are neighbours in the plane.
struct Boxes {
    /// From single pieces up.
    levels: Vec<Vec<Bounds>>,
}

impl Boxes {
    fn of(pieces: &[Segment]) -> Boxes {
        let mut levels = vec![pieces.iter().map(Segment::bounds).collect::<Vec<_>>()];
        while let Some(last) = levels.last().filter(|level| level.len() > 1) {
            let next = last.chunks(2).map(|pair| pair.iter().fold(Bounds::EMPTY, |whole, part| whole.merged(part))).collect();
            levels.push(next);
        }
        Boxes { levels }
    }

    /// Calls `visit` with pairs of different pieces whose boxes touch, the earlier first, until it says false.
    fn pairs(&self, visit: &mut impl FnMut(usize, usize) -> bool) {
        let mut waiting = vec![(self.levels.len() - 1, 0, 0)];
        while let Some((level, a, b)) = waiting.pop() {
            if a != b && !self.touch(level, a, b) {
                continue;
            }
            if level == 0 {
                if a != b && !visit(a, b) {
                    return;
                }
                continue;
            }
            let below = &self.levels[level - 1];
            for i in 2 * a..(2 * a + 2).min(below.len()) {
                for j in 2 * b..(2 * b + 2).min(below.len()) {
                    if a != b || i <= j {
                        waiting.push((level - 1, i, j));
                    }
                }
            }
        }
    }

    fn touch(&self, level: usize, a: usize, b: usize) -> bool {
        let boxes = &self.levels[level];
        matches!((boxes.get(a), boxes.get(b)), (Some(a), Some(b)) if a.touches(b))
    }
}
