//! The findings of a program as a whole: contours that do not close or cross themselves, its end, texts, numbers,
//! places.

use super::super::entry::{Move, What};
use super::super::fields::fields_of;
use super::super::parse::unexpected;
use super::super::repair::FEWEST_BLAMED;
use super::super::rules;
use super::cuts::joined;
use super::{At, Document, JoinedCut, PartAt, View};
use crate::finding::{Axis, Detail, Fault, Finding, Rule, Severity};
use crate::geometry::{Bounds, Vector};
use crate::program::chunks::Reread;
use crate::program::path::{
    BehindStops, Ends, HasCuts, Known, KnownTabs, Way, absurd_size, goes_on, tolerance,
};
use std::borrow::Cow;
use std::ops::Range;

/// Cuts that belong to one contour.
struct GoesOn {
    /// The starts of the cuts behind the first.
    begins: Vec<PartAt>,
    /// What comes behind them.
    behind: PartAt,
    /// All of them, where the last one cuts off the tab.
    held: Option<JoinedCut>,
}

/// An open cut and the cuts behind its stops.
struct OpenCuts<'a> {
    document: &'a Document,
    end: Option<At>,
    cuts: Vec<JoinedCut>,
    /// All up to each of them as one.
    wholes: Vec<JoinedCut>,
    /// The starts of the cuts behind the first.
    begins: Vec<PartAt>,
}

impl BehindStops for OpenCuts<'_> {
    fn take_next(&mut self) -> Option<()> {
        let whole = self.wholes.last()?;
        let begin = self.document.part_behind(whole.parts[1]);
        let next = self.document.cut_from(begin, self.end)?;
        self.wholes.push(joined(whole.clone(), &next));
        self.cuts.push(next);
        self.begins.push(begin);
        Some(())
    }

    fn ends(&self) -> Ends {
        self.document.ends(&self.wholes[self.wholes.len() - 1])
    }

    fn way(&self, cuts: Range<usize>) -> impl Way {
        self.document.way(match cuts.start {
            0 => &self.wholes[cuts.end - 1],
            single => &self.cuts[single],
        })
    }

    fn last_mark(&self) -> u64 {
        self.document.mark(&self.cuts[self.cuts.len() - 1])
    }

    fn last_stands_alone(&self) -> bool {
        let last = &self.cuts[self.cuts.len() - 1];
        last.sum.blocks > 0 && (last.is_jump || self.document.is_closed(last))
    }
}

impl Document {
    /// `clean` gets the contours within one stretch that are now known not to cross themselves, in order.
    pub(super) fn judged(
        &self,
        before: Option<(View, Reread)>,
        known: &mut Known,
        clean: &mut Vec<PartAt>,
    ) -> View {
        let mut view = View::default();
        view.end = self.end_word();
        view.outer = match before {
            Some((before, reread)) => self.outer_cuts_after(before, &reread, view.end),
            None => self.outer_cuts(view.end),
        };
        view.last_block = self.last_block(view.end);
        let off = self.off_positions();
        view.taken = self.taken(&view, &off);
        view.begins = self.begins(&view.taken);
        self.judge_contours(&mut view, &mut known.tabs);
        self.judge_joints(&mut view);
        self.judge_crossings(&mut view, known, clean);
        self.judge_end(&mut view);
        self.judge_texts(&mut view);
        self.judge_numbers(&mut view);
        self.judge_positions(&mut view, off);
        self.judge_size(&mut view);
        view
    }

    /// `units`: a whole program of a size that no wire cuts.
    fn judge_size(&self, view: &mut View) {
        // Stretches are laid end to end as their parts are, by their blocks' meaning: it does not matter where a
        // stretch ends.
        let (mut bounds, mut blocks, mut before) = (Bounds::EMPTY, 0, Move::default());
        for of in self.stretches.iter() {
            if let Some(own) = of.bounds {
                let [x, y] = before.meant_um();
                bounds.merge(&own.moved(Vector::new(x, y)));
            }
            blocks += of.blocks;
            before = before.plus(of.travel);
        }
        let first = || {
            let mut all = self.entries(0..self.stretches.len());
            let (at, _) = all.find(|(_, entry)| entry.block().is_some())?;
            Some(self.range_of(at))
        };
        if view.end.is_some()
            && let Some(fault) = absurd_size(&bounds, blocks)
            && let Some(range) = first()
        {
            view.findings.push(Finding::of(fault, range));
        }
    }

    /// `not-closed`, and the block to blame where that is plain. A contour that stops before its tab goes on behind the
    /// stop.
    fn judge_contours(&self, view: &mut View, known: &mut KnownTabs) {
        let is_open = |cut: &JoinedCut| !cut.is_jump && !self.goes_round(cut);
        let mut candidates: Vec<JoinedCut> = self
            .inner_cuts(view.end, |stretch| &stretch.open)
            .filter(is_open)
            .collect();
        for cut in view
            .outer
            .iter_mut()
            .filter(|cut| !cut.is_jump && !cut.goes_round)
        {
            cut.goes_round = self.goes_round(cut);
            candidates.extend((!cut.goes_round).then(|| cut.clone()));
        }
        // Between two pauses this would be a way to the next contour; before the end it is not.
        let last = view.end.and_then(|end| {
            Some((
                end.stretch,
                self.stretches
                    .get(end.stretch)?
                    .parts
                    .iter()
                    .position(|part| part.entries().end == end.entry)?,
            ))
        });
        candidates.extend(
            last.and_then(|last| self.cut_of_part(view, last))
                .filter(is_open),
        );
        candidates.sort_by_key(|cut| cut.parts[0]);
        candidates.dedup_by_key(|cut| cut.parts[0]);
        let (mut behind, mut open) = ((0, 0), Vec::new());
        for cut in candidates {
            if cut.parts[0] < behind {
                continue;
            }
            let is_empty = cut.sum.blocks + cut.sum.unread == 0;
            if is_empty || self.ends_open(view, &cut) {
                continue;
            }
            match self.goes_on(view, &cut, known) {
                Some(goes_on) => {
                    view.tabs.extend(goes_on.begins);
                    view.held.extend(goes_on.held);
                    behind = goes_on.behind;
                }
                // To and fro on one way.
                None if self.is_closed(&cut) => {}
                None => {
                    view.open.push(cut.parts[0]);
                    open.push(cut);
                }
            }
        }
        open.iter().for_each(|cut| self.judge_open(view, cut));
    }

    /// Whether the machine stops twice where a cut ends.
    fn ends_open(&self, view: &View, cut: &JoinedCut) -> bool {
        let last = cut.parts[1];
        let word = self.stretches.get(last.0).and_then(|of| {
            let part = of.parts.get(last.1)?;
            part.word.map(|_| At {
                stretch: last.0,
                entry: part.entries().end,
            })
        });
        word.is_some() && word != view.end && self.stops_again(last, view.end)
    }

    /// The continuation of an open cut behind a stop: a tab, or blocks that return to the start together, in whatever
    /// order they are cut. `None` where there is none.
    fn goes_on(&self, view: &View, cut: &JoinedCut, known: &mut KnownTabs) -> Option<GoesOn> {
        let mut open = OpenCuts {
            document: self,
            end: view.end,
            cuts: vec![cut.clone()],
            wholes: vec![cut.clone()],
            begins: Vec::new(),
        };
        let is_tab = goes_on(&mut open, known)?;
        let whole = open.wholes.pop()?;
        Some(GoesOn {
            begins: open.begins,
            behind: self.part_behind(whole.parts[1]),
            held: is_tab.then_some(whole),
        })
    }

    /// True for the way back to the thread hole, behind a stop at the end of a closed contour.
    fn leads_out(&self, view: &View, cut: &JoinedCut) -> bool {
        let (stretch, part) = cut.parts[0];
        let before = part
            .checked_sub(1)
            .and_then(|part| self.cut_of_part(view, (stretch, part)));
        before.is_some_and(|before| {
            let whole = before.sum.then(&cut.sum);
            !before.is_jump && whole.travel.is_within(tolerance(whole.arcs))
        })
    }

    fn judge_open(&self, view: &mut View, cut: &JoinedCut) {
        if cut.sum.unread > 0 {
            return;
        }
        let is_fragment = view.end.is_none() || self.is_fragment(cut);
        if is_fragment && self.leads_out(view, cut) {
            return;
        }
        view.findings.extend(self.not_closed(cut, is_fragment));
        let may_be_one_field =
            cut.sum.errors == 0 && cut.sum.blocks >= FEWEST_BLAMED && !self.lacks_a_number(cut);
        if !is_fragment
            && may_be_one_field
            && let Some((nth, fault)) = self.blamed(view, cut)
            && let Some(at) = self.blocks_of(cut).nth(nth)
        {
            let spot = match &fault {
                Fault::QuadrantKeepsOpen { .. } => rules::Spot::Motion,
                Fault::AxisKeepsOpen { .. } => rules::Spot::Axis,
                Fault::JKeepsOpen { .. } => rules::Spot::J,
                Fault::NumberKeepsOpen { axis: Axis::X, .. } => rules::Spot::X,
                Fault::NumberKeepsOpen { axis: Axis::Y, .. } => rules::Spot::Y,
                _ => rules::Spot::Block,
            };
            let block = self.range_of(at);
            let range = fields_of(self.text.bytes(), block.clone())
                .map_or(block.clone(), |fields| spot.range(&fields, block));
            view.findings.push(Finding::of(fault, range));
        }
    }

    /// Whether the numbers of a cut have a gap: a block is lost then.
    fn lacks_a_number(&self, cut: &JoinedCut) -> bool {
        let numbers: Vec<u32> = self
            .blocks_of(cut)
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

    /// `path-crosses-itself`. What stands before and behind the stop at a tab is one contour.
    fn judge_crossings(&self, view: &mut View, known: &mut Known, clean: &mut Vec<PartAt>) {
        let held = std::mem::take(&mut view.held);
        let is_held = |cut: &JoinedCut| {
            let behind = held.partition_point(|whole| whole.parts[0] <= cut.parts[0]);
            let whole = behind.checked_sub(1).and_then(|index| held.get(index));
            whole.is_some_and(|whole| cut.parts[1] <= whole.parts[1])
        };
        let mut findings = Vec::new();
        let may_cross = self.inner_cuts(view.end, |stretch| &stretch.may_cross);
        let may_cross = may_cross.filter(|cut| !is_held(cut)).map(Cow::Owned);
        let is_open_question = |cut: &&JoinedCut| !cut.crosses_nothing && !is_held(cut);
        let outer = view.outer.iter().filter(is_open_question).chain(&held);
        let mut clear: Vec<PartAt> = Vec::new();
        let cuts = may_cross.chain(outer.map(Cow::Borrowed));
        self.look_through(known, cuts, |cut, found| {
            if found.is_clean() {
                let is_inner = matches!(cut, Cow::Owned(_));
                clean.extend(is_inner.then_some(cut.parts[0]));
                clear.extend((!is_inner && cut.stop.is_none()).then_some(cut.parts[0]));
            } else if !self.is_odd(view, &cut) {
                findings.extend(found.findings(&self.way(&cut), &self.text));
            }
        });
        view.findings.extend(findings);
        for begin in clear {
            let index = view.outer.partition_point(|cut| cut.parts[0] < begin);
            if let Some(cut) = view.outer.get_mut(index) {
                cut.crosses_nothing = true;
            }
        }
    }

    /// `missing-end` and `text-after-end`.
    fn judge_end(&self, view: &mut View) {
        let Some(last_block) = view.last_block else {
            return;
        };
        let Some(end) = view.end else {
            let blocks: usize = self.stretches.iter().map(|stretch| stretch.blocks).sum();
            let fault = Fault::MissingEnd {
                word: self.words.end.clone(),
            };
            let severity = if blocks == 1 {
                Severity::Information
            } else {
                fault.rule().default_severity()
            };
            let finding = Finding::of(fault, self.range_of(last_block));
            view.findings.push(finding.with(severity));
            return;
        };
        let is_text = |what: &What| !matches!(what, What::CommentedBlock { .. });
        let behind = self.entries(end.stretch..self.stretches.len());
        let mut texts = behind.filter(|(at, entry)| *at > end && is_text(&entry.what));
        if let Some((first, _)) = texts.next() {
            let word = self.range_of(end);
            let word = self.text.bytes().get(word).unwrap_or_default();
            let word = String::from_utf8_lossy(word).into_owned();
            let fault = Fault::TextAfterEnd { word };
            view.findings.push(Finding::of(fault, self.range_of(first)));
        }
    }

    /// Text that is no block is a heading before the first block, and a fault between blocks.
    fn judge_texts(&self, view: &mut View) {
        let mut blocks = self.entries(0..self.stretches.len());
        let first_block = blocks.find(|(_, entry)| entry.block().is_some());
        let first_block = first_block.map(|(at, _)| at);
        let mut findings = Vec::new();
        let has_texts = |stretch: &usize| self.stretches[*stretch].texts > 0;
        let stretches = (0..self.stretches.len()).filter(has_texts);
        let texts = stretches
            .flat_map(|stretch| self.entries(stretch..stretch + 1))
            .filter_map(|(at, entry)| match entry.what {
                What::Text { column } => Some((at, column, false)),
                What::CommentedBlock { column } => Some((at, column, true)),
                _ => None,
            });
        let has_fault = self
            .stretches
            .iter()
            .any(|stretch| !stretch.faults.is_empty());
        let mut is_said = false;
        for (at, column, is_comment) in texts {
            let range = self.range_of(at);
            if is_comment {
                let sentence = say!(this_comment_holds_a_block_which_is_not_cut, column);
                let is_marked = self.text.bytes().get(range.start) == Some(&b';');
                let severity = if is_marked {
                    Severity::Information
                } else {
                    Severity::Warning
                };
                findings.push(syntax(range, sentence).with(severity));
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
            let sentence = say!(no_block_is_found).to_owned();
            let range = 0..self.text.line_range(0).end;
            findings.push(syntax(range, sentence).with(severity));
        }
        view.findings.extend(findings);
    }
}

fn syntax(range: Range<usize>, sentence: String) -> Finding {
    Finding::in_text(Rule::Syntax, range, Detail::Said(sentence))
}
