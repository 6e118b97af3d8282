//! Reverse the direction in which contours are cut; under a correction the wire stays on its side of the part.
//!
//! ```text
//! B5000B0B5000GXL1           B5000B0B5000GXL1          G41 D1                      G42 D1
//! B5000B0B10000GYNR1    →    B5000B0B10000GYSR4        G01 X5 Y0                   G01 X5 Y0
//! B5000B0B10000GYNR3         B5000B0B10000GYSR2        G03 X-5 Y0 I-5 J0     →     G02 X-5 Y0 I-5 J0
//! B5000B0B5000GXL3           B5000B0B5000GXL3          G03 X5 Y0 I5 J0             G02 X5 Y0 I5 J0
//! ```
//!
//! Ways in and out stay where they are one way, there and back; leads that part (arcs that run along the contour at its
//! start, an overlap) are reversed with it. An open path that counts is reversed where it is the whole program: it then begins at its other end.

use super::moves::{Change, Edits, Move, point};
use super::proof::rewritten;
use super::sheet::Sheet;
use crate::finding::Side;
use crate::program::path::{Cut, tolerance};
use std::ops::Range;

pub(in crate::program) fn reversed(sheet: &Sheet<'_>) -> Edits {
    let mut rewrite = sheet.rewrite();
    let mut reversed = Vec::new();
    // What cannot be turned round at all is refused before any contour is.
    sheet.words(&Change::Reverse(&[]))?;
    for contour in sheet.selected_contours() {
        let is_all = sheet.contours.len() == 1 && !sheet.names_places();
        let own = if is_all && !contour.closed {
            sheet.refuse_pause(contour)?;
            rewrite.start = sheet.moves.last().map(|last| last.to);
            rewrite.end = Some(sheet.trace.start);
            contour.steps.clone()
        } else {
            with_leads(sheet, contour, sheet.closed(contour)?)
        };
        for (place, back) in own.clone().zip(own.clone().rev()) {
            rewrite.moves[place] = Some(sheet.moves[back].reversed());
        }
        let all = contour.steps.clone();
        for (new, old) in rewrite.moves[all.clone()].iter_mut().zip(&sheet.moves[all]) {
            let side = old.side.map(Side::reversed);
            *new = new.map(|new| Move { side, ..new });
        }
        let before = contour.steps.start.checked_sub(1);
        let before = before.map_or(0, |before| sheet.moves[before].line + 1);
        let lines = before..sheet.moves[own.end - 1].line + 1;
        let mut of_contour = sheet.moves[contour.steps.clone()].iter();
        reversed.push((lines, of_contour.any(|own| own.side.is_some())));
    }
    rewrite.words = sheet.words(&Change::Reverse(&reversed))?;
    rewritten(sheet, &rewrite)
}

/// The moves of a contour, with its leads where these differ but come back to one place, else without them.
fn with_leads(sheet: &Sheet<'_>, contour: &Cut, own: Range<usize>) -> Range<usize> {
    let (moves, all) = (&sheet.moves, contour.steps.clone());
    let [leads_in, leads_out] = [&moves[all.start..own.start], &moves[own.end..all.end]];
    let (Some(first), Some(last)) = (leads_in.first(), leads_out.last()) else {
        return own;
    };
    let near = tolerance(sheet.arcs());
    let mut both = leads_in.iter().zip(leads_out.iter().rev());
    let is_one_way = leads_in.len() == leads_out.len()
        && both.all(|(there, back)| {
            let middles = [there.piece, back.piece].map(|piece| piece.point_at(0.5));
            (middles[0] - middles[1]).norm() <= 2.0 * near
        });
    let comes_back = match sheet.names_places() {
        true => first.from == last.to,
        false => (point(first.from) - point(last.to)).norm() <= near,
    };
    if is_one_way || !comes_back { own } else { all }
}
