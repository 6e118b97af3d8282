//! What is wrong with a program as a whole: contours that do not close or cross themselves, its end, texts, numbers, places.

use super::super::fields::fields_of;
use super::super::parse::unexpected;
use super::super::rules::block_number::{Numbered, Sequence};
use super::super::rules::{self, block_number, culprit, not_closed, position_mismatch};
use super::super::run::{BlockEntry, Entry, Move, Numbering, Part, What, may_cross_itself};
use super::sections::joined;
use super::way::{SectionWay, pieces_of};
use super::{At, Document, PartAt, Section, View};
use crate::finding::{Axis, Detail, Finding, NotJudged, Place, ProgramFault, Rule, Severity};
use crate::program::path::crossings::{Found, Known, Stretch, crossings_of_passes, search};
use crate::program::path::{closing, gap, is_tab, passes, pieces_of as pieces_of_way, tolerance};
use std::borrow::Cow;
use std::ops::Range;

/// Pauses in one contour, to hold the part before its last piece is cut.
const PAUSES_WITHIN: usize = 16;

/// Those of them behind which a tab is looked for.
const TABS_WITHIN: usize = 4;

impl Document {
    /// `calm` takes the contours within one run of which is known now that they do not cross themselves, in their order.
    pub(super) fn look(&self, known: &mut Known, calm: &mut Vec<PartAt>) -> View {
        let mut view = View {
            begins: self.begins(),
            ..View::default()
        };
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

    /// `not-closed`, and the block that is to blame where it is plain. A contour that stops before its tab goes on behind the stop.
    fn judge_contours(&self, view: &mut View) {
        let is_open = |section: &Section| !section.is_jump && !self.is_closed(section);
        let mut candidates: Vec<Section> = self
            .inner_sections(view.end, |run| &run.open)
            .filter(is_open)
            .collect();
        candidates.extend(
            view.outer
                .iter()
                .filter(|section| is_open(section))
                .cloned(),
        );
        // What would be a way to the next contour between two pauses is none before the end.
        let last = view.end.and_then(|end| {
            Some((
                end.run,
                self.runs
                    .get(end.run)?
                    .parts
                    .iter()
                    .position(|part| part.entries.end == end.entry)?,
            ))
        });
        candidates.extend(
            last.and_then(|last| self.section_of_part(view, last))
                .filter(is_open),
        );
        candidates.sort_by_key(|section| section.parts[0]);
        candidates.dedup_by_key(|section| section.parts[0]);
        let mut behind = (0, 0);
        for section in candidates {
            if section.parts[0] < behind {
                continue;
            }
            match self.goes_on(view, &section) {
                Some((stops, next)) => {
                    view.tabs.extend(stops);
                    behind = next;
                }
                None => {
                    view.open.push(section.parts[0]);
                    self.judge_open(view, &section);
                }
            }
        }
    }

    fn is_closed(&self, section: &Section) -> bool {
        not_closed::is_closed(&section.sum)
            || closing(&SectionWay::of(self, section)).is_some_and(|closing| closing.closed)
    }

    /// Where the sections begin that go on with an open one behind a stop, and what comes behind them: a tab, or blocks that come back
    /// to the start together, in whatever order they are cut. `None` where there are none.
    fn goes_on(&self, view: &View, section: &Section) -> Option<(Vec<PartAt>, PartAt)> {
        let mut whole = section.clone();
        let mut begins = Vec::new();
        let mut may_be_tab = true;
        for pause in 0..PAUSES_WITHIN {
            let next = self.part_behind(whole.parts[1]);
            let more = self.section_from(next, view.end)?;
            let longer = joined(whole.clone(), &more);
            begins.push(next);
            let way = |section: &Section| SectionWay::of(self, section);
            may_be_tab &= pause < TABS_WITHIN;
            let is_tab = may_be_tab
                && more.sum.blocks > 0
                && longer.sum.blocks > 2
                && is_tab(&way(&whole), &way(&more), &way(&longer)) == Some(true);
            if is_tab || not_closed::is_closed(&longer.sum) {
                return Some((begins, self.part_behind(more.parts[1])));
            }
            // What closes by itself is a contour of its own, and what leads to it no tab.
            may_be_tab =
                may_be_tab && (more.sum.blocks == 0 || !(more.is_jump || self.is_closed(&more)));
            whole = longer;
        }
        None
    }

    /// True for the way back to where the wire was threaded, behind a stop at the end of a closed contour.
    fn leads_out(&self, view: &View, section: &Section) -> bool {
        let (run, part) = section.parts[0];
        let before = part
            .checked_sub(1)
            .and_then(|part| self.section_of_part(view, (run, part)));
        before.is_some_and(|before| {
            let whole = before.sum.then(&section.sum);
            !before.is_jump && whole.travel.is_within(tolerance(whole.arcs))
        })
    }

    fn judge_open(&self, view: &mut View, section: &Section) {
        let Some(last) = self
            .last_block_of(section)
            .filter(|_| section.sum.unread == 0)
        else {
            return;
        };
        let is_fragment = view.end.is_none() || section.sum.blocks <= not_closed::FRAGMENT;
        if is_fragment && self.leads_out(view, section) {
            return;
        }
        let Some(gap) = gap(&SectionWay::of(self, section)) else {
            return;
        };
        let fault = not_closed::fault(gap, &section.sum);
        let severity = if is_fragment {
            Severity::Information
        } else {
            fault.rule().default_severity()
        };
        let mut findings = vec![Finding {
            severity,
            ..finding(self.range_of(last), fault)
        }];
        let may_be_one_field = section.sum.errors == 0
            && culprit::BLOCKS.contains(&section.sum.blocks)
            && !self.lacks_a_number(section);
        if !is_fragment && may_be_one_field {
            let blocks: Vec<&BlockEntry> = self
                .blocks_of(section)
                .filter_map(|at| self.entry(at)?.block())
                .collect();
            let named = self
                .blamed(section)
                .or_else(|| culprit::culprit(&section.sum, &blocks));
            if let Some((nth, fault)) = named
                && let Some(at) = self.blocks_of(section).nth(nth)
            {
                let spot = match &fault {
                    ProgramFault::QuadrantKeepsOpen { .. } => rules::Spot::Motion,
                    ProgramFault::AxisKeepsOpen { .. } => rules::Spot::Axis,
                    ProgramFault::JKeepsOpen { .. } => rules::Spot::J,
                    ProgramFault::NumberKeepsOpen { axis: Axis::X, .. } => rules::Spot::X,
                    ProgramFault::NumberKeepsOpen { axis: Axis::Y, .. } => rules::Spot::Y,
                    _ => rules::Spot::Block,
                };
                let block = self.range_of(at);
                let range = fields_of(self.text.bytes(), block.clone())
                    .map_or(block.clone(), |fields| spot.range(&fields, block));
                findings.push(finding(range, fault));
            }
        }
        view.findings.extend(findings);
    }

    /// Whether a number is left out among the numbers of a section: a block is lost then.
    fn lacks_a_number(&self, section: &Section) -> bool {
        let numbers: Vec<u32> = self
            .blocks_of(section)
            .filter_map(|at| self.entry(at)?.number())
            .collect();
        let steps = || {
            numbers
                .windows(2)
                .map(|pair| pair[1].saturating_sub(pair[0]))
                .filter(|step| *step > 0)
        };
        steps()
            .min()
            .is_some_and(|usual| steps().any(|step| step > usual))
    }

    fn judge_crossings(&self, view: &mut View, known: &mut Known, calm: &mut Vec<PartAt>) {
        let mut findings = Vec::new();
        let (mut pairs, mut contours) = (0, 0);
        let tangled = self
            .inner_sections(view.end, |run| &run.tangled)
            .map(Cow::Owned);
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
                    let from = self.range_of(first);
                    let fault = ProgramFault::PathCrossesItself {
                        at: [crossing.at.x / 1000.0, crossing.at.y / 1000.0],
                        other: self.text.line_of(from.start),
                    };
                    let related = vec![Place::Text { range: from }];
                    findings.push(Finding {
                        related,
                        ..finding(self.range_of(second), fault)
                    });
                }
            }
            if let Some(last) = self.last_block_of(&section).filter(|_| found.is_crowded) {
                findings.push(Finding {
                    rule: Rule::NotJudged,
                    severity: Severity::Information,
                    place: Place::Text {
                        range: self.range_of(last),
                    },
                    detail: Detail::NotJudged(NotJudged::Crossings {
                        blocks: section.sum.blocks,
                    }),
                    related: Vec::new(),
                });
            }
        }
        let whole_pairs: usize = view
            .outer
            .iter()
            .map(|section| section.parts[1].0 - section.parts[0].0)
            .sum();
        known.tidy(pairs.max(whole_pairs), contours);
        view.findings.extend(findings);
    }

    fn crossings_in(&self, section: &Section, known: &mut Known) -> Found {
        let way = SectionWay::of(self, section);
        let passes = passes(&way);
        if !passes.is_empty() {
            return crossings_of_passes(&pieces_of_way(&way).unwrap_or_default(), &passes);
        }
        let mut stretches: Vec<Stretch<'_>> = Vec::new();
        let mut places: Vec<(usize, Range<usize>)> = Vec::new();
        let mut start = Move::default();
        let [(first_run, first_part), (last_run, last_part)] = section.parts;
        for (run, of) in self
            .runs
            .iter()
            .enumerate()
            .take(last_run + 1)
            .skip(first_run)
        {
            let from = if run == first_run { first_part } else { 0 };
            let to = if run == last_run {
                last_part + 1
            } else {
                of.parts.len()
            };
            for part in of
                .parts
                .get(from..to)
                .unwrap_or_default()
                .iter()
                .filter(|part| part.sum.blocks > 0)
            {
                let Part {
                    bounds,
                    near,
                    sum,
                    entries,
                    ..
                } = part;
                stretches.push(Stretch {
                    mark: sum.mark,
                    blocks: sum.blocks,
                    start,
                    bounds: *bounds,
                    near,
                });
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
            let entries = places
                .get(stretch)
                .and_then(|(run, entries)| self.runs.get(*run)?.entries.get(entries.clone()));
            pieces_of(entries.unwrap_or_default().iter().filter_map(Entry::block))
        };
        search(&stretches, section.sum.arcs, known, &pieces)
    }

    /// `missing-end` and `text-after-end`.
    fn judge_end(&self, view: &mut View) {
        let Some(last_block) = view.last_block else {
            return;
        };
        let Some(end) = view.end else {
            let blocks: usize = self.runs.iter().map(|run| run.blocks).sum();
            let fault = ProgramFault::MissingEnd {
                word: self.words.end.clone(),
            };
            let severity = if blocks == 1 {
                Severity::Information
            } else {
                fault.rule().default_severity()
            };
            view.findings.push(Finding {
                severity,
                ..finding(self.range_of(last_block), fault)
            });
            return;
        };
        let behind = self
            .runs
            .iter()
            .enumerate()
            .skip(end.run)
            .flat_map(|(run, of)| (0..of.entries.len()).map(move |entry| At { run, entry }));
        let is_text = |at: &At| {
            !matches!(
                self.entry(*at).map(|entry| &entry.what),
                Some(What::CommentedBlock { .. })
            )
        };
        if let Some(first) = behind.into_iter().find(|at| *at > end && is_text(at)) {
            let word = self.range_of(end);
            let word = String::from_utf8_lossy(self.text.bytes().get(word).unwrap_or_default())
                .into_owned();
            let fault = ProgramFault::TextAfterEnd { word };
            view.findings.push(finding(self.range_of(first), fault));
        }
    }

    /// Text that is no block is a heading before the first block, a fault between blocks.
    fn judge_texts(&self, view: &mut View) {
        let first_block = self
            .runs
            .iter()
            .enumerate()
            .find(|(_, run)| run.blocks > 0)
            .and_then(|(run, of)| {
                let entry = of
                    .entries
                    .iter()
                    .position(|entry| entry.block().is_some())?;
                Some(At { run, entry })
            });
        let mut findings = Vec::new();
        let texts = self
            .runs
            .iter()
            .enumerate()
            .filter(|(_, run)| run.texts > 0)
            .flat_map(|(run, of)| {
                of.entries
                    .iter()
                    .enumerate()
                    .filter_map(move |(entry, what)| match what.what {
                        What::Text { column } => Some((At { run, entry }, column, false)),
                        What::CommentedBlock { column } => Some((At { run, entry }, column, true)),
                        _ => None,
                    })
            });
        let has_fault = self.runs.iter().any(|run| !run.faults.is_empty());
        let mut is_said = false;
        for (at, column, is_comment) in texts {
            let range = self.range_of(at);
            if is_comment {
                let sentence =
                    format!("column {column}: this comment holds a block, which is not cut");
                let is_marked = self.text.bytes().get(range.start) == Some(&b';');
                let severity = if is_marked {
                    Severity::Information
                } else {
                    Severity::Warning
                };
                findings.push(Finding {
                    severity,
                    ..syntax(range, sentence)
                });
                continue;
            }
            let is_fault = match (first_block, view.end) {
                (Some(first), end) => first < at && end.is_none_or(|end| at < end),
                // One sentence for a text that is no program at all.
                (None, _) => !has_fault && !is_said && view.end.is_none(),
            };
            if is_fault {
                let fault = unexpected(self.text.bytes(), range.clone(), column);
                findings.push(syntax(range, fault.sentence()));
                is_said = true;
            }
        }
        if first_block.is_none() && !has_fault && findings.is_empty() {
            let is_blank = self.text.bytes().iter().all(u8::is_ascii_whitespace);
            let severity = if is_blank {
                Severity::Information
            } else {
                Severity::Warning
            };
            let sentence = "no block is found, expected B X B Y B J G Z".to_owned();
            findings.push(Finding {
                severity,
                ..syntax(0..self.text.line_range(0).end, sentence)
            });
        }
        view.findings.extend(findings);
    }

    fn judge_numbers(&self, view: &mut View) {
        let numbering = self
            .runs
            .iter()
            .fold(Numbering::Empty, |before, run| before.then(run.numbering));
        if numbering != Numbering::Irregular || self.runs.iter().all(|run| run.numbered == 0) {
            return;
        }
        let end = view.end;
        let runs = || 0..end.map_or(self.runs.len(), |end| end.run + 1);
        let from = |run: usize| (run..runs().end).flat_map(|run| self.numbered_in(run, end));
        let head: Vec<Numbered> = from(0)
            .map(|(_, block)| block)
            .take(block_number::FIRST)
            .collect();
        let first = runs()
            .filter(|run| self.runs[*run].numbered > 0)
            .flat_map(|run| self.numbered_in(run, end));
        let first = first.into_iter().find_map(|(_, block)| block.number);
        let Some(mut sequence) = Sequence::of(&head, first) else {
            return;
        };
        for run in runs() {
            // A run in which the numbers go on as before is not walked through.
            let regular = match self.runs[run].numbering {
                Numbering::Regular { first, last, step } if end.is_none_or(|end| run < end.run) => {
                    Some((first, last, step))
                }
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
                if rest.is_some_and(|(first, last, step)| {
                    sequence.skip(first + step, last, step, count - 1)
                }) {
                    break;
                }
            }
        }
        for (at, fault, _) in sequence.found() {
            view.findings.push(finding(self.range_of(at), fault));
        }
    }

    /// Blocks and numbered words up to the end, with their numbers.
    pub(super) fn numbered(&self, end: Option<At>) -> (Vec<At>, Vec<Numbered>) {
        (0..self.runs.len())
            .flat_map(|run| self.numbered_in(run, end))
            .unzip()
    }

    /// Those of one run.
    fn numbered_in(
        &self,
        run: usize,
        end: Option<At>,
    ) -> impl Iterator<Item = (At, Numbered)> + '_ {
        let entries = self.runs.get(run).map_or(&[][..], |of| &of.entries[..]);
        let is_word = |entry: &Entry| matches!(entry.what, What::Word { .. });
        let mut is_after_pause = None;
        entries.iter().enumerate().filter_map(move |(entry, what)| {
            let follows_word = is_after_pause.unwrap_or_else(|| {
                let before = self.runs[..run]
                    .iter()
                    .rev()
                    .find_map(|of| of.entries.last());
                before.is_some_and(is_word)
            });
            is_after_pause = Some(is_word(what));
            let at = At { run, entry };
            let (number, is_unread) = (what.number(), what.what == What::Unread);
            let counts = what.block().is_some() || is_unread || (is_word(what) && number.is_some());
            let is_in_program = end.is_none_or(|end| at <= end);
            (counts && is_in_program).then_some((
                at,
                Numbered {
                    number,
                    is_after_pause: follows_word,
                    is_unread,
                },
            ))
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
                off.extend(
                    position_mismatch::mismatch(before, travel, stated)
                        .map(|by| (ordinal, At { run, entry: *entry }, by)),
                );
            }
            compared += positions.compared;
            off.extend(
                positions
                    .off
                    .iter()
                    .map(|(nth, entry, by)| (ordinal + nth, At { run, entry: *entry }, *by)),
            );
            ordinal += of.blocks;
            anchor = positions.anchor.unwrap_or(anchor);
        }
        if off.len() > 2 && off.len() as f64 > position_mismatch::FOREIGN * compared as f64 {
            return;
        }
        let mut before: Option<(usize, [f64; 2])> = None;
        for (ordinal, at, [x, y]) in off {
            // One end point that is off on its own is off once there and once back.
            let goes_back = before.is_some_and(|(last, [a, b])| {
                last + 1 == ordinal && (a + x).abs() <= 4.0 && (b + y).abs() <= 4.0
            });
            before = (!goes_back).then_some((ordinal, [x, y]));
            if !goes_back {
                view.findings.push(finding(
                    self.range_of(at),
                    ProgramFault::PositionMismatch { x, y },
                ));
            }
        }
    }
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
