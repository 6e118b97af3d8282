//! ISO text as an open document: its lines run, what came of them, and what an edit leaves as it was.

use super::block::{Block, Code, Motion, Note, Offset, Stop, read_line};
use super::corner::turned;
use super::crossings::Crossings;
use super::cuts::{StopAt, tabs};
use super::evidence::Evidence;
use super::machine::{CenterRule, Course, Machine, Move, Place, Reading, micrometres};
use super::order::{Order, order};
use super::repair::{Repairs, repairs};
use super::stretch::{Hears, Pathless, Run, Stretch};
use crate::finding::{Finding, Fix, Side};
use crate::geometry::Segment;
use crate::program::path::{Kind, Step, Trace};
use crate::settings::{Effective, Profile, UnitSetting, shipped_profiles};
use crate::text::{SourceText, TextEdit};
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::{Arc, LazyLock, OnceLock};

/// Lines that are run together: an edit costs as many, and a program has as many fewer stretches.
pub(super) const STRETCH: usize = 128;

/// Lines that are looked through for the places of the control's table that a program uses.
const LOOKED_AT: usize = 2_000;

/// Lines that are looked back for block numbers.
const LOOKED_BACK: usize = 50;

/// An ISO program as text, and what its lines do.
///
/// What a line does hangs on those before it, so a program is kept as stretches with what is in force before and behind each. An edit
/// runs the stretches that it touched, and those behind for which something else is in force; one that has only been moved is shifted.
/// A program that calls subprograms is run anew with each edit.
#[derive(Clone, Debug)]
pub struct Document {
    text: SourceText,
    stretches: Vec<Stretch>,
    reading: Reading,
    evidence: Evidence,
    /// The order of the lines, where it is not that of the text: then there is one stretch for each range in it.
    order: Option<Order>,
    /// Where the cuts cross themselves.
    crossings: Box<Crossings>,
    /// The stops within contours, before their tabs, in the order in which they run.
    tabs: Vec<StopAt>,
    /// What settings a fault is held against.
    pub(super) limits: Box<Limits>,
    /// What the program puts into the control's table.
    pub(super) table: Box<Table>,
    /// The slips that may be behind what is wrong, once somebody has asked for them.
    repairs: OnceLock<Arc<Repairs>>,
}

/// The settings that decide what is a fault.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Limits {
    /// mm, where the program's own table does not say.
    pub correction: f64,
    pub side: crate::settings::SideSetting,
    pub compensation: crate::settings::Compensation,
    /// The word that ends a program of the settings' profile.
    pub end: String,
    /// Words that profiles write: whoever has a profile for a machine knows what they mean there.
    pub known: BTreeSet<Code>,
    /// A program that does not say otherwise is in inches.
    pub inch: bool,
    /// Somebody has said in what the numbers of programs are.
    pub has_unit: bool,
    /// Where full circles alone leave open how I and J are meant.
    pub center: CenterRule,
    pub profile: Option<Arc<Profile>>,
}

impl Limits {
    fn of(settings: &Effective) -> Limits {
        Limits {
            correction: settings.correction,
            side: settings.side,
            compensation: settings.compensation,
            end: end_word(settings),
            known: known_words(settings),
            inch: settings.program_units == Some(UnitSetting::Inch),
            has_unit: settings.program_units.is_some(),
            center: settings
                .profile
                .as_ref()
                .map_or(CenterRule::StartToCenter, |profile| profile.center),
            profile: settings
                .profile
                .as_ref()
                .ok()
                .map(|profile| Arc::new(profile.clone())),
        }
    }

    /// The lines that the settings' profile writes besides those that move the wire.
    pub fn lines(&self) -> impl Iterator<Item = &str> {
        self.profile
            .iter()
            .flat_map(|profile| lines_of(profile))
            .map(String::as_str)
    }
}

fn lines_of(profile: &Profile) -> impl Iterator<Item = &String> {
    [
        &profile.begin,
        &profile.contour_begin,
        &profile.contour_end,
        &profile.pause,
        &profile.end,
    ]
    .into_iter()
    .flatten()
}

static SHIPPED_WORDS: LazyLock<BTreeSet<Code>> = LazyLock::new(|| {
    shipped_profiles()
        .filter_map(|name| Profile::of(name, None).ok())
        .flat_map(|profile| words_of_profile(&profile))
        .collect()
});

fn known_words(settings: &Effective) -> BTreeSet<Code> {
    let own = settings.profile.iter().flat_map(words_of_profile);
    SHIPPED_WORDS.iter().copied().chain(own).collect()
}

/// The words of a profile's lines that are a matter of the machine.
fn words_of_profile(profile: &Profile) -> Vec<Code> {
    let mut codes = Vec::new();
    for line in lines_of(profile) {
        read_line(line.replace(['{', '}'], " ").as_bytes(), 1, |note| {
            if let Note::Foreign { code, .. } = note {
                codes.push(code);
            }
        });
    }
    codes
}

/// M02 or M30, as the settings' profile has it.
fn end_word(settings: &Effective) -> String {
    let lines = settings.profile.iter().flat_map(|profile| &profile.end);
    let mut ends =
        lines.filter(|line| read_line(line.as_bytes(), 1, |_| {}).stop == Some(Stop::End));
    ends.next_back()
        .map_or_else(|| "M02".into(), |line| line.trim().into())
}

/// The last value of each place of the control's table, nm.
pub(super) type Table = FxHashMap<Offset, i64>;

/// A cut that has begun before some line and may go on in it, nm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Begun {
    /// Its first move, which is the way in where it has one.
    pub from: Place,
    pub to: Place,
    pub last: Move,
    pub moves: u32,
}

/// A stretch and the line of the text at which it begins.
pub(super) struct Placed<'a> {
    pub stretch: &'a Stretch,
    pub first_line: usize,
    /// Byte of the text from which the stretch's places count.
    pub offset: usize,
}

impl Document {
    /// Reads program text. Never fails: what is damaged is in [`Document::findings`].
    pub fn read(bytes: Vec<u8>) -> Document {
        Document::read_with(bytes, &Effective::default())
    }

    pub fn read_with(bytes: Vec<u8>, settings: &Effective) -> Document {
        let limits = Limits::of(settings);
        let mut document = Document {
            text: SourceText::new(bytes),
            stretches: Vec::new(),
            reading: Evidence::default().reading(limits.center),
            evidence: Evidence::default(),
            order: None,
            crossings: Box::default(),
            tabs: Vec::new(),
            limits: Box::new(limits),
            table: Box::default(),
            repairs: OnceLock::new(),
        };
        document.guess_reading();
        document.run_all();
        document
    }

    pub fn text(&self) -> &SourceText {
        &self.text
    }

    /// How the numbers of the program were found to be meant.
    pub fn reading(&self) -> &Reading {
        &self.reading
    }

    pub(super) fn evidence(&self) -> &Evidence {
        &self.evidence
    }

    pub(super) fn order(&self) -> Option<&Order> {
        self.order.as_ref()
    }

    /// Looks again under other settings.
    pub fn set_settings(&mut self, settings: &Effective) {
        let limits = Limits::of(settings);
        if limits == *self.limits {
            return;
        }
        let center = limits.center != self.limits.center;
        let is_other_unit = limits.inch != self.limits.inch;
        *self.limits = limits;
        self.repairs = OnceLock::new();
        if is_other_unit {
            self.guess_reading();
            return self.run_all();
        }
        self.stretches
            .iter_mut()
            .for_each(|stretch| stretch.is_quiet = false);
        if center {
            self.settle();
        } else {
            self.find_quiet();
        }
    }

    /// What is wrong in the program, in the order of the text.
    pub fn findings(&self) -> Vec<Finding> {
        super::report::findings(self)
    }

    /// The same without the blocks that are only suspected.
    pub fn plain_findings(&self) -> Vec<Finding> {
        super::report::plain_findings(self)
    }

    /// The slips that may be behind what is wrong, by the lines of the cuts that they stand in.
    pub(super) fn repairs(&self) -> &Repairs {
        self.repairs
            .get_or_init(|| Arc::new(repairs(self, &self.plain_findings())))
    }

    /// A line's bytes, without its end.
    pub(super) fn line_bytes(&self, line: usize) -> &[u8] {
        self.text
            .bytes()
            .get(self.text.line_range(line))
            .unwrap_or_default()
    }

    /// What a line says.
    pub(super) fn block(&self, line: usize) -> Block {
        read_line(self.line_bytes(line), 1, |_| {})
    }

    /// How many decimals nearly all numbers have, and how many have others.
    pub(super) fn usual_places(&self) -> Option<(u8, u32)> {
        self.evidence.usual_places()
    }

    /// Whether lengths have a decimal point, where nearly all are written alike.
    pub(super) fn pointed(&self) -> Option<bool> {
        self.evidence.pointed()
    }

    /// The fixes of one finding, the preferred one first.
    pub fn fixes(&self, finding: &Finding) -> Vec<Fix<Vec<TextEdit>>> {
        super::fixes::fixes(self, finding)
    }

    pub(super) fn stretches(&self) -> &[Stretch] {
        &self.stretches
    }

    /// Whether a stop stands within a contour, before its tab.
    pub(super) fn is_tab(&self, stop: StopAt) -> bool {
        self.tabs.binary_search(&stop).is_ok()
    }

    pub(super) fn crossings(&self) -> &Crossings {
        &self.crossings
    }

    /// Runs a stretch once more and tells `each` of its moves; gives the byte from which their places count.
    pub(super) fn run_again(&self, index: usize, each: &mut Hears<'_>) -> usize {
        let Some(Placed {
            stretch,
            first_line,
            offset,
        }) = self.placed().nth(index)
        else {
            return 0;
        };
        Stretch::run_with(
            lines_from(&self.text, first_line),
            stretch.lines as usize,
            offset,
            stretch.before,
            self.reading,
            each,
        );
        offset
    }

    /// The stretches in the order in which they run.
    pub(super) fn placed(&self) -> impl Iterator<Item = Placed<'_>> {
        let mut line = 0;
        self.stretches
            .iter()
            .enumerate()
            .map(move |(index, stretch)| {
                let first_line = match &self.order {
                    Some(order) => order.lines.get(index).map_or(0, |lines| lines.start),
                    None => line,
                };
                line = first_line + stretch.lines as usize;
                Placed {
                    stretch,
                    first_line,
                    offset: self.text.line_start(first_line),
                }
            })
    }

    // What is in force at a line.

    /// The lines before `line`, and itself where `behind` says so, in the stretch in which it first runs, run; `None` for a line that
    /// does not run.
    fn run_up_to(&self, line: usize, behind: bool) -> Option<(usize, Stretch)> {
        let mut placed = self.placed().enumerate();
        let holds = |placed: &Placed<'_>| {
            placed.first_line <= line && line < placed.first_line + placed.stretch.lines as usize
        };
        let (index, placed) = placed.find(|(_, placed)| holds(placed))?;
        Some((
            index,
            run_stretch(
                &self.text,
                placed.first_line..line + usize::from(behind),
                placed.stretch.before,
                self.reading,
            ),
        ))
    }

    /// What is in force, and where the wire stands, before a line; `None` for a line that does not run.
    pub(super) fn machine_before(&self, line: usize) -> Option<Machine> {
        self.run_up_to(line, false)
            .map(|(_, stretch)| stretch.after)
    }

    /// What is in force behind a line.
    pub(super) fn machine_behind(&self, line: usize) -> Option<Machine> {
        self.run_up_to(line, true).map(|(_, stretch)| stretch.after)
    }

    /// The cut that is under way before a line.
    pub(super) fn begun_cut(&self, line: usize) -> Option<Begun> {
        self.begun(self.run_up_to(line, false)?)
    }

    /// The cut that is under way behind a line.
    pub(super) fn begun_cut_with(&self, line: usize) -> Option<Begun> {
        self.begun(self.run_up_to(line, true)?)
    }

    fn begun(&self, (index, own): (usize, Stretch)) -> Option<Begun> {
        let mut begun: Option<Begun> = None;
        for stretch in self.stretches.iter().take(index).chain([&own]) {
            if stretch.ends_run_before.is_some() {
                begun = None;
            }
            for run in stretch.runs() {
                begun = begun_by(begun.filter(|_| run.continues), &run);
            }
        }
        begun
    }

    /// The correction in nm that the program itself puts into a place of the control's table.
    pub(super) fn table_value(&self, offset: Offset) -> Option<i64> {
        self.table.get(&offset).copied()
    }

    /// The places of the control's table that the program fills, with their values in nm, and those that its first lines use.
    pub(super) fn table_places(&self, letter: u8) -> Vec<(u32, Option<i64>)> {
        let mut places: BTreeMap<u32, Option<i64>> = self
            .used_places()
            .filter(|its| its.letter == letter)
            .map(|its| (its.index, None))
            .collect();
        for (offset, &value) in self
            .table
            .iter()
            .filter(|(offset, _)| offset.letter == letter)
        {
            places.insert(offset.index, Some(value));
        }
        places.into_iter().collect()
    }

    /// The corrections that the program itself puts into the control's table: their names, and mm.
    pub(in crate::program) fn stated_corrections(&self) -> Vec<(String, f64)> {
        let mut places: Vec<_> = self
            .table
            .iter()
            .map(|(offset, &value)| (*offset, value))
            .collect();
        places.sort_by_key(|(offset, _)| (offset.letter, offset.index));
        places
            .into_iter()
            .map(|(offset, nm)| {
                (
                    format!("{}{}", offset.letter as char, offset.index),
                    nm as f64 / 1e6,
                )
            })
            .collect()
    }

    /// `D` or `H`, as the program names places of the control's table.
    pub(super) fn table_letter(&self) -> u8 {
        let defined = self
            .stretches
            .iter()
            .flat_map(|stretch| &stretch.definitions)
            .map(|definition| definition.offset)
            .next();
        defined
            .or_else(|| self.used_places().next())
            .map_or(b'D', |offset| offset.letter)
    }

    /// The place of the table that a program names, where it names but one.
    pub(super) fn only_offset(&self) -> Option<Offset> {
        let mut all = self
            .table
            .keys()
            .copied()
            .chain(self.used_places().filter(|offset| offset.index > 0));
        let first = all.next()?;
        all.all(|offset| offset == first).then_some(first)
    }

    fn used_places(&self) -> impl Iterator<Item = Offset> + '_ {
        let lines = 0..self.text.line_count().min(LOOKED_AT);
        lines.filter_map(|line| {
            read_line(
                self.text.bytes().get(self.text.line_range(line))?,
                1,
                |_| {},
            )
            .offset
        })
    }

    /// The numbers of the subprograms that some line calls.
    pub(super) fn called(&self) -> BTreeSet<u32> {
        let calling = self.placed().filter(|placed| placed.stretch.calls);
        let lines = calling.flat_map(|placed| {
            placed.first_line..placed.first_line + placed.stretch.lines as usize
        });
        lines
            .filter_map(|line| {
                read_line(
                    self.text.bytes().get(self.text.line_range(line))?,
                    1,
                    |_| {},
                )
                .call
            })
            .collect()
    }

    /// The line that ends a program without calls: what stands behind it is run by nobody yet.
    pub(super) fn last_line(&self) -> Option<usize> {
        if self.order.is_some() {
            return None;
        }
        let ending = self.placed().find(|placed| placed.stretch.after.ended)?;
        let mut lines = ending.first_line..ending.first_line + ending.stretch.lines as usize;
        lines.find(|line| {
            let bytes = self
                .text
                .bytes()
                .get(self.text.line_range(*line))
                .unwrap_or_default();
            read_line(bytes, 1, |_| {}).stop == Some(Stop::End)
        })
    }

    /// The last block number before a line, and the step in which they count there.
    pub(super) fn numbers_before(&self, line: usize) -> Option<(u32, u32)> {
        let number = |line: usize| {
            read_line(
                self.text.bytes().get(self.text.line_range(line))?,
                1,
                |_| {},
            )
            .number
        };
        let mut numbers = (line.saturating_sub(LOOKED_BACK)..line)
            .rev()
            .filter_map(number)
            .filter(|number| *number < u32::MAX);
        let last = numbers.next()?;
        let step = numbers
            .next()
            .and_then(|before| last.checked_sub(before))
            .filter(|step| *step > 0);
        Some((
            last,
            step.unwrap_or(if last.is_multiple_of(10) { 10 } else { 1 }),
        ))
    }

    /// The number of the next block behind a line that has one.
    pub(super) fn number_behind(&self, line: usize) -> Option<u32> {
        let number = |line: usize| {
            read_line(
                self.text.bytes().get(self.text.line_range(line))?,
                1,
                |_| {},
            )
            .number
        };
        (line + 1..self.text.line_count().min(line + 1 + LOOKED_BACK)).find_map(number)
    }

    /// The numbers that the blocks of a stretch lack where the others skip one: each with its line.
    pub(super) fn lacking_numbers(&self, placed: &Placed<'_>) -> Vec<(usize, u32)> {
        let block = |line: usize| {
            read_line(
                self.text
                    .bytes()
                    .get(self.text.line_range(line))
                    .unwrap_or_default(),
                1,
                |_| {},
            )
        };
        let mut found = Vec::new();
        for line in placed.first_line..placed.first_line + placed.stretch.lines as usize {
            let own = block(line);
            if own.empty || own.number.is_some() || own.program.is_some() {
                continue;
            }
            let Some((last, step)) = self.numbers_before(line) else {
                continue;
            };
            let next = (line + 1..self.text.line_count().min(line + 1 + LOOKED_BACK))
                .map(block)
                .find(|block| !block.empty);
            if let (Some(expected), Some(next)) =
                (last.checked_add(step), next.and_then(|next| next.number))
                && expected.checked_add(step) == Some(next)
            {
                found.push((line, expected));
            }
        }
        found
    }

    /// Lines of a range whose coordinates count from where the wire stood: they do not say where it ends.
    pub fn lines_without_ends(&self, range: Range<usize>) -> BTreeSet<usize> {
        let wanted = self.text.line_of(range.start)..self.text.line_of(range.end) + 1;
        let mut found = BTreeSet::new();
        for (index, placed) in self.placed().enumerate() {
            let lines = placed.first_line..placed.first_line + placed.stretch.lines as usize;
            if lines.start < wanted.end && wanted.start < lines.end {
                self.steps_of(index, lines, &placed, &mut 0, &mut |step, machine, _| {
                    if machine.incremental {
                        found.insert(step.line);
                    }
                });
            }
        }
        found
    }

    /// Replaces a range of bytes and runs again what it touched.
    pub fn edit(&mut self, range: Range<usize>, replacement: &str) {
        let end = range.end.min(self.text.len());
        let start = range.start.min(end);
        // The byte before belongs to it: a CR there may become one line end with an inserted LF.
        let first = self.text.line_of(start.saturating_sub(1));
        let lines_behind = self.text.line_count() - 1 - self.text.line_of(end);
        self.repairs = OnceLock::new();
        self.text.replace(start..end, replacement);
        if self.order.is_some() {
            self.guess_reading();
            return self.run_all();
        }
        self.run_touched(first, lines_behind);
    }

    /// Runs the stretches that hold the lines from `first` up to the last `lines_behind` ones, and what hangs on them.
    fn run_touched(&mut self, first: usize, lines_behind: usize) {
        let all_lines = self.text.line_count();
        let (mut from, mut line) = (0, 0);
        while from + 1 < self.stretches.len() && line + self.stretches[from].lines as usize <= first
        {
            line += self.stretches[from].lines as usize;
            from += 1;
        }
        // Stretches before that look ahead at these lines run again too.
        while from > 0 && self.stretches[from - 1].ahead > 0 {
            from -= 1;
            line -= self.stretches[from].lines as usize;
        }
        let (mut to, mut behind) = (self.stretches.len(), 0);
        while to > from + 1 && behind + self.stretches[to - 1].lines as usize <= lines_behind {
            to -= 1;
            behind += self.stretches[to].lines as usize;
        }
        let before = self
            .stretches
            .get(from)
            .map_or_else(|| self.begin(), |stretch| stretch.before);
        let fresh = run_lines(&self.text, line..all_lines - behind, before, self.reading);
        let mut next = from + fresh.len();
        self.stretches.splice(from..to, fresh);
        let mut line = all_lines - behind;
        // What stands behind is run again for as long as something else is in force than was.
        while let Some(before) = next.checked_sub(1).map(|last| self.stretches[last].after)
            && let Some(stretch) = self.stretches.get_mut(next)
            && stretch.before != before
        {
            let lines = line..line + stretch.lines as usize;
            line = lines.end;
            let moved = Machine {
                at: stretch.before.at,
                ..before
            } == stretch.before;
            if moved && stretch.is_loose() {
                stretch.shift([
                    before.at[0].wrapping_sub(stretch.before.at[0]),
                    before.at[1].wrapping_sub(stretch.before.at[1]),
                ]);
            } else {
                *stretch = run_stretch(&self.text, lines, before, self.reading);
            }
            next += 1;
        }
        self.settle();
    }

    /// A first guess of how the numbers are meant, from the beginning of the text: it spares running everything twice.
    fn guess_reading(&mut self) {
        let head = 0..self.text.line_count().min(16 * STRETCH);
        let reading = Evidence::default().reading(self.limits.center);
        let evidence = self.summed(&run_lines(&self.text, head.clone(), self.begin(), reading));
        let units = evidence.reading(self.limits.center);
        let evidence = self.summed(&run_lines(&self.text, head, self.begin(), units));
        self.reading = evidence.reading(self.limits.center);
    }

    /// The control before the first line.
    pub(super) fn begin(&self) -> Machine {
        Machine {
            inch: self.limits.inch,
            ..Machine::default()
        }
    }

    fn summed(&self, stretches: &[Stretch]) -> Evidence {
        let mut evidence = Evidence {
            inch: self.limits.inch,
            ..Evidence::default()
        };
        stretches
            .iter()
            .for_each(|stretch| evidence.add(&stretch.evidence));
        evidence
    }

    /// Runs the whole program.
    fn run_all(&mut self) {
        self.order = None;
        self.run_stretches();
        self.settle();
    }

    fn run_stretches(&mut self) {
        self.stretches = match &self.order {
            None => run_lines(
                &self.text,
                0..self.text.line_count(),
                self.begin(),
                self.reading,
            ),
            Some(order) => {
                let mut machine = self.begin();
                let run = order.lines.iter().map(|lines| {
                    let stretch = run_stretch(&self.text, lines.clone(), machine, self.reading);
                    machine = stretch.after;
                    stretch
                });
                run.collect()
            }
        };
    }

    /// Holds the reading against what the whole program shows, and runs it again where it shows another one: first the unit and the
    /// finest step, then, measured with these, where I and J lead.
    fn settle(&mut self) {
        self.find_reading();
        self.tabs = tabs(self);
        let mut crossings = std::mem::take(&mut self.crossings);
        let calm = crossings.look(self);
        self.crossings = crossings;
        for index in calm {
            self.stretches[index].is_calm = true;
        }
        self.find_quiet();
    }

    /// What a cut within one stretch comes to hangs on its own lines, on the settings and on the control's table: one with which nothing is
    /// wrong is not judged again.
    fn find_quiet(&mut self) {
        let table = super::report::table(self);
        if table != *self.table {
            *self.table = table;
            self.stretches
                .iter_mut()
                .for_each(|stretch| stretch.is_quiet = false);
        }
        for index in super::report::quiet(self) {
            self.stretches[index].is_quiet = true;
        }
    }

    fn find_reading(&mut self) {
        if self.order.is_none() && self.stretches.iter().any(|stretch| stretch.calls) {
            self.order = Some(order(&self.text));
            self.run_stretches();
        }
        for _ in 0..2 {
            self.evidence = self.summed(&self.stretches);
            let reading = self.evidence.reading(self.limits.center);
            if reading == self.reading {
                return;
            }
            self.reading = reading;
            self.run_stretches();
        }
        self.evidence = self.summed(&self.stretches);
        self.reading = self.evidence.reading(self.limits.center);
    }

    /// Where the machine goes, move by move.
    pub fn trace(&self) -> Trace {
        let mut trace = Trace {
            writing: self.reading.writing(),
            ..Trace::default()
        };
        let mut contour = 0;
        let mut start = None;
        for (index, placed) in self.placed().enumerate() {
            let lines = placed.first_line..placed.first_line + placed.stretch.lines as usize;
            self.steps_of(
                index,
                lines,
                &placed,
                &mut contour,
                &mut |step, machine, _| {
                    start.get_or_insert((step.start, machine.stated));
                    trace.steps.push(step);
                },
            );
        }
        if let Some((start, is_known)) = start {
            (trace.start, trace.start_is_known) = (start, is_known);
        }
        trace
    }

    /// Hands out the moves in the order in which they run, each with its line and what is in force behind it.
    pub(super) fn moves(&self, each: &mut dyn FnMut(usize, Move, &Machine)) {
        for placed in self.placed() {
            let mut machine = placed.stretch.before;
            for line in placed.first_line..placed.first_line + placed.stretch.lines as usize {
                if machine.ended {
                    return;
                }
                let range = self.text.line_range(line);
                let block = read_line(&self.text.bytes()[range.clone()], range.start, |_| {});
                if !block.empty
                    && let Some(made) = machine.run(&block, &self.reading)
                {
                    let (made, corner) = self.turned(line, made, &mut machine);
                    each(line, made, &machine);
                    if let Some(corner) = corner {
                        each(line, corner, &machine);
                    }
                }
            }
        }
    }

    /// A move up to where the corner at its end begins, and that corner.
    pub(super) fn turned(
        &self,
        line: usize,
        made: Move,
        machine: &mut Machine,
    ) -> (Move, Option<Move>) {
        if made.corner.is_none() {
            return (made, None);
        }
        let turned = turned(
            made,
            machine,
            lines_from(&self.text, line + 1).map(|(_, line)| line),
            &self.reading,
        );
        (turned.made, turned.corner)
    }

    /// True where the control makes corners of its own.
    pub(super) fn has_corners(&self) -> bool {
        self.stretches.iter().any(|stretch| stretch.has_corners)
    }

    /// The side on which the wire runs beside each step of the trace.
    pub fn sides(&self) -> Vec<Option<Side>> {
        let mut sides = Vec::new();
        for (index, placed) in self.placed().enumerate() {
            let lines = placed.first_line..placed.first_line + placed.stretch.lines as usize;
            self.steps_of(index, lines, &placed, &mut 0, &mut |_, _, side| {
                sides.push(side)
            });
        }
        sides
    }

    /// The steps whose text overlaps or touches a range of bytes.
    pub fn steps_in(&self, range: Range<usize>) -> Vec<Step> {
        let wanted = self.text.line_of(range.start)..self.text.line_of(range.end) + 1;
        let mut steps = Vec::new();
        let mut contour = 0;
        for (index, placed) in self.placed().enumerate() {
            let lines = placed.first_line..placed.first_line + placed.stretch.lines as usize;
            if lines.start < wanted.end && wanted.start < lines.end {
                let mut own = contour;
                self.steps_of(index, lines, &placed, &mut own, &mut |step, _, _| {
                    if step.range.start <= range.end && range.start <= step.range.end {
                        steps.push(step);
                    }
                });
            }
            let before = |stretch: usize| self.tabs.partition_point(|tab| tab.0 < stretch);
            contour +=
                (placed.stretch.pauses as usize).saturating_sub(before(index + 1) - before(index));
        }
        steps
    }

    /// Runs lines of a stretch and hands out their steps, each with what is in force behind it, and the side on which the wire runs
    /// beside it.
    fn steps_of(
        &self,
        index: usize,
        lines: Range<usize>,
        placed: &Placed<'_>,
        contour: &mut usize,
        each: &mut dyn FnMut(Step, &Machine, Option<Side>),
    ) {
        let mut machine = placed.stretch.before;
        for line in lines {
            if machine.ended {
                return;
            }
            let range = self.text.line_range(line);
            let bytes = &self.text.bytes()[range.clone()];
            let block = read_line(bytes, range.start, |_| {});
            if block.empty {
                continue;
            }
            let made = machine
                .run(&block, &self.reading)
                .map(|made| self.turned(line, made, &mut machine));
            let words = super::stretch::words_of(bytes, range.start);
            let words = words.0 as usize..words.1 as usize;
            for made in made
                .into_iter()
                .flat_map(|(made, corner)| [Some(made), corner])
                .flatten()
            {
                let side = made.side;
                let kind = match made.motion {
                    Motion::Rapid => Kind::Rapid,
                    Motion::Line => Kind::Line,
                    Motion::Clockwise | Motion::CounterClockwise => Kind::Arc,
                };
                let ideal = match made.course(&self.reading) {
                    Course::Line => {
                        Some(Segment::line(micrometres(made.from), micrometres(made.to)))
                    }
                    Course::Arc(arc) => Some(Segment::Arc(arc)),
                    Course::OffRadius { .. } | Course::NoRadius => None,
                };
                let (start, end) = (micrometres(made.from), micrometres(made.to));
                let step = Step {
                    range: words.clone(),
                    line,
                    number: block.number,
                    kind,
                    start,
                    end,
                    ideal,
                    contour: *contour,
                };
                each(step, &machine, side);
            }
            if let Some(stop) = block.stop {
                let kind = if stop == Stop::End {
                    Kind::End
                } else {
                    Kind::Pause
                };
                let at = micrometres(machine.at);
                let is_tab = self.is_tab((index, words.start.saturating_sub(placed.offset) as u32));
                let step = Step {
                    range: words,
                    line,
                    number: block.number,
                    kind,
                    start: at,
                    end: at,
                    ideal: None,
                    contour: *contour,
                };
                each(step, &machine, None);
                *contour += usize::from(stop == Stop::Pause && !is_tab);
            }
        }
    }
}

/// The cut that is under way behind a run, which goes on with what was under way before.
fn begun_by(before: Option<Begun>, run: &Run) -> Option<Begun> {
    let last = run.last[1];
    let first = before.unwrap_or(Begun {
        from: run.first[0].from,
        to: run.first[0].to,
        last,
        moves: 0,
    });
    run.open.then_some(Begun {
        last,
        moves: first.moves + run.moves,
        ..first
    })
}

/// Runs lines in stretches of [`STRETCH`] to twice as many, so that lines inserted one by one do not leave ever shorter ones.
fn run_lines(
    text: &SourceText,
    lines: Range<usize>,
    before: Machine,
    reading: Reading,
) -> Vec<Stretch> {
    let mut machine = before;
    let pieces = (lines.len() / STRETCH).max(1);
    let at = |piece: usize| lines.start + lines.len() * piece / pieces;
    let mut stretches = Vec::with_capacity(pieces);
    for first in (0..pieces).step_by(AT_ONCE) {
        // What a line does hangs on those before, how the moves lie on themselves does not.
        let some = (first..pieces.min(first + AT_ONCE)).map(|piece| {
            let run = run_pathless(text, at(piece)..at(piece + 1), machine, reading);
            machine = run.after();
            run
        });
        let some: Vec<Pathless> = some.collect();
        if some.len() > 1 {
            stretches.par_extend(some.into_par_iter().map(Pathless::with_paths));
        } else {
            stretches.extend(some.into_iter().map(Pathless::with_paths));
        }
    }
    stretches
}

/// Stretches whose paths are found side by side.
const AT_ONCE: usize = 256;

fn run_stretch(
    text: &SourceText,
    lines: Range<usize>,
    before: Machine,
    reading: Reading,
) -> Stretch {
    run_pathless(text, lines, before, reading).with_paths()
}

fn run_pathless(
    text: &SourceText,
    lines: Range<usize>,
    before: Machine,
    reading: Reading,
) -> Pathless {
    let start = text.line_start(lines.start);
    Stretch::run(
        lines_from(text, lines.start),
        lines.len(),
        start,
        before,
        reading,
    )
}

/// The lines of a text from one on, each with the byte at which it begins.
fn lines_from(text: &SourceText, first: usize) -> impl Iterator<Item = (usize, &[u8])> + Clone {
    (first..text.line_count()).map(|line| {
        let range = text.line_range(line);
        (range.start, &text.bytes()[range])
    })
}
