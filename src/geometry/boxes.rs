//! Boxes of consecutive pieces of a way, boxes about pairs of them, and so on up to one: which of the earlier ones a
//! later one touches.
//!
//! Neighbours along a way are neighbours in the plane, so nothing is sorted, and a way is taken only as far as it is
//! needed.

use super::Bounds;
use std::ops::Range;

#[derive(Debug, Default)]
pub(crate) struct Boxes {
    levels: Vec<Vec<Bounds>>,
}

impl Boxes {
    pub(crate) fn of(boxes: impl Iterator<Item = Bounds>) -> Boxes {
        let mut all = Boxes::default();
        boxes.for_each(|own| all.push(own));
        all
    }

    pub(crate) fn push(&mut self, own: Bounds) {
        if self.levels.is_empty() {
            self.levels.push(Vec::new());
        }
        let mut index = self.levels[0].len();
        for level in &mut self.levels {
            match level.get_mut(index) {
                Some(whole) => whole.merge(&own),
                None => level.push(own),
            }
            index /= 2;
        }
        if let Some([one, other]) = self.levels.last().map(Vec::as_slice) {
            let whole = one.merged(other);
            self.levels.push(vec![whole]);
        }
    }

    /// The level of the box about all.
    pub(crate) fn top(&self) -> usize {
        self.levels.len().saturating_sub(1)
    }

    /// A box by its level, 0 for those of the pieces, and its number there.
    pub(crate) fn get(&self, level: usize, index: usize) -> Option<&Bounds> {
        self.levels.get(level)?.get(index)
    }

    /// Hands out the pieces before `end` whose boxes touch a box, in order; returns the number of boxes that it was
    /// compared with.
    pub(crate) fn touching(&self, own: &Bounds, end: usize, each: &mut impl FnMut(usize)) -> usize {
        self.look((self.top(), 0), own, end, each)
    }

    fn look(
        &self,
        (level, index): (usize, usize),
        own: &Bounds,
        end: usize,
        each: &mut impl FnMut(usize),
    ) -> usize {
        let touches = |bounds: &Bounds| bounds.touches(own);
        if index << level >= end || !self.get(level, index).is_some_and(touches) {
            return 1;
        }
        match level.checked_sub(1) {
            None => {
                each(index);
                1
            }
            Some(below) => {
                let mut half = |index| self.look((below, index), own, end, each);
                1 + half(2 * index) + half(2 * index + 1)
            }
        }
    }

    /// Hands out all pieces in order: those whose boxes touch a box each by itself, and between them ranges of which a box
    /// about all does not touch it. Returns the number of boxes that it was compared with.
    pub(crate) fn parted(&self, own: &Bounds, each: &mut impl FnMut(Range<usize>, bool)) -> usize {
        match self.levels.is_empty() {
            true => 0,
            false => self.part((self.top(), 0), own, each),
        }
    }

    fn part(
        &self,
        (level, index): (usize, usize),
        own: &Bounds,
        each: &mut impl FnMut(Range<usize>, bool),
    ) -> usize {
        let Some(bounds) = self.get(level, index) else {
            return 0;
        };
        let count = self.levels[0].len();
        let touches = bounds.touches(own);
        match level.checked_sub(1).filter(|_| touches) {
            None => {
                each(index << level..((index + 1) << level).min(count), touches);
                1
            }
            Some(below) => {
                let mut half = |index| self.part((below, index), own, each);
                1 + half(2 * index) + half(2 * index + 1)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn those_that_touch_are_found_in_order(
            places in prop::collection::vec((0_i32..30, 0_i32..30, 0_i32..6, 0_i32..6), 0..40),
            (x, y, size, end) in (0_i32..30, 0_i32..30, 0_i32..9, 0_usize..45),
        ) {
            let bounds = |x: i32, y: i32, by: [i32; 2]| Bounds {
                min: Point::new(f64::from(x), f64::from(y)),
                max: Point::new(f64::from(x + by[0]), f64::from(y + by[1])),
            };
            let all: Vec<Bounds> = places.iter().map(|&(x, y, w, h)| bounds(x, y, [w, h])).collect();
            let own = bounds(x, y, [size, size]);
            let mut found = Vec::new();
            Boxes::of(all.iter().copied()).touching(&own, end, &mut |index| found.push(index));
            let each = all.iter().enumerate().take(end);
            let expected: Vec<usize> = each.filter(|(_, one)| one.touches(&own)).map(|(index, _)| index).collect();
            prop_assert_eq!(&found, &expected);
            let (mut alone, mut all_of) = (Vec::new(), Vec::new());
            Boxes::of(all.iter().copied()).parted(&own, &mut |range, touches| {
                alone.extend(range.clone().filter(|_| touches));
                let about = range.clone().fold(Bounds::EMPTY, |about, index| about.merged(&all[index]));
                assert_eq!(about.touches(&own), touches);
                all_of.extend(range);
            });
            prop_assert_eq!(all_of, (0..all.len()).collect::<Vec<_>>());
            prop_assert!(found.iter().all(|index| alone.contains(index)));
        }
    }

    /// About a place between two long rows nearly all boxes are passed over, in few pieces.
    #[test]
    fn few_boxes_are_asked_about_a_place_between_two_rows() {
        let row = |y: f64, from: f64, by: f64| {
            let own = move |at: i32| from + by * f64::from(at);
            (0..1000).map(move |at| {
                let ends = [own(at), own(at + 1)].map(|x| Point::new(x, y));
                Bounds::of_points(&ends)
            })
        };
        let boxes = Boxes::of(row(0.0, 0.0, 1.0).chain(row(5.0, 1000.0, -1.0)));
        for x in [0.5, 123.4, 500.0, 999.5] {
            let here = Bounds::of_points(&[Point::new(x, 2.5)]);
            let mut pieces = 0;
            let asked = boxes.parted(&here, &mut |_, _| pieces += 1);
            assert!(asked < 50 && pieces < 25, "{asked} {pieces}");
        }
    }
}
