//! The findings of a program as a whole: its end, texts, numbers, places, size.

use super::super::entry::{Move, What};
use super::super::parse::unexpected;
use super::super::words::Word;
use super::Document;
use super::sequence::OffPosition;
use crate::finding::{Detail, Fault, Finding, Rule, Severity};
use crate::geometry::{Bounds, Vector};
use crate::program::followed::Followed;
use crate::program::path::{HasCuts, absurd_size};
use std::ops::Range;

impl Document {
    /// Adds the findings about the program as a whole to those that were found already.
    pub(super) fn judge(&mut self, off: Vec<OffPosition>, mut findings: Vec<Finding>) {
        self.judge_end(&mut findings);
        self.judge_texts(&mut findings);
        self.judge_numbers(&mut findings);
        self.judge_positions(&mut findings, off);
        self.judge_size(&mut findings);
        self.judge_ways(&mut findings);
        self.view.findings = findings;
    }

    /// `units`: a whole program of a size that no wire cuts.
    fn judge_size(&self, findings: &mut Vec<Finding>) {
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
        if self.view.end.is_some()
            && let Some(fault) = absurd_size(&bounds, blocks)
            && let Some(range) = first()
        {
            findings.push(Finding::of(fault, range));
        }
    }

    /// `not-closed`, of a cut that leads on from the start hole to the next contour, without the stop before that.
    fn judge_ways(&self, findings: &mut Vec<Finding>) {
        let mut at = (0, 0);
        while let Some(cut) = self.cut_from(at) {
            at = self.behind(&cut);
            let Some(length) = self.leads_on(&cut) else {
                continue;
            };
            // The last one may well end elsewhere.
            let goes_on = self.cut_from(at).is_some_and(|next| next.sum.blocks > 0);
            if let (true, Some(last)) = (goes_on, HasCuts::last_block(self, &cut)) {
                findings.push(Finding::of(Fault::LeadsOn { length }, last));
            }
        }
    }

    /// `missing-end` and `text-after-end`.
    fn judge_end(&self, findings: &mut Vec<Finding>) {
        let Some(last_block) = self.view.last_block else {
            return;
        };
        let Some(end) = self.view.end else {
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
            findings.push(finding.with(severity));
            return;
        };
        // `DD`, and behind it `M02` of another controller: both end the program.
        let is_text = |what: &What| match what {
            What::Word { word, is_own } => *is_own || *word != Word::End,
            What::CommentedBlock { .. } => false,
            _ => true,
        };
        let behind = self.entries(end.stretch..self.stretches.len());
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
        let mut blocks = self.entries(0..self.stretches.len());
        let first_block = blocks.find(|(_, entry)| entry.block().is_some());
        let first_block = first_block.map(|(at, _)| at);
        let known = findings.len();
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
