//! A contour travelled so that the wire lies on the left.

use crate::drawing::{Contour, ContourIndex, ContourSegment, Drawing};
use crate::finding::Side;
use crate::geometry::{Bounds, Segment};

/// A contour seen in the direction that has the wire on its left: arcs concave to the wire turn left.
///
/// Positions count segments in that direction. On a closed contour they wrap round, below zero too.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Travel<'a> {
    pub(crate) drawing: &'a Drawing,
    pub(crate) contour: &'a Contour,
    pub(crate) index: &'a ContourIndex,
    /// Wire side in the contour's own direction.
    pub(crate) side: Side,
}

impl Travel<'_> {
    pub(crate) fn len(&self) -> usize {
        self.contour.len()
    }

    /// The contour's own index at a position; `None` past the ends of an open contour.
    pub(crate) fn index_at(&self, position: isize) -> Option<usize> {
        let count = self.len() as isize;
        let inside = (0..count).contains(&position);
        if count == 0 || (!inside && !self.contour.closed) {
            return None;
        }
        let along = position.rem_euclid(count) as usize;
        Some(match self.side {
            Side::Left => along,
            Side::Right => self.len() - 1 - along,
        })
    }

    /// The position, within one round, of a contour's own index.
    pub(crate) fn position_of(&self, index: usize) -> isize {
        match self.side {
            Side::Left => index as isize,
            Side::Right => self.len() as isize - 1 - index as isize,
        }
    }

    /// The segment at a position, with the wire on the left of its direction.
    pub(crate) fn segment(&self, position: isize) -> Option<ContourSegment> {
        let own = self
            .contour
            .segment(self.drawing, self.index_at(position)?)?;
        Some(match self.side {
            Side::Left => own,
            Side::Right => ContourSegment {
                reversed: !own.reversed,
                geometry: own.geometry.reversed(),
                ..own
            },
        })
    }

    /// The first segment that reaches into a disc, that is, for whose index in the contour and
    /// geometry `reaches` is true. Only those whose boxes touch the box of the disc are checked.
    pub(crate) fn first_within(
        &self,
        disc: &Bounds,
        mut reaches: impl FnMut(usize, &Segment) -> bool,
    ) -> Option<(usize, Segment)> {
        self.index.near(disc).flatten().find_map(|index| {
            let segment = self.contour.segment(self.drawing, index)?.geometry;
            let is_near = segment.bounds().touches(disc);
            (is_near && reaches(index, &segment)).then_some((index, segment))
        })
    }
}
