//! The contours of a program, in any language: which cuts are one contour, with stops within it, and where one crosses
//! itself.

use super::path::{ControlOffset, Found, Verdict, Way, is_tab};
use super::steps::Program;
use rustc_hash::FxHashMap;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

/// Stops in one contour, to hold the part before its last piece is cut.
const STOPS_WITHIN: usize = 16;

/// Those of them after which a tab is searched for.
const TABS_WITHIN: usize = 4;

/// A program by its cuts, as the division into contours sees them.
pub(in crate::program) trait Divided: Program {
    /// Pieces that return to the start together are one contour, in whatever order they are cut.
    const PIECES_ARE_ONE: bool;

    /// Tells a cut apart from all others, and from what it was before an edit.
    fn id(&self, cut: usize) -> u64;

    fn verdict(&self, cut: usize) -> Cow<'_, Verdict>;

    fn way(&self, cut: usize) -> Way;

    /// It is open, and the wire may go on after the stop at its end.
    fn may_go_on(&self, cut: usize) -> bool;

    /// The cut after that stop, where it may belong to the same contour.
    fn behind_stop(&self, cut: usize) -> Option<usize>;

    /// It is a contour of its own or the way to one: no cut after it is a tab of those before.
    fn stands_alone(&self, cut: usize) -> bool;

    /// A block of these cuts has a fault: the way after it is not the intended one.
    fn is_doubtful(&self, cuts: &Range<usize>) -> bool;

    /// The offset that the control makes of some cuts that are one contour; `None` where it runs as it is written, or
    /// nothing is known of it.
    fn control_offset(&self, cuts: &Range<usize>) -> Option<ControlOffset>;

    /// The way of consecutive cuts, with a stop after the first.
    fn way_of(&self, cuts: &Range<usize>) -> Way {
        let mut all = cuts.clone().map(|cut| self.way(cut));
        let mut whole = all.next().unwrap_or_default();
        for way in all.filter(|way| way.count() > 0) {
            whole.append(&way);
        }
        whole
    }
}

/// Cuts that are one contour.
#[derive(Clone, Debug)]
pub(in crate::program) struct Contour {
    pub(crate) cuts: Range<usize>,
    /// The last of them is the tab of those before: all are judged as one. Else they return to the start together.
    pub(crate) ends_with_tab: bool,
    /// What is known of it as one, where it crosses itself, too; of pieces that return together, nothing.
    judged: Arc<Judged>,
}

impl Contour {
    pub(crate) fn verdict(&self) -> &Verdict {
        &self.judged.0
    }

    pub(crate) fn found(&self) -> &Found {
        &self.judged.1
    }
}

type Judged = (Verdict, Found);

/// What is known of an open cut and those after its stops: up to which one they are one contour, and whether that one is
/// their tab.
type Joined = Option<(usize, bool)>;

/// The contours of more than one cut, in order; and what is known of them until the next edit.
#[derive(Clone, Debug, Default)]
pub(in crate::program) struct Contours {
    list: Vec<Contour>,
    /// By the first cut, with all that were looked at.
    joined: FxHashMap<u64, (Vec<u64>, Joined)>,
    /// By the first cut and the last.
    judged: FxHashMap<(u64, u64), Arc<Judged>>,
}

impl Contours {
    /// Divides a program; what is known of cuts that are still there is used again.
    pub(crate) fn of<D: Divided>(program: &D, mut before: Contours) -> Contours {
        let mut contours = Contours::default();
        let mut cut = 0;
        while cut < program.cut_count() {
            if !program.may_go_on(cut) {
                cut += 1;
                continue;
            }
            let ids = |end: usize| (cut..end.min(program.cut_count())).map(|cut| program.id(cut));
            let is_same =
                |known: &(Vec<u64>, Joined)| ids(cut + known.0.len()).eq(known.0.iter().copied());
            let look = || {
                let (end, joined) = join(program, cut);
                let joined = joined.map(|(last, is_tab)| (last - cut, is_tab));
                (ids(end).collect(), joined)
            };
            let known = before.joined.remove(&program.id(cut)).filter(is_same);
            let (looked_at, joined) = known.unwrap_or_else(look);
            contours.joined.insert(program.id(cut), (looked_at, joined));
            let is_one = joined.filter(|(_, is_tab)| *is_tab || D::PIECES_ARE_ONE);
            let Some((last, ends_with_tab)) = is_one else {
                cut += 1;
                continue;
            };
            let cuts = cut..cut + last + 1;
            let key = (program.id(cut), program.id(cut + last));
            let judge = || match ends_with_tab {
                true => judged(program, &cuts),
                false => Arc::default(),
            };
            let judged = before.judged.remove(&key).unwrap_or_else(judge);
            contours.judged.insert(key, judged.clone());
            cut = cuts.end;
            contours.list.push(Contour {
                cuts,
                ends_with_tab,
                judged,
            });
        }
        contours
    }

    /// The contour of a cut that has more than this one.
    pub(crate) fn of_cut(&self, cut: usize) -> Option<&Contour> {
        let at = self.list.partition_point(|one| one.cuts.end <= cut);
        self.list.get(at).filter(|one| one.cuts.contains(&cut))
    }

    /// The cuts that are one contour with this one.
    pub(crate) fn cuts_of(&self, cut: usize) -> Range<usize> {
        let of_cut = self.of_cut(cut).map(|contour| contour.cuts.clone());
        of_cut.unwrap_or(cut..cut + 1)
    }

    /// Whether the contour of a cut goes on after the stop at its end.
    pub(crate) fn goes_on(&self, cut: usize) -> bool {
        self.cuts_of(cut).end > cut + 1
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Contour> {
        self.list.iter()
    }
}

fn judged<D: Divided>(program: &D, cuts: &Range<usize>) -> Arc<Judged> {
    let way = program.way_of(cuts);
    let found = match program.is_doubtful(cuts) {
        true => Found::default(),
        false => Found::of(&way, program.control_offset(cuts)),
    };
    Arc::new((Verdict::of(&way), found))
}

/// Follows an open cut past its stops: the cut after the last that was looked at; and the one with which it is a contour,
/// which is its tab, or the last of pieces that return to the start together, in whatever order they are cut.
fn join<D: Divided>(program: &D, first: usize) -> (usize, Joined) {
    let (mut last, mut may_be_tab) = (first, true);
    let (mut ends, mut whole) = (program.verdict(first).ends, None);
    for stop in 1..=STOPS_WITHIN {
        let Some(next) = program.behind_stop(last) else {
            break;
        };
        last = next;
        ends = ends.then(&program.verdict(next).ends);
        may_be_tab &= stop <= TABS_WITHIN;
        let mut is_tab_here = false;
        if may_be_tab {
            let before = whole.take().unwrap_or_else(|| program.way(first));
            let (behind, mut all) = (program.way(next), before.clone());
            all.append(&behind);
            is_tab_here = ends.blocks > 2 && is_tab(&before, &behind, &all);
            whole = Some(all);
        }
        if is_tab_here || ends.close() {
            return (last + 2, Some((last, is_tab_here)));
        }
        may_be_tab &= !program.stands_alone(next);
    }
    (last + 2, None)
}
