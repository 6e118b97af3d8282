//! What the blocks of a program of ours say beside where they lead: their numbers, the side of the correction and where
//! it is taken from, and the side of each arc of 4B.

use super::TOLERANCE;
use super::aligned::{Aligned, Row};
use super::difference::Difference;
use super::traced::{Block, Motion};
use crate::finding::DifferenceKind;
use crate::geometry::Vector;
use std::collections::BTreeMap;

/// A larger difference of a number that moves nothing is another way to say the same, µm.
const SLIP: f64 = 50.0;

/// The words of a block beside those of the rewritten one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Words {
    /// They are the same: where the block leads elsewhere, it begins elsewhere.
    pub(super) are_same: bool,
    /// The difference of one of the numbers, where all else is equal, µm.
    apart: f64,
    /// The same for the coordinates after the block.
    pub(super) stated: f64,
    /// Of an arc of 4B, whether the wire should run inside of it, where the block has it otherwise.
    inside: Option<bool>,
}

impl Words {
    pub(super) fn of(aligned: &Aligned, own: &Block, ideal: &Block) -> Words {
        let (traced, rewritten) = (aligned.traced, &aligned.rewritten.traced);
        if traced.line_from(own) == rewritten.line_from(ideal) {
            return Words {
                are_same: true,
                ..Words::default()
            };
        }
        let (said, expected) = (traced.said(own), rewritten.said(ideal));
        let stated = match (said.stated, expected.stated) {
            (Some([x, y]), Some([ideal_x, ideal_y])) => {
                (x - ideal_x).abs().max((y - ideal_y).abs())
            }
            _ => 0.0,
        };
        // Where coordinates count from zero, they differ as the place does.
        let counts = traced.counts;
        Words {
            are_same: said.is_like(&expected),
            apart: said.apart(&expected).filter(|_| counts).unwrap_or(0.0),
            stated,
            inside: expected
                .concave
                .filter(|_| said.concave != expected.concave),
        }
    }

    /// How far a block is off, µm.
    pub(super) fn off(&self, own: &Block, ideal: &Block) -> f64 {
        let way = |block: &Block| match block.motion.ends() {
            Some([start, end]) => end - start,
            None => Vector::zeros(),
        };
        // A line in place of an arc is off by more than rounding, wherever it ends.
        let other = || (way(own) - way(ideal)).norm().max(2.0 * TOLERANCE);
        let away = own.motion.away_from(&ideal.motion).unwrap_or_else(other);
        // Of a line X and Y say only which way it leads, in whatever numbers.
        let is_line = ideal.segment().is_none_or(|ideal| ideal.as_arc().is_none());
        match is_line && self.apart > SLIP {
            true => away,
            false => away.max(self.apart),
        }
    }
}

/// Sides, registers and arcs of 4B that are others than in the rewritten program.
pub(super) fn of_corrections(aligned: &Aligned) -> Vec<Difference> {
    let pairs = aligned.rows.iter().filter_map(|row| match *row {
        Row::Both { own, ideal } => {
            let (block, meant) = aligned.pair(own, ideal)?;
            Some(Pair {
                at: own,
                own: block,
                ideal: meant,
            })
        }
        _ => None,
    });
    let pairs: Vec<Pair> = pairs.collect();
    let mut found = sides(aligned, &pairs);
    found.extend(registers(aligned, &pairs));
    found.extend(arcs(aligned, &pairs));
    found
}

/// A block beside the rewritten one.
struct Pair<'a> {
    at: usize,
    own: &'a Block,
    ideal: &'a Block,
}

/// Of each run of blocks on another side the first.
fn sides(aligned: &Aligned, pairs: &[Pair]) -> Vec<Difference> {
    let cut: Vec<&Pair> = pairs
        .iter()
        .filter(|pair| pair.own.segment().is_some())
        .collect();
    let key = |pair: &&Pair| (pair.own.side, pair.ideal.side, pair.ideal.stretch);
    let runs = cut.chunk_by(|one, other| key(one) == key(other));
    let wrong = runs.filter_map(|run| {
        let first = run
            .first()
            .filter(|first| first.own.side != first.ideal.side)?;
        let kind = DifferenceKind::Side {
            stated: first.own.side,
            ideal: first.ideal.side,
        };
        Some(Difference::at_switch(
            aligned.traced,
            first.own,
            first.at,
            kind,
        ))
    });
    let mut wrong: Vec<Difference> = wrong.collect();
    // None of it is offset: that is one fault.
    if aligned
        .traced
        .blocks
        .iter()
        .all(|block| block.side.is_none())
    {
        wrong.truncate(1);
    }
    wrong
}

/// Each pass takes its correction from the place that the rewritten one names; from another where all passes that share
/// it do, and no others: the machine's table may begin elsewhere.
fn registers(aligned: &Aligned, pairs: &[Pair]) -> Vec<Difference> {
    let mut passes: BTreeMap<u32, Vec<(u32, &Pair)>> = BTreeMap::new();
    let mut last: Option<&Block> = None;
    for pair in pairs {
        let is_new = last.is_none_or(|last| {
            last.motion == Motion::Stop
                || (last.stretch, last.register) != (pair.own.stretch, pair.own.register)
        });
        last = Some(pair.own);
        if let (Some(own), Some(ideal), true) = (pair.own.register, pair.ideal.register, is_new) {
            passes.entry(ideal).or_default().push((own, pair));
        }
    }
    let is_elsewhere = |(ideal, own): (&u32, &Vec<(u32, &Pair)>)| {
        let shared = own.first().map(|(register, _)| *register);
        let of_others = |register: u32| {
            let others = passes.iter().filter(|(other, _)| *other != ideal);
            others
                .flat_map(|(_, all)| all)
                .any(|(other, _)| *other == register)
        };
        own.iter().all(|(register, _)| Some(*register) == shared)
            && shared.is_some_and(|register| !of_others(register))
    };
    if passes.iter().all(is_elsewhere) {
        return Vec::new();
    }
    let mut found = Vec::new();
    for (ideal, own) in &passes {
        let mut counts: BTreeMap<u32, usize> = BTreeMap::new();
        own.iter()
            .for_each(|(register, _)| *counts.entry(*register).or_default() += 1);
        let shared = counts
            .into_iter()
            .max_by_key(|(register, count)| (*count, register == ideal));
        let is_named = own.iter().any(|(register, _)| register == ideal);
        let right = match (is_named, shared) {
            (false, Some((shared, count))) if count > 1 => shared,
            _ => *ideal,
        };
        for (stated, pair) in own.iter().filter(|(register, _)| *register != right) {
            let kind = DifferenceKind::Register {
                stated: *stated,
                ideal: right,
            };
            found.push(Difference::at_switch(
                aligned.traced,
                pair.own,
                pair.at,
                kind,
            ));
        }
    }
    found
}

/// The arcs of 4B at which the wire runs on the other side; of several in sequence the first.
fn arcs(aligned: &Aligned, pairs: &[Pair]) -> Vec<Difference> {
    let (mut found, mut last) = (Vec::new(), false);
    if !aligned.traced.four_b {
        return found;
    }
    for pair in pairs {
        let is_arc = pair.own.segment().is_some_and(|own| own.as_arc().is_some());
        let words = Words::of(aligned, pair.own, pair.ideal);
        if let (Some(inside), true, false) = (words.inside, is_arc, last) {
            let kind = DifferenceKind::Turned { inside };
            found.push(Difference::of(pair.own, None, 0.0, kind));
        }
        if is_arc {
            last = words.inside.is_some();
        }
    }
    found
}
