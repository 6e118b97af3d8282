//! ISO text as an open document: its lines, their effects, and what an edit leaves unchanged.

use super::block::Block;
use super::control::{Control, way_of};
use super::cut::{Cut, Entry, Heard};
use super::evidence::{Evidence, UsualDecimals};
use super::layout::{LOOKED_AT, is_parted};
use super::leader::leader;
use super::limits::{Limits, Table};
use super::machine::{Machine, Ran};
use super::moves::Reading;
use super::order::{Order, Sequence, labels, order};
use super::read::{Placed, Run, words_of};
use super::repair::found::{Meant, Repairs};
use crate::program::contours::Contours;
use crate::program::cuts::Cuts;
use crate::program::path::Way;
use crate::program::repair::searches::Searches;
use crate::program::repair::slip;
use crate::settings::Effective;
use crate::text::SourceText;
use rustc_hash::FxHashMap;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// Lines at the beginning that show how numbers are meant: a first guess.
const HEAD: usize = 3_000;

/// An ISO program as text, with the effects of its lines.
///
/// The effect of a line depends on those before it, so a program is kept as cuts, each with the state in which the machine
/// enters it. An edit runs the cuts that it touched, and those after them whose state changes; a cut that only moved stays
/// as it is. A program that calls subprograms is run again with each edit.
#[derive(Clone, Debug)]
pub struct Document {
    text: SourceText,
    pub(super) cuts: Cuts<Cut, Entry>,
    pub(crate) control: Control,
    evidence: Evidence,
    pub(super) contours: Contours,
    /// The slips that may explain the findings, once somebody has asked for them.
    pub(super) repairs: OnceLock<Arc<Repairs>>,
    pub(super) searches: Searches<Vec<slip::Repair<Meant>>>,
    /// Whether its words stand apart, once somebody has asked.
    is_parted: OnceLock<bool>,
    /// The line of each N and O number, once somebody has asked.
    labels: OnceLock<Arc<FxHashMap<u32, usize>>>,
}

impl Document {
    /// Reads program text. Never fails: damage is in [`Document::findings`].
    pub fn read(bytes: Vec<u8>) -> Document {
        Document::read_with(bytes, &Effective::default())
    }

    pub(crate) fn read_with(bytes: Vec<u8>, settings: &Effective) -> Document {
        let limits = Limits::of(settings);
        let mut document = Document {
            text: SourceText::new(bytes),
            cuts: Cuts::before(Entry::of(Machine::default(), None)),
            control: Control {
                reading: Evidence::default().reading(&limits),
                limits: Arc::new(limits),
                table: Table::default(),
                leader: 0,
                order: None,
            },
            evidence: Evidence::default(),
            contours: Contours::default(),
            repairs: OnceLock::new(),
            searches: Searches::default(),
            is_parted: OnceLock::new(),
            labels: OnceLock::new(),
        };
        document.read_all();
        document
    }

    pub fn text(&self) -> &SourceText {
        &self.text
    }

    /// True where it feeds an electrode downwards.
    pub(crate) fn mills(&self) -> bool {
        self.cuts.state_before(self.cuts.len()).machine().mills
    }

    /// The meaning found for the program's numbers.
    pub fn reading(&self) -> &Reading {
        &self.control.reading
    }

    pub(crate) fn evidence(&self) -> &Evidence {
        &self.evidence
    }

    pub(in crate::program) fn order(&self) -> Option<&Order> {
        self.control.order.as_ref()
    }

    /// Checks again under other settings.
    pub(crate) fn set_settings(&mut self, settings: &Effective) {
        if *settings != self.control.limits.settings {
            self.control.limits = Arc::new(Limits::of(settings));
            self.repairs = OnceLock::new();
            self.read_all();
        }
    }

    /// Whether its words stand apart.
    pub(super) fn is_parted(&self) -> bool {
        *self.is_parted.get_or_init(|| is_parted(&self.text))
    }

    /// The line of each N and O number.
    pub(super) fn labels(&self) -> &FxHashMap<u32, usize> {
        self.labels.get_or_init(|| Arc::new(labels(&self.text)))
    }

    /// Its lines in the order in which they run.
    pub(super) fn sequence(&self) -> Sequence<'_> {
        self.control.sequence(&self.text)
    }

    /// A line's bytes, without its end; none of a line before the first `%`.
    pub(super) fn line_bytes(&self, line: usize) -> &[u8] {
        self.sequence().bytes(line)
    }

    /// The first lines, which no control reads: those before its first `%`.
    pub(crate) fn leader(&self) -> usize {
        self.control.leader
    }

    /// From the first to the last byte of a line that is not a space.
    pub(super) fn words_of(&self, line: usize) -> Range<usize> {
        let start = self.text.line_start(line);
        let (first, end) = words_of(self.line_bytes(line), start);
        first as usize..end as usize
    }

    /// The content of a line.
    pub(super) fn block(&self, line: usize) -> Block {
        Block::of(self.line_bytes(line))
    }

    /// The decimals of nearly all numbers.
    pub(super) fn usual_decimals(&self) -> Option<UsualDecimals> {
        self.evidence.usual_decimals()
    }

    /// Whether lengths have a decimal point, where nearly all are written alike.
    pub(super) fn pointed(&self) -> Option<bool> {
        self.evidence.pointed()
    }

    /// Some bytes that count from the beginning of a cut, in the text.
    pub(super) fn bytes_in(&self, cut: usize, (start, end): (u32, u32)) -> Range<usize> {
        let byte = self.cuts.byte(cut);
        byte + start as usize..byte + end as usize
    }

    /// Runs the lines of a cut again, up to one of them, and hands out what each does.
    pub(super) fn run_again(&self, cut: usize, end: usize, each: impl FnMut(&Ran<'_>)) -> Run<'_> {
        let before = self.cuts.state_before(cut).machine();
        let mut run = Run::new(self.sequence(), before, self.control.reading);
        run.lines(self.cuts.lines(cut).start..end, self.cuts.byte(cut), each);
        run
    }

    /// The moves of a cut that cut, from where the wire enters it.
    fn placed(&self, cut: usize) -> Vec<Placed> {
        let run = self.run_again(cut, self.cuts.lines(cut).end, |_| {});
        run.finished().1
    }

    /// The moves of a cut that cut, and the bytes of their words.
    pub(super) fn moves_of(&self, cut: usize) -> Vec<Heard> {
        let at = self.cuts.state_before(cut).at;
        let placed = |(made, range): Placed| (made.shifted(at), self.bytes_in(cut, range));
        self.placed(cut).into_iter().map(placed).collect()
    }

    pub(super) fn way_in(&self, cut: usize) -> Way {
        way_of(
            self.placed(cut).iter().map(|(made, _)| made),
            &self.control.reading,
        )
    }

    /// The state before a line, with the wire's position, or behind it; and the cut in which it first runs, up to there. `None`
    /// for a line that does not run.
    pub(super) fn run_up_to(&self, line: usize, behind: bool) -> Option<(usize, Run<'_>)> {
        let nth = match &self.control.order {
            None => line,
            Some(order) => order.of_line(line).next()?,
        };
        let cut = self.cuts.first_at(nth);
        self.cuts.get(cut)?;
        let end = nth + usize::from(behind);
        Some((cut, self.run_again(cut, end, |_| {})))
    }

    /// Replaces a range of bytes and runs again what it touched.
    pub fn edit(&mut self, range: Range<usize>, replacement: &str) {
        self.repairs = OnceLock::new();
        self.searches.edited();
        self.labels = OnceLock::new();
        // The byte before belongs to the edit: a CR there may become one line end with an inserted LF.
        let first = range.start.min(self.text.len()).saturating_sub(1);
        if self.text.line_of(first) < LOOKED_AT {
            self.is_parted = OnceLock::new();
        }
        if self.control.order.is_some() {
            let end = range.end.min(self.text.len());
            self.text.replace(range.start.min(end)..end, replacement);
            self.read_all();
            return;
        }
        let edit = (range, replacement);
        self.cuts.edit(&self.control, &mut self.text, edit);
        self.evidence = self.evidence_of_cuts();
        match leader(&self.text) == self.control.leader && !self.must_run_again() {
            true => self.look(),
            false => self.read_all(),
        }
    }

    /// Whether the program as a whole shows that its lines are to be read otherwise than they were.
    fn must_run_again(&self) -> bool {
        let calls = self.control.order.is_none() && self.cuts.iter().any(|cut| cut.calls);
        calls
            || self.evidence.reading(&self.control.limits) != self.control.reading
            || self.stated_table() != self.control.table
    }

    /// The control before the first line.
    pub(super) fn first_machine(&self) -> Machine {
        Machine {
            inch: self.control.limits.inch(),
            ..Machine::default()
        }
    }

    /// Runs all lines.
    fn run(&mut self) {
        let begin = Entry::of(self.first_machine(), None);
        self.cuts = Cuts::read(&self.control, &self.text, begin);
        self.evidence = self.evidence_of_cuts();
    }

    /// What nothing but the settings says of how numbers are meant.
    fn first_evidence(&self) -> Evidence {
        Evidence {
            inches: u32::from(self.control.limits.inch()),
            ..Evidence::default()
        }
    }

    /// What all lines say of it.
    fn evidence_of_cuts(&self) -> Evidence {
        let mut evidence = self.first_evidence();
        self.cuts.iter().for_each(|cut| evidence.add(&cut.evidence));
        evidence
    }

    /// Reads all of the text.
    fn read_all(&mut self) {
        self.control.leader = leader(&self.text);
        self.control.order = None;
        self.control.table.clear();
        self.guess_reading();
        self.run();
        if self.cuts.iter().any(|cut| cut.calls) {
            self.control.order = Some(order(&self.text));
            self.run();
        }
        // The evidence of an arc depends on the unit and the step, but not the other way round: after two runs the evidence
        // leads to no other reading, and with a third to no other table.
        for _ in 0..3 {
            if !self.must_run_again() {
                break;
            }
            self.control.reading = self.evidence.reading(&self.control.limits);
            self.control.table = self.stated_table();
            self.run();
        }
        self.contours = Contours::default();
        self.look();
    }

    /// A first guess of the meaning of numbers, from the beginning of the text: it saves running everything twice.
    fn guess_reading(&mut self) {
        self.control.reading = Evidence::default().reading(&self.control.limits);
        for _ in 0..2 {
            let (mut machine, mut evidence) = (self.first_machine(), self.first_evidence());
            let (mut line, end) = (0, HEAD.min(self.text.line_count()));
            while line < end {
                let mut run = Run::new(self.sequence(), machine, self.control.reading);
                line = run.lines(line..end, 0, |_| {});
                evidence.add(&run.evidence);
                machine = run.after;
            }
            self.control.reading = evidence.reading(&self.control.limits);
        }
    }

    /// Checks what depends on the program as a whole; what is known of cuts that were not run again is used again.
    fn look(&mut self) {
        let before = std::mem::take(&mut self.contours);
        self.contours = Contours::of(self, before);
        let doubtful = self.doubts();
        for (cut, is_doubtful) in self.cuts.iter_mut().zip(doubtful) {
            if let Some(moves) = &mut cut.moves {
                moves.is_doubtful = is_doubtful.or(moves.is_doubtful);
            }
            cut.moves.take_if(|moves| moves.tell_nothing());
        }
    }
}
