//! Where the cuts of a program cross themselves, found anew for what an edit has touched.

use super::document::Document;
use super::machine::Place;
use super::stretch::Stretch;
use crate::finding::{Detail, Finding, Place as Where, ProgramFault, Severity};
use crate::geometry::Segment;
use crate::program::three_b::{Displacement, Found, Known, PathStretch, search};
use std::ops::Range;

/// A cut with fewer moves does not cross itself.
const FEWEST_MOVES: u32 = 4;

/// A cut by its parts: the index of the stretch and that of the run in there.
type Cut = Vec<(usize, usize)>;

/// What was found in the cuts of a program.
#[derive(Clone, Debug, Default)]
pub(super) struct Crossings {
    known: Known,
    /// The cuts that cross themselves or lie on themselves, and where.
    found: Vec<(Cut, Found)>,
}

impl Crossings {
    /// Looks through a program; what is known of pairs of its parts is taken as it is.
    pub fn look(mut self, document: &Document) -> Crossings {
        self.found.clear();
        let stretches = document.stretches();
        let (mut pairs, mut count) = (0, 0);
        for cut in cuts(stretches) {
            count += 1;
            let mark = mark_of(stretches, &cut);
            if self.known.is_calm(mark) {
                continue;
            }
            let found = search_cut(document, &cut, &mut self.known);
            self.known.note(mark, &found);
            pairs += found.pairs;
            if !found.crossings.is_empty() || found.is_crowded {
                self.found.push((cut, found));
            }
        }
        self.known.tidy(pairs, count);
        self
    }

    /// The findings, in the order in which the cuts run.
    pub fn findings(&self, document: &Document) -> Vec<Finding> {
        let mut findings = Vec::new();
        for (cut, found) in &self.found {
            let place = |index: usize| place_of(document, cut, index);
            for crossing in &found.crossings {
                let (Some(from), Some(own)) = (place(crossing.first), place(crossing.second)) else { continue };
                let fault = ProgramFault::PathCrossesItself {
                    at: [crossing.at.x / 1000.0, crossing.at.y / 1000.0],
                    other: document.text().line_of(from.start),
                };
                findings.push(Finding {
                    rule: fault.rule(),
                    severity: fault.rule().default_severity(),
                    place: Where::Text { range: own },
                    detail: Detail::Program(Box::new(fault)),
                    related: vec![Where::Text { range: from }],
                });
            }
            let moves = moves_of(document, cut);
            if let Some(last) = place(moves.saturating_sub(1)).filter(|_| found.is_crowded) {
                let fault = ProgramFault::PathOnItself { blocks: moves };
                let rule = fault.rule();
                let detail = Detail::Program(Box::new(fault));
                findings.push(Finding {
                    rule,
                    severity: Severity::Information,
                    place: Where::Text { range: last },
                    detail,
                    related: Vec::new(),
                });
            }
        }
        findings
    }
}

/// The cuts of which every line could be read and every arc runs.
fn cuts(stretches: &[Stretch]) -> Vec<Cut> {
    let mut cuts = Vec::new();
    let mut open: Cut = Vec::new();
    let mut moves = 0;
    let mut sound = true;
    let mut close = |open: &mut Cut, moves: &mut u32, sound: &mut bool| {
        let cut = std::mem::take(open);
        if std::mem::replace(sound, true) && std::mem::take(moves) >= FEWEST_MOVES {
            cuts.push(cut);
        } else {
            *moves = 0;
        }
    };
    for (index, stretch) in stretches.iter().enumerate() {
        if stretch.ends_run_before.is_some() {
            close(&mut open, &mut moves, &mut sound);
        }
        for (run_index, run) in stretch.runs.iter().enumerate() {
            if !run.continues {
                close(&mut open, &mut moves, &mut sound);
            }
            open.push((index, run_index));
            moves += run.moves;
            sound &= run.whole && stretch.faults.is_empty();
            if !run.open {
                close(&mut open, &mut moves, &mut sound);
            }
        }
    }
    close(&mut open, &mut moves, &mut sound);
    cuts
}

/// Equal ways that are parted alike have equal marks.
fn mark_of(stretches: &[Stretch], cut: &Cut) -> u64 {
    let marks = cut.iter().filter_map(|(stretch, run)| Some(stretches.get(*stretch)?.paths.get(*run)?.mark));
    marks.fold(cut.len() as u64, |mark, next| (mark ^ next).wrapping_mul(0x2545_f491_4f6c_dd1d).rotate_left(23))
}

fn search_cut(document: &Document, cut: &Cut, known: &mut Known) -> Found {
    let stretches = document.stretches();
    let Some(begin) = cut.first().and_then(|(stretch, run)| Some(stretches.get(*stretch)?.runs.get(*run)?.start())) else {
        return Found::default();
    };
    let mut arcs = 0;
    let parts: Vec<PathStretch<'_>> = cut
        .iter()
        .filter_map(|&(stretch, run)| {
            let stretch = stretches.get(stretch)?;
            let (run, path) = (stretch.runs.get(run)?, stretch.paths.get(run)?);
            arcs += run.arcs as usize;
            Some(PathStretch {
                mark: path.mark,
                blocks: run.moves as usize,
                start: seen_from(begin, run.start()),
                bounds: path.bounds,
                near: &path.near,
            })
        })
        .collect();
    if let [one] = &parts[..]
        && one.near.is_empty()
    {
        return Found::default();
    }
    let pieces = |part: usize| cut.get(part).map_or_else(Vec::new, |&(stretch, run)| pieces(document, stretch, run).0);
    search(&parts, arcs, known, &pieces)
}

fn seen_from(begin: Place, place: Place) -> Displacement {
    Displacement { machine: [0, 0], meant: [place[0].wrapping_sub(begin[0]), place[1].wrapping_sub(begin[1])] }
}

/// The moves of a run in µm from where it begins, and the place of each in the text.
fn pieces(document: &Document, stretch: usize, run: usize) -> (Vec<Segment>, Vec<Range<usize>>) {
    let mut start = None;
    let (mut pieces, mut places) = (Vec::new(), Vec::new());
    let offset = document.run_again(stretch, &mut |index, step, range| {
        if index == run {
            let start = *start.get_or_insert(step.from);
            pieces.push(step.seen_from(start).segment(document.reading()));
            places.push(range.0 as usize..range.1 as usize);
        }
    });
    places.iter_mut().for_each(|place| *place = place.start + offset..place.end + offset);
    (pieces, places)
}

fn moves_of(document: &Document, cut: &Cut) -> usize {
    let moves = |&(stretch, run): &(usize, usize)| Some(document.stretches().get(stretch)?.runs.get(run)?.moves as usize);
    cut.iter().filter_map(moves).sum()
}

/// The place of a move of a cut by its number.
fn place_of(document: &Document, cut: &Cut, mut index: usize) -> Option<Range<usize>> {
    for &(stretch, run) in cut {
        let moves = document.stretches().get(stretch)?.runs.get(run)?.moves as usize;
        if index < moves {
            return pieces(document, stretch, run).1.into_iter().nth(index);
        }
        index -= moves;
    }
    None
}
