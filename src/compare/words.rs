//! What the blocks of a program of ours say beside where they lead: their numbers, the side of the correction and where
//! it is taken from, and the side of each arc of 4B.

use super::TOLERANCE;
use super::aligned::{Aligned, Pair};
use super::difference::Difference;
use super::traced::{Block, Motion, Traced};
use crate::finding::DifferenceKind;
use crate::geometry::Vector;
use std::collections::{BTreeMap, BTreeSet};

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
    pub(super) fn of(traced: &Traced, own: &Block, rewritten: &Traced, ideal: &Block) -> Words {
        if traced.line_from(own) == rewritten.line_from(ideal) {
            return Words {
                are_same: true,
                ..Words::default()
            };
        }
        let (said, expected) = (traced.said(own), rewritten.said(ideal));
        let stated = said.stated.zip(expected.stated);
        let concave = expected.concave;
        // Where coordinates count from zero, they differ as the place does.
        let apart = said.apart(&expected).filter(|_| traced.counts);
        Words {
            are_same: said.is_like(&expected),
            apart: apart.unwrap_or(0.0),
            stated: stated.map_or(0.0, |([x, y], [ideal_x, ideal_y])| {
                (x - ideal_x).abs().max((y - ideal_y).abs())
            }),
            inside: concave.filter(|_| said.concave != concave),
        }
    }

    /// How far a block is off, µm.
    pub(super) fn off(&self, own: &Block, ideal: &Block) -> f64 {
        let way = |block: &Block| {
            let ends = block.motion.ends();
            ends.map_or(Vector::zeros(), |[start, end]| end - start)
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
    let mut found = sides(aligned);
    found.extend(registers(aligned));
    if aligned.traced.four_b {
        found.extend(arcs(aligned));
    }
    found
}

/// Of each run of blocks on another side the first.
fn sides(aligned: &Aligned) -> Vec<Difference> {
    let cut: Vec<&Pair> = aligned
        .pairs()
        .filter(|pair| pair.own.segment().is_some())
        .collect();
    let key = |pair: &&Pair| (pair.own.side, pair.ideal.side, pair.ideal.stretch);
    let firsts = cut
        .chunk_by(|one, other| key(one) == key(other))
        .map(|run| run[0]);
    let wrong = firsts
        .filter(|first| first.own.side != first.ideal.side)
        .map(|first| {
            let kind = DifferenceKind::Side {
                stated: first.own.side,
                ideal: first.ideal.side,
            };
            Difference::at_switch(aligned.traced, first.own, first.at, kind)
        });
    // None of it is offset: that is one fault.
    let is_none = aligned
        .traced
        .blocks
        .iter()
        .all(|block| block.side.is_none());
    wrong.take(if is_none { 1 } else { usize::MAX }).collect()
}

/// Each pass takes its correction from the place that the rewritten one names; from another where all passes that share
/// it do, and no others: the machine's table may begin elsewhere.
fn registers(aligned: &Aligned) -> Vec<Difference> {
    let mut passes: Vec<(u32, u32, &Pair)> = Vec::new();
    let mut last: Option<&Block> = None;
    for pair in aligned.pairs() {
        let before = last.replace(pair.own);
        let is_same = before.is_some_and(|before| {
            before.motion != Motion::Stop
                && (before.stretch, before.register) == (pair.own.stretch, pair.own.register)
        });
        if let (Some(own), Some(ideal), false) = (pair.own.register, pair.ideal.register, is_same) {
            passes.push((own, ideal, pair));
        }
    }
    let mut counts: BTreeMap<u32, BTreeMap<u32, usize>> = BTreeMap::new();
    for (own, ideal, _) in &passes {
        *counts.entry(*ideal).or_default().entry(*own).or_default() += 1;
    }
    let used: BTreeSet<u32> = passes.iter().map(|(own, ..)| *own).collect();
    if counts.values().all(|own| own.len() == 1) && used.len() == counts.len() {
        return Vec::new();
    }
    let right = |ideal: u32| {
        let own = counts.get(&ideal).filter(|own| !own.contains_key(&ideal));
        let most = own.and_then(|own| own.iter().max_by_key(|(_, count)| **count));
        most.filter(|(_, count)| **count > 1)
            .map_or(ideal, |(most, _)| *most)
    };
    let wrong = passes
        .iter()
        .filter(|(own, ideal, _)| *own != right(*ideal));
    let named = wrong.map(|(own, ideal, pair)| {
        let kind = DifferenceKind::Register {
            stated: *own,
            ideal: right(*ideal),
        };
        Difference::at_switch(aligned.traced, pair.own, pair.at, kind)
    });
    named.collect()
}

/// The arcs of 4B at which the wire runs on the other side; of several in sequence the first.
fn arcs(aligned: &Aligned) -> Vec<Difference> {
    let is_arc = |own: &Block| own.segment().is_some_and(|own| own.as_arc().is_some());
    let arcs: Vec<&Pair> = aligned.pairs().filter(|pair| is_arc(pair.own)).collect();
    let is_wrong = |pair: &Pair| pair.words.inside.is_some();
    let runs = arcs.chunk_by(|one, other| is_wrong(one) == is_wrong(other));
    let named = runs.filter_map(|run| {
        let inside = run[0].words.inside?;
        let kind = DifferenceKind::Turned { inside };
        Some(Difference::of(run[0].own, None, 0.0, kind))
    });
    named.collect()
}
