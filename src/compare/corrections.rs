//! The corrections of a program of ours: the side and where it is taken from, and the side of each arc of 4B.

use super::aligned::{Aligned, Pair};
use super::difference::Difference;
use super::traced::{Block, Motion};
use crate::finding::DifferenceKind;
use std::collections::{BTreeMap, BTreeSet};

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
