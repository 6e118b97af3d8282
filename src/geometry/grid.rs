//! A hierarchical grid: which boxes come near a box, with boxes coming and going.

use super::Bounds;
use rustc_hash::FxHashMap;

/// Boxes by key. Each lies in the level whose cells are just larger than it, so it covers at most four cells there, and a
/// question looks into a few cells of each level in use. Adding, removing and asking cost what is found, whatever else
/// the grid holds, as long as boxes of one size do not lie in heaps.
#[derive(Clone, Debug)]
pub struct Grid<K> {
    cells: FxHashMap<(i16, i64, i64), Vec<(K, Bounds)>>,
    /// Number of boxes of each level in use.
    levels: FxHashMap<i16, usize>,
}

impl<K> Default for Grid<K> {
    fn default() -> Self {
        Grid { cells: FxHashMap::default(), levels: FxHashMap::default() }
    }
}

impl<K: Copy + PartialEq> Grid<K> {
    /// Adds a box; an empty one is never found.
    pub fn insert(&mut self, key: K, bounds: Bounds) {
        if bounds.is_empty() {
            return;
        }
        let level = level_of(&bounds);
        *self.levels.entry(level).or_default() += 1;
        for cell in cells(level, &bounds) {
            // Most cells hold one box: a vector that grows by itself would begin with room for four.
            self.cells.entry(cell).or_insert_with(|| Vec::with_capacity(1)).push((key, bounds));
        }
    }

    /// Removes a box that was added with these bounds.
    pub fn remove(&mut self, key: K, bounds: &Bounds) {
        if bounds.is_empty() {
            return;
        }
        let level = level_of(bounds);
        for cell in cells(level, bounds) {
            if let Some(boxes) = self.cells.get_mut(&cell) {
                boxes.retain(|(other, _)| *other != key);
                if boxes.is_empty() {
                    self.cells.remove(&cell);
                }
            }
        }
        if let Some(count) = self.levels.get_mut(&level) {
            *count -= 1;
            if *count == 0 {
                self.levels.remove(&level);
            }
        }
    }

    /// Calls `found` for each box that touches `area`, once each, in no order.
    pub fn near(&self, area: &Bounds, mut found: impl FnMut(K)) {
        if area.is_empty() {
            return;
        }
        for &level in self.levels.keys() {
            let size = cell_size(level);
            let first = |bounds: &Bounds| (cell(bounds.min.x, size), cell(bounds.min.y, size));
            let (left, bottom) = first(area);
            let (right, top) = (cell(area.max.x, size), cell(area.max.y, size));
            let columns = (right.saturating_sub(left) as u64).saturating_add(1);
            let rows = (top.saturating_sub(bottom) as u64).saturating_add(1);
            let mut look = |(x, y): (i64, i64), boxes: &[(K, Bounds)]| {
                for (key, bounds) in boxes {
                    // A box that covers several cells is met in the first of them that the question covers too.
                    let (own_x, own_y) = first(bounds);
                    if bounds.touches(area) && x == own_x.max(left) && y == own_y.max(bottom) {
                        found(*key);
                    }
                }
            };
            if columns.saturating_mul(rows) > self.cells.len() as u64 {
                for (&(_, x, y), boxes) in self.cells.iter().filter(|((other, ..), _)| *other == level) {
                    look((x, y), boxes);
                }
                continue;
            }
            for x in left..=right {
                for y in bottom..=top {
                    if let Some(boxes) = self.cells.get(&(level, x, y)) {
                        look((x, y), boxes);
                    }
                }
            }
        }
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

fn cell(coordinate: f64, size: f64) -> i64 {
    (coordinate / size).floor() as i64
}

fn cells(level: i16, bounds: &Bounds) -> impl Iterator<Item = (i16, i64, i64)> + use<> {
    let size = cell_size(level);
    let (left, right) = (cell(bounds.min.x, size), cell(bounds.max.x, size));
    let (bottom, top) = (cell(bounds.min.y, size), cell(bounds.max.y, size));
    (left..=right).flat_map(move |x| (bottom..=top).map(move |y| (level, x, y)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;

    #[test]
    fn finds_what_a_look_at_every_box_finds() {
        // Boxes of many sizes at scattered places, from a fixed sequence.
        let mut state = 12345u64;
        let mut number = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as f64 / (1u64 << 31) as f64
        };
        let mut boxes = Vec::new();
        let mut grid = Grid::default();
        for key in 0..500usize {
            let min = Point::new(number() * 100.0 - 50.0, number() * 100.0 - 50.0);
            let scale = 10f64.powf(number() * 4.0 - 3.0);
            let bounds = Bounds { min, max: min + crate::geometry::Vector::new(number(), number()) * scale };
            grid.insert(key, bounds);
            boxes.push(bounds);
        }
        for key in (0..500).step_by(3) {
            grid.remove(key, &boxes[key]);
        }
        for area in &boxes {
            let mut found = Vec::new();
            grid.near(area, |key| found.push(key));
            found.sort_unstable();
            let expected: Vec<usize> = (0..500).filter(|key| key % 3 != 0 && boxes[*key].touches(area)).collect();
            assert_eq!(found, expected);
        }
    }
}
