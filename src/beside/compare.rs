//! Compares a program with its drawing: as we write it under the drawing's settings, under others, else by the places
//! of its blocks.

use super::against_reference::{Told, against_reference};
use super::comparison::looked_at;
use super::difference::{Comparison, Difference};
use super::drawn::Drawn;
use super::followed::{Layings, but_one, followed};
use super::guess::otherwise;
use super::traced::{Block, Traced};
use super::uneven::uneven;
use super::walk::Kind;
use crate::settings::Compensation;
use std::ops::RangeInclusive;

/// In a program of fewer blocks, one deviating block may mean other settings.
const SMALL: usize = 40;
/// A larger deviation is no rounding, mm.
const ROUNDING: f64 = 5e-3;

/// One block that deviates by no more is a slip, mm; and by less it may be another writer's rounding.
const SLIP: f64 = 1e-2;
const LEAST: f64 = 2.5e-3;

/// Compares a program with a drawing; `None` where it follows nothing of it.
///
/// A program of ours is compared block by block, so that a change of 3 µm is found; for another writer's roundings
/// there is room.
pub fn compare(drawn: &Drawn, traced: &Traced) -> Option<Comparison> {
    let (seen, is_even) = compared(drawn, traced);
    if is_even || traced.mills {
        return seen;
    }
    let uneven = uneven(drawn, traced);
    if uneven.is_empty() {
        return seen;
    }
    let mut seen = seen.unwrap_or(Comparison {
        differences: Vec::new(),
        follows: Vec::new(),
    });
    // A way that is as far off leads to that contour.
    let is_of_way = |one: &Difference| {
        one.kind == Kind::Lead
            && uneven
                .iter()
                .any(|contour| (contour.off - one.off).abs() <= ROUNDING)
    };
    seen.differences.retain(|one| !is_of_way(one));
    seen.differences.extend(uneven);
    seen.differences.sort_by_key(|one| one.range.start);
    Some(seen)
}

/// The same without the corrections of contours beside each other, and whether nothing is to be asked of these: the
/// program is as we write it, but for one change perhaps, or follows all of the drawing at one correction.
fn compared(drawn: &Drawn, traced: &Traced) -> (Option<Comparison>, bool) {
    let known = against_reference(drawn, traced, &drawn.as_set());
    if traced.mills {
        // Layers that are not there are so by other settings.
        let known = known.filter(|told| !told.has_gap);
        return (known.map(Told::whole), true);
    }
    let mut layings = Layings::of(drawn, traced);
    let Some(known) = known else {
        let guessed = otherwise(drawn, traced);
        let is_one_change = guessed.as_ref().is_some_and(Told::is_one_change);
        let seen = match guessed {
            Some(told) if is_silent(&told) || is_slight(&told) => Some(told.whole()),
            Some(told) if told.is_one_change() => {
                clean_or_slip(drawn, traced, &mut layings).or(Some(told.whole()))
            }
            Some(told) => clean_or_slip(drawn, traced, &mut layings)
                .or_else(|| but_one(&mut layings))
                .or(Some(told.whole())),
            None => clean_or_slip(drawn, traced, &mut layings).or_else(|| {
                let seen = looked_at(drawn, traced);
                match seen.as_ref().is_some_and(is_clean) {
                    true => seen,
                    false => but_one(&mut layings).or(seen),
                }
            }),
        };
        let seen = seen.or_else(|| on_other_side(drawn, traced));
        return (seen, layings.is_even || is_one_change);
    };
    let blocks = traced.blocks.len();
    // Of few blocks any may be as other settings have it; of many, a few may be as another writer rounds them.
    let is_doubtful = match &known.comparison.differences[..] {
        [] => false,
        _ if !known.is_exact() || known.has_other_side() => true,
        // Nobody sets anything otherwise by so little.
        _ if is_slip(&known) => false,
        // A way that is lost, and nothing else.
        [one] if one.kind == Kind::Lead && known.is_one_change() => false,
        [one] if one.kind == Kind::Moved && known.elsewhere == 0 && !known.has_gap => false,
        [_] => known.has_gap || known.elsewhere > 0 || blocks < SMALL,
        all => {
            known.elsewhere > 0
                || 16 * all.len() > blocks
                || all.iter().any(|one| one.off < ROUNDING)
        }
    };
    if (is_doubtful || known.has_moved())
        && !known.is_one_change()
        && !is_slight(&known)
        && is_of_contours(&known)
        && let Some(seen) = clean_or_slip(drawn, traced, &mut layings)
    {
        return (Some(seen), layings.is_even);
    }
    if !is_doubtful {
        let is_ours = known.comparison.differences.is_empty() || known.is_one_change();
        return (Some(known.whole()), is_ours);
    }
    // No setting moves a contour as a whole: where it is said to be moved, other changes do not explain it better.
    let is_better = |told: &Told| {
        let explains = told.comparison.differences.is_empty() || told.has_moved();
        told.doubt() < known.doubt() && (explains || !known.is_exact() || !known.has_moved())
    };
    let guessed = otherwise(drawn, traced).filter(is_better);
    let known = guessed.unwrap_or(known).whole();
    if known.differences.len() < 2 {
        return (Some(known), false);
    }
    // One may be as another writer has it in a place or two.
    let seen = looked_at(drawn, traced).filter(is_clean);
    let seen = seen.or_else(|| but_one(&mut layings));
    (seen.or(Some(known)), false)
}

fn is_clean(seen: &Comparison) -> bool {
    seen.differences.is_empty()
}

/// What says nothing of a program; but where one block of it may be a few micrometres off, that: nobody sets anything
/// otherwise by so little.
fn clean_or_slip(drawn: &Drawn, traced: &Traced, layings: &mut Layings) -> Option<Comparison> {
    let seen = followed(layings)?;
    let is_slip = |seen: &Comparison| {
        is_one_off(seen, LEAST..=SLIP) && seen.differences.iter().all(|one| one.kind == Kind::Block)
    };
    looked_at(drawn, traced).filter(is_slip).or(Some(seen))
}

/// One block differs, by so many mm.
fn is_one_off(seen: &Comparison, by: RangeInclusive<f64>) -> bool {
    matches!(&seen.differences[..], [one] if by.contains(&one.off))
}

/// One block differs, by so little that nobody sets anything otherwise.
fn is_slip(told: &Told) -> bool {
    // A way in that is shorter by as much as a circle is larger comes from another correction.
    let is_it =
        |one: &Difference| one.off <= SLIP && (one.kind != Kind::Lead || told.is_one_change());
    let is_one = matches!(&told.comparison.differences[..], [one] if is_it(one));
    is_one && told.is_exact() && told.elsewhere == 0 && !told.has_gap
}

/// The same where the settings are not known to the last digit.
fn is_slight(told: &Told) -> bool {
    is_one_off(&told.comparison, LEAST..=SLIP) && !told.has_gap
}

/// It tells nothing, not even of a word that may be of a side which nobody has set.
fn is_silent(told: &Told) -> bool {
    let is_of_side = |one: &Difference| one.kind != Kind::Unstopped;
    told.comparison.differences.is_empty() && !told.words.iter().any(is_of_side)
}

/// What differs is of contours, not of the ways between them.
fn is_of_contours(told: &Told) -> bool {
    let is_contour = |one: &Difference| {
        matches!(
            one.kind,
            Kind::Block | Kind::Moved | Kind::Unfinished | Kind::Foreign
        )
    };
    told.comparison.differences.iter().any(is_contour)
}

/// The first block of a program that follows all of the drawing on the other side of its contours.
fn on_other_side(drawn: &Drawn, traced: &Traced) -> Option<Comparison> {
    let is_offset = traced.blocks.iter().any(Block::is_offset);
    if is_offset || traced.four_b || drawn.settings.compensation == Compensation::None {
        return None;
    }
    let seen = looked_at(&drawn.turned()?, traced)?;
    let first = seen
        .follows
        .first()
        .filter(|_| seen.differences.is_empty())?;
    let first = traced.blocks.iter().find(|block| block.range == *first)?;
    Some(Comparison {
        differences: vec![Difference::of(first, None, 0.0, Kind::OtherSide)],
        follows: Vec::new(),
    })
}
