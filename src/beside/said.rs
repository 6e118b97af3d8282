//! What a program says beside coordinates: the side of the correction and where it is taken from, stops, and the side of
//! each arc in 4B. Where the blocks are those of the rewritten program, these words are, too.

use super::comparison::FEW;
use super::difference::Difference;
use super::pairs::{Pair, Pairs};
use super::traced::{Block, Motion};
use super::walk::Kind;
use std::collections::BTreeMap;

/// The words that differ. `is_set`: the rewritten program is that of the drawing's own settings.
pub(super) fn said(pairs: &Pairs, is_set: bool) -> Vec<Difference> {
    let mut found = sides(pairs);
    found.extend(registers(pairs));
    found.extend(stops(pairs, is_set));
    found.extend(arcs(pairs));
    found.sort_by_key(|one| one.range.start);
    found
}

/// The switch of the correction before a block, where there is one, else the block.
fn at_switch(pairs: &Pairs, pair: &Pair, kind: Kind) -> Difference {
    let switch = match pair.own.side {
        Some(_) => pairs.traced.switch_before(pair.at),
        None => None,
    };
    let mut found = Difference::of(pair.own, None, 0.0, kind);
    if let Some((range, line)) = switch {
        (found.range, found.line) = (range, line);
    }
    found
}

/// Whether a pair is of a contour, and not of a way in or out.
fn is_of_contour(pairs: &Pairs, pair: &Pair) -> bool {
    let cuts = &pairs.reference.traced.cuts;
    let at = cuts.partition_point(|[all, _]| all.end <= pair.nth);
    cuts.get(at)
        .is_some_and(|[_, contour]| contour.contains(&pair.nth))
}

fn sides(pairs: &Pairs) -> Vec<Difference> {
    let cut = pairs
        .pairs
        .iter()
        .filter(|pair| pair.own.segment().is_some());
    let key = |pair: &&Pair| (pair.own.side, pair.meant.side, pair.meant.stretch);
    let all: Vec<&Pair> = cut.collect();
    if all.iter().all(|pair| pair.own.side == pair.meant.side) {
        return Vec::new();
    }
    let (mut found, mut ways, mut right) = (Vec::new(), Vec::new(), 0);
    for run in all.chunk_by(|one, other| key(one) == key(other)) {
        let first = run[0];
        let (said, meant) = (first.own.side, first.meant.side);
        if said == meant {
            right += usize::from(!run.iter().any(|pair| is_of_contour(pairs, pair)));
            continue;
        }
        let one = at_switch(pairs, first, Kind::Side { said, meant });
        match run.iter().any(|pair| is_of_contour(pairs, pair)) {
            true => found.push(one),
            false => ways.push(one),
        }
    }
    // Others switch the correction off a block earlier or later, but then they always do.
    if ways.len() <= right && found.is_empty() {
        found.append(&mut ways);
    }
    // None of it is offset: that is one fault, or a setting.
    if pairs.traced.blocks.iter().all(|block| !block.is_offset()) {
        found.truncate(1);
    }
    found.truncate(FEW);
    found
}

/// Each pass takes its correction from the place from which most passes of its number take it.
fn registers(pairs: &Pairs) -> Vec<Difference> {
    let mut all: BTreeMap<u32, Vec<(u32, &Pair)>> = BTreeMap::new();
    let mut last: Option<&Block> = None;
    for pair in &pairs.pairs {
        let is_new = last.is_none_or(|last| {
            last.motion == Motion::Stop
                || (last.stretch, last.register) != (pair.own.stretch, pair.own.register)
        });
        last = Some(pair.own);
        if let (Some(own), Some(meant), true) = (pair.own.register, pair.meant.register, is_new) {
            all.entry(meant).or_default().push((own, pair));
        }
    }
    let mut found = Vec::new();
    let mut taken: Vec<u32> = Vec::new();
    for (meant, passes) in all {
        let mut counts: BTreeMap<u32, usize> = BTreeMap::new();
        for (own, _) in &passes {
            *counts.entry(*own).or_default() += 1;
        }
        let most = counts
            .into_iter()
            .max_by_key(|(own, count)| (*count, *own == meant, !taken.contains(own)));
        let Some((most, _)) = most else { continue };
        taken.push(most);
        let others = passes.iter().filter(|(own, _)| *own != most);
        found.extend(others.map(|(said, pair)| {
            let kind = Kind::Register {
                said: *said,
                meant: most,
            };
            at_switch(pairs, pair, kind)
        }));
    }
    found
}

/// What a stop is before.
#[derive(Clone, Copy, PartialEq)]
enum Before {
    Tab,
    /// Another pass of the same contour.
    Pass,
    Way,
}

impl Before {
    fn of(pairs: &Pairs, before: &Pair, behind: &Pair) -> Before {
        let cuts = &pairs.reference.traced.cuts;
        let is_way = |pair: &Pair| {
            let own = cuts.iter().find(|[all, _]| all.contains(&pair.nth));
            own.is_none_or(|[_, contour]| contour.is_empty())
        };
        let follows = |pair: &Pair| pairs.reference.source_of(&pair.meant.motion).is_some();
        if is_way(before) || is_way(behind) {
            Before::Way
        } else if follows(before) && follows(behind) {
            Before::Tab
        } else {
            Before::Pass
        }
    }
}

/// Where no stop is, and nothing in its place, though the program stops elsewhere before the like. A program that stops
/// before nothing of that kind may be for a machine that does by itself, except where the settings ask for a tab.
fn stops(pairs: &Pairs, is_set: bool) -> Vec<Difference> {
    if pairs.unstopped.is_empty() {
        return Vec::new();
    }
    let all = &pairs.pairs;
    let stopping = all.windows(3).filter_map(|about| match about {
        [before, stop, behind] if stop.own.motion == Motion::Stop => {
            Some(Before::of(pairs, before, behind))
        }
        _ => None,
    });
    let stopping: Vec<Before> = stopping.collect();
    let lost = |number: &usize| {
        let [before, behind] = [number.checked_sub(1)?, *number].map(|at| all.get(at));
        let (before, behind) = (before?, behind?);
        let kind = Before::of(pairs, before, behind);
        let is_lost = stopping.contains(&kind) || is_set && kind == Before::Tab;
        let is_bare = is_lost && pairs.traced.is_bare_between(before.own, behind.own);
        is_bare.then(|| Difference::of(behind.own, None, 0.0, Kind::Unstopped))
    };
    let found: Vec<Difference> = pairs.unstopped.iter().filter_map(lost).collect();
    match found.len() <= FEW {
        true => found,
        false => Vec::new(),
    }
}

/// The arcs of 4B at which the wire runs on the other side; of several in sequence the first.
fn arcs(pairs: &Pairs) -> Vec<Difference> {
    let mut found = Vec::new();
    let mut last = false;
    for pair in &pairs.pairs {
        if pair.own.segment().is_none_or(|own| own.as_arc().is_none()) {
            last &= pair.own.segment().is_some();
            continue;
        }
        if let Some(meant) = pair.words.concave
            && !last
        {
            let segment = pairs.reference.source_of(&pair.meant.motion);
            found.push(Difference::of(
                pair.own,
                segment,
                0.0,
                Kind::Turned { meant },
            ));
        }
        last = pair.words.concave.is_some();
    }
    found.truncate(FEW);
    found
}
