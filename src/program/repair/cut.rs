//! A faulty cut as the search for its slip sees it: its pieces, what contradicts them, what speaks for them. No language here.

use super::gap::{SMOOTH, is_one_line};
use crate::geometry::{Point, Segment, Vector, turn};
use crate::program::path::{Node, Way, Writing, closing};
use std::ops::Range;

/// A block of a cut, or a line of one that moves the wire.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::program) struct Piece {
    /// Its curve from the origin, µm; `None` where it leads nowhere.
    pub(crate) curve: Option<Segment>,
    /// Its end from its start, µm: what it means, and where a control that counts ends.
    pub(crate) by: Vector,
    pub(crate) machine: Vector,
    /// The place that the text states for its end.
    pub(crate) stated: Option<Stated>,
    /// Its number, where blocks are numbered.
    pub(crate) number: Option<u32>,
    /// The text gives the place where it ends, not the way there: it may end short on purpose.
    pub(crate) is_placed: bool,
    /// It cannot be read.
    pub(crate) is_unread: bool,
    /// It can be read, and is wrong by itself.
    pub(crate) is_unsound: bool,
    /// Only in how its arc lies: another number of it would do as well.
    pub(crate) is_off_circle: bool,
    /// How much farther from its centre it ends than it begins, µm.
    pub(crate) miss: f64,
}

/// A place that stands after a block, µm.
#[derive(Clone, Copy, Debug)]
pub(in crate::program) struct Stated {
    pub(crate) at: Point,
    /// The step of its numbers.
    pub(crate) step: f64,
}

/// The farthest that a block ends from a place that three decimals state, µm: both ends are rounded, and J of an arc moves its
/// end by two µm on each axis.
const OFF: f64 = 4.0;

/// Two ends this near each other are one, µm; radii and centres of arcs lie a little farther apart.
pub(super) const SAME: f64 = 3.0;

/// The ends of a way out lie this near those of the way in, µm.
const MIRRORED: f64 = 3.0;

/// The fewest pieces of a cut that has leads, or passes.
pub(in crate::program) const FEWEST_WITH_LEADS: usize = 4;

impl Piece {
    pub(crate) fn is_arc(&self) -> bool {
        self.curve.is_some_and(|curve| curve.as_arc().is_some())
    }

    pub(crate) fn radius(&self) -> Option<f64> {
        self.curve?.as_arc().map(|arc| arc.radius)
    }

    /// Whether it leads from one stated place to another.
    fn leads(&self, from: &Stated, to: &Stated) -> bool {
        let allowed = OFF.max(OFF / 2.0 + from.step.max(to.step));
        let is_near = |by: Vector| {
            let off = to.at - from.at - by;
            off.x.abs() <= allowed && off.y.abs() <= allowed
        };
        is_near(self.by) || is_near(self.machine)
    }
}

/// What contradicts a cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::program) struct Against {
    pub(crate) unread: usize,
    pub(crate) unsound: usize,
    /// Blocks that end beside the places stated for them.
    pub(crate) off: usize,
    pub(crate) out_of_turn: usize,
    pub(crate) is_open: bool,
}

impl Against {
    pub(crate) fn count(&self) -> usize {
        self.unread + self.unsound + self.off + self.out_of_turn + usize::from(self.is_open)
    }

    /// With what contradicts some pieces in the place of what had contradicted others; nothing of its closing.
    fn changed(self, had: Against, is: Against) -> Against {
        let now =
            |of: fn(&Against) -> usize| of(&self).wrapping_sub(of(&had)).wrapping_add(of(&is));
        Against {
            unread: now(|own| own.unread),
            unsound: now(|own| own.unsound),
            off: now(|own| own.off),
            out_of_turn: now(|own| own.out_of_turn),
            is_open: false,
        }
    }
}

/// The joints of some pieces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::program) struct Joints {
    /// Tangent to an arc, or square; two lines that would have been written as one count against it.
    pub(crate) good: i32,
    /// Tangent to an arc.
    pub(crate) smooth: i32,
    /// Places where the wire runs back on the way that it came.
    pub(crate) doubled: i32,
}

/// The pieces of a cut, and what is known of it from around it.
#[derive(Clone, Debug, Default)]
pub(in crate::program) struct Pieces {
    pub(crate) all: Vec<Piece>,
    /// The place stated before it, and the number there.
    pub(crate) start: Option<Stated>,
    pub(crate) number: Option<u32>,
    /// The step of the program's numbers.
    pub(crate) step: Option<u32>,
    /// It must return to its start.
    pub(crate) closes: bool,
    /// Nothing contradicts it, and it is reported all the same, as where it crosses itself.
    pub(crate) is_tangled: bool,
    pub(crate) writing: Writing,
    /// The cuts before and behind it: perhaps its other passes.
    pub(crate) others: Vec<Vec<Piece>>,
    /// It holds several passes itself, without a stop between.
    pub(crate) holds_passes: bool,
}

impl Pieces {
    /// All pieces, with others in the place of `count` ones.
    pub(crate) fn with(&self, index: usize, count: usize, pieces: &[Piece]) -> Vec<Piece> {
        self.part_with(0..self.all.len(), index, count, pieces)
    }

    /// The same of a part of them.
    pub(super) fn part_with(
        &self,
        part: Range<usize>,
        index: usize,
        count: usize,
        pieces: &[Piece],
    ) -> Vec<Piece> {
        let before = self.all.get(part.start..index).unwrap_or_default();
        let behind = self.all.get(index + count..part.end).unwrap_or_default();
        [before, pieces, behind].concat()
    }

    /// The other cuts, as far as they have leads, go out as they came in.
    pub(crate) fn others_are_mirrored(&self) -> bool {
        let with_leads = |other: &&Vec<Piece>| other.len() >= FEWEST_WITH_LEADS;
        let mut others = self.others.iter().filter(with_leads).peekable();
        others.peek().is_some() && others.all(|other| is_mirrored(other.iter()))
    }

    pub(crate) fn before(&self, index: usize) -> Option<&Piece> {
        self.all.get(index.checked_sub(1)?)
    }

    /// The place that is stated before a piece.
    pub(crate) fn stated_before(&self, index: usize) -> Option<Stated> {
        match index {
            0 => self.start,
            _ => self.before(index)?.stated,
        }
    }

    pub(crate) fn is_off(&self, index: usize) -> bool {
        let stated = self.stated_before(index).zip(self.all.get(index));
        stated.is_some_and(|(from, piece)| piece.stated.is_some_and(|to| !piece.leads(&from, &to)))
    }

    /// What contradicts all of it.
    pub(crate) fn against(&self) -> Against {
        let mut against = self.against_within(0, &self.all);
        against.is_open = self.closes && against.unread == 0 && !self.is_closed(&self.all);
        against
    }

    /// The same with other pieces in the place of `count` ones, but for its closing; `was` contradicts it as it is.
    pub(crate) fn against_with(
        &self,
        was: Against,
        index: usize,
        count: usize,
        pieces: &[Piece],
    ) -> Against {
        // An end point that is off on its own is off once there and once back.
        let first = index.saturating_sub(2);
        let last = (index + count + 2).min(self.all.len());
        let own = self.all.get(first..last).unwrap_or_default();
        let new = self.part_with(first..last, index, count, pieces);
        let is = self.against_within(first, &new);
        let had = self.against_within(first, own);
        was.changed(had, is)
    }

    /// What contradicts some pieces, the first of which stands at `index`.
    fn against_within(&self, index: usize, pieces: &[Piece]) -> Against {
        let mut against = Against::default();
        let mut before = self.stated_before(index);
        let first = self.all.iter().find_map(|piece| piece.number);
        // Counting may begin again in each contour.
        let goes_on = |before: &u32| first.is_some_and(|first| first > *before);
        let mut last = match index {
            0 => self.number.filter(goes_on),
            _ => self
                .all
                .iter()
                .take(index)
                .rev()
                .find_map(|piece| piece.number),
        };
        let mut off_before: Option<Vector> = None;
        for piece in pieces {
            against.unread += usize::from(piece.is_unread);
            against.unsound += usize::from(piece.is_unsound);
            let off = before.zip(piece.stated).and_then(|(from, to)| {
                let is_off = !piece.is_unread && !piece.leads(&from, &to);
                is_off.then(|| to.at - from.at - piece.by)
            });
            let goes_back = off.zip(off_before).is_some_and(|(own, its)| {
                let back = own + its;
                back.x.abs() <= OFF && back.y.abs() <= OFF
            });
            against.off += usize::from(off.is_some() && !goes_back);
            off_before = off.filter(|_| !goes_back);
            before = piece.stated;
            if let (Some(last), Some(own), Some(step)) = (last, piece.number, self.step) {
                against.out_of_turn += usize::from(own != last.saturating_add(step));
            }
            last = piece.number.or(last);
        }
        against
    }

    pub(crate) fn is_closed(&self, pieces: &[Piece]) -> bool {
        let mut node = Node::at(Point::origin());
        let mut way = Way::from(node, self.writing);
        for piece in pieces {
            let start = node.ideal - Point::origin();
            let curve = piece.curve.map(|curve| curve.moved(start));
            let curve = curve.unwrap_or(Segment::line(node.ideal, node.ideal));
            node.ideal += piece.by;
            node.machine += piece.machine;
            way.push(curve, piece.is_arc(), node);
        }
        closing(&way).closed
    }

    /// From its end, or from that of its last piece but one, to the places where it may close.
    pub(crate) fn gaps(&self) -> Vec<Vector> {
        let count = self.all.len();
        let total: Vector = self.all.iter().map(|piece| piece.by).sum();
        let by = |index: usize| {
            self.all
                .get(index)
                .map_or(Vector::zeros(), |piece| piece.by)
        };
        let mut gaps = vec![-total];
        if count >= 3 {
            gaps.push(by(0) - total);
        }
        if count >= 5 {
            gaps.push(by(0) + by(count - 1) - total);
        }
        if count >= 6 {
            gaps.push(by(0) + by(1) - total);
        }
        gaps
    }

    /// How the machine's end lies beside the one that is meant.
    pub(crate) fn drift(&self) -> Vector {
        self.all.iter().map(|piece| piece.machine - piece.by).sum()
    }

    /// The joints of pieces with others in the place of `count` ones, less those that are there.
    pub(crate) fn joints_with(&self, index: usize, count: usize, pieces: &[Piece]) -> Joints {
        let first = index.saturating_sub(1);
        let last = (index + count + 1).min(self.all.len());
        let own = self.all.get(first..last).unwrap_or_default();
        let new = self.part_with(first..last, index, count, pieces);
        let is_first = first == 0;
        let is_last = last == self.all.len();
        let [is, was] = [
            joints(&new, is_first, is_last),
            joints(own, is_first, is_last),
        ];
        Joints {
            good: is.good - was.good,
            smooth: is.smooth - was.smooth,
            doubled: is.doubled - was.doubled,
        }
    }
}

/// The joints of some pieces, the first of which may be the way in, and the last the way out.
fn joints(pieces: &[Piece], is_first: bool, is_last: bool) -> Joints {
    let mut joints = Joints::default();
    for (nth, pair) in pieces.windows(2).enumerate() {
        let (Some(one), Some(other)) = (&pair[0].curve, &pair[1].curve) else {
            continue;
        };
        let angle = turn(one.end_tangent(), other.start_tangent()).abs();
        let has_arc = pair[0].is_arc() || pair[1].is_arc();
        // A lead hardly meets a circle tangentially.
        let is_round = |piece: &Piece| {
            let arc = piece.curve.and_then(|curve| curve.as_arc().copied());
            arc.is_some_and(|arc| arc.sweep.abs() > 3.0)
        };
        let is_lead = ((is_first && nth == 0) || (is_last && nth + 2 == pieces.len()))
            && pair.iter().any(is_round);
        joints.smooth += i32::from(angle <= SMOOTH && has_arc);
        let is_square = (angle - std::f64::consts::FRAC_PI_2).abs() <= SQUARE;
        if !has_arc && is_one_line(pair[0].by, pair[1].by) {
            joints.good -= 1;
        } else if is_square || (angle <= SMOOTH && has_arc && !is_lead) {
            joints.good += 1;
        }
        joints.doubled += i32::from(angle >= std::f64::consts::PI - SMOOTH);
    }
    joints
}

/// A joint this near a right angle is one, radians.
const SQUARE: f64 = 0.002;

/// True where the way out is the way in backwards.
pub(super) fn is_mirrored<'a>(pieces: impl DoubleEndedIterator<Item = &'a Piece>) -> bool {
    let mut pieces = pieces.filter(|piece| piece.curve.is_some());
    let (Some(first), Some(last)) = (pieces.next(), pieces.next_back()) else {
        return false;
    };
    let is_line = |piece: &Piece| !piece.is_arc() && !piece.is_unread;
    let has_more = pieces.next().is_some();
    let sums = [first.by + last.by, first.machine + last.machine];
    has_more && is_line(first) && is_line(last) && sums.iter().any(|sum| sum.norm() <= MIRRORED)
}

/// The pieces of a cut with others in the place of `count` ones.
pub(in crate::program) struct Changed<'a> {
    pub(crate) pieces: &'a [Piece],
    pub(crate) index: usize,
    pub(crate) count: usize,
    pub(crate) by: &'a [Piece],
}

impl<'a> Changed<'a> {
    /// The pieces that go.
    pub(super) fn replaced(&self) -> &'a [Piece] {
        let replaced = self.pieces.get(self.index..self.index + self.count);
        replaced.unwrap_or_default()
    }

    /// Those that lead anywhere.
    pub(crate) fn iter(&self) -> impl DoubleEndedIterator<Item = &'a Piece> + use<'a> {
        let (head, rest) = self.pieces.split_at(self.index.min(self.pieces.len()));
        let behind = rest.get(self.count..).unwrap_or_default();
        let all = head.iter().chain(self.by).chain(behind);
        all.filter(|piece| piece.curve.is_some())
    }
}

/// True where the way in comes from the centre of a full circle, in which the hole for the wire is drilled.
pub(in crate::program) fn is_about_hole<'a>(mut pieces: impl Iterator<Item = &'a Piece>) -> bool {
    let (Some(first), Some(circle)) = (pieces.next(), pieces.next()) else {
        return false;
    };
    let arc = circle.curve.and_then(|curve| curve.as_arc().copied());
    arc.is_some_and(|arc| arc.is_full_turn() && (arc.center - arc.start + first.by).norm() <= OFF)
}

/// True where the end runs on into the beginning: a contour without leads begins within a line or where an arc meets it.
pub(in crate::program) fn runs_on<'a>(
    mut pieces: impl DoubleEndedIterator<Item = &'a Piece>,
) -> bool {
    let curve = |piece: Option<&Piece>| piece.and_then(|piece| piece.curve);
    let ends = curve(pieces.next()).zip(curve(pieces.next_back()));
    ends.is_some_and(|(first, last)| {
        turn(last.end_tangent(), first.start_tangent()).abs() <= SMOOTH
    })
}

/// Where a way leads: each piece's end and middle, lines that run on as one.
pub(in crate::program) fn lead(pieces: &[Piece]) -> Vec<[Vector; 2]> {
    let mut lead: Vec<[Vector; 2]> = Vec::new();
    let mut line: Option<Vector> = None;
    for piece in pieces {
        let Some(curve) = piece.curve.filter(|curve| curve.length() > 0.0) else {
            continue;
        };
        let by = piece.by;
        if piece.is_arc() {
            let [quarter, half] = [0.25, 0.5].map(|share| curve.point_at(share) - curve.start());
            lead.extend([[by, half], [quarter, half]]);
            line = None;
            continue;
        }
        let joined = line
            .filter(|line| is_one_line(*line, by))
            .map(|line| line + by);
        if joined.is_some() {
            lead.pop();
        }
        let by = joined.unwrap_or(by);
        lead.push([by, by / 2.0]);
        line = Some(by);
    }
    lead
}

/// True for two ways whose pieces lie within so many µm of each other.
pub(in crate::program) fn are_alike(
    one: &[[Vector; 2]],
    other: &[[Vector; 2]],
    within: f64,
) -> bool {
    let near = |a: &Vector, b: &Vector| (a - b).norm() <= within;
    one.len() == other.len()
        && one
            .iter()
            .zip(other)
            .all(|(one, other)| near(&one[0], &other[0]) && near(&one[1], &other[1]))
}
