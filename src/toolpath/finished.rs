//! The contour that all passes leave, compared with the drawing.
//!
//! A place of the contour is cut where a pass comes within half its kerf. The material elsewhere is measured by the
//! distance to the nearest cut place. Beside a wall that the last pass follows it is the difference of its correction
//! and half its kerf; it only has to be searched for where that pass leaves a wall, at corners.

use super::clearance::Walls;
use super::corners::Element;
use super::offset::Wall;
use super::path::Source;
use crate::geometry::{Point, Segment};

/// The largest deviations of a finished part from its drawing. Lengths in drawing units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finished {
    /// The largest thickness left beyond the contour; 0 where nothing is left.
    pub uncut: f64,
    /// Its place on the contour.
    pub(crate) at: Point,
    /// How far the wire cuts beyond the contour; 0 where it nowhere does.
    pub overcut: f64,
}

impl Finished {
    /// The worse of each.
    pub(crate) fn merged(self, other: Finished) -> Finished {
        let worse = if other.uncut > self.uncut {
            other
        } else {
            self
        };
        Finished {
            overcut: self.overcut.max(other.overcut),
            ..worse
        }
    }
}

/// One pass as it cuts. Lengths in drawing units.
pub(super) struct Kerf {
    path: Walls,
    correction: f64,
    half: f64,
}

impl Kerf {
    pub(crate) fn new(path: &[Element], stand: Point, correction: f64, half: f64) -> Kerf {
        let mut pieces: Vec<Segment> = path.iter().map(|element| element.geometry).collect();
        if pieces.is_empty() {
            pieces.push(Segment::line(stand, stand));
        }
        Kerf {
            path: Walls::new(pieces),
            correction,
            half,
        }
    }

    /// The distance of a point from the cut of this pass; below 0 where it is cut.
    fn distance(&self, point: Point) -> f64 {
        self.path.distance_to(point, self.correction) - self.half
    }
}

/// The rest that the passes leave along `walls`; `last` is the path of the last one. Exact within `tolerance`, in
/// drawing units.
pub(super) fn finished(
    walls: &[Wall],
    last: &[Element],
    kerfs: &[Kerf],
    tolerance: f64,
) -> Option<Finished> {
    let finest = kerfs.last()?;
    let mut worst = Finished {
        uncut: (finest.correction - finest.half).max(0.0),
        at: walls.first()?.geometry.start(),
        overcut: kerfs
            .iter()
            .map(|kerf| kerf.half - kerf.correction)
            .fold(0.0, f64::max),
    };
    let left = |point: Point| {
        let distances = kerfs.iter().map(|kerf| kerf.distance(point));
        distances.fold(f64::INFINITY, f64::min)
    };
    let mut followed: Vec<Vec<[f64; 2]>> = vec![Vec::new(); walls.len()];
    for element in last
        .iter()
        .filter(|element| matches!(element.source, Source::Segment { .. }))
    {
        let wall = &walls[element.wall].geometry;
        let whole = |segment: &Segment| segment.as_arc().is_some_and(|arc| arc.is_full_turn());
        let shares = if whole(&element.geometry) {
            [0.0, 1.0]
        } else {
            [element.geometry.start(), element.geometry.end()]
                .map(|end| wall.share_of(end).clamp(0.0, 1.0))
        };
        // The two parts of a circle that is entered between them.
        if shares[0] <= shares[1] {
            followed[element.wall].push(shares);
        }
    }
    for (wall, mut followed) in walls.iter().zip(followed) {
        followed.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut done = 0.0;
        for [from, to] in followed.into_iter().chain([[1.0, 1.0]]) {
            if from >= done {
                search(&wall.geometry, [done, from], &left, tolerance, &mut worst);
            }
            done = to.max(done);
        }
    }
    Some(worst)
}

/// The most looks at one stretch.
const MOST: usize = 10_000;

/// Searches a stretch, given by shares of a wall, for the place where most is left: `left` changes by no more than the
/// way along it.
fn search(
    wall: &Segment,
    [from, to]: [f64; 2],
    left: &dyn Fn(Point) -> f64,
    tolerance: f64,
    worst: &mut Finished,
) {
    let length = wall.length();
    let mut look = |share: f64| {
        let at = wall.point_at(share);
        let uncut = left(at);
        if uncut > worst.uncut {
            (worst.uncut, worst.at) = (uncut, at);
        }
        (uncut, worst.uncut)
    };
    let (first, last) = (look(from).0, look(to).0);
    let mut waiting = vec![(from, first, to, last)];
    for _ in 0..MOST {
        let Some((from, at_from, to, at_to)) = waiting.pop() else {
            return;
        };
        let middle = (from + to) / 2.0;
        let (at_middle, most) = look(middle);
        let can_be = |a: f64, b: f64| (a + b + (to - from) / 2.0 * length) / 2.0;
        for (from, at_from, to, at_to) in [
            (from, at_from, middle, at_middle),
            (middle, at_middle, to, at_to),
        ] {
            if can_be(at_from, at_to) > most + tolerance {
                waiting.push((from, at_from, to, at_to));
            }
        }
    }
}
