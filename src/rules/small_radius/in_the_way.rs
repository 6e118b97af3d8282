//! What parts of the contour the disc of a new arc meets.
//!
//! Where arcs crowd, thousands of discs are tried, and a few segments are in the way of nearly all:
//! those that were in the way of the last discs are checked first.

use super::Travel;
use crate::geometry::{Arc, Bounds, Segment, Tolerances};

/// Segments that are checked first.
const MOST: usize = 16;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Meets {
    Nothing,
    /// Only replaced segments, and those by no more than rounding of the drawing explains.
    Rounding,
    Something,
}

/// Segments that reached into the last discs, the last one first, by their indices in the contour.
#[derive(Default)]
pub(super) struct InTheWay {
    segments: Vec<(usize, Segment, Bounds)>,
}

impl InTheWay {
    /// What the disc of an arc meets, where the arc replaces what lies between two positions.
    pub(super) fn met_by(
        &mut self,
        arc: &Arc,
        travel: &Travel,
        tolerances: &Tolerances,
        [before, after]: [isize; 2],
    ) -> Meets {
        let count = travel.len() as isize;
        let disc = Bounds::of_disc(arc.center, arc.radius);
        let met = |index: usize, segment: &Segment| {
            let distance = segment.distance_to(arc.center);
            let beyond = (travel.position_of(index) - before).rem_euclid(count);
            let is_replaced = beyond > 0 && beyond < after - before;
            match () {
                () if distance >= arc.radius - tolerances.clearance => Meets::Nothing,
                () if is_replaced && distance >= arc.radius - tolerances.arc_fit => Meets::Rounding,
                () => Meets::Something,
            }
        };
        let known = self.segments.iter().position(|(index, segment, bounds)| {
            bounds.touches(&disc) && met(*index, segment) == Meets::Something
        });
        if let Some(at) = known {
            self.segments[..=at].rotate_right(1);
            return Meets::Something;
        }
        let mut most = Meets::Nothing;
        let new = travel.first_within(&disc, |index, segment| {
            let met = met(index, segment);
            if met != Meets::Nothing {
                most = met;
            }
            met == Meets::Something
        });
        if let Some((index, segment)) = new {
            self.segments.truncate(MOST - 1);
            self.segments.insert(0, (index, segment, segment.bounds()));
        }
        most
    }
}
