//! Which free ends lie within the join tolerance of each other, and which of them can only be joined to each other.

mod borders;
mod closing;

use super::doubles::{self, SAME_PLACE};
use super::ends::{Buckets, Cell, Cells, End, Ends, NO_ENDS, ONE_POINT, has_ends};
use super::{Drawing, EntityId};
use crate::geometry::Point;
use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};
use std::borrow::Cow;
use std::cmp::{Ordering, Reverse};

/// The ends of cells with more than these are sorted into smaller ones.
const DENSE: usize = 64;

/// More ends than these in one small cell are a crowd, where not all pairs are compared. A drawing to be cut has a few.
pub(super) const CROWD: usize = 64;

/// Fewer ends than these are read on one thread.
const FEW: usize = 16_384;

/// The possible partner of an end, as a number: that of the one end, or one of these.
const NOTHING: u32 = u32::MAX;
const SEVERAL: u32 = u32::MAX - 1;

/// The free ends of entities by place; the entities are numbered in the order given.
pub(super) struct Joints<'a> {
    drawing: &'a Drawing,
    entities: &'a [EntityId],
    cells: Cells,
    /// Of each entity; NaN where there are none, or where the entity is set aside. Those of a whole drawing are not copied.
    places: Cow<'a, [Ends]>,
    all: Buckets,
    /// Ends of dense cells in smaller ones.
    dense: Option<Dense>,
    /// By end: its possible partner.
    met: Vec<u32>,
    /// By end: another one is so near that it cannot be joined to any farther away. Empty where none is joined from farther away.
    settled: Vec<bool>,
    pub(crate) doubles: Doubles,
}

/// Which of the entities that lie on each other are chained, by number.
#[derive(Debug, Default)]
pub(super) struct Doubles {
    /// Those that are not chained, each with the one in the same place that is.
    pub(crate) aside: FxHashMap<u32, u32>,
    /// Those that are chained and have a double that is not.
    pub(crate) kept: Vec<u32>,
    /// Those of which both are chained, since two outlines share them: each with the other.
    pub(crate) borders: FxHashMap<u32, u32>,
}

struct Dense {
    /// The large cells that are dense.
    large: FxHashSet<Cell>,
    cells: Cells,
    ends: Buckets,
    crowded: FxHashMap<Cell, Vec<End>>,
}

impl<'a> Joints<'a> {
    /// For `entities` with the ends that `ends_of` holds by id. Doubles are set aside: they have no joints.
    pub(crate) fn new(
        drawing: &'a Drawing,
        cells: Cells,
        entities: &'a [EntityId],
        ends_of: &'a [Ends],
    ) -> Joints<'a> {
        let count = entities.len();
        let are_all = count == ends_of.len() && (0..).zip(entities).all(|(at, id)| id.0 == at);
        let places = match are_all {
            true => Cow::Borrowed(ends_of),
            false => {
                let ends = |id: &EntityId| ends_of.get(id.0 as usize).copied();
                let each = entities.iter().map(|id| ends(id).unwrap_or(NO_ENDS));
                Cow::Owned(each.collect())
            }
        };
        let mut all = Buckets::new(count, 2 * count);
        for (at, &ends) in (0..).zip(&*places).filter(|(_, ends)| has_ends(ends)) {
            End::both(at)
                .into_iter()
                .for_each(|end| all.insert(cells.of(end.of(ends)), end));
        }
        let mut joints = Joints {
            drawing,
            entities,
            cells,
            places,
            all,
            dense: None,
            met: Vec::new(),
            settled: Vec::new(),
            doubles: Doubles::default(),
        };
        joints.sort_dense();
        let pairs = joints.meet();
        if !pairs.is_empty() {
            joints.doubles = joints.set_aside(&pairs);
            joints.keep_borders();
            for &double in joints.doubles.aside.keys() {
                joints.places.to_mut()[double as usize] = NO_ENDS;
            }
            joints.sort_dense();
            joints.meet();
        }
        joints.join_in_crowds();
        joints
    }

    pub(crate) fn end_count(&self) -> usize {
        2 * self.places.len()
    }

    pub(crate) fn place(&self, end: End) -> Point {
        end.of(self.places[end.entity() as usize])
    }

    /// The distance of two ends; 0 where they lie in one point.
    pub(crate) fn distance(&self, one: End, other: End) -> f64 {
        self.cells.distance(self.place(one), self.place(other))
    }

    pub(crate) fn join(&self) -> f64 {
        self.cells.join
    }

    /// The distance at which ends belong together whatever else is near.
    pub(crate) fn certain(&self) -> f64 {
        self.cells.certain
    }

    /// The one end that an end can be joined to, if neither has another choice.
    pub(crate) fn partner(&self, end: End) -> Option<End> {
        let met = *self.met.get(end.index())?;
        let is_mutual = self
            .met
            .get(met as usize)
            .is_some_and(|&back| back as usize == end.index());
        is_mutual.then(|| End::at(met as usize))
    }

    /// True where an end has no possible partner.
    pub(crate) fn is_lone(&self, end: End) -> bool {
        self.met.get(end.index()).is_none_or(|&met| met == NOTHING)
    }

    /// The crowded small cells: the ends of each.
    pub(crate) fn crowds(&self) -> impl Iterator<Item = &Vec<End>> {
        self.dense.iter().flat_map(|dense| dense.crowded.values())
    }

    /// The number of lists of all ends, doubles included: the ends of a cell are in one list, together with those of
    /// others.
    pub(crate) fn list_count(&self) -> usize {
        self.all.len()
    }

    pub(crate) fn of_list(&self, list: usize) -> impl Iterator<Item = End> + '_ {
        self.all.of_list(list)
    }

    /// The ends of a cell, and of others in the same list.
    pub(crate) fn of_cell(&self, cell: Cell) -> impl Iterator<Item = End> + '_ {
        self.all.of_cell(cell)
    }

    pub(crate) fn is_crowded(&self, end: End) -> bool {
        self.dense
            .as_ref()
            .is_some_and(|dense| dense.is_crowded(self.place(end)))
    }

    pub(crate) fn by_place(&self, one: u32, other: u32) -> Ordering {
        doubles::by_place(
            self.drawing,
            self.entities[one as usize],
            self.entities[other as usize],
        )
    }

    /// The number of ends of an entity that meet another one's end in one point, except those for which `leaves_out`
    /// holds.
    fn count_met(&self, entity: u32, leaves_out: impl Fn(u32) -> bool) -> usize {
        let meets = |&end: &End| {
            let mut met = false;
            self.each_near(end, |other, distance| {
                met |= distance == 0.0 && other.entity() != entity && !leaves_out(other.entity())
            });
            met
        };
        End::both(entity).iter().filter(|end| meets(end)).count()
    }

    /// Hands over every end within the join tolerance of one, with the distance, in no order: those that certainly meet
    /// it, else those that certainly meet no other. The other end of the same entity counts where that entity leads round.
    /// In a crowd no end sees another, nor is it seen.
    pub(crate) fn each_near(&self, end: End, mut look: impl FnMut(End, f64)) {
        let place = self.place(end);
        if place.x.is_nan() || self.is_crowded(end) {
            return;
        }
        let (mut is_dense, mut is_own) = (false, true);
        let is_settled = |end: End| {
            self.settled
                .get(end.index())
                .is_some_and(|settled| *settled)
        };
        let mut see = |other: End, cells: &Cells, cell: Cell| {
            let at = self.place(other);
            let apart = at - place;
            // Most ends of a list are far off, and those of other cells are seen from there.
            if apart.x.abs() > self.cells.join || apart.y.abs() > self.cells.join || other == end {
                return;
            }
            let distance = self.cells.distance(at, place);
            if distance <= self.cells.join
                && cells.of(at) == cell
                && (distance <= self.cells.certain || !(is_settled(end) || is_settled(other)))
                && (other.entity() != end.entity() || self.closes_alone(end.entity(), distance))
            {
                look(other, distance);
            }
        };
        for cell in self.cells.about(place) {
            let is_beside = std::mem::take(&mut is_own);
            if self
                .dense
                .as_ref()
                .is_some_and(|dense| dense.large.contains(&cell))
            {
                is_dense = true;
            } else if is_beside {
                self.all
                    .beside(end)
                    .for_each(|other| see(other, &self.cells, cell));
            } else {
                self.all
                    .of_cell(cell)
                    .for_each(|other| see(other, &self.cells, cell));
            }
        }
        if let Some(dense) = self.dense.as_ref().filter(|_| is_dense) {
            for cell in dense
                .cells
                .about(place)
                .filter(|cell| !dense.crowded.contains_key(cell))
            {
                dense
                    .ends
                    .of_cell(cell)
                    .for_each(|other| see(other, &dense.cells, cell));
            }
        }
    }

    /// The direction in which an entity leaves one of its ends, radians from −π to π.
    pub(crate) fn heading(&self, end: End) -> f64 {
        let Some(geometry) = self
            .drawing
            .get(self.entities[end.entity() as usize])
            .map(|entity| &entity.geometry)
        else {
            return 0.0;
        };
        let flat = self.drawing.flat();
        let segment = if end.is_start() {
            geometry.segment_of(0, flat)
        } else {
            geometry.segment_of(geometry.segment_count().saturating_sub(1), flat)
        };
        let way = segment.map(|segment| {
            if end.is_start() {
                segment.start_tangent()
            } else {
                -segment.end_tangent()
            }
        });
        way.map_or(0.0, |way| way.y.atan2(way.x))
    }

    /// Sorts the ends of dense cells into smaller ones.
    fn sort_dense(&mut self) {
        self.dense = None;
        let mut counts: FxHashMap<Cell, Vec<End>> = FxHashMap::default();
        for end in self
            .all
            .long_lists(DENSE)
            .flat_map(|list| self.all.of_list(list))
            .filter(|&end| !self.place(end).x.is_nan())
        {
            counts
                .entry(self.cells.of(self.place(end)))
                .or_default()
                .push(end);
        }
        counts.retain(|_, ends| ends.len() > DENSE);
        if counts.is_empty() {
            return;
        }
        let cells = self.cells.small();
        let count = counts.values().map(Vec::len).sum();
        let mut ends = Buckets::new(self.entities.len(), count);
        let mut small: FxHashMap<Cell, Vec<End>> = FxHashMap::default();
        for &end in counts.values().flatten() {
            let cell = cells.of(self.place(end));
            ends.insert(cell, end);
            small.entry(cell).or_default().push(end);
        }
        small.retain(|_, ends| ends.len() > CROWD);
        self.dense = Some(Dense {
            large: counts.into_keys().collect(),
            cells,
            ends,
            crowded: small,
        });
    }

    /// Finds the possible partner of each end; returns pairs of entities that lie in one place.
    fn meet(&mut self) -> Vec<(u32, u32)> {
        const STEP: usize = 4096;
        self.settled = Vec::new();
        if self.cells.certain < self.cells.join {
            let is_settled = |index: usize| {
                let mut nearest = f64::INFINITY;
                self.each_near(End::at(index), |_, distance| {
                    nearest = nearest.min(distance)
                });
                nearest <= self.cells.certain
            };
            let ends = (0..self.end_count()).into_par_iter();
            self.settled = ends.with_min_len(STEP).map(is_settled).collect();
        }
        let mut met = vec![NOTHING; self.end_count()];
        let joints = &*self;
        let look = |(step, met): (usize, &mut [u32])| {
            let mut pairs = Vec::new();
            for (index, met) in (step * STEP..).zip(met) {
                *met = joints.look(End::at(index), &mut pairs);
            }
            pairs
        };
        let mut pairs: Vec<(u32, u32)> = if self.end_count() < FEW {
            met.chunks_mut(STEP).enumerate().flat_map(look).collect()
        } else {
            let found: Vec<Vec<(u32, u32)>> =
                met.par_chunks_mut(STEP).enumerate().map(look).collect();
            found.into_iter().flatten().collect()
        };
        for crowd in joints.crowds() {
            joints.doubles_in_crowd(crowd, &mut pairs);
        }
        pairs.sort_unstable();
        pairs.dedup();
        self.met = met;
        pairs
    }

    fn look(&self, end: End, pairs: &mut Vec<(u32, u32)>) -> u32 {
        if self.place(end).x.is_nan() {
            return NOTHING;
        }
        let mut met = if self.is_crowded(end) {
            SEVERAL
        } else {
            NOTHING
        };
        let same_place = SAME_PLACE * self.cells.certain;
        self.each_near(end, |other, distance| {
            met = if met == NOTHING {
                other.index() as u32
            } else {
                SEVERAL
            };
            if distance <= same_place
                && end.is_start()
                && end.entity() < other.entity()
                && !self.is_crowded(end.other())
                && (self.place(end.other()) - self.place(other.other())).norm() <= same_place
                && self.are_doubles(end.entity(), other.entity(), same_place)
            {
                pairs.push((end.entity(), other.entity()));
            }
        });
        met
    }

    fn are_doubles(&self, one: u32, other: u32, tolerance: f64) -> bool {
        // A distance just within the tolerance must always be rounded to the same side.
        let (one, other) = if self.by_place(one, other).is_gt() {
            (other, one)
        } else {
            (one, other)
        };
        let [one, other] = [one, other].map(|entity| self.entities[entity as usize]);
        doubles::are_doubles(self.drawing, one, other, tolerance)
    }

    /// Keeps one of each crowd of doubles: the one that meets most others in one point, else the first by place.
    fn set_aside(&self, pairs: &[(u32, u32)]) -> Doubles {
        let mut partners: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        for &(one, other) in pairs {
            partners.entry(one).or_default().push(other);
            partners.entry(other).or_default().push(one);
        }
        partners.values_mut().for_each(|of| of.sort_unstable());
        let rank = |(&entity, own): (&u32, &Vec<u32>)| {
            let met = self.count_met(entity, |other| own.binary_search(&other).is_ok());
            (Reverse(met), entity)
        };
        let mut ranked: Vec<(Reverse<usize>, u32)> = partners.iter().map(rank).collect();
        ranked.sort_unstable_by(|(a, one), (b, other)| {
            a.cmp(b).then_with(|| self.by_place(*one, *other))
        });
        let mut doubles = Doubles::default();
        let mut is_kept: FxHashMap<u32, bool> = FxHashMap::default();
        for (_, entity) in ranked {
            let of = partners.get(&entity).into_iter().flatten();
            let kept = of
                .filter(|other| is_kept.get(other) == Some(&true))
                .min_by(|one, other| self.by_place(**one, **other));
            is_kept.insert(entity, kept.is_none());
            match kept {
                Some(&kept) => drop(doubles.aside.insert(entity, kept)),
                None => doubles.kept.push(entity),
            }
        }
        doubles
    }

    /// In a crowd only neighbours by place are compared, and are doubles where they lie in one place exactly.
    fn doubles_in_crowd(&self, crowd: &[End], pairs: &mut Vec<(u32, u32)>) {
        let mut entities: Vec<u32> = crowd.iter().map(|end| end.entity()).collect();
        entities.sort_unstable_by(|&one, &other| self.by_place(one, other));
        entities.dedup();
        let Some(mut kept) = entities.first().copied() else {
            return;
        };
        for &entity in &entities[1..] {
            match self.are_doubles(kept, entity, ONE_POINT * self.cells.join) {
                true => pairs.push((kept.min(entity), kept.max(entity))),
                false => kept = entity,
            }
        }
    }

    /// In a crowd, two ends that share a point with no third one are joined.
    fn join_in_crowds(&mut self) {
        let mut joined = Vec::new();
        for crowd in self.crowds() {
            let mut ends = crowd.clone();
            ends.sort_unstable_by(|&one, &other| {
                doubles::by_coordinates(&self.place(one), &self.place(other)).then(one.cmp(&other))
            });
            let are_one = |at: usize, next: usize| {
                let pair = ends.get(at).zip(ends.get(next));
                pair.is_some_and(|(&one, &other)| self.distance(one, other) == 0.0)
            };
            for at in 0..ends.len().saturating_sub(1) {
                let apart = ends[at].entity() != ends[at + 1].entity()
                    || self.leads_round(ends[at].entity());
                if apart
                    && are_one(at, at + 1)
                    && !are_one(at + 1, at + 2)
                    && !(at > 0 && are_one(at - 1, at))
                {
                    joined.push((ends[at], ends[at + 1]));
                }
            }
        }
        for (one, other) in joined {
            self.met[one.index()] = other.index() as u32;
            self.met[other.index()] = one.index() as u32;
        }
    }
}

impl Dense {
    fn is_crowded(&self, place: Point) -> bool {
        !self.crowded.is_empty() && self.crowded.contains_key(&self.cells.of(place))
    }
}
