//! The data of a program for comparing: its blocks as they mean it.

use crate::geometry::{Point, Segment, Side, Vector};
use crate::program::block_words::BlockWords;
use crate::program::path::{self, Kind, Step};
use crate::program::{Document, Format, Language};
use crate::text::SourceText;
use std::ops::Range;

/// Longer texts are not compared, bytes.
const LONGEST: usize = 2_000_000;

/// The blocks of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Traced {
    pub(super) blocks: Vec<Block>,
    pub(super) cuts: Vec<Cut>,
    /// Its first place is one of the drawing, if the program was written for it.
    pub(super) is_placed: bool,
    /// Arcs end where the machine stops counting: a little beside the intended place.
    pub(super) counts: bool,
    /// Every block counts from where the one before ended.
    pub(super) is_relative: bool,
    language: Language,
    pub(super) four_b: bool,
    /// An electrode mills it, layer by layer: it is compared with our own program, and not with a wire's path.
    pub(super) mills: bool,
    /// The text, unless it is too long to compare.
    pub(super) text: SourceText,
    /// Coordinates stand after blocks.
    pub(super) states_ends: bool,
}

/// What is cut from stop to stop; stops before tabs belong to it. Ranges of blocks by their numbers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cut {
    pub(super) blocks: Range<usize>,
    /// Without the ways in and out, as far as it comes back to where it begins.
    pub(super) contour: Range<usize>,
}

/// One block.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Block {
    /// Bytes of it in the text.
    pub(crate) range: Range<usize>,
    pub(crate) line: usize,
    pub(crate) motion: Motion,
    /// The side on which the control offsets it.
    pub(crate) side: Option<Side>,
    /// The place in the control's table that it takes the correction from, where the program names one.
    pub(crate) register: Option<u32>,
    /// The stretch of blocks between which the correction is neither switched on nor off: where the text itself ends a
    /// pass.
    pub(crate) stretch: usize,
    /// An invalid arc, taken as its chord.
    pub(crate) is_lost: bool,
    /// An arc of ISO that states its radius, not its centre.
    pub(crate) by_radius: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Motion {
    Cut(Segment),
    /// From one place to another without the wire, or by a block without a line or arc.
    Way(Point, Vector),
    Stop,
}

impl Motion {
    pub(super) fn ends(&self) -> Option<[Point; 2]> {
        match self {
            Motion::Cut(segment) => Some([segment.start(), segment.end()]),
            Motion::Way(start, by) => Some([*start, start + by]),
            Motion::Stop => None,
        }
    }

    /// How far two motions differ, wherever they begin, µm; `None` for different kinds.
    pub(super) fn away_from(&self, ideal: &Motion) -> Option<f64> {
        let (Some([start, end]), Some([ideal_start, ideal_end])) = (self.ends(), ideal.ends())
        else {
            return (self == ideal).then_some(0.0);
        };
        let by = ideal_start - start;
        let off = (end + by - ideal_end).norm();
        let (Motion::Cut(own), Motion::Cut(ideal)) = (self, ideal) else {
            // A straight way is one whether it is cut or not: the blocks about it tell that.
            let is_straight = |motion: &Motion| match motion {
                Motion::Cut(segment) => segment.as_arc().is_none(),
                Motion::Way(..) | Motion::Stop => true,
            };
            return (is_straight(self) && is_straight(ideal)).then_some(off);
        };
        Some(match (own.as_arc(), ideal.as_arc()) {
            (Some(own), Some(ideal)) if own.sweep * ideal.sweep > 0.0 => {
                off.max((own.center + by - ideal.center).norm())
            }
            (None, None) => off,
            _ => off.max((own.point_at(0.5) + by - ideal.point_at(0.5)).norm()),
        })
    }
}

impl Block {
    pub(super) fn segment(&self) -> Option<&Segment> {
        match &self.motion {
            Motion::Cut(segment) => Some(segment),
            Motion::Way(..) | Motion::Stop => None,
        }
    }
}

impl Traced {
    pub fn of(program: &Document) -> Traced {
        let four_b = match program {
            Document::ThreeB(program) => program.first_four_b_line().is_some(),
            Document::Iso(_) => false,
        };
        let (trace, text, language) = (program.trace(), program.text(), program.language());
        let cuts = path::cuts(&trace);
        let cuts = cuts.into_iter().filter(|cut| !cut.is_way);
        let cuts = cuts.map(|cut| {
            let contour = cut.contour_steps();
            // Where it does not come back, its first block and its last lead there and away.
            let inner = cut.steps.start + 1..cut.steps.end.saturating_sub(1);
            let is_known = cut.closed && !contour.is_empty() || cut.steps.len() < 3;
            Cut {
                contour: if is_known { contour } else { inner },
                blocks: cut.steps,
            }
        });
        let cuts = cuts.collect();
        let (is_placed, counts) = match language {
            Language::ThreeB => (trace.start_is_known, true),
            Language::Iso => (true, false),
        };
        let text = match text.len() <= LONGEST {
            true => text.clone(),
            false => SourceText::default(),
        };
        let mut moves = trace.steps.iter().filter(|step| step.moves());
        let is_relative = counts || moves.all(|step| step.is_relative);
        let trace = trace.into_meant();
        let (mut stretch, mut side) = (0, None);
        let mut stretch_of = |step: &Step| {
            if step.moves() && step.side != side {
                (stretch, side) = (stretch + 1, step.side);
            }
            stretch
        };
        let blocks = trace.steps.into_iter().map(|step| {
            let register = step.register.filter(|_| step.side.is_some());
            Block {
                stretch: stretch_of(&step),
                register: register.map(|register| register.index),
                line: step.line,
                motion: match (step.kind, step.ideal) {
                    (Kind::Line | Kind::Arc, Some(segment)) => Motion::Cut(segment),
                    (Kind::Arc, None) if step.end != step.start => {
                        Motion::Cut(Segment::line(step.start, step.end))
                    }
                    (Kind::Line | Kind::Arc | Kind::Rapid, _) => {
                        Motion::Way(step.start, step.end - step.start)
                    }
                    (Kind::Pause | Kind::End, _) => Motion::Stop,
                },
                side: step.side,
                is_lost: step.kind == Kind::Arc && step.ideal.is_none(),
                by_radius: step.radius.is_some(),
                range: step.range,
            }
        });
        let blocks = blocks.collect();
        Traced {
            states_ends: program.states_ends(),
            mills: program.mills(),
            text,
            blocks,
            cuts,
            is_placed,
            counts,
            is_relative,
            language,
            four_b,
        }
    }

    /// The format in which such a program is written.
    pub(super) fn format(&self) -> Format {
        match self.language {
            Language::Iso if self.mills => Format::Milling,
            Language::Iso => Format::Iso,
            Language::ThreeB if self.four_b => Format::FourB,
            Language::ThreeB => Format::ThreeB,
        }
    }

    /// The start of the first block that moves.
    pub(super) fn begin(&self) -> Option<Point> {
        self.blocks.iter().find_map(|block| match &block.motion {
            Motion::Cut(segment) => Some(segment.start()),
            Motion::Way(start, _) => Some(*start),
            Motion::Stop => None,
        })
    }

    /// The line that switches the correction on or off before a block, or at it: its bytes and its number.
    pub(super) fn switch_before(&self, index: usize) -> Option<(Range<usize>, usize)> {
        let own = self.blocks.get(index)?;
        let from = index.checked_sub(1).and_then(|at| self.blocks.get(at));
        let first = from.map_or(0, |before| before.line);
        let mut lines = (first..=own.line).rev();
        let switches = |line: &[u8]| {
            let has = |word: &[u8]| memchr::memmem::find(line, word).is_some();
            [&b"G40"[..], b"G41", b"G42"].into_iter().any(has)
        };
        let range = |line: usize| self.text.line_range(line);
        let line = lines.find(|line| self.text.slice(range(*line)).is_some_and(switches))?;
        Some((range(line), line))
    }

    /// Whether nothing that stops the machine may stand between two blocks: no word with an M, and in 3B none at all.
    pub(super) fn is_bare_between(&self, before: &Block, behind: &Block) -> bool {
        let between = before.range.end..behind.range.start.max(before.range.end);
        let between = self.text.slice(between).unwrap_or_default();
        match self.language {
            Language::Iso => !between.contains(&b'M'),
            Language::ThreeB => between.iter().all(|byte| !byte.is_ascii_alphabetic()),
        }
    }

    /// The bytes of a block, and of coordinates after it in its line.
    pub(super) fn line_from(&self, block: &Block) -> &[u8] {
        self.text.slice(self.range_from(block)).unwrap_or_default()
    }

    fn range_from(&self, block: &Block) -> Range<usize> {
        match self.states_ends {
            true => block.range.start..self.text.line_range(block.line).end,
            false => block.range.clone(),
        }
    }

    /// The content of a block.
    pub(super) fn said(&self, block: &Block) -> BlockWords {
        self.said_in(self.range_from(block))
    }

    /// The bytes of a range of the text.
    pub(super) fn said_in(&self, range: Range<usize>) -> BlockWords {
        BlockWords::of(self.language, self.text.slice(range).unwrap_or_default())
    }

    /// True where nothing is cut.
    pub(crate) fn is_empty(&self) -> bool {
        self.blocks.iter().all(|block| block.segment().is_none())
    }
}
