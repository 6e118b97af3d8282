//! A part of whose contour an edit has moved something, changed where it is: a segment for each that was there, and as many pieces of the
//! path and edges beside them. What such an edit costs hangs on what it touches.

use super::clearance::Walls;
use super::corners::Element;
use super::job::{Job, ROUNDING};
use super::kept::{Kept, NEW, follows_of};
use super::laid::Along;
use super::offset::Wall;
use super::part::{Cut, Cutting, Edge, Part};
use super::path::Source;
use super::proof::Beside;
use super::spliced::Splice;
use crate::drawing::{Contour, Drawing};
use crate::geometry::{Bounds, Segment};
use std::collections::BTreeMap;
use std::ops::Range;

/// Where more segments have changed, all is laid anew.
const MOST: usize = 64;

/// What of a part is not as it was.
#[derive(Debug, Default)]
pub(crate) struct Moved {
    /// Edges, by index.
    pub edges: Vec<usize>,
    /// The boxes of all that has changed, as it was and as it is: edges, and the way of the wire.
    pub boxes: Vec<Bounds>,
}

/// A piece of the path by its place, with what it follows.
type Piece = (usize, Wall, u32);

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
            job,
            half,
            last,
            away,
        } = Cut::of(drawing, cutting, &|| true).ok()?;
        let is_laid = self.is_by_neighbours == [true; 2] && !self.path_follows.is_empty();
        if !is_laid || contour.len() != self.drawn.len() {
            return None;
        }
        let new = self.changed(&job, contour, edited)?;
        if new.is_empty() {
            return Some(Moved::default());
        }
        let sides = [(away.sign(), last), (-cutting.side.sign(), half)];
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

    /// Puts other segments in the place of some, and hands out those.
    fn put_drawn(&mut self, new: &[(usize, Segment)]) -> Option<Vec<(usize, Segment)>> {
        for &(index, geometry) in new {
            self.drawn[index].geometry = geometry;
        }
        Some(self.own.as_mut()?.replace(new))
    }

    /// Puts other pieces of the path in the place of some, and hands out those.
    fn put_path(&mut self, new: &[Piece]) -> Vec<Piece> {
        let geometry = |(place, piece, _): &Piece| (*place, piece.geometry);
        let geometries: Vec<(usize, Segment)> = new.iter().map(geometry).collect();
        self.path.replace(&geometries);
        let put = |&(place, piece, follows): &Piece| {
            let piece = std::mem::replace(&mut self.ways[place], piece);
            let follows = std::mem::replace(&mut self.path_follows[place], follows);
            (place, piece, follows)
        };
        new.iter().map(put).collect()
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
        let changed = changed.iter().map(|(index, _)| *index);
        let laid = relaid(job, &drawn, changed, &self.path, &self.path_follows)?;
        let piece = |(place, element): (usize, Element)| {
            let (geometry, source) = (element.geometry, self.drawn[element.wall].source);
            let follows = follows_of(element.wall as u32, &element);
            (place, Wall { geometry, source }, follows)
        };
        let is_new = |(place, piece, follows): &Piece| {
            piece.geometry != self.ways[*place].geometry || *follows != self.path_follows[*place]
        };
        let pieces: Vec<Piece> = laid.into_iter().map(piece).filter(is_new).collect();
        let mut moved = Moved::default();
        let boxes = |part: &Part, moved: &mut Moved| {
            let boxes = pieces
                .iter()
                .map(|(place, ..)| *part.path.bounds_of(*place));
            moved.boxes.extend(boxes);
        };
        boxes(self, &mut moved);
        let gone = self.put_path(&pieces);
        boxes(self, &mut moved);
        let done = self.edges_follow_on(job, &pieces, second, &mut moved);
        if done.is_none() {
            self.put_path(&gone);
        }
        done.map(|()| moved)
    }

    fn edges_follow_on(
        &mut self,
        job: &Job,
        changed: &[Piece],
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
        let changed = changed.iter().map(|(place, ..)| *place);
        let laid = relaid(job, &beside, changed, &self.near, &self.edges_follow)?;
        let mut new = Vec::new();
        for (place, element) in laid {
            let edge = Edge::of(&element, &self.path_follows);
            let was = std::mem::replace(&mut self.edges[place], edge);
            self.edges_follow[place] = follows_of(element.wall as u32, &element);
            if was.geometry != edge.geometry || was.turned_about != edge.turned_about {
                moved.edges.push(place);
                moved.boxes.push(*self.near.bounds_of(place));
                new.push((place, edge.geometry));
            }
        }
        self.near.replace(&new);
        let boxes = moved.edges.iter().map(|place| *self.near.bounds_of(*place));
        moved.boxes.extend(boxes);
        Some(())
    }
}

/// The pieces beside the walls that have changed, each with its place in the path, proved, as is what lies about them.
fn relaid(
    job: &Job,
    beside: &Beside,
    changed: impl Iterator<Item = usize>,
    pieces: &Walls,
    follows: &[u32],
) -> Option<Vec<(usize, Element)>> {
    let Beside { walls, own, .. } = *beside;
    let mut was: Vec<u32> = (0..walls.len() as u32).collect();
    changed.for_each(|wall| was[wall] = NEW);
    let kept = Kept::new(walls.len(), was, pieces, follows, true);
    let joining = job.joining(Along {
        side: beside.side,
        correction: beside.correction,
        corner: Default::default(),
        closed: true,
    });
    let laid = Splice::of(&kept, walls, &joining)?.in_place(&kept)?;
    let about = kept.about(own, beside.correction);
    let is_near = |piece: usize| {
        let bounds = pieces.bounds_of(piece);
        about.iter().any(|new| new.touches(bounds))
    };
    let holds = |element: &Element| beside.holds_beyond(element, None).is_ok();
    let (mut all_hold, mut grown) = (true, 0.0);
    let origin = laid.first().map(|(_, element)| element.geometry.start())?;
    for (piece, element) in &laid {
        let was = pieces.segment(*piece);
        let stays = kept.followed(element, element.wall) == Some(follows[*piece])
            && *was == element.geometry;
        all_hold &= stays && !is_near(*piece) || holds(element);
        grown += element.geometry.twice_area(origin) - was.twice_area(origin);
    }
    let is_laid = |piece: usize| laid.iter().any(|(place, _)| *place == piece);
    let fails = |piece: usize| {
        let wall = follows[piece] as usize / 2;
        !is_laid(piece) && !holds(&kept.piece(piece, wall, walls))
    };
    all_hold &= about.iter().all(|new| pieces.find(new, fails).is_none());
    // It runs round as the contour does, on the side of the wire.
    let (contour, area) = (own.twice_area(), pieces.twice_area() + grown);
    let keeps_its_side = (area - contour) * beside.side <= 0.0 && area * contour > 0.0;
    (all_hold && keeps_its_side).then_some(laid)
}
