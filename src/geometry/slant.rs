//! A box that is rotated to lie along what it holds: for slanting lines side by side such boxes are
//! apart where the axis-parallel ones all overlap.

use super::{Bounds, Point, Segment, Vector, left_normal};

/// A closed box, of which one side runs along a direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slant {
    /// A unit vector.
    along: Vector,
    pub(super) middle: Point,
    /// Half of its length and of its width.
    pub(super) half: Vector,
}

impl Slant {
    /// The box that holds everything.
    pub(super) const ANYWHERE: Slant = Slant {
        along: Vector::new(1.0, 0.0),
        middle: Point::new(0.0, 0.0),
        half: Vector::new(f64::INFINITY, f64::INFINITY),
    };

    pub(super) fn of_box(bounds: &Bounds) -> Slant {
        Slant::about(Slant::ANYWHERE.along, [bounds.min, bounds.max].into_iter())
    }

    /// The box of segments along the longest chord among them.
    pub(super) fn of(segments: impl Iterator<Item = Segment> + Clone) -> Slant {
        let chords = segments.clone().map(|it| it.end() - it.start());
        let longest =
            chords.max_by(|one, other| one.norm_squared().total_cmp(&other.norm_squared()));
        let along = longest.and_then(|chord| chord.try_normalize(0.0));
        let along = along.filter(|along| along.norm_squared() > 0.5);
        Slant::about(
            along.unwrap_or(Slant::ANYWHERE.along),
            segments.flat_map(|segment| corners_of(&segment)),
        )
    }

    /// A box of boxes, along the longest of them.
    pub(super) fn of_all<'a>(all: impl Iterator<Item = &'a Slant> + Clone) -> Slant {
        let longest = all
            .clone()
            .max_by(|one, other| one.half.x.total_cmp(&other.half.x));
        match longest {
            Some(longest) if longest.half.x.is_finite() => {
                Slant::about(longest.along, all.flat_map(Slant::corners))
            }
            _ => Slant::ANYWHERE,
        }
    }

    fn about(along: Vector, points: impl Iterator<Item = Point>) -> Slant {
        let frame = Slant {
            along,
            ..Slant::ANYWHERE
        };
        let (mut low, mut high) = (frame.half, -frame.half);
        for point in points {
            let point = frame.within(point.coords);
            (low, high) = (low.inf(&point), high.sup(&point));
        }
        let (middle, half) = ((low + high) * 0.5, (high - low) * 0.5);
        let middle = along * middle.x + left_normal(along) * middle.y;
        // Beyond all measure: it may be anywhere.
        if !(middle.norm_squared().is_finite() && half.norm_squared().is_finite()) {
            return Slant::ANYWHERE;
        }
        Slant {
            along,
            middle: Point::from(middle),
            half,
        }
    }

    /// How far a vector goes along the box and across it.
    pub(super) fn within(&self, vector: Vector) -> Vector {
        Vector::new(
            self.along.dot(&vector),
            left_normal(self.along).dot(&vector),
        )
    }

    fn corners(&self) -> [Point; 4] {
        let (along, across) = (
            self.along * self.half.x,
            left_normal(self.along) * self.half.y,
        );
        [
            self.middle + along + across,
            self.middle + along - across,
            self.middle - along + across,
            self.middle - along - across,
        ]
    }

    /// True only where the two are farther from each other than `reach`: along a side of one of them, or across it.
    pub(super) fn is_apart(&self, other: &Slant, reach: f64) -> bool {
        self.is_beside(other, reach) || other.is_beside(self, reach)
    }

    fn is_beside(&self, other: &Slant, reach: f64) -> bool {
        let way = self.within(other.middle - self.middle).abs();
        let turned = self.within(other.along).abs();
        // The other's half length and half width, as seen along and across this one.
        let theirs = Vector::new(
            other.half.x * turned.x + other.half.y * turned.y,
            other.half.x * turned.y + other.half.y * turned.x,
        );
        let between = way - self.half - theirs;
        between.x > reach || between.y > reach
    }
}

/// Corners of a box that a segment lies in.
fn corners_of(segment: &Segment) -> [Point; 4] {
    match segment {
        Segment::Line(line) => [line.start, line.end, line.start, line.end],
        Segment::Arc(arc) if arc.is_minor() => {
            let rise = arc.point_at(0.5) - arc.start;
            let rise = rise - (arc.end - arc.start) * 0.5;
            [arc.start, arc.end, arc.start + rise, arc.end + rise]
        }
        Segment::Arc(arc) => {
            let (min, max) = (arc.bounds().min, arc.bounds().max);
            [min, max, Point::new(min.x, max.y), Point::new(max.x, min.y)]
        }
    }
}
