//! Room on the sheet for numbers: beside what is drawn, and apart from each other.

use super::sheet::Frame;
use crate::geometry::Segment;
use rustc_hash::FxHashSet;

/// Lines are noted in cells of this width, in units of the sheet.
const CELL: f64 = 3.0;
/// The most cells that are noted: a denser drawing has no room anyway.
const MOST_CELLS: usize = 200_000;

/// What is taken, in coordinates of the sheet.
#[derive(Default)]
pub(super) struct Room {
    lines: FxHashSet<(i32, i32)>,
    /// Marks and numbers.
    taken: Vec<Area>,
}

/// A box on the sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area {
    pub(super) from: (f64, f64),
    pub(super) to: (f64, f64),
}

impl Area {
    /// A box about its middle.
    pub(super) fn about((x, y): (f64, f64), width: f64, height: f64) -> Area {
        Area {
            from: (x - width / 2.0, y - height / 2.0),
            to: (x + width / 2.0, y + height / 2.0),
        }
    }

    fn overlaps(&self, other: &Area) -> bool {
        self.from.0 < other.to.0
            && other.from.0 < self.to.0
            && self.from.1 < other.to.1
            && other.from.1 < self.to.1
    }
}

fn cell(along: f64) -> i32 {
    (along / CELL).floor() as i32
}

impl Room {
    /// A line is drawn along a segment.
    pub(super) fn line(&mut self, frame: &Frame, segment: &Segment) {
        let length = segment.length() * frame.scale;
        let steps = (length / CELL).ceil();
        if !steps.is_finite() || self.lines.len() + steps as usize > MOST_CELLS {
            return;
        }
        for step in 0..=steps as usize {
            let share = step as f64 / steps.max(1.0);
            let (x, y) = frame.on_sheet(segment.point_at(share));
            self.lines.insert((cell(x), cell(y)));
        }
    }

    /// A mark or a number stands in `area`.
    pub(super) fn take(&mut self, area: Area) {
        self.taken.push(area);
    }

    /// How much is in the way of a number in `area`: 0 for nothing, more than [`MOST_CELLS`] for another number.
    fn load(&self, area: &Area) -> usize {
        let [left, right] = [area.from.0, area.to.0].map(cell);
        let [top, bottom] = [area.from.1, area.to.1].map(cell);
        let columns = left..=right;
        let cells = columns.flat_map(|x| (top..=bottom).map(move |y| (x, y)));
        let lines = cells.filter(|cell| self.lines.contains(cell)).count();
        let others = self.taken.iter().filter(|other| area.overlaps(other));
        lines + others.count() * (MOST_CELLS + 1)
    }

    /// The first of some places in which nothing is in the way, else that with the least; its box is taken then.
    pub(super) fn free<T>(
        &mut self,
        places: impl IntoIterator<Item = T>,
        area_of: impl Fn(&T) -> Area,
    ) -> Option<T> {
        let mut best: Option<(usize, T)> = None;
        for place in places {
            let load = self.load(&area_of(&place));
            if best.as_ref().is_none_or(|(least, _)| load < *least) {
                best = Some((load, place));
            }
            if load == 0 {
                break;
            }
        }
        let (_, place) = best?;
        self.take(area_of(&place));
        Some(place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;

    #[test]
    fn a_number_stands_beside_lines_and_other_numbers() {
        let frame = Frame {
            origin: Point::origin(),
            scale: 1.0,
            left: 0.0,
            bottom: 0.0,
        };
        let mut room = Room::default();
        room.line(
            &frame,
            &Segment::line(Point::new(0.0, 0.0), Point::new(100.0, 0.0)),
        );
        let places = [(50.0, 0.0), (50.0, 20.0), (80.0, 20.0)];
        let area = |place: &(f64, f64)| Area::about(*place, 20.0, 10.0);
        assert_eq!(room.free(places, area), Some((50.0, 20.0)));
        assert_eq!(room.free(places, area), Some((80.0, 20.0)));
        // All are taken: rather upon a line than upon a number.
        assert_eq!(room.free(places, area), Some((50.0, 0.0)));
    }
}
