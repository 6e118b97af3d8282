//! Where a contour closes: the one answer for the rules, the outline, conversion and refactorings of every language.
//!
//! A contour is closed where the way after its way in returns to the end of the way in, or to the start, however many
//! blocks the way in has; a way out may follow. A stop while the contour is open belongs to the contour if a block goes
//! on from that very point and then closes or meets the contour: the stop holds the part while its tab is cut.

use super::way::{Node, Way, tolerance};
use crate::finding::{Fault, Finding, Severity};
use crate::geometry::{Point, Segment, Vector};
use std::ops::Range;

/// An answer is first searched for with at most this many blocks in the ways in and out together, then in the whole
/// way.
const SHORT_LEADS: usize = 6;

/// The most blocks of a way out that does not lead to the start.
const LONGEST_WAY_OUT: usize = 12;

/// Within this many blocks after a stop one must meet the open contour.
const BEHIND_A_STOP: usize = 16;

/// Up to this many blocks are a fragment.
const FRAGMENT: usize = 2;

/// The ends of a way, from its start: for nearly all ways they alone show that it closes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Ends {
    /// Its start, and the ends of its first two blocks.
    begin: [Node; 3],
    /// The start and the end of its last block.
    end: [Node; 2],
    pub(crate) blocks: usize,
    pub(crate) arcs: usize,
    slack: f64,
}

impl Ends {
    pub(crate) fn of(way: &Way) -> Ends {
        let start = way.node(0);
        let seen = |index: usize| {
            let node = way.node(index);
            Node {
                machine: Point::origin() + (node.machine - start.machine),
                ideal: Point::origin() + (node.ideal - start.ideal),
            }
        };
        let count = way.count();
        Ends {
            begin: [0, 1, 2].map(seen),
            end: [count.saturating_sub(1), count].map(seen),
            blocks: count,
            arcs: way.arcs(),
            slack: way.writing().slack,
        }
    }

    /// Where it leads, from its start.
    pub(crate) fn travel(&self) -> Node {
        self.end[1]
    }

    /// The tolerance for its end at a place, µm.
    pub(crate) fn tolerance(&self) -> f64 {
        tolerance(self.arcs).max(self.slack)
    }

    /// Those of this way and one that goes on from its end.
    pub(crate) fn then(&self, next: &Ends) -> Ends {
        let by = self.travel();
        let behind = |node: Node| Node {
            machine: by.machine + node.machine.coords,
            ideal: by.ideal + node.ideal.coords,
        };
        let second = if self.blocks == 1 {
            behind(next.begin[1])
        } else {
            self.begin[2]
        };
        match (self.blocks, next.blocks) {
            (_, 0) => *self,
            (0, _) => *next,
            _ => Ends {
                begin: [self.begin[0], self.begin[1], second],
                end: next.end.map(behind),
                blocks: self.blocks + next.blocks,
                arcs: self.arcs + next.arcs,
                slack: self.slack.max(next.slack),
            },
        }
    }

    /// Whether it comes back to its start.
    pub(crate) fn returns(&self) -> bool {
        self.begin[0].is_near(&self.end[1], self.tolerance())
    }

    /// The distance of an open way's end from its start, or from the end of a way in of one block, whichever is nearer.
    pub(crate) fn not_closed(&self) -> Fault {
        let ([start, first, _], [_, end]) = (self.begin, self.end);
        let [from_start, from_first] = [start, first].map(|from| end.ideal - from.ideal);
        let is_nearer = self.blocks >= 3 && from_first.norm() < from_start.norm();
        let by = if is_nearer { from_first } else { from_start };
        Fault::NotClosed { x: by.x, y: by.y }
    }

    /// Whether it may well be meant to be open.
    pub(crate) fn is_fragment(&self) -> bool {
        self.blocks <= FRAGMENT
    }

    /// The finding of an open way at its last block, of which a fragment is only told.
    pub(crate) fn not_closed_at(&self, last: Range<usize>, is_fragment: bool) -> Finding {
        let finding = Finding::of(self.not_closed(), last);
        match is_fragment {
            true => finding.with(Severity::Information),
            false => finding,
        }
    }

    /// How far the last block leads on from the start, to which the way had come back, µm: the wire goes on to the next contour, and the
    /// stop before that is lost.
    pub(crate) fn lead_on(&self) -> Option<f64> {
        let (start, [last, end]) = (self.begin[0], self.end);
        let is_it = self.blocks > 3
            && start.is_near(&last, self.tolerance())
            && !start.is_near(&end, self.tolerance())
            && !self.begin[1].is_near(&end, self.tolerance());
        is_it.then(|| (end.ideal - last.ideal).norm())
    }

    /// True where they return to the start or to the end of a way in of one or two blocks. A way out that leads
    /// elsewhere counts as one only where it runs neither back along the way in nor on in its direction.
    pub(crate) fn close(&self) -> bool {
        let ([start, first, second], [last, end]) = (self.begin, self.end);
        let is_near = |one: Node, other: Node| one.is_near(&other, self.tolerance());
        self.blocks == 0
            || is_near(start, end)
            || (self.blocks >= 3 && is_near(first, end))
            || (self.blocks >= 6 && is_near(second, end))
            || (self.blocks >= 5
                && is_near(first, last)
                && !runs_along(first.ideal - start.ideal, end.ideal - last.ideal))
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

/// Whether and where a way holds a closed contour.
pub(crate) fn closing(way: &Way) -> Closing {
    let count = way.count();
    if count == 0 {
        return Closing::default();
    }
    let tolerance = way.tolerance();
    let is_near = |one: usize, other: usize| way.node(one).is_near(&way.node(other), tolerance);
    let closed = |lead_in, lead_out| Closing {
        closed: true,
        lead_in,
        lead_out,
    };
    if is_near(0, count) {
        // The way out runs back along the way in.
        let mut leads = 0;
        while 2 * leads + 2 < count
            && is_near(leads + 1, count - leads - 1)
            && encloses(way, leads + 1, leads + 1)
        {
            leads += 1;
        }
        return match forked(way, leads, tolerance) {
            Some([lead_in, lead_out]) => closed(lead_in, lead_out),
            None => closed(leads, leads),
        };
    }
    if count >= 3 && is_near(1, count) {
        return closed(1, 0);
    }
    // A last block like the first, there or back, was meant to lead to the start.
    let longest_out = match is_mirrored(way, tolerance) {
        true => 0,
        false => LONGEST_WAY_OUT,
    };
    for both in 1..=SHORT_LEADS.min(count) {
        for lead_out in 0..=(both - 1).min(longest_out) {
            let lead_in = both - lead_out;
            if both < count
                && is_near(lead_in, count - lead_out)
                && encloses(way, lead_in, lead_out)
            {
                return closed(lead_in, lead_out);
            }
        }
    }
    let pieces = way.pieces();
    if count > 3
        && let Some(first) = pieces.get(1)
    {
        // The cut may go on past the place where it closes: then its first and its last piece lie on each other there. A last piece
        // that only ends on the first one, as under a wrong sign, is no such cut.
        for lead_out in 0..=longest_out.min(1) {
            let (last, end) = (
                pieces[count - lead_out - 1],
                way.node(count - lead_out).ideal,
            );
            if first.distance_to(end) <= tolerance && last.distance_to(first.start()) <= tolerance {
                return closed(1, lead_out);
            }
        }
    }
    for lead_out in 0..=longest_out.min(count) {
        let end = way.node(count - lead_out).ideal;
        let is_it = |index: &usize| {
            *index > 0
                && (pieces[*index].start() - end).norm() <= tolerance
                && encloses(way, *index, lead_out)
        };
        if let Some(lead_in) = (0..count - lead_out).find(is_it) {
            return closed(lead_in, lead_out);
        }
    }
    meeting(way, tolerance).unwrap_or_default()
}

/// Blocks in and out of a way whose leads part on their way between the thread hole and the
/// contour, after the first `shared` blocks and before as many at the end: arcs that begin and end
/// on the contour in its direction, a cut that goes on past the place where the contour closes,
/// leads that are short beside it.
fn forked(way: &Way, shared: usize, tolerance: f64) -> Option<[usize; 2]> {
    let longest = 2 * LONGEST_FORK + LONGEST_OVERLAP;
    let count = way.count();
    let longest_here = longest.min(count.saturating_sub(2 * shared));
    for both in 2..=longest_here {
        for own_in in 1..both.min(longest - LONGEST_FORK) {
            let [lead_in, lead_out] = [shared + own_in, shared + both - own_in];
            if lead_in + lead_out < count
                && way
                    .node(lead_in)
                    .is_near(&way.node(count - lead_out), tolerance)
                && encloses(way, lead_in, lead_out)
                && are_leads(way, shared, [lead_in, lead_out], tolerance)
            {
                return Some([lead_in, lead_out]);
            }
        }
    }
    None
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
fn are_leads(way: &Way, shared: usize, [lead_in, lead_out]: [usize; 2], tolerance: f64) -> bool {
    let (closes, end) = (way.count() - lead_out, way.count() - shared);
    let pieces = way.pieces();
    let length = |own: Range<usize>| pieces[own].iter().map(Segment::length).sum::<f64>();
    let leads = length(shared..lead_in) + length(closes..end);
    let place = way.node(lead_in).ideal;
    if (way.node(shared).ideal - place).norm() <= 2.0 * tolerance {
        return false;
    }
    // The cut goes on along the first blocks of the contour, or has begun along the last ones.
    let runs_along = |index: usize, other: usize| {
        let (along, whole) = (&pieces[index], &pieces[other]);
        let is_on = |share| whole.distance_to(along.point_at(share)) <= tolerance;
        [0.0, 0.5, 1.0].into_iter().all(is_on)
    };
    let contour = closes - lead_in;
    let most_past = (lead_out - shared).min(contour);
    let past = (0..most_past).take_while(|past| runs_along(closes + past, lead_in + past));
    let past = past.count();
    let most_before = (lead_in - shared).min(contour);
    let before = (1..=most_before).take_while(|nth| runs_along(lead_in - nth, closes - nth));
    let before = before.count();
    let own = [lead_in - shared - before, lead_out - shared - past];
    if own.iter().any(|own| !(1..=LONGEST_FORK).contains(own)) {
        return false;
    }
    let overlap = length(lead_in - before..lead_in) + length(closes..closes + past);
    if overlap > 2.0 * tolerance {
        return true;
    }
    let is_tangent = |one: usize, other: usize| {
        let (one, other) = (&pieces[one], &pieces[other]);
        let turned = one.end_tangent().dot(&other.start_tangent());
        let rounding = 2.0 / one.length().min(other.length()).max(1.0);
        turned.clamp(-1.0, 1.0).acos() <= TANGENT + rounding
    };
    let is_arc = |index: usize| pieces[index].as_arc().is_some();
    let are_arcs = is_arc(lead_in - 1) && is_arc(closes);
    if are_arcs && is_tangent(lead_in - 1, lead_in) && is_tangent(closes - 1, closes) {
        return true;
    }
    length(lead_in..closes) > DOMINANT * leads
}

/// The closing of a way whose tab meets the part that was cut before the stop elsewhere than at the
/// stop.
fn meeting(way: &Way, tolerance: f64) -> Option<Closing> {
    let count = way.count();
    let before = way.stop().filter(|before| (3..count).contains(before))?;
    let stopped = way.node(before).ideal;
    let behind = before + 1..=count.min(before + BEHIND_A_STOP);
    behind.into_iter().find_map(|behind| {
        let end = way.node(behind).ideal;
        let is_apart = (end - stopped).norm() > tolerance;
        let mut pieces = way.pieces()[..before].iter();
        let met = pieces.position(|piece| is_apart && piece.distance_to(end) <= tolerance);
        met.map(|lead_in| Closing {
            closed: true,
            lead_in,
            lead_out: count - behind,
        })
    })
}

/// Whether the way between ways in and out of this many blocks can enclose anything: there and back does not.
fn encloses(way: &Way, lead_in: usize, lead_out: usize) -> bool {
    let end = way.count().saturating_sub(lead_out).max(lead_in);
    let own = &way.pieces()[lead_in..end];
    let goes_round = match own {
        [] => false,
        [piece] => piece.as_arc().is_some_and(|arc| arc.is_full_turn()),
        [one, other] => one.as_arc().or(other.as_arc()).is_some(),
        _ => true,
    };
    // What stays in one place is no contour.
    let begin = way.node(lead_in).ideal;
    let leads_away = |piece: &Segment| {
        let is_away = |share| (piece.point_at(share) - begin).norm() > 2.0 * way.tolerance();
        is_away(0.5) || is_away(1.0)
    };
    goes_round && own.iter().take(LOOKED_THROUGH).any(leads_away)
}

/// Within this many blocks one must lead away from the start of a contour.
const LOOKED_THROUGH: usize = 16;

/// Whether a way with this closing holds a contour that encloses something. Passes to and fro that leave the tab also
/// return to their start, but by the way they went.
pub(crate) fn goes_round(way: &Way, closing: Closing) -> bool {
    let own = closing.lead_in..way.count() - closing.lead_out;
    let pieces = &way.pieces()[own];
    let looked_at = (pieces.len() / 2).min(LOOKED_THROUGH);
    let pairs = pieces.iter().zip(pieces.iter().rev()).take(looked_at);
    let is_back = |(there, back): (&Segment, &Segment)| {
        (there.point_at(0.5) - back.point_at(0.5)).norm() <= way.tolerance()
    };
    let comes_back = looked_at > 0 && pairs.into_iter().all(is_back);
    closing.closed && !comes_back
}

/// Whether the last block is as long as the first, in the same or the opposite direction.
fn is_mirrored(way: &Way, tolerance: f64) -> bool {
    let count = way.count();
    let (first, last) = (
        way.ideal_between(0, 1),
        way.ideal_between(count.saturating_sub(1), count),
    );
    count >= 3 && ((first - last).norm() <= tolerance || (first + last).norm() <= tolerance)
}

/// Whether a way after a stop belongs to the open contour before it: it closes the contour or meets it. `before` are
/// the blocks up to the stop, `whole` those and the ones after it.
pub(crate) fn is_tab(before: &Way, behind: &Way, whole: &Way) -> bool {
    let goes_round = |way: &Way| goes_round(way, closing(way));
    if before.count() == 0 || behind.count() == 0 || goes_round(before) || goes_round(behind) {
        return false;
    }
    let closing = closing(whole);
    closing.closed && closing.lead_in <= before.count()
}

#[cfg(test)]
mod tests;
