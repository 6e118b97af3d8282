//! How ISO text is read, cut by cut: the effect of a line depends on those before it.

use super::block::{Motion, Register};
use super::corner;
use super::cut::{Cut, Entry, Moves};
use super::limits::{Limits, Table};
use super::moves::{Bend, Move, Place, Reading, added, apart, meet, micrometres};
use super::order::{Order, Sequence};
use super::read::{Placed, Run};
use super::summary::{Spur, Summary, WireSide};
use crate::drawing::wire_side;
use crate::finding::{Detail, Fault, Finding, NoFix, Rule, Side, SmallRadius};
use crate::program::cuts::Reader;
use crate::program::path::{
    ControlOffset, Found, Jointed, Node, UM_IN_MM, Verdict, Way, is_tight, odd_joints,
};
use crate::settings::Compensation;
use crate::text::SourceText;
use std::ops::Range;
use std::sync::Arc;

/// How the lines of a program are read and judged.
#[derive(Clone, Debug)]
pub(crate) struct Control {
    pub(super) reading: Reading,
    /// The settings that faults depend on.
    pub(crate) limits: Arc<Limits>,
    /// The values that the program puts into the control's table.
    pub(super) table: Table,
    /// The first lines, which no control reads.
    pub(super) leader: usize,
    /// The order of the lines, where it is not that of the text.
    pub(super) order: Option<Order>,
}

impl Control {
    /// The lines of a text in the order in which they run.
    pub(super) fn sequence<'t>(&'t self, text: &'t SourceText) -> Sequence<'t> {
        Sequence {
            text,
            leader: self.leader,
            order: self.order.as_ref(),
        }
    }

    /// The correction in a place of the control's table, µm: from the program's own table, else the settings.
    pub(super) fn correction(&self, offset: Option<Register>) -> f64 {
        let stated = self.stated_correction(offset);
        stated.unwrap_or(self.limits.settings.correction * 1e3)
    }

    /// The same where the program itself states it.
    pub(super) fn stated_correction(&self, offset: Option<Register>) -> Option<f64> {
        let stated = self.table.get(&offset?)?;
        Some((*stated as f64 / 1e3).abs())
    }
}

/// Lines that were run: the first and the one behind them, and where the wire goes.
pub(crate) struct Begun {
    lines: Range<usize>,
    cut: Cut,
    way: Vec<Placed>,
}

impl Reader for Control {
    type State = Entry;
    type Begun = Begun;
    type Cut = Cut;

    fn line_count(&self, text: &SourceText) -> usize {
        self.sequence(text).count()
    }

    fn base(&self, text: &SourceText, line: usize) -> usize {
        self.sequence(text).base(line)
    }

    fn run(&self, text: &SourceText, first: usize, before: &Entry) -> (Begun, usize, Entry) {
        let sequence = self.sequence(text);
        let mut run = Run::new(sequence, before.machine(), self.reading);
        let base = sequence.base(first);
        let behind = run.lines(first..sequence.count(), base, |_| {});
        let after = Entry::of(run.after, Some(before));
        let (cut, way) = run.finished();
        let begun = Begun {
            lines: first..behind,
            cut,
            way,
        };
        (begun, behind, after)
    }

    fn finish(&self, _: &SourceText, begun: Begun) -> Vec<(Range<usize>, Cut)> {
        let Begun {
            lines,
            mut cut,
            way,
        } = begun;
        if let Some(moves) = &mut cut.moves {
            let placed = way;
            let way = way_of(placed.iter().map(|(made, _)| made), &self.reading);
            moves.verdict = Verdict::of(&way);
            let mut faults = moves.join(&placed, &way);
            faults.extend(self.tight_arcs(&placed, moves.verdict.twice_area));
            faults.extend(side_change(&placed, moves.verdict.ends.tolerance()));
            if !faults.is_empty() {
                cut.rare.get_or_insert_default().faults.extend(faults);
            }
            let start = micrometres(moves.sum.start()).coords;
            cut.bounds = Some(moves.verdict.bounds.moved(start));
            let offset = || moves.sum.control_offset(self);
            let found = moves.sum.whole && !moves.sum.faulty;
            let found = found.then(|| Found::of(&way, offset()));
            moves.found = found.filter(|found| !found.is_clean()).map(Box::new);
        }
        cut.numbers.shrink_to_fit();
        vec![(lines, cut)]
    }

    const REACH: usize = corner::REACH;

    /// All places of a cut count from where the wire enters it.
    fn take_on(cut: &mut Cut, from: &Entry, to: &Entry) -> bool {
        from.is_like(to) && (from.at == to.at || !cut.fixed)
    }

    fn taken_on(after: &Entry, from: &Entry, to: &Entry) -> Entry {
        after.at(added(after.at, apart(to.at, from.at)))
    }
}

impl Control {
    /// Arcs that the wire cannot follow at its distance: those of a part's contour, whether the control offsets it or
    /// nobody does.
    fn tight_arcs(&self, placed: &[Placed], twice_area: f64) -> impl Iterator<Item = Finding> {
        let role = self.limits.settings.side.role();
        let by_settings = role.and_then(|role| wire_side(role, true, twice_area));
        placed.iter().filter_map(move |(made, range)| {
            let side_of_center = match made.motion {
                Motion::CounterClockwise => Side::Left,
                Motion::Clockwise => Side::Right,
                Motion::Line | Motion::Rapid => return None,
            };
            let side = match made.side {
                Some(side) => side,
                None if self.limits.settings.compensation == Compensation::Path => return None,
                None => by_settings.unwrap_or(side_of_center),
            };
            let required = self.correction(made.offset);
            let arc = made.segment(&self.reading).as_arc().copied()?;
            let is_tight = side == side_of_center && is_tight(arc.radius, required);
            let detail = SmallRadius {
                no_fix: Some(NoFix::Program),
                ..SmallRadius::of(&arc, arc.radius, required, UM_IN_MM)
            };
            let detail = Detail::SmallRadius(Box::new(detail));
            is_tight.then(|| Finding::in_text(Rule::SmallRadius, bytes(*range), detail))
        })
    }
}

/// Where the wire is first sent to the other side. The next pass, back along the same contour, has it there.
fn side_change(placed: &[Placed], tolerance: f64) -> Option<Finding> {
    let (first, _) = placed.first()?;
    let mut pairs = placed.iter().zip(placed.iter().skip(1));
    pairs.find_map(|((before, _), (made, range))| {
        let side = made
            .side
            .filter(|_| before.side.is_some() && made.side != before.side)?;
        let begins = [first.from, first.to].map(|begin| meet(begin, made.from, tolerance));
        let fault = Fault::SideChange { side };
        (begins == [false; 2]).then(|| Finding::of(fault, bytes(*range)))
    })
}

fn bytes((start, end): (u32, u32)) -> Range<usize> {
    start as usize..end as usize
}

impl Moves {
    /// Finds the odd joints of its way: the faults, but for spurs. Whether there is one depends on where its contour begins.
    fn join(&mut self, placed: &[Placed], way: &Way) -> Vec<Finding> {
        let block = |nth: usize| {
            let ((made, _), curve) = (placed.get(nth)?, way.pieces().get(nth)?);
            let is_known = made.is_arc() == curve.as_arc().is_some();
            is_known.then_some(Jointed {
                curve: *curve,
                by_radius: matches!(made.bend, Bend::Radius(_)),
                is_lead: made.switches.is_some(),
            })
        };
        let mut faults = Vec::new();
        for (nth, fault) in odd_joints(placed.len(), block) {
            let (made, range) = &placed[nth];
            match fault {
                Fault::Spur { length } => self.spurs.push(Spur {
                    tip: made.from,
                    length,
                    range: *range,
                }),
                fault => faults.push(Finding::of(fault, bytes(*range))),
            }
        }
        self.sum.faulty |= !faults.is_empty();
        faults
    }
}

impl Summary {
    /// The offset that the control makes, with the correction of the first moves.
    pub(super) fn control_offset(&self, control: &Control) -> Option<ControlOffset> {
        let WireSide::One(side) = self.side else {
            return None;
        };
        let [first, second] = &self.first;
        Some(ControlOffset {
            side,
            correction: control.correction(second.offset.or(first.offset)),
        })
    }
}

/// The way of some moves, µm, from the start of the first.
pub(super) fn way_of<'a>(moves: impl IntoIterator<Item = &'a Move>, reading: &Reading) -> Way {
    let mut moves = moves.into_iter().peekable();
    let start: Place = moves.peek().map_or([0, 0], |first| first.from);
    let mut way = Way::from(Node::default(), reading.writing());
    for made in moves {
        let piece = made.seen_from(start).segment(reading);
        let end = Node::at(micrometres(apart(made.to, start)));
        way.push(piece, made.is_arc(), end);
    }
    way
}
