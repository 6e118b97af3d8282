//! A faulty contour of 3B: the possible intended blocks, and their intended ends.
//!
//! The evidence is whether it closes, whether the coordinates and numbers around the blocks agree, and whether it runs
//! smoothly. Long contours are not searched.

mod evidence;
mod loose;
mod slips;

pub(super) use loose::{Loose, Number, loose};
pub(super) use slips::{Slip, is_sound};

use super::around::StatedPoint;
use super::block::{Block, Motion, PartArc};
use super::decode::meant as decode;
use super::encode::encode;
use super::entry::{Move, travel_of};
use super::rules::Limits;
use super::rules::position_mismatch::mismatch;
use crate::geometry::{Point, Segment, Vector};
use crate::program::grid::Node;
use crate::program::path::tolerance;
use crate::program::repair::search::{self, Contour, Verdict, search};
use evidence::{AgainstContour, Joints, crosses_itself, is_mirrored, joints};
use slips::{Wanted, straight};
use std::mem::{Discriminant, discriminant};

pub(super) type Change = search::Change<(Block, Slip)>;
pub(super) type Repair = search::Repair<(Block, Slip)>;

/// Contours of more blocks cost too long to try.
pub(super) const BLOCKS: std::ops::RangeInclusive<usize> = 1..=1000;

/// Contours of fewer blocks could be closed by too many changes.
pub(super) const FEWEST_BLAMED: usize = 4;

/// The largest distance of coordinates with three decimals from a block's end, µm.
const STATED: f64 = 4.0;

/// The most changes that are tried.
const LOOKED_AT: usize = 400;

/// The most blocks that are run for them: in a long contour fewer changes are tried.
const LOOKED_THROUGH: usize = 40_000;

/// A block of a contour on its way, changed or not.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Item {
    /// `None` for an unreadable one.
    pub(crate) block: Option<Block>,
    pub(crate) travel: Move,
    /// What it means, from the origin.
    pub(crate) way: Option<Segment>,
    pub(crate) stated: Option<StatedPoint>,
    pub(crate) number: Option<u32>,
    /// That of a 4B block.
    pub(crate) part: Option<PartArc>,
    /// A rule finds a fault in the block alone.
    pub(crate) is_faulty: bool,
}

impl Item {
    pub(crate) fn of(block: &Block) -> Item {
        Item {
            block: Some(*block),
            travel: travel_of(block),
            way: decode(block, Point::origin()),
            ..Item::default()
        }
    }

    fn is_arc(&self) -> bool {
        self.block.is_some_and(|block| !block.motion.is_line())
    }

    fn is_unread(&self) -> bool {
        self.block.is_none()
    }
}

/// A block of a contour as it stands in the text.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(crate) item: Item,
    /// Its remains, if it is unreadable.
    pub(crate) loose: Option<Loose>,
    /// X, Y and J as they are written.
    pub(crate) digits: [String; 3],
}

/// A faulty contour.
pub(super) struct Path<'a> {
    pub(crate) pieces: &'a [Piece],
    /// The place stated before its first block, and the last number there.
    pub(crate) start: Option<StatedPoint>,
    pub(crate) number: Option<u32>,
    /// The usual step of the program's numbers, where its blocks have numbers.
    pub(crate) step: Option<u32>,
    pub(crate) limits: &'a Limits,
    /// It leads from one contour to the next.
    pub(crate) is_jump: bool,
    /// It is not reported as open: it closes, if only together with others.
    pub(crate) is_closed: bool,
    /// The motions of the cuts before and after it: those of its other passes, perhaps.
    pub(crate) beside: Vec<Vec<Motion>>,
}

/// Which repairs are handed out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Scope {
    /// Those of wrong blocks, and of doubled ones.
    Blocks,
    /// Those of lost or exchanged blocks, too.
    All,
}

/// The repairs of a contour, the most likely one first.
pub(super) fn repairs(path: &Path<'_>, scope: Scope) -> Vec<Repair> {
    let suspect = Suspect::of(path, scope);
    if suspect.before.count() == 0 && scope == Scope::Blocks {
        return Vec::new();
    }
    search(&suspect, &mut LOOKED_AT.clone())
}

struct Suspect<'a> {
    path: &'a Path<'a>,
    scope: Scope,
    items: Vec<Item>,
    before: AgainstContour,
    joints: Joints,
    arcs: usize,
    /// The end of all of it.
    total: Move,
    /// The way out is the way in backwards.
    is_mirrored: bool,
    /// It must return to its start.
    closes: bool,
    is_four_b: bool,
    /// How wide X, Y and J are written.
    widths: [usize; 3],
    /// The blocks before which a number is missing.
    lost: Vec<usize>,
}

/// The result of a change: at which block, what kind of block, what radius, how far.
struct Lead {
    at: usize,
    kind: (Discriminant<Change>, Option<Discriminant<Motion>>),
    radius: f64,
    /// The centre seen from the start, µm: a full circle leads nowhere, wherever it lies.
    center: Vector,
    by: Move,
}

impl Contour for Suspect<'_> {
    type Meant = (Block, Slip);
    type Lead = Lead;

    const CLEARLY: f64 = 0.4;

    fn finalists(&self) -> usize {
        (LOOKED_THROUGH / self.items.len().max(1)).min(LOOKED_AT)
    }

    /// The place after the last block is one where a block may be lost.
    fn order(&self) -> Vec<usize> {
        (0..=self.items.len()).collect()
    }

    fn meant(&self, index: usize) -> Vec<((Block, Slip), f64)> {
        let Some(piece) = self.path.pieces.get(index) else {
            return Vec::new();
        };
        let wanted = self.wanted(index);
        match (&piece.item.block, &piece.loose) {
            (Some(block), _) => {
                let mut found = self.replaced(block, piece, &wanted);
                // Numbers of a way in that the way out has, too, are right.
                let is_lead = self.is_end(index) && self.is_mirrored && !piece.item.is_faulty;
                if is_lead && self.stated(index).is_none() {
                    found.retain(|((_, slip), _)| *slip == Slip::Motion);
                }
                found
            }
            (None, Some(loose)) => self.restored(loose, &wanted),
            (None, None) => Vec::new(),
        }
    }

    fn deleted(&self, index: usize) -> Option<f64> {
        let (own, before) = (self.items.get(index)?, self.before(index)?);
        let is_twin = own.block.is_some() && own.block == before.block;
        (is_twin && (own.number == before.number || self.before.off > 0)).then_some(0.2)
    }

    fn exchanged(&self, index: usize) -> Option<f64> {
        let (own, next) = (self.items.get(index)?, self.items.get(index + 1)?);
        let is_out_of_turn = own.number.zip(next.number).is_some_and(|(a, b)| a > b);
        let is_plain = own.number.is_none() && own.stated.is_none();
        let may_be =
            is_out_of_turn || self.off(index).is_some() || (self.before.count() == 0 && is_plain);
        let is_read = own.block.is_some() && next.block.is_some();
        (may_be && is_read && own.block != next.block).then_some(1.2)
    }

    fn gaps(&self, index: usize) -> Vec<Vector> {
        let (
            Some(first),
            AgainstContour {
                unread: 0,
                faulty: 0,
                ..
            },
        ) = (self.items.first(), self.before)
        else {
            return Vec::new();
        };
        // Counting begins with the first block.
        let may_be_first = self.path.number.is_some()
            || first
                .number
                .zip(self.path.step)
                .is_none_or(|(first, step)| first > step);
        let is_lost_here = self.lost.is_empty() || self.lost.contains(&index);
        let gap = |[x, y]: [f64; 2]| Vector::new(x.round(), y.round());
        let total = self.total.meant_um();
        if index == 0 && !may_be_first {
            Vec::new()
        } else if let Some([from, to]) = self.off(index) {
            let own = self.items[index].travel.meant_um();
            vec![gap([0, 1].map(|axis| {
                (to.at[axis] - from.at[axis]) * 1000.0 - own[axis]
            }))]
        } else if self.before.is_open && self.before.off == 0 && is_lost_here {
            let lead = first.travel.meant_um();
            let from_lead = gap([lead[0] - total[0], lead[1] - total[1]]);
            let mut gaps = vec![gap(total.map(|um| -um))];
            gaps.extend((!self.is_mirrored).then_some(from_lead));
            gaps
        } else {
            Vec::new()
        }
    }

    fn headings(&self, index: usize) -> Option<[Vector; 2]> {
        // The way in meets the contour with a corner.
        let is_at_lead = self.is_mirrored && (index <= 1 || index + 1 >= self.items.len());
        let (before, behind) = (self.before(index)?.way?, self.items.get(index)?.way?);
        (!is_at_lead).then(|| [before.end_tangent(), behind.start_tangent()])
    }

    fn filling(&self, index: usize, way: &Segment) -> Option<((Block, Slip), f64)> {
        let end = way.end();
        let node = Node {
            x: end.x as i64,
            y: end.y as i64,
        };
        let Some(arc) = way.as_arc() else {
            let line = straight(&Wanted {
                by: [end.x, end.y],
                near: STATED,
            })?;
            // Coordinates without a line along an axis between them are evidence for a lost one.
            let is_plain = self.stated(index).is_some() && (line.x == 0 || line.y == 0);
            return Some(((line, Slip::Coordinates), if is_plain { 1.3 } else { 2.5 }));
        };
        let mut blocks = Vec::new();
        let largest = self.path.limits.largest();
        encode(way, Node { x: 0, y: 0 }, node, largest, &mut blocks)?;
        let [one] = &blocks[..] else { return None };
        if self.lacks_a_part(&one.block, None) {
            return None;
        }
        // A half turn or more joins two sides of a slot where everything else is smooth, and elsewhere replaces a
        // corner's line.
        let is_likely =
            arc.sweep.abs() < 2.9 || 2 * self.joints.round > self.items.len() as i32 - 2;
        Some((
            (one.block, Slip::Coordinates),
            if is_likely { 2.2 } else { 5.0 },
        ))
    }

    fn judged(&self, change: &Change, cost: f64) -> (Option<Verdict>, usize) {
        (self.verdict(change, cost), 1)
    }

    fn lead(&self, change: &Change) -> Lead {
        let meant = match change {
            Change::Replace {
                meant: (block, _), ..
            } => Some(block),
            _ => None,
        };
        let by = change.meant().map(|(block, _)| travel_of(block));
        Lead {
            at: change.index(),
            kind: (
                discriminant(change),
                meant.map(|block| discriminant(&block.motion)),
            ),
            radius: meant
                .filter(|block| !block.motion.is_line())
                .map_or(0.0, |block| (block.x as f64).hypot(block.y as f64)),
            center: meant
                .and_then(|block| decode(block, Point::origin()))
                .and_then(|way| way.as_arc().map(|arc| arc.center - arc.start))
                .unwrap_or_default(),
            by: by.unwrap_or_default(),
        }
    }

    /// Into lines, or into arcs of one turn.
    fn is_alike(one: &Lead, other: &Lead) -> bool {
        one.at == other.at
            && one.kind == other.kind
            && one.by.minus(other.by).is_within(2.5)
            && (one.radius - other.radius).abs() <= 3.0
            && (one.center - other.center).norm() <= 8.0
    }

    /// Two numbers of one block that may each be wrong.
    fn is_either(&self, one: &Change, other: &Change) -> bool {
        let number = |change: &Change| match change {
            Change::Replace {
                meant: (_, Slip::Number(number, _)),
                ..
            } => Some(*number),
            _ => None,
        };
        number(one) != number(other)
    }

    fn holds(&self, change: &Change) -> bool {
        self.scope == Scope::All
            || !matches!(change, Change::Insert { .. } | Change::Exchange { .. })
    }

    fn crosses(&self, change: Option<&Change>, left: &mut usize) -> Option<bool> {
        let changed = change.map(|change| self.with(change));
        crosses_itself(changed.as_ref().unwrap_or(&self.items), self.arcs, left)
    }
}

impl<'a> Suspect<'a> {
    fn of(path: &'a Path<'a>, scope: Scope) -> Suspect<'a> {
        let items: Vec<Item> = path.pieces.iter().map(|piece| piece.item).collect();
        let is_lost = |index: &usize| {
            let [before, own] = [index - 1, *index].map(|index| items[index].number);
            let numbers = before.zip(own).zip(path.step);
            numbers.is_some_and(|((before, own), step)| own == before.saturating_add(2 * step))
        };
        let mut suspect = Suspect {
            path,
            scope,
            before: AgainstContour::default(),
            joints: joints(&items),
            arcs: items
                .iter()
                .filter(|item| item.is_arc() || item.is_unread())
                .count(),
            total: items
                .iter()
                .fold(Move::default(), |sum, item| sum.plus(item.travel)),
            is_mirrored: is_mirrored(&items),
            closes: !path.is_jump,
            is_four_b: items.iter().any(|item| item.part.is_some()),
            widths: slips::widths(path.pieces),
            lost: (1..items.len()).filter(is_lost).collect(),
            items,
        };
        suspect.before = suspect.against(&suspect.items);
        if suspect.before.is_open && path.is_closed {
            (suspect.before.is_open, suspect.closes) = (false, false);
        }
        suspect
    }

    /// The block before one.
    fn before(&self, index: usize) -> Option<&Item> {
        self.items.get(index.checked_sub(1)?)
    }

    /// The place stated before a block, or before the first one.
    fn stated_before(&self, index: usize) -> Option<StatedPoint> {
        match index {
            0 => self.path.start,
            _ => self.before(index)?.stated,
        }
    }

    /// The stated points about a block, where both are there.
    fn stated(&self, index: usize) -> Option<[StatedPoint; 2]> {
        Some([self.stated_before(index)?, self.items.get(index)?.stated?])
    }

    /// The stated points about a block that leads elsewhere.
    fn off(&self, index: usize) -> Option<[StatedPoint; 2]> {
        let stated = self.stated(index)?;
        let [from, to] = &stated;
        mismatch(from, &self.items[index].travel, to).map(|_| stated)
    }

    fn is_end(&self, index: usize) -> bool {
        index == 0 || index + 1 == self.items.len()
    }

    /// The end that a block must have for everything to be right, and whether coordinates say so.
    fn wanted(&self, index: usize) -> Vec<(Wanted, bool)> {
        let item = &self.items[index];
        if let Some([from, to]) = self.stated(index) {
            let by = [0, 1].map(|axis| (to.at[axis] - from.at[axis]) * 1000.0);
            let is_off = item.is_unread() || item.is_faulty || self.off(index).is_some();
            let wanted = is_off.then_some((Wanted { by, near: STATED }, true));
            return wanted.into_iter().collect();
        }
        let count = self.items.len();
        let others_unread = self.before.unread - usize::from(item.is_unread());
        let others_faulty = self.before.faulty - usize::from(item.is_faulty);
        if !self.closes || count < 3 || others_unread + others_faulty > 0 {
            return Vec::new();
        }
        let near = tolerance(self.arcs);
        let mut wanted: Vec<(Wanted, bool)> = Vec::new();
        let mut take = |by: Move| {
            let by = by.meant_um();
            let is_near = |[x, y]: [f64; 2]| (x - by[0]).hypot(y - by[1]) < 1.0;
            if !wanted.iter().any(|(known, _)| is_near(known.by)) {
                wanted.push((Wanted { by, near }, false));
            }
        };
        let own = item.travel.minus(self.total);
        take(own);
        if !self.is_mirrored {
            let mut node = Move::default();
            for lead in &self.items[..index.min(2)] {
                node = node.plus(lead.travel);
                take(own.plus(node));
            }
            let (first, last) = (&self.items[0], &self.items[count - 1]);
            if count >= 5 && !self.is_end(index) {
                take(own.plus(first.travel).plus(last.travel));
            }
        }
        wanted
    }

    /// The blocks with a change made.
    fn with(&self, change: &Change) -> Vec<Item> {
        let mut items = self.items.clone();
        match change {
            Change::Replace {
                index,
                meant: (block, _),
            } => {
                let Item {
                    stated,
                    number,
                    part,
                    ..
                } = items[*index];
                items[*index] = Item {
                    stated,
                    number,
                    part,
                    ..Item::of(block)
                };
            }
            Change::Delete { index } => drop(items.remove(*index)),
            Change::Exchange { index } => items.swap(*index, *index + 1),
            Change::Insert {
                index,
                meant: (block, _),
            } => {
                let mut item = Item::of(block);
                let number = self
                    .before(*index)
                    .map_or(self.path.number, |item| item.number);
                let numbers = number.zip(self.path.step);
                item.number = numbers.map(|(number, step)| number.saturating_add(step));
                item.stated = self.stated_before(*index).map(|from| {
                    let [x, y] = item.travel.meant_um();
                    let at = [from.at[0] + x / 1000.0, from.at[1] + y / 1000.0];
                    StatedPoint { at, ..from }
                });
                items.insert(*index, item);
            }
        }
        items
    }
}
