//! `block-number`: a number is repeated, out of its turn, or missing where the others have one.

use crate::finding::Fault;

/// A block's place in its program and its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::program) struct Numbered {
    pub(crate) number: Option<u32>,
    /// The first block after a pause: counting may begin again.
    pub(crate) is_after_pause: bool,
    /// Unreadable: whether it has a number is unknown.
    pub(crate) is_unread: bool,
}

/// The number of blocks that determine the step.
pub(in crate::program) const FIRST: usize = 16;

/// The faults in the sequence: the index of each block concerned, and its intended number where that is plain.
///
/// The step is the one that most of the first numbers have. Where fewer than three of four blocks have a number, or
/// more than half of them are out of turn, the numbers follow another rule, and there is no finding.
pub(in crate::program) fn check(blocks: &[Numbered]) -> Vec<(usize, Fault, Option<u32>)> {
    let first = blocks.iter().find_map(|block| block.number);
    let Some(mut sequence) = Sequence::of(&blocks[..blocks.len().min(FIRST)], first) else {
        return Vec::new();
    };
    for (index, block) in blocks.iter().enumerate() {
        sequence.push(block, blocks.get(index + 1), index);
    }
    sequence.found()
}

/// The sequence of a program's numbers, and its faults.
struct Sequence {
    step: u32,
    first: u32,
    before: Option<u32>,
    blocks: usize,
    numbered: usize,
    without: usize,
    found: Vec<(usize, Fault, Option<u32>)>,
}

impl Sequence {
    /// `blocks` are up to [`FIRST`] of the first ones, `first` the first number of all; `None` where these give no
    /// step.
    fn of(blocks: &[Numbered], first: Option<u32>) -> Option<Sequence> {
        let numbers: Vec<Option<u32>> = blocks.iter().map(|block| block.number).collect();
        let step = usual_step(&numbers)?;
        Some(Sequence {
            step,
            first: first?,
            before: None,
            blocks: 0,
            numbered: 0,
            without: 0,
            found: Vec::new(),
        })
    }

    /// Takes the next block; `next` is the one after it.
    fn push(&mut self, block: &Numbered, next: Option<&Numbered>, place: usize) {
        let Sequence {
            step,
            first,
            before,
            ..
        } = *self;
        self.blocks += 1;
        self.numbered += usize::from(block.number.is_some());
        self.without += usize::from(block.number.is_none() && !block.is_unread);
        let expected = before.map_or(first, |before| before.saturating_add(step));
        let follows = |number: u32| next.is_some_and(|next| next.number == Some(number));
        match block.number {
            None if block.is_unread => self.before = before.map(|_| expected),
            None => {
                let takes_one = follows(expected.saturating_add(step));
                self.found.push((
                    place,
                    Fault::Unnumbered { expected },
                    takes_one.then_some(expected),
                ));
                if takes_one {
                    self.before = Some(expected);
                }
            }
            Some(number) if number == expected || (block.is_after_pause && number == first) => {
                self.before = Some(number)
            }
            Some(number) => {
                let is_seen = before.is_some_and(|before| {
                    (first..=before).contains(&number) && (number - first).is_multiple_of(step)
                });
                let meant = follows(expected.saturating_add(step)).then_some(expected);
                let fault = if is_seen {
                    Fault::DoubledNumber { number }
                } else {
                    Fault::NumberOutOfOrder { expected, number }
                };
                self.found.push((place, fault, meant));
                self.before = match (meant, is_seen) {
                    (Some(meant), _) => Some(meant),
                    (None, true) => before,
                    (None, false) => Some(number),
                };
            }
        }
    }

    fn found(mut self) -> Vec<(usize, Fault, Option<u32>)> {
        let out_of_turn = self
            .found
            .iter()
            .filter(|(_, fault, _)| !matches!(fault, Fault::Unnumbered { .. }))
            .count();
        if 2 * out_of_turn > self.numbered {
            return Vec::new();
        }
        if 4 * self.without > self.blocks {
            self.found
                .retain(|(_, fault, _)| !matches!(fault, Fault::Unnumbered { .. }));
        }
        self.found
    }
}

/// The most frequent difference between consecutive numbers; the smaller one of two that are equally frequent.
pub(in crate::program) fn usual_step(numbers: &[Option<u32>]) -> Option<u32> {
    let step = |pair: &[Option<u32>]| super::step(pair[0]?, pair[1]?);
    let steps: Vec<u32> = numbers.windows(2).filter_map(step).collect();
    let count = |step: u32| steps.iter().filter(|other| **other == step).count();
    steps
        .iter()
        .copied()
        .max_by(|a, b| count(*a).cmp(&count(*b)).then(b.cmp(a)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNREAD: u32 = u32::MAX;

    fn check(numbers: &[u32], expected: &str) {
        let blocks: Vec<Numbered> = numbers
            .iter()
            .map(|&number| Numbered {
                number: (number > 0 && number != UNREAD).then_some(number),
                is_after_pause: false,
                is_unread: number == UNREAD,
            })
            .collect();
        let found: Vec<String> = super::check(&blocks)
            .into_iter()
            .map(|(index, fault, meant)| {
                let kind = match fault {
                    Fault::DoubledNumber { number } => format!("{number} twice"),
                    Fault::NumberOutOfOrder { expected, number } => {
                        format!("{number} for {expected}")
                    }
                    _ => "none".into(),
                };
                format!(
                    "{index}: {kind}{}",
                    meant.map_or_else(String::new, |meant| format!(" = {meant}"))
                )
            })
            .collect();
        assert_eq!(found.join(", "), expected, "{numbers:?}");
    }

    #[test]
    fn numbers_in_their_turn_are_silent() {
        check(&[1, 2, 3, 4, 5], "");
        check(&[10, 20, 30], "");
        check(&[5, 6, 7], "");
        check(&[], "");
        check(&[0, 0, 0, 0], "");
        check(&[1, 0, 0, 2, 0, 0, 3], "");
        check(&[1, 2, UNREAD, 4, 5], "");
        check(&[0, 0, UNREAD, 0, 0], "");
        check(&[7, 3, 9, 1, 4], "");
    }

    #[test]
    fn what_is_out_of_turn_is_named_once() {
        check(&[1, 2, 2, 3, 4], "2: 2 twice");
        check(&[1, 2, 2, 4, 5], "2: 2 twice = 3");
        check(&[1, 2, 4, 5, 6], "2: 4 for 3");
        check(&[1, 2, 30, 4, 5], "2: 30 for 3 = 3");
        check(&[1, 2, 0, 4, 5], "2: none = 3");
        check(&[1, 2, 3, 4, 0, 5, 6], "4: none");
        check(&[10, 20, 20, 40], "2: 20 twice = 30");
    }
}
