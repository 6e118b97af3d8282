//! Chaining entities to contours by their end points.
//!
//! Closed entities are contours of their own. The others are joined end to end within the join tolerance, across kinds
//! and layers. A *group* is what hangs together through ends that lie near each other: groups are chained independently of each
//! other, so an edit chains again only the groups that it touches, and the result is that of a fresh start.
//!
//! Which entities form a contour does not depend on their order in the drawing. Where nothing else is near, ends are joined as they
//! meet; the other places are for `knots`. Of entities in one place one is chained, see `doubles`. The order says where a contour
//! begins and which way it runs: with its first entity, in that one's direction.

use super::ends::{Buckets, Cell, Cells, End, Ends, NO_ENDS, has_ends};
use super::joints::Joints;
use super::knots::{Strand, resolve};
use super::{Contour, Drawing, EntityId, Piece, Role};
use crate::geometry::Point;
use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::Range;

/// Up to so many entities are put in order without a look at all others.
const FEW: usize = 16;
/// The ends of fewer than one in so many entities are moved one by one; of more, all are sorted into cells again.
const BULK: usize = 8;

/// Names a contour (or a group of several) of one [`Chains`]; not used again once it is gone.
pub type Key = u32;

/// Names nothing.
const NO_KEY: Key = 0;

/// The contours of a drawing, kept up to date edit by edit.
#[derive(Clone, Debug)]
pub struct Chains {
    cells: Cells,
    /// All free ends by cell, numbered by entity id; none until something is edited. All contours with an end in one cell are of one
    /// group.
    ends: Option<Buckets>,
    /// Where the free ends of each open entity lie, by entity id; [`NO_ENDS`] for all others.
    ends_of: Vec<Ends>,
    contours: FxHashMap<Key, Chain>,
    /// The contour of each entity, by entity id; [`NO_KEY`] for those in none.
    contour_of: Vec<Key>,
    /// The place of each entity among the pieces of its contour, by entity id.
    piece_of: Vec<u32>,
    /// Groups of more than one contour, and the group of each contour in one. Any other contour is a group by itself.
    groups: FxHashMap<Key, Vec<Key>>,
    group_of: FxHashMap<Key, Key>,
    next_key: Key,
}

#[derive(Clone, Debug)]
struct Chain {
    contour: Contour,
    /// The first of its entities in machining order.
    first: EntityId,
    /// It stands as long as the ends of its entities do, whatever lies between them.
    by_ends: bool,
}

/// Contours that went away and came when a drawing was edited.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rechained {
    pub gone: Vec<Key>,
    pub new: Vec<Key>,
}

impl Chains {
    /// Chains every entity of `drawing` for which `is_cut` holds; `join` is the join tolerance in drawing units.
    pub fn new(drawing: &Drawing, join: f64, is_cut: &dyn Fn(EntityId) -> bool) -> Chains {
        let mut chains = Chains {
            cells: Cells::new(join),
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
        let entities: Vec<EntityId> = drawing
            .order()
            .iter()
            .copied()
            .filter(|&id| is_cut(id))
            .collect();
        let ends: Vec<Ends> = entities
            .par_iter()
            .map(|&id| free_ends(drawing, id).unwrap_or(NO_ENDS))
            .collect();
        for (id, ends) in entities.iter().zip(ends) {
            chains.ends_of[id.0 as usize] = ends;
        }
        chains.chain(drawing, &entities);
        chains
    }

    /// Contour by key.
    pub fn get(&self, key: Key) -> Option<&Contour> {
        self.contours.get(&key).map(|chain| &chain.contour)
    }

    /// The first of a contour's entities in machining order.
    pub fn first_of(&self, key: Key) -> Option<EntityId> {
        self.contours.get(&key).map(|chain| chain.first)
    }

    /// Number of contours.
    pub fn len(&self) -> usize {
        self.contours.len()
    }

    pub fn is_empty(&self) -> bool {
        self.contours.is_empty()
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

    /// The piece of a contour that an entity is.
    pub fn piece_of(&self, entity: EntityId) -> Option<Piece> {
        let contour = self.get(self.contour_of(entity)?)?;
        let place = *self.piece_of.get(entity.0 as usize)?;
        contour
            .pieces
            .get(place as usize)
            .filter(|piece| piece.entity == entity)
            .copied()
    }

    /// The contour that holds a segment of an entity, and its index in there.
    pub fn index_of(&self, entity: EntityId, segment: usize) -> Option<(Key, usize)> {
        Some((
            self.contour_of(entity)?,
            self.piece_of(entity)?.index_of(segment)?,
        ))
    }

    /// Keys of all contours, in no order.
    pub fn keys(&self) -> impl Iterator<Item = Key> + '_ {
        self.contours.keys().copied()
    }

    /// True when an entity's free ends have not moved, so that the contours stand as they are. Never for an entity whose own
    /// ends touch, or that others meet: what lies between its ends counts there.
    pub fn same_ends(&self, drawing: &Drawing, entity: EntityId, is_cut: bool) -> bool {
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

    /// The number of segments of an entity has changed: its contour counts them anew.
    pub fn recount(&mut self, drawing: &Drawing, entity: EntityId) {
        let Some(Chain { contour, .. }) = self
            .contour_of(entity)
            .and_then(|key| self.contours.get_mut(&key))
        else {
            return;
        };
        let pieces = contour.pieces.iter();
        *contour = Contour {
            double_of: contour.double_of,
            ..Contour::new(
                drawing,
                pieces.map(|piece| (piece.entity, piece.reversed)),
                contour.closed,
            )
        };
    }

    /// Chains again what the entities of `touched` (new, changed or removed) belonged to or belong to now.
    pub fn update(
        &mut self,
        drawing: &Drawing,
        touched: &[EntityId],
        is_cut: &dyn Fn(EntityId) -> bool,
    ) -> Rechained {
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
            if let (Some(old), Some(ends)) = (self.ends_of(id), &mut ends) {
                End::both(id.0)
                    .into_iter()
                    .for_each(|end| ends.remove(self.cells.of(end.of(old)), end));
            }
            self.ends_of[id.0 as usize] = NO_ENDS;
        }
        let mut ends = ends.unwrap_or_else(|| self.sorted_ends());
        ends.grow(self.ends_of.len());
        let mut fresh = Vec::new();
        for id in distinct
            .into_iter()
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
                for id in chain.contour.pieces.into_iter().map(|piece| piece.entity) {
                    if drawing.get(id).is_some() && is_cut(id) {
                        entities.insert(id);
                    }
                    self.contour_of[id.0 as usize] = NO_KEY;
                }
            }
        }
        let ordered = in_machining_order(drawing, entities);
        rechained.new = self.chain(drawing, &ordered);
        rechained
    }

    fn grow(&mut self, drawing: &Drawing) {
        let bound = drawing.id_bound();
        self.ends_of.resize(bound, NO_ENDS);
        self.contour_of.resize(bound, NO_KEY);
        self.piece_of.resize(bound, 0);
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

    /// One contour of each cell about a point in which there are any: the others there are of its group.
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

    /// Groups and chains `entities`, which come in machining order and hold whole groups. Returns the new contours.
    fn chain(&mut self, drawing: &Drawing, entities: &[EntityId]) -> Vec<Key> {
        let joints = Joints::new(drawing, self.cells, entities, &self.ends_of);
        let linked = Linked::new(drawing, entities, &self.ends_of, &joints);
        let mut new = Vec::with_capacity(linked.ways.len());
        for way in &linked.ways {
            let key = self.fresh_key();
            let pieces = linked.pieces[way.range.clone()]
                .iter()
                .map(|&(at, reversed)| (entities[at as usize], reversed));
            let mut contour = Contour::new(drawing, pieces, way.closed);
            contour.double_of = way.double_of.map(|kept| entities[kept as usize]);
            for (place, piece) in (0..).zip(&contour.pieces) {
                self.contour_of[piece.entity.0 as usize] = key;
                self.piece_of[piece.entity.0 as usize] = place;
            }
            self.contours.insert(
                key,
                Chain {
                    contour,
                    first: entities[way.first as usize],
                    by_ends: way.by_ends,
                },
            );
            new.push(key);
        }
        for (one, other) in self.neighbours(entities, &joints) {
            self.unite(one, other);
        }
        new
    }

    /// Contours with an end in one cell, or in cells beside each other near the border.
    fn neighbours(&self, entities: &[EntityId], joints: &Joints) -> Vec<(Key, Key)> {
        let mut neighbours = Vec::new();
        let at = |end: End| {
            let id = entities[end.entity() as usize];
            (
                end.of(self.ends_of[id.0 as usize]),
                self.contour_of[id.0 as usize],
            )
        };
        let mut cells: Vec<(Cell, Key)> = Vec::new();
        for list in joints.lists() {
            cells.clear();
            for end in list {
                let (place, key) = at(end);
                let mut about = self.cells.about(place);
                let Some(own) = about.next() else { continue };
                match cells.iter_mut().find(|(cell, _)| *cell == own) {
                    Some((_, last)) if *last == key => {}
                    Some((_, last)) => neighbours.push((std::mem::replace(last, key), key)),
                    None => cells.push((own, key)),
                }
                for beside in about {
                    // All others there are of its group.
                    let other = joints
                        .of_cell(beside)
                        .map(at)
                        .find(|(place, _)| self.cells.of(*place) == beside);
                    neighbours.extend(
                        other
                            .filter(|(_, other)| *other != key)
                            .map(|(_, other)| (other, key)),
                    );
                }
            }
        }
        neighbours
    }

    /// Makes one group of those of two contours: the larger takes in the smaller.
    fn unite(&mut self, one: Key, other: Key) {
        let group = |contour: Key| self.group_of.get(&contour).copied();
        let (larger, smaller) = match (group(one), group(other)) {
            (Some(one), Some(other)) if one == other => return,
            (Some(one), Some(other)) => {
                let size = |group: Key| self.groups.get(&group).map_or(0, Vec::len);
                let (larger, smaller) = if size(one) >= size(other) {
                    (one, other)
                } else {
                    (other, one)
                };
                (larger, self.groups.remove(&smaller).unwrap_or_default())
            }
            (Some(group), None) => (group, vec![other]),
            (None, Some(group)) => (group, vec![one]),
            (None, None) => (self.fresh_key(), vec![one, other]),
        };
        for &contour in &smaller {
            self.group_of.insert(contour, larger);
        }
        self.groups.entry(larger).or_default().extend(smaller);
    }
}

/// A contour among the pieces of all.
struct Way {
    range: Range<usize>,
    closed: bool,
    /// The first of its entities in machining order, by number.
    first: u32,
    by_ends: bool,
    /// The entity in the same place that is chained, by number.
    double_of: Option<u32>,
}

/// What is joined to what: entities by number, in order of travel, and whether each is travelled against its own direction.
#[derive(Default)]
struct Linked {
    pieces: Vec<(u32, bool)>,
    ways: Vec<Way>,
}

impl Linked {
    fn new(drawing: &Drawing, entities: &[EntityId], ends_of: &[Ends], joints: &Joints) -> Linked {
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
            if closed || joints.is_lone(start) && joints.is_lone(end) {
                // Two that close a loop may come to lie on each other.
                let by_ends = !(closed && pieces.len() == 2
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
            let about = [start, end].map(|end| joints.place(end));
            let leads_round = pieces.len() == 1 && joints.leads_round(head);
            let is_crumb = !leads_round
                && joints.distance(start, end) <= joints.join()
                && pieces
                    .iter()
                    .all(|(at, _)| about.iter().all(|&about| joints.is_crumb(*at, about)));
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

    /// The entities through `first` that follow each other without a choice, in its direction. True where they lead round.
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

    /// Makes a contour of the pieces from `begin` on: in the direction of its first entity, and beginning with it where it is closed.
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

/// Role that the entities of a contour state, or what they are drawn on or in: that of the first piece which has one.
pub fn stated_role(
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

fn free_ends(drawing: &Drawing, id: EntityId) -> Option<Ends> {
    drawing.get(id)?.geometry.ends()
}

#[cfg(test)]
mod tests {
    use super::super::joints::CROWD;
    use super::*;
    use crate::drawing::{Entity, Geometry, Vertex};
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    type Coordinates = (f64, f64, f64, f64);

    fn lines(lines: &[Coordinates]) -> Drawing {
        let mut drawing = Drawing::new(None);
        for (i, &(x0, y0, x1, y1)) in lines.iter().enumerate() {
            let geometry = Geometry::Line {
                start: Point::new(x0, y0),
                end: Point::new(x1, y1),
            };
            drawing.push(Entity {
                handle: format!("{i}").into(),
                layer: "0".into(),
                role: None,
                kind: crate::drawing::Kind::Line,
                geometry,
            });
        }
        drawing
    }

    /// Contours as text, in machining order: entity numbers in order of travel, `'` where reversed, `o` where closed.
    fn check(input: &[Coordinates], expected: &[&str]) {
        let drawing = lines(input);
        let chains = Chains::new(&drawing, 0.01, &|_| true);
        let mut keys: Vec<Key> = drawing
            .order()
            .iter()
            .filter_map(|&id| chains.contour_of(id))
            .collect();
        keys.dedup();
        keys.sort_unstable_by_key(|key| {
            chains
                .get(*key)
                .map(|contour| contour.pieces.iter().map(|piece| piece.entity).min())
        });
        keys.dedup();
        let text = |key: &Key| {
            let contour = chains.get(*key).unwrap();
            let pieces = contour
                .pieces
                .iter()
                .map(|p| format!("{}{}", p.entity.0, if p.reversed { "'" } else { "" }));
            pieces.collect::<Vec<_>>().join(" ") + if contour.closed { " o" } else { "" }
        };
        assert_eq!(keys.iter().map(text).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn a_square_out_of_order_and_half_turned_about_is_one_loop() {
        check(
            &[
                (0.0, 0.0, 1.0, 0.0),
                (1.0, 1.0, 0.0, 1.0),
                (1.0, 1.0, 1.0, 0.0),
                (0.0, 0.0, 0.0, 1.0),
            ],
            &["0 2' 1 3' o"],
        );
    }

    #[test]
    fn gaps_up_to_the_tolerance_are_joined_and_wider_ones_are_not() {
        check(
            &[
                (0.0, 0.0, 1.0, 0.0),
                (1.009, 0.0, 1.0, 1.0),
                (1.0, 1.0, 0.0, 0.0),
            ],
            &["0 1 2 o"],
        );
        check(
            &[
                (0.0, 0.0, 1.0, 0.0),
                (1.02, 0.0, 1.0, 1.0),
                (1.0, 1.0, 0.0, 0.0),
            ],
            &["1 2 0"],
        );
    }

    #[test]
    fn two_loops_that_touch_in_a_point_stay_two() {
        let (one, other) = (
            [
                (0.0, 0.0, 1.0, 0.0),
                (1.0, 0.0, 0.0, 1.0),
                (0.0, 1.0, 0.0, 0.0),
            ],
            [
                (0.0, 0.0, -1.0, 0.0),
                (-1.0, 0.0, 0.0, -1.0),
                (0.0, -1.0, 0.0, 0.0),
            ],
        );
        check(&[one, other].concat(), &["0 1 2 o", "3 4 5 o"]);
    }

    #[test]
    fn a_lead_line_is_no_part_of_the_loop_that_it_leads_to() {
        check(
            &[
                (2.0, 0.0, 1.0, 0.0),
                (1.0, 0.0, 0.0, 1.0),
                (0.0, 1.0, -1.0, 0.0),
                (-1.0, 0.0, 1.0, 0.0),
            ],
            &["0", "1 2 3 o"],
        );
    }

    #[test]
    fn a_line_shorter_than_the_tolerance_is_not_skipped() {
        check(
            &[
                (0.0, 0.0, 1.0, 0.0),
                (1.0, 0.0, 1.005, 0.0),
                (1.005, 0.0, 1.0, 1.0),
                (1.0, 1.0, 0.0, 0.0),
            ],
            &["0 1 2 3 o"],
        );
        check(&[(0.0, 0.0, 0.005, 0.0)], &["0"]);
    }

    /// Handles of the entities of each contour, and whether it is closed.
    type Sets = BTreeSet<(BTreeSet<String>, bool)>;

    /// The contours of lines and, by bulge, arcs, drawn in an order; what is what, the handles say.
    fn sets(shapes: &[(f64, f64, f64, f64, f64)], order: &[usize]) -> Sets {
        let mut drawing = Drawing::new(None);
        for &number in order {
            let (x0, y0, x1, y1, bulge) = shapes[number];
            let vertices = vec![Vertex::new(x0, y0, bulge), Vertex::new(x1, y1, 0.0)];
            let geometry = match bulge {
                0.0 => Geometry::Line {
                    start: Point::new(x0, y0),
                    end: Point::new(x1, y1),
                },
                _ => Geometry::Polyline {
                    closed: false,
                    vertices,
                },
            };
            let kind = crate::drawing::Kind::Line;
            drawing.push(Entity {
                handle: format!("{number}").into(),
                layer: "0".into(),
                role: None,
                kind,
                geometry,
            });
        }
        let chains = Chains::new(&drawing, 0.01, &|_| true);
        let handle = |piece: &Piece| drawing.get(piece.entity).unwrap().handle.to_string();
        let set = |key: Key| {
            chains
                .get(key)
                .map(|contour| (contour.pieces.iter().map(handle).collect(), contour.closed))
        };
        let sets: Sets = chains.keys().filter_map(set).collect();
        assert_eq!(
            sets.iter().map(|(handles, _)| handles.len()).sum::<usize>(),
            shapes.len(),
            "each entity in one contour"
        );
        sets
    }

    fn permutations(count: usize) -> Vec<Vec<usize>> {
        let mut all = vec![Vec::new()];
        for number in 0..count {
            all = all
                .iter()
                .flat_map(|begun: &Vec<usize>| {
                    (0..=number).map(move |at| {
                        let mut order = begun.clone();
                        order.insert(at, number);
                        order
                    })
                })
                .collect();
        }
        all
    }

    /// Closed contours as text, the same in every order of up to seven entities, each line also with its ends exchanged.
    #[track_caller]
    fn check_in_every_order(shapes: &[(f64, f64, f64, f64, f64)], closed: &[&str]) {
        let first = sets(shapes, &(0..shapes.len()).collect::<Vec<_>>());
        let loops: Vec<String> = first
            .iter()
            .filter(|(_, closed)| *closed)
            .map(|(handles, _)| handles.iter().cloned().collect::<Vec<_>>().join(" "))
            .collect();
        assert_eq!(loops, closed, "{first:?}");
        for order in permutations(shapes.len()) {
            assert_eq!(sets(shapes, &order), first, "{order:?}");
        }
        let counts = |sets: &Sets| {
            sets.iter()
                .map(|(handles, closed)| (handles.len(), *closed))
                .collect::<BTreeSet<_>>()
        };
        for turned in 0..shapes.len() {
            let mut shapes = shapes.to_vec();
            let (x0, y0, x1, y1, bulge) = shapes[turned];
            shapes[turned] = (x1, y1, x0, y0, -bulge);
            assert_eq!(
                counts(&sets(&shapes, &(0..shapes.len()).collect::<Vec<_>>())),
                counts(&first),
                "{turned} turned round"
            );
        }
    }

    const SQUARE: [(f64, f64, f64, f64, f64); 4] = [
        (0.0, 0.0, 10.0, 0.0, 0.0),
        (10.0, 0.0, 10.0, 10.0, 0.0),
        (10.0, 10.0, 0.0, 10.0, 0.0),
        (0.0, 10.0, 0.0, 0.0, 0.0),
    ];

    #[test]
    fn a_double_does_not_spoil_an_outline_in_any_order() {
        let with = |others: &[(f64, f64, f64, f64, f64)]| [&SQUARE[..], others].concat();
        check_in_every_order(&with(&[(10.0, 0.0, 0.0, 0.0, 0.0)]), &["0 1 2 3"]);
        check_in_every_order(
            &with(&[(0.0, 0.0, 10.0, 0.0, 0.0), (0.0, 0.0, 10.0, 0.0, 0.0)]),
            &["0 1 2 3"],
        );
        check_in_every_order(
            &with(&[(0.0, 0.003, 10.0, 0.002, 0.0), (10.0, 10.0, 10.0, 0.0, 0.0)]),
            &["0 1 2 3"],
        );
        // The one that lies off is not the one that is chained.
        check_in_every_order(
            &[
                (0.0, -0.004, 10.0, -0.004, 0.0),
                SQUARE[1],
                SQUARE[2],
                SQUARE[3],
                SQUARE[0],
            ],
            &["1 2 3 4"],
        );
        // Two lines in one place alone, and two arcs on one chord: a double, and a circle.
        check_in_every_order(&[SQUARE[0], SQUARE[0]], &[]);
        check_in_every_order(
            &[
                (0.0, 0.0, 10.0, 0.0, 1.0),
                (10.0, 0.0, 0.0, 0.0, 1.0),
                (0.0, 0.0, 10.0, 0.0, 1.0),
            ],
            &["0 1"],
        );
        // Everything twice.
        check_in_every_order(
            &[
                SQUARE[0],
                SQUARE[1],
                (10.0, 10.0, 0.0, 0.0, 0.0),
                SQUARE[0],
                SQUARE[1],
                (0.0, 0.0, 10.0, 10.0, 0.0),
            ],
            &["0 1 2"],
        );
    }

    #[test]
    fn a_line_off_a_corner_does_not_spoil_an_outline_in_any_order() {
        let with = |others: &[(f64, f64, f64, f64, f64)]| [&SQUARE[..], others].concat();
        check_in_every_order(&with(&[(10.0, 10.0, 15.0, 12.0, 0.0)]), &["0 1 2 3"]);
        check_in_every_order(&with(&[(0.0, 0.0, 3.0, 3.0, 0.0)]), &["0 1 2 3"]);
        check_in_every_order(
            &with(&[
                (10.0, 10.0, 15.0, 12.0, 0.0),
                (15.0, 12.0, 20.0, 12.0, 0.4),
                (0.0, 0.0, -3.0, 0.0, 0.0),
            ]),
            &["0 1 2 3"],
        );
        // Off a corner whose own ends are a little apart.
        check_in_every_order(
            &[
                (0.005, 0.0, 10.0, 0.0, 0.0),
                SQUARE[1],
                SQUARE[2],
                SQUARE[3],
                (0.0, 0.0, -5.0, 1.0, 0.0),
            ],
            &["0 1 2 3"],
        );
        // Across: the outline is what closes.
        check_in_every_order(&with(&[(0.0, 0.0, 10.0, 10.0, 0.0)]), &["0 1 2 3"]);
        check_in_every_order(
            &with(&[(0.0, 0.0, 10.0, 10.0, 0.2), (0.0, 10.0, -4.0, 14.0, 0.0)]),
            &["0 1 2 3"],
        );
        // Two triangles in one point, and with a bridge between them.
        let triangles = [
            (0.0, 0.0, 4.0, 2.0, 0.0),
            (4.0, 2.0, 4.0, -2.0, 0.0),
            (4.0, -2.0, 0.0, 0.0, 0.0),
            (0.0, 0.0, -4.0, 2.0, 0.0),
            (-4.0, 2.0, -4.0, -2.0, 0.0),
            (-4.0, -2.0, 0.0, 0.0, 0.0),
        ];
        check_in_every_order(&triangles, &["0 1 2", "3 4 5"]);
        let apart = triangles.map(|(x0, y0, x1, y1, bulge)| {
            if x0 + x1 > 0.0 {
                (x0 + 5.0, y0, x1 + 5.0, y1, bulge)
            } else {
                (x0, y0, x1, y1, bulge)
            }
        });
        check_in_every_order(
            &[&apart[..], &[(0.0, 0.0, 5.0, 0.0, 0.0)]].concat(),
            &["0 1 2", "3 4 5"],
        );
        // Rounded coordinates where two loops meet.
        let rounded = triangles.map(|(x0, y0, x1, y1, bulge)| {
            (x0 + 4e-7 * (y1 - x1), y0, x1, y1 + 3e-7 * (x0 - y0), bulge)
        });
        check_in_every_order(&rounded, &["0 1 2", "3 4 5"]);
    }

    #[test]
    fn crumbs_and_notches_narrower_than_the_tolerance_stay_in_their_outline_in_any_order() {
        check_in_every_order(
            &[
                (0.0, 0.0, 1.0, 0.0, 0.0),
                (1.0, 0.0, 1.005, 0.0, 0.0),
                (1.005, 0.0, 1.0, 1.0, 0.0),
                (1.0, 1.0, 0.0, 0.0, 0.0),
            ],
            &["0 1 2 3"],
        );
        check_in_every_order(
            &[
                SQUARE[0],
                SQUARE[1],
                SQUARE[2],
                (0.0, 10.0, 0.0, 0.008, 0.0),
                (0.0, 0.008, 5.0, 0.002, 0.0),
                (5.0, 0.002, 0.0, 0.0, 0.0),
            ],
            &["0 1 2 3 4 5"],
        );
        // A triangle of crumbs.
        check_in_every_order(
            &[
                (0.0, 0.0, 0.006, 0.0, 0.0),
                (0.006, 0.0, 0.0, 0.006, 0.0),
                (0.0, 0.006, 0.0, 0.0, 0.0),
            ],
            &["0 1 2"],
        );
    }

    /// So many lines from nearly one point outward, and a triangle with a corner there.
    fn star(count: usize) -> Drawing {
        let line = |number: usize| {
            let angle = number as f64 * 0.003;
            let (x, y) = (
                1.001 + 0.0001 * (number % 7) as f64,
                1.001 + 0.0001 * (number % 11) as f64,
            );
            (x, y, x + 9.0 * angle.cos(), y + 9.0 * angle.sin())
        };
        let triangle = [
            (1.001, 1.001, -5.0, 1.0),
            (-5.0, 1.0, -5.0, -5.0),
            (-5.0, -5.0, 1.0012, 1.0011),
        ];
        lines(&(0..count).map(line).chain(triangle).collect::<Vec<_>>())
    }

    fn pieces(drawing: &Drawing, chains: &Chains) -> Vec<Vec<(EntityId, bool)>> {
        let mut keys: Vec<Key> = chains.keys().collect();
        keys.sort_unstable_by_key(|&key| drawing.rank(chains.first_of(key).unwrap()));
        let pieces = |key| {
            chains
                .get(key)
                .unwrap()
                .pieces
                .iter()
                .map(|piece| (piece.entity, piece.reversed))
                .collect()
        };
        keys.into_iter().map(pieces).collect()
    }

    #[test]
    fn thousands_of_ends_nearly_in_one_point_are_chained_in_machining_order() {
        let drawing = star(2 * CROWD);
        let chains = Chains::new(&drawing, 0.01, &|_| true);
        let id = |number: usize| EntityId(number as u32);
        let pair = |pair: usize| vec![(id(2 * pair + 1), true), (id(2 * pair), false)];
        let mut expected: Vec<Vec<(EntityId, bool)>> = (0..CROWD).map(pair).collect();
        expected.push(
            [0, 1, 2]
                .map(|number| (id(2 * CROWD + number), false))
                .to_vec(),
        );
        let found = pieces(&drawing, &chains);
        let differs = (0..)
            .zip(&found)
            .zip(&expected)
            .find(|((_, found), expected)| found != expected);
        assert!(
            found.len() == expected.len() && differs.is_none(),
            "{} contours, {differs:?}",
            found.len()
        );
        assert!(
            chains
                .keys()
                .filter(|&key| chains.get(key).unwrap().closed)
                .count()
                == 1
        );
    }

    #[test]
    fn an_edit_among_thousands_of_ends_chains_them_as_a_fresh_start_does() {
        let mut drawing = star(CROWD + 40);
        let mut chains = Chains::new(&drawing, 0.01, &|_| true);
        for number in [3, CROWD as u32, 17] {
            drawing.remove(EntityId(number));
            chains.update(&drawing, &[EntityId(number)], &|_| true);
            let fresh = Chains::new(&drawing, 0.01, &|_| true);
            assert!(
                pieces(&drawing, &chains) == pieces(&drawing, &fresh),
                "without entity {number}"
            );
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

        /// Lines and arcs between a few places, some of them a little apart, in other orders.
        #[test]
        fn contours_do_not_depend_on_the_order_of_entities(
            shapes in prop::collection::vec(((0..3usize, 0..3usize, 0..5usize), (0..3usize, 0..3usize, 0..5usize), 0..6usize), 1..24),
            orders in prop::collection::vec(prop::collection::vec(any::<prop::sample::Index>(), 24), 6),
        ) {
            let off = |number: usize| [0.0, 0.0, 0.004, -0.003, 4e-7][number];
            type Grid = (usize, usize, usize);
            let shape = |&(from, to, bulge): &(Grid, Grid, usize)| {
                let place = |(x, y, n): Grid| (x as f64 * 3.0 + off(n), y as f64 * 2.0 - off((n + 2) % 5));
                let ((x0, y0), (x1, y1)) = (place(from), place(to));
                (x0, y0, x1, y1, [0.0, 0.0, 0.0, 0.3, -0.3, 1.5][bulge])
            };
            let shapes: Vec<_> = shapes.iter().map(shape).filter(|(x0, y0, x1, y1, _)| (x0, y0) != (x1, y1)).collect();
            let first = sets(&shapes, &(0..shapes.len()).collect::<Vec<_>>());
            for picks in orders {
                let mut rest: Vec<usize> = (0..shapes.len()).collect();
                let order: Vec<usize> = picks.iter().map_while(|pick| (!rest.is_empty()).then(|| rest.swap_remove(pick.index(rest.len())))).collect();
                prop_assert_eq!(&sets(&shapes, &order), &first, "{:?} {:?}", order, shapes);
            }
        }

        /// Ends on a few places, some of them a little apart; the first lie on borders of cells.
        #[test]
        fn contours_with_ends_near_each_other_are_of_one_group(
            lines in prop::collection::vec(((0..3usize, 0..4usize), (0..3usize, 0..4usize)), 1..14),
        ) {
            let place = |(at, off): (usize, usize)| at as f64 + [0.0, 0.004, -1e-16, 0.009][off];
            let lines: Vec<Coordinates> = lines.into_iter().map(|(from, to)| (place(from), 0.0, place(to), 0.0)).collect();
            let drawing = self::lines(&lines);
            let chains = Chains::new(&drawing, 0.01, &|_| true);
            let ends: Vec<(EntityId, Point)> =
                drawing.order().iter().filter_map(|&id| Some((id, chains.ends_of(id)?))).flat_map(|(id, (a, b))| [(id, a), (id, b)]).collect();
            for (one, at) in &ends {
                for (other, there) in ends.iter().filter(|(_, there)| (at - there).norm() <= 0.01) {
                    let [a, b] = [one, other].map(|id| chains.contour_of(*id).unwrap());
                    let group = |key: Key| chains.group_of.get(&key);
                    prop_assert!(a == b || (group(a).is_some() && group(a) == group(b)), "{one:?} at {at} and {other:?} at {there}");
                }
            }
        }
    }
}
