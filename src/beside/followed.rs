//! Whether all of a program follows its drawing: at any correction, with either kind of corner, wherever it lies.
//!
//! A block is named where no way of writing the drawing explains it: what leaves nothing to name comes before what
//! leaves little.

use super::LEADS;
use super::anchor::places;
use super::comparison::{Tried, courses, longest_cut, sound, with_other_corner};
use super::difference::Comparison;
use super::drawn::Drawn;
use super::infer;
use super::passes::corrections;
use super::rounds::{Course, Rounds};
use super::traced::{Block, Traced};
use std::rc::Rc;

/// The most lists of corrections that are tried.
const LISTS: usize = 12;

/// For each block whose numbers are off, this many must be as any writer has them.
const SLIPS: usize = 3;

/// The comparison of a program of which every block follows the drawing; `None` where one does not. A number that is off
/// by less than moves its block aside is told.
pub(super) fn followed(drawn: &Drawn, traced: &Traced) -> Option<Comparison> {
    if traced.is_empty() || drawn.contours().is_empty() {
        return None;
    }
    let mut tried: Vec<Vec<Course>> = Vec::new();
    for courses in ways(drawn, traced) {
        if !tried.contains(&courses) {
            tried.push(courses);
        }
    }
    let corners = [drawn.clone(), with_other_corner(drawn)];
    let mut all = corners
        .iter()
        .flat_map(|drawn| tried.iter().map(move |courses| (drawn, courses)));
    all.find_map(|(drawn, courses)| {
        let mut rounds = Rounds::default();
        rounds.add(drawn, courses, None);
        let placements = places(traced, &rounds);
        let (mut walked, placement) = placements
            .into_iter()
            .find_map(|placement| Some((sound(traced, &rounds, placement)?.0, placement)))?;
        if is_left(traced, &walked.runs) {
            return None;
        }
        // Many are the way of its writer; a few somebody has changed.
        if SLIPS * walked.slips.len() <= walked.follows.len() {
            walked.unlike = std::mem::take(&mut walked.slips);
        }
        Tried::of(traced, walked, &[], (Rc::new(rounds), placement)).told(drawn, traced)
    })
}

/// The ways that the wire may go beside the contours, the likeliest first.
fn ways(drawn: &Drawn, traced: &Traced) -> Vec<Vec<Course>> {
    let of_settings = courses(&drawn.settings, traced);
    let mut all = vec![of_settings, vec![Course::Drawn]];
    if traced.four_b {
        return all;
    }
    let lists = corrections(drawn, traced).into_iter();
    let scale = drawn.unit_mm * 1e3;
    let single = infer::corrections(drawn.contours().iter(), scale, &longest_cut(traced));
    let single = single.into_iter().map(|mm| vec![mm]);
    let beside = |list: Vec<f64>| list.into_iter().map(Course::Beside).collect();
    all.extend(single.chain(lists).take(LISTS).map(beside));
    all
}

/// Whether a block of a pass, while the control offsets it, follows nothing and is no way in or out: it stands between
/// others that follow, or is one of too many before or behind them.
fn is_left(traced: &Traced, runs: &[bool]) -> bool {
    let blocks: Vec<(&Block, bool)> = traced.blocks.iter().zip(runs.iter().copied()).collect();
    let passes = blocks.chunk_by(|(one, _), (other, _)| one.stretch == other.stretch);
    let mut offset = passes.filter(|pass| pass.iter().all(|(block, _)| block.is_offset()));
    let left = |blocks: &[(&Block, bool)]| {
        let cuts = blocks
            .iter()
            .filter(|(block, follows)| !follows && block.segment().is_some());
        cuts.count()
    };
    offset.any(|pass| {
        let first = pass.iter().position(|(_, follows)| *follows);
        let last = pass.iter().rposition(|(_, follows)| *follows);
        first.zip(last).is_some_and(|(first, last)| {
            left(&pass[first..last]) > 0
                || left(&pass[..first]) > LEADS
                || left(&pass[last..]) > LEADS
        })
    })
}
