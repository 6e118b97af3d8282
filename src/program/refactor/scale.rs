//! Scale a program about the origin of its frame. Corrections, which are those of the wire, stay.
//!
//! ```text
//! B100B0B100GXL1       →     B2540B0B2540GXL1        (inch to mm)
//! B100B0B400GYNR1            B2540B0B10160GYNR1
//! ```
//!
//! Nodes are scaled and snapped to the grid in absolute coordinates, so that contours close again; arcs are calculated
//! again.

use super::moves::{Change, Edits, Place, point};
use super::proof::rewritten;
use super::sheet::Sheet;
use crate::program::write;

/// The factors by which a program can be scaled.
const FACTORS: std::ops::RangeInclusive<f64> = 1e-4..=1e4;

/// No edits where a word of the program states the unit.
pub(in crate::program) fn between_units(sheet: &Sheet<'_>, factor: f64) -> Edits {
    match sheet.printer.is_in_inches() {
        true => Ok(Vec::new()),
        false => scaled(sheet, factor),
    }
}

/// An error for a factor that is far from 1.
pub(in crate::program) fn refuse(factor: f64) -> Result<(), String> {
    let (least, most) = (FACTORS.start(), FACTORS.end());
    match FACTORS.contains(&factor) {
        true => Ok(()),
        false => Err(say!(the_factor_is_expected_between, factor, least, most)),
    }
}

/// The edits that scale a program. Errors: a factor with which a block vanishes or grows too long.
pub(in crate::program) fn scaled(sheet: &Sheet<'_>, factor: f64) -> Edits {
    let mut rewrite = sheet.rewrite();
    rewrite.words = sheet.words(&Change::Scale(factor))?;
    rewrite.factor = Some(factor);
    let mut from = None;
    for (own, new) in sheet.moves.iter().zip(&mut rewrite.moves) {
        let step = sheet.printer.step(own.like);
        let near = |place| {
            scaled_place(place, factor, step)
                .ok_or_else(|| say!(the_scaled_path_runs_too_far_out_for_a_program).to_owned())
        };
        let begin = from.map_or_else(|| near(own.from), Ok)?;
        let to = near(own.to)?;
        // An arc between places that fall together would be a full circle.
        let vanishes = begin == to && own.from != own.to;
        if vanishes && (own.is_arc() || !sheet.names_places()) {
            return Err(say!(the_block_becomes_shorter_than_1_um, own.line + 1));
        }
        *new = Some(own.fitted(&write::scaled(&own.piece, factor), [begin, to]));
        rewrite.start = rewrite.start.or(Some(begin));
        rewrite.end = Some(point(to));
        from = Some(to);
    }
    rewritten(sheet, &rewrite)
}

/// A place after scaling, in whole steps.
fn scaled_place(place: Place, factor: f64, step: i64) -> Option<Place> {
    const FARTHEST: f64 = 1e15;
    let scaled = place.map(|nm| (nm as f64 * factor).round());
    let is_near = scaled.iter().all(|nm| nm.abs() <= FARTHEST);
    is_near.then(|| scaled.map(|nm| (nm / step as f64).round() as i64 * step))
}
