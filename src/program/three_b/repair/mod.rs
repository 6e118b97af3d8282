//! A faulty contour of 3B: its blocks, and what each may have been before one slip.
//!
//! Which of them is meant is decided by [`crate::program::repair::rule`]. Long contours are not searched.

mod loose;
mod slips;

pub(super) use loose::{Loose, Number, loose};
use slips::is_odd_ratio;
pub(super) use slips::{Slip, is_sound};

use super::around::StatedPoint;
use super::block::{Block, PartArc};
use super::decode::meant as decode;
use super::encode::encode;
use super::entry::travel_of;
use crate::geometry::{Point, Segment, Vector};
use crate::program::grid::Node;
use crate::program::repair::cut::{Piece, Pieces, Stated};
use crate::program::repair::slip::{self, BLOCK_KEYS, Cut, Ends, Sort};
use crate::settings::Effective;

pub(super) type Change = slip::Change<(Block, Slip)>;
pub(super) type Repair = slip::Repair<(Block, Slip)>;

/// Contours of more blocks cost too long to try.
pub(super) const BLOCKS: std::ops::RangeInclusive<usize> = 1..=1000;

/// Contours of fewer blocks could be closed by too many changes.
pub(super) const FEWEST_BLAMED: usize = 4;

/// A block of a contour as it stands in the text.
#[derive(Clone, Debug, Default)]
pub(super) struct Written {
    /// `None` for an unreadable one.
    pub(crate) block: Option<Block>,
    /// That of a 4B block.
    pub(crate) part: Option<PartArc>,
    /// Its remains, if it is unreadable.
    pub(crate) loose: Option<Loose>,
    /// X, Y and J as they are written.
    pub(crate) digits: [String; 3],
    pub(crate) number: Option<u32>,
    pub(crate) stated: Option<StatedPoint>,
}

impl Written {
    fn piece(&self, settings: &Effective) -> Piece {
        let own = self.block.as_ref().map(piece_of).unwrap_or_default();
        Piece {
            stated: self.stated.map(stated),
            number: self.number,
            is_unread: self.block.is_none(),
            is_unsound: self
                .block
                .is_some_and(|block| !is_sound(&block, self.part, settings)),
            ..own
        }
    }
}

/// A block as the search sees it.
pub(super) fn piece_of(block: &Block) -> Piece {
    let travel = travel_of(block);
    let [x, y] = travel.meant_um();
    Piece {
        curve: decode(block, Point::origin()),
        by: Vector::new(x, y),
        machine: Vector::new(travel.machine[0] as f64, travel.machine[1] as f64),
        ..Piece::default()
    }
}

pub(super) fn stated(point: StatedPoint) -> Stated {
    let [x, y] = point.at.map(|mm| mm * 1000.0);
    Stated {
        at: Point::new(x, y),
        step: 10_f64.powi(3 - i32::from(point.decimals)),
    }
}

/// A faulty contour.
pub(super) struct Suspect<'a> {
    blocks: &'a [Written],
    pieces: Pieces,
    settings: &'a Effective,
    /// It leads from one contour to the next.
    is_jump: bool,
    /// The usual step of the program's numbers, where its blocks have numbers.
    step: Option<u32>,
    /// Nothing contradicts it.
    is_sound: bool,
    is_open: bool,
    is_four_b: bool,
    /// How wide X, Y and J are written.
    widths: [usize; 3],
}

impl Cut for Suspect<'_> {
    type Meant = (Block, Slip);

    fn pieces(&self) -> &Pieces {
        &self.pieces
    }

    fn slips(&self, index: usize, ends: &Ends) -> Vec<slip::Slip<(Block, Slip)>> {
        let Some(own) = self.blocks.get(index) else {
            return Vec::new();
        };
        match (&own.block, &own.loose) {
            (Some(block), _) => self.replaced(index, block, own, ends),
            (None, Some(loose)) => self.restored(index, loose, ends),
            (None, None) => Vec::new(),
        }
    }

    fn deleted(&self, index: usize) -> Option<slip::Slip<(Block, Slip)>> {
        let (own, before) = (self.blocks.get(index)?, index.checked_sub(1)?);
        let before = self.blocks.get(before)?;
        let is_equal = own.block.is_some() && own.block == before.block;
        let is_stated_again = match (own.stated, before.stated) {
            (Some(own), Some(before)) => own.at == before.at,
            (own, before) => own.is_none() && before.is_none(),
        };
        let is_twin = is_equal && own.number == before.number && is_stated_again;
        Some(slip::Slip::deletion(index, is_twin, (1, Vec::new())))
    }

    fn exchanged(&self, index: usize) -> Option<slip::Slip<(Block, Slip)>> {
        let blocks = self.blocks;
        let (own, next) = (blocks.get(index)?, blocks.get(index + 1)?);
        let is_out_of_turn = own.number.zip(next.number).is_some_and(|(a, b)| a > b);
        let is_plain = own.number.is_none() && own.stated.is_none();
        let may_be = is_out_of_turn || self.pieces.is_off(index) || (self.is_sound && is_plain);
        let is_read = own.block.is_some() && next.block.is_some();
        let pieces = self.pieces.all.get(index..index + 2)?;
        (may_be && is_read && own.block != next.block)
            .then(|| slip::Slip::exchange(index, (2, vec![pieces[1], pieces[0]])))
    }

    fn inserted(&self, index: usize, way: &Segment) -> Option<slip::Slip<(Block, Slip)>> {
        let first = self.blocks.first()?;
        // Counting begins with the first block.
        let may_be_first = self.pieces.number.is_some()
            || first
                .number
                .zip(self.step)
                .is_none_or(|(first, step)| first > step);
        if index == 0 && !may_be_first {
            return None;
        }
        let end = way.end();
        let node = Node {
            x: end.x as i64,
            y: end.y as i64,
        };
        let block = match way.as_arc() {
            None => slips::straight([end.x, end.y])?,
            Some(_) => {
                let mut blocks = Vec::new();
                let largest = self.settings.largest_number();
                encode(way, Node { x: 0, y: 0 }, node, largest, &mut blocks)?;
                match &blocks[..] {
                    [one] => one.block,
                    _ => return None,
                }
            }
        };
        if self.lacks_a_part(&block, None) {
            return None;
        }
        let mut piece = piece_of(&block);
        let number = match index.checked_sub(1) {
            Some(before) => self.blocks.get(before)?.number,
            None => self.pieces.number,
        };
        let numbers = number.zip(self.step);
        piece.number = numbers.map(|(number, step)| number.saturating_add(step));
        let from = self.pieces.stated_before(index);
        piece.stated = from.map(|from| Stated {
            at: from.at + piece.by,
            ..from
        });
        Some(slip::Slip {
            change: Change::Insert {
                index,
                meant: (block, Slip::Coordinates),
            },
            count: 0,
            pieces: vec![piece],
            sort: Sort::Insertion,
            // A half turn is hardly lost.
            keys: match way.as_arc() {
                Some(arc) if arc.sweep.abs() > 2.9 => BLOCK_KEYS + 5,
                Some(_) => BLOCK_KEYS + 1,
                None => BLOCK_KEYS,
            },
        })
    }
}

impl<'a> Suspect<'a> {
    /// `around` is what is known of it from around its blocks; where it is `closed`, it is not reported as open: it closes, if
    /// only together with others.
    pub(crate) fn of(
        blocks: &'a [Written],
        around: Pieces,
        closed: bool,
        settings: &'a Effective,
    ) -> Suspect<'a> {
        let (is_jump, step) = (!around.closes, around.step);
        let mut pieces = Pieces {
            all: blocks.iter().map(|own| own.piece(settings)).collect(),
            ..around
        };
        let mut against = pieces.against();
        let count = pieces.all.len();
        // Where most are out of their turn, the numbers follow another rule.
        if count > 1 && 2 * against.out_of_turn > count {
            pieces.step = None;
        }
        if against.is_open && closed {
            pieces.closes = false;
        } else if against.is_open {
            for (piece, own) in pieces.all.iter_mut().zip(blocks) {
                piece.is_unsound |= own.block.is_some_and(|block| is_odd_ratio(&block));
            }
        }
        against = pieces.against();
        Suspect {
            blocks,
            settings,
            is_jump,
            step,
            is_sound: against.count() == 0,
            is_open: against.is_open,
            is_four_b: blocks.iter().any(|own| own.part.is_some()),
            widths: slips::widths(blocks),
            pieces,
        }
    }

    /// True for an arc without a radius among arcs of 4B, which have one.
    fn lacks_a_part(&self, block: &Block, part: Option<PartArc>) -> bool {
        !block.motion.is_line() && part.is_none() && self.is_four_b
    }

    /// A block in the place of another one.
    fn slip(
        &self,
        index: usize,
        (block, how): (Block, Slip),
        sort: Sort,
        keys: i32,
    ) -> slip::Slip<(Block, Slip)> {
        let old = self.pieces.all[index];
        let piece = Piece {
            stated: old.stated,
            number: old.number,
            ..piece_of(&block)
        };
        slip::Slip {
            change: Change::Replace {
                index,
                meant: (block, how),
            },
            count: 1,
            pieces: vec![piece],
            sort,
            keys,
        }
    }
}
