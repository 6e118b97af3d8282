//! A hierarchical grid that finds the boxes near a box, while boxes come and go.

use super::Bounds;
use rustc_hash::FxHashMap;
use std::ops::ControlFlow;

/// Boxes by key. Each lies in the level whose cells are just larger than it, in the cell of its lower left corner, so
/// it reaches into the next column and row at most; a query reads a few cells of each level in use. Adding, removing
/// and finding cost what is found, whatever else the grid holds, as long as boxes of one size do
/// not pile up in one place.
#[derive(Clone, Debug)]
pub(crate) struct Grid<K> {
    /// By level in use the first box of each occupied cell.
    levels: FxHashMap<i16, FxHashMap<Cell, u32>>,
    boxes: Vec<Boxed<K>>,
    /// The first free place in `boxes`.
    free: u32,
}

/// Column and row. Boxes beyond the last column or row count as in it.
type Cell = (i32, i32);

#[derive(Clone, Debug)]
struct Boxed<K> {
    key: K,
    bounds: Bounds,
    /// The next box in the same cell.
    next: u32,
}

const NONE: u32 = u32::MAX;

impl<K> Default for Grid<K> {
    fn default() -> Self {
        Grid {
            levels: FxHashMap::default(),
            boxes: Vec::new(),
            free: NONE,
        }
    }
}

impl<K: Copy + PartialEq> Grid<K> {
    /// Makes room for this many more boxes.
    pub(crate) fn reserve(&mut self, count: usize) {
        self.boxes.reserve(count);
    }

    /// Adds a box; an empty one is never found.
    pub(crate) fn insert(&mut self, key: K, bounds: Bounds) {
        if bounds.is_empty() {
            return;
        }
        let (level, cell) = cell_of(&bounds);
        let first = self
            .levels
            .entry(level)
            .or_default()
            .entry(cell)
            .or_insert(NONE);
        let boxed = Boxed {
            key,
            bounds,
            next: *first,
        };
        match self.boxes.get_mut(self.free as usize) {
            Some(place) => {
                *first = self.free;
                self.free = place.next;
                *place = boxed;
            }
            None => {
                *first = self.boxes.len() as u32;
                self.boxes.push(boxed);
            }
        }
    }

    /// Removes a box that was added with these bounds.
    pub(crate) fn remove(&mut self, key: K, bounds: &Bounds) {
        if bounds.is_empty() {
            return;
        }
        let (level, cell) = cell_of(bounds);
        let Some(cells) = self.levels.get_mut(&level) else {
            return;
        };
        let Some(&first) = cells.get(&cell) else {
            return;
        };
        let (mut before, mut at) = (NONE, first);
        while let Some(boxed) = self.boxes.get(at as usize).filter(|boxed| boxed.key != key) {
            (before, at) = (at, boxed.next);
        }
        let Some(boxed) = self.boxes.get_mut(at as usize) else {
            return;
        };
        let next = std::mem::replace(&mut boxed.next, self.free);
        self.free = at;
        match self.boxes.get_mut(before as usize) {
            Some(before) => before.next = next,
            None if next == NONE => drop(cells.remove(&cell)),
            None => drop(cells.insert(cell, next)),
        }
        if cells.is_empty() {
            self.levels.remove(&level);
        }
    }

    /// The number of places for boxes: those in use, and those of removed boxes.
    pub(crate) fn len(&self) -> usize {
        self.boxes.len()
    }

    /// The keys of all boxes, in no order.
    pub(crate) fn keys(&self) -> impl Iterator<Item = K> + '_ {
        let boxed = |at: u32| self.boxes.get(at as usize);
        let firsts = self.levels.values().flat_map(FxHashMap::values);
        let of_cell = move |&first| std::iter::successors(boxed(first), move |it| boxed(it.next));
        firsts.flat_map(of_cell).map(|boxed| boxed.key)
    }

    /// Calls `found` with each box that touches `area`, once each, in no order. Returns how many boxes and cells were
    /// read.
    pub(crate) fn near(&self, area: &Bounds, mut found: impl FnMut(K, &Bounds)) -> u64 {
        let mut work = 0;
        let _ = self.look(area, &mut work, |key, bounds| {
            found(key, bounds);
            ControlFlow::Continue(())
        });
        work
    }

    /// True where `is_it` holds for a box that touches `area`.
    pub(crate) fn any_near(&self, area: &Bounds, is_it: impl Fn(K) -> bool) -> bool {
        let seek = |key: K, _: &Bounds| match is_it(key) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        self.look(area, &mut 0, seek).is_break()
    }

    fn look(
        &self,
        area: &Bounds,
        work: &mut u64,
        mut found: impl FnMut(K, &Bounds) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        if area.is_empty() {
            return ControlFlow::Continue(());
        }
        let mut look = |first: u32, work: &mut u64| {
            let mut at = first;
            while let Some(boxed) = self.boxes.get(at as usize) {
                if boxed.bounds.touches(area) {
                    found(boxed.key, &boxed.bounds)?;
                }
                at = boxed.next;
                *work += 1;
            }
            ControlFlow::Continue(())
        };
        for (&level, cells) in &self.levels {
            let size = cell_size(level);
            // A box may begin one cell to the left of where it is met, or one below.
            let (left, bottom) = (
                cell(area.min.x, size).saturating_sub(1),
                cell(area.min.y, size).saturating_sub(1),
            );
            let (right, top) = (cell(area.max.x, size), cell(area.max.y, size));
            let columns = (i64::from(right) - i64::from(left) + 1) as u64;
            let rows = (i64::from(top) - i64::from(bottom) + 1) as u64;
            // Few occupied cells: with a large area it is cheaper to look through them than through
            // all cells of the area.
            if columns.saturating_mul(rows) > cells.len() as u64 {
                *work += cells.len() as u64;
                let is_near = |&(&(x, y), _): &(&Cell, &u32)| {
                    (left..=right).contains(&x) && (bottom..=top).contains(&y)
                };
                for (_, &first) in cells.iter().filter(is_near) {
                    look(first, work)?;
                }
                continue;
            }
            *work += columns * rows;
            for x in left..=right {
                for y in bottom..=top {
                    if let Some(&first) = cells.get(&(x, y)) {
                        look(first, work)?;
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }
}

/// The level whose cells are at least as large as the box: cells of level n have a side of 2ⁿ.
fn level_of(bounds: &Bounds) -> i16 {
    let size = bounds.width().max(bounds.height()).max(1e-3);
    size.log2().ceil().clamp(-30.0, 1000.0) as i16
}

fn cell_size(level: i16) -> f64 {
    2f64.powi(i32::from(level))
}

fn cell(coordinate: f64, size: f64) -> i32 {
    (coordinate / size).floor() as i32
}

/// The level and the cell of a box: that of its lower left corner.
fn cell_of(bounds: &Bounds) -> (i16, Cell) {
    let level = level_of(bounds);
    let size = cell_size(level);
    (level, (cell(bounds.min.x, size), cell(bounds.min.y, size)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;

    #[test]
    fn one_small_box_makes_no_large_area_dear() {
        let square = |x: f64, y: f64, size: f64| {
            let min = Point::new(x, y);
            Bounds {
                min,
                max: min + crate::geometry::Vector::new(size, size),
            }
        };
        let mut grid = Grid::default();
        for key in 0..2500usize {
            grid.insert(
                key,
                square((key % 50) as f64 * 10.0, (key / 50) as f64 * 10.0, 8.0),
            );
        }
        let area = square(200.0, 200.0, 8.0);
        let alone = grid.near(&area, |_, _| {});
        grid.insert(2500, square(-20.0, -20.0, 0.001));
        let beside = grid.near(&area, |_, _| {});
        assert!(
            beside <= alone + 2,
            "{alone} looks without it, {beside} with it"
        );
    }

    #[test]
    fn finds_what_a_look_at_every_box_finds() {
        // Boxes of many sizes at scattered places, from a fixed sequence.
        let mut state = 12345u64;
        let mut number = || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 33) as f64 / (1u64 << 31) as f64
        };
        let mut boxes = Vec::new();
        let mut grid = Grid::default();
        for key in 0..500usize {
            let min = Point::new(number() * 100.0 - 50.0, number() * 100.0 - 50.0);
            let scale = 10f64.powf(number() * 4.0 - 3.0);
            let bounds = Bounds {
                min,
                max: min + crate::geometry::Vector::new(number(), number()) * scale,
            };
            grid.insert(key, bounds);
            boxes.push(bounds);
        }
        for key in (0..500).step_by(3) {
            grid.remove(key, &boxes[key]);
        }
        for area in &boxes {
            let mut found = Vec::new();
            grid.near(area, |key, _| found.push(key));
            found.sort_unstable();
            let expected: Vec<usize> = (0..500)
                .filter(|key| key % 3 != 0 && boxes[*key].touches(area))
                .collect();
            assert_eq!(found, expected);
        }
    }
}
