//! The corrections of all passes that a program may have been written with.

use super::drawn::Drawn;
use super::traced::Traced;
use super::{infer, measure};
use crate::geometry::Segment;
use std::collections::BTreeMap;

/// The most passes that are considered.
const PASSES: usize = 8;
/// The largest deviation of a pass from its place among the passes, mm.
const NEAR: f64 = 8e-3;
/// How far the radius of a block may be from that of its arc, µm.
const OF_GRID: f64 = 1.5;
/// Settings are round numbers, mm.
const ROUND: [f64; 3] = [5e-3, 1e-3, 1e-4];

fn rounded(mm: f64, to: f64) -> f64 {
    ((mm / to).round() * to * 1e4).round() / 1e4
}

/// Sorts lengths, mm: a shorter number comes first.
pub(super) fn shortness(mm: f64) -> (bool, bool) {
    let places = (mm * 1e3).round() as i64;
    (places % 5 != 0, places % 10 != 0)
}

/// The radii of a program's arcs, µm; of 4B, which holds the part's contour, those that the drawing does not have.
fn radii(drawn: &Drawn, traced: &Traced) -> Vec<f64> {
    let scale = drawn.unit_mm * 1e3;
    let radius_of = |segment: &Segment| segment.as_arc().map(|arc| arc.radius);
    let segments = drawn
        .contours()
        .iter()
        .flat_map(|contour| &contour.segments);
    let mut drawn_radii: Vec<f64> = segments
        .filter(|_| traced.four_b)
        .filter_map(|segment| Some(radius_of(&segment.geometry)? * scale))
        .collect();
    drawn_radii.sort_by(f64::total_cmp);
    let is_drawn = |radius: f64| {
        let at = drawn_radii.partition_point(|own| *own < radius - OF_GRID);
        drawn_radii
            .get(at)
            .is_some_and(|own| *own <= radius + OF_GRID)
    };
    let all = traced.blocks.iter();
    let all = all.filter_map(|block| block.segment().and_then(radius_of));
    all.filter(|radius| !is_drawn(*radius)).collect()
}

/// What 4B's transitions may come from, mm: the most frequent of the radii that the drawing does not have.
fn transitions(radii: &[f64]) -> Option<f64> {
    let mut counts: BTreeMap<i64, usize> = BTreeMap::new();
    for radius in radii {
        *counts.entry(radius.round() as i64).or_default() += 1;
    }
    // The smaller one of two that are as frequent: on the grid some are larger.
    let most = counts.into_iter().rev().max_by_key(|(_, count)| *count)?;
    Some(most.0 as f64 / 1e3 - 1e-3)
}

/// Corrections that a program may have been written with, mm; those of several passes fall.
pub(super) fn corrections(drawn: &Drawn, traced: &Traced) -> Vec<Vec<f64>> {
    let scale = drawn.unit_mm * 1e3;
    let mut passes = measure::passes(traced);
    // Where 4B leaves a tab, every other one may be a way back.
    let fewer = traced.four_b.then(|| measure::passes_one_way(&passes));
    passes.truncate(PASSES);
    let fewer = fewer.filter(|count| (1..passes.len()).contains(count));
    let steps = measure::steps(&passes).filter(|steps| steps.len() > 1);
    let first = [0.0];
    let known = steps.as_deref().unwrap_or(&first);
    let speaks_for = infer::of_passes(drawn.contours(), scale, &passes, known);
    let radii = radii(drawn, traced);
    // Round a corner it is the radius; a transition of 4B is larger by a step.
    let least = radii.iter().copied().fold(f64::INFINITY, f64::min) / 1e3;
    let least = least.is_finite().then_some([least, least - 1e-3]);
    let rounded_by = transitions(&radii).filter(|_| traced.four_b);
    // A way in whose length is counted from the contour is shorter by the correction.
    let leads = measure::leads(traced, 0.0).into_iter();
    let leads = leads.map(|(length, _)| drawn.settings.lead_in - length);
    let lead = leads.take(1).filter(|mm| (0.0..1.0).contains(mm));
    let likely = speaks_for.iter().copied().take(2).chain(lead);
    let likely = likely.chain(least.into_iter().flatten()).chain(rounded_by);
    let near = |mm: f64| [0.0, -1e-3, 1e-3].map(|by| rounded(mm + by, 1e-3));
    let mut single: Vec<f64> = Vec::new();
    for mm in likely.flat_map(near).filter(|mm| *mm > 0.0) {
        if !single.contains(&mm) {
            single.push(mm);
        }
    }
    single.sort_by_key(|mm| shortness(*mm));
    let mut all: Vec<Vec<f64>> = single.into_iter().map(|mm| vec![mm]).collect();
    let own = drawn.settings.each_correction();
    if own.len() == 1 {
        all.insert(0, own);
    }
    if passes.len() > 1 {
        let of_control = traced.four_b || traced.blocks.iter().any(|block| block.is_offset());
        let falling = |count: usize, from: f64| -> Vec<f64> {
            let of = |pass: usize| from * (1.0 - 0.1 * pass as f64);
            (0..count).map(of).collect()
        };
        // Where the control adds the correction, all passes are one way.
        let mut lists: Vec<Vec<f64>> = match of_control {
            true => {
                let mut single = all.iter().take(4).map(|list| list[0]);
                let own = single.next();
                let aside = measure::switching(traced);
                let least = least.into_iter().flatten().rev();
                let least = least.map(|mm| rounded(mm, 1e-3)).filter(|mm| *mm > 0.0);
                // Where several are alike as likely, the drawing's own.
                let first = aside.iter().copied().take(1).chain(own);
                let first = first.chain(least).chain(single);
                let counts = || std::iter::once(passes.len()).chain(fewer);
                let fall = first.flat_map(|mm| counts().map(move |count| falling(count, mm)));
                // Each pass may have told its own.
                let is_whole = aside.len() > 1 && aside.windows(2).all(|two| two[0] > two[1]);
                let each = is_whole.then(|| aside.clone());
                each.into_iter().chain(fall).collect()
            }
            false => Vec::new(),
        };
        // What each pass speaks for by itself is not moved where the machine counts; what it is beside the first says which of it is meant.
        let each: Vec<Vec<f64>> = passes
            .iter()
            .map(|pass| infer::corrections(drawn.contours().iter(), scale, pass))
            .collect();
        let by_itself = |pass: usize, mm: f64| {
            let all = each.get(pass).into_iter().flatten().copied();
            all.filter(|own| (own - mm).abs() <= NEAR)
                .min_by(|one, other| (one - mm).abs().total_cmp(&(other - mm).abs()))
                .unwrap_or(mm)
        };
        let rounds = ROUND.map(|to| [(to, true), (to, false)]).concat();
        for (first, (to, is_by_itself)) in speaks_for
            .iter()
            .flat_map(|mm| rounds.iter().map(|round| (*mm, *round)))
        {
            let of = |(pass, step): (usize, &f64)| {
                let mm = first - step / 1e3;
                let mm = if is_by_itself {
                    by_itself(pass, mm)
                } else {
                    mm
                };
                rounded(mm, to)
            };
            let list: Vec<f64> = known.iter().enumerate().map(of).collect();
            let falls = list.windows(2).all(|two| two[0] > two[1]);
            if falls && list.iter().all(|mm| *mm > 0.0) && !lists.contains(&list) {
                lists.push(list);
            }
        }
        all.splice(0..0, lists);
    }
    // What the votes come to where it has more than three places.
    all.extend(speaks_for.first().map(|mm| vec![*mm]));
    all
}
