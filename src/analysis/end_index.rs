//! An index of what the ends of single lines may face, for hatches of thousands of lines.

use super::Analysis;
use crate::drawing::{ContourKey, Drawing};
use crate::geometry::{Bounds, Grid, Line, Point, Segment, Shell, Shells};
use std::iter::once;

/// Two ends of lines belong together within this share of a line's length.
pub(super) const SHARE: f64 = 0.25;

/// Ends of the contours of a drawing.
pub(super) struct EndIndex {
    /// The reaches of single lines beyond both ends: two lines face each other where these meet.
    stubs: Shells<ContourKey>,
    /// The ends of other open contours.
    ends: Grid<ContourKey>,
}

impl EndIndex {
    pub(super) fn of(analysis: &Analysis, drawing: &Drawing) -> EndIndex {
        let stubs = analysis.lone.iter().flat_map(|(&key, lone)| {
            let stubs = stubs_of(&lone.line).into_iter();
            stubs.map(move |stub| (key, stub))
        });
        let mut ends = Grid::default();
        for &key in analysis.known.keys() {
            if !analysis.lone.contains_key(&key) {
                for end in analysis.ends_of(drawing, key) {
                    ends.insert(key, Bounds::of_points(&[end]));
                }
            }
        }
        EndIndex {
            stubs: Shells::new(stubs.collect()),
            ends,
        }
    }

    /// True where `is_faced` holds for another contour whose ends come near those of a line: within `reach`, or for a
    /// line within `join` of where its ends lead on.
    pub(super) fn any_near(
        &self,
        line: &Line,
        (reach, join): (f64, f64),
        is_faced: impl Fn(ContourKey) -> bool,
    ) -> bool {
        let ends: [Point; 2] = [line.start, line.end];
        let stubs = stubs_of(line);
        ends.iter()
            .any(|&end| self.ends.any_near(&Bounds::of_disc(end, reach), &is_faced))
            || stubs
                .iter()
                .any(|stub| self.stubs.any_near(stub, join, &is_faced))
    }
}

fn stubs_of(line: &Line) -> [Shell; 2] {
    let (start, end) = (line.start, line.end);
    let on = (end - start) * SHARE;
    [(start, start - on), (end, end + on)]
        .map(|(from, to)| Shell::of(once(Segment::line(from, to))))
}
