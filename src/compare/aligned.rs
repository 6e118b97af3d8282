//! The blocks of a program beside those of the program that is written again, and where both lie.
//!
//! Blocks are aligned by how far they lead, wherever the program lies: `B1000B0B1000GXL1` is the same block everywhere.
//! Where the two programs part, both are searched a few blocks ahead for where they agree again, so the work grows with
//! their length.

use super::TOLERANCE;
use super::rewritten::Rewritten;
use super::traced::{Block, Motion, Traced};
use super::words::Words;
use crate::drawing::EntityId;
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

/// A block of the program beside that of the rewritten one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<'a> {
    /// The numbers of both.
    pub(super) at: usize,
    pub(super) nth: usize,
    pub(super) own: &'a Block,
    pub(super) ideal: &'a Block,
    /// The segment of the drawing that the rewritten one follows: none for ways and stops.
    pub(super) source: Option<(EntityId, usize)>,
    pub(super) words: Words,
    /// How far it is off, µm.
    pub(super) off: f64,
    /// How far it begins, and ends, from where the rewritten one does, beyond what all of the program is away.
    pub(super) away: [Vector; 2],
}

impl<'a> Pair<'a> {
    fn of(traced: &'a Traced, at: usize, rewritten: &'a Rewritten, nth: usize) -> Option<Pair<'a>> {
        let (own, ideal) = (traced.blocks.get(at)?, rewritten.traced.blocks.get(nth)?);
        let words = Words::of(traced, own, &rewritten.traced, ideal);
        Some(Pair {
            at,
            nth,
            own,
            ideal,
            source: rewritten.source(nth),
            words,
            off: words.off(own, ideal),
            away: apart(own, ideal).unwrap_or_default(),
        })
    }

    /// It leads elsewhere, and says something else.
    pub(super) fn is_off(&self) -> bool {
        self.off > TOLERANCE && !self.words.are_same
    }

    /// It is of a contour.
    pub(super) fn is_of_contour(&self) -> bool {
        self.source.is_some()
    }
}

/// What stands beside what.
#[derive(Clone, Copy, Debug)]
pub(super) enum Row<'a> {
    Both(Pair<'a>),
    /// Nothing stands for it, before this block of the program.
    Lost {
        at: usize,
        ideal: &'a Block,
        source: Option<(EntityId, usize)>,
    },
    /// It stands for nothing.
    More(&'a Block),
}

/// A program beside the one that is written again.
pub(super) struct Aligned<'a> {
    pub(super) traced: &'a Traced,
    pub(super) rewritten: &'a Rewritten,
    pub(super) rows: Vec<Row<'a>>,
    /// From the rewritten program's places to where most of the program lies.
    pub(super) from: Vector,
}

impl<'a> Aligned<'a> {
    /// `None` where fewer than nine blocks of ten agree.
    pub(super) fn of(traced: &'a Traced, rewritten: &'a Rewritten) -> Option<Aligned<'a>> {
        let mut aligned = Aligned {
            traced,
            rewritten,
            rows: rows(traced, rewritten)?,
            from: Vector::zeros(),
        };
        let shift = match traced.is_placed {
            true => rewritten.shift,
            false => Vector::zeros(),
        };
        aligned.move_by(shift);
        aligned.from = aligned.away();
        aligned.move_by(aligned.from);
        Some(aligned)
    }

    fn move_by(&mut self, by: Vector) {
        for row in &mut self.rows {
            if let Row::Both(pair) = row
                && apart(pair.own, pair.ideal).is_some()
            {
                pair.away = pair.away.map(|away| away - by);
            }
        }
    }

    pub(super) fn pairs(&self) -> impl Iterator<Item = &Pair<'a>> {
        self.rows.iter().filter_map(|row| match row {
            Row::Both(pair) => Some(pair),
            Row::Lost { .. } | Row::More(_) => None,
        })
    }

    /// How far the program lies from the rewritten one: a machine that counts begins anywhere, where the first contour
    /// is; an absolute program lies where it says, or all of it elsewhere.
    fn away(&self) -> Vector {
        let of_contours = self.pairs().filter(|pair| pair.is_of_contour());
        let all: Vec<[Vector; 2]> = of_contours.map(|pair| pair.away).collect();
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

/// How far a block begins, and ends, from where another one does.
fn apart(own: &Block, ideal: &Block) -> Option<[Vector; 2]> {
    let ([start, end], [ideal_start, ideal_end]) = (own.motion.ends()?, ideal.motion.ends()?);
    Some([start - ideal_start, end - ideal_end])
}

/// Which block stands beside which; `None` where fewer than nine of ten agree.
fn rows<'a>(traced: &'a Traced, rewritten: &'a Rewritten) -> Option<Vec<Row<'a>>> {
    let (own, ideal) = (&traced.blocks, &rewritten.traced.blocks);
    let most = own.len().max(ideal.len());
    if own.is_empty() || own.len().abs_diff(ideal.len()) > IN_ONE_PLACE + most / ONE_OF {
        return None;
    }
    // They lead as far, in the same way.
    let agree = |at: usize, nth: usize| match (own.get(at), ideal.get(nth)) {
        (Some(own), Some(ideal)) => {
            let away = own.motion.away_from(&ideal.motion);
            away.is_some_and(|away| away <= SAME)
        }
        (None, None) => true,
        _ => false,
    };
    let stops = |blocks: &[Block], from: usize, count: usize| {
        let blocks = blocks.iter().skip(from).take(count);
        blocks.filter(|block| block.motion == Motion::Stop).count()
    };
    let moving = own.len() - stops(own, 0, own.len());
    let mut rows = Vec::with_capacity(most);
    let (mut at, mut nth, mut unlike, mut places) = (0, 0, 0, 0);
    let mut last: Option<usize> = None;
    while at < own.len() || nth < ideal.len() {
        if at < own.len() && agree(at, nth) {
            rows.extend(Pair::of(traced, at, rewritten, nth).map(Row::Both));
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
        let pair = |step: usize| Pair::of(traced, at + step, rewritten, nth + step);
        rows.extend((0..both).filter_map(pair).map(Row::Both));
        rows.extend((both..more).filter_map(|step| Some(Row::More(own.get(at + step)?))));
        rows.extend((both..lost).filter_map(|step| {
            Some(Row::Lost {
                at: at + both,
                ideal: ideal.get(nth + step)?,
                source: rewritten.source(nth + step),
            })
        }));
        // A stop more or less is a word, and no other way.
        let words = stops(own, at, more).abs_diff(stops(ideal, nth, lost));
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
    let all = (1..=2 * AHEAD).flat_map(of_sum);
    all.filter(|(more, lost)| *more <= AHEAD && *lost <= AHEAD)
}
