//! A contour: entities joined end to end, with a direction of travel. Segments that are shorter than the resolution are no part of it.

use super::crumbs::{LeftOut, left_out};
use super::{Drawing, EntityId, Geometry};
use crate::geometry::{Bounds, Point, Segment};
use std::ops::Range;
use std::sync::Arc;

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

    /// The place along the piece of the segment that is the `nth` of its entity, and the other way round.
    fn turned(&self, nth: usize) -> Option<usize> {
        match self.reversed {
            true => self.count().checked_sub(1 + nth),
            false => (nth < self.count()).then_some(nth),
        }
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
    /// Segments of the entities that are no part of it, in the order of the pieces.
    left_out: Vec<LeftOut>,
    /// Its segments, where it is composed of parts of other contours: its pieces then only name the entities.
    parts: Option<Arc<[ContourSegment]>>,
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

impl ContourSegment {
    /// The same in the other direction of travel.
    pub(crate) fn turned(&self) -> ContourSegment {
        ContourSegment {
            reversed: !self.reversed,
            geometry: self.geometry.reversed(),
            ..*self
        }
    }
}

impl Contour {
    /// A contour of `(entity, reversed)` in order of travel, with all their segments; entities without segments are left out.
    pub fn new(
        drawing: &Drawing,
        entities: impl IntoIterator<Item = (EntityId, bool)>,
        closed: bool,
    ) -> Contour {
        Contour::of(drawing, entities, closed, 0.0)
    }

    /// The same without the segments that are shorter than `least`, drawing units: where they were, the contour has a gap of
    /// less than that.
    pub(crate) fn of(
        drawing: &Drawing,
        entities: impl IntoIterator<Item = (EntityId, bool)>,
        closed: bool,
        least: f64,
    ) -> Contour {
        let entities = entities.into_iter();
        let mut contour = Contour {
            pieces: Vec::with_capacity(entities.size_hint().0),
            closed,
            ..Contour::default()
        };
        let mut first = 0;
        for (entity, reversed) in entities {
            let Some(geometry) = drawing.get(entity).map(|entity| &entity.geometry) else {
                continue;
            };
            let place = contour.pieces.len();
            let before = contour.left_out.len();
            left_out(geometry, least, place, &mut contour.left_out);
            let gone = contour.left_out.len() - before;
            let count = (geometry.segment_count() - gone) as u32;
            if count == 0 {
                contour.left_out.truncate(before);
                continue;
            }
            contour.pieces.push(Piece {
                entity,
                reversed,
                first,
                count,
            });
            first += count;
        }
        contour
    }

    /// A contour of parts of others, which hold these entities.
    pub(crate) fn composed(
        entities: impl IntoIterator<Item = EntityId>,
        parts: Vec<ContourSegment>,
        closed: bool,
    ) -> Contour {
        let piece = |entity| Piece {
            entity,
            reversed: false,
            first: 0,
            count: 0,
        };
        Contour {
            pieces: entities.into_iter().map(piece).collect(),
            closed,
            parts: Some(parts.into()),
            ..Contour::default()
        }
    }

    /// Whether it is composed of parts of others.
    pub(crate) fn is_composed(&self) -> bool {
        self.parts.is_some()
    }

    /// Whether segments of its entities are no part of it.
    pub(crate) fn leaves_out(&self) -> bool {
        !self.left_out.is_empty()
    }

    /// What is left out of the piece at a place.
    fn left_out_of(&self, place: usize) -> &[LeftOut] {
        if self.left_out.is_empty() {
            return &[];
        }
        let until = |place: usize| self.left_out.partition_point(|it| it.piece() < place);
        self.left_out
            .get(until(place)..until(place + 1))
            .unwrap_or_default()
    }

    /// The index within the contour of a segment of the piece at a place; `None` for one that is left out.
    pub(crate) fn index_of(&self, place: usize, segment: usize) -> Option<usize> {
        let piece = self.pieces.get(place)?;
        let nth = LeftOut::nth(self.left_out_of(place), segment)?;
        Some(piece.first() + piece.turned(nth)?)
    }

    /// Number of segments.
    pub(crate) fn len(&self) -> usize {
        match &self.parts {
            Some(parts) => parts.len(),
            None => self.pieces.last().map_or(0, |piece| piece.range().end),
        }
    }

    /// Segment `index` in the direction of travel, `None` past the end.
    pub(crate) fn segment(&self, drawing: &Drawing, index: usize) -> Option<ContourSegment> {
        if let Some(parts) = &self.parts {
            return parts.get(index).copied();
        }
        let (place, piece) = self.piece_of(index)?;
        segment_of(
            (piece, self.left_out_of(place)),
            &drawing.get(piece.entity)?.geometry,
            index - piece.first(),
            drawing.flat(),
        )
    }

    /// The first and the last segment of the piece of segment `index`.
    pub(crate) fn ends_of_piece(&self, index: usize) -> Option<(usize, usize)> {
        let (_, piece) = self.piece_of(index)?;
        Some((piece.first(), piece.range().end.checked_sub(1)?))
    }

    /// Segment `index` of which the geometry is known.
    pub(crate) fn segment_with(
        &self,
        drawing: &Drawing,
        index: usize,
        geometry: Segment,
    ) -> Option<ContourSegment> {
        if let Some(parts) = &self.parts {
            let part = *parts.get(index)?;
            return Some(ContourSegment { geometry, ..part });
        }
        let (entity, segment) = self.segment_id(drawing, index)?;
        Some(ContourSegment {
            entity,
            segment,
            reversed: self.piece_of(index)?.1.reversed,
            geometry,
        })
    }

    fn piece_of(&self, index: usize) -> Option<(usize, &Piece)> {
        let behind = |piece: &Piece| piece.range().end <= index;
        let place = self.pieces.partition_point(behind);
        Some((place, self.pieces.get(place)?))
    }

    /// The entity of segment `index`, and the segment in there: without its geometry.
    pub(crate) fn segment_id(&self, drawing: &Drawing, index: usize) -> Option<(EntityId, usize)> {
        if let Some(parts) = &self.parts {
            return parts.get(index).map(|part| (part.entity, part.segment));
        }
        let (place, piece) = self.piece_of(index)?;
        let nth = piece.turned(index - piece.first())?;
        let segment = LeftOut::segment(self.left_out_of(place), nth);
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
        let parts = self.parts.as_deref();
        let of_parts = parts.map(|parts| parts.get(range.clone()).unwrap_or_default());
        let pieces = parts.map_or(&self.pieces[..], |_| &[]);
        let first = pieces.partition_point(|piece| piece.range().end <= range.start);
        let flat = drawing.flat();
        let pieces = (first..)
            .zip(pieces.get(first..).unwrap_or_default())
            .take_while(move |(_, piece)| piece.first() < range.end);
        let of_pieces = pieces.flat_map(move |(place, piece)| {
            let left_out = self.left_out_of(place);
            let geometry = drawing.get(piece.entity).map(|entity| &entity.geometry);
            let along = range.start.saturating_sub(piece.first())
                ..range.end.min(piece.range().end) - piece.first();
            along.filter_map(move |along| segment_of((piece, left_out), geometry?, along, flat))
        });
        of_parts.into_iter().flatten().copied().chain(of_pieces)
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
        let last = self.pieces.len().saturating_sub(1);
        let mut left_out: Vec<LeftOut> = self.left_out.iter().map(|it| it.turned(last)).collect();
        left_out.sort_unstable_by_key(LeftOut::place);
        let parts = self.parts.as_deref();
        Contour {
            pieces: pieces.collect(),
            closed: self.closed,
            double_of: self.double_of,
            left_out,
            parts: parts.map(|parts| parts.iter().rev().map(ContourSegment::turned).collect()),
        }
    }
}

/// The segment `along` a piece, of which some are left out, in the direction of travel.
fn segment_of(
    (piece, left_out): (&Piece, &[LeftOut]),
    geometry: &Geometry,
    along: usize,
    flat: f64,
) -> Option<ContourSegment> {
    let segment = LeftOut::segment(left_out, piece.turned(along)?);
    let own = geometry.segment_of(segment, flat)?;
    let geometry = if piece.reversed { own.reversed() } else { own };
    Some(ContourSegment {
        entity: piece.entity,
        segment,
        reversed: piece.reversed,
        geometry,
    })
}
