//! What a guess of the settings says of a program: how likely it is, and whether the differences that it leaves are
//! changes.

use super::about_stops::{FAR, differs_from_stop_to_stop, is_amid, parts_at_a_stop};
use super::against_reference::Told;
use super::comparison::FEW;
use super::difference::Difference;
use super::reference::Under;
use super::sides::Sides;
use super::traced::Traced;
use super::walk::Kind;

/// A program whose blocks deviate by more than this in the mean is by another writer, µm.
const OURS: f64 = 0.5;
/// A smaller deviation may come from a guess that is not exact, mm.
const CHANGED: f64 = 3e-3;
/// The same where all other blocks are as the guess has them.
const SLIGHTLY: f64 = 2.5e-3;
/// A way in or out that deviates by more has another setting, mm; and the same where it depends on unknown settings.
const SLIP: f64 = 1e-2;
const SLIGHT: f64 = 5e-3;
/// One that deviates by less does so by the rounding of a setting, mm; and how far a whole number may be off, µm.
const LEAST_SLIP: f64 = 2.9e-3;
const WHOLE: f64 = 0.1;

/// Where the control adds the correction, the program does not state it, and ways in and out depend on it.
pub(super) fn without_leads(traced: &Traced, told: Told) -> Told {
    let is_offset = traced.blocks.iter().any(|block| block.is_offset());
    let most = if is_offset { SLIGHT } else { SLIP };
    // One number that was changed moves a way by whole micrometres; a guess that is not exact moves both of its ends.
    let is_whole = |um: f64| (um - um.round()).abs() <= WHOLE;
    told.without_leads(|off| (LEAST_SLIP..=most).contains(&off) && is_whole(off * 1e3))
}

/// Nothing differs, or one block of a contour that no setting changes by itself.
pub(super) fn is_certain(traced: &Traced, told: &Told, under: &Under) -> bool {
    // Corners of another kind may differ in one place alone.
    let most = match under.settings.corrections.len() {
        0 | 1 => f64::INFINITY,
        _ => FAR,
    };
    // Where the side is a guess, the words of another one are no change.
    let is_of_other_side = under.sides != Sides::AsSet && told.has_other_side();
    match &told.comparison.differences[..] {
        _ if told.elsewhere > 0 || is_of_other_side => false,
        [] => told.is_exact() && told.words.is_empty(),
        // Hardly any setting has one way alone elsewhere by so little; but a length that was measured may be that of a way
        // to a hole.
        [one] if one.kind == Kind::Lead => {
            told.is_exact() && one.off <= SLIGHT && is_round(under.settings.lead_in)
        }
        [one]
            if told.is_exact()
                && !told.has_gap
                && one.kind == Kind::Block
                && (SLIGHTLY..=most).contains(&one.off) =>
        {
            is_amid(traced, one)
        }
        _ => false,
    }
}

/// A length, mm, as somebody sets it.
pub(super) fn is_round(mm: f64) -> bool {
    const ROUND: f64 = 0.05;
    let rest = mm / ROUND - (mm / ROUND).round();
    rest.abs() <= 1e-6
}

/// Whether words contradict the side, and all else that speaks against a guess.
type Rank = (bool, ((bool, usize, bool, usize, u64), usize, f64));

/// First come guesses of a side that no word contradicts. Of guesses that are not exact the nearest comes first: one that
/// is farther off may hide a change. They come before those with lost or superfluous blocks, which may be an overlap. Of
/// exact ones for 4B, whose ways in and out tell the correction, the one that has most of these comes first.
pub(super) fn rank(traced: &Traced, told: &Told) -> Rank {
    let rest = match told.is_exact() {
        true if told.has_gap => ((true, 0, true, 0, 0), 0, told.mean),
        true if traced.four_b => (told.doubt(), told.ways, told.mean),
        true => (told.doubt(), 0, told.mean),
        false => ((true, 0, false, 0, 0), 0, told.mean),
    };
    (told.has_other_side(), rest)
}

/// Whether the differences that a guess leaves are changes by somebody and not due to the guess: the program is ours to
/// the last block, or has one change that is too large for a correction.
pub(super) fn is_told(traced: &Traced, told: &Told) -> bool {
    let all = &told.comparison.differences;
    // Several large differences come from a guess that goes another way.
    let is_little = |one: &Difference| one.off <= FAR || one.kind == Kind::Stated;
    // Where so few blocks agree, none supports the guess; and a slight difference may come from a tenth of a micrometre
    // of a correction.
    let is_slight = |one: &Difference| one.kind == Kind::Block && one.off < SLIGHTLY;
    // Coordinates that stand after a block are others where the wire comes from elsewhere.
    let is_of_ways = |one: &Difference| one.kind == Kind::Stated && told.ways > 0;
    // At a stop or an end another tab, overlap or hole is as likely, but none of them loses a block or leaves each in its place.
    let may_be_set = told.strays && !told.has_gap;
    let is_set =
        |one: &Difference| one.kind == Kind::Block && one.off > FAR && !is_amid(traced, one);
    if told.is_mostly_unlike() && !is_one_slip(told)
        || all.iter().any(|one| is_slight(one) || is_of_ways(one))
        || may_be_set && all.iter().any(is_set)
    {
        return false;
    }
    let is_ours = match told.is_exact() {
        true => all.len() < 2 || all.len() <= FEW && all.iter().all(is_little),
        false => {
            let is_change = |one: &Difference| {
                one.off >= CHANGED && (one.kind == Kind::Block || one.off <= SLIGHT)
            };
            told.mean < OURS && all.len() < 2 && !told.has_gap && all.iter().all(is_change)
        }
    };
    is_ours && !parts_at_a_stop(traced, told) && !differs_from_stop_to_stop(traced, told)
}

/// All is to the last digit as the guess has it, but for the end of one block: no setting changes that alone, however
/// few blocks there are.
fn is_one_slip(told: &Told) -> bool {
    let is_slip =
        |one: &Difference| one.kind == Kind::Block && (SLIGHTLY..=SLIP).contains(&one.off);
    let is_all_else_alike = told.is_exact() && !told.has_gap && told.elsewhere + told.ways == 0;
    is_all_else_alike && matches!(&told.comparison.differences[..], [one] if is_slip(one))
}
