//! Segments come into a long contour or leave it: what is known of those after them stays, under other indices. Looked
//! at as a whole, a polyline of 140,000 vertices takes twelve times as long for an edit, which is more than a frame.

use super::Analysis;
use super::compare::{RunId, ordered};
use super::known::Known;
use super::pairs::Pairs;
use crate::drawing::{ContourKey, Drawing, RUN};
use crate::rules::NEIGHBOURS;
use rustc_hash::FxHashSet;
use std::ops::Range;

/// A contour of this many runs or more is not looked at from scratch because segments come or go.
const LONG: usize = 4;

impl Analysis {
    /// Follows an edit that adds or removes vertices of an entity that is a long contour by itself: what is known of the
    /// segments after them stays, under other indices. Returns the vertices that are to be looked at, as a splice that
    /// keeps the count; `None`, with nothing done, where all of it is to be looked at. The runs about the splice are `forgotten`.
    pub(super) fn splice(
        &mut self,
        drawing: &Drawing,
        key: ContourKey,
        known: &mut Known,
        (start, removed, inserted): (usize, usize, usize),
        forgotten: &mut FxHashSet<usize>,
    ) -> Option<(usize, usize, usize)> {
        let contour = self.chains.get(key)?;
        let [piece] = contour.pieces.as_slice() else {
            return None;
        };
        let (gone, come) = (start.checked_sub(1)?..start + removed, inserted + 1);
        let index = &mut known.index;
        let about = gone.start.checked_sub(NEIGHBOURS)?..gone.end + NEIGHBOURS;
        let is_inside = about.start > 0 && about.end < index.len();
        if piece.reversed || !is_inside || come > RUN || index.run_count() < LONG {
            return None;
        }
        let about = index.runs_over(about);
        let about: Vec<_> = about.map(|run| (run, index.bounds_of_run(run))).collect();
        let behind = index.runs_over(gone.clone()).end;
        let first = index.range_of(behind).start;
        let tight = self.tight_below();
        if !index.splice(drawing, contour, tight, (gone, come)) {
            return None;
        }
        for (run, bounds) in about {
            if forgotten.insert(run) {
                self.pairs.forget_run((key, run as u32), &bounds);
            }
        }
        let by = inserted as isize - removed as isize;
        let runs = behind as u32..index.run_count() as u32;
        self.pairs.shift(key, runs, first, by);
        known.shift(behind, by);
        Some((start, inserted, inserted))
    }
}

impl Pairs {
    /// To be called when the segments of a contour from `first` on have other indices, which lie in these runs, and nothing
    /// is known of the segment before them.
    fn shift(&mut self, key: ContourKey, runs: Range<u32>, first: usize, by: isize) {
        for run in runs.clone() {
            let partners: Vec<RunId> = self.partners_of((key, run)).collect();
            for partner in partners {
                // Between two of these runs once.
                let is_later = partner.0 == key && partner.1 < run && runs.contains(&partner.1);
                if !is_later {
                    self.seen
                        .shift(&ordered((key, run), partner), key, first, by);
                }
            }
        }
    }
}
