//! 3B text as an open document: its lines and what is wrong in them.

use super::parse::{SyntaxFault, Words, read_line};
use crate::finding::{Detail, Finding, Place, Rule};
use crate::text::SourceText;
use std::ops::Range;

/// A 3B program as text, and the faults found in it.
///
/// What a line says hangs on no other line, so an edit reads again only the lines that it touched.
#[derive(Clone, Debug, Default)]
pub struct Document {
    text: SourceText,
    /// In the order of the text; all have a range of it.
    findings: Vec<Finding>,
}

impl Document {
    /// Reads program text. Never fails: what is damaged is in [`Document::findings`].
    pub fn read(bytes: Vec<u8>) -> Document {
        let text = SourceText::new(bytes);
        let findings = findings_in(&text, 0..text.line_count());
        Document { text, findings }
    }

    pub fn text(&self) -> &SourceText {
        &self.text
    }

    pub fn findings(&self) -> &[Finding] {
        &self.findings
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
        let fresh = findings_in(&self.text, first..last + 1);
        self.findings.splice(kept_before..kept_behind, fresh);
    }
}

fn start_of(finding: &Finding) -> usize {
    match &finding.place {
        Place::Text { range } => range.start,
        _ => 0,
    }
}

fn findings_in(text: &SourceText, lines: Range<usize>) -> Vec<Finding> {
    let words = Words::default();
    let faults = lines.filter_map(|line| {
        let range = text.line_range(line);
        let start = range.start;
        read_line(&text.bytes()[range], start, &words, |_| {}).err()
    });
    faults.map(finding).collect()
}

fn finding(fault: SyntaxFault) -> Finding {
    Finding {
        rule: Rule::Syntax,
        severity: Rule::Syntax.default_severity(),
        place: Place::Text { range: fault.range },
        detail: Detail::Syntax(fault.sentence),
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
        let expected = [
            (21, "column 5: found `GXL1`, expected digits of Y, or B before J"),
            (43, "column 1: found `9900B0B9900G`, expected a block (B X B Y B J G Z), a pause or end word, or a comment after `;`"),
        ];
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
