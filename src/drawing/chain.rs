//! Chaining entities to contours by their end points.
//!
//! Closed entities are contours of their own. The others are joined end to end within the join tolerance, across kinds
//! and layers. A *group* is what hangs together through shared end points: groups are chained independently of each other,
//! so an edit chains again only the groups that it touches, and the result is that of a fresh start.

use super::{Contour, Drawing, EntityId, Piece, Role};
use crate::geometry::Point;
use rayon::slice::ParallelSliceMut;
use rustc_hash::{FxHashMap, FxHashSet};

/// Side of a cell of the plane in join tolerances: end points that meet lie in one cell, or in two when a border runs
/// between them.
const CELL: f64 = 8.0;

/// The ends of up to so many entities are moved one by one, and as many ranks are held without a table of all entities.
const FEW: usize = 16;

/// One free end of an open entity: the cell that it lies in, and whose it is. Where it is, is kept by entity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct End {
    cell: u64,
    /// The id of the entity, doubled; odd for the entity's own end, even for its start. Ids stay below [`TAKEN`].
    whose: u32,
}

impl End {
    fn entity(self) -> EntityId {
        EntityId(self.whose >> 1)
    }

    /// The entity's own start, not its end.
    fn is_start(self) -> bool {
        self.whose & 1 == 0
    }
}

/// The free ends of an entity, start first. Most drawings have one for most entities, so none is a point that is no number.
type Ends = (Point, Point);

const NO_ENDS: Ends = (Point::new(f64::NAN, f64::NAN), Point::new(f64::NAN, f64::NAN));

/// Names a contour (or a group of several) of one [`Chains`]; not used again once it is gone.
pub type Key = u32;

/// Names nothing.
const NO_KEY: Key = 0;

/// The contours of a drawing, kept up to date edit by edit.
#[derive(Clone, Debug)]
pub struct Chains {
    join: f64,
    /// All free ends, sorted by cell.
    ends: Vec<End>,
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
            join,
            ends: Vec::new(),
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
        for &id in &entities {
            if let Some(pair) = free_ends(drawing, id) {
                chains.ends_of[id.0 as usize] = pair;
                chains.ends.extend(chains.ends_at(id, pair));
            }
        }
        chains.ends.shrink_to_fit();
        chains.ends.par_sort_unstable();
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
        self.ends_of.get(entity.0 as usize).copied().filter(|(start, _)| !start.x.is_nan())
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
        let touching = now.is_some_and(|(start, end)| (end - start).norm() <= self.join);
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
        let mut affected = FxHashSet::default();
        let mut entities = FxHashSet::default();
        let distinct: FxHashSet<EntityId> = touched.iter().copied().collect();
        affected.extend(distinct.iter().filter_map(|&id| self.contour_of(id)));
        // Each end taken out or put in by itself moves all behind it.
        let in_bulk = distinct.len() > FEW;
        if in_bulk {
            self.ends.retain(|end| !distinct.contains(&end.entity()));
        }
        let mut fresh: Vec<End> = Vec::new();
        for id in distinct {
            let old = self.ends_of(id);
            let new = if is_cut(id) { free_ends(drawing, id) } else { None };
            for end in old.map(|pair| self.ends_at(id, pair)).into_iter().flatten().filter(|_| !in_bulk) {
                if let Ok(at) = self.ends.binary_search(&end) {
                    self.ends.remove(at);
                }
            }
            self.ends_of[id.0 as usize] = new.unwrap_or(NO_ENDS);
            for (end, point) in new.map(|pair| self.ends_at(id, pair).into_iter().zip([pair.0, pair.1])).into_iter().flatten() {
                affected.extend(self.near(point).filter_map(|(other, _)| self.contour_of(other.entity())));
                if in_bulk {
                    fresh.push(end);
                } else {
                    let at = self.ends.partition_point(|other| *other < end);
                    self.ends.insert(at, end);
                }
            }
            if drawing.get(id).is_some() && is_cut(id) {
                entities.insert(id);
            }
        }
        if in_bulk {
            self.ends.append(&mut fresh);
            self.ends.sort_unstable();
        }
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

    fn fresh_key(&mut self) -> Key {
        self.next_key += 1;
        self.next_key
    }

    /// The cell that holds a point, as a key that sorts by column and row. Coordinates beyond its range share cells.
    fn cell(&self, x: f64, y: f64) -> u64 {
        let number = |coordinate: f64| (coordinate / (CELL * self.join)).floor() as i32;
        let ordered = |number: i32| u64::from(number as u32 ^ 0x8000_0000);
        ordered(number(x)) << 32 | ordered(number(y))
    }

    fn ends_at(&self, entity: EntityId, (start, end): Ends) -> [End; 2] {
        let at = |point: Point, own_end: u32| End { cell: self.cell(point.x, point.y), whose: entity.0 << 1 | own_end };
        [at(start, 0), at(end, 1)]
    }

    /// Free ends within the join tolerance of `point`, each with its place.
    fn near(&self, point: Point) -> impl Iterator<Item = (End, Point)> + '_ {
        let (left, right) = (point.x - self.join, point.x + self.join);
        let (below, above) = (point.y - self.join, point.y + self.join);
        let mut cells = [self.cell(left, below), self.cell(left, above), self.cell(right, below), self.cell(right, above)];
        // Sorted, so that equal ones stand side by side.
        cells.sort_unstable();
        let distinct = (0..4).filter(move |&i| i == 0 || cells[i] != cells[i - 1]).map(move |i| cells[i]);
        let of_cell = |cell: u64| {
            let first = self.ends.partition_point(|end| end.cell < cell);
            self.ends[first..].iter().take_while(move |end| end.cell == cell)
        };
        let place = |end: &End| {
            let (start, own_end) = self.ends_of(end.entity())?;
            Some((*end, if end.is_start() { start } else { own_end }))
        };
        distinct.flat_map(of_cell).filter_map(place).filter(move |(_, at)| (at - point).norm() <= self.join)
    }

    /// Groups and chains `entities`, which come in machining order and hold whole groups. Returns the new contours.
    fn chain(&mut self, drawing: &Drawing, entities: &[EntityId]) -> Vec<Key> {
        let mut new = Vec::new();
        let mut open = Open::new(drawing.id_bound(), entities);
        for &first in entities {
            if !open.has(first) {
                continue;
            }
            let Some(geometry) = drawing.get(first).map(|entity| &entity.geometry) else { continue };
            if geometry.segment_count() == 0 {
                continue;
            }
            open.touching.clear();
            let (pieces, closed) = match self.ends_of(first) {
                None => {
                    open.take(first);
                    (vec![(first, false)], true)
                }
                Some(_) => self.walk(drawing, first, &mut open),
            };
            let contour = Contour::new(drawing, pieces, closed);
            let key = self.fresh_key();
            self.enter(key, &contour, &open.touching);
            self.contours.insert(key, Chain { contour, first });
            new.push(key);
        }
        new
    }

    /// Enters a new contour into the groups of the entities that it touches, which become one: the largest takes in the others.
    fn enter(&mut self, key: Key, contour: &Contour, touching: &[EntityId]) {
        let touched: FxHashSet<Key> = touching.iter().filter_map(|&id| self.contour_of(id)).collect();
        for (place, piece) in contour.pieces.iter().enumerate() {
            self.contour_of[piece.entity.0 as usize] = key;
            self.piece_of[piece.entity.0 as usize] = place as u32;
        }
        if touched.is_empty() {
            return;
        }
        let mut loose = vec![key];
        let mut groups = FxHashSet::default();
        for contour in touched {
            match self.group_of.get(&contour) {
                Some(&group) => drop(groups.insert(group)),
                None => loose.push(contour),
            }
        }
        let size = |group: &Key| self.groups.get(group).map_or(0, Vec::len);
        let largest = groups.iter().copied().max_by_key(|group| (size(group), *group));
        let largest = largest.unwrap_or_else(|| self.fresh_key());
        for group in groups.into_iter().filter(|&group| group != largest) {
            loose.extend(self.groups.remove(&group).unwrap_or_default());
        }
        for &contour in &loose {
            self.group_of.insert(contour, largest);
        }
        self.groups.entry(largest).or_default().extend(loose);
    }

    /// The chain through `first`, in its direction: forward to a free end or back to its start, else backward too.
    fn walk(&self, drawing: &Drawing, first: EntityId, open: &mut Open) -> (Vec<(EntityId, bool)>, bool) {
        let mut forward = vec![(first, false)];
        let mut here = open.take(first);
        let Some((start, mut tip)) = self.ends_of(first) else { return (forward, true) };
        let closed = loop {
            let home = (tip - start).norm();
            let next = self.next(tip, here, open);
            let closes = home <= self.join && next.as_ref().is_none_or(|(_, distance)| home <= *distance);
            if closes && (forward.len() > 1 || comes_back(drawing, first)) {
                break true;
            }
            let Some((end, _)) = next else { break false };
            forward.push((end.entity(), !end.is_start()));
            here = open.take(end.entity());
            let Some(other) = self.other_end(end) else { break false };
            tip = other;
        };
        if closed {
            return (forward, true);
        }
        let mut backward = Vec::new();
        let mut tail = start;
        here = open.taken_rank(first);
        while let Some((end, _)) = self.next(tail, here, open) {
            // Travelled towards the chain: its own end meets the tail when it is not reversed.
            backward.push((end.entity(), end.is_start()));
            here = open.take(end.entity());
            let Some(other) = self.other_end(end) else { break };
            tail = other;
        }
        backward.reverse();
        backward.append(&mut forward);
        (backward, false)
    }

    fn other_end(&self, end: End) -> Option<Point> {
        self.ends_of(end.entity()).map(|(start, own_end)| if end.is_start() { own_end } else { start })
    }

    /// The open end that continues the chain at `tip`: the nearest; of equally near ones that of the entity that follows in
    /// machining order the one of rank `here`. Everything else that ends there is noted as touching.
    fn next(&self, tip: Point, here: u32, open: &mut Open) -> Option<(End, f64)> {
        let mut best: Option<(End, f64, u32)> = None;
        for (end, at) in self.near(tip) {
            let Some(rank) = open.rank(end.entity()) else {
                open.touching.push(end.entity());
                continue;
            };
            let distance = (at - tip).norm();
            // Those before `here` come after all that follow it.
            let after = rank.wrapping_sub(here);
            let better = |(other, near, later): &(End, f64, u32)| {
                distance.total_cmp(near).then(after.cmp(later)).then(other.is_start().cmp(&end.is_start())).is_lt()
            };
            if best.as_ref().is_none_or(better) {
                best = Some((end, distance, after));
            }
        }
        best.map(|(end, distance, _)| (end, distance))
    }
}

const UNRANKED: u32 = u32::MAX;
const TAKEN: u32 = 1 << 31;

/// The entities that are still to be chained, by their rank in machining order, and what the chain at hand has touched.
struct Open {
    ranks: Ranks,
    touching: Vec<EntityId>,
}

/// Ranks by entity id, with the top bit set once the entity is taken.
enum Ranks {
    All(Vec<u32>),
    /// Of a few among many: an edit does not cost the length of the drawing.
    Few(FxHashMap<EntityId, u32>),
}

impl Open {
    fn new(id_bound: usize, entities: &[EntityId]) -> Open {
        let ranked = entities.iter().copied().zip(0u32..);
        let ranks = if entities.len() * FEW < id_bound {
            Ranks::Few(ranked.collect())
        } else {
            let mut ranks = vec![UNRANKED; id_bound];
            ranked.for_each(|(id, rank)| ranks[id.0 as usize] = rank);
            Ranks::All(ranks)
        };
        Open { ranks, touching: Vec::new() }
    }

    fn entry(&self, id: EntityId) -> u32 {
        match &self.ranks {
            Ranks::All(ranks) => ranks.get(id.0 as usize).copied().unwrap_or(UNRANKED),
            Ranks::Few(ranks) => ranks.get(&id).copied().unwrap_or(UNRANKED),
        }
    }

    /// The rank of an entity that is not taken yet.
    fn rank(&self, id: EntityId) -> Option<u32> {
        Some(self.entry(id)).filter(|rank| rank & TAKEN == 0)
    }

    fn has(&self, id: EntityId) -> bool {
        self.rank(id).is_some()
    }

    /// Takes the entity and gives back its rank.
    fn take(&mut self, id: EntityId) -> u32 {
        let entry = match &mut self.ranks {
            Ranks::All(ranks) => ranks.get_mut(id.0 as usize),
            Ranks::Few(ranks) => ranks.get_mut(&id),
        };
        if let Some(entry) = entry {
            *entry |= TAKEN;
        }
        self.taken_rank(id)
    }

    fn taken_rank(&self, id: EntityId) -> u32 {
        self.entry(id) & !TAKEN
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
    geometry.segment_count() > 2 || geometry.segments().any(|segment| segment.as_arc().is_some_and(|arc| !arc.is_minor()))
}

fn free_ends(drawing: &Drawing, id: EntityId) -> Option<Ends> {
    drawing.get(id)?.geometry.ends()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Entity, Geometry};

    type Coordinates = (f64, f64, f64, f64);

    fn lines(lines: &[Coordinates]) -> Drawing {
        let mut drawing = Drawing::new(None);
        for (i, &(x0, y0, x1, y1)) in lines.iter().enumerate() {
            let geometry = Geometry::Line { start: Point::new(x0, y0), end: Point::new(x1, y1) };
            drawing.push(Entity { handle: format!("{i}").into(), layer: "0".into(), role: None, kind: "LINE", geometry });
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
}
