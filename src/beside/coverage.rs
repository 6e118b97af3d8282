//! Which parts of each round a program cuts, run by run, and whether anything is left between them.

use super::COVERED;
use super::rounds::Rounds;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// The largest share of a round that may be cut twice where consecutive stretches overlap.
const TWICE: f64 = 0.35;

/// The largest share of a round that may be cut from stop to stop apart from the longest run: without a stop, no piece of
/// a contour is left for later.
const BESIDE: f64 = 0.1;

/// What has been cut, from stop to stop.
#[derive(Clone, Debug, Default)]
pub(super) struct Coverage {
    runs: Vec<Cut>,
    stops: usize,
    /// The last run goes on.
    is_open: bool,
}

/// The stretches of one round that are cut in one run.
#[derive(Clone, Debug)]
struct Cut {
    round: usize,
    /// Stops before it.
    stops: usize,
    parts: Vec<Range<f64>>,
}

impl Cut {
    /// Nothing of its round is left.
    fn is_whole(&self, rounds: &Rounds) -> bool {
        uncut(&self.parts, rounds.rounds[self.round].length) <= COVERED
    }
}

impl Coverage {
    pub(super) fn cut(&mut self, round: usize, part: Range<f64>) {
        let stops = self.stops;
        let open = self
            .runs
            .last_mut()
            .filter(|run| self.is_open && run.round == round);
        self.is_open = true;
        let Some(own) = open else {
            self.runs.push(Cut {
                round,
                stops,
                parts: vec![part],
            });
            return;
        };
        match own.parts.last_mut() {
            Some(last) if (last.end - part.start).abs() <= 1e-3 => last.end = part.end,
            Some(last) if (last.start - part.end).abs() <= 1e-3 => last.start = part.start,
            _ => own.parts.push(part),
        }
    }

    /// The wire leaves the round.
    pub(super) fn end_run(&mut self) {
        self.is_open = false;
    }

    /// The wire stops, or is taken out.
    pub(super) fn stop(&mut self) {
        self.is_open = false;
        self.stops += 1;
    }

    /// Whether each run covers all of its round, or those from stop to stop do together: a tab is cut by itself.
    pub(crate) fn are_whole(self, rounds: &Rounds) -> bool {
        let partial = self.runs.into_iter().filter(|run| !run.is_whole(rounds));
        let mut by_round: FxHashMap<usize, Vec<Cut>> = FxHashMap::default();
        for run in partial {
            by_round.entry(run.round).or_default().push(run);
        }
        by_round.iter().all(|(round, runs)| {
            let length = rounds.rounds[*round].length;
            is_tiled(runs, length)
                && runs
                    .chunk_by(|a, b| a.stops == b.stops)
                    .all(|go| is_one(go, length))
        })
    }
}

/// Whether the runs of a round leave nothing of it uncut, and cut hardly anything more often than the rest of it.
fn is_tiled(runs: &[Cut], length: f64) -> bool {
    let parts: Vec<Range<f64>> = runs.iter().flat_map(|run| run.parts.clone()).collect();
    let mut counts = counts(&parts, length);
    counts.retain(|(_, length)| *length > COVERED);
    let least = counts.iter().map(|(count, _)| *count).min().unwrap_or(0);
    let more = |(count, length): &(i32, f64)| f64::from(count - least) * length;
    least > 0 && counts.iter().map(more).sum::<f64>() <= TWICE * length
}

/// Whether one of these runs cuts all that they cut together, up to an overlap.
fn is_one(runs: &[Cut], length: f64) -> bool {
    let all: Vec<Range<f64>> = runs.iter().flat_map(|run| run.parts.clone()).collect();
    let left = runs.iter().map(|run| uncut(&run.parts, length));
    left.fold(f64::INFINITY, f64::min) - uncut(&all, length) <= BESIDE * length
}

/// The uncut length of a round, without gaps up to [`COVERED`].
fn uncut(parts: &[Range<f64>], length: f64) -> f64 {
    let counts = counts(parts, length).into_iter();
    let left = counts.filter(|(count, length)| *count == 0 && *length > COVERED);
    left.map(|(_, length)| length).sum()
}

/// How often a round of a length is cut, stretch by stretch.
fn counts(parts: &[Range<f64>], length: f64) -> Vec<(i32, f64)> {
    let ends = parts
        .iter()
        .flat_map(|part| [(part.start, 1), (part.end, -1)]);
    let mut events: Vec<(f64, i32)> = ends.chain([(length, 0)]).collect();
    events.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut at, mut count) = (0.0, 0);
    let mut counts = Vec::with_capacity(events.len());
    for (to, step) in events {
        let to = to.clamp(0.0, length);
        counts.push((count, to - at));
        (at, count) = (to, count + step);
    }
    counts
}
