//! Which contours lie within which, and the orders of cutting that follow from it: what lies within
//! a contour is cut before it.

use crate::drawing::{Drawing, Outline, winding};
use crate::geometry::{Bounds, Grid};
use rustc_hash::FxHashMap;

/// The place that each outline is given among all, by its index, where it is given one.
pub(super) type Places = FxHashMap<usize, u32>;

/// The share of its width by which rounding moves a box.
const ROUNDING: f64 = 1e-9;

/// Which of some contours lie within which.
pub(crate) struct Nesting {
    /// By place: the places of the contours round it, the outermost first.
    pub(crate) around: Vec<Vec<usize>>,
}

impl Nesting {
    pub(crate) fn new(drawing: &Drawing, outlines: &[Outline], chosen: &[usize]) -> Nesting {
        if chosen.len() < 2 {
            return Nesting {
                around: vec![Vec::new(); chosen.len()],
            };
        }
        let boxes: Vec<Bounds> = chosen
            .iter()
            .map(|&index| outlines[index].contour.bounds(drawing))
            .collect();
        let is_closed = |place: &usize| outlines[chosen[*place]].contour.closed;
        let mut grid = Grid::default();
        let is_on_line = |place: &usize| outlines[chosen[*place]].is_on_line();
        for place in (0..chosen.len()).filter(|place| is_closed(place) && !is_on_line(place)) {
            grid.insert(place, boxes[place]);
        }
        let mut around = vec![Vec::new(); chosen.len()];
        // A slit is cut before what it lies in drops.
        for inner in (0..chosen.len()).filter(|place| is_closed(place) || is_on_line(place)) {
            let Some(first) = outlines[chosen[inner]].contour.segment(drawing, 0) else {
                continue;
            };
            let point = first.geometry.point_at(0.5);
            let holders: &mut Vec<usize> = &mut around[inner];
            grid.near(&Bounds::of_points(&[point]), |outer, _| holders.push(outer));
            holders.retain(|&outer| {
                // A line may end on what it lies in, and reach beyond its box by rounding.
                let about = match is_on_line(&inner) {
                    true => boxes[outer].grown(ROUNDING * boxes[outer].width()),
                    false => boxes[outer],
                };
                boxes[outer] != boxes[inner]
                    && about.merged(&boxes[inner]) == about
                    && winding(drawing, &outlines[chosen[outer]].contour, point) != 0
            });
            // From left to right, so that the first holder is the outermost.
            let left = |place: usize| boxes[place].min.x;
            holders.sort_by(|&a, &b| left(a).total_cmp(&left(b)).then(a.cmp(&b)));
        }
        Nesting { around }
    }

    /// What is cut out of each of `chosen` before it, in square drawing units, by the index of its outline: the areas directly within it.
    pub(crate) fn cut_out(&self, outlines: &[Outline], chosen: &[usize]) -> FxHashMap<usize, f64> {
        let mut areas = FxHashMap::default();
        for (inner, around) in self.around.iter().enumerate() {
            if let Some(&outer) = around.last() {
                let own = &outlines[chosen[inner]];
                let area = if own.is_on_line() {
                    0.0
                } else {
                    own.twice_area.abs() / 2.0
                };
                *areas.entry(chosen[outer]).or_default() += area;
            }
        }
        areas
    }

    /// When each is cut by the `places` that some are given: a contour at its own, what lies within it no later. Where none is given, last.
    pub(crate) fn turns(&self, chosen: &[usize], places: &Places) -> Vec<u32> {
        let own = |place: usize| places.get(&chosen[place]).copied().unwrap_or(u32::MAX);
        let turn = |place: usize| {
            let around = self.around[place].iter().map(|&outer| own(outer));
            around.fold(own(place), u32::min)
        };
        (0..chosen.len()).map(turn).collect()
    }

    /// Each in its turn, and directly before it what lies within it and was not cut yet, the innermost first.
    pub(crate) fn just_before(&self) -> Vec<usize> {
        let mut within = vec![Vec::new(); self.around.len()];
        for (inner, around) in self.around.iter().enumerate() {
            around.iter().for_each(|&outer| within[outer].push(inner));
        }
        let mut is_cut = vec![false; self.around.len()];
        let mut order = Vec::with_capacity(self.around.len());
        for (place, mut inner) in within.into_iter().enumerate() {
            inner.sort_by_key(|&inner| (std::cmp::Reverse(self.around[inner].len()), inner));
            for next in inner.into_iter().chain([place]) {
                if !std::mem::replace(&mut is_cut[next], true) {
                    order.push(next);
                }
            }
        }
        order
    }

    /// Leaves an order alone in which nothing comes before what it holds. Else the contours within one outermost contour follow each
    /// other, the innermost first; which outermost comes first stays as it was.
    pub(crate) fn inside_first(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.around.len()).collect();
        if self
            .around
            .iter()
            .enumerate()
            .all(|(inner, around)| around.iter().all(|&outer| outer > inner))
        {
            return order;
        }
        let outermost = |place: usize| self.around[place].first().copied().unwrap_or(place);
        let mut group: Vec<usize> = (0..self.around.len()).collect();
        for place in 0..self.around.len() {
            group[outermost(place)] = group[outermost(place)].min(place);
        }
        order.sort_by_key(|&place| {
            (
                group[outermost(place)],
                std::cmp::Reverse(self.around[place].len()),
                place,
            )
        });
        order
    }
}
