//! Which one slip explains what is wrong with a contour, and what undoes it.
//!
//! A slip is what a hand or a bad line makes of a program: a digit, X for Y, a lost letter, a block twice, lost or exchanged with the
//! next. Each that could have been is undone and the contour looked at again: does it close, do the coordinates and the numbers behind
//! and before the blocks agree, does it run on smoothly. What explains more, with less, stands before the rest.
//!
//! The search is bounded by the blocks of the contour: nothing is looked for in longer ones.

mod loose;
mod slips;

pub(super) use loose::{Loose, loose};
pub(super) use slips::{Digits, Number, Slip, is_sound};

use super::around::StatedPoint;
use super::block::{Block, Motion};
use super::decode::meant;
use super::encode::encode;
use super::entry::{Move, travel_of};
use super::rules::Limits;
use super::rules::position_mismatch::mismatch;
use crate::geometry::{Point, Segment, Vector, turn};
use crate::program::grid::Node;
use crate::program::path::crossings_of;
use crate::program::path::{HeldWay, Node as WayNode, Writing, closing, tolerance};
use crate::program::repair::gap::{SMOOTH, half_turn_between, is_one_line};
use slips::{Wanted, blocks_to, is_usual, solved, straight, with};

/// Contours of more blocks cost too long to try.
pub(super) const BLOCKS: std::ops::RangeInclusive<usize> = 1..=1000;

/// Contours of fewer blocks are open by too many changes to name one.
pub(super) const FEWEST_BLAMED: usize = 4;

/// How far coordinates of three decimals may lie from where a block ends, µm.
const STATED: f64 = 4.0;

/// Repairs that are looked at to the end, and those that are handed out.
const LOOKED_AT: usize = 400;
const HANDED_OUT: usize = 4;

/// What each µm asks for by which a repair leads beside where it should.
const MISS: f64 = 0.2;

/// What the other one of two quadrants asks for between which a start or a direction lies.
const UNUSUAL: f64 = 0.3;

/// How much more the second best repair has to ask for, for the best to be sure.
const CLEARLY: f64 = 0.4;

/// A block of a contour as it stands in the text.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// `None` where it cannot be read.
    pub block: Option<Block>,
    /// What is left of it then.
    pub loose: Option<Loose>,
    /// X, Y and J as they are written.
    pub digits: [Vec<u8>; 3],
    pub travel: Move,
    pub stated: Option<StatedPoint>,
    pub number: Option<u32>,
    /// A rule finds a fault in the block for itself.
    pub is_faulty: bool,
}

/// What is done to the blocks of a contour, by their index.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Change {
    Replace {
        index: usize,
        block: Block,
        slip: Slip,
    },
    /// One of two equal blocks goes.
    Delete { index: usize },
    /// The block changes places with the next one.
    Exchange { index: usize },
    /// A block comes before another one.
    Insert { index: usize, block: Block },
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Repair {
    pub change: Change,
    /// It leaves nothing to be said, and no other one is as likely.
    pub is_sure: bool,
    /// Nothing is left to be said of the contour.
    pub is_whole: bool,
}

/// A repair with what it comes to.
struct Judged {
    /// How much is left against the contour.
    left: usize,
    /// What it asks for.
    cost: f64,
    change: Change,
    /// Where the changed block leads.
    by: Move,
    /// It leaves a number out of its turn: a block may be lost.
    lacks_a_number: bool,
}

/// What speaks against a contour.
#[derive(Clone, Copy, Debug, Default)]
struct Against {
    unread: usize,
    faulty: usize,
    off: usize,
    out_of_turn: usize,
    is_open: bool,
}

impl Against {
    fn count(&self) -> usize {
        self.unread + self.faulty + self.off + self.out_of_turn + usize::from(self.is_open)
    }
}

/// How the blocks of a contour meet.
#[derive(Clone, Copy, Debug, Default)]
struct Joints {
    smooth: i32,
    /// Those of them at an arc.
    round: i32,
    /// Two lines that would have been written as one.
    split: i32,
    /// Where the wire runs back on the way that it came.
    doubled: i32,
    /// Sum of all turns, radians.
    turns: f64,
}

impl Joints {
    /// What speaks for them.
    fn gain(&self) -> i32 {
        self.smooth - self.split
    }
}

/// A block on its way, changed or not.
#[derive(Clone, Copy)]
struct Item {
    travel: Move,
    is_arc: bool,
    stated: Option<StatedPoint>,
    number: Option<u32>,
    is_unread: bool,
    is_faulty: bool,
    /// What it means, from the origin.
    way: Option<Segment>,
    block: Option<Block>,
}

impl Item {
    fn tangents(&self) -> Option<[Vector; 2]> {
        self.way.map(|way| [way.start_tangent(), way.end_tangent()])
    }
}

/// A contour that something is wrong with.
pub(super) struct Path<'a> {
    pub pieces: &'a [Piece],
    /// What is stated before its first block, and the last number there.
    pub start: Option<StatedPoint>,
    pub number: Option<u32>,
    /// The usual step of the program's numbers, where its blocks have numbers.
    pub step: Option<u32>,
    pub limits: &'a Limits,
    /// It leads from one contour to the next.
    pub is_jump: bool,
    /// Nothing is said of where it ends, for what it comes to with others.
    pub is_closed: bool,
}

/// Which repairs are handed out. All are looked for: a block that may be lost speaks against another one that may be wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scope {
    /// Of blocks that are wrong, and blocks twice.
    Blocks,
    /// Of blocks that are lost or exchanged, too.
    All,
}

impl Scope {
    fn holds(self, change: &Change) -> bool {
        self == Scope::All || !matches!(change, Change::Insert { .. } | Change::Exchange { .. })
    }
}

/// The repairs of a contour, the most likely one first.
pub(super) fn repairs(path: &Path<'_>, scope: Scope) -> Vec<Repair> {
    let search = Search::of(path);
    if search.before.count() == 0 && scope == Scope::Blocks {
        return Vec::new();
    }
    let mut found = search.changes();
    found.truncate(LOOKED_AT);
    let mut judged: Vec<Judged> = found
        .into_iter()
        .filter_map(|(change, cost)| search.judged(change, cost))
        .collect();
    judged.sort_by(|a, b| a.left.cmp(&b.left).then(a.cost.total_cmp(&b.cost)));
    // Of those that lead the same way the first is the plainest; what crosses itself as before comes last.
    let (mut kept, mut crossing): (Vec<Judged>, Vec<Judged>) = (Vec::new(), Vec::new());
    let (mut is_either, mut outside) = (false, None::<(usize, f64)>);
    let crosses_now = !judged.is_empty() && search.crosses(None);
    for repair in judged {
        if kept.len() == HANDED_OUT || kept.first().is_some_and(|best| repair.left > best.left) {
            break;
        }
        let change = &repair.change;
        let is_known = |known: &Judged| {
            at(&known.change) == at(change)
                && known.by.minus(repair.by).is_within(2.5)
                && is_alike(&known.change, change)
        };
        if let Some(known) = kept.iter().position(is_known) {
            // Two numbers of one block that may each be wrong: which is not known.
            is_either |= known == 0
                && field(&kept[0].change) != field(change)
                && repair.cost - kept[0].cost < CLEARLY;
            continue;
        }
        if !scope.holds(change) {
            if outside.is_none() && !search.crosses(Some(change)) {
                outside = Some((repair.left, repair.cost));
            }
        } else if search.crosses(Some(change)) {
            let is_as_before = crosses_now
                && !matches!(change, Change::Exchange { .. })
                && crossing.len() < HANDED_OUT;
            crossing.extend(is_as_before.then_some(repair));
        } else {
            kept.push(repair);
        }
    }
    let is_sure = is_sure(&search, &kept, outside) && !is_either;
    let is_best = |nth: usize| !kept.is_empty() && nth == 0;
    let all = if kept.is_empty() { &crossing } else { &kept };
    let made = all.iter().enumerate().map(|(nth, repair)| Repair {
        change: repair.change,
        is_sure: is_best(nth) && is_sure,
        is_whole: repair.left == 0,
    });
    made.collect()
}

/// True where the first of the repairs is the one that is meant: no other one, `outside` of those that are handed out neither, explains
/// as much with as little.
fn is_sure(search: &Search<'_>, kept: &[Judged], outside: Option<(usize, f64)>) -> bool {
    let Some(best) = kept.first() else {
        return false;
    };
    // A block that stands twice says more than one that could be lost.
    let is_twin = matches!(best.change, Change::Delete { .. });
    let counts = |repair: &&Judged| !is_twin || !matches!(repair.change, Change::Insert { .. });
    let rival = kept.iter().skip(1).find(counts);
    let rivals = [
        rival.map(|rival| (rival.left, rival.cost)),
        outside.filter(|_| !is_twin),
    ];
    let is_clear = rivals
        .into_iter()
        .flatten()
        .all(|(left, cost)| left > best.left || (left == best.left && cost - best.cost >= CLEARLY));
    is_clear && !best.lacks_a_number && search.may_be_sure(&best.change, best.left)
}

/// What a block asks for that is read with so many keys more or less: one that is written like a line is no arc, and a line is seldom
/// a ratio.
fn restored(block: &Block, keys: usize) -> f64 {
    let is_like_a_line = block.j == block.x.max(block.y) || (block.x, block.y) == (0, 0);
    let is_odd = is_like_a_line != matches!(block.motion, Motion::Line(_));
    0.4 * keys as f64 + if is_odd { 0.8 } else { 0.0 } + if is_usual(block) { 0.0 } else { UNUSUAL }
}

/// The number that a repair changes.
fn field(change: &Change) -> Option<Number> {
    match change {
        Change::Replace {
            slip: Slip::Number(number, _),
            ..
        } => Some(*number),
        _ => None,
    }
}

fn at(change: &Change) -> usize {
    match change {
        Change::Replace { index, .. }
        | Change::Delete { index }
        | Change::Exchange { index }
        | Change::Insert { index, .. } => *index,
    }
}

/// True for two changes of one block into lines, or into arcs of one turn.
fn is_alike(one: &Change, other: &Change) -> bool {
    let kind = |change: &Change| match change {
        Change::Replace { block, .. } => Some(std::mem::discriminant(&block.motion)),
        _ => None,
    };
    let radius = |change: &Change| match change {
        Change::Replace { block, .. } if !matches!(block.motion, Motion::Line(_)) => {
            (block.x as f64).hypot(block.y as f64)
        }
        _ => 0.0,
    };
    std::mem::discriminant(one) == std::mem::discriminant(other)
        && kind(one) == kind(other)
        && (radius(one) - radius(other)).abs() <= 3.0
}

struct Search<'a> {
    path: &'a Path<'a>,
    items: Vec<Item>,
    before: Against,
    joints: Joints,
    arcs: usize,
    /// The way out is the way in backwards.
    is_mirrored: bool,
    /// It has to come back to where it began.
    closes: bool,
}

impl<'a> Search<'a> {
    fn of(path: &'a Path<'a>) -> Search<'a> {
        let item = |piece: &Piece| Item {
            travel: piece.travel,
            is_arc: piece
                .block
                .is_some_and(|block| !matches!(block.motion, Motion::Line(_))),
            stated: piece.stated,
            number: piece.number,
            is_unread: piece.block.is_none(),
            is_faulty: piece.is_faulty,
            way: piece
                .block
                .as_ref()
                .and_then(|block| meant(block, Point::origin())),
            block: piece.block,
        };
        let items: Vec<Item> = path.pieces.iter().map(item).collect();
        let is_mirrored = is_mirrored(&items);
        let mut search = Search {
            path,
            arcs: items
                .iter()
                .filter(|item| item.is_arc || item.is_unread)
                .count(),
            items,
            before: Against::default(),
            joints: Joints::default(),
            is_mirrored,
            closes: !path.is_jump,
        };
        search.before = search.against(&search.items);
        if search.before.is_open && path.is_closed {
            (search.before.is_open, search.closes) = (false, false);
        }
        search.joints = joints(&search.items);
        search
    }

    fn against(&self, items: &[Item]) -> Against {
        let mut against = Against {
            unread: 0,
            faulty: 0,
            off: 0,
            out_of_turn: 0,
            is_open: false,
        };
        let (mut before, mut off_before): (_, Option<[f64; 2]>) = (self.path.start, None);
        // Counting may begin anew in each contour.
        let first = items.iter().find_map(|item| item.number);
        let mut last = self
            .path
            .number
            .filter(|before| first.is_some_and(|first| first > *before));
        for item in items {
            against.unread += usize::from(item.is_unread);
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

    /// The stated points about a block, where both are there.
    fn stated(&self, index: usize) -> Option<(StatedPoint, StatedPoint)> {
        let before = match index.checked_sub(1) {
            Some(before) => self.items.get(before)?.stated,
            None => self.path.start,
        };
        before.zip(self.items.get(index)?.stated)
    }

    /// Where a block has to lead for all to be right.
    fn wanted(&self, index: usize) -> Vec<(Wanted, bool)> {
        let item = &self.items[index];
        if let Some((from, to)) = self.stated(index) {
            let is_off =
                item.is_unread || item.is_faulty || mismatch(&from, &item.travel, &to).is_some();
            let by = [0, 1].map(|axis| (to.at[axis] - from.at[axis]) * 1000.0);
            return if is_off {
                vec![(Wanted { by, near: STATED }, true)]
            } else {
                Vec::new()
            };
        }
        let others_unread = self.before.unread - usize::from(item.is_unread);
        let others_faulty = self.before.faulty - usize::from(item.is_faulty);
        let ends = index == 0 || index + 1 == self.items.len();
        if !self.closes
            || others_unread + others_faulty > 0
            || (ends && self.is_mirrored && !item.is_faulty)
        {
            return Vec::new();
        }
        let near = tolerance(self.arcs);
        let total = self
            .items
            .iter()
            .fold(Move::default(), |sum, item| sum.plus(item.travel));
        let mut wanted: Vec<(Wanted, bool)> = Vec::new();
        let mut take = |by: Move| {
            let by = by.meant_um();
            let is_known = wanted
                .iter()
                .any(|(known, _)| (known.by[0] - by[0]).hypot(known.by[1] - by[1]) < 1.0);
            if !is_known && self.items.len() >= 3 {
                wanted.push((Wanted { by, near }, false));
            }
        };
        let mut node = Move::default();
        for lead in 0..=index.min(2) {
            if lead == 0 || !self.is_mirrored {
                take(item.travel.plus(node).minus(total));
            }
            node = node.plus(self.items[lead].travel);
        }
        if let (Some(first), Some(last)) = (self.items.first(), self.items.last())
            && !self.is_mirrored
            && self.items.len() >= 5
            && index > 0
            && index + 1 < self.items.len()
        {
            take(
                item.travel
                    .plus(first.travel)
                    .minus(total.minus(last.travel)),
            );
        }
        wanted
    }

    /// All changes that may explain it, and what each asks for.
    fn changes(&self) -> Vec<(Change, f64)> {
        let mut found = Vec::new();
        for index in 0..self.items.len() {
            self.replacements(index, &mut found);
            let (Some(own), Some(next)) = (
                self.items[index].block,
                self.items.get(index + 1).and_then(|next| next.block),
            ) else {
                continue;
            };
            let numbers = (self.items[index].number, self.items[index + 1].number);
            if own == next && (numbers.0 == numbers.1 || self.before.off > 0) {
                found.push((Change::Delete { index: index + 1 }, 0.2));
            }
        }
        self.exchanges(&mut found);
        self.insertions(&mut found);
        found
    }

    fn replacements(&self, index: usize, found: &mut Vec<(Change, f64)>) {
        let piece = &self.path.pieces[index];
        let mut take = |block: Block, slip: Slip, cost: f64| {
            found.push((Change::Replace { index, block, slip }, cost))
        };
        let wanted = self.wanted(index);
        let Some(block) = &piece.block else {
            let Some(loose) = &piece.loose else { return };
            let readings = loose.readings();
            for (wanted, _) in &wanted {
                for reading in &readings {
                    let slip = Slip::Unread { keys: reading.keys };
                    let made = match reading.unknown {
                        None => Some(reading.block),
                        Some(number) => solved(&reading.block, number, wanted)
                            .map(|(value, _)| with(&reading.block, number, value)),
                    };
                    if let Some(made) =
                        made.filter(|made| wanted.is_met(made) && is_sound(made, self.path.limits))
                    {
                        take(
                            made,
                            slip,
                            restored(&made, reading.keys) + MISS * wanted.miss(&made),
                        );
                    }
                }
            }
            // What it says by itself, where nothing says where it leads.
            for reading in readings.iter().filter(|reading| reading.unknown.is_none()) {
                if is_sound(&reading.block, self.path.limits) {
                    take(
                        reading.block,
                        Slip::Unread { keys: reading.keys },
                        restored(&reading.block, reading.keys) + 1.0,
                    );
                }
            }
            return;
        };
        for (wanted, is_stated) in &wanted {
            for (changed, slip) in blocks_to(block, &piece.digits, wanted, self.path.limits) {
                let is_line = |block: &Block| matches!(block.motion, Motion::Line(_));
                let cost = match slip {
                    Slip::Number(Number::J, Digits::Any) => 1.6,
                    // Along an axis nothing of a number stands there.
                    Slip::Number(_, Digits::Any) if block.x == 0 || block.y == 0 => 3.4,
                    Slip::Number(_, Digits::Any) => 2.6,
                    // What is written like a line is one.
                    Slip::Motion
                        if is_line(block) != is_line(&changed)
                            && block.j == block.x.max(block.y) =>
                    {
                        if is_line(&changed) {
                            0.9
                        } else {
                            2.2
                        }
                    }
                    _ => 1.0,
                };
                let cost = if slip == Slip::Motion && !is_usual(&changed) {
                    cost + UNUSUAL
                } else {
                    cost
                };
                take(changed, slip, cost + MISS * wanted.miss(&changed));
            }
            if let Some(line) = straight(wanted).filter(|line| *is_stated && line != block) {
                take(line, Slip::Coordinates, 3.0);
            }
        }
    }

    fn exchanges(&self, found: &mut Vec<(Change, f64)>) {
        for index in 0..self.items.len().saturating_sub(1) {
            let (own, next) = (&self.items[index], &self.items[index + 1]);
            let is_out_of_turn = own
                .number
                .zip(next.number)
                .is_some_and(|(own, next)| own > next);
            let is_off = self
                .stated(index)
                .is_some_and(|(from, to)| mismatch(&from, &own.travel, &to).is_some());
            let may_be = is_out_of_turn
                || is_off
                || (self.before.count() == 0 && own.number.is_none() && own.stated.is_none());
            if may_be && own.block.is_some() && next.block.is_some() && own.block != next.block {
                found.push((Change::Exchange { index }, 1.2));
            }
        }
    }

    fn insertions(&self, found: &mut Vec<(Change, f64)>) {
        if self.before.unread + self.before.faulty > 0 {
            return;
        }
        let total = self
            .items
            .iter()
            .fold(Move::default(), |sum, item| sum.plus(item.travel))
            .meant_um();
        let lead = self.items[0].travel.meant_um();
        let mut gaps = vec![total.map(|um| -um)];
        if !self.is_mirrored {
            gaps.push([lead[0] - total[0], lead[1] - total[1]]);
        }
        let is_number_lost = |index: usize| {
            let numbers = index
                .checked_sub(1)
                .and_then(|before| self.items[before].number)
                .zip(self.items.get(index).and_then(|item| item.number));
            numbers
                .zip(self.path.step)
                .is_some_and(|((before, own), step)| own == before.saturating_add(2 * step))
        };
        // Counting begins with the first block.
        let may_be_first = self.path.number.is_some()
            || self.items[0]
                .number
                .zip(self.path.step)
                .is_none_or(|(first, step)| first > step);
        let lost: Vec<usize> = (1..self.items.len())
            .filter(|index| is_number_lost(*index))
            .collect();
        for index in usize::from(!may_be_first)..=self.items.len() {
            let stated = if index < self.items.len() {
                self.stated(index)
            } else {
                None
            };
            let off =
                stated.filter(|(from, to)| mismatch(from, &self.items[index].travel, to).is_some());
            if let Some((from, to)) = off {
                let own = self.items[index].travel.meant_um();
                let gap = [0, 1].map(|axis| (to.at[axis] - from.at[axis]) * 1000.0 - own[axis]);
                self.insert(index, gap, found);
            } else if self.before.is_open
                && (lost.is_empty() || lost.contains(&index))
                && self.before.off == 0
            {
                gaps.iter().for_each(|gap| self.insert(index, *gap, found));
            }
        }
    }

    /// What lays a new way is never sure, what goes by the coordinates alone only where nothing else is wrong, and an arc for what is
    /// written like a line only where coordinates say so.
    fn may_be_sure(&self, change: &Change, left: usize) -> bool {
        match change {
            Change::Insert { .. } => false,
            Change::Replace {
                slip: Slip::Coordinates,
                ..
            } => left == 0,
            Change::Replace {
                index,
                block,
                slip: Slip::Motion,
            } if !matches!(block.motion, Motion::Line(_)) => {
                self.items[*index].is_arc
                    || block.j != block.x.max(block.y)
                    || self.stated(*index).is_some()
            }
            _ => true,
        }
    }

    /// The arc that runs smoothly between its neighbours, and the line.
    fn insert(&self, index: usize, gap: [f64; 2], found: &mut Vec<(Change, f64)>) {
        let across = Vector::new(gap[0], gap[1]);
        if across.norm() < 10.0 {
            return;
        }
        let wanted = Wanted {
            by: gap,
            near: STATED,
        };
        let before = index
            .checked_sub(1)
            .and_then(|before| self.items[before].tangents())
            .map(|tangents| tangents[1]);
        let behind = self
            .items
            .get(index)
            .and_then(|item| item.tangents())
            .map(|tangents| tangents[0]);
        // The way in meets the contour with a corner.
        let is_at_lead = self.is_mirrored && (index <= 1 || index + 1 >= self.items.len());
        if let (Some(from), Some(to), false) = (before, behind, is_at_lead)
            && let Some(half) = half_turn_between(from, to, across)
        {
            let (start, end) = (Point::origin(), Point::new(gap[0].round(), gap[1].round()));
            let arc = Segment::from_bulge(start, end, (half / 2.0).tan());
            let mut blocks = Vec::new();
            let node = Node {
                x: gap[0].round() as i64,
                y: gap[1].round() as i64,
            };
            let made = encode(
                &arc,
                Node { x: 0, y: 0 },
                node,
                self.path.limits.largest(),
                &mut blocks,
            );
            if let (Some(()), [one]) = (made, &blocks[..]) {
                // A half turn or more joins two sides of a slot, where all else runs smoothly, and is a corner's line elsewhere.
                let is_likely =
                    half.abs() < 1.45 || 2 * self.joints.round > self.items.len() as i32 - 2;
                found.push((
                    Change::Insert {
                        index,
                        block: one.block,
                    },
                    if is_likely { 2.2 } else { 5.0 },
                ));
            }
        }
        if let Some(line) = straight(&wanted) {
            // Coordinates between which a line along an axis is lacking speak for one that is lost.
            let is_plain = self.stated(index).is_some() && (line.x == 0 || line.y == 0);
            let cost = if is_plain { 1.3 } else { 2.5 };
            found.push((Change::Insert { index, block: line }, cost));
        }
    }

    /// The blocks with a change made.
    fn with(&self, change: &Change) -> Vec<Item> {
        let mut items = self.items.clone();
        let new = |block: &Block, old: Option<&Item>| Item {
            travel: travel_of(block),
            is_arc: !matches!(block.motion, Motion::Line(_)),
            stated: old.and_then(|old| old.stated),
            number: old.and_then(|old| old.number),
            is_unread: false,
            is_faulty: false,
            way: meant(block, Point::origin()),
            block: Some(*block),
        };
        match change {
            Change::Replace { index, block, .. } => {
                items[*index] = new(block, self.items.get(*index))
            }
            Change::Delete { index } => {
                items.remove(*index);
            }
            Change::Exchange { index } => items.swap(*index, *index + 1),
            Change::Insert { index, block } => {
                let mut item = new(block, None);
                let before = index
                    .checked_sub(1)
                    .and_then(|before| self.items.get(before));
                let number = before.map_or(self.path.number, |before| before.number);
                item.number = number
                    .zip(self.path.step)
                    .map(|(number, step)| number.saturating_add(step));
                let from = before.map_or(self.path.start, |before| before.stated);
                item.stated = from.map(|from| {
                    let [x, y] = item.travel.meant_um();
                    StatedPoint {
                        at: [from.at[0] + x / 1000.0, from.at[1] + y / 1000.0],
                        decimals: from.decimals,
                    }
                });
                items.insert(*index, item);
            }
        }
        items
    }

    /// What a change comes to; `None` for what explains nothing.
    fn judged(&self, change: Change, cost: f64) -> Option<Judged> {
        let items = self.with(&change);
        let after = self.against(&items);
        let (left, was) = (after.count(), self.before.count());
        let joints = joints(&items);
        let was_joined = match change {
            // The joint of two equal blocks goes with one of them.
            Change::Delete { index } => self::joints(&self.items[index - 1..=index]),
            _ => Joints::default(),
        };
        let gain = joints.gain() - self.joints.gain() + was_joined.gain();
        let doubled = joints.doubled - self.joints.doubled + was_joined.doubled;
        let is_better = match change {
            // Where nothing else is wrong it has to run on better.
            Change::Exchange { .. } if was == 0 => left == 0 && gain >= 2 && doubled <= 0,
            Change::Replace {
                slip: Slip::Unread { .. },
                ..
            } => left < was || (left == was && after.is_open),
            Change::Insert { .. } => left == 0,
            _ => {
                left < was
                    && after.unread <= self.before.unread
                    && after.faulty <= self.before.faulty
                    && after.off <= self.before.off
            }
        };
        let is_stated = self.before.off > after.off;
        if !is_better
            || (doubled > 0
                && !is_stated
                && !matches!(
                    change,
                    Change::Replace {
                        slip: Slip::Unread { .. },
                        ..
                    }
                ))
        {
            return None;
        }
        let gain = f64::from(gain.clamp(-2, 2));
        let turns = (joints.turns - self.joints.turns + was_joined.turns).clamp(-3.0, 3.0);
        let leads = if !self.is_mirrored && is_mirrored(&items) {
            0.8
        } else {
            0.0
        };
        let weighed = if is_stated {
            cost - 0.3 * gain
        } else {
            cost - leads - 0.6 * gain + 0.3 * turns + 1.5 * f64::from(doubled)
        };
        let by = items
            .get(at(&change))
            .map_or(Move::default(), |item| item.travel);
        // Where most are out of their turn, the numbers follow another rule.
        let lacks_a_number =
            after.out_of_turn > 0 && (2 * after.out_of_turn <= items.len() || items.len() == 1);
        Some(Judged {
            left,
            cost: weighed,
            change,
            by,
            lacks_a_number,
        })
    }

    /// Whether the way crosses itself.
    fn crosses(&self, change: Option<&Change>) -> bool {
        let items = change.map_or_else(|| self.items.clone(), |change| self.with(change));
        let pieces: Vec<Segment> = ways(&items).into_iter().map(|(way, _)| way).collect();
        !crossings_of(&pieces, self.arcs).is_empty()
    }
}

/// What each block means where it is meant to begin, and where it leads to.
fn ways(items: &[Item]) -> Vec<(Segment, Move)> {
    let mut at = Move::default();
    let mut ways = Vec::with_capacity(items.len());
    for item in items {
        let [x, y] = at.meant_um();
        let start = Point::new(x, y);
        at = at.plus(item.travel);
        ways.push((
            item.way.map_or(Segment::line(start, start), |way| {
                way.moved(Vector::new(x, y))
            }),
            at,
        ));
    }
    ways
}

fn is_closed(items: &[Item]) -> bool {
    let node = |at: &Move| {
        let ([x, y], [stands_x, stands_y]) = (at.meant_um(), at.machine);
        WayNode {
            stands: Point::new(stands_x as f64, stands_y as f64),
            meant: Point::new(x, y),
        }
    };
    let mut way = HeldWay::from(node(&Move::default()), Writing::default());
    for (item, (piece, end)) in items.iter().zip(ways(items)) {
        way.push(piece, item.is_arc, node(&end));
    }
    closing(&way).is_none_or(|closing| closing.closed)
}

/// True where the way out is the way in backwards.
fn is_mirrored(items: &[Item]) -> bool {
    let is_line = |item: &Item| !item.is_arc && !item.is_unread;
    match items {
        [first, _, .., last] => {
            is_line(first) && is_line(last) && first.travel.plus(last.travel).is_within(3.0)
        }
        _ => false,
    }
}

fn joints(items: &[Item]) -> Joints {
    let mut joints = Joints::default();
    for pair in items.windows(2) {
        let (Some([_, from]), Some([to, _])) = (pair[0].tangents(), pair[1].tangents()) else {
            continue;
        };
        let angle = turn(from, to).abs();
        let along = |item: &Item| item.way.map(|way| way.end() - way.start());
        let is_split = !(pair[0].is_arc || pair[1].is_arc)
            && along(&pair[0])
                .zip(along(&pair[1]))
                .is_some_and(|(one, other)| is_one_line(one, other));
        joints.split += i32::from(is_split);
        joints.smooth += i32::from(angle <= SMOOTH && !is_split);
        joints.round += i32::from(angle <= SMOOTH && (pair[0].is_arc || pair[1].is_arc));
        joints.doubled += i32::from(angle >= std::f64::consts::PI - SMOOTH);
        joints.turns += angle;
    }
    joints
}
