//! The corrections of all passes that a program may have been written with.

use super::drawn::Drawn;
use super::traced::Traced;
use super::{infer, measure};
use std::cmp::Reverse;

/// Corrections that mean the same one, mm; and of the first of several passes how many are tried.
const NEAR: f64 = 2e-3;
const FIRST: usize = 6;
/// Passes that are thought of, at most.
const PASSES: usize = 8;

/// What the first pass may have, mm, where each of the others runs so much nearer, that which most corrections speak for first.
fn first_of(speaks_for: &[f64], steps: &[f64]) -> Vec<f64> {
    let mut found: Vec<(usize, f64)> = Vec::new();
    let last = steps.last().copied().unwrap_or(f64::INFINITY);
    for first in speaks_for
        .iter()
        .flat_map(|mm| steps.iter().map(move |step| mm + step))
    {
        match found
            .iter_mut()
            .find(|(_, known)| (*known - first).abs() <= NEAR)
        {
            Some((count, _)) => *count += 1,
            None if first > last => found.push((1, first)),
            None => {}
        }
    }
    found.sort_by_key(|(count, _)| Reverse(*count));
    let round = |mm: f64| [(mm * 200.0).round() / 200.0, (mm * 1e3).round() / 1e3];
    let mut all: Vec<f64> = Vec::new();
    for mm in found.into_iter().take(FIRST).flat_map(|(_, mm)| round(mm)) {
        if !all.contains(&mm) {
            all.push(mm);
        }
    }
    all
}

/// Corrections that a program may have been written with, mm, those of several passes falling.
pub(super) fn corrections(drawn: &Drawn, traced: &Traced) -> Vec<Vec<f64>> {
    let scale = drawn.unit_mm * 1e3;
    let speaks_for = infer::corrections(drawn.contours().iter(), scale, &measure::first(traced));
    let arcs = traced
        .blocks
        .iter()
        .filter_map(|block| block.segment()?.as_arc());
    // Round a corner it is the radius; a transition of 4B is larger by a step.
    let least = arcs
        .map(|arc| arc.radius / 1e3)
        .fold(f64::INFINITY, f64::min);
    let least = least.is_finite().then_some([least, least - 1e-3]);
    let places = |mm: f64| (mm * 1e3).round() / 1e3;
    // A way in whose length is counted from the contour is shorter by the correction.
    let leads = measure::leads(traced, 0.0).into_iter();
    let leads = leads.map(|(length, _)| drawn.settings.lead_in - length);
    let lead = leads.take(1).filter(|mm| (0.0..1.0).contains(mm));
    let rounded = speaks_for.iter().copied().take(2).chain(lead);
    let rounded = rounded.chain(least.into_iter().flatten());
    let near = |mm: f64| [0.0, -1e-3, 1e-3].map(|by| places(mm + by));
    let mut single: Vec<f64> = Vec::new();
    for mm in rounded.flat_map(near).filter(|mm| *mm > 0.0) {
        if !single.contains(&mm) {
            single.push(mm);
        }
    }
    // A shorter number first.
    let steps = |mm: &f64| (*mm * 1e3).round() as i64;
    single.sort_by_key(|mm| (steps(mm) % 5 != 0, steps(mm) % 10 != 0));
    let mut all: Vec<Vec<f64>> = single.into_iter().map(|mm| vec![mm]).collect();
    let own = drawn.settings.each_correction();
    if own.len() == 1 {
        all.insert(0, own);
    }
    let count = measure::passes(traced).min(PASSES);
    if count > 1 {
        let of_control = traced.four_b || traced.blocks.iter().any(|block| block.is_offset);
        let falling = |from: f64| {
            let of = |pass: usize| from * (1.0 - 0.1 * pass as f64);
            (0..count).map(of).collect()
        };
        // Where the control adds the correction, all passes are one way.
        let mut lists: Vec<Vec<f64>> = match of_control {
            true => {
                let single = all.iter().take(4).map(|list| list[0]);
                let aside = measure::aside(traced);
                aside.into_iter().chain(single).map(falling).collect()
            }
            false => Vec::new(),
        };
        let steps = measure::steps(traced);
        for first in first_of(&speaks_for, &steps) {
            let fifths = |mm: f64| (mm * 200.0).round() / 200.0;
            lists.push(
                steps
                    .iter()
                    .map(|step| places(first - fifths(*step)))
                    .collect(),
            );
            lists.push(steps.iter().map(|step| places(first - step)).collect());
        }
        all.splice(0..0, lists);
    }
    // What the votes come to where it has more than three places.
    all.extend(speaks_for.first().map(|mm| vec![*mm]));
    all
}
