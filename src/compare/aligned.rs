//! The blocks of a program beside those of the program that is written again, and where both lie.

use super::rewritten::Rewritten;
use super::traced::{Block, Motion, Traced};
use crate::geometry::Vector;

/// Where two programs part, they are searched this many blocks ahead, and agree again where so many blocks do.
const AHEAD: usize = 8;
const AGAIN: usize = 3;
/// One block in this many may differ; and in a program of a few blocks this many in one place.
const ONE_OF: usize = 10;
const IN_ONE_PLACE: usize = 4;
/// Blocks agree within this, µm: a drawing that is changed elsewhere may round them otherwise.
const SAME: f64 = 1.5;
/// A place is where it should be within this, µm.
pub(super) const PLACED: f64 = 1.5;

/// What stands beside what, by their numbers among the blocks of both programs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Row {
    Both {
        own: usize,
        ideal: usize,
    },
    /// Nothing stands for it, before this block of the program.
    Lost {
        own: usize,
        ideal: usize,
    },
    /// It stands for nothing.
    More {
        own: usize,
    },
}

/// A program beside the one that is written again.
pub(super) struct Aligned<'a> {
    pub(super) traced: &'a Traced,
    pub(super) rewritten: &'a Rewritten,
    pub(super) rows: Vec<Row>,
    /// From the rewritten program's places to where most of the program lies.
    pub(super) from: Vector,
}

impl<'a> Aligned<'a> {
    pub(super) fn of(traced: &'a Traced, rewritten: &'a Rewritten) -> Option<Aligned<'a>> {
        let (own, ideal) = (&traced.blocks, &rewritten.traced.blocks);
        let rows = rows(own, ideal)?;
        let mut aligned = Aligned {
            traced,
            rewritten,
            rows,
            from: Vector::zeros(),
        };
        aligned.from = aligned.away();
        Some(aligned)
    }

    /// The segment of the drawing that a block of the rewritten program follows.
    pub(super) fn source(&self, ideal: usize) -> Option<(crate::drawing::EntityId, usize)> {
        *self.rewritten.sources.get(ideal)?
    }

    pub(super) fn pair(&self, own: usize, ideal: usize) -> Option<(&'a Block, &'a Block)> {
        let rewritten: &'a Rewritten = self.rewritten;
        let traced: &'a Traced = self.traced;
        Some((traced.blocks.get(own)?, rewritten.traced.blocks.get(ideal)?))
    }

    /// How far a block ends, and begins, from where the rewritten one does, beyond what all of the program is away.
    pub(super) fn ends_away(&self, own: usize, ideal: usize) -> Option<[Vector; 2]> {
        let (own, ideal) = self.pair(own, ideal)?;
        let ([start, end], [ideal_start, ideal_end]) = (own.motion.ends()?, ideal.motion.ends()?);
        let by = self.from
            + if self.traced.is_placed {
                self.rewritten.shift
            } else {
                Vector::zeros()
            };
        Some([start - ideal_start - by, end - ideal_end - by])
    }

    /// How far the program lies from the rewritten one: a machine that counts begins anywhere, where the first contour
    /// is; an absolute program lies where it says, or all of it elsewhere.
    fn away(&self) -> Vector {
        let of_contours = self.rows.iter().filter_map(|row| match *row {
            Row::Both { own, ideal } if self.source(ideal).is_some() => self.ends_away(own, ideal),
            _ => None,
        });
        let all: Vec<[Vector; 2]> = of_contours.collect();
        let still = all.iter().filter(|[_, end]| end.norm() <= PLACED).count();
        match all.first() {
            Some([first, _]) if self.traced.counts && !self.traced.is_placed => *first,
            None => Vector::zeros(),
            _ if self.traced.is_relative || 2 * still >= all.len() => Vector::zeros(),
            Some(_) => {
                let middle = |axis: usize| {
                    let mut all: Vec<f64> = all.iter().map(|[_, end]| end[axis]).collect();
                    let half = (all.len() - 1) / 2;
                    *all.select_nth_unstable_by(half, f64::total_cmp).1
                };
                Vector::new(middle(0), middle(1))
            }
        }
    }
}

/// Two blocks that lead as far, in the same way.
fn are_alike(own: &Block, ideal: &Block) -> bool {
    own.motion
        .away_from(&ideal.motion)
        .is_some_and(|away| away <= SAME)
}

/// Which block stands beside which; `None` where fewer than nine of ten agree.
fn rows(own: &[Block], ideal: &[Block]) -> Option<Vec<Row>> {
    let most = own.len().max(ideal.len());
    if own.is_empty() || own.len().abs_diff(ideal.len()) > IN_ONE_PLACE + most / ONE_OF {
        return None;
    }
    let agree = |at: usize, nth: usize| match (own.get(at), ideal.get(nth)) {
        (Some(own), Some(ideal)) => are_alike(own, ideal),
        (None, None) => true,
        _ => false,
    };
    let mut rows = Vec::with_capacity(most);
    let (mut at, mut nth, mut unlike, mut places) = (0, 0, 0, 0);
    let moving = own
        .iter()
        .filter(|block| block.motion != Motion::Stop)
        .count();
    let mut last: Option<usize> = None;
    while at < own.len() || nth < ideal.len() {
        if at < own.len() && agree(at, nth) {
            rows.push(Row::Both {
                own: at,
                ideal: nth,
            });
            (at, nth) = (at + 1, nth + 1);
            continue;
        }
        let is_again = |&(more, lost): &(usize, usize)| {
            at + more <= own.len()
                && nth + lost <= ideal.len()
                && (0..AGAIN).all(|ahead| {
                    let (at, nth) = (at + more + ahead, nth + lost + ahead);
                    at > own.len() || nth > ideal.len() || agree(at, nth)
                })
        };
        // Where as much is left of both, none is lost: layers and passes that repeat agree one block on, too.
        let in_place = [(1, 1), (2, 2)];
        let is_even = own.len() - at == ideal.len() - nth;
        let first = in_place.into_iter().filter(|_| is_even);
        let (more, lost) = first.chain(ahead()).find(is_again).unwrap_or((1, 1));
        let both = more.min(lost);
        rows.extend((0..both).map(|step| Row::Both {
            own: at + step,
            ideal: nth + step,
        }));
        rows.extend((both..more).map(|step| Row::More { own: at + step }));
        rows.extend((both..lost).map(|step| Row::Lost {
            own: at + both,
            ideal: nth + step,
        }));
        let stops = |blocks: &[Block]| {
            blocks
                .iter()
                .filter(|block| block.motion == Motion::Stop)
                .count()
        };
        let of = |blocks: &[Block], from: usize, count: usize| {
            blocks
                .get(from..(from + count).min(blocks.len()))
                .map_or(0, stops)
        };
        // A stop more or less is a word, and no other way.
        let words = of(own, at, more).abs_diff(of(ideal, nth, lost));
        unlike += more.max(lost).saturating_sub(words);
        let is_new = last.is_none_or(|last| rows.len() > last + more.max(lost) + 2);
        (places, last) = (places + usize::from(is_new), Some(rows.len()));
        (at, nth) = ((at + more).min(own.len()), (nth + lost).min(ideal.len()));
        let is_in_one_place =
            places == 1 && unlike <= IN_ONE_PLACE && 2 * unlike <= most && moving >= AGAIN;
        if ONE_OF * unlike > most && !is_in_one_place {
            return None;
        }
    }
    // Of a block or two that differ nothing says that they are ours.
    (places == 0 || moving >= AGAIN).then_some(rows)
}

/// How many blocks of the program, and of the rewritten one, are passed over, the fewest first.
fn ahead() -> impl Iterator<Item = (usize, usize)> {
    let of_sum = |sum: usize| {
        let mut all: Vec<(usize, usize)> = (0..=sum).map(|more| (more, sum - more)).collect();
        all.sort_by_key(|(more, lost)| more.abs_diff(*lost));
        all
    };
    (1..=2 * AHEAD)
        .flat_map(of_sum)
        .filter(|(more, lost)| *more <= AHEAD && *lost <= AHEAD)
}
