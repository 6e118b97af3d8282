//! Where a contour closes: the one answer for the rules, the outline, conversion and refactorings of every language.
//!
//! A contour is closed where the way after its way in returns to the end of the way in, or to the start, however many
//! blocks the way in has; a way out may follow. A stop while the contour is open belongs to the contour if a block goes
//! on from that very point and then closes or meets the contour: the stop holds the part while its tab is cut.

use super::way::{Node, Way};
use crate::finding::Fault;
use crate::geometry::Vector;

/// An answer is first searched for with at most this many blocks in the ways in and out together, then in the whole
/// way.
const SHORT_LEADS: usize = 6;

/// The most blocks of a way out that does not lead to the start.
const LONGEST_WAY_OUT: usize = 12;

/// Within this many blocks after a stop one must meet the open contour.
const BEHIND_A_STOP: usize = 16;

/// The ends of a way: for nearly all ways they alone show that it closes.
pub(crate) struct Ends {
    /// Its start, and the ends of its first two blocks.
    pub(crate) begin: [Node; 3],
    /// The start and the end of its last block.
    pub(crate) end: [Node; 2],
    pub(crate) blocks: usize,
    /// µm.
    pub(crate) tolerance: f64,
}

impl Ends {
    /// How far the last block leads on from the start, to which the way had come back, µm: the wire goes on to the next contour, and the
    /// stop before that is lost.
    pub(crate) fn lead_on(&self) -> Option<f64> {
        let (start, [last, end]) = (self.begin[0], self.end);
        let is_it = self.blocks > 3
            && start.is_near(&last, self.tolerance)
            && !start.is_near(&end, self.tolerance)
            && !self.begin[1].is_near(&end, self.tolerance);
        is_it.then(|| (end.meant - last.meant).norm())
    }

    /// True where they return to the start or to the end of a way in of one or two blocks. A way out that leads
    /// elsewhere counts as one only where it runs neither back along the way in nor on in its direction.
    pub(crate) fn close(&self) -> bool {
        let ([start, first, second], [last, end]) = (self.begin, self.end);
        let is_near = |one: Node, other: Node| one.is_near(&other, self.tolerance);
        self.blocks == 0
            || is_near(start, end)
            || (self.blocks >= 3 && is_near(first, end))
            || (self.blocks >= 6 && is_near(second, end))
            || (self.blocks >= 5
                && is_near(first, last)
                && !runs_along(first.meant - start.meant, end.meant - last.meant))
    }
}

/// True where the second move runs against the first, or on in its direction, through the contour; within a few
/// degrees.
fn runs_along(first: Vector, last: Vector) -> bool {
    first.dot(&last).abs() >= 0.99 * first.norm() * last.norm()
}

/// A way's division into way in, contour and way out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Closing {
    pub(crate) closed: bool,
    /// Blocks; none where the contour is open.
    pub(crate) lead_in: usize,
    pub(crate) lead_out: usize,
}

/// Whether and where a way holds a closed contour; `None` where that depends on blocks that are not held.
pub(crate) fn closing(way: &dyn Way) -> Option<Closing> {
    let count = way.count();
    if count == 0 {
        return Some(Closing::default());
    }
    let tolerance = way.tolerance();
    let is_near =
        |one: usize, other: usize| Some(way.node(one)?.is_near(&way.node(other)?, tolerance));
    let closed = |lead_in, lead_out| {
        Some(Closing {
            closed: true,
            lead_in,
            lead_out,
        })
    };
    if is_near(0, count)? {
        // The way out runs back along the way in.
        let mut leads = 0;
        while 2 * leads + 2 < count
            && is_near(leads + 1, count - leads - 1)?
            && encloses(way, leads + 1, leads + 1)?
        {
            leads += 1;
        }
        if let Some([lead_in, lead_out]) = forked(way, leads, tolerance)? {
            return closed(lead_in, lead_out);
        }
        return closed(leads, leads);
    }
    if count >= 3 && is_near(1, count)? {
        return closed(1, 0);
    }
    // A last block like the first, there or back, was meant to lead to the start.
    let longest_out = if is_mirrored(way, tolerance)? {
        0
    } else {
        LONGEST_WAY_OUT
    };
    for both in 1..=SHORT_LEADS.min(count) {
        for lead_out in 0..=(both - 1).min(longest_out) {
            let lead_in = both - lead_out;
            if lead_in + lead_out < count
                && is_near(lead_in, count - lead_out)?
                && encloses(way, lead_in, lead_out)?
            {
                return closed(lead_in, lead_out);
            }
        }
    }
    if way.totals().writing.names_places && count > 3 {
        // The cut may go on past the place where it closes: then its first and its last piece lie on each other there. A last piece
        // that only ends on the first one, as under a wrong sign, is no such cut.
        let first = way.piece(1)?;
        for lead_out in [0, 1] {
            let last = way.piece(count - lead_out - 1)?;
            if first.distance_to(way.node(count - lead_out)?.meant) <= tolerance
                && last.distance_to(first.start()) <= tolerance
            {
                return closed(1, lead_out);
            }
        }
    }
    for lead_out in 0..=longest_out.min(count) {
        let end = way.node(count - lead_out)?.meant;
        let mut found = None;
        way.pieces_about(end, tolerance, &mut |index, piece| {
            let is_it = index > 0
                && (piece.start() - end).norm() <= tolerance
                && encloses(way, index, lead_out) == Some(true);
            found = found.or(is_it.then_some(index));
            found.is_some() || index + lead_out >= count
        })?;
        if let Some(lead_in) = found {
            return closed(lead_in, lead_out);
        }
    }
    Some(meeting(way, tolerance)?.unwrap_or_default())
}

/// Blocks in and out of a way whose leads part on their way between the thread hole and the
/// contour, after the first `shared` blocks and before as many at the end: arcs that begin and end
/// on the contour in its direction, a cut that goes on past the place where the contour closes,
/// leads that are short beside it.
fn forked(way: &dyn Way, shared: usize, tolerance: f64) -> Option<Option<[usize; 2]>> {
    let longest = 2 * LONGEST_FORK + LONGEST_OVERLAP;
    let count = way.count();
    let longest_here = longest.min(count.saturating_sub(2 * shared));
    // Nodes that many pairs need are found once: finding a node may take a walk to it.
    let begins = (0..longest_here).map(|own| way.node(shared + own));
    let ends = (0..longest_here).map(|own| way.node(count - shared - own));
    let (begins, ends): (Vec<_>, Vec<_>) = (begins.collect(), ends.collect());
    for both in 2..=longest_here {
        for own_in in 1..both.min(longest - LONGEST_FORK) {
            let own_out = both - own_in;
            let [lead_in, lead_out] = [shared + own_in, shared + own_out];
            if lead_in + lead_out >= count {
                continue;
            }
            let (begin, end) = ((*begins.get(own_in)?)?, (*ends.get(own_out)?)?);
            if begin.is_near(&end, tolerance)
                && encloses(way, lead_in, lead_out)?
                && are_leads(way, shared, [lead_in, lead_out], tolerance)?
            {
                return Some(Some([lead_in, lead_out]));
            }
        }
    }
    Some(None)
}

/// The most blocks of either of two leads that part, without an overlap.
const LONGEST_FORK: usize = 3;

/// The most blocks of an overlap past the closing point.
const LONGEST_OVERLAP: usize = 9;

/// Two directions are one within this angle, rad, apart from the turn that rounding gives short blocks.
const TANGENT: f64 = 0.1;

/// A contour this many times as long as what leads to it and away from it is the contour, however these lie.
const DOMINANT: f64 = 3.0;

/// Whether the blocks before a closed piece of a way and those after it are leads, not a part of a contour that
/// touches itself.
fn are_leads(
    way: &dyn Way,
    shared: usize,
    [lead_in, lead_out]: [usize; 2],
    tolerance: f64,
) -> Option<bool> {
    let (closes, end) = (way.count() - lead_out, way.count() - shared);
    let length = |pieces: std::ops::Range<usize>, enough: f64| {
        let mut length = 0.0;
        for index in pieces {
            length += way.piece(index)?.length();
            if length > enough {
                break;
            }
        }
        Some(length)
    };
    let all = f64::INFINITY;
    let leads = length(shared..lead_in, all)? + length(closes..end, all)?;
    let place = way.node(lead_in)?.meant;
    if (way.node(shared)?.meant - place).norm() <= 2.0 * tolerance {
        return Some(false);
    }
    // The cut goes on along the first blocks of the contour, or has begun along the last ones.
    let runs_along = |index: usize, other: usize| {
        let (along, whole) = (way.piece(index)?, way.piece(other)?);
        let is_on = |share| whole.distance_to(along.point_at(share)) <= tolerance;
        Some([0.0, 0.5, 1.0].into_iter().all(is_on))
    };
    let contour = closes - lead_in;
    let mut past = 0;
    while past < (lead_out - shared).min(contour) && runs_along(closes + past, lead_in + past)? {
        past += 1;
    }
    let mut before = 0;
    while before < (lead_in - shared).min(contour)
        && runs_along(lead_in - 1 - before, closes - 1 - before)?
    {
        before += 1;
    }
    let own = [lead_in - shared - before, lead_out - shared - past];
    if own.iter().any(|own| !(1..=LONGEST_FORK).contains(own)) {
        return Some(false);
    }
    let overlap = length(lead_in - before..lead_in, all)? + length(closes..closes + past, all)?;
    if overlap > 2.0 * tolerance {
        return Some(true);
    }
    let is_tangent = |one: usize, other: usize| {
        let (one, other) = (way.piece(one)?, way.piece(other)?);
        let angle = one
            .end_tangent()
            .dot(&other.start_tangent())
            .clamp(-1.0, 1.0)
            .acos();
        let rounding = 2.0 / one.length().min(other.length()).max(1.0);
        Some(angle <= TANGENT + rounding)
    };
    let is_arc = |index: usize| Some(way.piece(index)?.as_arc().is_some());
    let are_arcs = is_arc(lead_in - 1)? && is_arc(closes)?;
    if are_arcs && is_tangent(lead_in - 1, lead_in)? && is_tangent(closes - 1, closes)? {
        return Some(true);
    }
    let enough = DOMINANT * leads;
    Some(length(lead_in..closes, enough)? > enough)
}

/// The closing of a way whose tab meets the part that was cut before the stop elsewhere than at the
/// stop.
fn meeting(way: &dyn Way, tolerance: f64) -> Option<Option<Closing>> {
    let Some(before) = way
        .stop()
        .filter(|before| (3..way.count()).contains(before))
    else {
        return Some(None);
    };
    let stopped = way.node(before)?.meant;
    for behind in before + 1..=way.count().min(before + BEHIND_A_STOP) {
        let end = way.node(behind)?.meant;
        if (end - stopped).norm() <= tolerance {
            continue;
        }
        let mut met = None;
        way.pieces_about(end, tolerance, &mut |index, piece| {
            met = met.or((index < before && piece.distance_to(end) <= tolerance).then_some(index));
            met.is_some() || index >= before
        })?;
        if let Some(lead_in) = met {
            return Some(Some(Closing {
                closed: true,
                lead_in,
                lead_out: way.count() - behind,
            }));
        }
    }
    Some(None)
}

/// Whether the way between ways in and out of this many blocks can enclose anything: there and back does not.
fn encloses(way: &dyn Way, lead_in: usize, lead_out: usize) -> Option<bool> {
    let is_arc = |index: usize| Some(way.piece(index)?.as_arc().is_some());
    let count = way.count().saturating_sub(lead_in + lead_out);
    let goes_round = match count {
        0 => false,
        1 => way
            .piece(lead_in)?
            .as_arc()
            .is_some_and(|arc| arc.is_full_turn()),
        2 => is_arc(lead_in)? || is_arc(lead_in + 1)?,
        _ => true,
    };
    if !goes_round {
        return Some(false);
    }
    // What stays in one place is no contour.
    let begin = way.node(lead_in)?.meant;
    for index in lead_in..lead_in + count.min(LOOKED_THROUGH) {
        let piece = way.piece(index)?;
        if [0.5, 1.0]
            .into_iter()
            .any(|share| (piece.point_at(share) - begin).norm() > 2.0 * way.tolerance())
        {
            return Some(true);
        }
    }
    Some(false)
}

/// Within this many blocks one must lead away from the start of a contour.
const LOOKED_THROUGH: usize = 16;

/// Whether a way holds a closed contour that encloses something. Passes to and fro that leave the tab also return to
/// their start, but by the way they went.
pub(crate) fn goes_round(way: &dyn Way) -> Option<bool> {
    let closing = closing(way)?;
    let pieces = closing.lead_in..way.count() - closing.lead_out;
    let looked_at = (pieces.len() / 2).min(LOOKED_THROUGH);
    let mut comes_back = closing.closed && looked_at > 0;
    for nth in 0..looked_at {
        let there = way.piece(pieces.start + nth)?.point_at(0.5);
        let back = way.piece(pieces.end - 1 - nth)?.point_at(0.5);
        comes_back &= (there - back).norm() <= way.tolerance();
    }
    Some(closing.closed && !comes_back)
}

/// Whether the last block is as long as the first, in the same or the opposite direction.
fn is_mirrored(way: &dyn Way, tolerance: f64) -> Option<bool> {
    let count = way.count();
    let first = way.node(1)?.meant - way.node(0)?.meant;
    let last = way.node(count)?.meant - way.node(count - 1)?.meant;
    Some(count >= 3 && ((first - last).norm() <= tolerance || (first + last).norm() <= tolerance))
}

/// The distance of an open way's end from its start, or from the end of a way in of one block, whichever is nearer;
/// `None` where that depends on blocks that are not held.
pub(crate) fn not_closed(way: &dyn Way) -> Option<Fault> {
    let count = way.count();
    let end = way.node(count)?.meant;
    let beside = |index: usize| Some(end - way.node(index)?.meant);
    let (start, lead_in) = (beside(0)?, if count >= 3 { beside(1) } else { None });
    let nearer = lead_in.filter(|lead_in| lead_in.norm() < start.norm());
    let by = nearer.unwrap_or(start);
    Some(Fault::NotClosed { x: by.x, y: by.y })
}

/// Whether a way after a stop belongs to the open contour before it: it closes the contour or meets it. `before` are
/// the blocks up to the stop, `whole` those and the ones after it.
pub(crate) fn is_tab(before: &dyn Way, behind: &dyn Way, whole: &dyn Way) -> Option<bool> {
    if before.count() == 0 || behind.count() == 0 || goes_round(before)? || goes_round(behind)? {
        return Some(false);
    }
    let closing = closing(whole)?;
    Some(closing.closed && closing.lead_in <= before.count())
}

#[cfg(test)]
mod tests;
