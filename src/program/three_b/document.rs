//! 3B text as an open document: what its lines say, where the machine goes, and what is wrong.
//!
//! The text is cut into runs of lines. What a line says hangs on no other line, so an edit reads again the runs that it touched;
//! what hangs on the whole program (contours, numbers, the end) is made from a few sums of each run.

use super::block::{Block, Node, PartArc};
use super::crossings::{Found, Known, Stretch, pieces_of, search};
use super::decode::meant;
use super::encode::line_block;
use super::fields::fields_of;
use super::language::{Field, Piece, pieces};
use super::layout::push_fields;
use super::parse::{StatedPoint, Words, unexpected};
use super::rules::block_number::{Numbered, Sequence};
use super::rules::position_mismatch::Mismatched;
use super::rules::{
    self, Counts, Limits, Site, TextFix, block_number, culprit, missing_end, not_closed, position_mismatch, text_after_end,
};
use super::run::{BlockEntry, Entry, LINES, Local, Move, Numbering, Part, Run, Sum, What, is_jump, may_cross_itself, travel_of};
use crate::finding::{Detail, Finding, FixKind, Place, ProgramFault, Rule, Severity};
use crate::geometry::{Point, Vector};
use crate::program::trace::{Chain, Kind, Step, Trace};
use crate::settings::{Effective, Layout, SideSetting};
use crate::text::{SourceText, TextEdit};
use rayon::prelude::*;
use std::borrow::Cow;
use std::ops::Range;

/// A 3B or 4B program as text, and what was read from it.
#[derive(Clone, Debug)]
pub struct Document {
    text: SourceText,
    words: OwnWords,
    limits: Limits,
    runs: Vec<Run>,
    view: Box<View>,
    /// What the search for crossings has seen.
    known: Box<Known>,
}

#[derive(Clone, Debug, PartialEq)]
struct OwnWords {
    pause: String,
    end: String,
}

impl OwnWords {
    fn of(settings: &Effective) -> OwnWords {
        OwnWords { pause: settings.pause.trim().into(), end: settings.end.trim().into() }
    }

    fn words(&self) -> Words<'_> {
        Words { pause: &self.pause, end: &self.end }
    }
}

/// An entry by its run and its index in there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct At {
    run: usize,
    entry: usize,
}

/// A part by its run and its index in there.
type PartAt = (usize, usize);

/// Blocks between two words.
#[derive(Clone, Debug, PartialEq)]
struct Section {
    /// First and last part.
    parts: [PartAt; 2],
    sum: Sum,
    /// The way between two contours, without the wire.
    is_jump: bool,
}

/// What hangs on the program as a whole.
#[derive(Clone, Debug, Default, PartialEq)]
struct View {
    /// Bytes and lines before each run.
    starts: Vec<(usize, usize)>,
    /// The sections that reach over the end of a run, or begin or end the text, in their order. The others are parts of one run.
    outer: Vec<Section>,
    /// Where the contours begin that do not close.
    open: Vec<PartAt>,
    /// The word that ends the program.
    end: Option<At>,
    last_block: Option<At>,
    /// In no order; the places are bytes of the text.
    findings: Vec<Finding>,
}

/// Where a finding is kept.
#[derive(Clone, Copy, Debug)]
enum Kept {
    InBlock { run: usize, index: usize },
    OnWhole { index: usize },
}

/// A block and what stands about it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedBlock {
    /// Bytes of the text, from the first `B` to the quadrant.
    pub range: Range<usize>,
    /// From 0.
    pub line: usize,
    pub number: Option<u32>,
    pub block: Block,
    /// What a 4B block says beside a 3B block.
    pub part: Option<PartArc>,
    /// Coordinates behind the block, mm.
    pub stated_end: Option<[f64; 2]>,
}

/// Pauses in one contour, to hold the part before its last piece is cut.
const PAUSES_WITHIN: usize = 16;

impl Document {
    /// Reads program text with the words and limits of the default settings.
    pub fn read(bytes: Vec<u8>) -> Document {
        Document::read_with(bytes, &Effective::default())
    }

    /// Reads program text. Never fails: what is damaged is in [`Document::findings`].
    pub fn read_with(bytes: Vec<u8>, settings: &Effective) -> Document {
        let text = SourceText::new(bytes);
        let (words, limits) = (OwnWords::of(settings), Limits::of(settings));
        let count = text.line_count();
        let read = |first: usize| run_of(&text, first..(first + LINES).min(count), &words.words(), &limits);
        let firsts: Vec<usize> = (0..count).step_by(LINES).collect();
        let runs = if count > 20 * LINES { firsts.into_par_iter().map(read).collect() } else { firsts.into_iter().map(read).collect() };
        let mut document = Document { text, words, limits, runs, view: Box::default(), known: Box::default() };
        document.look_again();
        document
    }

    /// The words between blocks.
    pub(in crate::program) fn words(&self) -> Words<'_> {
        self.words.words()
    }

    /// The largest number that the controller takes, µm.
    pub(in crate::program) fn largest(&self) -> i64 {
        self.limits.largest()
    }

    pub fn text(&self) -> &SourceText {
        &self.text
    }

    /// Reads again where the settings change what the text means or what is a fault of it.
    pub fn set_settings(&mut self, settings: &Effective) {
        if self.words != OwnWords::of(settings) || self.limits != Limits::of(settings) {
            *self = Document::read_with(std::mem::take(&mut self.text).into_bytes(), settings);
        }
    }

    /// Replaces a range of bytes and reads again what it touched.
    pub fn edit(&mut self, range: Range<usize>, replacement: &str) {
        let end = range.end.min(self.text.len());
        let start = range.start.min(end);
        // The byte before belongs to it: a CR there may become one line end with an inserted LF.
        let first = self.run_at(start.saturating_sub(1));
        let last = self.run_at(end).max(first);
        let starts = &self.view.starts;
        let first_byte = starts.get(first).map_or(0, |start| start.0);
        let first_line = starts.get(first).map_or(0, |start| start.1);
        let behind = starts.get(last + 1).map_or(self.text.len(), |start| start.0);
        let tail = self.text.len() - behind;
        self.text.replace(start..end, replacement);
        let new_behind = self.text.len() - tail;
        debug_assert_eq!(self.text.line_start(first_line), first_byte);
        let last_line = if tail == 0 { self.text.line_count() } else { self.text.line_of(new_behind) };
        let words = self.words.words();
        let fresh: Vec<Run> = (first_line..last_line)
            .step_by(LINES)
            .map(|line| run_of(&self.text, line..(line + LINES).min(last_line), &words, &self.limits))
            .collect();
        self.runs.splice(first..(last + 1).min(self.runs.len()), fresh);
        self.look_again();
    }

    /// The run that holds a byte; the last one for bytes past the end.
    fn run_at(&self, byte: usize) -> usize {
        self.view.starts.partition_point(|start| start.0 <= byte).saturating_sub(1)
    }

    fn base(&self, run: usize) -> usize {
        self.view.starts.get(run).map_or(0, |start| start.0)
    }

    fn entry(&self, at: At) -> Option<&Entry> {
        self.runs.get(at.run)?.entries.get(at.entry)
    }

    /// Bytes of an entry in the text.
    fn range_of(&self, at: At, starts: &[(usize, usize)]) -> Range<usize> {
        let base = starts.get(at.run).map_or(0, |start| start.0);
        self.entry(at).map_or(0..0, |entry| entry.range().start + base..entry.range().end + base)
    }

    // What hangs on the whole.

    fn look_again(&mut self) {
        let mut known = std::mem::take(&mut self.known);
        let mut calm = Vec::new();
        *self.view = self.look(&mut known, &mut calm);
        self.known = known;
        // What a contour within one run comes to hangs on nothing else: it is not asked again.
        for of_run in calm.chunk_by(|a, b| a.0 == b.0) {
            let run = of_run.first().and_then(|(run, _)| self.runs.get_mut(*run));
            let is_calm = |part: &usize| of_run.binary_search_by_key(part, |(_, part)| *part).is_ok();
            run.into_iter().for_each(|run| run.tangled.retain(|part| !is_calm(part)));
        }
    }

    /// `calm` takes the contours within one run of which is known now that they do not cross themselves, in their order.
    fn look(&self, known: &mut Known, calm: &mut Vec<PartAt>) -> View {
        let mut view = View { starts: Vec::with_capacity(self.runs.len()), ..View::default() };
        let (mut bytes, mut lines) = (0, 0);
        for run in &self.runs {
            view.starts.push((bytes, lines));
            bytes += run.bytes;
            lines += run.lines;
        }
        view.end = self.end_word();
        view.outer = self.outer_sections(view.end);
        view.last_block = self.last_block(view.end);
        self.judge_contours(&mut view);
        self.judge_crossings(&mut view, known, calm);
        self.judge_end(&mut view);
        self.judge_texts(&mut view);
        self.judge_numbers(&mut view);
        self.judge_positions(&mut view);
        view
    }

    /// The word that ends the program: the first of the controller's own, else the last that ends programs elsewhere, else a pause
    /// with no block behind it.
    fn end_word(&self) -> Option<At> {
        let place = |run: usize, entry: Option<usize>| entry.map(|entry| At { run, entry });
        let mut runs = self.runs.iter().enumerate();
        let own = runs.find_map(|(run, of)| place(run, of.own_end));
        let back = || self.runs.iter().enumerate().rev();
        let foreign = || back().find_map(|(run, of)| place(run, of.last_end));
        let pause = || {
            let last = back().find_map(|(run, of)| place(run, of.last_word))?;
            self.last_block(None).filter(|block| *block < last).map(|_| last)
        };
        own.or_else(foreign).or_else(pause)
    }

    fn last_block(&self, end: Option<At>) -> Option<At> {
        let runs = self.runs.iter().enumerate().rev().filter(|(_, run)| run.blocks > 0);
        let mut blocks = runs.flat_map(|(run, of)| {
            of.entries.iter().enumerate().rev().filter(|(_, entry)| entry.block().is_some()).map(move |(entry, _)| At { run, entry })
        });
        blocks.find(|at| end.is_none_or(|end| *at < end))
    }

    /// The blocks from a part on, up to the next word; `None` behind the end of the program.
    fn section_from(&self, start: PartAt, end: Option<At>) -> Option<Section> {
        let mut section: Option<Section> = None;
        let (mut run, mut index) = start;
        while let Some(of) = self.runs.get(run) {
            for (nth, part) in of.parts.iter().enumerate().skip(index) {
                if end.is_some_and(|end| end < At { run, entry: part.entries.start }) {
                    return section;
                }
                let own = section.get_or_insert(Section { parts: [(run, nth); 2], sum: Sum::default(), is_jump: false });
                own.parts[1] = (run, nth);
                own.sum = own.sum.then(&part.sum);
                if part.word.is_some() {
                    let is_end = end == Some(At { run, entry: part.entries.end });
                    own.is_jump = start != (0, 0) && self.is_behind_word(start) && !is_end && is_jump(&own.sum);
                    return section;
                }
            }
            (run, index) = (run + 1, 0);
        }
        section
    }

    /// Whether a word stands somewhere before a part at which a section begins.
    fn is_behind_word(&self, (run, part): PartAt) -> bool {
        part > 0 || self.runs[..run.min(self.runs.len())].iter().rev().any(|run| run.words > 0)
    }

    /// The part behind another one.
    fn part_behind(&self, (run, part): PartAt) -> PartAt {
        if self.runs.get(run).is_some_and(|of| part + 1 < of.parts.len()) { (run, part + 1) } else { (run + 1, 0) }
    }

    /// The sections that are not parts of one run.
    fn outer_sections(&self, end: Option<At>) -> Vec<Section> {
        let mut sections = Vec::new();
        let mut next = Some((0, 0));
        while let Some(section) = next.and_then(|start| self.section_from(start, end)) {
            let (run, _) = section.parts[1];
            let ends_text = self.runs.get(run).is_none_or(|of| section.parts[1].1 + 1 >= of.parts.len());
            next = self.runs.get(run).filter(|_| !ends_text).map(|of| (run, of.parts.len() - 1));
            sections.push(section);
        }
        sections
    }

    /// The section that a part belongs to.
    fn section_of_part(&self, view: &View, (run, part): PartAt) -> Option<Section> {
        let of = self.runs.get(run)?;
        if part > 0 && part + 1 < of.parts.len() {
            return self.section_from((run, part), view.end);
        }
        let index = view.outer.partition_point(|section| section.parts[1] < (run, part));
        view.outer.get(index).cloned()
    }

    fn is_jump(&self, part: PartAt) -> bool {
        self.section_of_part(&self.view, part).is_some_and(|section| section.is_jump)
    }

    fn closes(&self, view: &View, section: &Section) -> bool {
        view.open.binary_search(&section.parts[0]).is_err()
    }

    /// Sections within one run, of those that it names, up to the end of the program.
    fn inner_sections<'a>(&'a self, end: Option<At>, named: fn(&Run) -> &[usize]) -> impl Iterator<Item = Section> + 'a {
        let up_to = end.map_or(usize::MAX, |end| end.run);
        let runs = self.runs.iter().enumerate().take_while(move |(run, _)| *run <= up_to);
        runs.flat_map(move |(run, of)| named(of).iter().filter_map(move |part| self.section_from((run, *part), end)))
    }

    /// `not-closed`, and the block that is to blame where it is plain. A contour that pauses before its last piece goes on behind the pause.
    fn judge_contours(&self, view: &mut View) {
        let is_open = |section: &Section| !section.is_jump && !not_closed::is_closed(&section.sum);
        let mut candidates: Vec<Section> = self.inner_sections(view.end, |run| &run.open).filter(is_open).collect();
        candidates.extend(view.outer.iter().filter(|section| is_open(section)).cloned());
        // What would be a way to the next contour between two pauses is none before the end.
        let last =
            view.end.and_then(|end| Some((end.run, self.runs.get(end.run)?.parts.iter().position(|part| part.entries.end == end.entry)?)));
        candidates.extend(last.and_then(|last| self.section_of_part(view, last)).filter(is_open));
        candidates.sort_by_key(|section| section.parts[0]);
        candidates.dedup_by_key(|section| section.parts[0]);
        let mut behind = (0, 0);
        for section in candidates {
            if section.parts[0] < behind {
                continue;
            }
            let (mut whole, mut next) = (section.sum, self.part_behind(section.parts[1]));
            let mut closes = false;
            for _ in 0..PAUSES_WITHIN {
                let Some(more) = self.section_from(next, view.end) else { break };
                whole = whole.then(&more.sum);
                next = self.part_behind(more.parts[1]);
                closes = not_closed::is_closed(&whole);
                if closes {
                    break;
                }
            }
            if closes {
                behind = next;
            } else {
                view.open.push(section.parts[0]);
                self.judge_open(view, &section);
            }
        }
    }

    fn judge_open(&self, view: &mut View, section: &Section) {
        let Some(last) = self.last_block_of(section).filter(|_| section.sum.unread == 0) else { return };
        let is_fragment = view.end.is_none() || section.sum.blocks <= not_closed::FRAGMENT;
        let fault = not_closed::fault(&section.sum);
        let severity = if is_fragment { Severity::Information } else { fault.rule().default_severity() };
        let mut findings = vec![Finding { severity, ..finding(self.range_of(last, &view.starts), fault) }];
        let may_be_one_field = section.sum.errors == 0 && culprit::BLOCKS.contains(&section.sum.blocks) && !self.lacks_a_number(section);
        if !is_fragment && may_be_one_field {
            let blocks: Vec<&BlockEntry> = self.blocks_of(section).filter_map(|at| self.entry(at)?.block()).collect();
            if let Some((nth, fault)) = culprit::culprit(&section.sum, &blocks)
                && let Some(at) = self.blocks_of(section).nth(nth)
            {
                let spot = match fault.rule() {
                    Rule::WrongQuadrant => rules::Spot::Motion,
                    Rule::WrongCountingAxis => rules::Spot::Axis,
                    _ => rules::Spot::J,
                };
                let block = self.range_of(at, &view.starts);
                let range = fields_of(self.text.bytes(), block.clone()).map_or(block.clone(), |fields| spot.range(&fields, block));
                findings.push(finding(range, fault));
            }
        }
        view.findings.extend(findings);
    }

    /// Whether a number is left out among the numbers of a section: a block is lost then.
    fn lacks_a_number(&self, section: &Section) -> bool {
        let numbers: Vec<u32> = self.blocks_of(section).filter_map(|at| self.entry(at)?.number()).collect();
        let steps = || numbers.windows(2).map(|pair| pair[1].saturating_sub(pair[0])).filter(|step| *step > 0);
        steps().min().is_some_and(|usual| steps().any(|step| step > usual))
    }

    /// The blocks of a section in their order.
    fn blocks_of(&self, section: &Section) -> impl Iterator<Item = At> + '_ {
        let [(first_run, first_part), (last_run, last_part)] = section.parts;
        (first_run..=last_run).flat_map(move |run| {
            let entries = self.runs.get(run).map(|of| {
                let from = if run == first_run { of.parts.get(first_part).map_or(0, |part| part.entries.start) } else { 0 };
                let to = if run == last_run { of.parts.get(last_part).map_or(0, |part| part.entries.end) } else { of.entries.len() };
                (from..to).filter(move |entry| of.entries[*entry].block().is_some())
            });
            entries.into_iter().flatten().map(move |entry| At { run, entry })
        })
    }

    fn last_block_of(&self, section: &Section) -> Option<At> {
        let [(first_run, first_part), (last_run, last_part)] = section.parts;
        (first_run..=last_run).rev().find_map(|run| {
            let of = self.runs.get(run)?;
            let from = if run == first_run { of.parts.get(first_part)?.entries.start } else { 0 };
            let to = if run == last_run { of.parts.get(last_part)?.entries.end } else { of.entries.len() };
            let entry = (from..to).rev().find(|entry| of.entries.get(*entry).is_some_and(|entry| entry.block().is_some()))?;
            Some(At { run, entry })
        })
    }

    fn judge_crossings(&self, view: &mut View, known: &mut Known, calm: &mut Vec<PartAt>) {
        let mut findings = Vec::new();
        let (mut pairs, mut contours) = (0, 0);
        let tangled = self.inner_sections(view.end, |run| &run.tangled).map(Cow::Owned);
        for section in tangled.chain(view.outer.iter().map(Cow::Borrowed)) {
            contours += 1;
            if section.is_jump || !may_cross_itself(&section.sum) {
                continue;
            }
            let mark = section.sum.mark;
            let found = known.of(mark).unwrap_or_else(|| {
                let found = std::sync::Arc::new(self.crossings_in(&section, known));
                known.note(mark, &found);
                found
            });
            pairs += found.pairs;
            if found.crossings.is_empty() && !found.is_crowded {
                calm.extend(matches!(section, Cow::Owned(_)).then_some(section.parts[0]));
                continue;
            }
            for crossing in &found.crossings {
                let mut blocks = self.blocks_of(&section);
                let first = blocks.nth(crossing.first);
                let second = blocks.nth(crossing.second - crossing.first - 1);
                if let (Some(first), Some(second)) = (first, second) {
                    let from = self.range_of(first, &view.starts);
                    let fault = ProgramFault::PathCrossesItself {
                        at: [crossing.at.x / 1000.0, crossing.at.y / 1000.0],
                        other: self.text.line_of(from.start),
                    };
                    let related = vec![Place::Text { range: from }];
                    findings.push(Finding { related, ..finding(self.range_of(second, &view.starts), fault) });
                }
            }
            if let Some(last) = self.last_block_of(&section).filter(|_| found.is_crowded) {
                let fault = ProgramFault::PathOnItself { blocks: section.sum.blocks };
                findings.push(Finding { severity: Severity::Information, ..finding(self.range_of(last, &view.starts), fault) });
            }
        }
        let whole_pairs: usize = view.outer.iter().map(|section| section.parts[1].0 - section.parts[0].0).sum();
        known.tidy(pairs.max(whole_pairs), contours);
        view.findings.extend(findings);
    }

    fn crossings_in(&self, section: &Section, known: &mut Known) -> Found {
        let mut stretches: Vec<Stretch<'_>> = Vec::new();
        let mut places: Vec<(usize, Range<usize>)> = Vec::new();
        let mut start = Move::default();
        let [(first_run, first_part), (last_run, last_part)] = section.parts;
        for (run, of) in self.runs.iter().enumerate().take(last_run + 1).skip(first_run) {
            let from = if run == first_run { first_part } else { 0 };
            let to = if run == last_run { last_part + 1 } else { of.parts.len() };
            for part in of.parts.get(from..to).unwrap_or_default().iter().filter(|part| part.sum.blocks > 0) {
                let Part { bounds, near, sum, entries, .. } = part;
                stretches.push(Stretch { mark: sum.mark, blocks: sum.blocks, start, bounds: *bounds, near });
                places.push((run, entries.clone()));
                start = start.plus(sum.travel);
            }
        }
        if let [one] = &stretches[..]
            && one.near.is_empty()
        {
            return Found::default();
        }
        let pieces = |stretch: usize| {
            let entries = places.get(stretch).and_then(|(run, entries)| self.runs.get(*run)?.entries.get(entries.clone()));
            pieces_of(entries.unwrap_or_default().iter().filter_map(Entry::block))
        };
        search(&stretches, section.sum.arcs, known, &pieces)
    }

    /// `missing-end` and `text-after-end`.
    fn judge_end(&self, view: &mut View) {
        let Some(last_block) = view.last_block else { return };
        let Some(end) = view.end else {
            let blocks: usize = self.runs.iter().map(|run| run.blocks).sum();
            let fault = ProgramFault::MissingEnd { word: self.words.end.clone() };
            let severity = if blocks == 1 { Severity::Information } else { fault.rule().default_severity() };
            view.findings.push(Finding { severity, ..finding(self.range_of(last_block, &view.starts), fault) });
            return;
        };
        let behind =
            self.runs.iter().enumerate().skip(end.run).flat_map(|(run, of)| (0..of.entries.len()).map(move |entry| At { run, entry }));
        if let Some(first) = behind.into_iter().find(|at| *at > end) {
            let word = self.range_of(end, &view.starts);
            let word = String::from_utf8_lossy(self.text.bytes().get(word).unwrap_or_default()).into_owned();
            let fault = ProgramFault::TextAfterEnd { word };
            view.findings.push(finding(self.range_of(first, &view.starts), fault));
        }
    }

    /// Text that is no block is a heading before the first block, a fault between blocks.
    fn judge_texts(&self, view: &mut View) {
        let first_block = self.runs.iter().enumerate().find(|(_, run)| run.blocks > 0).and_then(|(run, of)| {
            let entry = of.entries.iter().position(|entry| entry.block().is_some())?;
            Some(At { run, entry })
        });
        let mut findings = Vec::new();
        let texts = self.runs.iter().enumerate().filter(|(_, run)| run.texts > 0).flat_map(|(run, of)| {
            of.entries.iter().enumerate().filter_map(move |(entry, what)| match what.what {
                What::Text { column } => Some((At { run, entry }, column)),
                _ => None,
            })
        });
        let has_fault = self.runs.iter().any(|run| !run.faults.is_empty());
        for (at, column) in texts {
            let range = self.range_of(at, &view.starts);
            let is_fault = match (first_block, view.end) {
                (Some(first), end) => first < at && end.is_none_or(|end| at < end),
                // One sentence for a text that is no program at all.
                (None, _) => !has_fault && findings.is_empty() && view.end.is_none(),
            };
            if is_fault {
                let fault = unexpected(self.text.bytes(), range.clone(), column);
                findings.push(syntax(range, fault.sentence()));
            }
        }
        view.findings.extend(findings);
    }

    fn judge_numbers(&self, view: &mut View) {
        let numbering = self.runs.iter().fold(Numbering::Empty, |before, run| before.then(run.numbering));
        if numbering != Numbering::Irregular || self.runs.iter().all(|run| run.numbered == 0) {
            return;
        }
        let end = view.end;
        let runs = || 0..end.map_or(self.runs.len(), |end| end.run + 1);
        let from = |run: usize| (run..runs().end).flat_map(|run| self.numbered_in(run, end));
        let head: Vec<Numbered> = from(0).map(|(_, block)| block).take(block_number::FIRST).collect();
        let first = runs().filter(|run| self.runs[*run].numbered > 0).flat_map(|run| self.numbered_in(run, end));
        let first = first.into_iter().find_map(|(_, block)| block.number);
        let Some(mut sequence) = Sequence::of(&head, first) else { return };
        for run in runs() {
            // A run in which the numbers go on as before is not walked through.
            let regular = match self.runs[run].numbering {
                Numbering::Regular { first, last, step } if end.is_none_or(|end| run < end.run) => Some((first, last, step)),
                _ => None,
            };
            let count = self.runs[run].numbered;
            if regular.is_some_and(|(first, last, step)| sequence.skip(first, last, step, count)) {
                continue;
            }
            let mut blocks = self.numbered_in(run, end).peekable();
            let mut is_first = true;
            while let Some((at, block)) = blocks.next() {
                let next = blocks.peek().copied().or_else(|| from(run + 1).next());
                sequence.push(&block, next.map(|(_, next)| next).as_ref(), at);
                let rest = regular.filter(|_| std::mem::take(&mut is_first) && count > 1);
                if rest.is_some_and(|(first, last, step)| sequence.skip(first + step, last, step, count - 1)) {
                    break;
                }
            }
        }
        for (at, fault, _) in sequence.found() {
            view.findings.push(finding(self.range_of(at, &view.starts), fault));
        }
    }

    /// Blocks and numbered words up to the end, with their numbers.
    fn numbered(&self, end: Option<At>) -> (Vec<At>, Vec<Numbered>) {
        (0..self.runs.len()).flat_map(|run| self.numbered_in(run, end)).unzip()
    }

    /// Those of one run.
    fn numbered_in(&self, run: usize, end: Option<At>) -> impl Iterator<Item = (At, Numbered)> + '_ {
        let entries = self.runs.get(run).map_or(&[][..], |of| &of.entries[..]);
        let is_word = |entry: &Entry| matches!(entry.what, What::Word { .. });
        let mut is_after_pause = None;
        entries.iter().enumerate().filter_map(move |(entry, what)| {
            let follows_word = is_after_pause.unwrap_or_else(|| {
                let before = self.runs[..run].iter().rev().find_map(|of| of.entries.last());
                before.is_some_and(is_word)
            });
            is_after_pause = Some(is_word(what));
            let at = At { run, entry };
            let (number, is_unread) = (what.number(), what.what == What::Unread);
            let counts = what.block().is_some() || is_unread || (is_word(what) && number.is_some());
            let is_in_program = end.is_none_or(|end| at <= end);
            (counts && is_in_program).then_some((at, Numbered { number, is_after_pause: follows_word, is_unread }))
        })
    }

    fn judge_positions(&self, view: &mut View) {
        let mut anchor = None;
        let (mut compared, mut ordinal) = (0, 0);
        let mut off: Vec<(usize, At, [f64; 2])> = Vec::new();
        for (run, of) in self.runs.iter().enumerate() {
            let positions = &of.positions;
            if let (Some(before), Some((entry, stated, travel))) = (&anchor, &positions.first) {
                compared += 1;
                off.extend(position_mismatch::mismatch(before, travel, stated).map(|by| (ordinal, At { run, entry: *entry }, by)));
            }
            compared += positions.compared;
            off.extend(positions.off.iter().map(|(nth, entry, by)| (ordinal + nth, At { run, entry: *entry }, *by)));
            ordinal += of.blocks;
            anchor = positions.anchor.unwrap_or(anchor);
        }
        if off.len() > 2 && off.len() as f64 > position_mismatch::FOREIGN * compared as f64 {
            return;
        }
        let mut before: Option<(usize, [f64; 2])> = None;
        for (ordinal, at, [x, y]) in off {
            // One end point that is off on its own is off once there and once back.
            let goes_back = before.is_some_and(|(last, [a, b])| last + 1 == ordinal && (a + x).abs() <= 4.0 && (b + y).abs() <= 4.0);
            before = (!goes_back).then_some((ordinal, [x, y]));
            if !goes_back {
                view.findings.push(finding(self.range_of(at, &view.starts), ProgramFault::PositionMismatch { x, y }));
            }
        }
    }

    // Findings and fixes.

    /// All findings as the reader and the rules see them, in no order.
    pub fn findings(&self) -> Vec<Finding> {
        let of_blocks = self.locals().map(|(run, local)| self.materialized(run, local));
        of_blocks.chain(self.view.findings.iter().cloned()).collect()
    }

    /// At most `limit` findings under the settings' severities, errors first, then in the order of the text; and how many there are.
    pub fn findings_under(&self, settings: &Effective, limit: usize) -> (Vec<Finding>, usize) {
        let severity = |rule: Rule, own: Severity| settings.severity_over(rule, own);
        let mut order: Vec<(Severity, usize, Kept)> = Vec::new();
        for (run, of) in self.runs.iter().enumerate().filter(|(_, of)| !of.faults.is_empty()) {
            for (index, local) in of.faults.iter().enumerate().filter(|(_, local)| self.counts(run, local)) {
                if let Some(severity) = severity(local.rule, self.own_severity(run, local)) {
                    order.push((severity, local.range.start + self.base(run), Kept::InBlock { run, index }));
                }
            }
        }
        for (index, finding) in self.view.findings.iter().enumerate() {
            if let (Some(severity), Place::Text { range }) = (severity(finding.rule, finding.severity), &finding.place) {
                order.push((severity, range.start, Kept::OnWhole { index }));
            }
        }
        order.sort_by_key(|(severity, start, _)| (*severity, *start));
        let count = order.len();
        order.truncate(limit);
        let made = order.into_iter().filter_map(|(severity, _, which)| {
            let finding = match which {
                Kept::InBlock { run, index } => self.materialized(run, self.runs.get(run)?.faults.get(index)?),
                Kept::OnWhole { index } => self.view.findings.get(index)?.clone(),
            };
            Some(Finding { severity, ..finding })
        });
        (made.collect(), count)
    }

    fn locals(&self) -> impl Iterator<Item = (usize, &Local)> {
        let all = self.runs.iter().enumerate().flat_map(|(run, of)| of.faults.iter().map(move |local| (run, local)));
        all.filter(|(run, local)| self.counts(*run, local))
    }

    fn section_of_local(&self, run: usize, local: &Local) -> Option<Section> {
        self.section_of_part(&self.view, (run, local.part))
    }

    fn is_unusual_only(&self, run: usize, local: &Local) -> bool {
        local.counts == Counts::MildIfClosed && self.section_of_local(run, local).is_none_or(|section| self.closes(&self.view, &section))
    }

    fn own_severity(&self, run: usize, local: &Local) -> Severity {
        if self.is_unusual_only(run, local) { Severity::Information } else { local.rule.default_severity() }
    }

    fn counts(&self, run: usize, local: &Local) -> bool {
        let section = || self.section_of_local(run, local);
        match local.counts {
            Counts::Always | Counts::MildIfClosed => true,
            Counts::IfOpen => section().is_some_and(|section| !self.closes(&self.view, &section)),
            Counts::IfInside { turns_left } => section().is_some_and(|section| {
                let runs_left = section.sum.twice_area > 0.0;
                let wire_is_inside = self.limits.side == SideSetting::Opening;
                (runs_left == wire_is_inside) == turns_left
            }),
        }
    }

    fn materialized(&self, run: usize, local: &Local) -> Finding {
        let base = self.base(run);
        let block = local.range.start + base..local.range.end + base;
        let range = match local.spot {
            rules::Spot::Block => block,
            spot => fields_of(self.text.bytes(), block.clone()).map_or(block.clone(), |fields| spot.range(&fields, block)),
        };
        let detail = match &local.detail {
            Detail::Program(fault) if self.is_unusual_only(run, local) => Detail::Program(Box::new(fault.as_unusual())),
            detail => detail.clone(),
        };
        let severity = self.own_severity(run, local);
        Finding { rule: local.rule, severity, place: Place::Text { range }, detail, related: Vec::new() }
    }

    /// The fixes of one finding, the preferred one first.
    pub fn fixes(&self, finding: &Finding) -> Vec<TextFix> {
        let Place::Text { range } = &finding.place else { return Vec::new() };
        let fault = match &finding.detail {
            Detail::Program(fault) => fault,
            Detail::Syntax(_) => return self.letter_fixes(range),
            _ => return Vec::new(),
        };
        match &**fault {
            ProgramFault::MissingEnd { word } => missing_end::fixes(&self.text, range.end, word),
            ProgramFault::TextAfterEnd { .. } => match self.view.end {
                Some(end) => text_after_end::fixes(&self.text, self.range_of(end, &self.view.starts).start),
                None => Vec::new(),
            },
            ProgramFault::NotClosed { .. } => self.closing_fixes(range),
            ProgramFault::DoubledNumber { .. } | ProgramFault::NumberOutOfOrder { .. } | ProgramFault::Unnumbered { .. } => {
                self.number_fixes(range)
            }
            ProgramFault::PositionMismatch { .. } => self.position_fixes(range).unwrap_or_default(),
            fault => self.block_fixes(range, fault),
        }
    }

    fn position_fixes(&self, range: &Range<usize>) -> Option<Vec<TextFix>> {
        let (at, entry) = self.block_at(range)?;
        let own = self.range_of(at, &self.view.starts);
        let stated = entry.stated_end()?;
        let before = self.stated_before(at)?;
        let next = self.next_block(at).and_then(|next| Some((next.stated_end()?, next.travel)));
        let goes_on = next.map(|(end, travel)| position_mismatch::mismatch(&stated, &travel, &end).is_none());
        let line = self.text.line_range(self.text.line_of(own.start));
        let is_behind = |piece: &&Piece| piece.field == Field::Coordinates && line.start + piece.range.start >= own.end;
        let pieces = pieces(self.text.bytes().get(line.clone())?, &self.words());
        let coordinates = pieces.iter().find(is_behind).map(|piece| line.start + piece.range.start..line.start + piece.range.end)?;
        let section = self.section_of(at)?;
        Some(position_mismatch::fixes(&Mismatched {
            text: self.text.bytes(),
            block: entry.block,
            fields: fields_of(self.text.bytes(), own)?,
            coordinates,
            before,
            stated,
            goes_on,
            closes: self.closes(&self.view, &section),
            closes_with: &|blocks| self.closes_with(at, entry, blocks),
        }))
    }

    /// The coordinates that stand behind the block before, or those of the start.
    fn stated_before(&self, at: At) -> Option<StatedPoint> {
        (0..=at.run).rev().find_map(|run| {
            let of = self.runs.get(run)?;
            let end = if run == at.run { at.entry } else { of.entries.len() };
            of.entries.get(..end)?.iter().rev().find_map(|entry| match &entry.what {
                What::Block(block) => Some(block.stated_end()),
                What::StartPoint(at) => Some(Some(StatedPoint { at: *at, decimals: 3 })),
                What::Unread => Some(None),
                What::Word { .. } | What::Text { .. } => None,
            })
        })?
    }

    fn next_block(&self, at: At) -> Option<&BlockEntry> {
        self.runs.iter().enumerate().skip(at.run).find_map(|(run, of)| {
            let from = if run == at.run { at.entry + 1 } else { 0 };
            of.entries.get(from..)?.iter().find_map(Entry::block)
        })
    }

    /// The block that a range lies in or before.
    fn block_at(&self, range: &Range<usize>) -> Option<(At, &BlockEntry)> {
        let run = self.run_at(range.start);
        let of = self.runs.get(run)?;
        let local = range.start.checked_sub(self.base(run))?;
        let entry = of.entries.partition_point(|entry| entry.range().end <= local);
        Some((At { run, entry }, of.entries.get(entry)?.block()?))
    }

    fn section_of(&self, at: At) -> Option<Section> {
        let part = self.runs.get(at.run)?.parts.partition_point(|part| part.entries.end <= at.entry);
        self.section_of_part(&self.view, (at.run, part))
    }

    fn block_fixes(&self, range: &Range<usize>, fault: &ProgramFault) -> Vec<TextFix> {
        let Some((at, entry)) = self.block_at(range) else { return Vec::new() };
        let own = self.range_of(at, &self.view.starts);
        // A number that stands before the block belongs to it.
        let block = if matches!(fault, ProgramFault::BlockNumberAsB { .. }) { range.clone() } else { own.clone() };
        let Some(fields) = fields_of(self.text.bytes(), own) else { return Vec::new() };
        let line = self.text.line_of(block.start);
        let site = Site {
            text: self.text.bytes(),
            range: if matches!(fault, ProgramFault::MissingB) { range.clone() } else { block },
            line: self.text.line_start(line)..self.text.line_start(line + 1),
            fields,
            block: entry.block,
            largest: self.limits.largest(),
            closes_with: &|blocks| self.closes_with(at, entry, blocks),
        };
        rules::fixes(&site, fault)
    }

    /// Whether the contour of a block closes with other blocks in its place.
    fn closes_with(&self, at: At, entry: &BlockEntry, blocks: &[Block]) -> bool {
        let Some(section) = self.section_of(at) else { return false };
        let new = blocks.iter().map(travel_of).fold(Move::default(), Move::plus);
        let mut sum = Sum { travel: section.sum.travel.minus(entry.travel).plus(new), ..section.sum };
        if self.blocks_of(&section).next() == Some(at) {
            sum.first = blocks.first().map(travel_of).or(sum.first);
        }
        if self.last_block_of(&section) == Some(at) {
            sum.last = blocks.last().map(travel_of).or(sum.last);
        }
        section.sum.blocks >= 3 && not_closed::is_closed(&sum)
    }

    /// A straight block that closes the contour.
    fn closing_fixes(&self, range: &Range<usize>) -> Vec<TextFix> {
        let Some((at, _)) = self.block_at(range) else { return Vec::new() };
        let Some(section) = self.section_of(at) else { return Vec::new() };
        let [x, y] = not_closed::gap(&section.sum).map(|um| um.round() as i64);
        let largest = self.limits.largest();
        if x.abs().max(y.abs()) > largest || (x, y) == (0, 0) {
            return Vec::new();
        }
        let block = line_block(Node { x: 0, y: 0 }, Node { x, y });
        let own = self.text.bytes().get(range.clone()).unwrap_or_default();
        let layout = if own.contains(&b' ') { Layout::Aligned } else { Layout::Compact };
        let mut text = missing_end::line_end_of(&self.text).as_bytes().to_vec();
        if let Some(number) = self.number_behind(at) {
            text.extend_from_slice(format!("N{number} ").as_bytes());
        }
        push_fields(&mut text, layout, &block, None);
        let behind = self.text.line_range(self.text.line_of(range.start)).end;
        let Ok(text) = String::from_utf8(text) else { return Vec::new() };
        let length = (x as f64).hypot(y as f64) / 1000.0;
        let edit = vec![TextEdit { range: behind..behind, text }];
        vec![crate::finding::Fix { kind: FixKind::Close { length }, preferred: true, in_fix_all: false, edit }]
    }

    /// The number that a block behind another one has, where the two before it are numbered.
    fn number_behind(&self, at: At) -> Option<u32> {
        let own = self.entry(at)?.number()?;
        let before = (0..=at.run).rev().find_map(|run| {
            let of = self.runs.get(run)?;
            let end = if run == at.run { at.entry } else { of.entries.len() };
            of.entries.get(..end)?.iter().rev().find(|entry| entry.block().is_some())
        });
        own.checked_add(own.checked_sub(before?.number()?).filter(|step| *step > 0)?)
    }

    fn number_fixes(&self, range: &Range<usize>) -> Vec<TextFix> {
        let (places, blocks) = self.numbered(self.view.end);
        let found = block_number::look(&blocks);
        let Some((index, _, meant)) =
            found.into_iter().find(|(index, ..)| places.get(*index).is_some_and(|at| self.range_of(*at, &self.view.starts) == *range))
        else {
            return Vec::new();
        };
        let mut fixes = Vec::new();
        if let Some(meant) = meant
            && let Some(edit) = places.get(index).map(|at| self.number_edit(*at, meant))
        {
            fixes.push(crate::finding::Fix {
                kind: FixKind::SetNumber { number: meant },
                preferred: true,
                in_fix_all: true,
                edit: vec![edit],
            });
        }
        let numbers = || blocks.iter().filter_map(|block| block.number);
        if let (Some(first), Some(second)) = (numbers().next(), numbers().nth(1)) {
            let step = second.saturating_sub(first).max(1);
            let edit = places.iter().enumerate().filter_map(|(index, at)| {
                let number = first.saturating_add(step.saturating_mul(u32::try_from(index).ok()?));
                (self.entry(*at)?.number() != Some(number)).then(|| self.number_edit(*at, number))
            });
            let edit: Vec<TextEdit> = edit.collect();
            fixes.push(crate::finding::Fix {
                kind: FixKind::Renumber { first, step },
                preferred: fixes.is_empty(),
                in_fix_all: false,
                edit,
            });
        }
        fixes
    }

    /// Writes the number of a block or word, in the place of the one that it has.
    fn number_edit(&self, at: At, number: u32) -> TextEdit {
        let range = self.range_of(at, &self.view.starts);
        let has_number = self.entry(at).is_some_and(|entry| entry.number().is_some());
        let line = self.text.line_range(self.text.line_of(range.start));
        let before = self.text.bytes().get(line.start..range.start).unwrap_or_default();
        let digits_end = before.iter().rposition(u8::is_ascii_digit).map_or(0, |last| last + 1);
        let digits_start = before[..digits_end].iter().rposition(|byte| !byte.is_ascii_digit()).map_or(0, |last| last + 1);
        if has_number && digits_end > 0 {
            // Padding is kept as wide as it was.
            let width = digits_end - digits_start;
            let padded = before.get(digits_start) == Some(&b'0');
            let text = if padded { format!("{number:0width$}") } else { number.to_string() };
            return TextEdit { range: line.start + digits_start..line.start + digits_end, text };
        }
        TextEdit { range: range.start..range.start, text: format!("N{number} ") }
    }

    fn letter_fixes(&self, range: &Range<usize>) -> Vec<TextFix> {
        match self.text.bytes().get(range.clone()) {
            Some(b"O" | b"o") => {
                let edit = vec![TextEdit { range: range.clone(), text: "0".into() }];
                vec![crate::finding::Fix { kind: FixKind::ZeroForO, preferred: true, in_fix_all: true, edit }]
            }
            _ => Vec::new(),
        }
    }

    // The way.

    /// Where the machine goes, block by block, up to the end word.
    pub fn trace(&self) -> Trace {
        let mut trace = Trace::default();
        let mut walk = self.walk();
        (trace.start, trace.start_is_known) = (walk.at, walk.start_is_known);
        for run in 0..self.runs.len() {
            walk.run(run, |_| true, &mut |step| trace.steps.push(step));
        }
        trace
    }

    /// The steps whose text overlaps or touches a range of bytes.
    pub fn steps_in(&self, range: Range<usize>) -> Vec<Step> {
        let (first, last) = (self.run_at(range.start), self.run_at(range.end));
        let mut walk = self.walk();
        (0..first).for_each(|run| walk.skip(run));
        let mut steps = Vec::new();
        for run in first..=last {
            walk.run(run, |bytes| bytes.start <= range.end && range.start <= bytes.end, &mut |step| steps.push(step));
        }
        steps
    }

    /// The blocks whose text overlaps or touches a range of bytes, as they stand there.
    pub fn blocks_in(&self, range: Range<usize>) -> Vec<PlacedBlock> {
        let mut blocks = Vec::new();
        for run in self.run_at(range.start)..=self.run_at(range.end) {
            let (Some(of), (base, first_line)) = (self.runs.get(run), self.view.starts.get(run).copied().unwrap_or_default()) else {
                continue;
            };
            for entry in &of.entries {
                let own = entry.range().start + base..entry.range().end + base;
                if let Some(block) = entry.block().filter(|_| own.start <= range.end && range.start <= own.end) {
                    let (line, number) = (first_line + entry.line as usize, entry.number());
                    let (part, stated_end) = (block.part(), block.stated_end().map(|stated| stated.at));
                    blocks.push(PlacedBlock { range: own, line, number, block: block.block, part, stated_end });
                }
            }
        }
        blocks
    }

    /// The blocks between two words of which one touches a byte, by their ends, and the number of that one among them.
    pub fn chain_at(&self, offset: usize) -> Option<(Chain<'static>, usize)> {
        let at = self.block_touching(offset)?;
        let section = self.section_of(at)?;
        let nth = self.count_before(&section, at);
        Some((self.chain(&section, None)?, nth))
    }

    /// The blocks from the last word on that stand before a byte, by their ends; `None` where there is none.
    pub fn chain_before(&self, offset: usize) -> Option<Chain<'static>> {
        let run = self.run_at(offset);
        let local = offset.saturating_sub(self.base(run));
        let entries = &self.runs.get(run)?.entries;
        let behind = At { run, entry: entries.partition_point(|entry| entry.range().end <= local) };
        if self.view.end.is_some_and(|end| end < behind) {
            return None;
        }
        let parts = &self.runs.get(run)?.parts;
        let part = parts.partition_point(|part| part.entries.end < behind.entry).min(parts.len().saturating_sub(1));
        self.chain(&self.section_of_part(&self.view, (run, part))?, Some(behind))
    }

    /// The first word behind a byte, up to the end of the program.
    pub fn word_behind(&self, offset: usize) -> Option<Range<usize>> {
        let first = self.run_at(offset);
        let words =
            self.runs.iter().enumerate().skip(first).flat_map(|(run, of)| {
                of.parts.iter().filter(|part| part.word.is_some()).map(move |part| At { run, entry: part.entries.end })
            });
        let found = words.map(|at| self.range_of(at, &self.view.starts)).find(|range| range.start > offset)?;
        let is_over = self.view.end.is_some_and(|end| self.range_of(end, &self.view.starts).start < found.start);
        (!is_over).then_some(found)
    }

    pub fn first_block(&self) -> Option<Range<usize>> {
        let run = self.runs.iter().position(|run| run.blocks > 0)?;
        let entry = self.runs[run].entries.iter().position(|entry| entry.block().is_some())?;
        Some(self.range_of(At { run, entry }, &self.view.starts))
    }

    /// Where the program begins, µm: the origin where it does not say.
    pub fn start(&self) -> Point {
        self.walk().at
    }

    fn block_touching(&self, offset: usize) -> Option<At> {
        // Of two that touch the byte the one that begins there.
        let touches = |at: &At| {
            let range = self.range_of(*at, &self.view.starts);
            range.start <= offset && offset <= range.end
        };
        let run = self.run_at(offset);
        let entries = self.runs.get(run)?.entries.iter().enumerate().filter(|(_, entry)| entry.block().is_some());
        let is_in_program = |at: &At| self.view.end.is_none_or(|end| *at < end);
        entries.map(|(entry, _)| At { run, entry }).rfind(|at| touches(at) && is_in_program(at))
    }

    /// Blocks of a section before one of its entries.
    fn count_before(&self, section: &Section, at: At) -> usize {
        let mut count = 0;
        for run in section.parts[0].0..=at.run {
            let Some(of) = self.runs.get(run) else { break };
            let parts = if run == section.parts[0].0 { section.parts[0].1.. } else { 0.. };
            for part in of.parts.get(parts).unwrap_or_default() {
                if (At { run, entry: part.entries.end }) <= at {
                    count += part.sum.blocks;
                } else if (At { run, entry: part.entries.start }) <= at {
                    let before = of.entries.get(part.entries.start..at.entry.min(part.entries.end));
                    count += before.unwrap_or_default().iter().filter(|entry| entry.block().is_some()).count();
                }
            }
        }
        count
    }

    /// The blocks of a section, up to an entry where one is named, by their ends.
    fn chain(&self, section: &Section, until: Option<At>) -> Option<Chain<'static>> {
        let end = until.unwrap_or(At { run: usize::MAX, entry: 0 });
        let [(first_run, first_part), (last_run, last_part)] = section.parts;
        // Entries of the section in a run, as far as they count.
        let entries = |run: usize| -> Range<usize> {
            let Some(of) = self.runs.get(run) else { return 0..0 };
            let from = if run == first_run { of.parts.get(first_part).map_or(0, |part| part.entries.start) } else { 0 };
            let to = if run == last_run { of.parts.get(last_part).map_or(0, |part| part.entries.end) } else { of.entries.len() };
            let to = if run == end.run { to.min(end.entry) } else { to };
            from..to.max(from)
        };
        let last_run = last_run.min(end.run);
        let blocks_in = |run: usize| {
            let of = self.runs.get(run).map_or(&[][..], |of| &of.entries[..]);
            of.get(entries(run)).unwrap_or_default().iter().filter_map(Entry::block)
        };
        let is_whole = |run: usize| run != first_run && run != last_run;
        let (mut count, mut arcs, mut travel) = (0, 0, Move::default());
        for run in first_run..=last_run {
            match self.runs.get(run).filter(|of| is_whole(run) && of.parts.len() == 1) {
                Some(of) => {
                    let sum = &of.parts[0].sum;
                    (count, arcs, travel) = (count + sum.blocks, arcs + sum.arcs, travel.plus(sum.travel));
                }
                None => blocks_in(run).for_each(|block| {
                    (count, arcs, travel) = (count + 1, arcs + usize::from(!block.is_line()), travel.plus(block.travel));
                }),
            }
        }
        // Runs that hold the first and the last blocks.
        let (mut head_end, mut held) = (first_run, 0);
        while head_end <= last_run && held < Chain::ENDS {
            held += blocks_in(head_end).count();
            head_end += 1;
        }
        let (mut tail_start, mut held) = (last_run + 1, 0);
        while tail_start > head_end && held < Chain::ENDS {
            tail_start -= 1;
            held += blocks_in(tail_start).count();
        }
        let mut walk = self.walk();
        (0..first_run).for_each(|run| walk.skip(run));
        let steps_of = |runs: Range<usize>, walk: &mut Walk<'_>| {
            let mut steps = Vec::new();
            for run in runs {
                let own = entries(run);
                walk.run(run, |_| true, &mut |step| steps.push((run, step)));
                let range = |entry: usize| self.range_of(At { run, entry }, &self.view.starts);
                let (from, to) = (range(own.start).start, own.end.checked_sub(1).map_or(0, |last| range(last).end));
                steps.retain(|(of, step)| {
                    *of != run || (step.moves() && step.range.start >= from && step.range.end <= to && !own.is_empty())
                });
            }
            steps.into_iter().map(|(_, step)| step).collect::<Vec<Step>>()
        };
        let head = steps_of(first_run..head_end.max(first_run), &mut walk);
        (head_end..tail_start).for_each(|run| walk.skip(run));
        let tail = steps_of(tail_start..(last_run + 1).max(tail_start), &mut walk);
        let [x, y] = travel.meant_um();
        (count > 0).then(|| Chain::by_ends(head, tail, (count, arcs), Vector::new(x, y)))
    }

    fn walk(&self) -> Walk<'_> {
        let mut starts = self.runs.iter().take_while(|run| run.blocks == 0).chain(self.runs.iter().find(|run| run.blocks > 0));
        let start = starts.find_map(|run| {
            run.entries.iter().take_while(|entry| entry.block().is_none()).find_map(|entry| match entry.what {
                What::StartPoint(at) => Some(at),
                _ => None,
            })
        });
        let [x, y] = start.unwrap_or([0.0, 0.0]).map(|mm| (mm * 1000.0).round());
        Walk { document: self, at: Point::new(x, y), start_is_known: start.is_some(), section: 0 }
    }
}

/// The machine on its way through the program.
struct Walk<'a> {
    document: &'a Document,
    at: Point,
    start_is_known: bool,
    section: usize,
}

impl Walk<'_> {
    /// Goes through a run, and hands out the steps whose bytes are `wanted`.
    fn run(&mut self, index: usize, wanted: impl Fn(&Range<usize>) -> bool, each: &mut dyn FnMut(Step)) {
        let document = self.document;
        let Some(run) = document.runs.get(index) else { return };
        let (base, first_line) = document.view.starts.get(index).copied().unwrap_or_default();
        let mut part = 0;
        let mut is_jump = document.is_jump((index, 0));
        for (entry_index, entry) in run.entries.iter().enumerate() {
            let at = At { run: index, entry: entry_index };
            if document.view.end.is_some_and(|end| at > end) {
                return;
            }
            let range = entry.range().start + base..entry.range().end + base;
            let (line, number, contour, start) = (first_line + entry.line as usize, entry.number(), self.section, self.at);
            match &entry.what {
                What::Block(block) => {
                    let [x, y] = block.travel.machine;
                    let end = start + Vector::new(x as f64, y as f64);
                    self.at = end;
                    if wanted(&range) {
                        let kind = match block.is_line() {
                            _ if is_jump => Kind::Rapid,
                            true => Kind::Line,
                            false => Kind::Arc,
                        };
                        each(Step { range, line, number, kind, start, end, ideal: meant(&block.block, start), contour });
                    }
                }
                What::Word { .. } => {
                    let kind = if document.view.end == Some(at) { Kind::End } else { Kind::Pause };
                    if wanted(&range) {
                        each(Step { range, line, number, kind, start, end: start, ideal: None, contour });
                    }
                    self.section += 1;
                    part += 1;
                    is_jump = document.is_jump((index, part));
                }
                What::StartPoint(_) | What::Text { .. } | What::Unread => {}
            }
        }
    }

    /// Goes through a run without a look.
    fn skip(&mut self, index: usize) {
        let Some(run) = self.document.runs.get(index) else { return };
        if self.document.view.end.is_some_and(|end| end.run <= index) {
            return self.run(index, |_| false, &mut |_| {});
        }
        let [x, y] = run.travel.machine;
        self.at += Vector::new(x as f64, y as f64);
        self.section += run.words;
    }
}

fn run_of(text: &SourceText, lines: Range<usize>, words: &Words<'_>, limits: &Limits) -> Run {
    let whole = text.line_start(lines.start)..text.line_start(lines.end);
    Run::read(text.bytes(), whole, lines.map(|line| text.line_range(line)), words, limits)
}

fn finding(range: Range<usize>, fault: ProgramFault) -> Finding {
    Finding {
        rule: fault.rule(),
        severity: fault.rule().default_severity(),
        place: Place::Text { range },
        detail: Detail::Program(Box::new(fault)),
        related: Vec::new(),
    }
}

fn syntax(range: Range<usize>, sentence: String) -> Finding {
    Finding {
        rule: Rule::Syntax,
        severity: Rule::Syntax.default_severity(),
        place: Place::Text { range },
        detail: Detail::Syntax(sentence),
        related: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::language::{Passage, passage_at, passages};
    use proptest::prelude::*;

    /// Findings in one order, whatever runs the lines lie in.
    fn sorted(document: &Document) -> Vec<String> {
        let mut findings: Vec<String> = document.findings().iter().map(|finding| format!("{finding:?}")).collect();
        findings.sort();
        findings
    }

    fn assert_is_fresh(document: &Document) -> Result<(), TestCaseError> {
        let fresh = Document::read(document.text().bytes().to_vec());
        prop_assert_eq!(document.text(), fresh.text());
        prop_assert_eq!(sorted(document), sorted(&fresh));
        prop_assert_eq!(document.trace(), fresh.trace());
        let all = 0..document.text().len();
        prop_assert_eq!(document.steps_in(all.clone()), fresh.steps_in(all));
        Ok(())
    }

    const PROGRAM: &str = "(((N[0-9] )?B[0-9]{1,4}B[0-9]{1,4}B[0-9]{1,5}G[XY](L|SR|NR)[1-4]( ; [0-9]\\.[0-9]{3} , 1\\.0)?|BxB|[;DN1 ]|DD|D|E|text|Start Point = 1 , 2)(\r\n|\n|\r)){0,40}";
    /// Closed ones, one that crosses itself, and the way between two.
    const CONTOURS: [&str; 4] = [
        "B9000B0B9000GXL1\nB0B9000B9000GYL2\nB9000B0B9000GXL3\nB0B9000B9000GYL4\nD\n",
        "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nD\n",
        "B900B0B900GXL1\nB900B900B900GYL1\nB900B0B900GXL3\nB900B900B900GXL4\nB900B0B900GXL3\nB0B50B50GYL2\nB0B50B50GYL4\nD\n",
        "B50000B0B50000GXL1\nD\n",
    ];
    const REPLACEMENT: &str = "(((N[0-9] )?B[0-9]{1,4}B[0-9]{1,4}B[0-9]{1,5}G[XY](L|SR|NR)[1-4]( ; [0-9]\\.[0-9]{3} , 1\\.0)?|BxB|[;DN1 ]|DD|D|E|text|Start Point = 1 , 2)|\r|\n| |7){0,3}";

    proptest! {
        #[test]
        fn an_edited_document_is_the_one_read_afresh(
            text in PROGRAM,
            copies in 1_usize..12,
            edits in prop::collection::vec((0_usize..4000, 0_usize..60, REPLACEMENT), 1..6),
        ) {
            // More lines than one run holds.
            let mut document = Document::read(text.repeat(copies).into_bytes());
            for (start, length, replacement) in edits {
                document.edit(start..start + length, &replacement);
                assert_is_fresh(&document)?;
            }
        }

        #[test]
        fn an_edit_among_sound_contours_leaves_them_as_read_afresh(
            contours in prop::collection::vec(prop::sample::select(CONTOURS.to_vec()), 1..60),
            (is_numbered, restarts) in (any::<bool>(), any::<bool>()),
            edits in prop::collection::vec((0_usize..9000, 0_usize..3, prop::sample::select(vec!["", "7", "1", "\n", "D\n", "DD\n", "N3 "])), 1..6),
        ) {
            let mut number = 0;
            let line = |line: &str| {
                number = if line == "D" && restarts { 0 } else { number + u32::from(line != "D") };
                if is_numbered && line != "D" { format!("N{number} {line}\n") } else { format!("{line}\n") }
            };
            let text: String = contours.concat().lines().map(line).collect();
            let mut document = Document::read((text + "DD\n").into_bytes());
            for (start, length, replacement) in edits {
                document.edit(start..start + length, replacement);
                assert_is_fresh(&document)?;
            }
        }

        #[test]
        fn steps_of_a_range_are_those_of_the_whole(
            text in PROGRAM,
            (start, length) in (0_usize..600, 0_usize..200),
        ) {
            let document = Document::read(text.repeat(6).into_bytes());
            let range = start..start + length;
            let touches = |step: &Step| step.range.start <= range.end && range.start <= step.range.end;
            let whole: Vec<Step> = document.trace().steps.into_iter().filter(touches).collect();
            prop_assert_eq!(document.steps_in(range.clone()), whole);
        }

        #[test]
        fn what_a_chain_tells_by_its_ends_is_what_all_its_steps_tell(
            text in PROGRAM,
            (leads, rounds) in (0_usize..4, 0_usize..100),
        ) {
            // A contour of more blocks than a chain holds, with ways in and out.
            let way = 100 * rounds;
            let long = format!(
                "{}{}B0B50B50GYL4\nB{way}B0B{way}GXL3\nB0B50B50GYL2\n{}",
                "B100B0B100GXL1\n".repeat(leads),
                "B50B0B50GXL1\nB0B50B50GYL2\nB50B0B50GXL1\nB0B50B50GYL4\n".repeat(rounds),
                "B100B0B100GXL3\n".repeat(leads),
            );
            let document = crate::program::Document::ThreeB(Document::read(format!("{text}{long}D\n{text}").into_bytes()));
            let trace = document.trace();
            let all = passages(&trace);
            for (index, step) in trace.steps.iter().enumerate().filter(|(index, step)| step.moves() && index % 13 == 0) {
                let whole = all.iter().find(|passage| passage.steps.contains(&index)).cloned();
                let Some(whole) = whole else { return Err(TestCaseError::fail("no passage")) };
                let Some((chain, passage, nth)) = passage_at(&document, step.range.start) else {
                    return Err(TestCaseError::fail("no chain"));
                };
                prop_assert_eq!(nth + whole.steps.start, index);
                prop_assert_eq!(chain.step(nth).is_none_or(|held| held == step), true);
                let offset = whole.steps.start;
                prop_assert_eq!(Passage { steps: passage.steps.start + offset..passage.steps.end + offset, ..passage }, whole);
            }
        }

        #[test]
        fn fixes_of_damaged_programs_never_panic(text in PROGRAM) {
            let document = Document::read(text.into_bytes());
            for finding in document.findings() {
                for fix in document.fixes(&finding) {
                    for edit in fix.edit {
                        prop_assert!(edit.range.start <= edit.range.end && edit.range.end <= document.text().len());
                    }
                }
            }
        }
    }
}
