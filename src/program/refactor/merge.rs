//! Merge lines that run on in the same direction.
//!
//! ```text
//! B2000B1000B2000GXL1     →    B6000B3000B6000GXL1          G01 X2. Y1.     →     G01 X6. Y3.
//! B4000B2000B4000GXL1                                       X6. Y3.
//! ```
//!
//! Lines with a comment between them stay: the comment marks the place. What the merged line leaves out lies within
//! [`ASIDE`] of it.

use super::moves::{Edits, Place, point};
use super::proof::rewritten;
use super::sheet::Sheet;
use crate::geometry::Line;
use std::ops::Range;

/// The largest distance of a node from the line that replaces it, µm: half the diagonal of the grid, which is what
/// snapping costs.
const ASIDE: f64 = 0.75;

pub(in crate::program) fn merged(sheet: &Sheet<'_>) -> Edits {
    let selected = sheet.selected_moves();
    let mut rewrite = sheet.rewrite();
    for contour in &sheet.contours {
        // Ways in and out end where the contour begins, whatever their direction.
        let own = contour.contour_steps();
        let parts = [
            contour.steps.start..own.start,
            own.clone(),
            own.end..contour.steps.end,
        ];
        for part in parts {
            let end = part.end.min(selected.end);
            let mut index = part.start.max(selected.start);
            while index < end {
                let run = run(sheet, index..end);
                if run.len() > 1 {
                    let ends = [sheet.moves[run.start].from, sheet.moves[run.end - 1].to];
                    rewrite.moves[run.start] = Some(sheet.moves[run.start].straight(ends));
                    rewrite.moves[run.start + 1..run.end].fill(None);
                }
                index = run.end;
            }
        }
    }
    rewritten(sheet, &rewrite)
}

/// The longest run of moves from the first one on that one line can replace.
fn run(sheet: &Sheet<'_>, moves: Range<usize>) -> Range<usize> {
    let (start, from) = (moves.start, sheet.moves[moves.start].from);
    let mut end = start + 1;
    let is_line = |index: usize| !sheet.moves[index].is_arc();
    let runs_on = |end: usize| {
        is_line(end)
            && sheet.printer.goes_on(end)
            && !sheet.is_behind_pause(end)
            && is_straight(sheet, start..end, from, sheet.moves[end].to)
    };
    while is_line(start) && end < moves.end && runs_on(end) {
        end += 1;
    }
    start..end
}

/// Whether every node between the moves lies near the line that would replace them and the next, and none goes back.
fn is_straight(sheet: &Sheet<'_>, moves: Range<usize>, from: Place, to: Place) -> bool {
    let [start, end] = [from, to].map(point);
    let whole = Line { start, end };
    let length = (to[0] - from[0]).abs().max((to[1] - from[1]).abs());
    let mut last = 0.0;
    let mut nodes = sheet.moves[moves].iter().map(|own| point(own.to));
    let are_near = nodes.all(|node| {
        let share = whole.share_of(node);
        let forward = share > last && share < 1.0;
        last = share;
        forward && whole.distance_to(node) <= ASIDE
    });
    length > 0 && length <= sheet.printer.longest() && are_near
}
