//! 3B text as an open document: its lines and what is wrong in them.

use super::decode::decode;
use super::parse::{Item, SyntaxFault, Word, Words, read_line, unexpected};
use crate::finding::{Detail, Finding, Fix, Place, Rule};
use crate::geometry::{Point, Segment};
use crate::program::trace::{Kind, Step, Trace};
use crate::settings::Effective;
use crate::text::{SourceText, TextEdit};
use std::ops::Range;

/// A 3B program as text, and the faults found in it.
///
/// What a line says hangs on no other line, so an edit reads again only the lines that it touched.
#[derive(Clone, Debug, Default)]
pub struct Document {
    text: SourceText,
    end_word: String,
    pause_word: String,
    /// In the order of the text; all have a range of it.
    findings: Vec<Finding>,
}

impl Document {
    /// Reads program text. Never fails: what is damaged is in [`Document::findings`].
    pub fn read(bytes: Vec<u8>) -> Document {
        Document::read_with(bytes, &Effective::default())
    }

    /// The same with the words and limits of a controller.
    pub fn read_with(bytes: Vec<u8>, settings: &Effective) -> Document {
        let text = SourceText::new(bytes);
        let mut document = Document { text, end_word: settings.end.clone(), pause_word: settings.pause.clone(), findings: Vec::new() };
        document.findings = document.findings_in(0..document.text.line_count());
        document
    }

    /// Reads again where the words between blocks have changed.
    pub fn set_settings(&mut self, settings: &Effective) {
        if (&self.end_word, &self.pause_word) != (&settings.end, &settings.pause) {
            *self = Document::read_with(std::mem::take(&mut self.text).into_bytes(), settings);
        }
    }

    /// The words between blocks.
    pub(in crate::program) fn words(&self) -> Words<'_> {
        Words { pause: self.pause_word.trim(), end: self.end_word.trim() }
    }

    /// The fixes of one finding, the preferred one first.
    pub fn fixes(&self, _finding: &Finding) -> Vec<Fix<Vec<TextEdit>>> {
        Vec::new()
    }

    /// Where the machine goes, block by block.
    pub fn trace(&self) -> Trace {
        let mut trace = Trace::default();
        let mut at = trace.start;
        let mut contour = 0;
        for line in 0..self.text.line_count() {
            let range = self.text.line_range(line);
            let start = range.start;
            read_line(&self.text.bytes()[range], start, &self.words(), |item| match item {
                Item::StartPoint { at: [x, y], .. } => {
                    if trace.steps.is_empty() {
                        at = Point::new((x * 1000.0).round(), (y * 1000.0).round());
                        (trace.start, trace.start_is_known) = (at, true);
                    }
                }
                Item::Word { word, range, .. } => {
                    let kind = if word == Word::End { Kind::End } else { Kind::Pause };
                    trace.steps.push(Step { range, line, number: None, kind, start: at, end: at, ideal: None, contour });
                    contour += usize::from(word == Word::Pause);
                }
                Item::Block { block, range, number, .. } => {
                    let ideal = decode(&block, at).ok();
                    let end = ideal.map_or(at, |ideal| ideal.end());
                    let kind = if matches!(ideal, Some(Segment::Arc(_))) { Kind::Arc } else { Kind::Line };
                    trace.steps.push(Step { range, line, number, kind, start: at, end, ideal, contour });
                    at = end;
                }
                Item::Text { .. } | Item::Fault(_) => {}
            });
        }
        trace
    }

    /// The steps whose text overlaps or touches a range of bytes.
    pub fn steps_in(&self, range: Range<usize>) -> Vec<Step> {
        let mut steps = self.trace().steps;
        steps.retain(|step| step.range.start <= range.end && range.start <= step.range.end);
        steps
    }

    pub fn text(&self) -> &SourceText {
        &self.text
    }

    pub fn findings(&self) -> Vec<Finding> {
        self.findings.clone()
    }

    /// Replaces a range of bytes and reads again what it touched.
    pub fn edit(&mut self, range: Range<usize>, replacement: &str) {
        let end = range.end.min(self.text.len());
        let start = range.start.min(end);
        // The byte before belongs to it: a CR there may become one line end with an inserted LF.
        let first = self.text.line_of(start.saturating_sub(1));
        let behind = self.text.line_start(self.text.line_of(end) + 1);
        let tail = self.text.len() - behind;
        let kept_before = self.findings.partition_point(|finding| start_of(finding) < self.text.line_start(first));
        let kept_behind = if tail == 0 { self.findings.len() } else { self.findings.partition_point(|finding| start_of(finding) < behind) };

        self.text.replace(start..end, replacement);

        let new_behind = self.text.len() - tail;
        let last = self.text.line_of(new_behind.saturating_sub(usize::from(tail > 0)));
        for finding in &mut self.findings[kept_behind..] {
            if let Place::Text { range } = &mut finding.place {
                *range = range.start - behind + new_behind..range.end - behind + new_behind;
            }
        }
        let fresh = self.findings_in(first..last + 1);
        self.findings.splice(kept_before..kept_behind, fresh);
    }

    fn findings_in(&self, lines: Range<usize>) -> Vec<Finding> {
        let words = self.words();
        let mut findings = Vec::new();
        for line in lines {
            let range = self.text.line_range(line);
            let start = range.start;
            read_line(&self.text.bytes()[range], start, &words, |item| match item {
                Item::Fault(fault) => findings.push(finding(fault)),
                Item::Text { range, column } => findings.push(finding(unexpected(self.text.bytes(), range, column))),
                _ => {}
            });
        }
        findings
    }
}

fn start_of(finding: &Finding) -> usize {
    match &finding.place {
        Place::Text { range } => range.start,
        _ => 0,
    }
}

fn finding(fault: SyntaxFault) -> Finding {
    Finding {
        rule: Rule::Syntax,
        severity: Rule::Syntax.default_severity(),
        detail: Detail::Syntax(fault.sentence()),
        place: Place::Text { range: fault.range },
        related: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn each_damaged_line_is_named_once_and_the_rest_is_read() {
        let document = Document::read(b"B1000B0B1000GXL1\nB1B2GXL1\nB0B1000B1000GYL2\n9900B0B9900GXL1\nDD\n".to_vec());
        let sentences: Vec<_> = document.findings().iter().map(|finding| (start_of(finding), finding.detail.clone())).collect();
        let expected = [(21, "column 5: found `GXL1`, expected digits of Y, or B before J"), (43, "a B of the block is missing")];
        assert_eq!(sentences, expected.map(|(start, sentence)| (start, Detail::Syntax(sentence.into()))));
    }

    proptest! {
        #[test]
        fn an_edited_document_is_the_one_read_afresh(
            text in "(B12B0B12GXL1|BxB|[;DN1 ]|\r\n|\n|\r){0,30}",
            edits in prop::collection::vec((0_usize..80, 0_usize..12, "(B5B5B5GYL1|q|\r|\n| ){0,3}"), 1..6),
        ) {
            let mut document = Document::read(text.into_bytes());
            for (start, length, replacement) in edits {
                document.edit(start..start + length, &replacement);
                let fresh = Document::read(document.text().bytes().to_vec());
                prop_assert_eq!(document.findings(), fresh.findings());
                prop_assert_eq!(document.text(), fresh.text());
            }
        }
    }
}
