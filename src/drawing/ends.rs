//! Free ends of open entities by cells of the plane: which lie near a place.

use crate::geometry::Point;

/// Side of a cell in join tolerances: ends that meet lie in one cell, or in two to four where borders run between them.
const CELL: f64 = 16.0;
/// How near a border, in cells, an end of the next cell may be within the join tolerance; with room for rounding.
const NEAR_BORDER: f64 = 1.001 / CELL;
/// Ends nearer to each other than this share of the join tolerance lie in one point: what differs then is how they were computed.
const ONE_POINT: f64 = 1e-6;

/// Both ends of an entity, start first. Most drawings have them for most entities, so none is a point that is no number.
pub(super) type Ends = (Point, Point);

pub(super) const NO_ENDS: Ends = (Point::new(f64::NAN, f64::NAN), Point::new(f64::NAN, f64::NAN));

pub(super) fn has_ends(ends: &Ends) -> bool {
    !ends.0.x.is_nan()
}

/// One end of an entity: the number of the entity, doubled; odd for its own end, even for its start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct End(u32);

impl End {
    pub(super) fn both(entity: u32) -> [End; 2] {
        [End(entity << 1), End(entity << 1 | 1)]
    }

    pub(super) fn entity(self) -> u32 {
        self.0 >> 1
    }

    /// The entity's own start, not its end.
    pub(super) fn is_start(self) -> bool {
        self.0 & 1 == 0
    }

    pub(super) fn of(self, ends: Ends) -> Point {
        if self.is_start() { ends.0 } else { ends.1 }
    }

    /// The other end of the same entity.
    pub(super) fn other(self) -> End {
        End(self.0 ^ 1)
    }
}

/// Column and row.
pub(super) type Cell = (i64, i64);

/// The plane, cut into cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells {
    pub(super) join: f64,
    per_unit: f64,
}

impl Cells {
    pub(super) fn new(join: f64) -> Cells {
        Cells { join, per_unit: 1.0 / (CELL * join) }
    }

    pub(super) fn of(&self, point: Point) -> Cell {
        (whole(point.x * self.per_unit), whole(point.y * self.per_unit))
    }

    /// The cell of a point, and those beside it in which something may be within the join tolerance.
    pub(super) fn about(&self, point: Point) -> impl Iterator<Item = Cell> + use<> {
        let along = |coordinate: f64| {
            let place = coordinate * self.per_unit;
            let own = whole(place);
            let beside = match place - own as f64 {
                share if share < NEAR_BORDER => -1,
                share if share > 1.0 - NEAR_BORDER => 1,
                _ => 0,
            };
            (own, beside)
        };
        let ((column, left_right), (row, up_down)) = (along(point.x), along(point.y));
        let beside = [(0, 0), (left_right, 0), (0, up_down), (left_right, up_down)];
        let is_there = [true, left_right != 0, up_down != 0, left_right != 0 && up_down != 0];
        let cell = move |(x, y): (i64, i64)| (column.saturating_add(x), row.saturating_add(y));
        beside.into_iter().zip(is_there).filter(|(_, is_there)| *is_there).map(move |(at, _)| cell(at))
    }

    /// True where two ends lie in one point of one cell.
    pub(super) fn are_one(&self, a: Point, b: Point) -> bool {
        self.distance(a, b) == 0.0 && self.of(a) == self.of(b)
    }

    /// The distance of two ends; 0 where they lie in one point.
    pub(super) fn distance(&self, a: Point, b: Point) -> f64 {
        let distance = (a - b).norm();
        if distance <= ONE_POINT * self.join { 0.0 } else { distance }
    }
}

/// The whole number at or below, without a call into the mathematics library.
fn whole(number: f64) -> i64 {
    let cut = number as i64;
    cut.saturating_sub(i64::from((cut as f64) > number))
}

const NONE: u32 = u32::MAX;

/// Ends in numbered lists.
#[derive(Clone, Debug)]
struct Lists {
    /// The first end of each list.
    first: Vec<u32>,
    /// By end: the next one in its list.
    next: Vec<u32>,
}

impl Lists {
    /// Puts an end before all others of a list.
    fn insert(&mut self, list: usize, end: End) {
        self.next[end.0 as usize] = std::mem::replace(&mut self.first[list], end.0);
    }

    fn of(&self, list: usize) -> impl Iterator<Item = End> + '_ {
        let first = self.first.get(list).copied().unwrap_or(NONE);
        let follows = |&end: &u32| self.next.get(end as usize).copied().filter(|&end| end != NONE);
        std::iter::successors(Some(first).filter(|&end| end != NONE), follows).map(End)
    }

    /// Goes through a list; gives back how many ends were removed from it.
    fn visit(&mut self, list: usize, mut look: impl FnMut(End) -> Visit) -> usize {
        let (mut at, mut before) = (self.first[list], NONE);
        let mut removed = 0;
        while at != NONE {
            let visit = look(End(at));
            let next = self.next[at as usize];
            match visit {
                Visit::Next => before = at,
                Visit::Stop => break,
                Visit::Remove | Visit::RemoveAndStop => {
                    match before {
                        NONE => self.first[list] = next,
                        before => self.next[before as usize] = next,
                    }
                    removed += 1;
                    if visit == Visit::RemoveAndStop {
                        break;
                    }
                }
            }
            at = next;
        }
        removed
    }
}

/// A number for a cell below `lists`, which is a power of two; the same for some other cells.
fn hash((column, row): Cell, lists: usize) -> usize {
    // Multiplied by 2⁶⁴ over the golden ratio, neighbours fall far apart: drawings on a grid fill all lists alike.
    const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;
    let hash = (column as u64).wrapping_mul(SPREAD).rotate_left(32) ^ row as u64;
    (hash.wrapping_mul(SPREAD) >> 32) as usize & (lists - 1)
}

/// Ends in lists, one for all cells of the same hash. Where an end lies, whoever asks knows.
#[derive(Clone, Debug)]
pub(super) struct Buckets {
    lists: Lists,
    count: usize,
}

impl Buckets {
    /// For the ends of entities numbered below `entities`, about `count` of them.
    pub(super) fn new(entities: usize, count: usize) -> Buckets {
        Buckets { lists: Lists { first: vec![NONE; count.next_power_of_two()], next: vec![NONE; 2 * entities] }, count: 0 }
    }

    /// True where lists have become long because ends came.
    pub(super) fn is_crowded(&self) -> bool {
        self.count > 4 * self.lists.first.len()
    }

    /// Makes room for the ends of entities numbered below `entities`.
    pub(super) fn grow(&mut self, entities: usize) {
        self.lists.next.resize(2 * entities, NONE);
    }

    fn list(&self, cell: Cell) -> usize {
        hash(cell, self.lists.first.len())
    }

    /// Puts an end before all others of its cell.
    pub(super) fn insert(&mut self, cell: Cell, end: End) {
        self.lists.insert(self.list(cell), end);
        self.count += 1;
    }

    pub(super) fn remove(&mut self, cell: Cell, end: End) {
        self.count -= self.lists.visit(self.list(cell), |other| if other == end { Visit::RemoveAndStop } else { Visit::Next });
    }

    /// The ends of a cell, and of others with the same hash.
    pub(super) fn of_cell(&self, cell: Cell) -> impl Iterator<Item = End> + '_ {
        self.lists.of(self.list(cell))
    }
}

/// Ends in lists as in [`Buckets`], the lists numbered as their first ends come. Along a drawing whose entities stand in their
/// order in the plane, lists that are asked for one after another lie side by side in memory.
#[derive(Debug)]
pub(super) struct Numbered {
    lists: Lists,
    /// By hash of a cell: the number of its list.
    by_hash: Vec<u32>,
    /// By hash of a cell, a bit: there is a list. Most of the cells beside one are empty, and these bits are always at hand.
    is_there: Vec<u64>,
    /// By end: the number of its list.
    of_end: Vec<u32>,
    /// How many ends came into each list.
    lengths: Vec<u32>,
}

impl Numbered {
    /// For the ends of entities numbered below `entities`.
    pub(super) fn new(entities: usize) -> Numbered {
        let ends = 2 * entities;
        let lists = Lists { first: Vec::with_capacity(ends), next: vec![NONE; ends] };
        let hashes = ends.next_power_of_two();
        Numbered {
            lists,
            by_hash: vec![NONE; hashes],
            is_there: vec![0; hashes.div_ceil(64)],
            of_end: vec![NONE; ends],
            lengths: Vec::with_capacity(ends),
        }
    }

    /// Puts a new end before all others of its cell.
    pub(super) fn insert(&mut self, cell: Cell, end: End) {
        let hash = hash(cell, self.by_hash.len());
        let number = &mut self.by_hash[hash];
        if *number == NONE {
            self.is_there[hash / 64] |= 1 << (hash % 64);
            *number = self.lists.first.len() as u32;
            self.lists.first.push(NONE);
            self.lengths.push(0);
        }
        self.of_end[end.0 as usize] = *number;
        self.lengths[*number as usize] += 1;
        self.lists.insert(*number as usize, end);
    }

    /// The ends in lists of more than `count`.
    pub(super) fn of_long_lists(&self, count: usize) -> impl Iterator<Item = End> + '_ {
        let long = self.lengths.iter().enumerate().filter(move |(_, length)| **length as usize > count);
        long.flat_map(|(list, _)| self.lists.of(list))
    }

    /// Puts an end that was removed, or not, before all others of its cell.
    pub(super) fn insert_again(&mut self, end: End) {
        self.lists.insert(self.of_end[end.0 as usize] as usize, end);
    }

    /// Goes through the ends of the cell of `end`, and of others with the same hash.
    pub(super) fn visit_about(&mut self, end: End, look: impl FnMut(End) -> Visit) {
        self.lists.visit(self.of_end[end.0 as usize] as usize, look);
    }

    /// Goes through the ends of a cell, and of others with the same hash.
    pub(super) fn visit(&mut self, cell: Cell, look: impl FnMut(End) -> Visit) {
        let hash = hash(cell, self.by_hash.len());
        if self.is_there[hash / 64] >> (hash % 64) & 1 == 1 {
            self.lists.visit(self.by_hash[hash] as usize, look);
        }
    }
}

/// What becomes of an end that was looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Visit {
    Next,
    Stop,
    Remove,
    RemoveAndStop,
}
