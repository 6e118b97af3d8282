//! Chaining entities to contours by their end points.
//!
//! Closed entities are contours of their own. The others are joined end to end within the join tolerance, across kinds
//! and layers. A *group* is what hangs together through ends that lie near each other: groups are chained independently of each
//! other, so an edit chains again only the groups that it touches, and the result is that of a fresh start.

use super::ends::{Buckets, Cell, Cells, End, Ends, NO_ENDS, Numbered, Visit, has_ends};
use super::{Contour, Drawing, EntityId, Piece, Role};
use crate::geometry::Point;
use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};

/// Up to so many entities are put in order without a look at all others.
const FEW: usize = 16;
/// The ends of fewer than one in so many entities are moved one by one; of more, all are sorted into cells again.
const BULK: usize = 8;

/// Of more ends than these in one cell of the plane the nearest is not sought: the first one within the join tolerance, in machining
/// order, goes on. A drawing to be cut has a few.
const CROWD: usize = 1000;

/// Of the ends that are left in such a cell no more than these are looked at.
const LOOKS: usize = 64;

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
        let entities: Vec<EntityId> = drawing.order().iter().copied().filter(|&id| is_cut(id)).collect();
        let ends: Vec<Ends> = entities.par_iter().map(|&id| free_ends(drawing, id).unwrap_or(NO_ENDS)).collect();
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
        self.contour_of.get(entity.0 as usize).copied().filter(|&key| key != NO_KEY)
    }

    fn ends_of(&self, entity: EntityId) -> Option<Ends> {
        self.ends_of.get(entity.0 as usize).copied().filter(has_ends)
    }

    /// The piece of a contour that an entity is.
    pub fn piece_of(&self, entity: EntityId) -> Option<Piece> {
        let contour = self.get(self.contour_of(entity)?)?;
        let place = *self.piece_of.get(entity.0 as usize)?;
        contour.pieces.get(place as usize).filter(|piece| piece.entity == entity).copied()
    }

    /// The contour that holds a segment of an entity, and its index in there.
    pub fn index_of(&self, entity: EntityId, segment: usize) -> Option<(Key, usize)> {
        Some((self.contour_of(entity)?, self.piece_of(entity)?.index_of(segment)?))
    }

    /// Keys of all contours, in no order.
    pub fn keys(&self) -> impl Iterator<Item = Key> + '_ {
        self.contours.keys().copied()
    }

    /// True when an entity's free ends have not moved, so that the contours stand as they are. Never for an entity whose own
    /// ends touch: whether it comes back to itself depends on what lies between them.
    pub fn same_ends(&self, drawing: &Drawing, entity: EntityId, is_cut: bool) -> bool {
        let known = self.ends_of(entity);
        let now = if is_cut { free_ends(drawing, entity) } else { None };
        let chained = self.contour_of(entity).is_some();
        let touching = now.is_some_and(|(start, end)| (end - start).norm() <= self.cells.join);
        known == now && !touching && chained == (is_cut && drawing.get(entity).is_some_and(|entity| entity.geometry.segment_count() > 0))
    }

    /// The number of segments of an entity has changed: its contour counts them anew.
    pub fn recount(&mut self, drawing: &Drawing, entity: EntityId) {
        let Some(Chain { contour, .. }) = self.contour_of(entity).and_then(|key| self.contours.get_mut(&key)) else { return };
        *contour = Contour::new(drawing, contour.pieces.iter().map(|piece| (piece.entity, piece.reversed)), contour.closed);
    }

    /// Chains again what the entities of `touched` (new, changed or removed) belonged to or belong to now.
    pub fn update(&mut self, drawing: &Drawing, touched: &[EntityId], is_cut: &dyn Fn(EntityId) -> bool) -> Rechained {
        self.grow(drawing);
        let mut entities = FxHashSet::default();
        let distinct: FxHashSet<EntityId> = touched.iter().copied().collect();
        let mut affected: FxHashSet<Key> = distinct.iter().filter_map(|&id| self.contour_of(id)).collect();
        let few = distinct.len() * BULK <= self.ends_of.len();
        let mut ends = self.ends.take().filter(|_| few);
        for &id in &distinct {
            if let (Some(old), Some(ends)) = (self.ends_of(id), &mut ends) {
                End::both(id.0).into_iter().for_each(|end| ends.remove(self.cells.of(end.of(old)), end));
            }
            self.ends_of[id.0 as usize] = NO_ENDS;
        }
        let mut ends = ends.unwrap_or_else(|| self.sorted_ends());
        ends.grow(self.ends_of.len());
        let mut fresh = Vec::new();
        for id in distinct.into_iter().filter(|&id| drawing.get(id).is_some() && is_cut(id)) {
            entities.insert(id);
            if let Some(both) = free_ends(drawing, id) {
                affected.extend([both.0, both.1].into_iter().flat_map(|point| self.contours_about(&ends, point)));
                fresh.push((id, both));
            }
        }
        for (id, both) in fresh {
            self.ends_of[id.0 as usize] = both;
            End::both(id.0).into_iter().for_each(|end| ends.insert(self.cells.of(end.of(both)), end));
        }
        self.ends = Some(if ends.is_crowded() { self.sorted_ends() } else { ends });
        for &id in touched {
            self.contour_of[id.0 as usize] = NO_KEY;
        }
        let mut rechained = Rechained::default();
        for contour in affected {
            let group = self.group_of.get(&contour).and_then(|group| self.groups.remove(group));
            for key in group.unwrap_or_else(|| vec![contour]) {
                self.group_of.remove(&key);
                let Some(chain) = self.contours.remove(&key) else { continue };
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
            End::both(id).into_iter().for_each(|end| ends.insert(self.cells.of(end.of(both)), end));
        }
        ends
    }

    fn fresh_key(&mut self) -> Key {
        self.next_key += 1;
        self.next_key
    }

    /// One contour of each cell about a point in which there are any: the others there are of its group.
    fn contours_about<'a>(&'a self, ends: &'a Buckets, point: Point) -> impl Iterator<Item = Key> + 'a {
        self.cells.about(point).filter_map(move |cell| {
            let is_here = |end: &End| self.ends_of(EntityId(end.entity())).is_some_and(|ends| self.cells.of(end.of(ends)) == cell);
            self.contour_of(EntityId(ends.of_cell(cell).find(is_here)?.entity()))
        })
    }

    /// Groups and chains `entities`, which come in machining order and hold whole groups. Returns the new contours.
    fn chain(&mut self, drawing: &Drawing, entities: &[EntityId]) -> Vec<Key> {
        let mut new = Vec::new();
        let mut loose = Loose::new(self.cells, entities, &self.ends_of);
        let mut neighbours = Vec::new();
        for (first, &id) in (0..).zip(entities) {
            let Some(geometry) = drawing.get(id).map(|entity| &entity.geometry) else { continue };
            if loose.is_taken(first) || geometry.segment_count() == 0 {
                continue;
            }
            self.next_key += 1;
            let key = self.next_key;
            let closed = match has_ends(&loose.ends_of(first)) {
                true => loose.walk(drawing, first, key),
                false => loose.take_alone(first, key),
            };
            let pieces = loose.way.iter().map(|&(at, reversed)| (entities[at as usize], reversed));
            let contour = Contour::new(drawing, pieces, closed);
            for (place, piece) in (0..).zip(&contour.pieces) {
                self.contour_of[piece.entity.0 as usize] = key;
                self.piece_of[piece.entity.0 as usize] = place;
            }
            neighbours.extend(loose.touching.drain(..).map(|other| (key, other)));
            self.contours.insert(key, Chain { contour, first: id });
            new.push(key);
        }
        neighbours.into_iter().for_each(|(one, other)| self.unite(one, other));
        new
    }

    /// Makes one group of those of two contours: the larger takes in the smaller.
    fn unite(&mut self, one: Key, other: Key) {
        let group = |contour: Key| self.group_of.get(&contour).copied();
        let (larger, smaller) = match (group(one), group(other)) {
            (Some(one), Some(other)) if one == other => return,
            (Some(one), Some(other)) => {
                let size = |group: Key| self.groups.get(&group).map_or(0, Vec::len);
                let (larger, smaller) = if size(one) >= size(other) { (one, other) } else { (other, one) };
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

/// Entities that are still to be chained, numbered in machining order, with their ends by cell.
struct Loose<'a> {
    cells: Cells,
    entities: &'a [EntityId],
    ends_of: &'a [Ends],
    /// Each list in machining order, and of one entity the start first; before them what was taken last in each cell.
    ends: Numbered,
    /// Cells with more ends than [`CROWD`], and the contour that was there last.
    crowded: FxHashMap<Cell, Key>,
    /// By number: the contour that took the entity, or [`NO_KEY`].
    taken_by: Vec<Key>,
    /// The chain at hand, in order of travel: entities, and whether they are travelled against their own direction.
    way: Vec<(u32, bool)>,
    /// Contours that the chain at hand has an end near.
    touching: Vec<Key>,
}

impl<'a> Loose<'a> {
    fn new(cells: Cells, entities: &'a [EntityId], ends_of: &'a [Ends]) -> Loose<'a> {
        let count = entities.len();
        let ends = Numbered::new(count);
        let mut loose = Loose {
            cells,
            entities,
            ends_of,
            ends,
            crowded: FxHashMap::default(),
            taken_by: vec![NO_KEY; count],
            way: Vec::new(),
            touching: Vec::new(),
        };
        for at in (0..count as u32).rev() {
            let ends = loose.ends_of(at);
            if has_ends(&ends) {
                End::both(at).into_iter().rev().for_each(|end| loose.ends.insert(cells.of(end.of(ends)), end));
            }
        }
        let mut counts: FxHashMap<Cell, usize> = FxHashMap::default();
        let place_of = |end: End| end.of(ends_of[entities[end.entity() as usize].0 as usize]);
        loose.ends.of_long_lists(CROWD).for_each(|end| *counts.entry(cells.of(place_of(end))).or_default() += 1);
        loose.crowded = counts.into_iter().filter(|(_, count)| *count > CROWD).map(|(cell, _)| (cell, NO_KEY)).collect();
        loose
    }

    fn ends_of(&self, at: u32) -> Ends {
        self.entities.get(at as usize).and_then(|id| self.ends_of.get(id.0 as usize)).copied().unwrap_or(NO_ENDS)
    }

    fn is_taken(&self, at: u32) -> bool {
        self.taken_by.get(at as usize).is_none_or(|&key| key != NO_KEY)
    }

    fn take(&mut self, at: u32, key: Key) {
        if let Some(taken) = self.taken_by.get_mut(at as usize) {
            *taken = key;
        }
    }

    /// A chain of one closed entity.
    fn take_alone(&mut self, first: u32, key: Key) -> bool {
        self.take(first, key);
        self.way.clear();
        self.way.push((first, false));
        true
    }

    /// Takes an entity that goes on from `tip` with one of its ends; gives back where its other end leads to.
    fn follow(&mut self, end: End, tip: Point, key: Key) -> End {
        self.take(end.entity(), key);
        if !self.cells.are_one(self.place_of(end), tip) {
            // What is near its end need not be near the tip.
            self.next(end, key);
        }
        end.other()
    }

    /// True in a cell with so many ends that all within the join tolerance count as equally near.
    fn is_crowded(&self, cell: Cell) -> bool {
        !self.crowded.is_empty() && self.crowded.contains_key(&cell)
    }

    fn place_of(&self, end: End) -> Point {
        end.of(self.ends_of(end.entity()))
    }

    /// The chain through `first`, in its direction: forward to a free end or back to its start, else backward too. True where
    /// it is closed.
    fn walk(&mut self, drawing: &Drawing, first: u32, key: Key) -> bool {
        self.take_alone(first, key);
        let [tail, mut tip] = End::both(first);
        let start = self.place_of(tail);
        loop {
            let here = self.place_of(tip);
            let mut home = self.cells.distance(here, start);
            if home <= self.cells.join && self.is_crowded(self.cells.of(start)) {
                home = 0.0;
            }
            let next = self.next(tip, key);
            let closes = home <= self.cells.join && next.is_none_or(|(_, distance)| home <= distance);
            if closes && (self.way.len() > 1 || comes_back(drawing, self.entities[first as usize])) {
                if !self.cells.are_one(here, start) {
                    self.next(tail, key);
                }
                return true;
            }
            let Some((end, _)) = next else { break };
            self.way.push((end.entity(), !end.is_start()));
            tip = self.follow(end, here, key);
        }
        let forward = self.way.len();
        let mut tip = tail;
        while let Some((end, _)) = self.next(tip, key) {
            // Travelled towards the chain: its own end meets the tip when it is not reversed.
            self.way.push((end.entity(), end.is_start()));
            let here = self.place_of(tip);
            tip = self.follow(end, here, key);
        }
        self.way[forward..].reverse();
        self.way.rotate_left(forward);
        false
    }

    /// The open end that continues the chain at its tip, an end of an entity that is taken: the nearest; of equally near ones, as all
    /// in a crowded cell are, that of the entity that follows in machining order. Contours that have an end in a cell about the tip are noted as touching.
    ///
    /// The tip comes to stand before all others of its cell, so that whoever looks there next is told of the chain at hand first.
    /// What else is taken goes from there, and nobody looks at it again.
    fn next(&mut self, tip: End, key: Key) -> Option<(End, f64)> {
        let (place, here) = (self.place_of(tip), tip.entity());
        let mut best: Option<(End, f64)> = None;
        // Those before `here` come after all that follow it.
        let after = |end: End| end.entity().wrapping_sub(here);
        let own = self.cells.of(place);
        for cell in self.cells.about(place) {
            let is_crowded = self.is_crowded(cell);
            let Loose { cells, entities, ends_of, ends, taken_by, touching, crowded, .. } = self;
            // Whoever looks into a crowded cell need not come as far as to an end that is taken.
            if let Some(last) = crowded.get_mut(&cell).filter(|_| is_crowded) {
                if ![NO_KEY, key].contains(last) && touching.last() != Some(&*last) {
                    touching.push(*last);
                }
                if cell == own {
                    *last = key;
                }
            }
            let (mut looked_at, mut gave_up, mut passed_tip, mut met_taken) = (0, false, false, false);
            let look = |end: End| {
                let at = end.entity() as usize;
                let point = end.of(ends_of[entities[at].0 as usize]);
                if taken_by[at] != NO_KEY {
                    if cells.of(point) != cell {
                        return Visit::Next;
                    }
                    if taken_by[at] != key && touching.last() != Some(&taken_by[at]) {
                        touching.push(taken_by[at]);
                    }
                    passed_tip |= end == tip;
                    // One that is taken stays in the cells about, for those who look there next.
                    return if cell == own || std::mem::replace(&mut met_taken, true) { Visit::Remove } else { Visit::Next };
                }
                if is_crowded && cells.of(point) == cell {
                    looked_at += 1;
                    if looked_at > LOOKS {
                        gave_up = true;
                        return Visit::Stop;
                    }
                }
                let distance = cells.distance(point, place);
                if distance > cells.join {
                    return Visit::Next;
                }
                let distance = if is_crowded { 0.0 } else { distance };
                let better = |(other, near): (End, f64)| {
                    distance.total_cmp(&near).then(after(end).cmp(&after(other))).then(other.is_start().cmp(&end.is_start())).is_lt()
                };
                if best.is_none_or(better) {
                    best = Some((end, distance));
                }
                // Nothing is nearer, and what comes later in the list is later in machining order. The tip came before it.
                if distance == 0.0 && end.entity() > here { Visit::Stop } else { Visit::Next }
            };
            if cell == own {
                ends.visit_about(tip, look);
                // Where the look did not come so far, the tip may still stand in its place.
                if passed_tip || !gave_up {
                    ends.insert_again(tip);
                }
            } else {
                ends.visit(cell, look);
            }
        }
        best
    }
}

/// Role that the entities of a contour state, or what they are drawn on or in: that of the first piece which has one.
pub fn stated_role(contour: &Contour, of_entity: &dyn Fn(EntityId) -> Option<Role>) -> Option<Role> {
    contour.pieces.iter().find_map(|piece| of_entity(piece.entity))
}

fn in_machining_order(drawing: &Drawing, entities: FxHashSet<EntityId>) -> Vec<EntityId> {
    if entities.len() <= FEW {
        let mut ordered: Vec<EntityId> = entities.into_iter().collect();
        ordered.sort_unstable_by_key(|&id| drawing.rank(id));
        return ordered;
    }
    let mut wanted = vec![false; drawing.id_bound()];
    entities.iter().for_each(|id| wanted[id.0 as usize] = true);
    drawing.order().iter().copied().filter(|id| wanted[id.0 as usize]).collect()
}

/// True when an open entity whose ends touch really leads round, and is not just shorter than the join tolerance.
fn comes_back(drawing: &Drawing, id: EntityId) -> bool {
    let Some(geometry) = drawing.get(id).map(|entity| &entity.geometry) else { return false };
    geometry.segment_count() > 2 || geometry.segments_of(drawing.flat()).any(|segment| segment.as_arc().is_some_and(|arc| !arc.is_minor()))
}

fn free_ends(drawing: &Drawing, id: EntityId) -> Option<Ends> {
    drawing.get(id)?.geometry.ends()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Entity, Geometry};
    use proptest::prelude::*;

    type Coordinates = (f64, f64, f64, f64);

    fn lines(lines: &[Coordinates]) -> Drawing {
        let mut drawing = Drawing::new(None);
        for (i, &(x0, y0, x1, y1)) in lines.iter().enumerate() {
            let geometry = Geometry::Line { start: Point::new(x0, y0), end: Point::new(x1, y1) };
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
        let mut keys: Vec<Key> = drawing.order().iter().filter_map(|&id| chains.contour_of(id)).collect();
        keys.dedup();
        keys.sort_unstable_by_key(|key| chains.get(*key).map(|contour| contour.pieces.iter().map(|piece| piece.entity).min()));
        keys.dedup();
        let text = |key: &Key| {
            let contour = chains.get(*key).unwrap();
            let pieces = contour.pieces.iter().map(|p| format!("{}{}", p.entity.0, if p.reversed { "'" } else { "" }));
            pieces.collect::<Vec<_>>().join(" ") + if contour.closed { " o" } else { "" }
        };
        assert_eq!(keys.iter().map(text).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn a_square_out_of_order_and_half_turned_about_is_one_loop() {
        check(&[(0.0, 0.0, 1.0, 0.0), (1.0, 1.0, 0.0, 1.0), (1.0, 1.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0)], &["0 2' 1 3' o"]);
    }

    #[test]
    fn gaps_up_to_the_tolerance_are_joined_and_wider_ones_are_not() {
        check(&[(0.0, 0.0, 1.0, 0.0), (1.009, 0.0, 1.0, 1.0), (1.0, 1.0, 0.0, 0.0)], &["0 1 2 o"]);
        check(&[(0.0, 0.0, 1.0, 0.0), (1.02, 0.0, 1.0, 1.0), (1.0, 1.0, 0.0, 0.0)], &["1 2 0"]);
    }

    #[test]
    fn two_loops_that_touch_in_a_point_stay_two() {
        let (one, other) = (
            [(0.0, 0.0, 1.0, 0.0), (1.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 0.0)],
            [(0.0, 0.0, -1.0, 0.0), (-1.0, 0.0, 0.0, -1.0), (0.0, -1.0, 0.0, 0.0)],
        );
        check(&[one, other].concat(), &["0 1 2 o", "3 4 5 o"]);
    }

    #[test]
    fn a_lead_line_into_a_loop_is_followed_in_machining_order() {
        check(&[(2.0, 0.0, 1.0, 0.0), (1.0, 0.0, 0.0, 1.0), (0.0, 1.0, -1.0, 0.0), (-1.0, 0.0, 1.0, 0.0)], &["0 1 2 3"]);
    }

    #[test]
    fn a_line_shorter_than_the_tolerance_is_not_skipped() {
        check(&[(0.0, 0.0, 1.0, 0.0), (1.0, 0.0, 1.005, 0.0), (1.005, 0.0, 1.0, 1.0), (1.0, 1.0, 0.0, 0.0)], &["0 1 2 3 o"]);
        check(&[(0.0, 0.0, 0.005, 0.0)], &["0"]);
    }

    /// So many lines from nearly one point outward, and a triangle with a corner there.
    fn star(count: usize) -> Drawing {
        let line = |number: usize| {
            let angle = number as f64 * 0.003;
            let (x, y) = (1.001 + 0.0001 * (number % 7) as f64, 1.001 + 0.0001 * (number % 11) as f64);
            (x, y, x + 9.0 * angle.cos(), y + 9.0 * angle.sin())
        };
        let triangle = [(1.001, 1.001, -5.0, 1.0), (-5.0, 1.0, -5.0, -5.0), (-5.0, -5.0, 1.0012, 1.0011)];
        lines(&(0..count).map(line).chain(triangle).collect::<Vec<_>>())
    }

    fn pieces(drawing: &Drawing, chains: &Chains) -> Vec<Vec<(EntityId, bool)>> {
        let mut keys: Vec<Key> = chains.keys().collect();
        keys.sort_unstable_by_key(|&key| drawing.rank(chains.first_of(key).unwrap()));
        let pieces = |key| chains.get(key).unwrap().pieces.iter().map(|piece| (piece.entity, piece.reversed)).collect();
        keys.into_iter().map(pieces).collect()
    }

    #[test]
    fn thousands_of_ends_nearly_in_one_point_are_chained_in_machining_order() {
        let drawing = star(2 * CROWD);
        let chains = Chains::new(&drawing, 0.01, &|_| true);
        let id = |number: usize| EntityId(number as u32);
        let pair = |pair: usize| vec![(id(2 * pair + 1), true), (id(2 * pair), false)];
        let mut expected: Vec<Vec<(EntityId, bool)>> = (0..CROWD).map(pair).collect();
        expected.push([0, 1, 2].map(|number| (id(2 * CROWD + number), false)).to_vec());
        let found = pieces(&drawing, &chains);
        let differs = (0..).zip(&found).zip(&expected).find(|((_, found), expected)| found != expected);
        assert!(found.len() == expected.len() && differs.is_none(), "{} contours, {differs:?}", found.len());
        assert!(chains.keys().filter(|&key| chains.get(key).unwrap().closed).count() == 1);
    }

    #[test]
    fn an_edit_among_thousands_of_ends_chains_them_as_a_fresh_start_does() {
        let mut drawing = star(CROWD + 40);
        let mut chains = Chains::new(&drawing, 0.01, &|_| true);
        for number in [3, CROWD as u32, 17] {
            drawing.remove(EntityId(number));
            chains.update(&drawing, &[EntityId(number)], &|_| true);
            let fresh = Chains::new(&drawing, 0.01, &|_| true);
            assert!(pieces(&drawing, &chains) == pieces(&drawing, &fresh), "without entity {number}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

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
