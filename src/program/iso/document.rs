//! ISO text as an open document: its lines, their effects, and what an edit leaves unchanged.

use super::block::{Block, Offset};
use super::control::{Control, lines_from};
use super::cut::JoinedCut;
use super::evidence::{Evidence, UsualDecimals};
use super::last_run::LastRun;
use super::layout::{LOOKED_AT, is_parted};
use super::leader::leader;
use super::limits::Limits;
use super::machine::Machine;
use super::moves::{Move, Reading};
use super::order::{Order, labels, order};
use super::read::words_of;
use super::repair::found::Repairs;
use super::stretch::{Placed, StopAt, Stretch};
use crate::program::by_chunk::ByChunk;
use crate::program::chunks::{ChunkReader, Chunks, Reread};
use crate::program::contours::{Contours, PartAt, Touched};
use crate::program::of_cut::OfCut;
use crate::program::path::Known;
use crate::settings::Effective;
use crate::text::SourceText;
use rustc_hash::FxHashMap;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// An ISO program as text, with the effects of its lines.
///
/// The effect of a line depends on those before it, so a program is kept as stretches with the state before and after
/// each. An edit runs the stretches that it touched, and those after them whose state changes; a stretch that only moved is
/// shifted. A program that calls subprograms is run again with each edit.
#[derive(Clone, Debug)]
pub struct Document {
    text: SourceText,
    pub(super) stretches: Chunks<Stretch>,
    reading: Reading,
    /// The first lines, which no control reads.
    leader: usize,
    evidence: Evidence,
    /// The order of the lines, where it is not that of the text: then there is one stretch for each range in it.
    order: Option<Order>,
    /// The stops within contours, before their tabs, and the contours that cross themselves.
    pub(super) contours: Contours<JoinedCut>,
    /// The contours with possible findings, and those that may belong together with one of them.
    pub(super) doubtful: ByChunk<JoinedCut>,
    /// The findings about those that depend on them alone, and those about contours that cross
    /// themselves.
    pub(super) told: ByChunk<OfCut>,
    /// The results of the search for crossings.
    known: Box<Known>,
    /// The settings that faults depend on.
    pub(crate) limits: Box<Limits>,
    /// The values that the program puts into the control's table.
    pub(crate) table: Box<Table>,
    /// The slips that may explain the findings, once somebody has asked for them.
    pub(super) repairs: OnceLock<Arc<Repairs>>,
    /// Those before the last edit.
    pub(super) repairs_before: Option<Arc<Repairs>>,
    /// The moves of one stretch, until one of them changes.
    last_run: LastRun,
    /// Whether its words stand apart, once somebody has asked.
    is_parted: OnceLock<bool>,
    /// The line of each N and O number, once somebody has asked.
    labels: OnceLock<Arc<FxHashMap<u32, usize>>>,
}

/// The last value of each place of the control's table, nm.
pub(super) type Table = FxHashMap<Offset, i64>;

impl Document {
    /// Reads program text. Never fails: damage is in [`Document::findings`].
    pub fn read(bytes: Vec<u8>) -> Document {
        Document::read_with(bytes, &Effective::default())
    }

    pub(crate) fn read_with(bytes: Vec<u8>, settings: &Effective) -> Document {
        let limits = Limits::of(settings);
        let mut document = Document {
            leader: 0,
            text: SourceText::new(bytes),
            stretches: Chunks::default(),
            reading: Evidence::default().reading(&limits),
            evidence: Evidence::default(),
            order: None,
            contours: Contours::default(),
            doubtful: ByChunk::default(),
            told: ByChunk::default(),
            known: Box::default(),
            limits: Box::new(limits),
            table: Box::default(),
            repairs: OnceLock::new(),
            repairs_before: None,
            last_run: LastRun::default(),
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
        self.stretches.iter().any(|stretch| stretch.after.mills)
    }

    /// The meaning found for the program's numbers.
    pub fn reading(&self) -> &Reading {
        &self.reading
    }

    pub(crate) fn evidence(&self) -> &Evidence {
        &self.evidence
    }

    pub(in crate::program) fn order(&self) -> Option<&Order> {
        self.order.as_ref()
    }

    /// Checks again under other settings.
    pub(crate) fn set_settings(&mut self, settings: &Effective) {
        let limits = Limits::of(settings);
        if limits == *self.limits {
            return;
        }
        let center = limits.center != self.limits.center;
        let numbers = |limits: &Limits| (limits.inch, limits.whole, limits.writes_micrometres);
        let is_other_unit = numbers(&limits) != numbers(&self.limits);
        *self.limits = limits;
        self.repairs = OnceLock::new();
        if is_other_unit {
            self.guess_reading();
            return self.run_all();
        }
        self.look_at_all();
        if center {
            self.find_reading();
        }
        self.look(None);
    }

    /// Forgets which cuts are sound.
    fn look_at_all(&mut self) {
        let again = self.stretches.iter_mut().map(Stretch::look_again);
        if !again.fold(true, |all, is_held| all & is_held) {
            self.run_stretches();
        }
    }

    /// The correction in a place of the control's table, µm: from the program's own table, else the settings.
    pub(super) fn correction(&self, offset: Option<Offset>) -> f64 {
        let of_settings = self.limits.correction * 1e3;
        self.stated_correction(offset).unwrap_or(of_settings)
    }

    /// The same where the program itself states it.
    pub(super) fn stated_correction(&self, offset: Option<Offset>) -> Option<f64> {
        let stated = self.table.get(&offset?)?;
        Some((*stated as f64 / 1e3).abs())
    }

    /// Whether its words stand apart.
    pub(super) fn is_parted(&self) -> bool {
        *self.is_parted.get_or_init(|| is_parted(&self.text))
    }

    /// The line of each N and O number.
    pub(super) fn labels(&self) -> &FxHashMap<u32, usize> {
        self.labels.get_or_init(|| Arc::new(labels(&self.text)))
    }

    /// A line's bytes, without its end; none of a line before the first `%`.
    pub(super) fn line_bytes(&self, line: usize) -> &[u8] {
        let read = (line >= self.leader).then(|| self.text.line(line));
        read.unwrap_or_default()
    }

    /// The first lines, which no control reads: those before its first `%`.
    pub(crate) fn leader(&self) -> usize {
        self.leader
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

    /// Whether a stop stands within a contour, before its tab.
    pub(super) fn is_tab(&self, stop: StopAt) -> bool {
        self.contours.is_tab(stop)
    }

    /// Byte of the text from which the places of a stretch count.
    pub(super) fn byte_of(&self, stretch: usize) -> usize {
        self.stretches.byte(stretch)
    }

    /// Hands out each move of a part; returns the byte from which their places count.
    pub(super) fn hear(
        &self,
        (index, part): PartAt,
        each: &mut dyn FnMut(&Move, (u32, u32)),
    ) -> usize {
        let Some(placed) = self.placed_at(index) else {
            return 0;
        };
        let Range { start, end } = placed.lines;
        let moves = self.last_run.of(index, |heard| {
            let lines = lines_from(&self.text, self.leader, start);
            let before = placed.stretch.before;
            Stretch::run_with(
                lines,
                end - start,
                placed.offset,
                before,
                self.reading,
                heard,
            );
        });
        let own = moves.iter().skip_while(|(of, ..)| *of < part);
        own.take_while(|(of, ..)| *of == part)
            .for_each(|(_, step, range)| each(step, *range));
        placed.offset
    }

    /// The stretches in the order in which they run.
    pub(super) fn placed(&self) -> impl Iterator<Item = Placed<'_>> {
        self.stretches.placed().map(|(stretch, place)| Placed {
            stretch,
            lines: place.lines.clone(),
            offset: place.byte,
        })
    }

    pub(super) fn placed_at(&self, index: usize) -> Option<Placed<'_>> {
        let place = self.stretches.place(index);
        self.stretches.get(index).map(|stretch| Placed {
            stretch,
            lines: place.lines,
            offset: place.byte,
        })
    }

    /// Replaces a range of bytes and runs again what it touched. Returns the first stretch in which the machine may
    /// stand elsewhere than before.
    pub fn edit(&mut self, range: Range<usize>, replacement: &str) -> usize {
        self.repairs_before = self.repairs.take().or(self.repairs_before.take());
        self.labels = OnceLock::new();
        self.last_run = LastRun::default();
        // The byte before belongs to the edit: a CR there may become one line end with an inserted LF.
        let first = range.start.min(self.text.len()).saturating_sub(1);
        if self.text.line_of(first) < LOOKED_AT {
            self.is_parted = OnceLock::new();
        }
        if self.order.is_some() {
            let end = range.end.min(self.text.len());
            self.text.replace(range.start.min(end)..end, replacement);
            self.read_all();
            return 0;
        }
        let control = self.control();
        let evidence = &mut self.evidence;
        let reread = self
            .stretches
            .edit(&control, &mut self.text, (range, replacement), |gone| {
                evidence.take(&gone.evidence)
            });
        let read = &self.stretches[reread.chunks.clone()];
        read.iter()
            .for_each(|stretch| evidence.add(&stretch.evidence));
        if leader(&self.text) != self.leader {
            self.read_all();
            return 0;
        }
        let first = reread.chunks.start;
        match self.settle(Some(reread)) {
            true => 0,
            false => first,
        }
    }

    /// A first guess of the meaning of numbers, from the beginning of the text: it saves running everything twice.
    fn guess_reading(&mut self) {
        let head = 0..self.text.line_count().min(16 * Control::LINES);
        self.reading = Evidence::default().reading(&self.limits);
        for _ in 0..2 {
            let head = Chunks::read(&self.control(), &self.text, head.clone());
            self.reading = self.summed(&head).reading(&self.limits);
        }
    }

    /// The present way of reading the text.
    pub(super) fn control(&self) -> Control {
        Control {
            begin: self.first_machine(),
            reading: self.reading,
            leader: self.leader,
        }
    }

    /// The control before the first line.
    pub(super) fn first_machine(&self) -> Machine {
        Machine {
            inch: self.limits.inch,
            ..Machine::default()
        }
    }

    fn summed(&self, stretches: &[Stretch]) -> Evidence {
        let mut evidence = Evidence {
            inches: u32::from(self.limits.inch),
            ..Evidence::default()
        };
        stretches
            .iter()
            .for_each(|stretch| evidence.add(&stretch.evidence));
        evidence
    }

    /// Reads all of the text.
    fn read_all(&mut self) {
        self.leader = leader(&self.text);
        self.guess_reading();
        self.run_all();
    }

    /// Runs the whole program.
    fn run_all(&mut self) {
        self.order = None;
        self.run_stretches();
        self.settle(None);
    }

    fn run_stretches(&mut self) {
        self.last_run = LastRun::default();
        let (control, text) = (self.control(), &self.text);
        self.stretches = match &self.order {
            None => Chunks::read(&control, text, 0..text.line_count()),
            Some(order) => Chunks::read_in_order(&control, text, &order.lines),
        };
        self.evidence = self.summed(&self.stretches);
    }

    /// Compares the reading with the evidence of the whole program, and runs it again where it suggests another one:
    /// first the unit and the finest step, then, measured with these, the meaning of I and J. True where it did.
    fn settle(&mut self, reread: Option<Reread>) -> bool {
        let is_run_again = self.find_reading();
        self.look(reread.filter(|_| !is_run_again));
        is_run_again
    }

    /// Checks what depends on the program as a whole; what an edit has not `reread` is kept.
    fn look(&mut self, mut reread: Option<Reread>) {
        // The findings of a cut depend on its own lines, on the settings and on the control's table.
        let table = self.stated_table();
        if table != *self.table {
            *self.table = table;
            self.look_at_all();
            reread = None;
        }
        let mut contours = std::mem::take(&mut self.contours);
        let mut doubtful = std::mem::take(&mut self.doubtful);
        let (reread, [from, to]) = match &reread {
            Some(reread) => self.touched(reread),
            None => {
                (contours, doubtful) = (Contours::default(), ByChunk::default());
                self.told = ByChunk::default();
                let all = Reread::all(&self.stretches);
                (all, [(0, 0), (self.stretches.len(), 0)])
            }
        };
        let touched = Touched {
            reread: &reread,
            from,
            to,
        };
        let (mut known, mut found) = (std::mem::take(&mut self.known), Vec::new());
        let mut is_doubtful = self.doubts();
        let looked_at = contours.look(self, touched, &mut known, |cut, crosses| {
            let is_kept = crosses == Some(true) || is_doubtful(&cut);
            found.extend(is_kept.then_some(cut));
        });
        drop(is_doubtful);
        (self.contours, self.known) = (contours, known);
        let told = self.tell(looked_at.from..looked_at.to, &mut found);
        self.told.splice(&looked_at, told);
        doubtful.splice(&looked_at, found);
        // All that begin in a stretch stand where it stood, but for those that were looked at.
        for (chunk, stretch) in self.stretches.iter().enumerate() {
            let is_elsewhere = |cut: &JoinedCut| cut.is_elsewhere(stretch.moved);
            let of = doubtful.of(chunk);
            if of.first().is_some_and(is_elsewhere) || of.last().is_some_and(is_elsewhere) {
                doubtful.change(chunk, |cut| cut.follow(stretch.moved));
            }
        }
        self.doubtful = doubtful;
        let last = self.stretches.len().min(looked_at.to.0 + 1);
        for index in self.clean(looked_at.from.0..last) {
            self.stretches[index].let_go();
        }
        let read = &mut self.stretches[reread.chunks.clone()];
        read.iter_mut().for_each(|stretch| stretch.is_fresh = false);
    }

    /// Runs the program again where it shows another meaning of its numbers; true where it did.
    fn find_reading(&mut self) -> bool {
        let mut is_run_again = false;
        if self.order.is_none() && self.stretches.iter().any(|stretch| stretch.calls) {
            self.order = Some(order(&self.text));
            self.run_stretches();
            is_run_again = true;
        }
        debug_assert_eq!(self.evidence, self.summed(&self.stretches));
        // The evidence of an arc depends on the unit and the step, but not the other way round:
        // after two runs the evidence leads to no other reading.
        for _ in 0..2 {
            let reading = self.evidence.reading(&self.limits);
            if reading == self.reading {
                break;
            }
            self.reading = reading;
            self.run_stretches();
            is_run_again = true;
        }
        is_run_again
    }
}
