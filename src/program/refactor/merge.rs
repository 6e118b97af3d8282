//! Merge lines that run on in the same direction.
//!
//! ```text
//! B2000B1000B2000GXL1     →    B6000B3000B6000GXL1          G01 X2. Y1.     →     G01 X6. Y3.
//! B4000B2000B4000GXL1                                       X6. Y3.
//! ```
//!
//! Lines with a comment between them stay: the comment marks the place. What the merged line leaves out lies within
//! [`ASIDE`] of it.

use super::{Content, Edits, Notation, Refactoring, Rewrite, Sheet};
use crate::geometry::Line;
use std::ops::Range;

pub(super) fn merge<N: Notation>() -> Refactoring<N> {
    Refactoring {
        id: "refactor.rewrite.merge",
        title: |_| say!(merge_collinear_blocks).into(),
        rewrite: merged,
    }
}

/// The largest distance of a node from the line that replaces it, µm: half the diagonal of the grid, which is what
/// snapping costs.
const ASIDE: f64 = 0.75;

fn merged<N: Notation>(sheet: &Sheet<'_, N>) -> Edits {
    let content = sheet.content()?;
    let selected = sheet.selected_rows(content);
    let mut rewrite = Rewrite::new();
    for contour in &content.contours {
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
                let run = run(sheet, content, index..end);
                if run.len() > 1 {
                    let ends = [content.rows[run.start].from, content.rows[run.end - 1].to];
                    let whole = N::straight(sheet.at(content, run.start), ends)?;
                    rewrite.rows.insert(run.start, whole);
                    for left_out in run.start + 1..run.end {
                        rewrite.rows.insert(left_out, Vec::new());
                    }
                }
                index = run.end;
            }
        }
    }
    rewrite.edits(sheet, content)
}

/// The longest run of rows from the first one on that one line can replace.
fn run<N: Notation>(
    sheet: &Sheet<'_, N>,
    content: &Content<N>,
    rows: Range<usize>,
) -> Range<usize> {
    let start = rows.start;
    let mut end = start + 1;
    let runs_on = |row: usize| N::runs_on(sheet.at(content, row), start);
    if !runs_on(start) {
        return start..end;
    }
    let from = content.rows[start].from;
    while end < rows.end && !content.is_behind_pause(end) && runs_on(end) {
        let to = content.rows[end].to;
        let whole = Line {
            start: Content::<N>::point(from),
            end: Content::<N>::point(to),
        };
        let length = (to.x - from.x).abs().max((to.y - from.y).abs());
        let mut last = 0.0;
        // Every node on the way lies near the line, and none goes back.
        let is_straight = (start..end).all(|index| {
            let node = Content::<N>::point(content.rows[index].to);
            let share = whole.share_of(node);
            let forward = share > last && share < 1.0;
            last = share;
            forward && whole.distance_to(node) <= ASIDE
        });
        if length == 0 || length > N::longest(sheet.settings) || !is_straight {
            break;
        }
        end += 1;
    }
    start..end
}
