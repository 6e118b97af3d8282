//! A contour: entities joined end to end, with a direction of travel.

use super::{Drawing, EntityId};
use crate::geometry::{Bounds, Point, Segment};

/// One entity of a contour, as it is travelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    pub entity: EntityId,
    /// Travelled against the entity's own direction.
    pub reversed: bool,
    /// Number of segments of the contour before this piece.
    pub first: usize,
    /// Number of segments of the piece.
    pub count: usize,
}

/// Entities joined end to end within the join tolerance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contour {
    /// In order of travel.
    pub pieces: Vec<Piece>,
    pub closed: bool,
}

/// A segment of a contour and where it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContourSegment {
    pub entity: EntityId,
    /// Index within the entity, in the entity's own direction.
    pub segment: usize,
    pub reversed: bool,
    /// In the contour's direction of travel.
    pub geometry: Segment,
}

impl Contour {
    /// A contour of `(entity, reversed)` in order of travel; entities without segments are left out.
    pub fn new(drawing: &Drawing, entities: impl IntoIterator<Item = (EntityId, bool)>, closed: bool) -> Contour {
        let mut pieces = Vec::new();
        let mut first = 0;
        for (entity, reversed) in entities {
            let count = drawing.get(entity).map_or(0, |entity| entity.geometry.segment_count());
            if count > 0 {
                pieces.push(Piece { entity, reversed, first, count });
                first += count;
            }
        }
        Contour { pieces, closed }
    }

    /// Number of segments.
    pub fn len(&self) -> usize {
        self.pieces.last().map_or(0, |piece| piece.first + piece.count)
    }

    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// Segment `index` in the direction of travel, `None` past the end.
    pub fn segment(&self, drawing: &Drawing, index: usize) -> Option<ContourSegment> {
        let piece = self.pieces.get(self.pieces.partition_point(|piece| piece.first + piece.count <= index))?;
        let along = index - piece.first;
        let segment = if piece.reversed { piece.count - 1 - along } else { along };
        let own = drawing.get(piece.entity)?.geometry.segment(segment)?;
        let geometry = if piece.reversed { own.reversed() } else { own };
        Some(ContourSegment { entity: piece.entity, segment, reversed: piece.reversed, geometry })
    }

    /// The index within the contour of an entity's segment.
    pub fn index_of(&self, entity: EntityId, segment: usize) -> Option<usize> {
        let piece = self.pieces.iter().find(|piece| piece.entity == entity)?;
        let along = if piece.reversed { piece.count.checked_sub(1 + segment)? } else { segment };
        (along < piece.count).then_some(piece.first + along)
    }

    /// All segments in the direction of travel.
    pub fn segments<'a>(&'a self, drawing: &'a Drawing) -> impl Iterator<Item = ContourSegment> + 'a {
        (0..self.len()).filter_map(|index| self.segment(drawing, index))
    }

    /// Twice the signed area with the arcs counted in, positive counter-clockwise; meaningful for a closed contour.
    pub fn twice_area(&self, drawing: &Drawing) -> f64 {
        // Seen from a point of the contour itself, so that coordinates far from the origin cost no digits.
        let origin = self.segment(drawing, 0).map_or_else(Point::origin, |first| first.geometry.start());
        self.segments(drawing).map(|segment| segment.geometry.twice_area(origin)).sum()
    }

    pub fn bounds(&self, drawing: &Drawing) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        self.segments(drawing).for_each(|segment| bounds.merge(&segment.geometry.bounds()));
        bounds
    }

    /// The same contour travelled the other way.
    pub fn reversed(&self) -> Contour {
        let mut first = 0;
        let pieces = self.pieces.iter().rev().map(|piece| {
            let turned = Piece { reversed: !piece.reversed, first, ..*piece };
            first += piece.count;
            turned
        });
        Contour { pieces: pieces.collect(), closed: self.closed }
    }
}
