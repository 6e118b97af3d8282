//! Free ends of open entities by cells of the plane, to find those near a place.

use crate::geometry::Point;

/// Side of a cell in join tolerances: ends that meet lie in one cell, or across the borders of two
/// to four.
const CELL: f64 = 16.0;
/// The same where there are too many ends to look at every one in a cell.
const SMALL_CELL: f64 = 2.0;
/// Ends nearer to each other than this share of the join tolerance lie in one point: the difference is rounding.
pub(super) const ONE_POINT: f64 = 1e-6;

/// Both ends of an entity, start first. Most entities of most drawings have them, so NaN stands for none.
pub(super) type Ends = (Point, Point);

pub(super) const NO_ENDS: Ends = (
    Point::new(f64::NAN, f64::NAN),
    Point::new(f64::NAN, f64::NAN),
);

pub(super) fn has_ends(ends: &Ends) -> bool {
    !ends.0.x.is_nan()
}

/// One end of an entity: twice the number of the entity; odd for its own end, even for its start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct End(u32);

impl End {
    pub(super) fn both(entity: u32) -> [End; 2] {
        [End(entity << 1), End(entity << 1 | 1)]
    }

    /// The end at an index of a table by end.
    pub(super) fn at(index: usize) -> End {
        End(index as u32)
    }

    pub(super) fn index(self) -> usize {
        self.0 as usize
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
    /// Ends as near as this belong together whatever else is near; at most `join`.
    pub(super) certain: f64,
    per_unit: f64,
    /// How near a border, in cells, an end of the next cell may be within the join tolerance; with room for rounding.
    near_border: f64,
}

impl Cells {
    pub(super) fn new(join: f64, certain: f64) -> Cells {
        let certain = certain.min(join);
        Cells::of_side((join, certain), CELL)
    }

    /// Cells that hold few ends where the others hold many.
    pub(super) fn small(self) -> Cells {
        Cells::of_side((self.join, self.certain), SMALL_CELL)
    }

    fn of_side((join, certain): (f64, f64), side: f64) -> Cells {
        Cells {
            join,
            certain,
            per_unit: 1.0 / (side * join),
            near_border: 1.001 / side,
        }
    }

    pub(super) fn of(&self, point: Point) -> Cell {
        (
            whole(point.x * self.per_unit),
            whole(point.y * self.per_unit),
        )
    }

    /// The cell of a point, and its neighbours that may hold something within the join tolerance.
    pub(super) fn about(&self, point: Point) -> impl Iterator<Item = Cell> + use<> {
        let near_border = self.near_border;
        let along = |coordinate: f64| {
            let place = coordinate * self.per_unit;
            let own = whole(place);
            let beside = match place - own as f64 {
                share if share < near_border => -1,
                share if share > 1.0 - near_border => 1,
                _ => 0,
            };
            (own, beside)
        };
        let ((column, left_right), (row, up_down)) = (along(point.x), along(point.y));
        let beside = [(0, 0), (left_right, 0), (0, up_down), (left_right, up_down)];
        let is_there = [
            true,
            left_right != 0,
            up_down != 0,
            left_right != 0 && up_down != 0,
        ];
        let cell = move |(x, y): (i64, i64)| (column.saturating_add(x), row.saturating_add(y));
        beside
            .into_iter()
            .zip(is_there)
            .filter(|(_, is_there)| *is_there)
            .map(move |(at, _)| cell(at))
    }

    /// The distance of two ends; 0 where they lie in one point.
    pub(super) fn distance(&self, a: Point, b: Point) -> f64 {
        let distance = (a - b).norm();
        if distance <= ONE_POINT * self.join {
            0.0
        } else {
            distance
        }
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
        let follows = |&end: &u32| {
            self.next
                .get(end as usize)
                .copied()
                .filter(|&end| end != NONE)
        };
        std::iter::successors(Some(first).filter(|&end| end != NONE), follows).map(End)
    }

    /// Takes an end out of a list; false where the list lacks it.
    fn remove(&mut self, list: usize, end: End) -> bool {
        let next = self.next[end.0 as usize];
        if self.first[list] == end.0 {
            self.first[list] = next;
            return true;
        }
        let before = self
            .of(list)
            .find(|other| self.next[other.0 as usize] == end.0);
        before
            .map(|before| self.next[before.0 as usize] = next)
            .is_some()
    }
}

/// A number for a cell below `lists`, which is a power of two; some other cells share it.
fn hash((column, row): Cell, lists: usize) -> usize {
    // Multiplied by 2⁶⁴ over the golden ratio, neighbours fall far apart: drawings on a grid fill all lists alike.
    const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;
    let hash = (column as u64).wrapping_mul(SPREAD).rotate_left(32) ^ row as u64;
    (hash.wrapping_mul(SPREAD) >> 32) as usize & (lists - 1)
}

/// Ends in lists, one for all cells with the same hash, numbered as their first ends come. Where the entities of a drawing are
/// ordered in the plane, lists that are read one after another lie side by side in memory.
#[derive(Clone, Debug)]
pub(super) struct Buckets {
    lists: Lists,
    /// By hash of a cell: the number of its list.
    by_hash: Vec<u32>,
    /// By hash of a cell, a bit: there is a list. Most cells beside one are empty, and these bits are always in the
    /// cache.
    is_there: Vec<u64>,
    /// By end: the number of its list.
    of_end: Vec<u32>,
    count: usize,
}

impl Buckets {
    /// For the ends of entities numbered below `entities`, about `count` of them.
    pub(super) fn new(entities: usize, count: usize) -> Buckets {
        let ends = 2 * entities;
        let hashes = count.next_power_of_two();
        Buckets {
            lists: Lists {
                first: Vec::with_capacity(count),
                next: vec![NONE; ends],
            },
            by_hash: vec![NONE; hashes],
            is_there: vec![0; hashes.div_ceil(64)],
            of_end: vec![NONE; ends],
            count: 0,
        }
    }

    /// True where new ends have made the lists long.
    pub(super) fn is_crowded(&self) -> bool {
        self.count > 4 * self.by_hash.len()
    }

    /// Makes room for the ends of entities numbered below `entities`.
    pub(super) fn grow(&mut self, entities: usize) {
        self.lists.next.resize(2 * entities, NONE);
        self.of_end.resize(2 * entities, NONE);
    }

    /// Puts a new end before all others of its cell.
    pub(super) fn insert(&mut self, cell: Cell, end: End) {
        let hash = hash(cell, self.by_hash.len());
        let number = &mut self.by_hash[hash];
        if *number == NONE {
            self.is_there[hash / 64] |= 1 << (hash % 64);
            *number = self.lists.first.len() as u32;
            self.lists.first.push(NONE);
        }
        self.of_end[end.index()] = *number;
        self.lists.insert(*number as usize, end);
        self.count += 1;
    }

    /// Takes out an end that is in a list.
    pub(super) fn remove(&mut self, end: End) {
        let list = self.of_end[end.index()] as usize;
        self.count -= usize::from(self.lists.remove(list, end));
    }

    /// Number of lists.
    pub(super) fn len(&self) -> usize {
        self.lists.first.len()
    }

    /// The ends of one list: those of a cell, and of others with the same hash.
    pub(super) fn of_list(&self, list: usize) -> impl Iterator<Item = End> + '_ {
        self.lists.of(list)
    }

    /// The lists of more than `count` ends.
    pub(super) fn long_lists(&self, count: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.len()).filter(move |list| self.of_list(*list).nth(count).is_some())
    }

    /// The ends of the cell of an end that is in a list, and of others with the same hash.
    pub(super) fn beside(&self, end: End) -> impl Iterator<Item = End> + '_ {
        self.lists.of(self.of_end[end.index()] as usize)
    }

    /// The ends of a cell, and of others with the same hash.
    pub(super) fn of_cell(&self, cell: Cell) -> impl Iterator<Item = End> + '_ {
        let hash = hash(cell, self.by_hash.len());
        let is_there = self.is_there[hash / 64] >> (hash % 64) & 1 == 1;
        let list = if is_there {
            self.by_hash[hash] as usize
        } else {
            usize::MAX
        };
        self.lists.of(list)
    }
}
