//! The blocks of a program, each beside that of the program which is written again.

use super::reference::Reference;
use super::traced::{Block, Motion, Traced};
use crate::geometry::Vector;

/// The most blocks that may be lost or superfluous in one place.
const LOST: usize = 3;

/// The blocks of a program, each beside the rewritten one.
pub(super) struct Pairs<'a> {
    pub traced: &'a Traced,
    pub reference: &'a Reference,
    pub pairs: Vec<Pair<'a>>,
    /// The block at which some are lost or too many, and one of these.
    pub gap: Option<(&'a Block, &'a Block)>,
    /// Numbers of the pairs before which a stop is lost.
    pub unstopped: Vec<usize>,
}

pub(super) struct Pair<'a> {
    pub own: &'a Block,
    pub meant: &'a Block,
    pub words: Words,
    /// Their numbers among the blocks of each program.
    pub at: usize,
    pub nth: usize,
    /// Blocks before it are lost or superfluous.
    pub behind_gap: bool,
}

/// The words of a block beside those of the rewritten one.
#[derive(Clone, Copy)]
pub(super) struct Words {
    /// They are the same.
    pub are_same: bool,
    /// The difference of one of the numbers, where all else is equal, µm.
    pub apart: Option<f64>,
    /// The same for the coordinates after the block.
    pub stated: f64,
    /// Of an arc of 4B, whether the wire should run inside of it, where the block has it otherwise.
    pub concave: Option<bool>,
}

impl Words {
    fn of(traced: &Traced, own: &Block, reference: &Reference, meant: &Block) -> Words {
        let reference = &reference.traced;
        if traced.line_from(own) == reference.line_from(meant) {
            return Words {
                are_same: true,
                apart: Some(0.0),
                stated: 0.0,
                concave: None,
            };
        }
        let (said, expected) = (traced.said(own), reference.said(meant));
        let stated = match (said.stated, expected.stated) {
            (Some([x, y]), Some([meant_x, meant_y])) => {
                (x - meant_x).abs().max((y - meant_y).abs())
            }
            _ => 0.0,
        };
        Words {
            are_same: said.is_like(&expected),
            apart: said.apart(&expected),
            stated,
            concave: expected
                .concave
                .filter(|_| said.concave != expected.concave),
        }
    }

    /// Equal except for rounding.
    fn are_near(&self) -> bool {
        self.apart.is_some_and(|apart| apart <= 1.0)
    }
}

impl<'a> Pairs<'a> {
    /// `None` where blocks are lost or superfluous and there is any other difference, or where they are too many.
    pub(super) fn of(traced: &'a Traced, reference: &'a Reference) -> Option<Pairs<'a>> {
        let (own, meant) = (&traced.blocks[..], &reference.traced.blocks[..]);
        let (more, lost) = (
            own.len().saturating_sub(meant.len()),
            meant.len().saturating_sub(own.len()),
        );
        let pair = |(at, nth): (usize, usize)| {
            let (own, meant) = (own.get(at)?, meant.get(nth)?);
            Some(Pair {
                own,
                meant,
                words: Words::of(traced, own, reference, meant),
                at,
                nth,
                behind_gap: false,
            })
        };
        let moving = |blocks: &[Block]| blocks.iter().filter(|block| !is_stop(block)).count();
        if moving(own) == moving(meant) {
            let (both, unstopped) = beside_each_other(own, meant)?;
            return (!own.is_empty()).then(|| Pairs {
                traced,
                reference,
                pairs: both.into_iter().filter_map(pair).collect(),
                gap: None,
                unstopped,
            });
        }
        if more.max(lost) > LOST || own.is_empty() {
            return None;
        }
        let mut pairs: Vec<Pair> = Vec::with_capacity(own.len());
        let before = (0..own.len()).map_while(|at| pair((at, at)));
        pairs.extend(before.take_while(|pair| pair.words.are_near()));
        let at = pairs.len();
        if at + more > own.len() || at + lost > meant.len() {
            return None;
        }
        let behind = (at + more..).zip(at + lost..);
        pairs.extend(behind.map_while(pair));
        if !pairs[at..].iter().all(|pair| pair.words.are_near()) {
            return None;
        }
        if let Some(next) = pairs.get_mut(at) {
            next.behind_gap = true;
        }
        let place = own.get(at).or(own.last())?;
        let of = if more > 0 {
            own.get(at)?
        } else {
            meant.get(at)?
        };
        (!is_stop(of)).then_some(Pairs {
            traced,
            reference,
            pairs,
            gap: Some((place, of)),
            unstopped: Vec::new(),
        })
    }

    /// The place of most of the program relative to the rewritten one.
    pub(super) fn away(&self) -> Vector {
        let ends = |pair: &Pair| {
            let ([_, end], [_, meant]) = (pair.own.motion.ends()?, pair.meant.motion.ends()?);
            Some(end - meant)
        };
        let all: Vec<Vector> = self.pairs.iter().filter_map(ends).collect();
        let middle = |axis: usize| {
            let mut all: Vec<f64> = all.iter().map(|away| away[axis]).collect();
            let half = all.len() / 2;
            match all.is_empty() {
                true => 0.0,
                false => *all.select_nth_unstable_by(half, f64::total_cmp).1,
            }
        };
        Vector::new(middle(0), middle(1))
    }
}

fn is_stop(block: &Block) -> bool {
    block.motion == Motion::Stop
}

/// Numbers of two blocks that belong together.
type Numbers = Vec<(usize, usize)>;

/// The numbers of the blocks of two programs that move as often, in pairs, and those of the pairs before which the first
/// program lacks a stop of the second; `None` where it stops anywhere else.
fn beside_each_other(own: &[Block], meant: &[Block]) -> Option<(Numbers, Vec<usize>)> {
    let mut pairs = Vec::with_capacity(own.len());
    let mut unstopped = Vec::new();
    let mut at = 0;
    for (nth, other) in meant.iter().enumerate() {
        let one = own.get(at)?;
        match (is_stop(one), is_stop(other)) {
            (false, true) => unstopped.push(pairs.len()),
            (true, false) => return None,
            _ => {
                pairs.push((at, nth));
                at += 1;
            }
        }
    }
    (at == own.len()).then_some((pairs, unstopped))
}
