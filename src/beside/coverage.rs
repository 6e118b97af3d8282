//! The parts of each round that a program cuts from stop to stop, and whether nothing is left between.

use super::COVERED;
use super::rounds::Rounds;
use std::ops::Range;

/// The largest share of a round that may be cut twice where consecutive stretches overlap.
const TWICE: f64 = 0.35;

/// What has been cut from stop to stop.
#[derive(Clone, Debug, Default)]
pub(super) struct Coverage {
    done: Vec<Go>,
    open: Vec<Go>,
}

/// The stretches of one round that are cut without a stop.
#[derive(Clone, Debug)]
struct Go {
    round: usize,
    parts: Vec<Range<f64>>,
}

impl Coverage {
    pub(super) fn cut(&mut self, round: usize, part: Range<f64>) {
        let Some(own) = self.open.iter_mut().find(|go| go.round == round) else {
            self.open.push(Go {
                round,
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

    /// The wire stops, or is taken out.
    pub(super) fn end(&mut self) {
        self.done.append(&mut self.open);
    }

    /// Whether the stretches of each round cover all of it, alone or together: a tab is cut by itself.
    pub(crate) fn are_whole(mut self, rounds: &Rounds) -> bool {
        self.end();
        let mut partial: Vec<Go> = Vec::new();
        for go in self.done {
            let length = rounds.rounds[go.round].length;
            let counts = counts(&go.parts, length);
            if !counts
                .iter()
                .any(|(count, length)| *count == 0 && *length > COVERED)
            {
                continue;
            }
            match partial.iter_mut().find(|other| other.round == go.round) {
                Some(other) => other.parts.extend(go.parts),
                None => partial.push(go),
            }
        }
        partial.iter().all(|go| {
            let length = rounds.rounds[go.round].length;
            let mut counts = counts(&go.parts, length);
            counts.retain(|(_, length)| *length > COVERED);
            let least = counts.iter().map(|(count, _)| *count).min().unwrap_or(0);
            let more = |(count, length): &(i32, f64)| f64::from(count - least) * length;
            least > 0 && counts.iter().map(more).sum::<f64>() <= TWICE * length
        })
    }
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
