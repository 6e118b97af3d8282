//! The findings of a program as a whole: its end, texts, numbers, places, size.

use super::super::entry::{Move, What};
use super::super::parse::unexpected;
use super::super::words::Word;
use super::Document;
use super::sequence::OffPosition;
use crate::finding::{Detail, Fault, Finding, Rule, Severity};
use crate::geometry::{Bounds, Vector};
use crate::program::path::absurd_size;
use crate::program::steps::Program;
use std::ops::Range;

impl Document {
    /// The findings about the program as a whole.
    pub(super) fn judge(&self, off: &[OffPosition]) -> Vec<Finding> {
        let mut findings = Vec::new();
        self.judge_end(&mut findings);
        self.judge_texts(&mut findings);
        self.judge_positions(&mut findings, off);
        self.judge_size(&mut findings);
        self.judge_ways(&mut findings);
        findings
    }

    /// `units`: a whole program of a size that no wire cuts.
    fn judge_size(&self, findings: &mut Vec<Finding>) {
        // Cuts are laid end to end by what their blocks mean.
        let (mut bounds, mut blocks, mut before) = (Bounds::EMPTY, 0, Move::default());
        for cut in self.cuts.iter() {
            let by = Vector::from(before.meant_um());
            let placed = cut.bounds.map(|own| own.moved(by));
            placed.iter().for_each(|placed| bounds.merge(placed));
            blocks += cut.blocks as usize;
            before = before.plus(cut.travel);
        }
        let first = || {
            self.all_entries()
                .find(|(_, entry)| entry.block().is_some())
        };
        if self.view.end.is_some()
            && let Some(fault) = absurd_size(&bounds, blocks)
            && let Some((at, _)) = first()
        {
            findings.push(Finding::of(fault, self.range_of(at)));
        }
    }

    /// `not-closed`, of a cut that leads on from the start hole to the next contour, without the stop before that.
    fn judge_ways(&self, findings: &mut Vec<Finding>) {
        for cut in 0..self.cut_count() {
            // The last one may well end elsewhere.
            let goes_on = |next: usize| next < self.cut_count() && self.cuts[next].blocks > 0;
            if let Some(length) = self.cuts[cut].rare().leads_on
                && goes_on(cut + 1)
                && let Some(last) = self.blocks_of(&(cut..cut + 1)).next_back()
            {
                findings.push(Finding::of(Fault::LeadsOn { length }, self.range_of(last)));
            }
        }
    }

    /// `missing-end` and `text-after-end`.
    fn judge_end(&self, findings: &mut Vec<Finding>) {
        let Some(last_block) = self.view.last_block else {
            return;
        };
        let Some(end) = self.view.end else {
            let blocks: u32 = self.cuts.iter().map(|cut| cut.blocks).sum();
            let fault = Fault::MissingEnd {
                word: self.words().end.to_owned(),
            };
            let severity = if blocks == 1 {
                Severity::Information
            } else {
                fault.rule().default_severity()
            };
            let finding = Finding::of(fault, self.range_of(last_block));
            findings.push(finding.with(severity));
            return;
        };
        // `DD`, and behind it `M02` of another controller: both end the program.
        let is_text = |what: &What| match what {
            What::Word { word, is_own } => *is_own || *word != Word::End,
            What::CommentedBlock { .. } => false,
            _ => true,
        };
        let behind = self.entries(end.cut..self.cuts.len());
        let mut texts = behind.filter(|(at, entry)| *at > end && is_text(&entry.what));
        if let Some((first, _)) = texts.next() {
            let word = self.range_of(end);
            let word = self.text.bytes().get(word).unwrap_or_default();
            let word = String::from_utf8_lossy(word).into_owned();
            let fault = Fault::TextAfterEnd { word };
            findings.push(Finding::of(fault, self.range_of(first)));
        }
    }

    /// Text that is no block is a heading before the first block, and a fault between blocks.
    fn judge_texts(&self, findings: &mut Vec<Finding>) {
        let first_block = self
            .all_entries()
            .find(|(_, entry)| entry.block().is_some());
        let first_block = first_block.map(|(at, _)| at);
        let known = findings.len();
        let with_texts = (0..self.cuts.len()).filter(|cut| self.cuts[*cut].rare().texts > 0);
        let texts = with_texts
            .flat_map(|cut| self.entries(cut..cut + 1))
            .filter_map(|(at, entry)| match entry.what {
                What::Text { column } => Some((at, column, false)),
                What::CommentedBlock { column } => Some((at, column, true)),
                _ => None,
            });
        let has_fault = self.cuts.iter().any(|cut| !cut.rare().faults.is_empty());
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
            let is_fault = match (first_block, self.view.end) {
                (Some(first), end) => first < at && end.is_none_or(|end| at < end),
                // One sentence for a text that is not a program at all.
                (None, _) => !has_fault && !is_said && self.view.end.is_none(),
            };
            if is_fault {
                let fault = unexpected(self.text.bytes(), range.clone(), column);
                findings.push(syntax(range, fault.sentence()));
                is_said = true;
            }
        }
        if first_block.is_none() && !has_fault && findings.len() == known {
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
    }
}

fn syntax(range: Range<usize>, sentence: String) -> Finding {
    Finding::in_text(Rule::Syntax, range, Detail::Said(sentence))
}
