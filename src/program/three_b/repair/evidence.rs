//! The evidence of a contour's blocks for and against a change: coordinates, numbers, closing, and the joints of the
//! blocks.

use super::super::block::Motion;
use super::super::entry::Move;
use super::super::rules::position_mismatch::mismatch;
use super::slips::Digits;
use super::{Change, Item, STATED, Slip, Suspect};
use crate::geometry::{Arc, Point, Segment, Vector, turn};
use crate::program::path::{HeldWay, Writing, closing};
use crate::program::repair::gap::{SMOOTH, is_one_line};
use crate::program::repair::search::{Plainness, Verdict};

/// How much likelier another pass, or the hole in the middle of a circle, makes a change.
const SAYS: f64 = 0.5;

/// The evidence against a contour.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct AgainstContour {
    pub(crate) unread: usize,
    pub(crate) faulty: usize,
    pub(crate) off: usize,
    pub(crate) out_of_turn: usize,
    pub(crate) is_open: bool,
}

impl AgainstContour {
    pub(crate) fn count(&self) -> usize {
        self.unread + self.faulty + self.off + self.out_of_turn + usize::from(self.is_open)
    }
}

/// The joints of a contour's blocks.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Joints {
    smooth: i32,
    /// Those of them at an arc.
    pub(crate) round: i32,
    /// Two lines that would have been written as one.
    split: i32,
    /// Places where the wire runs back on the way that it came.
    doubled: i32,
    /// Sum of all turns, radians.
    turns: f64,
}

impl Suspect<'_> {
    pub(super) fn against(&self, items: &[Item]) -> AgainstContour {
        let mut against = AgainstContour::default();
        let (mut before, mut off_before): (_, Option<[f64; 2]>) = (self.path.start, None);
        // Counting may begin again in each contour.
        let first = items.iter().find_map(|item| item.number);
        let goes_on = |before: &u32| first.is_some_and(|first| first > *before);
        let mut last = self.path.number.filter(goes_on);
        for item in items {
            against.unread += usize::from(item.is_unread());
            against.faulty += usize::from(item.is_faulty);
            let off = before
                .as_ref()
                .zip(item.stated.as_ref())
                .and_then(|(from, to)| mismatch(from, &item.travel, to));
            // One end point that is off on its own is off once there and once back.
            let goes_back = off
                .zip(off_before)
                .is_some_and(|([x, y], [a, b])| (a + x).abs() <= STATED && (b + y).abs() <= STATED);
            against.off += usize::from(off.is_some() && !goes_back);
            off_before = off.filter(|_| !goes_back);
            before = item.stated;
            if let (Some(last), Some(own), Some(step)) = (last, item.number, self.path.step) {
                against.out_of_turn += usize::from(own != u32::saturating_add(last, step));
            }
            last = item.number.or(last);
        }
        against.is_open = self.closes && against.unread == 0 && !is_closed(items);
        against
    }

    /// The result of a change; `None` if it explains nothing.
    pub(super) fn verdict(&self, change: &Change, cost: f64) -> Option<Verdict> {
        let items = self.with(change);
        let after = self.against(&items);
        let (left, was) = (after.count(), self.before.count());
        let mut joints = joints(&items);
        let mut was_joined = self.joints;
        let is_mirrored = !self.is_mirrored && is_mirrored(&items);
        let restores = matches!(
            change,
            Change::Replace {
                meant: (_, Slip::Unread { .. }),
                ..
            }
        );
        if (is_mirrored || restores) && self.is_replaced_end(change) {
            // Either of the two ways may be the wrong one, or either of two quadrants: how a way in meets the contour does
            // not tell.
            joints = was_joined;
        }
        if let Change::Delete { index } = change {
            // The joint of two equal blocks goes with one of them.
            was_joined = was_joined.without(&self::joints(&self.items[index - 1..=*index]));
        }
        let joined = joints.without(&was_joined);
        let gain = joined.smooth - joined.split;
        let is_better = match change {
            // Where there is no other fault the exchange must make the joints better.
            Change::Exchange { .. } if was == 0 => left == 0 && gain >= 2 && joined.doubled <= 0,
            _ if restores => left < was || (left == was && after.is_open),
            Change::Insert { .. } => left == 0,
            _ => {
                left < was
                    && after.unread <= self.before.unread
                    && after.faulty <= self.before.faulty
                    && after.off <= self.before.off
            }
        };
        let is_stated = self.before.off > after.off;
        if !is_better || (joined.doubled > 0 && !is_stated && !restores) {
            return None;
        }
        let gain = f64::from(gain.clamp(-2, 2));
        let leads = match (
            is_mirrored,
            self.is_mirrored && self.is_replaced_end(change),
        ) {
            (true, _) => 0.8,
            (_, true) => -0.8,
            _ => 0.0,
        };
        let others = self.is_as_beside(&items) - self.is_as_beside(&self.items)
            + is_about_hole(&items)
            - is_about_hole(&self.items);
        let doubled = 1.5 * f64::from(joined.doubled);
        // Two lines may run on nearly straight by chance.
        let met = f64::from((joined.round - joined.split).clamp(-2, 2));
        let (told, evidence) = match is_stated {
            true => (-0.3 * gain, -0.3 * met),
            false => {
                let told = doubled - leads - SAYS * others;
                (told - 0.6 * gain, told - 0.3 * met)
            }
        };
        // How far it turns altogether says which is likelier, and not which is meant.
        let turns = match is_stated {
            true => 0.0,
            false => 0.3 * joined.turns.clamp(-3.0, 3.0),
        };
        let cost = cost + told + turns;
        // Where most are out of their turn, the numbers follow another rule.
        let lacks_a_number =
            after.out_of_turn > 0 && (2 * after.out_of_turn <= items.len() || items.len() == 1);
        let (plainness, speaks) = self.plainness(change);
        // A way out that is the way in backwards says that both are right, unless another way in runs on smoothly.
        let parts_leads = !is_stated
            && !restores
            && gain <= 0.0
            && self.is_mirrored
            && self.is_replaced_end(change)
            && !self::is_mirrored(&items);
        Some(Verdict {
            left,
            cost,
            plainness,
            evidence: evidence + speaks,
            may_be_sure: !lacks_a_number
                && !parts_leads
                && (is_stated || plainness == Plainness::Slip)
                && self.may_be_sure(change, left),
        })
    }

    /// How plain a change is, and what its own kind says against it.
    fn plainness(&self, change: &Change) -> (Plainness, f64) {
        let Change::Replace {
            index,
            meant: (block, slip),
        } = change
        else {
            let speaks = match change {
                // A block that stands twice tells so itself.
                Change::Delete { .. } => -1.0,
                // Coordinates without a line along an axis between them speak for a lost one.
                Change::Insert { index, meant } => {
                    let is_along = meant.0.x == 0 || meant.0.y == 0;
                    match (meant.0.motion.is_line(), self.stated(*index).is_some()) {
                        (true, true) if is_along => 0.3,
                        (true, _) => 1.5,
                        // An arc fills the gap smoothly, or is none.
                        (false, _) => 0.8,
                    }
                }
                _ => 0.0,
            };
            return (Plainness::Slip, speaks);
        };
        let was_like_line = self.items.get(*index).and_then(|item| item.block);
        let is_made_arc = was_like_line.is_some_and(|old| {
            old.motion.is_line() && !block.motion.is_line() && old.j == old.x.max(old.y)
        });
        match slip {
            Slip::Number(_, Digits::Any) | Slip::Coordinates => (Plainness::Calculated, 0.0),
            Slip::Motion if is_made_arc => (Plainness::Slip, 1.2),
            Slip::Unread { keys } => (Plainness::Slip, 0.4 * *keys as f64),
            _ => (Plainness::Slip, 0.0),
        }
    }

    /// True where the first block or the last one becomes another.
    fn is_replaced_end(&self, change: &Change) -> bool {
        matches!(change, Change::Replace { index, .. } if self.is_end(*index))
    }

    /// 1 where the motions are those of the pass before or after.
    fn is_as_beside(&self, items: &[Item]) -> f64 {
        let motion = |item: &Item| item.block.map(|block| block.motion);
        let is_own = |other: &Vec<Motion>| {
            let other = other.iter().copied().map(Some);
            items.iter().map(motion).eq(other)
        };
        f64::from(self.path.beside.iter().any(is_own))
    }

    /// True of an exchange where another one, of the first block or of the last, makes the way out the way in backwards.
    fn may_be_a_lead(&self, change: &Change) -> bool {
        let last = self.items.len().saturating_sub(2);
        let is_mirrored = |change: &Change| is_mirrored(&self.with(change));
        let mut ends = [0, last]
            .into_iter()
            .filter(|index| *index != change.index());
        !is_mirrored(change) && ends.any(|index| is_mirrored(&Change::Exchange { index }))
    }

    /// A change that adds a way is never sure. One supported by the coordinates alone is sure only where there is no
    /// other fault, and an arc for a block written like a line only where coordinates support it.
    fn may_be_sure(&self, change: &Change, left: usize) -> bool {
        match change {
            Change::Insert { .. } => false,
            Change::Exchange { .. } => !self.may_be_a_lead(change),
            Change::Replace {
                index,
                meant: (block, Slip::Coordinates),
            } => left == 0 && block.motion.is_line() != self.items[*index].is_arc(),
            Change::Replace {
                index,
                meant: (block, Slip::Motion),
            } => {
                block.motion.is_line()
                    || self.items[*index].is_arc()
                    || block.j != block.x.max(block.y)
                    || self.stated(*index).is_some()
            }
            _ => true,
        }
    }
}

impl Joints {
    fn without(&self, other: &Joints) -> Joints {
        Joints {
            smooth: self.smooth - other.smooth,
            round: self.round - other.round,
            split: self.split - other.split,
            doubled: self.doubled - other.doubled,
            turns: self.turns - other.turns,
        }
    }
}

pub(super) fn joints(items: &[Item]) -> Joints {
    let mut joints = Joints::default();
    for pair in items.windows(2) {
        let (Some(one), Some(other)) = (&pair[0].way, &pair[1].way) else {
            continue;
        };
        let angle = turn(one.end_tangent(), other.start_tangent()).abs();
        let has_arc = pair[0].is_arc() || pair[1].is_arc();
        let is_split =
            !has_arc && is_one_line(one.end() - one.start(), other.end() - other.start());
        joints.split += i32::from(is_split);
        joints.smooth += i32::from(angle <= SMOOTH && !is_split);
        joints.round += i32::from(angle <= SMOOTH && has_arc);
        joints.doubled += i32::from(angle >= std::f64::consts::PI - SMOOTH);
        joints.turns += angle;
    }
    joints
}

/// 1 where the way in comes from the centre of a full circle, in which the hole for the wire is drilled.
fn is_about_hole(items: &[Item]) -> f64 {
    let [first, circle, ..] = items else {
        return 0.0;
    };
    let (Some(way), Some(block)) = (&circle.way, &circle.block) else {
        return 0.0;
    };
    let (sign_x, sign_y) = block.motion.quadrant().signs();
    let [x, y] = first.travel.meant_um();
    let aside = (x - sign_x * block.x as f64).hypot(y - sign_y * block.y as f64);
    let is_circle = way.as_arc().is_some_and(Arc::is_full_turn);
    f64::from(is_circle && aside <= STATED)
}

/// The curve of each block at its intended start, and its end.
fn ways(items: &[Item]) -> impl Iterator<Item = (Segment, Move)> {
    items.iter().scan(Move::default(), |at, item| {
        let [x, y] = at.meant_um();
        let start = Point::new(x, y);
        *at = at.plus(item.travel);
        let way = item.way.map(|way| way.moved(Vector::new(x, y)));
        Some((way.unwrap_or(Segment::line(start, start)), *at))
    })
}

pub(super) fn crosses_itself(items: &[Item], arcs: usize, left: &mut usize) -> Option<bool> {
    let pieces: Vec<Segment> = ways(items).map(|(way, _)| way).collect();
    crate::program::repair::crosses_itself(&pieces, arcs, left)
}

fn is_closed(items: &[Item]) -> bool {
    let mut way = HeldWay::from(Move::default().node(), Writing::default());
    for (item, (piece, end)) in items.iter().zip(ways(items)) {
        way.push(piece, item.is_arc(), end.node());
    }
    closing(&way).is_none_or(|closing| closing.closed)
}

/// True where the way out is the way in backwards.
pub(super) fn is_mirrored(items: &[Item]) -> bool {
    let is_line = |item: &Item| !item.is_arc() && !item.is_unread();
    match items {
        [first, _, .., last] => {
            is_line(first) && is_line(last) && first.travel.plus(last.travel).is_within(3.0)
        }
        _ => false,
    }
}
