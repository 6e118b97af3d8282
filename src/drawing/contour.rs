//! A contour: entities joined end to end, with a direction of travel.

use super::{Drawing, EntityId, Geometry};
use crate::geometry::{Bounds, Point, Segment};
use std::ops::Range;

/// One entity of a contour, in its direction of travel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    pub entity: EntityId,
    /// Travelled against the entity's own direction.
    pub(crate) reversed: bool,
    first: u32,
    count: u32,
}

impl Piece {
    /// Number of segments of the contour before this piece.
    pub(crate) fn first(&self) -> usize {
        self.first as usize
    }

    /// Number of segments of the piece.
    pub(crate) fn count(&self) -> usize {
        self.count as usize
    }

    /// The segments of the contour that belong to the piece.
    pub(crate) fn range(&self) -> Range<usize> {
        self.first()..self.first() + self.count()
    }

    /// The index within the contour of one of the piece's own segments.
    pub(crate) fn index_of(&self, segment: usize) -> Option<usize> {
        let along = if self.reversed {
            self.count().checked_sub(1 + segment)?
        } else {
            segment
        };
        (along < self.count()).then_some(self.first() + along)
    }
}

/// Entities joined end to end within the join tolerance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contour {
    /// In order of travel.
    pub pieces: Vec<Piece>,
    pub closed: bool,
    /// Left out when the ends were joined, since this entity lies in the same place and is cut.
    pub(crate) double_of: Option<EntityId>,
}

/// A segment of a contour and where it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContourSegment {
    pub entity: EntityId,
    /// Index within the entity, in the entity's own direction.
    pub segment: usize,
    pub(crate) reversed: bool,
    /// In the contour's direction of travel.
    pub geometry: Segment,
}

impl Contour {
    /// A contour of `(entity, reversed)` in order of travel; entities without segments are left out.
    pub fn new(
        drawing: &Drawing,
        entities: impl IntoIterator<Item = (EntityId, bool)>,
        closed: bool,
    ) -> Contour {
        let entities = entities.into_iter();
        let mut pieces = Vec::with_capacity(entities.size_hint().0);
        let mut first = 0;
        for (entity, reversed) in entities {
            let count = drawing
                .get(entity)
                .map_or(0, |entity| entity.geometry.segment_count()) as u32;
            if count > 0 {
                pieces.push(Piece {
                    entity,
                    reversed,
                    first,
                    count,
                });
                first += count;
            }
        }
        Contour {
            pieces,
            closed,
            double_of: None,
        }
    }

    /// Number of segments.
    pub(crate) fn len(&self) -> usize {
        self.pieces.last().map_or(0, |piece| piece.range().end)
    }

    /// False where there is nothing to cut: no segment is longer than `zero_length` (drawing units).
    pub(crate) fn has_length(&self, drawing: &Drawing, zero_length: f64) -> bool {
        self.segments(drawing)
            .any(|segment| segment.geometry.length() > zero_length)
    }

    /// Segment `index` in the direction of travel, `None` past the end.
    pub(crate) fn segment(&self, drawing: &Drawing, index: usize) -> Option<ContourSegment> {
        let piece = self.piece_of(index)?;
        segment_of(
            piece,
            &drawing.get(piece.entity)?.geometry,
            index - piece.first(),
            drawing.flat(),
        )
    }

    /// Segment `index` of which the geometry is known.
    pub(crate) fn segment_with(
        &self,
        drawing: &Drawing,
        index: usize,
        geometry: Segment,
    ) -> Option<ContourSegment> {
        let (entity, segment) = self.segment_id(drawing, index)?;
        Some(ContourSegment {
            entity,
            segment,
            reversed: self.piece_of(index)?.reversed,
            geometry,
        })
    }

    fn piece_of(&self, index: usize) -> Option<&Piece> {
        let behind = |piece: &Piece| piece.range().end <= index;
        self.pieces.get(self.pieces.partition_point(behind))
    }

    /// The entity of segment `index`, and the segment in there: without its geometry.
    pub(crate) fn segment_id(&self, drawing: &Drawing, index: usize) -> Option<(EntityId, usize)> {
        let piece = self.piece_of(index)?;
        let along = index - piece.first();
        let segment = match piece.reversed {
            true => piece.count().checked_sub(1 + along)?,
            false => along,
        };
        let geometry = &drawing.get(piece.entity)?.geometry;
        (segment < geometry.segment_count()).then_some((piece.entity, segment))
    }

    /// All segments in the direction of travel.
    pub fn segments<'a>(
        &'a self,
        drawing: &'a Drawing,
    ) -> impl Iterator<Item = ContourSegment> + 'a {
        self.segments_in(drawing, 0..self.len())
    }

    /// The segments of a range of indices in the direction of travel.
    pub(crate) fn segments_in<'a>(
        &'a self,
        drawing: &'a Drawing,
        range: Range<usize>,
    ) -> impl Iterator<Item = ContourSegment> + 'a {
        let first = self
            .pieces
            .partition_point(|piece| piece.range().end <= range.start);
        let flat = drawing.flat();
        let pieces = self.pieces[first..]
            .iter()
            .take_while(move |piece| piece.first() < range.end);
        pieces.flat_map(move |piece| {
            let geometry = drawing.get(piece.entity).map(|entity| &entity.geometry);
            let along = range.start.saturating_sub(piece.first())
                ..range.end.min(piece.range().end) - piece.first();
            along.filter_map(move |along| segment_of(piece, geometry?, along, flat))
        })
    }

    /// Twice the signed area, arcs included, positive counter-clockwise; meaningful for a closed contour.
    pub fn twice_area(&self, drawing: &Drawing) -> f64 {
        // Relative to a point of the contour, so that coordinates far from the origin cost no digits.
        let origin = self
            .segment(drawing, 0)
            .map_or_else(Point::origin, |first| first.geometry.start());
        self.segments(drawing)
            .map(|segment| segment.geometry.twice_area(origin))
            .sum()
    }

    pub(crate) fn bounds(&self, drawing: &Drawing) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        self.segments(drawing)
            .for_each(|segment| bounds.merge(&segment.geometry.bounds()));
        bounds
    }

    /// The same contour in the other direction.
    pub(crate) fn reversed(&self) -> Contour {
        let mut first = 0;
        let pieces = self.pieces.iter().rev().map(|piece| {
            let turned = Piece {
                reversed: !piece.reversed,
                first,
                ..*piece
            };
            first += piece.count;
            turned
        });
        Contour {
            pieces: pieces.collect(),
            closed: self.closed,
            double_of: self.double_of,
        }
    }
}

/// The segment `along` a piece in the direction of travel.
fn segment_of(
    piece: &Piece,
    geometry: &Geometry,
    along: usize,
    flat: f64,
) -> Option<ContourSegment> {
    let segment = if piece.reversed {
        piece.count().checked_sub(1 + along)?
    } else {
        along
    };
    let own = geometry.segment_of(segment, flat)?;
    let geometry = if piece.reversed { own.reversed() } else { own };
    Some(ContourSegment {
        entity: piece.entity,
        segment,
        reversed: piece.reversed,
        geometry,
    })
}
