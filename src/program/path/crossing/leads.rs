//! Where the way meets its own leads: in the scrap, where nothing of the part is cut.

use super::{BESIDE, Tangle, step_across};
use crate::geometry::{Point, Segment};

/// This many blocks may follow the closing point of a way.
const MOST_BEYOND: usize = 8;

/// Cosine of the largest turn between the arc of a lead and its tangent.
const SMOOTH: f64 = 0.999;

impl Tangle<'_> {
    /// Whether what happens at a place on two pieces is the business of ways in and out alone.
    pub(super) fn is_of_leads(&self, first: usize, second: usize, at: Point) -> bool {
        self.is_where_leads_end(first, second, at)
            || self.goes_on_past_its_start(first, second, at)
            || self.cuts_the_end_of_the_way_in(first, second, at)
            || self.are_ways_in_and_out(first, second)
            || self.steps_aside_over_a_lead(first, second)
            || self.is_between_passes_to_and_fro(first, second, at)
    }

    /// Lead-in and lead-out end on the contour, and may reach it from different sides.
    fn is_where_leads_end(&self, first: usize, second: usize, at: Point) -> bool {
        let piece = |index: usize| self.at(index);
        let near = |end: Option<Point>| {
            end.is_some_and(|end| {
                (end - at).norm() <= 2.0 * self.margin || self.run_beside(first, second, at, end)
            })
        };
        let back = |count: usize| self.pieces.len().checked_sub(count).and_then(piece);
        first <= 2
            && second + 3 >= self.pieces.len()
            && [0, 1]
                .into_iter()
                .any(|index| near(piece(index).map(|piece| piece.end())))
            && ([1, 2]
                .into_iter()
                .any(|count| near(back(count).map(|piece| piece.start())))
                || near(back(1).map(|piece| piece.end())))
    }

    /// Two pieces side by side from one place to another. An arc that leads to a contour runs there before its end:
    /// rounding decides where the two cross.
    fn run_beside(&self, first: usize, second: usize, from: Point, to: Point) -> bool {
        let is_on = |index: usize, point: Point| {
            let piece = self.at(index);
            piece.is_some_and(|piece| piece.distance_to(point) <= self.margin)
        };
        let middle = nalgebra::center(&from, &to);
        [to, middle]
            .into_iter()
            .all(|point| is_on(first, point) && is_on(second, point))
    }

    /// The way out, from the start of a tab, crosses the way in: both run through scrap. Each is a line, or a line and
    /// an arc tangent to it and to the contour, and the wire turns back at the thread hole.
    fn are_ways_in_and_out(&self, first: usize, second: usize) -> bool {
        let Some(last) = self.pieces.len().checked_sub(1).filter(|last| *last > 4) else {
            return false;
        };
        let is_smooth = |one: usize, other: usize| {
            let (one, other) = (self.at(one), self.at(other));
            one.zip(other)
                .is_some_and(|(one, other)| one.end_tangent().dot(&other.start_tangent()) > SMOOTH)
        };
        let is_arc = |index: usize| self.at(index).is_some_and(|it| it.as_arc().is_some());
        let way_in = 1 + usize::from(is_arc(1) && is_smooth(0, 1) && is_smooth(1, 2));
        let out = is_arc(last - 1) && is_smooth(last - 2, last - 1) && is_smooth(last - 1, last);
        let (Some(begin), Some(end)) = (self.at(0), self.at(last)) else {
            return false;
        };
        first < way_in
            && second >= last - usize::from(out)
            && (begin.start() - end.end()).norm() <= 2.0 * self.margin
            && begin.start_tangent().dot(&end.end_tangent()) < 0.0
    }

    /// Between two passes the wire steps away from the end of the tab, into the scrap, and over the way in or out there.
    fn steps_aside_over_a_lead(&self, first: usize, second: usize) -> bool {
        let is_step = |index: usize| {
            let Some(step) = self.at(index) else {
                return false;
            };
            let before = index.checked_sub(1).and_then(|before| self.at(before));
            let behind = match index + 1 == self.pieces.len() {
                true => self.next,
                false => self.at(index + 1),
            };
            let goes_back = |other: Segment| {
                let [from, to] = [step.start() - other.end(), step.end() - other.start()];
                from.norm().max(to.norm()) <= self.margin
            };
            step.as_arc().is_none()
                && step.length() <= BESIDE
                && [before, behind].into_iter().flatten().any(goes_back)
        };
        first <= 1 && is_step(second) || second + 2 >= self.pieces.len() && is_step(first)
    }

    /// The pass back lies beside the one that the way in leads to: the way out begins beside the end of the way in, and
    /// crosses it or the pass at its begin. What it would cut off is the strip between the two passes.
    fn is_between_passes_to_and_fro(&self, first: usize, second: usize, at: Point) -> bool {
        if first > 2 || second + 3 < self.pieces.len() {
            return false;
        }
        let middle = self.pieces.len() / 2;
        let between =
            (middle.saturating_sub(2)..=middle + 2).filter_map(|index| self.step_back(index));
        let Some(width) = between.reduce(f64::max) else {
            return false;
        };
        let is_near = |point: Point| (point - at).norm() <= 2.0 * width + self.margin;
        let ends = [0, 1].map(|index| self.at(index).map(|piece| piece.end()));
        let begins = [1, 2].map(|back| {
            let index = self.pieces.len().checked_sub(back)?;
            self.at(index).map(|piece| piece.start())
        });
        let any_near = |points: [Option<Point>; 2]| points.into_iter().flatten().any(is_near);
        any_near(ends) && any_near(begins)
    }

    /// The length of a step to the side after which the wire goes back beside where it came from, µm.
    fn step_back(&self, index: usize) -> Option<f64> {
        let (before, step) = (self.at(index.checked_sub(1)?)?, self.at(index)?);
        let turns_back = before
            .end_tangent()
            .dot(&self.at(index + 1)?.start_tangent())
            < -SMOOTH;
        step_across(&before, &step).filter(|_| turns_back)
    }

    /// The tab is cut beside the pass before it, through the end of the way in of that pass.
    fn cuts_the_end_of_the_way_in(&self, first: usize, second: usize, at: Point) -> bool {
        let lies_beside = |point: Point| {
            let piece = self.at(second);
            piece.is_some_and(|piece| piece.distance_to(point) <= 2.0 * self.aside + self.margin)
        };
        let ends_beside = |index: usize| {
            let end = self.at(index).map(|piece| piece.end());
            end.is_some_and(|end| lies_beside(end) && lies_beside(nalgebra::center(&at, &end)))
        };
        self.aside > 0.0 && first <= 1 && (first..=1).any(ends_beside)
    }

    /// The way goes on along its first blocks past its closing point, and out from there: it only cuts its own way in.
    /// A way in or out is a block, or a block and an arc. The same of a way that was turned round: it begins along its
    /// last blocks.
    fn goes_on_past_its_start(&self, first: usize, second: usize, at: Point) -> bool {
        let places = [first, second];
        self.overlaps(places, at, false) || self.overlaps(places, at, true)
    }

    fn overlaps(&self, [one, other]: [usize; 2], at: Point, is_turned: bool) -> bool {
        let most = MOST_BEYOND + 2;
        let turned = |index: usize| self.pieces.len().checked_sub(index + 1);
        let piece = |index: usize| match is_turned {
            true => turned(index)
                .and_then(|index| self.at(index))
                .map(|piece| piece.reversed()),
            false => self.at(index),
        };
        let (first, second) = match (is_turned, turned(other), turned(one)) {
            (true, Some(first), Some(second)) => (first, second),
            _ => (one, other),
        };
        if first > most || second + most + 1 < self.pieces.len() {
            return false;
        }
        let leads = [(1, 1), (2, 2), (1, 2), (2, 1)];
        let all = leads
            .into_iter()
            .flat_map(|leads| (1..=MOST_BEYOND).map(move |beyond| (leads, beyond)));
        all.into_iter().any(|((way_in, way_out), beyond)| {
            let Some(closes) = self.pieces.len().checked_sub(way_out + beyond) else {
                return false;
            };
            if closes < way_in + beyond || first > way_in + beyond || second + 1 < closes {
                return false;
            }
            let runs_along = |number: usize| {
                let (Some(along), Some(again)) = (piece(way_in + number), piece(closes + number))
                else {
                    return false;
                };
                [again.start(), again.point_at(0.5), again.end()]
                    .iter()
                    .all(|&point| along.distance_to(point) <= self.margin)
            };
            let starts =
                [piece(way_in), piece(closes)].map(|piece| piece.map(|piece| piece.start()));
            let [Some(begin), Some(again)] = starts else {
                return false;
            };
            let is_on = |number: usize| {
                let along = piece(way_in + number);
                along.is_some_and(|along| along.distance_to(at) <= self.margin)
            };
            (begin - again).norm() <= 2.0 * self.margin
                && (0..beyond).all(runs_along)
                && ((0..beyond).any(is_on) || self.run_beside(one, other, at, begin))
        })
    }
}
