//! How near a path comes to the walls, for contours of any size.

use crate::geometry::{
    Arc, Bounds, Line, Point, Segment, circle_circle, line_circle, line_line, reached,
};

/// Walls in boxes of boxes over their order along the contour, in which neighbours lie together.
pub(crate) struct Walls {
    segments: Vec<Segment>,
    /// Boxes of `FAN` segments, then boxes of `FAN` of those, up to one.
    levels: Vec<Vec<Bounds>>,
}

const FAN: usize = 8;

impl Walls {
    pub(crate) fn new(segments: Vec<Segment>) -> Walls {
        let mut level: Vec<Bounds> = segments.iter().map(Segment::bounds).collect();
        let mut levels = Vec::new();
        while level.len() > 1 {
            let above = level.chunks(FAN).map(|boxes| {
                let mut bounds = Bounds::EMPTY;
                boxes.iter().for_each(|inner| bounds.merge(inner));
                bounds
            });
            let above = above.collect();
            levels.push(std::mem::replace(&mut level, above));
        }
        levels.push(level);
        Walls { segments, levels }
    }

    pub(crate) fn segment(&self, index: usize) -> &Segment {
        &self.segments[index]
    }

    /// The first wall found to which `path` comes nearer than `distance`.
    pub(crate) fn too_near(&self, path: &Segment, distance: f64) -> Option<usize> {
        self.find_near(path, distance, |_, _| true)
    }

    /// The same among those for which, with their distance, `counts` holds.
    pub(crate) fn find_near(
        &self,
        path: &Segment,
        distance: f64,
        counts: impl Fn(usize, f64) -> bool,
    ) -> Option<usize> {
        self.find(&path.bounds().grown(distance), |index| {
            let away = distance_between(path, &self.segments[index]);
            away < distance && counts(index, away)
        })
    }

    /// How far a point is from the nearest one; they are looked for `reach` about it first. Endless where there are none.
    pub(crate) fn distance_to(&self, point: Point, reach: f64) -> f64 {
        let mut reach = reach.max(f64::MIN_POSITIVE);
        loop {
            let mut nearest = f64::INFINITY;
            self.find(&Bounds::of_disc(point, reach), |index| {
                nearest = nearest.min(self.segments[index].distance_to(point));
                false
            });
            if nearest <= reach || self.segments.is_empty() || reach == f64::INFINITY {
                return nearest;
            }
            reach *= 4.0;
        }
    }

    /// The first wall found that is nearer to a point than `distance`.
    pub(crate) fn nearer(&self, point: Point, distance: f64) -> Option<usize> {
        self.find(&Bounds::of_disc(point, distance), |index| {
            self.segments[index].distance_to(point) < distance
        })
    }

    /// The first segment with a box that touches `reach` of which `is_it` says so.
    pub(crate) fn find(
        &self,
        reach: &Bounds,
        mut is_it: impl FnMut(usize) -> bool,
    ) -> Option<usize> {
        let mut waiting = vec![(
            self.levels.len() - 1,
            0..self.levels.last().map_or(0, Vec::len),
        )];
        while let Some((level, range)) = waiting.pop() {
            for index in range {
                if !self.levels[level][index].touches(reach) {
                    continue;
                }
                if level > 0 {
                    let below = self.levels[level - 1].len();
                    waiting.push((level - 1, index * FAN..((index + 1) * FAN).min(below)));
                } else if is_it(index) {
                    return Some(index);
                }
            }
        }
        None
    }
}

/// Smallest distance between two segments, 0 where they cross or touch.
pub(crate) fn distance_between(a: &Segment, b: &Segment) -> f64 {
    let ends = a
        .distance_to(b.start())
        .min(a.distance_to(b.end()))
        .min(b.distance_to(a.start()))
        .min(b.distance_to(a.end()));
    ends.min(match (a, b) {
        (Segment::Line(a), Segment::Line(b)) => between_lines(a, b),
        (Segment::Line(line), Segment::Arc(arc)) | (Segment::Arc(arc), Segment::Line(line)) => {
            between_line_and_arc(line, arc)
        }
        (Segment::Arc(a), Segment::Arc(b)) => between_arcs(a, b),
    })
}

fn within(share: f64) -> bool {
    (0.0..=1.0).contains(&share)
}

fn between_lines(a: &Line, b: &Line) -> f64 {
    let crossing = line_line(a.start, a.end - a.start, b.start, b.end - b.start);
    match crossing {
        Some(point) if within(a.share_of(point)) && within(b.share_of(point)) => 0.0,
        _ => f64::INFINITY,
    }
}

fn between_line_and_arc(line: &Line, arc: &Arc) -> f64 {
    let along = line.end - line.start;
    let crosses = |&point: &Point| within(line.share_of(point)) && within(arc.share_of(point));
    if line_circle(line.start, along, arc.center, arc.radius)
        .iter()
        .any(crosses)
    {
        return 0.0;
    }
    let share = line.share_of(arc.center);
    let foot = line.start + along * share;
    if within(share) && within(arc.share_of(foot)) {
        arc.rise_of(foot).abs()
    } else {
        f64::INFINITY
    }
}

fn between_arcs(a: &Arc, b: &Arc) -> f64 {
    let crosses = |&point: &Point| within(a.share_of(point)) && within(b.share_of(point));
    if circle_circle(a.center, a.radius, b.center, b.radius)
        .iter()
        .any(crosses)
    {
        return 0.0;
    }
    // The nearest inner points of two circles lie on the line of their centres.
    let Some(axis) = (b.center - a.center).try_normalize(0.0) else {
        return f64::INFINITY;
    };
    let mut nearest = f64::INFINITY;
    for (on_a, on_b) in [(axis, axis), (axis, -axis), (-axis, axis), (-axis, -axis)] {
        if let (Some(p), Some(q)) = (reached(a, on_a), reached(b, on_b)) {
            nearest = nearest.min((p - q).norm());
        }
    }
    nearest
}
