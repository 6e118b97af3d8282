//! Begin a closed contour with the selected block; the ways in and out lead to its start.
//!
//! ```text
//! B5000B0B5000GXL3           B5000B10000B10000GYL3       G01 X0 Y0        G01 X10 Y0
//! B10000B0B10000GXL1    →    B0B10000B10000GYL2          X10         →    Y10          ← the cursor stood here
//! B0B10000B10000GYL2         B10000B0B10000GXL3          Y10              X0 Y0
//! ```

use super::{Change, Content, Edits, Notation, Refactoring, Rewrite, Sheet};
use crate::geometry::{Segment, meetings, turn};
use crate::program::grid::Node;
use std::ops::Range;

pub(super) fn start_here<N: Notation>() -> Refactoring<N> {
    Refactoring {
        id: "refactor.rewrite.startHere",
        title: |_| say!(begin_the_contour_with_this_block).into(),
        rewrite: begun_here,
    }
}

/// Moves that turn by no more than this, rad, are tangent: the numbers of a program are rounded.
const TANGENT: f64 = 2e-3;

/// A way in or out may meet the contour only within this distance of its end, µm.
const TOUCH: f64 = 3.0;

fn begun_here<N: Notation>(sheet: &Sheet<'_, N>) -> Edits {
    let content = sheet.content()?;
    let (rows, line) = (&content.rows, sheet.selected_lines().start);
    let first = rows.iter().position(|row| row.line == line);
    let first = first.ok_or(say!(no_block_is_selected))?;
    let mut contours = content.contours.iter();
    let contour = contours
        .find(|contour| contour.steps.contains(&first))
        .ok_or(say!(no_contour_is_selected))?;
    let own = content.closed(contour)?;
    if !own.contains(&first) {
        return Err(say!(the_block_leads_to_the_contour_or_away_from_it).into());
    }
    if first == own.start {
        return Ok(Vec::new());
    }
    let all = contour.steps.clone();
    let lines = rows[all.start].line..rows[all.end - 1].line + 1;
    let is_corner = turn(
        rows[first - 1].piece.end_tangent(),
        rows[first].piece.start_tangent(),
    );
    let is_corner = is_corner.abs() > TANGENT;
    N::refuse(sheet, Change::StartHere { lines, is_corner })?;
    let begin = rows[first].from;
    let mut rewrite = Rewrite::new();
    for (place, row) in own.clone().zip((first..own.end).chain(own.start..first)) {
        let kept = N::kept(sheet.at(content, row), place);
        rewrite.rows.insert(place, vec![kept]);
    }
    match (own.start - all.start, all.end - own.end) {
        (0, 0) if content.contours.len() == 1 && !sheet.trace.writing.names_places => {
            rewrite.start = Some(begin);
            rewrite.end = Some(Content::<N>::point(begin));
        }
        (0, 0) => return Err(say!(what_comes_before_and_behind_leads_to_the_present_start).into()),
        (1, 0 | 1) => {
            N::refuse_begin(content, own.start, first)?;
            let hole = rows[all.start].from;
            rewrite.stretch = None;
            let mut lead = |row: usize, ends: [Node; 2], far: Node| {
                if rows[row].piece.as_arc().is_some() {
                    return Err(say!(the_way_is_an_arc, rows[row].line + 1));
                }
                refuse_crossing(content, own.clone(), far, begin)?;
                let straight = N::straight(sheet.at(content, row), ends)?;
                rewrite.rows.insert(row, straight);
                Ok(())
            };
            lead(all.start, [hole, begin], hole)?;
            if own.end < all.end {
                let away = rows[own.end].to;
                lead(own.end, [begin, away], away)?;
            } else {
                rewrite.end = Some(Content::<N>::point(begin));
                if own.end < rows.len() {
                    return Err(say!(what_comes_behind_begins_at_the_present_end).into());
                }
            }
        }
        _ => return Err(say!(the_way_in_or_out_is_more_than_one_block).into()),
    }
    rewrite.edits(sheet, content)
}

/// An error where the straight way from `hole` to `begin` cuts through the contour.
fn refuse_crossing<N: Notation>(
    content: &Content<N>,
    own: Range<usize>,
    hole: Node,
    begin: Node,
) -> Result<(), String> {
    if hole == begin {
        return Err(say!(the_thread_hole_lies_on_the_start).into());
    }
    let way = Segment::line(Content::<N>::point(hole), Content::<N>::point(begin));
    for row in &content.rows[own] {
        let mut met = meetings(&way, &row.piece).into_iter();
        if met.any(|at| (at - way.end()).norm() > TOUCH) {
            return Err(say!(
                the_way_from_the_thread_hole_would_cut_the_contour,
                row.line + 1
            ));
        }
    }
    Ok(())
}
