//! 3B text as an open document: its lines, the machine's way, and its findings.
//!
//! The text is read as cuts, from one stop to the next. Lines are independent, so an edit rereads the cuts that it touched;
//! everything about the whole program (contours, numbers, the end) comes from what is known of each cut.

mod contours;
mod fixes;
mod judge;
mod repairs;
mod report;
mod sequence;
mod told;
mod walk;

use super::cut::{self, Cut};
use super::entry::Entry;
use super::words::Words;
use crate::finding::Finding;
use crate::geometry::{Point, Vector};
use crate::program::contours::Contours;
use crate::program::cuts::{Cuts, Reader};
use crate::program::repair::searches::Searches;
use crate::settings::Effective;
use crate::text::SourceText;
use sequence::Numbers;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use told::Found;

/// A 3B or 4B program as text, and its reading.
#[derive(Clone, Debug)]
pub struct Document {
    text: SourceText,
    settings: Arc<Effective>,
    cuts: Cuts<Cut, ()>,
    view: Box<View>,
}

/// An entry by its cut and its index in there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct At {
    cut: usize,
    entry: usize,
}

/// The properties of the program as a whole.
#[derive(Clone, Debug, Default)]
struct View {
    /// The machine's position before each cut, µm.
    begins: Vec<Point>,
    /// Where by the coordinates the wire was moved by hand at a stop: the first block after it, and how far, µm.
    taken: Vec<(At, Vector)>,
    contours: Contours,
    /// The word that ends the program.
    end: Option<At>,
    last_block: Option<At>,
    numbers: Numbers,
    /// The findings about contours and the whole, in no order, at bytes of the text.
    findings: Vec<Finding>,
    /// The blocks with a finding about their numbers, and the number of each one's turn, where that is known.
    faulty_numbers: BTreeMap<At, Option<u32>>,
    /// Of each cut, what a search for its slip may see of it from beside.
    marks: Vec<u64>,
    searches: Searches<Arc<Found>>,
}

impl Document {
    /// Reads program text with the words and limits of the default settings.
    pub fn read(bytes: Vec<u8>) -> Document {
        Document::read_with(bytes, &Effective::default())
    }

    /// Reads program text. Never fails: damage is in [`Document::findings`].
    pub fn read_with(bytes: Vec<u8>, settings: &Effective) -> Document {
        let text = SourceText::new(bytes);
        let cuts = Cuts::read(&Lines { settings }, &text, ());
        let mut document = Document {
            text,
            settings: Arc::new(settings.clone()),
            cuts,
            view: Box::default(),
        };
        document.judge_again();
        document
    }

    /// The words between blocks.
    pub(crate) fn words(&self) -> Words<'_> {
        Words::of(&self.settings)
    }

    /// The largest number that the controller takes, µm.
    pub(crate) fn largest(&self) -> i64 {
        self.settings.largest_number()
    }

    pub fn text(&self) -> &SourceText {
        &self.text
    }

    /// Rereads under other settings.
    pub(crate) fn set_settings(&mut self, settings: &Effective) {
        if *self.settings != *settings {
            *self = Document::read_with(std::mem::take(&mut self.text).into_bytes(), settings);
        }
    }

    /// Replaces a range of bytes and rereads what it touched.
    pub fn edit(&mut self, range: Range<usize>, replacement: &str) {
        let reader = Lines {
            settings: &self.settings,
        };
        let edit = (range, replacement);
        self.cuts.edit(&reader, &mut self.text, edit);
        self.judge_again();
    }

    fn entry(&self, at: At) -> Option<&Entry> {
        self.cuts.get(at.cut)?.entries.get(at.entry)
    }

    /// Bytes of an entry in the text.
    fn range_of(&self, at: At) -> Range<usize> {
        let byte = self.cuts.byte(at.cut);
        self.entry(at).map_or(0..0, |entry| {
            byte + entry.range().start..byte + entry.range().end
        })
    }

    /// Judges the program as a whole; what is known of cuts that were not read again is used again.
    fn judge_again(&mut self) {
        let before = std::mem::take(&mut *self.view);
        self.view.end = self.end_word();
        self.view.last_block = self.last_block(self.view.end);
        let off = self.off_positions();
        self.view.taken = self.taken(&off);
        self.view.numbers = self.numbers();
        self.view.begins = self.begins(&self.view.taken);
        let contours = match before.end == self.view.end {
            true => before.contours,
            false => Contours::default(),
        };
        self.view.contours = Contours::of(self, contours);
        let mut findings = self.judge(&off);
        self.view.faulty_numbers = self.judge_numbers(&mut findings);
        self.view.marks = self.marks();
        self.view.searches = before.searches;
        self.view.searches.edited();
        self.judge_contours(&mut findings);
        self.view.findings = findings;
    }
}

/// How 3B text is read: lines are independent.
struct Lines<'a> {
    settings: &'a Effective,
}

impl Reader for Lines<'_> {
    type State = ();
    type Begun = Vec<(Range<usize>, Cut)>;
    type Cut = Cut;

    fn line_count(&self, text: &SourceText) -> usize {
        text.line_count()
    }

    fn base(&self, text: &SourceText, line: usize) -> usize {
        text.line_start(line)
    }

    fn run(&self, text: &SourceText, first: usize, (): &()) -> (Self::Begun, usize, ()) {
        let (cuts, behind) = cut::read(text, first, self.settings);
        (cuts, behind, ())
    }

    fn finish(&self, _: &SourceText, begun: Self::Begun) -> Vec<(Range<usize>, Cut)> {
        let finished = |(lines, cut): (Range<usize>, Cut)| (lines, cut.finished(self.settings));
        begun.into_iter().map(finished).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::finding::Rule;
    use crate::program::numbering::Renumbering;
    use crate::program::path::Step;
    use proptest::prelude::*;

    /// Findings in one order, whatever cuts the lines lie in.
    fn sorted(document: &Document) -> Vec<String> {
        let mut findings: Vec<String> = document
            .findings()
            .iter()
            .map(|finding| format!("{finding:?}"))
            .collect();
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
    /// One with a spur, one with an arc that runs the wrong way round.
    const CONTOURS: [&str; 6] = [
        "B0B500B500GYL2\nB1000B0B1000GXL1\nB0B500B500GYL2\nB300B0B300GXL1\nB300B0B300GXL3\nB0B500B500GYL2\nB2000B0B2000GXL3\nB0B1000B1000GYL4\nB1000B0B1000GXL1\nB0B500B500GYL4\nD\n",
        "B0B500B500GYL2\nB500B0B500GXL1\nB0B500B1000GXNR4\nB1000B0B1000GXL3\nB0B500B1000GXSR1\nB500B0B500GXL1\nB0B500B500GYL4\nD\n",
        "B9000B0B9000GXL1\nB0B9000B9000GYL2\nB9000B0B9000GXL3\nB0B9000B9000GYL4\nD\n",
        "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nD\n",
        "B900B0B900GXL1\nB900B900B900GYL1\nB900B0B900GXL3\nB900B900B900GXL4\nB900B0B900GXL3\nB0B50B50GYL2\nB0B50B50GYL4\nD\n",
        "B50000B0B50000GXL1\nD\n",
    ];
    const REPLACEMENT: &str = "(((N[0-9] )?B[0-9]{1,4}B[0-9]{1,4}B[0-9]{1,5}G[XY](L|SR|NR)[1-4]( ; [0-9]\\.[0-9]{3} , 1\\.0)?|BxB|[;DN1 ]|DD|D|E|text|Start Point = 1 , 2)|\r|\n| |7){0,3}";

    #[test]
    fn blocks_of_equal_numbers_that_lead_elsewhere_are_not_taken_for_each_other() {
        // The third block crosses the first, until the second leads the other way.
        let text = "B10000B0B10000GXL1\nB5000B5000B5000GXL2\nB0B10000B10000GYL4\nB5000B5000B5000GXL2\nDD\n";
        let mut document = Document::read(text.into());
        assert!(
            sorted(&document)
                .iter()
                .any(|found| found.contains("PathCrossesItself"))
        );
        let at = text.find("GXL2").unwrap();
        document.edit(at..at + 4, "GYL1");
        assert_is_fresh(&document).unwrap();
        assert!(
            !sorted(&document)
                .iter()
                .any(|found| found.contains("PathCrossesItself"))
        );
    }

    #[test]
    fn an_arc_of_a_part_is_held_against_the_correction_where_the_wire_runs_inside() {
        let (settings, _) = crate::settings::from_toml(
            "correction = 0.1\nside = \"opening\"\n[program]\ncompensation = \"controller\"\n",
        );
        // A square with one rounded corner, in both directions, over more lines than one run holds.
        for (radius, is_tight) in [(80, true), (120, false)] {
            let (right, up) = (10_000 - radius, 10_000 - radius);
            let steps = |length: i64, motion: &str| {
                let step = |by: i64| match &motion[..1] {
                    "X" => format!("B{by}B0B{by}G{motion}\n"),
                    _ => format!("B0B{by}B{by}G{motion}\n"),
                };
                step(100).repeat(length as usize / 100 - 1) + &step(100 + length % 100)
            };
            let left_round = format!(
                "{}{}B{radius}B0B{radius}GXNR1\n{}{}DD\n",
                steps(10_000, "XL1"),
                steps(up, "YL2"),
                steps(right, "XL3"),
                steps(10_000, "YL4"),
            );
            let right_round = format!(
                "{}{}B0B{radius}B{radius}GYSR1\n{}{}DD\n",
                steps(10_000, "YL2"),
                steps(right, "XL1"),
                steps(up, "YL4"),
                steps(10_000, "XL3"),
            );
            for text in [left_round, right_round] {
                let document =
                    Document::read_with(text.clone().into_bytes(), &Effective::of(&settings));
                let found: Vec<_> = document
                    .findings()
                    .iter()
                    .map(|finding| finding.rule)
                    .collect();
                let expected = if is_tight {
                    vec![Rule::SmallRadius]
                } else {
                    vec![]
                };
                assert_eq!(found, expected, "{text}");
            }
        }
    }

    #[test]
    fn a_turn_is_counted_with_the_tolerance_of_its_rounding() {
        for (j, is_over) in [(4000, false), (4002, false), (4003, true)] {
            let text = format!("B1000B0B{j}GYNR1\nDD\n");
            let found = sorted(&Document::read(text.into_bytes()));
            let said = found.iter().any(|finding| finding.contains("JOverTurn"));
            assert_eq!(said, is_over, "{j}: {found:?}");
        }
    }

    proptest! {
        #[test]
        fn an_edited_document_is_the_one_read_afresh(
            text in PROGRAM,
            copies in 1_usize..12,
            // Often so near the beginning that more goes than stands before it.
            edits in prop::collection::vec((prop_oneof![0_usize..20, 0_usize..4000], 0_usize..60, REPLACEMENT), 1..6),
        ) {
            // More lines than a page.
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
        fn fixes_of_damaged_programs_never_panic(text in PROGRAM) {
            let document = Document::read(text.into_bytes());
            for finding in document.findings() {
                for fix in document.offered(&finding, Renumbering::Offered) {
                    for edit in fix.edit {
                        prop_assert!(edit.range.start <= edit.range.end && edit.range.end <= document.text().len());
                    }
                }
            }
        }
    }
}
