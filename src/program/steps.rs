//! The machine's path in a part of a program: an answer costs the length of the part, and a glance
//! at each chunk.

use super::path::{CutSteps, Kind, Step, Totals, Trace, Writing};
use crate::geometry::{Point, Vector};
use crate::text::SourceText;
use crate::toolpath::each;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// Chunks that one core follows at a time.
const CHUNKS: usize = 4;

/// A program of any language, chunk by chunk in the order in which the machine runs them.
pub(crate) trait Program: Sync {
    fn text(&self) -> &SourceText;

    /// How its blocks give their ends.
    fn writing(&self) -> Writing;

    /// The machine's start, µm, the origin by default; and whether the program gives it.
    fn begin(&self) -> (Point, bool);

    /// The first unreadable line: the position after it depends on what was meant.
    fn unread_line(&self) -> Option<usize>;

    fn chunk_count(&self) -> usize;

    /// The lines of the text that a chunk holds.
    fn lines_of(&self, chunk: usize) -> Range<usize>;

    fn sum_of(&self, chunk: usize) -> Sum;

    /// Hands out the steps of a chunk; `contour` is that of the first, and afterwards that of the next chunk's first.
    fn walk(&self, chunk: usize, contour: &mut usize, each: &mut dyn FnMut(Step));
}

/// The totals of a chunk's steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Sum {
    pub(crate) moves: usize,
    pub(crate) arcs: usize,
    /// Moves without the wire; only counted where there are no stops.
    pub(crate) rapids: usize,
    /// Pauses and ends.
    pub(crate) stops: usize,
    /// Pauses except those before a tab.
    pub(crate) contours: usize,
    /// From the beginning of its way to the end as its blocks mean it, nm.
    pub(crate) travel: [i64; 2],
}

impl Sum {
    pub(super) fn is_empty(&self) -> bool {
        self.moves + self.stops == 0
    }

    /// Only moves, all with the wire or all without.
    fn is_all(&self, rapid: bool) -> bool {
        self.stops == 0 && self.moves > 0 && self.rapids == if rapid { self.moves } else { 0 }
    }
}

/// Every step of a program.
pub(crate) fn trace(program: &dyn Program) -> Trace {
    let (start, start_is_known) = program.begin();
    let mut trace = Trace {
        steps: Vec::new(),
        start,
        start_is_known,
        writing: program.writing(),
        ..Trace::default()
    };
    let mut contour = 0;
    let begins = (0..program.chunk_count()).map(|chunk| {
        let begin = contour;
        contour += program.sum_of(chunk).contours;
        begin
    });
    let begins: Vec<usize> = begins.collect();
    let of_chunks = each(begins.len(), CHUNKS, |chunk| {
        let (mut contour, mut steps) = (begins[chunk], Vec::new());
        program.walk(chunk, &mut contour, &mut |step| steps.push(step));
        steps
    });
    trace.steps.reserve(of_chunks.iter().map(Vec::len).sum());
    of_chunks
        .into_iter()
        .for_each(|steps| trace.steps.extend(steps));
    trace
}

/// The steps whose text overlaps or touches a range of bytes.
pub(crate) fn steps_in(program: &dyn Program, range: Range<usize>) -> Vec<Step> {
    let text = program.text();
    let wanted = text.line_of(range.start)..text.line_of(range.end) + 1;
    let mut steps = Vec::new();
    let mut contour = 0;
    for chunk in 0..program.chunk_count() {
        let lines = program.lines_of(chunk);
        if lines.start < wanted.end && wanted.start < lines.end {
            program.walk(chunk, &mut contour, &mut |step| {
                if step.range.start <= range.end && range.start <= step.range.end {
                    steps.push(step);
                }
            });
        } else {
            contour += program.sum_of(chunk).contours;
        }
    }
    steps
}

/// The moves between two stops of which one touches a byte, and the number of that one among them: of two that touch
/// it, the one that begins there. At least `ends` moves of either end are held, if there are as many.
pub(crate) fn cut_at(
    program: &dyn Program,
    offset: usize,
    ends: usize,
) -> Option<(CutSteps<'static>, usize)> {
    let line = program.text().line_of(offset);
    let mut walk = Walk::through(program);
    let touches =
        |step: &Step| step.moves() && step.range.start <= offset && offset <= step.range.end;
    let at = (0..program.chunk_count())
        .rev()
        .filter(|chunk| program.lines_of(*chunk).contains(&line))
        .find_map(|chunk| {
            let step = walk.steps(chunk).iter().rposition(touches)?;
            Some(At { chunk, step })
        })?;
    walk.cut(at, None, ends)
}

/// The moves from the last stop on that stand before a byte, by their ends.
pub(crate) fn cut_before(program: &dyn Program, offset: usize) -> Option<CutSteps<'static>> {
    let line = program.text().line_of(offset);
    let mut walk = Walk::through(program);
    let at = (0..program.chunk_count())
        .rev()
        .filter(|chunk| {
            program.lines_of(*chunk).start <= line && !program.sum_of(*chunk).is_empty()
        })
        .find_map(|chunk| {
            let step = walk
                .steps(chunk)
                .iter()
                .rposition(|step| step.range.end <= offset)?;
            Some(At { chunk, step })
        })?;
    let (held, _) = walk.cut(at, Some(at), CutSteps::ENDS)?;
    Some(held)
}

/// The first stop after a byte.
pub(crate) fn stop_behind(program: &dyn Program, offset: usize) -> Option<Range<usize>> {
    let line = program.text().line_of(offset);
    let mut walk = Walk::through(program);
    (0..program.chunk_count())
        .filter(|chunk| program.lines_of(*chunk).end > line && program.sum_of(*chunk).stops > 0)
        .find_map(|chunk| {
            let mut steps = walk.steps(chunk).iter();
            steps
                .find(|step| !step.moves() && step.range.start > offset)
                .map(|step| step.range.clone())
        })
}

/// The first block that moves.
pub(crate) fn first_move(program: &dyn Program) -> Option<Range<usize>> {
    let mut walk = Walk::through(program);
    (0..program.chunk_count())
        .filter(|chunk| program.sum_of(*chunk).moves > 0)
        .find_map(|chunk| {
            let mut steps = walk.steps(chunk).iter();
            steps
                .find(|step| step.moves())
                .map(|step| step.range.clone())
        })
}

/// A step by its chunk and its number in there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct At {
    chunk: usize,
    step: usize,
}

/// Chunks that are read, each at most once.
struct Walk<'a> {
    program: &'a dyn Program,
    /// Contours that end before each chunk.
    contours: Vec<usize>,
    known: FxHashMap<usize, Vec<Step>>,
}

impl<'a> Walk<'a> {
    fn through(program: &'a dyn Program) -> Walk<'a> {
        let contours = (0..program.chunk_count()).scan(0, |contour, chunk| {
            let before = *contour;
            *contour += program.sum_of(chunk).contours;
            Some(before)
        });
        Walk {
            program,
            contours: contours.collect(),
            known: FxHashMap::default(),
        }
    }

    fn steps(&mut self, chunk: usize) -> &[Step] {
        let Walk {
            program,
            contours,
            known,
        } = self;
        known.entry(chunk).or_insert_with(|| {
            let mut contour = contours.get(chunk).copied().unwrap_or(0);
            let mut steps = Vec::new();
            program.walk(chunk, &mut contour, &mut |step| steps.push(step));
            steps
        })
    }

    /// The cut of a step that moves, up to `until`, and the number of the step in it.
    fn cut(
        &mut self,
        at: At,
        until: Option<At>,
        ends: usize,
    ) -> Option<(CutSteps<'static>, usize)> {
        let step = self
            .steps(at.chunk)
            .get(at.step)
            .filter(|step| step.moves())?;
        let own = Own {
            contour: step.contour,
            rapid: step.kind == Kind::Rapid,
        };
        let first = self.end_of(&own, at, false);
        let last = until.unwrap_or_else(|| self.end_of(&own, at, true));
        let (mut count, mut arcs, mut meant) = (0, 0, Vector::zeros());
        let (mut nth, mut stop) = (0, None);
        for chunk in first.chunk..=last.chunk {
            let sum = self.program.sum_of(chunk);
            let is_inside = chunk > first.chunk && chunk < last.chunk && chunk != at.chunk;
            if is_inside && sum.is_all(own.rapid) {
                count += sum.moves;
                arcs += sum.arcs;
                meant += Vector::new(sum.travel[0] as f64, sum.travel[1] as f64) / 1e3;
                continue;
            }
            let (from, to) = bounds(chunk, first, last);
            let steps = self.steps(chunk);
            for (index, step) in steps.iter().enumerate().take(to).skip(from) {
                if index == at.step && chunk == at.chunk {
                    nth = count;
                }
                if step.moves() {
                    count += 1;
                    arcs += usize::from(step.kind == Kind::Arc);
                    meant += step.meant();
                } else {
                    stop = stop.or(Some(count));
                }
            }
        }
        let mut head: Vec<Step> = Vec::new();
        for chunk in first.chunk..=last.chunk {
            if head.len() >= ends {
                break;
            }
            let (from, to) = bounds(chunk, first, last);
            let own = self.steps(chunk).iter().take(to).skip(from);
            head.extend(own.filter(|step| step.moves()).cloned());
        }
        let writing = self.program.writing();
        let stop = stop.filter(|stop| *stop < count);
        let left = count - head.len();
        if left == 0 {
            return Some((CutSteps::of(head, writing).stopping(stop), nth));
        }
        let mut tail: Vec<Step> = Vec::new();
        for chunk in (first.chunk..=last.chunk).rev() {
            if tail.len() >= ends.min(left) {
                break;
            }
            let (from, to) = bounds(chunk, first, last);
            let steps = self.steps(chunk);
            let own = steps[from..to.min(steps.len())].iter().rev();
            tail.extend(own.filter(|step| step.moves()).cloned());
        }
        tail.truncate(left);
        tail.reverse();
        let totals = Totals {
            count,
            arcs,
            writing,
            stop,
        };
        Some((CutSteps::by_ends(head, tail, meant, totals), nth))
    }

    /// The first step of a cut, or the last one where it is searched for `ahead` of one of its steps.
    fn end_of(&mut self, own: &Own, at: At, ahead: bool) -> At {
        let mut found = at;
        let chunks = match ahead {
            true => at.chunk..self.program.chunk_count(),
            false => 0..at.chunk + 1,
        };
        for chunk in towards(chunks, ahead) {
            let sum = self.program.sum_of(chunk);
            if chunk != at.chunk && sum.is_empty() {
                continue;
            }
            if chunk != at.chunk && sum.is_all(own.rapid) {
                if self.contours[chunk] != own.contour {
                    break;
                }
                let step = if ahead { sum.moves - 1 } else { 0 };
                found = At { chunk, step };
                continue;
            }
            let steps = self.steps(chunk);
            let range = match (chunk == at.chunk, ahead) {
                (true, true) => at.step..steps.len(),
                (true, false) => 0..at.step.min(steps.len()),
                (false, _) => 0..steps.len(),
            };
            for step in towards(range, ahead) {
                if own.holds(&steps[step]) {
                    found = At { chunk, step };
                } else if steps[step].kind != Kind::Pause {
                    return found;
                }
            }
        }
        found
    }
}

/// A range from its beginning, or from its end.
fn towards(range: Range<usize>, ahead: bool) -> impl Iterator<Item = usize> {
    let (first, end) = (range.start, range.end);
    range.map(move |at| if ahead { at } else { first + end - 1 - at })
}

/// The common properties of the moves of a cut.
struct Own {
    contour: usize,
    rapid: bool,
}

impl Own {
    fn holds(&self, step: &Step) -> bool {
        step.moves() && step.contour == self.contour && (step.kind == Kind::Rapid) == self.rapid
    }
}

/// The steps of a chunk that lie between two, both included.
fn bounds(chunk: usize, first: At, last: At) -> (usize, usize) {
    let from = if chunk == first.chunk { first.step } else { 0 };
    let to = if chunk == last.chunk {
        last.step + 1
    } else {
        usize::MAX
    };
    (from, to)
}

#[cfg(test)]
mod tests;
