//! A part of whose contour an edit has moved something, changed where it is: the pieces of the
//! path, and the edges, beside what has moved. The cost of such an edit depends on what it touches;
//! only where the number of pieces changes are all later ones renumbered. Made again, a pair of 10,000 segments each would take
//! twelve times as long, 37 ms of the processor, which is more than a frame.

use super::clearance::area_about;
use super::contour_path::Along;
use super::corners::Element;
use super::job::{Job, ROUNDING};
use super::offset::Wall;
use super::part::{Cut, Cutting, Edge, Part};
use super::path::Source;
use super::proof::Beside;
use super::reuse::{NEW, PathBefore, follows_of, which_it_is};
use super::spliced::Splice;
use crate::drawing::{Contour, Drawing};
use crate::geometry::{Bounds, Segment};
use std::collections::BTreeMap;
use std::ops::Range;

/// Where more segments have changed, everything is made again.
const MOST: usize = 64;

/// What has changed in a part.
#[derive(Debug, Default)]
pub(crate) struct Moved {
    /// Edges that are gone, and how many stand in their place; the last ones first.
    pub edges: Vec<(Range<usize>, usize)>,
    /// The boxes of all that has changed, as it was and as it is: edges, and the way of the wire.
    pub boxes: Vec<Bounds>,
}

impl Moved {
    /// Where an edge stands now that stood there; nothing where it is gone.
    pub(crate) fn is(&self, edge: usize) -> Option<usize> {
        let mut is = edge;
        for (gone, new) in &self.edges {
            if gone.contains(&edge) {
                return None;
            }
            if gone.end <= edge {
                is = is - gone.len() + new;
            }
        }
        Some(is)
    }

    /// The edges that are new.
    pub(crate) fn come(&self) -> impl Iterator<Item = usize> {
        let mut first = 0;
        let mut before = 0;
        let stretches = self.edges.iter().rev().map(move |(gone, new)| {
            first += gone.start - before;
            before = gone.end;
            let stretch = first..first + new;
            first += new;
            stretch
        });
        stretches.flatten()
    }
}

/// Pieces of the path, by their places, and those in their place, each with what it follows.
type Stretch = (Range<usize>, Vec<(Wall, u32)>);

impl Part {
    /// Follows an edit of the contour, under the same settings, of which it is known which segments may have changed, none of which came or
    /// went. `None` where something in the part came or went, or where it was not laid beside its neighbours: then the part is as it was.
    pub(crate) fn follow(
        &mut self,
        drawing: &Drawing,
        contour: &Contour,
        cutting: Cutting,
        edited: &[Range<usize>],
    ) -> Option<Moved> {
        let Cut {
            job, half, last, ..
        } = Cut::of(drawing, cutting, &|| true).ok()?;
        let is_laid = self.is_by_neighbours == [true; 2] && !self.path_follows.is_empty();
        if !is_laid || contour.len() != self.drawn.len() {
            return None;
        }
        // What the wire does not reach now it may reach then, anywhere.
        let followed = self.path_follows.chunk_by(|one, next| one / 2 == next / 2);
        if followed.count() < self.drawn.len() {
            return None;
        }
        let new = self.changed(&job, contour, edited)?;
        if new.is_empty() {
            return Some(Moved::default());
        }
        let last = last.on_own_side();
        let sides = [(last.side, last.correction), (-cutting.side.sign(), half)];
        let gone = self.put_drawn(&new)?;
        let moved = self.path_follows_on(&job, &new, sides);
        if moved.is_none() {
            self.put_drawn(&gone)?;
        }
        moved
    }

    /// The segments that are not what they were, with what they are now; `None` where they do not follow on each other as they did.
    fn changed(
        &self,
        job: &Job,
        contour: &Contour,
        edited: &[Range<usize>],
    ) -> Option<Vec<(usize, Segment)>> {
        let count = self.drawn.len();
        let zero_length = job.units(job.settings.tolerances.zero_length);
        let mut now = BTreeMap::new();
        let mut look = |index: usize| {
            let segment = contour.segment(job.drawing, index)?;
            let source = Source::Segment {
                entity: segment.entity,
                segment: segment.segment,
            };
            let is_sound =
                segment.geometry.length() > zero_length && source == self.drawn[index].source;
            now.insert(index, is_sound.then_some(segment.geometry)?);
            Some(segment.geometry != self.drawn[index].geometry)
        };
        let mut changed = Vec::new();
        for index in edited.iter().cloned().flatten() {
            if look(index)? && !changed.contains(&index) {
                changed.push(index);
            }
            if changed.len() > MOST {
                return None;
            }
        }
        changed.sort_unstable();
        for &index in &changed {
            for beside in [(index + count - 1) % count, (index + 1) % count] {
                if look(beside)? && !changed.contains(&beside) {
                    return None;
                }
            }
        }
        // A gap between neighbours is closed by both.
        let follows_on = |index: &usize| {
            let next = now.get(&((index + 1) % count))?;
            let before = now.get(&((index + count - 1) % count))?;
            let own = now.get(index)?;
            Some(before.end() == own.start() && own.end() == next.start())
        };
        let is_whole = changed.iter().all(|index| follows_on(index) == Some(true));
        let new = changed.iter().map(|index| Some((*index, *now.get(index)?)));
        new.collect::<Option<_>>().filter(|_| is_whole)
    }

    /// Replaces some segments, and returns the old ones.
    fn put_drawn(&mut self, new: &[(usize, Segment)]) -> Option<Vec<(usize, Segment)>> {
        for &(index, geometry) in new {
            self.drawn[index].geometry = geometry;
        }
        Some(self.own.as_mut()?.replace(new))
    }

    /// Replaces pieces of the path, one stretch after the other, and returns how that is undone.
    fn put_path(&mut self, stretches: &[Stretch]) -> Vec<Stretch> {
        let origin = self.drawn[0].geometry.start();
        let put = |(stretch, new): &Stretch| {
            let geometries: Vec<Segment> = new.iter().map(|(piece, _)| piece.geometry).collect();
            self.path.splice(stretch.clone(), &geometries, origin);
            let pieces = new.iter().map(|(piece, _)| *piece);
            let pieces: Vec<Wall> = self.ways.splice(stretch.clone(), pieces).collect();
            let follows = new.iter().map(|(_, follows)| *follows);
            let follows = self.path_follows.splice(stretch.clone(), follows);
            let gone = pieces.into_iter().zip(follows).collect();
            (stretch.start..stretch.start + new.len(), gone)
        };
        let mut undone: Vec<Stretch> = stretches.iter().map(put).collect();
        undone.reverse();
        undone
    }

    fn path_follows_on(
        &mut self,
        job: &Job,
        changed: &[(usize, Segment)],
        [first, second]: [(f64, f64); 2],
    ) -> Option<Moved> {
        let drawn = Beside {
            walls: &self.drawn,
            own: self.own.as_ref()?,
            correction: first.1,
            side: first.0,
            rounding: job.units(ROUNDING),
            closed: true,
        };
        let count = self.drawn.len();
        let mut was: Vec<u32> = (0..count as u32).collect();
        changed.iter().for_each(|(index, _)| was[*index] = NEW);
        let kept = PathBefore::new(count, was, &self.path, &self.path_follows);
        let piece = |element: Element| {
            let (geometry, source) = (element.geometry, self.drawn[element.wall].source);
            let follows = follows_of(element.wall as u32, &element);
            (Wall { geometry, source }, follows)
        };
        let stretches = relaid(job, &drawn, &kept)?.into_iter();
        let stretches = stretches.map(|(gone, new)| (gone, new.into_iter().map(piece).collect()));
        let stretches: Vec<Stretch> = stretches.collect();
        let is_kept = |(gone, new): &Stretch| {
            let is_among_new = |was: &u32| new.iter().any(|(_, now)| now / 2 == was / 2);
            self.path_follows[gone.clone()].iter().all(is_among_new)
        };
        if !stretches.iter().all(is_kept) {
            return None;
        }
        let mut moved = Moved::default();
        let before = self.ways.len();
        let mut was: Vec<u32> = (0..before as u32).collect();
        for (gone, new) in &stretches {
            let boxes = gone.clone().map(|piece| *self.path.bounds_of(piece));
            moved.boxes.extend(boxes);
            moved
                .boxes
                .extend(new.iter().map(|(piece, _)| piece.geometry.bounds()));
            was.splice(gone.clone(), new.iter().map(|_| NEW));
        }
        let undone = self.put_path(&stretches);
        let done = self.edges_follow_on(job, (was, before), second, &mut moved);
        if done.is_none() {
            self.put_path(&undone);
        }
        done.map(|()| moved)
    }

    /// `was` gives for each piece of the path the index that it had among the pieces before.
    fn edges_follow_on(
        &mut self,
        job: &Job,
        (was, before): (Vec<u32>, usize),
        (side, correction): (f64, f64),
        moved: &mut Moved,
    ) -> Option<()> {
        let beside = Beside {
            walls: &self.ways,
            own: &self.path,
            correction,
            side,
            rounding: job.units(ROUNDING),
            closed: true,
        };
        let kept = PathBefore::new(before, was, &self.near, &self.edges_follow);
        let stretches = relaid(job, &beside, &kept)?;
        let is = which_it_is(&kept.was, kept.before);
        for follows in &mut self.edges_follow {
            // Of one that is gone the edge goes, too.
            *follows = 2 * is[*follows as usize / 2].min(NEW / 4) + *follows % 2;
        }
        let origin = self.drawn[0].geometry.start();
        for (gone, new) in stretches {
            let geometries: Vec<Segment> = new.iter().map(|element| element.geometry).collect();
            moved.boxes.extend(geometries.iter().map(Segment::bounds));
            moved
                .boxes
                .extend(gone.clone().map(|edge| *self.near.bounds_of(edge)));
            self.near.splice(gone.clone(), &geometries, origin);
            let follows = new
                .iter()
                .map(|element| follows_of(element.wall as u32, element));
            self.edges_follow.splice(gone.clone(), follows);
            let edges = new
                .iter()
                .map(|element| Edge::of(element, &self.path_follows));
            self.edges.splice(gone.clone(), edges);
            moved.edges.push((gone, new.len()));
        }
        Some(())
    }
}

/// Where the path is not as it was, the last stretch first, and what stands there, proved, as is what lies about it.
fn relaid(
    job: &Job,
    beside: &Beside,
    kept: &PathBefore,
) -> Option<Vec<(Range<usize>, Vec<Element>)>> {
    let Beside { walls, own, .. } = *beside;
    let (pieces, follows) = (kept.pieces, kept.follows);
    let joining = job.joining(Along {
        side: beside.side,
        correction: beside.correction,
        closed: true,
    });
    let laid = Splice::of(kept, walls, &joining)?.stretches(kept)?;
    let holds = |element: &Element| beside.holds_beyond(element, None).is_ok();
    let is = which_it_is(&kept.was, kept.before);
    let fails = |piece: usize| {
        let wall = is[follows[piece] as usize / 2];
        !laid.iter().any(|(gone, _)| gone.contains(&piece))
            && (wall == NEW || !holds(&kept.piece(piece, wall as usize, walls)))
    };
    let about = kept.about(own, beside.correction);
    let mut new = laid.iter().flat_map(|(_, new)| new);
    let all_hold = new.all(holds) && about.iter().all(|new| pieces.find(new, fails).is_none());
    // It runs round as the contour does, on the side of the wire.
    let origin = walls.first()?.geometry.start();
    let grown = laid.iter().map(|(gone, new)| {
        let new: Vec<Segment> = new.iter().map(|element| element.geometry).collect();
        let gone = &pieces.segments()[gone.clone()];
        area_about(&new, origin) - area_about(gone, origin)
    });
    let (contour, area) = (own.twice_area(), pieces.twice_area() + grown.sum::<f64>());
    let keeps_its_side = (area - contour) * beside.side <= 0.0 && area * contour > 0.0;
    (all_hold && keeps_its_side).then_some(laid)
}
