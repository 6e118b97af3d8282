//! How near a path comes to the walls, for contours of any size.

use super::cores::{each, sum};
use super::distance::{are_apart, distance_between};
use super::offset::Wall;
use super::vicinity::{FAN, Vicinity, by_place, merged};
use crate::geometry::{Bounds, Point, Segment, Vector, left_normal};
use std::ops::Range;
use std::sync::OnceLock;

/// Walls in boxes of boxes: a few that follow each other along the contour in one, and of these, where there are many, a few that lie
/// together anywhere, as the turns of a spiral do.
#[derive(Clone, Debug)]
pub(crate) struct Walls {
    segments: Vec<Segment>,
    /// Boxes of `FAN` segments, then boxes of `FAN` of those, up to one.
    levels: Vec<Vec<Bounds>>,
    /// Of each box of the second level, where it is of the first few along the contour; empty where they stand in their order.
    order: Vec<u32>,
    /// What lies about each, once it has been asked for; `None` where that is too much.
    about: OnceLock<Option<Vicinity>>,
    /// Of each its directions at both ends, once they have been asked for.
    tangents: OnceLock<Vec<[Vector; 2]>>,
    /// Of all as one closed contour, the same.
    twice_area: OnceLock<f64>,
}

/// Up to this many walls are grouped in their order along the contour.
const MOST_IN_ORDER: usize = 1024;

/// Walls that one core takes at a time.
const AT_A_TIME: usize = 2048;

impl Walls {
    pub(super) fn of(walls: &[Wall]) -> Walls {
        Walls::new(each(walls.len(), AT_A_TIME, |index| walls[index].geometry))
    }

    pub(crate) fn new(segments: Vec<Segment>) -> Walls {
        let boxes = each(segments.len(), AT_A_TIME, |index| segments[index].bounds());
        Walls::within(segments, boxes)
    }

    /// The same by one core, for work that other cores are waiting for.
    pub(crate) fn by_one_core(segments: Vec<Segment>) -> Walls {
        let boxes = segments.iter().map(Segment::bounds).collect();
        Walls::within(segments, boxes)
    }

    fn within(segments: Vec<Segment>, boxes: Vec<Bounds>) -> Walls {
        let (mut levels, mut order) = (vec![boxes], Vec::new());
        while let Some(level) = levels.last().filter(|level| level.len() > 1) {
            let above = level.chunks(FAN).map(|boxes| merged(boxes.iter()));
            let mut above: Vec<Bounds> = above.collect();
            if levels.len() == 1 && segments.len() > MOST_IN_ORDER {
                order = by_place(&above);
                above = order.iter().map(|&few| above[few as usize]).collect();
            }
            levels.push(above);
        }
        Walls {
            segments,
            levels,
            order,
            about: OnceLock::new(),
            tangents: OnceLock::new(),
            twice_area: OnceLock::new(),
        }
    }

    /// Of each segment its directions at both ends.
    pub(crate) fn tangents(&self) -> &[[Vector; 2]] {
        let ends = |index: usize| tangents_of(&self.segments[index]);
        match self.tangents.get() {
            Some(known) => known,
            None => {
                // No core may wait for this meanwhile: it might be one that the work needs.
                let made = each(self.segments.len(), AT_A_TIME, ends);
                self.tangents.get_or_init(|| made)
            }
        }
    }

    /// Twice the signed area of all as one closed contour.
    pub(crate) fn twice_area(&self) -> f64 {
        if let Some(known) = self.twice_area.get() {
            return *known;
        }
        let first = self.segments.first();
        let origin = first.map_or_else(Point::origin, Segment::start);
        let of = |index: usize| self.segments[index].twice_area(origin);
        let made = sum(self.segments.len(), of);
        *self.twice_area.get_or_init(|| made)
    }

    pub(crate) fn segment(&self, index: usize) -> &Segment {
        &self.segments[index]
    }

    pub(crate) fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// The box of all.
    pub(crate) fn bounds(&self) -> Bounds {
        merged(self.levels.last().into_iter().flatten())
    }

    /// The first wall found to which `path` comes nearer than `distance`.
    pub(crate) fn too_near(&self, path: &Segment, distance: f64) -> Option<usize> {
        self.find_near(path, distance, |_, _| true)
    }

    /// The same for a path that runs beside the wall `own` no further from it than `distance` and a
    /// little: where it is known what lies about that wall, only few walls are checked, and the
    /// wall itself where `with_own`.
    pub(crate) fn too_near_beside(
        &self,
        own: usize,
        path: &Segment,
        distance: f64,
        with_own: bool,
    ) -> Option<usize> {
        let bounds = path.bounds();
        let (area, boxes) = (bounds.grown(distance), &self.levels[0]);
        let about = self.about.get().and_then(Option::as_ref);
        // All that comes near to what lies in the box is among those.
        let is_known = |about: &&Vicinity| boxes[own].grown(about.reach).holds(&area);
        let Some(about) = about.filter(is_known) else {
            return self.too_near(path, distance);
        };
        let mut walls = about.walls_of(own);
        walls.find(|&wall| {
            (with_own || wall != own)
                && boxes[wall].touches(&area)
                && self.distance_below(path, wall, distance).is_some()
        })
    }

    /// What lies about each few, for paths that run at a distance; worked out on several cores
    /// where it is first needed, so it must not be called from work that runs on several already.
    pub(crate) fn know_about(&self, distance: f64) {
        if self.about.get().is_none() {
            let few_near = |area: &Bounds, few: &mut Vec<_>| self.few_near(area, few);
            let made = Vicinity::of(&self.levels[0], 2.1 * distance, few_near);
            self.about.get_or_init(|| made);
        }
    }

    /// Those few walls whose box touches `reach`, by the first of them and with that box, in the order in which they are found.
    pub(super) fn few_near(&self, reach: &Bounds, found: &mut Vec<(u32, Bounds)>) {
        let top = self.levels.len() - 1;
        self.few_in(top, 0..self.levels[top].len(), reach, found);
    }

    /// The first of a few walls with a box that touches `reach` of which `is_it` says so.
    pub(super) fn find_among(
        &self,
        first: usize,
        reach: &Bounds,
        mut is_it: impl FnMut(usize) -> bool,
    ) -> Option<usize> {
        let boxes = &self.levels[0];
        let mut few = first..(first + FAN).min(boxes.len());
        few.find(|&index| boxes[index].touches(reach) && is_it(index))
    }

    /// How large the box of a few is, on an average of some.
    pub(super) fn size_of_few(&self) -> f64 {
        let boxes = &self.levels[self.levels.len().min(2) - 1];
        let some = boxes.iter().step_by(boxes.len().div_ceil(FAN).max(1));
        let (count, sum) = some.fold((0.0, 0.0), |(count, sum), few| {
            (count + 1.0, sum + few.width().max(few.height()))
        });
        if count > 0.0 { sum / count } else { 0.0 }
    }

    /// How far a path is from a wall, where that is less than `distance`.
    pub(crate) fn distance_below(&self, path: &Segment, wall: usize, distance: f64) -> Option<f64> {
        let wall = &self.segments[wall];
        if are_apart(path, wall, distance) {
            return None;
        }
        Some(distance_between(path, wall)).filter(|away| *away < distance)
    }

    /// The same among those for which, with their distance, `counts` holds.
    pub(crate) fn find_near(
        &self,
        path: &Segment,
        distance: f64,
        counts: impl Fn(usize, f64) -> bool,
    ) -> Option<usize> {
        self.find(&path.bounds().grown(distance), |wall| {
            let away = self.distance_below(path, wall, distance);
            away.is_some_and(|away| counts(wall, away))
        })
    }

    /// How far a point is from the nearest one; they are looked for `reach` about it first.
    /// Infinite where there are none.
    pub(crate) fn distance_to(&self, point: Point, reach: f64) -> f64 {
        let nearest = self.nearest_to(point, reach);
        nearest.map_or(f64::INFINITY, |(away, _)| away)
    }

    /// The nearest one, of several the first, and how far it is.
    pub(crate) fn nearest_to(&self, point: Point, reach: f64) -> Option<(f64, usize)> {
        nearest_by(&self.segments, point, reach, |area, each| {
            self.find(area, |index| {
                each(index);
                false
            });
        })
    }

    /// The first wall found that is nearer to a point than `distance`.
    pub(crate) fn nearer(&self, point: Point, distance: f64) -> Option<usize> {
        self.find(&Bounds::of_disc(point, distance), |index| {
            self.segments[index].distance_to(point) < distance
        })
    }

    /// One that is nearer to a point than `distance`: of those beside `last`, which was found for a point before it, else of all.
    pub(crate) fn nearer_from(
        &self,
        last: Option<usize>,
        point: Point,
        distance: f64,
    ) -> Option<usize> {
        let beside = last.map(|last| self.beside(last));
        let is_nearer = |wall: &usize| self.segments[*wall].distance_to(point) < distance;
        let beside = beside.into_iter().flatten().find(is_nearer);
        beside.or_else(|| self.nearer(point, distance))
    }

    /// One and those that follow on it.
    pub(crate) fn beside(&self, last: usize) -> [usize; 4] {
        let count = self.segments.len();
        [0, 1, count - 1, 2].map(|step| (last + step) % count)
    }

    /// The first segment with a box that touches `reach` of which `is_it` says so.
    pub(crate) fn find(
        &self,
        reach: &Bounds,
        mut is_it: impl FnMut(usize) -> bool,
    ) -> Option<usize> {
        let top = self.levels.len() - 1;
        self.find_in(top, 0..self.levels[top].len(), reach, &mut is_it)
    }

    fn find_in(
        &self,
        level: usize,
        mut range: Range<usize>,
        reach: &Bounds,
        is_it: &mut impl FnMut(usize) -> bool,
    ) -> Option<usize> {
        let boxes = &self.levels[level];
        if level == 0 {
            return range.find(|&index| boxes[index].touches(reach) && is_it(index));
        }
        let below = self.levels[level - 1].len();
        range
            .rev()
            .filter(|&index| boxes[index].touches(reach))
            .find_map(|index| {
                let first = match self.order.get(index).filter(|_| level == 1) {
                    Some(&few) => few as usize * FAN,
                    None => index * FAN,
                };
                let within = first..(first + FAN).min(below);
                self.find_in(level - 1, within, reach, is_it)
            })
    }

    fn few_in(
        &self,
        level: usize,
        range: Range<usize>,
        reach: &Bounds,
        found: &mut Vec<(u32, Bounds)>,
    ) {
        let boxes = &self.levels[level];
        for index in range.rev().filter(|&index| boxes[index].touches(reach)) {
            if level <= 1 {
                let few = self.order.get(index).copied().unwrap_or(index as u32);
                found.push((few * FAN as u32, boxes[index]));
            } else {
                let below = self.levels[level - 1].len();
                let within = index * FAN..((index + 1) * FAN).min(below);
                self.few_in(level - 1, within, reach, found);
            }
        }
    }
}

/// The nearest of some segments; `look` hands on all whose box touches an area.
pub(super) fn nearest_by(
    segments: &[Segment],
    point: Point,
    reach: f64,
    mut look: impl FnMut(&Bounds, &mut dyn FnMut(usize)),
) -> Option<(f64, usize)> {
    let mut reach = reach.max(f64::MIN_POSITIVE);
    loop {
        let mut nearest = None;
        look(&Bounds::of_disc(point, reach), &mut |index| {
            let found = (segments[index].distance_to(point), index);
            if nearest.is_none_or(|nearest| found < nearest) {
                nearest = Some(found);
            }
        });
        let is_within = nearest.is_some_and(|(away, _)| away <= reach);
        if is_within || segments.is_empty() || reach == f64::INFINITY {
            return nearest;
        }
        reach *= 4.0;
    }
}

/// The directions of a segment at its ends; of an arc by where they lie about its centre, if that is known well.
fn tangents_of(segment: &Segment) -> [Vector; 2] {
    match segment {
        Segment::Line(line) => [line.direction(); 2],
        Segment::Arc(arc) if !arc.is_shallow() && arc.radius > 0.0 => {
            let sense = arc.sweep.signum();
            let at = |end: Point| {
                let out = (end - arc.center).try_normalize(0.0);
                left_normal(out.unwrap_or_else(Vector::zeros)) * sense
            };
            [at(arc.start), at(arc.end)]
        }
        arc => [arc.start_tangent(), arc.end_tangent()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines and arcs of all sizes at scattered places, from a fixed sequence.
    fn scattered(count: usize) -> Vec<Segment> {
        let mut state = 7_u64;
        let mut number = || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 33) as f64 / (1_u64 << 31) as f64
        };
        let mut segment = || {
            let start = Point::new(number() * 4.0, number() * 4.0);
            let size = 10f64.powf(number() * 3.0 - 2.0);
            let way = Vector::new(number() - 0.5, number() - 0.5) * size;
            let bulge =
                [0.0, number() - 0.5, 6.0 * number() - 3.0, 1e-7][(number() * 4.0) as usize];
            Segment::from_bulge(start, start + way, bulge)
        };
        (0..count).map(|_| segment()).collect()
    }

    #[test]
    fn what_is_seen_to_be_apart_is() {
        let all = scattered(400);
        let mut apart = 0;
        for (a, b) in all.iter().flat_map(|a| all.iter().map(move |b| (a, b))) {
            for distance in [0.01, 0.1, 1.0] {
                if are_apart(a, b, distance) {
                    apart += 1;
                    let between = distance_between(a, b);
                    assert!(
                        between >= distance - 1e-9,
                        "{a:?} {b:?} {between} {distance}"
                    );
                }
            }
        }
        assert!(apart > 100_000, "{apart}");
    }

    #[test]
    fn beside_its_wall_a_path_is_near_to_what_it_is_near_to_among_all() {
        let all = scattered(300);
        let walls = Walls::new(all.clone());
        walls.know_about(0.1);
        let mut near = 0;
        for (own, wall) in all.iter().enumerate() {
            for shift in [0.0, 0.05, 0.2, 3.0] {
                let path = wall.moved(Vector::new(shift, shift));
                let found = walls.too_near_beside(own, &path, 0.1, true);
                assert_eq!(found, walls.too_near(&path, 0.1), "{own} {shift}");
                let is_near = |wall: &Segment| distance_between(&path, wall) < 0.1;
                assert_eq!(found.is_some(), all.iter().any(is_near), "{own} {shift}");
                near += usize::from(found.is_some());
            }
        }
        assert!((300..1200).contains(&near), "{near}");
    }
}
