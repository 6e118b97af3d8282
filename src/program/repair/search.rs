//! Finds the one slip that explains the faults of a contour, and undoes it: one search for every language.
//!
//! A slip is a typing or transmission error: a digit, X for Y, a lost word, a block that is doubled, lost or exchanged
//! with the next. Each possible one is undone and the contour checked again. The change that explains more, with less,
//! comes first.
//!
//! A language supplies the possible intended blocks and the evidence of the text against a change; the search decides
//! what is tried, how much of it, and what is sure. All is bounded by counts, so that the result depends on the text
//! alone.

use super::gap::fillings;
use super::slip::{Change, Repair};
use super::{HANDED_OUT, MOST_FOLLOWED};
use crate::geometry::{Segment, Vector};

/// How plain a change is. Of changes that are equally plain and leave a contour equally sound, none is sure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::program) enum Plainness {
    /// One slip: a digit lost, added, changed or exchanged with the next, a sign, a word, a line twice, lost or exchanged
    /// with the next.
    Slip,
    /// A number that is calculated from all others.
    Calculated,
}

/// The result of a change.
#[derive(Clone, Copy, Debug)]
pub(in crate::program) struct Verdict {
    /// The remaining evidence against the contour.
    pub(crate) left: usize,
    /// Its cost: the lower, the likelier. It says which change comes first.
    pub(crate) cost: f64,
    pub(crate) plainness: Plainness,
    /// The part of the cost that is evidence of the text for the change or against it: all slips are equally likely.
    pub(crate) evidence: f64,
    /// The only evidence against it is an equally likely change.
    pub(crate) may_be_sure: bool,
}

/// A faulty contour, as a language holds it.
pub(in crate::program) trait Contour {
    /// A possible intended block.
    type Meant;

    /// Where a change leads.
    type Lead;

    /// The text must say this much less for every other repair that is as plain for the best to be sure.
    const CLEARLY: f64;

    /// How many of the best changes are compared: each is followed along the whole contour.
    fn finalists(&self) -> usize;

    /// The blocks that are searched, those nearest to the fault first.
    fn order(&self) -> Vec<usize>;

    /// The possible intended words of a block, with their costs.
    fn meant(&self, index: usize) -> Vec<(Self::Meant, f64)>;

    /// The cost of removing a block; `None` where it stays.
    fn deleted(&self, index: usize) -> Option<f64>;

    /// The cost of exchanging a block and the next one; `None` where they stay.
    fn exchanged(&self, index: usize) -> Option<f64>;

    /// The possible displacement of a block lost before another one, µm.
    fn gaps(&self, index: usize) -> Vec<Vector>;

    /// The directions before and after a gap; `None` where no arc fills it.
    fn headings(&self, index: usize) -> Option<[Vector; 2]>;

    /// The block along a line or an arc from the origin, and its cost.
    fn filling(&self, index: usize, way: &Segment) -> Option<(Self::Meant, f64)>;

    /// The result of a change, `None` if it explains nothing; and how much was run for it.
    fn judged(&self, change: &Change<Self::Meant>, cost: f64) -> (Option<Verdict>, usize);

    fn lead(&self, change: &Change<Self::Meant>) -> Self::Lead;

    /// True for two changes with the same result.
    fn is_alike(one: &Self::Lead, other: &Self::Lead) -> bool;

    /// True for two changes either of which may be meant, so that neither is sure.
    fn is_either(&self, _one: &Change<Self::Meant>, _other: &Change<Self::Meant>) -> bool {
        false
    }

    /// False where only some of the blocks are searched.
    fn is_searched_whole(&self) -> bool {
        true
    }

    /// Whether a change is offered. All are searched: a possibly lost block counts against a possibly wrong one.
    fn holds(&self, _change: &Change<Self::Meant>) -> bool {
        true
    }

    /// Whether the way crosses itself; `None` where more than the pieces `left` would be read to find out. What is read is taken from them.
    fn crosses(&self, _change: Option<&Change<Self::Meant>>, _left: &mut usize) -> Option<bool> {
        Some(false)
    }
}

/// The repairs of a contour, the most likely one first. `left` is the work that may still be done.
pub(in crate::program) fn search<C: Contour>(
    contour: &C,
    left: &mut usize,
) -> Vec<Repair<C::Meant>> {
    // Lost blocks are searched for everywhere, and must leave room for wrong ones.
    let reserve = *left / 4 * 3;
    let (mut lost, mut moved, mut found) = (Vec::new(), Vec::new(), Vec::new());
    let mut is_complete = contour.is_searched_whole();
    let mut judge = |change: Change<C::Meant>, cost: f64, reserve: usize, into: &mut Vec<_>| {
        if *left <= reserve {
            is_complete &= matches!(change, Change::Insert { .. });
            return;
        }
        let (verdict, runs) = contour.judged(&change, cost);
        *left = left.saturating_sub(runs);
        into.extend(verdict.map(|verdict| (verdict, change)));
    };
    let order = contour.order();
    for &index in &order {
        if let Some(cost) = contour.deleted(index) {
            judge(Change::Delete { index }, cost, 0, &mut moved);
        }
        if let Some(cost) = contour.exchanged(index) {
            judge(Change::Exchange { index }, cost, 0, &mut moved);
        }
    }
    for &index in &order {
        for gap in contour.gaps(index) {
            for way in fillings(gap, contour.headings(index)) {
                if let Some((meant, cost)) = contour.filling(index, &way) {
                    judge(Change::Insert { index, meant }, cost, reserve, &mut lost);
                }
            }
        }
    }
    for index in order {
        for (meant, cost) in contour.meant(index) {
            judge(Change::Replace { index, meant }, cost, 0, &mut found);
        }
    }
    found.extend(moved);
    found.extend(lost);
    ranked(contour, found, is_complete)
}

/// The changes with different results, best first. None is sure where not all were judged.
fn ranked<C: Contour>(
    contour: &C,
    mut judged: Vec<Judged<C>>,
    mut is_complete: bool,
) -> Vec<Repair<C::Meant>> {
    judged.sort_by(|(a, _), (b, _)| a.left.cmp(&b.left).then(a.cost.total_cmp(&b.cost)));
    let least = judged.first().map_or(0, |(best, _)| best.left);
    judged.retain(|(verdict, _)| verdict.left == least);
    is_complete &= judged.len() <= contour.finalists();
    judged.truncate(contour.finalists());
    let mut left = MOST_FOLLOWED;
    let crosses_now = !judged.is_empty() && contour.crosses(None, &mut left) == Some(true);
    // Of changes with the same way the plainest comes first; ways that still cross themselves come last.
    let (mut kept, mut leads, mut crossing) = (Vec::<Judged<C>>::new(), Vec::new(), Vec::new());
    let (mut is_rivalled, mut outside) = (false, None);
    for (verdict, change) in judged {
        let best = kept.first();
        if is_rivalled && kept.len() == HANDED_OUT {
            break;
        }
        let rivals = best.is_some_and(|best| is_rival::<C>(best, &(verdict, &change)));
        if kept.len() == HANDED_OUT && !rivals {
            continue;
        }
        let lead = contour.lead(&change);
        if let Some(known) = leads.iter().position(|known| C::is_alike(known, &lead)) {
            is_rivalled |= best.is_some_and(|(best, other)| {
                known == 0
                    && verdict.cost - best.cost < C::CLEARLY
                    && contour.is_either(other, &change)
            });
            continue;
        }
        let is_held = contour.holds(&change);
        if !is_held && (is_rivalled || outside.is_some() || best.is_some() && !rivals) {
            continue;
        }
        let Some(crosses) = contour.crosses(Some(&change), &mut left) else {
            // The others are not known, so that none is sure.
            is_complete = false;
            break;
        };
        match (is_held, crosses) {
            (true, false) => {
                is_rivalled |= rivals;
                if kept.len() < HANDED_OUT {
                    kept.push((verdict, change));
                    leads.push(lead);
                }
            }
            (false, false) if best.is_some() => is_rivalled |= rivals,
            // It comes before all that are offered.
            (false, false) => outside = Some((verdict, change)),
            (true, true) if crosses_now && !matches!(change, Change::Exchange { .. }) => {
                crossing.push((verdict, change))
            }
            _ => {}
        }
    }
    let is_alone = |best: &Judged<C>| {
        let outside = outside.as_ref().map(|(verdict, change)| (*verdict, change));
        best.0.may_be_sure && !outside.is_some_and(|outside| is_rival::<C>(best, &outside))
    };
    let mut is_sure = is_complete && !is_rivalled && kept.first().is_some_and(is_alone);
    if kept.is_empty() {
        crossing.truncate(HANDED_OUT);
        (kept, is_sure) = (crossing, false);
    }
    let repair = |(nth, (verdict, change)): (usize, Judged<C>)| Repair {
        change,
        is_sure: nth == 0 && is_sure,
        is_whole: verdict.left == 0,
    };
    kept.into_iter().enumerate().map(repair).collect()
}

type Judged<C> = (Verdict, Change<<C as Contour>::Meant>);

/// True where another change is as plain as the best one, and the text says no less for it.
fn is_rival<C: Contour>(
    (best, change): &Judged<C>,
    (other, its): &(Verdict, &Change<C::Meant>),
) -> bool {
    // A doubled block is stronger evidence than a possibly lost one.
    let is_twin = matches!(change, Change::Delete { .. }) && matches!(its, Change::Insert { .. });
    // Of two pairs of blocks that may have changed places nothing says which have.
    let are_exchanged = matches!(
        (change, its),
        (Change::Exchange { .. }, Change::Exchange { .. })
    );
    // What is calculated fits by itself.
    let clearly = match best.plainness > other.plainness {
        true => 2.0 * C::CLEARLY,
        false => C::CLEARLY,
    };
    !is_twin
        && other.left == best.left
        && other.plainness <= best.plainness
        && (are_exchanged || other.evidence - best.evidence < clearly)
}

#[cfg(test)]
mod tests {
    use super::super::gap::SHORTEST;
    use super::*;
    use std::cell::Cell;

    /// Candidates by their result (first letter), the remaining evidence and their cost; `?` is not offered, and `x`
    /// crosses itself.
    struct Toy {
        meant: Vec<(&'static str, usize, f64)>,
        twin: Option<f64>,
        /// What is read to find out whether a change crosses itself.
        followed: usize,
        /// What has been read for it.
        read: Cell<usize>,
    }

    impl Toy {
        fn of(meant: Vec<(&'static str, usize, f64)>, twin: Option<f64>) -> Toy {
            Toy {
                meant,
                twin,
                followed: 1,
                read: Cell::new(0),
            }
        }
    }

    impl Contour for Toy {
        type Meant = (&'static str, usize);
        type Lead = Option<u8>;
        const CLEARLY: f64 = 1.0;

        fn finalists(&self) -> usize {
            10
        }
        fn order(&self) -> Vec<usize> {
            vec![0]
        }
        fn meant(&self, _: usize) -> Vec<(Self::Meant, f64)> {
            let all = self.meant.iter();
            all.map(|(name, left, cost)| ((*name, *left), *cost))
                .collect()
        }
        fn deleted(&self, _: usize) -> Option<f64> {
            self.twin
        }
        fn exchanged(&self, _: usize) -> Option<f64> {
            None
        }
        fn gaps(&self, _: usize) -> Vec<Vector> {
            [4.0, 500.0].map(|x| Vector::new(x, 0.0)).to_vec()
        }
        fn headings(&self, _: usize) -> Option<[Vector; 2]> {
            None
        }
        fn filling(&self, _: usize, way: &Segment) -> Option<(Self::Meant, f64)> {
            assert!(way.length() > SHORTEST);
            self.twin.map(|_| (("lost", 0), 0.5))
        }
        fn judged(&self, change: &Change<Self::Meant>, cost: f64) -> (Option<Verdict>, usize) {
            let left = match change {
                Change::Replace { meant, .. } | Change::Insert { meant, .. } => meant.1,
                _ => 0,
            };
            let verdict = Verdict {
                left,
                cost,
                plainness: Plainness::Slip,
                evidence: cost,
                may_be_sure: true,
            };
            (Some(verdict), 1)
        }
        fn lead(&self, change: &Change<Self::Meant>) -> Option<u8> {
            match change {
                Change::Replace { meant, .. } | Change::Insert { meant, .. } => {
                    meant.0.bytes().next()
                }
                _ => None,
            }
        }
        fn is_alike(one: &Option<u8>, other: &Option<u8>) -> bool {
            one == other
        }
        fn holds(&self, change: &Change<Self::Meant>) -> bool {
            self.lead(change) != Some(b'?')
        }
        fn crosses(&self, change: Option<&Change<Self::Meant>>, left: &mut usize) -> Option<bool> {
            let read = self.followed.min(*left);
            self.read.set(self.read.get() + read);
            *left -= read;
            (*left > 0).then(|| change.is_none_or(|change| self.lead(change) == Some(b'x')))
        }
    }

    fn check(meant: &[(&'static str, usize, f64)], twin: Option<f64>, expected: &str) {
        let meant = meant.to_vec();
        let found = search(&Toy::of(meant, twin), &mut 100);
        let shown = |repair: &Repair<(&'static str, usize)>| {
            let name = match &repair.change {
                Change::Replace { meant, .. } | Change::Insert { meant, .. } => meant.0,
                _ => "twin",
            };
            format!("{name}{}", if repair.is_sure { "!" } else { "" })
        };
        let found: Vec<String> = found.iter().map(shown).collect();
        assert_eq!(found.join(" "), expected);
    }

    #[test]
    fn the_least_that_leaves_the_least_is_sure_where_nothing_else_does_as_well() {
        check(&[("b", 0, 3.0), ("a", 0, 1.0), ("c", 1, 0.0)], None, "a! b");
        check(&[("b", 0, 1.5), ("a", 0, 1.0)], None, "a b");
        // A change with the same way is no rival, and the plainest is kept.
        check(&[("a2", 0, 1.5), ("a", 0, 1.0)], None, "a!");
        // Changes that are not offered count as rivals all the same.
        check(&[("a", 0, 1.0), ("?", 0, 1.2)], None, "a");
        // A way that crosses itself is offered where there is nothing else, and never sure.
        check(&[("a", 0, 1.0), ("x", 0, 0.5)], None, "a!");
        check(&[("x", 0, 0.5)], None, "x");
    }

    #[test]
    fn a_block_that_stands_twice_says_more_than_one_that_may_be_lost() {
        check(&[], Some(0.2), "twin! lost");
        check(&[("a", 0, 0.7)], Some(0.2), "twin lost a");
    }

    #[test]
    fn no_more_is_followed_than_may_be_and_nothing_is_sure_then() {
        const NAMES: [&str; 10] = ["a", "b", "c", "d", "e", "f", "g", "h", "i", "j"];
        for (followed, expected) in [(1_000, 4), (80_000, 1), (400_000, 0)] {
            let meant = (0..10).map(|cost| (NAMES[cost], 0, 2.0 * cost as f64));
            let toy = Toy {
                followed,
                ..Toy::of(meant.collect(), None)
            };
            let found = search(&toy, &mut 100);
            assert_eq!(found.len(), expected, "{followed}");
            assert!(toy.read.get() <= MOST_FOLLOWED);
            let is_sure = found.iter().any(|repair| repair.is_sure);
            assert_eq!(is_sure, followed == 1_000);
        }
    }

    #[test]
    fn no_more_is_run_than_may_be() {
        let meant = vec![("a", 0, 1.0), ("b", 0, 2.0), ("c", 0, 3.0)];
        let mut left = 2;
        let found = search(&Toy::of(meant, None), &mut left);
        assert_eq!((found.len(), left), (2, 0));
    }
}
