//! How many findings of its own a contour has, by kind: kept with it, so that a report looks only at those of which it shows some. Knows
//! nothing of what the findings say.

use crate::drawing::EntityId;
use crate::finding::{Place, Rule, Severity, Side, SmallRadius};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A rule, and the severity that the case has at most.
pub(super) type Kind = (Rule, Option<Severity>);

/// A contour with findings of its own.
#[derive(Clone, Debug)]
pub(super) struct Notable {
    /// The first of its entities in machining order.
    pub(super) first: EntityId,
    pub(super) what: Notability,
    /// The number of its findings, once counted.
    pub(super) counted: Option<Counted>,
}

/// What is to be asked about such a contour.
#[derive(Clone, Copy, Debug)]
pub(super) struct Notability {
    pub(super) has_tight_arcs: bool,
    pub(super) has_observations: bool,
    /// A rule on whole contours holds.
    pub(super) as_a_whole: bool,
}

/// How many findings a contour has with the wire on a side.
#[derive(Clone, Debug, Default)]
pub(super) struct Counted {
    pub(super) side: Option<Side>,
    pub(super) counts: Counts<Vec<(Kind, usize)>>,
    /// The fit says what its arcs leave.
    pub(super) says_the_fit: bool,
    /// Each arc below the correction, where they are few.
    pub(super) arcs: Option<Arc<[TightArc]>>,
}

/// An arc below the correction, by its index in the contour.
#[derive(Clone, Debug)]
pub(super) struct TightArc {
    pub(super) index: usize,
    pub(super) place: Place,
    pub(super) numbers: SmallRadius,
}

/// Numbers of findings: of arcs below the correction, of local rules, of rules on whole contours.
#[derive(Clone, Debug, Default)]
pub(super) struct Counts<T> {
    pub(super) arcs: T,
    pub(super) local: T,
    /// Those of local rules that another finding of the contour stands for.
    pub(super) stood_for: T,
    pub(super) whole: T,
}

/// The sums over many contours.
pub(super) type Sums = Counts<BTreeMap<Kind, usize>>;

impl Sums {
    pub(super) fn add(&mut self, counted: &Counted) {
        for (sums, counts) in [
            (&mut self.arcs, &counted.counts.arcs),
            (&mut self.local, &counted.counts.local),
            (&mut self.stood_for, &counted.counts.stood_for),
            (&mut self.whole, &counted.counts.whole),
        ] {
            for &(kind, count) in counts {
                *sums.entry(kind).or_default() += count;
            }
        }
    }
}
