//! Chaining entities to contours by their end points.
//!
//! Closed entities are contours of their own. The others are joined end to end within the join tolerance, across kinds
//! and layers. A *group* is what hangs together through shared end points: groups are chained independently of each other,
//! so an edit chains again only the groups that it touches, and the result is that of a fresh start.

use super::{Contour, Drawing, EntityId, Piece, Role};
use crate::geometry::Point;
use rustc_hash::{FxHashMap, FxHashSet};

/// Side of a cell of the plane in join tolerances: end points that meet lie in one cell, or in two when a border runs
/// between them.
const CELL: f64 = 8.0;

/// The ends of up to so many entities are moved one by one.
const FEW: usize = 16;

/// One free end of an open entity.
#[derive(Clone, Copy, Debug, PartialEq)]
struct End {
    cell: u64,
    point: Point,
    entity: EntityId,
    /// The entity's own start, not its end.
    is_start: bool,
}

/// Names a contour (or a group) of one [`Chains`]; not used again once it is gone.
pub type Key = u32;

/// The contours of a drawing, kept up to date edit by edit.
#[derive(Clone, Debug)]
pub struct Chains {
    join: f64,
    /// All free ends, sorted by cell, then point, then entity.
    ends: Vec<End>,
    /// The free ends of each open entity as they stand in `ends`, by entity id.
    ends_of: Vec<Option<(Point, Point)>>,
    group_of: Vec<Option<Key>>,
    groups: FxHashMap<Key, Vec<EntityId>>,
    contours: FxHashMap<Key, Contour>,
    contours_of_group: FxHashMap<Key, Vec<Key>>,
    contour_of: Vec<Option<Key>>,
    /// The place of each entity among the pieces of its contour, by entity id.
    piece_of: Vec<u32>,
    next_key: Key,
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
            group_of: Vec::new(),
            groups: FxHashMap::default(),
            contours: FxHashMap::default(),
            contours_of_group: FxHashMap::default(),
            contour_of: Vec::new(),
            piece_of: Vec::new(),
            next_key: 0,
        };
        chains.grow(drawing);
        let entities: Vec<EntityId> = drawing.order().iter().copied().filter(|&id| is_cut(id)).collect();
        for &id in &entities {
            if let Some(pair) = free_ends(drawing, id) {
                chains.ends_of[id.0 as usize] = Some(pair);
                chains.ends.extend(chains.ends_at(id, pair));
            }
        }
        chains.ends.sort_unstable_by(compare);
        chains.chain(drawing, &entities);
        chains
    }

    /// Contour by key.
    pub fn get(&self, key: Key) -> Option<&Contour> {
        self.contours.get(&key)
    }

    /// The contour that holds an entity.
    pub fn contour_of(&self, entity: EntityId) -> Option<Key> {
        self.contour_of.get(entity.0 as usize).copied().flatten()
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
        let known = self.ends_of.get(entity.0 as usize).copied().flatten();
        let now = if is_cut { free_ends(drawing, entity) } else { None };
        let chained = self.contour_of(entity).is_some();
        let touching = now.is_some_and(|(start, end)| (end - start).norm() <= self.join);
        known == now && !touching && chained == (is_cut && drawing.get(entity).is_some_and(|entity| entity.geometry.segment_count() > 0))
    }

    /// The number of segments of an entity has changed: its contour counts them anew.
    pub fn recount(&mut self, drawing: &Drawing, entity: EntityId) {
        let Some(contour) = self.contour_of(entity).and_then(|key| self.contours.get_mut(&key)) else { return };
        *contour = Contour::new(drawing, contour.pieces.iter().map(|piece| (piece.entity, piece.reversed)), contour.closed);
    }

    /// Chains again what the entities of `touched` (new, changed or removed) belonged to or belong to now.
    pub fn update(&mut self, drawing: &Drawing, touched: &[EntityId], is_cut: &dyn Fn(EntityId) -> bool) -> Rechained {
        self.grow(drawing);
        let mut affected = FxHashSet::default();
        let mut entities = FxHashSet::default();
        // Each end taken out or put in by itself moves all behind it.
        let in_bulk = touched.len() > FEW;
        let distinct: FxHashSet<EntityId> = touched.iter().copied().collect();
        if in_bulk {
            self.ends.retain(|end| !distinct.contains(&end.entity));
        }
        let mut fresh: Vec<End> = Vec::new();
        for id in distinct {
            affected.extend(self.group_of[id.0 as usize]);
            let old = self.ends_of[id.0 as usize];
            let new = if is_cut(id) { free_ends(drawing, id) } else { None };
            for end in old.map(|pair| self.ends_at(id, pair)).into_iter().flatten().filter(|_| !in_bulk) {
                if let Ok(at) = self.ends.binary_search_by(|other| compare(other, &end)) {
                    self.ends.remove(at);
                }
            }
            for end in new.map(|pair| self.ends_at(id, pair)).into_iter().flatten() {
                affected.extend(self.near(end.point).filter_map(|other| self.group_of[other.entity.0 as usize]));
                if in_bulk {
                    fresh.push(end);
                } else {
                    let at = self.ends.partition_point(|other| compare(other, &end).is_lt());
                    self.ends.insert(at, end);
                }
            }
            self.ends_of[id.0 as usize] = new;
            self.group_of[id.0 as usize] = None;
            self.contour_of[id.0 as usize] = None;
            if drawing.get(id).is_some() && is_cut(id) {
                entities.insert(id);
            }
        }
        if in_bulk {
            self.ends.append(&mut fresh);
            self.ends.sort_unstable_by(compare);
        }
        let mut rechained = Rechained::default();
        for group in affected {
            for contour in self.contours_of_group.remove(&group).unwrap_or_default() {
                self.contours.remove(&contour);
                rechained.gone.push(contour);
            }
            for id in self.groups.remove(&group).unwrap_or_default() {
                if drawing.get(id).is_some() && is_cut(id) {
                    entities.insert(id);
                }
                self.group_of[id.0 as usize] = None;
                self.contour_of[id.0 as usize] = None;
            }
        }
        let ordered = in_machining_order(drawing, entities);
        rechained.new = self.chain(drawing, &ordered);
        rechained
    }

    fn grow(&mut self, drawing: &Drawing) {
        let bound = drawing.id_bound();
        self.ends_of.resize(bound, None);
        self.group_of.resize(bound, None);
        self.contour_of.resize(bound, None);
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

    fn ends_at(&self, entity: EntityId, (start, end): (Point, Point)) -> [End; 2] {
        let at = |point: Point, is_start| End { cell: self.cell(point.x, point.y), point, entity, is_start };
        [at(start, true), at(end, false)]
    }

    /// Free ends within the join tolerance of `point`.
    fn near(&self, point: Point) -> impl Iterator<Item = &End> + '_ {
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
        distinct.flat_map(of_cell).filter(move |end| (end.point - point).norm() <= self.join)
    }

    /// Groups and chains `entities`, which come in machining order and hold whole groups. Returns the new contours.
    fn chain(&mut self, drawing: &Drawing, entities: &[EntityId]) -> Vec<Key> {
        let mut new = Vec::new();
        let mut rank = vec![UNRANKED; drawing.id_bound()];
        for (position, &id) in entities.iter().enumerate() {
            rank[id.0 as usize] = position as u32;
        }
        let mut open = Open { rank, touching: Vec::new() };
        for &first in entities {
            if !open.has(first) {
                continue;
            }
            let Some(geometry) = drawing.get(first).map(|entity| &entity.geometry) else { continue };
            if geometry.segment_count() == 0 {
                continue;
            }
            open.touching.clear();
            let (pieces, closed) = match self.ends_of[first.0 as usize] {
                None => {
                    open.take(first);
                    (vec![(first, false)], true)
                }
                Some(_) => self.walk(drawing, first, &mut open),
            };
            let contour = Contour::new(drawing, pieces, closed);
            let key = self.fresh_key();
            self.enter(key, &contour, &open.touching);
            self.contours.insert(key, contour);
            new.push(key);
        }
        new
    }

    /// Enters a new contour into the groups of the entities that it touches, which become one.
    fn enter(&mut self, key: Key, contour: &Contour, touching: &[EntityId]) {
        let groups: FxHashSet<Key> = touching.iter().filter_map(|id| self.group_of[id.0 as usize]).collect();
        let mut members: Vec<EntityId> = contour.pieces.iter().map(|piece| piece.entity).collect();
        for (place, member) in members.iter().enumerate() {
            self.contour_of[member.0 as usize] = Some(key);
            self.piece_of[member.0 as usize] = place as u32;
        }
        let mut contours = vec![key];
        for group in groups {
            members.extend(self.groups.remove(&group).unwrap_or_default());
            contours.extend(self.contours_of_group.remove(&group).unwrap_or_default());
        }
        let group = self.fresh_key();
        for member in &members {
            self.group_of[member.0 as usize] = Some(group);
        }
        self.groups.insert(group, members);
        self.contours_of_group.insert(group, contours);
    }

    /// The chain through `first`, in its direction: forward to a free end or back to its start, else backward too.
    fn walk(&self, drawing: &Drawing, first: EntityId, open: &mut Open) -> (Vec<(EntityId, bool)>, bool) {
        let mut forward = vec![(first, false)];
        let mut here = open.take(first);
        let Some((start, mut tip)) = self.ends_of[first.0 as usize] else { return (forward, true) };
        let closed = loop {
            let home = (tip - start).norm();
            let next = self.next(tip, here, open);
            let closes = home <= self.join && next.as_ref().is_none_or(|(_, distance)| home <= *distance);
            if closes && (forward.len() > 1 || comes_back(drawing, first)) {
                break true;
            }
            let Some((end, _)) = next else { break false };
            forward.push((end.entity, !end.is_start));
            here = open.take(end.entity);
            tip = self.other_end(&end);
        };
        if closed {
            return (forward, true);
        }
        let mut backward = Vec::new();
        let mut tail = start;
        here = open.taken_rank(first);
        while let Some((end, _)) = self.next(tail, here, open) {
            // Travelled towards the chain: its own end meets the tail when it is not reversed.
            backward.push((end.entity, end.is_start));
            here = open.take(end.entity);
            tail = self.other_end(&end);
        }
        backward.reverse();
        backward.append(&mut forward);
        (backward, false)
    }

    fn other_end(&self, end: &End) -> Point {
        match self.ends_of[end.entity.0 as usize] {
            Some((_, other)) if end.is_start => other,
            Some((other, _)) => other,
            None => end.point,
        }
    }

    /// The open end that continues the chain at `tip`: the nearest; of equally near ones that of the entity that follows in
    /// machining order the one of rank `here`. Everything else that ends there is noted as touching.
    fn next(&self, tip: Point, here: u32, open: &mut Open) -> Option<(End, f64)> {
        let mut best: Option<(End, f64, u32)> = None;
        for end in self.near(tip) {
            if !open.has(end.entity) {
                open.touching.push(end.entity);
                continue;
            }
            let distance = (end.point - tip).norm();
            // Those before `here` come after all that follow it.
            let after = open.rank[end.entity.0 as usize].wrapping_sub(here);
            let better = |(other, near, later): &(End, f64, u32)| {
                distance.total_cmp(near).then(after.cmp(later)).then(other.is_start.cmp(&end.is_start)).is_lt()
            };
            if best.as_ref().is_none_or(better) {
                best = Some((*end, distance, after));
            }
        }
        best.map(|(end, distance, _)| (end, distance))
    }
}

const UNRANKED: u32 = u32::MAX;
const TAKEN: u32 = 1 << 31;

/// The entities that are still to be chained, by their rank in machining order, and what the chain at hand has touched.
struct Open {
    /// By entity id: the rank, with the top bit set once the entity is taken.
    rank: Vec<u32>,
    touching: Vec<EntityId>,
}

impl Open {
    fn has(&self, id: EntityId) -> bool {
        self.rank.get(id.0 as usize).is_some_and(|rank| rank & TAKEN == 0)
    }

    /// Takes the entity and gives back its rank.
    fn take(&mut self, id: EntityId) -> u32 {
        let rank = self.taken_rank(id);
        if let Some(entry) = self.rank.get_mut(id.0 as usize) {
            *entry |= TAKEN;
        }
        rank
    }

    fn taken_rank(&self, id: EntityId) -> u32 {
        self.rank.get(id.0 as usize).map_or(0, |rank| rank & !TAKEN)
    }
}

/// Role that the entities of a contour state, or their layers: that of the first piece which has one.
pub fn stated_role(drawing: &Drawing, contour: &Contour, of_layer: &dyn Fn(&str) -> Option<Role>) -> Option<Role> {
    contour.pieces.iter().find_map(|piece| {
        let entity = drawing.get(piece.entity)?;
        entity.role.or_else(|| of_layer(&entity.layer))
    })
}

fn in_machining_order(drawing: &Drawing, entities: FxHashSet<EntityId>) -> Vec<EntityId> {
    let mut wanted = vec![false; drawing.id_bound()];
    entities.iter().for_each(|id| wanted[id.0 as usize] = true);
    drawing.order().iter().copied().filter(|id| wanted[id.0 as usize]).collect()
}

/// True when an open entity whose ends touch really leads round, and is not just shorter than the join tolerance.
fn comes_back(drawing: &Drawing, id: EntityId) -> bool {
    let Some(geometry) = drawing.get(id).map(|entity| &entity.geometry) else { return false };
    geometry.segment_count() > 2 || geometry.segments().any(|segment| segment.as_arc().is_some_and(|arc| !arc.is_minor()))
}

fn free_ends(drawing: &Drawing, id: EntityId) -> Option<(Point, Point)> {
    drawing.get(id)?.geometry.ends()
}

fn compare(a: &End, b: &End) -> std::cmp::Ordering {
    let key = |end: &End| (end.entity, end.is_start);
    a.cell
        .cmp(&b.cell)
        .then_with(|| a.point.x.total_cmp(&b.point.x))
        .then_with(|| a.point.y.total_cmp(&b.point.y))
        .then_with(|| key(a).cmp(&key(b)))
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
