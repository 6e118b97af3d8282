//! Chains entities to contours by their end points.
//!
//! Closed entities are contours of their own. The others are joined end to end within the join tolerance, across kinds
//! and layers. A *group* is a set of contours connected through ends that lie near each other. Groups are chained
//! independently, so an edit rechains only the groups that it touches, and the result equals a fresh start.
//!
//! Which entities form a contour does not depend on their order in the drawing. Where no other end is near, ends are
//! joined as they meet; `knots` resolves the other places. Of entities in one place one is chained, see `doubles`. Only
//! the start and direction of a contour depend on the order: it begins with its first entity, in that entity's
//! direction.

mod groups;
mod kept;

use super::crumbs::{has_short, is_crumb};
use super::ends::{Buckets, Cells, End, Ends, NO_ENDS, has_ends};
use super::joints::Joints;
use super::linked::{Linked, Way};
use super::{Contour, Drawing, EntityId, Piece, Role};
use crate::geometry::Point;
use kept::{Before, Chain, kept_of};
use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// Up to this many entities are sorted without looking at all others.
const FEW: usize = 16;
/// Where up to one in this many entities has changed, the ends are moved one by one; beyond, all are sorted into cells again.
const BULK: usize = 8;

/// Entities, contours or lists of ends that one thread takes at a time.
const SHARE: usize = 4096;

/// Names a contour (or a group of several) of one [`Chains`]; never reused.
pub(crate) type Key = u32;

/// Names nothing.
const NO_KEY: Key = 0;

/// The contours of a drawing, kept up to date edit by edit.
#[derive(Clone, Debug)]
pub struct Chains {
    cells: Cells,
    /// What is shorter is no part of a contour, drawing units.
    least: f64,
    /// All free ends by cell, numbered by entity id; empty until the first edit. All contours with an end in one cell
    /// are of one group.
    ends: Option<Buckets>,
    /// The free ends of each open entity, by entity id; [`NO_ENDS`] for all others.
    ends_of: Vec<Ends>,
    /// Shared with copies.
    contours: FxHashMap<Key, Arc<Chain>>,
    /// The contour of each entity, by entity id; [`NO_KEY`] for entities in none.
    contour_of: Vec<Key>,
    /// The place of each entity among the pieces of its contour, by entity id.
    piece_of: Vec<u32>,
    /// Groups of more than one contour, and the group of each contour in one. Any other contour is a group by itself.
    groups: FxHashMap<Key, Vec<Key>>,
    group_of: FxHashMap<Key, Key>,
    next_key: Key,
}

/// Contours that an edit of the drawing removed and added.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rechained {
    pub gone: Vec<Key>,
    pub(crate) new: Vec<Key>,
    /// How many entities have been chained again, those of contours that are as they were among them.
    pub(crate) chained: usize,
}

impl Chains {
    /// Chains every entity of `drawing` for which `is_cut` holds; `join` is the join tolerance in drawing units.
    pub fn new(drawing: &Drawing, join: f64, is_cut: &(dyn Fn(EntityId) -> bool + Sync)) -> Chains {
        Chains::of_parts(drawing, (join, 0.0), &|id| is_cut(id).then_some(0))
    }

    /// The same for the entities of several workpieces, which are not joined to each other: the number of its workpiece
    /// for each entity that is cut. What is shorter than `least` is no part of a contour.
    pub(crate) fn of_parts(
        drawing: &Drawing,
        (join, least): (f64, f64),
        part_of: &(dyn Fn(EntityId) -> Option<u16> + Sync),
    ) -> Chains {
        let mut chains = Chains {
            cells: Cells::new(join, drawing.certain()),
            least,
            ends: None,
            ends_of: Vec::new(),
            contours: FxHashMap::default(),
            contour_of: Vec::new(),
            piece_of: Vec::new(),
            groups: FxHashMap::default(),
            group_of: FxHashMap::default(),
            next_key: NO_KEY,
        };
        chains.grow(drawing);
        let told = |&id: &EntityId| {
            let ends = || free_ends(drawing, id).unwrap_or(NO_ENDS);
            let part = part_of(id).filter(|_| !is_too_small(drawing, id, least));
            part.map(|part| (id, part, ends()))
        };
        let order = drawing.order().par_iter().with_min_len(SHARE);
        let told: Vec<(EntityId, u16, Ends)> = order.filter_map(told).collect();
        for &(id, _, ends) in &told {
            chains.ends_of[id.0 as usize] = ends;
        }
        let entities = told.into_iter().map(|(id, part, _)| (id, part));
        chains.chain(drawing, entities.unzip(), &Before::default());
        chains
    }

    /// Contour by key.
    pub fn get(&self, key: Key) -> Option<&Contour> {
        self.contours.get(&key).map(|chain| &chain.contour)
    }

    /// The first of a contour's entities in machining order.
    pub(crate) fn first_of(&self, key: Key) -> Option<EntityId> {
        self.contours.get(&key).map(|chain| chain.first)
    }

    /// The contour that holds an entity.
    pub fn contour_of(&self, entity: EntityId) -> Option<Key> {
        self.contour_of
            .get(entity.0 as usize)
            .copied()
            .filter(|&key| key != NO_KEY)
    }

    fn ends_of(&self, entity: EntityId) -> Option<Ends> {
        self.ends_of
            .get(entity.0 as usize)
            .copied()
            .filter(has_ends)
    }

    /// The piece of a contour that an entity makes.
    pub fn piece_of(&self, entity: EntityId) -> Option<Piece> {
        let contour = self.get(self.contour_of(entity)?)?;
        let place = *self.piece_of.get(entity.0 as usize)?;
        contour
            .pieces
            .get(place as usize)
            .filter(|piece| piece.entity == entity)
            .copied()
    }

    /// The contour that holds a segment of an entity, and its index in it.
    pub(crate) fn index_of(&self, entity: EntityId, segment: usize) -> Option<(Key, usize)> {
        let key = self.contour_of(entity)?;
        self.piece_of(entity)?;
        let place = *self.piece_of.get(entity.0 as usize)?;
        Some((key, self.get(key)?.index_of(place as usize, segment)?))
    }

    /// True where the contour of an entity leaves segments out, or where some of the entity's in `ranges` are short enough for that.
    pub(crate) fn leaves_out(
        &self,
        drawing: &Drawing,
        entity: EntityId,
        ranges: &[Range<usize>],
    ) -> bool {
        let contour = self.contour_of(entity).and_then(|key| self.get(key));
        contour.is_some_and(Contour::leaves_out)
            || drawing
                .get(entity)
                .is_some_and(|entity| has_short(&entity.geometry, ranges, self.least))
    }

    /// True when an entity's free ends have not moved, so that the contours hold. Never for an entity whose own ends
    /// touch, nor in a contour with a double, of two entities that close a loop, or joined where several ends meet:
    /// there the part between the ends counts.
    pub(crate) fn same_ends(&self, drawing: &Drawing, entity: EntityId, is_cut: bool) -> bool {
        let is_cut = is_cut && !is_too_small(drawing, entity, self.least);
        let known = self.ends_of(entity);
        let now = if is_cut {
            free_ends(drawing, entity)
        } else {
            None
        };
        let touching = now.is_some_and(|(start, end)| (end - start).norm() <= self.cells.join);
        let contour = self.contour_of(entity);
        let by_ends = contour
            .and_then(|key| self.contours.get(&key))
            .is_none_or(|chain| chain.by_ends);
        let is_chained = is_cut
            && drawing
                .get(entity)
                .is_some_and(|entity| entity.geometry.segment_count() > 0);
        known == now && !touching && by_ends && contour.is_some() == is_chained
    }

    /// True where no end of another contour comes near those of a contour, so that all others stay if it goes.
    pub(crate) fn stands_alone(&self, key: Key) -> bool {
        !self.group_of.contains_key(&key)
    }

    /// To be called when the number of segments of an entity has changed: its contour counts them
    /// again.
    pub(crate) fn recount(&mut self, drawing: &Drawing, entity: EntityId) {
        let Some(chain) = self
            .contour_of(entity)
            .and_then(|key| self.contours.get_mut(&key))
        else {
            return;
        };
        let contour = &mut Arc::make_mut(chain).contour;
        let pieces = contour.pieces.iter();
        let pieces = pieces.map(|piece| (piece.entity, piece.reversed));
        let mut counted = Contour::of(drawing, pieces, contour.closed, self.least);
        counted.double_of = contour.double_of;
        *contour = counted;
    }

    /// Rechains the groups that the entities of `touched` (new, changed or removed) belonged to or belong to now.
    pub fn update(
        &mut self,
        drawing: &Drawing,
        touched: &[EntityId],
        is_cut: &dyn Fn(EntityId) -> bool,
    ) -> Rechained {
        self.update_parts(drawing, touched, &|id| is_cut(id).then_some(0))
    }

    /// The same as [`Chains::of_parts`] for an edit.
    pub(crate) fn update_parts(
        &mut self,
        drawing: &Drawing,
        touched: &[EntityId],
        part_of: &dyn Fn(EntityId) -> Option<u16>,
    ) -> Rechained {
        let least = self.least;
        let part_of = |id: EntityId| part_of(id).filter(|_| !is_too_small(drawing, id, least));
        let is_cut = |id: EntityId| part_of(id).is_some();
        self.grow(drawing);
        let mut entities = FxHashSet::default();
        let distinct: FxHashSet<EntityId> = touched.iter().copied().collect();
        let mut affected: FxHashSet<Key> = distinct
            .iter()
            .filter_map(|&id| self.contour_of(id))
            .collect();
        let few = distinct.len() * BULK <= self.ends_of.len();
        let mut ends = self.ends.take().filter(|_| few);
        for &id in &distinct {
            if let (Some(_), Some(ends)) = (self.ends_of(id), &mut ends) {
                End::both(id.0).into_iter().for_each(|end| ends.remove(end));
            }
            self.ends_of[id.0 as usize] = NO_ENDS;
        }
        let mut ends = ends.unwrap_or_else(|| self.sorted_ends());
        ends.grow(self.ends_of.len());
        let mut fresh = Vec::new();
        for id in distinct
            .iter()
            .copied()
            .filter(|&id| drawing.get(id).is_some() && is_cut(id))
        {
            entities.insert(id);
            if let Some(both) = free_ends(drawing, id) {
                affected.extend(
                    [both.0, both.1]
                        .into_iter()
                        .flat_map(|point| self.contours_about(&ends, point)),
                );
                fresh.push((id, both));
            }
        }
        for (id, both) in fresh {
            self.ends_of[id.0 as usize] = both;
            End::both(id.0)
                .into_iter()
                .for_each(|end| ends.insert(self.cells.of(end.of(both)), end));
        }
        self.ends = Some(if ends.is_crowded() {
            self.sorted_ends()
        } else {
            ends
        });
        for &id in touched {
            self.contour_of[id.0 as usize] = NO_KEY;
        }
        let mut rechained = Rechained::default();
        let mut before = Before::default();
        for contour in affected {
            let group = self
                .group_of
                .get(&contour)
                .and_then(|group| self.groups.remove(group));
            for key in group.unwrap_or_else(|| vec![contour]) {
                self.group_of.remove(&key);
                let Some(chain) = self.contours.remove(&key) else {
                    continue;
                };
                rechained.gone.push(key);
                for id in chain.contour.pieces.iter().map(|piece| piece.entity) {
                    if drawing.get(id).is_some() && is_cut(id) {
                        entities.insert(id);
                    }
                    self.contour_of[id.0 as usize] = NO_KEY;
                }
                let pieces = &chain.contour.pieces;
                if !pieces.iter().any(|piece| distinct.contains(&piece.entity)) {
                    before.extend(
                        pieces
                            .first()
                            .map(|first| (first.entity, (key, chain.clone()))),
                    );
                }
            }
        }
        rechained.chained = entities.len();
        let ordered = in_machining_order(drawing, entities).into_iter();
        let ordered = ordered.filter_map(|id| Some((id, part_of(id)?)));
        rechained.new = self.chain(drawing, ordered.unzip(), &before);
        rechained
            .gone
            .retain(|key| !self.contours.contains_key(key));
        rechained
    }

    fn grow(&mut self, drawing: &Drawing) {
        let bound = drawing.id_bound();
        self.ends_of.resize(bound, NO_ENDS);
        self.contour_of.resize(bound, NO_KEY);
        self.piece_of.resize(bound, 0);
    }

    /// Sorts the free ends by cell, unless that is done: the first edit needs it.
    pub(crate) fn make_ready(&mut self) {
        if self.ends.is_none() {
            self.ends = Some(self.sorted_ends());
        }
    }

    /// All ends by cell.
    fn sorted_ends(&self) -> Buckets {
        let open = self.ends_of.iter().filter(|ends| has_ends(ends)).count();
        let mut ends = Buckets::new(self.ends_of.len(), open);
        for (id, &both) in (0..).zip(&self.ends_of).filter(|(_, both)| has_ends(both)) {
            End::both(id)
                .into_iter()
                .for_each(|end| ends.insert(self.cells.of(end.of(both)), end));
        }
        ends
    }

    fn fresh_key(&mut self) -> Key {
        self.next_key += 1;
        self.next_key
    }

    /// One contour for each occupied cell about a point: the others there belong to its group.
    fn contours_about<'a>(
        &'a self,
        ends: &'a Buckets,
        point: Point,
    ) -> impl Iterator<Item = Key> + 'a {
        self.cells.about(point).filter_map(move |cell| {
            let is_here = |end: &End| {
                self.ends_of(EntityId(end.entity()))
                    .is_some_and(|ends| self.cells.of(end.of(ends)) == cell)
            };
            self.contour_of(EntityId(ends.of_cell(cell).find(is_here)?.entity()))
        })
    }

    /// Groups and chains entities, which come in machining order and hold whole groups, each with its workpiece.
    /// Returns the new contours; those that are as they were `before` keep their keys.
    fn chain(
        &mut self,
        drawing: &Drawing,
        (entities, parts): (Vec<EntityId>, Vec<u16>),
        before: &Before,
    ) -> Vec<Key> {
        let is_of_one = parts.windows(2).all(|pair| pair[0] == pair[1]);
        let mut by_part: BTreeMap<u16, Vec<EntityId>> = BTreeMap::new();
        if !is_of_one {
            for (&id, &part) in entities.iter().zip(&parts) {
                by_part.entry(part).or_default().push(id);
            }
        }
        drop(parts);
        let ends_of = std::mem::take(&mut self.ends_of);
        // A group is rechained as a whole, whatever workpiece its entities are of.
        let joints = Joints::new(drawing, self.cells, &entities, &ends_of);
        let linked: Vec<(&[EntityId], Linked)> = if is_of_one {
            let linked = Linked::new(drawing, &entities, &ends_of, &joints);
            vec![(&entities, linked)]
        } else {
            let of_part = |of_part| {
                let joints = Joints::new(drawing, self.cells, of_part, &ends_of);
                (of_part, Linked::new(drawing, of_part, &ends_of, &joints))
            };
            by_part.values().map(Vec::as_slice).map(of_part).collect()
        };
        for (entities, linked) in &linked {
            for way in &linked.ways {
                let pieces = linked.pieces.get(way.range.clone()).unwrap_or_default();
                let key = match kept_of(before, entities, (pieces, way)) {
                    Some((key, chain)) => {
                        self.contours.insert(*key, chain.clone());
                        *key
                    }
                    None => self.fresh_key(),
                };
                for (at, _) in &linked.pieces[way.range.clone()] {
                    self.contour_of[entities[*at as usize].0 as usize] = key;
                }
            }
        }
        let count = linked.iter().map(|(_, linked)| linked.ways.len());
        let mut new = Vec::with_capacity(count.sum());
        self.group(&entities, &ends_of, &joints);
        // Freed before the contours are made: these take as much memory as the joints.
        drop(joints);
        self.ends_of = ends_of;
        for (entities, linked) in linked {
            let is_new = |way: &&Way| {
                let first = linked.pieces.get(way.range.start);
                let key = first.map(|(at, _)| self.contour_of[entities[*at as usize].0 as usize]);
                key.is_none_or(|key| !self.contours.contains_key(&key))
            };
            let ways: Vec<&Way> = linked.ways.iter().filter(is_new).collect();
            let ways = ways.into_par_iter().with_min_len(SHARE);
            let least = self.least;
            let chain = |way: &Way| {
                let pieces = linked.pieces.get(way.range.clone()).unwrap_or_default();
                Arc::new(Chain::new(drawing, entities, (pieces, way), least))
            };
            let chains: Vec<Arc<Chain>> = ways.map(chain).collect();
            self.contours.reserve(chains.len());
            for chain in chains {
                let key = self.contour_of[chain.contour.pieces[0].entity.0 as usize];
                for (place, piece) in (0..).zip(&chain.contour.pieces) {
                    self.piece_of[piece.entity.0 as usize] = place;
                }
                self.contours.insert(key, chain);
                new.push(key);
            }
        }
        new
    }
}

/// The role that the entities of a contour state, or that follows from the layer or block: that of the first piece
/// which has one.
pub(crate) fn stated_role(
    contour: &Contour,
    of_entity: &dyn Fn(EntityId) -> Option<Role>,
) -> Option<Role> {
    contour
        .pieces
        .iter()
        .find_map(|piece| of_entity(piece.entity))
}

fn in_machining_order(drawing: &Drawing, entities: FxHashSet<EntityId>) -> Vec<EntityId> {
    if entities.len() <= FEW {
        let mut ordered: Vec<EntityId> = entities.into_iter().collect();
        ordered.sort_unstable_by_key(|&id| drawing.rank(id));
        return ordered;
    }
    let mut wanted = vec![false; drawing.id_bound()];
    entities.iter().for_each(|id| wanted[id.0 as usize] = true);
    drawing
        .order()
        .iter()
        .copied()
        .filter(|id| wanted[id.0 as usize])
        .collect()
}

/// True for an entity that is no part of a contour since all of it is shorter than `least`.
fn is_too_small(drawing: &Drawing, id: EntityId, least: f64) -> bool {
    drawing
        .get(id)
        .is_some_and(|entity| is_crumb(&entity.geometry, least))
}

fn free_ends(drawing: &Drawing, id: EntityId) -> Option<Ends> {
    drawing.get(id)?.geometry.ends()
}

#[cfg(test)]
mod tests;
