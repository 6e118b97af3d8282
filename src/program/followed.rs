//! The contour that an open cut forms with the cuts after its stops: its tab, or pieces that return to the start
//! together.

use super::by_chunk::{Begun, PartAt};
use super::path::{HasCuts, KnownTabs, is_tab, mixed};
use super::steps::Program;

/// Stops in one contour, to hold the part before its last piece is cut.
const STOPS_WITHIN: usize = 16;

/// Those of them after which a tab is searched for.
const TABS_WITHIN: usize = 4;

/// A document whose cuts begin and end at parts of its chunks.
pub(in crate::program) trait Followed:
    HasCuts<Cut: Begun + Clone> + Program
{
    /// Pieces that return to the start together are one contour, in whatever order they are cut.
    const PIECES_ARE_ONE: bool;

    /// The first cut that begins between two places and needs to be looked at.
    fn next_cut(&self, from: PartAt, before: PartAt) -> Option<Self::Cut>;

    /// The cut that begins at a part; `None` where none is held.
    fn cut_from(&self, begin: PartAt) -> Option<Self::Cut>;

    /// Where the cut after it begins.
    fn behind(&self, cut: &Self::Cut) -> PartAt;

    /// Whether it is open and may go on after the stop at its end.
    fn may_go_on(&self, cut: &Self::Cut) -> bool;

    /// The cut after that stop, where it may belong to the same contour.
    fn behind_stop(&self, cut: &Self::Cut) -> Option<Self::Cut> {
        self.cut_from(self.behind(cut))
    }

    /// The stop between them, by its chunk and its place in there.
    fn stop_between(&self, cut: &Self::Cut, behind: &Self::Cut) -> (usize, usize);

    /// A cut and the one after its stop as one.
    fn joined(&self, cut: Self::Cut, behind: &Self::Cut) -> Self::Cut;

    /// It is a contour of its own or the way to one: no cut after it is a tab of those before.
    fn stands_alone(&self, _cut: &Self::Cut) -> bool {
        false
    }

    /// It does not close, with nothing after it that goes on.
    fn stays_open(&self, _cut: &Self::Cut) -> bool {
        false
    }

    /// The contour that an open cut forms with the cuts after its stops; `None` where it need not
    /// be looked for.
    fn follow(&self, cut: &Self::Cut, known: &mut KnownTabs) -> Option<Contour<Self::Cut>>
    where
        Self: Sized,
    {
        if !self.may_go_on(cut) {
            return None;
        }
        let mut open = OpenCuts {
            document: self,
            whole: cut.clone(),
            before: cut.clone(),
            last: cut.clone(),
            stops: Vec::new(),
        };
        let is_tab = open.end_with_tab(known);
        let OpenCuts { whole, stops, .. } = open;
        let behind = self.behind(&whole);
        let next = self.cut_from(behind);
        let reach = next.map_or(behind, |next| self.behind(&next)).0;
        let is_one = is_tab.is_some_and(|is_tab| is_tab || Self::PIECES_ARE_ONE);
        Some(Contour {
            tabs: if is_one { stops } else { Vec::new() },
            is_open: is_tab.is_none() && self.stays_open(cut),
            behind: if is_one { behind } else { self.behind(cut) },
            whole: (is_tab == Some(true)).then_some(whole),
            reach,
        })
    }
}

/// The contour that an open cut forms with the cuts after its stops.
pub(in crate::program) struct Contour<C> {
    /// The stops within it, in the order of the text, each by its chunk and its place in there.
    pub(crate) tabs: Vec<(usize, usize)>,
    /// All its cuts as one, where the last of them is its tab.
    pub(crate) whole: Option<C>,
    /// It does not close.
    pub(crate) is_open: bool,
    /// Where the next contour may begin.
    pub(crate) behind: PartAt,
    /// The last chunk that was looked at for this.
    pub(crate) reach: usize,
}

/// An open cut and the cuts after its stops.
struct OpenCuts<'a, D: Followed> {
    document: &'a D,
    /// All as one, and all but the last, which is the first while there is no other.
    whole: D::Cut,
    before: D::Cut,
    last: D::Cut,
    stops: Vec<(usize, usize)>,
}

impl<D: Followed> OpenCuts<'_, D> {
    /// Takes what goes on with the open cut; true where the last cut is a tab; false where the cuts together return to
    /// the start, in whatever order they are cut. `None` where nothing goes on.
    fn end_with_tab(&mut self, known: &mut KnownTabs) -> Option<bool> {
        let mut may_be_tab = true;
        let mut mark = self.last_mark();
        for last in 1..=STOPS_WITHIN {
            self.take_next()?;
            may_be_tab &= last <= TABS_WITHIN;
            mark = mixed(mark, self.last_mark());
            let ends = self.document.ends(&self.whole);
            let ends_with_tab =
                may_be_tab && ends.blocks > 2 && known.get(mark, || self.is_tab()) == Some(true);
            if ends_with_tab || ends.close() {
                return Some(ends_with_tab);
            }
            may_be_tab = may_be_tab && !self.document.stands_alone(&self.last);
        }
        None
    }

    fn take_next(&mut self) -> Option<()> {
        let document = self.document;
        let next = document.behind_stop(&self.last)?;
        self.stops.push(document.stop_between(&self.last, &next));
        let whole = document.joined(self.whole.clone(), &next);
        self.before = std::mem::replace(&mut self.whole, whole);
        self.last = next;
        Some(())
    }

    /// The mark of the last of them: equal ways with the same stops have equal marks.
    fn last_mark(&self) -> u64 {
        // What ends within the step of the program coincides.
        let slack = self.document.writing().slack;
        mixed(self.document.mark(&self.last), slack.to_bits())
    }

    /// Whether the last of them is the tab of those before.
    fn is_tab(&self) -> Option<bool> {
        let [before, last, whole] =
            [&self.before, &self.last, &self.whole].map(|cut| self.document.way(cut));
        is_tab(&before, &last, &whole)
    }
}
