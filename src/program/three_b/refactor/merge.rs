//! Merge lines that run on in the same direction.
//!
//! ```text
//! B2000B1000B2000GXL1     →    B6000B3000B6000GXL1
//! B4000B2000B4000GXL1
//! ```
//!
//! Lines with a comment between them stay: the comment marks the place. What the merged line leaves out lies within
//! [`ASIDE`] of it.

use super::Refactoring;
use super::rewrite::{New, Rewrite};
use super::sheet::{Content, Row, Sheet};
use crate::geometry::{Line, Point, Segment};
use crate::program::three_b::block::{Motion, Node};
use crate::program::three_b::encode::{Encoded, line_block};
use crate::text::TextEdit;
use std::ops::Range;

pub const MERGE: Refactoring = Refactoring {
    id: "refactor.rewrite.merge",
    title: |_| "Merge collinear blocks".into(),
    rewrite: merge,
};

/// How far a node may lie from the line that takes its place, µm: half the diagonal of the grid, which is what snapping costs.
const ASIDE: f64 = 0.75;

fn merge(sheet: &Sheet<'_>) -> Result<Vec<TextEdit>, String> {
    let content = sheet.content()?;
    let nodes = content.nodes()?;
    let selected = sheet.selected_rows(content);
    let mut rewrite = Rewrite {
        end: sheet.trace.end(),
        ..Rewrite::default()
    };
    for contour in &content.contours {
        // Ways in and out end where the contour begins, whatever their direction.
        let parts = [
            contour.rows.start..contour.own_rows().start,
            contour.own_rows(),
            contour.own_rows().end..contour.rows.end,
        ];
        for part in parts {
            let mut index = part.start.max(selected.start);
            while index < part.end.min(selected.end) {
                let run = run(content, &nodes, index..part.end.min(selected.end));
                if run.len() > 1 {
                    let (from, to) = (nodes[run.start].0, nodes[run.end - 1].1);
                    let piece = Segment::line(point(from), point(to));
                    let encoded = Encoded {
                        block: line_block(from, to),
                        from,
                        to,
                        piece,
                    };
                    rewrite.rows.insert(
                        run.start,
                        vec![New {
                            encoded,
                            part: None,
                            source: run.start,
                            exact: true,
                        }],
                    );
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

/// The longest run of rows from the first one on that one line can stand for.
fn run(content: &Content, nodes: &[(Node, Node)], rows: Range<usize>) -> Range<usize> {
    let start = rows.start;
    let is_line = |row: &Row| matches!(row.block.motion, Motion::Line(_)) && row.part.is_none();
    let mut end = start + 1;
    if !is_line(&content.rows[start]) {
        return start..end;
    }
    while end < rows.end
        && is_line(&content.rows[end])
        && content.rows[end].comment.is_none()
        && !content.rows[end].is_behind_pause
    {
        let (from, to) = (nodes[start].0, nodes[end].1);
        let whole = Line {
            start: point(from),
            end: point(to),
        };
        let length = (to.x - from.x).abs().max((to.y - from.y).abs());
        let mut last = 0.0;
        // Every node on the way lies beside the line, and none goes back.
        let runs_on = (start..end).all(|index| {
            let node = point(nodes[index].1);
            let share = whole.share_of(node);
            let forward = share > last && share < 1.0;
            last = share;
            forward && whole.distance_to(node) <= ASIDE
        });
        if length == 0 || length > content.largest || !runs_on {
            break;
        }
        end += 1;
    }
    start..end
}

fn point(node: Node) -> Point {
    Point::new(node.x as f64, node.y as f64)
}
