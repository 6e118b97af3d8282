//! Scale a program about the origin of its frame. Corrections, which are those of the wire, stay.
//!
//! ```text
//! B100B0B100GXL1       →     B2540B0B2540GXL1        (inch to mm)
//! B100B0B400GYNR1            B2540B0B10160GYNR1
//! ```
//!
//! Nodes are scaled and snapped to the grid in absolute coordinates, so that contours close again; arcs are calculated
//! again.

use super::{Change, Content, Edits, Notation, Refactoring, Rewrite, Sheet};
use crate::program::write::MOST_FOR_EACH;

pub(super) fn all<N: Notation>() -> [Refactoring<N>; 2] {
    [
        Refactoring {
            id: "refactor.rewrite.scale.inchToMm",
            title: |_| say!(scale_from_inch_to_mm).into(),
            rewrite: |sheet| between_units(sheet, INCH),
        },
        Refactoring {
            id: "refactor.rewrite.scale.mmToInch",
            title: |_| say!(scale_from_mm_to_inch).into(),
            rewrite: |sheet| between_units(sheet, 1.0 / INCH),
        },
    ]
}

/// mm.
pub(in crate::program) const INCH: f64 = 25.4;

/// No edits where a word of the program states the unit.
fn between_units<N: Notation>(sheet: &Sheet<'_, N>, factor: f64) -> Edits {
    if N::is_in_inches(sheet.content()?) {
        return Ok(Vec::new());
    }
    scaled(sheet, factor)
}

/// Arcs that no longer fit into a block are cut as chords: scaled, a program takes at most this many blocks more than
/// [`MOST_FOR_EACH`] for each that it has.
const MORE: usize = 20_000;

/// The factors by which a program can be scaled.
const FACTORS: std::ops::RangeInclusive<f64> = 1e-4..=1e4;

/// The edits that scale a program. Errors: a factor that is far from 1, or with which a block vanishes or grows too long.
pub(in crate::program) fn scaled<N: Notation>(sheet: &Sheet<'_, N>, factor: f64) -> Edits {
    if !FACTORS.contains(&factor) {
        let (least, most) = (FACTORS.start(), FACTORS.end());
        return Err(say!(the_factor_is_expected_between, factor, least, most));
    }
    let content = sheet.content()?;
    N::refuse(sheet, Change::Scale)?;
    let node = |row, node| {
        N::scaled_node(row, node, factor)
            .ok_or_else(|| say!(the_scaled_path_runs_too_far_out_for_a_program).to_owned())
    };
    let mut rewrite = Rewrite {
        stretch: Some(factor),
        ..Rewrite::new()
    };
    let (mut from, most) = (None, MOST_FOR_EACH * content.rows.len() + MORE);
    let mut room = most;
    for (index, row) in content.rows.iter().enumerate() {
        let begin = from.map_or_else(|| node(row, row.from), Ok)?;
        let to = node(row, row.to)?;
        rewrite.start = rewrite.start.or(Some(begin));
        let news = N::scaled(sheet.at(content, index), [begin, to], factor)?;
        if news.is_empty() {
            return Err(say!(the_block_becomes_shorter_than_1_um, row.line + 1));
        }
        let too_many = || say!(scaled_the_program_would_take_too_many_blocks, most);
        room = room.checked_sub(news.len()).ok_or_else(too_many)?;
        rewrite.rows.insert(index, news);
        rewrite.end = Some(Content::<N>::point(to));
        from = Some(to);
    }
    N::scale_words(sheet, factor, &mut rewrite)?;
    rewrite.edits(sheet, content)
}
