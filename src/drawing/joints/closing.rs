//! Which entities close by themselves, and which are no larger than the places where ends meet.

use super::{End, Joints};
use crate::geometry::Point;

impl Joints<'_> {
    /// True when an entity whose own ends are this far apart leads round; where they do not quite meet, it is larger than the gap.
    pub(super) fn closes_alone(&self, entity: u32, distance: f64) -> bool {
        let is_dot = || {
            let ends = End::both(entity).map(|end| self.place(end));
            ends.into_iter().all(|end| self.is_crumb(entity, end))
        };
        self.leads_round(entity) && (distance <= self.cells.certain || !is_dot())
    }

    /// True when an entity whose own ends touch really leads round, and is not just shorter than the join tolerance.
    pub(crate) fn leads_round(&self, entity: u32) -> bool {
        let Some(geometry) = self
            .drawing
            .get(self.entities[entity as usize])
            .map(|entity| &entity.geometry)
        else {
            return false;
        };
        // Two segments lead out and back, or, as the halves of a circle, round something.
        let encloses = || {
            let mut segments = geometry.segments_of(self.drawing.flat());
            let middles = segments
                .next()
                .zip(segments.next())
                .map(|(out, back)| [out, back].map(|segment| segment.point_at(0.5)));
            middles.is_some_and(|[out, back]| (out - back).norm() > self.cells.certain)
        };
        geometry.segment_count() > 2
            || geometry.segment_count() == 2 && encloses()
            || geometry
                .segments_of(self.drawing.flat())
                .any(|segment| segment.as_arc().is_some_and(|arc| !arc.is_minor()))
    }

    /// True when all of an entity lies within the join tolerance about a place.
    pub(crate) fn is_crumb(&self, entity: u32, about: Point) -> bool {
        let near = |point: Point| (point - about).norm() <= self.cells.join;
        self.drawing
            .get(self.entities[entity as usize])
            .is_some_and(|entity| {
                entity
                    .geometry
                    .segments_of(self.drawing.flat())
                    .all(|segment| {
                        [0.0, 0.5, 1.0]
                            .iter()
                            .all(|&share| near(segment.point_at(share)))
                    })
            })
    }
}
