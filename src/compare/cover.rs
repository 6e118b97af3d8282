//! What the passes of a program cover of their contours, and what to say of the rest: a tab is left to stand, else a block is
//! lost, or wrong.

use super::difference::Difference;
use super::foreign::Foreign;
use super::judged::{Judged, ROUNDED, SLIGHT};
use super::level::LEVEL;
use super::traced::{Cut, Motion};
use super::walk::{COVERED, WITHIN};
use crate::finding::DifferenceKind;
use crate::geometry::Point;

impl Foreign<'_> {
    /// A program that counts and follows to its end, but comes back beside where the wire is threaded by as much as it
    /// went on over the begin of its contour: its last block is too long.
    pub(super) fn comes_back(&mut self, cut: &Cut, begun: usize) {
        let blocks = self
            .traced
            .blocks
            .get(cut.blocks.clone())
            .unwrap_or_default();
        let mut ends = blocks.iter().filter_map(|block| block.motion.ends());
        let first = self.judged.get(begun).filter(|first| {
            let contour = self.drawn.contours().get(first.pass.contour);
            contour.is_some_and(|contour| contour.closed)
        });
        let begin = first.map(|first| first.ends[0]);
        let is_sound = self
            .judged
            .iter()
            .skip(begun)
            .all(|judged| judged.differences.is_empty());
        let (Some([start, first_end]), Some(begin), Some(last)) =
            (ends.next(), begin, self.judged.last_mut())
        else {
            return;
        };
        let end = ends.next_back().map_or(first_end, |[_, end]| end);
        let away = (end - start).norm();
        let is_overlap = away > SLIGHT && (end - start - (last.ends[1] - begin)).norm() <= WITHIN;
        if self.traced.is_relative
            && is_sound
            && is_overlap
            && let Some(block) = last.end.checked_sub(1)
            && let Some(block) = self.traced.blocks.get(block)
        {
            last.differences
                .push(Difference::of(block, None, away, DifferenceKind::Block));
        }
    }

    /// Names what is not covered. What a tab leaves is covered after a stop, at one offset or more.
    pub(super) fn cover(&mut self) {
        let mut named = Vec::new();
        for (number, judged) in self.judged.iter().enumerate() {
            let Some(gap) = &judged.gap else { continue };
            let others = self
                .of_contour(judged)
                .filter(|(other, _)| *other != number);
            let (mut is_filled, mut is_passed) = (false, false);
            for (other, it) in others {
                let is_same = (it.pass.offset - judged.pass.offset).abs() <= LEVEL;
                // A pass all the way round is one of its own.
                is_filled |= is_same && !it.is_whole() && it.covers_rest_of(judged);
                // What is left of a tab is cut once, or at each offset.
                is_passed |= other < number || it.covers_rest_of(judged);
            }
            // One change in a program that counts moves what comes after it: it is one finding.
            let mut all = self.of_contour(judged);
            let is_moved = self.traced.is_relative && all.any(|(_, it)| !it.differences.is_empty());
            let is_tab = judged.is_tab && self.is_tab_of_all(judged);
            let is_left = is_tab && is_passed || judged.is_tab && is_moved;
            if !is_filled && !is_left {
                let wrong = self.at_edge(judged).filter(|_| is_tab);
                named.push((number, wrong.unwrap_or_else(|| gap.clone())));
            }
        }
        for (number, gap) in named {
            // What comes after it in a program that counts is moved by it.
            if let Some(next) = self.judged.get_mut(number + 1)
                && self.traced.is_relative
            {
                let is_moved = |one: &Difference| one.kind == DifferenceKind::Moved;
                next.differences.retain(|one| !is_moved(one));
            }
            let mut all = self.judged.iter().flat_map(|judged| &judged.differences);
            let is_named = all.any(|one| one.line == gap.line);
            if let (Some(judged), false) = (self.judged.get_mut(number), is_named) {
                judged.differences.push(gap);
            }
        }
    }

    /// Whether no pass of the same contour goes farther round: each leaves the same tab.
    fn is_tab_of_all(&self, judged: &Judged) -> bool {
        const LONGER: f64 = 500.0;
        let all = self.of_contour(judged).map(|(_, it)| it);
        let whole = all.filter(|it| it.is_whole());
        // Where one goes all the way round, there is none.
        let least = whole.map(Judged::left).fold(judged.left(), f64::min);
        least > COVERED && judged.left() <= least + LONGER
    }

    /// All passes of the contour of one, with their numbers.
    fn of_contour(&self, judged: &Judged) -> impl Iterator<Item = (usize, &Judged)> {
        let contour = judged.pass.contour;
        let all = self.judged.iter().enumerate();
        all.filter(move |(_, it)| it.pass.contour == contour)
    }

    /// A block behind the stop after a pass that follows nothing, and begins or ends where the pass leaves a tab.
    fn at_edge(&self, judged: &Judged) -> Option<Difference> {
        let follows = |index: &usize| self.judged.iter().any(|it| it.follows.contains(index));
        let blocks = self.traced.blocks.get(judged.end..).unwrap_or_default();
        let before = blocks
            .iter()
            .take_while(|block| block.motion != Motion::Stop);
        let behind = judged.end + before.count();
        let mut rest = (behind..self.traced.blocks.len()).filter(|index| !follows(index));
        rest.find_map(|index| {
            let block = self.traced.blocks.get(index)?;
            let own = block.segment()?.moved(judged.shift);
            let is_near = |end: Point| {
                judged
                    .edges
                    .iter()
                    .any(|edge| (edge - end).norm() <= 2.0 * WITHIN)
            };
            let is_it = own.length() > ROUNDED && (is_near(own.start()) || is_near(own.end()));
            is_it.then(|| Difference::of(block, None, own.length(), DifferenceKind::Block))
        })
    }
}
