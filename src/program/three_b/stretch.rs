//! A stretch of consecutive lines: their content, the faults of each block by itself, and the sum of their blocks'
//! ways.
//!
//! Places count from the stretch's first byte and line, so that an edit elsewhere changes nothing here.

use super::around::StatedPoint;
use super::block::{Block, Motion};
use super::decode::meant;
use super::entry::{BlockEntry, Entry, Move, NO_NUMBER, What};
use super::fault::Flaw;
use super::parse::{Item, read_line};
use super::rules::block_number::Numbering;
use super::rules::position_mismatch::Positions;
use super::rules::{self, Counts, Limits, Spot};
use super::words::{Word, Words};
use crate::finding::{Detail, Fault, Rule};
use crate::geometry::{Bounds, Point, Segment, Vector};
use crate::program::path::{
    Ends, FEWEST_CROSSING, HeldWay, Lay, Node, Writing, may_be_odd, mixed, odd_joint, tolerance,
};
use std::ops::Range;

/// A finding at bytes of the stretch.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Local {
    pub(crate) range: Range<usize>,
    pub(crate) rule: Rule,
    pub(crate) detail: Detail,
    pub(crate) spot: Spot,
    pub(crate) counts: Counts,
    /// Index of the part that it lies in.
    pub(crate) part: usize,
}

/// The totals of blocks without a word between them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sum {
    pub(crate) blocks: usize,
    pub(crate) arcs: usize,
    pub(crate) travel: Move,
    /// Twice the area between the way and its chord, µm²; only its sign is used.
    pub(crate) twice_area: f64,
    /// Faults that change where the way leads.
    pub(crate) errors: usize,
    /// Unreadable blocks: the end of the way is unknown.
    pub(crate) unread: usize,
    /// Tells two of them apart: equal ways have equal marks.
    pub(crate) mark: u64,
    pub(crate) first: Option<Move>,
    pub(crate) second: Option<Move>,
    pub(crate) last: Option<Move>,
}

impl Sum {
    /// These blocks and then the next.
    pub(crate) fn then(&self, next: &Sum) -> Sum {
        if next.blocks == 0 {
            return Sum {
                errors: self.errors + next.errors,
                unread: self.unread + next.unread,
                ..*self
            };
        }
        let (a, b) = (self.travel.meant_um(), next.travel.meant_um());
        Sum {
            blocks: self.blocks + next.blocks,
            arcs: self.arcs + next.arcs,
            travel: self.travel.plus(next.travel),
            twice_area: self.twice_area + next.twice_area + a[0] * b[1] - a[1] * b[0],
            errors: self.errors + next.errors,
            unread: self.unread + next.unread,
            mark: self
                .mark
                .wrapping_mul(POLYNOMIAL.wrapping_pow(next.blocks as u32))
                .wrapping_add(next.mark),
            first: self.first.or(next.first),
            second: self.second.or(if self.blocks == 1 {
                next.first
            } else if self.blocks == 0 {
                next.second
            } else {
                None
            }),
            last: next.last.or(self.last),
        }
    }

    pub(crate) fn ends(&self) -> Ends {
        let first = self.first.unwrap_or_default();
        let second = first.plus(self.second.unwrap_or_default());
        let last = self.travel.minus(self.last.unwrap_or_default());
        Ends {
            begin: [Move::default(), first, second].map(|at| at.node()),
            end: [last, self.travel].map(|at| at.node()),
            blocks: self.blocks,
            tolerance: tolerance(self.arcs),
        }
    }

    fn push(&mut self, entry: &BlockEntry, segment: Option<&Segment>) {
        let origin = Point::origin();
        let one = Sum {
            blocks: 1,
            arcs: usize::from(!entry.is_line()),
            travel: entry.travel,
            twice_area: segment
                .and_then(Segment::as_arc)
                .map_or(0.0, |arc| Segment::Arc(*arc).twice_area(origin)),
            errors: 0,
            unread: 0,
            mark: mark_of(entry),
            first: Some(entry.travel),
            second: None,
            last: Some(entry.travel),
        };
        *self = self.then(&one);
    }
}

const POLYNOMIAL: u64 = 0x9e37_79b9_7f4a_7c15;

fn mark_of(entry: &BlockEntry) -> u64 {
    let Block {
        x,
        y,
        j,
        axis,
        motion,
    } = entry.block;
    let (kind, quadrant) = match motion {
        Motion::Line(quadrant) => (0, quadrant),
        Motion::Clockwise(quadrant) => (1, quadrant),
        Motion::CounterClockwise(quadrant) => (2, quadrant),
    };
    let fields = [
        x as u64,
        y as u64,
        j as u64,
        axis as u64 * 16 + kind * 4 + u64::from(quadrant.number()),
    ];
    fields.into_iter().fold(POLYNOMIAL, mixed)
}

/// Blocks up to a word or to the end of the stretch.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    pub(crate) entries: Range<usize>,
    pub(crate) sum: Sum,
    /// The word behind it, at `entries.end`.
    pub(crate) word: Option<(Word, bool)>,
    pub(crate) lay: Lay,
}

/// The curve of a block from the origin; none where it is unknown.
pub(super) fn shape(block: &Block) -> Segment {
    meant(block, Point::origin()).unwrap_or_else(nowhere)
}

fn nowhere() -> Segment {
    Segment::line(Point::origin(), Point::origin())
}

/// The beginning or end of a stretch, as far as the joint with its neighbour needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Edge {
    /// The outermost block, from the origin on.
    pub(crate) block: Segment,
    /// Its joint with the other blocks of the stretch may be odd.
    pub(crate) is_odd: bool,
}

/// An unfinished part.
struct Open {
    /// Its first entry.
    first: usize,
    sum: Sum,
    way: HeldWay,
    /// The last three blocks, the last one first, each from the origin on.
    trail: [Option<Segment>; 3],
    /// Its two ends.
    edges: [Option<Edge>; 2],
    /// Blocks that begin at an odd joint, by their number in the part.
    odd: Vec<(usize, Fault)>,
}

impl Open {
    fn at(first: usize) -> Open {
        Open {
            first,
            sum: Sum::default(),
            way: HeldWay::from(Node::at(Point::origin()), Writing::default()),
            trail: [None; 3],
            edges: [None; 2],
            odd: Vec::new(),
        }
    }

    fn push(&mut self, entry: &BlockEntry) {
        let segment = meant(&entry.block, Point::origin());
        self.join(segment.unwrap_or_else(nowhere));
        let [x, y] = self.sum.travel.meant_um();
        let (start, by) = (Point::new(x, y), Vector::new(x, y));
        let way = segment
            .as_ref()
            .map_or(Segment::line(start, start), |segment| segment.moved(by));
        self.sum.push(entry, segment.as_ref());
        self.way.push(way, !entry.is_line(), self.sum.travel.node());
    }

    /// Checks the joint at which the last block begins, now that the next block is known.
    fn join(&mut self, next: Segment) {
        let [made, before, came] = self.trail;
        let is_odd = made.is_some_and(|made| may_be_odd(&made, &next));
        if let (Some(made), Some(before)) = (made, before) {
            let fault = odd_joint(came, before, made, &next);
            let nth = self.sum.blocks - 1;
            self.odd.extend(fault.map(|fault| (nth, fault)));
        }
        if let (Some(first), 1) = (&mut self.edges[0], self.sum.blocks) {
            first.is_odd = is_odd;
        }
        let block = next;
        self.edges[0].get_or_insert(Edge {
            block,
            is_odd: false,
        });
        self.edges[1] = Some(Edge { block, is_odd });
        self.trail = [Some(next), made, before];
    }

    /// The part up to an entry, with the word there.
    fn closed(self, end: usize, word: Option<(Word, bool)>) -> Part {
        Part {
            entries: self.first..end,
            lay: Lay::of(&self.way, self.sum.mark),
            sum: self.sum,
            word,
        }
    }
}

/// Consecutive lines of a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Stretch {
    pub(crate) entries: Vec<Entry>,
    pub(crate) faults: Vec<Local>,
    pub(crate) parts: Vec<Part>,
    pub(crate) blocks: usize,
    pub(crate) arcs: usize,
    pub(crate) texts: usize,
    /// Blocks that could not be read.
    pub(crate) unread: usize,
    /// Entries with a number, and blocks with an end point behind them.
    pub(crate) numbered: usize,
    pub(crate) stated: usize,
    pub(crate) numbering: Numbering,
    pub(crate) positions: Positions,
    pub(crate) travel: Move,
    /// Around its way, µm from its start.
    pub(crate) bounds: Option<Bounds>,
    pub(crate) words: usize,
    /// Entries: the controller's own first end word, the last end word of any, the last word.
    pub(crate) own_end: Option<usize>,
    pub(crate) last_end: Option<usize>,
    pub(crate) last_word: Option<usize>,
    /// Parts between two words of the stretch without a closed contour, and those that come near themselves, until they
    /// are known not to cross.
    pub(crate) open: Vec<usize>,
    pub(crate) may_cross: Vec<usize>,
    /// The beginning of its first part, and the end of its last one; `None` where there is no block in it.
    pub(crate) edges: [Option<Edge>; 2],
}

/// A way of at most this many lines between two pauses leads from one contour to the next.
const JUMP_BLOCKS: usize = 3;

/// True for the way between two pauses from one contour to the next. A way that returns to its start is not one: that
/// is how a tab is cut off, from and to the thread hole.
pub(super) fn is_jump(sum: &Sum) -> bool {
    let is_way = (1..=JUMP_BLOCKS).contains(&sum.blocks) && sum.arcs == 0;
    is_way && sum.travel.machine != [0, 0]
}

/// True for a part that is searched for crossings: behind a faulty block the path is not the intended one.
pub(super) fn may_cross_itself(sum: &Sum) -> bool {
    sum.blocks >= FEWEST_CROSSING && sum.errors == 0
}

impl Stretch {
    /// Reads lines that begin at `offset` of the text. `lines` are ranges of the text without line ends, `bytes` all of it.
    pub(crate) fn read(
        text: &[u8],
        offset: usize,
        lines: impl Iterator<Item = Range<usize>>,
        words: &Words<'_>,
        limits: &Limits,
    ) -> Stretch {
        let mut stretch = Stretch::default();
        let mut open = Open::at(0);
        for (line, range) in lines.enumerate() {
            let start = range.start;
            read_line(&text[range], start, words, |item| {
                stretch.take(item, line as u32, offset, &mut open, limits)
            });
        }
        let end = stretch.entries.len();
        stretch.close(open, end, None);
        stretch.entries.shrink_to_fit();
        stretch.parts.shrink_to_fit();
        stretch.sum_up();
        stretch
    }

    /// Ends a part: its oddities count once its contour is known.
    fn close(&mut self, mut open: Open, end: usize, word: Option<(Word, bool)>) {
        if self.parts.is_empty() {
            self.edges[0] = open.edges[0];
        }
        self.edges[1] = open.edges[1];
        let odd = std::mem::take(&mut open.odd);
        let part = open.closed(end, word);
        let own = self.entries.get(part.entries.clone()).unwrap_or_default();
        let blocks = || own.iter().filter(|entry| entry.block().is_some());
        for (nth, fault) in odd {
            let range = blocks().nth(nth).map_or(0..0, Entry::range);
            self.faults.push(Local {
                range,
                rule: fault.rule(),
                detail: Detail::Program(Box::new(fault)),
                spot: Spot::Block,
                counts: Counts::IfAlone,
                part: self.parts.len(),
            });
        }
        self.parts.push(part);
    }

    fn sum_up(&mut self) {
        let last = self.parts.len().saturating_sub(1);
        for (index, part) in self.parts.iter().enumerate() {
            if part.sum.blocks > 0 {
                let [x, y] = self.travel.meant_um();
                let placed = part.lay.bounds.moved(Vector::new(x, y));
                let known = self.bounds.get_or_insert(placed);
                known.merge(&placed);
            }
            self.travel = self.travel.plus(part.sum.travel);
            self.arcs += part.sum.arcs;
            if let Some((word, is_own)) = part.word {
                self.words += 1;
                self.last_word = Some(part.entries.end);
                if word == Word::End {
                    self.own_end = self.own_end.or(is_own.then_some(part.entries.end));
                    self.last_end = Some(part.entries.end);
                }
            }
            if index > 0 && index < last {
                self.open
                    .extend((!is_jump(&part.sum) && !part.lay.goes_round).then_some(index));
                let may_cross = !part.lay.near.is_empty() && may_cross_itself(&part.sum);
                self.may_cross.extend(may_cross.then_some(index));
            }
        }
    }

    fn take(&mut self, item: Item, line: u32, base: usize, open: &mut Open, limits: &Limits) {
        let local = |range: Range<usize>| range.start - base..range.end - base;
        match item {
            Item::Block {
                block,
                range,
                number,
                stated_end,
                part,
            } => {
                let entry = BlockEntry::new(block, part, stated_end);
                let range = local(range);
                let part_index = self.parts.len();
                for observation in rules::check(&block, part, limits) {
                    // An unusual block, or one too tight, leads where it says.
                    open.sum.errors += usize::from(
                        observation.counts == Counts::Always
                            && observation.rule != Rule::SmallRadius,
                    );
                    let (rule, spot, counts, detail) = (
                        observation.rule,
                        observation.spot,
                        observation.counts,
                        observation.detail,
                    );
                    self.faults.push(Local {
                        range: range.clone(),
                        rule,
                        detail,
                        spot,
                        counts,
                        part: part_index,
                    });
                }
                self.stated += usize::from(entry.stated_end().is_some());
                open.push(&entry);
                self.positions
                    .block(self.blocks, self.entries.len(), &entry);
                self.blocks += 1;
                self.push(range, line, number, What::Block(entry));
            }
            Item::Word {
                word,
                is_own,
                range,
                number,
            } => {
                let end = self.entries.len();
                self.push(local(range), line, number, What::Word { word, is_own });
                let before = std::mem::replace(open, Open::at(end + 1));
                self.close(before, end, Some((word, is_own)));
            }
            Item::StartPoint { at, range } => {
                self.positions.anchor = Some(Some(StatedPoint { at, decimals: 3 }));
                self.push(local(range), line, None, What::StartPoint(at));
            }
            Item::Text { range, column } => {
                self.texts += 1;
                self.push(local(range), line, None, What::Text { column });
            }
            Item::CommentedBlock { range, column } => {
                self.texts += 1;
                self.push(local(range), line, None, What::CommentedBlock { column });
            }
            Item::Fault(fault) => {
                let is_unread = matches!(fault.flaw, Flaw::Unreadable(_) | Flaw::NotPlain(_));
                // Without its coordinates a block leads where it says.
                open.sum.errors += usize::from(fault.flaw != Flaw::DecimalCommas);
                open.sum.unread += usize::from(is_unread);
                self.unread += usize::from(is_unread);
                if is_unread {
                    // Its number has its turn, but its end is unknown.
                    self.positions.anchor = Some(None);
                    self.push(local(fault.range.clone()), line, fault.number, What::Unread);
                }
                let sentence = || Detail::Said(fault.sentence());
                let program = |fault| Detail::Program(Box::new(fault));
                let (rule, detail) = match fault.flaw {
                    Flaw::Unreadable(_)
                    | Flaw::LetterO
                    | Flaw::NotPlain(_)
                    | Flaw::DecimalCommas => (Rule::Syntax, sentence()),
                    Flaw::MissingB { .. } => (Rule::MissingB, program(Fault::MissingB)),
                    Flaw::BlockNumberAsB { number } => (
                        Rule::BlockNumberAsB,
                        program(Fault::BlockNumberAsB { number }),
                    ),
                };
                let part = self.parts.len();
                self.faults.push(Local {
                    range: local(fault.range.clone()),
                    rule,
                    detail,
                    spot: Spot::Block,
                    counts: Counts::Always,
                    part,
                });
            }
        }
    }

    fn push(&mut self, range: Range<usize>, line: u32, number: Option<u32>, what: What) {
        self.numbered += usize::from(number.is_some());
        self.numbering = self
            .numbering
            .with(number, matches!(what, What::Block(_) | What::Unread));
        self.entries.push(Entry {
            start: range.start as u32,
            length: range.len() as u32,
            line,
            number: number.unwrap_or(NO_NUMBER),
            what,
        });
    }
}
