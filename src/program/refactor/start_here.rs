//! Begin a closed contour with the selected block; the ways in and out lead to its start.
//!
//! ```text
//! B5000B0B5000GXL3           B5000B10000B10000GYL3       G01 X0 Y0        G01 X10 Y0
//! B10000B0B10000GXL1    →    B0B10000B10000GYL2          X10         →    Y10          ← the cursor stood here
//! B0B10000B10000GYL2         B10000B0B10000GXL3          Y10              X0 Y0
//! ```

use super::moves::{Change, Edits, Move, Place, point};
use super::proof::rewritten;
use super::sheet::Sheet;
use crate::geometry::{Segment, meetings, turn};
use std::ops::Range;

/// Moves that turn by no more than this, rad, are tangent: the numbers of a program are rounded.
const TANGENT: f64 = 2e-3;

/// Two contours' directions are the same within this, rad: a correction of 0.5 mm differs by 0.5 µm.
const ALONG: f64 = 1e-3;

/// A way in or out may meet the contour only within this distance of its end, µm.
const TOUCH: f64 = 3.0;

pub(in crate::program) fn begun_here(sheet: &Sheet<'_>) -> Edits {
    let (moves, line) = (&sheet.moves, sheet.selected_lines().start);
    let first = moves.iter().position(|own| own.line == line);
    let first = first.ok_or(say!(no_block_is_selected))?;
    let mut contours = sheet.contours.iter();
    let contour = contours
        .find(|contour| contour.steps.contains(&first))
        .ok_or(say!(no_contour_is_selected))?;
    let own = sheet.closed(contour)?;
    if !own.contains(&first) {
        return Err(say!(the_block_leads_to_the_contour_or_away_from_it).into());
    }
    if first == own.start {
        return Ok(Vec::new());
    }
    let all = contour.steps.clone();
    let leads = [own.start - all.start, all.end - own.end];
    let direction = |index: usize| moves[index].piece.start_tangent();
    let corner = turn(moves[first - 1].piece.end_tangent(), direction(first));
    let elsewhere = turn(direction(own.start), direction(first));
    let mut rewrite = sheet.rewrite();
    rewrite.words = sheet.words(&Change::StartHere {
        lines: moves[all.start].line..moves[all.end - 1].line + 1,
        is_corner: corner.abs() > TANGENT,
        is_led_elsewhere: leads[0] == 1 && elsewhere.abs() > ALONG,
    })?;
    let begin = moves[first].from;
    for (place, kept) in own.clone().zip((first..own.end).chain(own.start..first)) {
        // The side depends on the place in the program.
        let side = moves[place].side;
        rewrite.moves[place] = Some(Move {
            side,
            ..moves[kept]
        });
    }
    match leads {
        [0, 0] if sheet.contours.len() == 1 && !sheet.names_places() => {
            rewrite.start = Some(begin);
            rewrite.end = Some(point(begin));
        }
        [0, 0] => return Err(say!(what_comes_before_and_behind_leads_to_the_present_start).into()),
        [1, 0 | 1] => {
            rewrite.factor = None;
            let mut lead = |index: usize, ends: [Place; 2], far: Place| {
                if moves[index].is_arc() {
                    return Err(say!(the_way_is_an_arc, moves[index].line + 1));
                }
                refuse_crossing(sheet, own.clone(), far, begin)?;
                rewrite.moves[index] = Some(moves[index].straight(ends));
                Ok(())
            };
            let hole = moves[all.start].from;
            lead(all.start, [hole, begin], hole)?;
            if own.end < all.end {
                let away = moves[own.end].to;
                lead(own.end, [begin, away], away)?;
            } else if own.end < moves.len() {
                return Err(say!(what_comes_behind_begins_at_the_present_end).into());
            } else {
                rewrite.end = Some(point(begin));
            }
        }
        _ => return Err(say!(the_way_in_or_out_is_more_than_one_block).into()),
    }
    rewritten(sheet, &rewrite)
}

/// An error where the straight way from `hole` to `begin` cuts through the contour.
fn refuse_crossing(
    sheet: &Sheet<'_>,
    own: Range<usize>,
    hole: Place,
    begin: Place,
) -> Result<(), String> {
    if hole == begin {
        return Err(say!(the_thread_hole_lies_on_the_start).into());
    }
    let way = Segment::line(point(hole), point(begin));
    for own in &sheet.moves[own] {
        let mut met = meetings(&way, &own.piece).into_iter();
        if met.any(|at| (at - way.end()).norm() > TOUCH) {
            return Err(say!(
                the_way_from_the_thread_hole_would_cut_the_contour,
                own.line + 1
            ));
        }
    }
    Ok(())
}
