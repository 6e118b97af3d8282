//! Where the cuts of a program cross themselves, found anew for what an edit has touched.

use super::cuts::CutWay;
use super::document::Document;
use super::machine::Place;
use super::stretch::Stretch;
use crate::finding::{Detail, Finding, NotJudged, Place as Where, ProgramFault, Rule, Severity};
use crate::geometry::Segment;
use crate::program::path::crossings::{
    Found, Known, Stretch as PathStretch, crossings_of_passes, search,
};
use crate::program::path::{passes, pieces_of};
use crate::program::three_b::Displacement;
use std::ops::Range;
use std::sync::Arc;

/// A cut with fewer moves does not cross itself.
const FEWEST_MOVES: u32 = 4;

/// A cut by its parts: the index of the stretch and that of the run in there.
type Cut = Vec<(usize, usize)>;

/// What was found in the cuts of a program.
#[derive(Clone, Debug, Default)]
pub(super) struct Crossings {
    known: Known,
    /// The cuts that cross themselves or lie on themselves, and where.
    found: Vec<(Cut, Arc<Found>)>,
}

impl Crossings {
    /// Looks through a program; what is known of pairs of its parts is taken as it is. Gives the stretches that have become calm.
    pub fn look(&mut self, document: &Document) -> Vec<usize> {
        self.found.clear();
        let mut look = Look {
            document,
            crossings: self,
            pairs: 0,
            count: 0,
        };
        let calm = look.through(document.stretches());
        let (pairs, count) = (look.pairs, look.count);
        self.known.tidy(pairs, count);
        calm
    }

    /// The findings, in the order in which the cuts run.
    pub fn findings(&self, document: &Document) -> Vec<Finding> {
        let mut findings = Vec::new();
        for (cut, found) in &self.found {
            let place = |index: usize| place_of(document, cut, index);
            for crossing in &found.crossings {
                let (Some(from), Some(own)) = (place(crossing.first), place(crossing.second))
                else {
                    continue;
                };
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
                findings.push(Finding {
                    rule: Rule::NotJudged,
                    severity: Severity::Information,
                    place: Where::Text { range: last },
                    detail: Detail::NotJudged(NotJudged::Crossings { blocks: moves }),
                    related: Vec::new(),
                });
            }
        }
        findings
    }
}

/// A look through a program.
struct Look<'a> {
    document: &'a Document,
    crossings: &'a mut Crossings,
    pairs: usize,
    count: usize,
}

/// A cut whose parts are being put together.
struct OpenCut {
    parts: Cut,
    moves: u32,
    /// Every line of it could be read and every arc runs.
    is_sound: bool,
}

impl Look<'_> {
    fn through(&mut self, stretches: &[Stretch]) -> Vec<usize> {
        let mut calm = Vec::new();
        let mut open = OpenCut {
            parts: Vec::new(),
            moves: 0,
            is_sound: true,
        };
        for (index, stretch) in stretches.iter().enumerate() {
            open.is_sound &= !stretch.faulty_before;
            if let Some(is_whole) = stretch.ends_run_before {
                open.is_sound &= is_whole;
                self.close(&mut open);
            }
            let inner = stretch.inner();
            for run in (0..inner.start).chain(inner.end..stretch.run_count()) {
                // Those between do not go on from what was open before.
                if run >= inner.end {
                    self.inner(stretch, index, &inner, &mut calm);
                }
                let (Some(joints), Some((_, moves, _))) =
                    (stretch.joints(run), stretch.extent(run))
                else {
                    continue;
                };
                if !joints.continues {
                    self.close(&mut open);
                }
                open.parts.push((index, run));
                open.moves += moves;
                open.is_sound &= joints.sound;
                if !joints.open {
                    self.close(&mut open);
                }
            }
            if inner.end == stretch.run_count() {
                self.inner(stretch, index, &inner, &mut calm);
            }
        }
        self.close(&mut open);
        calm
    }

    /// The cuts that begin and end in a stretch.
    fn inner(
        &mut self,
        stretch: &Stretch,
        index: usize,
        inner: &Range<usize>,
        calm: &mut Vec<usize>,
    ) {
        if stretch.is_calm {
            return;
        }
        let mut is_calm = true;
        for run in inner.clone() {
            let is_near = stretch
                .paths
                .get(run)
                .is_some_and(|path| !path.near.is_empty());
            let is_sound = stretch.joints(run).is_some_and(|joints| joints.sound);
            if is_near
                && is_sound
                && stretch
                    .extent(run)
                    .is_some_and(|(_, moves, _)| moves >= FEWEST_MOVES)
            {
                is_calm &= self.is_calm(&[(index, run)]);
            }
        }
        calm.extend(is_calm.then_some(index));
    }

    fn close(&mut self, open: &mut OpenCut) {
        if open.is_sound && open.moves >= FEWEST_MOVES {
            self.is_calm(&open.parts);
        }
        open.parts.clear();
        (open.moves, open.is_sound) = (0, true);
    }

    /// Whether a cut does not cross itself; one that does is kept.
    fn is_calm(&mut self, cut: &[(usize, usize)]) -> bool {
        self.count += 1;
        let known = &mut self.crossings.known;
        let mark = mark_of(self.document.stretches(), cut);
        let found = known.of(mark).unwrap_or_else(|| {
            let found = Arc::new(search_cut(self.document, cut, known));
            known.note(mark, &found);
            found
        });
        self.pairs += found.pairs;
        let is_calm = found.crossings.is_empty() && !found.is_crowded;
        if !is_calm {
            self.crossings.found.push((cut.to_vec(), found));
        }
        is_calm
    }
}

/// Equal ways that are parted alike have equal marks.
fn mark_of(stretches: &[Stretch], cut: &[(usize, usize)]) -> u64 {
    let marks = cut
        .iter()
        .filter_map(|(stretch, run)| Some(stretches.get(*stretch)?.paths.get(*run)?.mark));
    marks.fold(cut.len() as u64, |mark, next| {
        (mark ^ next)
            .wrapping_mul(0x2545_f491_4f6c_dd1d)
            .rotate_left(23)
    })
}

fn search_cut(document: &Document, cut: &[(usize, usize)], known: &mut Known) -> Found {
    let stretches = document.stretches();
    let Some(begin) = cut
        .first()
        .and_then(|(stretch, run)| Some(stretches.get(*stretch)?.extent(*run)?.0))
    else {
        return Found::default();
    };
    let mut arcs = 0;
    let parts: Vec<PathStretch<'_>> = cut
        .iter()
        .filter_map(|&(stretch, run)| {
            let stretch = stretches.get(stretch)?;
            let ((start, moves, its_arcs), path) = (stretch.extent(run)?, stretch.paths.get(run)?);
            arcs += its_arcs as usize;
            Some(PathStretch {
                mark: path.mark,
                blocks: moves as usize,
                start: seen_from(begin, start),
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
    let way = CutWay::of_parts(document, cut);
    let passes = passes(&way);
    if !passes.is_empty() {
        return crossings_of_passes(&pieces_of(&way).unwrap_or_default(), &passes);
    }
    let pieces = |part: usize| {
        cut.get(part)
            .map_or_else(Vec::new, |&(stretch, run)| pieces(document, stretch, run).0)
    };
    search(&parts, arcs, known, &pieces)
}

fn seen_from(begin: Place, place: Place) -> Displacement {
    Displacement {
        machine: [0, 0],
        meant: [
            place[0].wrapping_sub(begin[0]),
            place[1].wrapping_sub(begin[1]),
        ],
    }
}

/// The moves of a run in µm from where it begins, and the place of each in the text.
pub(super) fn pieces(
    document: &Document,
    stretch: usize,
    run: usize,
) -> (Vec<Segment>, Vec<Range<usize>>) {
    let mut start = None;
    let (mut pieces, mut places) = (Vec::new(), Vec::new());
    let offset = document.run_again(stretch, &mut |index, step, range| {
        if index == run {
            let start = *start.get_or_insert(step.from);
            pieces.push(step.seen_from(start).segment(document.reading()));
            places.push(range.0 as usize..range.1 as usize);
        }
    });
    places
        .iter_mut()
        .for_each(|place| *place = place.start + offset..place.end + offset);
    (pieces, places)
}

fn moves_of(document: &Document, cut: &Cut) -> usize {
    let moves = |&(stretch, run): &(usize, usize)| {
        Some(document.stretches().get(stretch)?.extent(run)?.1 as usize)
    };
    cut.iter().filter_map(moves).sum()
}

/// The place of a move of a cut by its number.
fn place_of(document: &Document, cut: &Cut, mut index: usize) -> Option<Range<usize>> {
    for &(stretch, run) in cut {
        let moves = document.stretches().get(stretch)?.extent(run)?.1 as usize;
        if index < moves {
            return pieces(document, stretch, run).1.into_iter().nth(index);
        }
        index -= moves;
    }
    None
}
