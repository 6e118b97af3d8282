//! Joins entities to contours: the chains without a branch, and the rest as `knots` resolves it.

use super::ends::{End, Ends, has_ends};
use super::joints::Joints;
use super::knots::{Strand, resolve};
use super::{Drawing, EntityId};
use std::ops::Range;

/// A contour as a range of the pieces of all.
pub(super) struct Way {
    pub(crate) range: Range<usize>,
    pub(crate) closed: bool,
    /// The first of its entities in machining order, by number.
    pub(crate) first: u32,
    pub(crate) by_ends: bool,
    /// The entity in the same place that is chained, by number.
    pub(crate) double_of: Option<u32>,
}

/// The joints: entities by number, in order of travel, and whether each is travelled against its own direction.
#[derive(Default)]
pub(super) struct Linked {
    pub(crate) pieces: Vec<(u32, bool)>,
    pub(crate) ways: Vec<Way>,
}

impl Linked {
    pub(crate) fn new(
        drawing: &Drawing,
        entities: &[EntityId],
        ends_of: &[Ends],
        joints: &Joints,
    ) -> Linked {
        let mut linked = Linked {
            pieces: Vec::with_capacity(entities.len()),
            ways: Vec::new(),
        };
        let mut is_taken = vec![false; entities.len()];
        let mut is_special = vec![
            false;
            if joints.doubles.kept.is_empty() {
                0
            } else {
                entities.len()
            }
        ];
        joints
            .doubles
            .kept
            .iter()
            .chain(joints.doubles.aside.keys())
            .for_each(|&double| is_special[double as usize] = true);
        let (mut strands, mut ranges) = (Vec::new(), Vec::new());
        for (first, &id) in (0..).zip(entities) {
            let has_segments = || {
                drawing
                    .get(id)
                    .is_some_and(|entity| entity.geometry.segment_count() > 0)
            };
            if is_taken[first as usize] || !has_segments() {
                continue;
            }
            let begin = linked.pieces.len();
            let is_ring = !ends_of.get(id.0 as usize).is_some_and(has_ends);
            let closed = linked.run(joints, first, &mut is_taken) || is_ring;
            let range = begin..linked.pieces.len();
            let pieces = &linked.pieces[range.clone()];
            let (Some(&(head, head_reversed)), Some(&(last, last_reversed))) =
                (pieces.first(), pieces.last())
            else {
                continue;
            };
            let [start, end] = [
                End::both(head)[usize::from(head_reversed)],
                End::both(last)[usize::from(!last_reversed)],
            ];
            let about = [start, end].map(|end| joints.place(end));
            let lies_about_its_ends = |pieces: &[(u32, bool)]| {
                let mut pieces = pieces.iter();
                pieces.all(|(at, _)| about.iter().all(|&about| joints.is_crumb(*at, about)))
            };
            // What is no larger than the gap between its ends does not close.
            let is_wide = joints.distance(start, end) > joints.certain();
            let is_dot = closed && !is_ring && is_wide && lies_about_its_ends(pieces);
            if closed && !is_dot || joints.is_lone(start) && joints.is_lone(end) {
                // Two entities that close a loop may lie on each other, and one that is smaller than its gap does not close.
                let by_ends = !(closed && (pieces.len() == 2 || is_wide)
                    || !is_special.is_empty()
                        && pieces.iter().any(|(at, _)| is_special[*at as usize]));
                linked.ways.push(Way {
                    range,
                    closed,
                    first,
                    by_ends,
                    double_of: joints.doubles.aside.get(&first).copied(),
                });
                continue;
            }
            let leads_round = pieces.len() == 1 && joints.leads_round(head);
            let is_crumb = !leads_round
                && joints.distance(start, end) <= joints.join()
                && lies_about_its_ends(pieces);
            strands.push(Strand {
                ends: [start, end],
                count: pieces.len(),
                is_crumb,
            });
            ranges.push(range);
        }
        for joined in resolve(&strands, joints) {
            let begin = linked.pieces.len();
            for (strand, reversed) in joined.strands {
                let range = ranges[strand].clone();
                let piece = |index: usize| linked.pieces[index];
                let pieces: Vec<(u32, bool)> = if reversed {
                    range
                        .rev()
                        .map(piece)
                        .map(|(at, turned)| (at, !turned))
                        .collect()
                } else {
                    range.map(piece).collect()
                };
                linked.pieces.extend(pieces);
            }
            linked.settle(begin, joined.closed);
        }
        linked.ways.sort_unstable_by_key(|way| way.first);
        linked
    }

    /// The entities through `first` that follow each other without a branch, in its direction. True where they lead
    /// round.
    fn run(&mut self, joints: &Joints, first: u32, is_taken: &mut [bool]) -> bool {
        let begin = self.pieces.len();
        is_taken[first as usize] = true;
        self.pieces.push((first, false));
        let [tail, mut tip] = End::both(first);
        while let Some(end) = joints.partner(tip) {
            if end == tail {
                return true;
            }
            is_taken[end.entity() as usize] = true;
            self.pieces.push((end.entity(), !end.is_start()));
            tip = end.other();
        }
        let (mut tip, forward) = (tail, self.pieces.len());
        while let Some(end) = joints.partner(tip) {
            is_taken[end.entity() as usize] = true;
            // Travelled towards the chain: its own end meets the tip when it is not reversed.
            self.pieces.push((end.entity(), end.is_start()));
            tip = end.other();
        }
        let backward = self.pieces.len() - forward;
        self.pieces[forward..].reverse();
        self.pieces[begin..].rotate_right(backward);
        false
    }

    /// Makes a contour of the pieces from `begin` on: in the direction of its first entity, and starting with it if
    /// closed.
    fn settle(&mut self, begin: usize, closed: bool) {
        let pieces = &mut self.pieces[begin..];
        let Some((place, &(first, reversed))) =
            pieces.iter().enumerate().min_by_key(|(_, (at, _))| *at)
        else {
            return;
        };
        let mut place = place;
        if reversed {
            pieces.reverse();
            pieces
                .iter_mut()
                .for_each(|(_, reversed)| *reversed = !*reversed);
            place = pieces.len() - 1 - place;
        }
        if closed {
            pieces.rotate_left(place);
        }
        self.ways.push(Way {
            range: begin..self.pieces.len(),
            closed,
            first,
            by_ends: false,
            double_of: None,
        });
    }
}
