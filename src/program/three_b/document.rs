//! 3B text as an open document: its lines, the machine's way, and its findings.
//!
//! The text is cut into stretches of lines. Lines are independent, so an edit rereads the stretches that it touched;
//! everything about the whole program (contours, numbers, the end) comes from a few sums of each stretch.

mod asked;
mod contours;
mod cuts;
mod fixes;
mod joints;
mod judge;
mod repairs;
mod report;
mod sequence;
mod told;
mod walk;
mod way;

use super::entry::Entry;
use super::rules::Limits;
use super::stretch::Stretch;
use super::sum::Sum;
use super::words::Words;
use crate::finding::Finding;
use crate::geometry::{Point, Vector};
use crate::program::chunks::{ChunkReader, Chunks, Reread};
use crate::program::contours::{Contours, PartAt, Touched};
use crate::program::path::Known;
use crate::settings::Effective;
use crate::text::SourceText;
use asked::Asked;
use sequence::Numbers;
use std::ops::Range;
use told::Told;

/// A 3B or 4B program as text, and its reading.
#[derive(Clone, Debug)]
pub struct Document {
    text: SourceText,
    words: OwnWords,
    limits: Limits,
    stretches: Chunks<Stretch>,
    view: Box<View>,
    /// The results of the search for crossings.
    known: Box<Known>,
}

#[derive(Clone, Debug, PartialEq)]
struct OwnWords {
    pause: String,
    end: String,
}

impl OwnWords {
    fn of(settings: &Effective) -> OwnWords {
        OwnWords {
            pause: settings.pause.trim().into(),
            end: settings.end.trim().into(),
        }
    }

    fn words(&self) -> Words<'_> {
        Words {
            pause: &self.pause,
            end: &self.end,
        }
    }
}

/// An entry by its stretch and its index in there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct At {
    stretch: usize,
    entry: usize,
}

/// Blocks between two words, put together from the parts of the stretches that they run through.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JoinedCut {
    /// First and last part.
    parts: [PartAt; 2],
    sum: Sum,
    /// The way between two contours, without the wire.
    is_jump: bool,
    /// Blocks before its first stop, where it goes on after that.
    stop: Option<usize>,
}

/// The properties of the program as a whole.
#[derive(Clone, Debug, Default, PartialEq)]
struct View {
    /// The machine's position before each stretch, µm.
    begins: Vec<Point>,
    /// Where by the coordinates the wire was moved by hand at a stop: the first block after it, and how far, µm.
    taken: Vec<(At, Vector)>,
    /// The cuts that extend over the end of a stretch, or begin or end the text, in order. The others are parts of one stretch.
    outer: Vec<JoinedCut>,
    /// The contours that are open and not continued after a stop, and those that cross themselves.
    contours: Contours<JoinedCut>,
    /// The parts with an odd joint about the end of a stretch that is reported.
    odd: Vec<PartAt>,
    /// The word that ends the program.
    end: Option<At>,
    last_block: Option<At>,
    numbers: Numbers,
    /// The findings about single contours, and all others; the latter in no order, at bytes of the text.
    told: Told,
    findings: Vec<Finding>,
    asked: Asked,
}

impl Document {
    /// Reads program text with the words and limits of the default settings.
    pub fn read(bytes: Vec<u8>) -> Document {
        Document::read_with(bytes, &Effective::default())
    }

    /// Reads program text. Never fails: damage is in [`Document::findings`].
    pub fn read_with(bytes: Vec<u8>, settings: &Effective) -> Document {
        let text = SourceText::new(bytes);
        let (words, limits) = (OwnWords::of(settings), Limits::of(settings));
        let reader = Reader {
            words: words.words(),
            limits: &limits,
        };
        let stretches = Chunks::read(&reader, &text, 0..text.line_count());
        let mut document = Document {
            text,
            words,
            limits,
            stretches,
            view: Box::default(),
            known: Box::default(),
        };
        document.judge_again(None);
        document
    }

    /// The words between blocks.
    pub(crate) fn words(&self) -> Words<'_> {
        self.words.words()
    }

    /// The largest number that the controller takes, µm.
    pub(crate) fn largest(&self) -> i64 {
        self.limits.largest()
    }

    pub fn text(&self) -> &SourceText {
        &self.text
    }

    /// Rereads where the settings change the meaning of the text or its faults.
    pub(crate) fn set_settings(&mut self, settings: &Effective) {
        if self.words != OwnWords::of(settings) || self.limits != Limits::of(settings) {
            *self = Document::read_with(std::mem::take(&mut self.text).into_bytes(), settings);
        }
    }

    /// Replaces a range of bytes and rereads what it touched. Returns the first stretch in which the machine may
    /// stand elsewhere than before.
    pub fn edit(&mut self, range: Range<usize>, replacement: &str) -> usize {
        let reader = Reader {
            words: self.words.words(),
            limits: &self.limits,
        };
        let reread = self
            .stretches
            .edit(&reader, &mut self.text, (range, replacement), |_| {});
        self.judge_again(Some(reread))
    }

    fn entry(&self, at: At) -> Option<&Entry> {
        self.stretches.get(at.stretch)?.entries.get(at.entry)
    }

    /// Bytes of an entry in the text.
    fn range_of(&self, at: At) -> Range<usize> {
        let byte = self.stretches.byte(at.stretch);
        self.entry(at).map_or(0..0, |entry| {
            byte + entry.range().start..byte + entry.range().end
        })
    }

    /// Judges the program again; findings in lines that an edit has not `reread` are kept where
    /// they depend on nothing else. Returns the first stretch in which the machine may stand elsewhere than before.
    fn judge_again(&mut self, reread: Option<Reread>) -> usize {
        let before = std::mem::take(&mut *self.view);
        self.view.end = self.end_word();
        // An end word that was read again bears on what was read with it, which is judged again.
        let same_end = |reread: &Reread| match (before.end, self.view.end) {
            (Some(before), Some(now)) => match reread.moved(before.stretch) {
                Some(stretch) => At { stretch, ..before } == now,
                None => reread.chunks.contains(&now.stretch),
            },
            (before, now) => before == now,
        };
        let reread = reread.filter(same_end);
        let mut before = reread.as_ref().map_or_else(View::default, |_| before);
        let reread = reread.unwrap_or_else(|| Reread::all(&self.stretches));
        let mut outer = std::mem::take(&mut before.outer);
        let mut contours = std::mem::take(&mut before.contours);
        let [from, to] = self.find_outer(&mut outer, &reread);
        self.view.outer = outer;
        self.view.last_block = self.last_block(self.view.end);
        let off = self.off_positions();
        self.view.taken = self.taken(&off);
        self.view.numbers = self.numbers();
        self.view.begins = self.begins(&self.view.taken);
        let first_moved = self.first_moved(&before, &reread);
        let touched = Touched {
            reread: &reread,
            from,
            to,
        };
        // The contours within one stretch that are now known not to cross themselves.
        let mut clean: Vec<PartAt> = Vec::new();
        let mut known = std::mem::take(&mut self.known);
        let looked_at = contours.look(self, touched, &mut known, |cut, crosses| {
            let is_inner = cut.parts[0] == cut.parts[1];
            clean.extend((is_inner && crosses == Some(false)).then_some(cut.parts[0]));
        });
        self.known = known;
        self.view.contours = contours;
        let mut findings = Vec::new();
        self.view.odd = self.judge_joints(&mut findings);
        self.judge_contours(before, looked_at);
        self.judge(off, findings);
        // The findings of a contour within one stretch depend on nothing else: it is not checked again.
        for of_stretch in clean.chunk_by(|a, b| a.0 == b.0) {
            let stretch = of_stretch
                .first()
                .and_then(|(stretch, _)| self.stretches.get_mut(*stretch));
            let is_clean = |part: &usize| {
                of_stretch
                    .binary_search_by_key(part, |(_, part)| *part)
                    .is_ok()
            };
            if let Some(stretch) = stretch {
                stretch.may_cross.retain(|part| !is_clean(part));
                stretch.let_go();
            }
        }
        first_moved
    }
}

/// How 3B text is read: lines are independent.
struct Reader<'a> {
    words: Words<'a>,
    limits: &'a Limits,
}

impl ChunkReader for Reader<'_> {
    type State = ();
    type Begun = Range<usize>;
    type Chunk = Stretch;

    // Unit tests have short texts.
    const LINES: usize = if cfg!(test) { 24 } else { 128 };

    fn begin(&self) {}

    fn run(&self, _: &SourceText, lines: Range<usize>, (): ()) -> (Range<usize>, ()) {
        (lines, ())
    }

    fn finish(&self, text: &SourceText, lines: Range<usize>, old: &[Stretch]) -> Stretch {
        Stretch::read(
            text.bytes(),
            text.line_start(lines.start),
            lines.map(|line| text.line_range(line)),
            &self.words,
            self.limits,
            old,
        )
    }

    fn before(_: &Stretch) {}

    fn after(_: &Stretch) {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::finding::Rule;
    use crate::program::numbering::Renumbering;
    use crate::program::path::{Cut, Step, cuts};
    use proptest::prelude::*;

    /// Findings in one order, whatever stretches the lines lie in.
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
            edits in prop::collection::vec((0_usize..4000, 0_usize..60, REPLACEMENT), 1..6),
        ) {
            // More lines than one stretch holds.
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
        fn what_a_cut_tells_by_its_ends_is_what_all_its_steps_tell(
            text in PROGRAM,
            (leads, rounds) in (0_usize..4, 0_usize..100),
        ) {
            // A contour of more blocks than a cut holds, with ways in and out.
            let way = 100 * rounds;
            let long = format!(
                "{}{}B0B50B50GYL4\nB{way}B0B{way}GXL3\nB0B50B50GYL2\n{}",
                "B100B0B100GXL1\n".repeat(leads),
                "B50B0B50GXL1\nB0B50B50GYL2\nB50B0B50GXL1\nB0B50B50GYL4\n".repeat(rounds),
                "B100B0B100GXL3\n".repeat(leads),
            );
            let document = crate::program::Document::ThreeB(Document::read(format!("{text}{long}D\n{text}").into_bytes()));
            let trace = document.trace();
            let all = cuts(&trace);
            for (index, step) in trace.steps.iter().enumerate().filter(|(index, step)| step.moves() && index % 13 == 0) {
                let whole = all.iter().find(|cut| cut.steps.contains(&index)).cloned();
                let Some(whole) = whole else { return Err(TestCaseError::fail("no cut")) };
                let Some((held, cut, nth)) = document.cut_at(step.range.start) else {
                    return Err(TestCaseError::fail("no cut"));
                };
                // A pause before a tab is a step of the trace and none of the cut.
                let moves = |steps: std::ops::Range<usize>| trace.steps[steps].iter().filter(|step| step.moves()).count();
                prop_assert_eq!(nth, moves(whole.steps.start..index));
                prop_assert_eq!(held.step(nth).is_none_or(|held| held == step), true);
                let (steps, own) = (whole.steps.clone(), whole.contour_steps());
                let (lead_in, lead_out) = (moves(steps.start..own.start), moves(own.end..steps.end));
                prop_assert_eq!(cut, Cut { steps: 0..moves(steps), lead_in, lead_out, ..whole });
            }
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
